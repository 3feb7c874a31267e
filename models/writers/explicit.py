"""What the explicit texts of a spatial mechanism have in common: numbers to the last digit, and inertials for all.

They are texts that every engine reads alike, so what engines are known to read differently is not written: it is put
in another way that means the same, or refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..errors import InvalidInput
from ..spatial import ZERO_INERTIAL, Inertial, Pose, from_quaternion
from ..spatial_mechanism import RigidBody, SpatialMechanism

ROUNDED = 1e-9  # relative: principal moments may miss A + B ≥ C by this, as when they were printed with ten digits


def row(values: Iterable[float]) -> str:
    """Numbers, each with as many digits as it takes to read it back exactly."""
    return " ".join(repr(float(value) + 0.0) for value in values)


def pose_of(body: RigidBody) -> Pose:
    """Where the body is in its parent's frame."""
    return Pose(from_quaternion(body.quaternion), body.position)


def placed_inertials(mechanism: SpatialMechanism) -> list[Inertial]:
    """The bodies' inertials, where the inertia of a body without mass is its parent's, to which it is fixed.

    MuJoCo drops the inertia of such a body in URDF, and Drake puts a kilogram there. Raises :class:`InvalidInput` for
    an inertial that no rigid body has: engines do not agree on what to make of it.
    """
    found = [body.inertial for body in mechanism.bodies]
    for index in range(len(found) - 1, -1, -1):
        body, inertial = mechanism.bodies[index], found[index]
        if inertial.mass == 0 and inertial.tensor.any() and not body.joints and body.parent >= 0:
            found[body.parent] = found[body.parent] + inertial.transformed(pose_of(body))
            found[index] = ZERO_INERTIAL
    for body, inertial in zip(mechanism.bodies, found, strict=True):
        moments = np.linalg.eigvalsh(inertial.tensor)
        slack = ROUNDED * float(np.abs(moments).max())
        if inertial.mass < 0 or moments[0] < -slack or moments[0] + moments[1] < moments[2] - slack:
            raise InvalidInput(
                f"{body.where or body.name}: no rigid body has its mass and inertia; give it others first: engines do "
                "not agree on what to make of them"
            )
        if inertial.mass == 0 and inertial.tensor.any():
            raise InvalidInput(f"{body.where or body.name}: an inertia without a mass; give it a mass first")
    return found


def unique_names(bodies: Sequence[RigidBody], taken: str) -> list[str]:
    """The bodies' names, none twice and none the one that is ``taken``."""
    seen = {taken}
    names = []
    for body in bodies:
        name, count = body.name, 1
        while name in seen:
            count += 1
            name = f"{body.name}_{count}"
        seen.add(name)
        names.append(name)
    return names
