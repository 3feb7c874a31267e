"""Sine and cosine that vectorise: the polynomials of Sun's fdlibm, without a branch. Compiled code only."""

from __future__ import annotations

from typing import Any

from .compiling import inlined
from .vector import fma, in_quadrant

TWO_OVER_PI = 0.6366197723675814
HALF_PI, HALF_PI_LOW = 1.5707963267948966, 6.123233995736766e-17  # their sum is π/2 to 1.5e-33
ROUNDER = 6755399441055744.0  # 1.5·2^52: adding it rounds to a whole number, which then stands in the lowest bits


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
    z = r * r
    s = r + r * z * (
        -1.66666666666666324348e-01
        + z
        * (
            8.33333333332248946124e-03
            + z
            * (
                -1.98412698298579493134e-04
                + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))
            )
        )
    )
    c = (1.0 - 0.5 * z) + z * z * (
        4.16666666666666019037e-02
        + z
        * (
            -1.38888888888741095749e-03
            + z
            * (
                2.48015872894767294178e-05
                + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))
            )
        )
    )
    found: tuple[Any, Any] = in_quadrant(rounded, s, c)
    return found
