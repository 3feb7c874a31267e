"""Drake's own reading of a user's MJCF or URDF, any open mechanism, and its dynamics. An optional extra.

* Forward dynamics is that of a plant in continuous time, which applies the damping of joints and the reflected inertia
  of actuators. It knows neither contacts, here, nor limits, dry friction, springs or controllers of actuators.
* Joint couplings, which its URDF reader makes of mimic joints, are taken out: continuous time refuses them.
* The root link of a URDF is welded to the world, where Drake leaves it free.
* A link under a floating joint of a URDF is free in the world; the joint's name and origin are lost.
* Of several joints of an MJCF's body all but the last move massless bodies, ``body0``, ``body1`` …; here they are
  joints of the one body again.
* An MJCF without a model name, which Drake refuses, gets one by a model directive.
* Meshes are read only where the file says they are.
"""

from __future__ import annotations

import json
import logging
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ...models.readers.xml_file import read_xml
from ...models.spatial import Inertial, to_quaternion
from ...models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from ..protocol import Array
from ..quiet import silenced
from .robot_coordinates import Block, EngineState, RobotCoordinates
from .robot_joints import HeldJoint, joints_of, match, named_alike, unique

# Drake is a C++ extension: Any, here and nowhere else. Its module "all" would import matplotlib.
plants: Any = import_module("pydrake.multibody.plant")
parsing: Any = import_module("pydrake.multibody.parsing")
trees: Any = import_module("pydrake.multibody.tree")

KINDS = {
    "RevoluteJoint": ("hinge",),
    "PrismaticJoint": ("slide",),
    "BallRpyJoint": ("ball",),
    "QuaternionFloatingJoint": ("free",),
    "PlanarJoint": ("slide", "slide", "hinge"),
}
WAYS = {"BallRpyJoint": "roll-pitch-yaw", "QuaternionFloatingJoint": "free-in-world", "PlanarJoint": "plane"}
WELDED = "WeldJoint"


@dataclass(frozen=True)
class _Part:
    """A joint of the plant: the index of the file's body that it moves, and what it is for a mechanism."""

    joint: Any
    body: int
    held: tuple[HeldJoint, ...]

    @property
    def type(self) -> str:
        """The name of its class in Drake."""
        return type(self.joint).__name__


class DrakeRobot:
    """The file in Drake."""

    def __init__(self, path: Path, language: str, folders: Sequence[Path] = ()) -> None:
        with _quiet():
            self._plant = _parsed(path, language)
            for link in _roots(path) if language == "urdf" else ():
                if self._plant.HasBodyNamed(link):
                    self._plant.WeldFrames(self._plant.world_frame(), self._plant.GetBodyByName(link).body_frame())
            for constraint in self._plant.GetConstraintIds():
                self._plant.RemoveConstraint(constraint)
            self._plant.Finalize()
            self._context = self._plant.CreateDefaultContext()
        joints = (self._plant.get_joint(index) for index in self._plant.GetJointIndices())
        self._inboard = {int(joint.child_body().index()): joint for joint in joints}
        chains = {body: self._chain(body, language) for body in self._inboard}
        between = {int(joint.parent_body().index()) for chain in chains.values() for joint in chain[1:]}
        self._chains = {body: chains[body] for body in self._depth_first() if body not in between}
        self._parts = [part for body, chain in self._chains.items() for part in self._held(body, chain)]

    def _chain(self, body: int, language: str) -> list[Any]:
        """The joints of a body of the file, with those that move the massless bodies before it, ``body0`` …"""
        chain, name = [self._inboard[body]], re.escape(self._body(body).name())
        numbers: list[int] = []
        while language == "mjcf":
            before = chain[0].parent_body()
            number = re.fullmatch(name + r"(\d{1,4})", before.name())
            if number is None or before.default_mass():
                break
            numbers.insert(0, int(number[1]))
            chain.insert(0, self._inboard[int(before.index())])
        return chain if numbers == list(range(len(numbers))) else chain[-1:]

    def _depth_first(self, body: int = 0) -> Iterator[int]:
        """Indices of the bodies that hang on ``body``, parents before children, in the plant's order."""
        for child, joint in sorted(self._inboard.items()):
            if joint.parent_body().index() == body:
                yield child
                yield from self._depth_first(child)

    def _body(self, index: int) -> Any:
        return self._plant.get_body(trees.BodyIndex(index))

    def _held(self, body: int, chain: Sequence[Any]) -> Iterator[_Part]:
        """Drake makes the name ``parent-child`` of a joint without one, and names no free joint."""
        for joint in chain:
            kind = type(joint).__name__
            if kind == WELDED:
                continue
            if kind not in KINDS:
                raise ValueError(f"Drake has a joint {joint.name()!r} of type {kind}, which furiko does not know")
            own = "" if joint.is_ephemeral() else joint.name()
            made = own == f"{joint.parent_body().name()}-{joint.child_body().name()}"
            yield _Part(
                joint, body, joints_of(KINDS[kind], HeldJoint(own, kind, self._body(body).name(), joint.name(), made))
            )

    def joints(self) -> tuple[str, ...]:
        return tuple(unique(held.shown for part in self._parts for held in part.held))

    def compiled(self, like: SpatialMechanism | None = None) -> SpatialMechanism:
        """Poses are those at the default positions, which for an MJCF are each joint's ``ref``."""
        plant, names = self._plant, iter(self.joints())
        at = {int(trees.world_index()): WORLD}
        bodies: list[RigidBody] = []
        for body, chain in self._chains.items():
            parent = int(chain[0].parent_body().index())
            pose = self._pose(self._body(parent).body_frame(), self._body(body).body_frame())
            joints = tuple(self._made(body, names))
            quaternion = to_quaternion(np.array(pose.rotation().matrix()))
            inertial = _inertial(self._body(body).default_spatial_inertia())
            at[body] = len(bodies)
            position = np.array(pose.translation())
            bodies.append(RigidBody(self._body(body).name(), at[parent], position, quaternion, joints, inertial))
        if like is not None:
            bodies = named_alike(bodies, [held for part in self._parts for held in part.held], like)
        return SpatialMechanism(tuple(bodies), np.array(plant.gravity_field().gravity_vector()))

    def _pose(self, outer: Any, inner: Any) -> Any:
        return self._plant.CalcRelativeTransform(self._context, outer, inner)

    def _made(self, body: int, names: Iterator[str]) -> Iterator[Joint]:
        armature = self._armature()
        for part in (part for part in self._parts if part.body == body):
            joint = part.joint
            moved = self._pose(self._body(body).body_frame(), joint.frame_on_child())
            damping, start = joint.default_damping_vector(), joint.default_positions()
            low, high = joint.position_lower_limits(), joint.position_upper_limits()
            for k, held in enumerate(part.held):
                single = held.kind in {"hinge", "slide"}
                yield Joint(
                    name=next(names),
                    kind=held.kind,
                    axis=np.array(moved.rotation().matrix()) @ _axis(joint, k),
                    anchor=np.array(moved.translation()) if held.kind != "free" else np.zeros(3),
                    ref=float(start[k]) if single else 0.0,
                    armature=armature.get(int(joint.index()), 0.0),
                    damping=float(damping[k]),
                    limits=(float(low[k]), float(high[k])) if single and np.isfinite([low[k], high[k]]).all() else None,
                )

    def _armature(self) -> dict[int, float]:
        """The reflected inertia of the actuators of each joint."""
        found: dict[int, float] = {}
        for index in self._plant.GetJointActuatorIndices():
            actuator = self._plant.get_joint_actuator(index)
            joint = int(actuator.joint().index())
            found[joint] = found.get(joint, 0.0) + float(actuator.default_reflected_inertia())
        return found

    def bind(self, mechanism: SpatialMechanism) -> BoundDrake:
        held = [held for part in self._parts for held in part.held]
        ours = {j: i for i, j in enumerate(match(mechanism, held, "Drake"))}
        blocks, at = [], 0
        for part in self._parts:
            joints = tuple(ours[at + k] for k in range(len(part.held)))
            at += len(joints)
            blocks.append(
                Block(
                    joints,
                    WAYS.get(part.type, "same"),
                    int(part.joint.position_start()),
                    int(part.joint.velocity_start()),
                    plane=self._plane(mechanism, joints, part) if part.type == "PlanarJoint" else np.eye(2),
                )
            )
        return BoundDrake(self._plant, RobotCoordinates(mechanism, blocks, int(self._plant.num_positions())))

    def _plane(self, mechanism: SpatialMechanism, joints: Sequence[int], part: _Part) -> Array:
        """From a planar joint's two slides to Drake's own directions in that plane; as they are if it is another."""
        moved = self._pose(self._body(part.body).body_frame(), part.joint.frame_on_child())
        theirs = np.array(moved.rotation().matrix())[:, :2]
        axes = [mechanism.joints[index].joint.axis for index in joints[:2]]
        plane = theirs.T @ np.stack([axis / np.linalg.norm(axis) for axis in axes], axis=1)
        return plane if np.allclose(plane @ plane.T, np.eye(2), rtol=0, atol=1e-9) else np.eye(2)


class BoundDrake:
    """Drake's plant, asked in a mechanism's coordinates."""

    def __init__(self, plant: Any, coordinates: RobotCoordinates) -> None:
        self._plant, self._coordinates = plant, coordinates
        self._context = plant.CreateDefaultContext()
        self._joints = [plant.get_joint(index) for index in plant.GetJointIndices()]

    def mass_matrix(self, q: Array) -> Array:
        nv = int(self._plant.num_velocities())
        states = self._states(q, np.zeros((len(q), nv)))
        found = [state.our_matrix(self._plant.CalcMassMatrix(self._context)) for state in states]
        return np.array(found).reshape(len(q), nv, nv)

    def bias(self, q: Array, v: Array) -> Array:
        plant, context, found = self._plant, self._context, np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            found[row] = state.ours(plant.CalcBiasTerm(context) - plant.CalcGravityGeneralizedForces(context))
        return found

    def passive(self, q: Array, v: Array) -> Array:
        found = np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            forces = trees.MultibodyForces(self._plant)
            for joint in self._joints:
                joint.AddInDamping(self._context, forces)
            found[row] = state.ours(np.array(forces.generalized_forces()))
        return found

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        port, found = self._plant.get_applied_generalized_force_input_port(), np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            port.FixValue(self._context, state.theirs(torque[row]))
            derivatives = self._plant.EvalTimeDerivatives(self._context)
            found[row] = state.ours(derivatives.get_generalized_velocity().CopyToVector())
        return found

    def _states(self, q: Array, v: Array) -> Iterator[EngineState]:
        """Each row's state, written into the context."""
        for positions, rates in zip(q, v, strict=True):
            state = self._coordinates.state(positions, rates)
            self._plant.SetPositions(self._context, state.positions)
            self._plant.SetVelocities(self._context, state.rates)
            yield state


def _parsed(path: Path, language: str) -> Any:
    plant = plants.MultibodyPlant(time_step=0.0)
    suffix = {"urdf": ".urdf", "mjcf": ".xml"}[language]
    try:
        if path.suffix.lower() == suffix:
            parsing.Parser(plant).AddModels(str(path))
        else:  # which Drake would not know; files beside it are not found
            parsing.Parser(plant).AddModelsFromString(path.read_text(encoding="utf-8"), suffix[1:])
    except RuntimeError as error:
        if "must have a name attribute" not in str(error) or path.suffix.lower() != suffix:
            raise
        plant = plants.MultibodyPlant(time_step=0.0)
        directive = {"directives": [{"add_model": {"file": f"file://{path.resolve()}", "name": "furiko"}}]}
        parsing.Parser(plant).AddModelsFromString(json.dumps(directive), "dmd.yaml")
    return plant


def _roots(path: Path) -> list[str]:
    """Links of a URDF that are no joint's child, apart from ``world``, which Drake welds itself."""
    robot = read_xml(path)
    children = {child.get("link") for joint in robot.all("joint") for child in joint.all("child")}
    return [link.get("name") for link in robot.all("link") if link.get("name") not in {*children, "world"}]


def _axis(joint: Any, freedom: int) -> Array:
    """The axis (3,) of a hinge or slide in the frame that it moves; ``freedom``: which of a planar joint's."""
    if hasattr(joint, "revolute_axis"):
        return np.array(joint.revolute_axis(), dtype=np.float64)
    if hasattr(joint, "translation_axis"):
        return np.array(joint.translation_axis(), dtype=np.float64)
    return np.asarray(np.eye(3)[freedom if isinstance(joint, trees.PlanarJoint) else 2])


def _inertial(inertia: Any) -> Inertial:
    """From Drake's spatial inertia, whose tensor is about the body's origin."""
    centre = np.array(inertia.get_com())
    tensor = np.array(inertia.Shift(centre).CalcRotationalInertia().CopyToFullMatrix3())
    return Inertial(float(inertia.get_mass()), centre, tensor)


@contextmanager
def _quiet() -> Iterator[None]:
    """Without Drake's warnings, which go to Python's logger ``drake``, and what it prints past Python."""
    logger = logging.getLogger("drake")
    kept, logger.disabled = logger.disabled, True
    try:
        with silenced():
            yield
    finally:
        logger.disabled = kept
