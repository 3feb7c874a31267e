"""Vectors and matrices of three dimensions as lists of numbers, or of what stands for numbers (:mod:`.formulas`)."""

from __future__ import annotations

from typing import Any

OFF_DIAGONAL = ((0, 1, 2), (1, 3, 4), (2, 4, 5))  # where the entries of a symmetric matrix stand in its six numbers


def add(a: Any, b: Any) -> list[Any]:
    """a + b."""
    return [x + y for x, y in zip(a, b, strict=True)]


def scaled(factor: Any, a: Any) -> list[Any]:
    """factor · a."""
    return [factor * x for x in a]


def dot(a: Any, b: Any) -> Any:
    """a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Any, b: Any) -> list[Any]:
    """a × b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus_cross(start: Any, a: Any, b: Any) -> list[Any]:
    """start + a × b, added up number by number: each term is then one instruction."""
    return [
        start[0] + a[1] * b[2] - a[2] * b[1],
        start[1] + a[2] * b[0] - a[0] * b[2],
        start[2] + a[0] * b[1] - a[1] * b[0],
    ]


def times(matrix: Any, a: Any) -> list[Any]:
    """matrix · a, the matrix by rows (9)."""
    return [dot(matrix[0:3], a), dot(matrix[3:6], a), dot(matrix[6:9], a)]


def plus_times(start: Any, matrix: Any, a: Any) -> list[Any]:
    """start + matrix · a, added up number by number."""
    return [start[i] + matrix[3 * i] * a[0] + matrix[3 * i + 1] * a[1] + matrix[3 * i + 2] * a[2] for i in range(3)]


def transposed(matrix: Any) -> list[Any]:
    """The transpose of a matrix by rows (9)."""
    return [matrix[i] for i in (0, 3, 6, 1, 4, 7, 2, 5, 8)]


def product(a: Any, b: Any) -> list[Any]:
    """a · b of two matrices by rows (9)."""
    columns = [b[0::3], b[1::3], b[2::3]]
    return [dot(a[3 * i : 3 * i + 3], column) for i in range(3) for column in columns]


def full(six: Any) -> list[Any]:
    """A symmetric matrix by rows (9)."""
    return [six[k] for row in OFF_DIAGONAL for k in row]


def upper(nine: Any) -> list[Any]:
    """The six numbers of a symmetric matrix by rows."""
    return [nine[k] for k in (0, 1, 2, 4, 5, 8)]


def rotation_of(q: Any) -> list[Any]:
    """The rotation matrix by rows of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = q
    two = 2.0 / (w * w + x * x + y * y + z * z)
    xx, yy, zz, xy, xz, yz = x * x, y * y, z * z, x * y, x * z, y * z
    wx, wy, wz = w * x, w * y, w * z
    return [
        1.0 - two * (yy + zz), two * (xy - wz), two * (xz + wy),
        two * (xy + wz), 1.0 - two * (xx + zz), two * (yz - wx),
        two * (xz - wy), two * (yz + wx), 1.0 - two * (xx + yy),
    ]  # fmt: skip
