"""Options that several commands share."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TypeVar

import click

REPORT_FOLDER = Path("furiko-report")


Names = TypeVar("Names", str, tuple[str, ...])


def found_here(_context: click.Context, _parameter: click.Parameter, names: Names) -> Names:
    """The names; for an adapter from elsewhere the current folder is on Python's path, after all else."""
    each = (names,) if isinstance(names, str) else names
    if any(":" in name or name.endswith(".py") for name in each) and os.getcwd() not in sys.path:
        sys.path.append(os.getcwd())
    return names


json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document and nothing else.")
engine_option = click.option(
    "--engine",
    "-e",
    "engines",
    multiple=True,
    metavar="NAME|FILE.py|module:Class",
    callback=found_here,
    help="Run only this engine, or an adapter of your own: a file, or a class in a module, looked for in the current "
    "folder too (an example is in furiko.engines.protocol); may be repeated.",
)
report_folder_option = click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=REPORT_FOLDER,
    show_default=True,
    help="Folder for the report.",
)
jobs_option = click.option(
    "--jobs", "-j", type=click.IntRange(1, 256), help="Number of worker processes; the number of cores if not given."
)
