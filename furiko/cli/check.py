"""``furiko check``."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ..records.exit_status import INCOMPLETE, gravest
from .options import engine_option, jobs_option, json_option, report_folder_option, scene_names, words
from .output import print_failure, print_json, print_text
from .progress import check_progress


def usual_jobs(profile: str, engines: int) -> int:
    """Worker processes where the user does not say: one a core.

    Of a smoke run, in which a worker's start costs more than all that it does, at most one for each engine named.
    """
    cores = os.cpu_count() or 1
    return min(cores, engines) if profile == "smoke" and engines else cores


@click.command()
@click.argument("scenes", nargs=-1, metavar="[SCENE|FILE.toml]...", shell_complete=scene_names)
@engine_option
@click.option(
    "--profile",
    default="quick",
    show_default=True,
    metavar="smoke|quick|full",
    shell_complete=words("smoke", "quick", "full"),
    help="How much is checked.",
)
@report_folder_option
@click.option("--baseline", type=click.Path(path_type=Path), help="Compare with this earlier report.jsonl.")
@click.option("--known", type=click.Path(path_type=Path), help="A TOML file of known differences, which do not fail.")
@click.option("--known-strict", is_flag=True, help="Exit 1 also if a known difference has gone.")
@jobs_option
@click.option(
    "--timeout", type=click.FloatRange(0.1), default=60.0, show_default=True, help="Time limit of one check [s]."
)
@click.option("--memory", type=click.FloatRange(0.05), help="Memory limit of each engine's process [GiB].")
@click.option(
    "--sharp/--no-sharp",
    default=None,
    help="Exit 1 also if a result is loose: within the proven bound, but further off than rounding usually gets.  "
    "[default: as with --baseline]",
)
@click.option("--no-cache", is_flag=True, help="Do not use results of earlier runs, and keep none.")
@json_option
def check(
    scenes: tuple[str, ...],
    engines: tuple[str, ...],
    profile: str,
    out: Path,
    baseline: Path | None,
    known: Path | None,
    known_strict: bool,
    jobs: int | None,
    timeout: float,
    memory: float | None,
    sharp: bool | None,
    no_cache: bool,
    as_json: bool,
) -> int:
    """Check engines against the documents' equations.

    Runs scenes of the catalogue, or your own TOML files. Writes report.jsonl, report.html, report.md and junit.xml.
    """
    # Workers start before numpy is imported here, so that they import it at the same time.
    from ..checks.imported_ahead import MODULES
    from ..engines.workers.processes import worker_processes

    most = None if memory is None else int(memory * 2**30)
    jobs = jobs or usual_jobs(profile, len(engines))
    with worker_processes(jobs, MODULES, most) as source:
        from ..reports import compare, known_in, read_known, read_stream
        from ..run import ReportNotWritten
        from ..run import check as run_check

        if known_strict and known is None:
            raise click.UsageError("--known-strict needs --known FILE")
        entries = read_known(known) if known else ()
        before = read_stream(baseline) if baseline else None
        unwritten = ""
        with check_progress() as watch:
            try:
                report = run_check(
                    scenes or None,
                    engines or None,
                    profile=profile,
                    out=out,
                    jobs=jobs,
                    timeout=timeout,
                    use_cache=not no_cache,
                    source=source,
                    watch=watch,
                    known=entries if known else None,
                )
            except ReportNotWritten as error:
                report, unwritten = error.report, str(error)
    accounted = known_in(report, entries)  # without a file nothing is known
    statuses = [accounted.exit_status_of(before is not None if sharp is None else sharp, known_strict)]
    if unwritten:
        print_failure(unwritten)
        statuses.append(INCOMPLETE)
    comparison = None if before is None else compare(before, report)
    if comparison is not None:
        statuses.append(comparison.exit_status)
        if as_json:
            print_text(comparison.text(), err=True)
    if as_json:
        from ..records.check import CheckReport

        print_json(
            CheckReport(
                header=report.header,
                results=list(report.results),
                footer=report.footer,
                diagnoses=list(report.diagnoses),
                known=list(accounted.differences),
                alone=list(report.alone),
                advisable=list(report.advisable),
            )
        )
    else:
        from ..reports.terminal.check import print_report

        print_report(report, path=None if unwritten else out / "report.html")
        if known is not None:
            print_text(accounted.text())
        if comparison is not None:
            print_text(comparison.text())
    return gravest(statuses)
