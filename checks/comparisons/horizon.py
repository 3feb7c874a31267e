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
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator, engine_info, engine_names, load_engine
from ...models import Scene, document_catalogue, find_document_scene
from ...models.states import natural_rate, states
from ...models.systems import DocumentSystem
from ...records.check import Result
from ...reference import literal_accelerations
from ...reference.integration.variation import growth, tangent_flow
from ...reference.proved.kept import proof
from .. import true_path
from ..cell import Cell
from ..facts import scene_facts
from ..motions import divergence
from ..motions.divergence import (
    APART,
    Horizon,
    TrueMotion,
    divides,
    held,
    local_order,
    predicted,
    result,
)
from ..true_path import LONGEST, STEPS, followed, path

Array = NDArray[np.float64]

NAME = divergence.NAME


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of the engine's integrators and each step."""
    motion = cell.facts.path, cell.facts.path_low
    if len(motion[0]):
        truths = [in_steps(cell.scene.system, *motion, true_path.STEPS[-1] / 2, step) for step in STEPS]
    else:
        truths = [true_motion(cell.scene, step, followed(cell.scene)) for step in STEPS]
    for integrator in cell.info.integrators:
        found = [horizon(cell, integrator, truth) for truth in truths]
        orders = [None, *(local_order(a, b) for a, b in pairwise(found))]
        for one, order in zip(found, orders, strict=True):
            yield result(cell, one, order)


def horizon(cell: Cell, integrator: Integrator, truth: TrueMotion) -> Horizon:
    """Predict and measure the error of one integrator along the scene's true motion in steps."""
    scene, system = cell.scene, cell.scene.system
    kept = proof(system, scene.theta, scene.omega, scene.duration) if scene.theta and scene.omega else None
    return predicted(cell, integrator, truth, lambda *state: literal_accelerations(system, *state), held(truth, kept))


def true_motion(scene: Scene, step: float, duration: float) -> TrueMotion:
    """The true motion in steps; the quadruple precision behind it is shared among all steps that divide."""
    finest = STEPS[-1] if divides(STEPS[-1], step) else step
    steps = int(duration / step + 0.5) * round(step / finest)
    return in_steps(scene.system, *path(scene, finest / 2, 2 * steps + 1), finest / 2, step)


def in_steps(system: DocumentSystem, high: Array, low: Array, spacing: float, step: float) -> TrueMotion:
    """A motion, (P, 2n), known at times ``spacing`` seconds apart, in steps of a multiple of twice that."""
    stride = round(step / spacing)
    last, n = (len(high) - 1) // stride * stride, system.n
    half = high[: last + 1 : stride // 2]
    flow = tangent_flow(system, half[:, :n], half[:, n:], step)
    return TrueMotion(
        step, high[: last + 1 : stride], low[: last + 1 : stride], flow, growth(flow, step, natural_rate(system))
    )


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
    truths = [true_motion(scene, step, duration) for step in steps]
    for integrator in cell.info.integrators:
        for step, truth in zip(steps, truths, strict=True):
            found = horizon(cell, integrator, truth)
            predicted, measured = (
                f"{time:8.3f} s" if math.isfinite(time) else "   later  " for time in found.crossing(APART)
            )
            yield (
                f"{scene.name:21} {engine:17} {integrator.name:17} {step:8g} s       {predicted}  {measured} "
                f"{found.lyapunov_time:7.3f} s"
            )


if __name__ == "__main__":
    main()
