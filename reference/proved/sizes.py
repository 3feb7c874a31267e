"""Sizes of balls as powers of two: guesses of lengths and precisions rest on them, proofs do not."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any


def log2_of(ball: Any) -> float:
    """log₂ of the largest absolute value in a ball, to within one, however large or small; -inf of zero."""
    upper = ball.abs_upper()
    if upper.is_zero():
        return -math.inf
    if not upper.is_finite():
        return math.inf
    mantissa, exponent = upper.man_exp()
    return float(int(exponent) + int(mantissa).bit_length())


def log2_largest(balls: Iterable[Any]) -> float:
    """:func:`log2_of` the largest; -inf of none."""
    return max(map(log2_of, balls), default=-math.inf)
