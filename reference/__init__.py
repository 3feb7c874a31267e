"""The theory: both documents' equations and the values proved or computed from them. Imports models only, no engine.

Inside: arithmetic, limits → documents → truth, kernels → integration → planar_tree, maximal_coordinates → rounding;
truth → proved.
"""

from .documents.equation import Equation, Slip
from .documents.equations_of_motion import (
    centre_accelerations,
    centrifugal_matrix,
    energies,
    gravity_vector,
    joint_forces,
    literal_accelerations,
    mass_matrix,
)
from .documents.shiki import EQUATIONS as SHIKI
from .documents.shiki import SLIPS as _SHIKI_SLIPS
from .documents.takeno import EQUATIONS as TAKENO
from .documents.takeno import SLIPS as _TAKENO_SLIPS
from .documents.takeno_unnumbered import UNNUMBERED

EQUATIONS = SHIKI + TAKENO  # all 57, in the documents' order
MISPRINTS = tuple(equation for equation in EQUATIONS if equation.printed)
SLIPS = _SHIKI_SLIPS + _TAKENO_SLIPS  # outside the numbered formulas, found by reading

__all__ = [
    "EQUATIONS",
    "MISPRINTS",
    "SHIKI",
    "SLIPS",
    "TAKENO",
    "UNNUMBERED",
    "Equation",
    "Slip",
    "centre_accelerations",
    "centrifugal_matrix",
    "energies",
    "gravity_vector",
    "joint_forces",
    "literal_accelerations",
    "mass_matrix",
]
