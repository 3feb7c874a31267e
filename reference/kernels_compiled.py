"""The elimination of :mod:`.elimination` in compiled form: one state, and many states in lanes.

The batch kernels take states a row each, as numpy has them, and work on blocks of LANES states, one state a vector
lane. What makes a compiler vectorise them: loops of a length known beforehand, one flat scratch array whose parts lie
at constant offsets (many arrays mean many checks for overlap, and LLVM gives up), columns gathered in loops of their
own.
A last block that is not full repeats its last state, so that a state's result does not depend on its neighbours.

Status: 0, or 1 where an angle or rate is not finite or beyond what the kernels hold for, or their number is wrong.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import elimination
from .compiling import called, compiled, inlined, prefetch, wide_vectors
from .limits import LARGEST_ANGLE, LARGEST_RATE
from .sincos import sincos

difference = inlined(elimination.difference)
absorb_rod = inlined(elimination.absorb_rod)
turn = inlined(elimination.turn)
swing_rod = inlined(elimination.swing_rod)
turn_up = inlined(elimination.turn_up)
turn_down = inlined(elimination.turn_down)
force_above = inlined(elimination.force_above)
missing = inlined(elimination.missing)
absorb_missing = inlined(elimination.absorb_missing)
pull_of_leg = inlined(elimination.pull_of_leg)

LANES = 64
A, B, C, D, P, Q, ANGLE, ABOVE, BAD = (k * LANES for k in range(9))  # of each lane
STATE = 9 * LANES
SIN, COS, RATE, TAU, KB, KM = (k * LANES for k in range(6))  # of each lane and rod
ROW = 6 * LANES
ALONG, ACROSS, MOVED = (k * LANES for k in range(3))  # of each lane and rod, for the refinement
KEPT = 3 * LANES


@inlined
def fetch_ahead(theta: Any, omega: Any, out: Any, row: int, part: int) -> None:
    """Bring one part of the next block, LANES numbers of each array, near the processor.

    The columns of a block lie far apart in memory; without this every line of it would be waited for.
    """
    start = row * theta.shape[1] + part * LANES
    for i in range(0, LANES, 8):
        prefetch(theta, start + i)
        prefetch(omega, start + i)
        prefetch(out, start + i)


@inlined
def outside(theta: float, omega: float) -> float:
    """1 where a kernel cannot take the state, NaN included; else 0."""
    return 0.0 if abs(theta) <= LARGEST_ANGLE and abs(omega) <= LARGEST_RATE else 1.0


@inlined
def any_marked(lane: Any) -> int:
    """1 if any of the numbers is above zero."""
    found = 0
    for i in range(LANES):
        found |= 1 if lane[i] > 0.0 else 0
    return found


@compiled(releases_gil=False)
def rods_single(theta: Any, omega: Any, out: Any, table: Any) -> int:
    """θ'' of a rod chain in one state, shape (n,) each; table: see :func:`.kernels.table`."""
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
        row[10], along, across = swing_rod(row[2], row[3], row[4], row[5], row[6], row[7], along, across)
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
        delta = missing(row[0], row[9], row[10], across)
        p, q, row[5] = absorb_missing(row[0], delta, row[6], row[7], p, q)
        p, q = turn_up(row[2], row[3], p, q)
        along, across = force_above(row[0], row[4], row[8], row[9], row[10], along, across)
        along, across = turn_up(row[2], row[3], along, across)
    along = across = 0.0
    for j in range(n):
        row = table[j]
        more, along, across = swing_rod(row[2], row[3], 0.0, row[5], row[6], row[7], along, across)
        row[10] += more


@compiled(releases_gil=False)
def legs_single(theta: Any, omega: Any, out: Any, table: Any) -> int:
    """θ'' of an N-leg pendulum in one state, shape (n,) each; table: see :func:`.kernels.table`."""
    n = len(table) - 1
    if theta.size != n or omega.size != n:
        return 1
    gravity = table[n, 0]
    bad = outside(theta[0], omega[0])
    s1, c1 = sincos(theta[0], 0.0)
    h = gravity * c1 + table[0, 1] * omega[0] * omega[0]
    pull, inertia = 0.0, table[0, 0]
    for i in range(1, n):
        bad += outside(theta[i], omega[i])
        row = table[i]
        high, low = difference(theta[0], theta[i])
        s, c = sincos(high, low)
        more_pull, more_inertia = pull_of_leg(row[0], row[1] * omega[i] * omega[i], h, s, c)
        pull += more_pull
        inertia += more_inertia
        row[2], row[3] = s, c
    drag = -pull / inertia
    out[0] = (drag - gravity * s1) / table[0, 1]
    for i in range(1, n):
        row = table[i]
        out[i] = (h * row[2] - row[3] * drag) / row[1]
    return 1 if bad > 0.0 else 0


@compiled(releases_gil=True)
def rods_batch(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float, refined: bool) -> int:
    """θ'' of a rod chain in many states, shape (B, n) each."""
    wide_vectors()
    batch, n = theta.shape
    scratch = np.empty(STATE + n * ROW)
    lane = scratch[:STATE]
    motion = np.empty(n * KEPT if refined else 0)
    status = 0
    for first in range(0, batch, LANES):
        angles, rates = block(theta, first), block(omega, first)
        for i in range(STATE):
            lane[i] = 0.0
        gather(angles, n - 1, lane[ANGLE : ANGLE + LANES])
        for j in range(n - 1, -1, -1):
            rod = scratch[STATE + j * ROW : STATE + (j + 1) * ROW]
            fetch_ahead(theta, omega, out, first + LANES, n - 1 - j)
            gather(rates, j, rod[RATE : RATE + LANES])
            if j > 0:
                gather(angles, j - 1, lane[ABOVE : ABOVE + LANES])
            else:
                for i in range(LANES):
                    lane[ABOVE + i] = 0.0
            eliminate_rod(lane, rod, masses[j], lengths[j])
        for i in range(LANES):
            lane[P + i], lane[Q + i] = -gravity, 0.0
        if refined:
            refine(lane, scratch, motion, masses)
        for j in range(n):
            rod = scratch[STATE + j * ROW : STATE + (j + 1) * ROW]
            if refined:
                correct_rod(lane, rod, motion[j * KEPT : (j + 1) * KEPT], 1.0 / lengths[j])
            else:
                accelerate_rod(lane, rod, 1.0 / lengths[j])
            scatter(lane[ANGLE : ANGLE + LANES], out, first, min(LANES, batch - first), j)
        status |= any_marked(lane[BAD : BAD + LANES])
    return status


@inlined
def eliminate_rod(lane: Any, rod: Any, mass: float, length: float) -> None:
    """The upward step of one rod in every lane."""
    wide_vectors()
    for i in range(LANES):
        angle, rate = lane[ANGLE + i], rod[RATE + i]
        lane[BAD + i] += outside(angle, rate)
        high, low = difference(angle, lane[ABOVE + i])
        lane[ANGLE + i] = lane[ABOVE + i]
        s, co = sincos(high, low)
        w = length * rate * rate
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
        moved, along, across = swing_rod(
            rod[SIN + i],
            rod[COS + i],
            rod[RATE + i],
            rod[TAU + i],
            rod[KB + i],
            rod[KM + i],
            lane[P + i],
            lane[Q + i],
        )
        lane[ANGLE + i] = moved * inverse_length
        lane[P + i], lane[Q + i] = along, across


@inlined
def refine(lane: Any, scratch: Any, motion: Any, masses: Any) -> None:
    """From the motion to what is missing in every lane and rod; leaves P, Q ready for :func:`correct_rod`."""
    for j in range(masses.size):
        rod = scratch[STATE + j * ROW : STATE + (j + 1) * ROW]
        keep_motion(lane, rod, motion[j * KEPT : (j + 1) * KEPT])
    for i in range(LANES):
        lane[A + i], lane[B + i], lane[P + i], lane[Q + i] = 0.0, 0.0, 0.0, 0.0
    for j in range(masses.size - 1, -1, -1):
        rod = scratch[STATE + j * ROW : STATE + (j + 1) * ROW]
        eliminate_missing(lane, rod, motion[j * KEPT : (j + 1) * KEPT], masses[j])
    for i in range(LANES):
        lane[P + i], lane[Q + i] = 0.0, 0.0


@inlined
def keep_motion(lane: Any, rod: Any, kept: Any) -> None:
    """The downward step of one rod in every lane, keeping a_{j-1} and lθ''."""
    wide_vectors()
    for i in range(LANES):
        kept[ALONG + i], kept[ACROSS + i] = turn_down(rod[SIN + i], rod[COS + i], lane[P + i], lane[Q + i])
        kept[MOVED + i], lane[P + i], lane[Q + i] = swing_rod(
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
def eliminate_missing(lane: Any, rod: Any, kept: Any, mass: float) -> None:
    """The upward step of the correction of one rod in every lane; T_j stands in A, B."""
    wide_vectors()
    for i in range(LANES):
        s, co, a, b, x = rod[SIN + i], rod[COS + i], kept[ALONG + i], kept[ACROSS + i], kept[MOVED + i]
        delta = missing(mass, b, x, lane[B + i])
        p, q, rod[TAU + i] = absorb_missing(mass, delta, rod[KB + i], rod[KM + i], lane[P + i], lane[Q + i])
        lane[P + i], lane[Q + i] = turn_up(s, co, p, q)
        along, across = force_above(mass, rod[RATE + i], a, b, x, lane[A + i], lane[B + i])
        lane[A + i], lane[B + i] = turn_up(s, co, along, across)


@inlined
def correct_rod(lane: Any, rod: Any, kept: Any, inverse_length: float) -> None:
    """The downward step of the correction of one rod in every lane; θ'' is left in ANGLE."""
    wide_vectors()
    for i in range(LANES):
        more, along, across = swing_rod(
            rod[SIN + i], rod[COS + i], 0.0, rod[TAU + i], rod[KB + i], rod[KM + i], lane[P + i], lane[Q + i]
        )
        lane[ANGLE + i] = (kept[MOVED + i] + more) * inverse_length
        lane[P + i], lane[Q + i] = along, across


@inlined
def block(states: Any, first: int) -> Any:
    """The LANES states from the first on; where fewer are left, a copy that repeats the last."""
    left = states.shape[0] - first
    if left >= LANES:
        return states[first : first + LANES]
    filled = np.empty((LANES, states.shape[1]))
    for i in range(LANES):
        filled[i] = states[first + min(i, left - 1)]
    return filled


@inlined
def gather(states: Any, column: int, lane: Any) -> None:
    """One column of a block of states into consecutive places."""
    for i in range(LANES):
        lane[i] = states[i, column]


@inlined
def scatter(lane: Any, states: Any, first: int, count: int, column: int) -> None:
    """Consecutive places into one column of a block of states."""
    if count == LANES:
        full = states[first : first + LANES]
        for i in range(LANES):
            full[i, column] = lane[i]
    else:
        for i in range(count):
            states[first + i, column] = lane[i]


LEG_SIN, LEG_COS = 0, LANES  # of each lane and leg
LEG = 2 * LANES
FIRST, H, PULL, INERTIA, SIN1, X, Y, WRONG = (k * LANES for k in range(8))  # of each lane
FIRST_STATE = 8 * LANES
FEW_LEGS = 48  # up to here lanes are states; from here on the legs of one state fill the lanes better


@compiled(releases_gil=True)
def legs_batch(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float, _refined: bool) -> int:
    """θ'' of an N-leg pendulum in many states, shape (B, n) each."""
    wide_vectors()
    batch, n = theta.shape
    status = 0
    if n > FEW_LEGS:
        scratch = np.empty((4, n))
        for first in range(batch):
            status |= many_legs(theta[first], omega[first], out[first], masses, lengths, gravity, scratch)
        return status
    scratch = np.empty(FIRST_STATE + n * LEG)
    lane = scratch[:FIRST_STATE]
    for first in range(0, batch, LANES):
        count = min(LANES, batch - first)
        angles, rates = block(theta, first), block(omega, first)
        gather(angles, 0, lane[FIRST : FIRST + LANES])
        gather(rates, 0, lane[H : H + LANES])
        hang_first(lane, masses[0], lengths[0], gravity)
        for j in range(1, n):
            fetch_ahead(theta, omega, out, first + LANES, j - 1)
            gather(angles, j, lane[X : X + LANES])
            gather(rates, j, lane[Y : Y + LANES])
            add_leg(lane, scratch[FIRST_STATE + j * LEG : FIRST_STATE + (j + 1) * LEG], masses[j], lengths[j])
        accelerate_first(lane, lengths[0], gravity)
        scatter(lane[SIN1 : SIN1 + LANES], out, first, count, 0)
        for j in range(1, n):
            accelerate_leg(lane, scratch[FIRST_STATE + j * LEG : FIRST_STATE + (j + 1) * LEG], 1.0 / lengths[j])
            scatter(lane[X : X + LANES], out, first, count, j)
        status |= any_marked(lane[WRONG : WRONG + LANES])
    return status


@inlined
def hang_first(lane: Any, mass: float, length: float, gravity: float) -> None:
    """h, sin θ1 and the first terms of both sums in every lane; H holds ω1 before."""
    wide_vectors()
    for i in range(LANES):
        rate = lane[H + i]
        lane[WRONG + i] = outside(lane[FIRST + i], rate)
        s, c = sincos(lane[FIRST + i], 0.0)
        lane[SIN1 + i] = s
        lane[H + i] = gravity * c + length * rate * rate
        lane[PULL + i], lane[INERTIA + i] = 0.0, mass


@inlined
def add_leg(lane: Any, leg: Any, mass: float, length: float) -> None:
    """One leg's terms of both sums in every lane; X and Y hold its θ and ω."""
    wide_vectors()
    for i in range(LANES):
        angle, rate = lane[X + i], lane[Y + i]
        lane[WRONG + i] += outside(angle, rate)
        high, low = difference(lane[FIRST + i], angle)
        s, c = sincos(high, low)
        pull, inertia = pull_of_leg(mass, length * rate * rate, lane[H + i], s, c)
        lane[PULL + i] += pull
        lane[INERTIA + i] += inertia
        leg[LEG_SIN + i], leg[LEG_COS + i] = s, c


@inlined
def accelerate_first(lane: Any, length: float, gravity: float) -> None:
    """G, left in PULL, and θ1'', left in SIN1, in every lane."""
    for i in range(LANES):
        lane[PULL + i] = -lane[PULL + i] / lane[INERTIA + i]
        lane[SIN1 + i] = (lane[PULL + i] - gravity * lane[SIN1 + i]) / length


@inlined
def accelerate_leg(lane: Any, leg: Any, inverse_length: float) -> None:
    """θi'', left in X, in every lane."""
    wide_vectors()
    for i in range(LANES):
        lane[X + i] = (lane[H + i] * leg[LEG_SIN + i] - leg[LEG_COS + i] * lane[PULL + i]) * inverse_length


@inlined
def many_legs(theta: Any, omega: Any, out: Any, masses: Any, lengths: Any, gravity: float, scratch: Any) -> int:
    """θ'' of an N-leg pendulum in one state, its legs in the lanes; scratch: (4, n)."""
    wide_vectors()
    sines, cosines, pulls, inertias = scratch[0], scratch[1], scratch[2], scratch[3]
    s1, c1 = sincos(theta[0], 0.0)
    h = gravity * c1 + lengths[0] * omega[0] * omega[0]
    wrong = 0
    for i in range(theta.size):
        wrong |= 0 if abs(theta[i]) <= LARGEST_ANGLE and abs(omega[i]) <= LARGEST_RATE else 1
    for i in range(theta.size):
        high, low = difference(theta[0], theta[i])
        s, c = sincos(high, low)
        sines[i], cosines[i] = s, c
        pulls[i], inertias[i] = pull_of_leg(masses[i], lengths[i] * omega[i] * omega[i], h, s, c)
    drag = -total(pulls) / (masses[0] + total(inertias))
    for i in range(theta.size):
        out[i] = (h * sines[i] - cosines[i] * drag) / lengths[i]
    out[0] = (drag - gravity * s1) / lengths[0]
    return wrong


@inlined
def total(terms: Any) -> float:
    """Sum of all terms but the first, in eight parts."""
    a = b = c = d = e = f = g = h = 0.0
    whole = 1 + (terms.size - 1) // 8 * 8
    for i in range(1, whole, 8):
        a += terms[i]
        b += terms[i + 1]
        c += terms[i + 2]
        d += terms[i + 3]
        e += terms[i + 4]
        f += terms[i + 5]
        g += terms[i + 6]
        h += terms[i + 7]
    for i in range(whole, terms.size):
        a += terms[i]
    return ((a + b) + (c + d)) + ((e + f) + (g + h))
