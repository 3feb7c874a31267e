"""Roots of sums of squares, of numbers whose squares double precision has no room for."""

import math

import numpy as np
import pytest

from furiko.reference.rounding.monte_carlo import MAGNIFIED, spread
from furiko.reference.rounding.norms import norm, product, root_mean_square, vector_product

SIZES = [1.0, 1e-200, 1e-320, 1e200]


@pytest.mark.parametrize("size", SIZES)
def test_a_norm_scales_with_its_numbers(size):
    # 3, 4, 12 → 13; below the smallest normal number a number has fewer digits
    accuracy = 1e-3 if size < 1e-308 else 1e-15
    assert norm(np.array([3 * size, -4 * size, 12 * size])) == pytest.approx(13 * size, rel=accuracy)
    assert root_mean_square(np.full(5, -size)) == pytest.approx(size, rel=accuracy)


def test_what_vanishes_or_overflows_stays_so():
    assert norm(np.zeros((2, 3))).tolist() == [0.0, 0.0]
    assert norm(np.array([1.0, math.inf])) == math.inf


@pytest.mark.parametrize("size", [1e-180, 1.0, 1e140])
def test_errors_are_added_up_as_independent_ones(size):
    matrix = size * np.array([[[3.0, 4.0], [0.0, 2.0]]])
    assert vector_product(matrix, np.array([[1.0, 1.0]])) == pytest.approx(size * np.array([[5.0, 2.0]]), rel=1e-15)
    assert product(matrix, np.eye(2)) == pytest.approx(matrix, rel=1e-15)


@pytest.mark.parametrize("size", SIZES[:2])
def test_a_spread_is_seen_whatever_the_numbers_size(size):
    samples = size * (1 + np.array([1.0, -1.0, 1.0, -1.0]) * 2.0**-44)
    expected = size * 2.0**-44 / MAGNIFIED  # samples are rounded by up to 2⁻⁵³ of themselves, 2⁻⁹ of what is spread
    assert spread(samples, np.float64(size)) == pytest.approx(expected, rel=2.0**-9, abs=0)
