"""Names the mistake in a wrong derivation of any mechanism, in any form: solved, matrices, relative angles, momenta.

The accelerations that the rows give are held against those of every mistake in the mechanism's own derivation, and of
every two mistakes (:mod:`.trial`): so it does not matter how the rows were combined or solved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...algebra.fingerprint import PRIME
from ...algebra.notation import pretty
from ...algebra.trig import NOTHING, ONE, Formula
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
from ..differences import authors, lagrangian_scalings
from ..grade_record import NamedMistake
from ..hypotheses import Hypothesis
from .trial import Mark, Trial

MOST_COORDINATES = 4
MOST_TERMS = 400  # in the right rows: a second or two
MOST_NAMED = 6
MOST_SCALES = 4  # that a Lagrangian may have
MOST_PAIRS = 20  # that are proved
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
    mistakes = [x for x in _all(s, h, words_of(s)) if not (is_lagrangian and x.rows)]
    mistakes.sort(key=lambda x: (x.half_hidden, x.size))  # stable: as they were made, otherwise
    found = [mistake for mistake in mistakes if trial.explains(mistake)]
    if found:
        return (_named(found),)
    two = _pair(trial, mistakes) or (() if is_lagrangian else _one_after_another(trial, mistakes, words_of(s)))
    return tuple(_named(twins) for twins in two)


def _named(twins: Sequence[AnyMistake]) -> NamedMistake:
    """The first of mistakes that lead to the same equations, with the codes of the others."""
    first = twins[0]
    also = [code for code in dict.fromkeys(x.code for x in twins) if code != first.code][: MOST_NAMED - 1]
    return NamedMistake(first.code, first.code, first.stage, first.english, first.japanese, tuple(also))


def _pair(trial: Trial, mistakes: Sequence[AnyMistake]) -> tuple[list[AnyMistake], ...]:
    """Two mistakes that together lead to what is written, each with those that lead to the same; () where none do."""
    if trial.solution is None and not trial.scaled:
        return ()
    marks: dict[Mark, list[AnyMistake]] = {}
    for mistake in mistakes:
        mark = trial.mark(mistake)
        if mark is not None:
            marks.setdefault(mark, []).append(mistake)
    place = {id(mistake): k for k, mistake in enumerate(mistakes)}
    pairs = []
    for wanted in trial.wanted:
        for mark, twins in marks.items():
            other = tuple((x - y) % PRIME for x, y in zip(wanted, mark, strict=True))
            if other in marks and place[id(twins[0])] <= place[id(marks[other][0])]:
                pairs.append((twins, marks[other]))
    pairs.sort(key=lambda pair: sum(twins[0].size for twins in pair))
    return next((pair for pair in pairs[:MOST_PAIRS] if trial.explains(pair[0][0], pair[1][0])), ())


def _one_after_another(
    trial: Trial, mistakes: Sequence[AnyMistake], words: Words
) -> tuple[list[AnyMistake], list[AnyMistake]] | tuple[()]:
    """A mistake in the energies, and one made with the wrong energies in one row; () where no such two explain it.

    Without the second, all rows but that one are explained.
    """
    if trial.solution is None:
        return ()
    (wanted,) = trial.wanted
    for first in mistakes:
        mark = trial.mark(first) if first.energy else None
        if mark is None:
            continue
        left = [i for i, (x, y) in enumerate(zip(wanted, mark, strict=True)) if x != y]
        if len(left) != 1:
            continue
        m, space = trial.m, trial.space
        rows = {i: trial.right[i] + trial.changes(first).get(i, NOTHING) for i in left}
        moving = {key: c for key, c in m.valued(first.energy).terms.items() if space.motion(key[0])}
        kinetic = m.kinetic + Formula(moving)
        potential = kinetic - m.lagrangian - m.valued(first.energy)
        seconds = [
            *derivative_mistakes(space, kinetic, potential, words),
            *slip_mistakes(space, rows, _lengths(m)),
        ]
        rest = tuple((x - y) % PRIME for x, y in zip(wanted, mark, strict=True))
        found = [x for x in seconds if set(x.rows) == set(left) and trial.mark(x) == rest]
        found.sort(key=lambda x: x.size)
        if found and trial.explains(first, found[0]):
            return [first], found
    return ()


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
    yield from derivative_mistakes(m.space, m.kinetic, m.potential, words)
    yield from carried_mistakes(m, words)
    if s.mechanism is not None:
        yield from force_mistakes(m, s.mechanism, h.convention, words)
        yield from small_angle_mistakes(m)
    yield from slip_mistakes(m.space, dict(enumerate(m.rows)), _lengths(m))


def _lengths(m: Mechanism) -> list[Formula]:
    """Those of segments, and the same without their numbers: l of l/2."""
    found: dict[Formula, None] = {}
    for x in (x for body in m.bodies for x in body.way):
        if x.length.is_monomial() and not m.space.by_time(x.length):
            found[m.valued(x.length)] = None
            found[Formula(dict.fromkeys(x.length.terms, ONE))] = None
    return [f for f in found if f.is_monomial() and not f.is_number()]
