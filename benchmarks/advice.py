"""``furiko advise`` on random scenes: does the step advised keep the error asked for, and one four times larger not?

    python benchmarks/advice.py [--scenes 200] [--seed 1]

Random rod chains and N-leg pendulums of two to six links, with errors from 1e-3 to 1e-8. Each step that is advised for
an engine is run again, and one four times larger, and held at the end of the motion against heyoka's Taylor integrator
in quadruple precision, which the advice knows nothing of. Prints the counts; the exit status is 1 below what is asked.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from furiko.advise import advise
from furiko.engines import load_engine
from furiko.models import InvalidInput, Scene, find_scene
from furiko.reference.truth.quadruple import quadruple_trajectory
from furiko.studies.bench.methods import STEP

ENGINES = ["mujoco", "exudyn-tree"]
KEPT, MISSED = 0.99, 0.80  # asked: parts of the steps advised, and of those four times larger


def scenes(count: int, seed: int) -> Iterator[tuple[Path, float]]:
    """Files with random scenes, and the error to ask for."""
    folder = Path(tempfile.mkdtemp(prefix="furiko-advice-"))
    rng = np.random.default_rng(seed)
    for i in range(count):
        n = int(rng.integers(2, 7))
        rods = bool(rng.integers(2))
        lengths = rng.uniform(0.3, 1.5, n).round(3).tolist()
        masses = "" if rods else f"masses = {rng.uniform(0.3, 2, n).round(3).tolist()}\n"
        path = folder / f"random-{i}.toml"
        path.write_text(
            f'[system]\nkind = "{"rod-chain" if rods else "n-leg"}"\nlengths = {lengths}\n{masses}'
            f"[state]\ntheta = {rng.uniform(-1.5, 1.5, n).round(3).tolist()}\n"
            f"omega = {rng.normal(0, 1, n).round(3).tolist()}\nduration = {rng.uniform(0.5, 2):.3f}\n"
        )
        yield path, float(10.0 ** -rng.uniform(3, 8))


def off(scene: Scene, engine: str, scheme: str, step: float) -> float:
    """The largest error at the end of a run."""
    theta, omega = np.array(scene.theta), np.array(scene.omega)
    steps = round(scene.duration / step)
    if steps < 1:
        return float("inf")
    true = quadruple_trajectory(scene.system, theta, omega, [0.0, scene.duration])
    end = load_engine(engine, scene.system).trajectory(theta, omega, scheme, scene.duration / steps, steps)
    error = np.abs(np.array(end) - (true.theta[-1], true.omega[-1])).max()
    return float(error) if np.isfinite(error) else float("inf")


def main() -> int:
    """Measure, print, and compare with what is asked."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--budget", type=float, default=10.0)
    given = parser.parse_args()
    advised = kept = missed = refused = 0
    for path, asked in scenes(given.scenes, given.seed):
        try:
            found = advise(str(path), error=asked, engines=ENGINES, budget=given.budget)
        except InvalidInput as error:
            refused += 1
            print(f"{path.name}: {error}")
            continue
        scene = find_scene(str(path))
        for each in found.advised:
            if each.by != STEP:
                continue
            advised += 1
            right = off(scene, each.engine, each.scheme, each.setting) <= asked
            coarse = off(scene, each.engine, each.scheme, 4 * each.setting) > asked
            kept, missed = kept + right, missed + coarse
            if not right or not coarse:
                print(f"{path.name} {each.engine} {each.scheme} {each.setting:g}: kept {right}, 4 h missed {coarse}")
    print(
        f"{given.scenes} scenes, {refused} refused; {advised} steps advised: "
        f"{kept} keep the error, {missed} miss it at 4 h"
    )
    return int(kept < KEPT * advised or missed < MISSED * advised)


if __name__ == "__main__":
    sys.exit(main())
