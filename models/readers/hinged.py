"""Bodies whose joints are all hinges, in the form from which planar mechanisms are projected."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import InvalidInput
from ..projection import Body, SpatialHinge
from ..spatial_mechanism import Joint, RigidBody


def hinged(bodies: Sequence[RigidBody]) -> list[Body]:
    """The same bodies. Raises :class:`InvalidInput` for a joint that is no hinge."""
    return [
        Body(
            body.name,
            body.parent,
            body.pose,
            tuple(map(_hinge, body.joints)),
            body.inertial,
            body.where,
        )
        for body in bodies
    ]


def _hinge(joint: Joint) -> SpatialHinge:
    if joint.kind != "hinge":
        raise InvalidInput(f"{joint.where}: a joint of type {joint.kind!r}: not a planar tree of hinges")
    limits = None if joint.limits is None else (joint.limits[0] - joint.ref, joint.limits[1] - joint.ref)
    return SpatialHinge(
        name=joint.name,
        axis=joint.axis,
        anchor=joint.anchor,
        armature=joint.armature,
        damping=joint.damping,
        friction=joint.friction,
        stiffness=joint.stiffness,
        rest=joint.springref - joint.ref,
        limits=limits,
        zero=joint.ref,
        where=joint.where,
    )
