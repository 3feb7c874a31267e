"""What the runner and its workers say to each other."""

from __future__ import annotations

from dataclasses import dataclass

from ..models import Scene
from ..models.result import Result
from .plan import Task


@dataclass(frozen=True)
class FactsJob:
    """Compute a scene's truth."""

    scene: Scene
    random_states: int


@dataclass(frozen=True)
class CellJob:
    """Run a task's checks; ``facts`` as they came from the scene's :class:`FactsJob`."""

    task: Task
    facts: bytes


@dataclass(frozen=True)
class Begun:
    """A check has begun: if the worker dies now, this is the one that killed it."""

    check: str


@dataclass(frozen=True)
class Facts:
    """A scene's truth, as :meth:`SceneFacts.to_bytes` writes it."""

    content: bytes


@dataclass(frozen=True)
class Failed:
    """The job could not be done at all; ``missing`` where an engine is not installed."""

    reason: str
    trace: str


@dataclass(frozen=True)
class Done:
    """The job is over."""


Message = Begun | Result | Facts | Failed | Done
