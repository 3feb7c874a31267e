"""What the derivations of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's ℓ, φ, q_1, M_c are l, th1, th1, M. A support that is moved is at X
beside, Y above its rest; V, U are its rates, A, B its accelerations. `python prove_seventh.py` prints every verdict.
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
    THREE,
    TWO,
    WHEEL,
    F,
    I,
    M,
    a1,
    a2,
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
    l3,
    lc1,
    lc2,
    links,
    m,
    m1,
    m2,
    pendulum,
    ph,
    phd,
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
from truth import Body, Mechanism, compare, coordinate, lagrange, momenta
from verdicts import print_verdicts, right_in

half = Rational(1, 2)
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
X, Y, V, U, A, B, d, D, J, Omega = sp.symbols("X Y V U A B d D J Omega")
k1, k2, delta, mu, omega, tension1, tension2 = sp.symbols("k1 k2 delta mu omega tension1 tension2")
BOBS = bobs((l1, m1), (l2, m2))
UPRIGHT = cart_pole(up=True)
PUSHED = cart_pole(up=True, forces={x: F})


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# A cart and a pole


def escaped_energies():
    across, along = xd + l * w * c, -l * w * s
    return UPRIGHT, lagrange(half * M * xd**2 + half * m * (across**2 + along**2) - m * g * l * c, UPRIGHT)


def rows_of_pole():
    return PUSHED, [
        (M + m) * xdd + m * l * (al * c - w**2 * s) - F,
        m * l * xdd * c + m * l**2 * al - m * g * l * s,
    ]


def height_without_length():
    moving = half * (M * xd**2 + m * ((xd + l * w * c) ** 2 + (l * w * s) ** 2))
    return UPRIGHT, lagrange(moving - g * m * c, UPRIGHT)


def bold_terms():
    mass = [[M + m, m * l * c], [m * l * c, m * l**2]]
    return PUSHED, added(column(mass, [xdd, al]), [m * l * s * w**2, 0], [0, -g * m * l * s], [-F, 0])


def backticked_states():
    below = M + m * s**2
    return PUSHED, [
        xdd - (F - m * g * s * c + m * l * w**2 * s) / below,
        al - ((M + m) * g * s - F * c - m * l * w**2 * s * c) / (l * below),
    ]


def newton_chains():
    """The rod's force from the first row, put into the two of the bob."""
    force = (F - M * xdd) / s
    return PUSHED, [
        m * xdd + m * l * al * c - m * l * w**2 * s - force * s,
        -m * g + m * l * al * s + m * l * w**2 * c + force * c,
    ]


def newton_solved():
    below = M + m * (1 + c**2)
    return PUSHED, [
        xdd - (F - m * s * (g * c - l * w**2)) / below,
        al + (F * c - m * l * w**2 * s * c + (M + m) * g * s) / (l * below),
    ]


def columns_in_directive():
    """J about the pivot."""
    true = cart_pole(J - m * l**2, up=True, left=True, forces={x: F - D * xd, th: -d * w})
    below = (M + m) * J - (m * l * c) ** 2
    one = J * F - J * D * xd - m * l * J * w**2 * s + m**2 * l**2 * g * s * c - m * l * d * w * c
    two = m * l * c * F - m * l * D * xd * c - (m * l * w) ** 2 * s * c + (M + m) * m * l * g * s - (M + m) * d * w
    return true, [xdd - one / below, al - two / below]


def left_of_its_places():
    """The guide's drawing has the pole on the other side than its places."""
    true = cart_pole(up=True, forces={x: F - D * xd, th: -d * w})
    return true, [
        (M + m) * xdd - m * l * al * c + m * l * w**2 * s - F + D * xd,
        l * al - xdd * c - g * s + w * d / (m * l),
    ]


def empty_aligned_row():
    true = cart_pole(up=True, left=True, forces={x: F - D * xd, th: -d * w})
    below = M + m - m * c**2
    pushed = F - xd * D - w**2 * m * l * s
    return true, [
        xdd - (pushed - w * d / l * c + g * m * c * s) / below,
        al - (pushed * c - w * d * (M + m) / (m * l) + g * (M + m) * s) / (l * below),
    ]


def dashes_for_minus():
    """l is half the rod's length here; the page's L is 2 l."""
    true = cart_pole(m * l**2 / 3, up=True, forces={x: F})
    length = 2 * l
    return true, [
        (M + m) * xdd + half * m * length * c * al - half * m * length * s * w**2 - F,
        half * m * length * c * xdd
        - half * m * length * s * xd * w
        + m * length**2 / 3 * al
        - half * m * g * length * s,
    ]


def root_of_the_speed():
    """l is half the rod's length here; the page's l is 2 l."""
    true = cart_pole(m * l**2 / 3, up=True)
    length = 2 * l
    squared = (xd + length / 2 * c * w) ** 2 + (length / 2 * s * w) ** 2
    moving = half * M * xd**2 + half * m * squared + half * m * length**2 / 12 * w**2
    return true, lagrange(moving - m * g * length / 2 * c, true)


def displaystyle_speeds():
    true = cart_pole(up=True, left=True)
    squared = (xd - l * w * c) ** 2 + (l * w * s) ** 2
    return true, lagrange(half * M * xd**2 + half * m * squared - m * g * l * c, true)


def typst_damped(force):
    """force: what pushes the cart, 0 in the first report."""
    true = cart_pole(up=True, forces={x: force, th: -d * w})
    return true, [
        (M + m) * xdd + m * l * c * al - m * l * s * w**2 - force,
        m * l * c * xdd + m * l**2 * al + d * w - m * g * l * s,
    ]


def rust_doc():
    det = (M + m) * m * l**2 - m**2 * l**2 * c**2
    return PUSHED, [
        xdd - (m * l**2 * (F + m * l * w**2 * s) - m * l * c * m * g * l * s) / det,
        al - ((M + m) * m * g * l * s - m * l * c * (F + m * l * w**2 * s)) / det,
    ]


def places_in_steps():
    true = cart_pole()
    second = half * m * (l**2 * w**2 + xd**2 + 2 * l * w * xd * c)
    return true, lagrange(half * M * xd**2 + second + m * g * l * c, true)


def german_entries():
    true = chain([(l1, m1, lc1, I1), (l2, m2, lc2, I2)], up=True, cart=M, forces={x: u})
    near, far = m1 * lc1 + m2 * l1, m2 * lc2
    mass = [
        [M + m1 + m2, near * c1, far * c2],
        [near * c1, I1 + m1 * lc1**2 + m2 * l1**2, m2 * l1 * lc2 * C],
        [far * c2, m2 * l1 * lc2 * C, I2 + m2 * lc2**2],
    ]
    turn = [[0, -near * w1 * s1, -far * w2 * s2], [0, 0, far * l1 * w2 * S], [0, -far * l1 * w1 * S, 0]]
    return true, added(
        column(mass, [xdd, a1, a2]), column(turn, [xd, w1, w2]), [0, -near * g * s1, -far * g * s2], [-u, 0, 0]
    )


# Two bobs


def divided_rows():
    return BOBS, [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + g * (m1 + m2) * s1,
        m2 * l2 * a2 + m2 * l1 * a1 * C - m2 * l1 * w1**2 * S + m2 * g * s2,
    ]


def own_mass_alone():
    return BOBS, [
        m1 * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S + (m1 + m2) * g * l1 * s1,
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C - m2 * l1 * l2 * w1**2 * S + m2 * g * l2 * s2,
    ]


def french_solved():
    below = m1 + m2 * S**2
    one = -m2 * l2 * w2**2 * S - (m1 + m2) * g * s1 - m2 * g * s2 * C + m2 * l1 * w1**2 * S * C
    two = S * (-(m1 + m2) * l1 * w1**2 + m2 * l2 * w2**2 * C) + g * ((m1 + m2) * s1 * C - (m1 + m2) * s2)
    return BOBS, [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def french_arrows():
    """y points down; the tensions from the rows across, put into the rows along."""
    across1, along1 = -l1 * s1 * w1**2 + l1 * c1 * a1, -l1 * c1 * w1**2 - l1 * s1 * a1
    across2, along2 = across1 - l2 * s2 * w2**2 + l2 * c2 * a2, along1 - l2 * c2 * w2**2 - l2 * s2 * a2
    second = m2 * across2 / s2
    first = (m1 * across1 + second * s2) / s1
    return BOBS, [
        m1 * along1 + first * c1 - second * c2 - m1 * g,
        m2 * along2 + second * c2 - m2 * g,
    ]


def fenced_denominators():
    between = th2 - th1
    sd, cd = sin(between), cos(between)
    first = (m1 + m2) * l1 - m2 * l1 * cd**2
    second = l2 / l1 * first
    one = m2 * l1 * w1**2 * sd * cd + m2 * g * s2 * cd + m2 * l2 * w2**2 * sd - (m1 + m2) * g * s1
    two = -m2 * l2 * w2**2 * sd * cd + (m1 + m2) * g * s1 * cd - (m1 + m2) * l1 * w1**2 * sd - (m1 + m2) * g * s2
    return BOBS, [a1 - one / first, a2 - two / second]


def typst_boxed():
    return BOBS, [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S + (m1 + m2) * g * l1 * s1,
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C - m2 * l1 * l2 * w1**2 * S + m2 * g * l2 * s2,
    ]


def typst_two_displays():
    both = m2 * l1 * l2
    return BOBS, [
        m1 * l1**2 * a1
        + m2 * l1**2 * a1
        - both * (a2 * C - w2 * (w1 - w2) * S)
        + both * w1 * w2 * S
        + m1 * g * l1 * s1
        + m2 * g * l1 * s1,
        m2 * l2**2 * a2 + both * (a1 * C - w1 * (w1 - w2) * S) - both * w1 * w2 * S + m2 * g * l2 * s2,
    ]


def typst_poster():
    return BOBS, [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + (m1 + m2) * g * s1,
        l1 * a1 * C + l2 * a2 - m2 * l1 * w1**2 * S + g * s2,
    ]


def known_solved():
    """The right-hand sides of the form with sin(θ1 − 2θ2) and 2 θ1 − 2 θ2."""
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * m2 * S * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * c1 + w2**2 * l2 * m2 * C)
    return one / (l1 * below), two / (l2 * below)


def lined_fractions():
    one, two = known_solved()
    return BOBS, [a1 - one, a2 - two]


def all_units():
    """g is one too."""
    below = 3 - cos(2 * th1 - 2 * th2)
    one = -3 * s1 - sin(th1 - 2 * th2) - 2 * S * (w2**2 + w1**2 * C)
    two = 2 * S * (2 * w1**2 + 2 * c1 + w2**2 * C)
    return bobs((1, 1), (1, 1)), [a1 - one / below, a2 - two / below], {g: 1}


def first_named_twice():
    """Neither row says anything of the lower angle's acceleration."""
    one, two = known_solved()
    return BOBS, [a1 - one, a1 - two]


def from_hamiltonian(true, energy, names):
    """Hamilton's equations of an energy in the momenta named: rows, and rates that must hold."""
    put = dict(zip(names, momenta(true)[0], strict=True))
    rates = [(v - sp.diff(energy, p)).subs(put) for (_, v, _), p in zip(true.coordinates, names, strict=True)]
    rows = [
        (turn + sp.diff(energy, q)).subs(put)
        for (q, _, _), turn in zip(true.coordinates, momenta(true)[1], strict=True)
    ]
    return true, rows, rates


def spanish_hamiltonian():
    true = bobs((l1, m), (l2, m))
    p1, p2 = sp.symbols("p1 p2")
    above = l2**2 * p1**2 - 2 * l1 * l2 * p1 * p2 * C + 2 * l1**2 * p2**2
    energy = above / (2 * m * l1**2 * l2**2 * (2 - C**2)) - 2 * m * g * l1 * c1 - m * g * l2 * c2
    return from_hamiltonian(true, energy, [p1, p2])


# Springs


def first_arm_energies():
    """The upper arm is a spring."""
    below = (r * s1 + l2 * s2, -r * c1 - l2 * c2)
    true = Mechanism([RADIUS, ONE, TWO], [Body(m1, r * s1, -r * c1), Body(m2, *below)], k1 * (r - r0) ** 2 / 2)
    upper = rd**2 + r**2 * w1**2
    lower = upper + l2**2 * w2**2 + 2 * r * l2 * w1 * w2 * C - 2 * l2 * rd * w2 * S
    resting = -m1 * g * r * c1 - m2 * g * (r * c1 + l2 * c2) + half * k1 * (r - r0) ** 2
    return true, lagrange(half * m1 * upper + half * m2 * lower - resting, true)


def without_dimensions():
    """The lower arm is a spring; the first length, the lower mass and the stiffness are one, g is the paper's ω."""
    below = (s1 + r * s2, -c1 - r * c2)
    true = Mechanism([RADIUS, ONE, TWO], [Body(mu, s1, -c1), Body(1, *below)], (r - delta) ** 2 / 2)
    printed = half * (rd**2 + r**2 * w2**2) + half * (mu + 1) * w1**2 + r * C * w1 * w2 - S * rd * w1
    printed += g * ((mu + 1) * c1 + r * c2) - half * (delta - r) ** 2
    return true, lagrange(printed, true)


def gathered_string():
    """A string of length l and a spring of length r in one line; the spring pulls in proportion to their sum."""
    whole = l + r
    true = Mechanism([RADIUS, ANGLE], [Body(m, whole * s, -whole * c)], k * whole**2 / 2)
    return true, [
        al * m * whole**2 + m * g * whole * s,
        rdd * m - w**2 * m * whole - m * g * c + k * whole,
    ]


SPRUNG = elastic(k * (r - r0) ** 2 / 2)
PR, PT = sp.symbols("pr pt")


def wiki_hamiltonian():
    energy = PT**2 / (2 * m * r**2) + PR**2 / (2 * m) + m * g * (r0 - r * c) + k / 2 * (r0 - r) ** 2
    return from_hamiltonian(SPRUNG, energy, [PR, PT])


def wiki_brace():
    (radial, angular), (radial_rate, angular_rate) = momenta(SPRUNG)
    rows = [
        radial_rate - angular**2 / (m * r**3) - m * g * c - k * (r0 - r),
        angular_rate + m * g * r * s,
    ]
    return SPRUNG, rows, [rd - radial / m, w - angular / (m * r**2)]


# A support that is moved


def moved(right=False, up=False, top=False, forces=None):
    place = (X if right else 0) + l * s, (Y if up else 0) + (l if top else -l) * c
    phases = {X: V, V: A} if right else {}
    phases |= {Y: U, U: B} if up else {}
    return Mechanism([ANGLE], [Body(m, *place)], 0, forces or {}, False, phases)


def kapitska_row():
    """Of y = -a cos ωt the acceleration is B = a ω² cos ωt."""
    return moved(up=True), [al - B / l * s + g / l * s]


def zymplectic_energies():
    true = moved(right=True, up=True, top=True)
    moving = half * m * (V**2 + U**2 + (l * w) ** 2) + m * l * w * (V * c - U * s)
    return true, lagrange(moving - m * g * (l * c + Y), true)


def vibrating_base():
    """Of x = h sin ωt the acceleration is A = -h ω² sin ωt."""
    return moved(right=True, forces={th: u}), [m * l**2 * al + m * g * l * s + m * l * A * c - u]


def scheme_residual():
    return moved(up=True), [g * l * m * s + l**2 * m * al + l * m * s * B]


def primed_vertical():
    """Of y = a cos ωt the acceleration is B = -a ω² cos ωt."""
    return moved(up=True), [l * al + g * s + B * s]


def primed_sideways():
    """Of x = a cos ωt the acceleration is A = -a ω² cos ωt; the row has a cos ωt itself, -A / ω²."""
    return moved(right=True), [al + g / l * s + A / Omega**2 / l * c]


# Arms


def arm(mass, turn, weight):
    true = links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    return true, added(column(mass, [a1, a2]), turn, weight, [-tau1, -tau2])


BOTH, LAST = m2 * (lc2**2 + l1 * lc2 * c2) + I2, m2 * lc2**2 + I2
LINKED = [[m1 * lc1**2 + I1 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2) + I2, BOTH], [BOTH, LAST]]
LOWER = m2 * g * lc2 * cos(th1 + th2)


def typst_japanese():
    h = m2 * l1 * lc2 * s2
    weight = [m1 * g * lc1 * c1 + m2 * g * (lc2 * cos(th1 + th2) + l1 * c1), LOWER]
    return arm(LINKED, [-h * w2**2 - 2 * h * w1 * w2, h * w1**2], weight)


def bold_symbols():
    h = -m2 * l1 * lc2 * s2
    turn = column([[h * w2, h * (w1 + w2)], [-h * w1, 0]], [w1, w2])
    return arm(LINKED, turn, [(m1 * lc1 + m2 * l1) * g * c1 + LOWER, LOWER])


def without_rates():
    """Both centres are at the middle; lc1 and lc2 here are half the lengths, l1 is 2 lc1."""
    turn = column([[0, -m2 * l1 * lc2 * s2], [m2 * l1 * lc2 * s2, 0]], [w1, w2])
    return (*arm(LINKED, turn, [-(m1 * lc1 + m2 * l1) * g * c1 - LOWER, -LOWER]), {l1: 2 * lc1})


def quadratic_form():
    true = chain([(l1, m1, lc1, 0), (l2, m2, lc2, 0)], relative=True)
    both = m2 * (lc2**2 + l1 * lc2 * c2)
    mass = sp.Matrix([[m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2), both], [both, m2 * lc2**2]])
    rates = sp.Matrix([w1, w2])
    resting = -m1 * g * lc1 * c1 - m2 * g * (l1 * c1 + lc2 * cos(th1 + th2))
    return true, lagrange((rates.T * mass * rates)[0] / 2 - resting, true)


# Wheels


def friction_in_the_arm():
    """From the horizontal; the friction is that of the wheel's bearing."""
    bodies = [Body(m, l * c, l * s, 0, th), Body(0, l * c, l * s, I, th + ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {ph: u - b * phd})
    return true, [(I + m * l**2) * al + I * phdd + m * g * l * c + b * phd, I * (al + phdd) - u]


def german_fields():
    """m_0 is m g l; J_1 is the inertia of both about the pivot."""
    true = wheel(I1 - I2, I2, forces={ph: u})
    pull = m * g * l / (I1 - I2) * s
    return true, [al - pull + u / (I1 - I2), phdd + pull - I1 / (I2 * (I1 - I2)) * u]


def omega_for_an_angle():
    """The wheel's angle is counted in space; its motor turns the wheel back and the pendulum on."""
    bodies = [Body(m, l * s, -l * c), Body(0, l * s, 0, I, ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {th: tau, ph: -tau})
    return true, [m * l**2 * al + m * g * l * s - tau, I * phdd + tau]


# Carts alone, and one pendulum


def two_carts():
    y, yd, ydd = coordinate("y")
    springs = half * k1 * x**2 + half * k2 * (y - x) ** 2
    true = Mechanism([CART, (y, yd, ydd)], [Body(m1, x, 0), Body(m2, y, 0)], springs, {x: -b * xd})
    return true, [m1 * xdd + b * xd + (k1 + k2) * x - k2 * y, m2 * ydd + k2 * y - k2 * x]


def fenced_torque():
    true = pendulum(forces={th: tau - b * w})
    return true, [tau - m * l**2 * al - m * g * l * s - b * w]


def damping_of_inertia():
    true = pendulum(forces={th: tau - b * m * l**2 * w})
    return true, [al + g / l * s + b * w - tau / (m * l**2)]


def rod_and_bob():
    """M is the rod's mass."""
    true = Mechanism([ANGLE], [Body(M, l / 2 * s, -l / 2 * c, M * l**2 / 12, th), Body(m, l * s, -l * c)])
    printed = M * l**2 * w**2 / 24 + m * l**2 * w**2 / 2 + (M / 2 + m) * g * l * c
    return true, lagrange(printed, true)


# Three rods with bobs


def rods_with_bobs():
    masses = sp.symbols("b1 b2 b3 r1 r2 r3", positive=True)
    weights, rodded, lengths = masses[:3], masses[3:], (l1, l2, l3)
    bodies, right, up = [], sp.Integer(0), sp.Integer(0)
    for angle, length, bob, rod in zip((th1, th2, th3), lengths, weights, rodded, strict=True):
        middle = right + length / 2 * cos(angle), up + length / 2 * sin(angle)
        right, up = right + length * cos(angle), up + length * sin(angle)
        bodies += [Body(rod, *middle, rod * length**2 / 12, angle), Body(bob, right, up)]
    return Mechanism([ONE, TWO, THREE], bodies), weights, rodded


def letters_defined_behind():
    true, (bob1, bob2, bob3), (rod1, rod2, rod3) = rods_with_bobs()
    behind3 = bob3 + rod3
    behind2 = bob2 + rod2 + behind3
    first, second, third = bob1 + rod1 / 3 + behind2, bob2 + rod2 / 3 + behind3, bob3 + rod3 / 3
    mu1, mu2, mu3 = bob1 + rod1 / 2 + behind2, bob2 + rod2 / 2 + behind3, bob3 + rod3 / 2
    moving = half * (first * l1**2 * w1**2 + second * l2**2 * w2**2 + third * l3**2 * w3**2)
    moving += mu2 * l1 * l2 * w1 * w2 * cos(th2 - th1)
    moving += mu3 * l3 * w3 * (l2 * w2 * cos(th3 - th2) + l1 * w1 * cos(th3 - th1))
    resting = mu1 * g * l1 * s1 + mu2 * g * l2 * s2 + mu3 * g * l3 * sin(th3)
    return true, lagrange(moving - resting, true)


PROOFS = {
    "cp-escaped-energies": escaped_energies(),
    "cp-columns-of-forces": rows_of_pole(),
    "cp-height-without-length": height_without_length(),
    "cp-bold-terms": bold_terms(),
    "cp-backticked-states": backticked_states(),
    "cp-newton-chains": newton_chains(),
    "cp-newton-solved": newton_solved(),
    "cp-columns-in-math-directive": columns_in_directive(),
    "cp-left-of-its-places": left_of_its_places(),
    "cp-empty-aligned-row": empty_aligned_row(),
    "cp-dashes-for-minus": dashes_for_minus(),
    "cp-root-of-the-speed": root_of_the_speed(),
    "cp-displaystyle-speeds": displaystyle_speeds(),
    "cp-typst-damped": typst_damped(sp.Integer(0)),
    "cp-typst-mat": typst_damped(F),
    "cp-rust-doc": rust_doc(),
    "cp-places-in-steps": places_in_steps(),
    "dc-german-entries": german_entries(),
    "dp-broken-tags": divided_rows(),
    "dp-own-mass-alone": own_mass_alone(),
    "dp-french-solved": french_solved(),
    "dp-french-arrows": french_arrows(),
    "dp-fenced-denominators": fenced_denominators(),
    "dp-typst-boxed": typst_boxed(),
    "dp-typst-two-displays": typst_two_displays(),
    "dp-typst-poster": typst_poster(),
    "dp-lined-fractions": lined_fractions(),
    "dp-all-units": all_units(),
    "dp-first-named-twice": first_named_twice(),
    "dp-spanish-hamiltonian": spanish_hamiltonian(),
    "el-first-arm-energies": first_arm_energies(),
    "el-without-dimensions": without_dimensions(),
    "el-gathered-string": gathered_string(),
    "el-wiki-hamiltonian": wiki_hamiltonian(),
    "el-wiki-brace": wiki_brace(),
    "mv-kapitska-row": kapitska_row(),
    "mv-zymplectic-energies": zymplectic_energies(),
    "mv-vibrating-base": vibrating_base(),
    "mv-scheme-residual": scheme_residual(),
    "mv-primed-vertical": primed_vertical(),
    "mv-primed-sideways": primed_sideways(),
    "rr-typst-japanese": typst_japanese(),
    "rr-bold-symbols": bold_symbols(),
    "rr-without-rates": without_rates(),
    "rr-quadratic-form": quadratic_form(),
    "rw-friction-in-the-arm": friction_in_the_arm(),
    "rw-german-fields": german_fields(),
    "rw-omega-for-an-angle": omega_for_an_angle(),
    "sl-two-carts": two_carts(),
    "sp-fenced-torque": fenced_torque(),
    "sp-damping-of-inertia": damping_of_inertia(),
    "sp-rod-and-bob": rod_and_bob(),
    "tp-letters-defined-behind": letters_defined_behind(),
    "tp-energies-by-letters": letters_defined_behind(),
}


# What is wrong as declared and right in another convention, with the mechanism in that convention.
IN_ANOTHER = {
    "cp-left-of-its-places": (
        cart_pole(up=True, left=True, forces={x: F - D * xd, th: -d * w}),
        left_of_its_places()[1],
    ),
    "mv-kapitska-row": (moved(up=True), [row.subs(B, -B) for row in kapitska_row()[1]]),
}


def others(name):
    """The conventions in which the rows of a wrong one would be right: (turn, mirror of the slides), or the why's."""
    if name in IN_ANOTHER:
        true, turned = IN_ANOTHER[name]
        assert compare(turned, true) is None
        return ["the one in its why"]
    return right_in(PROOFS[name])


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS, others)
