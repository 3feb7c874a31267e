"""A worker's clock: the step that its job is at, in memory that it shares with whoever gave it the job.

An engine is asked many times in a millisecond, and each time begins a step. As a message each would wake the reader,
who needs to know of it only where a step takes too long or the worker dies.
"""

from __future__ import annotations

import mmap
import os
import struct
import sys
import tempfile
import time

from .messages import Step

ENTRY = struct.Struct("=d?B100s")  # when the step began, whether it asks an engine, its name's length, its name
NAME = 100  # bytes of a name
FIRST = 8  # after the count of steps
ROOM = 128  # bytes of one entry


class Clock:
    """Written by one process, read by another: the entry that is written is never the one that is read."""

    def __init__(self, file: int) -> None:
        """``file``: a descriptor of :func:`clock_file`."""
        self._memory = mmap.mmap(file, FIRST + 2 * ROOM)
        self._count = memoryview(self._memory)[:FIRST].cast("Q")

    def show(self, step: Step) -> None:
        """A step begins now."""
        count = self._count[0] + 1
        name = step.name.encode()[:NAME]
        ENTRY.pack_into(self._memory, FIRST + count % 2 * ROOM, time.monotonic(), step.engine, len(name), name)
        self._count[0] = count

    def last(self) -> tuple[float, Step] | None:
        """When the last step began (of time.monotonic, which is one for all processes), and the step; None before it.

        An engine may write into any memory of its process: what is no entry is none.
        """
        for _ in range(3):
            count = self._count[0]
            begun, engine, length, name = ENTRY.unpack_from(self._memory, FIRST + count % 2 * ROOM)
            if self._count[0] == count:  # it was not written to since
                return (begun, Step(name[:length].decode(errors="replace"), engine)) if count else None
        return None

    def close(self) -> None:
        """Give the memory back."""
        self._count.release()
        self._memory.close()


def clock_file(folder: str) -> int:
    """The descriptor of a new clock's memory, which goes with its last user; in ``folder`` where it must be a file.

    On Linux it is none: a disk that is full would end whoever writes to it.
    """
    if sys.platform == "linux":
        file = os.memfd_create("furiko-clock")
    else:
        file, path = tempfile.mkstemp(dir=folder)
        os.unlink(path)
    os.truncate(file, FIRST + 2 * ROOM)
    return file
