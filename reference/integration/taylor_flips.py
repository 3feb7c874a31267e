"""When links first pass the upright, eight trajectories at a time: ``furiko.flip_times``.

Between two steps an angle is the polynomial of :mod:`.taylor`, so that its passing an odd multiple of π is a root of
one, and not something between two points of a grid. Where the sum of a polynomial's magnitudes does not reach the
upright there is none. Elsewhere the step is halved until each part is seen to have none, by the rate in its middle and
a bound of the acceleration, or has a rate of one sign, and then its two ends tell. A link that turns back before the
upright, however near, has not flipped; one that passes it and comes back within a step has.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..kernels.compiling import aligned, called, compiled, inlined, merged
from ..kernels.sizes import EIGHT
from ..kernels.vector import load, magnitude, store
from .convolution import OMEGA, SERIES
from .layout import (
    AHEAD,
    ANGLE,
    ANGLE_LOW,
    BROKEN,
    DONE,
    IDLE,
    MORE,
    TIME,
    TIME_LOW,
    TRAJECTORY,
    TURNS,
    WRITTEN,
)
from .taylor_compiled import (
    ORDER,
    expand,
    factor_legs,
    factor_rods,
    solve_legs,
    solve_rods,
)
from .taylor_lanes import (
    SIZES,
    begin,
    go_on,
    largest,
    set_ahead,
    set_steps,
    time_left,
)

PI, PI_LOW = 3.141592653589793, 1.2246467991473532e-16
NEVER = -1.0
NARROWEST = 2.0**-46  # of a step: no narrower part is halved, since rounding hides what is in it
NEARLY = 1.0 - 1e-12  # a polynomial's magnitudes are summed with rounding
NEWTON = 60  # most steps to a root: bisection alone would take as many


@compiled(releases_gil=True)
def run_rod_flips(*given: Any) -> int:
    """:func:`run` of rod chains."""
    return run(factor_rods, solve_rods, given)


@compiled(releases_gil=True)
def run_leg_flips(*given: Any) -> int:
    """:func:`run` of N-leg pendulums."""
    return run(factor_legs, solve_legs, given)


@merged
def run(factor: Any, solve: Any, given: Any) -> int:
    """Follow all trajectories until one of the links from ``watched[0]`` to ``watched[1]`` - 1 flips, or to ``until``.

    As :func:`.taylor_lanes.run`; until: shape (1,), above 0. out_time, out_link: (B,), left as they are where none
    flips. Kept between calls besides: cells (n, 8), the turn that each link is in.
    """
    (
        masses,
        lengths,
        gravity,
        theta,
        omega,
        until,
        top,
        local,
        state,
        factors,
        clock,
        lanes,
        steps,
        watched,
        cells,
        out_time,
        out_link,
        budget,
    ) = given
    n = theta.shape[1]
    series = aligned(SERIES * (top + 3) * n * EIGHT).reshape((SERIES, top + 3, n, EIGHT))
    part = aligned(ORDER * n * EIGHT).reshape((ORDER, n, EIGHT))
    reach = aligned(n * EIGHT).reshape((n, EIGHT))
    sizes = aligned(SIZES * EIGHT).reshape((SIZES, EIGHT))
    powers = series[OMEGA]
    rates = np.empty(top + 1)
    running = 0
    for lane in range(EIGHT):
        if lanes[TRAJECTORY, lane] == IDLE:
            begin(lane, masses, lengths, gravity, theta, omega, 0.0, state, factors, clock, lanes)
            set_cells(lane, state, cells)
        running += lanes[TRAJECTORY, lane] != IDLE
    for _ in range(budget):
        if running == 0:
            return DONE
        expand(factor, solve, state, top, factors, part, series)
        for row, order in enumerate((0, 1, 2, top - 1, top)):
            store(sizes, row, largest(powers[order]))
        set_steps(sizes, clock, lanes, steps, top, local)
        if set_ahead(clock, lanes, until, 1.0):
            return BROKEN
        stop_at(until, clock, lanes)
        ahead = load(clock, AHEAD)
        for j in range(watched[0], watched[1]):
            store(reach, j, magnitude(load(state[j], ANGLE)) + travel(powers, j, top, ahead))
        for lane in range(EIGHT):
            find_flip(lane, powers, state, reach, watched, cells, rates, until, clock, lanes, out_time, out_link)
        go_on(powers, state, top, clock)
        for lane in range(EIGHT):
            if lanes[TRAJECTORY, lane] != IDLE and lanes[WRITTEN, lane] == 1:
                begin(lane, masses, lengths, gravity, theta, omega, 0.0, state, factors, clock, lanes)
                set_cells(lane, state, cells)
                running -= lanes[TRAJECTORY, lane] == IDLE
    return MORE if running > 0 else DONE


@called
def travel(powers: Any, j: int, top: int, h: Any) -> Any:
    """No link's angle changes by more within h."""
    far = magnitude(load(powers[top], j)) * (1.0 / (top + 1.0))
    for k in range(top - 1, -1, -1):
        far = magnitude(load(powers[k], j)) * (1.0 / (k + 1.0)) + h * far
    return h * far


@called
def stop_at(until: Any, clock: Any, lanes: Any) -> None:
    """No step goes beyond the end."""
    for lane in range(EIGHT):
        if lanes[TRAJECTORY, lane] != IDLE:
            clock[AHEAD, lane] = min(clock[AHEAD, lane], time_left(clock, lanes, until, lane))


@called
def set_cells(lane: int, state: Any, cells: Any) -> None:
    """The turns that the links of a lane begin in."""
    for j in range(len(state)):
        cells[j, lane] = turn_of(state, j, lane)


@inlined
def turn_of(state: Any, j: int, lane: int) -> float:
    """Which turn a link is in, from upright to upright; hanging is in the middle of it."""
    angle, low = state[j, ANGLE, lane], state[j, ANGLE_LOW, lane]
    turn: float = state[j, TURNS, lane]
    if (angle - PI) + (low - PI_LOW) > 0.0:
        turn += 1.0
    elif (angle + PI) + (low + PI_LOW) < 0.0:
        turn -= 1.0
    return turn


@called
def find_flip(
    lane: int,
    powers: Any,
    state: Any,
    reach: Any,
    watched: Any,
    cells: Any,
    rates: Any,
    until: Any,
    clock: Any,
    lanes: Any,
    out_time: Any,
    out_link: Any,
) -> None:
    """Write down the first of a lane's links to flip within its step, and where the trajectory is at its end."""
    if lanes[TRAJECTORY, lane] == IDLE:
        return
    first, link, h = NEVER, -1, clock[AHEAD, lane]
    for j in range(watched[0], watched[1]):
        if reach[j, lane] < PI * NEARLY:
            continue
        angle, low = state[j, ANGLE, lane], state[j, ANGLE_LOW, lane]
        turn = cells[j, lane] - state[j, TURNS, lane]
        at = 0.0  # passed at the last step's end, within a rounding of it
        if turn_of(state, j, lane) == cells[j, lane]:
            for k in range(len(rates)):
                rates[k] = powers[k, j, lane]
            above = (angle - PI * (2.0 * turn + 1.0)) + (low - PI_LOW * (2.0 * turn + 1.0))
            below = (angle - PI * (2.0 * turn - 1.0)) + (low - PI_LOW * (2.0 * turn - 1.0))
            at = passing(rates, above, below, h)
        if at != NEVER and (first == NEVER or at < first):
            first, link = at, j
    if first != NEVER:
        b = lanes[TRAJECTORY, lane]
        out_time[b], out_link[b] = clock[TIME, lane] + (clock[TIME_LOW, lane] + first), link
    if first != NEVER or h >= time_left(clock, lanes, until, lane):
        lanes[WRITTEN, lane] = 1


@called
def passing(rates: Any, above: float, below: float, h: float) -> float:
    """The first time within h at which an angle is at one of two ends, and goes beyond it; NEVER where there is none.

    ``above``, ``below``: the angle less its ends at the start, the one not above and the other not below 0.
    """
    top = len(rates) - 1
    bound = 0.0  # of the acceleration, in all of the step
    for k in range(top, 0, -1):
        bound = k * abs(rates[k]) + h * bound
    start, width = 0.0, h
    while start < h:
        width = min(width, h - start)
        middle = start + 0.5 * width
        turned, rate = moved(rates, middle)
        half = 0.5 * width
        play = half * (abs(rate) + 0.5 * half * bound)
        if above + turned + play < 0.0 and below + turned - play > 0.0:
            start, width = start + width, 2.0 * width
        elif abs(rate) > half * bound or width <= NARROWEST * h:
            end = start + width
            turned, _rate = moved(rates, end)
            if above + turned > 0.0:
                return root(rates, above, start, end)
            if below + turned < 0.0:
                return root(rates, below, start, end)
            start, width = end, 2.0 * width
        else:
            width = half
    return NEVER


@called
def moved(rates: Any, t: float) -> tuple[float, float]:
    """How far an angle has turned after t, and its rate."""
    top = len(rates) - 1
    rate = rates[top]
    angle = rate / (top + 1.0)
    for k in range(top - 1, -1, -1):
        rate = rates[k] + t * rate
        angle = rates[k] / (k + 1.0) + t * angle
    return t * angle, rate


@called
def root(rates: Any, offset: float, low: float, high: float) -> float:
    """Where ``offset`` plus the angle turned is 0, between two times at which its signs are two: Newton, or halving."""
    sign = 1.0 if offset + moved(rates, high)[0] > 0.0 else -1.0
    at = 0.5 * (low + high)
    for _ in range(NEWTON):
        turned, rate = moved(rates, at)
        off = offset + turned
        if sign * off > 0.0:
            high = at
        else:
            low = at
        following = at - off / rate if rate != 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if following == at or not low < following < high:
            break
        at = following
    return at
