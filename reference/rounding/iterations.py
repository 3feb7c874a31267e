"""What the iterations of an implicit scheme leave: not rounding, but what the solver's own tolerance allows.

Newton's iterations end when the norm of all residuals is below ``tolerance`` times that of the first ones, or times
that of n of the largest link's torques where that is more: whatever is left may be in any one row. The first residuals
are those of no acceleration, as sums of their terms' magnitudes.

In maximal coordinates the joints' constraints are rows like the others: positions, in units of length, for a scheme
that holds these together, and velocities for one that holds those. Joints that are left apart by c move the angles by
P c: P is the block of the inverse of (M, Gᵀ; G, 0) that answers constraints with angles.
"""

from __future__ import annotations

from dataclasses import dataclass

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


@dataclass(frozen=True)
class Left:
    """As much as the tolerance allows: in accelerations [rad/s²], in ``rates`` [rad/s] where velocities are held
    together, in ``angles`` [rad] where positions are, (B, n) each; the last by joints that are ``apart`` [m], (B,).
    """

    accelerations: Array
    rates: Array
    angles: Array
    apart: Array

    def with_joints_apart(self, gap: Array) -> Array:
        """Angles [rad], (B, n), where each of the joints is known to be apart by no more than ``gap`` [m], (B,)."""
        together = np.sqrt(self.angles.shape[-1]) * gap  # the norm of all rows
        share = np.divide(together, self.apart, out=np.ones_like(self.apart), where=together < self.apart)
        return np.asarray(self.angles * share[:, None])


def left_in_maximal_coordinates(system: DocumentSystem, theta: Array, omega: Array, tolerance: float) -> Left:
    """Of a step's equations in states (B, n)."""
    n, found = system.n, []
    for angles, rates in zip(theta, omega, strict=True):
        state = equations(system, angles, rates)
        inverse = np.linalg.inv(state.matrix)
        solution = np.abs(inverse @ state.right)
        first = np.abs(state.matrix) @ solution
        left = tolerance * max(float(norm(first[: 3 * n])), float(n))
        by_angle = inverse[2 : 3 * n : 3]
        accelerations = state.units.in_seconds(left * norm(by_angle), 2)
        turned = left * norm(by_angle[:, 3 * n :])
        found.append((accelerations, turned / state.units.time, turned, left * state.units.length))
    return Left(*(np.array(values) for values in zip(*found, strict=True)))
