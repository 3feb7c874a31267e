"""Grades a derivation: right, or which term of which equation is wrong, and the mistake that produces it."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ..mistakes.known_mistakes import KnownMistakes
from ..steps.derivation import NEWTON_STAGES, Mistake
from .explain import Alignment, align, explanations
from .grade_record import Grade, NamedMistake, Verdict
from .prepared import Prepared, prepare
from .submission import Submission, parse_submission, read_submission
from .verdict import empty_and_repeated, is_correct_row_by_row, is_correct_together, matching
from .wrong_terms import WrongTermFinder

AFTER_LAGRANGIAN = ("momentum", "derivative", "equation", "matrix", *NEWTON_STAGES)  # no mistake in a Lagrangian


def grade(source: str | os.PathLike[str]) -> Grade:
    """Grade the derivation in a TOML file. Raises InvalidInput, with the place, where it is not one."""
    return grade_submission(read_submission(source))


def grade_text(toml: str) -> Grade:
    """Grade the text of such a file."""
    return grade_submission(parse_submission(toml))


def grade_submission(submission: Submission) -> Grade:
    """Grade what was read."""
    given = prepare(submission)
    if is_correct_row_by_row(given):
        return answer(given.known, "correct")
    if is_correct_together(given):
        note = "The rows are combinations of the documents' rows and give the same accelerations."
        note_ja = "各行は文献の式の一次結合で、同じ加速度を与えます。"
        return answer(given.known, "correct", notes=(note,), notes_ja=(note_ja,))
    matches = matching(given)
    if None not in matches and len(set(matches)) == len(matches):
        return _incomplete(given, {i for i in matches if i is not None})
    return _wrong(given)


def answer(known: KnownMistakes, verdict: Verdict, **parts: object) -> Grade:
    """A grade for a mechanism."""
    return Grade(verdict=verdict, system=known.symbols.kind, links=known.symbols.n, **parts)  # type: ignore[arg-type]


def _incomplete(given: Prepared, there: set[int]) -> Grade:
    """Every row is right, but not all are there."""
    missing = [f"θ{i + 1}" for i in range(given.known.symbols.n) if i not in there]
    note = f"The given equations are right; the equation of {' and '.join(missing)} is missing."
    note_ja = f"書かれている式は正しいですが、足りない式があります：{'、'.join(missing)}"
    return answer(given.known, "undecided", notes=(note,), notes_ja=(note_ja,))


def _wrong(given: Prepared) -> Grade:
    """Name the mistakes, and list the terms."""
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
