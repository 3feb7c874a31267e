"""``furiko diagnose``: a user's own model file against the theory, in every engine that reads it.

Three questions, each with its own findings. *Does each engine do what the file says?* The planar tree that furiko reads
in the file is the theory; damping, armature, springs and the like count as said. *Who stands alone?* Where all engines
differ from it alike, the reading is to blame, not they. *Is the file what is wanted?* Without a scene that is the ideal
mechanism of the file's own links, hinges turning freely; with one, that scene's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..checks.workers.isolated import Lost, call_apart
from ..checks.workers.messages import CallJob
from ..engines.model_files.adapter import READERS, FileEngine, Reader
from ..engines.quiet import silenced
from ..models import InvalidInput, PlanarTree
from ..models.mechanism import Hinge, Mechanism, mechanism_of
from ..models.readers.model_file import ModelFile, read_model
from ..reference import planar_tree as planar
from ..reference.rounding.bounds import EPSILON
from .differences import differences
from .explain import explain, mechanism_from
from .finding import CAUSES, Finding, joint
from .matching import mirrored, natural_turns, orders, rearranged, same_motion, without_hinge
from .measurement import Array, Measurement, measure, probe_states
from .reader_faults import degrees_in_file, suspects

PASSIVE = {"damping": "damping-ignored", "friction": "friction-ignored", "stiffness": "stiffness-ignored"}
TOLD = 1e-13  # a tilt above this is told
TIMEOUT = 60.0  # [s] for one engine; ten links take less than one
ALTOGETHER = 40  # findings shown for one engine, at most


@dataclass(frozen=True)
class Diagnosis:
    """``verdict``: ``agrees``, ``differs`` or ``unexplained``; ``engines``: what each compiled, or why it did not;
    ``notes``: what was taken for granted."""

    model: str
    verdict: str
    findings: tuple[Finding, ...]
    engines: Mapping[str, Mapping[str, Any]]
    notes: tuple[str, ...] = ()
    against: str = ""
    mechanism: Mapping[str, Any] = field(default_factory=dict)

    @property
    def exit_status(self) -> int:
        """0 agrees, 1 differs, 3 where no engine could be asked."""
        if self.findings:
            return 1
        return 0 if any(e["status"] == "agrees" for e in self.engines.values()) else 3

    def to_json(self) -> dict[str, Any]:
        """The document that ``furiko diagnose --json`` prints."""
        return {
            "verdict": self.verdict,
            "findings": [finding.to_json() for finding in self.findings],
            "engines": {name: dict(engine) for name, engine in self.engines.items()},
            "model": self.model,
            "against": self.against or None,
            "mechanism": dict(self.mechanism),
            "notes": list(self.notes),
        }

    def text(self) -> str:
        """For a person."""
        lines = [f"{self.model}: {self.verdict}" + (f" (against {self.against})" if self.against else "")]
        links = self.mechanism.get("links", [])
        lines.append(f"  a planar tree of {len(links)} hinged link{'s' * (len(links) != 1)}")
        for name, engine in self.engines.items():
            says = engine.get("says", "")
            lines.append(f"  {name:16} {engine['status']}" + (f": {says}" if says else ""))
        for finding in self.findings:
            lines.append(f"  {finding.cause} at {finding.where}")
            lines.append(f"      {finding.says}")
            lines.append(f"      {finding.cause}: {CAUSES[finding.cause]}")
        lines += [f"  note: {note}" for note in self.notes]
        return "\n".join(lines)


def diagnose(
    model: str | Path | ModelFile,
    against: Any = None,
    engines: Mapping[str, Reader] = READERS,
    *,
    apart: bool = False,
) -> Diagnosis:
    """Diagnose an MJCF or URDF file.

    ``against``: None for what the file's own links would do on ideal hinges; the name of a scene or the path of its
    TOML file; the path of another model file; or a system, planar tree or mechanism. ``apart``: ask furiko's own
    engines each in a process of its own, so that a file that brings one down leaves the others standing. Raises
    :class:`InvalidInput` for a file that is no planar tree of hinges, and for bad ``against``.
    """
    file = model if isinstance(model, ModelFile) else read_model(model)
    wanted, name = _wanted(against)
    file = _with_gravity(file, wanted)
    if apart:
        asked = _ask_apart(file)
    else:
        with silenced(), np.errstate(all="ignore"):
            asked = [_ask(reader, file) for reader in engines.values()]
    findings = _vote(file, asked)
    of_file = list(degrees_in_file(file))
    of_file += _unideal(file.mechanism) if wanted is None else _against(file, wanted)
    findings = [*of_file, *findings]
    unexplained = any(f.cause == "unexplained" for f in findings)
    verdict = "unexplained" if unexplained else "differs" if findings else "agrees"
    return Diagnosis(
        model=file.path,
        verdict=verdict,
        findings=tuple(findings),
        engines={a.name: a.to_json() for a in asked},
        notes=tuple(dict.fromkeys([*file.notes, *_tilted(file.mechanism), *(note for a in asked for note in a.notes)])),
        against=name,
        mechanism=described(file.mechanism),
    )


def _tilted(mechanism: Mechanism) -> list[str]:
    if mechanism.tilt < TOLD:
        return []
    return [f"the hinges' axes are not quite parallel: engines are held to {mechanism.tilt:.1g} of each torque"]


def _wanted(against: Any) -> tuple[Mechanism | None, str]:
    if against is None:
        return None, ""
    if isinstance(against, str | Path):
        if str(against).endswith((".xml", ".urdf", ".mjcf")):
            return read_model(against).mechanism, str(against)
        from ..models import find_scene

        scene = find_scene(str(against))
        return mechanism_of(scene.system.tree()), scene.name
    if isinstance(against, ModelFile):
        return against.mechanism, against.path
    if isinstance(against, Mechanism | PlanarTree) or hasattr(against, "tree"):
        return mechanism_from(against), getattr(against, "kind", type(against).__name__)
    raise InvalidInput(f"against: a scene, a model file or a mechanism is needed, got {type(against).__name__}")


def _with_gravity(file: ModelFile, wanted: Mechanism | None) -> ModelFile:
    """URDF says nothing of gravity: that of what it is held against is taken."""
    if file.language != "urdf" or wanted is None:
        return file
    strength = float(np.hypot(*wanted.gravity))
    ratio = strength / float(np.hypot(*file.mechanism.gravity)) if any(file.mechanism.gravity) else 0.0
    old = file.mechanism
    vector = tuple(ratio * x if ratio else 0.0 for x in old.gravity_vector)
    along = old.gravity[0] * ratio
    if abs(along - strength) <= 1e-12 * strength:
        along = strength
    if vector[0] == 0 and vector[1] == 0:
        vector = (0.0, 0.0, -strength)
    changed = replace(old, gravity=(along, 0.0), gravity_vector=vector)
    notes = tuple(note for note in file.notes if "gravity" not in note)
    said = f"URDF says nothing of gravity: {strength:g} m/s² is taken, as in what it is held against"
    return replace(file, mechanism=changed, notes=(*notes, said))


@dataclass
class _Asked:
    """One engine's answers."""

    name: str
    status: str
    says: str = ""
    findings: list[Finding] = field(default_factory=list)
    compiled: Mechanism | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    accelerations: Array | None = None
    left: float = 0.0
    native: bool = True

    def to_json(self) -> dict[str, Any]:
        content: dict[str, Any] = {"status": self.status, "says": self.says, "reads the file itself": self.native}
        if self.compiled is not None:
            content |= {"compiled": described(self.compiled), "residual": self.left, **self.settings}
        return content


def _ask_apart(file: ModelFile) -> list[_Asked]:
    """All engines' answers, each from a process of its own: a file that brings one down leaves the others standing."""
    calls = [CallJob("furiko.diagnosis.diagnose", "ask", (name, file)) for name in READERS]
    answers = zip(READERS.values(), call_apart(calls, TIMEOUT), strict=True)
    return [_brought_down(reader, answer) if isinstance(answer, Lost) else answer for reader, answer in answers]


def _brought_down(reader: Reader, lost: Lost) -> _Asked:
    says = f"{reader.name}: {lost.reason}"
    findings = [Finding("unexplained", reader.name, None, None, says)]
    return _Asked(reader.name, "failed", lost.reason, findings=findings, native=reader.native)


def ask(name: str, file: ModelFile) -> _Asked:
    """What one of the engines makes of the file: runs in a worker."""
    with np.errstate(all="ignore"):
        return _ask(READERS[name], file)


def _ask(reader: Reader, file: ModelFile) -> _Asked:
    """What one engine makes of the file, and why that is not the same as furiko's reading."""
    mechanism = file.mechanism
    try:
        engine = reader.load(file)
    except ImportError as error:
        return _Asked(reader.name, "missing", f"pip install {reader.package} [{error}]", native=reader.native)
    except (ValueError, RuntimeError) as error:
        words = " ".join(str(error).split())[:300]
        asked = _Asked(reader.name, "refused", words, native=reader.native)
        if "inertia" in words and reader.native:
            asked.findings = [Finding("inertia-rejected", reader.name, None, None, f"{reader.name}: {words}")]
        return asked
    asked = _Asked(reader.name, "agrees", settings=engine.settings(), notes=engine.notes(), native=reader.native)
    said = _said(mechanism, reader)
    viewed = _View(engine, frozenset({"frictionloss"}) if "frictionloss" in reader.features else frozenset())
    theory = _without_friction(said) if viewed.without else said
    try:
        asked.compiled = engine.compiled()
        measured = measure(viewed, theory, max(EPSILON, theory.tilt))
    except (RuntimeError, ValueError, InvalidInput) as error:
        words = " ".join(str(error).split())
        asked.status = "differs"
        asked.findings = [Finding("unexplained", reader.name, None, None, f"{reader.name}: {words}")]
        return asked
    asked.accelerations = measured.alpha[measured.forward]
    asked.left = measured.worst(planar.parameters(theory))
    if asked.left > 1:
        asked.status = "differs"
        found = _why(reader, engine, viewed, file, theory, measured, asked.compiled)[:ALTOGETHER]
        asked.findings = [f if reader.name in f.where else replace(f, where=f"{reader.name}: {f.where}") for f in found]
        asked.says = f"{len(asked.findings)} finding{'s' * (len(asked.findings) != 1)}"
    return asked


def _said(mechanism: Mechanism, reader: Reader) -> Mechanism:
    """What the file says, less what the engine was never given."""
    if not reader.without:
        return mechanism
    nothing = dict.fromkeys(reader.without, 0.0)
    return replace(mechanism, hinges=tuple(replace(hinge, **nothing) for hinge in mechanism.hinges))  # type: ignore[arg-type]


def _without_friction(mechanism: Mechanism) -> Mechanism:
    """MuJoCo's dry friction is a soft constraint, not a constant torque: the rest is compared without it."""
    return replace(mechanism, hinges=tuple(replace(hinge, friction=0.0) for hinge in mechanism.hinges))


@dataclass(frozen=True)
class _View:
    """An engine with some of its features switched off."""

    engine: FileEngine
    without: frozenset[str]

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return self.engine.accelerations(theta, omega, self.without)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array) -> Array:
        return self.engine.inverse_dynamics(theta, omega, alpha, without=self.without)

    def compiled(self) -> Mechanism:
        return self.engine.compiled()


def _why(
    reader: Reader,
    engine: FileEngine,
    viewed: _View,
    file: ModelFile,
    theory: Mechanism,
    measured: Measurement,
    compiled: Mechanism | None,
) -> list[Finding]:
    """Why an engine does not do what the file says."""
    switched = list(_by_switching_off(reader, engine, viewed, theory))
    if switched:
        return switched
    if compiled is not None and compiled.n == theory.n and compiled.parents == theory.parents:
        held = _without_friction(compiled) if viewed.without else compiled
        found = _compiled(held, file, theory, measured, reader.name)
        if found:
            return found
    return explain(viewed, theory, who=reader.name, accuracy=max(EPSILON, theory.tilt), slight=False)


def _by_switching_off(reader: Reader, engine: FileEngine, viewed: _View, theory: Mechanism) -> Iterator[Finding]:
    """The feature without which the engine agrees is the cause."""
    for feature, cause in (("contact", "colliding-geoms"), ("limit", "joint-limit")):
        if feature not in reader.features:
            continue
        without = _View(engine, viewed.without | {feature})
        if measure(without, theory, max(EPSILON, theory.tilt)).worst(planar.parameters(theory)) > 1:
            continue
        theta, _ = probe_states(theory)
        touching = engine.contacts(theta) if feature == "contact" and hasattr(engine, "contacts") else []
        pairs = sorted({pair for _, pair in touching})
        words = f"{', '.join(pairs[:3])} touch in {len(touching)} of {len(theta)} states" if pairs else feature
        says = f"{reader.name}: without its {feature}s it agrees with the file: {words}"
        yield Finding(cause, reader.name, len(touching) if pairs else None, 0 if pairs else None, says)
        return


def _compiled(held: Mechanism, file: ModelFile, theory: Mechanism, measured: Measurement, who: str) -> list[Finding]:
    """What the engine compiled, with or without what it holds of damping, friction and springs, explains its motion."""
    for ignored in ((), ("damping",), ("friction",), ("damping", "friction"), ("stiffness",), tuple(PASSIVE)):
        nothing = dict.fromkeys(ignored, 0.0)
        acting = replace(held, hinges=tuple(replace(hinge, **nothing) for hinge in held.hinges))  # type: ignore[arg-type]
        if measured.worst(planar.parameters(acting)) <= 1:
            stops = tuple(replace(h, limits=w.limits) for h, w in zip(acting.hinges, theory.hinges, strict=True))
            named = differences(replace(acting, hinges=stops), theory, who, "the file says", suspects(file))
            return _weighed(file, named, who) + named
    return []


def _vote(file: ModelFile, asked: list[_Asked]) -> list[Finding]:
    """The engines' findings, or furiko's own where they all differ from it alike."""
    ran = [a for a in asked if a.accelerations is not None and a.native]
    differing = [a for a in ran if a.left > 1]
    if len(ran) >= 2 and len(differing) == len(ran) and not any(a.left <= 1 for a in ran):
        first = differing[0].accelerations
        assert first is not None
        size = np.abs(first).max(axis=1, keepdims=True)
        alike = all(
            a.accelerations is not None and (np.abs(a.accelerations - first) <= 1e-7 * size).all() for a in differing
        )
        if alike:
            names = ", ".join(a.name for a in ran)
            says = f"{names} agree with one another; what furiko reads in the file stands alone"
            return [Finding("theory-is-wrong", file.path, None, None, says), *differing[0].findings]
    return [finding for a in asked for finding in a.findings]


def _unideal(mechanism: Mechanism) -> list[Finding]:
    """What the file says that an ideal hinge has not."""
    ideal = mechanism.ideal()
    return differences(mechanism, ideal, "the file", "an ideal hinge has")


def _against(file: ModelFile, wanted: Mechanism) -> list[Finding]:
    """What the file says otherwise than what is wanted, when links and frames are seen in the way that suits best."""
    found = file.mechanism
    if found.n != wanted.n:
        return _other_number(found, wanted)
    own = suspects(file, own=True)
    ways: list[tuple[tuple[int, ...], list[Finding]]] = []
    for side, seen in enumerate((found, mirrored(found))):
        for order in orders(seen, wanted):
            ordered = rearranged(seen, order, [0.0] * seen.n)
            alike = same_motion(ordered.ideal(), wanted.ideal())
            kept = own if order == sorted(order) else None
            for way, turns in enumerate(natural_turns(ordered, wanted)):
                view = _named_alike(rearranged(ordered, range(ordered.n), turns), wanted)
                differ = differences(view, wanted, "the file", suspects=kept)
                if alike:  # numbers that do not change the motion are no difference
                    differ = [finding for finding in differ if finding.where.startswith("joint")]
                ways.append(((not alike, *_weight(differ), way, not _recognised(differ), side), differ))
    best = min(ways, key=lambda way: way[0])[1] if ways else None
    if best is None:
        says = f"the file: links hang on {[p + 1 for p in found.parents]}, wanted {[p + 1 for p in wanted.parents]}"
        return [Finding("joint-order", "the file", str(found.parents), str(wanted.parents), f"{says} (0: the support)")]
    return _gravity_turned(found, wanted, best) + _weighed(file, best) + best


def _recognised(findings: list[Finding]) -> bool:
    return any(finding.cause == "degree-vs-radian" for finding in findings)


def _weight(findings: list[Finding]) -> tuple[int, int]:
    """How many places they name, then how many things: the fewer, the better two mechanisms were brought together."""
    named = [finding for finding in findings if finding.cause != "degree-vs-radian"]  # always told beside another
    return len({finding.where for finding in named}), len(named)


def _weighed(file: ModelFile, findings: list[Finding], who: str = "the file") -> list[Finding]:
    """Where bodies get their inertials from their geoms and differ, that is what to look at first."""
    by_link = {"mass", "inertia", "com-displaced", "inertial-com-rotated", "length"}
    if not file.from_geoms:
        return []
    if not any(finding.cause in by_link for finding in findings):
        return []
    passed = [name for name in file.from_geoms if name in file.tensors]
    why = (
        "the compiler is told to (inertiafromgeom), and passes the inertials over"
        if passed
        else "they have no inertial"
    )
    names = ", ".join(file.from_geoms[:3]) + (" …" if len(file.from_geoms) > 3 else "")
    says = f"{who}: {names}: mass and inertia are those of the geoms: {why}"
    if who != "the file":
        says = f"{who}: {names}: the file gives no inertial, and this engine weighs their geoms otherwise"
    return [Finding("inertia-from-geoms", f"link {names}", None, None, says)]


def _named_alike(view: Mechanism, wanted: Mechanism) -> Mechanism:
    gravity = wanted.gravity if np.allclose(view.gravity, wanted.gravity, rtol=1e-14, atol=0) else view.gravity
    return replace(view, gravity=gravity)


def _gravity_turned(found: Mechanism, wanted: Mechanism, others: list[Finding]) -> list[Finding]:
    """Gravity askew in the world, where the links hang along the world's axes in the file's reference configuration."""
    vector = np.array(found.gravity_vector)
    size = float(np.linalg.norm(vector))
    if not size or np.abs(vector).max() > size * (1 - 1e-12):
        return []
    straight = [k.com for k in found.links if any(k.com)] + [
        k.hinge for k in found.links if any(k.hinge) and k.parent >= 0
    ]
    down, across = np.array(found.down), np.array(found.across)
    for along, sideways in straight:
        direction = along * down + sideways * across
        if np.abs(direction).max() < np.linalg.norm(direction) * (1 - 1e-9):
            return []
    angles = {round(float(np.arctan2(c[1], c[0])), 9) for c in straight}
    if any(abs(angle) < 1e-9 for angle in angles) or any("gravity" in f.cause for f in others):
        return []
    askew = min((float(np.degrees(a)) for a in angles), key=abs)
    says = (
        f"the file: gravity {found.gravity_vector} lies askew to the axes along which the links hang, by {askew:.6g}°"
    )
    return [Finding("gravity-turned", "gravity", askew, 0.0, says)]


def _other_number(found: Mechanism, wanted: Mechanism) -> list[Finding]:
    """A hinge too few or too many; which one, if leaving it out makes them alike."""
    fewer = found.n < wanted.n
    more = wanted if fewer else found
    less = found if fewer else wanted
    cause = "joint-dropped-by-parser" if fewer else "joint-added"
    which = None
    if more.n == less.n + 1:
        which = next((k for k in range(more.n) if _like(without_hinge(more, k), less)), None)
    where = joint(more, which) if which is not None else "the file"
    says = f"the file has {found.n} hinges, {wanted.n} are wanted"
    if which is not None:
        says += f"; {'missing is' if fewer else 'one too many is'} {where}"
    return [Finding(cause, where, found.n, wanted.n, says)]


def _like(a: Mechanism, b: Mechanism) -> bool:
    ideal = a.ideal(), b.ideal()
    return any(
        same_motion(rearranged(ideal[0], order, [0.0] * a.n), ideal[1], 1e-9) for order in orders(ideal[0], ideal[1])
    )


def described(mechanism: Mechanism) -> dict[str, Any]:
    """A mechanism for a report: numbers in the plane's frame."""
    plain = Hinge()
    links = []
    for i, (link, hinge) in enumerate(zip(mechanism.links, mechanism.hinges, strict=True)):
        held = {
            "stops" if name == "limits" else name: getattr(hinge, name)  # the name that reports have always had
            for name in ("armature", "damping", "friction", "stiffness", "rest", "limits")
            if getattr(hinge, name) != getattr(plain, name)
        }
        links.append(
            {
                "name": mechanism.link_names[i],
                "joint": hinge.name,
                "on": mechanism.link_names[link.parent] if link.parent >= 0 else None,
                "hinge": list(link.hinge),
                "centre of mass": list(link.com),
                "mass": link.mass,
                "inertia": link.inertia,
                **held,
            }
        )
    return {"gravity": list(mechanism.gravity_vector), "links": links}
