"""Runs a plan on worker processes and hands out results as they come.

A worker that dies or takes too long costs the check that it was running, which becomes an ``error``; the rest of its
cell is given to a fresh worker. An engine's time limit is for the engine alone; furiko's own work has a limit of its
own, and what exceeds it is never said of the engine.
"""

from __future__ import annotations

import heapq
import os
from collections import Counter, deque
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain

from ..engines.workers.messages import Failed
from ..engines.workers.pool import Event, Finished, Lost, Pool, Worker
from ..engines.workers.processes import Workers
from ..records.check import Diagnosis, Result
from .cache import Cache
from .diagnoses import joined
from .jobs import CellJob, Compared, Facts, TruthJob, accelerations_differ
from .ledger import Ledger
from .plan import Plan, Task

TIMEOUT = 60.0  # [s] for one call of an engine; the slowest sound one seen takes a few
HANGS = 2  # after so many time-outs an engine is given up: each costs the whole time-out


def run(
    plan: Plan,
    *,
    cache: Cache,
    source: Workers,
    jobs: int | None = None,
    timeout: float = TIMEOUT,
    ledger: Ledger | None = None,
    hangs: int | None = HANGS,
) -> Iterator[Result | Diagnosis]:
    """Every result of the plan, and a diagnosis after those of a cell that differs.

    First what is settled or kept already, then the others in the order in which they come.

    Workers are busy from the call on, before the first result is asked for; they end with their ``source``, if not by
    themselves. ``source``: where workers come from; ``jobs``: how many, as many as there are cores for None;
    ``timeout``: seconds for one call of an engine; ``ledger`` is told how many results each check has given;
    ``hangs``: after so many time-outs an engine is given up, None for never.
    """
    known: list[Result | Diagnosis] = [*plan.settled]
    tasks = []
    ledger = ledger or Ledger(plan)
    for task in plan.tasks:
        kept = cache.results(task)
        if kept is None:
            tasks.append(task)
        else:
            known += [*kept.results, *kept.diagnoses]
            for check in task.checks:
                given = sum(result.comparison == check for result in kept.results)
                ledger.promise(task.scene.name, task.engine, check, given)
    if not tasks:
        return iter(known)
    run = _Run(tasks, cache, source, jobs or os.cpu_count() or 1, timeout, ledger, hangs)
    run.begin()
    return chain(known, run.results())


@dataclass
class _Progress:
    """The results of a cell so far."""

    results: list[Result] = field(default_factory=list)
    diagnosis: Diagnosis | None = None  # of the checks so far
    compared: set[str] = field(default_factory=set)


class _Ready:
    """Cells that may run: by engine, the largest scene first, and of equal ones the first that came.

    A cell is put in and taken out in a time that grows with the logarithm of how many there are.
    """

    def __init__(self) -> None:
        self._by_engine: dict[str, list[tuple[int, int, CellJob]]] = {}
        self._came = 0
        self._left = 0

    def __len__(self) -> int:
        return self._left

    def add(self, job: CellJob) -> None:
        """Put a cell in."""
        cells = self._by_engine.setdefault(job.task.engine, [])
        heapq.heappush(cells, (-job.task.scene.system.n, self._came, job))
        self._came, self._left = self._came + 1, self._left + 1

    def take(self, here: Collection[str], importers: Mapping[str, int]) -> CellJob | None:
        """A cell of an engine that is imported ``here``; else of one that no worker has imported; else any."""
        chosen: tuple[int, int, int, str] | None = None
        for name, cells in self._by_engine.items():
            if cells:
                size, came, _ = cells[0]
                rank = (0 if name in here else 2 if importers.get(name) else 1, size, came, name)
                chosen = rank if chosen is None else min(chosen, rank)
        if chosen is None:
            return None
        self._left -= 1
        return heapq.heappop(self._by_engine[chosen[-1]])[2]

    def remove(self, engine: str) -> list[CellJob]:
        """Take out all cells of an engine."""
        cells = sorted(self._by_engine.pop(engine, []))
        self._left -= len(cells)
        return [job for _, _, job in cells]


class _Run:
    """The jobs that wait, and what has come of those that run."""

    def __init__(
        self,
        tasks: list[Task],
        cache: Cache,
        source: Workers,
        jobs: int,
        timeout: float,
        ledger: Ledger,
        most_hangs: int | None = HANGS,
    ) -> None:
        self.cache, self.source, self.timeout, self.ledger = cache, source, timeout, ledger
        sloping, followed = (
            {task.scene.name for task in tasks if check in task.checks} for check in ("derivatives", "horizon")
        )
        scenes = {
            name: TruthJob(task.scene, task.random_states, name in sloping, name in followed)
            for task in tasks
            for name in [task.scene.name]
        }
        # The longest first, motions in quadruple precision and then large mechanisms: cells wait for them.
        self.truths = deque(sorted(scenes.values(), key=lambda job: (not job.followed, -job.scene.system.n)))
        self.waiting: dict[str, list[Task]] = {name: [] for name in scenes}
        for task in tasks:
            self.waiting[task.scene.name].append(task)
        self.ready = _Ready()
        self.hangs: Counter[str] = Counter()
        self.most_hangs = most_hangs
        self.imported: dict[Worker, set[str]] = {}  # engines that a worker has imported already
        self.importers: Counter[str] = Counter()  # how many workers have imported an engine
        self.progress: dict[Worker, _Progress] = {}
        self.left_behind: dict[tuple[str, str], Diagnosis] = {}  # by workers that were lost; by scene and engine
        self.size = min(jobs, len(tasks))
        self.pool: Pool | None = None

    def begin(self) -> None:
        for job in list(self.truths):
            content = self.cache.facts(job.scene, job.random_states, job.slopes, job.followed)
            if content is not None:
                self.truths.remove(job)
                self._release(job, content)
        self.pool = Pool(self.source, self.size)
        self._employ(self.pool)

    def results(self) -> Iterator[Result | Diagnosis]:
        assert self.pool is not None
        try:
            while self._employ(self.pool):
                for event in self.pool.events():
                    yield from self._on(event)
        finally:
            self.pool.close()

    def _employ(self, pool: Pool) -> bool:
        """Give every idle worker a job; whether anything is still under way."""
        for worker in pool.idle():
            job = self._next_for(worker)
            if job is not None:
                self.progress[worker] = _Progress()
                pool.give(worker, job, self.timeout)
        return bool(pool.busy)

    def _next_for(self, worker: Worker) -> TruthJob | CellJob | None:
        """Small truths come before cells only while nothing else is ready; an engine it has imported comes first."""
        if self.truths and (not self.ready or len(self.truths) * 2 > len(self.waiting)):
            return self.truths.popleft()
        here = self.imported.setdefault(worker, set())
        job = self.ready.take(here, self.importers)
        if job is not None and job.task.engine not in here:
            here.add(job.task.engine)
            self.importers[job.task.engine] += 1
        return job or (self.truths.popleft() if self.truths else None)

    def _on(self, event: Event) -> Iterator[Result | Diagnosis]:
        progress, job = self.progress[event.worker], event.job
        if isinstance(event, Lost):
            self.importers.subtract(self.imported.pop(event.worker, set()))
            yield from self._lost(job, event, progress)
        elif isinstance(event, Finished):
            if isinstance(job, CellJob):
                yield from self._finished(job, progress)
                yield from self._diagnosis(job, progress)
        elif isinstance(event.message, Result):
            progress.results.append(event.message)
            yield event.message
        elif isinstance(event.message, Diagnosis):
            progress.diagnosis = event.message
        elif isinstance(event.message, Compared) and isinstance(job, CellJob):
            progress.compared.add(event.message.check)
            self.ledger.promise(job.task.scene.name, job.task.engine, event.message.check, event.message.results)
        elif isinstance(event.message, Facts) and isinstance(job, TruthJob):
            self.cache.keep_facts(job.scene, job.random_states, event.message.content, job.slopes, job.followed)
            self._release(job, event.message.content)
        elif isinstance(event.message, Failed):
            yield from self._failed(job, event.message.reason, {"traceback": event.message.trace}, progress)

    def _diagnosis(self, job: CellJob, progress: _Progress, ends: bool = True) -> Iterator[Diagnosis]:
        """The cell's diagnosis, where the cell ends here; else it is remembered for what is left of the cell."""
        cell = job.task.scene.name, job.task.engine
        found = joined(self.left_behind.pop(cell, None), progress.diagnosis)
        if found is not None and ends:
            yield found
        elif found is not None:
            self.left_behind[cell] = found

    def _release(self, job: TruthJob, facts: bytes) -> None:
        """A scene's truth is known: its cells may run."""
        for task in self.waiting.pop(job.scene.name):
            self.ready.add(CellJob(task, facts))

    def _finished(self, job: CellJob, progress: _Progress) -> Iterator[Result]:
        missing = [check for check in job.task.checks if check not in progress.compared]
        for check in missing:
            yield _error(job.task, check, "the check was planned, and no result of it arrived")
        if not missing:
            self.cache.keep_results(job.task, progress.results, [progress.diagnosis] if progress.diagnosis else [])

    def _lost(self, job: object, event: Lost, progress: _Progress) -> Iterator[Result | Diagnosis]:
        """A worker is gone with the job it had: say so, and let a fresh one resume what is left of it."""
        reason, check = event.reason, event.step.name
        if event.overdue and not event.step.engine:
            reason = f"{reason}: furiko's own computation takes too long here; nothing is known of the engine"
        elif event.overdue:
            reason = f"{reason}: it hangs"
        if not isinstance(job, CellJob) or check not in job.task.checks:
            yield from self._failed(job, reason, {}, progress)
            if isinstance(job, CellJob):
                yield from self._diagnosis(job, progress)
            return
        engine = job.task.engine
        self.hangs[engine] += event.overdue and event.step.engine
        if check not in progress.compared:
            yield _error(job.task, check, reason)
        left = job.task.checks[job.task.checks.index(check) + 1 :]
        given_up = self.most_hangs is not None and self.hangs[engine] >= self.most_hangs
        goes_on = bool(left) and not given_up
        yield from self._diagnosis(job, progress, ends=not goes_on)
        if given_up:
            yield from self._give_up(engine)
            yield from (_error(job.task, other, self._given_up()) for other in left)
        elif goes_on:
            differs = any(accelerations_differ(result.comparison, result) for result in progress.results)
            task = replace(job.task, checks=left)
            self.ready.add(replace(job, task=task, differs=job.differs or differs))

    def _give_up(self, engine: str) -> Iterator[Result | Diagnosis]:
        """An engine that hangs again and again: its other cells are errors without another wait."""
        for job in self.ready.remove(engine):
            yield from self._diagnosis(job, _Progress())
            yield from (_error(job.task, check, self._given_up()) for check in job.task.checks)
        for tasks in self.waiting.values():
            for task in [task for task in tasks if task.engine == engine]:
                tasks.remove(task)
                yield from (_error(task, check, self._given_up()) for check in task.checks)

    def _given_up(self) -> str:
        return f"not tried: the engine has hung {self.most_hangs} times"

    def _failed(self, job: object, reason: str, details: dict[str, str], progress: _Progress) -> Iterator[Result]:
        """A whole job came to nothing: all its checks are errors."""
        if isinstance(job, CellJob):
            left = [check for check in job.task.checks if check not in progress.compared]
            progress.compared.update(left)
            yield from (_error(job.task, check, reason, details) for check in left)
        elif isinstance(job, TruthJob):
            reason = f"the truth could not be computed: {reason}"
            for task in self.waiting.pop(job.scene.name, []):
                yield from (_error(task, check, reason, details) for check in task.checks)


def _error(task: Task, check: str, reason: str, details: dict[str, str] | None = None) -> Result:
    return Result(
        scene=task.scene.name,
        engine=task.engine,
        check=check,
        comparison=check,
        outcome="error",
        reason=reason,
        details=details or {},
    )
