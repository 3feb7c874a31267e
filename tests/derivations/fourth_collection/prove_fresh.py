# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""What the files of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's a, b, α, β are l1, l2, th1, th2.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    F,
    I,
    M,
    a1,
    a2,
    a3,
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
    m,
    m1,
    m2,
    pendulum,
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
    th3,
    u,
    w,
    w1,
    w2,
    w3,
    x,
    xd,
    xdd,
)
from prove_fresh_arms import ARM, acrobot, arm, level_arm, pendubot
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, momenta, rate

half, third = Rational(1, 2), Rational(1, 3)
TWO, EQUAL, RODS = bobs((l1, m1), (l2, m2)), bobs((l, m), (l, m)), rods((l1, m1), (l2, m2))
THREE = bobs((l, m), (l, m), (l, m))
D, S, C = th1 - th2, sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
d1, d2, k1, k2, d, J, phase, speed, size = sp.symbols("d1 d2 k1 k2 d J phase speed size")


def bob_rows(sign=-1, squared=w2, weight=m1 + m2):
    """sign: of the second centrifugal term; squared: the rate in the first; weight: the mass in the first's weight."""
    return [
        (m1 + m2) * l1 * a1 + m2 * l2 * (a2 * C + squared**2 * S) + weight * g * sin(th1),
        l2 * a2 + l1 * (a1 * C + sign * w1**2 * S) + g * sin(th2),
    ]


def align_brackets():
    return [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * (a2 * C + w2**2 * S) + (m1 + m2) * g * l1 * sin(th1),
        m2 * l2**2 * a2 + m2 * l1 * l2 * (a1 * C - w1**2 * S) + m2 * g * l2 * sin(th2),
    ]


def solved(second=l2):
    """second: the length under the second acceleration."""
    below = m1 + m2 * S**2
    one = m2 * g * sin(th2) * C - m2 * S * (l1 * w1**2 * C + l2 * w2**2) - (m1 + m2) * g * sin(th1)
    two = (m1 + m2) * (l1 * w1**2 * S - g * sin(th2) + g * sin(th1) * C) + m2 * l2 * w2**2 * S * C
    return [a1 - one / (l1 * below), a2 - two / (second * below)]


def bold_matrix():
    left = sp.Matrix([[(m1 + m2) * l1**2, m2 * l1 * l2 * C], [m2 * l1 * l2 * C, m2 * l2**2]])
    right = sp.Matrix(
        [-m2 * l1 * l2 * w2**2 * S - (m1 + m2) * g * l1 * sin(th1), m2 * l1 * l2 * w1**2 * S - m2 * g * l2 * sin(th2)]
    )
    return list(left * sp.Matrix([a1, a2]) - right)


def mathjax():
    return [2 * a1 + a2 * C + w2**2 * S + 2 * g / l * sin(th1), a2 + a1 * C - w1**2 * S + g / l * cos(th2)]


def ode_file():
    return [
        (m1 / 3 + m2) * l1**2 * a1
        + m2 * l1 * l2 * C / 2 * a2
        + m2 * l1 * l2 / 2 * w2**2 * S
        + (m1 / 2 + m2) * g * l1 * sin(th1),
        m2 * l1 * l2 * C / 2 * a1 + m2 * l2**2 / 3 * a2 - m2 * l1 * l2 / 2 * w1**2 * S + m2 * g * l2 / 2 * sin(th2),
    ]


def vlatex_rods():
    return [
        (l1**2 * m1 / 3 + l1**2 * m2) * a1
        + l1 * l2 * m2 * C / 2 * a2
        + l1 * (g * m1 * sin(th1) + 2 * g * m2 * sin(th1) + l2 * m2 * S * w2**2) / 2,
        l1 * l2 * m2 * C / 2 * a1 + l2**2 * m2 / 3 * a2 - l2 * m2 * (-g * sin(th2) + l1 * S * w1**2) / 2,
    ]


def boost():
    """Cramer's rule."""
    p, q, v, z = (m1 + m2) * l1, m2 * l2 * C, l1 * C, l2
    one = -m2 * l2 * w2**2 * S - (m1 + m2) * g * sin(th1)
    two = -l1 * w1**2 * S - g * sin(th2)
    return [a1 - (one * z - q * two) / (p * z - q * v), a2 - (p * two - v * one) / (p * z - q * v)]


def hamiltonian_equal():
    """Hamilton's equations of the printed H, the momenta being those of the mechanism."""
    p1, p2 = sp.symbols("p1 p2")
    energy = (p1**2 + 2 * p2**2 - 2 * p1 * p2 * C) / (2 * m * l**2 * (1 + S**2)) - m * g * l * (2 * cos(th1) + cos(th2))
    (true1, true2), (rate1, rate2) = momenta(EQUAL)
    put = {p1: true1, p2: true2}
    rates = [(v - sp.diff(energy, p)).subs(put) for v, p in ((w1, p1), (w2, p2))]
    return EQUAL, [(rate1 + sp.diff(energy, th1)).subs(put), (rate2 + sp.diff(energy, th2)).subs(put)], rates


def hamilton_q_p():
    true = pendulum()
    (p,), (force,) = momenta(true)
    return true, [force + m * g * l * s], [w - p / (m * l**2)]


def energies_t_u():
    kinetic = (m1 + m2) * l1**2 * w1**2 / 2 + m2 * l2**2 * w2**2 / 2 + m2 * l1 * l2 * w1 * w2 * S
    return TWO, lagrange(kinetic + (m1 + m2) * g * l1 * cos(th1) + m2 * g * l2 * cos(th2), TWO)


def energies_rods():
    true = rods((l, m), (l, m))
    kinetic = m * l**2 / 6 * (4 * w1**2 + w2**2 + 3 * w1 * w2 * C)
    return true, lagrange(kinetic + m * g * l / 2 * (3 * cos(th1) + cos(th2)), true)


def cut_forces():
    """Of four rows: S_2 from the third, the second rod's transverse row; S_1 left out with its own direction."""
    x1, y1 = l1 * (a1 * cos(th1) - w1**2 * sin(th1)), l1 * (a1 * sin(th1) + w1**2 * cos(th1))
    x2, y2 = x1 + l2 * (a2 * cos(th2) - w2**2 * sin(th2)), y1 + l2 * (a2 * sin(th2) + w2**2 * cos(th2))
    second = -m2 * x2 / sin(th2)
    first = (second * sin(th2) - m1 * x1) / sin(th1)
    return [m1 * y1 - first * cos(th1) + second * cos(th2) + m1 * g, m2 * y2 - second * cos(th2) + m2 * g]


def positions():
    y1 = -l1 * cos(th1)
    places = ((m1, l1 * sin(th1), y1), (m2, l1 * sin(th1) + l2 * sin(th2), y1 - l1 * cos(th2)))
    kinetic = sum(mass * (rate(p, TWO) ** 2 + rate(q, TWO) ** 2) / 2 for mass, p, q in places)
    return TWO, lagrange(kinetic - sum(mass * g * q for mass, _, q in places), TWO)


def rods_lagrangian():
    kinetic = half * (third * m1 + m2) * l1**2 * w1**2 + m2 * l2**2 * w2**2 / 6 + half * m2 * l1 * l2 * w1 * w2 * C
    return RODS, lagrange(kinetic + (half * m1 + m2) * g * l1 * cos(th1) + half * m2 * g * l2 * cos(th2), RODS)


def joint_dampers():
    true = bobs((l1, m1), (l2, m2), forces={th1: -d1 * w1 - d2 * (w1 - w2), th2: -d2 * (w2 - w1)})
    one, two = align_brackets()
    return true, [one + d1 * w1 + d2 * (w2 - w1), two + d2 * (w2 - w1)]


def rods_torsion():
    true = rods((l, m), (l, m), potential=k1 * th1**2 / 2 + k2 * (th2 - th1) ** 2 / 2)
    back, cosine = sin(th2 - th1), cos(th2 - th1)
    return (
        true,
        [
            4 * third * m * l**2 * a1 + half * m * l**2 * (a2 * cosine - w2**2 * back) + k1 * th1 - k2 * (th2 - th1),
            third * m * l**2 * a2 + half * m * l**2 * (a1 * cosine + w1**2 * back) + k2 * (th2 - th1),
        ],
        {g: 0},
    )


def cart_lagrangian_inertia():
    true = cart_pole(J)
    return true, lagrange((M + m) * xd**2 / 2 + m * l * xd * w * c + (J + m * l**2) * w**2 / 2 + m * g * l * c, true)


def euler_cart():
    return [
        l * m * s * w**2 - l * m * c * al - (M + m) * xdd,
        -g * l * m * s - l * m * (l * al - s * w * xd + c * xdd) - l * m * s * w * xd,
    ]


def euler_spring():
    return [
        g * m * c - k * (-2 * r0 + 2 * r) / 2 + m * w**2 / 2 - m * rdd,
        -g * m * r * s - m * (r * al + w * rd),
    ]


def cart_up():
    return [(M + m) * xdd + m * l * (al * c - w**2 * s) - F, l * al + xdd * c - g * s]


def japanese():
    true = cart_pole(m * l**2 / 3, up=True, forces={x: u})
    return true, [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s - u,
        m * l * xdd * c + 4 * third * m * l**2 * al - m * g * l * s,
    ]


def modelica_cart():
    return [(M + m) * xdd + m * l * c * al - m * l * w**2 * s, l * al + l * c * xdd + g * s]


def odeint_den():
    below, push = M + m * s**2, u - b * xd
    rows = [
        xdd - (push + m * s * (l * w**2 + g * c)) / below,
        al + (push * c + m * l * w**2 * s * c + (M + m) * g * s) / (l * below),
    ]
    return cart_pole(forces={x: push}), rows, {g: Rational(981, 100)}


def embedded():
    push = (F + m * l * w * w * s) / (M + m)
    return [al - (g * s - c * push) / (l * (1 + m * c * c / (M + m))), xdd - push + m * l * al * c / (M + m)]


def states():
    below = M + m * s**2
    return [
        xdd - (u + m * l * w**2 * s - m * g * s * c) / below,
        al - ((M + m) * g * s - u * c - m * l * w**2 * s * c) / (l * below),
    ]


def free_bodies():
    across = m * xdd + m * l * al * c - m * l * w**2 * s
    down = m * g + m * l * al * s + m * l * w**2 * c
    return [M * xdd + b * xd + across - F, I * al + down * l * s + across * l * c]


def general_support():
    """The support's place, rate and acceleration are three given numbers of the time."""
    s0, s1, s2 = sp.symbols("s0 s1 s2")
    true = Mechanism([ANGLE], [Body(m, s0 + l * s, -l * c)], shifts=False, phases={s0: s1, s1: s2})
    return true, [l * al + s2 * c + g * s]


def moved(right=0, up=0):
    return Mechanism([ANGLE], [Body(m, right + l * s, up - l * c)], shifts=False, phases={phase: speed})


def rho_lagrangian():
    """r is the extension."""
    true = elastic(k * r**2 / 2, length=r0 + r)
    return true, lagrange(m * half * (rd**2 + (r0 + r) ** 2 * w**2) + m * g * (r0 + r) * c - k * half * r**2, true)


def julia_spring():
    return [rdd - (r * w**2 + g * c - k / m * (r - r0)), al + (g * s + 2 * rd * w) / r]


def loops():
    angles, rates, accelerations = (th1, th2, th3), (w1, w2, w3), (a1, a2, a3)
    return [
        sum(
            (3 - max(i, j))
            * l
            * (accelerations[j] * cos(angles[i] - angles[j]) + rates[j] ** 2 * sin(angles[i] - angles[j]))
            for j in range(3)
        )
        + (3 - i) * g * sin(angles[i])
        for i in range(3)
    ]


def triple_matrix():
    c13, c23, s13, s23 = cos(th1 - th3), cos(th2 - th3), sin(th1 - th3), sin(th2 - th3)
    mass = sp.Matrix([[3, C, c13], [C, 2, c23], [c13, c23, 1]])
    turn = sp.Matrix([[0, 2 * S, s13], [-2 * S, 0, s23], [-s13, -s23, 0]])
    weight = g / l * sp.Matrix([3 * sin(th1), 2 * sin(th2), sin(th3)])
    return list(mass * sp.Matrix([a1, a2, a3]) + turn * sp.Matrix([w1**2, w2**2, w3**2]) + weight)


def three_rods():
    true = rods((l, m), (l, m), (l, m))
    kinetic = (
        m
        * l**2
        / 6
        * (
            7 * w1**2
            + 4 * w2**2
            + w3**2
            + 9 * w1 * w2 * C
            + 3 * w1 * w3 * cos(th1 - th3)
            + 3 * w2 * w3 * cos(th2 - th3)
        )
    )
    return true, lagrange(kinetic + m * g * l / 2 * (5 * cos(th1) + 3 * cos(th2) + cos(th3)), true)


def spring_pendulum():
    """x is the depth z."""
    true = Mechanism([CART, ANGLE], [Body(M, 0, -x), Body(m, l * s, -x - l * c)], k * x**2 / 2)
    return true, [(M + m) * xdd - m * l * (al * s + w**2 * c) + k * x - (M + m) * g, l * al - xdd * s + g * s]


def telescope():
    bodies = [Body(0, 0, 0, J, th), Body(m, r * c, r * s)]
    true = Mechanism([ANGLE, (r, rd, rdd)], bodies, 0, {th: tau1, r: tau2})
    return true, [
        (J + m * r**2) * al + 2 * m * r * rd * w + m * g * r * c - tau1,
        m * rdd - m * r * w**2 + m * g * s - tau2,
    ]


def inverted_rod():
    true = chain([(l, m, l / 2, m * l**2 / 12)], up=True, forces={th1: tau - d * w1})
    return true, [m * l**2 / 12 * a1 - m * g * l / 2 * sin(th1) + d * w1 - tau]


def inverted_motor(sign):
    """The virtual work of a torque along the angle is torque times the angle's change, whichever way the angle counts."""
    return pendulum(I, up=True, forces={th: tau - b * w}), [(I + m * l**2) * al + b * w - m * g * l * s - sign * tau]


def spring_rest():
    rest = sp.Symbol("rest")
    true = Mechanism([ANGLE], [Body(m, l * s, l * c)], k * (th - rest) ** 2 / 2)
    return true, [m * l**2 * al - m * g * l * s + k * (th - rest)]


UP = cart_pole(up=True, forces={x: F})
PROOFS = {
    "dp-align-brackets": (TWO, align_brackets()),
    "dp-aligned-dfrac": (TWO, solved()),
    "dp-bold-matrix": (TWO, bold_matrix()),
    "dp-mathjax-answer": (EQUAL, mathjax()),
    "dp-mathworld-alt": (TWO, [bob_rows()[0], m2 * bob_rows()[1]]),
    "dp-modelica-class": (TWO, bob_rows()),
    "dp-live-script": (TWO, bob_rows()),
    "dp-ode-file": (RODS, ode_file()),
    "dp-julia-svector": (TWO, solved(second=l1)),
    "dp-mathematica-fullnames": (TWO, bob_rows()),
    "dp-maple-assign": (TWO, bob_rows()),
    "dp-maxima-labels": (TWO, bob_rows(weight=m1)),
    "cp-euler-equations": (cart_pole(), euler_cart()),
    "el-euler-equations": (elastic(k * (r - r0) ** 2 / 2), euler_spring()),
    "dr-vlatex-mass-matrix": (RODS, vlatex_rods()),
    "sp-srepr": (pendulum(forces={th: -b * w}), [b * w + g * l * m * s + l**2 * m * al]),
    "dp-boost-odeint": (TWO, boost()),
    "dp-greek-plain": (TWO, bob_rows()),
    "dp-mail": (TWO, bob_rows(squared=w1)),
    "dp-typst-block": (TWO, bob_rows()),
    "dp-html": (TWO, bob_rows()),
    "cp-asciimath": (UP, cart_up()),
    "sp-mathml": (pendulum(), [al + g / l * s]),
    "dp-hamiltonian-equal": hamiltonian_equal(),
    "sp-hamilton-q-p": hamilton_q_p(),
    "dp-energies-t-u": energies_t_u(),
    "dp-energies-physics": energies_rods(),
    "dp-schnittkraefte": (TWO, cut_forces()),
    "dp-positions": positions(),
    "dr-lagrangian-multline": rods_lagrangian(),
    "sp-french-sheet": (pendulum(J - m * l**2, forces={th: -b * w}), [al + b / J * w + m * g * l / J * s]),
    "cp-japanese": japanese(),
    "dp-joint-dampers": joint_dampers(),
    "ch-rods-torsion": rods_torsion(),
    "cp-subnumbered": (cart_pole(up=True, forces={x: F - b * xd}), [cart_up()[0] + b * xd, cart_up()[1]]),
    "cp-modelica-short": (cart_pole(), modelica_cart()),
    "cp-odeint-den": odeint_den(),
    "cp-c-embedded": (UP, embedded()),
    "cp-lagrangien": cart_lagrangian_inertia(),
    "cp-states-x4": (cart_pole(up=True, forces={x: u}), states()),
    "cp-free-bodies": (cart_pole(I, forces={x: F - b * xd}), free_bodies()),
    "mv-general-support": general_support(),
    "mv-ndsolve": (moved(right=size * sin(phase)), [l * al + g * s - size * speed**2 * sin(phase) * c]),
    "mv-inner-derivative": (
        moved(up=size * cos(phase)),
        [m * l**2 * al - m * l * size * speed * cos(phase) * s + m * g * l * s],
    ),
    "el-rho-lagrangian": rho_lagrangian(),
    "el-julia-inplace": (elastic(k * (r - r0) ** 2 / 2), julia_spring()),
    "ac-entries": acrobot(),
    "pb-theta-matlab": pendubot(),
    "arm-shorthand": (ARM, arm(2)),
    "arm-sc-unicode": (ARM, arm(1)),
    "arm-christoffel-sums": level_arm(),
    "tp-loops": (THREE, loops()),
    "tp-cos-shorthand": (THREE, triple_matrix()),
    "ch-three-rods": three_rods(),
    "sp-siunitx": (pendulum(), [al + Rational(196, 10) * s], {g: Rational(98, 10), l: half}),
    "sp-drallsatz": (pendulum(I), [(I + m * l**2) * al + m * g * l * s]),
    "sp-displaystyle": (rods((l, m)), [a1 + 3 * g / (2 * l) * sin(th1)]),
    "ip-rod-steiner": inverted_rod(),
    "sv-spring-pendulum": spring_pendulum(),
    "rp-arm": telescope(),
    "ip-motor-clockwise": inverted_motor(1),
    "ip-motor-against": inverted_motor(-1),
    "ip-spring-rest": spring_rest(),
}
