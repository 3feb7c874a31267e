"""Extrapolation to step zero of known series: never less sure than it says, nor so unsure as to hide a fault."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from furiko.reference.integration.richardson import amplified, at_step_zero, follows, settles

COEFFICIENTS = st.floats(-10, 10).map(lambda x: round(x, 6))


def runs(order, *coefficients, limit=2.0, h=0.1):
    """Values at h … h/8 of limit + Σ c h^(order + k)."""
    steps = h / 2.0 ** np.arange(4)
    return [np.array([limit + sum(c * x ** (order + k) for k, c in enumerate(coefficients))]) for x in steps]


@given(st.integers(1, 6), COEFFICIENTS, COEFFICIENTS, COEFFICIENTS)
# Terms that cancel in the middle value of three, in the fine one's difference from it, and in the coarse one's.
@example(2, 1.0, -3 * 0.025, 1.0)
@example(2, 1.0, -3 * 15 / 7 * 0.0125, 1.0)
@example(1, 1.0, -3 * 7 / 3 * 0.0125, 1.0)
@example(2, 1.0, -3 * 15 / 7 * 0.025, 1.0)
def test_the_limit_is_as_sure_as_it_says(order, leading, following, last):
    found, uncertainty = at_step_zero(runs(order, leading, following, last), order)
    rounding = amplified(order) * 4 * np.spacing(2 + abs(leading) + abs(following) + abs(last))
    assert abs(found[0] - 2.0) <= uncertainty + rounding
    # It is the coarser values' own size: β h^(p+1), no more.
    assert uncertainty <= 4 * (abs(following) * 0.1 ** (order + 1) + abs(last) * 0.1 ** (order + 2)) + rounding


def test_what_converges_elsewhere_is_told():
    found, uncertainty = at_step_zero(runs(4, 0.3, 0.5, limit=1e-6), 4)
    assert abs(found[0]) > 100 * uncertainty


@pytest.mark.parametrize("order", [1, 2, 4])
def test_each_of_many_entries_counts(order):
    calm, wild = runs(order, 0.0, 0.0), runs(order, 1.0, 10.0)
    _, both = at_step_zero([np.concatenate(pair) for pair in zip(calm, wild, strict=True)], order)
    _, alone = at_step_zero(wild, order)
    assert both == alone


@pytest.mark.parametrize("order", [1, 2, 4])
@pytest.mark.parametrize("sign", [1, -1])
def test_what_is_in_the_runs_is_amplified_so_much_at_most(order, sign):
    series = runs(order, 0.0)
    off = [*series[:2], series[2] - sign * 1e-3, series[3] + sign * 1e-3]
    found, _ = at_step_zero(off, order)
    assert abs(found[0] - 2.0) == pytest.approx(amplified(order) * 1e-3)


@pytest.mark.parametrize("order", [1, 2, 4])
@pytest.mark.parametrize(
    ("terms", "expected"),
    [((1.0, 3.0), True), ((1.0, 0.0, 3.0), True), ((1.0, 3.0, 3.0), True), ((1.0, 0, 0, 0, 0, 1.0), False)],
)
def test_values_follow_each_other_as_the_next_terms_do(order, terms, expected):
    assert follows(runs(order, *terms), order) == expected


def test_a_difference_in_which_terms_cancel_is_seen():
    # Extrapolation of order 2 leaves -4/3 b x³ - 4 c x⁴ of b h³ + c h⁴; D₁ = 0 where 7b = -15 · 3c x, x = 0.1/8.
    assert not follows(runs(2, 1.0, -3 * 15 / 7 * 0.0125, 1.0), 2)


@pytest.mark.parametrize("order", [1, 2, 4])
def test_errors_that_fall_as_the_order_says_settle_and_those_that_jump_about_do_not(order):
    steps = 0.1 / 2.0 ** np.arange(4)
    falling = [np.array([3.0 + 2 * h**order - 5 * h ** (order + 1)]) for h in steps]
    jumping = [np.array([value]) for value in (2286.6, 1786.5, 289.5, 379.5)]
    assert settles(falling, order, noise=0.0)
    assert not settles(jumping, order, noise=0.0)
    assert settles(jumping, order, noise=5000.0)


def test_runs_whose_own_differences_grow_do_not_settle():
    """What MuJoCo's Euler leaves of energy in a motion that is too fast for its steps: what is extrapolated from these
    falls like a first order's, by 2.4, and the runs themselves part more and more.
    """
    left = [np.array([value]) for value in (6.614e-13, 1.0969e-12, 9.865e-13, 7.943e-13)]
    assert not settles(left, 1, noise=1e-16)
    assert settles(left, 1, noise=1e-12)


@pytest.mark.parametrize(
    ("order", "series", "expected"),
    [
        # Extrapolated by 2y(h) - y(2h): 0, 0, 1, whose fine difference is 1; and 8, 0, 0, whose coarse one is 8 = 2A.
        (1, (0.0, 0.0, 0.0, 0.5), 4 / 3 + 3 / 7),
        (1, (0.0, 4.0, 2.0, 1.0), 4 / 3 + 3 / 7),
        # By (16y(h) - y(2h))/15: 0, 0, 1, and later terms may be as much as that.
        (4, (0.0, 0.0, 0.0, 15 / 16), 1.0),
    ],
)
def test_how_sure_a_limit_is_by_hand(order, series, expected):
    _, uncertainty = at_step_zero([np.array([value]) for value in series], order)
    assert uncertainty == pytest.approx(expected, rel=1e-15)
