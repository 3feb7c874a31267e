"""What the carts of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's m_c, m_p, r, ω_t are M, m, l, θ.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    ONE,
    TWO,
    WHEEL,
    F,
    I,
    M,
    a1,
    a2,
    al,
    b,
    b1,
    b2,
    cart_pole,
    g,
    l,
    l1,
    l2,
    m,
    m1,
    m2,
    ph,
    phdd,
    th,
    th1,
    th2,
    u,
    w,
    w1,
    w2,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism

half = Rational(1, 2)
s, c = sin(th), cos(th)


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


# A cart and a point mass

STANDING = cart_pole(up=True, forces={x: F})
HANGING = cart_pole(forces={x: F})
PUSH = (M + m) * xdd + m * l * al * c - m * l * w**2 * s - F
WHOLE = m * l**2 * al + m * l * xdd * c
SHORT = l * al + xdd * c


def friction_divided():
    """The pole to the left; its friction is m l bθ, b2 here."""
    true = cart_pole(up=True, left=True, forces={x: F - b1 * xd, th: -m * l * b2 * w})
    push = (M + m) * xdd + b1 * xd - m * l * al * c + m * l * w**2 * s - F
    return true, [push, l * al + b2 * w - g * s - xdd * c]


def torque_solved():
    turn = -g * s * (M + m) - c * (F + m * l * w**2 * s)
    return STANDING, [
        al - turn / (l * (M + m * s**2)),
        xdd - (F + m * l * (w**2 * s - al * c)) / (M + m),
    ]


def plain_brackets():
    turn = (-m * w**2 * s * c - g / l * (M + m) * s) / (M + m - m * c**2)
    return cart_pole(), [al - turn, xdd + m * l / (M + m) * (al * c - w**2 * s)]


LEFT = cart_pole(up=True, left=True, forces={x: F - b1 * xd, th: -b2 * w})


def force_of_time():
    push = (M + m) * xdd - m * l * al * c + m * l * w**2 * s - F + b1 * xd
    return LEFT, [push, l * al - xdd * c - g * s + w * b2 / (m * l)]


def empty_rows():
    below = M + m - m * c**2
    short = F - xd * b1 - w**2 * m * l * s
    turn = short * c - w * b2 * (M + m) / (m * l) + g * (M + m) * s
    return LEFT, [xdd - (short - w * b2 / l * c + g * m * c * s) / below, al - turn / (l * below)]


def one_over():
    below = M + m * s**2
    return HANGING, [
        xdd - (F + m * s * (l * w**2 + g * c)) / below,
        al - (-F * c - m * l * w**2 * c * s - (M + m) * g * s) / (l * below),
    ]


def manipulator():
    mass = column([[M + m, m * l * c], [m * l * c, m * l**2]], [xdd, al])
    turn = column([[0, -m * l * w * s], [0, 0]], [xd, w])
    return HANGING, [mass[0] + turn[0] - F, mass[1] + turn[1] + m * g * l * s]


def all_ones():
    ones = {M: 1, m: 1, l: 1, g: 1}
    return HANGING, [2 * xdd + al * c - w**2 * s - F, xdd * c + al + s], ones


# Two poles

DOUBLE = Mechanism(
    [CART, ONE, TWO],
    [
        Body(M, x, 0),
        Body(m1, x + l1 * sin(th1), -l1 * cos(th1)),
        Body(m2, x + l1 * sin(th1) + l2 * sin(th2), -l1 * cos(th1) - l2 * cos(th2)),
    ],
    0,
    {x: F},
)


def double():
    s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
    both, s12, c12 = m1 + m2, sin(th1 - th2), cos(th1 - th2)
    mass = [
        [M + both, both * l1 * c1, m2 * l2 * c2],
        [both * l1 * c1, both * l1**2, m2 * l1 * l2 * c12],
        [m2 * l2 * c2, m2 * l1 * l2 * c12, m2 * l2**2],
    ]
    squares = [
        -both * l1 * s1 * w1**2 - m2 * l2 * s2 * w2**2,
        m2 * l1 * l2 * s12 * w2**2,
        -m2 * l1 * l2 * s12 * w1**2,
    ]
    rest = [-F, both * g * l1 * s1, m2 * g * l2 * s2]
    rows = [sum(parts) for parts in zip(column(mass, [xdd, a1, a2]), squares, rest, strict=True)]
    return DOUBLE, rows


# A cart and a uniform rod, l its half

ROD = cart_pole(m * l**2 / 3, up=True, forces={x: F})
BELOW = l * (Rational(4, 3) - m * c**2 / (M + m))
MOVED = (F + m * l * w**2 * s) / (M + m)


def barto():
    """temp, b: what the cart's acceleration would be without the pole's."""
    return ROD, [al - (g * s - c * MOVED) / BELOW, xdd - (F + m * l * (w**2 * s - al * c)) / (M + m)]


def half_of_the_angle():
    """l is the rod's length."""
    true = cart_pole(m * l**2 / 12, up=True, forces={x: F}, arm=l / 2)
    short = (F + w**2 * l * sin(th / 2)) / (M + m)
    turn = (g * s - short * c) / (l / 2 * (Rational(4, 3) - m / (M + m) * c**2))
    # the sine of half the angle: the rational points have those of whole multiples, so that θ is doubled throughout
    twice = {th: 2 * th, w: 2 * w, al: 2 * al}
    rows = [row.subs(twice, simultaneous=True) for row in (al - turn, xdd - short + l / 2 * al * c * m / (M + m))]
    pole = Body(m, x + l / 2 * sin(2 * th), l / 2 * cos(2 * th), m * l**2 / 12, 2 * th)
    return Mechanism(true.coordinates, [Body(M, x, 0), pole], 0, {x: F}, False), rows


def mlcos():
    return ROD, [
        (M + m) * xdd - F - m * l * w**2 * s + m * l * al * c,
        Rational(4, 3) * m * l**2 * al - m * g * l * s + m * l * c * xdd,
    ]


def gamma_first():
    turn = (g * s - MOVED * c) / (Rational(4, 3) * (M + m) * l - m * l * c**2)
    return ROD, [al - turn, xdd - MOVED + m * l * al * c / (M + m)]


# A cart with friction, a pole with an inertia about its centre

RUBBED = cart_pole(I, forces={x: F - b * xd})
MASSES = [PUSH + b * xd, (I + m * l**2) * al + m * g * l * s + m * l * xdd * c]


def steps_k():
    short = (F + m * l * w**2 * s - b * xd) / (M + m)
    turn = (-g * s - short * c) / (I / m + l - m * l * c**2 / (M + m))
    return RUBBED, [al - turn, xdd - short + m * l * al * c / (M + m)]


def reactions():
    """N is of the first row, put into the second; P of the two last, by hand: their sum along the pole."""
    n = F - M * xdd - b * xd
    across = n - (m * xdd + m * l * al * c - m * l * w**2 * s)
    # l times the third row and the fourth, added: P and N cancel
    return RUBBED, [across, -m * g * s * l - l * (m * l * al + m * xdd * c) - I * al]


def attributes():
    true = cart_pole(I, up=True, forces={x: u - b * xd})
    return true, [
        (M + m) * xdd + b * xd + m * l * (al * c - w**2 * s) - u,
        (I + m * l**2) * al - m * g * l * s + m * l * xdd * c,
    ]


def output():
    """b1, b2: the inertias of the pole and of the wheel, which has no mass of its own."""
    pole = [Body(m, x + l * s, l * c, b1, th), Body(0, x + l * s, l * c, b2, th + ph)]
    true = Mechanism([CART, ANGLE, WHEEL], [Body(M, x, 0), *pole], 0, {})
    return true, [
        -(w**2) * l * m * s + al * l * m * c + xdd * m + xdd * M,
        al * l**2 * m + xdd * l * m * c - g * l * m * s + b2 * phdd + (b1 + b2) * al,
        b2 * phdd + b2 * al,
    ]


PROOFS = {
    "cp-list-of-ones": (STANDING, [PUSH, WHOLE - m * g * l * s]),
    "cp-friction-of-a-divided-row": friction_divided(),
    "cp-firmware-hanging": (HANGING, [PUSH, SHORT + g * s]),
    "cp-brackets-under-a-list": (RUBBED, MASSES),
    "cp-torque-of-the-wrong-sign": (STANDING, [PUSH, SHORT + g * s]),
    "cp-torque-solved": torque_solved(),
    "cp-plain-brackets": plain_brackets(),
    "dc-one-line-of-matrices": double(),
    "dc-matrices-apart": double(),
    "cp-force-of-time": force_of_time(),
    "cp-aligned-empty-rows": empty_rows(),
    "cp-chinese-one-over": one_over(),
    "cp-chinese-manipulator": manipulator(),
    "cp-all-constants-one": all_ones(),
    "cp-chinese-newton": (HANGING, [PUSH, WHOLE - m * g * l * s]),
    "cp-text-temp": barto(),
    "cp-fraction-in-brackets": barto(),
    "cp-bracket-to-minus-one": barto(),
    "cp-operatorname-temp": barto(),
    "cp-half-of-the-angle": half_of_the_angle(),
    "cp-omega-is-the-angle": barto(),
    "cp-polish-cos-in-italics": (RUBBED, MASSES),
    "cp-equation-in-dollars": (RUBBED, MASSES),
    "cp-steps-k": steps_k(),
    "cp-array-in-single-dollars": (RUBBED, MASSES),
    "cp-reactions-in-a-cell": reactions(),
    "cp-published-cell": (RUBBED, MASSES),
    "cp-attributes-of-a-component": attributes(),
    "cp-mlcos": mlcos(),
    "cp-gamma-first": gamma_first(),
    "cw-rows-of-an-output": output(),
}
