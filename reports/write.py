"""The folder of a run: ``report.jsonl`` while it runs, and beside it the page, the summary and the JUnit file."""

from __future__ import annotations

import os
from pathlib import Path

from ..models.errors import InvalidInput
from ..records.check import Header
from .report import Report
from .stream import STREAM, StreamWriter

PAGE, SUMMARY, JUNIT = "report.html", "report.md", "junit.xml"


def open_report(directory: str | Path, header: Header) -> StreamWriter:
    """The stream of a new run in this folder, which is made if need be; what an earlier run rendered is removed.

    So an interrupted run never leaves its stream beside the page of another. Raises :class:`InvalidInput` where the
    folder cannot be made or written.
    """
    folder = Path(directory)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in (PAGE, SUMMARY, JUNIT):
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror or error}") from None
    return StreamWriter(folder / STREAM, header)


def prepare_reports() -> None:
    """Load what :func:`write_reports` will need, while something else computes."""
    from .pages.check_page import load_templates

    load_templates()


def write_reports(directory: str | Path, report: Report) -> tuple[Path, ...]:
    """Write the page, the summary and the JUnit file of a run into its folder; returns their paths.

    Each is there whole or not at all. Raises :class:`InvalidInput` with the path of one that cannot be written.
    """
    from .junit import to_junit
    from .markdown import to_markdown
    from .pages.check_page import to_html

    folder = Path(directory)
    return tuple(
        write_whole(folder / name, render(report))
        for name, render in ((PAGE, to_html), (SUMMARY, to_markdown), (JUNIT, to_junit))
    )


def write_whole(path: Path, text: str) -> Path:
    """Write under another name, then rename: whoever looks sees the old file or the new one, never half of one."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="utf-8", newline="\n")
        draft.replace(path)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        draft.unlink(missing_ok=True)
    return path
