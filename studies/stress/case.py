"""A case of the stress test, and the job that runs it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ...engines.workers.messages import Send
from ...records.check import Result


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

    def run(self, send: Send) -> None:
        send(self.case.run())
