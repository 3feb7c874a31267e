"""An engine asked about furiko's text of a planar mechanism, in the planar tree's own coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...engines.model_files.adapter import FileEngine, Reader
from ...models import InvalidInput
from ...models.errors import installing
from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ...reference import planar_tree as planar
from ...reference.rounding.bounds import EPSILON
from ..explain_motion import explain_motion
from ..finding import Finding
from ..measurement import Array, measure
from .engine_causes import accuracy_for, engine_causes
from .engine_view import EngineView, theory_for, view_for_comparison, with_hinges_cleared
from .result import mechanism_to_json

MOST_FINDINGS = 40  # shown for one engine
SOMETIMES = {"contact", "limit", "frictionloss"}  # features that act in some states only
OF_NO_FILE = "silent-reset"  # what the engine does after steps that are far too long, whatever the file
LONGEST_MESSAGE = 300  # characters of an engine's own message


@dataclass
class EngineAnswer:
    """One engine's answer about a model file.

    ``status``: ``agrees``, ``differs``, ``missing``, ``refused`` or ``failed``; ``accelerations``: in the probe states,
    (S, n) [rad/s²]; ``residual``: the largest residual torque over its tolerance; ``native``: whether the engine reads
    the file itself. ``motion``: why its runs, with the integrator that the file asks for, do not follow accelerations
    that agree; properties of its time steps, which change no verdict on the file.
    """

    name: str
    status: str
    says: str = ""
    findings: list[Finding] = field(default_factory=list)
    compiled: Mechanism | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    accelerations: Array | None = None
    residual: float = 0.0
    native: bool = True
    motion: list[Finding] = field(default_factory=list)

    def to_json(self) -> dict[str, Any]:
        """The engine's entry in the JSON of ``furiko diagnose``."""
        content: dict[str, Any] = {"status": self.status, "says": self.says, "reads the file itself": self.native}
        if self.compiled is not None:
            content |= {"compiled": mechanism_to_json(self.compiled), "residual": self.residual, **self.settings}
            content["motion"] = [finding.to_json() for finding in self.motion]
        return content


def ask(reader: Reader, file: ModelFile, *, limits: bool = True) -> EngineAnswer:
    """One engine's answer about the file, with the causes where it differs from furiko's reading of it.

    ``limits``: whether the joints' ranges act; where they do not count, they are switched off if they can be.
    """
    with np.errstate(all="ignore"):
        try:
            engine = reader.load(file)
        except ImportError as error:
            return EngineAnswer(reader.name, "missing", f"{installing(reader.package)} [{error}]", native=reader.native)
        except (ValueError, RuntimeError, LookupError) as error:  # LookupError: Pinocchio, of a class that it has not
            return _refused(reader, _one_line(error)[:LONGEST_MESSAGE])
        view = view_for_comparison(engine, reader)
        if not limits and "limit" in reader.features:
            view = view.switched_off("limit")
        return _compared(reader, engine, view, file)


def _refused(reader: Reader, message: str) -> EngineAnswer:
    answer = EngineAnswer(reader.name, "refused", message, native=reader.native)
    if "inertia" in message and reader.native:
        answer.findings = [Finding("inertia-rejected", reader.name, None, None, f"{reader.name}: {message}")]
    return answer


def _compared(reader: Reader, engine: FileEngine, view: EngineView, file: ModelFile) -> EngineAnswer:
    """The engine's accelerations and inverse dynamics against what the file says."""
    answer = EngineAnswer(reader.name, "agrees", settings=engine.settings(), notes=engine.notes(), native=reader.native)
    theory = theory_for(file.mechanism, reader, view)
    try:
        answer.compiled = engine.compiled()
        measured = measure(view, theory, accuracy_for(theory))
    except (RuntimeError, ValueError, InvalidInput) as error:
        answer.status = "differs"
        answer.findings = [Finding("unexplained", reader.name, None, None, f"{reader.name}: {_one_line(error)}")]
        return answer
    answer.accelerations = measured.alpha[measured.forward]
    answer.residual = measured.worst(planar.parameters(theory))
    if answer.residual > 1:
        found = engine_causes(reader, view, file, theory, measured, answer.compiled)[:MOST_FINDINGS]
        answer.status = "differs"
        answer.findings = [_with_engine_name(finding, reader.name) for finding in found]
        answer.says = f"{len(found)} finding{'s' * (len(found) != 1)}"
    elif theory.tilt <= EPSILON:  # a step is held to rounding
        answer.motion = _motion_causes(reader, view, theory)
    return answer


def _motion_causes(reader: Reader, view: EngineView, theory: Mechanism) -> list[Finding]:
    """What the time steps do, without limits, contacts and dry friction, which act in some states only."""
    integrator = view.engine.integrator()
    if integrator is None:
        return []
    for feature in SOMETIMES & set(reader.features):
        view = view.switched_off(feature)
    try:
        found = explain_motion(view, with_hinges_cleared(theory, ("friction",)), integrator, who=reader.name)
        return [cause for cause in found if cause.cause != OF_NO_FILE]
    except (RuntimeError, ValueError) as error:
        return [
            Finding("unexplained", reader.name, None, None, f"{reader.name}: {integrator.name}: {_one_line(error)}")
        ]


def _with_engine_name(finding: Finding, name: str) -> Finding:
    return finding if name in finding.where else replace(finding, where=f"{name}: {finding.where}")


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
