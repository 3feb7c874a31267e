"""The scenes that ``furiko bench`` times by default: rods that start at rest with rising angles.

``python -m furiko.studies.bench.scenes`` computes their end points anew, and proves those that it names (minutes).
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import numpy as np

from ...models import RodChain, Scene


def _rods(name: str, n: int, length: float, first: float, last: float, duration: float) -> Scene:
    theta = tuple(np.linspace(first, last, n).tolist())
    says = f"{n} equal rods from rest, angles {first:g} to {last:g} rad, {duration:g} s"
    return Scene(name, RodChain((length,) * n), theta, (0.0,) * n, duration, random=0, named=(), description=says)


BENCHMARKS: dict[str, Scene] = {
    scene.name: scene
    for scene in (
        _rods("bench-rods-2", 2, 1.0, 2.0, 2.5, 10.0),  # grows rounding errors a millionfold
        _rods("bench-rods-5", 5, 1.0, 1.0, 2.0, 5.0),
        _rods("bench-rods-100", 100, 0.05, 0.3, 1.2, 5.0),
    )
}


def main(proved: Sequence[str]) -> None:
    """Compute the end points of these motions anew, and prove those of the named ones."""
    from ...reference.proved import kept
    from ...reference.truth.end_points import BENCHMARKS_PATH, write

    print(f"{write([*BENCHMARKS.values()], BENCHMARKS_PATH)} end points written to {BENCHMARKS_PATH}")
    for name in proved:
        kept.write(BENCHMARKS[name], kept.BENCHMARKS_PATH)


if __name__ == "__main__":
    main(sys.argv[1:])
