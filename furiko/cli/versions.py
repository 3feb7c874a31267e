"""``furiko versions``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .options import engine_names, json_option
from .output import print_failure, print_json
from .progress import status_line

FOLDER = Path("furiko-versions")


@click.command()
@click.argument("engine", metavar="ENGINE", shell_complete=engine_names)
@click.option("--from", "first", metavar="VERSION", help="The oldest release.  [default: the first there is]")
@click.option("--to", "last", metavar="VERSION", help="The newest release.  [default: the latest]")
@click.option("--every", is_flag=True, help="Look at every release, not only at those that bisection leads to.")
@click.option("--out", type=click.Path(path_type=Path), default=FOLDER, show_default=True, help="Folder for the page.")
@json_option
def versions(engine: str, first: str | None, last: str | None, every: bool, out: Path, as_json: bool) -> int:
    """Find which release of an engine changed what, by the theory.

    ENGINE: a name that `furiko engines` lists, or a package (pin) for all its formulations. Each release is installed
    once, in an environment of its own. The oldest and the newest are looked at, and by bisection those between that
    changed an answer: accelerations, fields, the reading of model files. Writes versions.json and versions.html. The
    exit status is 1 where a release changed more than last digits or differs from the theory, 3 where one is missing.
    """
    from ..models import InvalidInput
    from ..versions import versions as look
    from ..versions import write

    with status_line() as watch:
        found = look(engine, first, last, every=every, watch=watch)
    changed = any(change.kind != "rounding" for change in found.changes)
    off = any(look.of == "theory" and look.outcome == "differs" for row in found.releases for look in row.looks)
    status = INCOMPLETE if any(row.missing for row in found.releases) else DIFFERS if changed or off else AGREES
    page = out / "versions.html"
    try:
        write(out, found)
    except InvalidInput as error:
        print_failure(str(error))
        status = max(status, INCOMPLETE)
    if as_json:
        print_json(found)
    else:
        from ..reports.terminal.versions import print_versions

        print_versions(found, page)
    return status
