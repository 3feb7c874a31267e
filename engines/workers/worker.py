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
from .clock import Clock
from .limits import LIMITS, limit_memory
from .messages import Done, Failed, Held, Ready, Setup, Step

if TYPE_CHECKING:
    from .messages import Job

PR_SET_PDEATHSIG = 1


def main() -> None:
    """Serve until the other end closes: ``python -m furiko.engines.workers.worker CONNECTION PARENT CLOCK``.

    The first and the last are file descriptors.
    """
    die_with_parent(int(sys.argv[2]))
    channel, clock = Channel(socket.socket(fileno=int(sys.argv[1]))), Clock(int(sys.argv[3]))
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
        serve(job, channel, clock)  # type: ignore[arg-type]


def serve(job: Job, channel: Channel, clock: Clock) -> None:
    """Run one job to its end. What is held is sent before an engine is asked, which may take this process along."""
    sent, at = 0, ""

    def send(message: object) -> None:
        nonlocal sent, at
        if isinstance(message, Step):
            if message.engine or message.name != at:
                channel.flush()
            at = message.name
            clock.show(message)
            return
        sent += 1
        if isinstance(message, Held):
            channel.hold(message.message)
        else:
            channel.send(message)

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
