"""Enclosed accelerations of long chains and of many legs, in O(n): Newton's and Euler's equations in ball arithmetic.

:mod:`.enclosures` solves the literal equations, whose matrix is dense; that is too much for a thousand rods. Here the
joint forces are the unknowns, as Takeno has them before he eliminates them. With Q_j = q_j q_jᵀ, (3) and (6) in the
conditions that the rods' ends move together, r''_j + (l_j/2) p''_j = r''_{j+1} - (l_{j+1}/2) p''_{j+1}, read

    (3 Q_j - 1)/m_j T_{j-1} + ((3 Q_j + 1)/m_j + (3 Q_{j+1} + 1)/m_{j+1}) T_j + (3 Q_{j+1} - 1)/m_{j+1} T_{j+1}
        = (l_j ω_j² p_j + l_{j+1} ω_{j+1}² p_{j+1})/2,      j = 1 … n-1, and for j = 0 without rod 0, -g e_y added,

block tridiagonal in T_0 … T_{n-1}. It is solved at some precision without regard to errors, and the result is *proved*
afterwards. For accelerations α̃, (8) gives forces, and what is left of (6), ρ_j = I_j α̃_j - (l_j/2) (T_j + T_{j-1})·q_j,
is row j of M α̃ + C ω² + G. Kinetic energy is not less than that of the turning about the centres alone, so
M ≥ diag(I_j), and for the error e = M⁻¹ ρ

    Σ I_j e_j² ≤ e·M e = e·ρ ≤ (Σ I_j e_j²)^½ (Σ ρ_j²/I_j)^½,      hence      |e_j| ≤ (Σ ρ_k²/I_k)^½ / √I_j.

Interval arithmetic run through the recursion itself would need some 16 bits for every rod.

The N-leg pendulum's rows i > 1 of Shiki (3.12) hold two unknowns each; putting them into row 1 leaves one equation,
with sums only, and is done in balls as it stands.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, RodChain
from .enclosures import AS_GOOD_AS_ZERO, MOST_BITS, RELATIVE_RADIUS, SMALLEST, Enclosure, precision

Floats = NDArray[np.float64]

FEWEST_BITS = 160


def enclosed_accelerations(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """θ̈ [rad/s²] of the documents' equations of motion in states (…, n), each with a proved radius.

    The same result as :func:`.enclosures.enclosed_accelerations`, with the same promise, for any n; raises
    ArithmeticError where it cannot be kept.
    """
    theta, omega = np.broadcast_arrays(np.asarray(theta, dtype=np.float64), np.asarray(omega, dtype=np.float64))
    rows = [_proven(system, t, w) for t, w in zip(*(a.reshape(-1, system.n) for a in (theta, omega)), strict=True)]
    parts = (np.array([row[k] for row in rows]).reshape(theta.shape) for k in range(3))
    return Enclosure(*parts)


def close_accelerations(system: DocumentSystem, theta: Floats, omega: Floats, bits: int = FEWEST_BITS) -> list[Any]:
    """θ̈ of one state (n,) as balls' midpoints at this precision, without a proof: for differences of close states."""
    with precision(bits):
        state = theta.tolist(), omega.tolist()
        found = _rods(system, *state) if isinstance(system, RodChain) else _legs(system, *state)
        return [ball.mid() for ball in found]


def _proven(system: DocumentSystem, theta: Floats, omega: Floats) -> tuple[list[float], list[float], list[float]]:
    bits = FEWEST_BITS
    while True:
        with precision(bits):
            try:
                split = _split(_enclosed(system, theta.tolist(), omega.tolist()))
            except ZeroDivisionError:  # too few bits to tell a pivot from zero
                split = None
        if split is not None:
            largest = max(map(abs, split[0]))
            if max(split[2]) <= max(RELATIVE_RADIUS * largest, AS_GOOD_AS_ZERO):
                return split
        if bits >= MOST_BITS:
            raise ArithmeticError(f"no enclosure of this state with {bits} bits")
        bits *= 2


def _enclosed(system: DocumentSystem, theta: list[float], omega: list[float]) -> list[Any]:
    if not isinstance(system, RodChain):
        return _legs(system, theta, omega)
    guess = _rods(system, theta, omega)
    return _proved(system, theta, omega, guess)


def _split(balls: Sequence[Any]) -> tuple[list[float], list[float], list[float]]:
    """Balls as unevaluated sums of two doubles, and radii."""
    high = [float(ball.mid()) for ball in balls]
    low = [float((ball - h).mid()) for ball, h in zip(balls, high, strict=True)]
    rest = (float((ball - h - l).abs_upper()) for ball, h, l in zip(balls, high, low, strict=True))
    return high, low, [r * (1 + 2.0**-52) + SMALLEST if r else 0.0 for r in rest]


def _frames(theta: list[float]) -> tuple[list[Any], list[Any]]:
    from flint import arb

    pairs = [arb(angle).sin_cos() for angle in theta]
    return [s for s, _ in pairs], [c for _, c in pairs]


def _rods(system: RodChain, theta: list[float], omega: list[float]) -> list[Any]:
    """Midpoints of α̃; ρ is a factor of every force and is taken for one, so that m_j = l_j.

    Blocks are symmetric 2 × 2 matrices (xx, xy, yy), the unknowns T_j pairs. Radii are dropped on the way.
    """
    from flint import arb

    n, g = system.n, arb(system.gravity)
    s, c = _frames(theta)
    l = [arb(length) for length in system.lengths]
    turn = [3 * cj * cj for cj in c], [3 * cj * sj for cj, sj in zip(c, s, strict=True)], [3 * sj * sj for sj in s]
    half = [lj * arb(w) ** 2 / 2 for lj, w in zip(l, omega, strict=True)]  # l ω²/2
    own = [((turn[0][j] + 1) / l[j], turn[1][j] / l[j], (turn[2][j] + 1) / l[j]) for j in range(n)]
    off = [((turn[0][j] - 1) / l[j], turn[1][j] / l[j], (turn[2][j] - 1) / l[j]) for j in range(n)]
    inverses: list[tuple[Any, Any, Any]] = []
    rights: list[tuple[Any, Any]] = []
    for j in range(n):  # joint j lies between the document's rods j and j+1, here l[j-1] and l[j]
        a, b, d = own[j]
        x, y = half[j] * s[j], -half[j] * c[j]
        if j == 0:
            y = y - g
        else:
            above, (ia, ib, id_) = own[j - 1], inverses[-1]
            ea, eb, ed = off[j - 1]
            u, v, w, z = ia * ea + ib * eb, ia * eb + ib * ed, ib * ea + id_ * eb, ib * eb + id_ * ed  # D⁻¹ E
            a, b, d = (
                a + above[0] - (ea * u + eb * w),
                b + above[1] - (ea * v + eb * z),
                d + above[2] - (eb * v + ed * z),
            )
            rx, ry = rights[-1]
            x = x + half[j - 1] * s[j - 1] - (u * rx + w * ry)
            y = y - half[j - 1] * c[j - 1] - (v * rx + z * ry)
        determinant = a * d - b * b
        inverses.append(((d / determinant).mid(), (-b / determinant).mid(), (a / determinant).mid()))
        rights.append((x.mid(), y.mid()))
    alpha = [arb(0)] * n
    below = arb(0), arb(0)
    for j in reversed(range(n)):
        (ia, ib, id_), (x, y) = inverses[j], rights[j]
        if j < n - 1:
            ea, eb, ed = off[j]
            x, y = x - (ea * below[0] + eb * below[1]), y - (eb * below[0] + ed * below[1])
        force = (ia * x + ib * y).mid(), (ib * x + id_ * y).mid()
        across = (force[0] + below[0]) * c[j] + (force[1] + below[1]) * s[j]
        alpha[j] = (6 * across / (l[j] * l[j])).mid()  # (6), with m_j = l_j
        below = force
    return alpha


def _proved(system: RodChain, theta: list[float], omega: list[float], alpha: list[Any]) -> list[Any]:
    """``alpha`` (midpoints) as balls that hold the true accelerations, by the bound above."""
    from flint import arb

    n, g = system.n, arb(system.gravity)
    s, c = _frames(theta)
    l = [arb(length) for length in system.lengths]
    turned = [length * angular for length, angular in zip(l, alpha, strict=True)]
    drawn = [length * arb(w) ** 2 for length, w in zip(l, omega, strict=True)]
    x = y = arb(0)
    pulls: list[tuple[Any, Any]] = []  # m_j (r''_j + g e_y)
    for j in range(n):
        dx, dy = turned[j] * c[j] - drawn[j] * s[j], turned[j] * s[j] + drawn[j] * c[j]
        pulls.append((l[j] * (x + dx / 2), l[j] * (y + dy / 2 + g)))
        x, y = x + dx, y + dy
    squares, fx, fy = arb(0), arb(0), arb(0)
    inertia = [length**3 / 12 for length in l]
    for j in reversed(range(n)):
        ux, uy = fx - pulls[j][0], fy - pulls[j][1]  # T_{j-1} = T_j - m_j (r''_j + g e_y)
        left = inertia[j] * alpha[j] - l[j] / 2 * ((fx + ux) * c[j] + (fy + uy) * s[j])
        squares += left.abs_upper() ** 2 / inertia[j]
        fx, fy = ux, uy
    reach = squares.abs_upper().sqrt()
    return [a + arb(0, (reach / i.sqrt()).abs_upper()) for a, i in zip(alpha, inertia, strict=True)]


def _legs(system: DocumentSystem, theta: list[float], omega: list[float]) -> list[Any]:
    """Shiki (3.12): l_i θi'' = -l1 C_i θ1'' + l1 ω1² S_i - g sin θi put into row 1."""
    from flint import arb

    g = arb(system.gravity)
    l, m, w = ([arb(x) for x in values] for values in (system.lengths, system.masses, omega))
    s = [arb(angle).sin() for angle in theta]
    apart = [(arb(theta[0]) - arb(angle)).sin_cos() for angle in theta]
    first = l[0] * w[0] ** 2
    total, inertia, right = sum(m, arb(0)), arb(0), arb(0)
    for i in range(1, system.n):
        S, C = apart[i]
        inertia += m[i] * C * C
        right += m[i] * (l[i] * w[i] ** 2 * S + C * (first * S - g * s[i]))
    moved = -(right + total * g * s[0]) / (total - inertia)  # l1 θ1''
    found = [moved / l[0]]
    for i in range(1, system.n):
        S, C = apart[i]
        found.append((first * S - C * moved - g * s[i]) / l[i])
    return found
