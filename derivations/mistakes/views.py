"""Exact work on rows: seeing them in other angles, with all lengths equal, and up to a factor."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from ..algebra.symbols import Symbols
from ..algebra.trig import CONSTANT_ONE, COS, NOTHING, Formula, Key, Space
from ..steps.derivation import Row
from .known_mistakes import View


def columns_to_absolute(m: Symbols) -> tuple[dict[int, int], ...]:
    """Relative angles by absolute ones: q_k = θ_k - θ_parent."""
    return tuple({k: 1} | ({m.parent(k): -1} if m.parent(k) >= 0 else {}) for k in range(m.n))


def columns_to_relative(m: Symbols) -> tuple[dict[int, int], ...]:
    """Absolute angles by relative ones: θ_k = Σ q over the links from the support to k."""
    columns: list[dict[int, int]] = []
    for k in range(m.n):
        carried = columns[m.parent(k)] if m.parent(k) >= 0 else {}
        columns.append({**carried, k: 1})
    return tuple(columns)


def merged(view: View, f: Formula) -> Formula:
    """All lengths, all masses, written as the first, where the derivation has one symbol for them."""
    n = view.symbols.n
    places: dict[int, int] = {}
    if view.equal_lengths:
        places |= {2 * n + k: 2 * n for k in range(1, n)}
    if view.equal_masses:
        places |= {3 * n + k: 3 * n for k in range(1, n)}
    return view.symbols.space.rename(f, places) if places else f


def for_view(view: View, rows: Sequence[Row]) -> list[Row]:
    """The rows of a derivation as a view has them: Lagrange's rows of the relative angles, symbols merged."""
    m = view.symbols
    if view.relative:
        rows = _relative_rows(m, rows)
    if not (view.equal_lengths or view.equal_masses):
        return list(rows)
    return [{q: g for q, f in row.items() if (g := merged(view, f))} for row in rows]


def _relative_rows(m: Symbols, rows: Sequence[Row]) -> list[Row]:
    sums: list[Row] = [{} for _ in rows]
    for j, row in enumerate(rows):
        i = j
        while i >= 0:
            for q, f in row.items():
                sums[i][q] = sums[i].get(q, NOTHING) + f * m.divisor(j)
            i = m.parent(i)
    return [{q: f for q, f in row.items() if f} for row in sums]


def is_multiple(row: Row, base: Row) -> bool:
    """Whether row = factor · base for some factor, proved by multiplying crosswise with one coefficient of each."""
    if not row or row.keys() != base.keys():
        return False
    pivot = min(base, key=lambda q: (len(base[q]), len(row[q]), q))
    mine, theirs = row[pivot], base[pivot]
    return all(row[q] * theirs == base[q] * mine for q in base)


def exact_factor(row: Row, base: Row, agreed: Iterable[int] | None = None) -> Formula | None:
    """The factor in row = factor · base, from coefficients that ``agreed``; None where none of them can be divided."""
    shared = [q for q in (agreed if agreed is not None else base) if q in row and q in base]
    for q in sorted(shared, key=lambda q: (len(base[q]), len(row[q]), q)):
        factor = divided(row[q], base[q])
        if factor is not None and all(row[p] == base[p] * factor for p in shared):
            return factor
    return None


def divided(f: Formula, by: Formula) -> Formula | None:
    """f / by where it is easily told: by a single product, a single term with the same wave, or term against term."""
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
