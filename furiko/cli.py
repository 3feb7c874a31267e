"""The command line. Each command imports what it needs when it runs, so that none waits for another's libraries.

Exit status: 0 all that ran agrees and all that was asked for ran; 1 something differs; 2 bad usage or bad input; 3 an
engine that was asked for is missing or failed; 130 interrupted.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from . import __version__

if TYPE_CHECKING:
    from collections.abc import Callable

    from .checks.plan import Plan
    from .records.check import Result
    from .stress import Progress

AGREES, DIFFERS, BAD_INPUT, ENGINE_FAILED, INTERRUPTED = 0, 1, 2, 3, 130
REPORT_FOLDER = Path("furiko-report")
STRESS_FOLDER = Path("furiko-stress")


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, package_name="furiko")
def cli() -> None:
    """Cross-check hand-derived equations of motion of multi-pendulums and physics engines."""


json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document and nothing else.")


@cli.command()
@click.argument("scenes", nargs=-1, metavar="[SCENE|FILE.toml]...")
@click.option("--engine", "-e", "engines", multiple=True, metavar="NAME", help="Only this engine; may be repeated.")
@click.option("--profile", default="quick", show_default=True, metavar="smoke|quick|full", help="How thorough.")
@click.option("--out", type=click.Path(path_type=Path), default=REPORT_FOLDER, show_default=True, help="Report folder.")
@click.option("--baseline", type=click.Path(path_type=Path), help="An earlier report.jsonl to compare with.")
@click.option("--jobs", "-j", type=click.IntRange(1, 256), help="Worker processes; as many as cores if not given.")
@click.option("--timeout", type=click.FloatRange(0.1), default=60.0, show_default=True, help="Seconds for one check.")
@click.option("--no-cache", is_flag=True, help="Compute everything again, and keep nothing.")
@json_option
def check(
    scenes: tuple[str, ...],
    engines: tuple[str, ...],
    profile: str,
    out: Path,
    baseline: Path | None,
    jobs: int | None,
    timeout: float,
    no_cache: bool,
    as_json: bool,
) -> int:
    """Hold engines against the documents' equations, in the catalogue's scenes or your own."""
    from .checks.workers.processes import workshop

    with workshop(ahead=jobs or os.cpu_count() or 1) as place:
        from .run import check as run_check

        before = _read(baseline) if baseline else None
        with progress() as watch:
            report = run_check(
                scenes or None,
                engines or None,
                profile=profile,
                out=out,
                jobs=jobs,
                timeout=timeout,
                use_cache=not no_cache,
                place=place,
                watch=watch,
            )
    status = report.exit_status
    if as_json:
        print_json({"header": report.header, "results": report.results, "footer": report.footer})
    else:
        from .reports.terminal.check import print_report

        print_report(report, path=out / "report.html")
    if before is not None:
        from .reports import compare

        comparison = compare(before, report)
        click.echo(comparison.text(), err=as_json)
        status = DIFFERS if DIFFERS in (status, comparison.exit_status) else max(status, comparison.exit_status)
    return status


@cli.command()
@json_option
def scenes(as_json: bool) -> int:
    """List the catalogue's scenes."""
    from .models import find_scenes

    found = find_scenes(None)
    if as_json:
        print_json(
            [
                {
                    "name": scene.name,
                    "system": scene.system.kind,
                    "n": scene.system.n,
                    "duration": scene.duration,
                    "description": scene.description,
                    "equations": scene.equations,
                    "tags": scene.tags,
                }
                for scene in found
            ]
        )
    else:
        rows = [(s.name, s.system.kind, str(s.system.n), f"{s.duration:g}", s.description) for s in found]
        print_table(("scene", "system", "angles", "seconds", "what it is"), rows)
    return AGREES


@cli.command()
@json_option
def engines(as_json: bool) -> int:
    """List the engines, what is installed of them, and what they cannot do."""
    from .engines import engine_info, engine_names, engine_version

    infos = [engine_info(name) for name in engine_names()]
    if as_json:
        print_json(
            [
                {
                    "name": info.name,
                    "formulation": info.formulation,
                    "package": info.package,
                    "version": engine_version(info.name) or None,
                    "coordinates": info.coordinates,
                    "integrators": [{"name": i.name, "order": i.order} for i in info.integrators],
                    "missing": dict(info.missing),
                    "largest_n": info.largest_n,
                    "homepage": info.homepage,
                }
                for info in infos
            ]
        )
    else:
        rows = [
            (
                info.name,
                engine_version(info.name) or f"not installed: pip install {info.package}",
                info.formulation,
                ", ".join(i.name for i in info.integrators) or "-",
                ", ".join(info.missing) or "-",
            )
            for info in infos
        ]
        print_table(("engine", "version", "formulation", "integrators", "does not give"), rows)
    return AGREES


@cli.command()
@click.argument("scene")
@click.option("--mjcf", "language", flag_value="mjcf", help="As MuJoCo's MJCF.")
@click.option("--urdf", "language", flag_value="urdf", help="As URDF.")
@click.option("--out", "-o", type=click.Path(path_type=Path), help="File to write; standard output if not given.")
def export(scene: str, language: str | None, out: Path | None) -> int:
    """Write a scene's mechanism as a model file."""
    from .models import InvalidInput, find_scene, to_mjcf, to_urdf

    if language is None:
        raise click.UsageError("one of --mjcf and --urdf is needed")
    system = find_scene(scene).system
    text = to_mjcf(system) if language == "mjcf" else to_urdf(system)
    if out is None:
        click.echo(text, nl=False)
        return AGREES
    try:
        out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InvalidInput(f"{out}: cannot be written: {error.strerror or error}") from None
    return AGREES


@cli.command()
@click.argument("scenes", nargs=-1, metavar="[SCENE|FILE.toml]...")
@click.option("--engine", "-e", "engines", multiple=True, metavar="NAME", help="Only this engine; may be repeated.")
@click.option("--out", type=click.Path(path_type=Path), default=REPORT_FOLDER, show_default=True, help="Report folder.")
@click.option("--budget", type=click.FloatRange(1), default=60.0, show_default=True, help="Seconds, about.")
@click.option("--skips", is_flag=True, help="Prove what a check leaves out: verdicts and times with and without.")
@click.option("--targets", is_flag=True, help="Measure every figure that furiko is to reach (some minutes).")
@json_option
def bench(
    scenes: tuple[str, ...],
    engines: tuple[str, ...],
    out: Path,
    budget: float,
    skips: bool,
    targets: bool,
    as_json: bool,
) -> int:
    """Time against error, of every engine and of furiko itself: motions and accelerations.

    Writes bench.json and bench.html. With scenes only their motions, without any the benchmark's own (bench-rods-2,
    bench-rods-5, bench-rods-100) and accelerations from 2 to 1000 links.
    """
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # numpy reads them once, when it is imported
    from .bench import bench as run_bench
    from .bench import write

    with saying() as watch:
        found = run_bench(scenes or None, engines or None, budget=budget, skips=skips, targets=targets, watch=watch)
    page = write(out, found)
    if as_json:
        print_json(found)
    else:
        from .reports.terminal.bench import print_bench

        print_bench(found, page)
    wrong = any(not skip.same for skip in found.skips) or any(target.met is False for target in found.targets)
    return DIFFERS if wrong else AGREES


@cli.command()
@click.option("--axis", "-a", "axes", multiple=True, metavar="NAME", help="Only this; 'A x B' for two at once.")
@click.option("--engine", "-e", "engines", multiple=True, metavar="NAME", help="Only this, or 'document' or 'kernels'.")
@click.option("--budget", type=click.FloatRange(1.0), default=60.0, show_default=True, help="Seconds for the whole.")
@click.option("--out", type=click.Path(path_type=Path), default=STRESS_FOLDER, show_default=True, help="Report folder.")
@click.option("--seed", type=click.IntRange(0), default=2018, show_default=True, help="Of the random states.")
@click.option("--fresh", is_flag=True, help="Start anew; otherwise what the folder holds is gone on with.")
@click.option("--jobs", "-j", type=click.IntRange(1, 256), help="Worker processes; as many as cores if not given.")
@click.option("--timeout", type=click.FloatRange(0.1), default=30.0, show_default=True, help="Seconds for one case.")
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
    """Find where engines, integrators and formulas break, and what becomes of a chain of ever more rods.

    Axes: links, long-rods, short-rods, fast-rods, far-rods, straight-rods, folded-rods, strong-gravity, weak-gravity,
    no-gravity, legs, heavy-first, light-first, heavy-leg, light-leg, long-legs, short-legs, fast-legs, far-legs,
    aligned-legs; two of them as "long-rods x fast-rods"; and the parts accelerations, pairs, steps, "long runs",
    condition, chain. All but pairs if none is given.

    Writes stress.jsonl, stress.html and chain.html. Run again with the same folder it goes on where it stood.
    """
    from .stress import stress as run_stress

    with stress_progress() as watch:
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
    if as_json:
        print_json(found)
    else:
        from .reports.terminal.stress import print_stress

        print_stress(found, out / "stress.html")
    return DIFFERS if found["kernels"]["broken"] else AGREES


@cli.command()
@click.argument("before", type=click.Path(path_type=Path))
@click.argument("after", type=click.Path(path_type=Path))
def diff(before: Path, after: Path) -> int:
    """Compare two runs: what changed its outcome, got worse or better, appeared or vanished."""
    from .reports import compare

    comparison = compare(_read(before), _read(after))
    click.echo(comparison.text())
    return comparison.exit_status


@cli.command()
@click.argument("model", type=click.Path(path_type=Path))
@click.option("--against", metavar="SCENE|FILE", help="What it is meant to be: a scene, its TOML file, another model.")
@json_option
def diagnose(model: Path, against: str | None, as_json: bool) -> int:
    """Say what each engine makes of an MJCF or URDF file, whether they agree, and why not."""
    from .diagnosis.diagnose import diagnose as diagnose_file

    found = diagnose_file(model, against, apart=True)
    if as_json:
        print_json(found.to_json())
    else:
        click.echo(found.text())
    return found.exit_status


@cli.command()
@json_option
def audit(as_json: bool) -> int:
    """Hold each of the documents' 57 equations, as printed, against first principles."""
    from .derivations.audit.audit import audit as audit_documents

    found = audit_documents()
    if as_json:
        print_json(found.to_dict())
    else:
        click.echo(found.text())
    return AGREES


@cli.command()
@click.argument("file", type=click.Path(path_type=Path), required=False)
@click.option("--callable", "function", metavar="MODULE:FUNCTION", help="Grade a function that you trust.")
@click.option("--system", type=click.Choice(["n-leg", "rod-chain"]), help="With --callable: the mechanism.")
@click.option("--links", type=click.IntRange(1, 8), help="With --callable: how many angles.")
@click.option("--japanese", is_flag=True, help="Say it in Japanese.")
@json_option
def grade(
    file: Path | None, function: str | None, system: str | None, links: int | None, japanese: bool, as_json: bool
) -> int:
    """Grade a derivation: right, or which term is wrong and the mistake that makes it so.

    With --callable the function is called as f(theta, omega, parameters), where parameters has lengths, masses,
    gravity and, of rods, density; it returns the accelerations. It runs in a process of its own, within limits of time
    and memory. That is no sandbox: grade only what you would run yourself.
    """
    if (file is None) == (function is None):
        raise click.UsageError("give a FILE or --callable MODULE:FUNCTION")
    if function is None:
        from .derivations.grading.grade import grade as grade_file

        assert file is not None
        graded = grade_file(file)
    else:
        from .derivations.grading.grade_callable import grade_callable

        if system is None or links is None:
            raise click.UsageError("--callable needs --system and --links")
        graded = grade_callable(function, system, links)
    if as_json:
        print_json(graded.to_dict())
    else:
        click.echo(graded.text("ja" if japanese else "en"))
    return graded.exit_status


@cli.command()
@click.option("--out", type=click.Path(path_type=Path), default=Path("furiko-lesson.html"), show_default=True)
def lesson(out: Path) -> int:
    """Write a page for a class: thirty mistakes, a question first, where each bites. English and Japanese."""
    from .derivations.lesson.lesson import write_lesson

    click.echo(f"Lesson: {write_lesson(out)}")
    return AGREES


@cli.command()
@click.option("--clear", is_flag=True, help="Delete everything that is kept.")
@json_option
def cache(clear: bool, as_json: bool) -> int:
    """Say what is kept from earlier runs, and where."""
    from .checks.cache import user_cache

    kept = user_cache()
    size = sum(path.stat().st_size for path in kept.entries())
    found = {"folder": str(kept.folder), "entries": len(kept.entries()), "bytes": size}
    if clear:
        found["deleted"] = kept.clear()
    if as_json:
        print_json(found)
    else:
        done = ", deleted now" if clear else ""
        click.echo(f"{found['entries']} entries, {size / 1e6:.1f} MB in {found['folder']}{done}")
    return AGREES


def _read(path: Path) -> Any:
    from .reports import read_stream

    return read_stream(path)


def print_json(content: object) -> None:
    """One JSON document on standard output."""
    import msgspec

    click.echo(msgspec.json.format(msgspec.json.encode(content), indent=2).decode())


def print_table(heading: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> None:
    """A table for a person: as wide as the terminal there, as wide as it is in a pipe."""
    from rich.console import Console
    from rich.table import Table

    table = Table(*heading, box=None, header_style="bold", pad_edge=False)
    for row in rows:
        table.add_row(*row)
    console = Console(width=None if sys.stdout.isatty() else 160, highlight=False, markup=False)
    console.print(table)


@contextmanager
def progress() -> Iterator[Callable[[Plan, Result], None] | None]:
    """A progress bar on a terminal's standard error; None, and silence, in a pipe."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("checking", total=None)
        seen: set[tuple[str, str, str]] = set()

        def watch(plan: Plan, result: Result) -> None:
            settled = {(r.scene, r.engine, r.check) for r in plan.settled}
            # An engine has one trajectory result for each integrator: they count as the one check that was planned.
            seen.add((result.scene, result.engine, result.check.split(" ")[0]))
            total = sum(len(t.checks) for t in plan.tasks) + len(settled)
            now = f"{result.scene} {result.engine}"
            bar.update(task, completed=min(len(seen), total), total=total, description=now)

        yield watch


@contextmanager
def saying() -> Iterator[Callable[[str], None]]:
    """What is going on, in one line of a terminal's standard error; silence in a pipe."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.markup import escape

    with Console(stderr=True).status("") as status:
        yield lambda words: status.update(escape(words))


@contextmanager
def stress_progress() -> Iterator[Callable[[Progress], None] | None]:
    """How many questions are answered, and what runs, on a terminal's standard error; None, and silence, in a pipe."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    columns = (
        TextColumn("{task.fields[done]} cases, {task.fields[open]} questions open"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}"),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=None, done=0, open="?")

        def watch(now: Progress) -> None:
            total = now.done + now.open  # every open question takes at least one case more
            bar.update(task, completed=now.done, total=total, description=now.now, done=now.done, open=now.open)

        yield watch


def main() -> None:
    """Run the command line; ends the process with its status."""
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """The exit status of one command line. What the user can mend is one line on standard error, never a traceback."""
    try:
        status = cli.main(arguments, prog_name="furiko", standalone_mode=False)
        sys.stdout.flush()
    except click.ClickException as error:
        return _say(error.format_message(), BAD_INPUT)
    except (KeyboardInterrupt, click.Abort):
        return _say("interrupted; the stream that was begun has no footer, and readers will say so", INTERRUPTED)
    except BrokenPipeError:
        # Who read standard output has gone: nothing more can be said there.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return INTERRUPTED
    except (ValueError, RuntimeError) as error:
        from .models import EngineMissing, InvalidInput  # only now: workers are started before it is needed elsewhere

        if isinstance(error, InvalidInput):
            return _say(str(error), BAD_INPUT)
        if isinstance(error, EngineMissing):
            return _say(str(error), ENGINE_FAILED)
        raise
    return status if isinstance(status, int) else AGREES


def _say(message: str, status: int) -> int:
    print(f"furiko: {' '.join(message.split())}", file=sys.stderr)
    return status
