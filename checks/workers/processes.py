"""Worker processes, and a few of them started ahead, while the command is still importing what it needs to plan."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from multiprocessing import Pipe
from multiprocessing.connection import Connection

MOST_AHEAD = 4  # more are started only once it is known how much there is to do

ENVIRONMENT = {
    # One worker a core: threads of a linear algebra library would only be in each other's way.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    # Nothing is drawn: MuJoCo need not look for a window system, which takes half of its import.
    "MUJOCO_GL": "disable",
}

Spawned = tuple[subprocess.Popen[bytes], Connection]


@dataclass(frozen=True)
class Workshop:
    """A temporary folder for workers to run in, and workers that wait there for their first job."""

    folder: str
    waiting: list[Spawned] = field(default_factory=list)
    taken: list[Spawned] = field(default_factory=list)

    def worker(self) -> Spawned:
        """One that waits, or a fresh one."""
        self.taken.append(self.waiting.pop() if self.waiting else spawn(self.folder))
        return self.taken[-1]


@contextlib.contextmanager
def workshop(ahead: int = 0) -> Iterator[Workshop]:
    """A workshop with so many workers started already; all its workers are ended with it."""
    with tempfile.TemporaryDirectory(prefix="furiko-") as folder:
        found = Workshop(folder, [spawn(folder) for _ in range(min(ahead, MOST_AHEAD))])
        try:
            yield found
        finally:
            for spawned in found.waiting + found.taken:
                end(*spawned)


def spawn(folder: str) -> Spawned:
    """A fresh worker process that runs in ``folder``, and our end of the connection to it."""
    ours, theirs = Pipe()
    process = subprocess.Popen(
        [sys.executable, "-m", "furiko.checks.workers.worker", str(theirs.fileno())],
        pass_fds=[theirs.fileno()],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        cwd=folder,
        env=os.environ | ENVIRONMENT,
        start_new_session=True,  # Ctrl-C is the parent's to handle
    )
    theirs.close()
    ours.send([os.path.abspath(path) for path in sys.path])
    return process, ours


def give(connection: Connection, job: object) -> None:
    """Send a worker its job; if it has died, its silence will tell."""
    with contextlib.suppress(ConnectionError):
        connection.send(job)


def end(process: subprocess.Popen[bytes], connection: Connection) -> None:
    """End a worker, whatever it is doing; one that has ended already stays so."""
    process.kill()
    process.wait()
    connection.close()


def death(process: subprocess.Popen[bytes]) -> str:
    """How a worker that went silent came to its end, in words."""
    status = process.wait()
    if status < 0:
        return f"the engine's process died of {signal.Signals(-status).name}"
    return f"the engine's process ended with status {status}"
