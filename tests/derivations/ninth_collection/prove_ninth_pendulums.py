"""What the pendulums and arms of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's φ, L_1, \\ell_2, L_{c1} are th, l1, l2, lc1.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    I1,
    I2,
    a1,
    a2,
    a3,
    al,
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
    rods,
    tau1,
    tau2,
    th,
    th1,
    th2,
    th3,
    w,
    w1,
    w2,
    w3,
)
from sympy import Rational, cos, sin
from truth import lagrange, momenta, rate

half = Rational(1, 2)
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
p1, p2 = sp.symbols("p1 p2")
BOBS = bobs((l1, m1), (l2, m2))
EQUAL = bobs((l, m), (l, m))
BOTH = m1 + m2


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# Two bobs

# The rows that most texts have: divided by the first length, and by the second length and mass
DIVIDED = [
    BOTH * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + BOTH * g * s1,
    l2 * a2 + l1 * a1 * C - l1 * w1**2 * S + g * s2,
]
LOWER_WITH_MASS = m2 * l2 * a2 + m2 * l1 * a1 * C - m2 * l1 * w1**2 * S + m2 * g * s2
# Not divided
WHOLE = [
    BOTH * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S + BOTH * g * l1 * s1,
    m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C - m2 * l1 * l2 * w1**2 * S + m2 * g * l2 * s2,
]
KNOWN = half * BOTH * l1**2 * w1**2 + half * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * C
KNOWN += BOTH * g * l1 * c1 + m2 * g * l2 * c2


def obsidian_matrix():
    mass = [[BOTH * l1, m2 * l2 * C], [m2 * l1 * C, m2 * l2]]
    squares = [m2 * l2 * w2**2 * S, -m2 * l1 * w1**2 * S]
    return BOBS, added(column(mass, [a1, a2]), squares, [BOTH * g * s1, m2 * g * s2])


def boxed_brace():
    return BOBS, [
        l1 * BOTH * a1 + l2 * m2 * a2 * C + l2 * m2 * w2**2 * S + g * l1 * BOTH * s1,
        l2 * m2 * a2 + l1 * m2 * a1 * C - l1 * m2 * w1**2 + g * l2 * m2 * s2,
    ]


def times_matrix():
    mass = [[l1 * m2 * C, l2 * m2], [l1 * BOTH, l2 * m2 * C]]
    rest = [-l1 * m2 * w1**2 * S + m2 * g * s2, l2 * m2 * w2**2 * S + BOTH * g * s1]
    return BOBS, added(column(mass, [a1, a2]), rest)


def boxed_cases():
    twice = half * sin(2 * th1 - 2 * th2)
    below = m2 * C**2 - m1 - m2
    one = BOTH * g * s1 - l2 * m2 * w2**2 * S + l1 * m2 * w1**2 * twice - m2 * g * s2 * C
    two = BOTH * g * s2 + l2 * m2 * w2**2 * twice - BOTH * w1**2 * S - g * BOTH * s1 * C
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def observable_momenta():
    true = rods((l1, m1), (l2, m2))
    first = (m1 / 3 + m2) * l1**2 * w1 + m2 / 2 * l1 * l2 * w2 * C
    second = m2 / 3 * l2**2 * w2 + m2 / 2 * l1 * l2 * w1 * C
    both = m2 / 2 * l1 * l2 * w1 * w2 * S
    return true, [
        rate(first, true) + both + (m1 / 2 + m2) * g * l1 * s1,
        rate(second, true) - both + m2 / 2 * g * l2 * s2,
    ]


def well_known(lengths=(l1, l2), masses=(m1, m2)):
    """The solved form with the sine of θ1 - 2 θ2."""
    (one, two), (upper, lower) = lengths, masses
    below = 2 * upper + lower - lower * cos(2 * th1 - 2 * th2)
    first = (
        -g * (2 * upper + lower) * s1 - lower * g * sin(th1 - 2 * th2) - 2 * S * lower * (w2**2 * two + w1**2 * one * C)
    )
    second = 2 * S * (w1**2 * one * (upper + lower) + g * (upper + lower) * c1 + w2**2 * two * lower * C)
    return [a1 - first / (one * below), a2 - second / (two * below)]


EQUAL_ROWS = [2 * a1 + a2 * C + w2**2 * S + 2 * g / l * s1, a2 + a1 * C - w1**2 * S + g / l * s2]


def boxed_equal():
    printed = half * m * l**2 * (2 * w1**2 + w2**2 + 2 * w1 * w2 * C) + m * g * l * (2 * c1 + c2)
    return EQUAL, lagrange(printed, EQUAL)


def energies_qquad():
    moving = m * l**2 * (w1**2 + half * w2**2 + w1 * w2 * C)
    return EQUAL, lagrange(moving + m * g * l * (2 * c1 + c2), EQUAL)


def broken_before_equals():
    both = m2 * l1 * l2 * w1 * w2 * S
    return BOBS, [
        BOTH * l1**2 * a1 + m2 * l1 * l2 * a2 * C - both + m2 * l1 * l2 * w2**2 * S + both + BOTH * g * l1 * s1,
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C + both - m2 * l1 * l2 * w1**2 * S - both + m2 * g * l2 * s2,
    ]


def cosine_in_front():
    below = m1 + m2 * S**2
    one = g * BOTH * s1 + C * w1**2 * l1 * m2 * S + w2**2 * l2 * m2 * S - C * g * m2 * s2
    two = C * g * BOTH * s1 + w1**2 * l1 * BOTH * S + C * w2**2 * l2 * m2 * S - g * s2 * BOTH
    return BOBS, [a1 + one / (l1 * below), a2 - two / (l2 * below)]


def unicode_bullets():
    below = m1 + m2 * S**2
    one = m2 * g * s2 * C - m2 * S * (l1 * w1**2 * C + l2 * w2**2) - BOTH * g * s1
    two = BOTH * (l1 * w1**2 * S - g * s2 + g * s1 * C) + m2 * l2 * w2**2 * S * C
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def rust_comment():
    below = l * (2 * m - m * cos(2 * th1 - 2 * th2))
    one = -g * 2 * m * s1 - m * g * sin(th1 - 2 * th2) - 2 * S * m * (w2**2 * l + w1**2 * l * C)
    two = 2 * S * (w1**2 * l * 2 * m + g * 2 * m * c1 + w2**2 * l * m * C)
    return EQUAL, [a1 - one / below, a2 - two / below]


def numbers_relative():
    true = chain([(1, 1, half, 0), (1, 1, half, 0)], relative=True, horizontal=True)
    quarter, both = Rational(1, 4), cos(th1 + th2)
    return true, [
        (3 * half + c2) * a1
        + (half * c2 + quarter) * a2
        - s2 * w1 * w2
        - half * s2 * w2**2
        + 3 * half * g * c1
        + half * g * both,
        (half * c2 + quarter) * a1 + quarter * a2 + half * s2 * w1**2 + half * g * both,
    ]


def braces_misplaced():
    """As it is printed: the upper row is right, the lower row's sine is of the first angle alone."""
    upper, _ = well_known()
    below = l2 * (2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2))
    lower = 2 * s1 - th2 * (w1**2 * l1 * BOTH + g * BOTH * c1 + w2**2 * l2 * m2 * C)
    return BOBS, [upper, a2 - lower / below]


def all_ones():
    ones = {m1: 1, m2: 1, l1: 1, l2: 1, g: 1}
    below = 3 - cos(2 * th1 - 2 * th2)
    one = -3 * s1 - sin(th1 - 2 * th2) - 2 * S * (w2**2 + w1**2 * C)
    two = 2 * S * (2 * w1**2 + 2 * c1 + w2**2 * C)
    return BOBS, [a1 - one / below, a2 - two / below], ones


def hamilton(true, energy):
    """Rows: the momenta's rates; the rates of themselves: the angles' rates."""
    place = dict(zip((p1, p2), momenta(true)[0], strict=True))
    turns = momenta(true)[1]
    rates = [speed - sp.diff(energy, p).subs(place) for speed, p in zip((w1, w2), (p1, p2), strict=True)]
    rows = [turn + sp.diff(energy, q).subs(place) for turn, q in zip(turns, (th1, th2), strict=True)]
    return true, rows, rates


def hamiltonian_spanish():
    above = l2**2 * p1**2 - 2 * l1 * l2 * p1 * p2 * C + 2 * l1**2 * p2**2
    energy = above / (2 * m * l1**2 * l2**2 * (2 - C**2)) - 2 * m * g * l1 * c1 - m * g * l2 * c2
    return hamilton(bobs((l1, m), (l2, m)), energy)


def hamiltonian_breaks():
    above = m2 * l2**2 * p1**2 - 2 * m2 * l1 * l2 * C * p1 * p2 + BOTH * l1**2 * p2**2
    energy = above / (2 * m2 * l1**2 * l2**2 * (m1 + m2 * S**2)) - BOTH * g * l1 * c1 - m2 * g * l2 * c2
    return hamilton(BOBS, energy)


# Two rods

RODS = rods((l1, m1), (l2, m2))


def rods_joined():
    printed = (m1 + 4 * m2) * l1**2 * w1**2 / 24 + m2 * l2**2 * w2**2 / 24 + m2 * l1 * l2 * w1 * w2 * C / 6
    printed += half * (m1 + 2 * m2) * g * l1 * c1 + half * m2 * g * l2 * c2
    return RODS, lagrange(printed, RODS)


def rods_numbers():
    both = m2 * l1 * l2 / 6
    return RODS, [
        (m1 + 4 * m2) * l1**2 * a1 / 12 + both * a2 * C + both * w2**2 * S + half * (m1 + 2 * m2) * g * l1 * s1,
        m2 * l2**2 * a2 / 12 + both * a1 * C - both * w1**2 * S + half * m2 * g * l2 * s2,
    ]


# Three links, flat


def therefore():
    q1, q2, q3 = sp.symbols("Q1 Q2 Q3")
    true = bobs((l1, m1), (l2, m2), (l3, m3), forces={th1: q1, th2: q2, th3: q3})
    near, far = m2 + m3, m3
    s12, c12, s13, c13 = S, C, sin(th1 - th3), cos(th1 - th3)
    s23, c23 = sin(th2 - th3), cos(th2 - th3)
    one = (m1 + m2 + m3) * l1**2 * a1 + near * l1 * l2 * a2 * c12 + far * l1 * l3 * a3 * c13
    one += near * l1 * l2 * w2**2 * s12 + far * l1 * l3 * w3**2 * s13 - q1
    two = near * l2**2 * a2 + near * l1 * l2 * a1 * c12 + far * l2 * l3 * a3 * c23
    two += -near * l1 * l2 * w1**2 * s12 - far * l2 * l3 * w3**2 * s23 - q2
    three = far * l3**2 * a3 + far * l1 * l3 * a1 * c13 + far * l2 * l3 * a2 * c23
    three += -far * l1 * l3 * w1**2 * s13 - far * l2 * l3 * w2**2 * s23 - q3
    return true, [one, two, three], {g: 0}


# One bob


def typst_omega():
    return pendulum(), [al + g / l * sin(w)]


def typst_quad():
    return pendulum(), [al + g / l * s]


def energies_array():
    true = pendulum()
    moving = half * m * ((l * w * c) ** 2 + (l * w * s) ** 2)
    return true, lagrange(moving + m * g * l * c, true)


def rate_left_standing():
    """The three printed rows are one."""
    true = pendulum()
    return true, [rate(m * l**2 * w, true) + m * g * l * s]


def one_lagrangian():
    true = pendulum()
    return true, lagrange(half * m * l**2 * w**2 + m * g * l * c, true)


# Two links

ARM = links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
FIRST = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2)
BETWEEN = m2 * (lc2**2 + l1 * lc2 * c2)
WEIGHTS = [(m1 * lc1 + m2 * l1) * g * c1 + m2 * lc2 * g * cos(th1 + th2), m2 * lc2 * g * cos(th1 + th2)]


def arm_rows():
    """The three texts have these entries, two of them in so many words, one with h = -m2 l1 lc2 sin q2."""
    mass = [[FIRST + I1 + I2, BETWEEN + I2], [BETWEEN + I2, m2 * lc2**2 + I2]]
    h = -m2 * l1 * lc2 * s2
    turn = [[h * w2, h * (w1 + w2)], [-h * w1, 0]]
    return ARM, added(column(mass, [a1, a2]), column(turn, [w1, w2]), WEIGHTS, [-tau1, -tau2])


def flat_inverse():
    true = chain([(l1, m1, lc1, 0), (l2, m2, lc2, 0)], relative=True)
    h = m2 * l1 * lc2 * s2
    mass = [[FIRST, BETWEEN], [BETWEEN, m2 * lc2**2]]
    turn = [[-h * w2, -h * (w1 + w2)], [h * w1, 0]]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2])), {g: 0}


def simplified():
    true = chain(
        [(l1, m1, l1 / 2, I1), (l2, m2, l2 / 2, I2)], relative=True, horizontal=True, forces={th1: tau1, th2: tau2}
    )
    between = m2 * l2**2 / 4 + m2 * l1 * l2 * c2 + I2
    mass = [
        [m1 * l1**2 / 4 + I1 + m2 * l1**2 + m2 * l2**2 / 4 + m2 * l1 * l2 * c2 + I2, between],
        [between, m2 * l2**2 / 4 + I2],
    ]
    h = m2 * l1 * l2 / 2 * s2
    last = -m2 * l2 / 2 * g * cos(th1 + th2)
    weights = [-(m1 * l1 / 2 + m2 * l1) * g * c1 + last, last]
    return true, added(column(mass, [a1, a2]), column([[0, -h], [h, 0]], [w1, w2]), weights, [-tau1, -tau2])


PROOFS = {
    "dp-obsidian-matrix": obsidian_matrix(),
    "dp-fence-lagrangian": (BOBS, lagrange(KNOWN, BOBS)),
    "dp-boxed-brace": boxed_brace(),
    "dp-times-matrix": times_matrix(),
    "dp-boxed-cases": boxed_cases(),
    "dp-observable-block": (BOBS, WHOLE),
    "dp-observable-momenta": observable_momenta(),
    "dp-omega-system": (BOBS, well_known()),
    "dp-spanish-ell": (BOBS, WHOLE),
    "dp-boxed-equal": boxed_equal(),
    "dp-energies-qquad": energies_qquad(),
    "dp-vietnamese-inline": (BOBS, [DIVIDED[0], LOWER_WITH_MASS]),
    "dp-ampersand-inside": (BOBS, DIVIDED),
    "dp-in-a-sentence": (EQUAL, EQUAL_ROWS),
    "dp-broken-before-equals": broken_before_equals(),
    "dp-cosine-in-front": cosine_in_front(),
    "dp-korean-numbered": (BOBS, WHOLE),
    "dp-cases-spaced": (BOBS, [DIVIDED[0], LOWER_WITH_MASS]),
    "dp-displaystyle": (BOBS, lagrange(KNOWN, BOBS)),
    "dp-numbered-inline": (BOBS, DIVIDED),
    "dp-unicode-bullets": unicode_bullets(),
    "dp-rust-comment": rust_comment(),
    "dp-numbers-relative": numbers_relative(),
    "dp-python-comment": (BOBS, DIVIDED),
    "dp-braces-misplaced": braces_misplaced(),
    "dp-sine-in-italics": (BOBS, well_known()),
    "dp-all-ones-primes": all_ones(),
    "dp-hamiltonian-spanish": hamiltonian_spanish(),
    "dp-hamiltonian-breaks": hamiltonian_breaks(),
    "dp-homework-l-ampersand": (BOBS, lagrange(KNOWN, BOBS)),
    "dp-rods-dollars-joined": rods_joined(),
    "dp-rods-equation-numbers": rods_numbers(),
    "tp-therefore": therefore(),
    "sp-typst-omega": typst_omega(),
    "sp-typst-quad": typst_quad(),
    "sp-energies-array": energies_array(),
    "sp-spanish-boxed-page": rate_left_standing(),
    "sp-implies-korean": typst_quad(),
    "sp-unicode-bold": one_lagrangian(),
    "rr-chinese-cards": arm_rows(),
    "rr-chinese-bullets": arm_rows(),
    "rr-details": arm_rows(),
    "rr-flat-inverse": flat_inverse(),
    "rr-simplified": simplified(),
}
