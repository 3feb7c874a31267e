"""How often sound engines are called different, on mechanisms in numbers that nobody would choose. It should be never.

    python tests/checks/score_sound.py [--scenes 60] [--spread mild|wide|absurd] [--seed 1] [--profile full] [--still]

Random scenes are written to a folder and `furiko check` is run on them; its exit status is passed on. Every random
number follows from the seed, the spread and a scene's index, so that a run, and a scene of it, can be repeated.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Spread:
    """Ranges of powers of ten: lengths [m], masses [kg], rates [rad/s], angles [rad], gravity [m/s²], and of ratios."""

    lengths: tuple[float, float]
    masses: tuple[float, float]
    rates: tuple[float, float]
    angles: tuple[float, float]
    gravity: tuple[float, float]
    unlike: float


SPREADS = {
    "mild": Spread((-2, 2), (-3, 3), (-4, 2), (-4, 1.5), (-3, 2), unlike=1.5),
    "wide": Spread((-6, 6), (-9, 9), (-12, 3), (-12, 3), (-9, 5), unlike=3),
    "absurd": Spread((-40, 40), (-40, 40), (-300, 6), (-300, 10), (-50, 30), unlike=3),
}
LINKS = (1, 2, 2, 3, 3, 4, 5, 6, 8, 12)


def scene_text(spread: str, seed: int, index: int, still: bool = False) -> str:
    """A scene file; ``still``: without a motion, whose truth takes longer than everything else."""
    ranges = SPREADS[spread]
    random = np.random.default_rng([seed, index, list(SPREADS).index(spread)])

    def power(low: float, high: float) -> float:
        return float(10 ** random.uniform(low, high))

    def alike_but_for(size: float, n: int) -> list[float]:
        unlike = random.uniform(0, ranges.unlike)
        return [size * power(-unlike, 0) for _ in range(n)]

    legs = bool(random.integers(2))
    n = max(int(random.choice(LINKS)), 2 if legs else 1)
    lengths = alike_but_for(power(*ranges.lengths), n)
    gravity = [0.0, 9.81, 9.81, power(*ranges.gravity)][random.integers(4)]
    omega = power(*ranges.rates) * random.normal(size=n) * (random.random(n) < 0.8) * (random.random() < 0.85)
    theta = power(*ranges.angles) * random.normal(size=n) * (random.random(n) < 0.9)
    if random.random() < 0.3:
        theta = random.uniform(-np.pi, np.pi, n)
    rate = max(float(np.sqrt(gravity / min(lengths))), float(np.abs(omega).max()), 0.5)
    mass = power(*ranges.masses)
    lines = [
        "[system]",
        f'kind = "{"n-leg" if legs else "rod-chain"}"',
        f"lengths = {lengths}",
        f"gravity = {gravity}",
        f"masses = {alike_but_for(mass, n)}" if legs else f"density = {mass}",
        "[state]",
        f"theta = {theta.tolist()}",
        f"omega = {omega.tolist()}",
        *([] if still else [f"duration = {random.uniform(0.3, 3) / rate}"]),
    ]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--spread", choices=SPREADS, default="wide")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--profile", default="full")
    parser.add_argument("--still", action="store_true", help="leave out the motions: many more scenes in the same time")
    parser.add_argument("--out", type=Path, help="keep scenes and report in this folder")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = chosen.out or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        files = [folder / f"{chosen.spread}-{chosen.seed}-{index}.toml" for index in range(chosen.scenes)]
        for index, file in enumerate(files):
            file.write_text(scene_text(chosen.spread, chosen.seed, index, chosen.still), encoding="utf-8")
        command = [
            "check",
            *map(str, files),
            "--profile",
            chosen.profile,
            "--no-cache",
            "--out",
            str(folder / "report"),
        ]
        return subprocess.run([sys.executable, "-m", "furiko", *command], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
