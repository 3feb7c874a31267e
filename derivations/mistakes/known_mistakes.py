"""The catalogue of mistakes evaluated at one random point: the rows of each wrong derivation as numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from ..algebra.fingerprint import RandomPoint, Vector, combine
from ..algebra.trig import unit
from ..steps.derivation import Derivation, Mistake, correct_derivation, derive
from ..steps.views import View
from .catalogue import catalogue

# The catalogue grows with the cube of the links: beyond these, wrong terms are listed and no mistake is named.
MOST_LINKS = {"n-leg": 8, "rod-chain": 6}


@dataclass(frozen=True)
class KnownMistake:
    """One wrong derivation: the rows that differ from the right ones, as vectors, and what each differs by."""

    mistake: Mistake
    rows: dict[int, Vector]
    projective: dict[int, int]
    change: dict[int, int]  # the linear number of (wrong row - right row)
    terms: frozenset[tuple[int, int]]  # (row, product of motion) of every coefficient that differs


class KnownMistakes:
    """Every mistake of the catalogue, evaluated for one view."""

    def __init__(self, view: View) -> None:
        self.view = view
        self.symbols = view.symbols
        self.point = RandomPoint(view.symbols.space, view.equal_lengths, view.equal_masses)
        self._divisors = [self.point.value(self.symbols.divisor(i)) for i in range(self.symbols.n)]
        self._right_rows = correct_derivation(self.symbols).rows
        self._right_vectors = [self.point.vector(row) for row in self._right_rows]
        self.right = self.rows(correct_derivation(self.symbols))
        self.right_projective = [self.point.projective(row) for row in self.right]

    def rows(self, d: Derivation) -> list[Vector]:
        """The rows of a derivation at the point: as the documents scale them, or for relative angles."""
        vectors = [
            evaluated if row is right else self.point.vector(row)
            for row, right, evaluated in zip(d.rows, self._right_rows, self._right_vectors, strict=True)
        ]
        return self._to_relative(vectors) if self.view.relative else vectors

    def _to_relative(self, rows: list[Vector]) -> list[Vector]:
        """Lagrange's rows of the relative angles: row i sums, undivided, those of link i and its subtree."""
        m = self.symbols
        sums: list[Vector] = [{} for _ in rows]
        for j in range(m.n):
            i = j
            while i >= 0:
                sums[i] = combine([(1, sums[i]), (self._divisors[j], rows[j])])
                i = m.parent(i)
        return sums

    @property
    def has_catalogue(self) -> bool:
        """Whether the mechanism is short enough for all its mistakes to be worked out, which takes some seconds."""
        return self.symbols.n <= MOST_LINKS[self.symbols.kind]

    @cached_property
    def wrong(self) -> list[KnownMistake]:
        """The catalogue's derivations that are really wrong; none where there are too many to be worked out."""
        if not self.has_catalogue:
            return []
        entries = (self._entry(mistake) for mistake in catalogue(self.symbols))
        return [entry for entry in entries if entry.rows]

    @cached_property
    def equivalent(self) -> list[Mistake]:
        """The catalogue's mistakes that lead to right equations here."""
        wrong = {entry.mistake.name for entry in self.wrong}
        return [mistake for mistake in catalogue(self.symbols) if mistake.name not in wrong]

    def _entry(self, mistake: Mistake) -> KnownMistake:
        return self.evaluated(mistake, self.rows(derive(self.symbols, [mistake])))

    def evaluated(self, mistake: Mistake, rows: list[Vector]) -> KnownMistake:
        """The differences of a derivation's rows from the right ones; a row that is only scaled does not count."""
        changed, projective, change, terms = {}, {}, {}, set()
        for i, (row, base) in enumerate(zip(rows, self.right, strict=True)):
            if row is base or row == base:
                continue
            number = self.point.projective(row)
            if number != self.right_projective[i]:
                changed[i], projective[i] = row, number
                difference = combine([(1, row), (-1, base)])
                change[i] = self.point.linear(difference)
                terms |= {(i, q) for q in difference}
        return KnownMistake(mistake, changed, projective, change, frozenset(terms))

    @cached_property
    def accelerations(self) -> list[int]:
        """The packed products that are α₁ … αₙ."""
        return [unit(k) for k in range(self.symbols.n)]


@lru_cache(maxsize=8)
def known_mistakes(view: View) -> KnownMistakes:
    """The catalogue of the view's mechanism, evaluated; kept for the next derivation that is graded."""
    return KnownMistakes(view)
