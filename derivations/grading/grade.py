"""Grades a derivation: right, or which term of which equation is wrong, and the mistake that produces it."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ..mistakes.images import Images
from ..steps.derivation import NEWTON, Mistake
from .explain import Alignment, align, explanations
from .findings import Teller
from .given import Given, given_of
from .result import Diagnosis, Named, Verdict
from .submission import Submission, parse_submission, read_submission
from .verdict import empty_and_repeated, is_correct_row_by_row, is_correct_together, matching

AFTER_LAGRANGIAN = ("momentum", "derivative", "equation", "matrix", *NEWTON)  # no mistake in a Lagrangian


def grade(source: str | os.PathLike[str]) -> Diagnosis:
    """Grade the derivation in a TOML file. Raises InvalidInput, with the place, where it is not one."""
    return grade_submission(read_submission(source))


def grade_text(toml: str) -> Diagnosis:
    """Grade the text of such a file."""
    return grade_submission(parse_submission(toml))


def grade_submission(submission: Submission) -> Diagnosis:
    """Grade what was read."""
    given = given_of(submission)
    if is_correct_row_by_row(given):
        return answer(given.seen, "correct")
    if is_correct_together(given):
        note = "The rows are combinations of the documents' rows, and determine the same accelerations."
        note_ja = "各行は文献の式の一次結合で、同じ加速度を与えます。"
        return answer(given.seen, "correct", notes=(note,), notes_ja=(note_ja,))
    matches = matching(given)
    if None not in matches and len(set(matches)) == len(matches):
        return _incomplete(given, {i for i in matches if i is not None})
    return _wrong(given)


def answer(seen: Images, verdict: Verdict, **parts: object) -> Diagnosis:
    """A diagnosis for a mechanism."""
    return Diagnosis(verdict=verdict, system=seen.mechanism.kind, links=seen.mechanism.n, **parts)  # type: ignore[arg-type]


def _incomplete(given: Given, there: set[int]) -> Diagnosis:
    """Every row is right, but not all are there."""
    missing = [f"θ{i + 1}" for i in range(given.seen.mechanism.n) if i not in there]
    note = f"What is there is right; the equation of {' and '.join(missing)} is not there."
    note_ja = f"書かれている式は正しいですが、足りない式があります：{'、'.join(missing)}"
    return answer(given.seen, "undecided", notes=(note,), notes_ja=(note_ja,))


def _wrong(given: Given) -> Diagnosis:
    """Name the mistakes, and list the terms."""
    seen, teller = given.seen, Teller(given.seen)
    alignment = align(seen, given.vectors, [row.label for row in given.rows])
    found = explanations(seen, given.vectors, alignment)
    if given.lagrangian is not None:
        found = [ms for ms in found if all(mistake.stage not in AFTER_LAGRANGIAN for mistake in ms)]
    if not found:
        return _unexplained(given, teller, alignment)
    told = same_equations(seen, found)
    mistakes = told[0][0]
    findings = (
        teller.lagrangian(given.lagrangian, mistakes)
        if given.lagrangian is not None
        else teller.explained(mistakes, given.rows)
    )
    alternatives = tuple(tuple(mistake.name for mistake in others) for others, _ in told[1:])
    return answer(seen, "wrong", findings=findings, mistakes=named(*told[0]), alternatives=alternatives)


def _unexplained(given: Given, teller: Teller, alignment: Alignment) -> Diagnosis:
    spoilt = empty_and_repeated(given)
    if spoilt and given.lagrangian is None:
        return answer(given.seen, "wrong", findings=spoilt)
    if given.lagrangian is not None:
        note = "No mistake of the catalogue leads to this Lagrangian."
        note_ja = "このラグランジアンになる誤りは目録にありません。"
        findings = teller.lagrangian(given.lagrangian, ())
        return answer(given.seen, "wrong", findings=findings, notes=(note,), notes_ja=(note_ja,))
    findings = teller.unexplained(given, alignment)
    if given.seen.has_catalogue:
        return answer(given.seen, "wrong", findings=findings)
    note = "With so many links the terms are told one by one; mistakes of earlier steps are not looked for."
    note_ja = "リンクが多いので、違う項だけを示します（前の段階の誤りは探しません）。"
    return answer(given.seen, "wrong", findings=findings, notes=(note,), notes_ja=(note_ja,))


def named(mistakes: Sequence[Mistake], twins: Sequence[Sequence[Mistake]]) -> tuple[Named, ...]:
    """Mistakes as they are told, each with those that lead to the very same equations."""
    return tuple(
        Named(m.code, m.name, m.stage, m.english, m.japanese, tuple(twin.name for twin in others))
        for m, others in zip(mistakes, twins, strict=True)
    )


def same_equations(
    seen: Images, found: Sequence[tuple[Mistake, ...]]
) -> list[tuple[tuple[Mistake, ...], list[list[Mistake]]]]:
    """Explanations that are the same but for names of the same equations, told as one.

    Each with, for each of its mistakes, the others that lead to the very same equations.
    """
    numbers = {image.mistake.name: tuple(sorted(image.projective.items())) for image in seen.wrong}
    groups: dict[tuple[str, ...], tuple[tuple[Mistake, ...], list[list[Mistake]]]] = {}
    for mistakes in found:
        key = tuple(sorted(repr(numbers[mistake.name]) for mistake in mistakes))
        if key not in groups:
            groups[key] = (mistakes, [_twins(seen, numbers, mistake) for mistake in mistakes])
    return list(groups.values())


def _twins(seen: Images, numbers: dict[str, tuple[tuple[int, int], ...]], mistake: Mistake) -> list[Mistake]:
    mine = numbers[mistake.name]
    return [
        image.mistake
        for image in seen.wrong
        if numbers[image.mistake.name] == mine and image.mistake.name != mistake.name
    ]
