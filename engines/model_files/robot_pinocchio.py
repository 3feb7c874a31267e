"""Pinocchio's own reading of a user's MJCF or URDF, any open mechanism, and its dynamics.

* Forward dynamics is the articulated-body algorithm, ``aba``. It applies the armature of every freedom, and neither
  damping nor dry friction, which the model holds: ``passive`` is zero.
* Several joints of one body of an MJCF are one composite joint, ``Composite_`` and the first's name.
* A free joint's armature acts on the velocity in the body's axes, MuJoCo's on that in the world's.
* Its MJCF reader does not read the file's gravity, and meshes are not read at all.
* Mimic joints of a URDF are left independent.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ...models.spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose, to_quaternion
from ...models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from ..protocol import Array
from ..quiet import overheard
from .robot_coordinates import Block, EngineState, RobotCoordinates
from .robot_joints import HeldJoint, joints_of, match, named_alike, unique

# Pinocchio is a C++ extension without types: Any, here and nowhere else.
pinocchio: Any = import_module("pinocchio")

KINDS = {"FreeFlyer": ("free",), "Spherical": ("ball",), "Planar": ("slide", "slide", "hinge")}
WAYS = {"FreeFlyer": "free-in-body", "Spherical": "quaternion-last", "Planar": "plane-in-body", "Unbounded": "pair"}
# The workspace that Pinocchio makes for any algorithm has several numbers for each three freedoms, some 37 bytes:
# 1.2 GB for 300 freedoms, 2.4 GB for 400, and minutes for 700.
MOST_FREEDOMS = 400
WRITTEN = re.compile(r"Error: +(.+)")
LIMIT = ". Instead, give <limit> both effort= and velocity="
ADVICE = {"effort": LIMIT, "velocity": LIMIT}  # by the last word of what the parser of URDF says
UNLIMITED = 1e300  # the largest limit that Pinocchio has for no limit is a little more


@dataclass(frozen=True)
class _Part:
    """A joint of the model, or one of a composite: ``placement`` in the frame that the one before it has moved.

    ``of``: the model's joint; ``held``: what it is for a mechanism, three joints where it is planar.
    """

    of: int
    joint: Any
    type: str
    placement: Pose
    at_q: int
    at_v: int
    held: tuple[HeldJoint, ...]


class PinocchioRobot:
    """The file in Pinocchio."""

    def __init__(self, path: Path, language: str, folders: Sequence[Path] = ()) -> None:
        build = pinocchio.buildModelFromUrdf if language == "urdf" else pinocchio.buildModelFromMJCF
        with overheard() as written:
            try:
                self._model = build(str(path))
            except (ValueError, RuntimeError) as error:  # where in Pinocchio's sources says nothing of the file
                raise ValueError(_why(str(error).rpartition("message:")[2].strip(), written())) from None
        if self._model.nv > MOST_FREEDOMS:
            gigabytes = 37e-9 * self._model.nv**3
            raise ValueError(
                f"Pinocchio's workspace for {self._model.nv} freedoms takes some {gigabytes:.0f} GB: it is not asked"
            )
        self._bodies = _body_frames(self._model)
        self._parts = tuple(self._all_parts())

    def _all_parts(self) -> Iterator[_Part]:
        model = self._model
        names = unique(model.names)
        for j in range(1, model.njoints):
            joint = model.joints[j]
            body = model.frames[self._bodies[j][0]].name if self._bodies[j] else ""
            placement = _pose(model.jointPlacements[j])
            if joint.shortname() != "JointModelComposite":
                held = _held(_type(joint), model.names[j], names[j], body)
                yield _Part(j, joint, _type(joint), placement, int(model.idx_qs[j]), int(model.idx_vs[j]), held)
                continue
            composite = joint.extract()
            first = model.names[j].removeprefix("Composite_")
            for k, (part, place) in enumerate(zip(composite.joints, composite.jointPlacements, strict=True)):
                own = first if k == 0 else ""
                held = _held(_type(part), own, own or f"{names[j]}[{k}]", body)
                at = placement @ _pose(place) if k == 0 else _pose(place)
                yield _Part(j, part, _type(part), at, int(part.idx_q), int(part.idx_v), held)

    def joints(self) -> tuple[str, ...]:
        return tuple(unique(held.shown for part in self._parts for held in part.held))

    def compiled(self, like: SpatialMechanism | None = None) -> SpatialMechanism:
        """Bodies are Pinocchio's frames of type BODY, the first of each joint with the inertial of all of that joint.

        A joint without such a frame (the second body of one name) moves a body of the joint's name. Coordinates of the
        reference are those of ``qpos0``, which the MJCF reader makes, and for a URDF zero.
        """
        model, names, reference = self._model, iter(self.joints()), self._reference()
        bodies: list[RigidBody] = []
        moving: dict[int, tuple[int, Pose]] = {0: (WORLD, IDENTITY)}  # each joint's first body, its pose in the joint
        for j in range(model.njoints):
            frames = [model.frames[f] for f in self._bodies[j]]
            parts = [part for part in self._parts if part.of == j]
            inertial = _inertial(model.inertias[j])
            parent, parents_pose = moving[int(model.parents[j])]
            to_joint = _inverse(parents_pose)
            for part in parts:
                to_joint = to_joint @ part.placement @ _moved(part.joint, reference)
            if j:
                own = _pose(frames[0].placement) if frames else IDENTITY
                moving[j] = len(bodies), own
                name = frames.pop(0).name if frames else model.names[j]
                joints = tuple(self._made(parts, own, reference, names))
                bodies.append(_body(name, parent, to_joint @ own, joints, inertial.transformed(_inverse(own))))
                inertial = ZERO_INERTIAL
            fixed_to, own = moving[j]
            for frame in frames:
                pose = _pose(frame.placement)
                its = inertial.transformed(_inverse(pose))
                bodies.append(_body(frame.name, fixed_to, _inverse(own) @ pose, (), its))
                inertial = ZERO_INERTIAL
        if like is not None:
            bodies = named_alike(bodies, [held for part in self._parts for held in part.held], like)
        return SpatialMechanism(tuple(bodies), model.gravity.linear.copy())

    def _reference(self) -> Array:
        """Coordinates (nq,) of the file's reference configuration."""
        known = {entry.key(): entry.data() for entry in self._model.referenceConfigurations}
        q = np.array(known.get("qpos0", pinocchio.neutral(self._model)), dtype=np.float64)
        return q if len(q) == self._model.nq else np.array(pinocchio.neutral(self._model))

    def _made(self, parts: Sequence[_Part], own: Pose, reference: Array, names: Iterator[str]) -> list[Joint]:
        """The joints of one body, whose pose in the frame that the last of them moves is ``own``."""
        model, after, poses = self._model, own, []
        for part in reversed(parts):
            poses.append(after)
            after = part.placement @ _moved(part.joint, reference) @ after
        made: list[Joint] = []
        for part, body in zip(parts, reversed(poses), strict=True):
            for k, held in enumerate(part.held):
                at_v = part.at_v + k
                single = held.kind in {"hinge", "slide"} and part.type not in {"Planar", "Unbounded"}
                low, high = (
                    (float(model.lowerPositionLimit[part.at_q]), float(model.upperPositionLimit[part.at_q]))
                    if single
                    else (-np.inf, np.inf)
                )
                made.append(
                    Joint(
                        name=next(names),
                        kind=held.kind,
                        axis=body.rotation.T @ _axis(part, k),
                        anchor=_inverse(body).translation if held.kind != "free" else np.zeros(3),
                        ref=float(reference[part.at_q]) if single else 0.0,
                        armature=float(model.armature[at_v]),
                        damping=float(model.damping[at_v]),
                        friction=float(model.friction[at_v]),
                        limits=(low, high) if max(abs(low), abs(high)) < UNLIMITED else None,
                    )
                )
        return made

    def bind(self, mechanism: SpatialMechanism) -> BoundPinocchio:
        return BoundPinocchio(*self.bound_to(mechanism))

    def bound_to(self, mechanism: SpatialMechanism) -> tuple[Any, RobotCoordinates]:
        """Pinocchio's model, and its coordinates for the mechanism's. Raises as :meth:`bind` does."""
        held = [(part, k) for part in self._parts for k in range(len(part.held))]
        order = match(mechanism, [part.held[k] for part, k in held], "Pinocchio")
        ours: dict[int, list[int]] = {}
        for i, j in enumerate(order):
            ours.setdefault(self._parts.index(held[j][0]), [-1] * len(held[j][0].held))[held[j][1]] = i
        blocks = [
            Block(tuple(ours[p]), WAYS.get(part.type, "same"), part.at_q, part.at_v, part.placement)
            for p, part in enumerate(self._parts)
        ]
        return self._model, RobotCoordinates(mechanism, blocks, int(self._model.nq))


class BoundPinocchio:
    """Pinocchio's model, asked in a mechanism's coordinates."""

    def __init__(self, model: Any, coordinates: RobotCoordinates) -> None:
        self._model, self._coordinates = model, coordinates
        self._data = model.createData()

    def mass_matrix(self, q: Array) -> Array:
        nv = int(self._model.nv)
        states = self._states(q, np.zeros((len(q), nv)))
        found = [state.our_matrix(pinocchio.crba(self._model, self._data, state.positions)) for state in states]
        return np.array(found).reshape(len(q), nv, nv)

    def bias(self, q: Array, v: Array) -> Array:
        found = [
            state.ours(pinocchio.rnea(self._model, self._data, state.positions, state.rates, state.drift))
            for state in self._states(q, v)
        ]
        return np.array(found).reshape(v.shape)

    def passive(self, q: Array, v: Array) -> Array:
        return np.zeros_like(v)

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        found = np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            forces = state.theirs(torque[row])
            own = pinocchio.aba(self._model, self._data, state.positions, state.rates, forces)
            found[row] = state.ours(own - state.drift)
        return found

    def _states(self, q: Array, v: Array) -> Iterator[EngineState]:
        return (self._coordinates.state(positions, rates) for positions, rates in zip(q, v, strict=True))


def _body_frames(model: Any) -> list[list[int]]:
    """For each joint the indices of its frames that are bodies of the file, in the model's order."""
    found: list[list[int]] = [[] for _ in range(model.njoints)]
    for index, frame in enumerate(model.frames):
        if frame.type == pinocchio.FrameType.BODY:
            found[int(frame.parentJoint)].append(index)
    return found


def _type(joint: Any) -> str:
    name = str(joint.shortname()).removeprefix("JointModel")
    if name in KINDS:
        return name
    for start, kind in (
        ("RUB", "Unbounded"),
        ("RevoluteUnbounded", "Unbounded"),
        ("R", "Revolute"),
        ("P", "Prismatic"),
    ):
        if name.startswith(start):
            return kind
    raise ValueError(f"Pinocchio has a joint of type {name}, which neither MJCF nor URDF has")


def _held(kind: str, name: str, shown: str, body: str) -> tuple[HeldJoint, ...]:
    """What a joint is for a mechanism. Pinocchio makes the names ``bodyJoint_k``, ``body_free``, ``parentBis``."""
    made = re.search(r"Joint_\d+$|_free$", name) is not None
    kinds = KINDS.get(kind, ("slide" if kind == "Prismatic" else "hinge",))
    name = name if made or not name else shown  # a second joint of one name is another one
    return joints_of(kinds, HeldJoint(name, kinds[0], "" if body.endswith("Bis") else body, shown, made))


def _axis(part: _Part, freedom: int) -> Array:
    """The axis (3,) of a hinge or slide in the frame that it moves; ``freedom``: which of a planar joint's."""
    if part.type == "Planar":
        return np.asarray(np.eye(3)[freedom])
    if part.type in {"FreeFlyer", "Spherical"}:
        return np.array([0.0, 0.0, 1.0])
    motion = np.asarray(part.joint.createData().S, dtype=np.float64).reshape(6)
    return motion[:3] if part.type == "Prismatic" else motion[3:]


def _moved(joint: Any, q: Array) -> Pose:
    """The pose of the frame that a joint moves in that where it starts, at the model's coordinates q (nq,)."""
    data = joint.createData()
    joint.calc(data, q)
    return _pose(data.M)


def _pose(placement: Any) -> Pose:
    return Pose(np.array(placement.rotation), np.array(placement.translation))


def _inverse(pose: Pose) -> Pose:
    return Pose(pose.rotation.T, -pose.rotation.T @ pose.translation)


def _why(message: str, written: str) -> str:
    """Why Pinocchio does not read the file: what its parser of URDF writes first, whose error names the file alone."""
    said = WRITTEN.search(written)
    if said is None or not message.endswith("a valid URDF model."):
        return message
    return f"no valid URDF for its parser: {said[1].strip()}{ADVICE.get(said[1].split()[-1], '')}"


def _inertial(inertia: Any) -> Inertial:
    return Inertial(float(inertia.mass), np.array(inertia.lever), np.array(inertia.inertia))


def _body(name: str, parent: int, pose: Pose, joints: tuple[Joint, ...], inertial: Inertial) -> RigidBody:
    return RigidBody(name, parent, pose.translation, to_quaternion(pose.rotation), joints, inertial)
