"""Forward dynamics of both systems in O(n), free of cancellation: one text for numpy and for compiled code.

For rods this is the articulated-body algorithm (ABA): Λ is the articulated-body inertia of the subtree below a joint,
2 × 2 since a joint transmits no torque, and β its bias force. Every function here is elementwise arithmetic: it takes
numbers or arrays (of any float type), and :mod:`.forward_dynamics_compiled` compiles it unchanged. Frames:
p_j = (sin θ_j, -cos θ_j) along link j, q_j = (cos θ_j, sin θ_j) across it.

**Rod chain** (Takeno). Let a_j be the acceleration of joint j less gravity, a_j = r̂''_j + g e_y, so that a_0 = g e_y,
and w_j = l_j ω_j². Differentiating (1) twice, a_j = a_{j-1} + q_j l_j θ''_j - p_j w_j. Eliminating T_{j-1} from (3) and
(6) gives the moments about the upper end, and (3) itself the force there (every T linear in the motion above it):

    (m/3) lθ'' = q·T_j - (m/2) q·a_{j-1}                                            (6) with (3)
    T_{j-1} = T_j - m (a_{j-1} + (q lθ'' - p w)/2)                                  (3)
    T_j = -(Λ_j a_j + β_j),   Λ_n = 0,  β_n = 0                                     ansatz, (8)

In the frame (p, q) of rod j let Λ = (A, B; B, C), D = det Λ, β = (P, Q), a_{j-1} = (a, b). Inserting a_j:

    κ = 1/(m/3 + C),   τ = w B - Q,   lθ'' = κ (τ - B a - (m/2 + C) b)
    Λ' = Λ + m I - κ u uᵀ,   β' = β + κ τ u - w (Λ p + m p/2),   u = (B, m/2 + C)

Written out so, A', B', C' and P', Q' subtract nearly equal numbers. Multiplied out, what cancels is gone:

    E  = A - κB²            = κ (A m/3 + D)           A' = m + E
    B' = B - κB (m/2 + C)   = -κ (m/6) B              C' = κ m (C/3 + m/12)
    P' = P - κBQ - w (m/2 + E)                        Q' = κ τ m/6
    b + lθ'' = κ (τ - B a - (m/6) b)                  D' = A'C' - B'²  with  B'² ≤ A'C'/4

(the last because B² ≤ AC); so C' sin² + … after the rotation into the frame of rod j-1, by θ_j - θ_{j-1}, does not
cancel either. Only sines and cosines of differences of neighbouring angles are needed, of θ_1 - 0 first.

One cancellation is left: T = -(Λ a + β) between a heavy rod and a light one, where what moves the light rod is a small
difference of the heavy one's Λ a and β. Such chains (:data:`UNEQUAL`) get one step of iterative refinement. The forces
follow from the motion just found by (3) alone, T_n = 0 upwards, and are as exact as they are large; the residual of
(6) with (3),

    δ = q·T_j - (m/2) b - (m/3) lθ'',

is eliminated as before, with w = 0 and g = 0 (τ = δ - Q, P' = P + κB (δ - Q), Q' = (1 + κ m/6) δ - (κ m/6) Q), and
added to lθ''. Where 1 state in 50 had errors up to 1e-13 (lengths 1 to 1000, 20 rods), the worst is then 2e-15.

**N-leg pendulum** (Shiki (3.9), (3.12)). S_i = sin(θ1 - θi), C_i = cos(θ1 - θi), h = g cos θ1 + l1 ω1², w_i = l_i ω_i².
Row i > 1 gives l_i θi'' = l1 ω1² S_i - C_i l1 θ1'' - g sin θi. Put into row 1, Σm - Σ m_i C_i² = m1 + Σ m_i S_i², and
with l1 θ1'' = G - g sin θ1 and sin θi = C_i sin θ1 - S_i cos θ1 all that cancels for aligned legs drops out:

    G = -Σ m_i S_i (w_i + h C_i) / (m1 + Σ m_i S_i²)
    l1 θ1'' = G - g sin θ1,      l_i θi'' = h S_i - C_i G
"""

from __future__ import annotations

from typing import Any

UNEQUAL = 4.0  # ratio of the longest to the shortest rod from which on a chain is refined
Number = Any  # a float, a numpy array of any float type, or what numba makes of them


def difference(x: Number, y: Number) -> tuple[Number, Number]:
    """x - y as an unevaluated sum of its rounded value and the rounding error, exactly (Knuth's two-sum)."""
    high = x - y
    back = high - x
    return high, (x - (high - back)) - (y + back)


def absorb_rod(
    m: Number, w: Number, A: Number, B: Number, C: Number, D: Number, P: Number, Q: Number
) -> tuple[Number, ...]:
    """Λ, β of a rod's lower joint to those of its upper joint, in the rod's own frame.

    Returns A', B', C', P', Q' and what :func:`rod_acceleration` needs: κτ, κB, κm/6.
    """
    kappa = 1 / (m / 3 + C)
    kappa_B, kappa_m6 = kappa * B, kappa * (m / 6)
    kappa_tau = kappa * (w * B - Q)
    E = kappa * (A * (m / 3) + D)
    return (
        m + E,
        -kappa_m6 * B,
        kappa * (C * (m / 3) + m * m / 12),
        P - kappa_B * Q - w * (m / 2 + E),
        kappa_tau * (m / 6),
        kappa_tau,
        kappa_B,
        kappa_m6,
    )


def turn(s: Number, c: Number, A: Number, B: Number, C: Number, P: Number, Q: Number) -> tuple[Number, ...]:
    """Λ and β from a rod's frame into its parent's; s, c: sine and cosine of own angle less parent's.

    Returns A, B, C, D = det Λ, P, Q.
    """
    cc, ss, cs = c * c, s * s, c * s
    return (
        A * cc - 2 * (B * cs) + C * ss,
        (A - C) * cs + B * (cc - ss),
        A * ss + 2 * (B * cs) + C * cc,
        A * C - B * B,
        c * P - s * Q,
        s * P + c * Q,
    )


def rod_acceleration(
    s: Number, c: Number, w: Number, kappa_tau: Number, kappa_B: Number, kappa_m6: Number, along: Number, across: Number
) -> tuple[Number, Number, Number]:
    """lθ'' of a rod, and a_j (along, across) in its frame, from a_{j-1} in its parent's frame."""
    a = c * along + s * across
    b = c * across - s * along
    moved = kappa_tau - kappa_B * a - kappa_m6 * b
    return moved - b, a - w, moved


def turn_down(s: Number, c: Number, along: Number, across: Number) -> tuple[Number, Number]:
    """A vector from the parent's frame into the rod's."""
    return c * along + s * across, c * across - s * along


def turn_up(s: Number, c: Number, along: Number, across: Number) -> tuple[Number, Number]:
    """A vector from the rod's frame into its parent's."""
    return c * along - s * across, s * along + c * across


def force_above(
    m: Number, w: Number, a: Number, b: Number, x: Number, along: Number, across: Number
) -> tuple[Number, Number]:
    """T_{j-1} from T_j, both in rod j's frame, by (3); a, b: a_{j-1} in it, x: lθ''."""
    return along - m * (a - w / 2), across - m * (b + x / 2)


def moment_residual(m: Number, b: Number, x: Number, across: Number) -> Number:
    """δ, the residual of the moments of rod j; across: q·T_j."""
    return (across - (m / 2) * b) - (m / 3) * x


def absorb_residual(
    m: Number, delta: Number, kappa_B: Number, kappa_m6: Number, P: Number, Q: Number
) -> tuple[Number, Number, Number]:
    """P', Q' and κτ of the correction, in the rod's frame."""
    rest = delta - Q
    return P + kappa_B * rest, delta + kappa_m6 * rest, kappa_m6 * rest / (m / 6)


def leg_terms(m: Number, w: Number, h: Number, s: Number, c: Number) -> tuple[Number, Number]:
    """A leg's terms of the two sums in G: m S (w + h C) and m S²."""
    return m * s * (w + h * c), m * s * s
