r"""Newton's equations with the forces of constraints: one row more for each force, which is then eliminated.

``M ẍ = T sin θ``, ``m (ẍ + …) = -T sin θ``, ``m (…) = T cos θ - m g``: three rows for two coordinates and the rod's
force T. A force is a letter T, N, R, S, H, V, P or F, with an index or none, which neither the mechanism nor the file
defines.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ...models.errors import InvalidInput
from ..algebra.trig import CONSTANT_ONE, NOTHING, Formula, Space
from ..dialects.names import plain_name
from ..steps.mechanism import Mechanism
from .declaration import QUANTITIES
from .motion.joint_forces import is_held

FORCE = re.compile(
    r"(?<![A-Za-z\\^{])(?<!\^\s)(?P<name>(?:[TNRSHVPF]|\\lambda)(?![a-z])(?:_\{[A-Za-z0-9]{1,3}\}|_?[0-9](?![0-9A-Za-z])"
    r"|_[A-Za-z]|[₀-₉]|(?![A-Za-z0-9_₀-₉])))"
)
WORD = re.compile(r"\\?[A-Za-z]+(?:_\{\w+\}|_?\w+)?")
MOST_FORCES, MOST_ROWS = 6, 16


def constraint_forces(data: dict[str, Any], count: int) -> list[str]:
    """The names of forces in the rows, where there are rows besides those of ``count`` coordinates for them all."""
    table, define = data.get("equations"), data.get("define", {})
    lines = list(table.values()) if isinstance(table, dict) else table if isinstance(table, list) else []
    extra = len(lines) - count
    if not count or not 1 <= extra <= MOST_ROWS or not all(isinstance(line, str) for line in lines):
        return []
    bodies = data.get("bodies", [])
    texts: list[str] = [str(name) for name in define] if isinstance(define, dict) else []
    if isinstance(bodies, list):
        texts += [str(b[q]) for b in bodies if isinstance(b, dict) for q in (*QUANTITIES, "coordinate") if q in b]
    taken = {plain_name(word[0]) for text in texts for word in WORD.finditer(text)}
    found = {plain_name(m["name"]): m["name"] for line in lines for m in FORCE.finditer(line)}
    forces = [name for name in found if name and name not in taken]
    return sorted(forces) if len(forces) <= min(extra, MOST_FORCES) else []


def eliminated(
    space: Space, rows: Sequence[tuple[str, Formula]], forces: Sequence[str], mechanism: Mechanism | None
) -> tuple[tuple[str, Formula], ...]:
    """The rows without the forces. Raises InvalidInput where one is in no row, or not linear.

    ``mechanism``: by which a force that is in one row alone is judged; such a row says nothing of the motion.
    """
    left = list(rows)
    for force in forces:
        place = space.own_place(force)
        parts = [_parts(space, f, place, force) for _, f in left]
        pivots = [k for k, (_, by) in enumerate(parts) if by]
        if not pivots:
            raise InvalidInput(f"equations: the force {force} is in no row that is left; it cannot be eliminated")
        if len(pivots) == 1 and (mechanism is None or not is_held(mechanism, rows, forces, force)):
            raise InvalidInput(
                f"equations: the force {force} is in row {left[pivots[0]][0]} alone, which only says what it is, and "
                "it is none that a rod or a slide holds here; correct that row, or leave it out"
            )
        pivot = min(pivots, key=lambda k: len(parts[k][1].terms))
        without, by = parts[pivot]
        left = [
            (label, f if not parts[k][1] else parts[k][0] * by - without * parts[k][1])
            for k, (label, f) in enumerate(left) if k != pivot
        ]  # fmt: skip
    return tuple(left)


def _parts(space: Space, f: Formula, place: int, force: str) -> tuple[Formula, Formula]:
    """What stands without the force, and its factor."""
    without = space.replace(f, {place: NOTHING})
    by = space.replace(f, {place: CONSTANT_ONE}) - without
    if space.replace(f, {place: CONSTANT_ONE.times(2)}) - without - by.times(2):
        raise InvalidInput(f"equations: the force {force} is not linear; solve the rows for the accelerations first")
    return without, by
