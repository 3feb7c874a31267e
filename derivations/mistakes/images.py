"""Every derivation of the catalogue, right and wrong, as it looks at one random point."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from ..algebra.fingerprint import Point, Vector, combine
from ..algebra.symbols import Mechanism
from ..algebra.trig import unit
from ..steps.derivation import Derivation, Mistake, derive, right
from .catalogue import catalogue

# The catalogue grows with the cube of the links: beyond these, wrong terms are told one by one and no mistake is named.
MOST_LINKS = {"n-leg": 8, "rod-chain": 6}


@dataclass(frozen=True)
class View:
    """How rows are looked at: in which angles, and whether all lengths, all masses, are one symbol."""

    mechanism: Mechanism
    relative: bool = False
    equal_lengths: bool = False
    equal_masses: bool = False


@dataclass(frozen=True)
class Image:
    """One wrong derivation: the rows that differ from the right ones, as vectors, and what each differs by."""

    mistake: Mistake
    rows: dict[int, Vector]
    projective: dict[int, int]
    change: dict[int, int]  # the linear number of (wrong row - right row)
    terms: frozenset[tuple[int, int]]  # (row, product of motion) of every coefficient that differs


class Images:
    """All of them, for one view."""

    def __init__(self, view: View) -> None:
        self.view = view
        self.mechanism = view.mechanism
        self.point = Point(view.mechanism.space, view.equal_lengths, view.equal_masses)
        self._divisors = [self.point.value(self.mechanism.divisor(i)) for i in range(self.mechanism.n)]
        self._right_rows = right(self.mechanism).rows
        self._plain_right = [self.point.vector(row) for row in self._right_rows]
        self.right = self.rows(right(self.mechanism))
        self.right_projective = [self.point.projective(row) for row in self.right]

    def rows(self, d: Derivation) -> list[Vector]:
        """The rows of a derivation at the point: as the documents scale them, or for relative angles."""
        vectors = [
            seen if row is known else self.point.vector(row)
            for row, known, seen in zip(d.rows, self._right_rows, self._plain_right, strict=True)
        ]
        return self._to_relative(vectors) if self.view.relative else vectors

    def _to_relative(self, rows: list[Vector]) -> list[Vector]:
        """Lagrange's rows of the relative angles: row i sums, undivided, those of link i and of all that it carries."""
        m = self.mechanism
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
        return self.mechanism.n <= MOST_LINKS[self.mechanism.kind]

    @cached_property
    def wrong(self) -> list[Image]:
        """The catalogue's derivations that are really wrong; none where there are too many to be worked out."""
        if not self.has_catalogue:
            return []
        images = (self._image(mistake) for mistake in catalogue(self.mechanism))
        return [image for image in images if image.rows]

    @cached_property
    def equivalent(self) -> list[Mistake]:
        """The catalogue's mistakes that lead to right equations here."""
        wrong = {image.mistake.name for image in self.wrong}
        return [mistake for mistake in catalogue(self.mechanism) if mistake.name not in wrong]

    def _image(self, mistake: Mistake) -> Image:
        return self.image_of(mistake, self.rows(derive(self.mechanism, [mistake])))

    def image_of(self, mistake: Mistake, rows: list[Vector]) -> Image:
        """What a derivation's rows differ by from the right ones; a row that is only scaled does not count."""
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
        return Image(mistake, changed, projective, change, frozenset(terms))

    @cached_property
    def accelerations(self) -> list[int]:
        """The packed products that are α₁ … αₙ."""
        return [unit(k) for k in range(self.mechanism.n)]


@lru_cache(maxsize=8)
def images(view: View) -> Images:
    """The images for a view, kept for the next derivation that is graded."""
    return Images(view)
