"""Proved end points of the catalogue's motions, kept in ``reference/data/``: seconds to minutes of computing each.

The keys are those of :mod:`furiko.reference.truth.end_points`; an entry holds each angle and rate as a decimal ball,
``[midpoint +/- radius]``, which contains the binary one that was proved. ``python -m furiko.reference.proved.kept
[SCENE …]`` computes them again, or only those named.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ...models import AnyScene, DocumentSystem, Scene
from ...models.writers.whole_file import write_whole
from ..truth.end_points import PARTS, key
from ..truth.quadruple import QuadrupleTrajectory
from .enclose import Balls, Enclosed, Floats, above, enclose

PATH = Path(__file__).parent.parent / "data" / "proved_endpoints.json"
BENCHMARKS_PATH = PATH.with_name("proved_benchmarks.json")  # of the motions that are timed, in the same form
DIGITS = 30  # as many as the end points in quadruple precision promise
KEPT_DIGITS = 40  # of a midpoint's decimals
READ_BITS = 192  # of the balls that are read: more than KEPT_DIGITS hold


@dataclass(frozen=True)
class Proof:
    """Proved end points: ``times`` [s], balls ``theta`` [rad] and ``omega`` [rad/s], (times, n), as far as proved.

    ``radius``: the largest at each time; ``bits``, ``steps``, ``seconds``: of the run that proved them.
    """

    scene: str
    times: tuple[float, ...]
    theta: Balls
    omega: Balls
    radius: tuple[float, ...]
    bits: int
    steps: int
    seconds: float


def proof(system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], duration: float) -> Proof | None:
    """The proved states at 1/8, 1/4, 1/2 and all of ``duration`` [s]; None where none are kept."""
    entry = _kept().get(key(system, theta, omega, duration))
    if entry is None:
        return None
    import flint

    with flint.ctx.workprec(READ_BITS):
        balls = np.array([[flint.arb(text) for text in row] for row in entry["states"]], dtype=object)
    n = system.n
    numbers = (entry[name] for name in ("bits", "steps", "seconds"))
    return Proof(entry["scene"], tuple(entry["times"]), balls[:, :n], balls[:, n:], tuple(entry["radius"]), *numbers)


def sure(truth: QuadrupleTrajectory, proof: Proof | None) -> tuple[Floats, tuple[bool, ...]]:
    """How far off the angles and rates of ``truth`` are at each of its times, shape (times,), and whether it is proved.

    Where there is a proof it is a bound: the largest distance of the states from the far ends of the intervals.
    Elsewhere it is the estimate that ``truth`` has.
    """
    off = truth.error.copy()
    count = 0 if proof is None else len(proof.times)
    if proof is not None:
        for i in range(count):
            high, low = (np.concatenate(pair) for pair in _parts(truth, i))
            off[i] = distance(proof, i, high, low)
    return off, tuple(i < count for i in range(len(off)))


def distance(proof: Proof, i: int, high: Floats, low: Floats) -> float:
    """How far the state ``high + low`` (2n,), angles and then rates, is at most from the motion at the time ``i``."""
    import flint

    balls = (*proof.theta[i], *proof.omega[i])
    with flint.ctx.workprec(READ_BITS):
        return max(above(abs(b - h - l).upper()) for b, h, l in zip(balls, high.tolist(), low.tolist(), strict=True))


def _parts(truth: QuadrupleTrajectory, i: int) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
    return (truth.theta[i], truth.omega[i]), (truth.theta_low[i], truth.omega_low[i])


def proved(scene: Scene, digits: int = DIGITS, seconds: float | None = None) -> Enclosed:
    """The scene's motion at its start and at the times that are kept, proved anew."""
    assert scene.theta is not None
    assert scene.omega is not None
    times = [0.0, *(scene.duration * part for part in PARTS)]
    return enclose(scene.system, scene.theta, scene.omega, times, digits, seconds=seconds)


def entry(scene: AnyScene, found: Enclosed) -> dict[str, Any]:
    """What is kept of a proved motion, without its start."""
    import flint

    with flint.ctx.workprec(found.bits + 64):
        states = [
            [ball.str(KEPT_DIGITS, more=True) for ball in (*theta, *omega)]
            for theta, omega in zip(found.theta[1:], found.omega[1:], strict=True)
        ]
    return {
        "scene": scene.name,
        "times": found.times[1:].tolist(),
        "states": states,
        "radius": radii(states),
        "bits": found.bits,
        "steps": found.steps,
        "seconds": round(found.seconds, 1),
    }


def radii(states: Sequence[Sequence[str]]) -> list[float]:
    """The largest radius of each row of decimal balls, two digits of it, rounded up."""
    import flint

    with flint.ctx.workprec(READ_BITS):
        found = [max(above(flint.arb(text).rad()) for text in row) for row in states]
    return [float(f"{1.05 * radius:.1e}") for radius in found]


@cache
def _kept() -> dict[str, dict[str, Any]]:
    return _read(PATH) | _read(BENCHMARKS_PATH)


def _read(path: Path) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return found


def table() -> str:
    """What is kept, as a table in Markdown: in the order of the catalogue."""
    from ...models import document_scenes

    lines = ["| scene | proved until [s] | radius there | bits | steps | seconds |", "|---|---|---|---|---|---|"]
    for scene in document_scenes():
        if scene.theta is None or scene.omega is None or not scene.duration:
            continue
        found = proof(scene.system, scene.theta, scene.omega, scene.duration)
        if found is None or not found.times:
            lines.append(f"| {scene.name} | not yet of {scene.duration:g} | | | | |")
            continue
        until, radius = found.times[-1], f"{found.radius[-1]:.0e}"
        part = "" if until == scene.duration else f" of {scene.duration:g}"
        lines.append(
            f"| {scene.name} | {until:g}{part} | {radius} | {found.bits} | {found.steps} | {found.seconds:.0f} |"
        )
    return "\n".join(lines)


def write(scene: Scene, path: Path = PATH) -> None:
    """Prove the end points of a scene anew, keep them, and say how far that went."""
    assert scene.theta is not None
    assert scene.omega is not None
    found = proved(scene)
    kept = _read(path) | {key(scene.system, scene.theta, scene.omega, scene.duration): entry(scene, found)}
    write_whole(path, json.dumps(kept, indent=1, sort_keys=True, ensure_ascii=False) + "\n")
    print(
        f"{scene.name}: {'proved' if found.complete else f'proved until {found.proved_until:g} s, {found.why}'}, "
        f"radius {found.radius[-1]:.1e}, {found.bits} bits, {found.steps} steps, {found.seconds:.1f} s",
        flush=True,
    )


def main(names: Sequence[str]) -> None:
    """Prove the end points of these scenes, or of all that have a duration, and write them."""
    from ...models import document_scenes

    for scene in document_scenes():
        if (
            scene.theta is not None
            and scene.omega is not None
            and scene.duration
            and (not names or scene.name in names)
        ):
            write(scene)


if __name__ == "__main__":
    main(sys.argv[1:])
