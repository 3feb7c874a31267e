"""``furiko bench``."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE, gravest
from .options import engine_option, json_option, report_folder_option, scene_names
from .output import print_failure, print_json
from .progress import bench_progress


@click.command()
@click.argument("scenes", nargs=-1, metavar="[SCENE|FILE.toml]...", shell_complete=scene_names)
@engine_option
@report_folder_option
@click.option(
    "--budget", type=click.FloatRange(1), default=60.0, show_default=True, help="Approximate time of the whole run [s]."
)
@click.option(
    "--skips",
    is_flag=True,
    help="Measure the work that a check skips: are the verdicts the same, and how much time is saved.",
)
@click.option(
    "--sharpness", is_flag=True, help="Measure the smallest relative error of an entry that a check notices (minutes)."
)
@json_option
def bench(
    scenes: tuple[str, ...],
    engines: tuple[str, ...],
    out: Path,
    budget: float,
    skips: bool,
    sharpness: bool,
    as_json: bool,
) -> int:
    """Measure time against error, for engines and for furiko itself.

    With scenes: their motions only. Without: the benchmark's own motions (bench-rods-2, bench-rods-5, bench-rods-100)
    and accelerations of 2 to 1000 links. Writes bench.json and bench.html.
    """
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # numpy reads them once, when it is imported
    from ..bench import bench as run_bench
    from ..bench import write
    from ..models import InvalidInput
    from ..models.writers.whole_file import make_folder

    make_folder(out)  # first: the benchmark takes a while
    with bench_progress() as watch:
        found = run_bench(scenes or None, engines or None, budget=budget, skips=skips, sharpness=sharpness, watch=watch)
    differs = any(not skip.same for skip in found.skips) or any(motion.causes for motion in found.motions)
    status = DIFFERS if differs else AGREES
    page = out / "bench.html"
    try:
        write(out, found)
    except InvalidInput as error:
        print_failure(str(error))
        status = gravest((status, INCOMPLETE))
    if as_json:
        print_json(found)
    else:
        from ..reports.terminal.bench import print_bench

        print_bench(found, page)
    return status
