"""What an engine's numbers of a mechanism in space may be off by: the units times how many roundings they allow."""

from __future__ import annotations

from ....models.spatial_mechanism import Array, SpatialMechanism
from ..bounds import EPSILON
from .magnitudes import FORCE_ROUNDINGS, Magnitudes


def allowed_mass_matrix(mechanism: SpatialMechanism, q: Array, *, world: bool = True) -> Array:
    """What each entry of an engine's M may be off by, (nv, nv), in the state ``q`` (nq,)."""
    units = Magnitudes(mechanism, q, world=world)
    return units.roundings * EPSILON * units.mass_matrix


def allowed_bias(mechanism: SpatialMechanism, q: Array, v: Array, *, world: bool = True) -> Array:
    """What each row of an engine's bias may be off by, (nv,) [N m or N]."""
    units = Magnitudes(mechanism, q, v, world=world)
    return units.roundings * EPSILON * units.bias


def allowed_gravity(mechanism: SpatialMechanism, q: Array, *, world: bool = True) -> Array:
    """What each row of an engine's gravity terms may be off by, (nv,) [N m or N]."""
    units = Magnitudes(mechanism, q, world=world)
    return units.roundings * EPSILON * units.gravity


def allowed_passive(mechanism: SpatialMechanism, q: Array, v: Array) -> Array:
    """What each row of an engine's passive forces may be off by, (nv,) [N m or N]."""
    return FORCE_ROUNDINGS * EPSILON * Magnitudes(mechanism, q, v).passive


def allowed_residual(
    mechanism: SpatialMechanism,
    q: Array,
    v: Array,
    accelerations: Array,
    mass: Array,
    torque: Array | None = None,
    *,
    factorised: bool = True,
    inverted: bool = True,
    world: bool = True,
) -> Array:
    """What each row of M a + bias − passive − torque may be, (nv,), for an engine's ``accelerations`` a (nv,).

    ``mass``: M (nv, nv), to a few digits; ``factorised``: whether the engine may factorise it; ``inverted``: whether it
    may invert blocks of it.
    """
    units = Magnitudes(mechanism, q, v, world=world)
    return (
        units.roundings
        * EPSILON
        * units.residual(accelerations, mass, torque, factorised=factorised, inverted=inverted)
    )
