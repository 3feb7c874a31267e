"""One engine asked about a robot's own file: what it holds, whether it computes that right, why it reads otherwise."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from ...engines.model_files.robot import BoundRobot, RobotEngine, RobotReader
from ...models import InvalidInput
from ...models.errors import installing
from ...models.readers.model_file import ModelFile, read_model
from ...models.readers.rules import Rules, mistakes_in, with_mistakes
from ...models.spatial import components
from ...models.spatial_mechanism import SpatialMechanism
from ..finding import Finding
from .fields import field_differences
from .free_armature import armature_finding, armature_in_body_axes
from .measures import MASS_MATRIX, Measured, measured, not_determined, worst
from .misreadings import explain_reading
from .numbering import lost_entry, lost_entry_finding
from .numbers import FieldDifference, plain
from .same_frame import frames_kept, moved_back, rounded
from .same_names import called_as
from .simulation import simulation_findings
from .wording import MOST_PLACES, Places, field_findings, instead, mistake_finding

NEARLY_IN_FRAME = (
    "{engine} has the inertials of {bodies}, which are within {reach:g} of the body's frame, in that frame"
)
NO_MECHANISM = "{engine} holds a body whose axes are not at right angles: no mechanism to hold its numbers against"
NO_ACCELERATIONS = "{engine}: accelerations are not determined, and not compared: {why}"
NOT_UTF8 = (
    "a name in it is not in UTF-8, the only encoding that the engine's names have. Instead, save the file in UTF-8"
)
TOO_MANY = "{count} freedoms, more than the {most} for which {engine} is asked: it would need gigabytes, and minutes"
ALL_MEASURED = 4  # quantities: mass matrix, bias, accelerations without and with torques
LONGEST_MESSAGE = 300  # characters of an engine's own message


@dataclass(frozen=True)
class Question:
    """``path``: the user's own file, bytes untouched; ``file``: furiko's reading of it; ``meshes``: folders besides its
    own in which meshes are looked for; ``limits``: whether joints' ranges count; ``contacts``: whether geoms that touch
    do, in an engine that otherwise does what the file says."""

    path: Path
    file: ModelFile
    meshes: tuple[Path, ...] = ()
    limits: bool = False
    contacts: bool = False

    def read(self, rules: Rules) -> SpatialMechanism:
        """The file, read with these mistakes."""
        return read_model(self.path, rules, self.meshes).spatial


# Mistakes after which there may be no mechanism left, or classes that are not there. Each is tried alone, and then
# beside the other one if an engine makes that too.
LOSING = (
    "include_not_followed",
    "attach_ignored",
    "frame_ignored",
    "bare_bodies_lost",
    "late_sections_ignored",
    "later_sections_ignored",
    "space_behind_number_rejected",
)
BESIDE_LOSING = "first_root_only"


@dataclass
class RobotAnswer:
    """One engine's answer.

    ``status``: ``agrees``, ``differs``, ``missing``, ``refused`` or ``failed``; ``measured``: the engine's mass matrix,
    bias and accelerations against the truth of what it holds; ``left``: how many numbers differ that no known mistake
    explains; ``rounded``: the file's mechanism as the engine rounds it, if it does; ``without``: what it leaves out by
    design; ``simulation``: what a simulation adds to the dynamics; ``native``: whether it reads the file itself;
    ``asked``: False where furiko does not hand it a file of this size, which says nothing of the file.
    """

    name: str
    status: str
    says: str = ""
    findings: list[Finding] = field(default_factory=list)
    holds: SpatialMechanism | None = None
    measured: tuple[Measured, ...] = ()
    left: int = 0
    rounded: SpatialMechanism | None = None
    without: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    simulation: list[Finding] = field(default_factory=list)
    native: bool = True
    asked: bool = True

    @property
    def unexplained(self) -> bool:
        """Whether no cause was found."""
        return any(finding.cause == "unexplained" for finding in self.findings)

    def to_json(self) -> dict[str, Any]:
        """The engine's entry in the JSON of ``furiko diagnose``."""
        content: dict[str, Any] = {"status": self.status, "says": self.says, "reads the file itself": self.native}
        if self.holds is not None:
            content["holds"] = mechanism_to_json(self.holds)
            content["measured"] = [one.to_json() for one in self.measured]
        return content


def ask_robot(reader: RobotReader, question: Question) -> RobotAnswer:
    """What one engine makes of the user's own file."""
    with np.errstate(all="ignore"):
        if too_many := _too_many_freedoms(reader, question):
            return RobotAnswer(reader.name, "refused", too_many, asked=False)
        try:
            engine = reader.load(question.path, question.file.language, question.meshes)
        except ImportError as error:
            return RobotAnswer(reader.name, "missing", f"{installing(reader.package)} [{error}]")
        except UnicodeDecodeError:
            return _refused(reader, NOT_UTF8, question)
        except (ValueError, RuntimeError, LookupError) as error:  # LookupError: Pinocchio, of a class that it has not
            return _refused(reader, " ".join(str(error).split())[:LONGEST_MESSAGE], question)
        return _compared(reader, engine, question)


def _too_many_freedoms(reader: RobotReader, question: Question) -> str:
    """Why the engine is not asked to read so large a file, nothing where it is: some read only a part of it."""
    language, most = question.file.language, reader.most_freedoms
    if not most or question.file.spatial.nv <= most:
        return ""
    lost = [flag for flag in (*LOSING, BESIDE_LOSING) if flag in reader.mistakes.get(language, ())]
    try:
        count = question.read(with_mistakes(language, lost)).nv
    except InvalidInput:
        return ""
    return TOO_MANY.format(engine=reader.name, count=count, most=most) if count > most else ""


def _refused(reader: RobotReader, message: str, question: Question) -> RobotAnswer:
    """What an engine's refusal comes from: a mistake with which the file cannot be read, or what its message says."""
    mistake = _unreadable_with(reader, message, question)
    if mistake is not None:
        return RobotAnswer(reader.name, "refused", message, [mistake])
    words = message.lower().removeprefix("error: ")
    of_file = "xml error" in words or words.startswith("mesh")  # whose message may advise another inertia
    inertia = not of_file and re.search(r"inertia\b|\bmass|eigenvalue", words) is not None
    says = f"{reader.name} refuses: {message}" + ("" if inertia else _about_files(words))
    finding = Finding("inertia-rejected" if inertia else "file-refused", reader.name, None, None, says)
    return RobotAnswer(reader.name, "refused", message, [finding])


def _about_files(message: str) -> str:
    """What helps where an engine does not get or read a mesh, as the end of a sentence."""
    without = "--fix OUT writes the mechanism without meshes"
    if "error opening file" in message:
        return f". Name the folder that has it with --meshes; {without}"
    return f". {without}" if "mesh" in message or "decoder" in message else ""


def _unreadable_with(reader: RobotReader, message: str, question: Question) -> Finding | None:
    """The engine's known mistake, or two, with which furiko's own reader, too, finds no mechanism in the file."""
    language = question.file.language
    known = reader.mistakes.get(language, ())
    losing = [lost for lost in LOSING if lost in known]
    alone = [(flag,) for flag in losing]
    beside = [(flag, BESIDE_LOSING) for flag in losing if BESIDE_LOSING in known]
    for flags in (*alone, *beside, *combinations(losing, 2)):
        left = _what_is_left(question, flags)
        if left:
            does = ", and ".join(mistakes_in(language)[one] for one in flags)
            says = f"{reader.name} refuses: {message.rstrip('.')}. It {does}; read so: {left}"
            return Finding(flags[0].replace("_", "-"), reader.name, None, None, says + instead(flags[0]))
    return None


def _what_is_left(question: Question, flags: Sequence[str]) -> str:
    """Why nothing can be made of the file, read with these mistakes; nothing if something can."""
    try:
        return "" if question.read(with_mistakes(question.file.language, flags)).joints else "no joint is left"
    except InvalidInput as error:
        return str(error)


def _compared(reader: RobotReader, engine: RobotEngine, question: Question) -> RobotAnswer:
    answer = RobotAnswer(reader.name, "agrees", without=left_to_caller(reader, question.file.spatial))
    try:
        answer.holds = engine.compiled(question.file.spatial)
        bound = engine.bind(answer.holds)
    except UnicodeDecodeError:
        return _refused(reader, NOT_UTF8, question)
    except (ValueError, RuntimeError, InvalidInput) as error:
        return failed(answer, error)
    named, left = _reading(reader, question, answer.holds)
    answer.left = len(left)
    answer.findings = [*named, *field_findings(reader.name, left, places_in(question.file.spatial))]
    if any(finding.cause == "axis-not-normalised" for finding in named):
        answer.status, answer.notes = "differs", (NO_MECHANISM.format(engine=reader.name),)
        return answer
    try:
        answer.measured = tuple(
            measured(bound, acting(answer.holds, reader.leaves_to_caller), factorised=reader.factorises)
        )
        answer.findings += computing_findings(reader, bound, answer, places_in(question.file.spatial))
        if answer.measured and len(answer.measured) < ALL_MEASURED:
            answer.notes = (NO_ACCELERATIONS.format(engine=reader.name, why=not_determined(answer.holds)),)
    except (ValueError, RuntimeError, InvalidInput, np.linalg.LinAlgError) as error:
        return failed(answer, error)
    kept = frames_kept(answer.holds, question.file.spatial, reader.same_frame)
    if kept:
        answer.rounded = rounded(answer.holds, question.file.spatial, reader.same_frame)
        answer.notes += (NEARLY_IN_FRAME.format(engine=reader.name, bodies=listed(kept), reach=reader.same_frame),)
    if reader.name == "mujoco" and question.file.language == "mjcf":
        answer.simulation = simulation_findings(engine, question.file.spatial)
    if answer.findings:
        answer.status = "differs"
    return answer


def failed(answer: RobotAnswer, error: Exception) -> RobotAnswer:
    """What the engine's error leaves: what it holds otherwise than the file, if that is known, explains it."""
    message = " ".join(str(error).split())[:LONGEST_MESSAGE]
    if answer.findings:
        answer.status, answer.notes = "differs", (*answer.notes, f"{answer.name}: {message}")
    else:
        answer.status, answer.says = "failed", message
        answer.findings = [Finding("unexplained", answer.name, None, None, f"{answer.name}: {message}")]
    return answer


def listed(bodies: Sequence[str]) -> str:
    """The first few of these names."""
    more = len(bodies) - MOST_PLACES
    return ", ".join(map(repr, bodies[:MOST_PLACES])) + (f" and {more} more" if more > 0 else "")


def acting(holds: SpatialMechanism, cleared: Sequence[str]) -> SpatialMechanism:
    """The mechanism without these numbers of its joints: what the engine's forward dynamics applies of it."""
    none: dict[str, Any] = dict.fromkeys(cleared, 0.0)
    bodies = [replace(b, joints=tuple(replace(joint, **none) for joint in b.joints)) for b in holds.bodies]
    return replace(holds, bodies=tuple(bodies))


def left_to_caller(reader: RobotReader, mechanism: SpatialMechanism) -> tuple[str, ...]:
    """A sentence on the passive forces that the file has and the engine's forward dynamics leaves to its caller."""
    left = [name for name in reader.leaves_to_caller if mechanism.per_freedom(name).any()]
    if not left:
        return ()
    them = "it" if len(left) == 1 else "them"
    return (f"{' and '.join(left)} in {reader.name}, whose forward dynamics leaves {them} to the caller",)


def _reading(
    reader: RobotReader, question: Question, holds: SpatialMechanism
) -> tuple[list[Finding], tuple[FieldDifference, ...]]:
    """The mistakes in reading that explain what the engine holds, and the differences that they leave."""
    file, language = question.file, question.file.language
    how: dict[str, Any] = {"limits": question.limits, "ignored": reader.not_held, "mesh_axes": reader.mesh_axes}

    def left(reading: SpatialMechanism) -> list[FieldDifference]:
        called = called_as(holds, reading)
        return field_differences(moved_back(called, reading, reader.same_frame), reading, **how)

    if not left(file.spatial):
        return [], ()
    explanation = explain_reading(question.read, language, left, reader.mistakes.get(language, ()))
    places, sentences = places_in(file.spatial), mistakes_in(language)
    named = [
        mistake_finding(reader.name, flag, sentences[flag], changes, places) for flag, changes in explanation.mistakes
    ]
    return named, explanation.left


def computing_findings(reader: RobotReader, bound: BoundRobot, answer: RobotAnswer, places: Places) -> list[Finding]:
    """Where the engine's numbers are not those of the mechanism that it holds."""
    beyond = worst(answer.measured)
    if beyond is None or answer.holds is None:
        return []
    holds = acting(answer.holds, reader.leaves_to_caller)
    found = []
    lost = lost_entry(bound, holds) if beyond.quantity == MASS_MATRIX else None
    if lost is not None:
        found.append(lost_entry_finding(reader.name, lost))
        beyond = worst([one for one in answer.measured if one.quantity != MASS_MATRIX])
        if beyond is None:
            return found
    known = armature_in_body_axes(bound, holds)
    if known is not None:
        line = places.lines.get(f"joint {known.joint.name!r}", "")
        return [*found, armature_finding(reader.name, known, line)]
    says = (
        f"{reader.name}: {beyond.quantity} at {beyond.where} is {beyond.found:.9g}, the mechanism that it holds has "
        f"{beyond.expected:.9g}; rounding explains {beyond.allowed:.2g}"
    )
    return [*found, Finding("unexplained", f"{reader.name}: {beyond.where}", beyond.found, beyond.expected, says)]


def places_in(mechanism: SpatialMechanism) -> Places:
    """Element and line of every body and joint of the file."""
    lines: dict[str, str] = {}
    for body in mechanism.bodies:
        lines[f"link {body.name!r}"] = body.where
        for joint in body.joints:
            lines[f"joint {joint.name!r}"] = joint.where
    return Places(lines)


def mechanism_to_json(mechanism: SpatialMechanism) -> dict[str, Any]:
    """A mechanism for a report, SI units: bodies with parent, pose, joints and inertial in the body's own frame."""
    bodies = []
    for body in mechanism.bodies:
        entry: dict[str, Any] = {
            "name": body.name,
            "parent": mechanism.bodies[body.parent].name if body.parent >= 0 else None,
            "position": plain(body.position),
            "quaternion": plain(body.quaternion),
            "mass": float(body.inertial.mass),
            "centre of mass": plain(body.inertial.centre),
            "inertia": components(body.inertial.tensor),
            "joints": [_joint(joint) for joint in body.joints],
        }
        bodies.append(entry)
    return {"gravity": plain(mechanism.gravity), "bodies": bodies}


def _joint(joint: Any) -> Mapping[str, Any]:
    numbers = {
        n: float(getattr(joint, n)) for n in ("ref", "armature", "damping", "friction", "stiffness", "springref")
    }
    entry: dict[str, Any] = {"name": joint.name, "kind": joint.kind}
    if joint.kind in ("hinge", "slide"):
        entry["axis"] = plain(joint.axis)
    if joint.kind in ("hinge", "ball"):
        entry["anchor"] = plain(joint.anchor)
    entry |= {name: value for name, value in numbers.items() if value}
    if joint.limits is not None:
        entry["limits"] = plain(joint.limits)
    return entry
