"""Whether two systems of equations have the same solutions for the accelerations, with an exact proof either way.

A system is rows Σ A_ij α_j + b_i = 0, exact formulas. The rows given are right when each is a combination of the right
rows, with any factors (of parameters, angles and rates), and when nothing is lost: the matrix A given is regular.

- That they differ, or that A is regular, is proved by one point of a finite field where a number is not zero: a formula
  that vanishes everywhere vanishes there.
- That row g is a combination of the right rows S is proved by its bordered minors: with columns J in which the rows S
  are regular, det [S, g][J, j] = 0 for every other column j. These are multiplied out, and their terms cancel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

from flint import fmpq

from .fingerprint import PRIME, RandomPoint
from .quotient import Budget, TooLarge
from .trig import NOTHING, Formula, Key, Space, digits, unit
from .trig import ONE as _ONE

MOST_WORK = 3_000_000  # products of terms in one proof; some seconds
Line = list[Formula]  # coefficients of α₁ … αₙ, and what is left
Numbers = list[int]
Answer = Literal["same", "different", "incomplete", "not proved"]


@dataclass(frozen=True)
class Comparison:
    """``same``: proved equal. ``different``: proved different. ``incomplete``: right rows, but too few.

    ``not proved``: equal at the point, but the proof is too large to be multiplied out.
    ``needs_motion``: the rows determine the accelerations only while something moves.
    """

    answer: Answer
    needs_motion: bool = False


def line(space: Space, f: Formula) -> Line | None:
    """A row by its accelerations; None where they do not enter linearly."""
    parts: list[dict[Key, fmpq]] = [{} for _ in range(space.n + 1)]
    columns: dict[int, int] = {0: space.n} | {unit(k): k for k in range(space.n)}
    for (e, h, s), c in f.terms.items():
        moved = space.accelerations(e)
        k = columns.get(moved)
        if k is None:
            return None
        parts[k][e - moved, h, s] = c
    return [Formula(part) for part in parts]


class System:
    """Rows and their values at one random point of a finite field."""

    def __init__(self, space: Space, rows: Sequence[Formula], point: RandomPoint) -> None:
        lines = [line(space, f) for f in rows]
        self.space, self.point = space, point
        self.linear = all(x is not None for x in lines)
        self.lines: list[Line] = [x for x in lines if x is not None]
        self.numbers: list[Numbers] = [[point.value(f) for f in x] for x in self.lines]


def differs_at_point(given: System, right: Sequence[Numbers]) -> bool:
    """Whether the accelerations that the right rows have at the point do not satisfy the rows given: a proof."""
    n = given.space.n
    solution = solve([row[:n] for row in right], [-row[n] for row in right])
    if not given.linear or solution is None:
        return True
    return any((sum(a * x for a, x in zip(row, solution, strict=False)) + row[n]) % PRIME for row in given.numbers)


def compare(given: System, right: System) -> Comparison:
    """Whether the rows given have the solutions that the right rows have."""
    n = given.space.n
    if differs_at_point(given, right.numbers):
        return Comparison("different")
    if any(not any(row) for row in given.numbers) or rank([row[:n] for row in given.numbers]) < len(given.numbers):
        return Comparison("different")
    budget = Budget(MOST_WORK)
    transposed = [[right.numbers[i][j] for i in range(n)] for j in range(n)]
    try:
        for exact, numbers in zip(given.lines, given.numbers, strict=True):
            factors = solve(transposed, numbers[:n])
            support = [i for i, x in enumerate(factors or ()) if x]
            if not _is_combination(exact, right, support, budget):
                return Comparison("different")
    except TooLarge:
        return Comparison("not proved", _needs_motion(given))
    if len(given.lines) < n:
        return Comparison("incomplete")
    return Comparison("same", _needs_motion(given))


def _needs_motion(given: System) -> bool:
    """Whether the matrix is singular at rest: every product in its determinant has a rate."""
    n = given.space.n

    def at_rest(f: Formula) -> int:
        still = {key: c for key, c in f.terms.items() if not any(digits(key[0], 2 * n)[n:])}
        return given.point.value(Formula(still))

    still = [[at_rest(f) for f in row[:n]] for row in given.lines]
    return rank(still) < n


def _is_combination(given: Line, right: System, support: Sequence[int], budget: Budget) -> bool:
    rows = [right.lines[i] for i in support]
    columns = _pivots(right, support)
    if columns is None:
        return False
    for j in range(len(given)):
        if j in columns:
            continue
        chosen = [*columns, j]
        if determinant([[row[c] for c in chosen] for row in (*rows, given)], budget):
            return False
    return True


def _pivots(right: System, support: Sequence[int]) -> tuple[int, ...] | None:
    """Columns in which these rows are regular, with few terms."""
    size, n = len(support), right.space.n
    if size > 3:
        return tuple(support)  # a mass matrix is regular, and so are its principal minors
    regular = (
        columns
        for columns in combinations(range(n + 1), size)
        if rank([[right.numbers[i][c] for c in columns] for i in support]) == size
    )
    return min(regular, key=lambda cs: sum(len(right.lines[i][c]) for i in support for c in cs), default=None)


def determinant(a: Sequence[Sequence[Formula]], budget: Budget) -> Formula:
    """By minors of the columns, each multiplied out once."""
    size = len(a)
    minors: dict[tuple[int, ...], Formula] = {(): Formula({(0, 0, 0): _ONE})}
    for r in range(size):
        grown: dict[tuple[int, ...], Formula] = {}
        for columns, minor in minors.items():
            for c in range(size):
                if c in columns or not a[r][c] or not minor:
                    continue
                chosen = tuple(sorted((*columns, c)))
                part = budget.product(minor, a[r][c])
                if (len(columns) - chosen.index(c)) % 2:
                    part = -part
                grown[chosen] = grown.get(chosen, NOTHING) + part
        minors = grown
    return minors.get(tuple(range(size)), NOTHING)


def solve(a: Sequence[Sequence[int]], b: Sequence[int]) -> Numbers | None:
    """The solution of a square system modulo PRIME; None where it is singular."""
    n = len(a)
    rows = [[*row, x] for row, x in zip(a, b, strict=True)]
    for c in range(n):
        pivot = next((r for r in range(c, n) if rows[r][c] % PRIME), None)
        if pivot is None:
            return None
        rows[c], rows[pivot] = rows[pivot], rows[c]
        inverse = pow(rows[c][c], -1, PRIME)
        rows[c] = [x * inverse % PRIME for x in rows[c]]
        for r in range(n):
            if r != c and rows[r][c]:
                factor = rows[r][c]
                rows[r] = [(x - factor * y) % PRIME for x, y in zip(rows[r], rows[c], strict=True)]
    return [row[n] for row in rows]


def rank(a: Sequence[Sequence[int]]) -> int:
    """The rank of a matrix modulo PRIME."""
    rows = [[x % PRIME for x in row] for row in a]
    found = 0
    for c in range(len(rows[0]) if rows else 0):
        pivot = next((r for r in range(found, len(rows)) if rows[r][c]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        inverse = pow(rows[found][c], -1, PRIME)
        for r in range(found + 1, len(rows)):
            if rows[r][c]:
                factor = rows[r][c] * inverse % PRIME
                rows[r] = [(x - factor * y) % PRIME for x, y in zip(rows[r], rows[found], strict=True)]
        found += 1
    return found
