"""Quotients of formulas, exact and bounded in size: a derivation that is read is evaluated in them.

The denominator is kept as a list of factors, so that m₁/(m₁+m₂) + m₂/(m₁+m₂) gets no squared denominator.
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
    """How many products of terms may still be multiplied out."""

    left: int = LARGEST_WORK
    at: int = 0  # the column of what is being evaluated, for the refusal

    def refuse(self, why: str) -> NoReturn:
        """Raise :class:`TooLarge` with the column."""
        raise TooLarge(f"column {self.at + 1}: {why}")

    def check_degree(self, degree: int) -> None:
        """Refuse powers that no equation of motion has."""
        if degree > LARGEST_DEGREE:
            self.refuse(
                f"a power beyond {LARGEST_DEGREE} arises when this is multiplied out; no equation of motion has one"
            )

    def product(self, one: Formula, two: Formula) -> Formula:
        """``one · two``; counted, and refused, before it is multiplied out."""
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
    """``numerator`` over the product of the factors in ``denominator``, each to its power.

    ``degree`` bounds every exponent.
    """

    numerator: Formula
    denominator: Mapping[Formula, int] = field(default_factory=dict)
    degree: int = 0

    def plus(self, other: Quotient, sign: int, budget: Budget) -> Quotient:
        """The sum (``sign`` 1) or difference (-1), over the least common denominator."""
        theirs = other.numerator if sign > 0 else -other.numerator
        if self.denominator == other.denominator:
            return Quotient(self.numerator + theirs, self.denominator, max(self.degree, other.degree))
        ours, others = self.denominator, other.denominator
        common = {f: max(ours.get(f, 0), others.get(f, 0)) for f in {**ours, **others}}
        numerator = self._raised(common, self.numerator, budget) + other._raised(common, theirs, budget)
        return _checked(numerator, common, self.degree + other.degree, budget)

    def _raised(self, common: Mapping[Formula, int], numerator: Formula, budget: Budget) -> Formula:
        for factor, power in common.items():
            missing = power - self.denominator.get(factor, 0)
            if missing:
                numerator = budget.product(numerator, budget.power(factor, missing))
        return numerator

    def times(self, other: Quotient, budget: Budget) -> Quotient:
        """The product."""
        denominator = dict(self.denominator)
        for factor, power in other.denominator.items():
            denominator[factor] = denominator.get(factor, 0) + power
        numerator = budget.product(self.numerator, other.numerator)
        return _checked(numerator, denominator, self.degree + other.degree, budget)

    def inverse(self) -> Quotient:
        """The reciprocal; the caller must exclude zero."""
        numerator = CONSTANT_ONE
        for factor, power in self.denominator.items():
            numerator = numerator * factor.power(power)
        if self.numerator.is_monomial():
            return Quotient(numerator * self.numerator.inverse_monomial(), {}, self.degree)
        _, lead = min(self.numerator.terms.items())
        return Quotient(numerator.times(1 / lead), {self.numerator.times(1 / lead): 1}, self.degree)

    def power(self, exponent: int, budget: Budget) -> Quotient:
        """A whole power; a negative one of what is not zero."""
        base = self if exponent >= 0 else self.inverse()
        size = abs(exponent)
        denominator = {factor: power * size for factor, power in base.denominator.items()} if size else {}
        budget.check_degree(base.degree * size)
        return Quotient(budget.power(base.numerator, size), denominator, base.degree * size)


def _checked(numerator: Formula, denominator: Mapping[Formula, int], degree: int, budget: Budget) -> Quotient:
    """``degree`` only bounds the powers from above; where it grows too large, they are looked at."""
    if degree > LARGEST_DEGREE:
        degree = max((numerator.degree(), *(factor.degree() * power for factor, power in denominator.items())))
    budget.check_degree(degree)
    return Quotient(numerator, denominator if numerator else {}, degree)


def number(value: int | fmpq) -> Quotient:
    """A rational number."""
    return Quotient(constant(value))


ZERO = Quotient(NOTHING)
