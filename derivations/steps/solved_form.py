"""The equations of motion solved for the accelerations, exactly: each row with one acceleration and the determinant."""

from __future__ import annotations

from collections.abc import Sequence

from ..algebra.symbols import Symbols
from ..algebra.trig import CONSTANT_ONE, NOTHING, Formula, unit
from .derivation import Row

MOST_SOLVED = 3  # angles; beyond them nobody writes the solution down


def is_solved(m: Symbols, rows: Sequence[Row]) -> bool:
    """Whether each row has just one acceleration, and no two the same."""
    accelerations = [[k for k in range(m.n) if unit(k) in row] for row in rows]
    return (
        m.n <= MOST_SOLVED
        and len(rows) == m.n
        and all(len(ks) == 1 for ks in accelerations)
        and len({ks[0] for ks in accelerations}) == m.n
    )


def solved_rows(m: Symbols, rows: Sequence[Row]) -> list[Row]:
    """det A · α_i + Σ_j adj A_ij b_j = 0, from the rows A α + b = 0."""
    n = m.n
    a = [[row.get(unit(k), NOTHING) for k in range(n)] for row in rows]
    rest = [{q: f for q, f in row.items() if q not in map(unit, range(n))} for row in rows]
    determinant = _determinant(a)
    result = []
    for i in range(n):
        row: Row = {unit(i): determinant}
        for j in range(n):
            cofactor = _determinant([[x for c, x in enumerate(r) if c != i] for k, r in enumerate(a) if k != j])
            if (i + j) % 2:
                cofactor = -cofactor
            for q, f in rest[j].items():
                row[q] = row.get(q, NOTHING) + cofactor * f
        result.append({q: f for q, f in row.items() if f})
    return result


def _determinant(a: list[list[Formula]]) -> Formula:
    if not a:
        return CONSTANT_ONE
    total = NOTHING
    for c, x in enumerate(a[0]):
        if x:
            minor = x * _determinant([[y for k, y in enumerate(row) if k != c] for row in a[1:]])
            total = total - minor if c % 2 else total + minor
    return total
