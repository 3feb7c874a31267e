"""Sine and cosine that vectorise, without a branch. Compiled code only."""

from __future__ import annotations

from typing import Any

from . import sine
from .compiling import inlined
from .sine import HALF_PI, HALF_PI_LOW, ROUNDER, TWO_OVER_PI
from .vector import fma, in_quadrant

polynomials = inlined(sine.polynomials)


@inlined
def sincos(high: Any, low: Any) -> tuple[Any, Any]:
    """Sine and cosine of high + low [rad]; absolute error below 2.5e-16 for |high| ≤ 1e14, 1e-15 for ≤ 3e15.

    For numbers and for vectors of eight (:mod:`.vector`). Cody and Waite's reduction in two parts is enough: each
    product is exact within its fused multiply-add, and what the two parts leave of π/2 is 1.5e-33 k, at most 3e-18 for
    k < 2^51. Above 1e14, k may miss the nearest whole number by 0.7, where the polynomials are a little less exact.
    """
    rounded = fma(high, TWO_OVER_PI, ROUNDER)
    k = rounded - ROUNDER
    r = fma(-k, HALF_PI_LOW, fma(-k, HALF_PI, high)) + low
    s, c = polynomials(r)
    found: tuple[Any, Any] = in_quadrant(rounded, s, c)
    return found
