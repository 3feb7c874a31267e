"""``furiko sweep``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..records.exit_status import INCOMPLETE, gravest
from .options import jobs_option, json_option
from .output import print_failure, print_json
from .progress import sweep_progress

if TYPE_CHECKING:
    from ..records.sweep import SweepSummary

FOLDER = Path("furiko-sweep")


@click.command()
@click.argument("words", nargs=-1, required=True, metavar="FILE.toml | report DIR", type=click.Path())
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=FOLDER,
    show_default=True,
    help="Folder for the results.",
)
@jobs_option
@click.option("--dask", metavar="ADDRESS", help="Run on the cluster of this scheduler (tcp://host:8786, or its file).")
@click.option("--resume", is_flag=True, help="Go on with the sweep in this folder; this is so without it, too.")
@click.option("--fresh", is_flag=True, help="Start anew: what an earlier sweep left in this folder is removed.")
@json_option
def sweep(
    words: tuple[str, ...],
    out: Path,
    jobs: int | None,
    dask: str | None,
    resume: bool,
    fresh: bool,
    as_json: bool,
) -> int:
    """Run a grid of scenes, engines and seeds; resumable, on all cores.

    FILE.toml declares scenes or random mechanisms × parameters × seeds × engines × checks. Results are Parquet files in
    the folder, chunk by chunk; a second run with the same folder goes on where the first stood. `furiko sweep report
    DIR` sums up what is there, without running anything: sweep.json, sweep.md and sweep.html.

    The exit status is 1 where an engine differs, 3 where one failed or a planned cell is not there.
    """
    if resume and fresh:
        raise click.UsageError("--resume and --fresh: one of the two")
    if words[0] == "report":
        if len(words) != 2:
            raise click.UsageError("furiko sweep report DIR: one folder is needed")
        from ..sweep import report

        return _show(report(words[1]), Path(words[1]), as_json)
    if len(words) != 1:
        raise click.UsageError(f"one file is needed, not {len(words)}: {' '.join(words)[:200]}")
    from ..sweep import SweepCutOff
    from ..sweep import sweep as run_sweep

    lost = ""
    with sweep_progress() as watch:
        try:
            found = run_sweep(words[0], out=out, jobs=jobs, dask=dask, fresh=fresh, watch=watch)
        except SweepCutOff as error:
            found, lost = error.summary, str(error)
    if lost:
        print_failure(lost)
    return gravest([_show(found, out, as_json), *([INCOMPLETE] if lost else [])])


def _show(found: SweepSummary, folder: Path, as_json: bool) -> int:
    from ..sweep import PAGE, exit_status

    if as_json:
        print_json(found)
    else:
        from ..reports.terminal.sweep import print_sweep

        print_sweep(found, folder / PAGE)
    return exit_status(found)
