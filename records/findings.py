"""The documents that ``furiko grade``, ``audit`` and ``diagnose`` print with ``--json``.

They describe what those commands make; a test validates real output against them.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec

from .errors import Error

# --- grade


class WrongTerm(msgspec.Struct, frozen=True, kw_only=True):
    """One wrong term of a derivation, in the scaling of the row as it was handed in, all on its left side."""

    equation: str  # the documents' number
    term: str
    found: str
    expected: str
    cause: str
    says: str
    says_ja: str
    row: str  # its label in the file


class NamedMistake(msgspec.Struct, frozen=True, kw_only=True):
    """A mistake in a derivation that explains what was found."""

    cause: str
    name: str
    stage: str
    says: str
    says_ja: str
    also: list[str]  # further mistakes that lead to the same equations


class StageMark(msgspec.Struct, frozen=True, kw_only=True):
    """One stage of a derivation that is stated stage by stage."""

    stage: str
    outcome: Literal["right", "follows", "wrong"]  # follows: from earlier stages that are wrong; not wrong again
    says: str
    says_ja: str
    findings: list[WrongTerm]
    of: int  # how many terms the right stage has


class GradeReading(msgspec.Struct, frozen=True, kw_only=True):
    """What was read of a derivation, so that its author sees whether he was understood."""

    mechanism: str
    mechanism_ja: str
    drawing: str  # of characters; empty for many links
    angles: str
    angles_ja: str
    symbols: list[tuple[str, str]]  # what is written, what it is read as
    equations: list[tuple[str, str]]  # label, and the equation in the author's letters


class GradeDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The document of ``furiko grade --json``."""

    verdict: Literal["correct", "wrong", "undecided"]
    findings: list[WrongTerm]
    mistakes: list[NamedMistake]
    alternatives: list[list[str]]  # other sets of mistakes that explain it as well
    notes: list[str]
    notes_ja: list[str]
    system: str
    links: int
    assumes: list[str]  # what "correct" rests on and the file does not say; empty: on nothing
    assumes_ja: list[str]
    reading: GradeReading
    right_for: str  # another mechanism that wrong equations are right for; empty: none known
    right_for_ja: str
    stages: list[StageMark]  # empty unless the derivation is stated stage by stage


# --- audit


class JudgedEquation(msgspec.Struct, frozen=True, kw_only=True):
    """One numbered equation of a document, held against first principles as it is printed."""

    document: Literal["shiki", "takeno"]
    number: str
    judgement: Literal["holds", "holds-if", "misprint"]
    says: str
    formula: str
    evidence: dict[str, Any]  # how it was judged: in symbols, in ball arithmetic
    condition: str  # under which it holds; empty: none
    printed: str  # where it is not the formula
    correction: str  # of a misprint
    costs: list[dict[str, Any]]  # what a misprint does to accelerations and motions


class SlipEntry(msgspec.Struct, frozen=True, kw_only=True):
    """A slip outside the numbered equations."""

    found: str  # how
    document: Literal["shiki", "takeno"]
    where: str
    printed: str
    right: str
    says: str


class OpenQuestion(msgspec.Struct, frozen=True, kw_only=True):
    """A question that the documents leave open, its answer, and measured numbers."""

    question: str
    answer: str
    argument: str
    numbers: dict[str, Any]


class AuditDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The document of ``furiko audit --json``."""

    equations: list[JudgedEquation]
    slips: list[SlipEntry]
    open_questions: list[OpenQuestion]
    unnumbered: list[JudgedEquation]  # Takeno's displays without a number


class JudgedEntry(msgspec.Struct, frozen=True, kw_only=True):
    """One entry of a user's list of equations, graded as a derivation."""

    number: str
    says: str  # what it is, as the file has it
    judgement: Literal["holds", "holds-if", "wrong"]
    told: list[str]  # why; empty where it holds
    told_ja: list[str]
    grade: GradeDocument


class FileAuditDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The document of ``furiko audit FILE --json``."""

    title: str
    entries: list[JudgedEntry]


# --- diagnose


class Difference(msgspec.Struct, frozen=True, kw_only=True):
    """One difference between an engine, a model file and what it should be."""

    cause: str  # a stable code
    where: str  # joint, link or engine
    measured: float | str | None
    expected: float | str | None
    says: str


class LinkEntry(msgspec.Struct, frozen=True, kw_only=True):
    """One link of a planar mechanism, in the frame of its plane; SI units. Joint fields that are zero are left out."""

    name: str
    joint: str
    on: str | None  # the parent; None: the world
    hinge: list[float]
    com: list[float] = msgspec.field(name="centre of mass")
    mass: float
    inertia: float
    armature: float | None = None
    damping: float | None = None
    friction: float | None = None
    stiffness: float | None = None
    rest: float | None = None
    stops: list[float | None] | None = None


class MechanismEntry(msgspec.Struct, frozen=True, kw_only=True):
    """A planar mechanism."""

    gravity: list[float]
    links: list[LinkEntry]


class SpatialJoint(msgspec.Struct, frozen=True, kw_only=True):
    """A joint of a body, in the body's own frame; numbers that are zero are left out."""

    name: str
    kind: str  # hinge, slide, ball or free
    axis: list[float] | None = None
    anchor: list[float] | None = None
    ref: float | None = None  # its coordinate in the reference configuration
    armature: float | None = None
    damping: float | None = None
    friction: float | None = None
    stiffness: float | None = None
    springref: float | None = None
    limits: list[float] | None = None


class SpatialBody(msgspec.Struct, frozen=True, kw_only=True):
    """A body in its parent's frame, in the reference configuration; its inertial in its own frame; SI units."""

    name: str
    parent: str | None  # None: the world
    position: list[float]
    quaternion: list[float]  # w, x, y, z
    mass: float
    com: list[float] = msgspec.field(name="centre of mass")
    inertia: list[float]  # about the centre of mass: xx, yy, zz, xy, xz, yz
    joints: list[SpatialJoint]  # in the order in which they move it; none: fixed to its parent


class SpatialEntry(msgspec.Struct, frozen=True, kw_only=True):
    """An open mechanism in space."""

    gravity: list[float]
    bodies: list[SpatialBody]


class MeasuredTerm(msgspec.Struct, frozen=True, kw_only=True):
    """The worst entry of one of an engine's quantities against the truth of what the engine holds."""

    quantity: str
    ratio: float  # of the difference to what rounding explains
    where: str
    found: float
    expected: float
    allowed: float


class EngineReading(msgspec.Struct, frozen=True, kw_only=True):
    """One engine on a model file. Further fields are settings of the engine, by their own names."""

    status: str  # agrees, differs, refused, failed or missing
    says: str
    holds: SpatialEntry | None = None  # what the engine made of the user's own bytes
    measured: list[MeasuredTerm] | None = None
    native: bool = msgspec.field(name="reads the file itself")
    compiled: MechanismEntry | None = None  # the mechanism that the engine made of the file
    residual: float | None = None  # what that mechanism does not explain
    motion: list[Difference] | None = None  # causes in the time steps of the integrator that the file asks for


class WrittenFile(msgspec.Struct, frozen=True, kw_only=True):
    """A file that ``--fix`` wrote: whether all engines that were asked read it alike, and sentences why not."""

    path: str
    agrees: bool
    why: list[str]


class DiagnoseDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The document of ``furiko diagnose --json``."""

    verdict: Literal["agrees", "differs", "unexplained", "incomplete"]
    headline: str  # the answer in one sentence
    without: list[str]  # what acts in the file and is left out of the comparison
    findings: list[Difference]
    simulation: list[Difference]  # what a simulation of the file adds to its dynamics; changes no verdict
    engines: dict[str, EngineReading]
    model: str
    against: str | None
    mechanism: MechanismEntry | None  # None: not a planar tree of hinges
    spatial: SpatialEntry
    notes: list[str]
    fix: WrittenFile | None = None  # what --fix wrote


class DiagnosedModel(msgspec.Struct, frozen=True, kw_only=True):
    """One file of several: what was found, or why there is no answer."""

    model: str
    status: int  # the exit status of ``furiko diagnose`` with this file alone
    diagnosis: DiagnoseDocument | None
    error: Error | None


class DiagnosedModels(msgspec.Struct, frozen=True, kw_only=True):
    """The document of ``furiko diagnose --json`` with several files, in the order in which they were given."""

    models: list[DiagnosedModel]
