"""True accelerations of mechanisms too large for a dense solution in balls: the same equations, O(n).

A rod chain by Takeno's equations with the joint forces kept; an N-leg pendulum by Shiki's own matrix (3.12), whose
legs do not know each other: all entries but the first row, the first column and the diagonal are exactly zero.
"""

from __future__ import annotations

import numpy as np

from ..models import RodChain
from . import motion
from .arithmetic import Array, balls
from .motion import Mechanism
from .quadruple import chain_accelerations
from .truth import Floats, Truth, rounded_precisely


def true_accelerations(system: Mechanism, theta: Floats, omega: Floats) -> Truth:
    """θ̈ [rad/s²] of the literal equations, enclosed; shape (B, n) in and out."""
    parts = [rounded_precisely(lambda t=t, w=w: _enclose(system, t, w)) for t, w in zip(theta, omega, strict=True)]
    high, low, radius = (np.concatenate([part[k] for part in parts]) for k in range(3))
    return Truth(high, low, radius)


def _enclose(system: Mechanism, theta: Floats, omega: Floats) -> Array:
    xp = balls()
    t, w = xp.array(theta), xp.array(omega)
    if isinstance(system, RodChain):
        return chain_accelerations(xp, system, t, w)[None]
    equations = motion.literal_system(xp, system, t[None], w[None])
    return _arrow(equations.matrix[0], equations.right[0])[None]


def _arrow(matrix: Array, right: Array) -> Array:
    """The solution where a matrix has a first row, a first column and a diagonal."""
    row, column, diagonal = matrix[0, 1:], matrix[1:, 0], matrix.diagonal()[1:]
    first = (right[0] - (row * right[1:] / diagonal).sum()) / (matrix[0, 0] - (row * column / diagonal).sum())
    return np.concatenate([[first], (right[1:] - column * first) / diagonal])
