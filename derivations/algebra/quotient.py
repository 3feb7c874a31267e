"""Formulas over formulas: what the reader of a derivation computes with, kept exact and bounded in size.

The denominator is kept as a list of factors, so that m₁/(m₁+m₂) + m₂/(m₁+m₂) does not grow a square below.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NoReturn

from flint import fmpq

from ...models.errors import InvalidInput
from .trig import CONSTANT_ONE, NOTHING, Formula, constant

LARGEST_DEGREE = 64  # of any product that is written or arises; the true equations have degree 6
LARGEST_WORK = 250_000  # products of terms, for one file; less than a second


class TooLarge(InvalidInput):
    """Multiplied out, the expression has more terms, or higher powers, than any equation of motion has."""


@dataclass
class Budget:
    """How much multiplying out is still allowed."""

    left: int = LARGEST_WORK
    at: int = 0  # the column of what is being evaluated, for the refusal

    def refuse(self, why: str) -> NoReturn:
        """Say where it became too much."""
        raise TooLarge(f"column {self.at + 1}: {why}")

    def check_degree(self, degree: int) -> None:
        """Refuse powers that no equation of motion has."""
        if degree > LARGEST_DEGREE:
            self.refuse(
                f"a power beyond {LARGEST_DEGREE} arises when this is multiplied out; no equation of motion has one"
            )

    def product(self, one: Formula, two: Formula) -> Formula:
        """``one · two``, paid for before it is done."""
        self.left -= len(one) * len(two) + 1
        if self.left < 0:
            self.refuse("multiplied out, this has too many terms for an equation of motion; write it more simply")
        return one * two

    def power(self, base: Formula, exponent: int) -> Formula:
        """``base`` to a whole power ≥ 0."""
        result = CONSTANT_ONE
        for _ in range(exponent):
            result = self.product(result, base)
        return result


@dataclass(frozen=True)
class Quotient:
    """``top`` over the product of the factors in ``below``, each to its power; ``degree`` bounds every exponent."""

    top: Formula
    below: Mapping[Formula, int] = field(default_factory=dict)
    degree: int = 0

    def plus(self, other: Quotient, sign: int, budget: Budget) -> Quotient:
        """The sum (``sign`` 1) or difference (-1), over the least common denominator."""
        theirs = other.top if sign > 0 else -other.top
        if self.below == other.below:
            return Quotient(self.top + theirs, self.below, max(self.degree, other.degree))
        common = {f: max(self.below.get(f, 0), other.below.get(f, 0)) for f in {**self.below, **other.below}}
        top = self._raised(common, self.top, budget) + other._raised(common, theirs, budget)
        return _checked(top, common, self.degree + other.degree, budget)

    def _raised(self, common: Mapping[Formula, int], top: Formula, budget: Budget) -> Formula:
        for factor, power in common.items():
            missing = power - self.below.get(factor, 0)
            if missing:
                top = budget.product(top, budget.power(factor, missing))
        return top

    def times(self, other: Quotient, budget: Budget) -> Quotient:
        """The product."""
        below = dict(self.below)
        for factor, power in other.below.items():
            below[factor] = below.get(factor, 0) + power
        return _checked(budget.product(self.top, other.top), below, self.degree + other.degree, budget)

    def inverse(self) -> Quotient:
        """The reciprocal; the caller must exclude zero."""
        top = CONSTANT_ONE
        for factor, power in self.below.items():
            top = top * factor.power(power)
        if self.top.is_monomial():
            return Quotient(top * self.top.inverse_monomial(), {}, self.degree)
        _, lead = min(self.top.terms.items())
        return Quotient(top.times(1 / lead), {self.top.times(1 / lead): 1}, self.degree)

    def power(self, exponent: int, budget: Budget) -> Quotient:
        """A whole power; a negative one of what is not zero."""
        base = self if exponent >= 0 else self.inverse()
        size = abs(exponent)
        below = {factor: power * size for factor, power in base.below.items()} if size else {}
        budget.check_degree(base.degree * size)
        return Quotient(budget.power(base.top, size), below, base.degree * size)


def _checked(top: Formula, below: Mapping[Formula, int], degree: int, budget: Budget) -> Quotient:
    """``degree`` only bounds the powers from above; where it grows too large, they are looked at."""
    if degree > LARGEST_DEGREE:
        degree = max((top.degree(), *(factor.degree() * power for factor, power in below.items())))
    budget.check_degree(degree)
    return Quotient(top, below if top else {}, degree)


def number(value: int | fmpq) -> Quotient:
    """A rational number."""
    return Quotient(constant(value))


ZERO = Quotient(NOTHING)
