"""``furiko stress``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .options import engine_names, jobs_option, json_option
from .output import print_failure, print_json
from .progress import stress_progress


@click.command()
@click.option("--axis", "-a", "axes", multiple=True, metavar="NAME", help="Only this axis; 'A x B' for two together.")
@click.option(
    "--engine",
    "-e",
    "engines",
    multiple=True,
    metavar="NAME",
    shell_complete=engine_names,
    help="Only this engine, or 'document' or 'kernels'.",
)
@click.option(
    "--budget", type=click.FloatRange(1.0), default=60.0, show_default=True, help="Time for the whole run [s]."
)
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("furiko-stress"),
    show_default=True,
    help="Folder for the report.",
)
@click.option("--seed", type=click.IntRange(0), default=2018, show_default=True, help="Seed of the random states.")
@click.option("--fresh", is_flag=True, help="Start anew. Without it the run in this folder is resumed.")
@jobs_option
@click.option(
    "--timeout", type=click.FloatRange(0.1), default=30.0, show_default=True, help="Time limit of one case [s]."
)
@json_option
def stress(
    axes: tuple[str, ...],
    engines: tuple[str, ...],
    budget: float,
    out: Path,
    seed: int,
    fresh: bool,
    jobs: int | None,
    timeout: float,
    as_json: bool,
) -> int:
    """Find where engines, integrators and formulas break.

    Axes: links, long-rods, short-rods, fast-rods, far-rods, straight-rods, folded-rods, strong-gravity, weak-gravity,
    no-gravity, legs, heavy-first, light-first, heavy-leg, light-leg, long-legs, short-legs, fast-legs, far-legs,
    aligned-legs, and units so small that numbers are subnormal: small-mass, small-length, slow and subnormal (all
    three), each with -rods and -legs; two of the others as "long-rods x fast-rods"; and the parts accelerations, pairs,
    steps, "long runs", condition, chain, trees, "tree runs". All but pairs if none is given.

    Axes of open mechanisms, each on cart-pole, acrobot, arm-7, quadruped, humanoid, and on two mechanisms of its own,
    where it applies: heavy-links, light-tips, long-links, short-links, fast, many-turns, straight, far-base, fast-base,
    long-quaternions, short-quaternions, half-turns, small-masses, small-lengths, slow, freedoms, gimbal-lock. One
    mechanism's are named by it ("arm-7"), one alone by both ("arm-7: fast").

    "tree runs" are of open mechanisms whose motion is known for ever, from 1 s on to 1000 s, and to 10000 s with a
    larger budget: a body thrown, a top without torque, a mass on a spring, a pendulum about an axis that leans.

    Writes stress.jsonl, stress.html and chain.html. A second run with the same folder resumes the first.
    """
    from ..stress import StressNotWritten
    from ..stress import stress as run_stress

    unwritten = ""
    with stress_progress(budget) as watch:
        try:
            found = run_stress(
                axes or None,
                engines or None,
                budget=budget,
                seed=seed,
                out=out,
                fresh=fresh,
                jobs=jobs,
                timeout=timeout,
                watch=watch,
            )
        except StressNotWritten as error:
            found, unwritten = error.summary, str(error)
    if unwritten:
        print_failure(unwritten)
    if as_json:
        print_json(found)
    else:
        from ..reports.terminal.stress import print_stress

        print_stress(found, None if unwritten else out / "stress.html")
    if found.kernels.broken:
        return DIFFERS
    return INCOMPLETE if unwritten else AGREES
