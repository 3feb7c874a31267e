"""Derivatives of the accelerations of the documents' mechanisms, exact, in ball arithmetic.

The equations F = M θ̈ + C θ̇² + G = 0 have, with numbers A_ij = A_ji of the mechanism, M_ij = A_ij cos(θ_i − θ_j),
C_ij = A_ij sin(θ_i − θ_j) and G_i = g_i sin θ_i. So with respect to θ_k, θ̈ and θ̇ held,

    L_ik = C_ik θ̈_k − M_ik θ̇_k²   (i ≠ k),      L_kk = Σ_{j≠k} (M_kj θ̇_j² − C_kj θ̈_j) + g_k cos θ_k,

and with respect to θ̇_k, 2 C_ik θ̇_k. As F stays zero, M ∂θ̈/∂θ = −L and M ∂θ̈/∂θ̇ = −2 C diag(θ̇). Nothing is
differenced.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ..arithmetic import Array, balls
from ..documents import equations_of_motion as motion
from . import enclosures as proved

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Derivatives:
    """Of accelerations a in states: ∂a/∂q, ∂a/∂v and M⁻¹, (B, n, n) each, row i being that of a_i."""

    of_positions: proved.Enclosure
    of_rates: proved.Enclosure
    inverse_mass: proved.Enclosure


def enclosed_derivatives(system: DocumentSystem, theta: Floats, omega: Floats) -> Derivatives:
    """∂θ̈/∂θ [1/s²], ∂θ̈/∂θ̇ [1/s] and M⁻¹ [1/(kg m²)] in absolute angles, for states (B, n).

    Proved to 2⁻⁸⁰ of the largest entry of each matrix; raises ArithmeticError where that fails.
    """
    parts = [proved.enclosed(partial(_in_balls, system, theta[k : k + 1], omega[k : k + 1])) for k in range(len(theta))]
    shape = (3, 0, system.n, system.n)
    high, low, radius = (
        np.stack([part[k][:, 0] for part in parts], axis=1) if parts else np.empty(shape) for k in range(3)
    )
    return Derivatives(*(proved.Enclosure(high[k], low[k], radius[k]) for k in range(3)))


def _in_balls(system: DocumentSystem, theta: Floats, omega: Floats, _bits: int) -> Array:
    """The three matrices of one state (1, n) as balls, (3, 1, n, n)."""
    import flint

    xp, n = balls(), system.n
    t, w = xp.array(theta), xp.array(omega)
    a = proved.accelerations_in_balls(system, t, w)[0]
    mass, centrifugal = motion.mass_matrix(system, t)[0], motion.centrifugal_matrix(system, t)[0]
    slope = motion.gravity_vector(system, t + flint.arb.pi() / 2)[0]  # sin(θ + π/2) = cos θ
    squares = w[0] * w[0]
    of_angles, of_rates = centrifugal * a - mass * squares, 2 * centrifugal * w[0]
    for k in range(n):
        others = [j for j in range(n) if j != k]
        pulls = (mass[k, j] * squares[j] - centrifugal[k, j] * a[j] for j in others)
        of_angles[k, k] = sum(pulls, start=slope[k])
    rows = [[-x for x in (*of_angles[i], *of_rates[i])] + [flint.arb(int(i == k)) for k in range(n)] for i in range(n)]
    solved = flint.arb_mat(mass.tolist()).solve(flint.arb_mat(rows)).tolist()
    return np.array(solved, dtype=object).reshape(n, 3, n).swapaxes(0, 1)[:, None]
