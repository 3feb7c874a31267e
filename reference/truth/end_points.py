"""End points of the catalogue's trajectories, computed once in quadruple precision and kept as small data.

The key of an entry is a hash of the mechanism, the initial state and the times, not a name. An entry holds the states
as decimals of some 34 digits, and the error estimate of each. ``python -m furiko.reference.truth.end_points`` computes
all entries again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from ...models import DocumentSystem, RodChain, Scene
from ...models.writers.whole_file import write_whole
from . import quadruple
from .quadruple import QuadrupleTrajectory

PATH = Path(__file__).parent.parent / "data" / "endpoints.json"
BENCHMARKS_PATH = PATH.with_name("benchmarks.json")  # of the motions that are timed, in the same form
PARTS = (0.125, 0.25, 0.5, 1.0)  # of the duration


def lookup(
    system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], duration: float
) -> QuadrupleTrajectory:
    """States in quadruple precision at 1/8, 1/4, 1/2 and all of ``duration`` [s], shape (4, n): kept or computed now.

    Computing needs heyoka: raises LibraryMissing without it.
    """
    entry = _kept().get(_key(system, theta, omega, _times(duration)))
    if entry is None:
        entry = _computed(system, theta, omega, _times(duration))
    return quadruple.from_decimals(entry["states"], entry["error"], system.n)


def entries(scenes: Sequence[Scene]) -> dict[str, dict[str, Any]]:
    """The entries of these scenes, computed anew. Raises LibraryMissing without heyoka."""
    return dict(_entry(scene) for scene in scenes if scene.theta is not None and scene.duration > 0)


def write(scenes: Sequence[Scene], path: Path = PATH) -> int:
    """Compute and write the data of all these scenes; returns how many entries it has."""
    found = entries(scenes)
    path.parent.mkdir(exist_ok=True)
    write_whole(path, json.dumps(found, indent=1, sort_keys=True, ensure_ascii=False) + "\n")
    return len(found)


def _entry(scene: Scene) -> tuple[str, dict[str, Any]]:
    assert scene.theta is not None
    assert scene.omega is not None
    times = _times(scene.duration)
    entry = _computed(scene.system, scene.theta, scene.omega, times)
    return _key(scene.system, scene.theta, scene.omega, times), {"scene": scene.name, **entry}


def _computed(
    system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], times: list[float]
) -> dict[str, Any]:
    digits, error = quadruple.decimal_states(system, theta, omega, [0.0, *times])
    return {"times": times, "states": digits[1:], "error": [float(f"{e:.2e}") for e in error[1:]]}


def key(system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], duration: float) -> str:
    """The key of the motion's end points at the parts of ``duration`` [s]."""
    return _key(system, theta, omega, _times(duration))


def _times(duration: float) -> list[float]:
    return [duration * part for part in PARTS]


def _key(system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], times: Sequence[float]) -> str:
    density = system.density if isinstance(system, RodChain) else None
    masses = None if isinstance(system, RodChain) else system.masses
    numbers = [system.lengths, masses, density, system.gravity, theta, omega, times]
    text = json.dumps([system.kind, *(None if value is None else _exact(value) for value in numbers)])
    return hashlib.sha256(text.encode()).hexdigest()


def _exact(value: float | Sequence[float]) -> Any:
    """Doubles written so that no bit is lost and an integer is no other number than its double."""
    return float(value).hex() if isinstance(value, int | float) else [float(number).hex() for number in value]


@cache
def _kept() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for path in (PATH, BENCHMARKS_PATH):
        if path.exists():
            found |= json.loads(path.read_text(encoding="utf-8"))
    return found


def main() -> None:
    """Compute the end points of the catalogue's scenes anew."""
    from ...models import document_scenes

    print(f"{write(document_scenes(), PATH)} end points written to {PATH}")


if __name__ == "__main__":
    main()
