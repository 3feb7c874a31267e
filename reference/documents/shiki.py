"""Shiki 2020, "Equations of motion of the double N-leg pendulum": every numbered equation, symbol by symbol.

A mass m₁ hangs on a rod l₁ from the origin; masses m₂ … m_{n+1} hang from m₁ on rods of their own. Rods weigh nothing.
θ are absolute angles from the downward vertical, x to the right, y up.

Symbols, with the document's index 1 at index 0: ``l`` lengths [m], ``m`` masses [kg], ``g`` gravity [m/s²], ``theta``
[rad], ``omega`` = θ̇ [rad/s], ``alpha`` = θ̈ [rad/s²], shape (…, n) with n counting angles (chapter 3's n + 1);
``velocity`` = (ẋ_i, ẏ_i) [m/s], shape (…, n, 2); ``speed_squared`` = |ẋ_i|² [m²/s²], shape (…, n);
``momentum_rate`` = d/dt ∂L/∂θ̇_i and ``dL_dtheta`` = ∂L/∂θ_i [N m], shape (…, n). ``xp`` is the arithmetic.

Each function returns the members of its equation: a tuple of what stands between the equals signs, as printed and in
that order, names that are only introduced left out. A misprint stands beside its correction as ``eq_…_printed``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arithmetic import Arithmetic, Array, components, times
from .equation import Equation, Members, Slip

# ---------------------------------------------------------------- chapter 1: double pendulum


def eq_1_1(xp: Arithmetic, l: Array, theta: Array) -> Members:
    """(1.1) Positions (x_i, y_i) of both masses [m], shape (…, 2, 2)."""
    l1, l2 = components(l)
    t1, t2 = components(theta)
    x1 = l1 * xp.sin(t1)
    y1 = -l1 * xp.cos(t1)
    x2 = l1 * xp.sin(t1) + l2 * xp.sin(t2)
    y2 = -l1 * xp.cos(t1) - l2 * xp.cos(t2)
    return (xp.matrix([[x1, y1], [x2, y2]]),)


def eq_1_2(l: Array, omega: Array) -> Members:
    """(1.2) Square of mass 1's speed [m²/s²]."""
    return (l[..., 0] ** 2 * omega[..., 0] ** 2,)


def eq_1_3(xp: Arithmetic, l: Array, theta: Array, omega: Array, velocity: Array) -> Members:
    """(1.3) Square of mass 2's speed [m²/s²]: four forms, from components to the cosine of the difference."""
    return (_squared(velocity, 1), *_speed_squared_written_out(xp, l, theta, omega, 1))


def eq_1_4(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, speed_squared: Array) -> Members:
    """(1.4) Lagrangian T - U [J]: in the speeds, then in the angles' rates."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    v1, v2 = components(speed_squared)
    cos, cos12 = xp.cos, xp.cos(t1 - t2)
    in_speeds = m1 * v1 / 2 + m1 * g * l1 * cos(t1) + m2 * v2 / 2 + m2 * g * (l1 * cos(t1) + l2 * cos(t2))
    in_rates = (
        m1 * l1**2 * w1**2 / 2
        + m1 * g * l1 * cos(t1)
        + m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * cos12) / 2
        + m2 * g * (l1 * cos(t1) + l2 * cos(t2))
    )
    return in_speeds, in_rates


def eq_1_5(momentum_rate: Array, dL_dtheta: Array) -> Members:
    """(1.5) Lagrange's equations [N m], shape (…, n)."""
    return momentum_rate, dL_dtheta


def eq_1_6(xp: Arithmetic, l: Array, m: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(1.6) ∂L/∂θ̇ [N m s] and its time derivative [N m], shape (…, 2, 2)."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    a1, a2 = components(alpha)
    cos, sin = xp.cos_sin(t1 - t2)
    p1 = m1 * l1**2 * w1 + m2 * l1 * (l1 * w1 + l2 * w2 * cos)
    p2 = m2 * l2 * (l2 * w2 + l1 * w1 * cos)
    dp1 = (m1 + m2) * l1**2 * a1 + m2 * l1 * (l2 * a2 * cos - l2 * w2 * (w1 - w2) * sin)
    dp2 = m2 * l2 * (l2 * a2 + l1 * a1 * cos - l1 * w1 * (w1 - w2) * sin)
    return (xp.matrix([[p1, p2], [dp1, dp2]]),)


def eq_1_7(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> Members:
    """(1.7) ∂L/∂θ [N m], shape (…, 2)."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    sin = xp.sin
    row1 = -m1 * g * l1 * sin(t1) - m2 * l1 * l2 * w1 * w2 * sin(t1 - t2) - m2 * g * l1 * sin(t1)
    row2 = m2 * l1 * l2 * w1 * w2 * sin(t1 - t2) - m2 * g * l2 * sin(t2)
    return (xp.stack([row1, row2]),)


def eq_1_8(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(1.8) Equations of motion, left and right side [N m], shape (…, 2)."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    a1, a2 = components(alpha)
    cos, sin = xp.cos, xp.sin
    left1 = (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * a2 * cos(t1 - t2)
    right1 = -m1 * g * l1 * sin(t1) - m2 * g * l1 * sin(t1) - m2 * l1 * l2 * w2**2 * sin(t1 - t2)
    left2 = m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * cos(t1 - t2)
    right2 = -m2 * g * l2 * sin(t2) + m2 * l1 * l2 * w1**2 * sin(t1 - t2)
    return xp.stack([left1, left2]), xp.stack([right1, right2])


def eq_1_9(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(1.9) The same with row i divided by l_i, left and right side [N], shape (…, 2)."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    a1, a2 = components(alpha)
    cos, sin = xp.cos, xp.sin
    left1 = (m1 + m2) * l1 * a1 + m2 * l2 * a2 * cos(t1 - t2)
    right1 = -m1 * g * sin(t1) - m2 * g * sin(t1) - m2 * l2 * w2**2 * sin(t1 - t2)
    left2 = m2 * l2 * a2 + m2 * l1 * a1 * cos(t1 - t2)
    right2 = -m2 * g * sin(t2) + m2 * l1 * w1**2 * sin(t1 - t2)
    return xp.stack([left1, left2]), xp.stack([right1, right2])


def matrices_1_10(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> tuple[Array, Array]:
    """The two matrices that stand in (1.10) and (1.11): [kg m] and [N], shape (…, 2, 2) each."""
    l1, l2 = components(l)
    m1, m2 = components(m)
    t1, t2 = components(theta)
    w1, w2 = components(omega)
    cos, sin = xp.cos, xp.sin
    left = xp.matrix([[(m1 + m2) * l1, m2 * l2 * cos(t1 - t2)], [m2 * l1 * cos(t1 - t2), m2 * l2]])
    right = xp.matrix(
        [
            [(m1 + m2) * g * sin(t1), m2 * l2 * w2**2 * sin(t1 - t2)],
            [m2 * l1 * w1**2 * sin(t2 - t1), m2 * g * sin(t2)],
        ]
    )
    return left, right


def eq_1_10(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(1.10) Equations of motion in matrix form, left and right side [N], shape (…, 2)."""
    left, right = matrices_1_10(xp, l, m, g, theta, omega)
    return times(left, alpha), times(right, xp.array([-1, -1]))


def eq_1_11(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(1.11) The accelerations: themselves, and the matrix equation solved for them [rad/s²], shape (…, 2)."""
    left, right = matrices_1_10(xp, l, m, g, theta, omega)
    return alpha, xp.solve(left, times(right, xp.array([-1, -1])))


# ---------------------------------------------------------------- chapter 2: two legs


def eq_2_1(xp: Arithmetic, l: Array, theta: Array) -> Members:
    """(2.1), corrected: positions (x_i, y_i) of the three masses [m], shape (…, 3, 2); mass 3 hangs on l₃."""
    return (_positions_2_1(xp, l, theta, leg_of_mass_3=2),)


def eq_2_1_printed(xp: Arithmetic, l: Array, theta: Array) -> Members:
    """(2.1) as printed: l₂ in place of l₃ in x₃ and in y₃."""
    return (_positions_2_1(xp, l, theta, leg_of_mass_3=1),)


def _positions_2_1(xp: Arithmetic, l: Array, theta: Array, leg_of_mass_3: int) -> Array:
    l1, l2 = l[..., 0], l[..., 1]
    l3 = l[..., leg_of_mass_3]
    t1, t2, t3 = components(theta)
    x1 = l1 * xp.sin(t1)
    y1 = -l1 * xp.cos(t1)
    x2 = l1 * xp.sin(t1) + l2 * xp.sin(t2)
    y2 = -l1 * xp.cos(t1) - l2 * xp.cos(t2)
    x3 = l1 * xp.sin(t1) + l3 * xp.sin(t3)
    y3 = -l1 * xp.cos(t1) - l3 * xp.cos(t3)
    return xp.matrix([[x1, y1], [x2, y2], [x3, y3]])


def eq_2_2(l: Array, omega: Array) -> Members:
    """(2.2) Square of mass 1's speed [m²/s²]."""
    return (l[..., 0] ** 2 * omega[..., 0] ** 2,)


def eq_2_3(xp: Arithmetic, l: Array, theta: Array, omega: Array, velocity: Array) -> Members:
    """(2.3) Square of mass 2's speed [m²/s²]: four forms."""
    return (_squared(velocity, 1), *_speed_squared_written_out(xp, l, theta, omega, 1))


def eq_2_4(xp: Arithmetic, l: Array, theta: Array, omega: Array, velocity: Array) -> Members:
    """(2.4) Square of mass 3's speed [m²/s²]: in components, and in the angles' rates."""
    l1, _, l3 = components(l)
    t1, _, t3 = components(theta)
    w1, _, w3 = components(omega)
    return _squared(velocity, 2), l1**2 * w1**2 + l3**2 * w3**2 + 2 * l1 * l3 * w1 * w3 * xp.cos(t1 - t3)


def eq_2_5(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, speed_squared: Array) -> Members:
    """(2.5) Lagrangian T - U [J]: in the speeds, then in the angles' rates."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    v1, v2, v3 = components(speed_squared)
    cos = xp.cos
    in_speeds = (
        m1 * v1 / 2
        + m1 * g * l1 * cos(t1)
        + m2 * v2 / 2
        + m2 * g * (l1 * cos(t1) + l2 * cos(t2))
        + m3 * v3 / 2
        + m3 * g * (l1 * cos(t1) + l3 * cos(t3))
    )
    in_rates = (
        m1 * l1**2 * w1**2 / 2
        + m1 * g * l1 * cos(t1)
        + m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * cos(t1 - t2)) / 2
        + m2 * g * (l1 * cos(t1) + l2 * cos(t2))
        + m3 * (l1**2 * w1**2 + l3**2 * w3**2 + 2 * l1 * l3 * w1 * w3 * cos(t1 - t3)) / 2
        + m3 * g * (l1 * cos(t1) + l3 * cos(t3))
    )
    return in_speeds, in_rates


def eq_2_6(momentum_rate: Array, dL_dtheta: Array) -> Members:
    """(2.6) Lagrange's equations [N m], shape (…, n)."""
    return momentum_rate, dL_dtheta


def eq_2_7(xp: Arithmetic, l: Array, m: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(2.7) ∂L/∂θ̇ [N m s] and its time derivative [N m], shape (…, 2, 3)."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    a1, a2, a3 = components(alpha)
    cos, sin = xp.cos, xp.sin
    p1 = m1 * l1**2 * w1 + m2 * l1 * (l1 * w1 + l2 * w2 * cos(t1 - t2)) + m3 * l1 * (l1 * w1 + l3 * w3 * cos(t1 - t3))
    p2 = m2 * l2 * (l2 * w2 + l1 * w1 * cos(t1 - t2))
    p3 = m3 * l3 * (l3 * w3 + l1 * w1 * cos(t1 - t3))
    dp1 = (
        (m1 + m2 + m3) * l1**2 * a1
        + m2 * l1 * (l2 * a2 * cos(t1 - t2) - l2 * w2 * (w1 - w2) * sin(t1 - t2))
        + m3 * l1 * (l3 * a3 * cos(t1 - t3) - l3 * w3 * (w1 - w3) * sin(t1 - t3))
    )
    dp2 = m2 * l2 * (l2 * a2 + l1 * a1 * cos(t1 - t2) - l1 * w1 * (w1 - w2) * sin(t1 - t2))
    dp3 = m3 * l3 * (l3 * a3 + l1 * a1 * cos(t1 - t3) - l1 * w1 * (w1 - w3) * sin(t1 - t3))
    return (xp.matrix([[p1, p2, p3], [dp1, dp2, dp3]]),)


def eq_2_8(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> Members:
    """(2.8) ∂L/∂θ [N m], shape (…, 3)."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    sin = xp.sin
    row1 = (
        -m1 * g * l1 * sin(t1)
        - m2 * l1 * l2 * w1 * w2 * sin(t1 - t2)
        - m2 * g * l1 * sin(t1)
        - m3 * l1 * l3 * w1 * w3 * sin(t1 - t3)
        - m3 * g * l1 * sin(t1)
    )
    row2 = m2 * l1 * l2 * w1 * w2 * sin(t1 - t2) - m2 * g * l2 * sin(t2)
    row3 = m3 * l1 * l3 * w1 * w3 * sin(t1 - t3) - m3 * g * l3 * sin(t3)
    return (xp.stack([row1, row2, row3]),)


def eq_2_9(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(2.9) Equations of motion, left and right side [N m], shape (…, 3)."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    a1, a2, a3 = components(alpha)
    cos, sin = xp.cos, xp.sin
    left1 = (m1 + m2 + m3) * l1**2 * a1 + m2 * l1 * l2 * a2 * cos(t1 - t2) + m3 * l1 * l3 * a3 * cos(t1 - t3)
    right1 = (
        -m1 * g * l1 * sin(t1)
        - m2 * g * l1 * sin(t1)
        - m2 * l1 * l2 * w2**2 * sin(t1 - t2)
        - m3 * g * l1 * sin(t1)
        - m3 * l1 * l3 * w3**2 * sin(t1 - t3)
    )
    left2 = m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * cos(t1 - t2)
    right2 = -m2 * g * l2 * sin(t2) + m2 * l1 * l2 * w1**2 * sin(t1 - t2)
    left3 = m3 * l3**2 * a3 + m3 * l1 * l3 * a1 * cos(t1 - t3)
    right3 = -m3 * g * l3 * sin(t3) + m3 * l1 * l3 * w1**2 * sin(t1 - t3)
    return xp.stack([left1, left2, left3]), xp.stack([right1, right2, right3])


def eq_2_10(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(2.10) The same with row i divided by l_i, left and right side [N], shape (…, 3)."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    a1, a2, a3 = components(alpha)
    cos, sin = xp.cos, xp.sin
    left1 = (m1 + m2 + m3) * l1 * a1 + m2 * l2 * a2 * cos(t1 - t2) + m3 * l3 * a3 * cos(t1 - t3)
    right1 = (
        -m1 * g * sin(t1)
        - m2 * g * sin(t1)
        - m2 * l2 * w2**2 * sin(t1 - t2)
        - m3 * g * sin(t1)
        - m3 * l3 * w3**2 * sin(t1 - t3)
    )
    left2 = m2 * l2 * a2 + m2 * l1 * a1 * cos(t1 - t2)
    right2 = -m2 * g * sin(t2) + m2 * l1 * w1**2 * sin(t1 - t2)
    left3 = m3 * l3 * a3 + m3 * l1 * a1 * cos(t1 - t3)
    right3 = -m3 * g * sin(t3) + m3 * l1 * w1**2 * sin(t1 - t3)
    return xp.stack([left1, left2, left3]), xp.stack([right1, right2, right3])


def matrices_2_11(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> tuple[Array, Array]:
    """The two matrices that stand in (2.11) and (2.12): [kg m] and [N], shape (…, 3, 3) each."""
    l1, l2, l3 = components(l)
    m1, m2, m3 = components(m)
    t1, t2, t3 = components(theta)
    w1, w2, w3 = components(omega)
    cos, sin = xp.cos, xp.sin
    left = xp.matrix(
        [
            [(m1 + m2 + m3) * l1, m2 * l2 * cos(t1 - t2), m3 * l3 * cos(t1 - t3)],
            [m2 * l1 * cos(t1 - t2), m2 * l2, 0],
            [m3 * l1 * cos(t1 - t3), 0, m3 * l3],
        ]
    )
    right = xp.matrix(
        [
            [(m1 + m2 + m3) * g * sin(t1), m2 * l2 * w2**2 * sin(t1 - t2), m3 * l3 * w3**2 * sin(t1 - t3)],
            [m2 * l1 * w1**2 * sin(t2 - t1), m2 * g * sin(t2), 0],
            [m3 * l1 * w1**2 * sin(t3 - t1), 0, m3 * g * sin(t3)],
        ]
    )
    return left, right


def eq_2_11(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(2.11) Equations of motion in matrix form, left and right side [N], shape (…, 3)."""
    left, right = matrices_2_11(xp, l, m, g, theta, omega)
    return times(left, alpha), times(right, xp.array([-1, -1, -1]))


def eq_2_12(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(2.12) The accelerations: themselves, and the matrix equation solved for them [rad/s²], shape (…, 3)."""
    left, right = matrices_2_11(xp, l, m, g, theta, omega)
    return alpha, xp.solve(left, times(right, xp.array([-1, -1, -1])))


# ---------------------------------------------------------------- chapter 3: N legs


def eq_3_1(xp: Arithmetic, l: Array, theta: Array) -> Members:
    """(3.1) Positions (x_i, y_i) [m], shape (…, n, 2): mass 1, then those that hang from it."""
    l1, li = l[..., :1], l[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    x1 = l1 * xp.sin(t1)
    y1 = -l1 * xp.cos(t1)
    xi = l1 * xp.sin(t1) + li * xp.sin(ti)
    yi = -l1 * xp.cos(t1) - li * xp.cos(ti)
    return (xp.stack([_joined(x1, xi), _joined(y1, yi)]),)


def eq_3_2(l: Array, omega: Array) -> Members:
    """(3.2) Square of mass 1's speed [m²/s²]."""
    return (l[..., 0] ** 2 * omega[..., 0] ** 2,)


def eq_3_3(xp: Arithmetic, l: Array, theta: Array, omega: Array, velocity: Array) -> Members:
    """(3.3) Squares of the other masses' speeds [m²/s²], shape (…, n - 1): in components, and in the angles' rates."""
    l1, li = l[..., :1], l[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    in_components = velocity[..., 1:, 0] ** 2 + velocity[..., 1:, 1] ** 2
    return in_components, l1**2 * w1**2 + li**2 * wi**2 + 2 * l1 * li * w1 * wi * xp.cos(t1 - ti)


def eq_3_4(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, speed_squared: Array) -> Members:
    """(3.4), corrected: Lagrangian T - U [J], in the speeds, then in the angles' rates."""
    l1 = l[..., 0]
    return _lagrangian_3_4(xp, l, m, g, theta, omega, speed_squared, l1_squared=l1**2)


def eq_3_4_printed(
    xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, speed_squared: Array
) -> Members:
    """(3.4) as printed: l₁² is missing from ½ m₁ θ̇₁² in the second form."""
    return _lagrangian_3_4(xp, l, m, g, theta, omega, speed_squared, l1_squared=1)


def _lagrangian_3_4(
    xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, speed_squared: Array, l1_squared: Any
) -> Members:
    l1, li = l[..., :1], l[..., 1:]
    m1, mi = m[..., :1], m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    v1, vi = speed_squared[..., 0], speed_squared[..., 1:]
    cos = xp.cos
    height1 = (m1 * g * l1 * cos(t1))[..., 0]
    in_speeds = m1[..., 0] * v1 / 2 + height1 + (mi * vi / 2 + mi * g * (l1 * cos(t1) + li * cos(ti))).sum(-1)
    in_rates = (
        m1[..., 0] * l1_squared * w1[..., 0] ** 2 / 2
        + height1
        + (
            mi * (l1**2 * w1**2 + li**2 * wi**2 + 2 * l1 * li * w1 * wi * cos(t1 - ti)) / 2
            + mi * g * (l1 * cos(t1) + li * cos(ti))
        ).sum(-1)
    )
    return in_speeds, in_rates


def eq_3_5(momentum_rate: Array, dL_dtheta: Array) -> Members:
    """(3.5) Lagrange's equations [N m], shape (…, n)."""
    return momentum_rate, dL_dtheta


def eq_3_6(xp: Arithmetic, l: Array, m: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(3.6) ∂L/∂θ̇ [N m s] and its time derivative [N m], shape (…, 2, n)."""
    l1, li = l[..., :1], l[..., 1:]
    m1, mi = m[..., :1], m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    a1, ai = alpha[..., :1], alpha[..., 1:]
    cos, sin = xp.cos_sin(t1 - ti)
    p1 = m1 * l1**2 * w1 + _sum(mi * l1 * (l1 * w1 + li * wi * cos))
    pi = mi * li * (li * wi + l1 * w1 * cos)
    dp1 = _sum(m) * l1**2 * a1 + _sum(mi * l1 * (li * ai * cos - li * wi * (w1 - wi) * sin))
    dpi = mi * li * (li * ai + l1 * a1 * cos - l1 * w1 * (w1 - wi) * sin)
    return (xp.stack([_joined(p1, pi), _joined(dp1, dpi)], axis=-2),)


def eq_3_7(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> Members:
    """(3.7) ∂L/∂θ [N m], shape (…, n)."""
    l1, li = l[..., :1], l[..., 1:]
    m1, mi = m[..., :1], m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    sin = xp.sin
    row1 = -m1 * g * l1 * sin(t1) - _sum(mi * l1 * li * w1 * wi * sin(t1 - ti) + mi * g * l1 * sin(t1))
    rowi = mi * l1 * li * w1 * wi * sin(t1 - ti) - mi * g * li * sin(ti)
    return (_joined(row1, rowi),)


def eq_3_8(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(3.8) Equations of motion, left and right side [N m], shape (…, n)."""
    l1, li = l[..., :1], l[..., 1:]
    m1, mi = m[..., :1], m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    a1, ai = alpha[..., :1], alpha[..., 1:]
    cos, sin = xp.cos, xp.sin
    left1 = _sum(m) * l1**2 * a1 + _sum(mi * l1 * li * ai * cos(t1 - ti))
    right1 = -m1 * g * l1 * sin(t1) - _sum(mi * g * l1 * sin(t1) + mi * l1 * li * wi**2 * sin(t1 - ti))
    lefti = mi * li**2 * ai + mi * l1 * li * a1 * cos(t1 - ti)
    righti = -mi * g * li * sin(ti) + mi * l1 * li * w1**2 * sin(t1 - ti)
    return _joined(left1, lefti), _joined(right1, righti)


def eq_3_9(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array, alpha: Array) -> Members:
    """(3.9) The same with row i divided by l_i, left and right side [N], shape (…, n).

    The sum on the right of row 1 starts at i = 1, as printed: its i = 1 term carries sin(θ₁ - θ₁) = 0.
    """
    l1, li = l[..., :1], l[..., 1:]
    mi = m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1 = omega[..., :1]
    a1, ai = alpha[..., :1], alpha[..., 1:]
    cos, sin = xp.cos, xp.sin
    left1 = _sum(m) * l1 * a1 + _sum(mi * li * ai * cos(t1 - ti))
    right1 = -_sum(m * g * sin(t1) + m * l * omega**2 * sin(t1 - theta))
    lefti = mi * li * ai + mi * l1 * a1 * cos(t1 - ti)
    righti = -mi * g * sin(ti) + mi * l1 * w1**2 * sin(t1 - ti)
    return _joined(left1, lefti), _joined(right1, righti)


def eq_3_10(xp: Arithmetic, A: Array, B: Array, e: Array, alpha: Array) -> Members:
    """(3.10) Two statements, shape (…, 2, n): A θ̈ = -B e [N], and θ̈ = -A⁻¹ B e [rad/s²]; left and right sides."""
    return xp.stack([times(A, alpha), alpha], axis=-2), xp.stack([-times(B, e), -xp.solve(A, times(B, e))], axis=-2)


def eq_3_11(xp: Arithmetic, alpha: Array, e: Array) -> Members:
    """(3.11) Components of the vectors θ̈ and e, shape (…, 2, n). What e_i is, 1, the document leaves unsaid."""
    return (xp.stack([alpha, e], axis=-2),)


def eq_3_12(xp: Arithmetic, l: Array, m: Array, g: Array, theta: Array, omega: Array) -> Members:
    """(3.12) The matrices A [kg m] and B [N], shape (…, 2, n, n)."""
    l1, li = l[..., :1], l[..., 1:]
    mi = m[..., 1:]
    t1, ti = theta[..., :1], theta[..., 1:]
    w1, wi = omega[..., :1], omega[..., 1:]
    cos, sin = xp.cos_sin(t1 - ti)
    n = theta.shape[-1]
    legs = np.arange(1, n)
    A, B = xp.zeros((2, *np.broadcast_shapes(l.shape, m.shape, theta.shape, omega.shape), n))
    A[..., 0, 0] = m.sum(-1) * l[..., 0]
    A[..., legs, legs] = mi * li
    A[..., 0, 1:] = mi * li * cos
    A[..., 1:, 0] = mi * l1 * cos
    B[..., 0, 0] = m.sum(-1) * g * xp.sin(theta[..., 0])
    B[..., legs, legs] = mi * g * xp.sin(ti)
    B[..., 0, 1:] = mi * li * wi**2 * sin
    B[..., 1:, 0] = mi * l1 * w1**2 * xp.sin(ti - t1)
    return (np.stack([A, B], axis=-3),)


# ---------------------------------------------------------------- what several of them share


def _squared(velocity: Array, i: int) -> Array:
    return np.asarray(velocity[..., i, 0] ** 2 + velocity[..., i, 1] ** 2)


def _speed_squared_written_out(xp: Arithmetic, l: Array, theta: Array, omega: Array, i: int) -> Members:
    """The last three forms of (1.3) and of (2.3), which are the same text."""
    l1, l2 = l[..., 0], l[..., i]
    t1, t2 = theta[..., 0], theta[..., i]
    w1, w2 = omega[..., 0], omega[..., i]
    cos1, sin1 = xp.cos_sin(t1)
    cos2, sin2 = xp.cos_sin(t2)
    factored = (l1 * w1 * cos1 + l2 * w2 * cos2) ** 2 + (l1 * w1 * sin1 + l2 * w2 * sin2) ** 2
    expanded = (l1**2 * w1**2 * cos1**2 + 2 * l1 * l2 * w1 * w2 * cos1 * cos2 + l2**2 * w2**2 * cos2**2) + (
        l1**2 * w1**2 * sin1**2 + 2 * l1 * l2 * w1 * w2 * sin1 * sin2 + l2**2 * w2**2 * sin2**2
    )
    collected = l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * xp.cos(t1 - t2)
    return factored, expanded, collected


def _sum(x: Array) -> Array:
    return np.asarray(x.sum(-1, keepdims=True))


def _joined(first: Array, rest: Array) -> Array:
    """Row 1 and the rows of the legs, shape (…, 1) and (…, n - 1), as one vector."""
    batch = np.broadcast_shapes(first.shape[:-1], rest.shape[:-1])
    return np.concatenate(
        [np.broadcast_to(first, (*batch, 1)), np.broadcast_to(rest, (*batch, rest.shape[-1]))], axis=-1
    )


# ---------------------------------------------------------------- index

_ROW_I = "the rows written with i are those of i ≠ 1"

EQUATIONS: tuple[Equation, ...] = (
    Equation(
        "shiki", "1.1", "position", "where the two masses are",
        "x₁ = l₁ sin θ₁, y₁ = −l₁ cos θ₁, x₂ = l₁ sin θ₁ + l₂ sin θ₂, y₂ = −l₁ cos θ₁ − l₂ cos θ₂", eq_1_1,
    ),
    Equation("shiki", "1.2", "velocity", "speed of mass 1", "|ẋ₁|² = l₁² θ̇₁²", eq_1_2),
    Equation(
        "shiki", "1.3", "velocity", "speed of mass 2, from its components to the cosine of the difference",
        "|ẋ₂|² = ẋ₂² + ẏ₂² = … = l₁² θ̇₁² + l₂² θ̇₂² + 2 l₁ l₂ θ̇₁ θ̇₂ cos(θ₁ − θ₂)", eq_1_3,
    ),
    Equation(
        "shiki", "1.4", "energy", "the Lagrangian, kinetic less potential energy",
        "L = ½ m₁ l₁² θ̇₁² + m₁ g l₁ cos θ₁ + ½ m₂ (l₁² θ̇₁² + l₂² θ̇₂² + 2 l₁ l₂ θ̇₁ θ̇₂ cos(θ₁ − θ₂))"
        " + m₂ g (l₁ cos θ₁ + l₂ cos θ₂)", eq_1_4,
    ),
    Equation("shiki", "1.5", "lagrange", "Lagrange's equations", "d/dt ∂L/∂θ̇ᵢ = ∂L/∂θᵢ", eq_1_5),
    Equation(
        "shiki", "1.6", "lagrange", "the momenta and their time derivatives",
        "d/dt ∂L/∂θ̇₁ = (m₁ + m₂) l₁² θ̈₁ + m₂ l₁ (l₂ θ̈₂ cos(θ₁ − θ₂) − l₂ θ̇₂ (θ̇₁ − θ̇₂) sin(θ₁ − θ₂)), …", eq_1_6,
    ),
    Equation(
        "shiki", "1.7", "lagrange", "the Lagrangian's derivatives by the angles",
        "∂L/∂θ₁ = −m₁ g l₁ sin θ₁ − m₂ l₁ l₂ θ̇₁ θ̇₂ sin(θ₁ − θ₂) − m₂ g l₁ sin θ₁, …", eq_1_7,
    ),
    Equation(
        "shiki", "1.8", "motion", "the equations of motion",
        "(m₁ + m₂) l₁² θ̈₁ + m₂ l₁ l₂ θ̈₂ cos(θ₁ − θ₂) = −(m₁ + m₂) g l₁ sin θ₁ − m₂ l₁ l₂ θ̇₂² sin(θ₁ − θ₂), …", eq_1_8,
    ),
    Equation(
        "shiki", "1.9", "motion", "the equations of motion, each divided by its length",
        "(m₁ + m₂) l₁ θ̈₁ + m₂ l₂ θ̈₂ cos(θ₁ − θ₂) = −(m₁ + m₂) g sin θ₁ − m₂ l₂ θ̇₂² sin(θ₁ − θ₂), …", eq_1_9,
    ),
    Equation(
        "shiki", "1.10", "matrix", "the equations of motion as matrices",
        "[(m₁+m₂)l₁, m₂l₂cos(θ₁−θ₂); m₂l₁cos(θ₁−θ₂), m₂l₂] θ̈ ="
        " −[(m₁+m₂)g sin θ₁, m₂l₂θ̇₂²sin(θ₁−θ₂); m₂l₁θ̇₁²sin(θ₂−θ₁), m₂g sin θ₂] (1, 1)", eq_1_10,
    ),
    Equation("shiki", "1.11", "matrix", "the accelerations", "θ̈ = [(1.10), left]⁻¹ [(1.10), right] (−1, −1)", eq_1_11),
    Equation(
        "shiki", "2.1", "position", "where the three masses are",
        "x₃ = l₁ sin θ₁ + l₃ sin θ₃, y₃ = −l₁ cos θ₁ − l₃ cos θ₃; masses 1 and 2 as in (1.1)", eq_2_1,
        printed=eq_2_1_printed,
        printed_formula="x₃ = l₁ sin θ₁ + l₂ sin θ₃, y₃ = −l₁ cos θ₁ − l₂ cos θ₃",
        correction="l₃ in place of l₂ in x₃ and in y₃; the document goes on correctly, with l₃, in (2.4)",
    ),
    Equation("shiki", "2.2", "velocity", "speed of mass 1", "|ẋ₁|² = l₁² θ̇₁²", eq_2_2),
    Equation(
        "shiki", "2.3", "velocity", "speed of mass 2, from its components to the cosine of the difference",
        "|ẋ₂|² = ẋ₂² + ẏ₂² = … = l₁² θ̇₁² + l₂² θ̇₂² + 2 l₁ l₂ θ̇₁ θ̇₂ cos(θ₁ − θ₂)", eq_2_3,
    ),
    Equation(
        "shiki", "2.4", "velocity", "speed of mass 3",
        "|ẋ₃|² = ẋ₃² + ẏ₃² = l₁² θ̇₁² + l₃² θ̇₃² + 2 l₁ l₃ θ̇₁ θ̇₃ cos(θ₁ − θ₃)", eq_2_4,
    ),
    Equation(
        "shiki", "2.5", "energy", "the Lagrangian, kinetic less potential energy",
        "L = ½ m₁ l₁² θ̇₁² + m₁ g l₁ cos θ₁"
        " + Σᵢ₌₂,₃ [½ mᵢ (l₁² θ̇₁² + lᵢ² θ̇ᵢ² + 2 l₁ lᵢ θ̇₁ θ̇ᵢ cos(θ₁ − θᵢ)) + mᵢ g (l₁ cos θ₁ + lᵢ cos θᵢ)]", eq_2_5,
    ),
    Equation("shiki", "2.6", "lagrange", "Lagrange's equations", "d/dt ∂L/∂θ̇ᵢ = ∂L/∂θᵢ", eq_2_6),
    Equation(
        "shiki", "2.7", "lagrange", "the momenta and their time derivatives",
        "∂L/∂θ̇₂ = m₂ l₂ (l₂ θ̇₂ + l₁ θ̇₁ cos(θ₁ − θ₂)),"
        " d/dt ∂L/∂θ̇₂ = m₂ l₂ (l₂ θ̈₂ + l₁ θ̈₁ cos(θ₁ − θ₂) − l₁ θ̇₁ (θ̇₁ − θ̇₂) sin(θ₁ − θ₂)), …", eq_2_7,
    ),
    Equation(
        "shiki", "2.8", "lagrange", "the Lagrangian's derivatives by the angles",
        "∂L/∂θ₂ = m₂ l₁ l₂ θ̇₁ θ̇₂ sin(θ₁ − θ₂) − m₂ g l₂ sin θ₂, …", eq_2_8,
    ),
    Equation(
        "shiki", "2.9", "motion", "the equations of motion",
        "m₂ l₂² θ̈₂ + m₂ l₁ l₂ θ̈₁ cos(θ₁ − θ₂) = −m₂ g l₂ sin θ₂ + m₂ l₁ l₂ θ̇₁² sin(θ₁ − θ₂), …", eq_2_9,
    ),
    Equation(
        "shiki", "2.10", "motion", "the equations of motion, each divided by its length",
        "m₂ l₂ θ̈₂ + m₂ l₁ θ̈₁ cos(θ₁ − θ₂) = −m₂ g sin θ₂ + m₂ l₁ θ̇₁² sin(θ₁ − θ₂), …", eq_2_10,
    ),
    Equation(
        "shiki", "2.11", "matrix", "the equations of motion as matrices",
        "[(m₁+m₂+m₃)l₁, m₂l₂cos(θ₁−θ₂), m₃l₃cos(θ₁−θ₃); m₂l₁cos(θ₁−θ₂), m₂l₂, 0; m₃l₁cos(θ₁−θ₃), 0, m₃l₃] θ̈ ="
        " −[(m₁+m₂+m₃)g sin θ₁, m₂l₂θ̇₂²sin(θ₁−θ₂), m₃l₃θ̇₃²sin(θ₁−θ₃); m₂l₁θ̇₁²sin(θ₂−θ₁), m₂g sin θ₂, 0;"
        " m₃l₁θ̇₁²sin(θ₃−θ₁), 0, m₃g sin θ₃] (1, 1, 1)", eq_2_11,
    ),
    Equation(
        "shiki", "2.12", "matrix", "the accelerations", "θ̈ = [(2.11), left]⁻¹ [(2.11), right] (−1, −1, −1)", eq_2_12
    ),
    Equation(
        "shiki", "3.1", "position", "where the masses are",
        "x₁ = l₁ sin θ₁, y₁ = −l₁ cos θ₁; i ≠ 1: xᵢ = l₁ sin θ₁ + lᵢ sin θᵢ, yᵢ = −l₁ cos θ₁ − lᵢ cos θᵢ", eq_3_1,
    ),
    Equation("shiki", "3.2", "velocity", "speed of mass 1", "|ẋ₁|² = l₁² θ̇₁²", eq_3_2),
    Equation(
        "shiki", "3.3", "velocity", "speeds of the other masses",
        "|ẋᵢ|² = ẋᵢ² + ẏᵢ² = l₁² θ̇₁² + lᵢ² θ̇ᵢ² + 2 l₁ lᵢ θ̇₁ θ̇ᵢ cos(θ₁ − θᵢ)", eq_3_3,
    ),
    Equation(
        "shiki", "3.4", "energy", "the Lagrangian, kinetic less potential energy",
        "L = ½ m₁ l₁² θ̇₁² + m₁ g l₁ cos θ₁"
        " + Σᵢ₌₂ⁿ⁺¹ [½ mᵢ (l₁² θ̇₁² + lᵢ² θ̇ᵢ² + 2 l₁ lᵢ θ̇₁ θ̇ᵢ cos(θ₁ − θᵢ)) + mᵢ g (l₁ cos θ₁ + lᵢ cos θᵢ)]", eq_3_4,
        printed=eq_3_4_printed,
        printed_formula="L = … = ½ m₁ θ̇₁² + m₁ g l₁ cos θ₁ + Σᵢ₌₂ⁿ⁺¹ […]",
        correction="l₁² is missing from ½ m₁ θ̇₁² in the second form (it then is no energy unless l₁ = 1);"
        " the document goes on correctly, with m₁ l₁² θ̇₁, in (3.6)",
    ),
    Equation("shiki", "3.5", "lagrange", "Lagrange's equations", "d/dt ∂L/∂θ̇ᵢ = ∂L/∂θᵢ", eq_3_5),
    Equation(
        "shiki", "3.6", "lagrange", "the momenta and their time derivatives",
        "∂L/∂θ̇₁ = m₁ l₁² θ̇₁ + Σᵢ₌₂ⁿ⁺¹ mᵢ l₁ (l₁ θ̇₁ + lᵢ θ̇ᵢ cos(θ₁ − θᵢ)), …", eq_3_6, condition=_ROW_I,
    ),
    Equation(
        "shiki", "3.7", "lagrange", "the Lagrangian's derivatives by the angles",
        "∂L/∂θ₁ = −m₁ g l₁ sin θ₁ − Σᵢ₌₂ⁿ⁺¹ (mᵢ l₁ lᵢ θ̇₁ θ̇ᵢ sin(θ₁ − θᵢ) + mᵢ g l₁ sin θ₁), …", eq_3_7,
        condition=_ROW_I,
    ),
    Equation(
        "shiki", "3.8", "motion", "the equations of motion",
        "(Σᵢ₌₁ⁿ⁺¹ mᵢ) l₁² θ̈₁ + Σᵢ₌₂ⁿ⁺¹ mᵢ l₁ lᵢ θ̈ᵢ cos(θ₁ − θᵢ)"
        " = −m₁ g l₁ sin θ₁ − Σᵢ₌₂ⁿ⁺¹ (mᵢ g l₁ sin θ₁ + mᵢ l₁ lᵢ θ̇ᵢ² sin(θ₁ − θᵢ)),"
        " mᵢ lᵢ² θ̈ᵢ + mᵢ l₁ lᵢ θ̈₁ cos(θ₁ − θᵢ) = −mᵢ g lᵢ sin θᵢ + mᵢ l₁ lᵢ θ̇₁² sin(θ₁ − θᵢ)", eq_3_8,
        condition=_ROW_I,
    ),
    Equation(
        "shiki", "3.9", "motion", "the equations of motion, each divided by its length",
        "(Σᵢ₌₁ⁿ⁺¹ mᵢ) l₁ θ̈₁ + Σᵢ₌₂ⁿ⁺¹ mᵢ lᵢ θ̈ᵢ cos(θ₁ − θᵢ) = −Σᵢ₌₁ⁿ⁺¹ (mᵢ g sin θ₁ + mᵢ lᵢ θ̇ᵢ² sin(θ₁ − θᵢ)),"
        " mᵢ lᵢ θ̈ᵢ + mᵢ l₁ θ̈₁ cos(θ₁ − θᵢ) = −mᵢ g sin θᵢ + mᵢ l₁ θ̇₁² sin(θ₁ − θᵢ)", eq_3_9,
        condition=_ROW_I,
    ),
    Equation(
        "shiki", "3.10", "matrix", "the equations of motion and the accelerations as matrices",
        "A θ̈ = −B e, θ̈ = −A⁻¹ B e", eq_3_10,
    ),
    Equation(
        "shiki", "3.11", "matrix", "the components of the vectors in (3.10)", "(θ̈)ᵢ = θ̈ᵢ, (e)ᵢ = eᵢ", eq_3_11,
        condition="eᵢ = 1 for every i: the equation defines e by itself, and (3.10) holds for this e alone",
    ),
    Equation(
        "shiki", "3.12", "matrix", "the entries of the matrices in (3.10)",
        "A₁₁ = (Σₖ mₖ) l₁, Aᵢᵢ = mᵢ lᵢ, A₁ᵢ = mᵢ lᵢ cos(θ₁ − θᵢ), Aᵢ₁ = mᵢ l₁ cos(θ₁ − θᵢ),"
        " B₁₁ = (Σₖ mₖ) g sin θ₁, Bᵢᵢ = mᵢ g sin θᵢ, B₁ᵢ = mᵢ lᵢ θ̇ᵢ² sin(θ₁ − θᵢ), Bᵢ₁ = mᵢ l₁ θ̇₁² sin(θᵢ − θ₁),"
        " all others 0", eq_3_12,
    ),
)  # fmt: skip

SLIPS: tuple[Slip, ...] = (
    Slip("shiki", "chapter 1, before (1.3)", "式(3.1)より", "式(1.1)より", "refers to an equation two chapters on"),
    Slip("shiki", "chapter 1, before (1.8)", "式(3.6), 式(3.7)より", "式(1.6), 式(1.7)より", "refers to chapter 3"),
    Slip("shiki", "chapter 1, before (1.9)", "定数を割る", "定数で割る", "divides the constant, not by it"),
    Slip("shiki", "chapter 2, before (2.3)", "質点 21", "質点 2", "there is no mass 21"),
    Slip("shiki", "chapter 2, before (2.3)", "式(3.1)より", "式(2.1)より", "refers to chapter 3"),
    Slip("shiki", "chapter 2, before (2.9)", "式(3.6), 式(3.7)より", "式(2.7), 式(2.8)より", "refers to chapter 3"),
    Slip("shiki", "chapter 2, before (2.12)", "加速度 θ̈₁, θ̈₂", "加速度 θ̈₁, θ̈₂, θ̈₃", "θ̈₃ is left out"),
    Slip(
        "shiki", "(1.4), (2.5), (3.4), first forms", "|ẋᵢ|² with x in italics", "|ẋᵢ|² with x in bold",
        "the speed's square is meant; in italics xᵢ is one coordinate of (xᵢ, yᵢ)",
    ),
    Slip(
        "shiki", "chapter 3, from (3.4) on", "n, in the sums up to n + 1", "N, the number of legs",
        "the text says N legs, the sums say n, and n is introduced nowhere",
    ),
    Slip("shiki", "(3.12)", "i, j > 1 ∩ i ≠ j", "i, j > 1 かつ i ≠ j", "∩ joins sets, not conditions"),
)  # fmt: skip
