"""Names the mistake in a wrong derivation of any mechanism, in any form: solved, matrices, relative angles, momenta.

The accelerations that the rows give are held against those of every mistake in the mechanism's own derivation, at one
random point first, and then exactly: so it does not matter how the rows were combined or solved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...algebra.equivalence import System, compare, solve
from ...algebra.fingerprint import PRIME, point_of
from ...algebra.multiples import is_multiple
from ...algebra.notation import pretty
from ...algebra.trig import NOTHING, Formula
from ...mistakes.any_energies import energy_mistakes_anywhere
from ...mistakes.any_parts import AnyMistake, Parts, Words
from ...mistakes.any_rows import (
    carried_mistakes,
    derivative_mistakes,
    force_mistakes,
    slip_mistakes,
    small_angle_mistakes,
)
from ...mistakes.any_segments import segment_mistakes
from ...reading.submission import Submission
from ...steps.derivation import lagrange_rows
from ...steps.mechanism import Mechanism
from ..differences import authors
from ..grade_record import NamedMistake
from ..hypotheses import Hypothesis
from ..judge import one_scale

MOST_COORDINATES = 4
MOST_TERMS = 400  # in the right rows: a second or two
MOST_NAMED = 6
BODIES = {"rod-chain": ("rod", "棒"), "rods": ("rod", "棒"), "links": ("link", "リンク")}


def named_anywhere(s: Submission, h: Hypothesis) -> tuple[NamedMistake, ...]:
    """The first mistake that leads to what is written, with the others that lead to the same; () where none does."""
    m, space = h.mechanism, s.space
    if space.n > MOST_COORDINATES or sum(map(len, m.rows)) > MOST_TERMS:
        return ()
    is_lagrangian = s.lagrangian is not None
    written = lagrange_rows(space, s.lagrangian) if s.lagrangian is not None else [f for _, f in s.rows]
    if h.variant.given:
        written = [space.replace(f, h.variant.given) for f in written]
    finder = _Finder(m, written, m.free_rows if is_lagrangian else m.rows, scaled=is_lagrangian)
    if not finder.usable:
        return ()
    found: list[AnyMistake] = []
    for mistake in _all(s, h, words_of(s)):
        if is_lagrangian and mistake.rows:
            continue
        if finder.explains(mistake) and all(x.code != mistake.code for x in found):
            found.append(mistake)
            if len(found) == MOST_NAMED:
                break
    if not found:
        return ()
    first, *others = found
    also = tuple(x.code for x in others)
    return (NamedMistake(first.code, first.code, first.stage, first.english, first.japanese, also),)


def words_of(s: Submission) -> Words:
    """The author's names of coordinates, rates and bodies."""
    n = s.space.n
    if s.mechanism is not None:
        names = s.mechanism.coordinates
        return Words(names, tuple(f"{name}'" for name in names), tuple(b.name for b in s.mechanism.bodies))
    kind = BODIES.get(s.kind, ("mass", "質点"))[0]
    angles = tuple(pretty(authors(s, f"t{k}")) for k in range(1, n + 1))
    rates = tuple(pretty(authors(s, f"w{k}")) for k in range(1, n + 1))
    return Words(angles, rates, tuple(f"{kind} {k}" for k in range(1, n + 1)))


def _all(s: Submission, h: Hypothesis, words: Words) -> Iterator[AnyMistake]:
    """Earlier stages first: of mistakes that explain equally well, the first is named."""
    m = h.mechanism
    parts = Parts(m, words)
    yield from segment_mistakes(parts)
    yield from energy_mistakes_anywhere(parts)
    yield from derivative_mistakes(m, words)
    yield from carried_mistakes(m, words)
    if s.mechanism is not None:
        yield from force_mistakes(m, s.mechanism, h.convention, words)
        yield from small_angle_mistakes(m)
    yield from slip_mistakes(m, words)


class _Finder:
    """The rows as written, and the right ones, at a random point."""

    def __init__(self, m: Mechanism, written: Sequence[Formula], right: Sequence[Formula], *, scaled: bool) -> None:
        self.m, self.space, self.point = m, m.space, point_of(m.space)
        self.written, self.right, self.scaled = list(written), list(right), scaled
        self.given = System(self.space, written, self.point)
        self.numbers = System(self.space, right, self.point).numbers
        self.usable = self.given.linear and len(self.given.lines) == self.space.n
        self.solution = self._solved(self.given.numbers) if self.usable else None

    def _solved(self, rows: Sequence[Sequence[int]]) -> list[int] | None:
        n = self.space.n
        return solve([row[:n] for row in rows], [-row[n] % PRIME for row in rows])

    def explains(self, mistake: AnyMistake) -> bool:
        """Whether the right rows with this mistake give the accelerations of the rows as written; proved."""
        changes = dict(mistake.rows)
        if mistake.energy:
            for i, f in enumerate(lagrange_rows(self.space, self.m.valued(mistake.energy))):
                changes[i] = changes.get(i, NOTHING) + f
        made = {i: f for i, f in changes.items() if f}
        if not made:
            return False
        numbers = list(self.numbers)
        for i, f in made.items():
            (added,) = System(self.space, [f], self.point).numbers or [[0] * (self.space.n + 1)]
            numbers[i] = [(x + y) % PRIME for x, y in zip(numbers[i], added, strict=True)]
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
