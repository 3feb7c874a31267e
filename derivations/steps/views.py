"""Rows in another form: for relative angles, or with one symbol for all lengths or all masses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..algebra.symbols import Symbols
from ..algebra.trig import NOTHING, Formula
from .derivation import Row


@dataclass(frozen=True)
class View:
    """How rows are looked at: in which angles, and whether all lengths, all masses, are one symbol."""

    symbols: Symbols
    relative: bool = False
    equal_lengths: bool = False
    equal_masses: bool = False


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
