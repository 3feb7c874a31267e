"""Inertials that an engine moves into their body's own frame because they are nearly in it.

MuJoCo's compiler takes a centre of mass within 1e-6 m of the body's origin to be at it, and principal axes within 1e-6
(the vector part of their quaternion) of the body's axes to be these. It is an engine's rounding, not another reading.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...models.spatial import Inertial
from ...models.spatial_mechanism import RigidBody, SpatialMechanism

ROUNDING = 1e-14  # of the largest moment: two dozen operations make a tensor; a turn by less than that is none


def moved_back(found: SpatialMechanism, expected: SpatialMechanism, reach: float) -> SpatialMechanism:
    """``found`` with the inertials that ``expected`` has within ``reach`` [m, and as parts of a quaternion] of where
    they are, if that is exactly in their body's frame. Bodies are recognised by name."""
    if not reach:
        return found
    said = {body.name: body.inertial for body in expected.bodies}
    return replace(found, bodies=tuple(_moved_back(body, said.get(body.name), reach) for body in found.bodies))


def frames_kept(found: SpatialMechanism, expected: SpatialMechanism, reach: float) -> list[str]:
    """The bodies of ``found`` whose inertial is moved back."""
    pairs = zip(found.bodies, moved_back(found, expected, reach).bodies, strict=True)
    return [before.name for before, after in pairs if before is not after]


def rounded(found: SpatialMechanism, expected: SpatialMechanism, reach: float) -> SpatialMechanism:
    """``expected`` with those inertials of ``found`` that are moved back: what an engine has that only rounds so."""
    kept = set(frames_kept(found, expected, reach))
    held = {body.name: body.inertial for body in found.bodies if body.name in kept}
    bodies = (replace(body, inertial=held.get(body.name, body.inertial)) for body in expected.bodies)
    return replace(expected, bodies=tuple(bodies))


def _moved_back(body: RigidBody, said: Inertial | None, reach: float) -> RigidBody:
    held = body.inertial
    if said is None:
        return body
    off_diagonal = held.tensor - np.diag(np.diag(held.tensor))
    centre = held.centre
    if not held.centre.any() and np.abs(said.centre).max() <= reach:
        centre = said.centre
    tensor = held.tensor
    # An angle of twice the quaternion's part about each of three axes: products of inertia up to so much of what the
    # moments differ by, and moments by its square.
    gap, rounding = float(np.ptp(np.diag(held.tensor))), ROUNDING * np.abs(held.tensor).max()
    change = np.abs(said.tensor - held.tensor)
    moments = np.diag(change).max()
    if not off_diagonal.any() and moments <= 16 * reach**2 * gap + rounding and change.max() <= 4 * reach * gap:
        tensor = said.tensor
    turned = np.abs(tensor - held.tensor).max() > rounding
    if np.array_equal(centre, held.centre) and not turned:
        return body
    return replace(body, inertial=Inertial(held.mass, centre, tensor))
