"""Gives the joints of links that weigh nothing to what they carry: MuJoCo refuses links that move and weigh nothing.

Robots' files have such links between the axes of one shoulder, or between the wheels' directions of a base. In MJCF a
body has several joints, and then the links between them need not be there. At an end nothing says how such a link
moves, and everything else moves as without it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..spatial import Pose, to_quaternion
from ..spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism

MERGED = ("hinge", "slide")
MOST_FREEDOMS = 6  # of one body in MuJoCo


def without_weightless_links(mechanism: SpatialMechanism) -> tuple[SpatialMechanism, tuple[str, ...]]:
    """The mechanism without the links that weigh nothing and carry one other, which has their joints before its own.

    Hinges and slides alone, and at most :data:`MOST_FREEDOMS` a body. Bodies fixed to such a link are left out with it.
    The second is the names of the bodies that are left out.
    """
    left: list[str] = []
    while (step := _first_merged(mechanism)) is not None:
        mechanism, names = step
        left += names
    return mechanism, tuple(left)


def without_idle_joints(mechanism: SpatialMechanism) -> tuple[SpatialMechanism, tuple[str, ...]]:
    """The mechanism, in which links that weigh nothing and carry none that moves are fixed where they are.

    Not those whose joints have armature, which says how they move. The second is the names of the joints that are gone;
    none where no joint would be left.
    """
    bodies, gone = list(mechanism.bodies), []
    while (index := _idle(bodies)) is not None:
        gone += [joint.name for joint in bodies[index].joints]
        bodies[index] = _fixed(bodies[index])
    if not any(body.joints for body in bodies):
        return mechanism, ()
    return replace(mechanism, bodies=tuple(bodies)), tuple(gone)


def _idle(bodies: Sequence[RigidBody]) -> int | None:
    """The last body whose joints move nothing that weighs; None where there is none."""
    links = _links(bodies)
    for index in reversed(range(len(bodies))):
        body = bodies[index]
        members = [k for k, link in enumerate(links) if link == index]
        carries = any(other.joints and other.parent in members for other in bodies)
        if not body.joints or carries or any(joint.armature for joint in body.joints):
            continue
        if all(bodies[k].inertial.weightless for k in members):
            return index
    return None


def _fixed(body: RigidBody) -> RigidBody:
    """The body without its joints, in its reference configuration: where a joint's ``ref`` is, nothing has moved."""
    return replace(body, joints=())


def _first_merged(mechanism: SpatialMechanism) -> tuple[SpatialMechanism, list[str]] | None:
    """One link less, the last that can go, and the names of its bodies; None where there is none."""
    bodies = mechanism.bodies
    links = _links(bodies)
    for index in reversed(range(len(bodies))):
        members = [k for k, link in enumerate(links) if link == index]
        if not bodies[index].joints or not all(bodies[k].inertial.weightless for k in members):
            continue
        carried = [k for k, body in enumerate(bodies) if body.joints and body.parent in members]
        if len(carried) == 1 and _may_be_one(bodies[index], bodies[carried[0]]):
            (child,) = carried
            merged = _with_joints_of(bodies, index, child)
            return _without(mechanism, members, {child: merged}), [bodies[k].name for k in members]
    return None


def _links(bodies: Sequence[RigidBody]) -> list[int]:
    """For each body the index of the one whose joints move it: its own, or that of what it is fixed to."""
    links: list[int] = []
    for index, body in enumerate(bodies):
        fixed_to = links[body.parent] if body.parent != WORLD else WORLD
        links.append(index if body.joints else fixed_to)
    return links


def _may_be_one(link: RigidBody, child: RigidBody) -> bool:
    joints = (*link.joints, *child.joints)
    return len(joints) <= MOST_FREEDOMS and all(joint.kind in MERGED for joint in joints)


def _with_joints_of(bodies: Sequence[RigidBody], link: int, child: int) -> RigidBody:
    """The ``child`` where the ``link`` has it, on what carries the link, with the joints of both."""
    pose, parent = bodies[child].pose, bodies[child].parent
    while parent != link:  # through bodies that are fixed to the link
        pose, parent = bodies[parent].pose @ pose, bodies[parent].parent
    whole = bodies[link].pose @ pose
    return replace(
        bodies[child],
        parent=bodies[link].parent,
        position=whole.translation,
        quaternion=to_quaternion(whole.rotation),
        joints=(*(_seen_from(pose, joint) for joint in bodies[link].joints), *bodies[child].joints),
    )


def _seen_from(pose: Pose, joint: Joint) -> Joint:
    """A joint of an outer frame, in the inner frame that has this ``pose`` there in the reference configuration."""
    to_inner = pose.rotation.T
    return replace(joint, axis=to_inner @ joint.axis, anchor=to_inner @ (joint.anchor - pose.translation))


def _without(mechanism: SpatialMechanism, gone: Sequence[int], changed: dict[int, RigidBody]) -> SpatialMechanism:
    kept = [index for index in range(len(mechanism.bodies)) if index not in gone]
    places = {WORLD: WORLD} | {index: place for place, index in enumerate(kept)}
    bodies = [changed.get(index, mechanism.bodies[index]) for index in kept]
    return replace(mechanism, bodies=tuple(replace(body, parent=places[body.parent]) for body in bodies))
