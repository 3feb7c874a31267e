"""What the programs of this folder compute, entered by hand from their text, and what each describes.

The letters here are the mechanisms' own. A program that inverts a matrix, or solves with one, has its rows before that.
Run as a script, it compares each verdict of index.toml with what follows from positions alone.
"""

from pathlib import Path

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    I1,
    I2,
    ONE,
    TWO,
    WHEEL,
    I,
    a1,
    a2,
    al,
    b1,
    b2,
    bobs,
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
    m3,
    ph,
    phdd,
    r,
    r0,
    rd,
    rdd,
    rods,
    tau,
    tau1,
    tau2,
    th,
    th1,
    th2,
    u,
    w,
    w1,
    w2,
)
from prove_eighth_poles import PROOFS as POLES
from prove_eighth_poles import added, column
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, momenta
from verdicts import print_verdicts

half = Rational(1, 2)
BOBS = bobs((l1, m1), (l2, m2))
d = th1 - th2
S, C = sin(d), cos(d)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
s12, c12 = sin(th1 + th2), cos(th1 + th2)
both = m1 + m2
X, Y, V, U, A, B, I3, hip, share = sp.symbols("X Y V U A B I3 hip share")
p1, p2 = sp.symbols("p1 p2")


# Two bobs and rods


def casadi_torques():
    """The torques do work on the angles themselves."""
    true = bobs((l1, m1), (l2, m2), forces={th1: tau1, th2: tau2})
    below = m2 * cos(2 * d) - 2 * m1 - m2
    one = l1**2 * l2 * m2 * w1**2 * sin(2 * d) + 2 * tau2 * C * l1
    inner = g * sin(th1 - 2 * th2) * l1 * m2 / 2 + S * w2**2 * l1 * l2 * m2 + g * l1 * (m1 + m2 / 2) * s1 - tau1
    two = -g * l1 * l2 * m2 * both * sin(2 * th1 - th2) - l1 * l2**2 * m2**2 * w2**2 * sin(2 * d)
    two += -2 * w1**2 * l1**2 * l2 * m2 * both * S + 2 * tau1 * C * l2 * m2 + l1 * both * (s2 * g * l2 * m2 - 2 * tau2)
    return true, [
        a1 - (one + 2 * inner * l2) / (l1**2 * l2 * below),
        a2 - two / (l2**2 * l1 * m2 * below),
    ]


def squares_in_place():
    mass = [[both * l1**2, m2 * l1 * l2 * C], [m2 * l1 * l2 * C, m2 * l2**2]]
    right = [
        w1**2 * m2 * l1 * l2 * S - both * l1 * s1 * g,
        w2**2 * m2 * l1 * l2 * S - m2 * l2 * s2 * g,
    ]
    return BOBS, added(column(mass, [a1, a2]), [-part for part in right])


def one_denominator():
    below = 2 * m1 + m2 - m2 * cos(2 * d)
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * both + g * both * c1 + w2**2 * l2 * m2 * C)
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def upper_weight():
    above = m2 * g * l1 * s2 * C - m2 * l1**2 * w1**2 * S * C - both * g * l1 * s1 - m2 * l1 * l2 * w2**2 * S
    return BOBS, [
        a1 - above / (both * l1**2 - m2 * l1**2 * C**2),
        a2 - (l1 * w1**2 * S - l1 * a1 * C - g * s1) / l2,
    ]


def ratio():
    share = both / m2
    one = g * (s2 * C - share * s1) - (l1 * w1 * w1 * C + l2 * w2 * w2) * S
    two = g * share * (C * s1 - s2) + (share * l1 * w1 * w1 + l2 * w2 * w2 * C) * S
    return BOBS, [a1 - one / (l1 * (share - C * C)), a2 - two / (l2 * (share - C * C))]


def by_momenta(true, first, second, third, fourth):
    """Rates of two angles and of their momenta p1 and p2: rows, and rates that must hold."""
    put = dict(zip((p1, p2), momenta(true)[0], strict=True))
    turn1, turn2 = momenta(true)[1]
    rates = [(w1 - first).subs(put), (w2 - second).subs(put)]
    return true, [turn1 - third.subs(put), turn2 - fourth.subs(put)], rates


def two_bobs_momenta(last):
    a = m1 + m2 * S**2
    first = (l2 * p1 - l1 * p2 * C) / (l1**2 * l2 * a)
    second = (l1 * both * p2 - l2 * m2 * p1 * C) / (l1 * l2**2 * m2 * a)
    mixed = p1 * p2 * S / (l1 * l2 * a)
    third = -both * g * l1 * s1 - mixed + last
    return by_momenta(BOBS, first, second, third, -m2 * g * l2 * s2 + mixed - last)


def squared_outside():
    a = m1 + m2 * S**2
    above = (l2**2 * m2 * p1**2 + l1**2 * both * p2**2 - l1 * l2 * m2 * p1 * p2 * C) * sin(2 * d)
    return two_bobs_momenta(above / (2 * l1**2 * l2**2) * a * a)


def lost_two():
    a = m1 + m2 * S**2
    above = l2**2 * m2 * p1**2 + l1**2 * both * p2**2 - l1 * l2 * m2 * p1 * p2 * C
    return two_bobs_momenta(above / (2 * l1**2 * l2**2 * a * a) * sin(2 * d))


def four_handles():
    """Rods of the length l and the mass 1 / l²."""
    true = rods((l, 1 / l**2), (l, 1 / l**2))
    first = 6 * (2 * p1 - 3 * C * p2) / (16 - 9 * C**2)
    second = 6 * (8 * p2 - 3 * C * p1) / (16 - 9 * C**2)
    third = -half * (first * second * S + 3 * g / l * s1)
    fourth = -half * (-first * second * S + g / l * s2)
    return by_momenta(true, first, second, third, fourth)


def torch_slices():
    moving = half * m1 * (l1 * w1) ** 2 + half * m2 * ((l1 * w1) ** 2 + (l2 * w2) ** 2 + 2 * l1 * l2 * w1 * w2 * C)
    upper = -l1 * c1
    return BOBS, lagrange(moving - m1 * g * upper - m2 * g * (upper - l2 * c2), BOBS)


def subscripts():
    across, along = l1 * w1 * c1, l1 * w1 * s1
    moving = half * m1 * (across**2 + along**2)
    moving += half * m2 * ((across + l2 * w2 * c2) ** 2 + (along + l2 * w2 * s2) ** 2)
    return BOBS, lagrange(moving + g * m1 * l1 * c1 + g * m2 * (l1 * c1 + l2 * c2), BOBS)


def unpacked_hamiltonian():
    above = both * l1**2 * p2**2 / 2 + m2 * l2**2 * p1**2 / 2 - m2 * l1 * l2 * p1 * p2 * C
    energy = above / (m2 * l1**2 * l2**2 * (m1 + m2 * S**2)) - g * both * l1 * c1 - g * m2 * l2 * c2
    parts = [sp.diff(energy, p1), sp.diff(energy, p2), -sp.diff(energy, th1), -sp.diff(energy, th2)]
    return by_momenta(BOBS, *parts)


# Arms and legs


def centre_twice():
    true = links(False, relative=True, horizontal=True, forces={th2: u})
    cross = m2 * (lc2**2 + l1 * lc2 * c2) + I2
    mass = [
        [m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * lc1 * lc2 * c2) + I1 + I2, cross],
        [cross, m2 * lc2**2 + I2],
    ]
    h = m2 * l1 * lc2 * s2
    turn = [-h * w2**2 - 2 * h * w2 * w1, h * w1**2]
    weight = [(m1 * lc1 + m2 * l1) * g * c1 + m2 * lc2 * g * c12, m2 * lc2 * g * c12]
    return true, added(column(mass, [a1, a2]), turn, weight, [0, -u])


def hanging_arm(weight, forces):
    """Inertias about the pivots."""
    true = links(True, relative=True, forces=forces)
    h = m2 * l1 * lc2
    mass = [[I1 + I2 + m2 * l1**2 + 2 * h * c2, I2 + h * c2], [I2 + h * c2, I2]]
    turn = [[-2 * h * s2 * w2, -h * s2 * w2], [h * s2 * w1, 0]]
    pushed = [-forces.get(th1, 0), -forces.get(th2, 0)]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight, pushed)


def whole_length():
    """The centres are in the middle: lc1 and lc2 are half of l1 and l2."""
    weight = [(m1 * lc1 + m2 * l1) * g * s1 + m2 * g * 2 * lc2 * s12, m2 * g * 2 * lc2 * s12]
    true, rows = hanging_arm(weight, {th1: u})
    return true, rows, {l1: 2 * lc1, l2: 2 * lc2}


def handles():
    weight = [m1 * g * lc1 * s1 + m2 * g * (l1 * s1 + lc2 * s12), m2 * g * lc2 * s12]
    return hanging_arm(weight, {th2: u})


def underscored():
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    cross = m2 * (l1 * l2 * c2 + l2**2)
    mass = [[m1 * l1**2 + m2 * (l1**2 + 2 * l1 * l2 * c2 + l2**2), cross], [cross, m2 * l2**2]]
    turn = [-m2 * l1 * l2 * s2 * (2 * w1 * w2 + w2 * w2), m2 * l1 * l2 * w1 * w1 * s2]
    weight = [both * l1 * g * c1 + m2 * g * l2 * c12, m2 * g * l2 * c12]
    return true, added(column(mass, [a1, a2]), turn, weight, [-tau1, -tau2])


def payload():
    """The load m3, I3 is fixed to the end of the second link."""
    end = l1 * c1 + l2 * c12, l1 * s1 + l2 * s12
    second = l1 * c1 + l2 / 2 * c12, l1 * s1 + l2 / 2 * s12
    bodies = [
        Body(m1, l1 / 2 * c1, l1 / 2 * s1, m1 * l1**2 / 12, th1),
        Body(m2, *second, m2 * l2**2 / 12, th1 + th2),
        Body(m3, *end, I3, th1 + th2),
    ]
    true = Mechanism([ONE, TWO], bodies, 0, {th1: tau1 - b1 * w1, th2: tau2 - b2 * w2})
    third = Rational(1, 3)
    own = third * (m2 + 3 * m3) * l2**2 + I3
    cross = half * (m2 + 2 * m3) * l1 * l2 * c2 + own
    mass = [[third * (m1 + 3 * (m2 + m3)) * l1**2 + (m2 + 2 * m3) * l1 * l2 * c2 + own, cross], [cross, own]]
    h = (m2 + 2 * m3) * l1 * l2 * s2
    turn = [[-h * w2, -h / 2 * w2], [h / 2 * w1, 0]]
    weight = [
        half * ((m1 + 2 * m2 + 2 * m3) * l1 * c1 + (m2 + 2 * m3) * l2 * c12) * g,
        half * (m2 + 2 * m3) * l2 * c12 * g,
    ]
    rubbed = [b1 * w1 - tau1, b2 * w2 - tau2]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight, rubbed)


def compass():
    """share: of a leg's length, from the hip to its centre; the swing leg hangs from the hip."""
    place = (-(1 - share) * l * s1, (1 - share) * l * c1)
    top = (-l * s1, l * c1)
    swing = (top[0] + share * l * s2, top[1] - share * l * c2)
    true = Mechanism([ONE, TWO], [Body(m, *place, I, th1), Body(hip, *top), Body(m, *swing, I, th2)])
    alpha = m / hip
    part, turned = share * alpha, I / hip / l**2
    first, second = (share - 2 + 2 / share) * part + turned + 1, share * part + turned
    mass = [[first, -part * C], [-part * C, second]]
    turn = [[0, -part * S * w2], [part * S * w1, 0]]
    weight = [-(2 * alpha - part + 1) * s1 * g / l, part * s2 * g / l]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight)


# The rest


def struct_p():
    return elastic(half * k * (r - r0) ** 2), [
        rdd - (g * m * c - k * r + k * r0 + m * r * w**2) / m,
        al + (g * s + 2 * rd * w) / r,
    ]


def simulator():
    """The wheel's angle is counted in space; its torque acts back on the pole."""
    bodies = [Body(m, l * s, l * c, I1, th), Body(0, l * s, l * c, I2, ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {th: -tau, ph: tau})
    return true, [al - (m * g * l * s - tau) / (I1 + m * l**2), phdd - tau / I2]


def keyword_closure():
    """Of bx cos(wx t + px) the acceleration is A = -bx wx² cos(wx t + px); of the height it is B."""
    place = Body(m, X + l * s, Y - l * c)
    true = Mechanism([ANGLE], [place], 0, {}, False, {X: V, V: A, Y: U, U: B})
    return true, [al - (-A / l * c - (g + B) * s / l)]


PROOFS = POLES | {
    "dp-casadi-torques": casadi_torques(),
    "dp-julia-squares-in-place": squares_in_place(),
    "dp-javascript-destructured": one_denominator(),
    "dp-julia-nested-structs": one_denominator(),
    "dp-c-macros": one_denominator(),
    "dp-rust-upper-weight": upper_weight(),
    "dp-processing-ratio": ratio(),
    "dp-cpp-squared-outside": squared_outside(),
    "dp-fortran90-lost-two": lost_two(),
    "dr-matlab-four-handles": four_handles(),
    "dp-torch-slices": torch_slices(),
    "dp-mathematica-subscripts": subscripts(),
    "dp-julia-unpacked-hamiltonian": unpacked_hamiltonian(),
    "ac-matlab-centre-twice": centre_twice(),
    "pb-matlab-whole-length": whole_length(),
    "ac-matlab-handles": handles(),
    "arm-python-underscored": underscored(),
    "arm-python-payload": payload(),
    "leg-matlab-compass": compass(),
    "el-matlab-struct-p": struct_p(),
    "rw-python-simulator": simulator(),
    "mv-julia-keyword-closure": keyword_closure(),
}


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
