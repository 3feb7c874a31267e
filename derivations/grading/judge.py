"""Decides whether a derivation is right, as it is meant or on a condition, exactly."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from flint import fmpq

from ..algebra.equivalence import Comparison, Numbers, System, compare, differs_at_point
from ..algebra.fingerprint import RandomPoint, point_of
from ..algebra.multiples import is_multiple
from ..algebra.trig import COS, Formula, Key, Space, constant
from ..reading.submission import Submission
from ..steps.derivation import lagrange_rows
from ..steps.mechanism import Mechanism
from .hypotheses import MOST_LINKS_FREE, Hypothesis, Said, absent, hypotheses, simple_values, value_words

MOST_FITTED = 4  # links; nobody writes numbers for more
MOST_FITTED_ANYHOW = 2  # links up to which numbers are looked for in every convention
GRAVITIES = ("9.80665", "9.81", "9.8", "10")


DIFFERENT = Comparison("different")


@dataclass(frozen=True)
class Judgement:
    """``hypothesis``: under which the derivation is right, or all that is there is; None where it is wrong."""

    hypothesis: Hypothesis | None
    comparison: Comparison = DIFFERENT

    @property
    def assumes(self) -> tuple[Said, ...]:
        """What the verdict rests on beyond what the file says."""
        return self.hypothesis.assumes if self.hypothesis else ()


WRONG = Judgement(None)


class Judge:
    """Holds one derivation against mechanisms, at one random point and then exactly."""

    def __init__(self, s: Submission) -> None:
        self.s = s
        self.space = s.space
        self.point = point_of(s.space)
        rows = [f for _, f in s.rows] if s.lagrangian is None else lagrange_rows(s.space, s.lagrangian)
        self.rows = rows
        self._systems: dict[int, System] = {}
        self._points: dict[tuple[tuple[int, int], ...], RandomPoint] = {}

    def given(self, h: Hypothesis) -> System:
        """The rows of the derivation with what their symbols stand for."""
        key = id(h.variant.given) if h.variant.given else 0
        if key not in self._systems:
            values = h.variant.given
            rows = [self.space.replace(f, values) for f in self.rows] if values else self.rows
            self._systems[key] = System(self.space, rows, self.point)
        return self._systems[key]

    def holds(self, h: Hypothesis) -> Comparison:
        """Whether the derivation is right for one hypothesis."""
        given = self.given(h)
        if self.s.lagrangian is None:
            if differs_at_point(given, self.right_numbers(h.mechanism)):
                return DIFFERENT
            return compare(given, h.mechanism.system)
        moved = self.s.mechanism.given if self.s.mechanism else ()  # as given: it has no row
        rows, free, forced = (
            [row for k, row in enumerate(x) if k not in moved]
            for x in (_given_rows(self, h), h.mechanism.free_rows, h.mechanism.rows)
        )
        # T - U has no forces; those that have a potential, as a constant drive F has -F x, may be in U as well
        right = one_scale(self.space, rows, free) or one_scale(self.space, rows, forced)
        return Comparison("same" if right else "different")

    def right_numbers(self, m: Mechanism) -> list[Numbers]:
        """The right rows at the point; those of a mechanism with values without multiplying the values out."""
        plain = m.without_values
        if plain is None or not m.values_are_constant:
            return m.system.numbers
        key = tuple((place, self.point.value(m.valued(self.space.symbol(place)))) for place in m.values)
        point = self._points.get(key)
        if point is None:
            point = self._points[key] = self.point.elsewhere(dict(key))
        return [[point.value(f) for f in row] for row in plain.system.lines]


def one_scale(space: Space, rows: Sequence[Formula], right: Sequence[Formula]) -> bool:
    """Whether the rows of a Lagrangian are the right ones, all times one factor of parameters alone."""
    return is_multiple(_coefficients(space, rows), _coefficients(space, right))


Place = tuple[int, ...]  # row, motion, coordinates outside waves, wave and its phase


def _coefficients(space: Space, rows: Sequence[Formula]) -> dict[Place, Formula]:
    """The coefficient, of parameters alone, of each product of motion and wave in each row."""
    parts: dict[Place, dict[Key, fmpq]] = {}
    for i, row in enumerate(rows):
        for (e, h, s), c in row.terms.items():
            q, outside = space.motion(e), space.outside(e)
            parts.setdefault((i, q, outside, h, s), {})[e - q - outside, 0, COS] = c
    return {place: Formula(terms) for place, terms in parts.items()}


def judge(s: Submission, *, pinned: bool = False) -> Judgement:
    """Whether the derivation is right: as it is declared, else on the weakest condition that is found."""
    court = Judge(s)
    tried: list[Hypothesis] = []
    for h in hypotheses(s, pinned=pinned):
        answer = court.holds(h)
        if answer.answer != "different":
            return Judgement(h, answer)
        tried.append(h)
    if pinned or s.space.n > MOST_LINKS_FREE:
        return WRONG
    for h in tried:
        for special in _specials(court, h):
            answer = court.holds(special)
            if answer.answer != "different":
                return Judgement(special, answer)
    return WRONG


def _specials(court: Judge, h: Hypothesis) -> Iterator[Hypothesis]:
    """The same with values for the parameters that the derivation never mentions."""
    s, space = court.s, court.space
    places = absent(s, h.mechanism) if s.mechanism is None else []
    if not places or s.kind in ("links", "mechanism"):
        return
    for values in simple_values(s, places):
        yield _special(h, space, values)
    likely = h.convention == s.convention or space.n <= MOST_FITTED_ANYHOW
    if likely and len(court.given(h).lines) == space.n <= MOST_FITTED:
        from .fitted_values import fitted  # numpy, which a first verdict need not wait for

        fixed, unknown = _fixed(s, places)
        free = [p for p in places if p not in fixed]
        found = fitted(space, [*_given_rows(court, h)], h.mechanism.rows, free, fixed) if free else fixed
        if found is not None:
            yield _special(h, space, found, unknown)


def _given_rows(court: Judge, h: Hypothesis) -> list[Formula]:
    space = court.space
    rows = court.rows
    return [space.replace(f, h.variant.given) for f in rows] if h.variant.given else rows


def _special(h: Hypothesis, space: Space, values: dict[int, Formula], per_gravity: bool = False) -> Hypothesis:
    said = value_words(space, values, per_gravity)
    return replace(h, mechanism=h.mechanism.with_values(values), assumes=(*h.assumes, said))


def _fixed(s: Submission, places: list[int]) -> tuple[dict[int, Formula], bool]:
    """Values for what the equations do not determine: the scale of all masses, and of lengths and gravity together.

    Also whether gravity is none of the numbers written, so that lengths are known over g alone.
    """
    n, names = s.space.n, s.space.names
    masses = [p for p in places if names[p][0] == "m"]
    fixed = {masses[0]: constant(1)} if len(masses) == n else {}
    if s.space.names.index("rho") in places:
        fixed[s.space.names.index("rho")] = constant(1)
    unknown = False
    lengths, g = [p for p in places if names[p][0] == "l"], names.index("g")
    if g in places and len(lengths) == n:
        text = s.source
        number = next((x for x in GRAVITIES if re.search(rf"(?<![0-9.]){re.escape(x)}(?![0-9])", text)), "1")
        unknown = number == "1"
        whole, _, decimals = number.partition(".")
        fixed[g] = constant(fmpq(int(whole + decimals), 10 ** len(decimals)))
    return fixed, unknown
