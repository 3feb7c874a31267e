"""Points: row by row, or for a Lagrangian, term by term."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from ..algebra.equivalence import System, compare
from ..algebra.fingerprint import point_of
from ..algebra.trig import Formula
from ..grading.differences import Scaled, Terms, lagrangian_scalings, right_rows, scalings, term_finding, terms
from ..grading.grade_record import Grade, WrongTerm
from ..reading.submission import Submission
from ..steps.stages import StageName
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
    if s.stages is not None or problem.points.stages:
        parts = _stages(problem, s, grade)
    elif s.uses_momenta:
        parts = (_first_order(problem, s, grade),)
    else:
        parts = _lagrangian(problem, s, grade) if s.lagrangian is not None else _rows(problem, s, grade)
    off = problem.points.each_mistake
    if off is None or grade.verdict != "wrong" or not grade.mistakes:
        return parts
    total = problem.points.total
    made = max(len(grade.mistakes), sum(mark.outcome == "wrong" for mark in grade.stages))
    left = max(Fraction(0), total - off * made)
    whole = Part("the derivation", "導出全体", "wrong", float(left), float(total))
    return (whole, *(Part(p.name, p.name_ja, p.outcome, 0.0, 0.0, p.terms) for p in parts))


TITLES: dict[StageName, tuple[str, str]] = {
    "positions": ("positions", "位置"), "velocities": ("velocities", "速度"),
    "kinetic": ("kinetic energy", "運動エネルギー"), "potential": ("potential energy", "位置エネルギー"),
    "lagrangian": ("Lagrangian", "ラグランジアン"), "momenta": ("momenta", "運動量"),
    "hamiltonian": ("Hamiltonian", "ハミルトニアン"), "equations": ("equations of motion", "運動方程式"),
    "solved": ("solved equations", "解いた式"),
}  # fmt: skip


def _stages(problem: Problem, s: Submission, grade: Grade) -> tuple[Part, ...]:
    """Each stage that is asked; those that are given where the problem asks none in particular, each the same."""
    points = problem.points
    marked = {mark.stage: mark for mark in grade.stages}
    asked = points.stages or tuple((stage, points.total / len(marked)) for stage in TITLES if stage in marked)
    parts = []
    for stage, worth in asked:
        name, name_ja = TITLES[stage]
        mark = marked.get(stage)
        if mark is None:
            parts.append(_only(stage, worth, problem, s, grade))
        elif mark.outcome == "wrong":
            left = left_of(worth, len(mark.findings), mark.of, points)
            parts.append(Part(name, name_ja, "wrong", left, float(worth), mark.findings))
        else:
            parts.append(Part(name, name_ja, "right", float(worth), float(worth)))
    return tuple(parts)


def _only(stage: StageName, worth: Fraction, problem: Problem, s: Submission, grade: Grade) -> Part:
    """A stage that is not marked: the whole of a submission that has no other, or missing."""
    name, name_ja = TITLES[stage]
    whole = "lagrangian" if s.lagrangian is not None and s.first_order is None else (
        "hamiltonian" if s.first_order is not None and s.first_order.hamiltonian else "equations")  # fmt: skip
    if s.stages is not None or stage != whole:
        return Part(name, name_ja, "missing", 0.0, float(worth))
    alone = replace(problem, points=replace(problem.points, stages=(), rows=(), total=worth, each_mistake=None))
    inside = marks(alone, s, grade)
    points = sum(part.points for part in inside)
    terms = tuple(term for part in inside for term in part.terms)
    outcome: Outcome = "right" if all(part.outcome == "right" for part in inside) else "wrong"
    return Part(name, name_ja, outcome, points, float(worth), terms)


def _first_order(problem: Problem, s: Submission, grade: Grade) -> Part:
    """A Hamiltonian, or equations with momenta."""
    assert s.first_order is not None
    has_energy = s.first_order.hamiltonian is not None
    name, name_ja = ("the Hamiltonian", "ハミルトニアン") if has_energy else ("the equations", "方程式")
    total = problem.points.total
    if grade.verdict == "correct":
        return Part(name, name_ja, "right", float(total), float(total))
    truth = problem.truth(s).mechanism
    written = len(terms(s.space, truth.lagrangian, apart=True)) if has_energy else sum(
        len(terms(s.space, f)) for _, f in (*s.first_order.relations, *s.first_order.slopes))  # fmt: skip
    wrong = max(len(grade.findings), 1)
    return Part(name, name_ja, "wrong", left_of(total, wrong, written, problem.points), float(total), grade.findings)


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
        rights = [terms(space, f) for f in right_rows(s, truth.mechanism.rows)]
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
