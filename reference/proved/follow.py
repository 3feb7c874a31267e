"""From step to step: as many bits as are worth it, steps as long as is proved, outputs wherever they are asked for.

The bounds grow faster than the motion's own differences do, as e^∫L dt with L from the absolute values of the
derivatives. A start that is exact needs nothing better: a bit of precision more is cheap, and as many are taken as the
growth uses up. And as the bounds grow, the polynomials need fewer: a step is computed to a few bits below them.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .clouds import Cloud
from .form import Form, Planar, form_of
from .sizes import log2_largest
from .steps import Walk

ORDER_PER_BIT = 0.4  # the order at which a bit of time costs least: measured, flat from 0.3 to 0.6
BELOW = 8  # bits by which a step's own error is smaller than the bounds' width already is
GUARD = 32  # bits of the computation beyond those of a step's error
SHORTEST = 2.0**-40  # of a step, relative to the whole time: what needs shorter ones is not followed


@dataclass
class Progress:
    """How far a run has come. ``rows``: the states at each time that was asked for, in order."""

    time: float
    rows: list[Cloud] = field(default_factory=list)
    steps: int = 0
    wide: float = -math.inf  # log₂ of the largest radius there
    stopped: str = ""  # why it did not come to the end: "time", "step" or "width"


@dataclass(frozen=True)
class Limits:
    """When a run ends early: ``widest``: log₂ of the largest radius; ``deadline``: of the clock [s];
    ``watch``: told of each step's end, (time [s], log₂ of the radius).
    """

    widest: float
    deadline: float = math.inf
    watch: Callable[[float, float], None] | None = None


def follow(p: Planar, start: Cloud, times: Sequence[float], bits: int, limits: Limits) -> Progress:
    """The states at all ``times`` [s] of the motions that are in ``start`` at ``times[0]``, steps off by 2^-bits.

    Returns what was reached: a run ends before the first step after which a radius is larger than it may be.
    """
    import flint

    walk, progress, cloud = Walk(), Progress(times[0], wide=start.wide()), start
    end = times[-1]
    shortest = SHORTEST * abs(end - times[0])
    ahead = [*times]
    while ahead and ahead[0] == times[0]:
        progress.rows.append(cloud)
        ahead.pop(0)
    forms: dict[int, Form] = {}
    while ahead:
        if clock.monotonic() > limits.deadline:
            progress.stopped = "time"
            return progress
        scale = max(0.0, log2_largest((*cloud.x, *cloud.v)))
        wanted = max(scale - bits, progress.wide - BELOW)
        precision = 32 * math.ceil((max(0.0, scale - wanted) + GUARD) / 32)
        with flint.ctx.workprec(precision):
            if precision not in forms:
                forms[precision] = form_of(p)
            span = (progress.time, end)
            stretch, reached = walk.step(
                forms[precision], cloud.upright(walk.pace), order_for(scale - wanted), wanted, span, shortest
            )
            if stretch is None:
                progress.stopped = "step"
                return progress
            cloud = stretch.at(stretch.length)
            wide = cloud.wide()
            if wide > limits.widest:
                progress.stopped = "width"
                return progress
            while ahead and abs(ahead[0] - times[0]) <= abs(reached - times[0]):
                at = ahead.pop(0)
                progress.rows.append(cloud if at == reached else stretch.at(flint.arb(at) - progress.time))
        progress.time, progress.wide = reached, wide
        progress.steps += 1
        if limits.watch:
            limits.watch(reached, wide)
    return progress


def order_for(bits: float) -> int:
    """The degree of the polynomials for this precision."""
    return max(8, math.ceil(ORDER_PER_BIT * bits))
