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
class RungCase:
    """Accelerations on one rung of a ladder: the names under which the result stands."""

    ladder: str
    engine: str
    rung: int
    seed: int

    @property
    def scene(self) -> str:
        """The ladder."""
        return self.ladder

    @property
    def check(self) -> str:
        """The rung."""
        return f"accelerations, rung {self.rung}"

    def result(self, outcome: str, **fields: object) -> Result:
        """A result under this case's names."""
        return Result(scene=self.scene, engine=self.engine, check=self.check, outcome=outcome, **fields)  # type: ignore[arg-type]


@dataclass(frozen=True)
class CaseJob:
    """Run one case."""

    case: Case

    def run(self, send: Send) -> None:
        send(self.case.run())
