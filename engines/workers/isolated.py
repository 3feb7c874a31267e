"""Calls made in worker processes side by side, so that one that crashes or hangs leaves the others alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from .messages import Failed, Send
from .pool import Finished, Lost, Pool, Said
from .processes import worker_processes


@dataclass(frozen=True)
class Call:
    """A function, importable by its name, and its arguments."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()

    def run(self, send: Send) -> None:
        send(Returned(self.function(*self.arguments)))


@dataclass(frozen=True)
class Returned:
    """The value of a call."""

    value: Any


@dataclass(frozen=True)
class NotReturned:
    """A call that did not return, and why, in words."""

    reason: str


def call_isolated(calls: Sequence[Call], timeout: float) -> list[Any]:
    """The value of each call, or :class:`NotReturned`: each in a worker of its own, for ``timeout`` seconds at most."""
    values: dict[int, Any] = {}
    with worker_processes(ahead=len(calls)) as source:
        pool = Pool(source, len(calls))
        for worker, call in zip(pool.workers, calls, strict=True):
            pool.give(worker, call, timeout)
        while pool.busy:
            for event in pool.events():
                if isinstance(event, Said):
                    values[id(event.job)] = _value(event.message)
                elif isinstance(event, Lost):
                    hangs = ": it hangs" if event.overdue else ""
                    values[id(event.job)] = NotReturned(event.reason + hangs)
                elif isinstance(event, Finished):
                    values.setdefault(id(event.job), NotReturned("it returned nothing"))
    return [values[id(call)] for call in calls]


def _value(message: object) -> Any:
    if isinstance(message, Returned):
        return message.value
    return NotReturned(message.reason if isinstance(message, Failed) else f"an unexpected {type(message).__name__}")
