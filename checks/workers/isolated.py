"""Calls made in worker processes side by side, so that what crashes or hangs one leaves the others alone."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Any

from .messages import Answer, CallJob, Failed
from .processes import Spawned, death, give, workshop


@dataclass(frozen=True)
class Lost:
    """A call that did not return, and why, in words."""

    reason: str


def call_apart(calls: Sequence[CallJob], timeout: float) -> list[Any]:
    """What each call returns, or :class:`Lost`: each in a worker of its own, for ``timeout`` seconds at most."""
    with workshop(ahead=len(calls)) as place:
        workers = [place.worker() for _ in calls]
        for (_, connection), call in zip(workers, calls, strict=True):
            give(connection, call)
        deadline = time.monotonic() + timeout
        return [_answer(worker, deadline, timeout) for worker in workers]


def _answer(worker: Spawned, deadline: float, timeout: float) -> Any:
    process, connection = worker
    if not wait([connection], max(0.0, deadline - time.monotonic())):
        return Lost(f"no answer within {timeout:g} s: it hangs")
    try:
        message = connection.recv()
    except (EOFError, ConnectionError):
        return Lost(death(process))
    if isinstance(message, Answer):
        return message.value
    return Lost(message.reason if isinstance(message, Failed) else f"an unexpected {type(message).__name__}")
