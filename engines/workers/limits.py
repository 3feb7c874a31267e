"""Limits of the processes in which engines run."""

from __future__ import annotations

import sys
from dataclasses import dataclass


@dataclass
class Limits:
    """``seconds`` for one answer of an engine in a place of its own, None where a pool keeps the clock; ``memory``:
    bytes that each process may allocate, None for any number."""

    seconds: float | None = 60.0
    memory: int | None = None


LIMITS = Limits()  # of this process; a worker's are set when it starts


def limit_memory(memory: int) -> None:
    """Let this process allocate no more bytes than this: what would is a MemoryError, or ends in a crash."""
    if sys.platform == "win32":
        return
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_DATA)
    wanted = memory if most == resource.RLIM_INFINITY else min(memory, most)
    resource.setrlimit(resource.RLIMIT_DATA, (wanted, most))
