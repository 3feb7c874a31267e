"""What the runner and its workers say to each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

from ...models import Scene
from ...records.check import Result
from ..plan import Task


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


class Case(Protocol):
    """A self-contained measurement: the names under which its one result stands, and how it is made."""

    @property
    def scene(self) -> str: ...
    @property
    def engine(self) -> str: ...
    @property
    def check(self) -> str: ...
    def run(self) -> Result:
        """Measure; an exception is a finding about the engine."""
        ...


@dataclass(frozen=True)
class CaseJob:
    """Run one case."""

    case: Case


@dataclass(frozen=True)
class CallJob:
    """Call a function of furiko's, in ``module``, and send back what it returns."""

    module: str
    function: str
    arguments: tuple[Any, ...]


@dataclass(frozen=True)
class Answer:
    """What a called function returned."""

    value: Any


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


Message = Answer | Begun | Result | Facts | Failed | Done
