"""``furiko environments``."""

from __future__ import annotations

from datetime import UTC, datetime

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_table, print_text


@click.command()
@click.option("--remove", multiple=True, metavar="NAME|all", help="Delete this environment; may be repeated.")
@json_option
def environments(remove: tuple[str, ...], as_json: bool) -> int:
    """List or remove the environments made for versions of engines.

    One is made when a version is first named (-e mujoco@3.3.7), and kept. The folder is that of furiko's cache:
    FURIKO_CACHE, or where the system keeps such things.
    """
    from ..engines.places.environments import all_kept, environments_folder, size_of
    from ..engines.places.environments import remove as remove_one
    from ..records.listings import EnvironmentRow

    kept = all_kept()
    for name in [one.name for one in kept] if "all" in remove else remove:
        remove_one(name)
    rows = [
        EnvironmentRow(
            name=one.name,
            folder=str(one.folder),
            requirements=list(one.requirements),
            packages=one.packages,
            python=one.python,
            made=datetime.fromtimestamp(one.made, UTC).isoformat(timespec="seconds"),
            by=one.by,
            bytes=size_of(one),
        )
        for one in (all_kept() if remove else kept)
    ]
    if as_json:
        print_json(rows)
    elif rows:
        print_table(
            ("environment", "Python", "installed", "made", "by", "MB"),
            [
                (row.name, row.python, ", ".join(row.requirements), row.made[:10], row.by, f"{row.bytes / 1e6:.0f}")
                for row in rows
            ],
        )
        print_text(f"They are in {environments_folder()}; furiko environments --remove NAME deletes one.")
    else:
        print_text("There are none: the first is made by -e NAME@VERSION, as in furiko check -e mujoco@3.3.7")
    return AGREES
