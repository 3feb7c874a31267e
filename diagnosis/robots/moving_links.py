"""A mechanism's moving links, described so that two readings of one file can be compared whatever frames they use.

Bodies fixed to each other are one link. Everything is seen in world axes in one configuration, points relative to a
reference point that follows from the joints alone: the point of a hinge's axis that is closest to the parent's
reference point, a ball's anchor, a free body's own origin, for a slide the parent's.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...models.spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose, from_axis_angle, from_quaternion
from ...models.spatial_mechanism import WORLD, Array, Joint, SpatialMechanism


@dataclass(frozen=True, eq=False)
class SeenJoint:
    """A joint in world axes: ``axis`` (3,), and ``arm`` (3,) [m], from the reference point before it to its own.

    Zeros where they mean nothing: the axis of a ball or free joint, the arm of a slide or free joint.
    """

    joint: Joint
    axis: Array
    arm: Array


@dataclass
class MovingLink:
    """A link with the joints that move it.

    ``parent``: the index of its parent link, -1 for the world; ``turned``: its frame's axes in the world (3, 3);
    ``inertial``: that of all its bodies, in world axes, as seen from its reference point; ``bodies``: their names, its
    own first; ``meshes`` [kg m²]: the largest moments of the meshes that they are weighed by, added up.
    """

    parent: int
    joints: tuple[SeenJoint, ...]
    turned: Array
    inertial: Inertial = ZERO_INERTIAL
    bodies: list[str] = field(default_factory=list)
    meshes: float = 0.0

    @property
    def name(self) -> str:
        """The name of the body that its joints move."""
        return self.bodies[0]

    @property
    def key(self) -> str:
        """What it is recognised by in another reading: the name of its last joint."""
        return self.joints[-1].joint.name


def moving_links(mechanism: SpatialMechanism, q: Array | None = None) -> tuple[MovingLink, ...]:
    """The links in the bodies' order, in the configuration ``q`` (nq,), by default the reference configuration."""
    q = mechanism.reference if q is None else q
    placed = iter(mechanism.joints)
    links: list[MovingLink] = []
    points: list[Array] = []
    poses: list[Pose] = []
    link_of_body: list[int] = []
    for body in mechanism.bodies:
        at_world = body.parent == WORLD
        outer = IDENTITY if at_world else poses[body.parent]
        link = WORLD if at_world else link_of_body[body.parent]
        point = np.zeros(3) if link == WORLD else points[link]
        pose = outer @ body.pose
        seen = []
        for _ in body.joints:
            here = next(placed)
            pose, point, joint = _moved(pose, point, here.joint, q[here.columns_q])
            seen.append(joint)
        if seen:
            links.append(MovingLink(link, tuple(seen), pose.rotation))
            points.append(point)
            link = len(links) - 1
        poses.append(pose)
        link_of_body.append(link)
        if link != WORLD:
            at_point = Pose(pose.rotation, pose.translation - points[link])
            links[link].inertial = links[link].inertial + body.inertial.transformed(at_point)
            links[link].bodies.append(body.name)
            links[link].meshes += body.meshes
    return tuple(links)


def _moved(pose: Pose, point: Array, joint: Joint, q: Array) -> tuple[Pose, Array, SeenJoint]:
    """The body's pose and the reference point behind the joint, and the joint as it is seen."""
    none = np.zeros(3)
    if joint.kind == "free":
        pose = Pose(from_quaternion(q[3:]), np.array(q[:3], dtype=np.float64))
        return pose, pose.translation, SeenJoint(joint, none, none)
    anchor = pose.point(joint.anchor)
    if joint.kind == "ball":
        turned = pose.rotation @ from_quaternion(q)
        return Pose(turned, anchor - turned @ joint.anchor), anchor, SeenJoint(joint, none, anchor - point)
    axis = pose.rotation @ (joint.axis / np.linalg.norm(joint.axis))
    moved = float(q[0]) - joint.ref
    if joint.kind == "slide":
        return Pose(pose.rotation, pose.translation + moved * axis), point, SeenJoint(joint, axis, none)
    arm = anchor - point
    arm = arm - (arm @ axis) * axis
    turned = from_axis_angle(axis, moved) @ pose.rotation if moved else pose.rotation
    return Pose(turned, anchor - turned @ joint.anchor), point + arm, SeenJoint(joint, axis, arm)


def coordinates_of(names: SpatialMechanism, q: Array, other: SpatialMechanism) -> Array:
    """The configuration ``q`` (nq,) of ``names`` in the coordinates of ``other``, joint by joint of the same name.

    Joints that the first does not have, or has as another kind, stay at their reference.
    """
    found = other.reference.copy()
    known = {placed.joint.name: placed for placed in names.joints}
    for placed in other.joints:
        same = known.get(placed.joint.name)
        if same is not None and same.joint.kind == placed.joint.kind:
            found[placed.columns_q] = q[same.columns_q]
    return found
