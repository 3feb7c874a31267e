"""Four runs: the order they show, where they converge to, and how sure that is, on series that are known."""

import math

import numpy as np
import pytest
from motion_zoo import Damped, Fake, LongStep

from furiko.checks import trajectories
from furiko.checks.trajectories import Ladder


def ladder(error, steps=8):
    """The runs of a scheme whose error at step h is error(h), in one angle whose true value is 2."""
    ends = [np.array([[2.0 + error(0.1 / 2**k)], [0.0]]) for k in range(4)]
    return Ladder(0.1, steps, tuple(ends))


@pytest.mark.parametrize("order", [1, 2, 4, 6])
def test_the_order_of_a_known_series(order):
    coarser, finer = ladder(lambda h: 0.3 * h**order + 0.5 * h ** (order + 1)).orders()
    # The next term's share of a difference is 5/3 h (2 - 2^-order): a tenth at h = 0.1, which adds 0.2 to the order.
    assert order < finer < coarser < order + 0.25
    assert finer - order == pytest.approx((coarser - order) / 2, rel=0.1)


@pytest.mark.parametrize("order", [1, 2, 4])
def test_the_limit_is_as_sure_as_it_says(order):
    limit, uncertainty = ladder(lambda h: 0.3 * h**order + 0.5 * h ** (order + 1)).limit(order)
    assert abs(limit[0] - 2) <= uncertainty / 3
    assert uncertainty < 0.5 * 0.1 ** (order + 1)


def test_runs_that_converge_elsewhere_are_not_sure_enough_to_hide_it():
    limit, uncertainty = ladder(lambda h: 1e-6 + 0.3 * h**4).limit(4)
    assert abs(limit[0] - 2) > 100 * uncertainty


def test_runs_that_blow_up_have_no_order():
    ends = [np.full((2, 1), np.inf), *[np.array([[2.0 + 0.1 / 4**k], [0.0]]) for k in range(3)]]
    coarser, finer = Ladder(0.1, 8, tuple(ends)).orders()
    assert math.isnan(coarser)
    assert finer == pytest.approx(2)


def test_four_steps_are_reported(make_cell):
    (result,) = trajectories.compare(make_cell(Fake, "double-pendulum"))
    assert result.outcome == "agrees"
    assert len(result.details["steps"]) == len(result.details["errors"]) == 4
    ratios = np.array(result.details["steps"][:-1]) / result.details["steps"][1:]
    np.testing.assert_allclose(ratios, 2)


@pytest.mark.parametrize("fake", [Damped, LongStep])
def test_a_fault_of_1e_7_or_less_is_found_at_step_zero(make_cell, fake, monkeypatch):
    monkeypatch.setattr(trajectories, "ORDER_SETTLED", -0.02)  # refine until the next term is small
    (result,) = trajectories.compare(make_cell(fake, "double-pendulum"))
    assert result.outcome == "differs", result
