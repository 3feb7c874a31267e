"""Enclosed solutions of linear systems: floating point does most of the work, ball arithmetic proves the error.

An approximate inverse R in double precision, whatever its quality, proves a bound on the error of an approximate
solution (Rump 1999, "Fast and parallel interval arithmetic"): with |I - R M| ≤ δ < 1 in the maximum norm,

    |x - x̃| ≤ |R r| + δ/(1 - δ) · max |R r|,      r = right - M x̃ enclosed in balls.

Every rounding error of the bound itself is bounded and added. Where R is too inaccurate, balls are eliminated alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arithmetic import Array, Balls, ball_matrix

Floats = NDArray[np.float64]

UNIT = 2.0**-53  # unit roundoff of double precision
TINY = 1e-290  # more than any underflow in the products below adds up to
NEGLIGIBLE = 2.0**-90  # relative to the solution
UPWARDS = 1 + 2.0**-36  # more than the rounding of nested sums of up to 8000 non-negative products takes away
BLOCK = 60  # BLAS leaves products of matrices of this size to one thread
PARTS = 3  # doubles that the approximate solution is the sum of: 159 bits
SMALL = 12  # up to here eliminating in balls is as fast


def solve(matrix: Array, right: Array) -> Array:
    """Balls that enclose the solutions of matrix · x = right, given as balls; shapes (B, n, n) and (B, n).

    Raises ZeroDivisionError where the balls' precision cannot show a matrix to be regular.
    """
    n = right.shape[-1]
    if n <= SMALL:
        return Balls().solve(matrix, right)
    approximate = matrix.astype(np.float64)
    column_scale = _power_of_two(np.abs(approximate).max(-2))
    approximate *= column_scale[:, None, :]
    inverse = _approximate_inverse(approximate)
    solved = np.empty((len(matrix), n), dtype=object)
    for i, (balls, b) in enumerate(zip(matrix, right, strict=True)):
        enclosed = inverse is not None and _enclose(balls, b, approximate[i], inverse[i], column_scale[i])
        solved[i] = enclosed or Balls().solve(balls, b)
    return solved


def _approximate_inverse(matrix: Floats) -> Floats | None:
    row_scale = _power_of_two(np.abs(matrix).max(-1))
    try:
        return _inverse_by_halves(matrix * row_scale[:, :, None]) * row_scale[:, None, :]
    except np.linalg.LinAlgError:
        return None


def _inverse_by_halves(matrix: Floats) -> Floats:
    """Inverse in blocks that BLAS does not split among threads: where cores are shared, its threads wait for each other
    longer than they compute (n = 100 on two busy cores: five times)."""
    n = matrix.shape[-1]
    if n <= BLOCK:
        return np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    h = n // 2
    b, c = matrix[:, :h, h:], matrix[:, h:, :h]
    first = _inverse_by_halves(matrix[:, :h, :h])
    right, below = first @ b, c @ first
    last = _inverse_by_halves(matrix[:, h:, h:] - c @ right)
    upper = -right @ last
    return np.block([[first - upper @ below, upper], [-last @ below, last]])


def _enclose(balls: Array, right: Array, approximate: Floats, inverse: Floats, scale: Floats) -> list[Any] | None:
    """The solution's balls, or None where the inverse is too inaccurate to prove a bound.

    ``approximate``: the matrix with its columns times ``scale`` (powers of two, so exactly) in doubles; ``inverse``:
    that of it. Unknowns are scaled alike, y = x / scale, so that the maximum norm suits them.
    """
    from flint import arb, arb_mat

    n = len(right)
    M = ball_matrix(balls)
    R = np.abs(inverse)
    delta = _distance_from_identity(M, approximate, inverse, scale)
    if not delta < 0.5:
        return None
    residual = ball_matrix(right[:, None])
    parts = []
    for _ in range(PARTS):
        part = scale * _times(inverse, np.array([float(r) for r in residual.entries()]))
        if not np.isfinite(part).all():
            return None
        residual = residual - M * arb_mat(n, 1, part.tolist())
        parts.append(part.tolist())
    left_over = np.array([float(r.abs_upper()) for r in residual.entries()]) * UPWARDS
    exact = all(r.is_zero() for r in residual.entries())
    if not exact and NEGLIGIBLE * np.max(np.abs(parts[0]) / scale) < TINY:
        return None
    first = np.zeros(n) if exact else _times(R, left_over) * UPWARDS + TINY
    radius = (first + delta / (1 - delta) * first.max()) * UPWARDS * scale
    return [sum(map(arb, part), arb(0, r)) for part, r in zip(zip(*parts, strict=True), radius.tolist(), strict=True)]


def _distance_from_identity(M: Any, approximate: Floats, inverse: Floats, scale: Floats) -> float:
    """A bound of |I - R M'| in the maximum norm, M' being M with its columns scaled; n ≤ 8000.

    I - R M' = (I - R A) - R (M' - A) with A the doubles. A product of doubles is off by at most n u |R| |A|; rounding
    M' to A by 2u |A|; the balls' own radii come on top.
    """
    from flint import arb_mat

    n = len(scale)
    R, A = np.abs(inverse), np.abs(approximate)
    off = np.abs(np.einsum("ij,jk->ik", inverse, approximate) - np.eye(n)).sum(-1)
    rounding = (1.01 * n + 4) * UNIT * _times(R, A.sum(-1))
    radii = (M - M.mid()) * arb_mat(n, 1, scale.tolist())
    from_balls = _times(R, np.array([float(r.abs_upper()) for r in radii.entries()]) * UPWARDS)
    return float(np.max((off + rounding + from_balls) * UPWARDS + TINY))


def _times(matrix: Floats, vector: Floats) -> Floats:
    return np.asarray((matrix * vector).sum(-1))


def _power_of_two(x: Floats) -> Floats:
    """Powers of two that bring positive numbers near 1."""
    return np.ldexp(1.0, -np.frexp(np.where(x > 0, x, 1.0))[1])
