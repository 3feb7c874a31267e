"""What the pendulums and arms of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's φ, r_1, l_{c_1}, I_{zz_1} are th1, l1, lc1, I1.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    I1,
    I2,
    I,
    a1,
    a2,
    al,
    b,
    bobs,
    chain,
    g,
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
    tau,
    tau1,
    tau2,
    th,
    th1,
    th2,
    th3,
    u,
    w,
    w1,
    w2,
    w3,
)
from sympy import Rational, cos, sin
from truth import lagrange, momenta

half = Rational(1, 2)
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
s12, c12 = sin(th1 + th2), cos(th1 + th2)
dry = sp.Symbol("dry")
BOBS = bobs((l1, m1), (l2, m2))


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# One bob


def length_lost():
    return pendulum(), [al + l * g * s]


def note_exclamation():
    """b is the author's c L²."""
    return pendulum(forces={th: -b * w}), [m * l**2 * al + b * w + m * g * l * s]


def torque_left():
    return pendulum(forces={th: u}), [u - l * m * g * s - l**2 * m * al]


def damped_and_driven():
    return pendulum(forces={th: tau - b * w}), [m * l**2 * al + b * w + m * g * l * s - tau]


def dry_and_driven():
    """dry: the moment of the friction with the sign of the rate, one unknown number."""
    true = pendulum(I - m * l**2, forces={th: tau - b * w - dry})
    return true, [I * al + b * w + dry + m * g * l * s - tau]


def weight_sign():
    return pendulum(), [-m * g * l * s + m * l**2 * al]


def half_angle():
    """Twice the square of the sine of half the angle is one minus the cosine; every constant is one."""
    true = pendulum()
    p = sp.Symbol("p")
    energy = half * p**2 + (1 - c)
    (momentum,), (turn,) = momenta(true)
    ones = {g: 1, m: 1, l: 1}
    rate = (w - sp.diff(energy, p)).subs(p, momentum).subs(ones)
    return true, [turn + sp.diff(energy, th)], [rate], ones


# Two bobs


def mathscr_energies():
    true = bobs((l1, m1), (l2, m2), up=True)
    moving = half * m1 * w1**2 * l1**2 + half * m2 * (w2**2 * l2**2 + w1**2 * l2**2 + 2 * w1 * w2 * l1 * l2 * C)
    return true, lagrange(moving - g * ((m1 + m2) * l1 * c1 + m2 * l2 * c2), true)


def spaced_cosine():
    """Both lengths are l; the division is by l² alone, and where it is by the masses too the rows are no better."""
    true = bobs((l, m1), (l, m2))
    between = th2 - th1
    sd, cd = sin(between), cos(between)
    one = w2 * sd * (w2 - w1) + g * (m1 + m2) * s1 - m2 * l**2 * a2 * cd
    return true, [
        a2 - (g / l * s2 - a1 * cd + w1 * sd * (w2 - w1)),
        a1 - one / (l**2 * (m1 + m2)),
    ]


def jsx_escaped():
    """The heights are counted down, the weights are as if they were counted up."""
    both = m1 + m2
    return BOBS, [
        both * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S - l1 * g * both * s1,
        l2 * a2 + l1 * a1 * C - l1 * w1**2 * S - g * s2,
    ]


KNOWN = half * (m1 + m2) * l1**2 * w1**2 + half * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * C


def lean_comment():
    return BOBS, lagrange(KNOWN + (m1 + m2) * g * l1 * c1 + m2 * g * l2 * c2, BOBS)


def first_mass_twice():
    across, along = l1 * w1 * c1, l1 * w1 * s1
    moving = half * m1 * (across**2 + along**2)
    moving += half * m1 * ((across + l2 * w2 * c2) ** 2 + (along + l2 * w2 * s2) ** 2)
    return BOBS, lagrange(moving - g * (-m1 * l1 * c1 - m2 * (l1 * c1 + l2 * c2)), BOBS)


def cosine_not_squared():
    share = m2 / (m1 + m2)
    below = 1 - share * C
    one = -share * w1**2 * S * C + share * g / l1 * s2 * C - share * l2 / l1 * w2**2 * S - g / l1 * s1
    two = share * w2**2 * S * C + g / l2 * s1 * C + l1 / l2 * w1**2 * S - g / l2 * s2
    return BOBS, [a1 - one / below, a2 - two / below]


LOWER = a2 + l1 / l2 * (a1 * C - w1**2 * S) + g / l2 * s2


def rst_labels():
    share = m2 / (m1 + m2)
    return BOBS, [a1 + share * l2 / l1 * (a2 * C + w2**2 * S) + g / l1 * s1, LOWER]


def rst_one_minus():
    both = m2 * l1 * l2
    upper = l1**2 * a1 * (m1 + m2) - both * a2 * C - both * w2 * S * (w1 - w2) + both * w1 * w2 * S
    return BOBS, [upper + g * l1 * (m1 + m2) * s1, LOWER]


def dart_aligned():
    moving = half * m1 * l1**2 * w1**2 + half * m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * C)
    return BOBS, lagrange(moving + (m1 + m2) * g * l1 * c1 + m2 * g * l2 * c2, BOBS)


def dart_states():
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * m2 * S * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * c1 + w2**2 * l2 * m2 * C)
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def french_walrus():
    printed = m1 * (l1 * w1) ** 2 / 2 + m1 * g * l1 * c1
    printed += m2 * ((l1 * w1) ** 2 / 2 + (l2 * w2) ** 2 / 2 + l1 * w1 * l2 * w2 * C) + m2 * g * (l1 * c1 + l2 * c2)
    return BOBS, lagrange(printed, BOBS)


def french_notebook():
    true = bobs((l, m), (l, m))
    moving = m * l**2 * (w1**2 + half * w2**2 + w1 * w2 * C)
    return true, lagrange(moving + m * g * l * (2 * c1 + c2), true)


def chinese_boxed():
    return BOBS, [
        (m1 + m2) * l1 * a1 + m2 * l2 * C * a2 + m2 * l2 * S * w2**2 + (m1 + m2) * g * s1,
        l2 * a2 + l1 * C * a1 - l1 * S * w1**2 + g * s2,
    ]


# Three bobs


def sums_limits():
    masses, lengths = (m1, m2, m3), (l1, l2, l3)
    true = bobs(*zip(lengths, masses, strict=True))
    places = [(th1, w1), (th2, w2), (th3, w3)]
    printed = sp.Integer(0)
    for i, mass in enumerate(masses):
        links_ = list(zip(lengths[: i + 1], places[: i + 1], strict=True))
        across = sum(length * rate * cos(angle) for length, (angle, rate) in links_)
        along = sum(length * rate * sin(angle) for length, (angle, rate) in links_)
        printed += half * mass * (across**2 + along**2)
        printed += g * mass * sum(length * cos(angle) for length, (angle, _) in links_)
    return true, lagrange(printed, true)


def sympy_slips():
    true = bobs((l1, m1), (l2, m2), (l3, m3), relative=True, up=True)
    second, third = th1 + th2, th1 + th2 + th3
    moving = half * (m1 + m2) * l1**2 * w1**2 * (s1**2 + c1**2)
    shared = l1 * c1 * w1 + l2 * (w1 + w2) * cos(second)
    moving += half * m3 * (shared - l3 * (w1 + w2 + w3) * sin(third)) ** 2
    moving += half * m3 * (shared + l3 * (w1 + w2 + w3) * cos(third)) ** 2
    resting = g * l1 * m1 * c1 + g * m2 * (l1 * c1 + l2 * cos(second))
    resting += g * m3 * (l1 * s1 + l2 * sin(second) + l3 * cos(third))
    return true, lagrange(moving - resting, true)


# Arms


def acromonk():
    true = links(True, relative=True, forces={th2: u})
    h = m2 * l1 * lc2 * s2
    both = I2 + m2 * l1 * lc2 * c2
    mass = [[I1 + I2 + m2 * l1**2 + 2 * m2 * l1 * lc2 * c2, both], [both, I2]]
    turn = [[-2 * h * w2, -h * w2], [h * w1, 0]]
    weight = [-m1 * g * lc1 * s1 - m2 * g * (l1 * s1 + lc2 * s12), -m2 * g * lc2 * s12]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), [-part for part in weight], [0, -u])


def gravity_along_x():
    true = links(False, relative=True, up=True, forces={th1: tau1, th2: tau2})
    cross, h = m2 * l1 * lc2 * c2 + m2 * lc2**2 + I2, m2 * l1 * lc2 * s2
    mass = [
        [m1 * lc1**2 + m2 * l1**2 + 2 * m2 * l1 * lc2 * c2 + m2 * lc2**2 + I1 + I2, cross],
        [cross, m2 * lc2**2 + I2],
    ]
    turn = [[-h * w2, -h * w1 - h * w2], [h * w1, 0]]
    weight = [-m1 * g * lc1 * s1 - m2 * g * (lc2 * s12 + l1 * s1), -m2 * g * lc2 * s12]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight, [-tau1, -tau2])


def korean_raw():
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    cross = m2 * (l1 * l2 * c2 + l2**2)
    mass = [[m1 * l1**2 + m2 * (l1**2 + 2 * l1 * l2 * c2 + l2**2), cross], [cross, m2 * l2**2]]
    turn = [-m2 * l1 * l2 * s2 * (2 * w1 * w2 + w2**2), m2 * l1 * l2 * s2 * w1**2]
    weight = [(m1 + m2) * l1 * g * c1 + m2 * g * l2 * c12, m2 * g * l2 * c12]
    return true, added(column(mass, [a1, a2]), turn, weight, [-tau1, -tau2])


def spanish_lagrangian():
    true = chain([(l1, m1, lc1, I1), (l2, m2, lc2, I2)], relative=True)
    moving = half * m1 * lc1**2 * w1**2 + half * I1 * w1**2 + half * m2 * l1**2 * w1**2
    moving += half * m2 * lc2**2 * (w1**2 + 2 * w1 * w2 + w2**2) + m2 * l1 * lc2 * (w1**2 + w1 * w2) * c2
    moving += half * I2 * (w1 + w2) ** 2
    return true, lagrange(moving + m1 * lc1 * g * c1 + m2 * l1 * g * c1 + m2 * lc2 * g * c12, true)


PROOFS = {
    "sp-length-lost": length_lost(),
    "sp-note-exclamation": note_exclamation(),
    "sp-rst-torque-left": torque_left(),
    "sp-doxygen": damped_and_driven(),
    "sp-turkish-dry": dry_and_driven(),
    "sp-leibniz": damped_and_driven(),
    "sp-chinese-weight-sign": weight_sign(),
    "sp-hamilton-half-angle": half_angle(),
    "dp-mathscr-energies": mathscr_energies(),
    "dp-spaced-cosine": spaced_cosine(),
    "dp-jsx-escaped": jsx_escaped(),
    "dp-lean-comment": lean_comment(),
    "dp-first-mass-twice": first_mass_twice(),
    "dp-cosine-not-squared": cosine_not_squared(),
    "dp-rst-labels": rst_labels(),
    "dp-rst-one-minus": rst_one_minus(),
    "dp-dart-aligned": dart_aligned(),
    "dp-dart-states": dart_states(),
    "dp-french-walrus": french_walrus(),
    "dp-french-notebook": french_notebook(),
    "dp-chinese-boxed": chinese_boxed(),
    "tp-sums-limits": sums_limits(),
    "tp-sympy-slips": sympy_slips(),
    "ac-acromonk": acromonk(),
    "rr-gravity-along-x": gravity_along_x(),
    "arm-korean-raw": korean_raw(),
    "rr-spanish-lagrangian": spanish_lagrangian(),
}
