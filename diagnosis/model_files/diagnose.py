"""``furiko diagnose``: a user's own model file against the theory, in every engine that reads it.

Three questions, each with its own findings. *Does each engine do what the file says?* The theory is the planar tree
that furiko reads in the file, with its damping, armature, springs and so on. *Which one differs from all others?* Where
all engines differ from furiko's reading in the same way, the reading is wrong, not the engines. *Is the file what is
wanted?* Compared with a scene, another model or a mechanism, if one is given.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ...engines.model_files.adapter import READERS, Reader
from ...engines.model_files.robot import ROBOT_READERS
from ...engines.model_files.robot_joints import UNNAMED_BODY, UNNAMED_JOINT
from ...models import InvalidInput, PlanarTree
from ...models.errors import nearest
from ...models.mechanism import Mechanism, mechanism_of
from ...models.readers.mjcf.bodies import MESHES_LEFT_OUT
from ...models.readers.model_file import ModelFile, read_model
from ...models.spatial_mechanism import SpatialMechanism
from ..finding import Finding
from ..robots.answer import Question, listed, places_in
from ..robots.answer import mechanism_to_json as spatial_to_json
from ..robots.built import BUILT, why_not_built
from ..robots.fields import field_differences
from ..robots.simulation import servo_findings
from ..robots.wording import field_findings
from .engine_result import EngineResult, ask_engines
from .result import Diagnosis, mechanism_to_json
from .voting import vote

REPORTED_TILT = 1e-13  # a larger tilt is mentioned in a note
PASSIVE = {"armature": "armature", "damping": "damping", "friction": "dry friction", "stiffness": "a spring"}
MODEL_ENDINGS = (".xml", ".urdf", ".mjcf")


def diagnose(
    model: str | Path | ModelFile,
    against: Any = None,
    engines: Mapping[str, Reader] | Sequence[str] | None = None,
    *,
    meshes: Sequence[Path] = (),
    limits: bool = False,
    isolated: bool = False,
) -> Diagnosis:
    """Diagnose an MJCF or URDF file: any open mechanism, in every engine that reads it.

    ``against``: None; the name of a scene or the path of its TOML file; the path of another model file; or a system,
    planar tree or mechanism. ``engines``:
    those to ask, and no others; where they are named, one that refuses the file leaves the answer incomplete.
    ``meshes``: folders besides the file's own in which meshes may lie. ``limits``: whether joints' ranges count.
    ``isolated``: ask each engine in a worker process of its own, so that a file that crashes one engine does not affect
    the others; the readers are then pickled. Raises :class:`InvalidInput` for a file that cannot be read, and for bad
    ``against``.
    """
    file = model if isinstance(model, ModelFile) else read_model(model, meshes=meshes)
    if not file.spatial.joints:
        raise InvalidInput(f"{file.path}: no joint: at least one body must be able to move")
    wanted = expected_of(against, meshes)
    file = _with_gravity(file, wanted.planar)
    readers = chosen_readers(engines)
    with own_file(file) as path:
        folders = tuple(folder.resolve() for folder in meshes)
        # Of a file alone contacts are left out, and said; what it is compared with has none.
        question = Question(path, file, folders, limits, contacts=bool(wanted.name))
        results = ask_engines(question, readers, named=engines is not None, isolated=isolated)
    of_file = _of_file(file, wanted, limits)
    not_asked = {} if engines is not None else _not_asked(file, results)
    results = [result for result in results if result.name not in not_asked]
    findings = [*of_file, *vote(file, results)]
    notes = [*_of_interest(file), *_tilt_notes(file.planar), *_not_ideal_notes(file.planar, wanted)]
    notes += [note for result in results for note in result.notes]
    notes += [f"{name} is not asked: {why}" for name, why in not_asked.items()]
    return Diagnosis(
        model=file.path,
        verdict=verdict(findings, results, named=engines is not None),
        findings=tuple(findings),
        engines={result.name: result.to_json() for result in results},
        notes=tuple(dict.fromkeys(_by_their_bodies(note, file.spatial) for note in notes)),
        against=wanted.name,
        mechanism=mechanism_to_json(file.planar) if file.planar is not None else None,
        spatial=spatial_to_json(file.spatial),
        simulation=(*servo_findings(file.servos), *(said for result in results for said in result.simulation)),
        without=tuple(dict.fromkeys([*file.without, *(line for result in results for line in result.without)])),
    )


def _of_interest(file: ModelFile) -> list[str]:
    """The reader's notes; not that on furiko's own text of the file, which is made of planar mechanisms alone."""
    return [note for note in file.notes if file.planar is not None or note != MESHES_LEFT_OUT]


def _by_their_bodies(note: str, mechanism: SpatialMechanism) -> str:
    """A note, in which joints that the file leaves unnamed are called after their bodies, not by furiko's numbers."""
    for placed in mechanism.joints:
        name, body = placed.joint.name, mechanism.bodies[placed.body].name
        if name.startswith(UNNAMED_JOINT):
            owner = "an unnamed body" if body.startswith(UNNAMED_BODY) else f"body {body!r}"
            note = note.replace(f"joint {name!r}", f"the unnamed joint of {owner}")
    return note


def _not_asked(file: ModelFile, results: Sequence[EngineResult]) -> dict[str, str]:
    """By name the engines that nobody named and that are left out, each with the reason."""
    found = {r.name: r.own.says for r in results if r.own is not None and not r.own.asked}
    if why := _why_not_built(file, results):
        found[BUILT.name] = why
    return found


def _why_not_built(file: ModelFile, results: Sequence[EngineResult]) -> str:
    """Why Exudyn, which nobody named, has no answer about a mechanism in space; nothing where it has one."""
    if file.planar is not None:
        return ""
    refused = (result.says for result in results if result.name == BUILT.name and result.status == "refused")
    return why_not_built(file.spatial) or next(refused, "")


def verdict(findings: Sequence[Finding], results: Sequence[EngineResult], *, named: bool) -> str:
    """``agrees`` only where nothing was found and an engine was compared; ``incomplete`` where one that was asked for
    by name could not be, or none was."""
    if any(finding.cause == "unexplained" for finding in findings):
        return "unexplained"
    if not any(result.compared for result in results) or (named and any(not result.compared for result in results)):
        return "incomplete"
    return "differs" if findings else "agrees"


def _of_file(file: ModelFile, wanted: Expected, limits: bool) -> list[Finding]:
    """What is in the file and was not expected there."""
    if file.planar is not None:
        return _of_planar_file(file, wanted, limits)
    if wanted.spatial is not None:
        return _in_space(file, wanted.spatial, limits, wanted.name)
    if wanted.name:
        raise InvalidInput(f"{file.path}: {file.not_planar}; it cannot be compared with {wanted.name}")
    return []


def _in_space(file: ModelFile, wanted: SpatialMechanism, limits: bool, name: str) -> list[Finding]:
    differences = field_differences(file.spatial, wanted, limits=limits)
    return field_findings("the file", differences, places_in(file.spatial), asked=Path(name).name)


def _of_planar_file(file: ModelFile, wanted: Expected, limits: bool) -> list[Finding]:
    from ..reader_faults import degrees_in_file  # and all hypotheses of the plane, which robots do not need
    from .comparison import compare_with, compare_with_ideal

    found = list(degrees_in_file(file))
    if wanted.planar is not None:
        return found + compare_with(file, wanted.planar)
    if wanted.spatial is not None:
        return found + _in_space(file, wanted.spatial, limits, wanted.name)
    assert file.planar is not None
    ideal = compare_with_ideal(file.planar)
    return found + [finding for finding in ideal if limits and finding.cause == "joint-limit"]


def _not_ideal_notes(planar: Mechanism | None, wanted: Expected) -> list[str]:
    """What the hinges have besides turning, in one sentence a kind: nobody said that they should not have it."""
    if planar is None or wanted.name:
        return []
    joints: dict[str, list[str]] = {}
    for hinge in planar.hinges:
        for name in (name for name in PASSIVE if getattr(hinge, name)):
            joints.setdefault(PASSIVE[name], []).append(hinge.name)
    return [f"the file gives {name} to {listed(names)}" for name, names in joints.items()]


def chosen_readers(engines: Mapping[str, Reader] | Sequence[str] | None) -> dict[str, Reader | None]:
    """The engines asked for, all where none are named: by name, the reader of planar trees, None where it has none.

    Raises :class:`InvalidInput` for an unknown name.
    """
    if isinstance(engines, Mapping):
        return dict(engines)
    known = tuple(dict.fromkeys([*READERS, *ROBOT_READERS]))
    unknown = next((name for name in engines or () if name not in known), None)
    if unknown is not None:
        hint = nearest(unknown, known) or f"; known: {', '.join(known)}"
        raise InvalidInput(f"engine {unknown!r} reads no model files{hint}")
    return {name: READERS.get(name) for name in engines or known}


@contextmanager
def own_file(file: ModelFile) -> Iterator[Path]:
    """The path of the user's own file; a text that is in no file is written into a temporary one."""
    path = Path(file.path)
    if not file.own_text and path.is_file():
        yield path.resolve()  # workers run in a folder of their own
        return
    with tempfile.TemporaryDirectory(prefix="furiko-") as folder:
        path = Path(folder, f"model.{'xml' if file.language == 'mjcf' else 'urdf'}")
        path.write_text(file.own_text, encoding="utf-8")
        yield path


def _tilt_notes(mechanism: Mechanism | None) -> list[str]:
    if mechanism is None or mechanism.tilt < REPORTED_TILT:
        return []
    along = abs(float(np.dot(np.cross(mechanism.down, mechanism.across), mechanism.gravity_vector)))
    steep = along > float(np.hypot(*mechanism.gravity)) > 0
    why = "gravity is nearly along the hinges' axes" if steep else "the hinges' axes are not quite parallel"
    return [f"{why}: the tolerance is {mechanism.tilt:.1g} of each torque"]


@dataclass(frozen=True)
class Expected:
    """What a file is compared with: its ``name``, and the planar mechanism or else the one in space."""

    name: str = ""
    planar: Mechanism | None = None
    spatial: SpatialMechanism | None = None


def expected_of(against: Any, meshes: Sequence[Path] = ()) -> Expected:
    """``against`` understood. Raises :class:`InvalidInput`."""
    if against is None:
        return Expected()
    if isinstance(against, str | Path):
        if str(against).endswith(MODEL_ENDINGS):
            return expected_of(read_model(against, meshes=meshes))
        from ...models import find_document_scene

        scene = find_document_scene(str(against), "--against")
        return Expected(scene.name, mechanism_of(scene.system.tree()))
    if isinstance(against, ModelFile):
        return Expected(against.path, against.planar, against.spatial)
    if isinstance(against, Mechanism | PlanarTree) or hasattr(against, "tree"):
        from ..compiled import mechanism_from

        return Expected(getattr(against, "kind", type(against).__name__), mechanism_from(against))
    raise InvalidInput(f"against: a scene, a model file or a mechanism is needed, got {type(against).__name__}")


def _with_gravity(file: ModelFile, expected: Mechanism | None) -> ModelFile:
    """A URDF file, which cannot give gravity, with the gravity of the mechanism that it is compared with."""
    if file.language != "urdf" or expected is None or file.planar is None:
        return file
    strength = float(np.hypot(*expected.gravity))
    ratio = strength / float(np.hypot(*file.planar.gravity)) if any(file.planar.gravity) else 0.0
    old = file.planar
    vector = tuple(ratio * x if ratio else 0.0 for x in old.gravity_vector)
    along = old.gravity[0] * ratio
    if abs(along - strength) <= 1e-12 * strength:
        along = strength
    in_plane = abs(abs(vector[2]) - strength) <= 1e-12 * strength
    if vector[0] == 0 and vector[1] == 0 and in_plane:
        vector = (0.0, 0.0, -strength)
    changed = replace(old, gravity=(along, 0.0), gravity_vector=vector)
    notes = tuple(note for note in file.notes if "gravity" not in note)
    note = f"URDF gives no gravity: {strength:g} m/s² is used, as in what the file is compared with"
    return replace(file, planar=changed, notes=(*notes, note))
