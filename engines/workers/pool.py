"""The pool: workers, the job that each is busy with, its time limit, and what became of it."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Any

from .messages import Done, Job, Ready, Step
from .processes import WorkerProcess, Workers

START = Step("", engine=True)  # until the job says otherwise
OWN_LIMIT = 600.0  # [s] for a step of furiko's own work


@dataclass(eq=False)
class Worker:
    """A worker, its job, and the step that the job is at."""

    process: WorkerProcess
    job: Job | None = None
    begun: float = 0.0  # when it was given its job, or was ready for it
    limit: float = 0.0  # [s] for a step that asks an engine
    heard: int = 0  # messages of this job

    def at(self) -> tuple[float, Step]:
        """When the step began that its job is at, and the step. A time that cannot be is not believed."""
        shown = self.process.clock.last()
        return shown if shown is not None and self.begun <= shown[0] <= time.monotonic() else (self.begun, START)

    def allowed(self, step: Step) -> float:
        """Seconds for a step. A process that is still starting is at work of furiko's own."""
        engine = step.engine and self.process.channel.ready
        return self.limit if engine else max(self.limit, OWN_LIMIT)

    def deadline(self) -> float:
        """When the step takes too long (of time.monotonic)."""
        begun, step = self.at()
        return begun + self.allowed(step)


@dataclass(frozen=True)
class Said:
    """A job sent a message."""

    worker: Worker
    job: Job
    message: Any


@dataclass(frozen=True)
class Finished:
    """A job is over, and all that it sent has arrived."""

    worker: Worker
    job: Job


@dataclass(frozen=True)
class Lost:
    """A job will not end: its worker died or sent rubbish (``overdue`` False), or its step took too long (True)."""

    worker: Worker
    job: Job
    step: Step
    reason: str
    overdue: bool = False


Event = Said | Finished | Lost


class Pool:
    """``size`` workers from ``source``. A worker that is lost is replaced by a fresh one at once."""

    def __init__(self, source: Workers, size: int) -> None:
        self.source = source
        self.workers = [Worker(source.worker()) for _ in range(size)]

    def idle(self) -> list[Worker]:
        """Workers without a job."""
        return [worker for worker in self.workers if worker.job is None]

    @property
    def busy(self) -> list[Worker]:
        """Workers with a job."""
        return [worker for worker in self.workers if worker.job is not None]

    def give(self, worker: Worker, job: Job, limit: float) -> None:
        """Give an idle worker a job; ``limit`` [s] for each step in which an engine is asked."""
        worker.job, worker.heard, worker.begun, worker.limit = job, 0, time.monotonic(), limit
        with contextlib.suppress(OSError):  # if it has died, its closed connection will tell
            worker.process.channel.send(job)

    def events(self, until: float | None = None) -> Iterator[Event]:
        """The next events: waits until a worker says something, is overdue, or ``until`` (of time.monotonic)."""
        busy = self.busy
        if not busy:
            return
        now = time.monotonic()
        # A step that asks an engine may begin at any time from now on, and nobody is woken by it.
        ends = [min(worker.deadline(), now + worker.limit) for worker in busy] + ([] if until is None else [until])
        ready = wait([worker.process.channel.connection for worker in busy], max(0.0, min(ends) - now))
        for worker in busy:
            if worker.process.channel.connection in ready:
                yield from self._listen(worker)
        now = time.monotonic()
        for worker in busy:
            if worker.job is not None and worker in self.workers and now > worker.deadline():
                allowed = worker.allowed(worker.at()[1])
                yield from self._lose(worker, f"no answer within {allowed:g} s", overdue=True)

    def stop(self, worker: Worker) -> None:
        """End a worker with whatever it is doing, and start a fresh one in its place."""
        self.source.end(worker.process)
        worker.job = None
        self.workers[self.workers.index(worker)] = Worker(self.source.worker())

    def close(self) -> None:
        """End all workers; those without a job go back to a source that keeps them for the next pool."""
        for worker in self.workers:
            if self.source.keeps and worker.job is None:
                self.source.take_back(worker.process)
            else:
                self.source.end(worker.process)
        self.workers = []

    def _listen(self, worker: Worker) -> Iterator[Event]:
        try:
            messages = worker.process.channel.available()
        except (EOFError, ConnectionResetError):
            yield from self._lose(worker, worker.process.how_it_died())
            return
        except OSError as error:
            yield from self._lose(worker, f"the engine's process cannot be understood: {error}")
            return
        for message in messages:
            if isinstance(message, Ready) and not worker.process.channel.ready:
                worker.process.channel.ready = True
                if worker.at()[1] is START:  # if it has not begun a step meanwhile
                    worker.begun = time.monotonic()
                continue
            job = worker.job
            if job is None:  # it spoke without being asked: not to be trusted with another job
                self.stop(worker)
                return
            if isinstance(message, Done):
                if message.sent != worker.heard:
                    yield from self._lose(
                        worker, f"{message.sent - worker.heard} of {message.sent} messages did not arrive"
                    )
                    return
                worker.job = None
                yield Finished(worker, job)
                continue
            worker.heard += 1
            yield Said(worker, job, message)

    def _lose(self, worker: Worker, reason: str, *, overdue: bool = False) -> Iterator[Event]:
        job, (_, step) = worker.job, worker.at()
        self.stop(worker)
        if job is not None:
            yield Lost(worker, job, step, reason, overdue)
