"""Numbers that carry derivatives along: forward differentiation, in balls."""

from __future__ import annotations

from typing import Any


class Tangent:
    """A value and its derivatives along some directions, a matrix of one row; None where all are zero."""

    __slots__ = ("parts", "value")

    def __init__(self, value: Any, parts: Any | None) -> None:
        self.value = value
        self.parts = parts

    def __add__(self, other: Any) -> Tangent:
        if not isinstance(other, Tangent):
            return Tangent(self.value + other, self.parts)
        a, b = self.parts, other.parts
        return Tangent(self.value + other.value, b if a is None else a if b is None else a + b)

    __radd__ = __add__

    def __neg__(self) -> Tangent:
        return Tangent(-self.value, None if self.parts is None else -self.parts)

    def __sub__(self, other: Any) -> Tangent:
        return self + -other

    def __rsub__(self, other: Any) -> Tangent:
        return -self + other

    def __mul__(self, other: Any) -> Tangent:
        a = self.parts
        if not isinstance(other, Tangent):
            return Tangent(self.value * other, None if a is None else a * other)
        b = other.parts
        if a is not None:
            a = a * other.value
        if b is not None:
            b = b * self.value
        return Tangent(self.value * other.value, b if a is None else a if b is None else a + b)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Tangent:
        """By a number without derivatives."""
        return Tangent(self.value / other, None if self.parts is None else self.parts / other)

    def sin_cos(self) -> tuple[Tangent, Tangent]:
        """Sine and cosine."""
        sin, cos = self.value.sin_cos()
        if self.parts is None:
            return Tangent(sin, None), Tangent(cos, None)
        return Tangent(sin, self.parts * cos), Tangent(cos, self.parts * -sin)


def row(tangent: Any, size: int) -> list[Any]:
    """Its derivatives, ``size`` of them; zeros of what has none."""
    parts = tangent.parts if isinstance(tangent, Tangent) else None
    return [0] * size if parts is None else parts.entries()


def unit(key: int, value: Any, size: int) -> Any:
    """The derivative ``value`` along direction ``key`` of ``size``."""
    from flint import arb_mat

    found = arb_mat(1, size)
    found[0, key] = value
    return found
