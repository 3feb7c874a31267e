"""Trajectories: each of an engine's own integrators at four steps, against a motion of proved accelerations.

As :mod:`furiko.checks.comparisons.trajectories` has it, in moves (:mod:`furiko.reference.integration.tree_places`): a
run starts beside the scene's place by a move, and ends beside the true one by another, of rotations by a rotation
vector. What rounding does in a step is not bounded here but measured: ten times what the engine's accelerations are off
by in states that the motion passes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...models import TreeScene
from ...records.check import Result
from ...reference.integration.richardson import amplified
from ...reference.integration.tree_places import difference, moved, plain, quaternions
from ...reference.proved.kept_trees import proof, sure
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.stepped import QUATERNION
from ...reference.truth.spatial import spatial_truth
from ..motions.ladder import EndPoint, Rounding, growth, settled
from .cell import TreeCell

Array = NDArray[np.float64]

NAME = "trajectory"


@dataclass(frozen=True)
class Beside:
    """A cell whose runs are looked at in moves: from its start's place, and from the true one at their end.

    ``places``: the true places (nq,) by times [s] at which runs may end.
    """

    cell: TreeCell
    places: dict[float, Array]

    @property
    def scene(self) -> TreeScene:
        """What moves."""
        return self.cell.scene

    @property
    def few_steps(self) -> int:
        """Of the finest run of ten links that is worth a longer time."""
        return self.cell.few_steps

    @property
    def start(self) -> tuple[Array, Array]:
        """No move, and the rates, (nv,) each."""
        first = self.cell.start
        assert first is not None
        return np.zeros_like(first[1]), first[1]

    def trajectory(self, by: Array, v: Array, integrator: Integrator, step: float, steps: int) -> Array:
        """The move from the true place, and the rates, at the end of a run from a place that is moved, (2, nv)."""
        first = self.cell.start
        assert first is not None
        q, rates = self.cell.run(moved(self.cell.mechanism, first[0], by), v, integrator, step, steps)
        time = min(self.places, key=lambda one: abs(one - step * steps))
        return np.stack([difference(self.cell.mechanism, self.places[time], q), rates])


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each of the engine's integrators."""
    facts = cell.facts
    first = cell.start
    assert first is not None
    off, proved = sure(facts.end_q, facts.end_error, proof(cell.scene))
    times, no_move = facts.times.tolist(), np.zeros(cell.mechanism.nv)
    points = tuple(EndPoint(t, no_move, *one) for t, *one in zip(times, off.tolist(), proved, strict=True))
    beside = Beside(cell, dict(zip(times, facts.end_q, strict=True)))
    q, v = np.array([first[0], *facts.end_q]), np.array([first[1], *facts.end_v])
    true = np.array([spatial_truth(cell.mechanism, *state).accelerations.float for state in zip(q, v, strict=True)])
    got = cell.answer("accelerations", cell.engine.accelerations(q, v), v.shape)
    wrong = 10 * float(np.abs(got - true).max()) + EPSILON * float(np.abs(true).max())
    places = 2.0 * QUATERNION if quaternions(cell.mechanism) else 0.0
    largest = max(places, float(np.abs(q[:, plain(cell.mechanism)[0]]).max(initial=0.0)))
    for integrator in cell.integrators:
        yield _compare(beside, integrator, points, _rounding(integrator, largest, v, true, wrong))


def _rounding(integrator: Integrator, places: float, v: Array, a: Array, off: float) -> Rounding:
    """Additions of a step are off by ε of ``places`` and rates; sums of stages by ε of what changes in a second.

    ``off``: error of the accelerations; an implicit scheme's iterations add its tolerance of them.
    """
    rates, changes = (float(np.abs(values).max()) for values in (v, a))
    stages = 2 * integrator.order
    return Rounding(
        angle=EPSILON * places,
        rate=EPSILON * rates,
        turning=stages * EPSILON * rates,
        speeding=off + (stages * EPSILON + integrator.tolerance) * changes,
    )


def _compare(cell: Beside, integrator: Integrator, points: tuple[EndPoint, ...], rounded: Rounding) -> Result:
    name, p = f"{NAME} {integrator.name}", integrator.order
    point, ladder = settled(cell, integrator, points, rounded)
    limit, uncertainty = ladder.limit(p)
    noise = rounded.after(8 * ladder.steps, point.time, growth(cell, integrator, ladder))
    bound = uncertainty + amplified(p) * noise + point.error
    missed = float(np.abs(limit).max())
    coarser, order = ladder.orders()
    fits = order > p - 0.5 or not ladder.judges(p, noise)
    agrees = math.isfinite(bound) and missed <= bound and fits
    reason = f"order {order:.2f}; extrapolated to step zero the true motion is met"
    if not fits:
        reason = f"{integrator.name} is of order {p} and shows order {order:.2f}"
    elif not agrees:
        reason = f"{integrator.name} converges {missed:.3g} rad or m beside the true motion, sure to {bound:.3g}"
    return cell.cell.result(
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
