"""Enclosed accelerations of long chains and of many legs, in O(n): Newton's and Euler's equations in ball arithmetic.

:mod:`.enclosures` solves the literal equations, whose matrix is dense; that is slow from a dozen links on, and too much
for a thousand. Here the block tridiagonal system of a rod chain's joint forces (:mod:`.block_tridiagonal`) is solved at
some precision without regard to errors, and the result is *proved* afterwards. For accelerations α̃, (8) gives forces,
and the residual of (6), ρ_j = I_j α̃_j - (l_j/2) (T_j + T_{j-1})·q_j, is row j of M α̃ + C ω² + G. Kinetic energy is not
less than that of the rotation about the centres alone, so M ≥ diag(I_j), and for the error e = M⁻¹ ρ

    Σ I_j e_j² ≤ e·M e = e·ρ ≤ (Σ I_j e_j²)^½ (Σ ρ_j²/I_j)^½,      hence      |e_j| ≤ (Σ ρ_k²/I_k)^½ / √I_j.

The N-leg pendulum's rows i > 1 of Shiki (3.12) hold two unknowns each; putting them into row 1 leaves one equation,
with sums only, and is done in balls as it stands.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, RodChain
from ..arithmetic import Array, balls
from ..documents.equations_of_motion import joint_forces
from .block_tridiagonal import chain_accelerations
from .enclosures import Enclosure, over_states, precision

Floats = NDArray[np.float64]

FEWEST_BITS = 160


def enclosed_accelerations(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """θ̈ [rad/s²] of the documents' equations of motion in states (…, n), each with a proved radius.

    The same result as :func:`.enclosures.enclosed_accelerations`, with the same promise, for any n; raises
    ArithmeticError where it cannot be kept.
    """
    return _in_each_state(lambda t, w, a: a, system, theta, omega, (system.n,))


def enclosed_joint_forces(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """Joint reaction forces [N] in the free motion, (…, n) in, (…, n, 2) out.

    The same result as :func:`.enclosures.enclosed_joint_forces`, with the same promise, for any n; raises
    ArithmeticError where it cannot be kept.
    """
    return _in_each_state(partial(joint_forces, system), system, theta, omega, (system.n, 2))


def _accelerations(system: DocumentSystem, theta: Array, omega: Array) -> Array:
    """θ̈ as balls, (B, n), of states that are doubles, given as balls."""
    rows = [
        _enclosed(system, t, w) for t, w in zip(*(x.astype(np.float64).tolist() for x in (theta, omega)), strict=True)
    ]
    return np.array(rows, dtype=object).reshape(theta.shape)


# A state that needs many bits must not have the others pay for them.
_in_each_state = partial(over_states, accelerate=_accelerations, bits=FEWEST_BITS, at_once=1)


def close_accelerations(system: DocumentSystem, theta: Floats, omega: Floats, bits: int = FEWEST_BITS) -> list[Any]:
    """θ̈ of one state (n,) as balls' midpoints at this precision, without a proof: for differences of close states."""
    with precision(bits):
        state = theta.tolist(), omega.tolist()
        found = _rods(system, *state) if isinstance(system, RodChain) else _legs(system, *state)
        return [ball.mid() for ball in found]


def _enclosed(system: DocumentSystem, theta: list[float], omega: list[float]) -> list[Any]:
    if not isinstance(system, RodChain):
        return _legs(system, theta, omega)
    guess = _rods(system, theta, omega)
    return _with_radii(system, theta, omega, guess)


def _frames(theta: list[float]) -> tuple[list[Any], list[Any]]:
    from flint import arb

    pairs = [arb(angle).sin_cos() for angle in theta]
    return [s for s, _ in pairs], [c for _, c in pairs]


def _rods(system: RodChain, theta: list[float], omega: list[float]) -> list[Any]:
    """Midpoints of α̃, close to the solution but not proved."""
    from flint import arb

    xp = balls()
    return list(chain_accelerations(xp, system, xp.array(theta), xp.array(omega), arb.mid))


def _with_radii(system: RodChain, theta: list[float], omega: list[float], alpha: list[Any]) -> list[Any]:
    """``alpha`` (midpoints) as balls that enclose the accelerations, by the bound above."""
    from flint import arb

    n, g = system.n, arb(system.gravity)
    s, c = _frames(theta)
    l = [arb(length) for length in system.lengths]
    tangential = [length * angular for length, angular in zip(l, alpha, strict=True)]
    centripetal = [length * arb(w) ** 2 for length, w in zip(l, omega, strict=True)]
    x = y = arb(0)
    forces: list[tuple[Any, Any]] = []  # m_j (r''_j + g e_y)
    for j in range(n):
        dx, dy = tangential[j] * c[j] - centripetal[j] * s[j], tangential[j] * s[j] + centripetal[j] * c[j]
        forces.append((l[j] * (x + dx / 2), l[j] * (y + dy / 2 + g)))
        x, y = x + dx, y + dy
    squares, fx, fy = arb(0), arb(0), arb(0)
    inertia = [length**3 / 12 for length in l]
    for j in reversed(range(n)):
        ux, uy = fx - forces[j][0], fy - forces[j][1]  # T_{j-1} = T_j - m_j (r''_j + g e_y)
        left = inertia[j] * alpha[j] - l[j] / 2 * ((fx + ux) * c[j] + (fy + uy) * s[j])
        squares += left.abs_upper() ** 2 / inertia[j]
        fx, fy = ux, uy
    reach = squares.abs_upper().sqrt()
    return [a + arb(0, (reach / i.sqrt()).abs_upper()) for a, i in zip(alpha, inertia, strict=True)]


def _legs(system: DocumentSystem, theta: list[float], omega: list[float]) -> list[Any]:
    """Balls that enclose the accelerations: l_i θi'' = -l1 C_i θ1'' + l1 ω1² S_i - g sin θi, Shiki (3.12), in row 1."""
    from flint import arb

    g = arb(system.gravity)
    l, m, w = ([arb(x) for x in values] for values in (system.lengths, system.masses, omega))
    s = [arb(angle).sin() for angle in theta]
    differences = [(arb(theta[0]) - arb(angle)).sin_cos() for angle in theta]
    first = l[0] * w[0] ** 2
    total, inertia, right = sum(m, arb(0)), arb(0), arb(0)
    for i in range(1, system.n):
        S, C = differences[i]
        inertia += m[i] * C * C
        right += m[i] * (l[i] * w[i] ** 2 * S + C * (first * S - g * s[i]))
    first_acceleration = -(right + total * g * s[0]) / (total - inertia)  # l1 θ1''
    found = [first_acceleration / l[0]]
    for i in range(1, system.n):
        S, C = differences[i]
        found.append((first * S - C * first_acceleration - g * s[i]) / l[i])
    return found
