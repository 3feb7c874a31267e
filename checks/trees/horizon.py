"""The horizon: when two trajectories of a tree's chaotic motion had to part, and whether these did then.

As :mod:`furiko.checks.comparisons.horizon` has it, of small mechanisms of hinges and slides: the true motion is their
own equations' in quadruple precision, held against a kept proof where there is one, and the tangent flow has slopes by
differences in extended precision. A coordinate that slides counts in metres as an angle does in radians.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...models import TreeScene
from ...records.check import Result
from ...reference.integration.tree_variation import accelerations, slopes, tree_flow
from ...reference.integration.variation import growth
from ...reference.proved.kept_trees import proof
from ...reference.rounding.bounds import EPSILON
from ...reference.truth.quadruple_tree import LARGEST, quadruple_tree_motion
from ..motions.divergence import NAME, TrueMotion, held, local_order, predicted, result
from ..true_path import FOLDS, LONGEST, STEPS
from .cell import TreeCell

Array = NDArray[np.float64]


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each of the engine's integrators and each step."""
    if cell.mechanism.nv > LARGEST:
        reason = f"motions are followed in quadruple precision up to {LARGEST} degrees of freedom, not to "
        yield cell.result(NAME, "skipped", reason=f"{reason}{cell.mechanism.nv}")
        return
    duration = followed(cell.scene)
    kept = proof(cell.scene)

    def wide(q: Array, v: Array) -> Array:
        found = accelerations(cell.mechanism, np.atleast_2d(q), np.atleast_2d(v))
        return np.asarray(found.reshape(np.shape(q)))

    for integrator in cell.info.integrators:
        if integrator.remembers:
            reason = f"{integrator.name} remembers more than coordinates and rates, and adapters of trees give no paths"
            yield cell.result(f"{NAME} {integrator.name}", "skipped", reason=reason)
            continue
        motions = (true_motion(cell.scene, step, duration) for step in STEPS)
        found = [
            predicted(cell, integrator, truth, wide, held(truth, kept, most_off(cell, truth))) for truth in motions
        ]
        orders = [None, *(local_order(a, b) for a, b in pairwise(found))]
        for one, order in zip(found, orders, strict=True):
            yield result(cell, one, order)


def most_off(cell: TreeCell, truth: TrueMotion) -> Array:
    """How far the roundings of the mechanism's numbers may take the true motion from the exact one, at each step.

    In rad or m, and per second. Accelerations are off by as many roundings as an engine's may be, and errors grow.
    """
    fastest = np.abs(np.diff(truth.high[:, truth.high.shape[-1] // 2 :], axis=0)).max() / truth.step
    grown = truth.growth.times * np.exp(np.maximum(truth.growth.logarithm, 0.0))
    return np.asarray(EPSILON * float(cell.roundings.max()) * fastest * grown)


@lru_cache(maxsize=1)  # a worker looks at one scene with several integrators and engines
def followed(scene: TreeScene) -> float:
    """How long a scene's motion is followed [s]: a whole number of the longest steps."""
    longest = STEPS[0] * round(min(LONGEST, scene.duration) / STEPS[0])
    folding = true_motion(scene, STEPS[0], longest).growth.lyapunov_time
    return STEPS[0] * round(min(longest, FOLDS * folding) / STEPS[0])


@lru_cache(maxsize=len(STEPS))
def true_motion(scene: TreeScene, step: float, duration: float) -> TrueMotion:
    """The true motion in steps of ``step`` seconds, which is a multiple of the finest."""
    high, low = _integrated(scene)
    stride = round(step / STEPS[-1])
    whole = round(duration / step)
    half = slice(0, 2 * whole * stride + 1, stride)
    mechanism = scene.system.mechanism()
    q, v = np.split(high[half], 2, axis=-1)
    flow = tree_flow(mechanism, q, v, step)
    each = slice(0, 2 * whole * stride + 1, 2 * stride)
    return TrueMotion(step, high[each], low[each], flow, growth(flow, step, _rate(scene)))


@lru_cache(maxsize=1)
def _integrated(scene: TreeScene) -> tuple[Array, Array]:
    """The motion at every half of the finest step, as far as it may be followed."""
    assert scene.q is not None
    assert scene.v is not None
    points = 2 * round(min(LONGEST, scene.duration) / STEPS[-1])
    times = STEPS[-1] / 2 * np.arange(points + 1, dtype=np.float64)
    return quadruple_tree_motion(scene.system.mechanism(), scene.q, scene.v, times.tolist())


def _rate(scene: TreeScene) -> float:
    """A rate [1/s] in which differences of rates are measured: √(largest row of ∂a/∂q) where the motion starts."""
    assert scene.q is not None
    assert scene.v is not None
    by_q, _ = slopes(scene.system.mechanism(), np.array([scene.q]), np.array([scene.v]))
    return float(np.sqrt(np.abs(by_q).sum(-1).max())) or 1.0
