"""Takeno 2018, "Equations of the multiple rigid pendulum": every numbered equation, symbol by symbol.

n uniform rods of one line density ρ hang end to end from the origin. θ are absolute angles from the downward vertical,
positive to the right; x to the right, y up.

Symbols, with the document's index 1 at index 0 along the last axis: ``l`` lengths [m], ``rho`` [kg/m], ``m`` = ρ l_j
[kg], ``I`` moments of inertia [kg m²], ``g`` [m/s²], ``theta`` [rad], ``omega`` = θ̇, ``alpha`` = θ̈, all (…, n);
``r_hat`` joints r̂₀ … r̂_n [m] and ``T`` forces T₀ … T_n [N], shape (…, n + 1, 2), T_j being what rod j + 1 exerts on
rod j at their joint; ``r`` centres [m], ``r_ddot`` their accelerations and ``p_ddot`` = d²/dt² p(θ_k), shape
(…, n, 2); ``a``, ``b`` the coefficients of (10) and (14), ``alpha_jk`` those of (20), ``A``, ``B`` the matrices of
(21), shape (n, n); ``L`` the lengths of (12) [m]. ``xp`` is the arithmetic.

Each function returns the members of its equation: a tuple of what stands between the equals signs, as printed and in
that order, names that are only introduced left out. A misprint stands beside its correction as ``eq_…_printed``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arithmetic import Arithmetic, Array, sum_after, times
from .equation import Equation, Members, Slip

# ---------------------------------------------------------------- section 3: positions


def p(xp: Arithmetic, theta: Array) -> Array:
    """p(θ) = (sin θ, -cos θ), the direction of a rod, shape (…, n, 2); not numbered in the document."""
    cos, sin = xp.cos_sin(theta)
    return np.stack([sin, -cos], axis=-1)


def q(xp: Arithmetic, theta: Array) -> Array:
    """q(θ) = (cos θ, sin θ), p turned by π/2, shape (…, n, 2); not numbered in the document."""
    cos, sin = xp.cos_sin(theta)
    return np.stack([cos, sin], axis=-1)


def eq_1(xp: Arithmetic, l: Array, theta: Array) -> Members:
    """(1) Joints r̂₀ = 0 and r̂_j [m], shape (…, n + 1, 2)."""
    joints = np.cumsum(l[..., None] * p(xp, theta), axis=-2)
    support = xp.array(np.zeros((*joints.shape[:-2], 1, 2)))
    return (np.concatenate([support, joints], axis=-2),)


def eq_2(xp: Arithmetic, l: Array, theta: Array, r_hat: Array) -> Members:
    """(2) Centres r_j [m], shape (…, n, 2): from the joint above, and from all rods above."""
    rods = l[..., None] * p(xp, theta)
    half = l[..., None] / 2 * p(xp, theta)
    return r_hat[..., :-1, :] + half, _sum_before(rods) + half


# ---------------------------------------------------------------- section 4: forces


def eq_3(xp: Arithmetic, m: Array, g: Array, r_ddot: Array, T: Array) -> Members:
    """(3) Newton's equation for each rod, left and right side [N], shape (…, n, 2)."""
    return m[..., None] * r_ddot, T[..., 1:, :] - T[..., :-1, :] - m[..., None] * g * e_y(xp)


def eq_4(xp: Arithmetic, l: Array, I: Array, theta: Array, alpha: Array, T: Array) -> Members:
    """(4) Rotation of each rod about its centre, left and right side [N m], shape (…, n)."""
    return I * alpha, l / 2 * _dot(T[..., 1:, :] + T[..., :-1, :], q(xp, theta))


def eq_5(l: Array, rho: Array, m: Array) -> Members:
    """(5) Moment of inertia of a rod about its centre [kg m²], shape (…, n): four forms, the first the integral."""
    integral = (l / 2) ** 3 / 3 - (-l / 2) ** 3 / 3
    return rho * integral, 2 * rho / 3 * (l / 2) ** 3, rho * l**3 / 12, m * l**2 / 12


def eq_6(xp: Arithmetic, l: Array, m: Array, theta: Array, alpha: Array, T: Array) -> Members:
    """(6) The same as (4), divided by l_j, with (5) put in; left and right side [N], shape (…, n)."""
    return m * l / 12 * alpha, _dot(T[..., 1:, :] + T[..., :-1, :], q(xp, theta)) / 2


# ---------------------------------------------------------------- section 5: eliminating the forces


def eq_7(xp: Arithmetic, m: Array, g: Array, r_ddot: Array, T: Array) -> Members:
    """(7) Newton's equation solved for the difference of the forces [N], shape (…, n, 2); left and right side."""
    return T[..., :-1, :] - T[..., 1:, :], -m[..., None] * (r_ddot + g * e_y(xp))


def eq_8(xp: Arithmetic, m: Array, g: Array, r_ddot: Array) -> Members:
    """(8) Forces T₀ … T_{n-1} [N], shape (…, n, 2): the sum over all rods below."""
    each = m[..., None] * (r_ddot + g * e_y(xp))
    return (-(each + sum_after(each, axis=-2)),)


def eq_9(xp: Arithmetic, m: Array, g: Array, r_ddot: Array, T: Array) -> Members:
    """(9) T_j + T_{j-1} [N], shape (…, n, 2): itself, from (7) and (8), and with inertia and weight apart."""
    mj = m[..., None]
    each = mj * (r_ddot + g * e_y(xp))
    apart = -(mj * r_ddot + 2 * sum_after(mj * r_ddot, axis=-2)) - (mj + 2 * sum_after(mj, axis=-2)) * g * e_y(xp)
    return T[..., 1:, :] + T[..., :-1, :], -each - 2 * sum_after(each, axis=-2), apart


def eq_10(xp: Arithmetic, a: Array, theta: Array) -> Members:
    """(10) Centres r_j as sums over the rods' directions [m], shape (…, n, 2)."""
    return (_combined(a, p(xp, theta)),)


def eq_11(xp: Arithmetic, l: Array) -> Members:
    """(11) The coefficients a_jk of (10) [m], shape (n, n): l_k before, half of l_j at, nothing after k = j."""
    n = l.shape[-1]
    a = xp.array(np.zeros((n, n)))
    for j in range(n):
        a[j, :j] = l[:j]
        a[j, j] = l[j] / 2
    return (a,)


def eq_12(l: Array) -> Members:
    """(12), corrected: L_j, half of rod j and all rods below [m], shape (n,)."""
    return (l / 2 + sum_after(l),)


def eq_12_printed(l: Array, index: int = 0) -> Members:
    """(12) as printed: Σ_{i=j+1}^n l_m, with an index m that nothing binds; ``index`` stands in for it."""
    n = l.shape[-1]
    return (l / 2 + np.arange(n - 1, -1, -1) * l[index],)


def eq_13(l: Array, rho: Array, m: Array, L: Array) -> Members:
    """(13) The coefficient of the second term on the right of (9) [kg], shape (n,): three forms."""
    return m + 2 * sum_after(m), rho * (l + 2 * sum_after(l)), 2 * rho * L


def eq_14(xp: Arithmetic, m: Array, theta: Array, r: Array, a: Array, b: Array) -> Members:
    """(14) The first term on the right of (9), undifferentiated [kg m], shape (…, n, 2): four forms."""
    directions = p(xp, theta)
    mj = m[..., None]
    centres = _combined(a, directions)
    return (
        mj * r + 2 * sum_after(mj * r, axis=-2),
        mj * centres + 2 * sum_after(mj * centres, axis=-2),
        _combined(b_of_a(m, a), directions),
        _combined(b, directions),
    )


def b_of_a(m: Array, a: Array) -> Array:
    """b_jk = m_j a_jk + 2 Σ_{i>j} m_i a_ik [kg m], shape (n, n); between (14) and (15), not numbered."""
    each = m[..., None] * a
    return np.asarray(each + 2 * sum_after(each, axis=-2))


def eq_15(l: Array, rho: Array, L: Array) -> Members:
    """(15) The coefficients b_jk [kg m], shape (n, n): case by case, and in one formula."""
    n = l.shape[-1]
    by_case = np.empty((n, n), dtype=np.result_type(l, L))
    for j in range(n):
        by_case[j, :j] = 2 * rho * L[j] * l[:j]
        by_case[j, j] = 2 * rho * (L[j] - l[j] / 4) * l[j]
        by_case[j, j + 1 :] = 2 * rho * L[j + 1 :] * l[j + 1 :]
    return by_case, 2 * rho * (later(L) - _on_diagonal(l / 4)) * l


def eq_16(xp: Arithmetic, l: Array, rho: Array, g: Array, L: Array, p_ddot: Array, T: Array) -> Members:
    """(16) T_j + T_{j-1} from the directions' second derivatives [N], shape (…, n, 2); left and right side."""
    coefficients = 2 * rho * (later(L) - _on_diagonal(l / 4)) * l
    return (
        T[..., 1:, :] + T[..., :-1, :],
        -_combined(coefficients, p_ddot) - (2 * rho * L * g)[..., None] * e_y(xp),
    )


def p_second_derivative(xp: Arithmetic, theta: Array, omega: Array, alpha: Array) -> Array:
    """d²/dt² p(θ_k) = -p θ̇² + q θ̈ [1/s²], shape (…, n, 2); between (16) and (17), not numbered."""
    return np.asarray(-p(xp, theta) * (omega**2)[..., None] + q(xp, theta) * alpha[..., None])


def eq_17(xp: Arithmetic, l: Array, g: Array, theta: Array, omega: Array, alpha: Array, L: Array) -> Members:
    """(17) Equations of motion divided by ρ l_j, and zero [m²/s²], shape (…, n); a rod's own inertia stands apart."""
    cos, sin = xp.cos_sin_differences(theta)
    lengths = (later(L) - _on_diagonal(l / 4)) * l
    inner = (lengths * (alpha[..., None, :] * cos + (omega**2)[..., None, :] * sin)).sum(-1)
    return l**2 / 12 * alpha + inner + L * g * xp.sin(theta), xp.array(np.zeros(theta.shape))


def eq_18(xp: Arithmetic, l: Array, g: Array, theta: Array, omega: Array, alpha: Array, L: Array) -> Members:
    """(18) Equations of motion divided by ρ l_j, and zero [m²/s²], shape (…, n)."""
    cos, sin = xp.cos_sin_differences(theta)
    lengths = (later(L) - _on_diagonal(l / 6)) * l
    inner = (lengths * (alpha[..., None, :] * cos + (omega**2)[..., None, :] * sin)).sum(-1)
    return inner + L * g * xp.sin(theta), xp.array(np.zeros(theta.shape))


def eq_19(xp: Arithmetic, l: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(19) (18) for two rods of one length, divided by that length squared, and zero [1/s²], shape (…, 2)."""
    length = l[..., 0]
    t1, t2 = theta[..., 0], theta[..., 1]
    w1, w2 = omega[..., 0], omega[..., 1]
    a1, a2 = alpha[..., 0], alpha[..., 1]
    cos, sin = xp.cos_sin(t1 - t2)
    row1 = 4 * a1 / 3 + (a2 * cos + w2**2 * sin) / 2 + 3 * g / (2 * length) * xp.sin(t1)
    row2 = (a1 * cos - w1**2 * sin) / 2 + a2 / 3 + g / (2 * length) * xp.sin(t2)
    return xp.stack([row1, row2]), xp.array(np.zeros(theta.shape))


def eq_20(l: Array, L: Array) -> Members:
    """(20) α_jk [m], shape (n, n); symmetric."""
    return (later(L) - _on_diagonal(l / 6),)


def eq_21(xp: Arithmetic, l: Array, theta: Array, alpha_jk: Array) -> Members:
    """(21) The matrices A(θ) and B(θ) [m²], shape (…, 2, n, n)."""
    cos, sin = xp.cos_sin_differences(theta)
    lengths = l * alpha_jk
    return (np.stack([lengths * cos, lengths * sin], axis=-3),)


def eq_21_one(l: Array, of_differences: Array, alpha_jk: Array) -> Array:
    """(21) A(θ) or B(θ) alone [m²], shape (…, n, n), from the cosines or the sines of θ_j - θ_k."""
    return np.asarray(l * alpha_jk * of_differences)


def eq_22(xp: Arithmetic, g: Array, theta: Array, omega: Array, alpha: Array, A: Array, B: Array, L: Array) -> Members:
    """(22) Equations of motion in matrix form, and zero [m²/s²], shape (…, n)."""
    return times(A, alpha) + times(B, omega**2) + g * (L * xp.sin(theta)), xp.array(np.zeros(theta.shape))


# ---------------------------------------------------------------- what several of them share


def e_y(xp: Arithmetic) -> Array:
    """The unit vector (0, 1), upwards."""
    return xp.array([0, 1])


def later(L: Array) -> Array:
    """L_{j∨k}: the entry of the later of both indices, shape (n, n)."""
    index = np.arange(L.shape[-1])
    return np.asarray(L[np.maximum(index[:, None], index)])


def _on_diagonal(x: Array) -> Array:
    """x_j δ_jk, shape (n, n)."""
    return np.diag(x)


def _sum_before(x: Array) -> Array:
    """Σ x_k over k = 1 … j-1, along the last axis but one."""
    before: Array = np.zeros_like(x)
    before[..., 1:, :] = np.cumsum(x, axis=-2)[..., :-1, :]
    return before


def _combined(coefficients: Array, vectors: Array) -> Array:
    """Σ_k c_jk v_k for coefficients (n, n) and vectors (…, n, 2)."""
    return np.asarray((coefficients[..., None] * vectors[..., None, :, :]).sum(-2))


def _dot(u: Array, v: Array) -> Any:
    return (u * v).sum(-1)


# ---------------------------------------------------------------- index

EQUATIONS: tuple[Equation, ...] = (
    Equation("takeno", "1", "position", "where the joints are", "r̂₀ = 0, r̂ⱼ = Σₖ₌₁ʲ lₖ p(θₖ)", eq_1),
    Equation(
        "takeno", "2", "position", "where the rods' centres are",
        "rⱼ = r̂ⱼ₋₁ + (lⱼ/2) p(θⱼ) = Σₖ₌₁ʲ⁻¹ lₖ p(θₖ) + (lⱼ/2) p(θⱼ)", eq_2,
    ),
    Equation("takeno", "3", "force", "Newton's equation for each rod", "mⱼ r̈ⱼ = Tⱼ − Tⱼ₋₁ − mⱼ g e_y", eq_3),
    Equation("takeno", "4", "force", "rotation of each rod about its centre", "Iⱼ θ̈ⱼ = (lⱼ/2) (Tⱼ + Tⱼ₋₁)·q(θⱼ)", eq_4),
    Equation(
        "takeno", "5", "energy", "moment of inertia of a rod about its centre",
        "Iⱼ = ρ ∫ x² dx = (2ρ/3) (lⱼ/2)³ = ρ lⱼ³/12 = mⱼ lⱼ²/12", eq_5,
    ),
    Equation("takeno", "6", "force", "(4) divided by the length", "(mⱼ lⱼ/12) θ̈ⱼ = ½ (Tⱼ + Tⱼ₋₁)·q(θⱼ)", eq_6),
    Equation("takeno", "7", "force", "difference of neighbouring joint forces", "Tⱼ₋₁ − Tⱼ = −mⱼ (r̈ⱼ + g e_y)", eq_7),
    Equation("takeno", "8", "force", "the joint forces", "Tₖ = −Σⱼ₌ₖ₊₁ⁿ mⱼ (r̈ⱼ + g e_y)", eq_8),
    Equation(
        "takeno", "9", "force", "sum of neighbouring joint forces",
        "Tⱼ + Tⱼ₋₁ = −d²/dt² (mⱼ rⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ rᵢ) − (mⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ) g e_y", eq_9,
    ),
    Equation("takeno", "10", "position", "the centres by the rods' directions", "rⱼ = Σₖ aⱼₖ p(θₖ)", eq_10),
    Equation(
        "takeno", "11", "position", "the coefficients in (10)",
        "aⱼₖ = lₖ (k < j), lⱼ/2 (k = j), 0 (k > j)", eq_11,
    ),
    Equation(
        "takeno", "12", "motion", "half of a rod and all rods below it", "Lⱼ = lⱼ/2 + Σᵢ₌ⱼ₊₁ⁿ lᵢ", eq_12,
        printed=eq_12_printed,
        printed_formula="Lⱼ = lⱼ/2 + Σᵢ₌ⱼ₊₁ⁿ l_m",
        correction="l_i in place of l_m: nothing binds m (with equal lengths it makes no difference);"
        " the document goes on correctly, with l_i, in (13)",
    ),
    Equation(
        "takeno", "13", "motion", "the weight's coefficient in (9)",
        "mⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ = ρ (lⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ lᵢ) = 2ρ Lⱼ", eq_13,
    ),
    Equation(
        "takeno", "14", "motion", "the inertia's term in (9) by the rods' directions",
        "mⱼ rⱼ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ rᵢ = Σₖ p(θₖ) (mⱼ aⱼₖ + 2 Σᵢ₌ⱼ₊₁ⁿ mᵢ aᵢₖ) = Σₖ bⱼₖ p(θₖ)", eq_14,
    ),
    Equation(
        "takeno", "15", "motion", "the coefficients in (14)", "bⱼₖ = 2ρ (Lⱼ∨ₖ − (lⱼ/4) δⱼₖ) lₖ", eq_15
    ),
    Equation(
        "takeno", "16", "force", "sum of neighbouring joint forces by the rods' directions",
        "Tⱼ + Tⱼ₋₁ = −Σₖ 2ρ (Lⱼ∨ₖ − (lⱼ/4) δⱼₖ) lₖ p̈(θₖ) − 2ρ Lⱼ g e_y", eq_16,
    ),
    Equation(
        "takeno", "17", "motion", "the equations of motion, a rod's own inertia apart",
        "(lⱼ²/12) θ̈ⱼ + Σₖ (Lⱼ∨ₖ − (lⱼ/4) δⱼₖ) lₖ {θ̈ₖ cos(θⱼ − θₖ) + θ̇ₖ² sin(θⱼ − θₖ)} + Lⱼ g sin θⱼ = 0", eq_17,
    ),
    Equation(
        "takeno", "18", "motion", "the equations of motion",
        "Σₖ (Lⱼ∨ₖ − (lⱼ/6) δⱼₖ) lₖ {θ̈ₖ cos(θⱼ − θₖ) + θ̇ₖ² sin(θⱼ − θₖ)} + Lⱼ g sin θⱼ = 0", eq_18,
    ),
    Equation(
        "takeno", "19", "motion", "the equations of motion of two rods of one length",
        "(4/3) θ̈₁ + ½ {θ̈₂ cos(θ₁ − θ₂) + θ̇₂² sin(θ₁ − θ₂)} + (3g/2l) sin θ₁ = 0,"
        " ½ {θ̈₁ cos(θ₁ − θ₂) − θ̇₁² sin(θ₁ − θ₂)} + (1/3) θ̈₂ + (g/2l) sin θ₂ = 0", eq_19,
    ),
    Equation("takeno", "20", "matrix", "the coefficients in (18)", "αⱼₖ = Lⱼ∨ₖ − (lⱼ/6) δⱼₖ", eq_20),
    Equation(
        "takeno", "21", "matrix", "the matrices of the equations of motion",
        "A(θ) = [lₖ αⱼₖ cos(θⱼ − θₖ)], B(θ) = [lₖ αⱼₖ sin(θⱼ − θₖ)]", eq_21,
    ),
    Equation(
        "takeno", "22", "matrix", "the equations of motion as matrices",
        "A(θ) (θ̈ₖ) + B(θ) (θ̇ₖ²) + g (Lⱼ sin θⱼ) = 0", eq_22,
    ),
)  # fmt: skip

SLIPS: tuple[Slip, ...] = (
    Slip("takeno", "section 2, first paragraph", "その系", "その糸", "a string is meant, not a system"),
    Slip("takeno", "section 2, second paragraph", "(1)", "(図 1)", "figure 1 is meant; (1) gives the joints"),
    Slip("takeno", "section 4, before (4)", "(3)", "(図 3)", "figure 3 is meant; (3) is Newton's equation"),
    Slip("takeno", "section 4, before (4)", "r_j in italics", "r_j in bold", "the centre, a vector everywhere else"),
    Slip(
        "takeno", "section 5, before (18)", "θ_j の微分の項", "θ_j の 2 階微分の項",
        "the second derivatives are collected there; the first derivatives follow",
    ),
)  # fmt: skip
