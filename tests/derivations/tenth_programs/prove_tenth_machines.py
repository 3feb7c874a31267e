"""What this folder's programs of carts, springs and arms compute, entered by hand from their text, and what each is of.

The letters here are the mechanisms' own. A program that inverts a matrix, or solves with one, has its rows before that.
"""

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
    al,
    b,
    bobs,
    cart_pole,
    chain,
    elastic,
    g,
    k,
    l,
    l1,
    l2,
    lc1,
    lc2,
    links,
    m,
    m1,
    m2,
    r,
    r0,
    rd,
    rdd,
    tau,
    tau1,
    tau2,
    th,
    th1,
    th2,
    w,
    w1,
    w2,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism

s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# Springs


def stretch():
    """r is the stretch beyond l, the spring's own length."""
    true = elastic(k * r**2 / 2, l + r)
    return true, [rdd - ((l + r) * w**2 - k / m * r + g * c), al + (g * s + 2 * rd * w) / (l + r)]


def leg(horizontal):
    place = (r * c, r * s) if horizontal else (r * s, r * c)
    return Mechanism([RADIUS, ANGLE], [Body(m, *place)], k * (r - r0) ** 2 / 2)


def leg_horizontal():
    return leg(True), [rdd - (r * w**2 - g * s - k / m * (r - r0)), al + 2 / r * rd * w + g / r * c]


def leg_upright():
    return leg(False), [rdd - (k / m * (r0 - r) + r * w**2 - g * c), al - (g * r * s - 2 * r * rd * w) / r**2]


# A cart and a point mass

STANDING = cart_pole(up=True, forces={x: F})
HANGING = cart_pole(forces={x: F})


def thrice():
    true = cart_pole(forces={x: F, th: -b * w})
    turn = -F * c - m * l * w**2 * c * s - (M + m + m) * g * s - b * w
    return true, [
        al - turn / (l * (M + m + m * s**2)),
        xdd - (F + m * s * (l * w**2 + g * c)) / (M + m * s**2),
    ]


def left():
    true = cart_pole(up=True, left=True, forces={x: F})
    below = M + m * s**2
    return true, [
        xdd - (F - m * l * w**2 * s + m * g * s * c) / below,
        al - (F * c - m * l * w**2 * s * c + (M + m) * g * s) / (l * below),
    ]


def hanging(sign=1):
    below = M + m * s**2
    turn = -F * c - m * l * w**2 * s * c - (M + m) * g * s
    return HANGING, [xdd - (F + m * s * (l * w**2 + g * c)) / below, al - sign * turn / (l * below)]


def lstsq():
    mass = column([[M + m, m * l * c], [m * l * c, m * l**2]], [xdd, al])
    return HANGING, [mass[0] - m * w * l * s * w - F, mass[1] + m * g * l * s]


def net_force():
    true = cart_pole(up=True, forces={x: F - b * xd})
    net, den = F - b * xd, M + m * s**2
    turn = (M + m) * g * s - c * (net + m * l * w**2 * s)
    return true, [al - turn / (l * den), xdd - (net + m * s * (l * w**2 - g * c)) / den]


def two_denominators():
    true, den = cart_pole(up=True), M + m * s**2
    turn = (g * s - c * m * l * w**2 * s / den) / (l * (Rational(4, 3) - m * c**2 / den))
    return true, [al - turn, xdd - m * l * (w**2 * s - al * c) / den]


def force_function():
    den = M + m - m * c**2
    turn = -F * c - m * l * w**2 * s * c + (M + m) * g * s
    return STANDING, [xdd - (F + m * l * w**2 * s - m * g * c * s) / den, al - turn / (l * den)]


# A cart and a uniform rod, l its half

ROD = cart_pole(m * l**2 / 3, up=True, forces={x: F})


def barto():
    short = (F + m * l * w**2 * s) / (M + m)
    turn = (g * s - c * short) / (l * (Rational(4, 3) - m * c**2 / (M + m)))
    return ROD, [al - turn, xdd - short + m * l * al * c / (M + m)]


def batch():
    total = M + m
    turn = (-m * l * s * c * w**2 + total * g * s - F * c) / (l * (Rational(4, 3) * total - m * c**2))
    return ROD, [al - turn, xdd - (m * l * s * w**2 - m * l * al * c + F) / total]


def handle():
    """ratio: the pole's mass over both; the sine of 2 θ over 2 is s c."""
    ratio = m / (m + M)
    below = Rational(4, 3) - ratio * c**2
    short = g * s - l * ratio * w**2 * sin(2 * th) / 2
    push = ratio * l * w**2 * s - ratio * c * short / below + (ratio**2 * c**2 / (m * below) + ratio / m) * F
    return ROD, [xdd - push, al - short / (l * below) + ratio * c / (m * l * below) * F]


def divided_twice():
    total = M + m
    aux = (F + m * l * w**2 * s) / total
    aux2 = l * (Rational(4, 3) - m * c**2 / total)
    aux3, aux4 = (g * s - c) * aux / aux2, c / total
    return ROD, [xdd - aux + m * l * aux3 * aux4, al - aux3 / aux2 * aux4]


# Two links


def inertia_times_mass():
    """Point masses with inertias about themselves; b: the friction of both joints, 1 in the program."""
    true = chain(
        [(l1, m1, l1, I1), (l2, m2, l2, I2)],
        relative=True,
        horizontal=True,
        forces={th1: -b * w1, th2: tau - b * w2},
    )
    between = m2 * (l2**2 + l1 * l2 * c2 + I2)
    mass = [[m1 * l1**2 + I1 + m2 * (l1**2 + l2**2 + 2 * l1 * l2 * c2) + I2, between], [between, l2**2 * m2 + I2]]
    h = l1 * l2 * m2 * s2
    lower = m2 * l2 * cos(th1 + th2) * g
    weights = [(m1 + m2) * l2 * c1 * g + lower, lower]
    turn = [-(2 * w1 * w2 + w2**2) * h, h * w1**2]
    return true, added(column(mass, [a1, a2]), turn, weights, [b * w1, b * w2 - tau])


def commented_matrix():
    true = links(True, relative=True, forces={th2: tau})
    between = I2 + m2 * l1 * lc2 * c2
    mass = [[I1 + I2 + m2 * lc1**2 + m2 * (l1**2 + 2 * l1 * lc2 * c2), between], [between, I2]]
    h = m2 * l1 * lc2 * s2
    lower = m2 * lc2 * g * sin(th1 + th2)
    turn = [-h * (2 * w1 * w2 + w2**2), h * w1**2]
    return true, added(column(mass, [a1, a2]), turn, [(m1 * lc1 + m2 * l1) * g * s1 + lower, lower - tau])


def pinv():
    true = bobs((l1, m1), (l2, m2), relative=True, up=True, forces={th2: tau})
    one, two, three = (m1 + m2) * l1**2, m2 * l2**2, m2 * l1 * l2
    mass = [[one + two + 2 * three * c2, three * c2 + two], [three * c2 + two, two]]
    turn = [-2 * three * w1 * w2 * s2 - three * w2**2 * s2, three * w1**2 * s2]
    lower = -m2 * g * l2 * sin(th1 + th2)
    return true, added(column(mass, [a1, a2]), turn, [-(m1 + m2) * g * l1 * s1 + lower, lower - tau])


def matrices_returned():
    """M q̈ + C q̇ + G = τ."""
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    between = m2 * l2**2 + m2 * l1 * l2 * c2
    mass = [[(m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2, between], [between, m2 * l2**2]]
    h = -m2 * l1 * l2 * s2
    turn = column([[h * w2, h * (w1 + w2)], [-h * w1, 0]], [w1, w2])
    lower = m2 * g * l2 * cos(th1 + th2)
    weights = [(m1 + m2) * g * l1 * c1 + lower - tau1, lower - tau2]
    return true, added(column(mass, [a1, a2]), turn, weights)


PROOFS = {
    "el-python-stretch": stretch(),
    "sl-python-dataclass": leg_horizontal(),
    "sl-python-state-indexed": leg_upright(),
    "cp-python-moved-mass-thrice": thrice(),
    "cp-python-namedtuple-steps": barto(),
    "cp-python-batch-columns": batch(),
    "cp-casadi-left": left(),
    "cp-casadi-chinese": hanging(),
    "cp-jax-lstsq": lstsq(),
    "ac-jax-inertia-times-mass": inertia_times_mass(),
    "ac-python-commented-matrix": commented_matrix(),
    "ac-python-pinv": pinv(),
    "rr-matlab-matrices-returned": matrices_returned(),
    "cp-matlab-net-force": net_force(),
    "cp-matlab-two-denominators": two_denominators(),
    "cp-matlab-force-function": force_function(),
    "cp-matlab-handle": handle(),
    "cp-matlab-minus-about-all": hanging(-1),
    "cp-julia-divided-twice": divided_twice(),
}
