"""``furiko history``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES
from .output import print_text


@click.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.option("--out", type=click.Path(path_type=Path), help="Folder for the files.  [default: FOLDER]")
def history(folder: Path, out: Path | None) -> int:
    """Show a folder of runs as one page, with badges.

    FOLDER has a folder for each run, with its report.jsonl in it. Writes history.html, engine by engine and version by
    version, and of the latest run badge.svg, badge-ENGINE.svg and the same as JSON for shields.io.
    """
    from ..reports.history.page import write_history
    from ..reports.history.runs import read_history

    found = read_history(folder)
    for sentence in found.unreadable:
        print_text(sentence, err=True)
    paths = write_history(found, out or folder)
    print_text(f"History: {paths[0]}, with {len(paths) - 1} files of badges")
    return AGREES
