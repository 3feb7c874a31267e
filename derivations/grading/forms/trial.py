"""Tries mistakes on the right rows: do they give the accelerations of the rows as written, or that Lagrangian?

At the accelerations that the written rows give, every right row leaves a remainder, and a mistake adds to it what it
adds to that row. So mistakes explain what is written where the sums are zero, however the rows were combined or solved,
and two mistakes that do are found by looking one up for the other. All this at one random point first, then exactly.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from ...algebra.equivalence import System, compare, solve
from ...algebra.fingerprint import PRIME, point_of
from ...algebra.multiples import is_multiple
from ...algebra.trig import CONSTANT_ONE, NOTHING, Formula
from ...mistakes.anywhere.parts import AnyMistake
from ...steps.derivation import lagrange_rows
from ...steps.mechanism import Mechanism
from ..judge import one_scale

Mark = tuple[int, ...]


class Trial:
    """The rows as written, and the right ones, at a random point.

    ``scaled``: they are a Lagrangian's, ``scales`` times the right ones; else only the accelerations count.
    """

    def __init__(
        self, m: Mechanism, written: Sequence[Formula], right: Sequence[Formula], scales: Sequence[Formula] | None
    ) -> None:
        self.m, self.space, self.point = m, m.space, point_of(m.space)
        self.written, self.right, self.scaled = list(written), list(right), scales is not None
        self.given = System(self.space, written, self.point)
        self.usable = self.given.linear and len(self.given.lines) == self.space.n
        self.solution = self._solved(self.given.numbers) if self.usable else None
        self.flat = self.scaled or self.solution is None  # no accelerations: then the rows are compared as they are
        self._right_numbers = System(self.space, right, self.point).numbers
        values = [self.point.value(f) for f in scales or (CONSTANT_ONE,)]
        self._factors = [pow(x, -1, PRIME) for x in values if x]
        self._changes: dict[int, tuple[AnyMistake, dict[int, Formula]]] = {}

    @cached_property
    def wanted(self) -> list[Mark]:
        """What mistakes must add up to: for each scale that a Lagrangian may have, or once."""
        if not self.flat:
            return [tuple(-x % PRIME for x in self._remainder(self._right_numbers))]
        right, given = _flat(self._right_numbers), _flat(self.given.numbers)
        return [tuple((x * f - y) % PRIME for x, y in zip(given, right, strict=True)) for f in self._factors]

    def mark(self, mistake: AnyMistake) -> Mark | None:
        """What a mistake adds; None where it changes nothing."""
        made = self.changes(mistake)
        return self.mark_of(made) if made else None

    def mark_of(self, made: Mapping[int, Formula]) -> Mark:
        """What these changes of rows add."""
        numbers = [[0] * (self.space.n + 1)] * self.space.n
        for i, f in made.items():
            numbers[i] = self._numbers(f)
        return tuple(_flat(numbers)) if self.flat else tuple(self._remainder(numbers))

    def may_explain(self, mistake: AnyMistake) -> bool:
        """False where a mistake alone adds something else at the random point."""
        return self.flat or self.mark(mistake) in self.wanted

    def explains(self, *mistakes: AnyMistake) -> bool:
        """Whether the right rows with these mistakes give what is written; proved."""
        made: dict[int, Formula] = {}
        for mistake in mistakes:
            for i, f in self.changes(mistake).items():
                made[i] = made.get(i, NOTHING) + f
        made = {i: f for i, f in made.items() if f}
        if not made:
            return False
        numbers = list(self._right_numbers)
        for i, f in made.items():
            numbers[i] = [(x + y) % PRIME for x, y in zip(numbers[i], self._numbers(f), strict=True)]
        rows = [f + made.get(i, NOTHING) for i, f in enumerate(self.right)]
        if self.scaled:
            return _proportional([_flat(self.given.numbers)], [_flat(numbers)]) and one_scale(
                self.space, self.written, rows
            )
        if self.solution is None:  # the mistake leaves an acceleration out: then row by row
            split = self.space.split
            return _proportional(self.given.numbers, numbers) and all(
                is_multiple(split(f), split(g)) for f, g in zip(self.written, rows, strict=True)
            )
        if self._solved(numbers) != self.solution:
            return False
        return compare(self.given, System(self.space, rows, self.point)).answer in ("same", "not proved")

    def changes(self, mistake: AnyMistake) -> dict[int, Formula]:
        """What a mistake adds to each row."""
        kept = self._changes.get(id(mistake))
        if kept is None:
            changes = dict(mistake.rows)
            if mistake.energy:
                for i, f in enumerate(lagrange_rows(self.space, self.m.valued(mistake.energy))):
                    changes[i] = changes.get(i, NOTHING) + f
            kept = self._changes[id(mistake)] = mistake, {i: f for i, f in changes.items() if f}
        return kept[1]

    def _numbers(self, f: Formula) -> list[int]:
        found = System(self.space, [f], self.point).numbers
        return found[0] if found else [0] * (self.space.n + 1)

    def _remainder(self, numbers: Sequence[Sequence[int]]) -> Iterator[int]:
        """Rows at the accelerations that the written ones give."""
        assert self.solution is not None
        for row in numbers:
            yield (sum(a * x for a, x in zip(row, self.solution, strict=False)) + row[-1]) % PRIME

    def _solved(self, rows: Sequence[Sequence[int]]) -> list[int] | None:
        n = self.space.n
        return solve([row[:n] for row in rows], [-row[n] % PRIME for row in rows])


def _flat(rows: Sequence[Sequence[int]]) -> list[int]:
    return [x for row in rows for x in row]


def _proportional(one: Sequence[Sequence[int]], other: Sequence[Sequence[int]]) -> bool:
    """Whether each row is a multiple of the other's, modulo PRIME."""
    for x, y in zip(one, other, strict=True):
        pivot = next((k for k, value in enumerate(y) if value), None)
        if pivot is None or not x[pivot]:
            return False
        if any((a * y[pivot] - b * x[pivot]) % PRIME for a, b in zip(x, y, strict=True)):
            return False
    return True
