"""What the carts, springs and wheels of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's m_0, m_{pend}, θ are M, m, th. A support that is moved is at X
beside, Y above its rest; V, U are its rates, A, B its accelerations.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    I1,
    I2,
    F,
    I,
    M,
    a1,
    a2,
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
    th,
    th1,
    th2,
    w,
    w1,
    w2,
    wheel,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, coordinate, lagrange

half = Rational(1, 2)
S, C = sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
X, Y, V, U, A, B, J, d, f = sp.symbols("X Y V U A B J d f")
k1, k2, k3, d1, d2, d3 = sp.symbols("k1 k2 k3 d1 d2 d3")


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# A cart and a pole


RUBBING = cart_pole(I - m * l**2, up=True, forces={x: F - b1 * xd, th: -b2 * w})


def boxed_pivot_inertia():
    return RUBBING, [
        (M + m) * xdd + m * l * c * al - F + b1 * xd - m * l * w**2 * s,
        m * l * c * xdd + I * al - m * g * l * s + b2 * w,
    ]


def letters_of_two():
    both, lever = M + m, m * l
    one, two = F - b1 * xd + lever * w**2 * s, lever * g * s - b2 * w
    below = both * I - (lever * c) ** 2
    return RUBBING, [xdd - (I * one - lever * c * two) / below, al - (both * two - lever * c * one) / below]


def newton_circled():
    """The forces of the hinge from ② and ③, put into ① and ④."""
    true = cart_pole(J, up=True, forces={x: F - b * xd})
    across = m * (xdd + l * c * al - l * s * w**2)
    along = m * g + m * (-l * s * al - l * c * w**2)
    return true, [J * al - along * l * s + across * l * c, F - across - b * xd - M * xdd]


def acceleration_given():
    """J_1 is about the centre; the cart's acceleration is A."""
    place = Body(m, X - l * s, l * c, J, th)
    true = Mechanism([ANGLE], [place], 0, {th: -d * w}, False, {X: V, V: A})
    below = J + l**2 * m
    return true, [al - (l * g * m * s - d * w) / below - l * m * c / below * A]


def cart_alone():
    true = cart_pole(J, up=True, left=True, forces={x: F, th: -d * w})
    below, push = J + l**2 * m, F / M
    return true, [xdd - push, al - (l * g * m * s - d * w) / below - l * m * c / below * push]


def all_ones():
    """g is one too."""
    true = cart_pole(forces={x: F}, mass=1, bob=1, arm=1)
    below = 2 - c**2
    return (
        true,
        [xdd - (F + s * c + w**2 * s) / below, al - (-c * F - w**2 * s * c - 2 * s) / below],
        {g: 1},
    )


def rod_double_angle():
    """The pole leans to the left."""
    true = cart_pole(m * l**2 / 12, up=True, left=True, forces={x: F}, arm=l / 2)
    below = 4 * M + 3 * m * s**2 + m
    return true, [
        xdd - (4 * F + 3 * g * m * sin(2 * th) / 2 - 2 * l * m * s * w**2) / below,
        al - 3 * (2 * g * (M + m) * s + (2 * F - l * m * s * w**2) * c) / (l * below),
    ]


def published_comments():
    true = cart_pole(up=True, left=True, forces={x: f})
    return true, [
        (M + m) * xdd - m * l * al * c + m * l * w**2 * s - f,
        -m * l * c * xdd + m * l**2 * al - m * g * l * s,
    ]


def drawn_matrices():
    true = cart_pole(forces={x: F})
    mass = [[M + m, m * l * c], [m * l * c, m * l**2]]
    turn = [[0, -m * l * w * s], [0, 0]]
    return true, added(column(mass, [xdd, al]), column(turn, [xd, w]), [-F, m * g * l * s])


def chinese_parts():
    true = cart_pole()
    moving = half * M * xd**2 + half * m * (xd**2 + (l * w) ** 2 + 2 * l * xd * w * c)
    return true, lagrange(moving + m * g * l * c, true)


# Two poles on a cart


def coloured_left():
    bodies = [
        Body(M, x, 0),
        Body(m1, x - l1 * s1, l1 * c1),
        Body(m2, x - l1 * s1 - l2 * s2, l1 * c1 + l2 * c2),
    ]
    true = Mechanism(bobs((1, m1), (1, m2), cart=M).coordinates, bodies)
    printed = half * M * xd**2 + half * m1 * (xd**2 - 2 * xd * l1 * w1 * c1 + l1**2 * w1**2)
    printed += half * m2 * (xd**2 + l1**2 * w1**2 + l2**2 * w2**2 - 2 * xd * l1 * w1 * c1 - 2 * xd * l2 * w2 * c2)
    printed += half * m2 * 2 * l1 * l2 * w1 * w2 * C - (m1 + m2) * g * l1 * c1 - m2 * g * l2 * c2
    return true, lagrange(printed, true)


def three_columns():
    true = bobs((l1, m1), (l2, m2), cart=M, forces={x: F})
    near, far, both = (m1 + m2) * l1, m2 * l2, m2 * l1 * l2
    mass = [[M + m1 + m2, near * c1, far * c2], [near * c1, near * l1, both * C], [far * c2, both * C, m2 * l2**2]]
    squares = [-near * s1 * w1**2 - far * s2 * w2**2, both * S * w2**2, -both * S * w1**2]
    return true, added(column(mass, [xdd, a1, a2]), squares, [-F, near * g * s1, far * g * s2])


def counted_twice():
    """The third of m l² that the page gives is the inertia about the end."""
    true = rods((l1, m1), (l2, m2), cart=M, up=True)
    end1, end2 = m1 * l1**2 / 3, m2 * l2**2 / 3
    printed = half * (M + m1 + m2) * xd**2 + half * (end1 + m1 * l1**2 / 4 + m2 * l1**2) * w1**2
    printed += half * (end2 + m2 * l2**2 / 4) * w2**2 + (m1 * l1 / 2 + m2 * l1) * xd * w1 * c1
    printed += m2 * l2 / 2 * xd * w2 * c2 + m2 * l1 * l2 / 2 * w1 * w2 * C
    printed -= (m1 * l1 / 2 + m2 * l1) * g * c1 + m2 * l2 / 2 * g * c2
    return true, lagrange(printed, true)


def myst_halved():
    true = chain([(l1, m1, l1 / 2, I1), (l2, m2, l2 / 2, I2)], cart=M, up=True)
    printed = half * (M + m1 + m2) * xd**2 + half * m1 * l1 / 2 * xd * c1 * w1 + m2 * l1 * xd * c1 * w1
    printed += half * m2 * l2 / 2 * xd * c2 * w2 + half * (I1 + m1 * l1**2 / 4) * w1**2
    printed += half * m2 * l1**2 * w1**2 + half * m2 * l1 * l2 * C * w1 * w2 + half * (I2 + m2 * l2**2 / 4) * w2**2
    printed -= m1 * g * l1 / 2 * c1 + m2 * g * (l1 * c1 + l2 / 2 * c2)
    return true, lagrange(printed, true)


# Masses in a row


def three_in_a_row():
    y, yd, ydd = coordinate("y")
    z, zd, zdd = coordinate("z")
    springs = half * k1 * x**2 + half * k2 * (y - x) ** 2 + half * k3 * (z - y) ** 2
    forces = {
        x: F - d1 * xd + d2 * (yd - xd),
        y: -d2 * (yd - xd) + d3 * (zd - yd),
        z: -d3 * (zd - yd),
    }
    bodies = [Body(m1, x, 0), Body(m2, y, 0), Body(m3, z, 0)]
    true = Mechanism([CART, (y, yd, ydd), (z, zd, zdd)], bodies, springs, forces)
    return true, [
        m1 * xdd + k1 * x + d1 * xd - k2 * (y - x) - d2 * (yd - xd) - F,
        m2 * ydd + k2 * (y - x) + d2 * (yd - xd) - k3 * (z - y) - d3 * (zd - yd),
        m3 * zdd + k3 * (z - y) + d3 * (zd - yd),
    ]


def turkish_carts():
    y, yd, ydd = coordinate("y")
    springs = half * k1 * x**2 + half * k2 * (y - x) ** 2
    bodies = [Body(m1, x, 0), Body(m2, y, 0)]
    true = Mechanism([CART, (y, yd, ydd)], bodies, springs, {x: -b * xd, y: f})
    return true, [m1 * xdd + k1 * x + k2 * (x - y) + b * xd, m2 * ydd + k2 * (y - x) - f]


def tags_in_front():
    y, yd, ydd = coordinate("y")
    true = Mechanism([CART, (y, yd, ydd)], [Body(m1, x, 0), Body(m2, y, 0)], half * k * (y - x - r0) ** 2)
    return true, [m1 * xdd - k * (y - x - r0), m2 * ydd + k * (y - x - r0)]


# A spring that swings, supports that are moved, a wheel


def spring_docstring():
    return elastic(half * k * (r - r0) ** 2), [rdd - r * w**2 - g * c + k / m * (r - r0), al + (2 * rd * w + g * s) / r]


def moved(up=False, top=False):
    place = sp.Integer(0) + l * s, (Y if up else 0) + (l if top else -l) * c
    return Mechanism([ANGLE], [Body(m, *place)], 0, {}, False, {Y: U, U: B})


def moving_frame():
    """Of y = -A cos ωt the acceleration is B = A ω² cos ωt."""
    return moved(up=True), [m * l * al - m * g * s + m * B * s]


def kapitza_solved():
    return moved(up=True), [al + (g + B) / l * s]


def ponderomotive():
    """Of y = a cos Ωt the acceleration is B = -a Ω² cos Ωt."""
    return moved(up=True), [al + g / l * s + B / l * s]


def cross_term():
    true = moved(up=True, top=True)
    return true, lagrange(half * m * (l**2 * w**2 + 2 * l * U * w * s) + m * g * l * (1 - c), true)


def torque_in_the_body():
    """I1 is the inertia of all but the wheel's own, about the pivot."""
    true = wheel(I1, I2, forces={ph: tau})
    return true, [(I1 + I2) * al + I2 * phdd - m * l * g * s + tau, I2 * al + I2 * phdd - tau]


def twice_the_wheel():
    """The wheel's angle beside the body's is X, its acceleration A, the author's u."""
    bodies = [Body(m, l * s, l * c, I1 - m * l**2, th), Body(0, l * s, l * c, I2, th + X)]
    true = Mechanism([ANGLE], bodies, 0, {}, False, {X: V, V: A})
    return true, [al - (m * l * g * s - 2 * I2 * A) / (I1 + 2 * I2)]


PROOFS = {
    "cp-boxed-pivot-inertia": boxed_pivot_inertia(),
    "cp-letters-of-two": letters_of_two(),
    "cp-newton-circled": newton_circled(),
    "cp-cart-alone": cart_alone(),
    "cp-all-ones": all_ones(),
    "cp-rod-double-angle": rod_double_angle(),
    "cp-matlab-published-comments": published_comments(),
    "cp-drawn-matrices": drawn_matrices(),
    "cp-chinese-parts": chinese_parts(),
    "dc-coloured-left": coloured_left(),
    "dc-three-columns": three_columns(),
    "dc-inertia-counted-twice": counted_twice(),
    "dc-myst-halved": myst_halved(),
    "sl-three-in-jsx": three_in_a_row(),
    "sl-turkish": turkish_carts(),
    "sl-tags-in-front": tags_in_front(),
    "el-docstring": spring_docstring(),
    "mv-acc-column": acceleration_given(),
    "mv-moving-frame": moving_frame(),
    "mv-kapitza-solved": kapitza_solved(),
    "mv-docstring-ponderomotive": ponderomotive(),
    "mv-fablab-cross-term": cross_term(),
    "rw-torque-in-the-body": torque_in_the_body(),
    "rw-twice-the-wheel": twice_the_wheel(),
}
