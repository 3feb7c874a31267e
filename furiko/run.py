"""One run of the cross-check: plan, workers, stream and reports, tied together."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, TypeVar

from . import __version__
from .checks.cache import Cache, user_cache
from .checks.imported_ahead import MODULES
from .checks.ledger import Ledger
from .checks.plan import Plan, make_plan, random_states
from .checks.runner import TIMEOUT, run
from .engines import engine_place, engine_version, runs_elsewhere, untested
from .engines.workers.processes import Workers, worker_processes
from .models import AnyScene, EngineMissing, InvalidInput, TreeScene, catalogue
from .models.errors import installing, installing_all
from .records import provenance
from .records.check import Diagnosis, EngineEntry, Footer, Header, Result, SceneEntry
from .reports import Report, StreamWriter, footer_of, known_in, open_report, prepare_reports, write_reports
from .reports.known import Entry

R = TypeVar("R", Result, Diagnosis)
SEED = "sha256 of the scene's name, PCG64"


class ReportNotWritten(InvalidInput):
    """The run is over, and a file of it could not be written; ``report`` is the run all the same."""

    def __init__(self, message: str, report: Report) -> None:
        super().__init__(message)
        self.report = report


def check(
    scenes: Sequence[str | Path] | None = None,
    engines: Sequence[str] | None = None,
    *,
    profile: str = "quick",
    out: str | Path | None = None,
    jobs: int | None = None,
    timeout: float = TIMEOUT,
    use_cache: bool = True,
    source: Workers | None = None,
    watch: Callable[[Plan, Result], None] | None = None,
    known: Sequence[Entry] | None = None,
) -> Report:
    """Check engines against the documents' equations.

    ``scenes``: names from the catalogue or paths of TOML files, None for those of the profile; ``engines``: names,
    None for all; ``profile``: ``smoke``, ``quick`` or ``full``; ``out``: folder for ``report.jsonl`` and its
    renderings, None for none; ``jobs``: worker processes, None for one a core; ``timeout`` [s] of one check;
    ``use_cache``: take results of an earlier run with the very same inputs; ``source``: workers started ahead;
    ``watch`` is called with each result as it comes; ``known``: entries of a file of known differences, which the
    renderings tell apart, None for no file.

    Raises :class:`furiko.InvalidInput` for unknown names and bad files, :class:`furiko.EngineMissing` where none of the
    engines is installed, before anything runs, and :class:`ReportNotWritten` at the end of a run whose files could not
    all be written.
    """
    begun = time.monotonic()
    given = None if scenes is None else [str(scene) for scene in scenes]
    plan = make_plan(given, engines, profile)
    _readings(plan.scenes)
    _require_an_engine(plan)
    cache = user_cache() if use_cache else Cache(None)
    results: list[Result] = []
    unwritten: list[str] = []
    diagnoses: list[Diagnosis] = []
    with ExitStack() as open_until_done:
        workers = source or open_until_done.enter_context(worker_processes(modules=MODULES))
        ledger = Ledger(plan)
        running = run(plan, cache=cache, source=workers, jobs=jobs, timeout=timeout, ledger=ledger)
        header = make_header(plan, given, engines)  # while they work: the formulas in it need numpy
        stream = None if out is None else open_until_done.enter_context(open_report(out, header))
        if stream is not None:
            prepare_reports()  # likewise: at the end of a small run nothing else would be left to do

        def take(result: Result) -> None:
            results.append(result if stream is None else _written(stream.write, result, unwritten))
            if watch is not None:
                watch(plan, results[-1])

        for record in running:
            if isinstance(record, Diagnosis):
                diagnoses.append(record if stream is None else _written(stream.write_diagnosis, record, unwritten))
            else:
                take(record)
        for result in ledger.missing(results):
            take(result)
        footer = _footer(stream, results, diagnoses, time.monotonic() - begun, unwritten)
    report = Report(header, tuple(results), footer, tuple(diagnoses))
    if out is not None:
        try:
            write_reports(out, report, None if known is None else known_in(report, known))
        except InvalidInput as error:
            unwritten.append(str(error))
    if unwritten:
        raise ReportNotWritten("; ".join(unwritten), report)
    return report


def _readings(scenes: Sequence[AnyScene]) -> None:
    """Read users' own equations before anything runs. Raises :class:`InvalidInput` with the scene in front."""
    for scene in scenes:
        if isinstance(scene, TreeScene) and scene.own is not None:
            from .derivations.robot.reading import read_robot  # exact algebra, which other scenes need none of

            try:
                read_robot(scene.system, scene.own).motion()
            except InvalidInput as error:
                raise InvalidInput(f"{scene.name}: {error}") from None


def _require_an_engine(plan: Plan) -> None:
    """Raise :class:`EngineMissing` where none of the engines is installed: nothing could be compared."""
    if not plan.absent or not all(plan.absent.values()):
        return
    elsewhere = [why for name, why in plan.absent.items() if why and runs_elsewhere(name)]
    if elsewhere:
        raise EngineMissing("; ".join(dict.fromkeys(elsewhere)))
    packages = list(dict.fromkeys(info.package for info in plan.engines))
    commands = [installing(package) for package in packages]
    every = f"; {installing_all()} installs every one" if len(packages) > 1 else ""
    raise EngineMissing(f"no engine to check is installed: {' or '.join(commands)}{every}")


def _written(write: Callable[[R], R], record: R, unwritten: list[str]) -> R:
    """The record as the stream has it. A stream that takes no more ends there, without a footer; the run goes on."""
    if unwritten:
        return record
    try:
        return write(record)
    except InvalidInput as error:
        unwritten.append(str(error))
        return record


def _footer(
    stream: StreamWriter | None,
    results: Sequence[Result],
    diagnoses: Sequence[Diagnosis],
    seconds: float,
    unwritten: list[str],
) -> Footer:
    if stream is not None and not unwritten:
        try:
            return stream.finish(seconds)
        except InvalidInput as error:
            unwritten.append(str(error))
    return footer_of(results, diagnoses, seconds)


def make_header(plan: Plan, given: Sequence[str] | None, engines: Sequence[str] | None = None) -> Header:
    """The first line of the stream: what runs, where, with what.

    ``given``, ``engines``: scenes and engines as the user named them; None where all run.
    """
    sources = {} if given is None else dict(zip((scene.name for scene in plan.scenes), given, strict=False))
    return Header(
        furiko=__version__,
        started=provenance.now(),
        command=provenance.command(),
        profile=plan.profile.name,
        seed=SEED,
        machine=provenance.machine(),
        versions=provenance.versions(),
        scenes=[
            scene_entry(scene, plan, sources.get(scene.name, scene.name), asked=given is not None)
            for scene in plan.scenes
        ],
        engines=[
            EngineEntry(
                name=info.name,
                formulation=info.formulation,
                package=info.package,
                version=engine_version(info.name),
                place=engine_place(info.name),
                untested=untested(info),
                asked=engines is not None,
            )
            for info in plan.engines
        ],
    )


def scene_entry(scene: AnyScene, plan: Plan, source: str, *, asked: bool = False) -> SceneEntry:
    """One scene in the header. ``source``: what to pass to ``furiko check`` to run it again; ``asked``: by name."""
    from .reference import EQUATIONS

    formulas = {f"{equation.document} {equation.number}": equation.formula for equation in EQUATIONS}
    common: dict[str, Any] = {
        "name": scene.name,
        "system": scene.system.kind,
        "n": scene.system.n,
        "duration": scene.duration,
        "states": min(scene.random, random_states(scene, plan.profile)) + len(scene.named) + scene.starts,
        "description": scene.description,
        "equations": [f"{name}: {formulas[name]}" if name in formulas else name for name in scene.equations],
        "tags": list(scene.tags),
        "source": scene.name if scene.name in catalogue() else source,
        "asked": asked,
    }
    if isinstance(scene, TreeScene):
        from .reference.outline import outline

        tree = scene.system
        if scene.own is not None:
            from .derivations.robot.reading import read_robot

            read = read_robot(tree, scene.own)
            common["own"] = [*read.said, *read.typeset]
        return SceneEntry(
            **common,
            lengths=[],
            masses=[link.mass for link in tree.links],
            gravity=math.hypot(*tree.gravity),
            joints=[f"{joint.name} ({joint.kind})" for joint in tree.joints],
            outline=outline(tree.mechanism(), scene.q or tree.reference),
        )
    system = scene.system
    return SceneEntry(**common, lengths=list(system.lengths), masses=list(system.masses), gravity=system.gravity)
