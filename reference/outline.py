"""An open mechanism as lines, for a drawing of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..models.spatial_mechanism import WORLD, Array, SpatialMechanism
from .spatial_kinematics import motion

Line = tuple[float, float, float, float]


def outline(mechanism: SpatialMechanism, q: Sequence[float], *, across_least: bool = False) -> list[Line]:
    """Lines (x, z, x, z) [m] as seen along y in the state ``q`` (nq,): from each link's frame to its parent's frame.

    And to its centre of mass where nothing hangs on it. What has no length is left out. ``across_least``: as seen along
    x, y or z instead, whichever the mechanism reaches least far along; (y, z) along x, (x, y) along z.
    """
    moved = motion(mechanism, np.array([q]), np.zeros((1, mechanism.nv)))
    frames, turned = moved.position[0], moved.rotation[0]
    parents = {body.parent for body in mechanism.bodies}
    found: list[tuple[Array, Array]] = []
    for index, body in enumerate(mechanism.bodies):
        here = frames[index]
        if body.parent != WORLD:
            found.append((frames[body.parent], here))
        if index not in parents:
            found.append((here, here + turned[index] @ body.inertial.centre))
    seen = _seen(np.array(found)) if across_least and found else [0, 2]
    lines = [(*start[seen].tolist(), *end[seen].tolist()) for start, end in found]
    return [line for line in lines if line[:2] != line[2:]]


def _seen(ends: Array) -> list[int]:
    """The two axes in which these points (…, 3) are seen along the third; along y where none reaches less far."""
    reach = np.ptp(ends.reshape(-1, 3), axis=0)
    along = 1 if reach[1] == reach.min() else int(reach.argmin())
    return [axis for axis in range(3) if axis != along]
