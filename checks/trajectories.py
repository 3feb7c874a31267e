"""Trajectories: each of an engine's own integrators at four steps, against a truth in quadruple precision.

Two trajectories are never held against each other point by point: what an integrator of order p leaves after a fixed
time is C h^p + O(h^(p+1)). Four runs, at h, h/2, h/4 and h/8, give three things:

* the order that their differences show, which needs no truth: log₂ |y(h) - y(h/2)| / |y(h/2) - y(h/4)|, and the same
  of the finer three. The finer decides; that the coarser is near it shows that the expansion holds;
* where they converge to, by Richardson's extrapolation, and how sure that is: of three extrapolated values the last is
  at least three times nearer to the limit than the last two are to each other, whatever p ≥ 1 is;
* whether the truth lies there. If it does, the engine integrates the same mechanism.

In a chaotic motion errors grow until the expansion in h means nothing. The comparison therefore ends at the last of
the truth's times at which the coarse run is still near the fine one.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..engines import Integrator
from ..models.result import Result
from ..reference.endpoints import PARTS, lookup
from .cell import Cell, EngineFault
from .rounding import EPSILON

Array = NDArray[np.float64]

NAME = "trajectory"
NEEDS = "trajectory"

NEAR = (
    1e-2  # [rad] the runs at h/2 and h/4 part less than this: within it, an error's growth is linear to about a percent
)
FIRST_STEPS = 8  # of the coarsest run; doubled until the expansion in h holds
ORDER_SETTLED = 0.2  # the measured order is no further below the nominal one once the expansion's first term rules
BUDGET = 0.3  # [s] for one integrator, after which no finer step is begun


@dataclass(frozen=True)
class EndPoint:
    """The true angles [rad] at a time [s], (n,), and how sure they are [rad]."""

    time: float
    theta: Array
    error: float


@dataclass(frozen=True)
class Ladder:
    """Ends of four runs from the same state over the same time, at ``step``, half, a quarter and an eighth of it."""

    step: float
    steps: int
    ends: tuple[Array, ...]  # θ, ω at the end, shape (2, n)

    def orders(self) -> tuple[float, float]:
        """What the coarser and the finer three runs' differences show: nan where they are nothing but rounding."""
        gaps = self.gaps()
        return _order(gaps[0], gaps[1]), _order(gaps[1], gaps[2])

    def gaps(self) -> tuple[float, float, float]:
        """Largest difference in angle of each two neighbouring runs [rad], coarsest first."""
        first, second, third = (_apart(a[0], b[0]) for a, b in pairwise(self.ends))
        return first, second, third

    def settled(self, order: int) -> bool:
        """Whether the expansion in h holds: near enough, and of the expected order or, its first term small, above."""
        return self.gaps()[1] < NEAR and self.orders()[1] > order - ORDER_SETTLED

    def limit(self, order: int) -> tuple[Array, float]:
        """Angles at step zero, and how far off they may be [rad]."""
        extrapolated = [b[0] + (b[0] - a[0]) / (2**order - 1) for a, b in pairwise(self.ends[1:])]
        return extrapolated[1], float(np.abs(extrapolated[1] - extrapolated[0]).max())


def _order(coarse: float, fine: float) -> float:
    return math.log2(coarse / fine) if fine > 0 and coarse < math.inf else math.nan


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of the engine's integrators."""
    scene = cell.scene
    if scene.theta is None or scene.omega is None:
        return
    truth = lookup(scene.system, scene.theta, scene.omega, scene.duration)
    error = truth.error + EPSILON * np.abs(truth.theta).max(-1)
    points = tuple(map(EndPoint, [scene.duration * part for part in PARTS], truth.theta, error.tolist()))
    for integrator in cell.info.integrators:
        yield _compare(cell, integrator, points)


def _compare(cell: Cell, integrator: Integrator, points: tuple[EndPoint, ...]) -> Result:
    name = f"{NAME} {integrator.name}"
    point, ladder = settled(cell, integrator, points)
    limit, uncertainty = ladder.limit(integrator.order)
    growth = rounding_growth(cell, integrator, ladder)
    noise = EPSILON * math.sqrt(8 * ladder.steps) * growth * max(1.0, float(np.abs(point.theta).max()))
    bound = uncertainty + noise + point.error
    missed = float(np.abs(limit - point.theta).max())
    coarser, order = ladder.orders()
    fits = order > integrator.order - 0.5 or ladder.gaps()[1] <= 64 * noise
    agrees = missed <= bound and fits
    return cell.result(
        name,
        "agrees" if agrees else "differs",
        measured=missed,
        allowed=bound,
        unit="rad",
        reason=_reason(integrator, order, missed, bound, fits),
        details={
            "integrator": integrator.name,
            "nominal order": integrator.order,
            "measured order": None if math.isnan(order) else order,
            "measured order, coarser runs": None if math.isnan(coarser) else coarser,
            "time": point.time,
            "steps": [ladder.step / 2**k for k in range(4)],
            "errors": [_finite(float(np.abs(end[0] - point.theta).max())) for end in ladder.ends],
            "extrapolated error": missed,
            "growth of rounding": growth,
        },
    )


def settled(cell: Cell, integrator: Integrator, points: tuple[EndPoint, ...]) -> tuple[EndPoint, Ladder]:
    """The longest time within the horizon, and steps small enough that the measured order has settled.

    Longer and longer times, each from the steps that the one before needed. Where the first never settles, because the
    engine's share of time is spent or rounding is reached, it stands and is judged as it is.
    """
    deadline = time.perf_counter() + BUDGET
    best: tuple[EndPoint, Ladder] | None = None
    steps = FIRST_STEPS
    for point in points:
        ladder = refine(cell, integrator, point, steps, deadline)
        if best is not None and not ladder.settled(integrator.order):
            break
        best = point, ladder
        steps = 2 * ladder.steps  # the next time is twice as long
    assert best is not None
    if not math.isfinite(best[1].gaps()[2]):
        raise EngineFault(f"{integrator.name}: no run came to its end, with up to {8 * best[1].steps} steps")
    return best


def refine(cell: Cell, integrator: Integrator, point: EndPoint, steps: int, deadline: float) -> Ladder:
    """Halve the steps until the measured order is near the nominal one, or rounding or the deadline is near."""
    ends = [run(cell, integrator, point.time, steps << k) for k in range(4)]
    while True:
        ladder = Ladder(point.time / steps, steps, tuple(ends))
        rounding = 2e3 * EPSILON * steps
        if ladder.settled(integrator.order) or ladder.gaps()[1] < rounding or time.perf_counter() > deadline:
            return ladder
        steps *= 2
        ends = [*ends[1:], run(cell, integrator, point.time, steps << 3)]


def run(cell: Cell, integrator: Integrator, duration: float, steps: int, shift: float = 0.0) -> Array:
    """The end of one run from the scene's state, its angles moved by ``shift``; infinite where it blows up."""
    assert cell.scene.theta is not None
    assert cell.scene.omega is not None
    theta, omega = np.array(cell.scene.theta) + shift, np.array(cell.scene.omega)
    try:
        with np.errstate(all="ignore"):
            return cell.trajectory(theta, omega, integrator, duration / steps, steps)
    except EngineFault:
        return np.full((2, theta.size), np.inf)  # too coarse a step: a large error, not yet a fault


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _apart(a: Array, b: Array) -> float:
    """Largest difference [rad]; infinite where a run blew up."""
    return float(np.abs(a - b).max()) if np.isfinite(a).all() and np.isfinite(b).all() else math.inf


def rounding_growth(cell: Cell, integrator: Integrator, ladder: Ladder) -> float:
    """How much larger a small difference at the start has become at the end: the engine's own two runs tell."""
    shift = 2.0**-24  # half of double precision's digits: the difference and its own rounding part evenly
    moved = run(cell, integrator, ladder.step * ladder.steps, 2 * ladder.steps, shift)
    return max(1.0, float(np.abs(moved - ladder.ends[1]).max()) / shift)


def _reason(integrator: Integrator, order: float, missed: float, bound: float, fits: bool) -> str:
    if not fits:
        return f"{integrator.name} is of order {integrator.order} and shows order {order:.2f}"
    if missed > bound:
        return (
            f"{integrator.name} converges, but {missed:.3g} rad beside the true motion; its extrapolation to step zero "
            f"is sure to {bound:.3g} rad"
        )
    return f"order {order:.2f}; extrapolated to step zero the true motion is met"
