"""What one release of an engine makes of the scenes and files that were chosen for differences between releases.

Against the theory the checks judge (:func:`furiko.run.check`); here are the answers themselves, so that releases can be
held against each other to the last bit, and what each reads in a model file.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...diagnosis.robots.answer import Question, RobotAnswer, ask_robot
from ...engines import cannot, engine_info, load_engine, load_tree_engine
from ...engines.model_files.elsewhere import reader_at
from ...models import TreeScene, find_scene
from ...models.readers.model_file import read_model
from ...models.spatial_mechanism import SpatialMechanism
from ...models.states import states
from ...models.trees.states import tree_states
from ...records.check import Outcome
from ...records.versions import LookKind

Array = NDArray[np.float64]

FILES = Path(__file__).parent / "files"
# Of each document a small and a long mechanism, unequal lengths, and of the trees one with each kind of joint.
SCENES = ("double-pendulum-unequal", "n-leg-3", "rods-3", "rods-5-chaotic", "rods-20", "acrobot", "arm-7", "quadruped")
STATES = 20


@dataclass(frozen=True)
class Look:
    """``probe``: a scene or a file; ``kind``: what is looked at there.

    ``says``: a sentence where there is something to say; ``digest``: of the answer's bytes; ``answer``: the
    numbers, for how far two releases are apart; none: empty.
    """

    probe: str
    kind: LookKind
    outcome: Outcome
    says: str
    digest: str
    answer: Array


def look(engine: str, scenes: Sequence[str] = SCENES) -> list[Look]:
    """All looks at an engine, in this process; one that fails is a look, too. ``scenes``: names from the catalogue."""
    return [*_scenes(engine, scenes), *_files(engine)]


def files() -> list[Path]:
    """The model files that were made for this."""
    return sorted(path for path in FILES.iterdir() if path.suffix in {".xml", ".urdf"})


def _scenes(engine: str, scenes: Sequence[str]) -> Iterator[Look]:
    info = engine_info(engine)
    for name in scenes:
        scene = find_scene(name)
        why = cannot(info, scene.system)
        if why:
            yield _silent(name, "accelerations", "skipped", why.replace(engine, engine.partition("@")[0]))
            continue
        try:
            if isinstance(scene, TreeScene):
                at = tree_states(scene, STATES)
                tree = load_tree_engine(engine, scene.system)
                yield _answered(name, "accelerations", tree.accelerations(at.q, at.v))
            else:
                there = states(scene, STATES)
                made = load_engine(engine, scene.system)
                yield _answered(name, "accelerations", made.accelerations(there.theta, there.omega))
                if "fields" not in info.missing:
                    held = made.fields()
                    numbers = (held.hinges, held.centres, held.masses, held.inertias, held.gravity)
                    yield _answered(name, "fields", np.concatenate([np.ravel(part) for part in numbers]))
        except Exception as error:
            yield _silent(
                name, "accelerations", "error", f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
            )


def _files(engine: str) -> Iterator[Look]:
    reader = reader_at(engine)
    for path in files() if reader else ():
        assert reader is not None
        file = read_model(path)
        if file.language not in reader.languages:
            continue
        try:
            found = ask_robot(reader, Question(path, file))
        except Exception as error:
            yield _silent(
                path.name, "reading", "error", f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
            )
            continue
        yield _read(path.name, found, file.spatial)


def _read(name: str, found: RobotAnswer, wanted: SpatialMechanism) -> Look:
    outcomes: dict[str, Outcome] = {
        "agrees": "agrees",
        "differs": "differs",
        "refused": "differs",
        "missing": "error",
        "failed": "error",
    }
    says = "; ".join(dict.fromkeys(finding.says for finding in found.findings)) or found.says
    says = says.replace(f"{FILES}{os.sep}", "")  # where furiko is installed is nobody's concern
    numbers = np.zeros(0)
    if found.holds is not None:
        says = says or _places(found.holds, wanted)
        held = [
            np.concatenate([body.position, body.quaternion, [body.inertial.mass], body.inertial.centre])
            for body in found.holds.bodies
        ]
        numbers = np.concatenate([np.ravel(part) for part in held])
    return Look(name, "reading", outcomes[found.status], says[:600], _digest(numbers), numbers)


def _places(held: SpatialMechanism, wanted: SpatialMechanism) -> str:
    """By how much bodies are beside the places that the file says, where no more than last digits are other."""
    theirs, ours = ([body.position for body in one.bodies] for one in (held, wanted))
    off = np.abs(np.array(theirs) - np.array(ours)).max(initial=0.0) if len(theirs) == len(ours) else 0.0
    return f"places are up to {off:.2g} m beside those that are written" if off else ""


def _answered(name: str, kind: LookKind, answer: Array) -> Look:
    return Look(name, kind, "agrees", "", _digest(answer), answer)


def _silent(name: str, kind: LookKind, outcome: Outcome, says: str) -> Look:
    return Look(name, kind, outcome, says, "", np.zeros(0))


def _digest(answer: Array) -> str:
    shape = repr(answer.shape).encode()
    return hashlib.sha256(shape + np.ascontiguousarray(answer, dtype="<f8").tobytes()).hexdigest()[:16]
