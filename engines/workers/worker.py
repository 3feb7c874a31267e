"""A worker: a process that takes jobs from a connection, runs them, and sends what they say.

Its standard streams lead nowhere, and it runs in a temporary folder: what an engine prints or writes disturbs nobody.
It dies with the process that started it, whatever happens to that one.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import sys
import traceback
from importlib import import_module
from typing import TYPE_CHECKING

from .channel import Channel
from .limits import LIMITS, limit_memory
from .messages import Done, Failed, Ready, Setup

if TYPE_CHECKING:
    from .messages import Job

PR_SET_PDEATHSIG = 1


def main() -> None:
    """Serve until the other end closes: ``python -m furiko.engines.workers.worker FILE_DESCRIPTOR PARENT``."""
    die_with_parent(int(sys.argv[2]))
    channel = Channel(socket.socket(fileno=int(sys.argv[1])))
    setup = channel.receive()
    assert isinstance(setup, Setup)
    LIMITS.seconds, LIMITS.memory = None, setup.memory  # whoever gives it jobs keeps the clock
    if setup.memory:
        limit_memory(setup.memory)
    sys.path += [path for path in setup.paths if path not in sys.path]
    for module in setup.modules:
        with contextlib.suppress(ImportError):  # the job that needs it will say so
            import_module(module)
    channel.send(Ready())
    while True:
        try:
            job = channel.receive()
        except (EOFError, ConnectionError):
            return
        serve(job, channel)  # type: ignore[arg-type]


def serve(job: Job, channel: Channel) -> None:
    """Run one job to its end."""
    sent = 0

    def send(message: object) -> None:
        nonlocal sent
        channel.send(message)
        sent += 1

    try:
        job.run(send)
    except Exception as error:
        send(Failed(one_line(error), traceback.format_exc()))
    channel.send(Done(sent))


def die_with_parent(parent: int) -> None:
    """Have the system kill this process when its parent ends, even where an engine never returns to Python."""
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it ended before the system was told
        os._exit(0)


def one_line(error: BaseException) -> str:
    """An exception in one line: its own words where the user can act on them, its type as well for the rest."""
    from ...models.errors import LibraryMissing

    words = " ".join(str(error).split())[:500]
    return words if isinstance(error, LibraryMissing) else f"{type(error).__name__}: {words}"


if __name__ == "__main__":
    main()
