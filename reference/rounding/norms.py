"""Roots of sums of squares of numbers of any size: squared as they are, those below 1e-154 would vanish."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def norm(values: NDArray[Any], axis: int | tuple[int, ...] = -1) -> Array:
    """√Σ values² over the axis or axes."""
    scale = _power_of_two(values, axis)
    total = np.sqrt(np.sum((values / scale) ** 2, axis=axis))
    return np.asarray(total * np.squeeze(scale, axis=axis), dtype=np.float64)


def root_mean_square(values: NDArray[Any], axis: int = 0) -> Array:
    """√(Σ values² / count) over the axis."""
    return np.asarray(norm(values, axis) / np.sqrt(values.shape[axis]))


def product(matrix: NDArray[Any], other: NDArray[Any]) -> Array:
    """√(matrix∘² other∘²), the product of matrices (…, n, m) and (…, m, k) in which errors add up as independent ones.

    Rows of the one and columns of the other are brought near to one before they are squared.
    """
    rows, columns = _power_of_two(matrix, -1), _power_of_two(other, -2)
    return np.asarray(np.sqrt((matrix / rows) ** 2 @ (other / columns) ** 2) * rows * columns)


def vector_product(matrix: NDArray[Any], vector: NDArray[Any]) -> Array:
    """The same of a vector (…, m)."""
    return product(matrix, vector[..., None])[..., 0]


def _power_of_two(values: NDArray[Any], axis: int | tuple[int, ...]) -> NDArray[Any]:
    """That of the largest of the values, kept in the axis; one where all are zero or one of them is not finite."""
    largest = np.abs(values).max(axis=axis, keepdims=True)
    usable = np.isfinite(largest) & (largest > 0)
    return np.where(usable, np.ldexp(0.5, np.frexp(np.where(usable, largest, 1.0))[1]), 1.0)
