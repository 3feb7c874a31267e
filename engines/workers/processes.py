"""Worker processes, and a few of them started ahead, while the command is still importing what it needs to plan."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ...models.errors import LibraryMissing
from .channel import SEND_TIMEOUT, Channel
from .clock import Clock, clock_file
from .messages import Setup

MOST_AHEAD = 4  # more are started only once it is known how much there is to do
PREFIX = "furiko-"

ENVIRONMENT = {
    # One worker a core: threads of a linear algebra library would only slow each other down.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    # Nothing is drawn: MuJoCo need not look for a window system, which takes half of its import.
    "MUJOCO_GL": "disable",
}


@dataclass(frozen=True)
class WorkerProcess:
    """A worker process, our end of the connection to it, and its clock."""

    process: subprocess.Popen[bytes]
    channel: Channel
    clock: Clock

    def end(self) -> None:
        """End it, whatever it is doing; one that has ended already stays so."""
        self.process.kill()
        self.process.wait()
        self.channel.close()
        self.clock.close()

    def how_it_died(self) -> str:
        """In words, for one whose connection is closed."""
        status = self.process.wait()
        if status < 0:
            return f"the engine's process died of {signal.Signals(-status).name}"
        return f"the engine's process ended with status {status}"


@dataclass(frozen=True)
class Workers:
    """A temporary folder for workers to run in, and workers that wait there for a job.

    ``keeps``: whether a pool that closes gives its idle workers back, so that the next one need not start others.
    """

    folder: str
    memory: int | None = None  # bytes that each may allocate
    modules: tuple[str, ...] = ()  # imported by each worker while its first job is still being decided on
    keeps: bool = False
    waiting: list[WorkerProcess] = field(default_factory=list)
    taken: list[WorkerProcess] = field(default_factory=list)

    def worker(self) -> WorkerProcess:
        """One that waits, or a fresh one."""
        while self.waiting:
            found = self.waiting.pop()
            if not self.keeps or found.process.poll() is None:  # it may have died since it was given back
                break
            found.end()
        else:
            found = spawn(self.folder, self.modules, self.memory)
        self.taken.append(found)
        return found

    def take_back(self, worker: WorkerProcess) -> None:
        """A worker that has done its job, and waits for the next."""
        self.taken.remove(worker)
        self.waiting.append(worker)

    def end(self, worker: WorkerProcess) -> None:
        """End a worker, whatever it is doing, and forget it."""
        worker.end()
        if worker in self.taken:
            self.taken.remove(worker)


@contextlib.contextmanager
def worker_processes(
    ahead: int = 0, modules: Sequence[str] = (), memory: int | None = None, *, keeps: bool = False
) -> Iterator[Workers]:
    """A source of workers, so many of them started already; all its workers are ended with it.

    ``memory``: bytes that each may allocate, None for any number; ``keeps``: workers serve one pool after the other.
    """
    remove_left_behind()
    with tempfile.TemporaryDirectory(prefix=f"{PREFIX}{os.getpid()}-", ignore_cleanup_errors=True) as folder:
        found = Workers(folder, memory, tuple(modules), keeps)
        try:
            found.waiting.extend(spawn(folder, found.modules, memory) for _ in range(min(ahead, MOST_AHEAD)))
            yield found
        finally:
            for worker in found.waiting + found.taken:
                worker.end()


def remove_left_behind() -> None:
    """Remove the folders of runs that were killed: their process is gone."""
    if sys.platform == "win32":
        return  # asking there whether a process lives would end it
    for path in Path(tempfile.gettempdir()).glob(f"{PREFIX}*-*"):
        owner = path.name.removeprefix(PREFIX).partition("-")[0]
        if owner.isdigit() and not _alive(int(owner)):
            shutil.rmtree(path, ignore_errors=True)


def _alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True  # somebody else's
    return True


def spawn(folder: str, modules: Sequence[str] = (), memory: int | None = None) -> WorkerProcess:
    """A fresh worker process that runs in ``folder``; ``memory``: bytes that it may allocate."""
    if sys.platform == "win32":
        raise LibraryMissing("engines run in processes of their own, which needs Linux or macOS; on Windows use WSL")
    file = clock_file(folder)
    ours, theirs = socket.socketpair()
    try:
        clock = Clock(file)
        given = [str(theirs.fileno()), str(os.getpid()), str(file)]
        process = subprocess.Popen(
            [sys.executable, "-m", "furiko.engines.workers.worker", *given],
            pass_fds=[theirs.fileno(), file],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=folder,
            env=os.environ | ENVIRONMENT,
            start_new_session=True,  # Ctrl-C is the parent's to handle
        )
    except BaseException:
        ours.close()
        raise
    finally:
        theirs.close()
        os.close(file)
    ours.settimeout(SEND_TIMEOUT)
    channel = Channel(ours)
    with contextlib.suppress(OSError):  # if it has died, its closed connection will tell
        channel.send(Setup(tuple(os.path.abspath(path) for path in sys.path), tuple(modules), memory))
    return WorkerProcess(process, channel, clock)
