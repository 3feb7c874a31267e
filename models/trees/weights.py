"""What a mechanism's moving bodies weigh, with what is fixed to them: the limits of some engines are told from it."""

from __future__ import annotations

import numpy as np

from ..spatial import Inertial, unit
from ..spatial_mechanism import WORLD, Array, Joint, SpatialMechanism


def moved(mechanism: SpatialMechanism) -> tuple[tuple[str, float, float], ...]:
    """Each moving body: name, mass [kg], and its least inertia about a joint of its own, with the armature.

    About a hinge [kg m²], about a ball or free joint the smallest of all axes; infinite for slides alone.
    """
    bodies = mechanism.bodies
    inertials = [body.inertial for body in bodies]
    for index in range(len(bodies) - 1, -1, -1):
        body = bodies[index]
        if not body.joints and body.parent != WORLD:
            inertials[body.parent] = inertials[body.parent] + inertials[index].transformed(body.pose)
    return tuple(
        (body.name, float(inertial.mass), min((_about(joint, inertial) for joint in body.joints), default=np.inf))
        for body, inertial in zip(bodies, inertials, strict=True)
        if body.joints
    )


def _about(joint: Joint, inertial: Inertial) -> float:
    if joint.kind == "slide":
        return np.inf
    tensor: Array = inertial.tensor_about(np.zeros(3) if joint.kind == "free" else joint.anchor)
    if joint.kind == "hinge":
        axis = unit(joint.axis)
        return float(axis @ tensor @ axis) + joint.armature
    return float(np.linalg.eigvalsh(tensor)[0]) + joint.armature
