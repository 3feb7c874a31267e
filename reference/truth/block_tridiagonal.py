"""Accelerations of a rod chain in O(n) with the joint forces as unknowns, in any arithmetic.

Newton's and Euler's equations as Takeno has them before he eliminates the joint forces. With Q_j = q_j q_jᵀ, (3) and
(6) in the conditions that the rods' ends move together, r''_j + (l_j/2) p''_j = r''_{j+1} - (l_{j+1}/2) p''_{j+1}, read

    (3 Q_j - 1)/m_j T_{j-1} + ((3 Q_j + 1)/m_j + (3 Q_{j+1} + 1)/m_{j+1}) T_j + (3 Q_{j+1} - 1)/m_{j+1} T_{j+1}
        = (l_j ω_j² p_j + l_{j+1} ω_{j+1}² p_{j+1})/2,      j = 1 … n-1, and for j = 0 without rod 0, -g e_y added,

symmetric, positive definite and block tridiagonal in T_0 … T_{n-1}; then (6) gives each θ''. ρ is a factor of every
force and is taken as one, so that m_j = l_j.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...models import RodChain
from ..arithmetic import Arithmetic, Array


def _unchanged(x: Any) -> Any:
    return x


def chain_accelerations(
    xp: Arithmetic, system: RodChain, theta: Array, omega: Array, carried: Callable[[Any], Any] = _unchanged
) -> Array:
    """θ'' [rad/s²] of one state, shape (n,) in and out: elimination from the support, substitution from the tip.

    ``carried`` is applied to every number that one rod hands to the next. Balls need it: their radii would grow by some
    16 bits a rod.
    """
    n, g = system.n, xp.array([system.gravity])[0]
    cosines, sines = xp.cos_sin(theta)
    c, s, l = list(cosines), list(sines), list(xp.array(system.lengths))
    half = [lj * w**2 / 2 for lj, w in zip(l, omega, strict=True)]  # l ω²/2
    # Symmetric 2 × 2 blocks (xx, xy, yy): of each rod on the diagonal, and beside it.
    turn = [(3 * cj * cj, 3 * cj * sj, 3 * sj * sj) for cj, sj in zip(c, s, strict=True)]
    own = [((xx + 1) / lj, xy / lj, (yy + 1) / lj) for (xx, xy, yy), lj in zip(turn, l, strict=True)]
    off = [((xx - 1) / lj, xy / lj, (yy - 1) / lj) for (xx, xy, yy), lj in zip(turn, l, strict=True)]
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
        inverses.append((carried(d / determinant), carried(-b / determinant), carried(a / determinant)))
        rights.append((carried(x), carried(y)))
    alpha = np.empty(n, dtype=xp.dtype)
    below: tuple[Any, Any] | None = None  # T_j; none below the last rod
    for j in reversed(range(n)):
        (ia, ib, id_), (x, y) = inverses[j], rights[j]
        if below is not None:
            ea, eb, ed = off[j]
            x, y = x - (ea * below[0] + eb * below[1]), y - (eb * below[0] + ed * below[1])
        force = carried(ia * x + ib * y), carried(ib * x + id_ * y)
        across = force if below is None else (force[0] + below[0], force[1] + below[1])
        alpha[j] = carried(6 * (across[0] * c[j] + across[1] * s[j]) / (l[j] * l[j]))  # (6)
        below = force
    return alpha
