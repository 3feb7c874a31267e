"""Whether formulas, or rows of them, are multiples of one another, and by which factor; all exact."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import TypeVar

from .trig import CONSTANT_ONE, COS, NOTHING, Formula, Key, Space

Place = TypeVar("Place", int, tuple[int, ...])


def is_multiple(row: Mapping[Place, Formula], base: Mapping[Place, Formula]) -> bool:
    """Whether row = factor · base for some factor, proved by multiplying crosswise with one coefficient of each."""
    if not row or row.keys() != base.keys():
        return False
    pivot = min(base, key=lambda q: (len(base[q]), len(row[q]), q))
    mine, theirs = row[pivot], base[pivot]
    return all(row[q] * theirs == base[q] * mine for q in base)


def exact_factor(
    row: Mapping[int, Formula], base: Mapping[int, Formula], agreed: Iterable[int] | None = None
) -> Formula | None:
    """The factor in row = factor · base, from coefficients that ``agreed``; None where none of them can be divided."""
    shared = [q for q in (agreed if agreed is not None else base) if q in row and q in base]
    for q in sorted(shared, key=lambda q: (len(base[q]), len(row[q]), q)):
        factor = divided(row[q], base[q])
        if factor is not None and all(row[p] == base[p] * factor for p in shared):
            return factor
    return None


def divided(f: Formula, by: Formula) -> Formula | None:
    """f / by, where it is found without polynomial division: ``by`` is one product, one term, or matches term by term.

    None elsewhere, also where the quotient exists.
    """
    if by.is_monomial():
        return f * by.inverse_monomial()
    if len(by) == 1:
        ((e, h, phase), c), *_ = by.terms.items()
        if any((h2, phase2) != (h, phase) for _, h2, phase2 in f.terms):
            return None
        return Formula({(e2 - e, 0, COS): c2 / c for (e2, _, _), c2 in f.terms.items()})
    if len(f) != len(by):
        return None
    ((e, h, phase), c), *_ = by.terms.items()
    for (e2, h2, phase2), c2 in f.terms.items():
        if (h2, phase2) == (h, phase):
            factor = Formula({(e2 - e, 0, COS): c2 / c})
            if by * factor == f:
                return factor
    return None


def by_waves(space: Space, f: Formula) -> dict[Key, Formula]:
    """The coefficient, in l, m, g, ρ alone, of each product of motion and wave; what is constant is left out."""
    parts: dict[Key, Formula] = {}
    for (e, h, phase), c in f.terms.items():
        q = space.motion(e)
        if q or h:
            key = (q, h, phase)
            parts[key] = parts.get(key, NOTHING) + Formula({(e - q, 0, COS): c})
    return {key: part for key, part in parts.items() if part}


def common_factor(given: Mapping[Key, Formula], base: Mapping[Key, Formula]) -> Formula:
    """The factor between two Lagrangians that most of their terms bear out; 1 where they have none in common."""
    votes: Counter[Formula] = Counter()
    for key in given.keys() & base.keys():
        factor = divided(given[key], base[key])
        if factor is not None:
            votes[factor] += 1
    return max(votes, key=lambda f: (votes[f], f == CONSTANT_ONE)) if votes else CONSTANT_ONE
