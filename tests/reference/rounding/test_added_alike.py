"""What a running sum loses for equal terms, held against exact sums of random ones."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from furiko.reference.rounding.monte_carlo import ONE_ROUNDING
from furiko.reference.rounding.spread import added_alike


def lost(term: float, count: int) -> float:
    """Error of the running sum of ``count`` times the same number, exact."""
    total = 0.0
    for _ in range(count):
        total += term
    return float(Fraction(total) - count * Fraction(term))


@pytest.mark.parametrize("count", [8, 32, 100])
def test_rms_of_the_running_sum_of_equal_terms(count: int) -> None:
    """Within a factor of three: the sum's exponent changes on the way, and with it the side to which it rounds."""
    terms = np.random.default_rng(7).uniform(1.0, 2.0, 500)
    measured = np.sqrt(np.mean([lost(term, count) ** 2 for term in terms]))
    predicted = ONE_ROUNDING * np.sqrt(np.mean([added_alike(np.full(count, term)) ** 2 for term in terms]))
    assert predicted / 3 < measured < 3 * predicted
    # Independent roundings would lose the root of the sum of squares: much less, for many terms.
    independent = ONE_ROUNDING * 1.5 * np.sqrt(sum(k**2 for k in range(count)))
    assert count < 32 or measured > 1.5 * independent


def test_terms_that_differ_are_left_to_sampling() -> None:
    assert added_alike(np.array([1.0, 2.0, 3.0])) == 0.0
    assert added_alike(np.array([2.0, 1.0, 2.0])) == 4.0  # 2 × 2² / 2
