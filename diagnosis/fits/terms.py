"""The terms of the equations of motion in the states of a measurement, entry by entry, for faults in code.

Row i, in absolute angles, is Σ_j M_ij θ̈_j + Σ_j C_ij θ̇_j² + G_i. A fault in an engine's code changes one of these
terms, or all of one kind, in its forward dynamics, its inverse dynamics or both; what is added to the row is linear
in the fault's size.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ...reference import planar_tree as planar
from ...reference.planar_tree import Parameters
from ..measurement import Array, Measurement


@dataclass(frozen=True, eq=False)
class Terms:
    """The terms of the mechanism ``p`` in states ``theta``, ``omega`` (S, n)."""

    parents: tuple[int, ...]
    p: Parameters
    theta: Array
    omega: Array

    @cached_property
    def mass(self) -> Array:
        """M, (S, n, n)."""
        return planar.mass_matrix(self.parents, self.p, self.theta)

    @cached_property
    def velocity(self) -> Array:
        """C, (S, n, n)."""
        return _velocity_matrix(self.parents, self.p, self.theta)

    @cached_property
    def gravity(self) -> Array:
        """G, (S, n)."""
        return planar.gravity_terms(self.parents, self.p, self.theta)

    @cached_property
    def gravity_turned(self) -> Array:
        """G with every angle a quarter turn on, which makes cosines of sines."""
        return planar.gravity_terms(self.parents, self.p, self.theta + np.pi / 2)

    @cached_property
    def sums(self) -> tuple[Array, Array]:
        """M and C with the sum of two angles in place of their difference."""
        return _with_sums(self.parents, self.p, self.theta)

    @cached_property
    def by_gravity(self) -> Array:
        """The part of the true accelerations that gravity makes, (S, n) [rad/s²]."""
        return -np.asarray((self._inverse @ self.gravity[..., None])[..., 0])

    @cached_property
    def by_rates(self) -> Array:
        """The part that the rates make."""
        return -np.asarray((self._inverse @ (self.velocity @ (self.omega**2)[..., None]))[..., 0])

    @cached_property
    def _inverse(self) -> Array:
        return _inverse(self.mass)


@lru_cache(maxsize=8)
def terms_of(measured: Measurement, p: Parameters) -> Terms:
    """Every term of the mechanism ``p`` in the measurement's states."""
    return Terms(measured.parents, p, measured.theta, measured.omega)


def _inverse(mass: Array) -> Array:
    """NaN where one of them is singular: such a mechanism has no accelerations."""
    try:
        return np.asarray(np.linalg.inv(mass), dtype=np.float64)
    except np.linalg.LinAlgError:
        return np.full_like(mass, np.nan)


def _velocity_matrix(parents: tuple[int, ...], p: Parameters, theta: Array) -> Array:
    """C of the velocity terms C θ̇², (S, n, n): column j is those of the rate θ̇_j = 1 alone."""
    n = len(parents)
    states = np.repeat(theta[:, None, :], n, axis=1)
    rates = np.broadcast_to(np.eye(n), states.shape)
    flat = states.reshape(-1, n), rates.reshape(-1, n)
    found = planar.velocity_terms(parents, p, *flat).reshape(states.shape)
    return np.asarray(np.swapaxes(found, 1, 2))


def _with_sums(parents: tuple[int, ...], p: Parameters, theta: Array) -> tuple[Array, Array]:
    """M and C with θ_i + θ_j in every pair in place of the difference, (S, n, n) each.

    An entry depends on θ_i − θ_j alone: it is taken where θ_j has the other sign.
    """
    n = len(parents)
    mass, velocity = np.empty((*theta.shape, n)), np.empty((*theta.shape, n))
    for j in range(n):
        other = theta.copy()
        other[:, j] *= -1
        mass[:, :, j] = planar.mass_matrix(parents, p, other)[:, :, j]
        velocity[:, :, j] = _velocity_matrix(parents, p, other)[:, :, j]
    return mass, velocity
