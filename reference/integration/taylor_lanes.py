"""Eight Taylor trajectories at a time, one a lane of a vector: ``furiko.simulate`` of an ensemble.

The step itself is that of :mod:`.taylor_compiled`, compiled for vectors of eight. Each lane has its own time, its own
step and its own masses and lengths; a lane whose trajectory is at its end takes the next start, so that none waits for
the slowest.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..kernels.compiling import aligned, called, compiled, inlined, merged
from ..kernels.sizes import EIGHT
from ..kernels.vector import load, magnitude, maximum, store
from .convolution import OMEGA, SERIES
from .layout import (
    AHEAD,
    BROKEN,
    DONE,
    DUE,
    GRAVITY,
    IDLE,
    INVERSE,
    LENGTH,
    MASS,
    MORE,
    NEXT,
    RATE,
    RATE_LOW,
    STATE,
    STEP,
    TIME,
    TIME_LOW,
    TRAJECTORY,
    TURNS,
    WRITTEN,
)
from .taylor_compiled import (
    MOST_STEPS,
    ORDER,
    advance,
    expand,
    factor_legs,
    factor_rods,
    moved_on,
    solve_legs,
    solve_rods,
    step_size,
    two_sum,
    unwrapped,
    wrap,
)

SIZES = 5


@compiled(releases_gil=True)
def run_rod_lanes(*given: Any) -> int:
    """:func:`run` of rod chains."""
    return run(factor_rods, solve_rods, given)


@compiled(releases_gil=True)
def run_leg_lanes(*given: Any) -> int:
    """:func:`run` of N-leg pendulums."""
    return run(factor_legs, solve_legs, given)


@merged
def run(factor: Any, solve: Any, given: Any) -> int:
    """Advance all trajectories of an ensemble until the last is DONE, or ``budget`` steps of eight are spent (MORE).

    theta, omega, masses, lengths: shape (B, n); gravity, steps: (B,); out_theta, out_omega: (B, len(times), n).
    Kept between calls: ``state`` (n, STATE, 8), ``factors`` (n, FACTORS, 8), ``clock`` (CLOCK, 8) and ``lanes``
    (LANE_ROWS, 8), the first row of it IDLE before the first call. BROKEN: as in :func:`.taylor_compiled.run`;
    lanes[NEXT, 1] is the trajectory.
    """
    (
        masses,
        lengths,
        gravity,
        theta,
        omega,
        times,
        top,
        local,
        state,
        factors,
        clock,
        lanes,
        steps,
        out_theta,
        out_omega,
        budget,
    ) = given
    n = theta.shape[1]
    series = aligned(SERIES * (top + 3) * n * EIGHT).reshape((SERIES, top + 3, n, EIGHT))
    part = aligned(ORDER * n * EIGHT).reshape((ORDER, n, EIGHT))
    moved = aligned(4 * n * EIGHT).reshape((4, n, EIGHT))
    sizes = aligned(SIZES * EIGHT).reshape((SIZES, EIGHT))
    direction = 1.0 if times[-1] >= times[0] else -1.0
    powers = series[OMEGA]
    running = 0
    for lane in range(EIGHT):
        if lanes[TRAJECTORY, lane] == IDLE:
            begin(lane, masses, lengths, gravity, theta, omega, times[0], state, factors, clock, lanes)
        running += lanes[TRAJECTORY, lane] != IDLE
    for _ in range(budget):
        if running == 0:
            return DONE
        expand(factor, solve, state, top, factors, part, series)
        for row, order in enumerate((0, 1, 2, top - 1, top)):
            store(sizes, row, largest(powers[order]))
        set_steps(sizes, clock, lanes, steps, top, local)
        while find_due(clock, lanes, times):
            look_ahead(powers, state, moved, top, load(clock, AHEAD))
            write(moved, state, lanes, out_theta, out_omega)
        if set_ahead(clock, lanes, times, direction):
            return BROKEN
        go_on(powers, state, top, clock)
        for lane in range(EIGHT):
            if lanes[TRAJECTORY, lane] != IDLE and lanes[WRITTEN, lane] == times.size:
                begin(lane, masses, lengths, gravity, theta, omega, times[0], state, factors, clock, lanes)
                running -= lanes[TRAJECTORY, lane] == IDLE
    return MORE if running > 0 else DONE


@called
def set_steps(sizes: Any, clock: Any, lanes: Any, steps: Any, top: int, local: float) -> None:
    """The step of each lane, from the largest coefficients of orders 0, 1, 2 and the last two; they are counted."""
    for lane in range(EIGHT):
        clock[STEP, lane] = step_size(
            sizes[0, lane], sizes[1, lane], sizes[2, lane], sizes[3, lane], sizes[4, lane], top, local
        )
        steps[max(lanes[TRAJECTORY, lane], 0)] += lanes[TRAJECTORY, lane] != IDLE


@inlined
def look_ahead(powers: Any, state: Any, moved: Any, top: int, ahead: Any) -> None:
    """Angles and rates of all links after ``ahead``, each as a sum of two numbers, into the rows of ``moved``."""
    for j in range(len(state)):
        angle, angle_low, rate, rate_low = moved_on(powers, state, j, top, ahead)
        store(moved[0], j, angle)
        store(moved[1], j, angle_low)
        store(moved[2], j, rate)
        store(moved[3], j, rate_low)


@inlined
def go_on(powers: Any, state: Any, top: int, clock: Any) -> None:
    """Take time and state of each lane ahead."""
    ahead = load(clock, AHEAD)
    high, low = two_sum(load(clock, TIME), ahead)
    high, low = two_sum(high, low + load(clock, TIME_LOW))
    store(clock, TIME, high)
    store(clock, TIME_LOW, low)
    for j in range(len(state)):
        advance(powers, state, j, top, ahead)


@called
def begin(
    lane: int,
    masses: Any,
    lengths: Any,
    gravity: Any,
    theta: Any,
    omega: Any,
    time: float,
    state: Any,
    factors: Any,
    clock: Any,
    lanes: Any,
) -> None:
    """Put the next trajectory into a lane; where there is none, one at rest without gravity, which nobody reads."""
    b = lanes[NEXT, 0]
    clock[TIME, lane], clock[TIME_LOW, lane] = time, 0.0
    lanes[TRAJECTORY, lane], lanes[WRITTEN, lane] = IDLE, 0
    for j in range(theta.shape[1]):
        for column in range(STATE):
            state[j, column, lane] = 0.0
        factors[j, GRAVITY, lane] = 0.0
        factors[j, MASS, lane] = factors[j, LENGTH, lane] = factors[j, INVERSE, lane] = 1.0
    if b == len(theta):
        return
    lanes[NEXT, 0] += 1
    lanes[TRAJECTORY, lane] = b
    link = np.zeros(STATE)
    for j in range(theta.shape[1]):
        link[RATE], link[RATE_LOW], link[TURNS] = omega[b, j], 0.0, 0.0
        wrap(link, theta[b, j], 0.0)
        for column in range(STATE):
            state[j, column, lane] = link[column]
        factors[j, MASS, lane], factors[j, LENGTH, lane] = masses[b, j], lengths[b, j]
        factors[j, INVERSE, lane], factors[j, GRAVITY, lane] = 1.0 / lengths[b, j], gravity[b]


@inlined
def largest(row: Any) -> Any:
    """Largest magnitude in each lane; not a number where one of them is infinite or none."""
    first = load(row, 0)
    found, unsound = magnitude(first), 0.0 * first
    for j in range(1, len(row)):
        each = load(row, j)
        found = maximum(found, magnitude(each))
        unsound += 0.0 * each
    return found + unsound


@called
def find_due(clock: Any, lanes: Any, times: Any) -> int:
    """How far ahead each lane's next output is, 0 where its step does not reach it. Returns how many are due."""
    due = 0
    for lane in range(EIGHT):
        clock[AHEAD, lane], lanes[DUE, lane] = 0.0, 0
        if lanes[TRAJECTORY, lane] != IDLE and lanes[WRITTEN, lane] < times.size:
            left = time_left(clock, lanes, times, lane)
            if abs(left) <= clock[STEP, lane]:
                clock[AHEAD, lane], lanes[DUE, lane] = left, 1
                due += 1
    return due


@inlined
def time_left(clock: Any, lanes: Any, times: Any, lane: int) -> float:
    """From a lane's time to its next output."""
    left: float = (times[lanes[WRITTEN, lane]] - clock[TIME, lane]) - clock[TIME_LOW, lane]
    return left


@called
def write(moved: Any, state: Any, lanes: Any, out_theta: Any, out_omega: Any) -> None:
    """The outputs that are due."""
    for lane in range(EIGHT):
        if lanes[DUE, lane]:
            b, k = lanes[TRAJECTORY, lane], lanes[WRITTEN, lane]
            for j in range(len(state)):
                out_theta[b, k, j] = unwrapped(moved[0, j, lane], moved[1, j, lane], state[j, TURNS, lane])
                out_omega[b, k, j] = moved[2, j, lane] + moved[3, j, lane]
            lanes[WRITTEN, lane] += 1


@called
def set_ahead(clock: Any, lanes: Any, times: Any, direction: float) -> int:
    """The step of each lane that is not at its end. Returns 1 where one will never get there, and says which."""
    for lane in range(EIGHT):
        clock[AHEAD, lane] = 0.0
        if lanes[TRAJECTORY, lane] != IDLE and lanes[WRITTEN, lane] < times.size:
            if not clock[STEP, lane] * MOST_STEPS > abs(time_left(clock, lanes, times, lane)):
                lanes[NEXT, 1] = lanes[TRAJECTORY, lane]
                return 1
            clock[AHEAD, lane] = clock[STEP, lane] * direction
    return 0
