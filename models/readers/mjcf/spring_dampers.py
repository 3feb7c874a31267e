"""MJCF's ``springdamper``: stiffness and damping of a joint from a time constant and a damping ratio.

They belong to the inertia that the joint feels in the reference configuration: 1/(M⁻¹)ᵢᵢ, with the mean of a ball's or
free joint's diagonal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ...errors import InvalidInput
from ...spatial import Pose
from ...spatial_mechanism import Joint, RigidBody
from ..attributes import Array


def with_spring_dampers(bodies: Sequence[RigidBody], given: Mapping[str, tuple[float, float]]) -> tuple[RigidBody, ...]:
    """The bodies, of whose joints those in ``given`` have the spring and damper of its time constant and ratio.

    Raises :class:`InvalidInput` where the mass matrix is singular.
    """
    if not given:
        return tuple(bodies)
    try:
        inverse = np.diag(np.linalg.inv(_mass_matrix(bodies)))
    except np.linalg.LinAlgError:
        raise InvalidInput("springdamper: the mass matrix is singular in the reference configuration") from None
    found, at = [], 0
    for body in bodies:
        joints = []
        for joint in body.joints:
            felt = 1 / float(inverse[at : at + joint.freedoms].mean())
            joints.append(_with(joint, felt, *given[joint.name]) if joint.name in given else joint)
            at += joint.freedoms
        found.append(replace(body, joints=tuple(joints)))
    return tuple(found)


def _with(joint: Joint, inertia: float, constant: float, ratio: float) -> Joint:
    return replace(joint, stiffness=inertia / (constant * ratio) ** 2, damping=2 * inertia / constant)


def _mass_matrix(bodies: Sequence[RigidBody]) -> Array:
    """The mass matrix (nv, nv) in the reference configuration, from each body's Jacobian about its centre of mass."""
    sizes = [joint.freedoms for body in bodies for joint in body.joints]
    freedoms = sum(sizes)
    matrix = np.diag([joint.armature for body in bodies for joint in body.joints for _ in range(joint.freedoms)])
    poses: list[Pose] = []
    turning: list[Array] = []  # (3, nv) angular velocity of each body by the rates
    moving: list[Array] = []  # (3, nv) velocity of the point of each body that is at the world's origin
    at = 0
    for body in bodies:
        here = body.pose
        w, v = np.zeros((3, freedoms)), np.zeros((3, freedoms))
        if body.parent >= 0:
            here = poses[body.parent] @ here
            w, v = turning[body.parent].copy(), moving[body.parent].copy()
        for joint in body.joints:
            angular, linear = _columns(joint, here)
            w[:, at : at + joint.freedoms] = angular
            v[:, at : at + joint.freedoms] = linear
            at += joint.freedoms
        poses.append(here)
        turning.append(w)
        moving.append(v)
        inertial = body.inertial.transformed(here)
        centre = v + np.cross(w.T, inertial.centre).T
        matrix = matrix + inertial.mass * centre.T @ centre + w.T @ inertial.tensor @ w
    return matrix


def _columns(joint: Joint, here: Pose) -> tuple[Array, Array]:
    """Angular velocity (3, k) by each rate of the joint, and velocity (3, k) of the body's point at the origin."""
    if joint.kind == "slide":
        axis = here.rotation @ (joint.axis / np.linalg.norm(joint.axis))
        return np.zeros((3, 1)), axis[:, None]
    if joint.kind == "hinge":
        angular = (here.rotation @ (joint.axis / np.linalg.norm(joint.axis)))[:, None]
    else:
        angular = here.rotation
    about = np.cross(here.point(joint.anchor), angular.T).T
    if joint.kind == "free":
        return np.hstack([np.zeros((3, 3)), angular]), np.hstack([np.eye(3), about])
    return angular, about
