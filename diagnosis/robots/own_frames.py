"""Two readings held together body by body, each number in the body's own frame, as a file writes it.

Where both use the same frames, one number that is wrong is one difference, whatever it moves: a body that is placed
otherwise carries its joint, its centre of mass and all that hangs on it along.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...models.spatial import IDENTITY, ZERO_INERTIAL, Pose, from_quaternion, to_quaternion
from ...models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from .numbers import (
    SAME,
    FieldDifference,
    axis_difference,
    coordinate_difference,
    inertial_differences,
    joint_numbers,
    plain,
    uncertain_tensor,
)

SINGLE = ("hinge", "slide")


def own_frame_differences(
    found: SpatialMechanism,
    expected: SpatialMechanism,
    length: float,
    *,
    limits: bool = False,
    ignored: frozenset[str] = frozenset(),
    mesh_axes: float = 0.0,
) -> list[FieldDifference] | None:
    """What the bodies have otherwise than those of ``expected``, without gravity; None where they are not the same.

    They are the same with the same names, joints and parents; an engine may have joined bodies that are fixed to each
    other. ``length`` [m]: of the mechanism, which distances are held against; the rest is as in
    :func:`.fields.field_differences`.
    """
    if any(len({body.name for body in m.bodies}) < len(m.bodies) for m in (found, expected)):
        return None  # it is not known which body is which
    merged = merged_like(expected, found)
    for theirs, ours in ((found, merged), (fixed_to_moving(found), fixed_to_moving(merged))):
        if _structure(theirs) == _structure(ours):
            return list(_differences(theirs, ours, length, limits, ignored, mesh_axes))
    return None


def merged_like(expected: SpatialMechanism, found: SpatialMechanism) -> SpatialMechanism:
    """``expected``, with the fixed bodies that ``found`` does not have, or has without mass, weighed with their parent.

    Those that it does not have are left out. Engines join bodies that are fixed to each other; some keep the frames.
    """
    theirs = {body.name: body.inertial for body in found.bodies}
    bodies = list(expected.bodies)
    for index, body in reversed([*enumerate(bodies)]):
        if body.joints or not theirs.get(body.name, ZERO_INERTIAL).weightless:
            continue
        whole = bodies[index]
        if body.parent != WORLD:
            above = bodies[body.parent]
            inertial = above.inertial + whole.inertial.transformed(body.pose)
            bodies[body.parent] = replace(above, inertial=inertial, meshes=above.meshes + whole.meshes)
        bodies[index] = replace(whole, inertial=ZERO_INERTIAL, meshes=0.0)
    missing = {body.name for body in bodies if not body.joints and body.name not in theirs}
    return replace(expected, bodies=tuple(_hung_on(bodies, missing, missing)))


def fixed_to_moving(mechanism: SpatialMechanism) -> SpatialMechanism:
    """The same mechanism, whose bodies hang on the ones that joints move, or in the world: none on a fixed one."""
    fixed = {body.name for body in mechanism.bodies if not body.joints}
    return replace(mechanism, bodies=tuple(_hung_on(mechanism.bodies, fixed, set())))


def _hung_on(bodies: Sequence[RigidBody], fixed: set[str], left_out: set[str]) -> Iterator[RigidBody]:
    """The bodies, but for those ``left_out``; those that hang on a ``fixed`` one hang on what that one hangs on."""
    placed: list[tuple[int, Pose]] = []  # by body: which of those that are kept carries what hangs on it, and where
    kept = 0
    for body in bodies:
        parent, outer = placed[body.parent] if body.parent != WORLD else (WORLD, IDENTITY)
        placed.append((parent, outer @ body.pose) if body.name in fixed else (kept, IDENTITY))
        if body.name in left_out:
            continue
        kept += 1
        if outer is IDENTITY:
            yield replace(body, parent=parent)
        else:
            pose = outer @ body.pose
            yield replace(body, parent=parent, position=pose.translation, quaternion=to_quaternion(pose.rotation))


def _structure(mechanism: SpatialMechanism) -> list[tuple[str, str, list[tuple[str, str]]]]:
    bodies = mechanism.bodies
    above = {index: body.name for index, body in enumerate(bodies)} | {WORLD: None}
    rows = [(b.name, above[b.parent] or "", [(joint.name, joint.kind) for joint in b.joints]) for b in bodies]
    return sorted(rows)


def _differences(
    found: SpatialMechanism,
    expected: SpatialMechanism,
    length: float,
    limits: bool,
    ignored: frozenset[str],
    mesh_axes: float,
) -> Iterator[FieldDifference]:
    theirs = {body.name: body for body in found.bodies}
    moves = _moving(expected)
    matters = _carrying(expected, moves)
    for index, body in enumerate(expected.bodies):
        other = theirs[body.name]
        if matters[index]:
            yield from _placements(other, body, length)
        for one, joint in zip(other.joints, body.joints, strict=True):
            yield from joint_numbers(one, joint, limits, ignored)
        if moves[index]:
            where, uncertain = f"link {body.name!r}", uncertain_tensor(mesh_axes, body.meshes)
            yield from inertial_differences(other.inertial, body.inertial, where, np.eye(3), length, uncertain)


def _moving(mechanism: SpatialMechanism) -> list[bool]:
    """Of each body, whether a joint moves it."""
    moves: list[bool] = []
    for body in mechanism.bodies:
        moves.append(bool(body.joints) or (body.parent != WORLD and moves[body.parent]))
    return moves


def _carrying(mechanism: SpatialMechanism, moves: list[bool]) -> list[bool]:
    """Of each body, whether it has a joint, moves with a mass, or carries one that does: other places are no matter.

    ``moves``: of each, whether a joint moves it.
    """
    matters = [
        bool(body.joints) or (moving and not body.inertial.weightless)
        for body, moving in zip(mechanism.bodies, moves, strict=True)
    ]
    for index, body in reversed([*enumerate(mechanism.bodies)]):
        if matters[index] and body.parent != WORLD:
            matters[body.parent] = True
    return matters


def _placements(other: RigidBody, body: RigidBody, length: float) -> Iterator[FieldDifference]:
    """The body's pose and the axes and anchors of its joints."""
    kind, where = ("joint", f"joint {body.joints[0].name!r}") if body.joints else ("body", f"link {body.name!r}")
    if not (body.joints and body.joints[0].kind == "free"):  # which is where its coordinates say
        size = _displaced(other, body) / length
        if size > SAME:
            yield FieldDifference(
                f"{kind}-placement", where, "place", plain(other.position), plain(body.position), "m", size
            )
        size = float(np.linalg.norm(from_quaternion(other.quaternion) - from_quaternion(body.quaternion)))
        if size > SAME:
            theirs, ours = (plain(b.quaternion / np.linalg.norm(b.quaternion)) for b in (other, body))
            yield FieldDifference(f"{kind}-orientation", where, "orientation", theirs, ours, "", size)
    for one, joint in zip(other.joints, body.joints, strict=True):
        yield from _joint(one, joint, length)


def _displaced(other: RigidBody, body: RigidBody) -> float:
    """How far a body is from its place [m]: its origin or, if that is less, the point that its first joint turns about.

    A body that is only turned there has its origin elsewhere, and no other place.
    """
    anchor = body.joints[0].anchor if body.joints else np.zeros(3)
    origins = float(np.linalg.norm(other.position - body.position))
    return min(origins, float(np.linalg.norm(other.pose.point(anchor) - body.pose.point(anchor))))


def _joint(one: Joint, joint: Joint, length: float) -> Iterator[FieldDifference]:
    where, across = f"joint {joint.name!r}", one.anchor - joint.anchor
    if joint.kind in SINGLE:
        theirs, ours = (j.axis / np.linalg.norm(j.axis) for j in (one, joint))
        axis = axis_difference(theirs, ours, where, np.eye(3))
        if axis is not None:
            yield axis
        across = across - (across @ ours) * ours
        yield from coordinate_difference("joint-reference", "ref", one, joint)
    size = float(np.linalg.norm(across)) / length
    if joint.kind in ("hinge", "ball") and size > SAME:
        yield FieldDifference("joint-placement", where, "anchor", plain(one.anchor), plain(joint.anchor), "m", size)
