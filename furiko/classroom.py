"""``furiko grade --problem``: a class's submissions assessed, and its reports written."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec

from .derivations.classroom.assess import unread
from .derivations.classroom.folder import ENDINGS, Handed, assess_all, handed_in
from .derivations.classroom.problem import problem_fields, problem_of, read_problem
from .models.errors import InvalidInput
from .models.writers.whole_file import make_folder, write_whole
from .records.classroom import Assessed, ClassDocument, CommonMistake
from .records.exit_status import AGREES, DIFFERS, INCOMPLETE


def assess_class(
    problem: Path, paths: Sequence[Path], *, hints: int | None = None, jobs: int | None = None,
    watch: Callable[[int, int], None] = lambda *_: None,
) -> ClassDocument:  # fmt: skip
    """Assess the submissions in files and folders. Raises InvalidInput where there is none, or no problem.

    ``hints``: in place of the problem's own; ``watch``: called with how many of how many are done.
    """
    pinned = read_problem(problem)
    fields = problem_fields(problem)
    if hints is not None:
        fields = {**fields, "feedback": {**fields.get("feedback", {}), "hints": hints}}
        pinned = problem_of(fields)
    submissions: list[Handed] = [h for h in handed_in(paths) if h.path.resolve() != problem.resolve()]
    found = assess_all(pinned, fields, submissions, jobs=jobs, watch=lambda done: watch(done, len(submissions)))
    assessed = [msgspec.convert(entry, Assessed) for entry in found]
    return ClassDocument(
        title=pinned.title, rule=pinned.points.sentence(), hints=pinned.hints, submissions=assessed,
        mistakes=_mistakes(assessed),
    )  # fmt: skip


def assess_one(problem: Path, path: Path, *, hints: int | None = None) -> ClassDocument:
    """The same for what one student handed in: where it is not one file, that is what its author is told."""
    fields = problem_fields(problem)
    read_problem(problem)  # raises where it is none
    try:
        found = len(handed_in([path]))
    except InvalidInput:
        found = 0
    if found == 1:
        return assess_class(problem, [path], hints=hints)
    pinned = problem_of(fields)
    endings = f"one file that ends in {ENDINGS[0]}, or else one text ({', '.join(ENDINGS[1:6])}, …)"
    why = f"hand in {endings}; here {'is none' if not found else f'are {found}'}"
    alone = msgspec.convert(unread(pinned, path.name, "not read", why).to_dict(), Assessed)
    return ClassDocument(
        title=pinned.title, rule=pinned.points.sentence(), hints=pinned.hints, submissions=[alone], mistakes=[]
    )


def _mistakes(assessed: Sequence[Assessed]) -> list[CommonMistake]:
    """Each mistake once, the commonest first."""
    who: dict[tuple[str, str], list[str]] = {}
    for s in assessed:
        named: Sequence[Any] = s.grade.mistakes if s.grade else ()
        for mistake in named or [term for part in s.parts for term in part.terms]:
            names = who.setdefault((mistake.says, mistake.says_ja), [])
            if s.who not in names:
                names.append(s.who)
    ranked = sorted(who.items(), key=lambda item: -len(item[1]))
    return [CommonMistake(says=says, says_ja=ja, who=names) for (says, ja), names in ranked]


def exit_status(found: ClassDocument) -> int:
    """0: all are right; 1: some are not; 3: some could not be graded."""
    outcomes = {s.outcome for s in found.submissions}
    if "not graded" in outcomes:
        return INCOMPLETE
    return AGREES if outcomes <= {"correct"} else DIFFERS


def write_class(folder: Path, found: ClassDocument) -> list[Path]:
    """Write the teacher's page, a page a student, CSV, JUnit and JSON. Raises InvalidInput where that fails."""
    from .reports.class_files import to_class_junit, to_csv
    from .reports.pages.class_page import to_students_page, to_teachers_page

    make_folder(folder / "students")
    encoded = msgspec.json.format(msgspec.json.encode(found), indent=2).decode()
    files = {"teacher.html": to_teachers_page(found), "class.csv": to_csv(found), "junit.xml": to_class_junit(found),
             "class.json": encoded}  # fmt: skip
    used: set[str] = set()
    for s in found.submissions:
        name = re.sub(r"[^\w.-]+", "_", s.who, flags=re.ASCII).strip("._")[:80] or "student"
        while name.lower() in used:
            name += "_"
        used.add(name.lower())
        files[f"students/{name}.html"] = to_students_page(found, s)
    return [write_whole(folder / name, text) for name, text in files.items()]
