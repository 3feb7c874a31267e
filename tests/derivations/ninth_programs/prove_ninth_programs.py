"""What this folder's programs of two and three pendulums compute, entered by hand from their text, and what each is of.

The letters here are the mechanisms' own. A program that inverts a matrix, or solves with one, has its rows before that.
Run as a script, it compares each verdict of index.toml with what follows from positions alone.
"""

from pathlib import Path

import sympy as sp
from mechanisms import (  # fmt: skip
    a1,
    a2,
    a3,
    b,
    b1,
    b2,
    bobs,
    g,
    l,
    l1,
    l2,
    l3,
    m,
    m1,
    m2,
    m3,
    rods,
    tau,
    th1,
    th2,
    th3,
    w1,
    w2,
    w3,
)
from prove_ninth_machines import PROOFS as MACHINES
from prove_ninth_machines import added, column
from sympy import Rational, cos, sin
from truth import lagrange, momenta
from verdicts import print_verdicts

half = Rational(1, 2)
BOBS = bobs((l1, m1), (l2, m2))
EQUAL = bobs((l, m), (l, m))
d = th1 - th2
S, C = sin(d), cos(d)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
both = m1 + m2
twice = 2 * m1 + m2
TWICE = twice - m2 * cos(2 * d)
p1, p2, ratio = sp.symbols("p1 p2 ratio")


def above():
    """The numerators over l1 (2 m1 + m2 - m2 cos 2d) and over l2 (…), as myphysicslab has them."""
    one = -g * twice * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    return one, 2 * S * (w1**2 * l1 * both + g * both * c1 + w2**2 * l2 * m2 * C)


def over(one, two, true=BOBS, first=l1 * TWICE, second=l2 * TWICE):
    return true, [a1 - one / first, a2 - two / second]


def commented_out():
    below = both - m2 * C**2
    one = g * m2 * s2 * C - g * both * s1 - (w2**2 * l2 * m2 + w1**2 * l1 * m2 * C) * S
    two = g * both * s1 * C - g * both * s2 + (w1**2 * l1 * both + w2**2 * l2 * m2 * C) * S
    return over(one, two, first=l1 * below, second=l2 * below)


def generated():
    """The program's delta is -d."""
    below = both * l1 - m2 * l1 * C**2
    one = (-m2 * g * s2 * C - m2 * l2 * w2**2 * S * C + both * g * s1) / below
    two = (l1 / l2 * one * C - g * s2 + l1 / below * w1**2 * S) / (1 - m2 / both * C**2)
    return BOBS, [a1 - one, a2 - two]


def damped_accelerations():
    true = bobs((l1, m1), (l2, m2), forces={th1: tau - b * w1 + b * (w2 - w1), th2: -b * (w2 - w1)})
    one, two = above()
    return true, [a1 - (one / (l1 * TWICE) - b * w1 + tau), a2 - (two / (l2 * TWICE) - b * (w2 - w1))]


def one_tuple():
    below = twice - m2 * cos(2 * th1 - th2)
    one, two = above()
    one += g * twice * s1 - g * (2 * m2 + m1) * s1
    return over(one, two, first=l1 * below, second=l2 * below)


def length_over_itself():
    """The program's delta is -d."""
    den = both * l1 - m2 * l1 * C**2
    one = -m2 * l1 * w1**2 * S * C + m2 * g * s2 * C - m2 * l2 * w2**2 * S - both * g * s1
    two = -m2 * l1 * w2**2 * S * C + both * (g * s1 * C + l1 * w1**2 * S - g * s2)
    return over(one, two, first=den, second=den)


def starred():
    one, two = l2 / l1 * m2 / both * C, l1 / l2 * C
    f1 = -l2 / l1 * m2 / both * w2**2 * S - g / l1 * s1
    f2 = l1 / l2 * w1**2 * S - g / l2 * s2
    return over(f1 - one * f2, f2 - two * f1, first=1 - one * two, second=1 - one * two)


def lambda_tuple():
    true = bobs((l1, m1), (l2, m2), forces={th1: -b * w1 + b * (w2 - w1), th2: -b * (w2 - w1)})
    one, two = above()
    return over(one - b * w1, two - b * w2, true)


def compound_product():
    one = -g * 2 * m1 * m2 * s1 - g * m2 * sin(th1 - 2 * th2) - 2 * w2**2 * l2 * m2 * S
    one -= w1**2 * l1 * m2 * sin(2 * d)
    return over(one, above()[1])


def sample_time():
    """The masses are 1."""
    below = l * (3 - cos(2 * d))
    one = -3 * g * s1 - g * sin(th1 - 2 * th2) - 2 * S * l * (w2**2 + w1**2 * C)
    two = 2 * S * (2 * w1**2 * l + 2 * g * c1 + w2**2 * l * C)
    return over(one, two, bobs((l, 1), (l, 1)), below, below)


def product():
    return over(*above(), first=l1 * (2 * m1 * m2 - m2 * cos(2 * d)))


def third_twice():
    one = -g * twice * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l1 + w1**2 * l1 * C)
    return over(one, 2 * S * (2 * g * both * c1 + w2**2 * l2 * m2 * C))


def inner_class():
    """From above; the program's G is -g."""
    one, two = m2 * l2 / (both * l1) * C, l1 / l2 * C
    third = -m2 * l2 / (both * l1) * w2**2 * S + g * s1 / l1
    fourth = (l1 * w1**2 * S + g * s2) / l2
    true = bobs((l1, m1), (l2, m2), up=True)
    return over(third - one * fourth, fourth - two * third, true, 1 - one * two, 1 - one * two)


def records():
    share, part = l1 / l2, 1 + m1 / m2
    below = part - C**2
    one = g / l1 * (s2 * C - part * s1) - (w2**2 / share + w1**2 * C) * S
    two = g * part / l2 * (s1 * C - s2) + (part * share * w1**2 + w2**2 * C) * S
    return over(one, two, first=below, second=below)


def tuple_state():
    below = both - m2 * C**2
    one = -(g * twice * s1 + m2 * (g * sin(th1 - 2 * th2) + 2 * (l2 * w2**2 + l1 * w1**2 * C) * S))
    two = (both * (l1 * w1**2 + g * c1) + l2 * m2 * w2**2 * C) * S
    return over(one, two, first=2 * l1 * below, second=l2 * below)


def cramer(rate):
    """a to f; rate: what stands for the square of the second rate."""
    a, f1, f2, e = both * l1, m2 * l2 * C, m2 * l1 * C, m2 * l2
    five = -m2 * l2 * rate * S - g * both * s1
    six = m2 * l1 * w1**2 * S - m2 * g * s2
    below = a * e - f2 * f1
    return over(five * e - f1 * six, a * six - f2 * five, first=below, second=below)


def residual():
    mass = [[l1**2 * both, m1 * l1 * l2 * C], [l1 * C, l2]]
    rest = [m2 * l1 * l2 * w2**2 * S + g * l1 * both * s1, -l1 * w1**2 * S + g * s2]
    return BOBS, added(column(mass, [a1, a2]), rest)


def solver_output():
    true = rods((l1, m1), (l2, m2), forces={th1: tau - b1 * w1 + b2 * (w2 - w1), th2: -b2 * (w2 - w1)})
    below = 8 * m1 + 15 * m2 - 9 * m2 * cos(2 * d)
    one = 4 * b1 * w1 * l2 - 4 * tau * l2 + 6 * b2 * w1 * l1 * C - 6 * b2 * w2 * l1 * C
    one += 3 * g * l1 * l2 * m2 * sin(th1 - 2 * th2) / 2 + 3 * w1**2 * l1**2 * l2 * m2 * sin(2 * d) / 2
    one += 2 * w2**2 * l1 * l2**2 * m2 * S + 2 * g * l1 * l2 * m1 * s1 + 5 * g * l1 * l2 * m2 * s1 / 2
    two = 4 * b2 * w1 * l1 * m1 - 6 * tau * l2 * m2 * C + 12 * b2 * w1 * l1 * m2 - 4 * b2 * w2 * l1 * m1
    two += -12 * b2 * w2 * l1 * m2 + 6 * w1**2 * l1**2 * l2 * m2**2 * S - 3 * g * l1 * l2 * m2**2 * s2
    two += 3 * w2**2 * l1 * l2**2 * m2**2 * sin(2 * d) / 2 + 3 * g * l1 * l2 * m2**2 * sin(2 * th1 - th2)
    two += 6 * b1 * w1 * l2 * m2 * C + 2 * w1**2 * l1**2 * l2 * m1 * m2 * S - g * l1 * l2 * m1 * m2 * s2 / 2
    two += 3 * g * l1 * l2 * m1 * m2 * sin(2 * th1 - th2) / 2
    return over(-6 * one, 6 * two, true, l1**2 * l2 * below, l1 * l2**2 * m2 * below)


def returned_object():
    below = m1 + m2 * S * S
    one = m2 * S * C * l1 * w1 * w1 + m2 * S * l2 * w2 * w2 + (both * s1 - m2 * s2 * C) * g
    two = both * S * l1 * w1 * w1 + m2 * S * C * l2 * w2 * w2 + both * S * c1 * g
    return over(one, two, first=-below * l1, second=below * l2)


def sine_reversed():
    one = -g * twice * s1 - m2 * g * sin(th1 - 2 * th2) + 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    return over(one, -2 * S * (w1**2 * l1 * both + g * both * c1 + w2**2 * l2 * m2 * C))


def mixed_denominators():
    """The program's delta is -d."""
    one = m2 * g * s2 * C + m2 * S * (l1 * w1**2 * C + l2 * w2**2) - both * g * s1
    two = both * (-l1 * w1**2 * S - g * s2 + g * s1 * C) - m2 * l2 * w2**2 * S * C
    return over(one, two, second=l2 * l2 / l1 * TWICE)


def matrix_solve():
    """Masses and rods are 1."""
    true = bobs((1, 1), (1, 1))
    right = [-S * w2 * w2 - g * 2 * s1, S * w1 * w1 - g * s2]
    return true, added(column([[2, C], [C, 1]], [a1, a2]), [-part for part in right])


def module_functions():
    below = l * (2 - C**2)
    one = g * (C * s2 - 2 * s1) - S * l * (w2**2 + C * w1**2)
    two = 2 * g * (C * s1 - s2) + S * l * (2 * w1**2 + C * w2**2)
    return over(one, two, EQUAL, below, below)


def component_of_speed():
    moving = half * m * ((l * w1) ** 2 + (l * (w1 + C * w2)) ** 2)
    height = l * (1 - c1)
    return EQUAL, lagrange(moving - m * g * (height + height - l * c2), EQUAL)


def unstack():
    moving = half * both * l1**2 * w1**2 + half * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * C
    return BOBS, lagrange(moving - both * g * l1 * (1 - c1) - m2 * g * l2 * (1 - c2), BOBS)


def emmy():
    height = -l1 * c1
    moving = half * m1 * l1**2 * w1**2 + half * m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * C)
    return BOBS, lagrange(moving - m1 * g * height - m2 * g * (height - l2 * c2), BOBS)


def cosine_cubed():
    """The program's delta is -d."""
    true = bobs((l1, m1), (l2, m2), forces={th1: tau - b1 * w1 + b2 * (w2 - w1), th2: -b2 * (w2 - w1)})
    den = both * l1 - m2 * l1 * C**3
    one = -m2 * l1 * w1**2 * S * C + m2 * g * s2 * C - m2 * l2 * w2**2 * S - both * g * s1 + tau - b1 * w1
    two = m2 * l2 * w2**2 * S * C + both * g * s2 * C + both * l2 * w2**2 * S - both * g * s1 - b2 * w2
    return over(one, two, true, den, l2 / l1 * den)


# Momenta


def by_momenta(true, first, second, third, fourth):
    """Rates of two angles and of their momenta p1 and p2: rows, and rates that must hold."""
    put = dict(zip((p1, p2), momenta(true)[0], strict=True))
    turn1, turn2 = momenta(true)[1]
    rates = [(w1 - first).subs(put), (w2 - second).subs(put)]
    return true, [turn1 - third.subs(put), turn2 - fourth.subs(put)], rates


def portuguese():
    mixed = p1 * p2 * S / (m1 * l1 * l2)
    first = p1 / (m1 * l1**2) - p2 * C / (m1 * l1 * l2)
    second = p2 / (m2 * l2**2) - p1 * C / (m1 * l1 * l2)
    return by_momenta(BOBS, first, second, -m1 * g * l1 * s1 - mixed, -m2 * g * l2 * s2 + mixed)


def ratio_lost():
    true = bobs((l, m1), (l, m1 * ratio))
    below = m1 * l**2 * (1 + ratio * S**2)
    one = p1 * p2 * S / below
    two = (p1**2 * ratio - 2 * p1 * p2 * ratio * C + p2**2 * (1 + ratio)) * sin(2 * d)
    two = two / (2 * m1 * l**2 * (1 + ratio * S**2) ** 2)
    first, second = (p1 - p2 * C) / below, (p2 * (1 + ratio) - p1 * ratio * C) / below
    third = -m1 * (1 + ratio) * g * l * s1 - one + two
    return by_momenta(true, first, second, third, -m1 * ratio * g * l * s2 + one - two)


def brackets():
    a = m1 + m2 * S * S
    first = (l2 * p1 - l1 * p2 * C) / (l1 * l1 * l2 * a)
    second = (both * l1 * p2 - m2 * l1 * p1 * C) / (m2 * l1 * l2 * l2 * a)
    mixed = p1 * p2 * S / (l1 * l2 * a)
    squares = m2 * l2 * l2 * p1 * p1 + both * l1 * l1 * p2 * p2 - 2 * m2 * l1 * l2 * p1 * p2 * C
    squares = squares / (2 * l1 * l1 * l2 * l2 * a)
    return by_momenta(
        BOBS,
        first,
        second,
        squares * sin(2 * d) - mixed - both * g * l1 * s1,
        mixed - squares * sin(2 * d),  # the weight is inside the sine: left out, the rates are wrong already
    )


def feenox():
    energy = -(m1 * g * l1 * c1 + m2 * g * (l1 * c1 + l2 * c2))
    squares = l2**2 * m2 * p1**2 - 2 * l1 * l2 * m2 * C * p1 * p2 + l1**2 * both * p2**2
    energy -= squares / (l1**2 * l2**2 * m2 * (-2 * m1 - m2 + m2 * cos(2 * d)))
    parts = [sp.diff(energy, p1), sp.diff(energy, p2), -sp.diff(energy, th1), -sp.diff(energy, th2)]
    return by_momenta(BOBS, *parts)


# Three pendulums

THREE = bobs((l1, m1), (l2, m2), (l3, m3))


def dataclass():
    last = m2 + m3
    s13, s23, c13, c23 = sin(th1 - th3), sin(th2 - th3), cos(th1 - th3), cos(th2 - th3)
    mass = [
        [(m1 + m2 + m3) * l1**2, last * l1 * l2 * C, m3 * l1 * l3 * c13],
        [last * l1 * l2 * C, last * l2**2, m3 * l2 * l3 * c23],
        [m3 * l1 * l3 * c13, m3 * l2 * l3 * c23, m3 * l3**2],
    ]
    one = g * l1 * (m1 + m2 + m3) * s1 + last * l1 * l2 * S * w1 * w2 + m3 * l1 * l3 * s13 * w1 * w3
    one += -last * l1 * l2 * S * (w1 - w2) * w2 - m3 * l1 * l3 * s13 * (w1 - w3) * w3
    two = g * l2 * last * s2 - last * l1 * l2 * S * w1 * w2 + m3 * l2 * l3 * s23 * w2 * w3
    two += -last * l1 * l2 * S * (w1 - w2) * w1 - m3 * l2 * l3 * s23 * (w2 - w3) * w3
    three = m3 * g * l3 * sin(th3) - m3 * l2 * l3 * s23 * w2 * w3 - m3 * l1 * l3 * s13 * w1 * w3
    three += -m3 * l1 * l3 * s13 * (w1 - w3) * w1 - m3 * l2 * l3 * s23 * (w2 - w3) * w2
    return THREE, added(column(mass, [a1, a2, a3]), [one, two, three])


def polar():
    down, right, energy = sp.Integer(0), sp.Integer(0), sp.Integer(0)
    for mass, length, angle in ((m1, l1, th1), (m2, l2, th2), (m3, l3, th3)):
        down, right = down + length * cos(angle), right + length * sin(angle)
        speeds = [sum(sp.diff(place, q) * v for q, v in ((th1, w1), (th2, w2), (th3, w3))) for place in (down, right)]
        energy += mass / 2 * (speeds[0] ** 2 + speeds[1] ** 2) + mass * g * down
    return THREE, lagrange(energy, THREE)


PROOFS = MACHINES | {
    "dp-python-commented-out": commented_out(),
    "dp-python-generated-odeint": generated(),
    "dp-python-damped-accelerations": damped_accelerations(),
    "dp-python-one-tuple": one_tuple(),
    "dp-python-length-over-itself": length_over_itself(),
    "dp-python-portuguese-momenta": portuguese(),
    "dp-python-starred-call": starred(),
    "dp-cpp-lambda-tuple": lambda_tuple(),
    "dp-cpp-compound-product": compound_product(),
    "dp-cpp-sample-time": sample_time(),
    "dp-processing-product": product(),
    "dp-processing-third-twice": third_twice(),
    "dp-processing-inner-class": inner_class(),
    "dp-javascript-terms": over(*above()),
    "dp-opencl-kernel": over(*above()),
    "dp-dart-nested-function": over(*above()),
    "dp-go-named-results": over(*above()),
    "dp-haskell-records": records(),
    "dp-lua-ratio-lost": ratio_lost(),
    "dp-julia-tuple-state": tuple_state(),
    "dp-julia-toolkit-numerators": over(*above()),
    "dp-matlab-rate-not-squared": cramer(w2),
    "dp-matlab-residual": residual(),
    "dr-matlab-solver-output": solver_output(),
    "dp-typescript-returned-object": returned_object(),
    "dp-r-sine-reversed": sine_reversed(),
    "dp-r-mixed-denominators": mixed_denominators(),
    "dp-r-dollar-letters": cramer(w2**2),
    "dp-swift-brackets": brackets(),
    "dp-rust-matrix-solve": matrix_solve(),
    "dp-fortran-module-functions": module_functions(),
    "dp-sympy-component-of-speed": component_of_speed(),
    "dp-tensorflow-unstack": unstack(),
    "dp-casadi-cosine-cubed": cosine_cubed(),
    "dp-feenox-hamiltonian": feenox(),
    "dp-clojure-emmy": emmy(),
    "tp-python-dataclass": dataclass(),
    "tp-mathematica-polar": polar(),
}


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
