"""What the programs of this folder compute, entered by hand from their text, and what each describes.

The letters here are the mechanisms' own. A program that inverts a matrix, or eliminates, has its rows before that.
Run as a script, it compares each verdict of index.toml with what follows from positions alone.
"""

from pathlib import Path

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
from prove_sixth import RESTED, A, k1, k2, many, moved, r01, r02, r1, r2
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange, momenta, rate
from verdicts import print_verdicts

half = Rational(1, 2)
BOBS = bobs((l1, m1), (l2, m2))
d = th1 - th2
S, C = sin(d), cos(d)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
both = m1 + m2
eta0, square, tau3 = sp.symbols("eta0 square tau3")
mr, md, radius = sp.symbols("mr md radius", positive=True)


def solved(mass, force, accelerations):
    """Rows of mass · accelerations = force."""
    return list(sp.Matrix(mass) * sp.Matrix(accelerations) - sp.Matrix(force))


def columns(true):
    """Angles, rates and accelerations, each by themselves."""
    return zip(*true.coordinates, strict=True)


# Many links


def counted_below():
    true, _, _ = many(3, equal=True)
    q, v, a = map(list, columns(true))
    lhs, rhs = sp.zeros(3, 3), []
    for i in range(3):
        total = sp.Integer(0)
        for j in range(3):
            below = 3 - max(i, j)
            total -= below * sin(q[i] - q[j]) * v[j] ** 2
            lhs[i, j] = below * cos(q[i] - q[j])
        rhs.append(total - g / l * (3 - i) * sin(q[i]))
    return true, solved(lhs, rhs, a)


def one_based():
    true, lengths, masses = many(3)
    q, v, a = map(list, columns(true))
    inertia, turn, weight = sp.zeros(3, 3), sp.zeros(3, 1), sp.zeros(3, 1)
    for i in range(3):
        for j in range(3):
            carried = sum(masses[max(i, j) :]) * lengths[i] * lengths[j]
            inertia[i, j] = carried * cos(q[i] - q[j])
            turn[i] += carried * sin(q[i] - q[j]) * v[j] ** 2
        weight[i] = sum(masses[i:]) * g * lengths[i] * sin(q[i])
    return true, solved(inertia, -(turn + weight), a)


def first_masses():
    """The length of each link is one third."""
    true, lengths, masses = many(3)
    q, v, a = map(list, columns(true))
    n, table = 3, sp.zeros(3, 3)
    for i in range(n):
        for j in range(n):
            table[i, j] = sum(masses[: n - i]) if j <= i else sum(masses[j:])
    lhs = sp.Matrix(n, n, lambda i, j: cos(q[i] - q[j]) * table[i, j])
    turn = sp.Matrix(n, n, lambda i, j: sin(q[i] - q[j]) * table[i, j]) * sp.Matrix([v[j] ** 2 / n for j in range(n)])
    gravity = sp.Matrix([-g * table[i, i] * sin(q[i]) for i in range(n)])
    return true, solved(lhs / n, gravity - turn, a), dict.fromkeys(lengths, Rational(1, 3))


def reduced():
    true, lengths, masses = many(3)
    q, v, a = map(list, columns(true))
    lhs, rhs = sp.zeros(3, 3), []
    for i in range(3):
        total = -g * sum(masses[i:]) * sin(q[i])
        for j in range(3):
            hanging = sum(masses[max(i, j) :])
            lhs[i, j] = hanging * lengths[j] * cos(q[i] - q[j])
            total -= hanging * lengths[j] * v[j] ** 2 * sin(q[i] - q[j])
        rhs.append(total)
    return true, solved(lhs, rhs, a)


def mathematica_sums():
    true, lengths, masses = many(3)
    q = [angle for angle, _, _ in true.coordinates]
    energy = sp.Integer(0)
    for upto in range(3):
        right = sum(lengths[i] * sin(q[i]) for i in range(upto + 1))
        up = -sum(lengths[i] * cos(q[i]) for i in range(upto + 1))
        energy += half * masses[upto] * (rate(right, true) ** 2 + rate(up, true) ** 2) - masses[upto] * g * up
    return true, lagrange(energy, true)


def three_methods():
    """Masses and lengths are one."""
    below = -10 + 4 * cos(2 * th1 - 2 * th2) + 2 * cos(2 * th2 - 2 * th3)
    one = 10 * g * s1 + 4 * g * sin(th1 - 2 * th2) - g * sin(th1 + 2 * th2 - 2 * th3) - g * sin(th1 - 2 * th2 + 2 * th3)
    one += 4 * w1**2 * sin(2 * th1 - 2 * th2) + 8 * w2**2 * S
    one += 2 * w3**2 * sin(th1 - th3) + 2 * w3**2 * sin(th1 - 2 * th2 + th3)
    two = -7 * g * sin(2 * th1 - th2) + 7 * g * s2 + g * sin(th2 - 2 * th3) + g * sin(2 * th1 + th2 - 2 * th3)
    two += 2 * w1**2 * sin(th1 + th2 - 2 * th3) - 14 * w1**2 * S
    two += 2 * w2**2 * sin(2 * th2 - 2 * th3) - 4 * w2**2 * sin(2 * th1 - 2 * th2)
    two += 6 * w3**2 * sin(th2 - th3) - 2 * w3**2 * sin(2 * th1 - th2 - th3)
    three = g * cos(2 * th1 - th2) + g * c2 + 2 * w1**2 * C + 2 * w2**2 + w3**2 * cos(th2 - th3)
    three *= -2 * sin(th2 - th3)
    last = -5 + 2 * cos(2 * th1 - 2 * th2) + cos(2 * th2 - 2 * th3)
    return bobs((1, 1), (1, 1), (1, 1)), [a1 - one / below, a2 - two / below, a3 - three / last]


def gauss_jordan():
    q, v, a = [th1, th2, th3], [w1, w2, w3], [a1, a2, a3]
    length, mass = [l1, l2, l3], [m1, m2, m3]
    carried = {(0, 1): m2 / 2 + m3, (0, 2): m3 / 2, (1, 2): m3 / 2}
    lhs, turn = sp.diag(m1 / 3 + m2 + m3, m2 / 3 + m3, m3 / 3), sp.zeros(3, 3)
    for (i, j), value in carried.items():
        lhs[i, j] = lhs[j, i] = value * cos(q[i] - q[j])
        turn[i, j], turn[j, i] = -value * sin(q[i] - q[j]), value * sin(q[i] - q[j])
    force = [-(mass[i] / 2 + sum(mass[i + 1 :])) * g * sin(q[i]) for i in range(3)]
    for i in range(3):
        force[i] += sum(turn[i, j] * length[j] * v[j] ** 2 for j in range(3))
    unknowns = [length[i] * a[i] for i in range(3)]
    return rods((l1, m1), (l2, m2), (l3, m3)), solved(lhs, force, unknowns)


# Two bobs, two rods


def glsl_helpers():
    p_1, q_1, r_1 = both * l1, m2 * l2 * C, -(w2**2) * l2 * m2 * S - g * both * s1
    p_2, q_2, r_2 = m2 * l1 * C, m2 * l2, w1**2 * l1 * m2 * S - g * m2 * s2
    lower = (p_2 * r_1 - p_1 * r_2) / (p_2 * q_1 - p_1 * q_2)
    return BOBS, [a1 - (r_1 - q_1 * lower) / p_1, a2 - lower]


def vec2_ratio():
    kx, ky = l2 / l1 * m2 / both * C, l1 / l2 * C
    fx = -l2 / l1 * m2 / both * w2**2 * S - g / l1 * s1
    fy = l2 / l2 * w1**2 * S - g / l2 * s2
    below = 1 - kx * ky
    return BOBS, [a1 - (fx - kx * fy) / below, a2 - (-ky * fx + fy) / below]


def parameter_array():
    one = m2 * C * (l1 * S * w1**2 - g * s2) + m2 * l2 * S * w2**2 + both * g * s1
    two = m2 * l2 * C * S * w2**2 + both * l1 * S * w1**2 + both * g * C * s1 - both * g * s2
    return BOBS, [a1 - one / (m2 * l1 * C**2 - both * l1), a2 - two / (both * l2 - m2 * l2 * C**2)]


def known_solved(below):
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * both + g * both * c1 + w2**2 * l2 * m2 * C)
    return [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def one_line():
    """Masses and lengths are one."""
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - th2)
    return BOBS, known_solved(below), {m1: 1, m2: 1, l1: 1, l2: 1}


def julia_callable():
    return BOBS, known_solved(2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2))


def plugin_columns():
    flat = [both * l1, m2 * l1 * C, m2 * l2 * C, m2 * l2]
    mass = sp.Matrix(2, 2, lambda i, j: flat[i + 2 * j])
    turn = sp.Matrix([m2 * l2 * w2**2 * S, -m2 * l1 * w1**2 * S])
    return BOBS, solved(mass, sp.Matrix([-both * g * s1, -m2 * g * s2]) - turn, [a1, a2])


def lua_global_names():
    ratio = 1 + m1 / m2
    one = g * m1 * s1 + g * m2 * sin(th1 - 2 * th2) / 2 + g * m2 * s1 / 2
    one += l1 * m2 * sin(2 * th1 - 2 * th2) * w1**2 / 2 + l2 * m2 * S * w2**2
    two = g * ratio * (s1 * C - s2) + (ratio * l1 * w1**2 + l2 * w2**2 * C) * S
    return BOBS, [a1 + one / (l1 * (m1 - m2 * C**2 + m2)), a2 - two / (l2 * (ratio - C**2))]


def go_compound():
    true = rods((l1, m1), (l2, m2))
    (p1, p2), (rate1, rate2) = momenta(true)
    weight, q = m1 + 3 * m2, l1 / l2
    below = 4 * weight - 9 * m2 * C**2
    rates = [
        w1 - 6 / l1**2 * (2 * p1 - 3 * q * C * p2) / below,
        w2 - 6 / (m2 * l2**2) * (2 * p2 * weight - 3 * m2 / q * C * p1) / below,
    ]
    mixed = half * m2 * l1 * l2 * w1 * w2 * S
    rows = [rate1 + mixed + (m1 / 2 + m2) * g * l1 * s1, rate2 - mixed + m2 * g * l2 * s2 / 2]
    return true, rows, rates


def go_closures():
    """What the two rates are, solved for the momenta; their change put beside the momenta's own."""
    p1, p2 = sp.symbols("p1 p2")
    below = m1 + m2 * S**2
    one = (p1 * l2 - l1 * p2 * C) / (m1 * l1**2 * l2 * below)
    two = (l1 * p2 * both - l2 * m2 * p1 * C) / (m2 * l1 * l2**2 * below)
    first = p1 * p2 * S / (l1 * l2 * below)
    second = m2 * l2**2 * p1**2 + both * l1**2 * p2**2 - 2 * m2 * l1 * l2 * p1 * p2 * C
    second *= sin(2 * th1 - 2 * th2) / (2 * l1**2 * l2**2 * below**2)
    matrix = sp.Matrix([[sp.diff(v, p) for p in (p1, p2)] for v in (one, two)])
    meant = matrix.inv() * sp.Matrix([w1, w2])
    put = {p1: meant[0], p2: meant[1]}
    changes = [-both * g * l1 * s1 - first + second, -m2 * g * l2 * s2 + first - second]
    return BOBS, [rate(meant[i], BOBS) - changes[i].subs(put) for i in range(2)]


def global_momenta():
    """The rates are those of the momenta that are meant."""
    (p1, p2), (rate1, rate2) = momenta(BOBS)
    below = m1 + m2 * S**2
    first = p1 * p2 * S / (l1 * l2 * below)
    second = l2**2 * m2 * p1**2 + l1**2 * both * p2**2 - l1 * l2 * m2 * p1 * p2 * C
    second *= sin(2 * th1 - 2 * th2) / (2 * l1**2 * l2**2 * below) ** 2
    rates = [
        w1 - (l2 * p1 - l1 * p2 * C) / (l1**2 * l2 * below),
        w2 - (l1 * both * p2 - l2 * m2 * p1 * C) / (l1 * l2**2 * m2 * below),
    ]
    return BOBS, [rate1 + both * g * l1 * s1 + first - second, rate2 + m2 * g * l2 * s2 - first + second], rates


def lengths_for_masses():
    return BOBS, known_solved(2 * l1 + l2 - l2 * cos(2 * th1 - 2 * th2))


def jax_energies():
    moving = half * m1 * (l1 * w1) ** 2 + half * m2 * ((l1 * w1) ** 2 + (l2 * w2) ** 2 + 2 * l1 * l2 * w1 * w2 * C)
    up1 = -l1 * c1
    return BOBS, lagrange(moving - (m1 * g * up1 + m2 * g * (up1 - l2 * c2)), BOBS)


def maxima_loops():
    true = bobs((l, m), (l, m))
    places = [l * s1, -l * c1, l * s1 + l * s2, -l * c1 - l * c2]
    moving = sum(half * m * rate(place, true) ** 2 for place in places)
    return true, lagrange(moving - (m * g * places[1] + m * g * places[3]), true)


def fortran77_common():
    delta = th2 - th1
    sd, cd = sin(delta), cos(delta)
    below = both * l1 - m2 * l1 * cd**2
    one = m2 * l1 * w1**2 * sd * cd + m2 * g * s2 * cd + m2 * l2 * w2**2 * sd - both * g * s1
    two = -m2 * l2 * w2**2 * sd * cd + both * g * s1 * cd - both * l1 * w1**2 * sd - both * g * s2
    return BOBS, [a1 - one / below, a2 - two / (l2 / l1 * below)]


def mixed_units():
    low = b2 * (w2 - w1)
    true = bobs((l1, m1), (l2, m2), forces={th1: -b1 * w1 + low, th2: -low})
    one = -m2 * l1 * l2 * w2**2 * S - both * g * l1 * s1 - b1 * w1 + low
    two = m2 * l1 * l2 * w1**2 * S - m2 * g * l2 * s2 - low
    j11, j12, j22 = both * l1**2, m2 * l1 * l2 * C, m2 * l2**2
    det = j11 * j22 - j12 * j12
    return true, [a1 - (one * j22 - j12 * two) / det, a2 - (j11 * two - one * j12) / det]


# Arms, acrobot, pendubot


def small_structs():
    true = links(False, relative=True, horizontal=True)
    own2, cc = m2 * lc2**2 + I2, c2 * m2 * l1 * lc2
    mixed = own2 + cc
    h = s2 * m2 * l1 * lc2
    mass = sp.Matrix([[m1 * lc1**2 + m2 * l1**2 + own2 + I1 + 2 * cc, mixed], [mixed, own2]])
    turn = sp.Matrix([[-h * w2, -h * (w1 + w2)], [h * w1, 0]]) * sp.Matrix([w1, w2])
    low = m2 * lc2 * g * cos(th1 + th2)
    weight = sp.Matrix([(m1 * lc1 + m2 * l1) * g * c1 + low, low])
    return true, solved(mass, -(turn + weight), [a1, a2])


def torch_stack():
    three = Rational(3, 4)
    true = chain(
        [(l1, m1, l1 / 2, three * m1 * l1**2), (l2, m2, l2 / 2, three * m2 * l2**2)], relative=True, forces={th2: u}
    )
    j1, j2, h = m1 * l1**2, m2 * l2**2, m2 * l1 * l2 / 2
    mass = sp.Matrix([[j1 + j2 + m2 * l1**2 + 2 * h * c2, j2 + h * c2], [j2 + h * c2, j2]])
    turn = sp.Matrix([[-2 * h * s2 * w2, -h * s2 * w2], [h * s2 * w1, 0]]) * sp.Matrix([w1, w2])
    s12 = sin(th1 + th2)
    weight = sp.Matrix([-m1 * g * l1 / 2 * s1 - m2 * g * (l1 * s1 + l2 / 2 * s12), -m2 * g * l2 / 2 * s12])
    return true, solved(mass, weight + sp.Matrix([0, u]) - turn, [a1, a2])


def lost_rate():
    true = links(False, relative=True, horizontal=True, forces={th1: tau1})
    t1, t2, t3 = m1 * lc1**2 + m2 * l1**2 + I1, m2 * lc2**2 + I2, m2 * l1 * lc2
    mass = sp.Matrix([[t1 + t2 + 2 * t3 * c2, t2 + t3 * c2], [t2 + t3 * c2, t2]])
    turn = t3 * s2 * sp.Matrix([[-w2, -w2], [w1, 0]]) * sp.Matrix([w1, w2])
    low = m2 * lc2 * g * cos(th1 + th2)
    weight = sp.Matrix([(m1 * lc1 + m2 * l1) * g * c1 + low, low])
    return true, solved(mass, sp.Matrix([tau1, 0]) - turn - weight, [a1, a2])


def julia_sigma():
    true = bobs((l1, m1), (l2, m2), relative=True, forces={th1: tau1 - b1 * w1, th2: tau2 - b2 * w2})
    m12, h = m2 * l2**2 + m2 * l1 * l2 * c2, -m2 * l1 * l2 * s2
    mass = sp.Matrix([[both * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2, m12], [m12, m2 * l2**2]])
    turn = sp.Matrix([[h * w2, h * (w1 + w2)], [-h * w1, 0]]) * sp.Matrix([w1, w2])
    low = m2 * l2 * g * sin(th1 + th2)
    weight = sp.Matrix([both * l1 * g * s1 + low, low])
    return true, solved(mass, sp.Matrix([tau1 - b1 * w1, tau2 - b2 * w2]) - turn - weight, [a1, a2])


def matlab_jacobians():
    true = rods((l1, m1), (l2, m2), (l3, m3), relative=True, horizontal=True, forces={th1: tau1, th2: tau2, th3: tau3})
    turns = [th1, th1 + th2, th1 + th2 + th3]
    speeds = [w1, w1 + w2, w1 + w2 + w3]
    across = [sp.Matrix([-sin(q), cos(q)]) for q in turns]
    along = [sp.Matrix([cos(q), sin(q)]) for q in turns]
    none = sp.Matrix([0, 0])
    low, high = l2 * across[1] + l3 / 2 * across[2], l3 / 2 * across[2]
    jv = [
        sp.Matrix.hstack(l1 / 2 * across[0], none, none),
        sp.Matrix.hstack(l1 * across[0] + l2 / 2 * across[1], l2 / 2 * across[1], none),
        sp.Matrix.hstack(l1 * across[0] + low, low, high),
    ]
    jw = [sp.Matrix([[1, 0, 0]]), sp.Matrix([[1, 1, 0]]), sp.Matrix([[1, 1, 1]])]
    pulls = [
        -l1 / 2 * speeds[0] ** 2 * along[0],
        -l1 * speeds[0] ** 2 * along[0] - l2 / 2 * speeds[1] ** 2 * along[1],
        -l1 * speeds[0] ** 2 * along[0] - l2 * speeds[1] ** 2 * along[1] - l3 / 2 * speeds[2] ** 2 * along[2],
    ]
    mass, turn, weight = sp.zeros(3, 3), sp.zeros(3, 1), sp.zeros(3, 1)
    for bar, inertia, j, spin, pull in zip(
        (m1, m2, m3), (m1 * l1**2 / 12, m2 * l2**2 / 12, m3 * l3**2 / 12), jv, jw, pulls, strict=True
    ):
        mass += bar * j.T * j + spin.T * spin * inertia
        turn += bar * j.T * pull
        weight += (bar * g * j.row(1)).T
    return true, solved(mass, sp.Matrix([tau1, tau2, tau3]) - turn - weight, [a1, a2, a3])


# A cart and a pole


def static_arrays():
    mass = sp.Matrix([[M + m, m * l * c], [m * l * c, m * l**2]])
    turn = sp.Matrix([[0, -m * w * l * s], [0, 0]]) * sp.Matrix([xd, w])
    force = -(turn + sp.Matrix([0, m * g * l * s]) - sp.Matrix([F, 0]))
    return cart_pole(forces={x: F}), solved(mass, force, [xdd, al])


def casadi_config():
    return cart_pole(forces={x: F}), [
        xdd - (l * m * s * w**2 + F + m * g * c * s) / (M + m * (1 - c**2)),
        al + (l * m * c * s * w**2 + F * c + (M + m) * g * s) / (l * M + l * m * (1 - c**2)),
    ]


def mathematica_functions():
    return cart_pole(up=True, forces={x: F - b * xd}), [
        (M + m) * xdd + b * xd + m * l * al * c - m * l * w**2 * s - F,
        m * l**2 * al + m * l * xdd * c - m * g * l * s,
    ]


def other_rates():
    """square: the angle's square, one unknown number; the rows are wrong whatever it is."""
    above = g * s * (M + m) - (F + m * l * square * s) * c
    return cart_pole(m * l**2 / 3, up=True, forces={x: F}), [
        al - above / (Rational(4, 3) * l * (M + m) - m * l * c**2),
        xdd - (F - m * l * (al * c - xd**2 * s)) / (M + m),
    ]


def csharp_seven():
    below = 7 * (M + m) - 3 * m * c**2
    return cart_pole(4 * m * l**2 / 3, up=True, forces={x: F}), [
        al - (3 * g * (M + m) * s - 3 * c * (F + w**2 * l * m * s)) / (l * below),
        xdd - (7 * F + m * (7 * w**2 * l - 3 * g * c) * s) / below,
    ]


def mass_of_the_cart():
    return cart_pole(forces={x: F, th: tau}), [
        xdd - (F + l * m * (s * w**2 - c * al)) / (M + m),
        al - (tau - l * (g * M * s + m * c * xdd)) / (l**2 * m),
    ]


def mx_uniform():
    total = M + m
    return cart_pole(m * l**2 / 3, up=True, forces={x: F}), [
        al - (g * s - c * (F + m * l * w**2 * s) / total) / (l * (Rational(4, 3) - m * c**2 / total)),
        xdd - (F + m * l * (w**2 * s - al * c)) / total,
    ]


def desolve_friction():
    h = l / 2
    true = cart_pole(m * l**2 / 12, up=True, forces={x: F - b1 * xd, th: -b2 * w}, arm=h)
    mass = sp.Matrix([[M + m, m * h * c], [m * h * c, m * l**2 / 3]])
    return true, solved(mass, [F - b1 * xd + m * h * w**2 * s, m * g * h * s - b2 * w], [xdd, al])


# A cart with two poles


def processing_switch():
    low = b2 * (w1 - w2)
    true = chain(
        [(l1, m1, lc1, I1), (l2, m2, lc2, I2)],
        up=True,
        cart=M,
        forces={x: u - eta0 * xd, th1: -b1 * w1 - low, th2: low},
    )
    total, h1, h2 = M + m1 + m2, m1 * lc1 + m2 * l1, m2 * lc2
    j1, j2, mixed = m1 * lc1**2 + m2 * l1**2 + I1, m2 * lc2**2 + I2, m2 * l1 * lc2
    n0 = u - xd * eta0 + h1 * s1 * w1**2 + h2 * s2 * w2**2
    n1 = -w1 * b1 - low - mixed * S * w2**2 + h1 * g * s1
    n2 = low + mixed * S * w1**2 + h2 * g * s2
    p, q, o = h1 * c1, h2 * c2, mixed * C
    det = total * j1 * j2 + 2 * p * q * o - p**2 * j2 - total * o**2 - q**2 * j1
    return true, [
        xdd - (n0 * (j1 * j2 - o**2) + n1 * (q * o - p * j2) + n2 * (p * o - q * j1)) / det,
        a1 - (n0 * (q * o - p * j2) + n1 * (total * j2 - q**2) + n2 * (p * q - total * o)) / det,
        a2 - (n0 * (p * o - q * j1) + n1 * (p * q - total * o) + n2 * (total * j1 - p**2)) / det,
    ]


def leaning_left():
    low = b2 * (w2 - w1)
    upper, lower = (x - l / 2 * s1, l / 2 * c1), (x - l * s1 - l / 2 * s2, l * c1 + l / 2 * c2)
    bodies = [Body(M, x, 0), Body(m, *upper), Body(m, *lower)]
    true = Mechanism([CART, ONE, TWO], bodies, 0, {x: F - b1 * xd, th1: -b2 * w1 + low, th2: -low})
    n = Rational(3, 2) * m * l
    mass = sp.Matrix(
        [
            [M + 2 * m, -n * c1, -m * l * c2 / 2],
            [-n * c1, Rational(5, 4) * m * l**2, m * l**2 * C / 2],
            [-m * l * c2 / 2, m * l**2 * C / 2, m * l**2 / 4],
        ]
    )
    force = [
        F - n * w1**2 * s1 - m * l * w2**2 * s2 / 2,
        n * g * s1 - m * l**2 * w2**2 * S / 2,
        m * g * l * s2 / 2 + m * l**2 * w1**2 * S / 2,
    ]
    return true, solved(mass, force, [xdd + b1 * xd, a1 + b2 * w1, a2 + b2 * w2])


def sympy_jacobians():
    parts = [(l1, m1, l1 / 2, 0), (l2, m2, l2 / 2, 0)]
    true = chain(parts, relative=True, horizontal=True, cart=M, forces={x: F})
    places = [(x, sp.Integer(0)), (x + l1 / 2 * c1, l1 / 2 * s1)]
    places.append((x + l1 * c1 + l2 / 2 * cos(th1 + th2), l1 * s1 + l2 / 2 * sin(th1 + th2)))
    energy = sum(
        mass * (rate(px, true) ** 2 + rate(py, true) ** 2) / 2
        for mass, (px, py) in zip((M, m1, m2), places, strict=True)
    )
    return true, lagrange(energy - m1 * g * places[1][1] - m2 * g * places[2][1], true)


def effective_masses():
    """l1 and l2 are half the poles' lengths; the poles hang at zero."""
    bodies = [
        Body(M, x, 0),
        Body(m1, x + l1 * s1, -l1 * c1, m1 * l1**2 / 3, th1),
        Body(m2, x + l2 * s2, -l2 * c2, m2 * l2**2 / 3, th2),
    ]
    q = Rational(3, 4)
    force = F + m1 * l1 * w1**2 * s1 + q * m1 * c1 * g * s1 + m2 * l2 * w2**2 * s2 + q * m2 * c2 * g * s2
    mass = M + m1 * (1 - q * c1**2) + m2 * (1 - q * c2**2)
    return Mechanism([CART, ONE, TWO], bodies, 0, {x: F}), [
        xdd - force / mass,
        a1 + q * (xdd * c1 + g * s1) / l1,
        a2 + q * (xdd * c2 + g * s2) / l2,
    ]


# One pendulum, springs, supports, a wheel


def rest_length():
    """r is the stretch, l the length at rest."""
    true = Mechanism([RADIUS, ANGLE], [Body(m, (l + r) * s, -(l + r) * c)], k * r**2 / 2)
    return true, [al - (-2 * rd * w - g * s) / (r + l), rdd - (-r * k / m + r * w**2 + l * w**2 + g * c)]


def lost_two():
    return elastic(k * (r - r0) ** 2 / 2), [
        rdd - (r * w**2 - k / m * (r - r0) + g * c),
        al + (g * s + rd * w) / r,
    ]


def maxima_two_springs():
    """Both heights are counted downwards."""
    ax, ay = r1 * s1, r1 * c1
    bx, by = ax + r2 * s2, ay + r2 * c2
    one = half * m1 * (rate(ax, RESTED) ** 2 + rate(ay, RESTED) ** 2) + m1 * g * ay - k1 / 2 * (r1 - r01) ** 2
    two = half * m2 * (rate(bx, RESTED) ** 2 + rate(by, RESTED) ** 2) + m2 * g * by - k2 / 2 * (r2 - r02) ** 2
    return RESTED, lagrange(one + two, RESTED)


def swift_labels():
    return pendulum(forces={th: -b * m * l**2 * w}), [al + g / l * s + b * w]


def mass_kept():
    return pendulum(), [al + m * g / l * s]


def java_constants():
    return pendulum(forces={th: tau - b * w}), [al + g / l * s + b / (m * l**2) * w - tau / (m * l**2)]


def rod_and_disk():
    """The wheel of radius at the rod's end is fixed to it."""
    inertia, moment = mr * l**2 / 3 + md * l**2 + md * radius**2 / 2, mr * l / 2 + md * l
    bodies = [
        Body(mr, l / 2 * s, -l / 2 * c, mr * l**2 / 12, th),
        Body(md, l * s, -l * c, md * radius**2 / 2, th),
    ]
    return Mechanism([ANGLE], bodies, 0, {th: -b * w}), [inertia * al + b * w + moment * g * s]


def gsl_reduced():
    """Of y = sin(Ωτ) / 100 the acceleration is A = -Ω² sin(Ωτ) / 100."""
    return moved(up=True), [al + (1 + A) * s], {m: 1, l: 1, g: 1}


def trolley():
    return moved(right=True, forces={th: -b * w}), [al + A * c / l + g / l * s + b * w / (m * l**2)]


def data_class():
    """The wheel sits at the pole's end, l1 from the pivot."""
    true = chain(
        [(l1, m1, lc1, I1), (0, m2, 0, I2)], relative=True, up=True, forces={th1: -b1 * w1, th2: tau - b2 * w2}
    )
    inertia, lever, on_wheel = I1 + m1 * lc1**2 + m2 * l1**2, m1 * lc1 + m2 * l1, tau - b2 * w2
    tilt = (lever * g * s1 - b1 * w1 - on_wheel) / inertia
    return true, [a1 - tilt, a2 - (on_wheel / I2 - tilt)]


PROOFS = {
    "np-csharp-counted-below": counted_below(),
    "np-rust-one-based": one_based(),
    "np-python-first-masses": first_masses(),
    "np-javascript-reduce": reduced(),
    "tp-mathematica-sums": mathematica_sums(),
    "tp-java-three-methods": three_methods(),
    "tp-cpp-gauss-jordan": gauss_jordan(),
    "dp-glsl-helpers": glsl_helpers(),
    "dp-glsl-vec2-ratio": vec2_ratio(),
    "dp-cpp-parameter-array": parameter_array(),
    "dp-python-one-line": one_line(),
    "dp-julia-callable": julia_callable(),
    "dp-c-plugin-columns": plugin_columns(),
    "dp-lua-global-names": lua_global_names(),
    "dr-go-compound": go_compound(),
    "dp-go-closures": go_closures(),
    "dp-matlab-global-momenta": global_momenta(),
    "dp-rust-lengths-for-masses": lengths_for_masses(),
    "dp-jax-energies": jax_energies(),
    "dp-maxima-loops": maxima_loops(),
    "dp-fortran77-common": fortran77_common(),
    "dp-numba-mixed-units": mixed_units(),
    "arm-cpp-small-structs": small_structs(),
    "ac-torch-stack": torch_stack(),
    "pb-octave-lost-rate": lost_rate(),
    "arm-julia-sigma": julia_sigma(),
    "arm-matlab-jacobians": matlab_jacobians(),
    "cp-julia-static-arrays": static_arrays(),
    "cp-matlab-casadi-config": casadi_config(),
    "cp-mathematica-functions": mathematica_functions(),
    "cp-python-other-rates": other_rates(),
    "cp-csharp-seven": csharp_seven(),
    "cp-java-mass-of-the-cart": mass_of_the_cart(),
    "cp-casadi-mx-uniform": mx_uniform(),
    "cp-r-desolve-friction": desolve_friction(),
    "dc-processing-switch": processing_switch(),
    "dc-matlab-leaning-left": leaning_left(),
    "dc-sympy-jacobians": sympy_jacobians(),
    "dc-cpp-effective-masses": effective_masses(),
    "el-python-rest-length": rest_length(),
    "el-typescript-lost-two": lost_two(),
    "el-maxima-two-springs": maxima_two_springs(),
    "sp-swift-labels": swift_labels(),
    "sp-python-mass-kept": mass_kept(),
    "sp-java-constants": java_constants(),
    "sp-modelica-rod-and-disk": rod_and_disk(),
    "mv-c-gsl-reduced": gsl_reduced(),
    "mv-typescript-trolley": trolley(),
    "rw-kotlin-data-class": data_class(),
}


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
