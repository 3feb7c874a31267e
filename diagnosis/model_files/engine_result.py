"""One engine's answers put together: to the user's own file, and to furiko's text of the same planar mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from ...engines.model_files.adapter import Reader
from ...engines.model_files.robot import ROBOT_READERS
from ...engines.quiet import silenced
from ...engines.workers.isolated import Call, NotReturned, call_isolated
from ...models.projection import planar_mechanism
from ...models.readers.model_file import ModelFile
from ..finding import Finding
from ..robots.answer import Question, RobotAnswer, ask_robot
from ..robots.built import BUILT, ask_built, why_not_built

if TYPE_CHECKING:
    from .engine_answers import EngineAnswer

# What is found in the equations of motion, or in their surroundings, whatever the engine holds of the file.
BESIDE_READING = ("damping-ignored", "friction-ignored", "stiffness-ignored", "colliding-geoms", "float32")
TOUCHING = "colliding-geoms"
REFUSALS = ("inertia-rejected", "file-refused")
OPTIONAL = ("drake",)
TIMEOUT = 60.0  # [s] for one engine; ten links take less than one


@dataclass(frozen=True)
class EngineResult:
    """``own``: the answer to the file's own bytes, None where the engine reads none; ``planar``: the answer to
    furiko's text of it, None where the file is no planar tree of hinges. One of the two is there. ``contacts``: whether
    geoms that touch in a planar mechanism are a difference; else they are what a simulation adds, as in space."""

    name: str
    own: RobotAnswer | None
    planar: EngineAnswer | None
    contacts: bool = True

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
        planar = [found for found in self._of_planar if found not in self._touching]
        if self.own is None:
            return planar
        if not self.own.findings:
            return planar if self.planar is not None and self.planar.status == "differs" else []
        if self.own.status == "refused":
            return [*(found for found in planar if found.cause not in REFUSALS), *self.own.findings]
        named = [found for found in self.own.findings if found.cause != "unexplained"]
        beside = [found for found in planar if found.cause in BESIDE_READING or not named]
        if self.own.status == "differs" and self.own.unexplained and beside:
            return [*named, *beside]
        return [*self.own.findings, *(found for found in beside if found.cause in BESIDE_READING)]

    @property
    def compared(self) -> bool:
        """Whether its numbers were held against the theory."""
        answer = self.own if self.own is not None else self.planar
        return answer is not None and answer.status in ("agrees", "differs")

    @property
    def reads_itself(self) -> bool:
        """Whether the engine has a reader of the format."""
        if self.own is not None:
            return self.own.native
        return self.planar is not None and self.planar.native

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what was changed or set in the engine."""
        return tuple(note for answer in (self.own, self.planar) if answer is not None for note in answer.notes)

    @property
    def simulation(self) -> list[Finding]:
        """What a simulation of the file adds to its dynamics."""
        own = self.own.simulation if self.own is not None else []
        return own if any(found.cause == TOUCHING for found in own) else [*own, *self._touching]

    @property
    def _of_planar(self) -> list[Finding]:
        return list(self.planar.findings) if self.planar is not None else []

    @property
    def _touching(self) -> list[Finding]:
        if self.contacts or self.own is None:
            return []
        return [found for found in self._of_planar if found.cause == TOUCHING]

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
    built = named or not why_not_built(question.file.spatial)
    asked = {
        name: reader
        for name, reader in readers.items()
        if name in ROBOT_READERS or planar or (name == BUILT.name and built)
    }
    calls = {name: Call(ask_both, (name, reader, question)) for name, reader in asked.items()}
    there = [name for name, reader in asked.items() if isolated and _installed(name, reader)]
    answers = dict(zip(there, call_isolated([calls[name] for name in there], TIMEOUT), strict=True)) if there else {}
    with silenced():
        answers |= {name: ask_both(*call.arguments) for name, call in calls.items() if name not in answers}
    results = [
        _failed(name, answers[name].reason) if isinstance(answers[name], NotReturned) else answers[name]
        for name in asked
    ]
    return [result for result in results if named or result.name not in OPTIONAL or result.status != "missing"]


def _installed(name: str, planar: Reader | None) -> bool:
    """Whether the engine can be there: nothing of it is imported."""
    readers = (ROBOT_READERS.get(name), planar)
    modules = [reader.module.partition(".")[0] for reader in readers if reader is not None and reader.module]
    return not modules or any(find_spec(module) is not None for module in modules)


def ask_both(name: str, planar: Reader | None, question: Question) -> EngineResult:
    """One engine, asked about the user's own bytes where it reads the format, and about furiko's text of the file."""
    reader, own, answer = ROBOT_READERS.get(name), None, None
    if reader is not None and question.file.language in reader.languages:
        own = ask_robot(reader, question)
    if name == BUILT.name and question.file.planar is None:
        own = ask_built(question)
    if planar is not None and question.file.planar is not None:
        from .engine_answers import ask  # and all hypotheses of the plane, which robots do not need

        limits = question.limits or question.contacts  # what a file is compared with has none
        answer = ask(planar, _as_rounded(question.file, own), limits=limits)
    return EngineResult(name, own, answer, question.contacts)


def _as_rounded(file: ModelFile, own: RobotAnswer | None) -> ModelFile:
    """The file, whose planar mechanism is as the engine rounds it where that is known, so that rounding is no cause."""
    if own is None or own.rounded is None or file.planar is None:
        return file
    planar = planar_mechanism(own.rounded)
    old = file.planar  # whose gravity may be a scene's, for a URDF
    return replace(file, planar=replace(planar, gravity=old.gravity, gravity_vector=old.gravity_vector))


def _failed(name: str, reason: str) -> EngineResult:
    findings = [Finding("unexplained", name, None, None, f"{name}: {reason}")]
    return EngineResult(name, RobotAnswer(name, "failed", reason, findings), None)
