"""Runs of one integrator at four steps, over the longest time at which their expansion in the step holds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...models import AnyScene
from ...reference.integration.richardson import at_step_zero, follows
from ..cell import EngineFault

Array = NDArray[np.float64]

NEAR = 1e-2  # [rad] the runs at h/2 and h/4 part less than this: an error's growth is then linear to about a percent
FIRST_STEPS = 8  # of the coarsest run; doubled until the expansion in h holds
MOST_STEPS = 1 << 17  # of the finest run; what has not converged by then does not
FIRST_ORDER = 16  # times as many steps are few for a scheme of first order
SHIFT = 2.0**-24  # half of double precision's digits: the difference and its own rounding part evenly
# The measured order is off by a part that is in proportion to h: once the expansion's first term rules, the finer one
# is no further below the nominal one than this, and the coarser one no further than twice this.
ORDER_SETTLED = 0.2


class Moving(Protocol):
    """A cell whose engine makes runs from the scene's state: of a document's mechanism, or of a tree."""

    @property
    def scene(self) -> AnyScene:
        """What moves."""
        ...

    @property
    def few_steps(self) -> int:
        """Of the finest run of ten links that is worth a longer time."""
        ...

    @property
    def start(self) -> tuple[Array, Array] | None:
        """Coordinates and rates, (n,) each."""
        ...

    def trajectory(self, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int, /) -> Array:
        """The same at the end, (2, n)."""
        ...


@dataclass(frozen=True)
class EndPoint:
    """The true angles [rad] at a time [s], (n,), how sure they are [rad], and whether that is proved."""

    time: float
    theta: Array
    error: float
    proved: bool = False


@dataclass(frozen=True)
class Rounding:
    """By how much rounding moves angles and rates: in every step by ``angle`` [rad] and ``rate`` [rad/s], and in every
    second, whatever the step, by ``turning`` [rad/s] and ``speeding`` [rad/s²].
    """

    angle: float
    rate: float
    turning: float
    speeding: float

    def after(self, steps: int, time: float, growth: tuple[float, float]) -> float:
        """How much of it there can be in the angles at the end [rad]; ``growth`` as :func:`growth` gives it."""
        by_angle = steps * self.angle + time * self.turning
        by_rate = steps * self.rate + time * self.speeding
        return by_angle * growth[0] + by_rate * growth[1]


@dataclass(frozen=True)
class Ladder:
    """Ends of four runs from the same state over the same time, at ``step``, half, a quarter and an eighth of it."""

    step: float
    steps: int
    ends: tuple[Array, ...]  # θ, ω at the end, shape (2, n)

    def orders(self) -> tuple[float, float]:
        """The orders that the coarser and the finer three runs show: nan where they are nothing but rounding."""
        gaps = self.gaps()
        return _order(gaps[0], gaps[1]), _order(gaps[1], gaps[2])

    def gaps(self) -> tuple[float, float, float]:
        """Largest difference in angle of each two neighbouring runs [rad], coarsest first."""
        first, second, third = (_apart(a[0], b[0]) for a, b in pairwise(self.ends))
        return first, second, third

    def settled(self, order: int) -> bool:
        """Whether the expansion in h holds: near enough, and of the expected order or, its first term small, above."""
        coarser, finer = self.orders()
        fits = finer > order - ORDER_SETTLED and coarser > order - 2 * ORDER_SETTLED
        return self.gaps()[1] < NEAR and fits and follows([end[0] for end in self.ends], order)

    def astray(self, order: int) -> bool:
        """Whether the expansion holds with a lower order than expected: no finer step will raise it again."""
        coarser, finer = self.orders()
        steady = abs(finer - coarser) < ORDER_SETTLED / 4 and abs(finer - round(finer)) < ORDER_SETTLED / 4
        return self.gaps()[0] < NEAR and steady and finer < order - 0.5

    def judges(self, order: int, noise: float) -> bool:
        """Whether the runs differ by so much more than ``noise`` [rad] that their order can be told.

        Each gap is off by two noises at most. With one of 16 × 2^p between the middle runs, that between the fine ones
        is at most 16 + 2/2^p + 2, and the order of p comes out too low by log₂(19/16), a quarter, at most.
        """
        return self.gaps()[1] > 16 * 2.0**order * noise

    def limit(self, order: int) -> tuple[Array, float]:
        """Angles at step zero, and how far off they may be [rad]."""
        return at_step_zero([end[0] for end in self.ends], order)


def _order(coarse: float, fine: float) -> float:
    return math.log2(coarse / fine) if 0 < fine < math.inf and 0 < coarse < math.inf else math.nan


def settled(
    cell: Moving, integrator: Integrator, points: tuple[EndPoint, ...], rounded: Rounding
) -> tuple[EndPoint, Ladder]:
    """The longest time within the horizon, and steps small enough that the measured orders have settled.

    Longer and longer times, each from the steps that the one before needed, as far as few enough will do. How far that
    is depends on the scheme and the mechanism alone, never on the machine's speed: a verdict is the same everywhere.
    """
    best: tuple[EndPoint, Ladder] | None = None
    steps, most = FIRST_STEPS, MOST_STEPS
    for point in points:
        ladder = refine(cell, integrator, point, rounded, steps, most)
        if best is not None and not ladder.settled(integrator.order):
            break
        best = point, ladder
        steps = 2 * ladder.steps  # the next time is twice as long
        most = few_steps(integrator, cell.scene.system.n, cell.few_steps)
        if 8 * steps > most:
            break
    assert best is not None
    if not all(map(math.isfinite, best[1].gaps())):
        raise EngineFault(f"{integrator.name}: not every run came to its end, with {best[1].steps} steps and more")
    return best


def few_steps(integrator: Integrator, n: int, few: int) -> int:
    """Steps of a run that is worth a longer time: schemes of first order need many, long mechanisms make them dear."""
    return round((FIRST_ORDER if integrator.order == 1 else 1) * few * min(1.0, 10 / n))


def refine(cell: Moving, integrator: Integrator, point: EndPoint, rounded: Rounding, steps: int, most: int) -> Ladder:
    """Halve the steps until the measured orders are near the nominal one, rounding is, or the finest has ``most``."""
    ends = [run(cell, integrator, point.time, steps << k) for k in range(4)]
    while True:
        ladder = Ladder(point.time / steps, steps, tuple(ends))
        noise = rounded.after(8 * steps, point.time, (1.0, point.time))
        hidden = math.isfinite(ladder.gaps()[0]) and not ladder.judges(integrator.order, noise)
        if ladder.settled(integrator.order) or hidden or 16 * steps > most:
            return ladder
        if ladder.astray(integrator.order):
            return ladder
        steps *= 2
        ends = [*ends[1:], run(cell, integrator, point.time, steps << 3)]


def run(
    cell: Moving,
    integrator: Integrator,
    duration: float,
    steps: int,
    turned: Array | float = 0.0,
    sped: Array | float = 0.0,
) -> Array:
    """The end of one run from the scene's state, its angles ``turned`` and its rates ``sped`` by so much.

    Infinite where it blows up: too coarse a step makes a large error, and is not yet a fault.
    """
    first = cell.start
    assert first is not None
    theta, omega = first[0] + turned, first[1] + sped
    try:
        with np.errstate(all="ignore"):
            return cell.trajectory(theta, omega, integrator, duration / steps, steps)
    except EngineFault:
        return np.full((2, theta.size), np.inf)


def _apart(a: Array, b: Array) -> float:
    """Largest difference [rad]; infinite where a run blew up."""
    return float(np.abs(a - b).max()) if np.isfinite(a).all() and np.isfinite(b).all() else math.inf


def growth(cell: Moving, integrator: Integrator, ladder: Ladder) -> tuple[float, float]:
    """Angles at the end [rad] per angle [rad] and per rate [rad/s] at the start: the engine's own runs tell.

    In directions that no symmetry makes special, as turning all angles alike would be. At least what free links do.
    """
    time, steps = ladder.step * ladder.steps, 2 * ladder.steps
    signs = np.random.Generator(np.random.PCG64(1)).choice([-1.0, 1.0], cell.scene.system.n)
    by_angle = run(cell, integrator, time, steps, turned=SHIFT * signs)
    by_rate = run(cell, integrator, time, steps, sped=SHIFT / time * signs)
    angle, rate = (float(np.abs(moved[0] - ladder.ends[1][0]).max()) / SHIFT for moved in (by_angle, by_rate))
    return max(1.0, angle), max(1.0, rate) * time
