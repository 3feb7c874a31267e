"""One Taylor step of either system in compiled form, and the run from output time to output time.

The derivation is in :mod:`.taylor`. Rows of numbers, one a link, are padded to whole vectors of EIGHT.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..kernels import elimination
from ..kernels.compiling import aligned, called, compiled, fma, inlined, wide_vectors
from ..kernels.sincos import sincos
from .convolution import COSINE, EIGHT, FP, FQ, OMEGA, SERIES, SINE, WP, WQ, R, convolve_eight

absorb_rod = inlined(elimination.absorb_rod)
turn = inlined(elimination.turn)
two_difference = inlined(elimination.difference)

RODS, LEGS = 0, 1
MOST_STEPS = 1e11  # to one output: days of work; more is probably a wrong unit
DONE, MORE, BROKEN = 0, 1, 2
TWO_PI, TWO_PI_LOW = 6.283185307179586, 2.4492935982947064e-16
# columns of the state, one row a link: angle and rate as sums of two numbers, and whole turns taken off the angle
ANGLE, ANGLE_LOW, RATE, RATE_LOW, TURNS, STATE = range(6)
# columns of the factors of a step, one row a link
MASS, LENGTH, SIN, COS, A, B, KAPPA, KC, KB, KM, M12, M22, UP_W, ACROSS_W, ACROSS_R, WP_R, FACTORS = range(17)
# rows of what one order of the series needs: WP, WQ, R of the convolution, then
BETA_P, TAU, ORDER = 3, 4, 5


@inlined
def two_sum(a: float, b: float) -> tuple[float, float]:
    """a + b and its rounding error."""
    return two_difference(a, -b)


@inlined
def relative_sincos(state: Any, link: int, other: int) -> tuple[float, float]:
    """Sine and cosine of a link's angle less another's (negative: less nothing), low parts included."""
    if other < 0:
        return sincos(state[link, ANGLE], state[link, ANGLE_LOW])
    high, low = two_difference(state[link, ANGLE], state[other, ANGLE])
    return sincos(high, low + (state[link, ANGLE_LOW] - state[other, ANGLE_LOW]))


@called
def factor_rods(state: Any, factors: Any) -> None:
    """Everything of the elimination that all orders of a step share."""
    a = b = c = d = 0.0
    for j in range(len(state) - 1, -1, -1):
        f = factors[j]
        m = f[MASS]
        s, co = relative_sincos(state, j, j - 1)
        kappa = 1.0 / (m / 3.0 + c)
        f[SIN], f[COS], f[A], f[B], f[KAPPA] = s, co, a, b, kappa
        f[KC], f[KB], f[KM] = kappa * c, kappa * b, kappa * (m / 6.0)
        f[UP_W] = kappa * (a * (m / 3.0) + d) + m / 2.0
        f[ACROSS_W] = kappa * (m * (m / 6.0 + c / 3.0))
        f[ACROSS_R] = kappa * (m / 2.0 + c)
        f[WP_R] = f[KM] * b
        f[M12] = s * f[KM] - co * f[KB]
        f[M22] = -(s * f[KB] + co * f[KM])
        a, b, c, _p, _q, _t, _kb, _km = absorb_rod(m, 0.0, a, b, c, d, 0.0, 0.0)
        a, b, c, d, _p, _q = turn(s, co, a, b, c, 0.0, 0.0)


@called
def solve_rods(order: int, gravity: float, factors: Any, part: Any, series: Any) -> None:
    """One order of lθ'' and F, and with it the next orders of ω, sine and cosine."""
    wp, wq, r, beta_p, tau = part[WP], part[WQ], part[R], part[BETA_P], part[TAU]
    fp, fq = series[FP, order], series[FQ, order]
    p = q = 0.0
    for j in range(len(factors) - 1, -1, -1):
        f = factors[j]
        weight = f[LENGTH] * (order + 1.0)
        w_p, w_q = -weight * wp[j], weight * wq[j]
        wp[j], wq[j] = w_p, w_q
        beta_p[j] = p
        tau[j] = f[KAPPA] * (r[j] - q) - f[KB] * w_p - f[KC] * w_q
        own_p = f[UP_W] * w_p + f[KB] * ((f[MASS] / 3.0) * w_q + r[j])
        own_q = f[ACROSS_R] * r[j] + f[ACROSS_W] * w_q - f[WP_R] * w_p
        p, q = (
            (f[COS] * own_p - f[SIN] * own_q) + f[COS] * p + f[M12] * q,
            (f[SIN] * own_p + f[COS] * own_q) + f[SIN] * p + f[M22] * q,
        )
    p, q = (-gravity if order == 0 else 0.0), 0.0
    for j in range(len(factors)):
        f = factors[j]
        m = f[MASS]
        a = f[COS] * p + f[SIN] * q
        b = f[COS] * q - f[SIN] * p
        p, q = (
            wp[j] + f[COS] * p + f[SIN] * q,
            (tau[j] + wq[j]) + f[M12] * p + f[M22] * q,
        )
        moved = tau[j] - f[KB] * a - f[KM] * b
        x = moved - b
        fq[j] = (m / 3.0) * x - r[j]
        fp[j] = -((m / 2.0) * a + f[A] * (a + wp[j]) + (f[B] * (moved + wq[j]) + beta_p[j]))
        extend(series, order, j, f[LENGTH], x, wp[j], wq[j])


@inlined
def extend(series: Any, order: int, j: int, length: float, x: float, wp: float, wq: float) -> None:
    """ω_{k+1} from lθ''_k = x, and c_{k+2}, s_{k+2} from c' = -s ω, s' = c ω."""
    further = 1.0 / (length * ((order + 1.0) * (order + 2.0)))
    series[OMEGA, order + 1, j] = x / (length * (order + 1.0))
    series[COSINE, order + 2, j] = wp * further
    series[SINE, order + 2, j] = (x + wq) * further


@called
def factor_legs(state: Any, gravity: float, factors: Any) -> None:
    """Sines and cosines of θ1 - θi, the pivot m1 + Σ m S² in KAPPA, and g e_y in frame 1 in A, B of link 1."""
    s, c = relative_sincos(state, 0, -1)
    factors[0, A], factors[0, B] = -gravity * c, gravity * s
    pivot = factors[0, MASS]
    for i in range(1, len(state)):
        f = factors[i]
        f[SIN], f[COS] = relative_sincos(state, 0, i)
        pivot += f[MASS] * f[SIN] * f[SIN]
    factors[0, KAPPA] = pivot


@called
def solve_legs(order: int, factors: Any, part: Any, series: Any) -> None:
    """One order of lθ'', of A (legs) and Φ (link 1), and with it the next orders of ω, sine and cosine."""
    wp, wq, r = part[WP], part[WQ], part[R]
    fp, fq = series[FP, order], series[FQ, order]
    for i in range(len(factors)):
        weight = factors[i, LENGTH] * (order + 1.0)
        wp[i], wq[i] = -weight * wp[i], weight * wq[i]
    along = wp[0] + (factors[0, A] if order == 0 else 0.0)
    across = wq[0] + (factors[0, B] if order == 0 else 0.0)
    load = r[0]
    for i in range(1, len(factors)):
        f = factors[i]
        load += f[MASS] * (f[COS] * (wq[i] - r[i]) - f[SIN] * (f[COS] * along + wp[i]))
    G = -load / factors[0, KAPPA]
    force = factors[0, MASS] * along
    for i in range(1, len(factors)):
        f = factors[i]
        fp[i] = f[COS] * along - f[SIN] * G
        fq[i] = f[SIN] * along + f[COS] * G
        force += f[MASS] * (f[COS] * (fp[i] + wp[i]) + f[SIN] * (wq[i] - r[i]))
        extend(series, order, i, f[LENGTH], -fq[i] - r[i], wp[i], wq[i])
    fp[0], fq[0] = force, -r[0]
    extend(series, order, 0, factors[0, LENGTH], G - across, wp[0], wq[0])


@called
def expand(kind: int, state: Any, gravity: float, top: int, factors: Any, part: Any, series: Any) -> None:
    """The series of ω, and of sine and cosine of each link's turn, to order ``top``."""
    wide_vectors()
    if kind == RODS:
        factor_rods(state, factors)
    else:
        factor_legs(state, gravity, factors)
    for j in range(len(factors)):
        series[OMEGA, 0, j] = series[SINE, 1, j] = state[j, RATE]
        series[SINE, 0, j], series[COSINE, 0, j], series[COSINE, 1, j] = 0.0, 1.0, 0.0
    for k in range(top):
        for first in range(0, part.shape[1], EIGHT):
            convolve_eight(series, k, first, part)
        if kind == RODS:
            solve_rods(k, gravity, factors, part, series)
        else:
            solve_legs(k, factors, part, series)


@inlined
def largest(row: Any) -> float:
    """Largest magnitude in a row; not a number where one of them is infinite or none."""
    found = unsound = 0.0
    for e in range(row.size):
        found = max(found, abs(row[e]))
        unsound += 0.0 * row[e]
    return found + unsound


@called
def step_size(omega: Any, top: int, local: float) -> float:
    """The step at which each of the last two terms of ω is ``local`` of the largest of its first three."""
    step = math.inf
    for last in (top - 1, top):
        end = largest(omega[last])
        if end != 0.0:
            reach = 0.0
            for first in range(3):
                reach = max(reach, (local * largest(omega[first]) / end) ** (1.0 / (last - first)))
            step = end if math.isnan(end) else min(step, reach)
    return step


@called
def moved_on(omega: Any, state: Any, j: int, top: int, h: float) -> tuple[float, float, float, float]:
    """Angle and rate of one link after h, each as a sum of two numbers: only the small terms are rounded."""
    rate: float = omega[top, j]
    angle = rate / (top + 1.0)
    for k in range(top - 1, 0, -1):
        rate = omega[k, j] + h * rate
        angle = omega[k, j] / (k + 1.0) + h * angle
    travel = h * state[j, RATE]
    high, low = two_sum(state[j, ANGLE], travel)
    low += state[j, ANGLE_LOW] + (h * (h * angle + state[j, RATE_LOW]) + fma(h, state[j, RATE], -travel))
    angle_high, angle_low = two_sum(high, low)
    gain = h * rate
    high, low = two_sum(state[j, RATE], gain)
    rate_high, rate_low = two_sum(high, low + (state[j, RATE_LOW] + fma(h, rate, -gain)))
    return angle_high, angle_low, rate_high, rate_low


@inlined
def unwrapped(high: float, low: float, turns: float) -> float:
    """The angle with its whole turns."""
    whole = turns * TWO_PI
    total, rest = two_sum(whole, high)
    angle: float = total + (rest + (low + (fma(turns, TWO_PI, -whole) + turns * TWO_PI_LOW)))
    return angle


@inlined
def wrap(state: Any, j: int) -> None:
    """Bring an angle to within half a turn, exactly."""
    turns = np.rint(state[j, ANGLE] / TWO_PI)
    if turns != 0.0:
        whole = turns * TWO_PI
        high, low = two_sum(state[j, ANGLE] - whole, -fma(turns, TWO_PI, -whole))
        state[j, ANGLE], state[j, ANGLE_LOW] = two_sum(high, low + (state[j, ANGLE_LOW] - turns * TWO_PI_LOW))
        state[j, TURNS] += turns


@compiled(releases_gil=True)
def start(theta: Any, omega: Any, state: Any) -> None:
    """Write the state of one trajectory, shape (n,) each, into a fresh ``state`` of shape (n, STATE)."""
    for j in range(theta.size):
        state[j, ANGLE], state[j, RATE] = theta[j], omega[j]
        state[j, ANGLE_LOW] = state[j, RATE_LOW] = state[j, TURNS] = 0.0
        wrap(state, j)


@compiled(releases_gil=True)
def run(
    kind: int,
    masses: Any,
    lengths: Any,
    gravity: float,
    times: Any,
    top: int,
    local: float,
    state: Any,
    clock: Any,
    counts: Any,
    out_theta: Any,
    out_omega: Any,
    budget: int,
) -> int:
    """Advance one trajectory until its last output is written (DONE) or ``budget`` steps are spent (MORE).

    BROKEN: the rates are such that the steps are too short ever to get there.

    ``top``: order of the series; ``local``: size of its last terms; ``state``: from :func:`start`; ``clock``: the time
    as a sum of two numbers; ``counts``: outputs written and steps taken; out_theta, out_omega: (len(times), n).
    All of them are kept between calls.
    """
    n = len(masses)
    width = (n + EIGHT - 1) // EIGHT * EIGHT
    series = aligned(SERIES * (top + 3) * width).reshape((SERIES, top + 3, width))
    part = aligned(ORDER * width).reshape((ORDER, width))
    series[:], part[:] = 0.0, 0.0
    factors = np.zeros((n, FACTORS))
    factors[:, MASS], factors[:, LENGTH] = masses, lengths
    direction = 1.0 if times[-1] >= times[0] else -1.0
    for _ in range(budget):
        expand(kind, state, gravity, top, factors, part, series)
        h = step_size(series[OMEGA], top, local)
        counts[1] += 1
        while True:
            ahead = (times[counts[0]] - clock[0]) - clock[1]
            if not abs(ahead) <= h:
                break
            for j in range(n):
                angle, low, rate, rate_low = moved_on(series[OMEGA], state, j, top, ahead)
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
            angle, low, rate, rate_low = moved_on(series[OMEGA], state, j, top, h)
            state[j, ANGLE], state[j, ANGLE_LOW], state[j, RATE], state[j, RATE_LOW] = angle, low, rate, rate_low
            wrap(state, j)
    return MORE
