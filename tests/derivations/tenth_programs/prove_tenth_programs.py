"""What this folder's programs of two and three pendulums compute, entered by hand from their text, and what each is of.

The letters here are the mechanisms' own. Run as a script, it compares each verdict of index.toml with what follows from
positions alone.
"""

from pathlib import Path

from mechanisms import a1, a2, a3, b1, b2, bobs, g, l, l1, l2, l3, m, m1, m2, m3, th1, th2, th3, w1, w2, w3
from prove_tenth_machines import PROOFS as MACHINES
from sympy import Rational, cos, sin
from verdicts import print_verdicts

half = Rational(1, 2)
BOBS = bobs((l1, m1), (l2, m2))
EQUAL = bobs((l, m), (l, m))
THREE = bobs((l1, m1), (l2, m2), (l3, m3))
d = th1 - th2
S, C = sin(d), cos(d)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
both = m1 + m2
TWICE = 2 * m1 + m2 - m2 * cos(2 * d)


def over(one, two, first=l1 * TWICE, second=l2 * TWICE, true=BOBS):
    return true, [a1 - one / first, a2 - two / second]


def above(sine=S):
    """The numerators over l1 (2 m1 + m2 - m2 cos 2d) and over l2 (…), and the sine that stands in front."""
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * sine * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    return one, 2 * sine * (w1**2 * l1 * both + g * both * c1 + w2**2 * l2 * m2 * C)


def denominators():
    """The programs' delta is -d."""
    den = both * l1 - m2 * l1 * C**2
    one = -m2 * l1 * w1**2 * S * C + m2 * g * s2 * C - m2 * l2 * w2**2 * S - both * g * s1
    two = m2 * l2 * w2**2 * S * C + both * (g * s1 * C + l1 * w1**2 * S - g * s2)
    return over(one, two, den, l2 / l1 * den)


def equal_lengths():
    """The masses and the lengths have one value each."""
    one = -g / l * (2 * s1 - C * s2) - S * (w2**2 + C * w1**2)
    two = -g / l * (s2 - 2 * C * s1) + S * (w1**2 + C * w2**2)
    return over(one, two, 2 - C**2, 2 - C**2, EQUAL)


def closure():
    """The program's delta is -d; its second denominator has l2 twice and l1 below."""
    one, two = above(-S)
    return over(one, two, second=l2 * l2 / l1 * TWICE)


def one_denominator(sine):
    """The numerators over l1 (m1 + m2 sin²d) and over l2 (…), with d's sine as the program has it."""
    den = m1 + m2 * sine**2
    one = m2 * g * s2 * C - m2 * sine * (l1 * w1**2 * C + l2 * w2**2) - both * g * s1
    two = both * (l1 * w1**2 * sine - g * s2 + g * s1 * C) + m2 * l2 * w2**2 * sine * C
    return over(one, two, l1 * den, l2 * den)


def swapped():
    """c is the sine, s the cosine."""
    below = l**2 - S**2
    one = g * s2 * S - 2 * s1 + l * C * w1**2 * S + w2**2
    two = 2 * g * s1 * S - s2 - l * C * w2**2 * S + 2 * w1**2
    return over(one, two, below, below, EQUAL)


def guarded():
    """What is computed where the guard does not act."""
    one, two = above()
    factor = 2 * both - m2 * (1 + cos(2 * d))
    return over(one, two, l1 * factor, l2 * factor)


def small_names():
    first, second = l2 / l1 * m2 / both * C, l1 / l2 * C
    f1 = -l2 / l1 * m2 / both * w2**2 * S - g / l1 * s1
    f2 = l1 / l2 * w1**2 * S - g / l2 * s2
    return over(f1 - first * f2, f2 - second * f1, 1 - first * second, 1 - first * second)


def damped_joints():
    return bobs((l1, m1), (l2, m2), forces={th1: -b1 * w1 + b2 * (w2 - w1), th2: -b2 * (w2 - w1)})


def inverse_by_hand():
    """s is -sin d; the rows before the matrix is inverted."""
    true = damped_joints()
    return true, [
        both * l1**2 * a1
        + m2 * l1 * l2 * C * a2
        + m2 * l1 * l2 * w2**2 * S
        + both * l1 * g * s1
        + b1 * w1
        - b2 * (w2 - w1),
        m2 * l1 * l2 * C * a1 + m2 * l2**2 * a2 - m2 * l1 * l2 * w1**2 * S + m2 * l2 * g * s2 + b2 * (w2 - w1),
    ]


def julia_damped():
    """Δθ is -d."""
    one = -m2 * l2 * w2**2 * S * C + m2 * g * s2 * C - m2 * l2 * w2**2 * S - both * g * s1 - b1 * w1
    two = -both * l1 * w1**2 * S * C - both * g * s2 + both * g * s1 * C - m2 * l2 * w2**2 * S - b2 * w2
    den = both - m2 * C**2
    return over(one, two, den * l1, den * l2, damped_joints())


def lost_bracket():
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * w2**2 * l2 + w1**2 * l1 * C
    return over(one, above()[1])


def named_parts():
    last, total = m2 + m3, m1 + m2 + m3
    s01, s02, s12 = S, sin(th1 - th3), sin(th2 - th3)
    c01, c02, c12 = C, cos(th1 - th3), cos(th2 - th3)
    r1, r2, r3 = last * c01 * c02 - total * c12, total - last * c01**2, -total + m3 * c02**2
    part = r1 * c01 + r2 * c02
    third = -g * sin(th3) + l1 * s02 * w1**2 + l2 * s12 * w2**2
    fourth = -g * last * s2 + l1 * last * s01 * w1**2 - l3 * m3 * s12 * w3**2
    fifth = -m3 * last * (-c02 + cos(th1 - 2 * th2 + th3)) ** 2 * total
    sixth = g * total * s1 + l2 * last * s01 * w2**2 + l3 * m3 * s02 * w3**2
    below = m3 * r1**2 + last * r3 * r2
    one = 4 * m3 * last * part * third * r2 - 4 * (-m3 * part * r1 + below * c01) * fourth
    one -= (fifth + 4 * m3 * r1**2 + 4 * last * r3 * r2) * sixth
    two = -m3 * r1 * total * third * r2 - (m3 * part * r1 - below * c01) * sixth + total * r3 * r2 * fourth
    three = last * part * sixth + last * total * third * r2 + r1 * total * fourth
    return THREE, [
        a1 - total / 4 * one / (l1 * below * total * r2),
        a2 - two / (l2 * below * r2),
        a3 + three / (l3 * below),
    ]


def rates_for_accelerations():
    ones = {m1: 1, m2: 1, m3: 1, l1: 1, l2: 1, l3: 1, g: 1}
    s12, c12, s13, c13 = S, C, sin(th1 - th3), cos(th1 - th3)
    s23, c23 = sin(th2 - th3), cos(th2 - th3)
    third = Rational(1, 3)
    one = -third * s1 - 2 * third * (w2 * c12 + w2**2 * s12) - third * (w3 * c13 + w3**2 * s13)
    two = -s2 - w1 * c12 + w1**2 * s12 - half * (w3 * c23 + w3**2 * s23)
    three = -sin(th3) - w1 * c13 + w1**2 * s13 - w2 * c23 + w2**2 * s23
    return THREE, [a1 - one, a2 - two, a3 - three], ones


PROOFS = MACHINES | {
    "dp-python-denominators": denominators(),
    "dp-python-equal-lengths": equal_lengths(),
    "dp-python-closure": closure(),
    "dp-python-host-parameters": one_denominator(S),
    "dp-python-factored": denominators(),
    "dp-python-names-swapped": swapped(),
    "dp-python-guarded": guarded(),
    "dp-jax-small-names": small_names(),
    "dp-matlab-array-of-structs": one_denominator(-S),
    "dp-matlab-ode45": over(*above()),
    "dp-matlab-continued-lines": denominators(),
    "dp-matlab-inverse-by-hand": inverse_by_hand(),
    "dp-julia-subscripts": over(*above()),
    "dp-julia-polish": over(*above()),
    "dp-julia-damped": julia_damped(),
    "dp-javascript-refs": over(*above()),
    "dp-javascript-lost-bracket": lost_bracket(),
    "dp-cpp-references": over(*above()),
    "tp-python-named-parts": named_parts(),
    "tp-python-rates-for-accelerations": rates_for_accelerations(),
}


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
