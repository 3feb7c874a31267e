"""Points: row by row, or for a Lagrangian, term by term."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from ..algebra.equivalence import System, compare
from ..algebra.fingerprint import point_of
from ..algebra.trig import Formula
from ..grading.differences import Scaled, Terms, lagrangian_scalings, right_rows, scalings, term_finding, terms
from ..grading.grade_record import Grade, WrongTerm
from ..reading.submission import Submission
from .problem import Points, Problem

Outcome = Literal["right", "wrong", "missing"]
RIGHT = ("same", "incomplete", "not proved")


@dataclass(frozen=True)
class Part:
    """What has points of its own: a row, or the Lagrangian. ``terms``: those that are wrong."""

    name: str
    name_ja: str
    outcome: Outcome
    points: float
    of: float
    terms: tuple[WrongTerm, ...] = ()


def marks(problem: Problem, s: Submission, grade: Grade) -> tuple[Part, ...]:
    """The points of equations of motion or of a Lagrangian that was graded."""
    parts = _lagrangian(problem, s, grade) if s.lagrangian is not None else _rows(problem, s, grade)
    off = problem.points.each_mistake
    if off is None or grade.verdict != "wrong" or not grade.mistakes:
        return parts
    total = problem.points.total
    left = max(Fraction(0), total - off * len(grade.mistakes))
    whole = Part("the derivation", "導出全体", "wrong", float(left), float(total))
    return (whole, *(Part(p.name, p.name_ja, p.outcome, 0.0, 0.0, p.terms) for p in parts))


def left_of(worth: Fraction, wrong: int, terms_in_all: int, points: Points) -> float:
    """What is left of a part's points when some of its terms are wrong."""
    each = points.each_term if points.each_term is not None else worth / max(terms_in_all, 1)
    return float(max(Fraction(0), worth - each * wrong))


def _lagrangian(problem: Problem, s: Submission, grade: Grade) -> tuple[Part, ...]:
    total = problem.points.total
    assert s.lagrangian is not None
    name, name_ja = "the Lagrangian", "ラグランジアン"
    if grade.verdict == "correct":
        return (Part(name, name_ja, "right", float(total), float(total)),)
    best = lagrangian_scalings(s.space, s.lagrangian, problem.truth(s).mechanism.lagrangian)[0]
    found = tuple(term_finding(s, best, key, "", "The Lagrangian", name_ja) for key in best.wrong)
    return (
        Part(name, name_ja, "wrong", left_of(total, len(found), len(best.right), problem.points), float(total), found),
    )


def _rows(problem: Problem, s: Submission, grade: Grade) -> tuple[Part, ...]:
    n, space = s.space.n, s.space
    worth = problem.points.rows or (problem.points.total / n,) * n
    truth = problem.truth(s)
    given = [space.replace(f, truth.variant.given) if truth.variant.given else f for _, f in s.rows]
    if grade.verdict == "correct":
        good: dict[int, int] = {i: i for i in range(n)}
        bad: dict[int, tuple[int, Scaled]] = {}
    else:
        rights = [terms(space, f) for f in right_rows(s, truth.mechanism)]
        good = _placed(s, _right_ones(given, s, truth.mechanism.system), given, rights)
        left = [r for r in range(len(given)) if r not in good.values()]
        bad = _matched(s, {r: terms(space, given[r]) for r in left}, {i: rights[i] for i in range(n) if i not in good})
    parts = []
    for i in range(n):
        name, name_ja, of = f"row {i + 1}", f"第{i + 1}行", float(worth[i])
        if i in good:
            parts.append(Part(name, name_ja, "right", of, of))
        elif i in bad:
            r, scaled = bad[i]
            label = s.rows[r][0]
            found = tuple(term_finding(s, scaled, key, label, f"Row {label}", f"第{label}行") for key in scaled.wrong)
            points = left_of(worth[i], len(found), len(scaled.right), problem.points)
            parts.append(Part(name, name_ja, "wrong", points, of, found))
        else:
            parts.append(Part(name, name_ja, "missing", 0.0, of))
    return tuple(parts)


def _right_ones(given: Sequence[Formula], s: Submission, right: System) -> list[int]:
    """The rows that are combinations of the right rows, and of none another again."""
    found: list[int] = []
    for r in range(len(given)):
        system = System(s.space, [given[k] for k in (*found, r)], point_of(s.space))
        if compare(system, right).answer in RIGHT:
            found.append(r)
    return found


def _placed(s: Submission, found: list[int], given: Sequence[Formula], rights: list[Terms]) -> dict[int, int]:
    """Which right row each of these rows stands for: the one that it is most like, then the first that is free."""
    good = {i: r for i, (r, _) in _matched(
        s, {r: terms(s.space, given[r]) for r in found}, dict(enumerate(rights))).items()}  # fmt: skip
    for r in found:
        if r not in good.values():
            good[next(i for i in range(len(rights)) if i not in good)] = r
    return good


def _matched(s: Submission, given: dict[int, Terms], rights: dict[int, Terms]) -> dict[int, tuple[int, Scaled]]:
    """Right row to the given row that is most like it, and both at the best factor; labels decide between equals."""
    pairs = []
    for r, row in given.items():
        for i, right in rights.items():
            best = scalings(row, right)[0]
            score = 2 * best.agreeing - sum(map(len, row.values())) - sum(map(len, right.values()))
            pairs.append((-score, s.rows[r][0] != str(i + 1), abs(r - i), r, i, best))
    out: dict[int, tuple[int, Scaled]] = {}
    for _, _, _, r, i, best in sorted(pairs, key=lambda pair: pair[:5]):
        if i not in out and all(r != taken for taken, _ in out.values()):
            out[i] = (r, best)
    return out
