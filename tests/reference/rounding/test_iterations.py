"""What an implicit scheme's iterations leave in maximal coordinates, against a single rod by hand."""

import numpy as np
import pytest

from furiko.models import RodChain
from furiko.reference.rounding.iterations import left_in_maximal_coordinates

LENGTH = 0.7
STATE = np.array([[0.5]]), np.array([[2.0]])


def left(tolerance=1e-12):
    return left_in_maximal_coordinates(RodChain((LENGTH,)), *STATE, tolerance)


def test_a_rod_whose_end_is_apart_from_the_support_turns_by_what_the_least_work_gives():
    """Of all small motions that part the end by c from the support, the one of the least ½ m |δx|² + ½ I δφ² turns the
    rod by m (l/2) c / (m (l/2)² + I), which is 3/2 c/l, where c is along the rod's normal.
    """
    found = left()
    assert found.apart[0] > 0
    assert found.angles[0, 0] == pytest.approx(1.5 * found.apart[0] / LENGTH, rel=1e-12, abs=0)


def test_joints_that_are_nearer_than_the_tolerance_allows_turn_less():
    found = left()
    assert found.with_joints_apart(np.array([1e-20]))[0, 0] == pytest.approx(1.5e-20 / LENGTH, rel=1e-12, abs=0)
    for gap in (np.inf, 1e3 * found.apart[0]):  # an engine that does not say, or says too much
        assert found.with_joints_apart(np.array([gap]))[0, 0] == found.angles[0, 0]


def test_twice_the_tolerance_leaves_twice_as_much():
    for one, two in zip(vars(left()).values(), vars(left(2e-12)).values(), strict=True):
        assert two == pytest.approx(2 * one, rel=1e-12, abs=0)
