"""Numbers that carry the worst that rounding to nearest may have made of them: running error analysis, to first order.

A second derivation of the proven bounds, from the operations themselves (Wilkinson; Higham, *Accuracy and Stability of
Numerical Algorithms*, section 3.3): every operation adds half an ε of its result to what its operands' errors make.
"""

import math


class Running:
    """``value`` and the largest ``error`` that it may have, in units of ε/2."""

    def __init__(self, value, error=0.0):
        self.value, self.error = value, error

    @classmethod
    def rounded(cls, value):
        """A number that double precision has rounded once."""
        return cls(value, abs(value))

    def __add__(self, other):
        if not isinstance(other, Running):
            other = Running(other)
        value = self.value + other.value
        return Running(value, self.error + other.error + abs(value))

    __radd__ = __add__

    def __neg__(self):
        return Running(-self.value, self.error)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if not isinstance(other, Running):
            other = Running(other)
        value = self.value * other.value
        return Running(value, abs(self.value) * other.error + abs(other.value) * self.error + abs(value))

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Running):
            other = Running(other)
        value = self.value / other.value
        return Running(value, (self.error + abs(value) * other.error) / abs(other.value) + abs(value))

    def __rtruediv__(self, other):
        return Running(other) / self

    def cos(self):
        """Cosine."""
        value = math.cos(self.value)
        return Running(value, abs(math.sin(self.value)) * self.error + abs(value))

    def sin(self):
        """Sine."""
        value = math.sin(self.value)
        return Running(value, abs(math.cos(self.value)) * self.error + abs(value))
