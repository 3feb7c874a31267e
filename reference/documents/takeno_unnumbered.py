"""Takeno 2018: the displays that have no number, with the symbols of :mod:`.takeno`.

Each is called by the numbers that it stands between. Members are flat over j, or over the pairs j, k that a display is
about, where it is about some of them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arithmetic import Arithmetic, Array, sum_after
from .equation import Equation, Members
from .takeno import b_of_a, e_y, eq_21, later, p, p_second_derivative, q


def directions(xp: Arithmetic, theta: Array) -> Members:
    """p(θ) and q(θ), shape (n, 2) each."""
    return p(xp, theta), q(xp, theta)


def moment_below(xp: Arithmetic, l: Array, theta: Array, T: Array) -> Members:
    """The moment of T_j about the centre of rod j [N m], shape (n,)."""
    return (l / 2 * (T[1:] * q(xp, theta)).sum(-1),)


def moment_above(xp: Arithmetic, l: Array, theta: Array, T: Array) -> Members:
    """The moment of -T_{j-1} [N m], shape (n,): two forms."""
    across = q(xp, theta)
    return l / 2 * ((-T[:-1]) * (-across)).sum(-1), l / 2 * (T[:-1] * across).sum(-1)


def telescope(T: Array) -> Members:
    """The sum of (7) over the rods below, and T_k [N], shape (n, 2)."""
    each = T[:-1] - T[1:]
    return each + sum_after(each, axis=-2), T[:-1]


def coefficients(m: Array, a: Array) -> Members:
    """b_jk by a_jk [kg m], shape (n, n)."""
    return (b_of_a(m, a),)


def coefficients_before(l: Array, rho: Array, m: Array, L: Array) -> Members:
    """b_jk for k < j [kg m]: two forms."""
    below = sum_after(m)
    pairs = list(_pairs(len(l)))
    return (
        np.array([m[j] * l[k] + 2 * below[j] * l[k] for k, j in pairs]),
        np.array([2 * rho * L[j] * l[k] for k, j in pairs]),
    )


def coefficients_at(l: Array, rho: Array, m: Array, a: Array, L: Array) -> Members:
    """b_jj [kg m], shape (n,): three forms."""
    n, below = len(l), sum_after(m)
    first = [m[j] * a[j, j] + 2 * sum((m[i] * a[i, j] for i in range(j + 1, n)), 0 * m[j] * l[j]) for j in range(n)]
    return np.array(first), m * l / 2 + 2 * below * l, 2 * rho * (L - l / 4) * l


def coefficients_after(l: Array, rho: Array, m: Array, a: Array, L: Array) -> Members:
    """b_jk for k > j [kg m]: three forms."""
    n, below = len(l), sum_after(m)
    ks = [k for _, k in _pairs(n)]
    first = [2 * m[k] * a[k, k] + 2 * sum((m[i] * a[i, k] for i in range(k + 1, n)), 0 * m[k] * l[k]) for k in ks]
    second = [m[k] * l[k] + 2 * below[k] * l[k] for k in ks]
    return np.array(first), np.array(second), np.array([2 * rho * L[k] * l[k] for k in ks])


def second_derivative(xp: Arithmetic, theta: Array, omega: Array, alpha: Array) -> Members:
    """d²/dt² p(θ_k) [1/s²], shape (n, 2): with the derivatives of p, and with p and q."""
    cos, sin = xp.cos_sin(theta)
    first, second = np.stack([cos, sin], axis=-1), np.stack([-sin, cos], axis=-1)
    squares = (omega**2)[..., None]
    return second * squares + first * alpha[..., None], p_second_derivative(xp, theta, omega, alpha)


def products(xp: Arithmetic, theta: Array) -> Members:
    """p(θ_k)·q(θ_j), q(θ_k)·q(θ_j) and e_y·q(θ_j), each by its components and in its last form; (2, n (2n + 1))."""
    cos, sin = xp.cos_sin_differences(theta)
    along, across, up = p(xp, theta), q(xp, theta), e_y(xp)
    pairs = [(j, k) for j in range(len(theta)) for k in range(len(theta))]
    left = [(along[k] * across[j]).sum() for j, k in pairs] + [(across[k] * across[j]).sum() for j, k in pairs]
    right = [-sin[j, k] for j, k in pairs] + [cos[j, k] for j, k in pairs]
    left += [(up * across[j]).sum() for j in range(len(theta))]
    return np.array(left), np.array(right + list(xp.sin(theta)))


def rotation(
    xp: Arithmetic,
    l: Array,
    rho: Array,
    m: Array,
    g: Array,
    theta: Array,
    omega: Array,
    alpha: Array,
    L: Array,
    T: Array,
) -> Members:
    """(6) with (16) in it [N], shape (n,): three forms."""
    cos, sin = xp.cos_sin_differences(theta)
    lengths = (later(L) - np.diag(l / 4)) * l
    inner = (lengths * ((omega**2)[None, :] * sin + alpha[None, :] * cos)).sum(-1)
    return m * l / 12 * alpha, ((T[1:] + T[:-1]) * q(xp, theta)).sum(-1) / 2, -rho * inner - rho * L * g * xp.sin(theta)


def own_acceleration(l: Array, alpha: Array, L: Array) -> Members:
    """The terms of θ̈_j in (17) [m²/s²], shape (n,): two forms."""
    return l**2 / 12 * alpha + (L - l / 4) * l * alpha, (L - l / 6) * l * alpha


def equal_lengths(l: Array, L: Array) -> Members:
    """α_jk for rods of one length [m], shape (n, n): three forms."""
    n, one = len(l), l[0]
    middle, last = np.empty((n, n), dtype=object), np.empty((n, n), dtype=object)
    for j in range(n):
        for k in range(n):
            whole = n - max(j, k) - 1
            middle[j, k] = one * whole + one / 2 - (one / 6 if j == k else one * 0)
            last[j, k] = one * whole + (one / 3 if j == k else one / 2)
    return later(L) - np.diag(l / 6), middle, last


def symmetry(xp: Arithmetic, l: Array, theta: Array, alpha_jk: Array) -> Members:
    """A, its transpose, B and minus its transpose, for rods of one length [m²], shape (n, n) each."""
    ((a, b),) = eq_21(xp, l, theta, alpha_jk)
    return a, a.T, b, -b.T


def _pairs(n: int) -> Iterator[tuple[int, int]]:
    """All j < k."""
    return ((j, k) for j in range(n) for k in range(j + 1, n))


UNNUMBERED: tuple[Equation, ...] = (
    Equation(
        "takeno", "before 1", "position", "the directions p and q",
        "p(θ) = (sin θ, −cos θ), q(θ) = (cos θ, sin θ)", directions,
    ),
    Equation("takeno", "before 4, first", "force", "the moment of the force below", "(lⱼ/2) Tⱼ·q(θⱼ)", moment_below),
    Equation(
        "takeno", "before 4, second", "force", "the moment of the force above",
        "(lⱼ/2) (−Tⱼ₋₁)·(−q(θⱼ)) = (lⱼ/2) Tⱼ₋₁·q(θⱼ)", moment_above,
    ),
    Equation(
        "takeno", "before 8", "force", "the sum of (7) over the rods below",
        "(Tₖ − Tₖ₊₁) + … + (Tₙ₋₁ − Tₙ) = Tₖ", telescope,
    ),
    Equation(
        "takeno", "before 15, first", "motion", "bⱼₖ by the coefficients of (10)", "bⱼₖ = mⱼ aⱼₖ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ aᵢₖ",
        coefficients,
    ),
    Equation(
        "takeno", "before 15, k < j", "motion", "bⱼₖ of a rod above",
        "bⱼₖ = mⱼ lₖ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ lₖ = 2ρ Lⱼ lₖ", coefficients_before,
    ),
    Equation(
        "takeno", "before 15, k = j", "motion", "bⱼⱼ",
        "bⱼⱼ = mⱼ aⱼⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ aᵢⱼ = mⱼ lⱼ/2 + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ lⱼ = 2ρ (Lⱼ − lⱼ/4) lⱼ", coefficients_at,
    ),
    Equation(
        "takeno", "before 15, k > j", "motion", "bⱼₖ of a rod below",
        "bⱼₖ = 2 mₖ aₖₖ + 2 Σᵢ₌ₖ₊₁ⁿ mᵢ aᵢₖ = mₖ lₖ + 2 Σᵢ₌ₖ₊₁ⁿ mᵢ lₖ = 2ρ Lₖ lₖ", coefficients_after,
    ),
    Equation(
        "takeno", "before 17, first", "motion", "the second derivative of a direction",
        "p̈(θₖ) = p″(θₖ) θ̇ₖ² + p′(θₖ) θ̈ₖ = −p(θₖ) θ̇ₖ² + q(θₖ) θ̈ₖ", second_derivative,
    ),
    Equation(
        "takeno", "before 17, second", "motion", "products of the directions",
        "p(θₖ)·q(θⱼ) = −sin(θⱼ − θₖ), q(θₖ)·q(θⱼ) = cos(θⱼ − θₖ), e_y·q(θⱼ) = sin θⱼ", products,
    ),
    Equation(
        "takeno", "before 17, third", "motion", "(6) with (16) in it",
        "(mⱼ lⱼ/12) θ̈ⱼ = ½ (Tⱼ + Tⱼ₋₁)·q(θⱼ) = −ρ Σₖ (Lⱼ∨ₖ − (lⱼ/4) δⱼₖ) lₖ {θ̇ₖ² sin(θⱼ − θₖ) + θ̈ₖ cos(θⱼ − θₖ)}"
        " − ρ Lⱼ g sin θⱼ", rotation,
    ),
    Equation(
        "takeno", "before 18", "motion", "the terms of the own acceleration in (17)",
        "(lⱼ²/12) θ̈ⱼ + (Lⱼ − lⱼ/4) lⱼ θ̈ⱼ = (Lⱼ − lⱼ/6) lⱼ θ̈ⱼ", own_acceleration,
    ),
    Equation(
        "takeno", "before 19", "motion", "the coefficients for rods of one length",
        "Lⱼ∨ₖ − (l/6) δⱼₖ = l (n − j∨k + ½) − (l/6) δⱼₖ = l (n − j∨k + ½) (j ≠ k), l (n − j + ⅓) (j = k)",
        equal_lengths,
    ),
    Equation(
        "takeno", "after 22", "matrix", "symmetry for rods of one length", "A(θ)ᵀ = A(θ), B(θ)ᵀ = −B(θ)", symmetry,
    ),
)  # fmt: skip
