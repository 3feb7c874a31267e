"""What rounding may do to an engine's terms and accelerations of a mechanism in space; :mod:`.magnitudes` derives it.

May import models, the arithmetic and the kinematics of the room, and :mod:`furiko.reference.rounding.bounds`.
"""

from .allowed import allowed_bias, allowed_gravity, allowed_mass_matrix, allowed_passive, allowed_residual
from .magnitudes import FORCE_ROUNDINGS, Lengths, Magnitudes, components, magnitudes

__all__ = [
    "FORCE_ROUNDINGS",
    "Lengths",
    "Magnitudes",
    "allowed_bias",
    "allowed_gravity",
    "allowed_mass_matrix",
    "allowed_passive",
    "allowed_residual",
    "components",
    "magnitudes",
]
