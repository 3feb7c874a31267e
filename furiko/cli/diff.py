"""``furiko diff``."""

from __future__ import annotations

from pathlib import Path

import click

from .output import print_text


@click.command()
@click.argument("before", type=click.Path(path_type=Path))
@click.argument("after", type=click.Path(path_type=Path))
@click.option(
    "--factor",
    type=click.FloatRange(1.0, min_open=True),
    default=2.0,
    show_default=True,
    help="An error that grew by more than this is worse, and fails.",
)
def diff(before: Path, after: Path, factor: float) -> int:
    """Compare two runs of check.

    BEFORE and AFTER: report.jsonl of each run, or the folder it is in. First come other
    differences of the runs, such as an engine's version; then comparisons whose outcome changed, whose error grew or
    shrank, and those that only one run has. Exit 1 if something broke or its error grew.
    """
    from ..reports import compare, read_stream

    comparison = compare(read_stream(before), read_stream(after), factor)
    print_text(comparison.text())
    return comparison.exit_status
