"""Monte-Carlo arithmetic: every operation's result is moved by a random part of its last digit, many times over.

Running an algorithm in it samples the rounding of that algorithm, whatever its engine's order of operations is in
detail: the spread of the results is the size of rounding in each of them (Parker, *Monte Carlo arithmetic*, 1997).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .norms import root_mean_square

Array = NDArray[np.float64]

EPSILON = 2.0**-52
POOL = 1 << 16  # random factors, drawn once: an operation takes a run of them from a random place

# Rounding to nearest errs by at most half a unit of the last digit, uniformly. A unit is between ε/2 and ε of the
# number; for numbers whose logarithms are spread evenly its root mean square is 0.7355 ε.
UNIT = 0.7355
# The factors are so much coarser than rounding, and spreads are divided by as much: or double precision's own rounding
# would undo most of the random one (a number just above a power of two is not moved by less than half an ε).
MAGNIFIED = 2.0**8
ONE_ROUNDING = UNIT / math.sqrt(12) * EPSILON  # root mean square of one operation's relative error


class Noise:
    """A source of factors 1 + u: the rounding to nearest of one operation, magnified.

    ``seed``: the same one gives the same factors; ``accuracy``: relative accuracy of one operation, ε by default.
    """

    def __init__(self, seed: int, accuracy: float = EPSILON) -> None:
        self._random = np.random.Generator(np.random.PCG64(seed))
        self._size = UNIT * accuracy * MAGNIFIED
        self._pool = self._factors(POOL)
        self._at = seed

    def _factors(self, count: int) -> Array:
        return np.asarray(1.0 + self._random.uniform(-0.5, 0.5, count) * self._size)

    def __call__(self, values: Array) -> Noisy:
        """Numbers that are kept as they are, rounded at random."""
        return self.rounded(values.copy())

    def rounded(self, values: Array) -> Noisy:
        """The result of an operation, rounded at random in its own place: nobody else holds ``values``."""
        size = values.size
        if size > self._pool.size // 2:
            self._pool = self._factors(4 * size)
        self._at = (self._at * 1103515245 + 12345) % 2147483648  # where to take them, at random enough
        start = self._at % (self._pool.size - size)
        values *= self._pool[start : start + size].reshape(values.shape)
        return Noisy(values, self)


class Noisy:
    """Numbers, (samples, …), whose every operation is rounded at random, unless it is exact."""

    __slots__ = ("noise", "value")
    __array_ufunc__ = None  # an array on the left leaves the operation to this class

    def __init__(self, value: Array, noise: Noise) -> None:
        self.value, self.noise = value, noise

    def __add__(self, other: Noisy | float) -> Noisy:
        return self if _is(other, 0.0) else self.noise.rounded(self.value + _value(other))

    __radd__ = __add__

    def __sub__(self, other: Noisy | float) -> Noisy:
        return self if _is(other, 0.0) else self.noise.rounded(self.value - _value(other))

    def __rsub__(self, other: float) -> Noisy:
        return -self if _is(other, 0.0) else self.noise.rounded(other - self.value)

    def __mul__(self, other: Noisy | float) -> Noisy | float:
        if isinstance(other, Noisy):
            return self.noise.rounded(self.value * other.value)
        if other == 0.0:
            return 0.0
        # A product with a power of two is exact.
        product = self.value * other
        return Noisy(product, self.noise) if abs(math.frexp(other)[0]) == 0.5 else self.noise.rounded(product)

    __rmul__ = __mul__

    def __truediv__(self, other: Noisy | float) -> Noisy:
        return self.noise.rounded(self.value / _value(other))

    def __rtruediv__(self, other: float) -> Noisy | float:
        return 0.0 if _is(other, 0.0) else self.noise.rounded(other / self.value)

    def __neg__(self) -> Noisy:
        return Noisy(-self.value, self.noise)

    def cos(self) -> Noisy:
        """Cosine, rounded."""
        return self.noise.rounded(np.cos(self.value))

    def sin(self) -> Noisy:
        """Sine, rounded."""
        return self.noise.rounded(np.sin(self.value))

    def sqrt(self) -> Noisy:
        """Square root, rounded."""
        return self.noise.rounded(np.sqrt(self.value))


def _is(number: Noisy | float, exact: float) -> bool:
    """Whether it is this very number, so that an operation with it is exact."""
    return not isinstance(number, Noisy) and number == exact


def _value(number: Noisy | float) -> Array | float:
    return number.value if isinstance(number, Noisy) else number


def spread(samples: Array, exact: Array) -> Array:
    """Root mean square of the samples' distance from the exact values: (…) from (samples, …)."""
    return np.asarray(root_mean_square(samples - exact) / MAGNIFIED)
