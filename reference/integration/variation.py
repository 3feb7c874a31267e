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
from ...models.states import natural_rate
from ..arithmetic import arithmetic_of
from ..documents import equations_of_motion as motion
from . import schemes

Floats = NDArray[np.float64]

LOGARITHM_SETTLED = 0.05  # growth is known to a factor of e^0.05
MOST_STEPS = 50_000


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
    scaled = flow * (unit / unit[:, None])
    product, taken_out = np.eye(2 * n), 0.0
    logarithm = np.zeros(len(flow) + 1)
    for k, phi in enumerate(scaled):
        product = phi @ product
        size = float(np.abs(product).max())
        if not np.isfinite(size):  # the path has blown up
            logarithm[k + 1 :] = np.inf
            break
        product /= size
        taken_out += np.log(size)
        logarithm[k + 1] = taken_out + np.log(np.linalg.norm(product, 2))
    return Growth(step * np.arange(len(flow) + 1, dtype=np.float64), logarithm)


def growth_along(system: DocumentSystem, theta: Floats, omega: Floats, duration: float) -> Growth:
    """Growth of small differences along the motion from a state (n,), over ``duration`` [s].

    The motion is integrated in double precision by Butcher's sixth order scheme, twice as finely until the growth no
    longer changes by a twentieth of a factor e. Where the motion is chaotic that is not the motion from this state,
    after some time, but one from a state beside it; the growth is as typical.
    """
    rate = natural_rate(system)
    steps = max(8, int(np.ceil(4 * duration * float(fastest_rate(system, theta, omega)))))
    before = _growth_in(system, theta, omega, duration, steps, rate)
    while True:
        steps *= 2
        found = _growth_in(system, theta, omega, duration, steps, rate)
        if abs(found.logarithm[-1] - before.logarithm[-1]) < LOGARITHM_SETTLED or steps > MOST_STEPS:
            return found
        before = found


def lyapunov_time(system: DocumentSystem, theta: Floats, omega: Floats, duration: float) -> float:
    """The time [s] in which the most sensitive small difference grows e-fold, on average over ``duration`` [s].

    Infinite where nothing grows. A motion that is not chaotic has one too, about its duration: differences then grow
    in proportion to time.
    """
    return growth_along(system, theta, omega, duration).lyapunov_time


def _growth_in(
    system: DocumentSystem, theta: Floats, omega: Floats, duration: float, steps: int, rate: float
) -> Growth:
    step = duration / steps
    states = np.empty((2 * steps + 1, 2, system.n))
    states[0] = theta, omega

    def accelerations(angles: Floats, rates: Floats) -> Floats:
        return motion.literal_accelerations(system, angles, rates)

    with np.errstate(over="ignore", invalid="ignore"):  # steps too long for what comes on the way are halved
        for k in range(2 * steps):  # half steps, which the tangent flow needs
            angles, rates = states[k]
            states[k + 1] = schemes.BUTCHER_6.step(accelerations, angles, rates, step / 2)
        return growth(tangent_flow(system, states[:, 0], states[:, 1], step), step, rate)
