"""Engines' own integrators on an open mechanism, and its motion, for ``furiko advise``."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...engines import TreeShape, engine_info, load_tree_engine
from ...models import InvalidInput, TreeScene
from ...models.spatial_mechanism import SpatialMechanism
from ...reference.integration.tree_places import difference
from ...reference.truth.tree_motion import TreeMotion, tree_motion
from .methods import STEP, End, Method, why_not

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TreeReference:
    """The ``motion`` of a ``mechanism`` at the times looked at, and how far it may be off at most."""

    mechanism: SpatialMechanism
    motion: TreeMotion
    error: float

    def off(self, number: int, end: End) -> float:
        """The largest error of an end at one of the times: of coordinates, turns [rad] and rates."""
        q, v = end
        turned = difference(self.mechanism, q[None], self.motion.q[number][None])
        return float(np.abs(np.concatenate([turned[0], v - self.motion.v[number]])).max())


def tree_reference(scene: TreeScene, asked: float, parts: Sequence[float], sure: float) -> TreeReference:
    """The motion at ``parts`` of the scene's duration, from proven accelerations.

    Raises :class:`InvalidInput` where it is known no better than the part ``sure`` of ``asked``.
    """
    mechanism = scene.system.mechanism()
    times = [part * scene.duration for part in parts]
    try:
        motion = tree_motion(mechanism, np.array(scene.q), np.array(scene.v), times)
    except ArithmeticError as error:
        raise InvalidInput(f"{scene.name}: {error}") from None
    off = np.maximum.accumulate(motion.error)
    if not off[-1] <= sure * asked:
        raise InvalidInput(
            f"{scene.name}: an error of {asked:g} cannot be told after {scene.duration:g} s: the motion itself is "
            f"known to {off[-1]:.0e} only; ask for a shorter time (--until) or a larger error (--error)"
        )
    return TreeReference(mechanism, motion, float(off[-1]))


def tree_methods(scene: TreeScene, engines: Sequence[str]) -> tuple[list[Method], list[str]]:
    """All methods of these engines for the scene; and the engines left out, with the reason."""
    found: list[Method] = []
    left_out: list[str] = []
    for name in engines:
        info = engine_info(name)
        missing = info.tree.missing if info.tree else {}
        reason = why_not(name, scene) or missing.get("trajectory") or ""
        if reason:
            left_out.append(f"{name}: {reason}")
            continue
        found += _of_engine(scene, name)
    return found, left_out


def _of_engine(scene: TreeScene, name: str) -> Iterator[Method]:
    engine = load_tree_engine(name, scene.system)
    for scheme in engine_info(name).integrators:
        yield Method(name, scheme.name, STEP, (), partial(_fixed, engine, scene, scheme.name))


def _fixed(engine: TreeShape, scene: TreeScene, scheme: str, step: float, part: float = 1.0) -> End:
    steps = round(part * scene.duration / step)
    q, v = engine.trajectory(np.array(scene.q), np.array(scene.v), scheme, step, steps)
    return (q, v) if np.isfinite(q).all() else (np.full_like(q, math.nan), v)
