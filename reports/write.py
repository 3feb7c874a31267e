"""The folder of a run: ``report.jsonl`` during the run, then beside it the page, the summary and the JUnit file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..models.errors import InvalidInput
from ..models.writers.whole_file import make_folder, write_whole
from ..records.check import Header
from .known import Known
from .report import Report
from .stream import STREAM, StreamWriter

PAGE, SUMMARY, JUNIT = "report.html", "report.md", "junit.xml"


def open_report(directory: str | Path, header: Header) -> StreamWriter:
    """The stream of a new run in this folder, which is made if it is missing.

    Reports of an earlier run are deleted, so that an interrupted run never leaves its stream beside the page of
    another. Raises :class:`InvalidInput` where the folder cannot be made or written.
    """
    folder = Path(directory)
    make_folder(folder)
    try:
        for name in (PAGE, SUMMARY, JUNIT):
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror or error}") from None
    return StreamWriter(folder / STREAM, header)


def prepare_reports() -> None:
    """Load what :func:`write_reports` needs, while workers compute."""
    from .pages.check_page import load_templates

    load_templates()


def write_reports(directory: str | Path, report: Report, known: Known | None = None) -> tuple[Path, ...]:
    """Write the page, the summary and the JUnit file of a run into its folder; returns their paths.

    With ``known`` the page and the summary have its known differences apart, and in the JUnit file they are skipped,
    not failed.
    Each is written completely or not at all. Raises :class:`InvalidInput` with the paths of those that cannot be
    written, after the others have been.
    """
    from .ci.junit import to_junit
    from .ci.markdown import to_markdown
    from .pages.check_page import to_html

    folder = Path(directory)
    paths, failures = [], []
    renderings: dict[str, Callable[[], str]] = {
        PAGE: lambda: to_html(report, known),
        SUMMARY: lambda: to_markdown(report, known),
        JUNIT: lambda: to_junit(report, known),
    }
    for name, render in renderings.items():
        try:
            paths.append(write_whole(folder / name, render()))
        except InvalidInput as error:
            failures.append(str(error))
    if failures:
        raise InvalidInput("; ".join(failures))
    return tuple(paths)
