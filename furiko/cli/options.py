"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path

import click

REPORT_FOLDER = Path("furiko-report")

json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document and nothing else.")
engine_option = click.option(
    "--engine", "-e", "engines", multiple=True, metavar="NAME", help="Run only this engine; may be repeated."
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
