"""``furiko lesson``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES
from .output import print_text


@click.command()
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("furiko-lesson.html"),
    show_default=True,
    help="File to write.",
)
def lesson(out: Path) -> int:
    """Write a web page for teaching: thirty mistakes in derivations.

    Each mistake begins with a question and shows the motion that it causes. In English and Japanese.
    """
    from ..models.writers.whole_file import require_writable

    require_writable(out)  # first: making the page takes a while
    from ..derivations.lesson.lesson import write_lesson

    print_text(f"Lesson: {write_lesson(out)}")
    return AGREES
