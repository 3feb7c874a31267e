"""Writes a spatial mechanism as URDF in which everything is said, and nothing that engines read differently."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidInput
from ..spatial import IDENTITY, Inertial, Pose, components, from_axis_angle, unit
from ..spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from .explicit import placed_inertials, positive, row, unique_names
from .urdf import NO_LIMIT

Array = NDArray[np.float64]

GRAVITY = (0.0, 0.0, -9.81)
PLANAR = (("_TX", "slide"), ("_TY", "slide"), ("_RZ", "hinge"))  # the joints of a planar one, as MuJoCo names them
ORTHOGONAL = 1e-12  # the axes of a planar joint are this close to a right-handed frame: some thousands of roundings


def spatial_urdf(mechanism: SpatialMechanism, name: str = "mechanism") -> str:
    """The mechanism as a URDF document whose robot is called ``name``.

    Its root is the massless link ``world``, to which engines fix it. Joints have the mechanism's coordinates: a link's
    frame stands on its joint's anchor, and where the coordinate zero is, not the reference. A planar joint's axis is z,
    the only one that Pinocchio takes. Raises :class:`InvalidInput` naming the joint or body for what URDF cannot say
    (balls, armature, springs, another gravity than 9.81 m/s² along −z, damping of a free or planar joint, several
    joints on one body) and for inertials that engines do not agree on.
    """
    if tuple(mechanism.gravity) != GRAVITY:
        raise InvalidInput(f"gravity {row(mechanism.gravity)}: URDF cannot say it; engines take 9.81 m/s² along −z")
    robot = ElementTree.Element("robot", name=name)
    inertials = placed_inertials(mechanism)
    for body, inertial in zip(mechanism.bodies, inertials, strict=True):
        if inertial.mass > 0 and not positive(inertial):
            raise InvalidInput(f"{body.where or body.name}: a moment of inertia is 0, which MuJoCo refuses in URDF")
    names = unique_names(mechanism.bodies, "world")
    ElementTree.SubElement(robot, "link", name="world")
    frames: list[Pose] = []  # of each link, in its body's frame
    for body, link, inertial in zip(mechanism.bodies, names, inertials, strict=True):
        frames.append(_frame(body))
        _link(robot, link, inertial.transformed(_inverse(frames[-1])))
        above = IDENTITY if body.parent == WORLD else frames[body.parent]
        place = _inverse(above) @ body.pose @ _at_zero(body) @ frames[-1]
        _joint(robot, body, link, "world" if body.parent == WORLD else names[body.parent], place)
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def _inverse(pose: Pose) -> Pose:
    return IDENTITY if pose is IDENTITY else Pose(pose.rotation.T, -(pose.rotation.T @ pose.translation))


def _frame(body: RigidBody) -> Pose:
    """The link's frame in its body's: on the joint's anchor, for a planar joint with its axes as well."""
    for joint in body.joints:
        _refuse_unsaid(joint)
    if not body.joints:
        return IDENTITY
    first = body.joints[0]
    if len(body.joints) > 1:
        axes = np.stack([unit(joint.axis) for joint in body.joints], axis=1)
        kinds = [(joint.name[-3:], joint.kind) for joint in body.joints]
        prefixes = {joint.name[:-3] for joint in body.joints}
        if kinds != list(PLANAR) or len(prefixes) > 1 or np.abs(axes.T @ axes - np.eye(3)).max() > ORTHOGONAL:
            raise InvalidInput(f"{body.where or body.name}: {len(body.joints)} joints on one body: URDF has one a link")
        if np.linalg.det(axes) < 0 or any(joint.ref or joint.damping or joint.friction for joint in body.joints):
            raise InvalidInput(f"{first.where or first.name}: a planar joint with ref or damping: URDF cannot say it")
        return Pose(axes, body.joints[2].anchor)
    if first.kind == "hinge" and first.anchor.any():
        return Pose(np.eye(3), first.anchor)
    return IDENTITY


def _at_zero(body: RigidBody) -> Pose:
    """Where the body's frame is at the coordinate zero, seen from where it is in the reference configuration."""
    if len(body.joints) != 1 or body.joints[0].ref == 0:
        return IDENTITY
    joint = body.joints[0]
    if joint.kind == "slide":
        return Pose(np.eye(3), -joint.ref * unit(joint.axis))
    turn = from_axis_angle(joint.axis, -joint.ref)
    return Pose(turn, joint.anchor - turn @ joint.anchor)


def _refuse_unsaid(joint: Joint) -> None:
    where = joint.where or joint.name
    if joint.kind == "ball":
        raise InvalidInput(f"{where}: a ball joint: URDF has none")
    for what, number in (("armature", joint.armature), ("stiffness", joint.stiffness)):
        if number:
            raise InvalidInput(f"{where}: {what} {number:g}: URDF cannot say it")
    if joint.kind == "free" and (joint.damping or joint.friction):
        raise InvalidInput(f"{where}: damping or friction of a free joint: URDF cannot say it")


def _link(robot: ElementTree.Element, name: str, inertial: Inertial) -> None:
    element = ElementTree.SubElement(robot, "link", name=name)
    if inertial.mass == 0:
        return
    said = ElementTree.SubElement(element, "inertial")
    ElementTree.SubElement(said, "origin", xyz=row(inertial.centre), rpy="0 0 0")
    ElementTree.SubElement(said, "mass", value=row([inertial.mass]))
    six = zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), components(inertial.tensor), strict=True)
    ElementTree.SubElement(said, "inertia", {key: row([value]) for key, value in six})


def _joint(robot: ElementTree.Element, body: RigidBody, link: str, parent: str, place: Pose) -> None:
    first = body.joints[0] if body.joints else None
    if first is None:
        name, kind = f"{link}_fixed", "fixed"
    elif len(body.joints) > 1:
        name, kind = first.name[:-3], "planar"
    else:
        turning = "continuous" if first.limits is None else "revolute"
        name, kind = first.name, {"hinge": turning, "slide": "prismatic", "free": "floating"}[first.kind]
    element = ElementTree.SubElement(robot, "joint", name=name, type=kind)
    ElementTree.SubElement(element, "parent", link=parent)
    ElementTree.SubElement(element, "child", link=link)
    ElementTree.SubElement(element, "origin", xyz=row(place.translation), rpy=row(_roll_pitch_yaw(place.rotation)))
    if kind == "planar":
        ElementTree.SubElement(element, "axis", xyz="0 0 1")
    if first is None or kind not in ("continuous", "revolute", "prismatic"):
        return
    ElementTree.SubElement(element, "axis", xyz=row(first.axis))
    if first.damping or first.friction:
        ElementTree.SubElement(element, "dynamics", damping=row([first.damping]), friction=row([first.friction]))
    if kind != "continuous":
        low, high = (f"-{NO_LIMIT}", NO_LIMIT) if first.limits is None else (row([x]) for x in first.limits)
        ElementTree.SubElement(element, "limit", lower=low, upper=high, effort=NO_LIMIT, velocity=NO_LIMIT)


def _roll_pitch_yaw(rotation: Array) -> tuple[float, float, float]:
    """The angles [rad] about the fixed x, y, z. Yaw is taken given roll, so that a pitch of a quarter turn is right."""
    r = rotation
    roll = math.atan2(r[2, 1], r[2, 2])
    pitch = math.atan2(-r[2, 0], math.hypot(r[2, 1], r[2, 2]))
    s, c = math.sin(roll), math.cos(roll)
    return roll, pitch, math.atan2(s * r[0, 2] - c * r[0, 1], c * r[1, 1] - s * r[1, 2])
