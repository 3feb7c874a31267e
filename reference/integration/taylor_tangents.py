"""Eight trajectories at a time with small differences beside them: ``furiko.lyapunov`` and ``furiko.stretching``.

A small difference (δθ, δω) obeys the equations of motion's first variation. Each order of it is found as the motion's
own is (:mod:`.taylor`): everything is linear in the series of a step once the turns of the links are counted from where
the motion begins it, in frames that the difference does not turn. Then gravity is no part of the difference, whose
sine begins with δθ instead of 0, and whose sums of products are those of :func:`.convolution.convolve_tangent`; the
factors of the elimination are the same. No difference quotient anywhere.

After each step the differences are made orthonormal again (Gram and Schmidt), and what that takes out, a triangle R, is
multiplied up: Q R of the product of all steps, with its size taken out as a logarithm. Nothing overflows, and no
difference is lost in the one that grows most (Benettin et al. 1980).
"""

from __future__ import annotations

import math
from typing import Any

from ..kernels.compiling import aligned, called, compiled, inlined, merged, wide_vectors
from ..kernels.sizes import EIGHT
from ..kernels.vector import load, magnitude, maximum, square_root, store
from .convolution import COSINE, OMEGA, SERIES, SINE, convolve_tangent
from .layout import (
    AHEAD,
    BROKEN,
    DIFFERENCE,
    DONE,
    DUE,
    IDLE,
    INVERSE,
    LENGTH,
    MASS,
    MORE,
    RATE_SCALE,
    SIZE,
    SPED,
    STEP,
    TAKEN_OUT,
    TRAJECTORY,
    TURNED,
    WRITTEN,
)
from .taylor_compiled import (
    ORDER,
    expand,
    factor_legs,
    factor_rods,
    solve_legs,
    solve_rods,
    step_size,
)
from .taylor_lanes import (
    SIZES,
    begin,
    find_due,
    go_on,
    largest,
    look_ahead,
    set_ahead,
    set_steps,
    write,
)


@merged
def run(factor: Any, solve: Any, factor_still: Any, change_by: Any, given: Any) -> int:
    """As :func:`.taylor_lanes.run`, with K differences beside each trajectory, from ``first`` (K, DIFFERENCE, n).

    ``rate_scale``: (B,), how many rad/s count as much as a radian; out_growth: (B, m, K), ln of the diagonal of R;
    out_product: (B, m, K, K), R but for a factor, and out_size: (B, m), ln of that; none written where out_product
    has no rows. Kept between calls besides: ``still`` as factors, without gravity; differences: (K, DIFFERENCE, n, 8);
    product: (K, K, 8); growth: (K, 8); scales: (SCALES, 8).
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
        first,
        rate_scale,
        still,
        differences,
        product,
        growth,
        scales,
        out_growth,
        out_product,
        out_size,
        budget,
    ) = given
    n, count = theta.shape[1], len(first)
    series = aligned(SERIES * (top + 3) * n * EIGHT).reshape((SERIES, top + 3, n, EIGHT))
    change = aligned(SERIES * (top + 3) * n * EIGHT).reshape((SERIES, top + 3, n, EIGHT))
    rates = aligned(count * (top + 1) * n * EIGHT).reshape((count, top + 1, n, EIGHT))
    part = aligned(ORDER * n * EIGHT).reshape((ORDER, n, EIGHT))
    moved = aligned(4 * n * EIGHT).reshape((4, n, EIGHT))
    there = aligned(count * DIFFERENCE * n * EIGHT).reshape((count, DIFFERENCE, n, EIGHT))
    triangle = aligned(count * count * EIGHT).reshape((count, count, EIGHT))
    sizes = aligned(2 * SIZES * EIGHT).reshape((2 * SIZES, EIGHT))
    direction = 1.0 if times[-1] >= times[0] else -1.0
    powers = series[OMEGA]
    running = 0
    for lane in range(EIGHT):
        if lanes[TRAJECTORY, lane] == IDLE:
            begin(lane, masses, lengths, gravity, theta, omega, times[0], state, factors, clock, lanes)
            begin_differences(lane, lanes, first, rate_scale, factors, still, differences, product, growth, scales)
        running += lanes[TRAJECTORY, lane] != IDLE
    for _ in range(budget):
        if running == 0:
            return DONE
        expand(factor, solve, state, top, factors, part, series)
        factor_still(state, still)
        for k in range(count):
            change_by(differences[k], top, still, part, series, change)
            keep_rates(change[OMEGA], rates[k])
        for row, order in enumerate((0, 1, 2, top - 1, top)):
            store(sizes, row, largest(powers[order]))
            store(sizes, SIZES + row, largest_of_all(rates, order))
        set_steps(sizes, clock, lanes, steps, top, local)
        shorten(sizes, clock, top, local)
        while find_due(clock, lanes, times):
            ahead = load(clock, AHEAD)
            look_ahead(powers, state, moved, top, ahead)
            for k in range(count):
                carry(rates[k], differences[k], there[k], top, ahead)
            separate(there, triangle, load(scales, RATE_SCALE))
            write_growth(triangle, product, growth, scales, lanes, out_growth, out_product, out_size)
            write(moved, state, lanes, out_theta, out_omega)
        if set_ahead(clock, lanes, times, direction):
            return BROKEN
        ahead = load(clock, AHEAD)
        go_on(powers, state, top, clock)
        for k in range(count):
            carry(rates[k], differences[k], differences[k], top, ahead)
        separate(differences, triangle, load(scales, RATE_SCALE))
        multiply_up(triangle, product, growth, scales)
        for lane in range(EIGHT):
            if lanes[TRAJECTORY, lane] != IDLE and lanes[WRITTEN, lane] == times.size:
                begin(lane, masses, lengths, gravity, theta, omega, times[0], state, factors, clock, lanes)
                begin_differences(lane, lanes, first, rate_scale, factors, still, differences, product, growth, scales)
                running -= lanes[TRAJECTORY, lane] == IDLE
    return MORE if running > 0 else DONE


@inlined
def keep_rates(found: Any, rates: Any) -> None:
    """The series of a difference's rates; the rest of its series makes room for the next."""
    for order in range(len(rates)):
        for j in range(rates.shape[1]):
            store(rates[order], j, load(found[order], j))


@inlined
def largest_of_all(rates: Any, order: int) -> Any:
    """Largest magnitude of one order of all differences, in each lane."""
    found = largest(rates[0, order])
    for k in range(1, len(rates)):
        found = maximum(found, largest(rates[k, order]))
    return found


@called
def shorten(sizes: Any, clock: Any, top: int, local: float) -> None:
    """Shorten the steps to what the differences allow; where a motion's series is none, neither are theirs."""
    for lane in range(EIGHT):
        found = step_size(sizes[5, lane], sizes[6, lane], sizes[7, lane], sizes[8, lane], sizes[9, lane], top, local)
        clock[STEP, lane] = clock[STEP, lane] if clock[STEP, lane] < found else found


@called
def begin_differences(
    lane: int,
    lanes: Any,
    first: Any,
    rate_scale: Any,
    factors: Any,
    still: Any,
    differences: Any,
    product: Any,
    growth: Any,
    scales: Any,
) -> None:
    """The differences of a lane that has just been given a trajectory, or none."""
    b = lanes[TRAJECTORY, lane]
    scale = rate_scale[max(b, 0)]
    scales[RATE_SCALE, lane], scales[TAKEN_OUT, lane] = scale, 0.0
    for k in range(len(first)):
        growth[k, lane] = 0.0
        for other in range(len(first)):
            product[k, other, lane] = 1.0 if k == other else 0.0
        for j in range(len(still)):
            differences[k, TURNED, j, lane] = first[k, TURNED, j]
            differences[k, SPED, j, lane] = first[k, SPED, j] * scale
    for j in range(len(still)):
        for row in (MASS, LENGTH, INVERSE):
            still[j, row, lane] = factors[j, row, lane]


@inlined
def expand_difference(solve: Any, difference: Any, top: int, still: Any, part: Any, series: Any, change: Any) -> None:
    """What the series of a step change by, to order ``top``; ``still``: its factors, without gravity."""
    wide_vectors()
    omega = series[OMEGA, 0]
    for j in range(len(still)):
        turned, sped = load(difference[TURNED], j), load(difference[SPED], j)
        store(change[OMEGA, 0], j, sped)
        store(change[SINE, 0], j, turned)
        store(change[SINE, 1], j, sped)
        store(change[COSINE, 0], j, 0.0)
        store(change[COSINE, 1], j, -turned * load(omega, j))
    columns = part[0].size
    for k in range(top):
        for first in range(0, columns, EIGHT):
            convolve_tangent(series, change, k, first, part)
        solve(k, still, part, change)


@called
def carry(rates: Any, difference: Any, moved: Any, top: int, h: Any) -> None:
    """A difference after h, from the series of its rates."""
    for j in range(rates.shape[1]):
        rate = load(rates[top], j)
        angle = rate * (1.0 / (top + 1.0))
        for k in range(top - 1, -1, -1):
            term = load(rates[k], j)
            rate = term + h * rate
            angle = term * (1.0 / (k + 1.0)) + h * angle
        store(moved[TURNED], j, load(difference[TURNED], j) + h * angle)
        store(moved[SPED], j, rate)


@called
def separate(differences: Any, triangle: Any, rate_scale: Any) -> None:
    """Make differences orthonormal, one after the other: what they were is what they are times ``triangle``.

    Of δθ and δω by ``rate_scale``.
    """
    n = differences.shape[2]
    weight = 1.0 / (rate_scale * rate_scale)
    for a in range(len(differences)):
        own = differences[a]
        for b in range(a + 1):
            other = differences[b]
            turned = sped = load(own[TURNED], 0) * 0.0
            for j in range(n):
                turned += load(other[TURNED], j) * load(own[TURNED], j)
                sped += load(other[SPED], j) * load(own[SPED], j)
            along = turned + weight * sped
            if a == b:
                along = square_root(along)
                shorter = 1.0 / along
                for j in range(n):
                    store(own[TURNED], j, shorter * load(own[TURNED], j))
                    store(own[SPED], j, shorter * load(own[SPED], j))
            else:
                for j in range(n):
                    store(own[TURNED], j, load(own[TURNED], j) - along * load(other[TURNED], j))
                    store(own[SPED], j, load(own[SPED], j) - along * load(other[SPED], j))
            store(triangle[b], a, along)


@called
def multiply_up(triangle: Any, product: Any, growth: Any, scales: Any) -> None:
    """``triangle`` times the product so far, by its largest entry; the logarithms are added up."""
    count = len(product)
    found = load(scales, RATE_SCALE) * 0.0
    for a in range(count):
        for b in range(a, count):
            total = load(triangle[a], a) * load(product[a], b)
            for c in range(a + 1, b + 1):
                total += load(triangle[a], c) * load(product[c], b)
            store(product[a], b, total)
            found = maximum(found, magnitude(total))
    store(scales, SIZE, found)
    smaller = 1.0 / found
    for a in range(count):
        for b in range(a, count):
            store(product[a], b, smaller * load(product[a], b))
    add_logarithms(triangle, growth, scales)


@called
def add_logarithms(triangle: Any, growth: Any, scales: Any) -> None:
    """Of what each difference has grown by, and of the product's size."""
    for lane in range(EIGHT):
        scales[TAKEN_OUT, lane] += math.log(scales[SIZE, lane])
        for k in range(len(growth)):
            growth[k, lane] += math.log(triangle[k, k, lane])


@called
def write_growth(
    triangle: Any,
    product: Any,
    growth: Any,
    scales: Any,
    lanes: Any,
    out_growth: Any,
    out_product: Any,
    out_size: Any,
) -> None:
    """The outputs that are due: the product so far, and the ``triangle`` from the step's start to there times it."""
    count = len(product)
    for lane in range(EIGHT):
        if not lanes[DUE, lane]:
            continue
        b, m = lanes[TRAJECTORY, lane], lanes[WRITTEN, lane]
        for k in range(count):
            out_growth[b, m, k] = growth[k, lane] + math.log(triangle[k, k, lane])
        if len(out_product) == 0:
            continue
        out_size[b, m] = scales[TAKEN_OUT, lane]
        for row in range(count):
            for column in range(count):
                total = 0.0
                for c in range(row, column + 1):
                    total += triangle[row, c, lane] * product[c, column, lane]
                out_product[b, m, row, column] = total


# What follows is compiled once for each of the two systems, and called: in a run that holds it all, it takes twice as
# long to compile. A function that is given to one that is called could not be kept on disk.


@called
def still_rods(state: Any, still: Any) -> None:
    """Factors of rods without gravity."""
    factor_rods(state, still)


@called
def still_legs(state: Any, still: Any) -> None:
    """Factors of N legs without gravity."""
    factor_legs(state, still)


@called
def change_rods(difference: Any, top: int, still: Any, part: Any, series: Any, change: Any) -> None:
    """:func:`expand_difference` of rods."""
    expand_difference(solve_rods, difference, top, still, part, series, change)


@called
def change_legs(difference: Any, top: int, still: Any, part: Any, series: Any, change: Any) -> None:
    """:func:`expand_difference` of N legs."""
    expand_difference(solve_legs, difference, top, still, part, series, change)


@compiled(releases_gil=True)
def run_rod_tangents(*given: Any) -> int:
    """:func:`run` of rod chains."""
    return run(factor_rods, solve_rods, still_rods, change_rods, given)


@compiled(releases_gil=True)
def run_leg_tangents(*given: Any) -> int:
    """:func:`run` of N-leg pendulums."""
    return run(factor_legs, solve_legs, still_legs, change_legs, given)
