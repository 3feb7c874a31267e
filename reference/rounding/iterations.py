"""What the iterations of an implicit scheme leave: not rounding, but what the solver's own tolerance allows.

Newton's iterations end when the norm of all residuals is below ``tolerance`` times that of the first ones, or times
that of n of the largest link's torques where that is more: whatever is left may be in any one row. The first residuals
are those of no acceleration, as sums of their terms' magnitudes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ...models.units import units_of
from .. import mass_matrix
from .bounds import Amplitudes
from .maximal_elimination import equations
from .norms import norm

Array = NDArray[np.float64]


def left_in_accelerations(
    system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array, alpha: Array, tolerance: float
) -> Array:
    """Of accelerations [rad/s²], (B, n), from residuals in the joints' own coordinates."""
    mass = mass_matrix(system, theta)
    first = (np.abs(amplitude.own_matrix(mass)) @ np.abs(amplitude.own(alpha))[..., None])[..., 0]
    units = units_of(system.tree())
    torque = np.array([system.n * units.fitting(system.gravity, rates).energy for rates in omega])
    left = tolerance * np.maximum(norm(first), torque)
    return np.asarray(left[:, None] * norm(amplitude.solution(mass)))


def left_in_maximal_coordinates(
    system: DocumentSystem, theta: Array, omega: Array, tolerance: float
) -> tuple[Array, Array]:
    """Of accelerations [rad/s²] and, where velocities are held together, of rates [rad/s], (B, n) each."""
    n, pairs = system.n, []
    for angles, rates in zip(theta, omega, strict=True):
        state = equations(system, angles, rates)
        inverse = np.linalg.inv(state.matrix)
        solution = np.abs(inverse @ state.right)
        first = np.abs(state.matrix) @ solution
        left = tolerance * max(float(norm(first[: 3 * n])), float(n))
        by_angle = inverse[2 : 3 * n : 3]
        accelerations = state.units.in_seconds(left * norm(by_angle), 2)
        speeds = left * norm(by_angle[:, 3 * n :]) / state.units.time
        pairs.append((accelerations, speeds))
    accelerations, speeds = (np.array(values) for values in zip(*pairs, strict=True))
    return accelerations, speeds
