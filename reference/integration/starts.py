"""What all that integrates an ensemble shares: its systems and starts, times, tolerance, order, and threads."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.systems import System
from ..kernels.forward_dynamics import link_masses
from ..kernels.sizes import EIGHT
from ..kernels.threads import processors, thread_pool
from ..limits import checked_state
from .layout import BROKEN, CLOCK, FACTORS, IDLE, LANE_ROWS, MORE, NEXT, STATE, TIME, TRAJECTORY

Array = NDArray[np.float64]

FINEST = 1e-14  # a tolerance below this asks for more than doubles hold
SAFETY = 1e-2  # the error of a step over the tolerance: errors add up, and grow with the motion
STEPS_A_CALL = 20_000  # after so many, Python is given a chance to see an interrupt


@dataclass(frozen=True)
class Starts:
    """Checked starts: one system, or one a start; ``theta`` [rad], ``omega`` [rad/s], shape (..., n)."""

    systems: list[System]
    theta: Array
    omega: Array

    @property
    def kind(self) -> str:
        """Of all the systems."""
        return self.systems[0].kind

    @property
    def n(self) -> int:
        """Number of links."""
        return self.systems[0].n

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes."""
        return self.theta.shape[:-1]

    @property
    def count(self) -> int:
        """How many starts there are."""
        return math.prod(self.shape)

    def rows(self) -> tuple[Array, Array]:
        """Angles and rates, shape (count, n)."""
        return self.theta.reshape(-1, self.n), self.omega.reshape(-1, self.n)

    def links(self) -> tuple[Array, Array, Array]:
        """Masses and lengths, shape (count, n), and gravity, shape (count,)."""
        return (
            self.each(link_masses, (self.n,)),
            self.each(attrgetter("lengths"), (self.n,)),
            self.each(attrgetter("gravity"), ()),
        )

    def each(self, value: Callable[[System], Any], shape: tuple[int, ...]) -> Array:
        """A value of the system of each start, shape (count, *shape)."""
        values = [value(system) for system in self.systems]
        return np.ascontiguousarray(np.broadcast_to(values, (self.count, *shape)), np.float64)


def checked_starts(system: System | Sequence[System], theta: Any, omega: Any) -> Starts:
    """The systems, one or one a start, and the starts. Raises InvalidInput."""
    if not isinstance(system, Sequence):
        return Starts([system], *checked_state(system, theta, omega))
    systems = [*system]
    kinds = {(each.kind, each.n) for each in systems}
    if len(kinds) != 1:
        raise InvalidInput(
            f"system: one or more of one kind and number of links are needed, got {len(systems)}: {kinds}"
        )
    angles, rates = checked_state(systems[0], theta, omega)
    if angles.ndim == 1:
        angles, rates = (np.repeat(row[np.newaxis], len(systems), axis=0) for row in (angles, rates))
    if angles.ndim != 2 or len(angles) != len(systems):
        raise InvalidInput(
            f"theta: with {len(systems)} systems, shape ({len(systems)}, {systems[0].n}) is needed, got {angles.shape}"
        )
    return Starts(systems, angles, rates)


def checked_times(times: Any) -> Array:
    """``times`` as float64, (m,), finite and in order. Raises InvalidInput."""
    try:
        moments = np.array(times, np.float64)
    except (TypeError, ValueError):
        raise InvalidInput(f"times: an array of numbers is needed, got {str(times)[:60]}") from None
    if moments.ndim != 1 or len(moments) == 0:
        raise InvalidInput(f"times: one axis with at least one time is needed, got shape {moments.shape}")
    if not np.isfinite(moments).all():
        raise InvalidInput(f"times: must be finite, got {float(moments[~np.isfinite(moments)][0])}")
    steps = np.diff(moments)
    if (steps > 0).any() and (steps < 0).any():
        turn = int(np.argmax(steps * (moments[-1] - moments[0] or steps[np.nonzero(steps)[0][0]]) < 0)) + 1
        raise InvalidInput(
            f"times: must rise or fall throughout, but times[{turn - 1}] = {moments[turn - 1]:g} is followed by "
            f"times[{turn}] = {moments[turn]:g}"
        )
    return moments


def checked_tolerance(tolerance: Any) -> float:
    """Raises InvalidInput for one that no series can be cut off at."""
    if not (isinstance(tolerance, int | float | np.floating) and 0 < tolerance <= 0.1):
        raise InvalidInput(f"tolerance: must be above 0 and at most 0.1, got {tolerance!r}")
    return float(tolerance)


def local_size(tolerance: float) -> float:
    """The size of a step's last terms relative to its first; at the finest below rounding."""
    return SAFETY * max(tolerance, FINEST)


def best_order(local: float) -> int:
    """The order P at which reaching ``local`` costs least.

    The step grows as local^(1/P). Work that grows as P² (the convolutions) is least at P = -ln(local)/2 (Jorba and Zou
    2005), work that grows as P at twice that; measured for 2, 5 and 100 rods, the best is flat about 0.72.
    """
    return max(6, math.ceil(-0.72 * math.log(local)))


def step_accuracy(tolerance: float, *, finer: bool = False) -> tuple[int, float]:
    """Order and :func:`local_size` of the steps; ``finer``: of the run that a result's error is estimated from."""
    local = local_size(tolerance)
    order = best_order(local)
    return (order + 4, local * SAFETY) if finer else (order, local)


def empty_lanes(n: int) -> tuple[Array, Array, Array, NDArray[np.int64]]:
    """What the kernels of eight lanes keep between calls, nothing begun: state, factors, clock, lanes."""
    lanes = np.zeros((LANE_ROWS, EIGHT), np.int64)
    lanes[TRAJECTORY] = IDLE
    return np.zeros((n, STATE, EIGHT)), np.zeros((n, FACTORS, EIGHT)), np.zeros((CLOCK, EIGHT)), lanes


def run_lanes(advance: Callable[[int], int], clock: Array, lanes: NDArray[np.int64], until: float) -> None:
    """Call a kernel of eight lanes with a number of steps until all are done. Raises InvalidInput for a broken one."""
    status = MORE
    while status == MORE:
        status = advance(STEPS_A_CALL // EIGHT)
    if status == BROKEN:
        lane = int(np.argmax(lanes[TRAJECTORY] == lanes[NEXT, 1]))
        raise too_fast(clock[TIME, lane], until)


def on_threads(count: int, threads: int | None, work: Callable[[slice], None]) -> None:
    """Have ``work`` done for all of ``count`` rows, in as many parts as threads."""
    if count == 0:
        return
    size = -(-count // min(processors(threads), count))
    parts = [slice(first, min(first + size, count)) for first in range(0, count, size)]
    spread = thread_pool().map if len(parts) > 1 else map
    for _ in spread(work, parts):
        pass


def too_fast(time: float, until: float) -> InvalidInput:
    """What is raised where steps would be too short ever to come to the end."""
    return InvalidInput(f"omega: the motion is too fast to be followed from t = {time:g} s to {until:g} s")
