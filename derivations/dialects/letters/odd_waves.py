"""cos(theta^2) of a program, which no equation of motion has: a quantity that is independent of all others.

As functions of θ, cos θ² is algebraically independent of cos θ and θ (Ax), so that rows hold for every value of that
quantity, or do not hold. Where sine and cosine of one square stand, they are not independent, and are left alone.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from ..names import LONGEST
from .every_text import rows_of

POWER = re.compile(r"(?<![A-Za-z])(?P<wave>sin|cos)\(\s*(?P<x>[A-Za-z]\w{0,20})\s*\^\s*(?P<k>[2-6])\s*\)")
OTHERS = ("lagrangian", "kinetic", "potential", "hamiltonian", "momenta", "solved", "steps", "positions", "velocities")


def with_odd_waves(data: dict[str, Any], coordinates: Collection[str]) -> tuple[dict[str, Any], list[str]]:
    """The fields with a quantity for each cosine of a coordinate's power, and the names of these."""
    define = data.get("define", {})
    rows = rows_of(data)
    if any(field in data for field in OTHERS) or not isinstance(define, dict):
        return data, []
    text = "\n".join([*(line for _, line in rows), *map(str, define.values())])
    found = [m for m in POWER.finditer(text) if m["x"] in coordinates]
    waves = {(m["x"], m["k"], m["wave"]) for m in found}
    if not found or len({(x, k) for x, k, _ in waves}) < len(waves):
        return data, []
    names = {(x, k, wave): f"waveof{x.replace('_', '')}power{k}" for x, k, wave in waves}
    taken = text + str(data.get("bodies"))
    if len(set(names.values())) < len(names) or any(len(name) > LONGEST or name in taken for name in names.values()):
        return data, []

    def one(line: Any) -> Any:
        def name(m: re.Match[str]) -> str:
            return names.get((m["x"], m["k"], m["wave"]), m[0])

        return POWER.sub(name, line) if isinstance(line, str) else line

    made = {"equations": {label: one(line) for label, line in rows}, "define": {k: one(v) for k, v in define.items()}}
    return data | made, list(names.values())
