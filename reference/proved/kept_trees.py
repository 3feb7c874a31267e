"""Proved end points of the catalogue's open mechanisms that their joints keep in a plane, kept in ``reference/data/``.

As :mod:`.kept` has them: at the times of :mod:`furiko.reference.truth.tree_end_points`, under the same keys,
coordinates and rates as decimal balls. ``python -m furiko.reference.proved.kept_trees [SCENE …]`` computes them again.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import TreeScene, find_scenes
from ...models.errors import InvalidInput
from ...models.writers.whole_file import write_whole
from ..truth.tree_end_points import key, moves, times
from .enclose import Enclosed, above, enclose
from .kept import READ_BITS, Proof, entry

PATH = Path(__file__).parent.parent / "data" / "proved_tree_endpoints.json"
DIGITS = 20  # doubles are held against them


def proof(scene: TreeScene) -> Proof | None:
    """The proved coordinates and rates at :func:`~.tree_end_points.times`; None where none are kept."""
    entry = _kept().get(key(scene))
    if entry is None:
        return None
    import flint

    with flint.ctx.workprec(READ_BITS):
        balls = np.array([[flint.arb(text) for text in row] for row in entry["states"]], dtype=object)
    n = balls.shape[1] // 2
    numbers = (entry[name] for name in ("bits", "steps", "seconds"))
    return Proof(entry["scene"], tuple(entry["times"]), balls[:, :n], balls[:, n:], tuple(entry["radius"]), *numbers)


def sure(q: NDArray[np.float64], error: NDArray[np.float64], proof: Proof | None) -> tuple[Any, tuple[bool, ...]]:
    """How far off coordinates ``q`` (times, n) are at each time, shape (times,), and whether it is proved.

    A bound where there is a proof, the largest distance to the far ends of the intervals; elsewhere ``error``.
    """
    off = error.copy()
    count = 0 if proof is None else len(proof.times)
    if proof is not None:
        import flint

        with flint.ctx.workprec(READ_BITS):
            for i in range(count):
                apart = [abs(ball - x).upper() for ball, x in zip(proof.theta[i], q[i].tolist(), strict=True)]
                off[i] = above(max(apart))
    return off, tuple(i < count for i in range(len(off)))


def proved(scene: TreeScene, digits: int = DIGITS, seconds: float | None = None) -> Enclosed:
    """The scene's motion at its start and at the times that are kept, proved anew."""
    assert scene.q is not None
    assert scene.v is not None
    return enclose(scene.system, scene.q, scene.v, [0.0, *times(scene)], digits, seconds=seconds)


@cache
def _kept() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = json.loads(PATH.read_text(encoding="utf-8")) if PATH.exists() else {}
    return found


def main(names: Sequence[str]) -> None:
    """Prove the end points of these scenes, or of all that move in a plane, and write them."""
    for scene in find_scenes(None):
        if not isinstance(scene, TreeScene) or not moves(scene) or (names and scene.name not in names):
            continue
        try:
            found = proved(scene)
        except InvalidInput as error:  # a joint that leaves the plane
            print(error)
            continue
        kept = json.loads(PATH.read_text(encoding="utf-8")) if PATH.exists() else {}
        kept[key(scene)] = entry(scene, found)
        write_whole(PATH, json.dumps(kept, indent=1, sort_keys=True, ensure_ascii=False) + "\n")
        until = f"{found.proved_until:g} s {found.why}".rstrip()
        print(f"{scene.name}: proved until {until}, {found.bits} bits, {found.seconds:.1f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
