# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""What the files of this folder print, entered by hand from the page, and what each describes."""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    I1,
    I2,
    RADIUS,
    F,
    M,
    a1,
    a2,
    a3,
    al,
    b,
    bobs,
    cart_pole,
    elastic,
    g,
    k,
    l,
    l1,
    l2,
    l3,
    lc1,
    lc2,
    links,
    m,
    m1,
    m2,
    m3,
    pendulum,
    ph,
    phd,
    phdd,
    r,
    r0,
    rd,
    rdd,
    rods,
    tau,
    th,
    th1,
    th2,
    th3,
    u,
    w,
    w1,
    w2,
    w3,
    wheel,
    x,
    xd,
    xdd,
)
from prove_strange_pendulums import bob_lagrangian, coding_train, linear_system, long_rows, matplotlib
from prove_strange_pendulums import rows as short_rows
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, rate

half = Rational(1, 2)
TWO = bobs((l1, m1), (l2, m2))
EQUAL = bobs((l, m), (l, m))
THREE = bobs((l1, m1), (l2, m2), (l3, m3))
D, S, C = th1 - th2, sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
c_, d, J, Iw, IG = sp.symbols("c d J Iw IG")


def solved():
    """The two accelerations over m1 + m2 sin²."""
    below = m1 + m2 * S**2
    first = m2 * g * sin(th2) * C - m2 * S * (l1 * w1**2 * C + l2 * w2**2) - (m1 + m2) * g * sin(th1)
    second = (m1 + m2) * (l1 * w1**2 * S - g * sin(th2) + g * sin(th1) * C) + m2 * l2 * w2**2 * S * C
    return [a1 - first / (l1 * below), a2 - second / (l2 * below)]


def other_rate():
    one, two = long_rows()
    return [one, two + m2 * l1 * l2 * S * (w1**2 - w2**2)]


def relative_energy():
    """T by the mass matrix, V as printed."""
    c2 = cos(th2)
    m12 = m2 * l2**2 + m2 * l1 * l2 * c2
    kinetic = (
        ((m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2) * w1**2 / 2 + m12 * w1 * w2 + m2 * l2**2 * w2**2 / 2
    )
    potential = -(m1 + m2) * g * l1 * cos(th1) - m2 * g * l2 * cos(th1 + th2)
    mechanism = bobs((l1, m1), (l2, m2), relative=True)
    return mechanism, lagrange(kinetic - potential, mechanism)


def matrix_with_sign():
    a = sp.Matrix([[(m1 + m2) * l1**2, m2 * l1 * l2 * C], [m2 * l1 * l2 * C, m2 * l2**2]])
    right = sp.Matrix([m2 * l1 * l2 * S * w2**2 - (m1 + m2) * g * l1 * sin(th1),
                       m2 * l1 * l2 * S * w1**2 - m2 * g * l2 * sin(th2)])  # fmt: skip
    return list(a * sp.Matrix([a1, a2]) - right)


def ode45():
    below = 2 - C**2
    return [a1 - (g * (sin(th2) * C - 2 * sin(th1)) - l * (w2**2 + w1**2 * C) * S) / (l * below),
            a2 - (2 * g * (sin(th1) * C - sin(th2)) + l * (2 * w1**2 + w2**2 * C) * S) / (l * below)]  # fmt: skip


def javascript():
    one, _ = solved()
    second = (m1 + m2) * (l1 * w1**2 * S - g * cos(th2) + g * sin(th1) * C) + m2 * l2 * w2**2 * S * C
    return [one, a2 - second / (l2 * (m1 + m2 * S**2))]


def from_places(mechanism):
    """L with T and V from the places of the bobs."""
    x1, y1 = l1 * sin(th1), -l1 * cos(th1)
    x2, y2 = x1 + l2 * sin(th2), y1 - l2 * cos(th2)
    kinetic = sum(
        mass * (rate(p, mechanism) ** 2 + rate(q, mechanism) ** 2) / 2 for mass, p, q in ((m1, x1, y1), (m2, x2, y2))
    )
    return lagrange(kinetic - m1 * g * y1 - m2 * g * y2, mechanism)


def triple_sum():
    angles, lengths, rates = (th1, th2, th3), (l1, l2, l3), (w1, w2, w3)
    total = 0
    for i, mass in enumerate((m1, m2, m3)):
        along = sum(lengths[j] * rates[j] * cos(angles[j]) for j in range(i + 1))
        across = sum(lengths[j] * rates[j] * sin(angles[j]) for j in range(i + 1))
        total += mass / 2 * (along**2 + across**2) + g * mass * sum(lengths[j] * cos(angles[j]) for j in range(i + 1))
    return lagrange(total, THREE)


def triple_plain():
    m23 = m2 + m3
    return [
        (m1 + m23) * l1 * a1
        + m23 * l2 * a2 * C
        + m3 * l3 * a3 * cos(th1 - th3)
        + m23 * l2 * w2**2 * S
        + m3 * l3 * w3**2 * sin(th1 - th3)
        + (m1 + m23) * g * sin(th1),
        m2 * l1 * a1 * C
        + m23 * l2 * a2
        + m3 * l3 * a3 * cos(th2 - th3)
        - m23 * l1 * w1**2 * S
        + m3 * l3 * w3**2 * sin(th2 - th3)
        + m23 * g * sin(th2),
        l1 * a1 * cos(th1 - th3)
        + l2 * a2 * cos(th2 - th3)
        + l3 * a3
        - l1 * w1**2 * sin(th1 - th3)
        - l2 * w2**2 * sin(th2 - th3)
        + g * sin(th3),
    ]


def cart_up():
    return [(M + m) * xdd + m * l * al * c - m * l * w**2 * s - F, l * al + xdd * c - g * s]


def cart_down():
    return [(M + m) * xdd + m * l * al * c - m * l * w**2 * s, l * al + xdd * c + g * s]


def cart_newton():
    """The rod's force T from the first row, put into the others."""
    pull = M * xdd / s
    return [m * (xdd + l * al * c - l * w**2 * s) + pull * s, m * (l * al * s + l * w**2 * c) - pull * c + m * g]


def cart_solved():
    acc = (u + m * l * w**2 * s - m * g * s * c) / (M + m * s**2)
    return [xdd - acc, al - (g * s - acc * c) / l]


def cart_lambda():
    return [xdd - (m * l * w**2 * s - m * g * s * c) / (M + m * s**2),
            al - (-m * l * w**2 * s * c - (M + m) * g * s) / (l * (M + m * s**2))]  # fmt: skip


def cart_left():
    return [
        (M + m) * xdd - m * l * c * al + b * xd + m * l * w**2 * s - u,
        -m * l * c * xdd + m * l**2 * al + c_ * w - m * g * l * s,
    ]


def cart_eigen():
    a = sp.Matrix([[M + m, m * l * c], [m * l * c, m * l * l]])
    return list(sp.Matrix([xdd, al]) - a.inv() * sp.Matrix([F + m * l * s * w * w, -m * g * l * s]))


def julia():
    return [
        xdd - m * s * (l * w**2 + g * c) / (M + m * s**2),
        al + (m * l * w**2 * s * c + (M + m) * g * s) / (l * (M + m * s**2)),
    ]


h = m2 * l1 * lc2
M11 = I1 + I2 + m1 * lc1**2 + m2 * (l1**2 + lc2**2) + 2 * h * cos(th2)
M12 = I2 + m2 * lc2**2 + h * cos(th2)
G2 = m2 * lc2 * g * sin(th1 + th2)
G1 = (m1 * lc1 + m2 * l1) * g * sin(th1) + G2


def acrobot():
    return [
        M11 * a1 + M12 * a2 - h * sin(th2) * w2 * (2 * w1 + w2) + G1,
        M12 * a1 + (I2 + m2 * lc2**2) * a2 + h * sin(th2) * w1**2 + G2 - u,
    ]


def pendubot():
    return [
        M11 * a1 + M12 * a2 - h * sin(th2) * w2 * (2 * w1 + w2) + G1 - tau,
        M12 * a1 + (I2 + m2 * lc2**2) * a2 - h * sin(th2) * w1**2 + G2,
    ]


def pendubot_lagrangian():
    mechanism = links(False, relative=True)
    kinetic = M11 * w1**2 / 2 + M12 * w1 * w2 + (I2 + m2 * lc2**2) * w2**2 / 2
    return mechanism, lagrange(kinetic + (m1 * lc1 + m2 * l1) * g * cos(th1) + m2 * lc2 * g * cos(th1 + th2), mechanism)


def absolute_wheel():
    """Arm and wheel by angles of their own; a motor and its bearing's friction between them."""
    moment = tau - b * (phd - w)
    arm = Body(m, l * sin(th), l * cos(th), J, th)
    true = Mechanism([ANGLE, (ph, phd, phdd)], [arm, Body(0, 0, 0, Iw, ph)], 0, {th: -moment, ph: moment})
    return true, [(J + m * l**2) * al - m * g * l * s + tau, Iw * phdd + b * (phd - w) - tau]


def wheel_rows():
    return wheel(J + m * l**2, Iw, forces={ph: tau})


def spring(weight=c, coriolis=2):
    true = elastic(k * (r - r0) ** 2 / 2)
    return true, [m * (rdd - r * w**2) - m * g * weight + k * (r - r0), m * (r * al + coriolis * rd * w) + m * g * s]


def coupled():
    """A level spring between two pendulums."""
    stretch = sp.Symbol("a") * (sin(th1) - sin(th2))
    bodies = [Body(m, l * sin(q), -l * cos(q)) for q in (th1, th2)]
    true = Mechanism([(th1, w1, a1), (th2, w2, a2)], bodies, k * stretch**2 / 2, {})
    pull = k * sp.Symbol("a") * stretch
    return true, [
        m * l**2 * a1 + m * g * l * sin(th1) + pull * cos(th1),
        m * l**2 * a2 + m * g * l * sin(th2) - pull * cos(th2),
    ]


phase, speed, size = sp.symbols("phase speed size")


def moved(right=0, up=0, **more):
    """A pendulum on a support that moves as a given function of the phase, which grows at a given speed."""
    body = Body(m, right + l * sin(th), up - l * cos(th))
    return Mechanism([ANGLE], [body], 0, {}, shifts=False, phases={phase: speed}, **more)


def landau_3c():
    true = moved(up=-size * cos(phase))
    return true, lagrange(m * l**2 * w**2 / 2 + m * l * size * speed**2 * cos(phase) * c + m * g * l * c, true)


def driven():
    torque = l * F * cos(phase)
    true = Mechanism(
        [ANGLE], [Body(m, l * sin(th), -l * cos(th))], 0, {th: torque - b * l**2 * w}, phases={phase: speed}
    )
    omega2, beta, gamma = g / l, b / (2 * m), F / (m * g)
    return true, [al + 2 * beta * w + omega2 * s - gamma * omega2 * cos(phase)]


def hoop():
    """A bead on a hoop that turns: the centrifugal potential."""
    turn = sp.Symbol("turn")
    true = Mechanism([ANGLE], [Body(m, l * sin(th), -l * cos(th))], -m * (turn * l * sin(th)) ** 2 / 2, {})
    return true, [al - (turn**2 * c - g / l) * s]


def atwood():
    """The other end of the rope carries M, which is lifted as r grows."""
    bodies = [Body(m, r * sin(th), -r * cos(th)), Body(M, 0, r)]
    return Mechanism([RADIUS, ANGLE], bodies, 0, {}), [
        (m + M) * rdd - m * r * w**2 - m * g * c + M * g,
        r * al + 2 * rd * w + g * s,
    ]


def ladder():
    """A rod between a wall and a floor, by its angle from the wall."""
    true = Mechanism([ANGLE], [Body(m, l / 2 * sin(th), l / 2 * cos(th), m * l**2 / 12, th)], 0, {})
    return true, [al - 3 * g / (2 * l) * s]


def compound():
    lost = links(False)
    return lost, [
        (I1 + m1 * lc1**2 + m2 * l1**2) * a1
        + m2 * l1 * lc2 * C * a2
        + m2 * l1 * lc2 * S * w2**2
        + (m1 * lc1 + m2 * l1) * g * sin(th1),
        I2 * a2 + m2 * l1 * lc2 * C * a1 - m2 * l1 * lc2 * S * w1**2 + m2 * lc2 * g * sin(th2),
    ]


def tensions():
    """The second rod's tension from the fourth row, the first rod's left out with its own row."""
    second = m2 * (l2 * w2**2 + l1 * a1 * S + l1 * w1**2 * C) + m2 * g * cos(th2)
    return [
        m1 * l1 * a1 + m1 * g * sin(th1) + second * S,
        m2 * (l2 * a2 + l1 * a1 * C - l1 * w1**2 * S) + m2 * g * sin(th2),
    ]


def no_height():
    lagrangian = bob_lagrangian() - m1 * g * l1 * cos(th1) - m2 * g * (l1 * cos(th1) + l2 * cos(th2))
    return lagrange(lagrangian + g * (m1 * l1 * cos(th1) + m2 * l2 * cos(th2)), TWO)


def c_function():
    below = 2 - C * C
    return [a1 - (g * (sin(th2) * C - 2 * sin(th1)) - l * (w2 * w2 + w1 * w1 * C) * S) / (l * below),
            a2 - (2 * g * (sin(th1) * C - sin(th2)) + l * (2 * w1 * w1 - w2 * w2 * C) * S) / (l * below)]  # fmt: skip


UP = cart_pole(up=True, forces={x: F})
DOWN = cart_pole()
PROOFS = {
    "dp-gather-boxed": (TWO, short_rows()),
    "dp-left-array": (TWO, short_rows()),
    "dp-underbrace": (TWO, other_rate()),
    "dp-implies": (TWO, short_rows()),
    "dp-operator": (TWO, long_rows()),
    "dp-unicode-solved": (TWO, solved()),
    "dp-quadratic-form": relative_energy(),
    "dp-forum-dd": (TWO, short_rows(back=1)),
    "dp-odeint": (TWO, solved()),
    "dp-class": (TWO, coding_train()),
    "dp-dict-solve": (TWO, matrix_with_sign()),
    "dp-ode45": (EQUAL, ode45()),
    "dp-rust": (TWO, coding_train()),
    "dp-js": (TWO, javascript()),
    "sp-pretty": (pendulum(), [g * l * m * s + l**2 * m * al]),
    "dp-mathematica-rules": (TWO, solved()),
    "dp-sum-energies": (TWO, from_places(TWO)),
    "tp-sum": (THREE, triple_sum()),
    "tp-plain": (THREE, triple_plain()),
    "cp-comments": (UP, cart_up()),
    "cp-newton": (DOWN, cart_newton()),
    "cp-solve-ivp": (cart_pole(up=True, forces={x: u}), cart_solved()),
    "cp-lambda": (DOWN, cart_lambda()),
    "cp-array-left": (cart_pole(up=True, left=True, forces={x: u - b * xd, th: -c_ * w}), cart_left()),
    "cp-eigen": (cart_pole(forces={x: F}), cart_eigen()),
    "cp-and": (DOWN, cart_down()),
    "ac-matlab-function": (links(False, relative=True, forces={th2: u}), acrobot()),
    "pb-c": (links(False, relative=True, forces={th1: tau}), pendubot()),
    "rw-qquad": (wheel_rows(), [(J + m * l**2) * al - m * g * l * s + tau, Iw * (al + phdd) - tau]),
    "rw-absolute": absolute_wheel(),
    "el-cases": spring(),
    "el-odeint": spring(coriolis=1),
    "cs-coupled": coupled(),
    "sp-vertical-cos": (moved(up=size * cos(phase)), [al + (g - size * speed**2 * cos(phase)) / l * s]),
    "sp-sideways-cos": (moved(right=size * cos(phase)), [al + g / l * s + size * speed**2 / l * cos(phase) * c]),
    "sp-landau-3c": landau_3c(),
    "sp-ddp": driven(),
    "sp-hoop": hoop(),
    "at-swinging": atwood(),
    "la-ladder": ladder(),
    "sp-where": (Mechanism([ANGLE], [Body(m, d * sin(th), -d * cos(th), IG, th)], 0, {th: -c_ * w}),
                 [(IG + m * d**2) * al + c_ * w + m * g * d * s]),
    "dk-compound": compound(),
    "sp-modelica-model": (pendulum(forces={th: -d * w}), [m * l**2 * al + m * g * l * s + d * w]),
    "dp-newton-tensions": (TWO, tensions()),
    "dp-inv-dot": (TWO, linear_system()),
    "dp-zeros-like": (TWO, matplotlib()),
    "cp-julia": (DOWN, julia()),
    "cp-headed": (UP, cart_up()),
    "dp-subequations": (TWO, short_rows()),
    "sp-moments": (rods((l1, m1)), [m1 * l1**2 * a1 / 3 + m1 * g * l1 / 2 * sin(th1)]),
    "pb-quadratic": pendubot_lagrangian(),
    "el-mathematica-list": spring(weight=1),
    "dp-with-two": (TWO, solved()),
    "cp-unicode-lines": (UP, cart_up()),
    "dp-sum-potential": (TWO, no_height()),
    "sp-kapitza-sign": (moved(up=size * cos(phase)), [al + (g / l + size * speed**2 / l * cos(phase)) * s]),
    "sp-scipy-doc": (pendulum(forces={th: -d * w}), [al + d / (m * l**2) * w + g / l * s]),
    "rw-anonymous": (wheel_rows(), [al - (m * g * l * s - tau) / (J + m * l**2), phdd - tau / Iw + (m * g * l * s - tau) / (J + m * l**2)]),
    "dp-c-function": (EQUAL, c_function()),
}  # fmt: skip
