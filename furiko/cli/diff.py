"""``furiko diff``."""

from __future__ import annotations

from pathlib import Path

import click

from .output import print_text


@click.command()
@click.argument("before", type=click.Path(path_type=Path))
@click.argument("after", type=click.Path(path_type=Path))
def diff(before: Path, after: Path) -> int:
    """Compare two runs of check.

    BEFORE and AFTER: report.jsonl of each run, or the folder it is in. Lists comparisons whose outcome changed, whose
    error grew or shrank, and those that only one run has.
    """
    from ..reports import compare, read_stream

    comparison = compare(read_stream(before), read_stream(after))
    print_text(comparison.text())
    return comparison.exit_status
