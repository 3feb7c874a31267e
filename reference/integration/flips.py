"""When a pendulum first flips: ``furiko.flip_times``, by events on the dense output of Taylor steps.

A link flips when it passes the upright: when its angle passes an odd multiple of π. :mod:`.taylor_flips` finds it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.systems import System
from ..kernels.ahead.load import kernel
from ..kernels.sizes import EIGHT
from .starts import (
    FINEST,
    Starts,
    checked_starts,
    checked_tolerance,
    empty_lanes,
    on_threads,
    run_lanes,
    step_accuracy,
)

Array = NDArray[np.float64]
EPSILON = float(np.finfo(np.float64).eps)
NONE = -1


@dataclass(frozen=True)
class FlipTimes:
    """When each motion first flips [s], shape (...): infinite where no link has by ``until`` [s].

    ``link``, shape (...): which link it is, from 0, and -1 where there is none; ``steps``, shape (...): Taylor steps.
    """

    times: Array
    link: NDArray[np.int64]
    until: float
    tolerance: float
    steps: NDArray[np.int64]
    _finer: Callable[[], tuple[Array, NDArray[np.int64]]] = field(repr=False, compare=False)

    @cached_property
    def error(self) -> Array:
        """Estimated error of each time [s], shape (...): an estimate, not a bound.

        Twice the difference from a second run of higher order and smaller steps, and not less than rounding. Infinite
        where the two do not agree on whether, or which, link flips first: there the motion is too chaotic for doubles
        to say, or the link comes to rest at the upright within rounding.
        """
        times, link = self._finer()
        both = np.isfinite(self.times) & np.isfinite(times)
        apart = np.abs(np.where(both, self.times, 0) - np.where(both, times, 0))
        rounding = EPSILON * (np.sqrt(1.0 + self.steps) + np.where(both, self.times, 0))
        return np.where(self.link == link, 2 * apart + np.where(both, rounding, 0), np.inf)


def flip_times(
    system: System | Sequence[System],
    theta: Any,
    omega: Any,
    until: float,
    tolerance: float = FINEST,
    *,
    link: int | None = None,
    threads: int | None = None,
) -> FlipTimes:
    """The time from the start at ``theta`` [rad], ``omega`` [rad/s] to the first flip of each motion, up to ``until``.

    A link flips when its angle, absolute and from the downward vertical, passes an odd multiple of π: when it goes over
    the top, in either direction. ``link``: only this link counts, from 0; the first flip of any if not given.
    ``system``, ``theta``, ``omega`` (..., n), ``tolerance``, ``threads``: as of :func:`furiko.simulate`; many starts
    run eight at a time, each to its own flip. ``until`` [s]: above 0. Raises :class:`InvalidInput` as
    :func:`furiko.simulate` does.
    """
    starts = checked_starts(system, theta, omega)
    number = isinstance(until, int | float | np.floating) and not isinstance(until, bool)
    if not (number and until > 0 and math.isfinite(until)):
        raise InvalidInput(f"until: a time [s] above 0 is needed, got {until!r:.60}")
    fits = link is None or (isinstance(link, int | np.integer) and not isinstance(link, bool) and 0 <= link < starts.n)
    if not fits:
        raise InvalidInput(f"link: a number from 0 to {starts.n - 1} is needed, or None for any, got {link!r:.60}")
    wanted = checked_tolerance(tolerance)
    watched = (0, starts.n) if link is None else (int(link), int(link) + 1)

    def found(*, finer: bool = False) -> tuple[Array, NDArray[np.int64], NDArray[np.int64]]:
        return _flips(starts, float(until), watched, *step_accuracy(wanted, finer=finer), threads)

    times, flipped, steps = found()
    return FlipTimes(times, flipped, float(until), wanted, steps, lambda: found(finer=True)[:2])


def _flips(
    starts: Starts, until: float, watched: tuple[int, int], order: int, local: float, threads: int | None
) -> tuple[Array, NDArray[np.int64], NDArray[np.int64]]:
    """Times, links, and steps taken, each of the shape of the starts."""
    total = starts.count
    given = (*starts.links(), *starts.rows())
    times, link, steps = np.full(total, np.inf), np.full(total, NONE, np.int64), np.zeros(total, np.int64)

    def follow(rows: slice) -> None:
        out = steps[rows], times[rows], link[rows]
        _follow(starts.kind, [a[rows] for a in given], np.array([until]), watched, order, local, out)

    on_threads(total, threads, follow)
    return times.reshape(starts.shape), link.reshape(starts.shape), steps.reshape(starts.shape)


def _follow(
    kind: str,
    given: list[Array],
    until: Array,
    watched: tuple[int, int],
    order: int,
    local: float,
    out: tuple[NDArray[np.int64], Array, NDArray[np.int64]],
) -> None:
    run = kernel("run_rod_flips" if kind == "rod-chain" else "run_leg_flips")
    steps, times, link = out
    n = given[3].shape[1]
    state, factors, clock, lanes = empty_lanes(n)
    kept = state, factors, clock, lanes, steps, np.array(watched, np.int64), np.zeros((n, EIGHT)), times, link
    run_lanes(lambda count: run(*given, until, order, local, *kept, count), clock, lanes, until[0])
