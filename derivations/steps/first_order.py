"""Equations of first order, as Hamilton's, made equations of motion: their own variables are eliminated, exactly.

*Relations* tie coordinates, rates and momenta (q̇ = ∂H/∂p, or p = ∂L/∂q̇); *slopes* are the momenta's derivatives
(ṗ = -∂H/∂q). A momentum is whatever the relations make it: momenta of another scale, or none at all but new variables,
give the same motion, and that alone is held against the truth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from flint import fmpq

from ..algebra.division import exact_quotient
from ..algebra.equivalence import determinant
from ..algebra.quotient import Budget
from ..algebra.trig import CONSTANT_ONE, NOTHING, Formula, Key, Space, digit, unit
from .derivation import add

MOST_COORDINATES = 4  # whose momenta are eliminated
WORK = 300_000  # products of terms; less than a second


class NoMomenta(ValueError):
    """The relations do not say what the momenta are."""


@dataclass(frozen=True)
class Momenta:
    """Momenta in coordinates and rates: ``above`` over one ``below``, which is 1 where they divide."""

    above: tuple[Formula, ...]
    below: Formula

    @property
    def divided(self) -> bool:
        """Whether they are formulas without a denominator."""
        return self.below == CONSTANT_ONE


Labelled = tuple[tuple[str, Formula], ...]


@dataclass(frozen=True)
class Places:
    """Where the momenta and their derivatives stand among a space's symbols."""

    momenta: tuple[int, ...]
    slopes: tuple[int, ...]


@dataclass(frozen=True)
class FirstOrder:
    """What an author wrote: each row with its label, left minus right, cleared of denominators.

    ``relations``, ``slopes``: as above; ``momenta``: that the relations give; ``hamiltonian``: above and below, where
    the rows are those of one; ``canonical``: the variables are meant as momenta, ∂L/∂q̇.
    """

    at: Places
    relations: Labelled
    slopes: Labelled
    momenta: Momenta
    hamiltonian: tuple[Formula, Formula] | None = None
    canonical: bool = True

    def mapped(self, change: Callable[[Formula], Formula]) -> FirstOrder:
        """With every formula changed."""
        energy = self.hamiltonian
        return replace(
            self, relations=tuple((label, change(f)) for label, f in self.relations),
            slopes=tuple((label, change(f)) for label, f in self.slopes),
            momenta=Momenta(tuple(map(change, self.momenta.above)), change(self.momenta.below)),
            hamiltonian=(change(energy[0]), change(energy[1])) if energy else None,
        )  # fmt: skip


def solved_momenta(space: Space, at: Places, relations: Sequence[Formula], budget: Budget) -> Momenta:
    """The momenta that n relations give. Raises NoMomenta where they give none."""
    n = space.n
    matrix = [[space.by_symbol(f, place) for place in at.momenta] for f in relations]
    if any(space.places(entry) & {*at.momenta, *at.slopes} for row in matrix for entry in row):
        raise NoMomenta("the momenta enter as products; they have to enter linearly")
    rest = [f - add(x * space.symbol(p) for x, p in zip(row, at.momenta, strict=True))
            for f, row in zip(relations, matrix, strict=True)]  # fmt: skip
    whole = determinant(matrix, budget)
    if not whole:
        raise NoMomenta("they do not say what each momentum is")
    above = []
    for j in range(n):
        # Cramer's rule: column j replaced by what the others are to be
        columns = [[-rest[i] if k == j else x for k, x in enumerate(row)] for i, row in enumerate(matrix)]
        above.append(determinant(columns, budget))
    divided = [exact_quotient(space, f, whole) for f in above]
    if all(f is not None for f in divided):
        return Momenta(tuple(f for f in divided if f is not None), CONSTANT_ONE)
    return Momenta(tuple(above), whole)


def without_momenta(space: Space, at: Places, slopes: Sequence[Formula], momenta: Momenta, budget: Budget
                    ) -> list[Formula]:  # fmt: skip
    """The slopes with the momenta, and their time derivatives, put in; cleared of denominators."""
    below = momenta.below
    values = dict(zip(at.momenta, momenta.above, strict=True))
    for place, f in zip(at.slopes, momenta.above, strict=True):
        quick = space.by_time(f)
        values[place] = quick if momenta.divided else (
            budget.product(quick, below) - budget.product(f, space.by_time(below)))  # fmt: skip
    weights = dict.fromkeys(at.momenta, 1) | dict.fromkeys(at.slopes, 2)
    return [substituted(space, f, values, weights, below, budget) for f in slopes]


def substituted(
    space: Space, f: Formula, values: dict[int, Formula], weights: dict[int, int], below: Formula, budget: Budget
) -> Formula:
    """f with the symbols at ``values`` replaced, each by its value over ``below`` to its weight; times what clears it.

    Raises NoMomenta where such a symbol stands in a denominator.
    """
    parts: dict[tuple[int, ...], dict[Key, fmpq]] = {}
    for (e, h, s), c in f.terms.items():
        powers = tuple(digit(e, place) for place in values)
        if min(powers, default=0) < 0:
            raise NoMomenta("a momentum stands in a denominator")
        left = e - sum(unit(place) * power for place, power in zip(values, powers, strict=True))
        parts.setdefault(powers, {})[left, h, s] = c
    heavy = {powers: sum(power * weights[p] for p, power in zip(values, powers, strict=True)) for powers in parts}
    most = max(heavy.values(), default=0)
    total = NOTHING
    for powers, terms in parts.items():
        product = Formula(terms)
        for value, power in zip(values.values(), powers, strict=True):
            for _ in range(power):
                product = budget.product(product, value)
        for _ in range((most - heavy[powers]) if below != CONSTANT_ONE else 0):
            product = budget.product(product, below)
        total = total + product
    return total


def hamiltons_rows(space: Space, at: Places, above: Formula, below: Formula, budget: Budget
                   ) -> tuple[list[Formula], list[Formula]]:  # fmt: skip
    """q̇ - ∂H/∂p and ṗ + ∂H/∂q of H = above/below, cleared of denominators; ``below`` has no momenta and no rates."""
    relations, slopes = [], []
    for k in range(space.n):
        relations.append(budget.product(below, space.w(k)) - space.by_symbol(above, at.momenta[k]))
        slope = budget.product(space.by_angle(above, k), below) - budget.product(above, space.by_angle(below, k))
        slopes.append(budget.product(budget.product(below, below), space.symbol(at.slopes[k])) + slope)
    return relations, slopes


def legendre(space: Space, at: Places, above: Formula, below: Formula, momenta: Momenta, budget: Budget
             ) -> Formula | None:  # fmt: skip
    """L = Σ p q̇ - H with H = above/below, in coordinates and rates; None where it is no formula without denominator."""
    if not momenta.divided:
        return None
    values = dict(zip(at.momenta, momenta.above, strict=True))
    energy = substituted(space, above, values, dict.fromkeys(at.momenta, 1), CONSTANT_ONE, budget)
    hamiltonian = exact_quotient(space, energy, below)
    if hamiltonian is None:
        return None
    return add(budget.product(p, space.w(k)) for k, p in enumerate(momenta.above)) - hamiltonian
