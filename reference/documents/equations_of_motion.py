"""The documents' final equations, put together for a mechanism, in whichever arithmetic its state is given.

Angles and rates are absolute, shape (…, n), floats with any batch or arrays of balls, sympy or heyoka expressions.
Lagrange rows: M(θ) θ̈ + C(θ) θ̇² + G(θ) = 0 in [N m], θ̇² entry by entry.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...models import DocumentSystem, NLegPendulum, RodChain
from ..arithmetic import Arithmetic, Array, arithmetic_of, times
from . import shiki, takeno


@dataclass(frozen=True)
class Literal:
    """A document's last form, (3.10) with (3.12) or (22): matrix · θ̈ = right; ``lagrange_row`` makes rows [N m]."""

    matrix: Array
    right: Array
    lagrange_row: Array


def literal_system(xp: Arithmetic, system: DocumentSystem, theta: Array, omega: Array) -> Literal:
    """A θ̈ = -B e of Shiki (3.10), or A θ̈ = -(B θ̇² + g L sin θ) of Takeno (22); matrix (…, n, n), right (…, n)."""
    l, g = xp.array(system.lengths), xp.array(system.gravity)
    if isinstance(system, RodChain):
        rho = xp.array(system.density)
        (L,) = takeno.eq_12(l)
        A, B = _takeno_matrices(xp, l, L, theta)
        return Literal(A, -(times(B, omega**2) + g * (L * xp.sin(theta))), rho * l)
    m = xp.array(system.masses)
    (both,) = shiki.eq_3_12(xp, l, m, g, theta, omega)
    e = xp.array(np.ones(system.n))
    return Literal(both[..., 0, :, :], -times(both[..., 1, :, :], e), l)


def literal_accelerations(system: DocumentSystem, theta: Array, omega: Array) -> Array:
    """Forward dynamics: θ̈ [rad/s²] by the document's own formula, (3.10) or (22) solved, shape (…, n)."""
    xp = arithmetic_of(theta, omega)
    equations = literal_system(xp, system, theta, omega)
    return xp.solve(equations.matrix, equations.right)


def mass_matrix(system: DocumentSystem, theta: Array) -> Array:
    """Joint-space inertia (mass) matrix M(θ) [kg m²] of the absolute angles, shape (…, n, n).

    Shiki (3.12) row i times l_i, Takeno (21) row j times ρ l_j.
    """
    if isinstance(system, RodChain):
        xp = arithmetic_of(theta)
        return _takeno_one(xp, system, xp.cos_differences(theta))
    return _terms(system, theta)[0]


def centrifugal_matrix(system: DocumentSystem, theta: Array) -> Array:
    """Centrifugal matrix C(θ) [kg m²], shape (…, n, n): C_jk multiplies θ̇_k² in row j. No products θ̇_j θ̇_k."""
    if isinstance(system, RodChain):
        xp = arithmetic_of(theta)
        return _takeno_one(xp, system, xp.sin_differences(theta))
    return _terms(system, theta)[1]


def gravity_vector(system: DocumentSystem, theta: Array) -> Array:
    """Gravity terms G(θ) [N m], shape (…, n)."""
    if isinstance(system, RodChain):
        xp = arithmetic_of(theta)
        l, g = xp.array(system.lengths), xp.array(system.gravity)
        (L,) = takeno.eq_12(l)
        return np.asarray(xp.array(system.density) * l * g * (L * xp.sin(theta)))
    return _terms(system, theta)[2]


def _takeno_one(xp: Arithmetic, system: RodChain, of_differences: Array) -> Array:
    """Rows ρ l_j of Takeno (21)'s A or B: one alone is half the work, most of which is cosines and sines."""
    l = xp.array(system.lengths)
    (L,) = takeno.eq_12(l)
    (alpha_jk,) = takeno.eq_20(l, L)
    return np.asarray((xp.array(system.density) * l)[:, None] * takeno.eq_21_one(l, of_differences, alpha_jk))


def _terms(system: NLegPendulum, theta: Array) -> tuple[Array, Array, Array]:
    """Those of Shiki (3.12)."""
    xp = arithmetic_of(theta)
    l, g = xp.array(system.lengths), xp.array(system.gravity)
    # With every rate 1, B of (3.12) holds the coefficients of the squared rates; gravity is on its diagonal.
    unit_rates = xp.array(np.ones(system.n))
    (both,) = shiki.eq_3_12(xp, l, xp.array(system.masses), g, theta, unit_rates)
    A, B = both[..., 0, :, :], both[..., 1, :, :]
    index = np.arange(system.n)
    gravity = B[..., index, index]
    centrifugal = B.copy()
    centrifugal[..., index, index] = 0
    return l[:, None] * A, l[:, None] * centrifugal, l * gravity


def _takeno_matrices(xp: Arithmetic, l: Array, L: Array, theta: Array) -> tuple[Array, Array]:
    (alpha_jk,) = takeno.eq_20(l, L)
    (both,) = takeno.eq_21(xp, l, theta, alpha_jk)
    return both[..., 0, :, :], both[..., 1, :, :]


def energies(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Kinetic and potential energy [J], shape (…) each; the potential is zero at the support."""
    xp = arithmetic_of(theta, omega)
    l, m, g = _lengths_masses_gravity(xp, system)
    across, down = _across_and_down(system, l, theta, xp)
    velocity = _centres(system, across * omega[..., None])
    height = _centres(system, down)[..., 1]
    kinetic = (m * (velocity**2).sum(-1)).sum(-1) / 2
    if isinstance(system, RodChain):
        inertia = takeno.eq_5(l, xp.array(system.density), m)[-1]
        kinetic = kinetic + (inertia * omega**2).sum(-1) / 2
    return np.asarray(kinetic), np.asarray((m * g * height).sum(-1))


def centre_accelerations(system: DocumentSystem, theta: Array, omega: Array, alpha: Array) -> Array:
    """Acceleration (x, up) of each link's centre of mass [m/s²], shape (…, n, 2)."""
    xp = arithmetic_of(theta, omega, alpha)
    across, down = _across_and_down(system, xp.array(system.lengths), theta, xp)
    return _centres(system, across * alpha[..., None] - down * (omega**2)[..., None])


def joint_forces(system: DocumentSystem, theta: Array, omega: Array, alpha: Array) -> Array:
    """Joint reaction force (x, up) [N] of each link on its parent in this motion, shape (…, n, 2).

    Takeno (8): row j of a rod chain is T_j, j = 0 … n-1. For the star the same sum over the hinge's subtree.
    """
    xp = arithmetic_of(theta, omega, alpha)
    _, m, g = _lengths_masses_gravity(xp, system)
    r_ddot = centre_accelerations(system, theta, omega, alpha)
    if isinstance(system, RodChain):
        forces: Array = takeno.eq_8(xp, m, g, r_ddot)[0]
        return forces
    forces = -m[:, None] * (r_ddot + g * takeno.e_y(xp))
    forces[..., 0, :] = forces.sum(-2)
    return forces


def _lengths_masses_gravity(xp: Arithmetic, system: DocumentSystem) -> tuple[Array, Array, Array]:
    l, g = xp.array(system.lengths), xp.array(system.gravity)
    m = xp.array(system.density) * l if isinstance(system, RodChain) else xp.array(system.masses)
    return l, m, g


def _across_and_down(system: DocumentSystem, l: Array, theta: Array, xp: Arithmetic) -> tuple[Array, Array]:
    """l q(θ) and l p(θ) of each link [m], shape (…, n, 2)."""
    cos, sin = xp.cos_sin(theta)
    return np.stack([l * cos, l * sin], axis=-1), np.stack([l * sin, -l * cos], axis=-1)


def _centres(system: DocumentSystem, links: Array) -> Array:
    """From a vector for each whole link, the vector for each centre: the sum of its ancestors' and its own part."""
    if isinstance(system, RodChain):  # half of its own, all of those before
        return np.asarray(np.cumsum(links, axis=-2) - links / 2)
    centres = links.copy()
    centres[..., 1:, :] = links[..., 1:, :] + links[..., :1, :]
    return centres
