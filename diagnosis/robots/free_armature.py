"""Armature of a free joint that resists the velocity along the body's axes in place of the world's.

MuJoCo's free joint moves along the world's axes, and its armature A resists their acceleration a. An engine whose free
joint moves along the body's axes adds A to the acceleration there, Rᵀ a − ω × Rᵀ v: at rest the same, in motion the
bias lacks A ω × v.
"""

from __future__ import annotations

import numpy as np

from ...engines.model_files.robot import BoundRobot
from ...models.spatial import from_quaternion
from ...models.spatial_mechanism import PlacedJoint, SpatialMechanism
from ...reference.rounding.spatial import allowed_bias
from ...reference.truth.spatial import spatial_truth
from ..finding import Finding
from .states import probe_states


def armature_in_body_axes(bound: BoundRobot, mechanism: SpatialMechanism) -> PlacedJoint | None:
    """The first free joint with armature, if acting along the body's axes explains the engine's bias."""
    free = [placed for placed in mechanism.joints if placed.joint.kind == "free" and placed.joint.armature]
    if not free:
        return None
    q, v = probe_states(mechanism)
    found = np.asarray(bound.bias(q, v), dtype=np.float64)
    for k in range(len(q)):
        expected = spatial_truth(mechanism, q[k], v[k]).bias.float.copy()
        for placed in free:
            turned = from_quaternion(q[k][placed.columns_q][3:])
            speed, spin = v[k][placed.columns_v][:3], turned @ v[k][placed.columns_v][3:]
            rows = slice(placed.at_v, placed.at_v + 3)
            expected[rows] -= placed.joint.armature * np.cross(spin, speed)
        # The product above rounds a few times more than the bias itself.
        if (np.abs(found[k] - expected) > 2 * allowed_bias(mechanism, q[k], v[k])).any():
            return None
    return free[0]


def armature_finding(engine: str, placed: PlacedJoint, line: str) -> Finding:
    """The cause in words; ``line``: the joint's element and line in the file, or nothing."""
    joint = placed.joint
    says = (
        f"{engine}: the armature {joint.armature:g} of the free joint {joint.name!r} acts along the body's axes, "
        "MuJoCo's along the world's: at rest the same, in motion the forces differ by armature·(ω × v)"
        f"{f' ({line})' if line else ''}. Instead, leave armature off free joints: "
        "<freejoint> takes none from a default class"
    )
    return Finding("free-armature-in-body-axes", f"{engine}: joint {joint.name!r}", None, None, says)
