"""How far springs are from rest, and the forces of those that hold a body in all its turns."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....models.spatial_mechanism import Array, PlacedJoint, SpatialMechanism

Wide = NDArray[Any]


def stretches(mechanism: SpatialMechanism, placed: PlacedJoint, q: Wide) -> Wide:
    """How far a joint's spring is from rest at coordinates (B, nq), for each degree of freedom (B, …) [m or rad]."""
    joint, here = placed.joint, q[:, placed.columns_q]
    if joint.kind in ("hinge", "slide"):
        return here - joint.springref
    if joint.kind == "ball":
        return _rotation_vectors(np.array([1.0, 0.0, 0.0, 0.0]), here)
    rest = mechanism.bodies[placed.body]
    return np.concatenate([here[:, :3] - rest.position, _rotation_vectors(rest.quaternion, here[:, 3:])], axis=-1)


def sprung(mechanism: SpatialMechanism, q: Wide, torque: Wide | None) -> Wide | None:
    """The torques (B, nv), and those of springs that the formulas leave out: of balls and free joints."""
    for placed in mechanism.joints:
        if placed.joint.kind in ("ball", "free") and placed.joint.stiffness:
            torque = np.zeros((len(q), mechanism.nv), q.dtype) if torque is None else torque.copy()
            torque[:, placed.columns_v] -= placed.joint.stiffness * stretches(mechanism, placed, q)
    return torque


def _rotation_vectors(rest: Array, here: Wide) -> Wide:
    """The shorter rotation from one quaternion's direction to others' (B, 4), in the turned axes (B, 3) [rad]."""
    a, r = rest[0], rest[1:]
    w = a * here[:, 0] + (here[:, 1] * r[0] + here[:, 2] * r[1] + here[:, 3] * r[2])
    vector = a * here[:, 1:] - here[:, :1] * r - np.cross(r, here[:, 1:])
    length = np.linalg.norm(vector, axis=-1)
    angle = 2 * np.arctan2(length, np.abs(w)) * np.where(w < 0, -1, 1)
    return np.asarray(vector * (angle / np.where(length > 0, length, 1))[:, None])
