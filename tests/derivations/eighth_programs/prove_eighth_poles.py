"""What this folder's programs of poles on a cart compute, entered by hand from their text, and what each describes.

The letters here are the mechanisms' own. A program that solves with a matrix has its rows before that.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
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
    k,
    l,
    l1,
    l2,
    m,
    m1,
    m2,
    rods,
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
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
J = sp.Symbol("J")


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# A cart and a pole


def modelica_gantry():
    true = cart_pole(forces={x: F - b1 * xd, th: -b2 * w})
    one = l * (b1 * xd - m * (g * s * c + l * s * w**2) - F) - b2 * c * w
    two = b2 * w * (m + M) + m**2 * l**2 * s * c * w**2 + m * l * (g * s * (m + M) + c * (F - b1 * xd))
    return true, [xdd - one / (-l * (M + m * s**2)), al - two / (m * l**2 * (-M - m * s**2))]


def mutating():
    true = cart_pole(forces={x: F})
    mass = [[M + m, m * l * c], [m * l * c, m * l**2]]
    return true, added(column(mass, [xdd, al]), [-m * l * s * w**2 - F, g * m * l * s])


def plain_cosine():
    true = cart_pole(J, up=True, forces={x: F})
    a, square = J + m * l**2, (m * l) ** 2
    below = (m + M) * a - square * c
    push = F + m * l * w**2 * s
    return true, [
        xdd - (a * push - square * g * s * c) / below,
        al - ((m + M) * m * g * l * s - m * l * c * push) / below,
    ]


def spring_cart():
    true = cart_pole(potential=half * k * x**2)
    below = M + m - m * c**2
    return true, [
        xdd - (m * l * w * s - k * x + m * g * s * c) / below,
        al - (-m * l * w**2 * s * c + k * x * c - (M + m) * g * s) / (l * below),
    ]


def p5_constants():
    true = cart_pole(up=True, left=True, forces={x: F})
    first = m / (m + M)
    third = first / m
    det, squares = 1 - first * c * c, first * w * w * s
    return true, [
        xdd - (first * g * s * c - l * squares + third * F) / det,
        al - (g / l * s - squares * c + third / l * F * c) / det,
    ]


def common():
    true = cart_pole(I, forces={x: F - b1 * xd, th: u - b2 * w})
    near, own = m * l * c, m * l**2 + I
    factor = 1 / ((M + m) * own - near**2)
    row1 = -F + w * (-m * l * w * s) + xd * b1
    row2 = m * g * l * s - u + w * b2
    return true, [xdd - (near * row2 - own * row1) * factor, al - (near * row1 - (M + m) * row2) * factor]


def sum_for_product():
    """l is half the rod's length."""
    true = cart_pole(m * l**2 / 3, up=True, forces={x: F})
    total = M + m
    product = total + m
    temp = (F + product * w * w * s) / total
    turn = (g * s - c * temp) / (l * (Rational(4, 3) - total * c * c / total))
    return true, [al - turn, xdd - (temp - product * turn * c / total)]


def rate_not_squared():
    true = cart_pole(up=True, left=True, forces={x: F})
    below = M + m * s**2
    return true, [
        xdd - (F + m * c * s * g - m * l * s * w) / below,
        al - (c * F / l + (M + m) * g * s / l - m * c * s * w**2) / below,
    ]


def generator():
    true = cart_pole(forces={x: F})
    below = M + m * s**2
    return true, [
        xdd - (F + m * s * (l * w**2 + g * c)) / below,
        al + (F * c + m * l * w**2 * c * s + (M + m) * g * s) / (l * below),
    ]


def eigen_solve():
    true = cart_pole(forces={x: F})
    mass, turn = [[M + m, m * l * c], [m * l * c, m * l**2]], [[0, -m * l * w * s], [0, 0]]
    return true, added(column(mass, [xdd, al]), column(turn, [xd, w]), [-F, m * g * l * s])


def cosine_below():
    true = cart_pole(up=True, left=True, forces={x: F})
    first, second = M + m * c**2, l * (M + m * s**2)
    return true, [
        xdd - (-m * l * w**2 * s + m * g * s * c) / first - F / first,
        al - (-m * l * w**2 * s * c + (M + m) * g * s) / second - c / second * F,
    ]


# Two poles on a cart


def half_weight():
    true = rods((l1, m1), (l2, m2), cart=M, up=True, forces={x: F})
    near, far, cross = (half * m1 + m2) * l1, half * m2 * l2, half * m2 * l1 * l2
    third = Rational(1, 3)
    mass = [
        [M + m1 + m2, near * c1, far * c2],
        [near * c1, (third * m1 + m2) * l1**2, cross * C],
        [far * c2, cross * C, third * m2 * l2**2],
    ]
    turn = [[0, -near * s1 * w1, -far * s2 * w2], [0, 0, cross * S * w2], [0, -cross * S * w1, 0]]
    weight = [0, -half * (m1 + m2) * l1 * g * s1, -half * m2 * l2 * g * s2]
    return true, added(column(mass, [xdd, a1, a2]), column(turn, [xd, w1, w2]), weight, [-F, 0, 0])


def rates_first():
    """Rods to the left for positive angles; m1 and m2 here are the rods' masses, the program's m2 and m3."""
    bodies = [
        Body(M, x, 0),
        Body(m1, x - l1 / 2 * s1, l1 / 2 * c1, m1 * l1**2 / 12, th1),
        Body(m2, x - l1 * s1 - l2 / 2 * s2, l1 * c1 + l2 / 2 * c2, m2 * l2**2 / 12, th2),
    ]
    coordinates = rods((l1, m1), (l2, m2), cart=M).coordinates
    true = Mechanism(coordinates, bodies, 0, {x: F - b * xd})
    left = [
        [2 * (M + m1 + m2), -(m1 + 2 * m2) * l1 * c1, -m2 * l2 * c2],
        [-(3 * m1 + 6 * m2) * c1, (2 * m1 + 6 * m2) * l1, 3 * m2 * l2 * C],
        [-3 * c2, 3 * l1 * C, 2 * l2],
    ]
    right = [
        2 * F - 2 * b * xd - (m1 + 2 * m2) * l1 * w1**2 * s1 - m2 * l2 * w2**2 * s2,
        (3 * m1 + 6 * m2) * g * s1 - 3 * m2 * l2 * w2**2 * S,
        3 * l1 * w1**2 * S + 3 * g * s2,
    ]
    return true, added(column(left, [xdd, a1, a2]), [-part for part in right])


PROOFS = {
    "cp-modelica-gantry": modelica_gantry(),
    "cp-julia-mutating": mutating(),
    "cp-matlab-casadi-plain-cosine": plain_cosine(),
    "cp-python-spring-cart": spring_cart(),
    "cp-p5js-constants": p5_constants(),
    "cp-javascript-common": common(),
    "cp-c-sum-for-product": sum_for_product(),
    "cp-python-rate-not-squared": rate_not_squared(),
    "cp-sympy-generator": generator(),
    "cp-cpp-eigen-solve": eigen_solve(),
    "cp-matlab-cosine-below": cosine_below(),
    "dc-python-french-half-weight": half_weight(),
    "dc-matlab-rates-first": rates_first(),
}
