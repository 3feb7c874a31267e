"""Numbers that carry derivatives along: forward differentiation, in balls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from operator import mul
from typing import Any


class Tangent:
    """A value and its derivatives along some directions, a list; None where all are zero."""

    __slots__ = ("parts", "value")

    def __init__(self, value: Any, parts: list[Any] | None) -> None:
        self.value = value
        self.parts = parts

    def __add__(self, other: Any) -> Tangent:
        if not isinstance(other, Tangent):
            return Tangent(self.value + other, self.parts)
        return Tangent(self.value + other.value, _sum(self.parts, other.parts))

    __radd__ = __add__

    def __neg__(self) -> Tangent:
        return Tangent(-self.value, None if self.parts is None else [-a for a in self.parts])

    def __sub__(self, other: Any) -> Tangent:
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> Tangent:
        return (-self).__add__(other)

    def __mul__(self, other: Any) -> Tangent:
        if not isinstance(other, Tangent):
            return Tangent(self.value * other, _times(self.parts, other))
        return Tangent(self.value * other.value, _sum(_times(self.parts, other.value), _times(other.parts, self.value)))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Tangent:
        """By a number without derivatives."""
        return Tangent(self.value / other, None if self.parts is None else [a / other for a in self.parts])

    def sin_cos(self) -> tuple[Tangent, Tangent]:
        """Sine and cosine."""
        sin, cos = self.value.sin_cos()
        return Tangent(sin, _times(self.parts, cos)), Tangent(cos, _times(self.parts, -sin))


def _sum(a: list[Any] | None, b: list[Any] | None) -> list[Any] | None:
    if a is None or b is None:
        return b if a is None else a
    return [x + y for x, y in zip(a, b, strict=True)]


def _times(parts: list[Any] | None, factor: Any) -> list[Any] | None:
    return None if parts is None else [a * factor for a in parts]


def derivatives(number: Any, size: int) -> list[Any]:
    """Its derivatives, ``size`` of them; zeros of what has none."""
    parts = number.parts if isinstance(number, Tangent) else None
    return [0] * size if parts is None else parts


def unit(key: int, value: Any, size: int) -> list[Any]:
    """The derivatives of what changes at the rate ``value`` along direction ``key`` of ``size`` alone."""
    from flint import arb

    found = [arb(0)] * size
    found[key] = value
    return found


def convolve(size: int) -> Callable[[Sequence[Any], Sequence[Any]], Tangent]:
    """A function of two lists: Σ a_i b_i with ``size`` derivatives, by products of matrices, as long as the shorter."""
    from flint import arb_mat

    def product(a: Sequence[Any], b: Sequence[Any]) -> Tangent:
        count = min(len(a), len(b))
        a, b = a[:count], b[:count]
        a_values, b_values = [x.value for x in a], [y.value for y in b]
        a_parts = list(chain.from_iterable(derivatives(x, size) for x in a))
        b_parts = list(chain.from_iterable(derivatives(y, size) for y in b))
        by_a = arb_mat(1, count, a_values) * arb_mat(count, size, b_parts)
        by_b = arb_mat(1, count, b_values) * arb_mat(count, size, a_parts)
        return Tangent(sum(map(mul, a_values, b_values)), (by_a + by_b).entries())

    return product


def solver(rows: list[list[Any]], size: int) -> Callable[[list[Any]], list[Any]]:
    """Solutions with their ``size`` derivatives: M a = r, M ∂a = ∂r - ∂M a. Raises ZeroDivisionError as for balls."""
    from flint import arb_mat

    n = len(rows)
    inverse = arb_mat(n, n, [e.value if isinstance(e, Tangent) else e for line in rows for e in line]).inv()
    moved = arb_mat(n * size, n, [e for line in rows for e in _columns(line, size)])

    def solve(right: list[Any]) -> list[Tangent]:
        value = inverse * arb_mat(n, 1, [r.value for r in right])
        change = (moved * value).entries()  # row i's of direction j at i * size + j
        rest = [a - b for a, b in zip(chain.from_iterable(derivatives(r, size) for r in right), change, strict=True)]
        parts = (inverse * arb_mat(n, size, rest)).entries()
        return [Tangent(a, parts[i * size : (i + 1) * size]) for i, a in enumerate(value.entries())]

    return solve


def _columns(line: list[Any], size: int) -> list[Any]:
    """The derivatives of a row of a matrix, direction by direction."""
    parts = [derivatives(e, size) for e in line]
    return [part[j] for j in range(size) for part in parts]
