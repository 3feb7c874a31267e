"""Trajectories: each of an engine's own integrators at four steps, against a motion of proved accelerations.

As :mod:`furiko.checks.comparisons.trajectories` has it, of mechanisms of hinges and slides, whose coordinates are their
own rates' integrals. What rounding does in a step is not bounded here but measured: ten times what the engine's
accelerations are off by in states that the motion passes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...records.check import Result
from ...reference.integration.richardson import amplified
from ...reference.proved.kept_trees import proof, sure
from ...reference.rounding.bounds import EPSILON
from ...reference.truth.spatial import spatial_truth
from ..comparisons.trajectories import EndPoint, Rounding, growth, settled
from .cell import TreeCell

Array = NDArray[np.float64]

NAME = "trajectory"


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each of the engine's integrators."""
    facts = cell.facts
    first = cell.start
    assert first is not None
    off, proved = sure(facts.end_q, facts.end_error, proof(cell.scene))
    points = tuple(map(EndPoint, facts.times.tolist(), facts.end_q, off.tolist(), proved))
    q, v = np.array([first[0], *facts.end_q]), np.array([first[1], *facts.end_v])
    true = np.array([spatial_truth(cell.mechanism, *state).accelerations.float for state in zip(q, v, strict=True)])
    got = cell.answer("accelerations", cell.engine.accelerations(q, v), v.shape)
    wrong = 10 * float(np.abs(got - true).max()) + EPSILON * float(np.abs(true).max())
    for integrator in cell.info.integrators:
        yield _compare(cell, integrator, points, _rounding(integrator, q, v, true, wrong))


def _rounding(integrator: Integrator, q: Array, v: Array, a: Array, off: float) -> Rounding:
    """Additions of a step are off by ε of coordinates and rates; sums of stages by ε of what changes in a second.

    ``off``: error of the accelerations; an implicit scheme's iterations add its tolerance of them.
    """
    largest = [float(np.abs(values).max()) for values in (q, v, a)]
    stages = 2 * integrator.order
    return Rounding(
        angle=EPSILON * largest[0],
        rate=EPSILON * largest[1],
        turning=stages * EPSILON * largest[1],
        speeding=off + (stages * EPSILON + integrator.tolerance) * largest[2],
    )


def _compare(cell: TreeCell, integrator: Integrator, points: tuple[EndPoint, ...], rounded: Rounding) -> Result:
    name, p = f"{NAME} {integrator.name}", integrator.order
    point, ladder = settled(cell, integrator, points, rounded)
    limit, uncertainty = ladder.limit(p)
    noise = rounded.after(8 * ladder.steps, point.time, growth(cell, integrator, ladder))
    bound = uncertainty + amplified(p) * noise + point.error
    missed = float(np.abs(limit - point.theta).max())
    coarser, order = ladder.orders()
    fits = order > p - 0.5 or not ladder.judges(p, noise)
    agrees = math.isfinite(bound) and missed <= bound and fits
    reason = f"order {order:.2f}; extrapolated to step zero the true motion is met"
    if not fits:
        reason = f"{integrator.name} is of order {p} and shows order {order:.2f}"
    elif not agrees:
        reason = f"{integrator.name} converges {missed:.3g} rad or m beside the true motion, sure to {bound:.3g}"
    return cell.result(
        name,
        "agrees" if agrees else "differs",
        measured=missed,
        allowed=bound,
        unit="rad or m",
        reason=reason,
        details={
            "integrator": integrator.name,
            "nominal order": p,
            "measured order": None if math.isnan(order) else order,
            "measured order, coarser runs": None if math.isnan(coarser) else coarser,
            "time": point.time,
            "truth": "proved" if point.proved else "estimated",
            "steps": [ladder.step / 2**k for k in range(4)],
            "rounding": noise,
        },
    )
