"""Explains a derivation that is right under no hypothesis: mistakes of the catalogue, or the terms that differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..algebra.symbols import KINDS
from ..algebra.trig import NOTHING
from ..mistakes.known_mistakes import KnownMistakes
from ..reading.submission import Submission
from ..steps.conventions import Convention
from ..steps.derivation import NEWTON_STAGES, Mistake
from ..steps.stages import StageName
from .differences import aligned, lagrangian_differences, lagrangian_scalings, row_differences
from .explain import Alignment, align, explanations
from .forms.any_mechanism import named_anywhere
from .forms.hamilton import first_order_differences
from .forms.stages import StageJudge
from .forms.units import units_notes
from .grade_record import Grade, NamedMistake, StageMark, Verdict, WrongTerm
from .hypotheses import Hypothesis, hypotheses
from .other_mechanisms import in_relative_angles, right_for
from .prepared import Prepared, prepare
from .readback import readback
from .useless_rows import empty_and_repeated
from .wrong_terms import WrongTermFinder

AFTER_LAGRANGIAN = ("momentum", "derivative", "equation", "matrix", *NEWTON_STAGES)  # no mistake in a Lagrangian
MOST_LINKS_COMPARED = 4  # links up to which the terms are counted in every convention
MOST_TERMS_COMPARED = 2000
USELESS = ("row-empty", "row-repeated")


def wrong(s: Submission, *, pinned: bool = False) -> Grade:
    """Name the mistakes, and list the terms, in the meaning in which fewest are wrong; units first."""
    found = _wrong(s, pinned=pinned)
    units = units_notes(s)
    return replace(
        found,
        notes=(*(en for en, _ in units), *found.notes),
        notes_ja=(*(ja for _, ja in units), *found.notes_ja),
    )


def _wrong(s: Submission, *, pinned: bool) -> Grade:
    meant = next(hypotheses(s, pinned=True))
    found = Grade(verdict="wrong", links=s.space.n)
    if s.uses_momenta:
        nearest = meant if pinned else _nearest(s, meant)
        found = _with_cause(s, nearest, _by_terms(s, nearest, found))
        return replace(found, system=s.kind, reading=readback(s, nearest))
    if is_documents(s):
        found = _plainer(s, meant, _by_catalogue(prepare(s)))
    if not found.mistakes and not any(f.cause in USELESS for f in found.findings):
        nearest = meant if pinned else _nearest(s, meant)
        if nearest is not meant or not found.findings or s.space.n == 1:
            found = _by_terms(s, nearest, found)
            meant = nearest
        found = _with_cause(s, meant, found)
    other = right_for(s)
    if other is not None:
        found = replace(found, right_for=other[0], right_for_ja=other[1])
    return replace(found, system=s.kind, reading=readback(s, meant))


def _with_cause(s: Submission, h: Hypothesis, found: Grade) -> Grade:
    """The same with the one mistake that explains it, where it is more than the one term that differs."""
    named = named_anywhere(s, h)
    if not named or (len(found.findings) == 1 and _says_no_more(named[0], found.findings[0])):
        return found
    if len(found.findings) <= len(named) == 2 and all(x.stage == "equation" for x in named):
        return found  # the two terms, and no more
    return replace(found, mistakes=named)


def _says_no_more(mistake: NamedMistake, term: WrongTerm) -> bool:
    """Whether a mistake is a slip of the pen in the one term that differs: a sign has many causes, and none is said."""
    if mistake.cause == "bracket-slip":
        return term.cause != "term-wrong"  # which says nothing
    return mistake.stage == "equation" or (term.cause == "sign" and mistake.stage == "derivative")


UP_TO = ("position", "velocity", "speed", "energy", "lagrangian")
MADE_AT: dict[StageName, tuple[str, ...]] = {  # at which stages of the catalogue a mistake of a stated stage is made
    "positions": ("position",), "velocities": ("velocity", "speed"), "kinetic": ("velocity", "speed", "energy"),
    "potential": ("energy", "position"), "lagrangian": UP_TO, "hamiltonian": UP_TO, "equations": AFTER_LAGRANGIAN,
}  # fmt: skip


def named_in_stages(
    s: Submission, h: Hypothesis, found: StageJudge, marks: Sequence[StageMark]
) -> tuple[NamedMistake, ...]:
    """The mistakes of the catalogue that explain the first wrong stage, where all before it is right.

    Of two energies that are both wrong, neither follows from the other, and both are explained.
    """
    wrong_ones = [mark for mark in marks if mark.outcome == "wrong"]
    energies = [mark for mark in wrong_ones if mark.stage in ("kinetic", "potential")]
    named = [_named_in_stage(s, h, found, mark) for mark in (energies if wrong_ones[0] in energies else wrong_ones[:1])]
    return tuple(mistake for mistakes in named for mistake in mistakes)


def _named_in_stage(s: Submission, h: Hypothesis, found: StageJudge, mark: StageMark) -> tuple[NamedMistake, ...]:
    first = mark.stage
    plain = replace(s, stages=None)
    assert s.stages is not None
    if first in ("equations", "solved"):
        made = replace(plain, rows=s.stages.equations if first == "equations" else s.stages.solved)
    elif first in MADE_AT:
        made = replace(plain, lagrangian=found.lagrangian(found.only(first)))
    else:
        return ()
    if is_documents(s) and not h.variant.given:
        mistakes = _by_catalogue(prepare(made)).mistakes
        if mistakes and len(mistakes) < 3 and all(x.stage in MADE_AT.get(first, AFTER_LAGRANGIAN) for x in mistakes):
            return mistakes
    mistakes = named_anywhere(made, h)
    at_stage = all(x.stage in MADE_AT.get(first, AFTER_LAGRANGIAN) for x in mistakes)
    plain_slip = len(mark.findings) == 1 and any(_says_no_more(x, mark.findings[0]) for x in mistakes)
    return mistakes if at_stage and not plain_slip else ()


def if_as_declared(s: Submission) -> tuple[NamedMistake, ...]:
    """The mistakes in a derivation that is right in another convention, if the one that is declared was meant."""
    found = _by_catalogue(prepare(s)).mistakes if is_documents(s) and s.space.n <= MOST_LINKS_COMPARED else ()
    return found if len(found) <= s.space.n else ()


def is_documents(s: Submission) -> bool:
    """Whether the catalogue of mistakes is about this mechanism, in these symbols and angles."""
    plain = s.convention == Convention(relative=s.relative) and not {"I", "c"} & {letter for letter, _ in s.used}
    return plain and (s.kind in KINDS or (s.kind == "point-masses" and s.space.n <= 2))


def _plainer(s: Submission, meant: Hypothesis, found: Grade) -> Grade:
    """The same, but one wrong term rather than two mistakes in many; a Lagrangian in its own angles and scale."""
    if s.lagrangian is not None:
        if not found.mistakes:
            return _by_terms(s, meant, found)
        if s.relative:
            named = tuple(replace(x, says=in_relative_angles(x.says, s.kind, s.space.n),
                                  says_ja=in_relative_angles(x.says_ja, s.kind, s.space.n))
                          for x in found.mistakes)  # fmt: skip
            return replace(_by_terms(s, meant, found), mistakes=named)
        return found
    if len(found.mistakes) > 1:
        terms = row_differences(s, meant.mechanism)
        accused = {(f.term, f.row) for f in found.findings}
        if len(terms) < min(len(found.mistakes), len(accused)):
            return replace(found, findings=terms, mistakes=(), alternatives=())
    return found


def _by_terms(s: Submission, h: Hypothesis, found: Grade) -> Grade:
    """The terms that differ, in the author's coordinates, symbols and scale."""
    assumes = tuple(en for en, _ in h.assumes), tuple(ja for _, ja in h.assumes)
    found = replace(found, assumes=assumes[0], assumes_ja=assumes[1])
    if s.uses_momenta:
        return replace(found, findings=first_order_differences(s, h.mechanism, h.variant.given))
    if s.lagrangian is None:
        return replace(found, findings=row_differences(s, h.mechanism), notes=(), notes_ja=())
    terms, notes = lagrangian_differences(s, h.mechanism)
    return replace(found, findings=terms, notes=tuple(en for en, _ in notes), notes_ja=tuple(ja for _, ja in notes))


def _nearest(s: Submission, meant: Hypothesis) -> Hypothesis:
    """The meaning in which fewest terms are wrong; the declared one unless another has less than half of them."""
    written = s.rows or (("", s.lagrangian or NOTHING),)
    if s.space.n > MOST_LINKS_COMPARED or sum(len(f) for _, f in written) > MOST_TERMS_COMPARED:
        return meant
    best, fewest = meant, _count(s, meant) / 2
    for h in hypotheses(s):
        if h.variant.given:
            continue
        count = _count(s, h)
        if count < fewest:
            best, fewest = h, count
    return best


def _count(s: Submission, h: Hypothesis) -> int:
    if s.uses_momenta:
        return len(first_order_differences(s, h.mechanism, h.variant.given))
    if s.lagrangian is not None:
        return len(lagrangian_scalings(s.space, s.lagrangian, h.mechanism.lagrangian)[0].wrong)
    return sum(len(scaled.wrong) for _, scaled in aligned(s, h.mechanism.rows))  # without a word for each


def answer(known: KnownMistakes, verdict: Verdict, **parts: object) -> Grade:
    """A grade for a mechanism."""
    return Grade(verdict=verdict, system=known.symbols.kind, links=known.symbols.n, **parts)  # type: ignore[arg-type]


def _by_catalogue(given: Prepared) -> Grade:
    """Name the mistakes of the documents' mechanisms, and list the terms."""
    known, finder = given.known, WrongTermFinder(given.known)
    alignment = align(known, given.vectors, [row.label for row in given.rows])
    found = explanations(known, given.vectors, alignment)
    if given.lagrangian is not None:
        found = [ms for ms in found if all(mistake.stage not in AFTER_LAGRANGIAN for mistake in ms)]
    if not found:
        return _unexplained(given, finder, alignment)
    groups = same_equations(known, found)
    mistakes = groups[0][0]
    findings = (
        finder.lagrangian(given.lagrangian, mistakes)
        if given.lagrangian is not None
        else finder.explained(mistakes, given.rows)
    )
    alternatives = tuple(tuple(mistake.name for mistake in others) for others, _ in groups[1:])
    return answer(known, "wrong", findings=findings, mistakes=named(*groups[0]), alternatives=alternatives)


def _unexplained(given: Prepared, finder: WrongTermFinder, alignment: Alignment) -> Grade:
    useless = empty_and_repeated(given)
    if useless and given.lagrangian is None:
        return answer(given.known, "wrong", findings=useless)
    if given.lagrangian is not None:
        note = "No mistake in the catalogue leads to this Lagrangian."
        note_ja = "このラグランジアンになる誤りは目録にありません。"
        findings = finder.lagrangian(given.lagrangian, ())
        return answer(given.known, "wrong", findings=findings, notes=(note,), notes_ja=(note_ja,))
    findings = finder.unexplained(given, alignment)
    if given.known.has_catalogue:
        return answer(given.known, "wrong", findings=findings)
    note = "With so many links, wrong terms are listed one by one; mistakes in earlier steps are not searched for."
    note_ja = "リンクが多いので、違う項だけを示します（前の段階の誤りは探しません）。"
    return answer(given.known, "wrong", findings=findings, notes=(note,), notes_ja=(note_ja,))


def named(mistakes: Sequence[Mistake], twins: Sequence[Sequence[Mistake]]) -> tuple[NamedMistake, ...]:
    """Mistakes as records, each with the names of those that lead to the same equations."""
    return tuple(
        NamedMistake(m.code, m.name, m.stage, m.english, m.japanese, tuple(twin.name for twin in others))
        for m, others in zip(mistakes, twins, strict=True)
    )


def same_equations(
    known: KnownMistakes, found: Sequence[tuple[Mistake, ...]]
) -> list[tuple[tuple[Mistake, ...], list[list[Mistake]]]]:
    """Explanations grouped: those that lead to the same equations under other names are one.

    Each with, for each of its mistakes, the others that lead to the very same equations.
    """
    numbers = {entry.mistake.name: tuple(sorted(entry.projective.items())) for entry in known.wrong}
    groups: dict[tuple[str, ...], tuple[tuple[Mistake, ...], list[list[Mistake]]]] = {}
    for mistakes in found:
        key = tuple(sorted(repr(numbers[mistake.name]) for mistake in mistakes))
        if key not in groups:
            groups[key] = (mistakes, [_twins(known, numbers, mistake) for mistake in mistakes])
    return list(groups.values())


def _twins(known: KnownMistakes, numbers: dict[str, tuple[tuple[int, int], ...]], mistake: Mistake) -> list[Mistake]:
    mine = numbers[mistake.name]
    return [
        entry.mistake
        for entry in known.wrong
        if numbers[entry.mistake.name] == mine and entry.mistake.name != mistake.name
    ]
