"""What the explicit texts of a spatial mechanism have in common: numbers to the last digit, and inertials for all.

They are texts that every engine reads alike, so what engines are known to read differently is not written: it is put
in another way that means the same, or refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from ..errors import InvalidInput
from ..spatial import ZERO_INERTIAL, Inertial
from ..spatial_mechanism import WORLD, RigidBody, SpatialMechanism
from .mjcf import LEAST_INERTIA

ROUNDED = 1e-9  # relative: principal moments may miss A + B ≥ C by this, as when they were printed with ten digits


def row(values: Iterable[float]) -> str:
    """Numbers, each with as many digits as it takes to read it back exactly."""
    return " ".join(repr(float(value) + 0.0) for value in values)


def positive(inertial: Inertial) -> bool:
    """Whether all principal moments are more than nothing, as MuJoCo wants them."""
    return float(np.linalg.eigvalsh(inertial.tensor)[0]) > LEAST_INERTIA


def placed_inertials(mechanism: SpatialMechanism) -> list[Inertial]:
    """The bodies' inertials, so placed that engines take them.

    That of a body without mass, or with a moment of zero, is its parent's where it is fixed to it: MuJoCo drops the
    former in URDF and refuses the latter, Drake puts a kilogram for the former. What does not move has none if it is
    such a one, or none that a rigid body has. Raises :class:`InvalidInput` for others that no rigid body has: engines
    do not agree on what to make of them.
    """
    found = [body.inertial for body in mechanism.bodies]
    still: list[bool] = []
    for body in mechanism.bodies:
        still.append(not body.joints and (body.parent == WORLD or still[body.parent]))
    for index in range(len(found) - 1, -1, -1):
        body, inertial = mechanism.bodies[index], found[index]
        if _impossible(inertial):
            if still[index]:
                found[index] = ZERO_INERTIAL
        elif not body.joints and (inertial.mass == 0 or not positive(inertial)):
            if not still[index]:
                found[body.parent] = found[body.parent] + inertial.transformed(body.pose)
            found[index] = ZERO_INERTIAL
    for body, inertial in zip(mechanism.bodies, found, strict=True):
        if _impossible(inertial):
            raise InvalidInput(
                f"{body.where or body.name}: no rigid body has its mass and inertia; give it others first: engines do "
                "not agree on what to make of them"
            )
        if inertial.mass == 0 and inertial.tensor.any():
            raise InvalidInput(f"{body.where or body.name}: an inertia without a mass; give it a mass first")
    return found


def _impossible(inertial: Inertial) -> bool:
    moments = np.linalg.eigvalsh(inertial.tensor)
    slack = ROUNDED * float(np.abs(moments).max()) + LEAST_INERTIA
    return bool(inertial.mass < 0 or moments[0] < -slack or moments[0] + moments[1] < moments[2] - slack)


def unique_names(
    bodies: Sequence[RigidBody], *taken: str, besides: Callable[[RigidBody, str], Iterable[str]] = lambda *_: ()
) -> list[str]:
    """The bodies' names, none twice and none that is ``taken``; ``besides``: what else comes with a body called so."""
    seen = set(taken)
    names = []
    for body in bodies:
        name, count = body.name, 1
        while not seen.isdisjoint({name, *besides(body, name)}):
            count += 1
            name = f"{body.name}_{count}"
        seen |= {name, *besides(body, name)}
        names.append(name)
    return names
