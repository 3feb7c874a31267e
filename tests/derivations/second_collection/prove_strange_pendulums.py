# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""What the chains and single pendulums of this folder print, entered by hand from the page, and what each describes."""

import sympy as sp
from mechanisms import (  # fmt: skip
    a1,
    a2,
    a3,
    al,
    b,
    bobs,
    g,
    k,
    l,
    l1,
    l2,
    l3,
    m,
    m1,
    m2,
    m3,
    pendulum,
    rods,
    th,
    th1,
    th2,
    th3,
    w,
    w1,
    w2,
    w3,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, momenta, rate, rows_of

half = Rational(1, 2)
D, S, C = th1 - th2, sin(th1 - th2), cos(th1 - th2)
TWO = bobs((l1, m1), (l2, m2))
RODS = rods((l1, m1), (l2, m2))
EQUAL = bobs((l, m), (l, m))
THREE = bobs((l1, m1), (l2, m2), (l3, m3))
c1, c2, k1, k2, d, IG = sp.symbols("c1 c2 k1 k2 d IG")
below = m1 + m2 * S**2


def rows(back=-1, weight=l1):
    """Divided by a length; ``back``: the sign of the second centrifugal term."""
    return [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + (m1 + m2) * g * sin(th1) * weight / l1,
        l2 * a2 + l1 * a1 * C + back * l1 * w1**2 * S + g * sin(th2),
    ]


def long_rows():
    """As Lagrange's equations give them."""
    return [l1 * rows()[0], m2 * l2 * rows()[1]]


def bob_lagrangian(turn=C, mixed=2):
    v2 = l1**2 * w1**2 + l2**2 * w2**2 + mixed * l1 * l2 * w1 * w2 * turn
    return (m1 * l1**2 * w1**2 / 2 + m2 * v2 / 2 + m1 * g * l1 * cos(th1)
            + m2 * g * (l1 * cos(th1) + l2 * cos(th2)))  # fmt: skip


def coding_train(other=l2):
    den = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    first = (-g * (2 * m1 + m2) * sin(th1) - m2 * g * sin(th1 - 2 * th2)
             - 2 * S * m2 * (w2 * w2 * l2 + w1 * w1 * l1 * C))  # fmt: skip
    second = 2 * S * (w1 * w1 * l1 * (m1 + m2) + g * (m1 + m2) * cos(th1) + w2 * w2 * l2 * m2 * C)
    return [a1 - first / (l1 * den), a2 - second / (other * den)]


def matplotlib():
    e = th2 - th1
    den1 = (m1 + m2) * l1 - m2 * l1 * cos(e) ** 2
    first = (m2 * l1 * w1**2 * sin(e) * cos(e) + m2 * g * sin(th2) * cos(e) + m2 * l2 * w2**2 * sin(e)
             - (m1 + m2) * g * sin(th1))  # fmt: skip
    second = (-m2 * l2 * w2**2 * sin(e) * cos(e) + (m1 + m2) * g * sin(th1) * cos(e)
              - (m1 + m2) * l1 * w1**2 * sin(e) - (m1 + m2) * g * sin(th2))  # fmt: skip
    return [a1 - first / den1, a2 - second / (l2 / l1 * den1)]


def linear_system():
    a = sp.Matrix([[(m1 + m2) * l1, m2 * l2 * C], [l1 * C, l2]])
    right = sp.Matrix([-m2 * l2 * w2**2 * S - (m1 + m2) * g * sin(th1), l1 * w1**2 * S - g * sin(th2)])
    return list(a * sp.Matrix([a1, a2]) - right)


def relative_matrices():
    c, s = cos(th2), sin(th2)
    mass = sp.Matrix([[(m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c, m2 * l2**2 + m2 * l1 * l2 * c],
                      [m2 * l2**2 + m2 * l1 * l2 * c, m2 * l2**2]])  # fmt: skip
    coriolis = sp.Matrix([[-2 * m2 * l1 * l2 * s * w2, -m2 * l1 * l2 * s * w2], [m2 * l1 * l2 * s * w1, 0]])
    weight = sp.Matrix([(m1 + m2) * g * l1 * sin(th1) + m2 * g * l2 * sin(th1 + th2), m2 * g * l2 * sin(th1 + th2)])
    return list(mass * sp.Matrix([a1, a2]) + coriolis * sp.Matrix([w1, w2]) + weight)


def solved_mu(mu):
    first = g * (sin(th2) * C - mu * sin(th1)) - (l2 * w2**2 + l1 * w1**2 * C) * S
    second = g * mu * (sin(th1) * C - sin(th2)) + (mu * l1 * w1**2 + l2 * w2**2 * C) * S
    return [a1 - first / (l1 * (mu - C**2)), a2 - second / (l2 * (mu - C**2))]


def assencio():
    one, two = l2 / l1 * (m2 / (m1 + m2)) * C, l1 / l2 * C
    f1 = -l2 / l1 * (m2 / (m1 + m2)) * w2**2 * S - g / l1 * sin(th1)
    f2 = l1 / l2 * w1**2 * S - g / l2 * sin(th2)
    return [a1 - (f1 - one * f2) / (1 - one * two), a2 - (-two * f1 + f2) / (1 - one * two)]


def hamilton(mixed):
    """ṗ with p and ṗ of the true motion put in, and the rates from the momenta, which must hold of themselves."""
    (p1, p2), (s1, s2) = momenta(TWO)
    one = p1 * p2 * S / (l1 * l2 * below)
    top = l2**2 * m2 * p1**2 + l1**2 * (m1 + m2) * p2**2 - mixed * l1 * l2 * m2 * p1 * p2 * C
    two = top / (2 * l1**2 * l2**2 * below**2) * sin(2 * D)
    slopes = [s1 + (m1 + m2) * g * l1 * sin(th1) + one - two, s2 + m2 * g * l2 * sin(th2) - one + two]
    rates = [w1 - (l2 * p1 - l1 * p2 * C) / (l1**2 * l2 * below),
             w2 - (l1 * (m1 + m2) * p2 - l2 * m2 * p1 * C) / (l1 * l2**2 * m2 * below)]  # fmt: skip
    return TWO, slopes, rates


def springs():
    true = rods((l1, m1), (l2, m2), potential=k1 * th1**2 / 2 + k2 * (th2 - th1) ** 2 / 2)
    printed = ((m1 / 3 + m2) * l1**2 * w1**2 / 2 + m2 * l2**2 * w2**2 / 6 + m2 * l1 * l2 * w1 * w2 * C / 2
               + (m1 / 2 + m2) * g * l1 * cos(th1) + m2 * g * l2 * cos(th2) / 2 - k1 * th1**2 / 2 - k2 * th2**2 / 2)  # fmt: skip
    return true, lagrange(printed, true)


def damped():
    true = bobs((l1, m1), (l2, m2), forces={th1: -c1 * w1 + c2 * (w2 - w1), th2: -c2 * (w2 - w1)})
    first, second = long_rows()
    return true, [first + (c1 + c2) * w1 - c2 * w2, second + c2 * (w2 - w1)]


def scalar_speeds():
    printed = (m1 * (l1 * w1) ** 2 / 2 + m2 * (l1 * w1 + l2 * w2) ** 2 / 2 + m1 * g * l1 * cos(th1)
               + m2 * g * (l1 * cos(th1) + l2 * cos(th2)))  # fmt: skip
    return TWO, lagrange(printed, TWO)


def mprint():
    return [
        g * l1 * m1 * sin(th1) + g * l1 * m2 * sin(th1) + l1**2 * m1 * a1
        + m2 * (2 * l1**2 * a1 + 2 * l1 * l2 * S * w2**2 + 2 * l1 * l2 * C * a2) / 2,
        g * l2 * m2 * sin(th2) + m2 * (-2 * l1 * l2 * S * w1**2 + 2 * l1 * l2 * C * a1 + 2 * l2**2 * a2) / 2,
    ]  # fmt: skip


def before_the_derivative():
    first = (m1 + m2) * l1**2 * w1 + m2 * l1 * l2 * w2 * C
    second = m2 * l2**2 * w2 + m2 * l1 * l2 * w1 * C
    mixed = m2 * l1 * l2 * w1 * w2 * S
    return [
        rate(first, TWO) + mixed + (m1 + m2) * g * l1 * sin(th1),
        rate(second, TWO) - mixed + m2 * g * l2 * sin(th2),
    ]


def equal_bobs():
    return EQUAL, [2 * a1 + a2 * C + w2**2 * S + 2 * g / l * sin(th1), a2 + a1 * C - w1**2 * S + g / l * sin(th2)]


def fortran():
    gravity, den = Rational(981, 100), 3 - cos(2 * th1 - 2 * th2)
    first = -3 * gravity * sin(th1) - gravity * sin(th1 - 2 * th2) - 2 * S * (w2**2 + w1**2 * C)
    second = 2 * S * (2 * w1**2 + 2 * gravity * cos(th1) + w2**2 * C)
    true = bobs((sp.Integer(1), m), (sp.Integer(1), m))
    return true, [a1 - first / den, a2 - second / den], {g: gravity}


def commented():
    first = m2 * g * sin(th2) * C - m2 * l1 * w1**2 * S * C - m2 * l2 * w2**2 * S - (m1 + m2) * g * sin(th1)
    second = (m1 + m2) * (l1 * w1**2 * S - g * sin(th2) + g * sin(th1) * C) + m2 * l2 * w2**2 * S * C
    return [a1 - first / (l1 * below), a2 - second / (l2 * below)]


def triple_matrices():
    n, angles = (m1 + m2 + m3, m2 + m3, m3), (th1, th2, th3)
    length, rate, acceleration = (l1, l2, l3), (w1, w2, w3), (a1, a2, a3)
    return [
        sum(n[max(i, j)] * length[i] * length[j]
            * (cos(angles[i] - angles[j]) * acceleration[j] + sin(angles[i] - angles[j]) * rate[j] ** 2) for j in range(3))
        + n[i] * g * length[i] * sin(angles[i]) for i in range(3)
    ]  # fmt: skip


def rod_rows():
    return [
        (m1 / 3 + m2) * l1**2 * a1 + m2 * l1 * l2 * (a2 * C + w2**2 * S) / 2 + (m1 / 2 + m2) * g * l1 * sin(th1),
        m2 * l2**2 * a2 / 3 + m2 * l1 * l2 * (a1 * C - w1**2 * S) / 2 + m2 * g * l2 * sin(th2) / 2,
    ]


def rods_at_the_middle():
    return [
        (m1 / 3 + m2 / 4) * l1**2 * a1 + m2 * l1 * l2 * (a2 * C + w2**2 * S) / 4 + (m1 + m2) / 2 * g * l1 * sin(th1),
        m2 * l2**2 * a2 / 3 + m2 * l1 * l2 * (a1 * C - w1**2 * S) / 4 + m2 * g * l2 * sin(th2) / 2,
    ]


def forked():
    """θ_a, θ_b, θ_c as th1, th2, th3: two bobs hang at the end of one rod."""
    x1, y1 = l1 * sin(th1), -l1 * cos(th1)
    bodies = [Body(m1, x1, y1), Body(m2, x1 + l2 * sin(th2), y1 - l2 * cos(th2)),
              Body(m3, x1 + l3 * sin(th3), y1 - l3 * cos(th3))]  # fmt: skip
    e, f = th1 - th2, th1 - th3
    printed = [
        (m1 + m2 + m3) * l1 * a1 + m2 * l2 * (a2 * cos(e) + w2**2 * sin(e)) + m3 * l3 * (a3 * cos(f) + w3**2 * sin(f))
        + (m1 + m2 + m3) * g * sin(th1),
        l2 * a2 + l1 * (a1 * cos(e) - w1**2 * sin(e)) + g * sin(th2),
        l3 * a3 + l1 * (a1 * cos(f) - w1**2 * sin(f)) + g * sin(th3),
    ]  # fmt: skip
    return Mechanism(list(THREE.coordinates), bodies), printed


def moved_support(printed, sideways):
    """x is the support's own coordinate, driven by whatever moves it so: its row is the truth's."""
    side = (x + l * sin(th), -l * cos(th)) if sideways else (l * sin(th), x - l * cos(th))
    force = sp.Symbol("reaction")
    true = Mechanism([(x, xd, xdd), (th, w, al)], [Body(m, *side)], 0, {x: force, **({th: -b * w} if sideways else {})})
    return true, [rows_of(true)[0], printed(xdd)]


PENDULUM, ROD = pendulum(), pendulum(arm=l / 2, inertia=m * l**2 / 12)
PROOFS = {
    "dp-align-nonumber": (TWO, rows()), "dp-split": (TWO, long_rows()),
    "dp-landau": (TWO, lagrange(bob_lagrangian(), TWO)),
    "dp-landau-plus": (TWO, lagrange(bob_lagrangian(turn=cos(th1 + th2)), TWO)),
    "dp-mathematica": (TWO, long_rows()), "dp-mathematica-full": (TWO, rows(back=1)),
    "dp-maple": (TWO, rows()), "dp-maple-dollar": (TWO, rows(weight=l2)),
    "dp-matlab-symbolic": (TWO, rows()), "dp-modelica": (TWO, rows()),
    "dp-coding-train": (TWO, coding_train()), "dp-coding-train-den": (TWO, coding_train(other=l1)),
    "dp-c-pow": (TWO, matplotlib()), "dp-matplotlib": (TWO, matplotlib()),
    "dp-linalg-solve": (TWO, linear_system()),
    "dp-numpy-inv": (bobs((l1, m1), (l2, m2), relative=True), relative_matrices()),
    "dp-french": (TWO, lagrange(bob_lagrangian(), TWO)), "dp-german": (TWO, rows()),
    "dp-alpha-beta": (TWO, rows(back=1)), "dp-mu": (TWO, solved_mu(1 + m1 / m2)),
    "dp-mu-inverse": (TWO, solved_mu(m1 / m2)), "dp-assencio-functions": (TWO, assencio()),
    "dp-weisstein-hamilton": hamilton(2), "dp-weisstein-misprint": hamilton(1),
    "dp-damped-rows": damped(), "dp-torsion-springs": springs(), "dp-scalar-speeds": scalar_speeds(),
    "dp-word": (TWO, rows()), "dp-typst": (TWO, rows()), "dp-modelingtoolkit": (TWO, rows()),
    "dp-maxima": (TWO, rows()), "dp-mprint": (TWO, mprint()), "dp-kane-latex": (TWO, long_rows()),
    "dp-fullwidth": (TWO, rows()), "dp-total-derivative": (TWO, before_the_derivative()),
    "dp-two-omegas": equal_bobs(), "dp-fortran": fortran(), "dp-commented": (TWO, commented()),
    "tp-matrix": (THREE, triple_matrices()),
    "dp-eulerlagrange-stages": (TWO, lagrange(bob_lagrangian(mixed=1), TWO)),
    "dr-goldstein": (RODS, rod_rows()), "dr-end-mass": (RODS, rods_at_the_middle()), "tr-y-shape": forked(),
    "sp-leibniz": (PENDULUM, [al + g / l * sin(th)]),
    "sp-strogatz": (pendulum(forces={th: -b * w}), [al + g / l * sin(th) + b / (m * l**2) * w]),
    "sp-khalil": (pendulum(forces={th: -k * l**2 * w}), [al + g / l * sin(th) + k / m * w]),
    "sp-steiner": (pendulum(inertia=IG, arm=d), [(IG + m * d**2) * al + m * g * d * sin(th)]),
    "sp-rod-thirds": (ROD, [m * l**2 * al / 3 + m * g * l / 2 * sin(th)]),
    "sp-rod-half": (ROD, [m * l**2 * al / 12 + m * g * l / 2 * sin(th)]),
    "sp-lagrange-step": (PENDULUM, [m * l**2 * al + m * g * l * sin(th)]),
    "sp-linear": (PENDULUM, [al + g / l * th]),
    "sp-horizontal-support": moved_support(
        lambda own: m * l**2 * al + b * w + m * l * own * cos(th) + m * g * l * sin(th), sideways=True),
    "sp-sine-support": moved_support(lambda own: al + (g + own) / l * sin(th), sideways=False),
}  # fmt: skip
