"""Runs a plan on worker processes and hands out results as they come.

A worker that dies or takes too long costs the check that it was running, which becomes an ``error``; the rest of its
cell is given to a fresh worker.
"""

from __future__ import annotations

import os
import subprocess
import time
from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import chain
from multiprocessing.connection import Connection, wait

from ..engines import engine_version
from ..records.check import Result
from .cache import Cache
from .plan import Plan, Task
from .workers.messages import Begun, CellJob, Done, Facts, FactsJob, Failed
from .workers.processes import Workshop, death, end, give

TIMEOUT = 60.0  # [s] for one check; the slowest sound one seen takes a few
HANGS = 2  # after so many time-outs an engine is given up: each costs the whole time-out


def run(
    plan: Plan, *, cache: Cache, place: Workshop, jobs: int | None = None, timeout: float = TIMEOUT
) -> Iterator[Result]:
    """Every result of the plan: first what is settled or kept already, then the others in the order in which they come.

    Workers are busy from the call on, before the first result is asked for; they end with their ``place``, if not by
    themselves. ``place``: where workers come from; ``jobs``: how many, as many as there are cores for None;
    ``timeout``: seconds for one check.
    """
    known, tasks = [*plan.settled], []
    for task in plan.tasks:
        kept = cache.results(task, version) if (version := engine_version(task.engine)) else None
        if kept is None:
            tasks.append(task)
        else:
            known += kept
    if not tasks:
        return iter(known)
    pool = _Pool(tasks, cache, place, jobs or os.cpu_count() or 1, timeout)
    pool.begin()
    return chain(known, pool.results())


@dataclass(eq=False)
class _Worker:
    """A worker process and what it is busy with."""

    process: subprocess.Popen[bytes]
    connection: Connection
    job: FactsJob | CellJob | None = None
    check: str = ""
    deadline: float = 0.0
    results: list[Result] = field(default_factory=list)  # of its job so far
    engines: set[str] = field(default_factory=set)  # it has imported these already

    def give(self, job: FactsJob | CellJob) -> None:
        self.job, self.check, self.results = job, "", []
        give(self.connection, job)


class _Pool:
    """Workers, the jobs that wait, and the bookkeeping between them."""

    def __init__(self, tasks: list[Task], cache: Cache, place: Workshop, jobs: int, timeout: float) -> None:
        self.cache, self.place, self.timeout = cache, place, timeout
        scenes = {task.scene.name: FactsJob(task.scene, task.random_states) for task in tasks}
        # The largest truths first: they take longest, and cells wait for them.
        self.facts_jobs = deque(sorted(scenes.values(), key=lambda job: -job.scene.system.n))
        self.waiting: dict[str, list[Task]] = {name: [] for name in scenes}
        for task in tasks:
            self.waiting[task.scene.name].append(task)
        self.ready: list[CellJob] = []
        self.hangs: Counter[str] = Counter()
        self.workers: list[_Worker] = []
        self.size = min(jobs, len(tasks))

    def begin(self) -> None:
        for job in list(self.facts_jobs):
            content = self.cache.facts(job.scene, job.random_states)
            if content is not None:
                self.facts_jobs.remove(job)
                self._release(job, content)
        for _ in range(self.size):
            self._start()
        self._employ()

    def results(self) -> Iterator[Result]:
        try:
            while self._employ():
                yield from self._listen()
        finally:
            for worker in list(self.workers):
                self._stop(worker)

    def _start(self) -> None:
        self.workers.append(_Worker(*self.place.worker()))

    def _stop(self, worker: _Worker) -> None:
        self.workers.remove(worker)
        end(worker.process, worker.connection)

    def _employ(self) -> bool:
        """Give every idle worker a job; whether anything is still under way."""
        for worker in self.workers:
            if worker.job is None:
                job = self._next_for(worker)
                if job is not None:
                    worker.deadline = time.monotonic() + self.timeout
                    worker.give(job)
        return any(worker.job is not None for worker in self.workers)

    def _next_for(self, worker: _Worker) -> FactsJob | CellJob | None:
        """Small truths come before cells only while nothing else is ready; an engine it has imported comes first."""
        if self.facts_jobs and (not self.ready or len(self.facts_jobs) * 2 > len(self.waiting)):
            return self.facts_jobs.popleft()
        if self.ready:
            elsewhere = {name for other in self.workers if other is not worker for name in other.engines}
            self.ready.sort(key=lambda job: _preference(job, worker.engines, elsewhere))
            job = self.ready.pop(0)
            worker.engines.add(job.task.engine)
            return job
        return self.facts_jobs.popleft() if self.facts_jobs else None

    def _listen(self) -> Iterator[Result]:
        """What workers say until one of them is idle again, dead or overdue."""
        busy = [worker for worker in self.workers if worker.job is not None]
        patience = max(0.0, min(worker.deadline for worker in busy) - time.monotonic())
        heard = wait([worker.connection for worker in busy], patience)
        for worker in busy:
            if worker.connection in heard:
                try:
                    message = worker.connection.recv()
                except (EOFError, ConnectionError):
                    yield from self._lost(worker, death(worker.process))
                else:
                    yield from self._heard(worker, message)
        for worker in list(self.workers):
            if worker.job is not None and time.monotonic() > worker.deadline:
                if isinstance(worker.job, CellJob):
                    self.hangs[worker.job.task.engine] += 1
                yield from self._lost(worker, f"no answer within {self.timeout:g} s: it hangs")

    def _heard(self, worker: _Worker, message: object) -> Iterator[Result]:
        job = worker.job
        if isinstance(message, Result):
            worker.results.append(message)
            yield message
        elif isinstance(message, Begun):
            worker.check = message.check
            worker.deadline = time.monotonic() + self.timeout
        elif isinstance(message, Done):
            worker.job = None
            if isinstance(job, CellJob) and (version := engine_version(job.task.engine)) and worker.results:
                self.cache.keep_results(job.task, version, worker.results)
        elif isinstance(message, Facts) and isinstance(job, FactsJob):
            self.cache.keep_facts(job.scene, job.random_states, message.content)
            self._release(job, message.content)
        elif isinstance(message, Failed) and job is not None:
            yield from self._failed(job, message.reason, {"traceback": message.trace})

    def _release(self, job: FactsJob, facts: bytes) -> None:
        """A scene's truth is known: its cells may run."""
        self.ready += [CellJob(task, facts) for task in self.waiting.pop(job.scene.name)]

    def _lost(self, worker: _Worker, reason: str) -> Iterator[Result]:
        """A worker is gone with the job it had: say so, and let a fresh one go on with what is left of it."""
        job, check = worker.job, worker.check
        self._stop(worker)
        self._start()
        if isinstance(job, CellJob) and check:
            yield _error(job.task, check, reason)
            left = job.task.checks[job.task.checks.index(check) + 1 :]
            if self.hangs[job.task.engine] >= HANGS:
                yield from self._give_up(job.task.engine)
                given_up = f"not tried: the engine has hung {HANGS} times"
                yield from (_error(job.task, other, given_up) for other in left)
            elif left:
                self.ready.append(replace(job, task=replace(job.task, checks=left)))
        elif job is not None:
            yield from self._failed(job, reason, {})

    def _give_up(self, engine: str) -> Iterator[Result]:
        """An engine that hangs again and again: its other cells are errors without another wait."""
        reason = f"not tried: the engine has hung {HANGS} times"
        for job in [job for job in self.ready if job.task.engine == engine]:
            self.ready.remove(job)
            yield from (_error(job.task, check, reason) for check in job.task.checks)
        for tasks in self.waiting.values():
            for task in [task for task in tasks if task.engine == engine]:
                tasks.remove(task)
                yield from (_error(task, check, reason) for check in task.checks)

    def _failed(self, job: FactsJob | CellJob, reason: str, details: dict[str, str]) -> Iterator[Result]:
        """A whole job came to nothing: all its checks are errors."""
        if isinstance(job, CellJob):
            tasks = [job.task]
        else:
            tasks, reason = self.waiting.pop(job.scene.name), f"the truth could not be computed: {reason}"
        for task in tasks:
            yield from (_error(task, check, reason, details) for check in task.checks)


def _preference(job: CellJob, here: set[str], elsewhere: set[str]) -> tuple[int, int]:
    name = job.task.engine
    return (0 if name in here else 2 if name in elsewhere else 1), -job.task.scene.system.n


def _error(task: Task, check: str, reason: str, details: dict[str, str] | None = None) -> Result:
    return Result(
        scene=task.scene.name, engine=task.engine, check=check, outcome="error", reason=reason, details=details or {}
    )
