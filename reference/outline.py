"""An open mechanism as lines, for a drawing of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..models.spatial_mechanism import WORLD, Array, SpatialMechanism
from .spatial_kinematics import motion

Line = tuple[float, float, float, float]


def outline(mechanism: SpatialMechanism, q: Sequence[float]) -> list[Line]:
    """Lines (x, z, x, z) [m] as seen along y in the state ``q`` (nq,): from each link's frame to its parent's frame.

    And to its centre of mass where nothing hangs on it. What has no length is left out.
    """
    moved = motion(mechanism, np.array([q]), np.zeros((1, mechanism.nv)))
    frames, turned = moved.position[0], moved.rotation[0]
    parents = {body.parent for body in mechanism.bodies}
    found: list[Line] = []
    for index, body in enumerate(mechanism.bodies):
        here = frames[index]
        if body.parent != WORLD:
            found.append(_line(frames[body.parent], here))
        if index not in parents:
            found.append(_line(here, here + turned[index] @ body.inertial.centre))
    return [line for line in found if line[:2] != line[2:]]


def _line(start: Array, end: Array) -> Line:
    return float(start[0]), float(start[2]), float(end[0]), float(end[2])
