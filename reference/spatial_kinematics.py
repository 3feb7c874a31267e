"""Where a mechanism in space is and how it moves, and its energy: in doubles, for batches of states.

For what needs no proof: energies along a trajectory, the lengths in bounds of rounding. :mod:`.truth.spatial` has the
same in ball arithmetic, computed another way, and the tests hold one against the other.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..models.spatial import unit
from ..models.spatial_mechanism import WORLD, Array, Joint, SpatialMechanism
from .kernels.trees.springs import stretches


@dataclass(frozen=True, eq=False)
class Motion:
    """Frames of all bodies in B states, in the world's axes, and what each degree of freedom does.

    ``rotation`` (B, bodies, 3, 3), ``position`` (B, bodies, 3) [m]; ``angular`` and ``linear`` (B, bodies, 3): velocity
    [rad/s] and that of the frame's origin [m/s]. ``axis`` and ``pivot`` (B, nv, 3): direction of a degree of freedom,
    and for one that turns a point that it leaves in place, for others the frame's origin [m].
    """

    rotation: Array
    position: Array
    angular: Array
    linear: Array
    axis: Array
    pivot: Array

    def of_state(self, row: int) -> Motion:
        """One of the states, as a batch of one."""
        return Motion(*(getattr(self, part.name)[row : row + 1] for part in fields(self)))


def motion(mechanism: SpatialMechanism, q: Array, v: Array) -> Motion:
    """All frames in the states ``q`` (B, nq), ``v`` (B, nv). Quaternions may have any length but zero."""
    q, v = np.asarray(q, dtype=np.float64), np.asarray(v, dtype=np.float64)
    batch, bodies = len(q), len(mechanism.bodies)
    found = Motion(
        np.empty((batch, bodies, 3, 3)),
        *(np.empty((batch, bodies, 3)) for _ in range(3)),
        *(np.empty((batch, mechanism.nv, 3)) for _ in range(2)),
    )
    placed: dict[int, list[int]] = {index: [] for index in range(bodies)}
    for number, joint in enumerate(mechanism.joints):
        placed[joint.body].append(number)
    for index, body in enumerate(mechanism.bodies):
        state = _on_parent(found, body.parent, batch)
        state.carry(body.position, rotations(np.tile(body.quaternion, (batch, 1))))
        for number in placed[index]:
            one = mechanism.joints[number]
            state.move(one.joint, q[:, one.columns_q], v[:, one.columns_v])
            found.axis[:, one.columns_v], found.pivot[:, one.columns_v] = state.axis, state.pivot
        found.rotation[:, index], found.position[:, index] = state.rotation, state.position
        found.angular[:, index], found.linear[:, index] = state.angular, state.linear
    return found


def energy(mechanism: SpatialMechanism, q: Array, v: Array) -> Array:
    """Kinetic and potential energy [J], (B, 2), as :func:`furiko.reference.truth.spatial.energy` has them."""
    q, v = np.asarray(q, dtype=np.float64), np.asarray(v, dtype=np.float64)
    moved = motion(mechanism, q, v)
    moving = carried(mechanism)
    kinetic = (v * v) @ mechanism.per_freedom("armature") / 2
    potential = np.zeros(len(q))
    for index, body in enumerate(mechanism.bodies):
        if not moving[index]:
            continue
        arm = np.einsum("bik,k->bi", moved.rotation[:, index], body.inertial.centre)
        speed = moved.linear[:, index] + np.cross(moved.angular[:, index], arm)
        own = np.einsum("bki,bk->bi", moved.rotation[:, index], moved.angular[:, index])
        turning = np.einsum("bi,ij,bj->b", own, body.inertial.tensor, own)
        kinetic += (body.inertial.mass * (speed * speed).sum(-1) + turning) / 2
        potential -= body.inertial.mass * ((moved.position[:, index] + arm) @ mechanism.gravity)
    for one in mechanism.joints:
        if one.joint.stiffness:
            stretch = stretches(mechanism, one, q)
            potential += one.joint.stiffness * (stretch * stretch).sum(-1) / 2
    return np.stack([kinetic, potential], axis=-1)


def momentum(mechanism: SpatialMechanism, moved: Motion, root: int, about: Array | None = None) -> tuple[Array, Array]:
    """Linear [kg m/s] and angular momentum [kg m²/s] of all that hangs on ``root``, (B, 3).

    ``about`` (B, 3): the point of the angular one, the world's origin if None. Without what armatures add.
    """
    linear, angular = (np.zeros((len(moved.linear), 3)) for _ in range(2))
    point = np.zeros(3) if about is None else about
    for index in _hanging(mechanism, root):
        inertial = mechanism.bodies[index].inertial
        turned, spin = moved.rotation[:, index], moved.angular[:, index]
        arm = np.einsum("bik,k->bi", turned, inertial.centre)
        push = np.asarray(inertial.mass * (moved.linear[:, index] + np.cross(spin, arm)), dtype=np.float64)
        linear += push
        turning = np.einsum("bij,jk,blk,bl->bi", turned, inertial.tensor, turned, spin)
        angular += np.asarray(np.cross(moved.position[:, index] - point + arm, push) + turning, dtype=np.float64)
    return linear, angular


def centre_of_mass(mechanism: SpatialMechanism, moved: Motion, root: int) -> tuple[Array, float]:
    """That of all that hangs on ``root``, (B, 3) [m], and its mass [kg]."""
    mass, moment = 0.0, np.zeros((len(moved.linear), 3))
    for index in _hanging(mechanism, root):
        inertial = mechanism.bodies[index].inertial
        place = moved.position[:, index] + np.einsum("bik,k->bi", moved.rotation[:, index], inertial.centre)
        mass, moment = mass + inertial.mass, moment + inertial.mass * place
    return moment / mass, mass


def _hanging(mechanism: SpatialMechanism, root: int) -> list[int]:
    """Numbers of the bodies that hang on ``root``, itself among them."""
    hangs = [index == root for index in range(len(mechanism.bodies))]
    for index, body in enumerate(mechanism.bodies):
        hangs[index] |= body.parent != WORLD and hangs[body.parent]
    return [index for index, one in enumerate(hangs) if one]


def carried(mechanism: SpatialMechanism) -> list[bool]:
    """Whether each body is moved by any joint."""
    found: list[bool] = []
    for body in mechanism.bodies:
        found.append(bool(body.joints) or (body.parent != WORLD and found[body.parent]))
    return found


def rotations(q: Array) -> Array:
    """The rotation matrices (B, 3, 3) of quaternions (B, 4) (w, x, y, z) of any length but zero."""
    w, x, y, z = unit(q).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


class _State:
    """The frame in which the next joint acts, in every state of the batch, and what the last one did."""

    def __init__(self, rotation: Array, position: Array, angular: Array, linear: Array) -> None:
        self.rotation, self.position, self.angular, self.linear = rotation, position, angular, linear
        self.axis = self.pivot = np.zeros((len(rotation), 0, 3))

    def carry(self, place: Array, turn: Array) -> None:
        """On to a frame that is fixed in this one."""
        arm = self.rotation @ place
        self.position = self.position + arm
        self.linear = self.linear + np.cross(self.angular, arm)
        self.rotation = self.rotation @ turn

    def move(self, joint: Joint, q: Array, v: Array) -> None:
        """On through a joint."""
        if joint.kind == "free":
            self.position, self.rotation = q[:, :3], rotations(q[:, 3:])
            self.linear = v[:, :3]
            self.angular = np.einsum("bik,bk->bi", self.rotation, v[:, 3:])
            world = np.broadcast_to(np.eye(3), self.rotation.shape)
            self.axis = np.concatenate([world, np.swapaxes(self.rotation, -1, -2)], axis=1)
            self.pivot = np.repeat(self.position[:, None], 6, axis=1)
            return
        axis = unit(joint.axis) if joint.kind != "ball" else joint.axis
        if joint.kind == "slide":
            self.axis = (self.rotation @ axis)[:, None]
            self.position = self.position + (q - joint.ref) * self.axis[:, 0]
            # It slides along an axis that turns with what it slides on.
            self.linear = self.linear + (q - joint.ref) * np.cross(self.angular, self.axis[:, 0]) + v * self.axis[:, 0]
            self.pivot = self.position[:, None]
            return
        pivot = self.position + self.rotation @ joint.anchor
        at = self.linear + np.cross(self.angular, pivot - self.position)
        if joint.kind == "hinge":
            self.axis = (self.rotation @ axis)[:, None]
            half = (q[:, 0] - joint.ref) / 2
            turn = rotations(np.concatenate([np.cos(half)[:, None], np.sin(half)[:, None] * axis], axis=-1))
            self.rotation = self.rotation @ turn
        else:
            self.rotation = self.rotation @ rotations(q)
            self.axis = np.swapaxes(self.rotation, -1, -2)
        self.angular = self.angular + np.einsum("bk,bki->bi", v, self.axis)
        arm = self.rotation @ joint.anchor
        self.position = pivot - arm
        self.linear = at - np.cross(self.angular, arm)
        self.pivot = np.repeat(pivot[:, None], joint.freedoms, axis=1)


def _on_parent(found: Motion, parent: int, batch: int) -> _State:
    if parent == WORLD:
        nothing = np.zeros((batch, 3))
        return _State(np.tile(np.eye(3), (batch, 1, 1)), nothing, nothing, nothing)
    return _State(
        found.rotation[:, parent], found.position[:, parent], found.angular[:, parent], found.linear[:, parent]
    )
