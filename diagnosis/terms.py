"""The terms of the equations of motion in the states of a measurement, entry by entry, for faults in code.

Row i, in absolute angles, is Σ_j M_ij θ̈_j + Σ_j C_ij θ̇_j² + G_i. A fault in an engine's code changes one of these
terms, or all of one kind, in its forward dynamics, its inverse dynamics or both; what is added to the row is linear
in the fault's size.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from .measurement import Array, Measurement


@dataclass(frozen=True, eq=False)
class Terms:
    """``mass``, ``velocity``: M and C in each state, (S, n, n); ``mass_turned``, ``velocity_turned``: the same with the
    row's own angle a quarter turn on, which makes cosines of sines; ``gravity``, ``gravity_turned``: G, (S, n);
    ``by_gravity``, ``by_rates``: the parts of the true accelerations, (S, n) [rad/s²]."""

    mass: Array
    velocity: Array
    mass_sum: Array
    velocity_sum: Array
    gravity: Array
    gravity_turned: Array
    by_gravity: Array
    by_rates: Array


@lru_cache(maxsize=8)
def terms_of(measured: Measurement, p: Parameters) -> Terms:
    """Every term of the mechanism ``p`` in the measurement's states."""
    parents, theta, omega = measured.parents, measured.theta, measured.omega
    mass = planar.mass_matrix(parents, p, theta)
    velocity = _velocity_matrix(parents, p, theta)
    gravity = planar.gravity_terms(parents, p, theta)
    inverse = _inverse(mass)
    mass_sum, velocity_sum = _with_sums(parents, p, theta)
    return Terms(
        mass=mass,
        velocity=velocity,
        mass_sum=mass_sum,
        velocity_sum=velocity_sum,
        gravity=gravity,
        gravity_turned=planar.gravity_terms(parents, p, theta + np.pi / 2),
        by_gravity=-np.asarray((inverse @ gravity[..., None])[..., 0]),
        by_rates=-np.asarray((inverse @ (velocity @ (omega**2)[..., None]))[..., 0]),
    )


def _inverse(mass: Array) -> Array:
    """NaN where one of them is singular: such a mechanism has no accelerations."""
    try:
        return np.asarray(np.linalg.inv(mass))
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
