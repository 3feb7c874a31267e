"""What the iterations of an implicit scheme leave: not rounding, but what the solver's own tolerance allows.

Newton's iterations end when the norm of all residuals is below ``tolerance`` times that of the first ones, or times
that of n of the largest link's torques where that is more. What is left is had by multiplying the first residuals, more
or less, row by row, since iterations with a derivative that is nearly right make all of them smaller together: a light
link's row is left with that part of its own torque, not of the heaviest link's, but for a part that rows share in (see
:data:`SHARED`). The first residuals are those of no acceleration, as sums of their terms' magnitudes. Constraints of
velocities (index two) start from zero and have no such scale: they are left anywhere within the whole norm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ...models.units import units_of
from .. import mass_matrix
from .bounds import Amplitudes
from .maximal_elimination import equations

Array = NDArray[np.float64]

# Of the norm of all rows, what each shares in: measured in Exudyn, with masses a million times apart (1e-4 of it).
SHARED = 1e-3


def left_in_accelerations(
    system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array, alpha: Array, tolerance: float
) -> Array:
    """Of accelerations [rad/s²], (B, n), in the joints' own coordinates; root of the sum over rows of squares."""
    mass = mass_matrix(system, theta)
    first = (np.abs(amplitude.own_matrix(mass)) @ np.abs(amplitude.own(alpha))[..., None])[..., 0]
    units = units_of(system.tree())
    torque = np.array([system.n * units.fitting(system.gravity, rates).energy for rates in omega])
    norm = np.linalg.norm(first, axis=-1)
    part = tolerance * np.maximum(1.0, np.divide(torque, norm, out=np.ones_like(norm), where=norm > 0))
    rows = part[:, None] * (first + SHARED * norm[:, None])
    left = (amplitude.solution(mass) ** 2 @ (rows**2)[..., None])[..., 0]
    return np.asarray(np.sqrt(left))


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
        norm = float(np.linalg.norm(first[: 3 * n]))
        part = tolerance * max(1.0, n / norm) if norm else tolerance
        by_angle = inverse[2 : 3 * n : 3]
        accelerations = part * np.sqrt(by_angle**2 @ (first + SHARED * norm) ** 2) / state.units.time**2
        speeds = part * norm * np.linalg.norm(by_angle[:, 3 * n :], axis=1) / state.units.time
        pairs.append((accelerations, speeds))
    accelerations, speeds = (np.array(values) for values in zip(*pairs, strict=True))
    return accelerations, speeds
