"""The horizon: when two trajectories of a chaotic motion had to part, and whether these did then and no earlier.

From the true state at each of its times t_k an engine takes one step; what it misses the true state at t_{k+1} by is
its local error d_k. Errors that are small travel with the motion's own tangent flow Φ_k, so that those of the engine's
whole run are predicted by

    e_{k+1} = Φ_k e_k + d_k,

with Φ from the reference's variational equations and the truth in quadruple precision. Beside it stands the error that
the engine's run really has. Where the two cross 0.001 rad at one time, the trajectories had to part then: by what the
scheme neglects in a step, and by how the motion makes differences grow.

The local errors are the engine's own, and so a different model shows in them as well as a scheme: but in proportion to
the step, while a scheme of order p neglects step^(p+1). With several steps the one is told from the other.

A scheme that remembers more than angles and rates (accelerations of its own, hinges that have come apart) is let run
for some steps first, from a true state, until it has forgotten that start: see :func:`memory`. In so many steps from
the start of the whole run nothing is predicted, since both are one run.

    python -m furiko.checks.comparisons.horizon [SCENE|FILE.toml ...] [--engine NAME] [--step SECONDS] [--duration
    SECONDS]
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator, engine_info, engine_names, load_engine
from ...models import InvalidInput, Scene, document_catalogue, find_document_scene
from ...models.states import natural_rate, states
from ...models.systems import DocumentSystem
from ...records.check import Result
from ...reference import literal_accelerations
from ...reference.integration.variation import growth, lyapunov_time, tangent_flow
from ...reference.proved.kept import proof
from ...reference.truth.quadruple import quadruple_trajectory
from ..cell import Cell
from ..facts import scene_facts
from ..motions import divergence
from ..motions.divergence import (
    APART,
    FOLDS,
    LONGEST,
    STEPS,
    Horizon,
    TrueMotion,
    divides,
    held,
    local_order,
    predicted,
    result,
)

Array = NDArray[np.float64]

NAME = divergence.NAME


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of the engine's integrators and each step."""
    for integrator in cell.info.integrators:
        found = [horizon(cell, integrator, step, followed(cell.scene)) for step in STEPS]
        orders = [None, *(local_order(a, b) for a, b in pairwise(found))]
        for one, order in zip(found, orders, strict=True):
            yield result(cell, one, order)


@lru_cache(maxsize=1)  # a worker looks at one scene with several integrators and engines
def followed(scene: Scene) -> float:
    """How long a scene's motion is followed [s]: a whole number of the longest steps."""
    assert scene.theta is not None
    assert scene.omega is not None
    folding = lyapunov_time(scene.system, np.array(scene.theta), np.array(scene.omega), scene.duration)
    return STEPS[0] * round(min(LONGEST, FOLDS * folding) / STEPS[0])


def horizon(cell: Cell, integrator: Integrator, step: float, duration: float) -> Horizon:
    """Predict and measure the error of one integrator at one step."""
    scene = cell.scene
    if scene.theta is None or scene.omega is None:
        raise InvalidInput(f"scene {scene.name!r} has no state for a trajectory to start from")
    system = scene.system
    truth = true_motion(system, scene.theta, scene.omega, step, duration)
    proved = held(truth, proof(system, scene.theta, scene.omega, scene.duration))
    return predicted(cell, integrator, truth, lambda *state: literal_accelerations(system, *state), proved)


def true_motion(
    system: DocumentSystem, theta: tuple[float, ...], omega: tuple[float, ...], step: float, duration: float
) -> TrueMotion:
    """The true motion in steps; the quadruple precision behind it is shared among all steps that divide."""
    finest = STEPS[-1] if divides(STEPS[-1], step) else step
    stride = round(step / finest)
    steps = int(duration / step + 0.5)
    high, low = _integrated(system, theta, omega, finest / 2, 2 * steps * stride)
    half = slice(0, 2 * steps * stride + 1, stride)
    n = system.n
    flow = tangent_flow(system, high[half, :n], high[half, n:], step)
    whole = slice(0, 2 * steps * stride + 1, 2 * stride)
    return TrueMotion(step, high[whole], low[whole], flow, growth(flow, step, natural_rate(system)))


@lru_cache(maxsize=4)
def _integrated(
    system: DocumentSystem, theta: tuple[float, ...], omega: tuple[float, ...], spacing: float, points: int
) -> tuple[Array, Array]:
    found = quadruple_trajectory(system, theta, omega, spacing * np.arange(points + 1, dtype=np.float64))
    return np.hstack([found.theta, found.omega]), np.hstack([found.theta_low, found.omega_low])


def main(arguments: Sequence[str] | None = None) -> None:
    """Print predicted and measured divergence times of scenes, engines, integrators and steps."""
    parser = argparse.ArgumentParser(
        prog="python -m furiko.checks.comparisons.horizon", description="When trajectories part."
    )
    parser.add_argument("scene", nargs="*", help="of the catalogue, or a TOML file; those tagged chaotic if left out")
    parser.add_argument("--engine", action="append", help="may be given several times; all that integrate if left out")
    parser.add_argument("--step", action="append", type=float, help=f"[s]; {', '.join(map(str, STEPS))} if left out")
    parser.add_argument("--duration", type=float, default=LONGEST, help=f"[s]; {LONGEST:g} if left out")
    given = parser.parse_args(arguments)
    scenes = [find_document_scene(name, "this") for name in given.scene or document_catalogue()]
    chosen = [scene for scene in scenes if given.scene or "chaotic" in scene.tags]
    print("scene                 engine            integrator            step   parts: predicted  measured   Lyapunov")
    for scene in chosen:
        for engine in given.engine or [name for name in engine_names() if engine_info(name).integrators]:
            for line in _table(scene, engine, given.step or STEPS, given.duration):
                print(line, flush=True)


def _table(scene: Scene, engine: str, steps: Sequence[float], duration: float) -> Iterator[str]:
    looked_at = states(scene, random=1)
    cell = Cell(scene, engine_info(engine), load_engine(engine, scene.system), looked_at, scene_facts(scene, looked_at))
    for integrator in cell.info.integrators:
        for step in steps:
            found = horizon(cell, integrator, step, duration)
            predicted, measured = (
                f"{time:8.3f} s" if math.isfinite(time) else "   later  " for time in found.crossing(APART)
            )
            yield (
                f"{scene.name:21} {engine:17} {integrator.name:17} {step:8g} s       {predicted}  {measured} "
                f"{found.lyapunov_time:7.3f} s"
            )


if __name__ == "__main__":
    main()
