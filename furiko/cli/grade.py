"""``furiko grade``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from .options import json_option
from .output import print_json, print_table, print_text

if TYPE_CHECKING:
    from ..records.classroom import ClassDocument


@click.command()
@click.argument("files", metavar="[FILE|FOLDER]...", type=click.Path(path_type=Path), nargs=-1)
@click.option("--problem", type=click.Path(path_type=Path), help="What a teacher fixes: mechanism, points, hints.")
@click.option("--hints", type=click.IntRange(0, 4), help="With --problem: how much is told, 0 (right or wrong) to 4.")
@click.option("--out", type=click.Path(path_type=Path), help="With --problem: write pages, CSV, JUnit, JSON here.")
@click.option("--gradescope", type=click.Path(path_type=Path), help="With --problem: write one file's results.json.")
@click.option("--autograder", type=click.Path(path_type=Path), help="With --problem: write a zip for Gradescope.")
@click.option("--jobs", "-j", type=click.IntRange(1, 256), help="With --problem: how many are graded at once.")
@click.option("--callable", "function", metavar="MODULE:FUNCTION", help="Grade a function that you trust.")
@click.option("--system", help="The mechanism of a text or a --callable, or the one that a TOML file must be about.")
@click.option("--links", type=click.IntRange(1, 20), help="The number of angles, likewise.")
@click.option("--japanese", is_flag=True, help="Print the result in Japanese.")
@json_option
def grade(
    files: tuple[Path, ...],
    problem: Path | None,
    hints: int | None,
    out: Path | None,
    gradescope: Path | None,
    jobs: int | None,
    autograder: Path | None,
    function: str | None,
    system: str | None,
    links: int | None,
    japanese: bool,
    as_json: bool,
) -> int:
    """Grade a derivation: correct, or which term is wrong and why.

    A FILE is what you have: LaTeX, Markdown, plain text, a notebook, a program's text (nothing of it is run); or a TOML
    file, which can say more. Of a text, --system and --links say what it is about; without, the usual mechanisms are
    tried, and the one that it is right for is said.

    With --callable the function is called as f(theta, omega, parameters), where parameters has lengths, masses,
    gravity and, for rods, density; it returns the accelerations. It runs in a process of its own, with limits of time
    and memory. That is no sandbox: grade only code that you would run yourself.

    With --system or --links a TOML file about another problem is refused, and a derivation that is right only on some
    condition counts as wrong.

    With --problem any number of files, or folders with one file per student, are graded by a problem file: points for
    each row, hints up to its level, a table of who made which mistake. No submission can change another one's grade.
    """
    if autograder is not None:
        from ..autograder import write_autograder

        if problem is None or files:
            raise click.UsageError("--autograder needs --problem, and no files")
        print_text(f"written: {write_autograder(problem, autograder)}; upload it to Gradescope as the autograder")
        return 0
    if problem is not None:
        if function or system or links or not files:
            raise click.UsageError("--problem needs a FILE or FOLDER, and neither --callable nor --system nor --links")
        return _grade_class(problem, files, hints, out, gradescope, jobs, japanese, as_json)
    if hints is not None or out or gradescope or jobs:
        raise click.UsageError("--hints, --out, --gradescope and --jobs go with --problem")
    if len(files) > 1:
        raise click.UsageError("several files are graded with --problem")
    file = files[0] if files else None
    if (file is None) == (function is None):
        raise click.UsageError("give a FILE or --callable MODULE:FUNCTION")
    if function is None:
        from ..derivations.grading.grade import grade as grade_file
        from ..derivations.reading.pinned import Pinned

        assert file is not None
        found = grade_file(file, pinned=Pinned(system, links) if system or links else None)
    else:
        from ..derivations.grading.grade_callable import grade_callable

        if system is None or links is None:
            raise click.UsageError("--callable needs --system and --links")
        found = grade_callable(function, system, links)
    if as_json:
        print_json(found.to_dict())
    else:
        print_text(found.text("ja" if japanese else "en"))
    return found.exit_status


def _grade_class(
    problem: Path,
    paths: tuple[Path, ...],
    hints: int | None,
    out: Path | None,
    gradescope: Path | None,
    jobs: int | None,
    japanese: bool,
    as_json: bool,
) -> int:
    from ..classroom import assess_class, assess_one, exit_status, write_class
    from .progress import status_line

    if gradescope is None and len(paths) == 1 and paths[0].is_file():
        found = assess_class(problem, paths, hints=hints)
    elif gradescope is not None and len(paths) == 1:
        found = assess_one(problem, paths[0], hints=hints)
    else:
        with status_line() as say:
            found = assess_class(
                problem, paths, hints=hints, jobs=jobs, watch=lambda done, of: say(f"graded {done} of {of}")
            )
    if gradescope is not None:
        from ..models.writers.whole_file import write_whole
        from ..reports.class_files import to_gradescope

        if len(found.submissions) != 1:
            raise click.UsageError(f"--gradescope is for one submission; these are {len(found.submissions)}")
        write_whole(gradescope, to_gradescope(found, found.submissions[0]))
    written = write_class(out, found) if out is not None else []
    if as_json:
        print_json(found)
    elif len(found.submissions) == 1:
        (one,) = found.submissions
        print_text("\n".join(one.feedback_ja if japanese else one.feedback))
    else:
        _print_class(found)
    if written and not as_json:
        print_text(f"written: {written[0]} and {len(written) - 1} more")
    return exit_status(found)


def _print_class(found: ClassDocument) -> None:
    rows = []
    for s in found.submissions:
        why = s.why or "; ".join(m.says for m in found.mistakes if s.who in m.who)
        why = why or ("; ".join(s.grade.notes) if s.grade else "")
        rows.append((s.who, s.outcome, f"{s.points:g} of {s.of:g}", why))
    print_table(("who", "outcome", "points", "why"), rows)
    right = sum(s.outcome == "correct" for s in found.submissions)
    print_text(f"\n{right} of {len(found.submissions)} right. {found.rule}")
    if found.mistakes:
        print_text("")
        print_table(("times", "mistake", "who"), [(str(len(m.who)), m.says, ", ".join(m.who)) for m in found.mistakes])
