"""Jobs, and the messages that a worker sends of the one that it runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

Send = Callable[[object], None]


class Job(Protocol):
    """Work for a worker: an object that can be pickled, whose ``run`` sends its results as they come."""

    def run(self, send: Send) -> None:
        """Do the work. What is sent reaches whoever gave the job; an exception ends the job as :class:`Failed`."""
        ...


@dataclass(frozen=True)
class Setup:
    """A worker's first message: where to find modules, and which to import before the first job comes.

    ``memory``: bytes that it may allocate, and each engine's process that it starts; None for any number.
    """

    paths: tuple[str, ...]
    modules: tuple[str, ...]
    memory: int | None = None


@dataclass(frozen=True)
class Ready:
    """A worker has started and imported what it was told to: from now on the time is that of its job."""


@dataclass(frozen=True)
class Held:
    """A message that may wait for the next one, or for the next step: each that is sent wakes the reader."""

    message: object


@dataclass(frozen=True)
class Step:
    """The job begins a step, and its time limit starts anew. If the worker dies now, it died in this step.

    It is not sent: the worker's clock (:mod:`.clock`) shows it. ``engine``: an engine is being asked, so that the time
    is the engine's; otherwise the job is at work of its own.
    """

    name: str
    engine: bool = False


@dataclass(frozen=True)
class Failed:
    """The job ended in an exception: ``reason`` in one line, ``trace`` as Python prints it."""

    reason: str
    trace: str


@dataclass(frozen=True)
class Done:
    """The job is over; ``sent`` counts its messages, so that a lost one is noticed."""

    sent: int
