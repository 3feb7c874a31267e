"""Holds one submission against a problem: its outcome, its points, and what its author is told."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

from ...models.errors import InvalidInput
from ..algebra.mathml import lines_html
from ..algebra.notation import pretty, text
from ..algebra.trig import digits
from ..grading.differences import authors
from ..grading.grade import graded
from ..grading.grade_record import Grade
from ..reading.derivation import read_derivation
from ..reading.submission import Submission, fields_of
from .feedback import feedback
from .marks import Part, marks
from .problem import Problem

Outcome = Literal["correct", "wrong", "undecided", "not read", "not graded"]


@dataclass(frozen=True)
class Assessment:
    """What one submission is worth. ``parts``: rows, or the Lagrangian; ``why``: it was not read, or not graded.

    ``feedback``: for its author, as far as the problem allows; ``solution``: label and right equation, for the teacher;
    ``grade``: all that was found, for the teacher.
    """

    who: str
    outcome: Outcome
    points: float
    of: float
    parts: tuple[Part, ...] = ()
    feedback: tuple[str, ...] = ()
    feedback_ja: tuple[str, ...] = ()
    solution: tuple[tuple[str, str], ...] = ()
    grade: Grade | None = None
    why: str = ""
    seconds: float = 0.0

    def _repr_html_(self) -> str:
        """For a notebook: what its author is told, escaped."""
        return lines_html(self.feedback)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def assess_text(problem: Problem, who: str, text: str, suffix: str = ".toml") -> Assessment:
    """Assess the text of a submission, whose file's name ends in ``suffix``.

    One that cannot be read has the outcome "not read"; nothing is raised for it.
    """
    started = time.perf_counter()
    try:
        found = assess(problem, who, fields_of(text, suffix))
    except InvalidInput as error:
        found = unread(problem, who, "not read", str(error))
    return replace(found, seconds=round(time.perf_counter() - started, 4))


def unread(problem: Problem, who: str, outcome: Outcome, why: str) -> Assessment:
    """The assessment of a submission that has no verdict."""
    said, said_ja = ("It could not be read", "読み取れませんでした") if outcome == "not read" else (
        "It could not be graded", "採点できませんでした")  # fmt: skip
    total = float(problem.points.total)
    return Assessment(who, outcome, 0.0, total, (), (f"{said}: {why}",), (f"{said_ja}：{why}",), why=why)


def assess(problem: Problem, who: str, data: dict[str, Any]) -> Assessment:
    """Assess the fields of a submission. Raises InvalidInput where it cannot be read, or states another problem."""
    held = problem.held(data)

    def read(slashes: int) -> Submission:
        return problem.checked(read_derivation(held, slashes))

    first = read(0)
    _require_form(problem, first)
    grade, s = graded(read, pinned=True)
    if grade.assumes:  # a reading of slashes is an assumption, and here nothing is assumed
        raise InvalidInput(f"say how it is meant: {'; '.join(grade.assumes)}")
    parts = marks(problem, s, grade)
    solution = right_answer(problem, s)
    total = float(problem.points.total)
    points = round(sum(part.points for part in parts), 6)
    outcome = grade.verdict
    if outcome == "correct" and any(part.outcome == "missing" for part in parts):
        outcome = "undecided"
        grade = replace(grade, verdict=outcome)
    made = Assessment(who, outcome, points, total, parts, solution=solution, grade=grade)
    shown = solution if problem.shows_solution or problem.hints == 4 else ()
    lines, lines_ja = feedback(problem.hints, grade, parts, points, total, shown)
    return replace(made, feedback=lines, feedback_ja=lines_ja)


def right_answer(problem: Problem, s: Submission) -> tuple[tuple[str, str], ...]:
    """The right rows, or the right Lagrangian, in the submission's coordinates and symbols."""
    truth = problem.truth(s).mechanism
    if s.stages is not None:
        energies = (("T", truth.kinetic), ("U", truth.potential))
        rows = tuple((str(i), f"{pretty(authors(s, text(s.space, row)))} = 0") for i, row in enumerate(truth.rows, 1))
        return (*((name, pretty(authors(s, text(s.space, f)))) for name, f in energies), *rows)
    if s.lagrangian is not None:
        return (("L", pretty(authors(s, text(s.space, truth.lagrangian)))),)
    return tuple((str(i), pretty(authors(s, text(s.space, row))) + " = 0") for i, row in enumerate(truth.rows, 1))


KNOWN = {
    "equations": "the equations of motion", "solved": "the equations solved for the accelerations",
    "lagrangian": "the Lagrangian", "hamiltonian": "the Hamiltonian", "energies": "the energies T and U",
    "positions": "the positions or velocities",
}  # fmt: skip


def _require_form(problem: Problem, s: Submission) -> None:
    form = _form(s)
    if form == "solved" and "solved" not in problem.forms and "equations" in problem.forms:
        form = "equations"  # they are equations of motion too
    if form not in problem.forms and not problem.points.stages:
        asked = " or ".join(KNOWN[name] for name in problem.forms)
        raise InvalidInput(f"this problem asks for {asked}; {KNOWN[form]} is something else")


def _form(s: Submission) -> str:
    """What a submission ends in."""
    if s.stages is not None:
        last = s.stages.given[-1]
        if {"kinetic", "potential"} <= set(s.stages.given) and last in ("potential", "momenta"):
            return "energies"
        return last if last in KNOWN else "positions"
    if s.first_order is not None:
        return "hamiltonian" if s.first_order.hamiltonian else "equations"
    if s.lagrangian is not None:
        return "lagrangian"
    return "solved" if _is_solved(s) else "equations"


def _is_solved(s: Submission) -> bool:
    n = s.space.n
    found: list[int] = []
    for _, f in s.rows:
        present = {k for e, _, _ in f.terms for k, power in enumerate(digits(s.space.accelerations(e), n)) if power}
        if len(present) != 1:
            return False
        found += present
    return len(set(found)) == len(found)
