"""One engine's answers put together: to the user's own file, and to furiko's text of the same planar mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...engines.model_files.adapter import Reader
from ...engines.model_files.robot import ROBOT_READERS
from ...engines.quiet import silenced
from ...engines.workers.isolated import Call, NotReturned, call_isolated
from ..finding import Finding
from ..robots.answer import Question, RobotAnswer, ask_robot

if TYPE_CHECKING:
    from .engine_answers import EngineAnswer

# What is found in the equations of motion, or in their surroundings, whatever the engine holds of the file.
BESIDE_READING = ("damping-ignored", "friction-ignored", "stiffness-ignored", "colliding-geoms", "float32")
OPTIONAL = ("drake",)
TIMEOUT = 60.0  # [s] for one engine; ten links take less than one


@dataclass(frozen=True)
class EngineResult:
    """``own``: the answer to the file's own bytes, None where the engine reads none; ``planar``: the answer to
    furiko's text of it, None where the file is no planar tree of hinges. One of the two is there."""

    name: str
    own: RobotAnswer | None
    planar: EngineAnswer | None

    @property
    def status(self) -> str:
        """``agrees``, ``differs``, ``missing``, ``refused`` or ``failed``: of the user's own bytes where it reads them.

        An engine that agrees on these may still differ in what is looked at on furiko's text alone.
        """
        if self.own is None:
            return self.planar.status if self.planar is not None else "missing"
        if self.own.status == "agrees" and self.findings:
            return "differs"
        return self.own.status

    @property
    def says(self) -> str:
        """The engine's own message, or how many findings there are."""
        answer = self.own if self.own is not None else self.planar
        if answer is not None and answer.status in ("refused", "failed", "missing"):
            return answer.says
        count = len(self.findings)
        return f"{count} finding{'s' * (count != 1)}" if count else ""

    @property
    def findings(self) -> list[Finding]:
        """What explains the engine's numbers: its reading of the user's file before what is found on furiko's text."""
        planar = list(self.planar.findings) if self.planar is not None else []
        if self.own is None:
            return planar
        if not self.own.findings:
            return planar if self.planar is not None and self.planar.status == "differs" else []
        if self.own.status == "differs" and self.own.unexplained and planar:
            return planar
        if self.own.status == "refused":
            return [*planar, *self.own.findings]
        return [*self.own.findings, *(found for found in planar if found.cause in BESIDE_READING)]

    @property
    def compared(self) -> bool:
        """Whether its numbers were held against the theory."""
        answer = self.own if self.own is not None else self.planar
        return answer is not None and answer.status in ("agrees", "differs")

    @property
    def reads_itself(self) -> bool:
        """Whether the engine has a reader of the format."""
        return self.own is not None or (self.planar is not None and self.planar.native)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what was changed or set in the engine."""
        return tuple(note for answer in (self.own, self.planar) if answer is not None for note in answer.notes)

    @property
    def simulation(self) -> list[Finding]:
        """What a simulation of the file adds to its dynamics."""
        return self.own.simulation if self.own is not None else []

    @property
    def without(self) -> tuple[str, ...]:
        """What the engine leaves out by design."""
        return self.own.without if self.own is not None else ()

    def to_json(self) -> dict[str, Any]:
        """The engine's entry in the JSON of ``furiko diagnose``."""
        content = self.planar.to_json() if self.planar is not None else {}
        if self.own is not None:
            content |= self.own.to_json()
        return content | {"status": self.status, "says": self.says}


def ask_engines(
    question: Question, readers: Mapping[str, Reader | None], *, named: bool, isolated: bool
) -> list[EngineResult]:
    """The answer of each engine that can be asked, in their order; ``isolated``: each in a worker of its own.

    ``readers``: by the engine's name its reader of planar trees, None where it has none. An optional engine that is not
    installed is left out unless the engines were ``named``.
    """
    planar = question.file.planar is not None
    asked = {name: reader for name, reader in readers.items() if name in ROBOT_READERS or planar}
    calls = [Call(ask_both, (name, reader, question)) for name, reader in asked.items()]
    if isolated:
        answers = call_isolated(calls, TIMEOUT)
    else:
        with silenced():
            answers = [ask_both(*call.arguments) for call in calls]
    results = [
        _failed(name, answer.reason) if isinstance(answer, NotReturned) else answer
        for name, answer in zip(asked, answers, strict=True)
    ]
    return [result for result in results if named or result.name not in OPTIONAL or result.status != "missing"]


def ask_both(name: str, planar: Reader | None, question: Question) -> EngineResult:
    """One engine, asked about the user's own bytes where it reads the format, and about furiko's text of the file."""
    own, answer = ROBOT_READERS.get(name), None
    if planar is not None and question.file.planar is not None:
        from .engine_answers import ask  # and all hypotheses of the plane, which robots do not need

        answer = ask(planar, question.file)
    return EngineResult(
        name,
        ask_robot(own, question) if own is not None and question.file.language in own.languages else None,
        answer,
    )


def _failed(name: str, reason: str) -> EngineResult:
    findings = [Finding("unexplained", name, None, None, f"{name}: {reason}")]
    return EngineResult(name, RobotAnswer(name, "failed", reason, findings), None)
