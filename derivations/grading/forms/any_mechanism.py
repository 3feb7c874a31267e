"""Names the mistake in a wrong derivation of any mechanism, in any form: solved, matrices, relative angles, momenta.

The accelerations that the rows give are held against those of every mistake in the mechanism's own derivation, and of
every two mistakes (:mod:`.trial`): so it does not matter how the rows were combined or solved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from ...algebra.fingerprint import PRIME
from ...algebra.notation import pretty
from ...algebra.trig import NOTHING, ONE, Formula
from ...mistakes.anywhere.energies import energy_mistakes_anywhere
from ...mistakes.anywhere.parts import AnyMistake, Parts, Words
from ...mistakes.anywhere.rows import (
    carried_mistakes,
    derivative_mistakes,
    force_mistakes,
    slip_mistakes,
    small_angle_mistakes,
)
from ...mistakes.anywhere.segments import segment_mistakes
from ...reading.submission import Submission
from ...steps.derivation import lagrange_rows
from ...steps.mechanism import Mechanism
from ..differences import authors, lagrangian_scalings, right_rows
from ..grade_record import NamedMistake
from ..hypotheses import Hypothesis
from .brackets import bracket_slips
from .trial import Mark, Trial

MOST_COORDINATES = 4
MOST_TERMS = 400  # in the right rows: a second or two
MOST_NAMED = 6
MOST_SCALES = 4  # that a Lagrangian may have
MOST_PAIRS = 20  # that are proved
MOST_FIRST = 12  # that explain all but one row, and are followed by others
STRANGE = 2  # terms
BODIES = {"rod-chain": ("rod", "棒"), "rods": ("rod", "棒"), "links": ("link", "リンク")}


def named_anywhere(s: Submission, h: Hypothesis) -> tuple[NamedMistake, ...]:
    """The mistake that leads to what is written, with the others that lead to the same; two, where no one does; or ().

    Of several, the one that changes fewest terms comes first, and of those the one that is made earliest.
    """
    m, space = h.mechanism, s.space
    if space.n > MOST_COORDINATES or sum(map(len, m.rows)) > MOST_TERMS:
        return ()
    is_lagrangian = s.lagrangian is not None
    written = lagrange_rows(space, s.lagrangian) if s.lagrangian is not None else [f for _, f in s.rows]
    scales = None
    if s.lagrangian is not None:
        scales = [x.factor for x in lagrangian_scalings(space, s.lagrangian, m.lagrangian)[:MOST_SCALES]]
    if h.variant.given:
        written = [space.replace(f, h.variant.given) for f in written]
    trial = Trial(m, written, m.free_rows if is_lagrangian else m.rows, scales)
    if not trial.usable:
        return ()
    words = words_of(s)
    mistakes = [x for x in _all(s, h, words) if not (is_lagrangian and x.rows)]
    mistakes.sort(key=lambda x: (x.half_hidden, x.size))  # stable: as they were made, otherwise
    found = [mistake for mistake in mistakes if trial.may_explain(mistake) and trial.explains(mistake)]
    found = found or _of_brackets(trial, words) or _in_solved_rows(s, trial, words)
    if found:
        return (_named(found),)
    pairs = [*_sums(trial, mistakes), *_derived(trial, mistakes, words)]
    pairs.sort(key=lambda pair: pair.cost)
    two = next(
        (x for x in (*pairs[:MOST_PAIRS], *_slipped(trial, mistakes, words)) if trial.explains(x.one[0], x.two[0])),
        None,
    )
    return () if two is None else (_named(two.one), _named(two.two))


def _of_brackets(trial: Trial, words: Words) -> list[AnyMistake]:
    slips = bracket_slips(trial, words, rows=not trial.scaled)
    return [slip for slip in slips[:MOST_NAMED] if trial.explains(slip)]


def _in_solved_rows(s: Submission, trial: Trial, words: Words) -> list[AnyMistake]:
    """Slips in rows that are solved for the accelerations, which the rows of motion do not have."""
    if trial.scaled:
        return []
    rows = right_rows(s, trial.right)
    if all(f is g for f, g in zip(rows, trial.right, strict=True)):
        return []
    solved = Trial(trial.m, trial.written, rows, None)
    slips = slip_mistakes(trial.space, dict(enumerate(rows)), _lengths(trial.m), words)
    return [slip for slip in slips if solved.explains(slip)] or _of_brackets(solved, words)


def _named(twins: Sequence[AnyMistake]) -> NamedMistake:
    """The first of mistakes that lead to the same equations, with the codes of the others."""
    first = twins[0]
    also = [code for code in dict.fromkeys(x.code for x in twins) if code != first.code][: MOST_NAMED - 1]
    return NamedMistake(first.code, first.code, first.stage, first.english, first.japanese, tuple(also))


@dataclass(frozen=True)
class _Pair:
    """Two mistakes that together explain what is written, each with those that lead to the same."""

    one: Sequence[AnyMistake]
    two: Sequence[AnyMistake]
    apart: bool  # the second is made as if the first were not

    @property
    def cost(self) -> int:
        """The terms that both change; more where derivatives are wrong, and yet those of the right energies."""
        one, two = self.one[0], self.two[0]
        strange = self.apart and bool(one.energy) != bool(two.energy) and "derivative" in (one.stage, two.stage)
        return one.size + two.size + STRANGE * strange


def _sums(trial: Trial, mistakes: Sequence[AnyMistake]) -> Iterator[_Pair]:
    """Two mistakes neither of which changes what the other adds."""
    marks: dict[Mark, list[AnyMistake]] = {}
    for mistake in mistakes:
        mark = trial.mark(mistake)
        if mark is not None:
            marks.setdefault(mark, []).append(mistake)
    place = {id(mistake): k for k, mistake in enumerate(mistakes)}
    for wanted in trial.wanted:
        for mark, twins in marks.items():
            other = tuple((x - y) % PRIME for x, y in zip(wanted, mark, strict=True))
            if other in marks and place[id(twins[0])] <= place[id(marks[other][0])]:
                yield _Pair(twins, marks[other], apart=True)


def _derived(trial: Trial, mistakes: Sequence[AnyMistake], words: Words) -> Iterator[_Pair]:
    """A mistake in the energies, and one in the derivatives of what those then are, in one row."""
    m, space = trial.m, trial.space

    def seconds(first: AnyMistake, row: int) -> Iterator[AnyMistake]:
        moving = {key: c for key, c in m.valued(first.energy).terms.items() if space.motion(key[0])}
        kinetic = m.kinetic + Formula(moving)
        potential = kinetic - m.lagrangian - m.valued(first.energy)
        return (x for x in derivative_mistakes(space, kinetic, potential, words) if set(x.rows) == {row})

    return _one_after_another(trial, [x for x in mistakes if x.energy], seconds)


def _slipped(trial: Trial, mistakes: Sequence[AnyMistake], words: Words) -> Iterator[_Pair]:
    """A mistake, and a slip in one term of a row that it leads to."""

    def seconds(first: AnyMistake, row: int) -> Iterator[AnyMistake]:
        changed = trial.right[row] + trial.changes(first).get(row, NOTHING)
        return slip_mistakes(trial.space, {row: changed}, _lengths(trial.m), words)

    return _one_after_another(trial, [x for x in mistakes if x.stage != "equation"], seconds)


def _one_after_another(
    trial: Trial, mistakes: Sequence[AnyMistake], seconds: Callable[[AnyMistake, int], Iterable[AnyMistake]]
) -> Iterator[_Pair]:
    """A mistake that explains all rows but one, and another of those that it may be followed by in that row."""
    if trial.flat:
        return
    (wanted,) = trial.wanted
    tried = 0
    for first in mistakes:
        mark = trial.mark(first)
        if mark is None:
            continue
        left = [i for i, (x, y) in enumerate(zip(wanted, mark, strict=True)) if x != y]
        if len(left) != 1:
            continue
        tried += 1
        if tried > MOST_FIRST:
            return
        rest = tuple((x - y) % PRIME for x, y in zip(wanted, mark, strict=True))
        found = sorted((x for x in seconds(first, left[0]) if trial.mark(x) == rest), key=lambda x: x.size)
        if found:
            yield _Pair([first], found, apart=False)


def words_of(s: Submission) -> Words:
    """The author's names of coordinates, rates and bodies."""
    n = s.space.n
    if s.mechanism is not None:
        names = s.mechanism.coordinates
        rates, accelerations = (tuple(name + dots for name in names) for dots in ("'", "''"))
        return Words(names, rates, accelerations, tuple(b.name for b in s.mechanism.bodies))
    kind = BODIES.get(s.kind, ("mass", "質点"))[0]
    angles, rates, accelerations = (
        tuple(pretty(authors(s, f"{letter}{k}")) for k in range(1, n + 1)) for letter in "twa"
    )
    return Words(angles, rates, accelerations, tuple(f"{kind} {k}" for k in range(1, n + 1)))


def _all(s: Submission, h: Hypothesis, words: Words) -> Iterator[AnyMistake]:
    """Earlier stages first: of mistakes that explain equally well, the first is named."""
    m = h.mechanism
    parts = Parts(m, words)
    yield from segment_mistakes(parts)
    yield from energy_mistakes_anywhere(parts)
    yield from derivative_mistakes(m.space, m.kinetic, m.potential, words)
    yield from carried_mistakes(m, words)
    if s.mechanism is not None:
        yield from force_mistakes(m, s.mechanism, h.convention, words)
        yield from small_angle_mistakes(m)
    yield from slip_mistakes(m.space, dict(enumerate(m.rows)), _lengths(m), words)


def _lengths(m: Mechanism) -> list[Formula]:
    """Those of segments, and the same without their numbers: l of l/2."""
    found: dict[Formula, None] = {}
    for x in (x for body in m.bodies for x in body.way):
        if x.length.is_monomial() and not m.space.by_time(x.length):
            found[m.valued(x.length)] = None
            found[Formula(dict.fromkeys(x.length.terms, ONE))] = None
    return [f for f in found if f.is_monomial() and not f.is_number()]
