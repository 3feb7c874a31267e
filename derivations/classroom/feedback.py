"""What the author of a submission is told, up to the problem's hint level."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from ..algebra.notation import pretty
from ..grading.grade_record import Grade
from .marks import TITLES, Part
from .problem import shown_points

ROW, TERM, CAUSE, SOLUTION = 1, 2, 3, 4
HEADS = {"correct": ("Right.", "正しい導出です。"), "wrong": ("Wrong.", "誤りがあります。"),
         "undecided": ("Not complete.", "まだ完成していません。")}  # fmt: skip
OUTCOMES = {"right": ("right", "正しい"), "wrong": ("wrong", "誤り"), "missing": ("missing", "ありません")}
Lines = tuple[str, ...]


def feedback(
    level: int, grade: Grade, parts: Sequence[Part], points: float, of: float, solution: Sequence[tuple[str, str]]
) -> tuple[Lines, Lines]:
    """Lines in English and Japanese. ``solution``: what is shown of it."""
    english, japanese = [HEADS[grade.verdict][0]], [HEADS[grade.verdict][1]]
    english[0] += f" {_points(points)} of {_points(of)} points."
    japanese[0] += f"{_points(of)} 点中 {_points(points)} 点。"
    if level >= ROW and grade.verdict != "correct":
        for part in parts:
            if part.terms or len(parts) > 1 or part.outcome != "right":
                en, ja = OUTCOMES[part.outcome]
                worth = f" ({_points(part.points)} of {_points(part.of)})" if part.of else ""
                en, ja = _followed(part, grade) or (en, ja)
                english.append(f"{part.name[0].upper()}{part.name[1:]}: {en}{worth}.")
                japanese.append(f"{part.name_ja}：{ja}{worth}。")
            if level >= TERM:
                for term in part.terms:
                    expected = f": found {pretty(term.found)}, expected {pretty(term.expected)}" * (level >= SOLUTION)
                    english.append(f"  Look at the term with {_term(term.term)}{expected}.")
                    japanese.append(f"  {_term(term.term)} の項を見直してください{expected}。")
    if level >= CAUSE and grade.verdict != "correct":
        english += [f"Cause: {says}" for says, _ in causes(grade, parts)]
        japanese += [f"原因：{says}" for _, says in causes(grade, parts)]
        if grade.right_for:
            english.append(f"It is right for another mechanism: {grade.right_for}.")
            japanese.append(f"別の機構の正しい式です：{grade.right_for_ja}。")
    if level >= CAUSE or grade.verdict == "correct":
        english += grade.notes
        japanese += grade.notes_ja
    english += [f"Solution, {label}: {line}" for label, line in solution]
    japanese += [f"解答 {label}：{line}" for label, line in solution]
    return tuple(english), tuple(japanese)


def _followed(part: Part, grade: Grade) -> tuple[str, str] | None:
    """A stage that is right only in so far as it follows from an earlier one."""
    for mark in grade.stages:
        if mark.outcome == "follows" and TITLES[mark.stage][0] == part.name:
            return "follows from your earlier stages, which are wrong", "前の段階から正しく導かれている"
    return None


def causes(grade: Grade, parts: Sequence[Part]) -> list[tuple[str, str]]:
    """Why it is wrong, in English and Japanese: the mistakes that are named, else what is wrong with each term."""
    if grade.mistakes:
        named = [(mistake.says, mistake.says_ja) for mistake in grade.mistakes]
        wrong = [mark for mark in grade.stages if mark.outcome == "wrong"]
        return named + [(term.says, term.says_ja) for mark in wrong[1:] for term in mark.findings]
    return [(term.says, term.says_ja) for part in parts for term in part.terms]


def _points(points: float) -> str:
    return shown_points(Fraction(points))


def _term(name: str) -> str:
    """A term's name without its sign."""
    return pretty(name.removeprefix("-"))
