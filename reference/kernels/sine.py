"""Sine and cosine near zero: the polynomials of Sun's fdlibm, in any arithmetic, and how to get there."""

from __future__ import annotations

from typing import Any

TWO_OVER_PI = 0.6366197723675814
HALF_PI, HALF_PI_LOW = 1.5707963267948966, 6.123233995736766e-17  # their sum is π/2 to 1.5e-33
ROUNDER = 6755399441055744.0  # 1.5·2^52: adding it rounds to a whole number, which then stands in the lowest bits


def polynomials(r: Any) -> tuple[Any, Any]:
    """Sine and cosine of |r| ≤ π/4."""
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
    return s, c
