"""What integrators keep in the long run with the steps that are advised: the evidence beside an advice.

Of the scene itself the energy, where no damper takes it, and the length of quaternions; of the motions that are known
for ever (:mod:`.trees.motions`), those of the kinds of joints that the scene has, the phase too. Every run is of this
engine, this step and this release; each begins at its start, and the longest that the time allows is told.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import load_tree_engine
from ...models import TreeScene
from ...models.trees.system import TreeSystem
from ...records.bench import LongMotion
from ...reference.integration.tree_places import quaternions
from ...reference.truth.spatial import energy
from .accelerations import finite
from .failures import Failure
from .trees.motions import known_motions
from .trees.runs import LONG, TIMES, Kept, TreeRunCase

Array = NDArray[np.float64]
Asked = Callable[[float], Kept]  # what is kept after so many seconds

MOTIONS = {"hinge": ("pendulum",), "slide": ("slider",), "ball": ("top",), "free": ("thrown", "top")}
PARTS = tuple(k / 8 for k in range(1, 9))  # of the scene's duration, at which its energies are looked at
FEWEST = 2  # runs, the first of which loads what all need
GROWS = 4.0  # a run is about three times as long as the one before; and takes a little more


@dataclass(frozen=True)
class Advisable:
    """An engine's scheme with the step [s] that is advised."""

    engine: str
    scheme: str
    step: float


def long_runs(
    scene: TreeScene, advised: Sequence[Advisable], budget: float, watch: Callable[[str], None] = lambda _: None
) -> list[LongMotion]:
    """The longest run of each, of the scene and of known motions, in about ``budget`` [s]; at most 1000 s long."""
    known = [name for name in known_motions() if any(name in MOTIONS[j.kind] for j in scene.system.joints)]
    found: list[LongMotion] = []
    until = time.monotonic() + budget
    left = len(advised) * (1 + len(known))
    for each in advised:
        for motion in (None, *known):
            watch(f"{each.engine} {each.scheme}: {motion or scene.name} in the long run")
            share = (until - time.monotonic()) / left
            left -= 1
            found += _longest(scene, each, motion, share)
    return found


def _longest(scene: TreeScene, each: Advisable, motion: str | None, share: float) -> Iterator[LongMotion]:
    """The longest run that the time allows, or the first that is another motion; none where not even one ends."""
    says = scene.name if motion is None else f"{motion}: {known_motions()[motion].says}"
    spent = latest = 0.0
    last = None
    for rung, seconds in enumerate(TIMES):
        if seconds > LONG or (rung >= FEWEST and GROWS * latest > share - spent):
            break
        begun = time.monotonic()
        try:
            kept, failure = _of_scene(scene, each, seconds) if motion is None else _of_known(each, motion, rung)
        except Exception as error:  # an engine's own failure is told, and ends no advice
            kept, failure = Kept(np.inf, np.inf, np.inf), f"{type(error).__name__}: {error}"
        latest = time.monotonic() - begun
        spent += latest
        last = LongMotion(
            engine=each.engine,
            scheme=each.scheme,
            step=each.step,
            motion=motion or scene.name,
            says=says,
            time=seconds,
            phase_error=None if motion is None else finite(kept.phase),
            energy_drift=None if motion is None and _damped(scene.system) else finite(kept.energy),
            length_drift=finite(kept.length),
            failure=failure,
        )
        if failure:
            break
    if last is not None:
        yield last


def _of_known(each: Advisable, motion: str, rung: int) -> tuple[Kept, str | None]:
    details = TreeRunCase(each.engine, each.scheme, motion, each.step, rung).run().details
    phase, drift, length = (details.get(f"{name}") for name in ("phase error", "energy drift", "length drift"))
    return Kept(*(np.inf if part is None else part for part in (phase, drift, length))), details["failure"]


def _of_scene(scene: TreeScene, each: Advisable, seconds: float) -> tuple[Kept, Failure | None]:
    """Energy over the largest that the scene's motion turns into motion, and quaternions; nothing is known of the
    phase."""
    mechanism = scene.system.mechanism()
    q, v = _end(scene, each, seconds)
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        return Kept(np.inf, np.inf, np.inf), "NaN"
    off = float(energy(mechanism, q, v).float.sum() - energy(mechanism, *_start(scene)).float.sum())
    turned = max(_turned(scene, each, part) for part in PARTS)
    drift = abs(off) / turned if turned else 0.0
    lengths = [abs(float(np.linalg.norm(q[at])) - 1) for at, _ in quaternions(mechanism)]
    kept = Kept(0.0, 0.0 if _damped(scene.system) else drift, max(lengths, default=0.0))
    return kept, kept.failure


def _turned(scene: TreeScene, each: Advisable, part: float) -> float:
    """Kinetic energy [J] after a part of the scene's duration, or what potential energy has changed by."""
    (_, before), (kinetic, after) = (
        energy(scene.system.mechanism(), *state).float.tolist()
        for state in (_start(scene), _end(scene, each, part * scene.duration))
    )
    return max(float(kinetic), abs(float(after - before)))


def _start(scene: TreeScene) -> tuple[Array, Array]:
    return np.array(scene.q), np.array(scene.v)


def _end(scene: TreeScene, each: Advisable, seconds: float) -> tuple[Array, Array]:
    engine = load_tree_engine(each.engine, scene.system)
    return engine.trajectory(*_start(scene), each.scheme, each.step, max(1, round(seconds / each.step)))


def _damped(system: TreeSystem) -> bool:
    return any(joint.damping for joint in system.joints)
