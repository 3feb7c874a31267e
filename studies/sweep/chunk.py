"""A chunk: its scenes, made from their numbers, and their cells, run as ``furiko check`` runs them.

An engine runs in a process of furiko's own. One that dies, hangs, floods its connection or takes too much memory is the
error of the check that it was asked for, and a fresh process goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import cache
from typing import Self

from ...checks.cache import Cache
from ...checks.imported_ahead import MODULES
from ...checks.ledger import Ledger
from ...checks.plan import Profile, plan_of
from ...checks.runner import run
from ...engines import EngineInfo, engine_info, engine_version
from ...engines.workers.processes import worker_processes
from ...models import AnyScene, InvalidInput
from ...records.check import Result
from ...records.sweep import SweepMark, SweepRow
from .plan import Place, Sweep
from .table import finite, to_parquet


@dataclass(frozen=True)
class Work:
    """A chunk that is to be done: its number, and the engines of which no results of it are kept."""

    chunk: int
    engines: tuple[str, ...]


@dataclass(frozen=True)
class Part:
    """The results of a chunk on one engine: the content of its file, and how much is in it.

    ``outcomes``: how many results have which outcome.
    """

    mark: SweepMark
    content: bytes
    outcomes: Mapping[str, int]


class Stopped(Exception):
    """Nobody waits for a chunk any more."""


class Lane:
    """One worker process after another, which serves one chunk after another; what a thread or a task works with."""

    def __init__(self, memory: int | None) -> None:
        self._open = ExitStack()
        self.source = self._open.enter_context(worker_processes(modules=MODULES, memory=memory, keeps=True))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def end(self) -> None:
        """End its processes, whatever they are doing."""
        self._open.close()


def do(
    sweep: Sweep, digest: str, work: Work, lane: Lane, stopped: Callable[[], bool] = lambda: False
) -> tuple[Part, ...]:
    """Run a chunk; a part for each of its engines.

    ``digest``: of the sweep, which each part carries; ``stopped`` is asked after each result. Raises :class:`Stopped`.
    """
    places, scenes, refused = _scenes(sweep, work.chunk)
    infos = tuple(replace(engine_info(name), name=name) for name in work.engines)
    profile = Profile("sweep", "", sweep.checks, 10 * sweep.states)  # of trees a tenth is looked at: all are asked for
    plan = plan_of(tuple(scenes), infos, profile, absent=dict.fromkeys(work.engines, ""))
    ledger = Ledger(plan)
    results: list[Result] = []
    running = run(plan, cache=Cache(None), source=lane.source, jobs=1, timeout=sweep.seconds, ledger=ledger, hangs=None)
    for record in running:
        if stopped():
            raise Stopped
        if isinstance(record, Result):
            results.append(record)
    results += ledger.missing(results)
    results += [_refused(place, info, check, why) for place, why in refused for info in infos for check in sweep.checks]
    return tuple(_part(sweep, digest, work.chunk, places, info, results) for info in infos)


def _scenes(sweep: Sweep, chunk: int) -> tuple[dict[str, tuple[Place, int]], list[AnyScene], list[tuple[Place, str]]]:
    """By the scene's name its place and n; the scenes; and the places whose parameters make none, and why."""
    places: dict[str, tuple[Place, int]] = {}
    scenes: list[AnyScene] = []
    refused: list[tuple[Place, str]] = []
    for number in sweep.numbers(chunk):
        place = sweep.place(number)
        try:
            scenes.append(sweep.scene(place))
        except InvalidInput as error:
            refused.append((place, f"the parameters make no mechanism: {error}"))
        places[place.name] = place, 0 if refused and refused[-1][0] is place else scenes[-1].system.n
    return places, scenes, refused


def _refused(place: Place, info: EngineInfo, check: str, why: str) -> Result:
    return Result(scene=place.name, engine=info.name, check=check, comparison=check, outcome="error", reason=why)


def _part(
    sweep: Sweep,
    digest: str,
    chunk: int,
    places: Mapping[str, tuple[Place, int]],
    info: EngineInfo,
    results: Sequence[Result],
) -> Part:
    version = _version(info.name)
    found = [_row(sweep, *places[result.scene], version, result) for result in results if result.engine == info.name]
    # In the order of the cells, and of the checks in each: the same whatever came first.
    order = {name: k for k, name in enumerate(sweep.checks)}
    rows = sorted(found, key=lambda row: (row.cell, order[row.comparison]))
    outcomes: dict[str, int] = {}
    for row in rows:
        outcomes[row.outcome] = outcomes.get(row.outcome, 0) + 1
    mark = SweepMark(digest=digest, chunk=chunk, engine=info.name, cells=len({r.cell for r in rows}), rows=len(rows))
    return Part(mark, to_parquet(rows, mark, sweep.parameters), outcomes)


_version = cache(engine_version)  # its package's metadata is a file


def _row(sweep: Sweep, place: Place, n: int, version: str, result: Result) -> SweepRow:
    base = place.source.base
    details = result.details
    return SweepRow(
        cell=sweep.cell(place.number, result.engine),
        scene=result.scene,
        source=place.source.label,
        system=base.system.kind if hasattr(base, "system") else base.kind,
        n=n,
        seed=place.seed,
        engine=result.engine,
        version=version,
        comparison=result.comparison,
        check=result.check,
        outcome=result.outcome,
        loose=result.loose,
        measured=result.measured,
        allowed=result.allowed,
        unit=result.unit,
        error=finite(details, "forward error"),
        states=int(finite(details, "states") or 0),
        seconds=result.seconds,
        in_engine=result.in_engine,
        cause=result.cause,
        reason=result.reason,
        traceback=str(details.get("traceback", "")),
        parameters=place.values,
    )
