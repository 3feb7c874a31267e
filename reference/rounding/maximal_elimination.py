"""The backward error of elimination in maximal coordinates, where masses, inertias and lengths are in one matrix.

The KKT system of free bodies and hinges, (M, Gᵀ; G, 0) (q̈, λ) = b, is solved by Gaussian elimination with row
interchanges. Its backward error is |L||U||x| (Higham, Accuracy and Stability of Numerical Algorithms, theorem 9.3), not
row by row: a row of a light link may be added to one of a heavy link and share its rounding. The size depends on the
order in which unknowns are eliminated, which a sparse solver chooses by rules of its own; the worst of several random
orders is taken.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ...models.units import in_units, units_of
from .. import mass_matrix
from ..maximal_coordinates import MaximalCoordinates
from .bounds import interchanged

Array = NDArray[np.float64]

ORDERS = 16


def elimination(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Magnitudes in units of ε of the equations of motion and of the joint reaction forces: (B, n) [N m], (B, n) [N].

    For states (B, n). In the rows of the document's equations: M times the change of the angular accelerations that a
    residual |L||U||x| of the KKT system makes, and its change of the multipliers.
    """
    pairs = [_one(system, t, w) for t, w in zip(theta, omega, strict=True)]
    rows, forces = (np.array(values) for values in zip(*pairs, strict=True))
    return rows, forces


def _one(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    tree, n = system.tree(), system.n
    units = units_of(tree).fitting(system.gravity, omega)
    bodies = MaximalCoordinates(in_units(tree, units))
    q, v = bodies.state(theta, omega * units.time)
    matrix = bodies.kkt_matrix(bodies.jacobian(q))
    right = np.concatenate([bodies.force, -bodies.constraint_bias(q, v)]).astype(np.float64)
    inverse = np.linalg.inv(matrix)
    size = _residual_bound(matrix, np.abs(np.linalg.solve(matrix, right)))
    by_angle = np.abs(mass_matrix(system, theta) / units.inertia @ inverse[2 : 3 * n : 3])
    by_force = np.abs(inverse[3 * n :])
    forces = np.linalg.norm((by_force @ size).reshape(n, 2), axis=-1)
    return by_angle @ size * units.energy, forces * units.force


def _residual_bound(matrix: Array, unknowns: Array) -> Array:
    """|L||U||x| of each equation in the worst of ORDERS orders of the unknowns."""
    generator = np.random.Generator(np.random.PCG64(1))
    orders = np.array([generator.permutation(len(matrix)) for _ in range(ORDERS)])
    factors = interchanged(np.stack([matrix[:, order] for order in orders]))
    return np.asarray((factors * unknowns[orders][:, None]).sum(axis=-1).max(axis=0))
