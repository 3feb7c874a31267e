"""Writes a spatial mechanism as MJCF in which everything is said, and nothing that engines read differently."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np

from ..errors import InvalidInput
from ..spatial import Inertial, Pose, from_axis_angle, to_quaternion, unit
from ..spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from .explicit import placed_inertials, positive, row, unique_names
from .mjcf import DEEPEST, LEAST_INERTIA

SUPPORT = "furiko_support"
UNTURNED = np.array([1.0, 0.0, 0.0, 0.0])


def spatial_mjcf(mechanism: SpatialMechanism, model: str = "mechanism", *, raised: bool = True) -> str:
    """The mechanism as an MJCF document whose model is called ``model``.

    ``raised``: whether moments of zero are raised to the least that MuJoCo takes (``boundinertia``).

    Radians, no default classes, an explicit inertial for every body that has one, a name for everything, no geoms, so
    that nothing touches. Bodies without joints and with a pose are put in one without a pose where Pinocchio would drop
    it; a body with several joints stands in one that has its pose, which Drake would apply at the last joint, and the
    first of them has no ref, which Pinocchio would ignore; no body is called as Drake calls those that it makes of such
    joints; a free body beside others of the world has slides and a ball; a joint with armature has a motor, without
    which Drake would drop it. Raises :class:`InvalidInput` for inertials on which engines do not agree, and for more
    than 450 bodies one in the other.
    """
    if any(_free(body) for body in mechanism.bodies):
        mechanism = _free_by_slides(_without_scenery(mechanism))
    root = ElementTree.Element("mujoco", model=model)
    compiler = ElementTree.SubElement(root, "compiler", angle="radian", balanceinertia="false", autolimits="false")
    ElementTree.SubElement(root, "option", gravity=row(mechanism.gravity))
    inertials = placed_inertials(mechanism)
    if raised and any(i.mass > 0 and not positive(i) for i in inertials):
        compiler.set("boundinertia", repr(LEAST_INERTIA))  # MuJoCo refuses a point mass
    world = ElementTree.SubElement(root, "worldbody")
    names = unique_names(mechanism.bodies, "world", SUPPORT, besides=_names_besides)
    top = _top(world, mechanism)  # of bodies without a free joint, which must be on one of the world itself
    elements: list[ElementTree.Element] = []
    depths: list[int] = []
    for body, name, inertial in zip(mechanism.bodies, names, inertials, strict=True):
        parent = elements[body.parent] if body.parent != WORLD else world if _free(body) else top
        depths.append(1 if body.parent == WORLD else depths[body.parent] + 1 + (len(body.joints) > 1))
        if depths[-1] > DEEPEST - 2:
            raise InvalidInput(f"bodies {DEEPEST} deep: MJCF nests them, and its readers take no more")
        elements.append(_body(parent, body, name, inertial))
    motors = [joint for body in mechanism.bodies for joint in body.joints if joint.armature and joint.kind in _MOVED]
    if motors:
        actuators = ElementTree.SubElement(root, "actuator")
        for joint in motors:
            ElementTree.SubElement(actuators, "motor", name=f"{joint.name}_motor", joint=joint.name)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


_MOVED = ("hinge", "slide")


def _without_scenery(mechanism: SpatialMechanism) -> SpatialMechanism:
    """The mechanism without what neither moves nor carries anything that does, beside which Pinocchio would lose what
    is free."""
    bodies = mechanism.bodies
    moves: list[bool] = []
    for body in bodies:
        moves.append(bool(body.joints) or (body.parent != WORLD and moves[body.parent]))
    kept = list(moves)  # and what carries one of these
    for index, body in reversed([*enumerate(bodies)]):
        if kept[index] and body.parent != WORLD:
            kept[body.parent] = True
    places = np.cumsum(kept) - 1
    left = [
        replace(body, parent=body.parent if body.parent == WORLD else int(places[body.parent]))
        for body, stays in zip(bodies, kept, strict=True)
        if stays
    ]
    return replace(mechanism, bodies=tuple(left))


def _free_by_slides(mechanism: SpatialMechanism) -> SpatialMechanism:
    """The mechanism, in which a body that is free beside others of the world has three slides along the world's axes
    and a ball in place of its free joint.

    Pinocchio reads only the first body of the world, and MJCF takes a free joint nowhere else. The rates are the same:
    the velocity along the world's axes, the angular velocity in the body's. The slides are zero where the body is.
    """
    if sum(body.parent == WORLD for body in mechanism.bodies) < 2:
        return mechanism
    return replace(mechanism, bodies=tuple(_by_slides(body) if _free(body) else body for body in mechanism.bodies))


def _by_slides(body: RigidBody) -> RigidBody:
    (free,) = body.joints
    along = body.pose.rotation  # whose rows are the world's axes, seen from the body
    slides = [
        replace(free, name=f"{free.name}_{letter}", kind="slide", axis=axis, anchor=np.zeros(3))
        for letter, axis in zip("xyz", along, strict=True)
    ]
    ball = replace(free, name=f"{free.name}_turn", kind="ball", anchor=np.zeros(3))
    return replace(body, joints=(*slides, ball))


def _top(world: ElementTree.Element, mechanism: SpatialMechanism) -> ElementTree.Element:
    """Where the bodies of the world that have no free joint are put: in one body without a pose if Pinocchio would lose
    some of them, or the pose of the first; in their order in the world behind a free one, which alone it reads."""
    roots = [body for body in mechanism.bodies if body.parent == WORLD]
    if roots and _free(roots[0]):
        return world
    roots = [_without_first_ref(body) for body in roots if not _free(body)]
    first_is_fixed = bool(roots) and len(roots[0].joints) != 1  # with several joints, what it stands in is
    posed = first_is_fixed and (roots[0].position.any() or not _unturned(roots[0]))
    if not (len(roots) > 1 or posed):
        return world
    return ElementTree.SubElement(world, "body", name=SUPPORT)


def _names_besides(body: RigidBody, name: str) -> list[str]:
    """Of a body with several joints what it stands in, and what Drake makes of all joints but the last."""
    more = len(body.joints) - 1
    return [_frame(name), *(f"{name}{k}" for k in range(more))] if more > 0 else []


def _frame(name: str) -> str:
    return f"{name}_frame"


def _free(body: RigidBody) -> bool:
    return any(joint.kind == "free" for joint in body.joints)


def _unturned(body: RigidBody) -> bool:
    return not body.quaternion[1:].any() and bool(body.quaternion[0] > 0)


def _without_first_ref(body: RigidBody) -> RigidBody:
    """The body posed where it is at zero of its first joint, which then needs no ref; the others keep theirs.

    One with a single joint, whose ref is read, stays as it is.
    """
    if len(body.joints) < 2 or not body.joints[0].ref:
        return body
    first = body.joints[0]
    axis = unit(first.axis)
    if first.kind == "slide":
        back = Pose(np.eye(3), -first.ref * axis)
    else:
        turn = from_axis_angle(axis, -first.ref)
        back = Pose(turn, first.anchor - turn @ first.anchor)
    pose = body.pose @ back
    return replace(
        body,
        position=pose.translation,
        quaternion=to_quaternion(pose.rotation),
        joints=(replace(first, ref=0.0), *body.joints[1:]),
    )


def _body(parent: ElementTree.Element, body: RigidBody, name: str, inertial: Inertial) -> ElementTree.Element:
    body = _without_first_ref(body)
    pose = {"pos": row(body.position)}
    if not _unturned(body):
        pose["quat"] = row(unit(body.quaternion))
    if len(body.joints) > 1:
        parent = ElementTree.SubElement(parent, "body", {"name": _frame(name), **pose})
        pose = {"pos": "0 0 0"}
    element = ElementTree.SubElement(parent, "body", {"name": name, **pose})
    for joint in body.joints:
        ElementTree.SubElement(element, "joint", _joint(joint))
    if inertial.mass > 0:
        tensor = inertial.tensor
        given = {"pos": row(inertial.centre), "mass": row([inertial.mass])}
        if np.count_nonzero(tensor - np.diag(np.diag(tensor))) == 0:
            given["diaginertia"] = row(np.diag(tensor))
        elif not positive(inertial):  # which MuJoCo takes on principal axes alone
            moments, axes = np.linalg.eigh(tensor)
            axes = axes if np.linalg.det(axes) > 0 else -axes
            given |= {"diaginertia": row(np.maximum(moments, 0.0)), "quat": row(to_quaternion(axes))}
        else:
            given["fullinertia"] = row([*np.diag(tensor), tensor[0, 1], tensor[0, 2], tensor[1, 2]])
        ElementTree.SubElement(element, "inertial", given)
    return element


def _joint(joint: Joint) -> dict[str, str]:
    said = {"name": joint.name, "type": joint.kind}
    if joint.kind in _MOVED:
        said["axis"] = row(joint.axis)
    if joint.kind != "free":
        said["pos"] = row(joint.anchor)
    if joint.kind in _MOVED:
        said |= {"ref": row([joint.ref]), "springref": row([joint.springref])}
    for attribute, number in (
        ("armature", joint.armature),
        ("damping", joint.damping),
        ("frictionloss", joint.friction),
        ("stiffness", joint.stiffness),
    ):
        said[attribute] = row([number])
    if joint.limits is not None and joint.limits[0] < joint.limits[1]:  # MuJoCo refuses a range of nothing
        said |= {"limited": "true", "range": row(joint.limits)}
    elif joint.kind != "free":
        said["limited"] = "false"
    return said
