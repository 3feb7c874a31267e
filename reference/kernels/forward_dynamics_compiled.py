"""The elimination of :mod:`.elimination` in compiled form: one state, and many states in lanes.

The batch kernels take states a row each, as numpy has them, and work on blocks of LANES states, one state a vector
lane (:mod:`.lanes`). What makes a compiler vectorise them: loops of a length known beforehand, and one flat scratch
array whose parts lie at constant offsets (many arrays mean many checks for overlap, and LLVM gives up).

Status: 0, or 1 where an angle or rate is not finite or beyond what the kernels hold for, or their number is wrong;
the batch kernels may give 1 for states that are only nearly so.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..limits import LARGEST_ANGLE, LARGEST_RATE
from . import elimination
from .compiling import aligned, called, compiled, inlined, merged, wide_vectors
from .lanes import (
    any_suspicious,
    fetch_block,
    fetch_scratch,
    fetch_to_read,
    fetch_to_write,
    filled_up,
    read_columns,
    size,
    write_columns,
)
from .sincos import sincos

difference = inlined(elimination.difference)
absorb_rod = inlined(elimination.absorb_rod)
turn = inlined(elimination.turn)
rod_acceleration = inlined(elimination.rod_acceleration)
turn_up = inlined(elimination.turn_up)
turn_down = inlined(elimination.turn_down)
force_above = inlined(elimination.force_above)
moment_residual = inlined(elimination.moment_residual)
absorb_residual = inlined(elimination.absorb_residual)
leg_terms = inlined(elimination.leg_terms)


@inlined
def outside(theta: float, omega: float) -> float:
    """1 where a kernel cannot take the state, NaN included; else 0."""
    return 0.0 if abs(theta) <= LARGEST_ANGLE and abs(omega) <= LARGEST_RATE else 1.0


@compiled(releases_gil=False)
def rods_single(theta: Any, omega: Any, out: Any, table: Any) -> int:
    """θ'' of a rod chain in one state, shape (n,) each; table: see :func:`.forward_dynamics.table`."""
    n = len(table) - 1
    if theta.size != n or omega.size != n:
        return 1
    gravity = table[n, 0]
    a = b = c = d = p = q = 0.0
    bad = 0.0
    for j in range(n - 1, -1, -1):
        bad += outside(theta[j], omega[j])
        row = table[j]
        high, low = difference(theta[j], theta[j - 1] if j > 0 else 0.0)
        s, co = sincos(high, low)
        w = row[1] * omega[j] * omega[j]
        a, b, c, p, q, kappa_tau, kappa_b, kappa_m6 = absorb_rod(row[0], w, a, b, c, d, p, q)
        a, b, c, d, p, q = turn(s, co, a, b, c, p, q)
        row[2], row[3], row[4], row[5], row[6], row[7] = s, co, w, kappa_tau, kappa_b, kappa_m6
    along, across = -gravity, 0.0
    for j in range(n):
        row = table[j]
        row[8], row[9] = turn_down(row[2], row[3], along, across)
        row[10], along, across = rod_acceleration(row[2], row[3], row[4], row[5], row[6], row[7], along, across)
    if table[n, 1] > 0.0:
        refine_single(table, n)
    for j in range(n):
        out[j] = table[j, 10] / table[j, 1]
    return 1 if bad > 0.0 else 0


@called
def refine_single(table: Any, n: int) -> None:
    """One step of iterative refinement of lθ''."""
    along = across = p = q = 0.0
    for j in range(n - 1, -1, -1):
        row = table[j]
        delta = moment_residual(row[0], row[9], row[10], across)
        p, q, row[5] = absorb_residual(row[0], delta, row[6], row[7], p, q)
        p, q = turn_up(row[2], row[3], p, q)
        along, across = force_above(row[0], row[4], row[8], row[9], row[10], along, across)
        along, across = turn_up(row[2], row[3], along, across)
    along = across = 0.0
    for j in range(n):
        row = table[j]
        more, along, across = rod_acceleration(row[2], row[3], 0.0, row[5], row[6], row[7], along, across)
        row[10] += more


@compiled(releases_gil=False)
def legs_single(theta: Any, omega: Any, out: Any, table: Any) -> int:
    """θ'' of an N-leg pendulum in one state, shape (n,) each; table: see :func:`.forward_dynamics.table`."""
    n = len(table) - 1
    if theta.size != n or omega.size != n:
        return 1
    gravity = table[n, 0]
    bad = outside(theta[0], omega[0])
    s1, c1 = sincos(theta[0], 0.0)
    h = gravity * c1 + table[0, 1] * omega[0] * omega[0]
    load, inertia = 0.0, table[0, 0]
    for i in range(1, n):
        bad += outside(theta[i], omega[i])
        row = table[i]
        high, low = difference(theta[0], theta[i])
        s, c = sincos(high, low)
        more_load, more_inertia = leg_terms(row[0], row[1] * omega[i] * omega[i], h, s, c)
        load += more_load
        inertia += more_inertia
        row[2], row[3] = s, c
    G = -load / inertia
    out[0] = (G - gravity * s1) / table[0, 1]
    for i in range(1, n):
        row = table[i]
        out[i] = (h * row[2] - row[3] * G) / row[1]
    return 1 if bad > 0.0 else 0


LANES = 16  # states of rod chains at a time: with more, long chains leave the cache sooner
A, B, C, D, P, Q, SIZE = (k * LANES for k in range(7))  # of each lane
ALONG_T, ACROSS_T = A, B  # take their places
STATE = 7 * LANES
ANGLE, COS, RATE, TAU, KB, KM = (k * LANES for k in range(6))  # of each lane and rod
SIN = ANGLE  # takes its place, and gives it to θ'' in the end
ROW = 6 * LANES
ALONG, ACROSS, MOVED = (k * LANES for k in range(3))  # of each lane and rod, for the refinement
KEPT = 3 * LANES
AHEAD = 18  # rods: so far ahead scratch is fetched, three pages of memory
SHORT = 1024  # links: the next block is fetched meanwhile; more would push this one's scratch out of the cache

LEG_LANES = 32  # states of N-leg pendulums at a time: their scratch is small
FIRST, H, LOAD, INERTIA, SIN1, LEG_SIZE = (k * LEG_LANES for k in range(6))  # of each lane
FIRST_STATE = 6 * LEG_LANES
LEG_ANGLE, LEG_RATE = 0, LEG_LANES  # of each lane and leg
LEG_SIN, LEG_COS = LEG_ANGLE, LEG_RATE  # take their places
LEG = 2 * LEG_LANES


@compiled(releases_gil=True)
def rods_batch(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float) -> int:
    """θ'' of a rod chain in many states, shape (B, n) each."""
    return in_blocks(rods_block, LANES, STATE, ROW, theta, omega, out, masses, lengths, gravity)


@compiled(releases_gil=True)  # apart, because the mere presence of the refinement slows down what goes without
def refined_rods_batch(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float) -> int:
    """:func:`rods_batch` with one step of refinement."""
    return in_blocks(refined_rods_block, LANES, STATE, ROW + KEPT, theta, omega, out, masses, lengths, gravity)


@compiled(releases_gil=True)
def legs_batch(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float) -> int:
    """θ'' of an N-leg pendulum in many states, shape (B, n) each."""
    return in_blocks(legs_block, LEG_LANES, FIRST_STATE, LEG, theta, omega, out, masses, lengths, gravity)


@merged
def in_blocks(
    solve: Any,
    lanes: int,
    lane_size: int,
    link_size: int,
    theta: Any,
    omega: Any,
    out: Any,
    masses: Any,
    lengths: Any,
    gravity: float,
) -> int:
    """Have ``solve`` find θ'' of so many states at a time, with scratch for them and each link."""
    batch, n = theta.shape
    scratch = aligned(lane_size + (n + 8) * link_size)  # the support comes first; tiles are eight links wide
    status, whole = 0, batch - batch % lanes
    angles, rates, found, first = theta, omega, out, 0
    for row in range(0, batch, lanes):
        if row == whole:
            angles, rates, found = filled_up(theta, whole, lanes), filled_up(omega, whole, lanes), np.empty((lanes, n))
        first = row if row < whole else 0
        status |= solve(angles, rates, found, first, masses, lengths, gravity, scratch)
    for row in range(whole, batch):  # an assignment to a slice takes seconds to compile
        for j in range(n):
            out[row, j] = found[row - whole, j]
    return status


@merged
def rods_block(
    theta: Any, omega: Any, out: Any, first: int, masses: Any, lengths: Any, gravity: float, scratch: Any
) -> int:
    """θ'' of a rod chain in the LANES states from the first on."""
    wide_vectors()
    lane, rods = scratch[:STATE], scratch[STATE:]
    eliminate(theta, omega, out, first, masses, lengths, gravity, lane, rods)
    for start in range(0, lengths.size, 8):
        count = min(8, lengths.size - start)
        if lengths.size > SHORT:
            fetch_to_write(out, first, start + 16, LANES)
        for j in range(start, start + count):
            fetch_scratch(rods, (j + 1 + AHEAD) * ROW, ROW)
            accelerate_rod(lane, rods[(j + 1) * ROW : (j + 2) * ROW], 1.0 / lengths[j])
        write_columns(rods, (start + 1) * ROW + ANGLE, ROW, out, first, start, count, LANES)
    return any_suspicious(lane[SIZE : SIZE + LANES])


@merged
def refined_rods_block(
    theta: Any, omega: Any, out: Any, first: int, masses: Any, lengths: Any, gravity: float, scratch: Any
) -> int:
    """:func:`rods_block` with one step of refinement."""
    wide_vectors()
    lane, rods, motion = scratch[:STATE], scratch[STATE:], scratch[STATE + (lengths.size + 8) * ROW :]
    eliminate(theta, omega, out, first, masses, lengths, gravity, lane, rods)
    refine(lane, rods, motion, masses)
    for start in range(0, lengths.size, 8):
        count = min(8, lengths.size - start)
        for j in range(start, start + count):
            rod = rods[(j + 1) * ROW : (j + 2) * ROW]
            correct_rod(lane, rod, motion[j * KEPT : (j + 1) * KEPT], 1.0 / lengths[j])
        write_columns(rods, (start + 1) * ROW + ANGLE, ROW, out, first, start, count, LANES)
    return any_suspicious(lane[SIZE : SIZE + LANES])


@merged
def eliminate(
    theta: Any, omega: Any, out: Any, first: int, masses: Any, lengths: Any, gravity: float, lane: Any, rods: Any
) -> None:
    """The upward steps of all rods, eight at a time; P, Q then hold a_0. First in rods: the support, whose angle is 0.

    ``out`` is only brought near.
    """
    n = lengths.size
    for i in range(STATE):
        lane[i] = 0.0
    for i in range(LANES):
        rods[ANGLE + i] = 0.0
    last = (n - 1) // 8 * 8
    read_rods(theta, omega, first, last, n - last, rods)
    for start in range(last, -1, -8):
        if n > SHORT:
            fetch_to_read(theta, first, start - 16, LANES)  # what is read in the next round
            fetch_to_read(omega, first, start - 16, LANES)
        if start > 0:  # the next eight, because the lowest of these needs the angle above
            read_rods(theta, omega, first, start - 8, 8, rods)
        for j in range(min(start + 8, n) - 1, start - 1, -1):
            fetch_scratch(rods, (j + 1 - AHEAD) * ROW, ROW)
            if n <= SHORT:
                fetch_block(theta, omega, out, first + LANES, n - 1 - j, LANES)
            above, rod = rods[j * ROW : (j + 1) * ROW], rods[(j + 1) * ROW : (j + 2) * ROW]
            eliminate_rod(lane, rod, above, masses[j], lengths[j])
    for i in range(LANES):
        lane[P + i], lane[Q + i] = -gravity, 0.0


@inlined
def read_rods(theta: Any, omega: Any, first: int, start: int, count: int, rods: Any) -> None:
    """θ and ω of a few rods into their places."""
    read_columns(theta, first, start, count, rods, (start + 1) * ROW + ANGLE, ROW, LANES)
    read_columns(omega, first, start, count, rods, (start + 1) * ROW + RATE, ROW, LANES)


@inlined
def eliminate_rod(lane: Any, rod: Any, above: Any, mass: float, length: float) -> None:
    """The upward step of one rod in every lane."""
    wide_vectors()
    for i in range(LANES):
        angle, rate = rod[ANGLE + i], rod[RATE + i]
        rate_squared = rate * rate
        lane[SIZE + i] += size(angle, rate_squared)
        high, low = difference(angle, above[ANGLE + i])
        s, co = sincos(high, low)
        w = length * rate_squared
        a, b, c, p, q, kappa_tau, kappa_b, kappa_m6 = absorb_rod(
            mass, w, lane[A + i], lane[B + i], lane[C + i], lane[D + i], lane[P + i], lane[Q + i]
        )
        a, b, c, d, p, q = turn(s, co, a, b, c, p, q)
        lane[A + i], lane[B + i], lane[C + i], lane[D + i], lane[P + i], lane[Q + i] = a, b, c, d, p, q
        rod[SIN + i], rod[COS + i], rod[RATE + i] = s, co, w
        rod[TAU + i], rod[KB + i], rod[KM + i] = kappa_tau, kappa_b, kappa_m6


@inlined
def accelerate_rod(lane: Any, rod: Any, inverse_length: float) -> None:
    """The downward step of one rod in every lane; θ'' is left in ANGLE."""
    wide_vectors()
    for i in range(LANES):
        moved, along, across = rod_acceleration(
            rod[SIN + i],
            rod[COS + i],
            rod[RATE + i],
            rod[TAU + i],
            rod[KB + i],
            rod[KM + i],
            lane[P + i],
            lane[Q + i],
        )
        rod[ANGLE + i] = moved * inverse_length
        lane[P + i], lane[Q + i] = along, across


@inlined
def refine(lane: Any, rods: Any, motion: Any, masses: Any) -> None:
    """From the motion to the residuals of every lane and rod; leaves P, Q ready for :func:`correct_rod`."""
    for j in range(masses.size):
        keep_motion(lane, rods[(j + 1) * ROW : (j + 2) * ROW], motion[j * KEPT : (j + 1) * KEPT])
    for i in range(LANES):
        lane[ALONG_T + i], lane[ACROSS_T + i], lane[P + i], lane[Q + i] = 0.0, 0.0, 0.0, 0.0
    for j in range(masses.size - 1, -1, -1):
        eliminate_residual(lane, rods[(j + 1) * ROW : (j + 2) * ROW], motion[j * KEPT : (j + 1) * KEPT], masses[j])
    for i in range(LANES):
        lane[P + i], lane[Q + i] = 0.0, 0.0


@inlined
def keep_motion(lane: Any, rod: Any, kept: Any) -> None:
    """The downward step of one rod in every lane, keeping a_{j-1} and lθ''."""
    wide_vectors()
    for i in range(LANES):
        kept[ALONG + i], kept[ACROSS + i] = turn_down(rod[SIN + i], rod[COS + i], lane[P + i], lane[Q + i])
        kept[MOVED + i], lane[P + i], lane[Q + i] = rod_acceleration(
            rod[SIN + i],
            rod[COS + i],
            rod[RATE + i],
            rod[TAU + i],
            rod[KB + i],
            rod[KM + i],
            lane[P + i],
            lane[Q + i],
        )


@inlined
def eliminate_residual(lane: Any, rod: Any, kept: Any, mass: float) -> None:
    """The upward step of the correction of one rod in every lane."""
    wide_vectors()
    for i in range(LANES):
        s, co, a, b, x = rod[SIN + i], rod[COS + i], kept[ALONG + i], kept[ACROSS + i], kept[MOVED + i]
        delta = moment_residual(mass, b, x, lane[ACROSS_T + i])
        p, q, rod[TAU + i] = absorb_residual(mass, delta, rod[KB + i], rod[KM + i], lane[P + i], lane[Q + i])
        lane[P + i], lane[Q + i] = turn_up(s, co, p, q)
        along, across = force_above(mass, rod[RATE + i], a, b, x, lane[ALONG_T + i], lane[ACROSS_T + i])
        lane[ALONG_T + i], lane[ACROSS_T + i] = turn_up(s, co, along, across)


@inlined
def correct_rod(lane: Any, rod: Any, kept: Any, inverse_length: float) -> None:
    """The downward step of the correction of one rod in every lane; θ'' is left in ANGLE."""
    wide_vectors()
    for i in range(LANES):
        more, along, across = rod_acceleration(
            rod[SIN + i], rod[COS + i], 0.0, rod[TAU + i], rod[KB + i], rod[KM + i], lane[P + i], lane[Q + i]
        )
        rod[ANGLE + i] = (kept[MOVED + i] + more) * inverse_length
        lane[P + i], lane[Q + i] = along, across


@merged
def legs_block(
    theta: Any, omega: Any, out: Any, first: int, masses: Any, lengths: Any, gravity: float, scratch: Any
) -> int:
    """θ'' of an N-leg pendulum in LEG_LANES states from the first on."""
    wide_vectors()
    n = masses.size
    lane, legs = scratch[:FIRST_STATE], scratch[FIRST_STATE:]  # first in legs: the first link
    for start in range(0, n, 8):
        count = min(8, n - start)
        read_columns(theta, first, start, count, legs, start * LEG + LEG_ANGLE, LEG, LEG_LANES)
        read_columns(omega, first, start, count, legs, start * LEG + LEG_RATE, LEG, LEG_LANES)
        for j in range(start, start + count):
            if n <= SHORT:
                fetch_block(theta, omega, out, first + LEG_LANES, j, LEG_LANES)
            leg = legs[j * LEG : (j + 1) * LEG]
            if j == 0:
                begin_sums(lane, leg, masses[0], lengths[0], gravity)
            else:
                add_leg(lane, leg, masses[j], lengths[j])
    accelerate_first(lane, legs[:LEG], lengths[0], gravity)
    for start in range(0, n, 8):
        count = min(8, n - start)
        for j in range(max(start, 1), start + count):
            accelerate_leg(lane, legs[j * LEG : (j + 1) * LEG], 1.0 / lengths[j])
        write_columns(legs, start * LEG + LEG_ANGLE, LEG, out, first, start, count, LEG_LANES)
    return any_suspicious(lane[LEG_SIZE : LEG_SIZE + LEG_LANES])


@inlined
def begin_sums(lane: Any, link: Any, mass: float, length: float, gravity: float) -> None:
    """h, sin θ1 and the first terms of both sums in every lane."""
    wide_vectors()
    for i in range(LEG_LANES):
        angle, rate = link[LEG_ANGLE + i], link[LEG_RATE + i]
        rate_squared = rate * rate
        s, c = sincos(angle, 0.0)
        lane[FIRST + i], lane[SIN1 + i], lane[H + i] = angle, s, gravity * c + length * rate_squared
        lane[LOAD + i], lane[INERTIA + i], lane[LEG_SIZE + i] = 0.0, mass, size(angle, rate_squared)


@inlined
def add_leg(lane: Any, leg: Any, mass: float, length: float) -> None:
    """One leg's terms of both sums in every lane."""
    wide_vectors()
    for i in range(LEG_LANES):
        angle, rate = leg[LEG_ANGLE + i], leg[LEG_RATE + i]
        rate_squared = rate * rate
        lane[LEG_SIZE + i] += size(angle, rate_squared)
        high, low = difference(lane[FIRST + i], angle)
        s, c = sincos(high, low)
        load, inertia = leg_terms(mass, length * rate_squared, lane[H + i], s, c)
        lane[LOAD + i] += load
        lane[INERTIA + i] += inertia
        leg[LEG_SIN + i], leg[LEG_COS + i] = s, c


@inlined
def accelerate_first(lane: Any, link: Any, length: float, gravity: float) -> None:
    """G, left in LOAD, and θ1'', left in LEG_ANGLE, in every lane."""
    for i in range(LEG_LANES):
        lane[LOAD + i] = -lane[LOAD + i] / lane[INERTIA + i]
        link[LEG_ANGLE + i] = (lane[LOAD + i] - gravity * lane[SIN1 + i]) / length


@inlined
def accelerate_leg(lane: Any, leg: Any, inverse_length: float) -> None:
    """θi'', left in LEG_ANGLE, in every lane."""
    wide_vectors()
    for i in range(LEG_LANES):
        leg[LEG_ANGLE + i] = (lane[H + i] * leg[LEG_SIN + i] - leg[LEG_COS + i] * lane[LOAD + i]) * inverse_length
