"""What the notes of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's M_c, q_1, φ, θ are M, th1, th2, th.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    I1,
    I2,
    ONE,
    THREE,
    TWO,
    F,
    I,
    M,
    a1,
    a2,
    al,
    b,
    bobs,
    cart_pole,
    elastic,
    g,
    k,
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
    phdd,
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
    th3,
    u,
    w,
    w1,
    w2,
    w3,
    wheel,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, momenta

half, third = Rational(1, 2), Rational(1, 3)
BOBS = bobs((l1, m1), (l2, m2))
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
d, dry, phase, speed, size = sp.symbols("d dry phase speed size")
PUSHED = cart_pole(up=True, forces={x: F})


def newton_tension():
    """The rod's force from the row across, put into the other two."""
    across = m * xdd + m * l * al * c - m * l * w**2 * s
    return PUSHED, [M * xdd - F + across, -m * g + m * l * al * s + m * l * w**2 * c + across / s * c]


def guide_damped():
    true = cart_pole(up=True, left=True, forces={x: F - b * xd, th: -d * w})
    below, push = M + m - m * c**2, F - xd * b - w**2 * m * l * s
    return true, [
        xdd - (push - w * d / l * c + g * m * c * s) / below,
        al - (push * c - w * d * (M + m) / (m * l) + g * (M + m) * s) / (l * below),
    ]


def manipulator_terms():
    mass = sp.Matrix([[M + m, m * l * c], [m * l * c, m * l**2]])
    right = sp.Matrix([m * l * s * w**2 + u, -g * m * l * s])
    return cart_pole(forces={x: u}), list(mass * sp.Matrix([xdd, al]) - right)


def vector_rows():
    return PUSHED, [(M + m) * xdd + m * l * (al * c - w**2 * s) - F, m * l * xdd * c + m * l**2 * al - m * g * l * s]


def tajima_rod():
    """l is half the rod's length here; the page's L is 2 l."""
    true, length = cart_pole(m * l**2 / 3, up=True, forces={x: u}), 2 * l
    return true, [
        (M + m) * xdd + half * m * length * c * al - half * m * length * s * w**2 - u,
        half * m * length * (c * xdd - s * xd * w) + third * m * length**2 * al - half * m * g * length * s,
    ]


def edu_explicit():
    below = M + m - m * c**2
    return cart_pole(up=True, forces={x: u}), [
        xdd - (u + m * l * w**2 * s - m * g * s * c) / below,
        al - (u * c - m * l * w**2 * s * c + (M + m) * g * s) / (l * below),
    ]


def free_support():
    return cart_pole(), [half * (M + m) * xdd + m * l * al * c - m * l * w**2 * s, l * al + xdd * c + g * s]


def rod_halves():
    """l is half the rod's length here; the page's l is 2 l."""
    length = 2 * l
    return cart_pole(m * l**2 / 3), [
        (M + m) * xdd + m * length * c * al - m * length * s * w**2,
        m * length * c * xdd + third * m * length**2 * al + m * g * length / 2 * s,
    ]


def newton_french():
    """y points down; the tensions from the rows across, put into the rows along."""
    x1 = -l1 * sin(th1) * w1**2 + l1 * cos(th1) * a1
    y1 = -l1 * cos(th1) * w1**2 - l1 * sin(th1) * a1
    x2 = x1 - l2 * sin(th2) * w2**2 + l2 * cos(th2) * a2
    y2 = y1 - l2 * cos(th2) * w2**2 - l2 * sin(th2) * a2
    second = m2 * x2 / sin(th2)
    first = (m1 * x1 + second * sin(th2)) / sin(th1)
    return BOBS, [
        m1 * y1 + first * cos(th1) - second * cos(th2) - m1 * g,
        m2 * y2 + second * cos(th2) - m2 * g,
    ]


def tags_inside():
    return BOBS, [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + g * (m1 + m2) * sin(th1),
        m2 * l2 * a2 + m2 * l1 * a1 * C - m2 * l1 * w1**2 * S + m2 * g * sin(th2),
    ]


def lost_lower_mass():
    return BOBS, [
        m1 * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S + (m1 + m2) * g * l1 * sin(th1),
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C - m2 * l1 * l2 * w1**2 * S + m2 * g * l2 * sin(th2),
    ]


def susskind_sympy():
    double = sin(2 * th1 - 2 * th2)
    one = g * m1 * sin(th1) + g * m2 / 2 * sin(th1) + g * m2 / 2 * sin(th1 - 2 * th2)
    one += l1 * m2 / 2 * w1**2 * double + l2 * m2 * w2**2 * S
    two = -g * m1 * sin(th2) + g * m1 * sin(2 * th1 - th2) - g * m2 * sin(th2) + g * m2 * sin(2 * th1 - th2)
    two += 2 * l1 * m1 * w1**2 * S + 2 * l1 * m2 * w1**2 * S + l2 * m2 * w2**2 * double
    return BOBS, [a1 - one / (l1 * (-m1 + m2 * C**2 - m2)), a2 - two / (2 * l2 * (m1 - m2 * C**2 + m2))]


def hamilton(energy, p1, p2):
    """Hamilton's equations of a printed H, the momenta being those of the two bobs."""
    (true1, true2), (rate1, rate2) = momenta(BOBS)
    put = {p1: true1, p2: true2}
    rates = [(v - sp.diff(energy, p)).subs(put) for v, p in ((w1, p1), (w2, p2))]
    return BOBS, [(rate1 + sp.diff(energy, th1)).subs(put), (rate2 + sp.diff(energy, th2)).subs(put)], rates


def hamiltonian_broken():
    p1, p2 = sp.symbols("p1 p2")
    above = m2 * l2**2 * p1**2 + (m1 + m2) * l1**2 * p2**2 - 2 * m2 * l1 * l2 * p1 * p2 * C
    weight = g * (m1 + m2) * l1 * cos(th1) + g * m2 * l2 * cos(th2)
    return hamilton(above / (2 * m2 * l1**2 * l2**2 * (m1 + m2 * S**2)) - weight, p1, p2)


def hamiltonian_inverse():
    p1, p2 = sp.symbols("p1 p2")
    p = sp.Matrix([p1, p2])
    mass = sp.Matrix([[(m1 + m2) * l1**2, m2 * l1 * l2 * C], [m2 * l1 * l2 * C, m2 * l2**2]])
    moving = (p.T * mass.inv() * p)[0] / 2
    return hamilton(moving - (m1 + m2) * g * l1 * cos(th1) - m2 * g * l2 * cos(th2), p1, p2)


def german_unicode():
    moving = half * m1 * l1**2 * w1**2 + half * m2 * (l1**2 * w1**2 + l2**2 * w2**2 + 2 * l1 * l2 * w1 * w2 * C)
    return BOBS, lagrange(moving + (m1 + m2) * g * l1 * cos(th1) + m2 * g * l2 * cos(th2), BOBS)


def xiaoshi_energies():
    across = l1 * w1 * cos(th1) + l2 * w2 * cos(th2)
    down = l1 * w1 * sin(th1) + l2 * w2 * sin(th2)
    moving = half * m1 * (l1 * w1) ** 2 + half * m2 * (across**2 + down**2)
    resting = -m1 * g * l1 * cos(th1) - m2 * g * (l1 * cos(th1) + l2 * cos(th2))
    return BOBS, lagrange(moving - resting, BOBS)


def forum_listed():
    x1 = -(w1**2) * l1 * sin(th1) + a1 * l1 * cos(th1)
    y1 = w1**2 * l1 * cos(th1) + a1 * l1 * sin(th1)
    x2 = x1 - w2**2 * l2 * sin(th2) + a2 * l2 * cos(th2)
    y2 = y1 + w2**2 * l2 * cos(th2) + a2 * l2 * sin(th2)
    return BOBS, [
        sin(th1) * (m1 * y1 + m2 * y2 + m2 * g + m1 * g) + cos(th1) * (m1 * x1 + m2 * x2),
        sin(th2) * (m2 * y2 + m2 * g) + cos(th2) * m2 * x2,
    ]


def report_stars():
    sine, cosine = sin(th2 - th1), cos(th2 - th1)
    below = m1 + m2 - m2 * cosine**2
    one = m2 * ((g * sin(th2) + l1 * w1**2 * sine) * cosine + l2 * w2**2 * sine) - g * (m1 + m2) * sin(th1)
    two = (m1 + m2) * (g * (-sin(th2) + cosine * sin(th1)) - l1 * w1**2 * sine) - l2 * m2 * w2**2 * cosine * sine
    return BOBS, [a1 - one / (below * l1), a2 - two / (below * l2)]


SPRING = elastic(k * (r - r0) ** 2 / 2)


def l_minus_r():
    return SPRING, lagrange(
        half * m * rd**2 + half * m * r**2 * w**2 + m * g * r * c - half * k * (r0 - r) ** 2, SPRING
    )


def side_by_side():
    return SPRING, [rdd - (r * w**2 + g * c - k / m * (r - r0)), al + 2 * rd * w / r + g / r * s]


def from_x_axis():
    """r is the extension, the angle is counted from the right."""
    length = r0 + r
    true = Mechanism([(r, rd, rdd), ANGLE], [Body(m, length * c, length * s)], k * r**2 / 2)
    return true, [rdd - (length * w**2 - k * r / m + g * s), al + g / length * c + 2 * rd * w / length]


def bobs_on_rods():
    """A rod and a bob at its end are two bodies of one turn."""
    ends = sp.symbols("mb1 mb2 mb3", positive=True)
    bars = sp.symbols("mr1 mr2 mr3", positive=True)
    lengths, angles, rates = (l1, l2, l3), (th1, th2, th3), (w1, w2, w3)
    bodies, px, py = [], sp.Integer(0), sp.Integer(0)
    for bar, end, length, angle in zip(bars, ends, lengths, angles, strict=True):
        bodies.append(
            Body(bar, px + length / 2 * cos(angle), py + length / 2 * sin(angle), bar * length**2 / 12, angle)
        )
        px, py = px + length * cos(angle), py + length * sin(angle)
        bodies.append(Body(end, px, py))
    true = Mechanism([ONE, TWO, THREE], bodies)
    (mb1, mb2, mb3), (mr1, mr2, mr3) = ends, bars
    one, two, three = (
        mb1 + mr1 / 3 + mb2 + mr2 + mb3 + mr3,
        mb2 + mr2 / 3 + mb3 + mr3,
        mb3 + mr3 / 3,
    )
    first, second, last = mb1 + mr1 / 2 + mb2 + mr2 + mb3 + mr3, mb2 + mr2 / 2 + mb3 + mr3, mb3 + mr3 / 2
    moving = sum(mass * length**2 * v**2 / 2 for mass, length, v in zip((one, two, three), lengths, rates, strict=True))
    moving += second * l1 * l2 * w1 * w2 * cos(th2 - th1)
    moving += last * l3 * w3 * (l2 * w2 * cos(th3 - th2) + l1 * w1 * cos(th3 - th1))
    resting = first * g * l1 * sin(th1) + second * g * l2 * sin(th2) + last * g * l3 * sin(th3)
    return true, lagrange(moving - resting, true)


def lost_cross_term():
    true = bobs((l1, m1), (l2, m2), (l3, m3))
    one, two, three = (l1 * w1) ** 2, (l2 * w2) ** 2, (l3 * w3) ** 2
    moving = half * m1 * one + half * m2 * (one + two + 2 * l1 * l2 * w1 * w2 * C)
    couplings = 2 * l1 * l3 * w1 * w3 * cos(th1 - th3) + 2 * l2 * l3 * w2 * w3 * cos(th2 - th3)
    moving += half * m3 * (one + two + three + couplings)
    depths = (
        m1 * l1 * cos(th1) + m2 * (l1 * cos(th1) + l2 * cos(th2)) + m3 * (l1 * cos(th1) + l2 * cos(th2) + l3 * cos(th3))
    )
    return true, lagrange(moving + g * depths, true)


def moved(right=0, up=0):
    return Mechanism([ANGLE], [Body(m, right + l * s, up - l * c)], shifts=False, phases={phase: speed})


def circle_lagrangian():
    true = moved(right=size * cos(phase), up=size * sin(phase))
    printed = half * m * l**2 * w**2 + m * size * l * speed**2 * sin(th - phase) + m * g * l * c
    return true, lagrange(printed, true)


def coulomb_motor():
    """dry: the friction's moment times the sign of the rate, one unknown number."""
    inertia = I - m * l**2
    return pendulum(inertia, forces={th: tau - b * w - dry}), [I * al + b * w + dry + m * g * l * s - tau]


def upward_matrices():
    true = links(False, relative=True, up=True, forces={th1: tau1, th2: tau2})
    s1, s2, c2, s12 = sin(th1), sin(th2), cos(th2), sin(th1 + th2)
    cross = m2 * l1 * lc2 * c2 + m2 * lc2**2 + I2
    mass = sp.Matrix(
        [
            [m1 * lc1**2 + m2 * l1**2 + 2 * m2 * l1 * lc2 * c2 + m2 * lc2**2 + I1 + I2, cross],
            [cross, m2 * lc2**2 + I2],
        ]
    )
    h = m2 * l1 * lc2 * s2
    turn = sp.Matrix([[-h * w2, -h * w1 - h * w2], [h * w1, 0]])
    weight = sp.Matrix([-m1 * g * lc1 * s1 - m2 * g * (lc2 * s12 + l1 * s1), -m2 * g * lc2 * s12])
    return true, list(mass * sp.Matrix([a1, a2]) + turn * sp.Matrix([w1, w2]) + weight - sp.Matrix([tau1, tau2]))


def lift_and_turn():
    """x is the lift's height."""
    true = Mechanism([CART, ANGLE], [Body(M, 0, x), Body(m, l * s, x + l * c, I, th)], 0, {x: F, th: tau})
    return true, [
        (M + m) * xdd - m * l * s * al - m * l * c * w**2 + (M + m) * g - F,
        -m * l * s * xdd + (I + m * l**2) * al - l * s * m * g - tau,
    ]


def lift_two_links():
    """x is the lift's height; m1, l1, th1 are the page's m_2, l_2, q_2, and m2, l2, th2 its m_3, l_3, q_3."""
    turn = th1 + th2
    bodies = [
        Body(M, 0, x),
        Body(m1, lc1 * sin(th1), x + lc1 * cos(th1), I1, th1),
        Body(m2, l1 * sin(th1) + lc2 * sin(turn), x + l1 * cos(th1) + lc2 * cos(turn), I2, turn),
    ]
    true = Mechanism([CART, ONE, TWO], bodies, 0, {x: F, th1: tau1, th2: tau2})
    s1, c1, s2, c2, s12, c12 = sin(th1), cos(th1), sin(th2), cos(th2), sin(turn), cos(turn)
    lifts = -m1 * lc1 * s1 - m2 * l1 * s1 - m2 * lc2 * s12
    h, cross = m2 * l1 * lc2 * s2, m2 * lc2**2 + m2 * l1 * lc2 * c2 + I2
    whole = m1 * lc1**2 + I1 + m2 * l1**2 + m2 * 2 * l1 * lc2 * c2 + m2 * lc2**2 + I2
    return true, [
        (M + m1 + m2) * xdd
        + lifts * a1
        - m2 * lc2 * s12 * a2
        + (-m1 * lc1 * c1 * w1 - m2 * l1 * c1 * w1 - m2 * lc2 * c12 * w1 - m2 * lc2 * c12 * w2) * w1
        + (-m2 * lc2 * c12 * w1 - m2 * lc2 * c12 * w2) * w2
        + (M + m1 + m2) * g
        - F,
        lifts * xdd
        + whole * a1
        + cross * a2
        - h * w2 * w1
        + (-h * w1 - h * w2) * w2
        - lc1 * s1 * m1 * g
        - l1 * s1 * m2 * g
        - lc2 * s12 * m2 * g
        - tau1,
        -m2 * lc2 * s12 * xdd + cross * a1 + (m2 * lc2**2 + I2) * a2 + h * w1 * w1 - lc2 * s12 * m2 * g - tau2,
    ]


def mu_spanish():
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: u})
    one, two, three, four, five = (m1 + m2) * l1**2, m2 * l2**2, m2 * l1 * l2, (m1 + m2) * l1, m2 * l2
    cosine = cos(th2)
    mass = sp.Matrix([[one + two + 2 * three * cosine, two + three * cosine], [two + three * cosine, two]])
    turn = -three * sin(th2) * sp.Matrix([[w2, w1 + w2], [-w1, 0]])
    weight = g * sp.Matrix([four * cos(th1) + five * cos(th1 + th2), five * cos(th1 + th2)])
    return true, list(mass * sp.Matrix([a1, a2]) + turn * sp.Matrix([w1, w2]) + weight - sp.Matrix([u, 0]))


def coloured_lagrangian():
    """The angles are counted to the left, the slide to the right."""
    bodies = [
        Body(M, x, 0),
        Body(m1, x - l1 * sin(th1), l1 * cos(th1)),
        Body(m2, x - l1 * sin(th1) - l2 * sin(th2), l1 * cos(th1) + l2 * cos(th2)),
    ]
    true = Mechanism([CART, ONE, TWO], bodies)
    moving = half * M * xd**2 + half * m1 * (xd**2 - 2 * xd * l1 * w1 * cos(th1) + l1**2 * w1**2)
    couplings = -2 * xd * l1 * w1 * cos(th1) - 2 * xd * l2 * w2 * cos(th2) + 2 * l1 * l2 * w1 * w2 * C
    moving += half * m2 * (xd**2 + l1**2 * w1**2 + l2**2 * w2**2 + couplings)
    return true, lagrange(moving - (m1 + m2) * g * l1 * cos(th1) - m2 * g * l2 * cos(th2), true)


def relative_wheel():
    return wheel(I1, I2, forces={sp.Symbol("ph", real=True): tau}), [I1 * al - m * g * l * s + tau, I2 * phdd - tau]


PROOFS = {
    "cp-newton-tension": newton_tension(),
    "cp-guide-damped": guide_damped(),
    "cp-manipulator-terms": manipulator_terms(),
    "cp-vector-rows": vector_rows(),
    "cp-tajima-rod": tajima_rod(),
    "cp-edu-explicit": edu_explicit(),
    "cp-free-support": free_support(),
    "cp-rod-halves": rod_halves(),
    "dp-newton-french": newton_french(),
    "dp-tags-inside": tags_inside(),
    "dp-lost-lower-mass": lost_lower_mass(),
    "dp-susskind-sympy": susskind_sympy(),
    "dp-hamiltonian-broken": hamiltonian_broken(),
    "dp-hamiltonian-inverse": hamiltonian_inverse(),
    "dp-german-unicode": german_unicode(),
    "dp-xiaoshi-energies": xiaoshi_energies(),
    "dp-forum-listed": forum_listed(),
    "dp-report-stars": report_stars(),
    "el-l-minus-r": l_minus_r(),
    "el-side-by-side": side_by_side(),
    "el-from-x-axis": from_x_axis(),
    "tp-bobs-on-rods": bobs_on_rods(),
    "tp-lost-cross-term": lost_cross_term(),
    "mv-circle-lagrangian": circle_lagrangian(),
    "mv-morin-inline": (moved(right=size * cos(phase)), [al - size / l * speed**2 * cos(phase) * c + g / l * s]),
    "mv-harmonic-lost-cosine": (
        moved(right=size * cos(phase)),
        [al - size * speed**2 / l * cos(phase) + g / l * s],
    ),
    "mv-kapitza-downward": (
        moved(up=size * cos(phase)),
        [m * l * al - m * g * s + size * m * speed**2 * cos(phase) * s],
    ),
    "sp-energy-primes": (pendulum(), [l * al + g * s]),
    "sp-japanese-lagrangian": (pendulum(), lagrange(half * m * (l * w) ** 2 + m * g * l * c, pendulum())),
    "sp-coulomb-motor": coulomb_motor(),
    "sp-answers-plain": (
        pendulum(I, up=True, forces={th: tau - b * w}),
        [(I + m * l**2) * al - tau + b * w - m * g * l * s],
    ),
    "arm-upward-matrices": upward_matrices(),
    "arm-lift-and-turn": lift_and_turn(),
    "arm-lift-two-links": lift_two_links(),
    "pb-mu-spanish": mu_spanish(),
    "dc-coloured-lagrangian": coloured_lagrangian(),
    "rw-relative-wheel": relative_wheel(),
}
