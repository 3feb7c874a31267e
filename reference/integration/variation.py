"""Sensitivity of a motion to its state: exact derivatives of θ̈, the tangent flow, and the Lyapunov exponent.

In both documents' equations of motion, M θ̈ + C θ̇² + G = 0 (Shiki (3.10) with (3.12), Takeno (22)), an entry off the
diagonal depends on one difference of angles only, M_jk = m_jk cos(θ_j - θ_k) and C_jk = m_jk sin(θ_j - θ_k), the
diagonal of M is constant, and G_j = g_j sin θ_j. Hence, differentiating as it stands,

    ∂/∂θ_k (M θ̈ + C θ̇² + G)_j = C_jk θ̈_k - M_jk θ̇_k²                          for k ≠ j,
    ∂/∂θ_j (M θ̈ + C θ̇² + G)_j = Σ_{k≠j} (M_jk θ̇_k² - C_jk θ̈_k) + g_j cos θ_j,
    ∂/∂θ_k'(M θ̈ + C θ̇² + G)_j = 2 C_jk θ̇_k,

and the derivatives of θ̈ are these with a minus sign and M⁻¹ before them. No difference quotient anywhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ..arithmetic import arithmetic_of
from ..documents import equations_of_motion as motion
from . import schemes

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Variation:
    """θ̈ [rad/s²], (…, n), and its derivatives by angles [1/s²] and by rates [1/s], (…, n, n): entry j, k is ∂θ̈_j/∂k."""

    acceleration: Floats
    by_theta: Floats
    by_omega: Floats

    def matrix(self) -> Floats:
        """The 2n × 2n matrix of δ̇ = J δ, δ = (δθ, δω); shape (…, 2n, 2n)."""
        above = np.concatenate([np.zeros_like(self.by_theta), np.eye(self.by_theta.shape[-1]) + 0 * self.by_theta], -1)
        return np.concatenate([above, np.concatenate([self.by_theta, self.by_omega], -1)], -2)


def variation(system: DocumentSystem, theta: Floats, omega: Floats) -> Variation:
    """The accelerations at a state and their exact derivatives; θ, ω of shape (…, n), any float type."""
    xp = arithmetic_of(theta, omega)
    mass, centrifugal, gravity = (
        term(system, theta) for term in (motion.mass_matrix, motion.centrifugal_matrix, motion.gravity_vector)
    )
    squared = omega**2
    alpha = xp.solve(mass, -((centrifugal * squared[..., None, :]).sum(-1) + gravity))
    levers = motion.gravity_vector(system, np.full(system.n, np.pi / 2))  # g_j, each sine being one
    by_theta = centrifugal * alpha[..., None, :] - mass * squared[..., None, :]
    index = np.arange(system.n)
    by_theta[..., index, index] = 0
    by_theta[..., index, index] = levers * np.cos(theta) - by_theta.sum(-1)
    by_omega = 2 * centrifugal * omega[..., None, :]
    return Variation(alpha, _divide(xp, mass, by_theta), _divide(xp, mass, by_omega))


def _divide(xp: object, mass: Floats, right: Floats) -> Floats:
    """-M⁻¹ times a matrix; column by column where the arithmetic has no solver for matrices."""
    if mass.dtype == np.float64:
        return np.asarray(-np.linalg.solve(mass, right), dtype=np.float64)
    columns = [-xp.solve(mass, right[..., k]) for k in range(right.shape[-1])]  # type: ignore[attr-defined]
    return np.stack(columns, axis=-1)


def fastest_rate(system: DocumentSystem, theta: Floats, omega: Floats) -> Floats:
    """A bound [1/s] of the rate at which nearby states separate, at each instant; shape (…).

    The largest row sum of J after angles and rates are measured in one unit, the rate ν = √(largest row of ∂θ̈/∂θ).
    """
    found = variation(system, theta, omega)
    stiffness = np.abs(found.by_theta).sum(-1).max(-1)
    nu = np.sqrt(stiffness)
    friction = np.abs(found.by_omega).sum(-1).max(-1)
    return np.asarray(nu + friction)


def tangent_flow(system: DocumentSystem, theta: Floats, omega: Floats, step: float) -> Floats:
    """Φ of each step along a path: δ(t + step) = Φ δ(t), δ = (δθ, δω); shape (K, 2n, 2n).

    ``theta``, ``omega``: the path at K + 1 times, ``step`` apart, **and at the times half-way between**: shape
    (2K + 1, n). The linear equations δ̇ = J(t) δ are integrated by one step of the classical Runge-Kutta scheme, whose
    error is of fifth order in step × :func:`fastest_rate`.
    """
    J = variation(system, theta, omega).matrix()
    at = {0.0: J[0:-1:2], 0.5: J[1::2], 1.0: J[2::2]}
    return schemes.classical_step(lambda part, flow: at[part] @ flow, np.eye(J.shape[-1]), step)


@dataclass(frozen=True)
class Growth:
    """Growth of the most sensitive small difference at ``times`` [s]: ``logarithm`` (natural) of the factor."""

    times: Floats
    logarithm: Floats

    @property
    def exponent(self) -> float:
        """Finite-time Lyapunov exponent [1/s]: mean growth rate over the whole time."""
        return float(self.logarithm[-1] / (self.times[-1] - self.times[0]))

    @property
    def lyapunov_time(self) -> float:
        """1 / exponent [s]: a small difference grows e-fold in it; infinite where none has grown."""
        return 1 / self.exponent if self.exponent > 0 else float("inf")


def growth(flow: Floats, step: float, rate: float) -> Growth:
    """Growth of small differences from the first state on, from the Φ of each step (K, 2n, 2n).

    The size of a difference is that of (δθ, δω / ``rate``). The product of the Φ is kept from overflowing by taking
    out its size, step by step; its largest singular value is the growth of the most sensitive difference. Infinite from
    where the path is not finite.
    """
    n = flow.shape[-1] // 2
    unit = np.concatenate([np.ones(n), np.full(n, rate)])
    products, sizes = flow * (unit / unit[:, None]), []  # the Φ of each step first, then of all up to it
    product = np.eye(2 * n)
    for phi in products:
        product = phi @ product
        size = float(np.abs(product).max())
        if not np.isfinite(size):  # the path has blown up
            break
        product /= size
        phi[:] = product
        sizes.append(size)
    logarithm = np.concatenate([[0.0], np.full(len(flow), np.inf)])
    grown = np.linalg.norm(products[: len(sizes)], 2, axis=(-2, -1))
    logarithm[1 : len(sizes) + 1] = np.cumsum(np.log(sizes)) + np.log(grown)
    return Growth(step * np.arange(len(flow) + 1, dtype=np.float64), logarithm)
