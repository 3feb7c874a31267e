"""``furiko diagnose``: a user's own model file against the theory, in every engine that reads it.

Three questions, each with its own findings. *Does each engine do what the file says?* The theory is the planar tree
that furiko reads in the file, with its damping, armature, springs and so on. *Which one differs from all others?* Where
all engines differ from furiko's reading in the same way, the reading is wrong, not the engines. *Is the file what is
wanted?* Compared with a scene, another model or a mechanism; without one, with the file's own links on ideal hinges.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...engines.model_files.adapter import READERS, Reader
from ...models import InvalidInput, PlanarTree
from ...models.mechanism import Mechanism, mechanism_of
from ...models.readers.model_file import ModelFile, read_model
from ..compiled import mechanism_from
from ..reader_faults import degrees_in_file
from .comparison import compare_with, compare_with_ideal
from .engine_answers import ask_engines
from .result import Diagnosis, mechanism_to_json
from .voting import vote

REPORTED_TILT = 1e-13  # a larger tilt is mentioned in a note
MODEL_ENDINGS = (".xml", ".urdf", ".mjcf")


def diagnose(
    model: str | Path | ModelFile,
    against: Any = None,
    engines: Mapping[str, Reader] = READERS,
    *,
    isolated: bool = False,
) -> Diagnosis:
    """Diagnose an MJCF or URDF file.

    ``against``: None for what the file's own links would do on ideal hinges; the name of a scene or the path of its
    TOML file; the path of another model file; or a system, planar tree or mechanism. ``engines``: the engines to ask,
    and no others. ``isolated``: ask each engine in a worker process of its own, so that a file that crashes one engine
    does not affect the others; the readers are then pickled. Raises :class:`InvalidInput` for a file that is no planar
    tree of hinges, and for bad ``against``.
    """
    file = model if isinstance(model, ModelFile) else read_model(model)
    expected, name = _expected(against)
    file = _with_gravity(file, expected)
    answers = ask_engines(file, list(engines.values()), isolated=isolated)
    of_file = list(degrees_in_file(file))
    of_file += compare_with_ideal(file.mechanism) if expected is None else compare_with(file, expected)
    findings = [*of_file, *vote(file.path, answers)]
    engine_notes = (note for answer in answers for note in answer.notes)
    return Diagnosis(
        model=file.path,
        verdict=_verdict([finding.cause for finding in findings]),
        findings=tuple(findings),
        engines={answer.name: answer.to_json() for answer in answers},
        notes=tuple(dict.fromkeys([*file.notes, *_tilt_notes(file.mechanism), *engine_notes])),
        against=name,
        mechanism=mechanism_to_json(file.mechanism),
    )


def _verdict(causes: list[str]) -> str:
    if "unexplained" in causes:
        return "unexplained"
    return "differs" if causes else "agrees"


def _tilt_notes(mechanism: Mechanism) -> list[str]:
    if mechanism.tilt < REPORTED_TILT:
        return []
    return [f"the hinges' axes are not quite parallel: the tolerance is {mechanism.tilt:.1g} of each torque"]


def _expected(against: Any) -> tuple[Mechanism | None, str]:
    """The mechanism to compare with, and its name."""
    if against is None:
        return None, ""
    if isinstance(against, str | Path):
        if str(against).endswith(MODEL_ENDINGS):
            return read_model(against).mechanism, str(against)
        from ...models import find_document_scene

        scene = find_document_scene(str(against), "--against")
        return mechanism_of(scene.system.tree()), scene.name
    if isinstance(against, ModelFile):
        return against.mechanism, against.path
    if isinstance(against, Mechanism | PlanarTree) or hasattr(against, "tree"):
        return mechanism_from(against), getattr(against, "kind", type(against).__name__)
    raise InvalidInput(f"against: a scene, a model file or a mechanism is needed, got {type(against).__name__}")


def _with_gravity(file: ModelFile, expected: Mechanism | None) -> ModelFile:
    """A URDF file, which cannot give gravity, with the gravity of the mechanism that it is compared with."""
    if file.language != "urdf" or expected is None:
        return file
    strength = float(np.hypot(*expected.gravity))
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
    note = f"URDF gives no gravity: {strength:g} m/s² is used, as in what the file is compared with"
    return replace(file, planar=changed, notes=(*notes, note))
