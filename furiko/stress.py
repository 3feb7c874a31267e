"""One run of the stress test: plan, results of an earlier run, workers, stream and pages, tied together."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from . import __version__
from .engines import EngineInfo, all_of, engine_info, engine_names, engine_version, why_missing
from .models import EngineMissing, InvalidInput
from .models.errors import nearest
from .models.writers.whole_file import make_folder
from .records import provenance
from .records.check import EngineEntry, Header
from .records.stress import StressSummary
from .reports.journal import Journal
from .studies.stress.axes import AXES, Ladder, find_axes, pairs
from .studies.stress.over_bound import DOCUMENT, KERNELS, OWN
from .studies.stress.searches import FAMILIES, Results, Search, key, make_searches
from .studies.stress.searches import run as run_cases
from .studies.stress.trees.axes import TREE_AXES, TreeLadder, find_ladders, tree_ladders

STREAM = "stress.jsonl"
BUDGET = 60.0  # [s]
SEED = 2018
PROFILE = "stress"

Watch = Callable[["Progress"], None]
R = TypeVar("R")


@dataclass(frozen=True)
class Progress:
    """Progress of a run: cases done, questions open, and the case that runs now."""

    done: int
    open: int
    now: str


@dataclass(frozen=True)
class StressPlan:
    """The searches of a run, and the engines that take part."""

    searches: list[Search]
    engines: list[EngineInfo]


class StressNotWritten(InvalidInput):
    """The run is over, and a file of it could not be written; ``summary`` is what it found all the same."""

    def __init__(self, message: str, summary: StressSummary) -> None:
        super().__init__(message)
        self.summary = summary


def stress(
    axes: Sequence[str] | None = None,
    engines: Sequence[str] | None = None,
    *,
    budget: float = BUDGET,
    seed: int = SEED,
    out: str | Path | None = None,
    fresh: bool = False,
    jobs: int | None = None,
    timeout: float = 30.0,
    long_steps: int = 10_000_000,
    watch: Watch | None = None,
) -> StressSummary:
    """Find where engines, integrators and formulas break; returns the summary.

    ``axes``: names of ladders, of pairs (``A x B``) or of families (``steps``, ``chain``, …), None for all but pairs;
    ``engines``: names, ``document`` and ``kernels`` among them, None for all; ``budget`` [s] of the whole; ``out``:
    folder of the stream and the pages, where an earlier run is resumed unless ``fresh``; None writes nothing. ``jobs``:
    worker processes; ``timeout`` [s] of one case; ``long_steps``: number of steps of a long run.
    Raises :class:`InvalidInput` for unknown names and for a folder that holds another run, before anything runs, and
    :class:`StressNotWritten` at the end of a run whose files could not all be written.
    """
    begun = time.monotonic()
    plan = make_plan(axes, engines, seed=seed, long_steps=long_steps)
    folder = None if out is None else _folder(out, fresh)
    header = make_header(plan, seed)
    results: dict[Any, Any] = {}
    unwritten: list[str] = []
    if folder is None:
        _work(plan.searches, results, budget, jobs, timeout, watch, None, unwritten)
    else:
        with Journal(folder / STREAM, header) as journal:
            results.update((key(result), result) for result in journal.results)
            _work(plan.searches, results, budget, jobs, timeout, watch, journal, unwritten)
            _unless_unwritten(unwritten, journal.finish, time.monotonic() - begun)
            header = journal.header
    return summarise(plan.searches, results, header, seed, folder, unwritten)


def summarise(
    searches: Sequence[Search],
    results: Results,
    header: Header,
    seed: int,
    folder: Path | None,
    unwritten: Sequence[str] = (),
) -> StressSummary:
    """The summary; its pages are written into the folder, if there is one.

    Raises :class:`StressNotWritten` where they cannot be, or where the run has ``unwritten`` files already.
    """
    from .studies.stress.summary import summary

    found, failures = summary(searches, results, seed=seed), list(unwritten)
    if folder is not None:
        from .reports.pages.stress_page import write_pages

        try:
            write_pages(folder, found, header)
        except InvalidInput as error:
            failures.append(str(error))
    if failures:
        raise StressNotWritten("; ".join(failures), found)
    return found


def tip_verdict(folder: Path) -> list[str]:
    """What the run in a folder says of the tip of Takeno's chain. Raises :class:`InvalidInput` if that is nothing."""
    from .reports import read_stream
    from .studies.stress.chain_summary import chain_summary

    results = {key(result): result for result in read_stream(folder / STREAM).results}
    said = chain_summary(make_plan(["chain"], None, seed=SEED).searches, results).verdict
    if not said:
        raise InvalidInput(f"{folder}: this run moved no chains far enough; furiko stress -a chain does")
    return said


def _unless_unwritten(unwritten: list[str], write: Callable[[R], object], record: R) -> None:
    """Write, unless that has failed before: a journal that takes no more ends there, and the run goes on."""
    if unwritten:
        return
    try:
        write(record)
    except InvalidInput as error:
        unwritten.append(str(error))


def make_plan(
    axes: Sequence[str] | None, engines: Sequence[str] | None, *, seed: int, long_steps: int = 10_000_000
) -> StressPlan:
    """The searches. Raises :class:`InvalidInput` for unknown names, :class:`EngineMissing` for a missing engine."""
    ladders, trees, families = chosen_axes(axes)
    names = all_of((*OWN, *engine_names()) if engines is None else engines)
    own = [name for name in names if name in OWN]
    # An engine of the user's keeps the path by which it was loaded as its name.
    infos = [replace(engine_info(name), name=name) for name in names if name not in OWN]
    reasons = {info.name: why_missing(info.name) for info in infos}
    missing = [info for info in infos if reasons[info.name]]
    if missing and engines is not None:
        raise EngineMissing(f"{missing[0].name}: {reasons[missing[0].name]}")
    infos = [info for info in infos if info not in missing]
    searches = make_searches(
        ladders, infos, own, seed=seed, families=families, long_steps=long_steps, trees=trees or None
    )
    if not searches:
        raise InvalidInput(f"stress: nothing to run: {', '.join(names)} takes no part in {', '.join(axes or ())}")
    return StressPlan(searches, infos)


def chosen_axes(
    axes: Sequence[str] | None,
) -> tuple[tuple[Ladder, ...], tuple[TreeLadder, ...], tuple[str, ...]]:
    """Ladders, those of open mechanisms (none: all, if their family is there) and families by name.

    None: all but pairs. Raises :class:`InvalidInput` for unknown names.
    """
    if axes is None:
        return AXES, (), tuple(family for family in FAMILIES if family != "pairs")
    trees = [] if {"trees", "all"} & {*axes} else [ladder for name in axes for ladder in find_ladders(name)]
    families = [name for name in FAMILIES if name in axes]
    ladders: list[Ladder] = []
    for name in axes:
        if name == "accelerations":
            ladders += AXES
        elif name == "pairs":
            ladders += pairs()
        elif name == "all":
            ladders += [*AXES, *pairs()]
            families += FAMILIES
        elif find_ladders(name):
            families.append("trees")
        elif name not in FAMILIES:
            ladders += _of_documents(name)
            families += ["pairs" if " x " in name else "accelerations"]
    climbed = {ladder.name: ladder for ladder in trees}
    return tuple(dict.fromkeys(ladders)), tuple(climbed.values()), tuple(dict.fromkeys(families))


def _of_documents(name: str) -> tuple[Ladder, ...]:
    """The ladders of the documents' mechanisms with this name; where none has it, the nearest of all is told."""
    known = [*(axis.name for axis in TREE_AXES), *tree_ladders(), *(axis.name for axis in AXES)]
    try:
        return find_axes((name,))
    except InvalidInput:
        if " x " not in name and (hint := nearest(name, known)):
            raise InvalidInput(f"axis: none is called {name!r}{hint}") from None
        raise


def make_header(plan: StressPlan, seed: int) -> Header:
    """The first line of the stream."""
    return Header(
        furiko=__version__,
        started=provenance.now(),
        command=provenance.command(),
        profile=PROFILE,
        seed=str(seed),
        machine=provenance.machine(),
        versions=provenance.versions(),
        scenes=[],
        engines=[
            *(
                EngineEntry(name=name, formulation=says, package="furiko", version=__version__)
                for name, says in (
                    (DOCUMENT, "the documents' own formulas, a dense system solved in double precision"),
                    (KERNELS, "furiko's O(n) elimination: single states, batches, and plain numpy"),
                )
            ),
            *(
                EngineEntry(name=i.name, formulation=i.formulation, package=i.package, version=engine_version(i.name))
                for i in map(engine_info, engine_names())
            ),
        ],
    )


def _work(
    searches: Sequence[Search],
    results: dict[Any, Any],
    budget: float,
    jobs: int | None,
    timeout: float,
    watch: Watch | None,
    journal: Journal | None,
    unwritten: list[str],
) -> None:
    def begins(case: Any, waiting: int) -> None:
        if watch is not None:
            watch(Progress(len(results), waiting, f"{case.engine}: {case.scene}, {case.check}"))

    number = jobs or min(os.cpu_count() or 1, 8)
    for result in run_cases(searches, results, budget=budget, jobs=number, timeout=timeout, watch=begins):
        if journal is not None:
            _unless_unwritten(unwritten, journal.write, result)


def _folder(out: str | Path, fresh: bool) -> Path:
    folder = Path(out)
    make_folder(folder)
    try:
        if fresh:
            (folder / STREAM).unlink(missing_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror or error}") from None
    return folder
