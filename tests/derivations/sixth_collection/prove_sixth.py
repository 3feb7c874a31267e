"""What the derivations of this folder say, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's ℓ, φ, q_1, M_c are l, th1, th1, M. A support that is moved is at Y
above (or X beside) its rest, with the rate V and the acceleration A.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    I1,
    I2,
    ONE,
    RADIUS,
    TWO,
    F,
    I,
    M,
    a1,
    a2,
    a3,
    al,
    b,
    b1,
    b2,
    bobs,
    cart_pole,
    chain,
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
from sympy import Rational, cos, sin
from truth import Body, Mechanism, coordinate, lagrange, momenta, rows_of

half, third = Rational(1, 2), Rational(1, 3)
BOBS = bobs((l1, m1), (l2, m2))
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
X, V, A, q, damp, dry, rate2 = sp.symbols("X V A q damp dry rate2")
k1, k2, r01, r02 = sp.symbols("k1 k2 r01 r02")
r1, r1d, r1dd = coordinate("r1")
r2, r2d, r2dd = coordinate("r2")
z, zd, zdd = coordinate("z")


# One pendulum


def boxed_inertia():
    """The link's own length is of no account; l is where its centre is."""
    return pendulum(I, forces={th: u}), [(I + m * l**2) * al + m * g * l * s - u]


def torque_first():
    return pendulum(forces={th: tau}), [tau - (l * m * g * s + l**2 * m * al)]


def mathrm_derivatives():
    return pendulum(forces={th: tau - b * w}), [m * l**2 * al + b * w + m * g * l * s - tau]


def unicode_tau():
    """Of unit inertia: m l² is one."""
    true = Mechanism([ANGLE], [Body(1 / l**2, l * s, -l * c)], 0, {th: tau - b * w})
    return true, [al + b * w + g / l * s - tau]


def plain_d2():
    """m, l and g are one; the drive is an unknown number."""
    return pendulum(forces={th: F - w / q}), [al + w / q + s - F], {m: 1, l: 1, g: 1}


def length_above():
    return pendulum(), [al + l * g * s]


def plain_row():
    return pendulum(), [al + g / l * s]


# A support that is moved


def moved(right=False, up=False, top=False, forces=None):
    place = (X if right else 0) + l * s, (X if up else 0) + (l if top else -l) * c
    return Mechanism([ANGLE], [Body(m, *place)], 0, forces or {}, False, {X: V, V: A})


def undotted_height():
    true = moved(up=True, top=True)
    printed = m / 2 * (l**2 * w**2 + V**2 - 2 * l * X * w * s) - m * g * l * c - m * g * X
    return true, lagrange(printed, true)


def gathered_row():
    return moved(up=True, top=True), [al - (g + A) / l * s]


def pivot_subtracted():
    return moved(up=True), [al + (g - A) / l * s]


def docstring_omega():
    """Of y = a cos Ωt the acceleration is A = -a Ω² cos Ωt."""
    return moved(up=True), [al + g / l * s + A / l * s]


def damped_tuple():
    """Of y = a sin wt the acceleration is A = -a w² sin wt."""
    true = moved(up=True, top=True, forces={th: -b * w})
    return true, [al - (m * l * (g + A) * s - b * w) / (m * l**2)]


def accelerated_cart():
    true = moved(right=True, forces={th: -b * m * l**2 * w})
    return true, [al + g / l * s + A / l * c + b * w]


# Two bobs


def divided_rows():
    return BOBS, [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + (m1 + m2) * g * s1,
        m2 * l2 * a2 + m2 * l1 * a1 * C - m2 * l1 * w1**2 * S + m2 * g * s2,
    ]


def known_solved():
    """The form with sin(θ1 − 2θ2) and 2 θ1 − 2 θ2."""
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * m2 * S * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * c1 + w2**2 * l2 * m2 * C)
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def square_brackets():
    below = m1 + m2 * S**2
    one = m2 * g * s2 * C - m2 * S * (l1 * w1**2 * C + l2 * w2**2) - (m1 + m2) * g * s1
    two = (m1 + m2) * (l1 * w1**2 * S - g * s2 + g * s1 * C) + m2 * l2 * w2**2 * S * C
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def colon_equals():
    moving = m1 * (l1 * w1) ** 2 / 2 + m2 * ((l1 * w1) ** 2 / 2 + (l2 * w2) ** 2 / 2 + l1 * w1 * l2 * w2 * C)
    weight = m1 * g * l1 * c1 + m2 * g * (l1 * c1 + l2 * c2)
    return BOBS, lagrange(moving + weight, BOBS)


def bare_cos():
    moving = half * (m1 + m2) * l1**2 * w1**2 + half * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * C
    return BOBS, lagrange(moving + (m1 + m2) * g * l1 * c1 + m2 * g * l2 * c2, BOBS)


def hamiltonian_arguments():
    p1, p2 = sp.symbols("p1 p2")
    above = l2**2 * m2 * p1**2 - 2 * l1 * l2 * m2 * C * p1 * p2 + l1**2 * (m1 + m2) * p2**2
    below = l1**2 * l2**2 * m2 * (-2 * m1 - m2 + m2 * cos(2 * (th1 - th2)))
    energy = -above / below - (m1 * g * l1 * c1 + m2 * g * (l1 * c1 + l2 * c2))
    (true1, true2), (rate1, rate2) = momenta(BOBS)
    put = {p1: true1, p2: true2}
    rates = [(v - sp.diff(energy, p)).subs(put) for v, p in ((w1, p1), (w2, p2))]
    return BOBS, [(rate1 + sp.diff(energy, th1)).subs(put), (rate2 + sp.diff(energy, th2)).subs(put)], rates


def momentum_twice():
    (p1, p2), (rate1, rate2) = momenta(BOBS)
    below = m1 + m2 * S**2
    first = p1 * p2 * S / (l1 * l2 * below)
    second = l2**2 * m2 * p1**2 + l1**2 * (m1 + m2) * p2**2 - l1 * l2 * m2 * p1 * p2 * C
    second *= sin(2 * (th1 - th2)) / (2 * l1**2 * l2**2 * below**2)
    rates = [
        w1 - (l2 * p1 - l1 * p2 * C) / (l1**2 * l2 * below),
        w2 - (l1 * (m1 + m2) * p1 - l2 * m2 * p1 * C) / (l1**2 * l2 * below),
    ]
    rows = [rate1 + (m1 + m2) * g * l1 * s1 + first - second, rate2 + m2 * g * l2 * s2 - first + second]
    return BOBS, rows, rates


def other_length():
    true = bobs((l1, m1), (l2, m2), up=True)
    moving = half * m1 * w1**2 * l1**2 + half * m2 * (w2**2 * l2**2 + w1**2 * l2**2 + 2 * w1 * w2 * l1 * l2 * C)
    return true, lagrange(moving - g * ((m1 + m2) * l1 * c1 + m2 * l2 * c2), true)


def damper_alone():
    """Dampers at the joints: the lower one acts on the difference of the rates, and back on the upper rod."""
    lower = b2 * (w2 - w1)
    true = bobs((l1, m1), (l2, m2), forces={th1: -b1 * w1 + lower, th2: -lower})
    det = (m1 + m2) * l1**2 * m2 * l2**2 - (m2 * l1 * l2 * C) ** 2
    one = -m2 * l1 * l2 * w2**2 * S - (m1 + m2) * g * l1 * s1 - b1 * w1
    two = m2 * l1 * l2 * w1**2 * S - m2 * g * l2 * s2 - b2 * w2
    return true, [
        a1 - (m2 * l2**2 * one - m2 * l1 * l2 * C * two) / det,
        a2 - (-m2 * l1 * l2 * C * one + (m1 + m2) * l1**2 * two) / det,
    ]


def lattice_torques():
    true = bobs((1, 1), (1, 1), forces={th1: tau1, th2: tau2})
    mass, force = sp.Matrix([[2, C], [C, 1]]), sp.Matrix([-(w2**2) * S - 2 * g * s1 + tau1, w1**2 * S - g * s2 + tau2])
    return true, list(mass * sp.Matrix([a1, a2]) - force)


def greek_substitutions():
    alpha, beta, gamma = (m1 + m2) * l1**2, m2 * l1 * l2 * C, m2 * l2**2
    delta = m2 * l1 * l2 * w2**2 * S + l1 * g * (m1 + m2) * s1
    epsilon = -m2 * l1 * l2 * w1**2 * S + l2 * m2 * g * s2
    return BOBS, [alpha * a1 + beta * a2 + delta, gamma * a2 + beta * a1 + epsilon]


def relative_unit():
    true = bobs((1, 1), (1, 1), relative=True)
    moving = w1**2 / 2 + (w1**2 + (w1 + w2) ** 2) / 2 + w1 * (w1 + w2) * c2
    return true, lagrange(moving - g * (-c1) - g * (-c1 - cos(th1 + th2)), true)


def asciimath_places():
    """y points down: the weight does work along it."""
    true = bobs((l, m), (l, m), relative=True)
    places = [(l * s1, l * c1), (l * (s1 + sin(th1 + th2)), l * (c1 + cos(th1 + th2)))]
    bodies = [Body(m, right, -down) for right, down in places]
    found = Mechanism([ONE, TWO], bodies)
    return true, rows_of(found)


def mass_of_the_other():
    rows = sp.Matrix([[(m1 + m2) * l1, m2 * l2 * C], [m1 * l1 * C, m1 * l2]]) * sp.Matrix([a1, a2])
    return BOBS, [
        rows[0] + (m1 + m2) * g * s1 + m2 * l2 * w2**2 * S,
        rows[1] - (m2 * l1 * w1**2 * S - m2 * g * s2),
    ]


def damped_spanish():
    """The damper's moment is c1 l1 times the rate, as the row is divided by l1."""
    true = bobs((l1, m1), (l2, m2), forces={th1: -b1 * l1 * w1})
    D = th2 - th1
    mass = sp.Matrix([[(m1 + m2) * l1, m2 * l2 * cos(D)], [l1 * cos(D), l2]])
    turn = sp.Matrix([[b1, -m2 * l2 * w2 * sin(D)], [l1 * w1 * sin(D), 0]])
    rows = mass * sp.Matrix([a1, a2]) + turn * sp.Matrix([w1, w2]) + sp.Matrix([(m1 + m2) * g * s1, g * s2])
    fifth = Rational(1, 5)
    numbers = {m1: fifth, m2: fifth / 2, l1: Rational(3, 10), l2: Rational(1, 4), g: Rational(981, 100), b1: fifth}
    return true, list(rows), numbers


def scilab_letters():
    one = -(m1 + m2) * g * l1 * s1 - m2 * l1 * l2 * w2**2 * S
    two = -m2 * g * l2 * s2 + m2 * l1 * l2 * w1**2 * S
    first, both, last = (m1 + m2) * l1**2, m2 * l1 * l2 * C, m2 * l2**2
    lower = (two - both * one / first) / (last - both**2 / first)
    return BOBS, [a1 - (one - both * lower) / first, a2 - lower]


def elementwise_german():
    coupling = m2 * l2 * C / ((m1 + m2) * l1)
    rest = (m2 * l2 * w2**2 * S + (m1 + m2) * g * s1) / ((m1 + m2) * l1)
    lower = (l1 * rest * C + l1 * w1**2 * S - g * s2) / (l2 - coupling * l1 * C)
    return BOBS, [a1 + coupling * lower + rest, a2 - lower]


def french_odeint():
    true = bobs((l, m), (l, m))
    below = l * (2 * m + m - m * cos(2 * (th1 - th2)))
    one = -g * (2 * m + m) * s1 - m * g * sin(th1 - 2 * th2) - 2 * S * m * (w2**2 * l + w1**2 * l * C)
    two = 2 * S * (w1**2 * l * (m + m) + g * (m + m) * c1 + w2**2 * l * m * C)
    return true, [a1 - one / below, a2 - two / below]


# Rods, and links with a centre


def mathematica_signs():
    """A torque between the links turns the lower one on, and the upper one back."""
    true = bobs((l1, m1), (l2, m2), forces={th1: -u, th2: u})
    mass = sp.Matrix([[(m1 + m2) * l1**2, m2 * l1 * l2 * C], [m2 * l1 * l2 * C, m2 * l2**2]])
    force = sp.Matrix(
        [2 * m1 * g * l1 * s1 + m2 * l1 * l2 * S * w2**2, m1 * g * l2 * s2 - m2 * l1 * l2 * S * w1**2 + u]
    )
    return true, list(mass * sp.Matrix([a1, a2]) - force)


def drake_class():
    true = links(True, relative=True, forces={th1: -b1 * w1, th2: u - b2 * w2})
    h = m2 * l1 * lc2
    mass = sp.Matrix([[I1 + I2 + m2 * l1**2 + 2 * h * c2, I2 + h * c2], [I2 + h * c2, I2]])
    turn = sp.Matrix([[-2 * h * s2 * w2, -h * s2 * w2], [h * s2 * w1, 0]]) * sp.Matrix([w1, w2])
    s12 = sin(th1 + th2)
    weight = g * sp.Matrix([m1 * lc1 * s1 + m2 * (l1 * s1 + lc2 * s12), m2 * lc2 * s12])
    damped = sp.Matrix([b1 * w1, b2 * w2])
    return true, list(mass * sp.Matrix([a1, a2]) + turn + weight + damped - sp.Matrix([0, u]))


def equal_rods_matlab():
    true = rods((l, m), (l, m))
    below = l * (-23 + 9 * cos(2 * (th1 - th2)))
    one = 3 * (9 * g * s1 + 3 * g * sin(th1 - 2 * th2) + 2 * l * (2 * w2**2 + 3 * w1**2 * C) * S)
    two = 16 * l * w1**2 * S + 3 * l * w2**2 * sin(2 * (th1 - th2)) + 9 * g * sin(2 * th1 - th2) - 7 * g * s2
    return true, [a1 - one / below, a2 + 3 * two / below]


def cauchy_handles():
    """m l² is one."""
    true = rods((l, 1 / l**2), (l, 1 / l**2))
    (p1, p2), (rate1, rate2) = momenta(true)
    below = 16 - 9 * C**2
    rates = [w1 - 6 * (2 * p1 - 3 * C * p2) / below, w2 - 6 * (8 * p2 - 3 * C * p1) / below]
    return true, [rate1 + (w1 * w2 * S + 3 * g / l * s1) / 2, rate2 + (-w1 * w2 * S + g / l * s2) / 2], rates


def two_boxes():
    true = bobs((l1, m1), (l2, m2), relative=True, forces={th1: tau1, th2: tau2})
    s12 = sin(th1 + th2)
    one = ((m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2) * a1 + (m2 * l2**2 + m2 * l1 * l2 * c2) * a2
    one += -m2 * l1 * l2 * s2 * (2 * w1 + w2) * w2 + (m1 + m2) * g * l1 * s1 + m2 * g * l2 * s12
    two = (m2 * l2**2 + m2 * l1 * l2 * c2) * a1 + m2 * l2**2 * a2 + m2 * l1 * l2 * s2 * w1**2 + m2 * g * l2 * s12
    return true, [one - tau1, two - tau2]


def entries_bulleted():
    true = links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    both, last, h = m2 * (lc2**2 + l1 * lc2 * c2) + I2, m2 * lc2**2 + I2, m2 * l1 * lc2 * s2
    mass = sp.Matrix([[m1 * lc1**2 + I1 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2) + I2, both], [both, last]])
    turn = sp.Matrix([[-h * w2, -h * (w1 + w2)], [h * w1, 0]])
    lower = m2 * lc2 * g * cos(th1 + th2)
    weight = sp.Matrix([(m1 * lc1 + m2 * l1) * g * c1 + lower, lower])
    return true, list(mass * sp.Matrix([a1, a2]) + turn * sp.Matrix([w1, w2]) + weight - sp.Matrix([tau1, tau2]))


def spanish_energies():
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True)
    moving = half * ((m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2) * w1**2 + half * m2 * l2**2 * w2**2
    moving += (m2 * l2**2 + m2 * l1 * l2 * c2) * w1 * w2
    resting = m1 * g * l1 * s1 + m2 * g * (l1 * s1 + l2 * sin(th1 + th2))
    return true, lagrange(moving - resting, true)


# Three links and more

Q1, Q2, Q3 = sp.symbols("Q1 Q2 Q3")


def level(forces=None):
    return bobs((l1, m1), (l2, m2), (l3, m3), horizontal=True, forces=forces)


def level_lagrangian():
    true = level()
    moving = half * l1**2 * w1**2 * (m1 + m2 + m3) + half * l2**2 * w2**2 * (m2 + m3) + half * l3**2 * w3**2 * m3
    moving += (m2 + m3) * l1 * l2 * w1 * w2 * cos(th1 - th2)
    moving += m3 * l1 * l3 * w1 * w3 * cos(th1 - th3) + m3 * l2 * l3 * w2 * w3 * cos(th2 - th3)
    return true, lagrange(moving, true), {g: 0}


def level_rows():
    d12, d13, d23 = th1 - th2, th1 - th3, th2 - th3
    both, near, far = (m2 + m3) * l1 * l2, m3 * l2 * l3, m3 * l1 * l3
    one = (m1 + m2 + m3) * l1**2 * a1 + both * a2 * cos(d12) + far * a3 * cos(d13)
    one += both * w2**2 * sin(d12) + far * w3**2 * sin(d13)
    two = (m2 + m3) * l2**2 * a2 + both * a1 * cos(d12) + near * a3 * cos(d23)
    two += -both * w1**2 * sin(d12) - near * w3**2 * sin(d23)
    three = m3 * l3**2 * a3 + far * a1 * cos(d13) + near * a2 * cos(d23)
    three += -far * w1**2 * sin(d13) - near * w2**2 * sin(d23)
    return level({th1: Q1, th2: Q2, th3: Q3}), [one - Q1, two - Q2, three - Q3], {g: 0}


def tensions_index():
    """y points down; the tensions from the rows across, put into the rows along."""
    angles, rates, turns, lengths = (th1, th2, th3), (w1, w2, w3), (a1, a2, a3), (l1, l2, l3)
    across, down, right, below = [], [], sp.Integer(0), sp.Integer(0)
    for angle, v, a, length in zip(angles, rates, turns, lengths, strict=True):
        right = right + length * (a * cos(angle) - v**2 * sin(angle))
        below = below - length * (a * sin(angle) + v**2 * cos(angle))
        across.append(right)
        down.append(below)
    third_ = -m3 * across[2] / sin(th3)
    second = (third_ * sin(th3) - m2 * across[1]) / sin(th2)
    first = (second * sin(th2) - m1 * across[0]) / sin(th1)
    return bobs((l1, m1), (l2, m2), (l3, m3)), [
        m1 * down[0] + first * cos(th1) - second * cos(th2) - m1 * g,
        m2 * down[1] + second * cos(th2) - third_ * cos(th3) - m2 * g,
        m1 * down[2] + third_ * cos(th3) - m3 * g,
    ]


def many(number, equal=False):
    """A chain of point masses."""
    coordinates = [coordinate(f"q{i}") for i in range(number)]
    lengths = [l if equal else sp.Symbol(f"l{i}", positive=True) for i in range(number)]
    masses = [m if equal else sp.Symbol(f"m{i}", positive=True) for i in range(number)]
    bodies, right, up = [], sp.Integer(0), sp.Integer(0)
    for (angle, _, _), length, mass in zip(coordinates, lengths, masses, strict=True):
        right, up = right + length * sin(angle), up - length * cos(angle)
        bodies.append(Body(mass, right, up))
    return Mechanism(coordinates, bodies), lengths, masses


def sums_four():
    true, lengths, masses = many(4)
    printed = sp.Integer(0)
    for i in range(4):
        below = [(length, *place) for length, place in zip(lengths[: i + 1], true.coordinates[: i + 1], strict=True)]
        across = sum(length * v * cos(angle) for length, angle, v, _ in below)
        along = sum(length * v * sin(angle) for length, angle, v, _ in below)
        printed += half * masses[i] * (across**2 + along**2)
        printed += g * masses[i] * sum(length * cos(angle) for length, angle, _, _ in below)
    return true, lagrange(printed, true)


def five_loop():
    true, _, _ = many(5, equal=True)
    rows = []
    for angle, _, a in true.coordinates:
        others = [other for other, _, _ in true.coordinates if other != angle]
        rows.append(a + g / l * sin(angle) + sum(sin(angle - other) for other in others))
    return true, rows


# A cart and a pole


def portuguese_align():
    return cart_pole(I, forces={x: F - b * xd}), [
        (M + m) * xdd + b * xd + m * l * al * c - m * l * w**2 * s - F,
        (I + m * l**2) * al + m * g * l * s + m * l * xdd * c,
    ]


def portuguese_code():
    return cart_pole(I, forces={x: F - b * xd}), [
        (M + m) * xdd + b * xd + m * l * xdd * c - m * l * w**2 * s - F,
        (I + M * l**2) * al + m * g * l * s + m * l * xdd * c,
    ]


def dfrac_lagrangian():
    true = cart_pole(up=True)
    return true, lagrange(
        half * M * xd**2 + half * m * (xd**2 + 2 * l * xd * w * c + l**2 * w**2) - m * g * l * c, true
    )


def upright_zero():
    true = cart_pole(up=True)
    moving = half * M * xd**2 + half * m * ((xd + l * w * c) ** 2 + (-l * s * w) ** 2)
    return true, lagrange(moving - m * g * l * (1 - c), true)


def fishc_cases():
    return cart_pole(forces={x: F}), [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s - F,
        m * l * xdd * c + (M + m) * l * al + m * g * l * s,
    ]


def square_of_the_angle():
    """The cosine of the angle's square is one unknown number; the rows are wrong whatever it is."""
    d = 1 - rate2
    return cart_pole(forces={x: F}), [
        xdd - (l * m * s * w**2 + F + m * g * c * sin(x)) / (M + m * d),
        al + (l * m + c * s * w**2 + F * c + (M + m) * g * s) / (l * M + l * m * d),
    ]


def massless_fulcrum():
    true = cart_pole(potential=k * x**2 / 2, mass=sp.Integer(0))
    return true, [m * xdd + k * x + m * l * (al * c - w**2 * s), c * xdd + g * s + l * al]


def spanish_lagrangian():
    true = cart_pole(up=True, left=True)
    printed = half * (M + m) * xd**2 - m * l * xd * w * c + half * m * l**2 * w**2 - m * g * l * c
    return true, lagrange(printed, true)


def spanish_solved():
    below = M + m * s**2
    return cart_pole(up=True, left=True, forces={x: F}), [
        xdd - (F + m * l * s * (l * w**2 + g * c)) / below,
        al - (-F * c - m * l * w**2 * c * s - (M + m) * g * s) / (l * below),
    ]


def spanish_rod():
    """l is half the rod's length here; the notes' L is 2 l."""
    length = 2 * l
    return cart_pole(m * l**2 / 3, up=True, forces={x: F - b * xd}), [
        (M + m) * xdd + m * length / 2 * (al * c - w**2 * s) + b * xd - F,
        m * length**2 / 3 * al + m * length / 2 * xdd * c - m * g * length / 2 * s,
    ]


def underbraced_matrices():
    mass = sp.Matrix([[M + m, m * l * c], [m * l * c, I + m * l**2]])
    turn = sp.Matrix([[0, -m * l * w * s], [0, 0]])
    rows = mass * sp.Matrix([xdd, al]) + turn * sp.Matrix([xd, w]) + sp.Matrix([0, m * g * l * s]) - sp.Matrix([F, 0])
    return cart_pole(I, up=True, forces={x: F}), list(rows)


def numbered_list():
    return cart_pole(up=True, forces={x: F}), [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s - F,
        m * l**2 * al + m * l * xdd * c - m * g * l * s,
    ]


def textrm_sgn():
    """dry: the friction's force times the sign of the cart's rate, one unknown number."""
    true = cart_pole(m * l**2 / 3, up=True, forces={x: F - dry, th: -damp * w})
    pushed = c * (-F - m * l * w**2 * s + dry) / (M + m)
    return true, [
        al - (g * s + pushed - damp * w / (m * l)) / (l * (Rational(4, 3) - m * c**2 / (M + m))),
        xdd - (F + m * l * (w**2 * s - al * c) - dry) / (M + m),
    ]


def sympy_energies():
    true = cart_pole(m * l**2 / 3, up=True)
    moving = Rational(2, 3) * m * l**2 * w**2 + m * l * c * w * xd + (M + m) * xd**2 / 2
    return true, lagrange(moving - g * l * m * c, true)


def puffer_pointer():
    push = (F + m * l * w**2 * s) / (M + m)
    return cart_pole(m * l**2 / 3, up=True, forces={x: F}), [
        al - (g * s - c * push) / (l * (Rational(4, 3) - m * c**2 / (M + m))),
        xdd - (push - m * l * al * c / (M + m)),
    ]


# A cart with two poles, or with a chain


def shorthand_behind():
    true = bobs((l1, m1), (l2, m2), cart=M, forces={x: F})
    first = (m1 + m2) * l1
    mass = sp.Matrix(
        [
            [M + m1 + m2, first * c1, m2 * l2 * c2],
            [first * c1, first * l1, m2 * l1 * l2 * C],
            [m2 * l2 * c2, m2 * l1 * l2 * C, m2 * l2**2],
        ]
    )
    turn = sp.Matrix([-first * s1 * w1**2 - m2 * l2 * s2 * w2**2, m2 * l1 * l2 * S * w2**2, -m2 * l1 * l2 * S * w1**2])
    weight = sp.Matrix([0, first * g * s1, m2 * g * l2 * s2])
    return true, list(mass * sp.Matrix([xdd, a1, a2]) + turn + weight - sp.Matrix([F, 0, 0]))


def two_poles_upright():
    bodies = [
        Body(M, x, 0),
        Body(m1, x + l1 * s1, l1 * c1, I1, th1),
        Body(m2, x + l2 * s2, l2 * c2, I2, th2),
    ]
    true = Mechanism([CART, ONE, TWO], bodies, 0, {x: F})
    one = (M + m1 + m2) * xdd + m1 * l1 * a1 * c1 + m2 * l2 * a2 * c2 - m1 * l1 * w1**2 * s1 - m2 * l2 * w2**2 * s2
    return true, [
        one - F,
        m1 * l1 * xdd * c1 + (I1 + m1 * l1**2) * a1 + m1 * g * l1 * s1,
        m2 * l2 * xdd * c2 + (I2 + m2 * l2**2) * a2 + m2 * g * l2 * s2,
    ]


def full_length_inertia():
    true = chain([(l1, m1, lc1, I1), (l2, m2, lc2, I2)], up=True, cart=M)
    moving = half * (M + m1 + m2) * xd**2 + half * (m1 * lc1**2 + m2 * l1**2 + I1) * w1**2
    moving += half * (m2 * l2**2 + I2) * w2**2 + m2 * l1 * lc2 * C * w1 * w2
    moving += m2 * lc2 * c2 * xd * w2 + (m1 * lc1 + m2 * l1) * c1 * xd * w1
    return true, lagrange(moving - m1 * g * lc1 * c1 - m2 * g * (l1 * c1 + lc2 * c2), true)


# Springs


def momentum_boxed():
    """d/dt of m r² θ̇ by the chain rule."""
    return elastic(k * (r - r0) ** 2 / 2), [
        m * rdd - m * r * w**2 + k * (r - r0) - m * g * c,
        2 * m * r * rd * w + m * r**2 * al + m * g * r * s,
    ]


def sketch_letters():
    """r is the extension, l the length at rest."""
    true = Mechanism([RADIUS, ANGLE], [Body(m, (l + r) * s, -(l + r) * c)], k * r**2 / 2)
    return true, [rdd - ((l + r) * w**2 + g * c - k * r / m), al + (2 * rd * w + g * s) / (l + r)]


def two_springs(one, two, springs):
    bodies = [Body(m1, one * s1, -one * c1), Body(m2, one * s1 + two * s2, -one * c1 - two * c2)]
    return Mechanism([ONE, (r1, r1d, r1dd), TWO, (r2, r2d, r2dd)], bodies, springs)


RESTED = two_springs(r1, r2, k1 * (r1 - r01) ** 2 / 2 + k2 * (r2 - r02) ** 2 / 2)


def two_springs_parts():
    """r1 and r2 are the extensions, l the length of both at rest."""
    one, two = l + r1, l + r2
    true = two_springs(one, two, k1 * r1**2 / 2 + k2 * r2**2 / 2)
    moving = half * m1 * (r1d**2 + (one * w1) ** 2) + half * m2 * ((r2d + r1d * C) ** 2 + (r1d * S) ** 2)
    moving += half * m2 * ((two * w2 + one * w1 * C) ** 2 + (one * w1 * S) ** 2)
    resting = -m1 * g * one * c1 + half * k1 * r1**2 - m2 * g * (one * c1 + two * c2) + half * k2 * r2**2
    return true, lagrange(moving - resting, true)


def two_springs_apart():
    moving = half * m1 * (r1d**2 + r1 * w1**2) + half * m2 * (r2d**2 + r2 * w2**2)
    resting = -(m1 + m2) * g * r1 * c1 - m2 * g * r2 * c2 + half * k1 * (r1 - r01) ** 2 + half * k2 * (r2 - r02) ** 2
    return RESTED, lagrange(moving - resting, RESTED)


def two_springs_primes():
    return RESTED, [
        a1 + (2 * r1d * w1 + g * s1 + k2 / m1 * (r2 - r02) * S) / r1,
        a2 + (2 * r2d * w2 - k1 / m1 * (r1 - r01) * S) / r2,
        r1dd - (w1**2 * r1 + g * c1 - k1 / m1 * (r1 - r01) + k2 / m1 * (r2 - r02) * C),
        r2dd - (w2**2 * r2 - k2 / m2 * (r2 - r02) - k2 / m1 * (r2 - r02) + k1 / m1 * (r1 - r01) * C),
    ]


def rocket_rows():
    """A thruster of mass M at x, z; the rod's length is l."""
    bodies = [Body(M, x, z), Body(m, x + l / 2 * s, z + l / 2 * c, m * l**2 / 12, th)]
    true = Mechanism([CART, (z, zd, zdd), ANGLE], bodies, 0, {x: Q1, z: Q2, th: Q3})
    return true, [
        (M + m) * xdd + half * m * l * (al * c - w**2 * s) - Q1,
        (M + m) * zdd - half * m * l * (al * s + w**2 * c) + (M + m) * g - Q2,
        half * m * l * (xdd * c - zdd * s) + third * m * l**2 * al - half * m * g * l * s - Q3,
    ]


PROOFS = {
    "sp-boxed-inertia": boxed_inertia(),
    "sp-torque-first": torque_first(),
    "sp-mathrm-derivatives": mathrm_derivatives(),
    "sp-unicode-tau": unicode_tau(),
    "sp-plain-d2": plain_d2(),
    "sp-length-above": length_above(),
    "sp-macro-odd": plain_row(),
    "sp-french-states": plain_row(),
    "mv-undotted-height": undotted_height(),
    "mv-gathered-row": gathered_row(),
    "mv-pivot-subtracted": pivot_subtracted(),
    "mv-docstring-omega": docstring_omega(),
    "mv-damped-tuple": damped_tuple(),
    "mv-accelerated-cart": accelerated_cart(),
    "dp-combining-marks": divided_rows(),
    "dp-macro-od": known_solved(),
    "dp-square-brackets": square_brackets(),
    "dp-dotted-omegas": known_solved(),
    "dp-colon-equals": colon_equals(),
    "dp-bare-cos": bare_cos(),
    "dp-hamiltonian-arguments": hamiltonian_arguments(),
    "dp-momentum-twice": momentum_twice(),
    "dp-other-length": other_length(),
    "dp-damper-alone": damper_alone(),
    "dp-lattice-torques": lattice_torques(),
    "dp-greek-substitutions": greek_substitutions(),
    "dp-relative-unit": relative_unit(),
    "dp-asciimath-places": asciimath_places(),
    "dp-mass-of-the-other": mass_of_the_other(),
    "dp-damped-spanish": damped_spanish(),
    "dp-scilab-letters": scilab_letters(),
    "dp-elementwise-german": elementwise_german(),
    "dp-french-odeint": french_odeint(),
    "ac-mathematica-signs": mathematica_signs(),
    "ac-drake-class": drake_class(),
    "dr-equal-rods-matlab": equal_rods_matlab(),
    "dr-cauchy-handles": cauchy_handles(),
    "rr-two-boxes": two_boxes(),
    "rr-entries-bulleted": entries_bulleted(),
    "rr-spanish-energies": spanish_energies(),
    "tp-level-lagrangian": level_lagrangian(),
    "tp-level-rows": level_rows(),
    "tp-tensions-index": tensions_index(),
    "np-sums-four": sums_four(),
    "np-five-loop": five_loop(),
    "cp-portuguese-align": portuguese_align(),
    "cp-portuguese-code": portuguese_code(),
    "cp-dfrac-lagrangian": dfrac_lagrangian(),
    "cp-upright-zero": upright_zero(),
    "cp-fishc-cases": fishc_cases(),
    "cp-square-of-the-angle": square_of_the_angle(),
    "cp-massless-fulcrum": massless_fulcrum(),
    "cp-spanish-lagrangian": spanish_lagrangian(),
    "cp-spanish-solved": spanish_solved(),
    "cp-spanish-rod": spanish_rod(),
    "cp-underbraced-matrices": underbraced_matrices(),
    "cp-numbered-list": numbered_list(),
    "cp-textrm-sgn": textrm_sgn(),
    "cp-sympy-energies": sympy_energies(),
    "cp-puffer-pointer": puffer_pointer(),
    "dc-shorthand-behind": shorthand_behind(),
    "dc-two-poles-upright": two_poles_upright(),
    "dc-full-length-inertia": full_length_inertia(),
    "el-momentum-boxed": momentum_boxed(),
    "el-sketch-letters": sketch_letters(),
    "el-two-springs-parts": two_springs_parts(),
    "el-two-springs-apart": two_springs_apart(),
    "el-two-springs-primes": two_springs_primes(),
    "pl-rocket-rows": rocket_rows(),
}
