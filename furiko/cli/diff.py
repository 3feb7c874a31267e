"""``furiko diff``."""

from __future__ import annotations

from pathlib import Path

import click

from .options import json_option
from .output import print_json, print_text


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
@click.option(
    "--out", metavar="PAGE", type=click.Path(path_type=Path, dir_okay=False), help="Write the answer as one HTML page."
)
@json_option
def diff(before: Path, after: Path, factor: float, out: Path | None, as_json: bool) -> int:
    """Compare two runs of check.

    BEFORE and AFTER: report.jsonl of each run, or the folder it is in. First come other
    differences of the runs, such as an engine's version; then comparisons whose outcome changed, whose error grew or
    shrank, and those that only one run has. Exit 1 if something broke or its error grew.
    """
    from ..reports import compare, read_stream

    comparison = compare(read_stream(before), read_stream(after), factor)
    if out is not None:
        from ..models.writers.whole_file import write_whole
        from ..reports.pages.diff_page import to_diff_page

        write_whole(out, to_diff_page(comparison))
    if as_json:
        print_json(comparison.document())
    else:
        print_text("\n".join([comparison.text(), *([f"Page: {out}"] if out is not None else [])]))
    return comparison.exit_status
