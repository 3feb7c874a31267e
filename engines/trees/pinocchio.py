"""Pinocchio with an open mechanism, given to it joint by joint, or by its reader of MJCF (``PinocchioMjcfTree``).

Joint by joint:

* Each joint of a link is a joint of Pinocchio's, all but the last with no inertia; a joint's frame is at its anchor.
* A link's whole subtree is added before its next sibling's: ``crba`` takes the columns of a subtree to be neighbours.
* It has no ``ref``: angles and lengths are counted from there before they are handed on.

Either way:

* It holds dampers and applies none in ``aba``, and holds no springs: the adapter gives their forces as joint torques.
  For ``PinocchioCrbaTree`` the equation is M a = passive − bias, by ``crba``, ``rnea`` and NumPy's Cholesky factors.
* ``computeKineticEnergy`` counts the armature of joints about x, y or z and leaves that of others out (seen in 4.1.0):
  it is asked for the bodies alone, and ½ Σ armature v² is added.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ...models.errors import InvalidInput
from ...models.spatial import IDENTITY, Pose, unit
from ...models.spatial_mechanism import WORLD, Joint, SpatialMechanism
from ...models.writers.explicit import unique_names
from ...models.writers.spatial_mjcf import spatial_mjcf
from ..model_files.robot_coordinates import Block, RobotCoordinates
from ..model_files.robot_pinocchio import BoundPinocchio, PinocchioRobot
from ..pinocchio import both_triangles
from ..protocol import Array

# Pinocchio is a C++ extension without types: Any, here and nowhere else.
pinocchio: Any = import_module("pinocchio")

Links = list[tuple[int, Array]]
WAYS = {"hinge": "same", "slide": "same", "ball": "quaternion-last", "free": "free-in-body"}


class PinocchioAbaTree:
    """The mechanism in Pinocchio; accelerations by ``aba``.

    ``counts_from_reference``: whether the model's angles and lengths are zero in the reference configuration.
    """

    counts_from_reference = True

    def __init__(self, mechanism: SpatialMechanism) -> None:
        self._mechanism = mechanism
        self._model, self._coordinates, self._links = self._built(mechanism)
        self._bodies = self._model.copy()
        self._bodies.armature = np.zeros(mechanism.nv)
        self._data = self._model.createData()
        self._bound = BoundPinocchio(self._model, self._coordinates)
        single = [placed for placed in mechanism.joints if placed.joint.kind in ("hinge", "slide")]
        self._at_q, self._at_v = [placed.at_q for placed in single], [placed.at_v for placed in single]
        self._ref = np.array([placed.joint.ref for placed in single]) * self.counts_from_reference
        self._rest = np.array([placed.joint.springref for placed in single])
        self._stiffness = np.array([placed.joint.stiffness for placed in single])
        self._damping = mechanism.per_freedom("damping")
        self._armature = mechanism.per_freedom("armature")

    def _built(self, mechanism: SpatialMechanism) -> tuple[Any, RobotCoordinates, Links]:
        """The model, its coordinates for the mechanism's, and each moving link's joint and origin in its frame."""
        model, indices = _model(mechanism)
        blocks = [
            Block((k,), WAYS[placed.joint.kind], int(model.idx_qs[index]), int(model.idx_vs[index]))
            for k, (placed, index) in enumerate(zip(mechanism.joints, indices, strict=True))
        ]
        last = {placed.body: k for k, placed in enumerate(mechanism.joints)}
        links = [(indices[k], _origin(mechanism.joints[k].joint)) for _, k in sorted(last.items())]
        return model, RobotCoordinates(mechanism, blocks, int(model.nq)), links

    def accelerations(self, q: Array, v: Array) -> Array:
        return self._bound.accelerations(self._own(q), v, self.passive(q, v))

    def mass_matrix(self, q: Array) -> Array:
        found = self._bound.mass_matrix(self._own(q))
        upper = np.triu(np.ones(found.shape[1:], dtype=np.bool_))  # in some versions crba fills that triangle alone
        return np.where(upper, found, found.swapaxes(1, 2))

    def bias(self, q: Array, v: Array) -> Array:
        return self._bound.bias(self._own(q), v)

    def passive(self, q: Array, v: Array) -> Array:
        forces = -self._damping * v
        forces[:, self._at_v] -= self._stiffness * (q[:, self._at_q] - self._rest)
        return forces

    def derivatives(self, q: Array, v: Array) -> tuple[Array, Array]:
        """By ``computeABADerivatives``, at the torques of springs and dampers; these come in by M⁻¹ afterwards."""
        n, forces = self._mechanism.nv, self.passive(q, v)
        stiffness = np.zeros(n)
        stiffness[self._at_v] = self._stiffness
        found = np.empty((2, len(q), n, n))
        for row, (positions, rates, force) in enumerate(zip(self._own(q), v, forces, strict=True)):
            state = self._coordinates.state(positions, rates)
            torques = state.theirs(force)
            pinocchio.computeABADerivatives(self._model, self._data, state.positions, state.rates, torques)
            inverse = state.our_matrix(both_triangles(self._data.Minv))
            found[0, row] = state.our_matrix(self._data.ddq_dq) - inverse * stiffness
            found[1, row] = state.our_matrix(self._data.ddq_dv) - inverse * self._damping
        return found[0], found[1]

    def inverse_mass(self, q: Array) -> Array:
        n = self._mechanism.nv
        found = np.empty((len(q), n, n))
        for row, positions in enumerate(self._own(q)):
            state = self._coordinates.state(positions, np.zeros(n))
            inverse = pinocchio.computeMinverse(self._model, self._data, state.positions)
            found[row] = state.our_matrix(both_triangles(inverse))
        return found

    def joint_forces(self, q: Array, v: Array, a: Array) -> Array:
        model, data = self._model, self._data
        found = np.empty((len(q), len(self._links), 6))
        for row, (positions, rates, swings) in enumerate(zip(self._own(q), v, a, strict=True)):
            state = self._coordinates.state(positions, rates)
            pinocchio.rnea(model, data, state.positions, state.rates, state.theirs(swings) + state.drift)
            pinocchio.forwardKinematics(model, data, state.positions)
            for link, (joint, origin) in enumerate(self._links):
                # data.f: the force of the parent on the child about the joint's frame, in that one's axes.
                turn, wrench = data.oMi[joint].rotation, data.f[joint]
                found[row, link, :3] = -turn @ wrench.linear
                found[row, link, 3:] = -turn @ (wrench.angular - np.cross(origin, wrench.linear))
        return found

    def energy(self, q: Array, v: Array) -> Array:
        springs = self._stiffness * (q[:, self._at_q] - self._rest) ** 2 / 2
        found = np.stack([(self._armature * v**2).sum(axis=-1) / 2, springs.sum(axis=-1)], axis=-1)
        for row, (positions, rates) in enumerate(zip(self._own(q), v, strict=True)):
            state = self._coordinates.state(positions, rates)
            found[row, 0] += pinocchio.computeKineticEnergy(self._bodies, self._data, state.positions, state.rates)
            found[row, 1] += pinocchio.computePotentialEnergy(self._model, self._data, state.positions)
        return found

    def _own(self, q: Array) -> Array:
        """The same counted from the reference configuration."""
        own = q.copy()
        own[:, self._at_q] -= self._ref
        return own


class PinocchioCrbaTree(PinocchioAbaTree):
    """The mechanism in Pinocchio; accelerations from its mass matrix and its bias."""

    def accelerations(self, q: Array, v: Array) -> Array:
        right = self.passive(q, v) - self.bias(q, v)
        return _solved(self._factors(self.mass_matrix(q)), right)

    def _factors(self, mass: Array) -> Array:
        """L of each L Lᵀ = M, (B, n, n). Raises :class:`InvalidInput` where an M as computed has none."""
        try:
            return np.linalg.cholesky(mass).astype(np.float64)
        except np.linalg.LinAlgError:
            raise InvalidInput(self._without_factors(mass)) from None

    def _without_factors(self, mass: Array) -> str:
        """Which joint of which state moves nothing but rounding, and what to do, in a sentence."""
        state, freedom = next((k, i) for k, each in enumerate(mass) if (i := _first_without(each)) is not None)
        name = next(p.joint.name for p in reversed(self._mechanism.joints) if p.at_v <= freedom)
        return (
            f"pinocchio-crba: in state {state + 1} of {len(mass)} the mass matrix that it computes is not positive "
            f"definite: what joint {name!r} moves by itself, the others held, weighs less than rounding of the rest. "
            "Use pinocchio-aba, which forms no such matrix, or a pose farther from a singular one (two axes in line), "
            "or give the joint an armature"
        )

    def inverse_mass(self, q: Array) -> Array:
        n = self._mechanism.nv
        found = np.empty((len(q), n, n))
        for row, positions in enumerate(self._own(q)):
            state = self._coordinates.state(positions, np.zeros(n))
            pinocchio.crba(self._model, self._data, state.positions)
            pinocchio.cholesky.decompose(self._model, self._data)
            found[row] = state.our_matrix(pinocchio.cholesky.computeMinv(self._model, self._data))
        return found


def _first_without(mass: Array) -> int | None:
    """The first row up to which (n, n) ``mass`` has no Cholesky factors; None where it has all."""
    for i in range(len(mass)):
        try:
            np.linalg.cholesky(mass[: i + 1, : i + 1])
        except np.linalg.LinAlgError:
            return i
    return None


def _solved(factors: Array, right: Array) -> Array:
    """x of L Lᵀ x = ``right`` (B, n), by substitution: a general solver interchanges rows, which costs light links."""
    found = np.array(right, dtype=np.float64)
    n = found.shape[-1]
    for i in range(n):
        found[:, i] -= (factors[:, i, :i] * found[:, :i]).sum(axis=1)
        found[:, i] /= factors[:, i, i]
    for i in reversed(range(n)):
        found[:, i] -= (factors[:, i + 1 :, i] * found[:, i + 1 :]).sum(axis=1)
        found[:, i] /= factors[:, i, i]
    return found


class PinocchioMjcfTree(PinocchioAbaTree):
    """The mechanism as Pinocchio reads it from the MJCF that furiko writes; accelerations by ``aba``."""

    counts_from_reference = False

    def _built(self, mechanism: SpatialMechanism) -> tuple[Any, RobotCoordinates, Links]:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "mechanism.xml"
            # Pinocchio takes moments of zero, and raises those below a boundinertia.
            path.write_text(spatial_mjcf(mechanism, raised=False), encoding="utf-8")
            robot = PinocchioRobot(path, "mjcf")
        model, coordinates = robot.bound_to(mechanism)
        model.gravity.linear = mechanism.gravity  # its reader does not read it
        frames = {frame.name: frame for frame in model.frames if frame.type == pinocchio.FrameType.BODY}
        names = unique_names(mechanism.bodies, "world")
        moving = [frames[name] for name, body in zip(names, mechanism.bodies, strict=True) if body.joints]
        return model, coordinates, [(int(one.parentJoint), np.array(one.placement.translation)) for one in moving]


def _origin(joint: Joint) -> Array:
    """The origin (3,) of the frame of the link that this is the last joint of, in the joint's frame."""
    return np.zeros(3) if joint.kind == "free" else -joint.anchor


def _model(mechanism: SpatialMechanism) -> tuple[Any, list[int]]:
    """The model, and its index of each of the mechanism's joints."""
    model = pinocchio.Model()
    model.gravity.linear = mechanism.gravity
    first = {placed.body: k for k, placed in reversed(list(enumerate(mechanism.joints)))}
    indices = [0] * len(mechanism.joints)
    held: dict[int, tuple[int, Pose]] = {WORLD: (0, IDENTITY)}  # of each body: the joint it is fixed in, its pose there
    for b in _depth_first(mechanism):
        body = mechanism.bodies[b]
        joint, pose = held[body.parent]
        pose = pose @ body.pose
        for k, moving in enumerate(body.joints, start=first.get(b, 0)):
            free = moving.kind == "free"
            anchor = np.zeros(3) if free else moving.anchor
            placement = IDENTITY if free else pose @ Pose(np.eye(3), anchor)
            joint = indices[k] = model.addJoint(joint, _joint(moving), _se3(placement), f"joint{k}")
            pose = Pose(np.eye(3), -anchor)
        held[b] = joint, pose
        inertial = body.inertial
        if joint and not inertial.weightless:
            inertia = pinocchio.Inertia(float(inertial.mass), inertial.centre, inertial.tensor)
            model.appendBodyToJoint(joint, inertia, _se3(pose))
    armature = np.zeros(model.nv)
    for placed, index in zip(mechanism.joints, indices, strict=True):
        armature[model.idx_vs[index] :][: placed.joint.freedoms] = placed.joint.armature
    model.armature = armature
    return model, indices


def _depth_first(mechanism: SpatialMechanism) -> Iterator[int]:
    """Indices of the bodies, each before its children, and these before its next sibling."""
    children: dict[int, list[int]] = {}
    for b, body in enumerate(mechanism.bodies):
        children.setdefault(body.parent, []).append(b)
    left = children.get(WORLD, [])[::-1]
    while left:
        b = left.pop()
        yield b
        left += children.get(b, [])[::-1]


def _joint(joint: Joint) -> Any:
    if joint.kind == "free":
        return pinocchio.JointModelFreeFlyer()
    if joint.kind == "ball":
        return pinocchio.JointModelSpherical()
    axis = unit(joint.axis)
    for k, letter in enumerate("XYZ"):
        if axis[k] == 1:
            return getattr(pinocchio, f"JointModel{'R' if joint.kind == 'hinge' else 'P'}{letter}")()
    made = pinocchio.JointModelRevoluteUnaligned if joint.kind == "hinge" else pinocchio.JointModelPrismaticUnaligned
    return made(axis)


def _se3(pose: Pose) -> Any:
    return pinocchio.SE3(pose.rotation, pose.translation)
