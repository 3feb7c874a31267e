"""What is printed of chains of bobs and rods, entered by hand from the page, and the mechanism that each describes."""

import sympy as sp
from mechanisms import (
    a1,
    a2,
    a3,
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
    th1,
    th2,
    th3,
    w1,
    w2,
    w3,
)  # fmt: skip
from sympy import Rational, cos, sin
from truth import lagrange, momenta

half = Rational(1, 2)
D = th1 - th2
TWO = bobs((l1, m1), (l2, m2))
THREE = bobs((l1, m1), (l2, m2), (l3, m3))
EQUAL = rods((l, m), (l, m))
OWN = rods((l1, m1), (l2, m2))


def damped_at_joints():
    """Each damper turns with the difference of the rates that it joins."""
    return bobs((l1, m1), (l2, m2), forces={th1: -b1 * w1 + b2 * (w2 - w1), th2: -b2 * (w2 - w1)})


def solved_myphysicslab(sign=-1):
    """The solved form of myphysicslab; the sign is that of m2 g sin(θ1 − 2 θ2)."""
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    first = (-g * (2 * m1 + m2) * sin(th1) + sign * m2 * g * sin(th1 - 2 * th2)
             - 2 * sin(D) * m2 * (w2**2 * l2 + w1**2 * l1 * cos(D)))  # fmt: skip
    second = 2 * sin(D) * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * cos(th1) + w2**2 * l2 * m2 * cos(D))
    return [a1 - first / (l1 * below), a2 - second / (l2 * below)]


def unicode_brackets():
    d = th2 - th1
    below = (m1 + m2) * l1 - m2 * l1 * cos(d) ** 2
    first = (m2 * l1 * w1**2 * sin(d) * cos(d) + m2 * g * sin(th2) * cos(d) + m2 * l2 * w2**2 * sin(d)
             - (m1 + m2) * g * sin(th1))  # fmt: skip
    second = -m2 * l2 * w2**2 * sin(d) * cos(d) + (m1 + m2) * (
        g * sin(th1) * cos(d) - l1 * w1**2 * sin(d) - g * sin(th2)
    )
    return [a1 - first / below, a2 - second / (l2 / l1 * below)]


def julia():
    c = cos(D)
    first = g * (2 * m1 + m2) * sin(th1) + m2 * (g * sin(th1 - 2 * th2) + 2 * (l2 * w2**2 + l1 * w1**2 * c) * sin(D))
    second = ((m1 + m2) * (l1 * w1**2 + g * cos(th1)) + l2 * m2 * w2**2 * c) * sin(D)
    return [a1 + first / (2 * l1 * (m1 + m2 - m2 * c**2)), a2 - second / (l2 * (m1 + m2 - m2 * c**2))]


def numpy_form():
    c, s = cos(D), sin(D)
    first = m2 * g * sin(th2) * c - m2 * s * (l1 * w1**2 * c + l2 * w2**2) - (m1 + m2) * g * sin(th1)
    second = (m1 + m2) * (l1 * w1**2 * s - g * sin(th2) + g * sin(th1) * c) + m2 * l2 * w2**2 * s * c
    return [a1 - first / l1 / (m1 + m2 * s**2), a2 - second / l2 / (m1 + m2 * s**2)]


def short_rows(centrifugal=1):
    """The rows divided by a length, in most books."""
    return [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * cos(D) + centrifugal * m2 * l2 * w2**2 * sin(D)
        + g * (m1 + m2) * sin(th1),
        m2 * l2 * a2 + m2 * l1 * a1 * cos(D) - m2 * l1 * w1**2 * sin(D) + m2 * g * sin(th2),
    ]  # fmt: skip


def long_rows():
    """The rows as Lagrange's equations give them."""
    first, second = short_rows()
    return [sp.expand(l1 * first), sp.expand(l2 * second)]


def arsnumerandi():
    d = th2 - th1
    return [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * (-(w2**2) * sin(d) + a2 * cos(d)) + (m1 + m2) * g * l1 * sin(th1),
        m2 * l2 * (l2 * a2 + l1 * w2**2 * sin(d) + l1 * a1 * cos(d) + g * sin(th2)),
    ]


def arsnumerandi_lagrangian():
    return (m1 * l1**2 * w1**2 / 2 + m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * cos(th2 - th1) * w1 * w2) / 2
            + (m1 + m2) * g * l1 * cos(th1) + m2 * l2 * cos(th2))  # fmt: skip


def holooly():
    return ((m1 + m2) / 2 * l1**2 * w1**2 + m2 * l2**2 / 2 * w2**2 + m2 * l1 * l2 * w1 * w2 * cos(D)
            + (m1 + m2) * g * l1 * cos(th1) + m2 * g * l2 * cos(th2))  # fmt: skip


def energies():
    kinetic = half * m1 * l1**2 * w1**2 + half * m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * cos(D))
    return kinetic - (-m1 * g * l1 * cos(th1) - m2 * g * (l1 * cos(th1) + l2 * cos(th2)))


def damped_rows():
    return [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * cos(D) * a2
        + (m2 * l1 * l2 * w2**2 * sin(D) + (m1 + m2) * g * l1 * sin(th1) + b1 * w1),
        m2 * l1 * l2 * cos(D) * a1 + m2 * l2**2 * a2
        + (-m2 * l1 * l2 * w1**2 * sin(D) + m2 * g * l2 * sin(th2) + b2 * w2),
    ]  # fmt: skip


def product_rule():
    s = -sin(D)
    return [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * a2 * cos(D) + m2 * l1 * l2 * w2 * s * (w1 - w2)
        - m2 * l1 * l2 * w2 * w1 * s - g * l1 * (-sin(th1)) * (m1 + m2),
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * cos(D) + m2 * l1 * l2 * w1 * s * (w1 - w2)
        - m2 * l1 * l2 * w1 * w2 * sin(D) + m2 * g * l2 * sin(th2),
    ]  # fmt: skip


def product_rule_lost():
    return [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * (a2 * cos(D) + w2 * (w1 - w2) * sin(D))
        + m2 * l1 * l2 * w1 * w2 * sin(D) + (m1 + m2) * g * l1 * sin(th1),
        long_rows()[1],
    ]  # fmt: skip


def hamiltonian_rows():
    """Hamilton's equations of the printed H, the momenta being those of the mechanism."""
    p1, p2 = sp.symbols("p1 p2")
    h = (m2 * l2**2 * p1**2 + (m1 + m2) * l1**2 * p2**2 - 2 * m2 * l1 * l2 * p1 * p2 * cos(D)) / (
        2 * m2 * l1**2 * l2**2 * (m1 + m2 * sin(D) ** 2)
    ) - (m1 + m2) * g * l1 * cos(th1) - m2 * g * l2 * cos(th2)  # fmt: skip
    (true1, true2), (rate1, rate2) = momenta(TWO)
    put = {p1: true1, p2: true2}
    rates = [w1 - sp.diff(h, p1).subs(put), w2 - sp.diff(h, p2).subs(put)]
    return [rate1 + sp.diff(h, th1).subs(put), rate2 + sp.diff(h, th2).subs(put)], rates


def wiki_hamilton(coefficient):
    (p1, p2), (rate1, rate2) = momenta(EQUAL)
    below = 16 - 9 * cos(D) ** 2
    rates = [
        w1 - 6 / (m * l**2) * (2 * p1 - 3 * cos(D) * p2) / below,
        w2 - 6 / (m * l**2) * (coefficient * p2 - 3 * cos(D) * p1) / below,
    ]
    return [
        rate1 + half * m * l**2 * (w1 * w2 * sin(D) + 3 * g / l * sin(th1)),
        rate2 + half * m * l**2 * (-w1 * w2 * sin(D) + g / l * sin(th2)),
    ], rates


def triple_rows(coupling):
    """Standard rows; coupling is the mass with which links 1 and 2 are coupled."""
    d13, d23 = th1 - th3, th2 - th3
    all_, lower = m1 + m2 + m3, m2 + m3
    return [
        all_ * l1 * a1 + coupling * l2 * (a2 * cos(D) + w2**2 * sin(D)) + m3 * l3 * (a3 * cos(d13) + w3**2 * sin(d13))
        + all_ * g * sin(th1),
        lower * l2 * a2 + coupling * l1 * (a1 * cos(D) - w1**2 * sin(D)) + m3 * l3 * (a3 * cos(d23) + w3**2 * sin(d23))
        + lower * g * sin(th2),
        m3 * l3 * a3 + m3 * l1 * (a1 * cos(d13) - w1**2 * sin(d13)) + m3 * l2 * (a2 * cos(d23) - w2**2 * sin(d23))
        + m3 * g * sin(th3),
    ]  # fmt: skip


def triple_lagrangian():
    def pair(one, two, rate1, rate2):
        return 2 * one[0] * two[0] * cos(one[1] - two[1]) * rate1 * rate2

    A, B, C = (l1, th1), (l2, th2), (l3, th3)
    return (half * l1**2 * m1 * w1**2 + l1 * g * m1 * cos(th1) + g * m2 * (l1 * cos(th1) + l2 * cos(th2))
            + g * m3 * (l1 * cos(th1) + l2 * cos(th2) + l3 * cos(th3))
            + half * m2 * (l1**2 * w1**2 + pair(A, B, w1, w2) + l2**2 * w2**2)
            + half * m3 * (l1**2 * w1**2 + pair(A, B, w1, w2) + pair(A, C, w1, w3) + l2**2 * w2**2
                           + pair(B, C, w2, w3) + l3**2 * w3**2))  # fmt: skip


def wiki_rods():
    return m * l**2 / 6 * (w2**2 + 4 * w1**2 + 3 * w1 * w2 * cos(D)) + m * g * l / 2 * (3 * cos(th1) + cos(th2))


def scipython_rods():
    return (m1 * (l1 * w1) ** 2 / 6 + m2 * (l2 * w2) ** 2 / 6 + m2 / 2 * ((l1 * w1) ** 2 + l1 * l2 * w1 * w2 * cos(D))
            + (m1 / 2 + m2) * g * l1 * cos(th1) + m2 / 2 * g * l2 * cos(th2))  # fmt: skip


def euphonics():
    v = m * g * l * (1 - cos(th1)) + m * g * l * (2 * (1 - cos(th1)) + (1 - cos(th2)))
    third = m * l**2 / 3
    turns = (2 * w1 * cos(th1) + w2 * cos(th2)) ** 2 + (2 * w1 * sin(th1) + w2 * sin(th2)) ** 2
    return (half * m * l**2 * w1**2 * (cos(th1) ** 2 + sin(th1) ** 2) + half * third * w1**2 + half * third * w2**2
            + half * m * l**2 * turns - v)  # fmt: skip


def point_inertia():
    return (half * m1 * (l1 / 2) ** 2 * w1**2 + half * (m1 * l1**2 / 3) * w1**2
            + half * m2 * (l1**2 * w1**2 + (l2 / 2) ** 2 * w2**2 + l1 * l2 * w1 * w2 * cos(D))
            + half * (m2 * l2**2 / 3) * w2**2 + m1 * g * l1 / 2 * cos(th1)
            + m2 * g * (l1 * cos(th1) + l2 / 2 * cos(th2)))  # fmt: skip


def takeno_matrix():
    return [
        Rational(4, 3) * a1 + half * cos(D) * a2 + half * sin(D) * w2**2 + g / (2 * l) * 3 * sin(th1),
        half * cos(D) * a1 + Rational(1, 3) * a2 - half * sin(D) * w1**2 + g / (2 * l) * sin(th2),
    ]


# Name: the mechanism and the rows; of Hamilton's equations also those of the rates, which must hold of themselves.
PROOFS = {
    "dp-schawe": (TWO, short_rows()),
    "dp-arsnumerandi-rows": (TWO, arsnumerandi()),
    "dp-arsnumerandi-lagrangian": (TWO, lagrange(arsnumerandi_lagrangian(), TWO)),
    "dp-unicode-brackets": (TWO, unicode_brackets()),
    "dp-myphysicslab-json": (TWO, solved_myphysicslab()),
    "dp-matlab-continued": (TWO, solved_myphysicslab()),
    "dp-julia-subscripts": (TWO, julia()),
    "dp-portuguese": (TWO, short_rows()),
    "dp-hatena": (TWO, long_rows()),
    "dp-tagged": (TWO, long_rows()),
    "dp-holooly-lagrangian": (TWO, lagrange(holooly(), TWO)),
    "dp-infinitelexicon": (TWO, short_rows(centrifugal=half)),
    "dp-onelab-numpy": (TWO, numpy_form()),
    "dp-damped-absolute": (damped_at_joints(), damped_rows()),
    "dp-sympy-str": (TWO, long_rows()),
    "dp-sympy-srepr": (TWO, long_rows()),
    "dp-sympy-latex": (TWO, long_rows()),
    "tp-gramkoski-lagrangian": (THREE, lagrange(triple_lagrangian(), THREE)),
    "dp-assencio-hamiltonian": (TWO, *hamiltonian_rows()),
    "dp-theabbie-before": (TWO, solved_myphysicslab(sign=1)),
    "dp-nemotron-energies": (TWO, lagrange(energies(), TWO)),
    "dp-product-rule": (TWO, product_rule()),
    "dp-product-rule-lost-bracket": (TWO, product_rule_lost()),
    "tp-standard-rows": (THREE, triple_rows(m2 + m3)),
    "tp-lost-mass": (THREE, triple_rows(m2)),
    "dr-wiki-lagrangian": (EQUAL, lagrange(wiki_rods(), EQUAL)),
    "dr-wiki-hamilton": (EQUAL, *wiki_hamilton(8)),
    "dr-zingale-hamilton": (EQUAL, *wiki_hamilton(2)),
    "dr-scipython-lagrangian": (OWN, lagrange(scipython_rods(), OWN)),
    "dr-euphonics-energies": (rods((2 * l, m), (2 * l, m)), lagrange(euphonics(), EQUAL)),
    "dr-point-inertia": (OWN, lagrange(point_inertia(), OWN)),
    "dr-takeno-matrix": (EQUAL, takeno_matrix()),
}
