"""One Taylor step of either system in compiled form, and the run of one trajectory from output time to output time.

The derivation is in :mod:`.taylor`. The step is written for numbers and for vectors of eight alike
(:mod:`furiko.reference.kernels.vector`): here a row holds one number a link, padded to whole vectors; in
:mod:`.taylor_lanes` it holds a vector a link, one trajectory a lane.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..kernels import elimination
from ..kernels.compiling import aligned, bits, called, compiled, inlined, merged, wide_vectors
from ..kernels.sincos import sincos
from ..kernels.sine import ROUNDER
from ..kernels.sizes import EIGHT
from ..kernels.vector import fma, load, store
from .convolution import COSINE, FP, FQ, OMEGA, SERIES, SINE, WP, WQ, R, convolve_eight
from .layout import (
    ACROSS_R,
    ACROSS_W,
    ANGLE,
    ANGLE_LOW,
    BROKEN,
    COS,
    DONE,
    FACTORS,
    GRAVITY,
    INVERSE,
    KAPPA,
    KB,
    KC,
    KM,
    LENGTH,
    M12,
    M22,
    MASS,
    MORE,
    RATE,
    RATE_LOW,
    SIN,
    TURNS,
    UP_W,
    WP_R,
    A,
    B,
)

absorb_rod = inlined(elimination.absorb_rod)
turn = inlined(elimination.turn)
two_difference = inlined(elimination.difference)

MOST_STEPS = 1e11  # to one output: days of work; more is probably a wrong unit
TWO_PI, TWO_PI_LOW = 6.283185307179586, 2.4492935982947064e-16
TURNS_A_RADIAN = 0.15915494309189535
# rows of what one order of the series needs: WP, WQ, R of the convolution, then
BETA_P, TAU, ORDER = 3, 4, 5


@inlined
def two_sum(a: Any, b: Any) -> Any:
    """a + b and its rounding error."""
    return two_difference(a, -b)


@inlined
def store_sincos(factors: Any, high: Any, low: Any) -> None:
    """Sine and cosine of high + low into a link's factors."""
    s, c = sincos(high, low)
    store(factors, SIN, s)
    store(factors, COS, c)


@inlined
def store_relative(factors: Any, link: Any, other: Any) -> None:
    """Sine and cosine of a link's angle less another's, low parts included, into a link's factors."""
    high, low = two_difference(load(link, ANGLE), load(other, ANGLE))
    store_sincos(factors, high, low + (load(link, ANGLE_LOW) - load(other, ANGLE_LOW)))


@inlined
def factor_rods(state: Any, factors: Any) -> None:
    """Everything of the elimination that all orders of a step share."""
    a = b = c = d = load(state[0], ANGLE) * 0.0
    for j in range(len(factors) - 1, -1, -1):
        f = factors[j]
        if j > 0:
            store_relative(f, state[j], state[j - 1])
        else:
            store_sincos(f, load(state[0], ANGLE), load(state[0], ANGLE_LOW))
        m, s, co = load(f, MASS), load(f, SIN), load(f, COS)
        kappa = 1.0 / (m / 3.0 + c)
        kb, km = kappa * b, kappa * (m / 6.0)
        store(f, A, a)
        store(f, B, b)
        store(f, KAPPA, kappa)
        store(f, KC, kappa * c)
        store(f, KB, kb)
        store(f, KM, km)
        store(f, UP_W, kappa * (a * (m / 3.0) + d) + m / 2.0)
        store(f, ACROSS_W, kappa * (m * (m / 6.0 + c / 3.0)))
        store(f, ACROSS_R, kappa * (m / 2.0 + c))
        store(f, WP_R, km * b)
        store(f, M12, s * km - co * kb)
        store(f, M22, -(s * kb + co * km))
        a, b, c, _p, _q, _t, _kb, _km = absorb_rod(m, 0.0, a, b, c, d, 0.0, 0.0)
        a, b, c, d, _p, _q = turn(s, co, a, b, c, 0.0, 0.0)


@called
def solve_rods(order: int, factors: Any, part: Any, series: Any) -> None:
    """One order of lθ'' and F, and with it the next orders of ω, sine and cosine."""
    wp, wq, r, beta_p, tau = part[WP], part[WQ], part[R], part[BETA_P], part[TAU]
    fp, fq = series[FP, order], series[FQ, order]
    nothing = load(wp, 0) * 0.0
    p, q = nothing, nothing
    for j in range(len(factors) - 1, -1, -1):
        f = factors[j]
        s, c, kb, m = load(f, SIN), load(f, COS), load(f, KB), load(f, MASS)
        weight = load(f, LENGTH) * (order + 1.0)
        w_p, w_q, r_j = -weight * load(wp, j), weight * load(wq, j), load(r, j)
        store(wp, j, w_p)
        store(wq, j, w_q)
        store(beta_p, j, p)
        store(tau, j, load(f, KAPPA) * (r_j - q) - kb * w_p - load(f, KC) * w_q)
        own_p = load(f, UP_W) * w_p + kb * ((m / 3.0) * w_q + r_j)
        own_q = load(f, ACROSS_R) * r_j + load(f, ACROSS_W) * w_q - load(f, WP_R) * w_p
        p, q = (
            (c * own_p - s * own_q) + c * p + load(f, M12) * q,
            (s * own_p + c * own_q) + s * p + load(f, M22) * q,
        )
    p, q = nothing, nothing
    if order == 0:
        p = -load(factors[0], GRAVITY)
    once, twice = 1.0 / (order + 1.0), 1.0 / ((order + 1.0) * (order + 2.0))
    for j in range(len(factors)):
        f = factors[j]
        s, c, m = load(f, SIN), load(f, COS), load(f, MASS)
        w_p, w_q, tau_j = load(wp, j), load(wq, j), load(tau, j)
        a = c * p + s * q
        b = c * q - s * p
        p, q = (
            w_p + c * p + s * q,
            (tau_j + w_q) + load(f, M12) * p + load(f, M22) * q,
        )
        moved = tau_j - load(f, KB) * a - load(f, KM) * b
        x = moved - b
        store(fq, j, (m / 3.0) * x - load(r, j))
        store(fp, j, -((m / 2.0) * a + load(f, A) * (a + w_p) + (load(f, B) * (moved + w_q) + load(beta_p, j))))
        extend(series, order, j, load(f, INVERSE), once, twice, x, w_p, w_q)


@inlined
def extend(series: Any, order: int, j: int, inverse: Any, once: float, twice: float, x: Any, wp: Any, wq: Any) -> None:
    """ω_{k+1} from lθ''_k = x, and c_{k+2}, s_{k+2} from c' = -s ω, s' = c ω; inverse: 1/l, once: 1/(k+1), …"""
    store(series[OMEGA, order + 1], j, x * (inverse * once))
    store(series[COSINE, order + 2], j, wp * (inverse * twice))
    store(series[SINE, order + 2], j, (x + wq) * (inverse * twice))


@inlined
def factor_legs(state: Any, factors: Any) -> None:
    """Sines and cosines of θ1 - θi, the pivot m1 + Σ m S² in KAPPA, and g e_y in frame 1 in A, B of link 1."""
    first = factors[0]
    store_sincos(first, load(state[0], ANGLE), load(state[0], ANGLE_LOW))
    store(first, A, -load(first, GRAVITY) * load(first, COS))
    store(first, B, load(first, GRAVITY) * load(first, SIN))
    pivot = load(first, MASS)
    for i in range(1, len(state)):
        f = factors[i]
        store_relative(f, state[0], state[i])
        s = load(f, SIN)
        pivot += load(f, MASS) * s * s
    store(first, KAPPA, pivot)


@called
def solve_legs(order: int, factors: Any, part: Any, series: Any) -> None:
    """One order of lθ'', of A (legs) and Φ (link 1), and with it the next orders of ω, sine and cosine."""
    wp, wq, r = part[WP], part[WQ], part[R]
    fp, fq = series[FP, order], series[FQ, order]
    for i in range(len(factors)):
        weight = load(factors[i], LENGTH) * (order + 1.0)
        store(wp, i, -weight * load(wp, i))
        store(wq, i, weight * load(wq, i))
    first = factors[0]
    along, across = load(wp, 0), load(wq, 0)
    if order == 0:
        along, across = along + load(first, A), across + load(first, B)
    total = load(r, 0)
    for i in range(1, len(factors)):
        f = factors[i]
        s, c = load(f, SIN), load(f, COS)
        total += load(f, MASS) * (c * (load(wq, i) - load(r, i)) - s * (c * along + load(wp, i)))
    G = -total / load(first, KAPPA)
    force = load(first, MASS) * along
    once, twice = 1.0 / (order + 1.0), 1.0 / ((order + 1.0) * (order + 2.0))
    for i in range(1, len(factors)):
        f = factors[i]
        s, c, w_p, w_q, r_i = load(f, SIN), load(f, COS), load(wp, i), load(wq, i), load(r, i)
        ahead, aside = c * along - s * G, s * along + c * G
        store(fp, i, ahead)
        store(fq, i, aside)
        force += load(f, MASS) * (c * (ahead + w_p) + s * (w_q - r_i))
        extend(series, order, i, load(f, INVERSE), once, twice, -aside - r_i, w_p, w_q)
    store(fp, 0, force)
    store(fq, 0, -load(r, 0))
    extend(series, order, 0, load(first, INVERSE), once, twice, G - across, load(wp, 0), load(wq, 0))


@inlined
def expand(factor: Any, solve: Any, state: Any, top: int, factors: Any, part: Any, series: Any) -> None:
    """The series of ω, and of sine and cosine of each link's turn, to order ``top``."""
    wide_vectors()
    factor(state, factors)
    for j in range(len(factors)):
        rate = load(state[j], RATE)
        store(series[OMEGA, 0], j, rate)
        store(series[SINE, 1], j, rate)
        store(series[SINE, 0], j, 0.0)
        store(series[COSINE, 0], j, 1.0)
        store(series[COSINE, 1], j, 0.0)
    columns = part[0].size
    for k in range(top):
        for first in range(0, columns, EIGHT):
            convolve_eight(series, k, first, part)
        solve(k, factors, part, series)


@inlined
def largest(row: Any) -> float:
    """Largest magnitude in a row; not a number where one of them is infinite or none."""
    found = unsound = 0.0
    for e in range(row.size):
        found = max(found, abs(row[e]))
        unsound += 0.0 * row[e]
    return found + unsound


@called
def step_size(
    first: float, second: float, third: float, last_but_one: float, last: float, top: int, local: float
) -> float:
    """The step at which each of the last two terms of ω is ``local`` of the largest of its first three.

    From the largest coefficients of each over all links. Not a number where one is not finite.
    """
    step = math.inf
    below = rough_log2(local)
    starts = rough_log2(first) + below, rough_log2(second) + below, rough_log2(third) + below
    for order, size in ((top - 1, last_but_one), (top, last)):
        if size != 0.0:
            end = rough_log2(size)
            reach = max((starts[0] - end) / order, (starts[1] - end) / (order - 1), (starts[2] - end) / (order - 2))
            step = min(step, reach)
    unsound = 0.0 * (((first + second) + (third + last_but_one)) + last)
    return math.exp2(step) + unsound


@inlined
def rough_log2(x: float) -> float:
    """log2 of a positive number to within 0.09, which is little in the root that a step is: its bits as a number."""
    logarithm: float = bits(x) * 2.220446049250313e-16 - 1023.0
    return logarithm


@called
def moved_on(omega: Any, state: Any, j: int, top: int, h: Any) -> Any:
    """Angle and rate of one link after h, each as a sum of two numbers: only the small terms are rounded."""
    row = state[j]
    rate = load(omega[top], j)
    angle = rate * (1.0 / (top + 1.0))
    for k in range(top - 1, 0, -1):
        term = load(omega[k], j)
        rate = term + h * rate
        angle = term * (1.0 / (k + 1.0)) + h * angle
    travel = h * load(row, RATE)
    high, low = two_sum(load(row, ANGLE), travel)
    low += load(row, ANGLE_LOW) + (h * (h * angle + load(row, RATE_LOW)) + fma(h, load(row, RATE), -travel))
    angle_high, angle_low = two_sum(high, low)
    gain = h * rate
    high, low = two_sum(load(row, RATE), gain)
    rate_high, rate_low = two_sum(high, low + (load(row, RATE_LOW) + fma(h, rate, -gain)))
    return angle_high, angle_low, rate_high, rate_low


@inlined
def advance(omega: Any, state: Any, j: int, top: int, h: Any) -> None:
    """Take one link h further, and its angle to within half a turn, exactly."""
    angle, low, rate, rate_low = moved_on(omega, state, j, top, h)
    row = state[j]
    store(row, RATE, rate)
    store(row, RATE_LOW, rate_low)
    wrap(row, angle, low)


@inlined
def wrap(row: Any, angle: Any, low: Any) -> None:
    """Store an angle within half a turn, and count the turns taken off it; without a branch."""
    turns = fma(angle, TURNS_A_RADIAN, ROUNDER) - ROUNDER
    whole = turns * TWO_PI
    high, rest = two_sum(angle - whole, -fma(turns, TWO_PI, -whole))
    angle, low = two_sum(high, rest + (low - turns * TWO_PI_LOW))
    store(row, ANGLE, angle)
    store(row, ANGLE_LOW, low)
    store(row, TURNS, load(row, TURNS) + turns)


@inlined
def unwrapped(high: float, low: float, turns: float) -> float:
    """The angle with its whole turns."""
    whole = turns * TWO_PI
    total, rest = two_sum(whole, high)
    angle: float = total + (rest + (low + (fma(turns, TWO_PI, -whole) + turns * TWO_PI_LOW)))
    return angle


@compiled(releases_gil=True)
def start(theta: Any, omega: Any, state: Any) -> None:
    """Write the state of one trajectory, shape (n,) each, into a ``state`` of zeros of shape (n, STATE)."""
    for j in range(theta.size):
        state[j, RATE] = omega[j]
        wrap(state[j], theta[j], 0.0)


@compiled(releases_gil=True)
def run_rods(*given: Any) -> int:
    """:func:`run` of a rod chain."""
    return run(factor_rods, solve_rods, given)


@compiled(releases_gil=True)
def run_legs(*given: Any) -> int:
    """:func:`run` of an N-leg pendulum."""
    return run(factor_legs, solve_legs, given)


@merged
def run(factor: Any, solve: Any, given: Any) -> int:
    """Advance one trajectory until its last output is written (DONE) or ``budget`` steps are spent (MORE).

    BROKEN: the rates are such that the steps are too short ever to get there.

    ``top``: order of the series; ``local``: size of its last terms; ``state``: from :func:`start`; ``clock``: the time
    as a sum of two numbers; ``counts``: outputs written and steps taken; out_theta, out_omega: (len(times), n).
    All of them are kept between calls.
    """
    masses, lengths, gravity, times, top, local, state, clock, counts, out_theta, out_omega, budget = given
    n = len(masses)
    width = (n + EIGHT - 1) // EIGHT * EIGHT
    series = aligned(SERIES * (top + 3) * width).reshape((SERIES, top + 3, width))
    part = aligned(ORDER * width).reshape((ORDER, width))
    series.fill(0.0)
    part.fill(0.0)
    factors = np.zeros((n, FACTORS))
    for j in range(n):  # row by row: an assignment to a slice takes seconds to compile
        f = factors[j]
        f[MASS], f[LENGTH], f[INVERSE], f[GRAVITY] = masses[j], lengths[j], 1.0 / lengths[j], gravity
    direction = 1.0 if times[-1] >= times[0] else -1.0
    omega = series[OMEGA]
    for _ in range(budget):
        expand(factor, solve, state, top, factors, part, series)
        h = step_size(
            largest(omega[0]),
            largest(omega[1]),
            largest(omega[2]),
            largest(omega[top - 1]),
            largest(omega[top]),
            top,
            local,
        )
        counts[1] += 1
        while True:
            ahead = (times[counts[0]] - clock[0]) - clock[1]
            if not abs(ahead) <= h:
                break
            for j in range(n):
                angle, low, rate, rate_low = moved_on(omega, state, j, top, ahead)
                out_theta[counts[0], j] = unwrapped(angle, low, state[j, TURNS])
                out_omega[counts[0], j] = rate + rate_low
            counts[0] += 1
            if counts[0] == len(times):
                return DONE
        h *= direction
        if not abs(h) * MOST_STEPS > abs(ahead):
            return BROKEN
        high, low = two_sum(clock[0], h)
        clock[0], clock[1] = two_sum(high, low + clock[1])
        for j in range(n):
            advance(omega, state, j, top, h)
    return MORE
