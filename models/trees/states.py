"""The states in which a scene of an open mechanism is compared: given, named and random ones, in its coordinates."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..states import quantised
from .scene import TreeScene
from .system import COORDINATES, RATES, TreeJoint, TreeSystem

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TreeStates:
    """``q`` (B, nq) and ``v`` (B, nv), and a label for each of the B states."""

    labels: tuple[str, ...]
    q: Array
    v: Array

    def __len__(self) -> int:
        return len(self.labels)

    def at(self, rows: NDArray[np.intp]) -> TreeStates:
        """Some of them, by number."""
        return TreeStates(tuple(self.labels[row] for row in rows), self.q[rows], self.v[rows])


def tree_states(scene: TreeScene, random: int | None = None) -> TreeStates:
    """The scene's given state, its named ones, then its random ones; at most ``random`` of these, if given."""
    system = scene.system
    labels: list[str] = []
    rows: list[tuple[Array, Array]] = []
    if scene.q is not None and scene.v is not None:
        labels.append("given")
        rows.append((np.array(scene.q), np.array(scene.v)))
    for word in scene.named:
        labels.append(word)
        rows.append(named_state(word, system))
    count = scene.random if random is None else min(random, scene.random)
    rows += random_states(scene.name, system, count)
    labels += [f"random {i}" for i in range(count)]
    return TreeStates(
        tuple(labels),
        np.array([row[0] for row in rows]).reshape(-1, system.nq),
        np.array([row[1] for row in rows]).reshape(-1, system.n),
    )


def natural_rate(system: TreeSystem) -> float:
    """√(g/L) [rad/s], L being the mechanism's reach; 1 where there is no gravity, or no reach."""
    gravity = math.hypot(*system.gravity)
    return math.sqrt(gravity / system.reach) if gravity and system.reach else 1.0


def named_state(word: str, system: TreeSystem) -> tuple[Array, Array]:
    """q (nq,) and v (nv,) of one of :data:`furiko.models.trees.scene.NAMED_STATES`. Else ValueError.

    ``reference``: at rest in the reference configuration; ``small``: a little beside it, slowly; ``whirling``: turned
    far, a hundred times as fast as anything falls.
    """
    rate = natural_rate(system)
    index = np.arange(1, system.n + 1, dtype=np.float64)
    if word == "reference":
        return np.array(system.reference), np.zeros(system.n)
    if word == "small":
        turned, speeds = 1e-3 * np.cos(index), 1e-3 * rate * np.sin(index)
    elif word == "whirling":
        turned, speeds = 0.5 * index, 100 * rate * np.cos(2.0 * index)
    else:
        raise ValueError(f"no state is called {word!r}")
    return _moved(system, turned), quantised(speeds * _sizes(system))


def random_states(seed: str, system: TreeSystem, count: int) -> list[tuple[Array, Array]]:
    """``count`` pairs of q (nq,), v (nv,), the first of which are the same however many are asked for.

    Hinges are uniform within their limits, or on the circle; slides within their limits, or the reach; rotations are
    uniform; rates lie within six times the natural rate. ``seed`` is a word (a scene's name).
    """
    digest = hashlib.sha256(seed.encode()).digest()
    generator = np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "big")))
    scale = 6 * natural_rate(system) * _sizes(system)
    found = []
    for _ in range(count):
        q = [_random_position(joint, system, lambda size: 2 * generator.random(size) - 1) for joint in system.joints]
        found.append((np.concatenate(q), quantised(scale * (2 * generator.random(system.n) - 1))))
    return found


def _random_position(joint: TreeJoint, system: TreeSystem, draw: Callable[[int], Array]) -> Array:
    if joint.kind == "ball":
        return _direction(draw)
    if joint.kind == "free":
        return np.concatenate([quantised((system.reach or 1.0) * draw(3)), _direction(draw)])
    low, high = joint.limits or _range(joint, system)
    # Within limits of any size; a coordinate that rounding takes beyond them harms nothing.
    return quantised((low + high) / 2 + (high - low) / 2 * draw(1))


def _range(joint: TreeJoint, system: TreeSystem) -> tuple[float, float]:
    half = math.pi if joint.kind == "hinge" else system.reach or 1.0
    return joint.ref - half, joint.ref + half


def _direction(draw: Callable[[int], Array]) -> Array:
    """A quaternion, uniform on the sphere: the first of random points in the cube that is within it."""
    while True:
        point = quantised(draw(4))
        if 1e-2 <= point @ point <= 1:
            return np.asarray(quantised(point / np.linalg.norm(point)))


def _sizes(system: TreeSystem) -> Array:
    """What a rate of one is for each degree of freedom: rad/s, or the reach a second."""
    reach = system.reach or 1.0
    parts = {"hinge": [1.0], "slide": [reach], "ball": [1.0] * 3, "free": [reach] * 3 + [1.0] * 3}
    return np.array([size for joint in system.joints for size in parts[joint.kind]])


def _moved(system: TreeSystem, turned: Array) -> Array:
    """The reference configuration with each degree of freedom moved by so many rad, or of the reach; (nq,)."""
    q, by = np.array(system.reference), quantised(turned * _sizes(system))
    at_q = at_v = 0
    for joint in system.joints:
        if joint.kind in ("hinge", "slide"):
            q[at_q] += by[at_v]
        else:
            if joint.kind == "free":
                q[at_q : at_q + 3] += by[at_v : at_v + 3]
            end_q, end_v = at_q + COORDINATES[joint.kind], at_v + RATES[joint.kind]
            q[end_q - 4 : end_q] = quantised(_times(q[end_q - 4 : end_q], by[end_v - 3 : end_v]))
        at_q += COORDINATES[joint.kind]
        at_v += RATES[joint.kind]
    return q


def _times(quaternion: Array, vector: Array) -> Array:
    """The quaternion turned about the moved axes by a rotation vector (3,) [rad]."""
    angle = float(np.linalg.norm(vector))
    a, u = math.cos(angle / 2), math.sin(angle / 2) * vector / (angle or 1.0)
    w, r = quaternion[0], quaternion[1:]
    return np.concatenate([[w * a - r @ u], w * u + a * r + np.cross(r, u)])
