"""What this folder's programs of carts, arms, legs, wheels and springs compute, entered by hand from their text.

The letters here are the mechanisms' own. A program that solves with a matrix has its rows before that.
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
    WHEEL,
    F,
    I,
    M,
    a1,
    a2,
    al,
    b,
    b1,
    bobs,
    cart_pole,
    chain,
    g,
    k,
    l,
    l1,
    l2,
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
    rd,
    rdd,
    tau1,
    tau2,
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
s12, c12 = sin(th1 + th2), cos(th1 + th2)
D, J1, J2, a, mh = sp.symbols("D J1 J2 a mh")
V, A, Y, U, P = sp.symbols("V A Y U P")


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# A cart and a pole


def out_argument():
    true = cart_pole(up=True, forces={x: F})
    below = M + m * s**2
    return true, [
        xdd - (F + m * s * (l * w**2 - g * c)) / below,
        al - (-F * c - m * l * w**2 * s * c + (m + M) * g * s) / (l * below),
    ]


def velocity_verlet():
    """l is the whole rod's length."""
    true = cart_pole(m * l**2 / 12, up=True, arm=l / 2, forces={x: F})
    total = m + M
    turn = g * s + c * (-F - m * l / 2 * w**2 * s) / total
    turn = turn / (l / 2 * (Rational(4, 3) - m * c**2 / total))
    return true, [al - turn, xdd - (F + m * l / 2 * (w**2 * s - turn * c)) / total]


def comptime():
    """l is half the rod's length."""
    true = cart_pole(m * l**2 / 3, up=True, forces={x: F})
    total = M + m
    temp = (F + m * l * w * w * s) / total
    turn = (g * s - c * temp) / (l * (Rational(4, 3) - m * c * c / total))
    return true, [al - turn, xdd - (temp - m * l * turn * c / total)]


def force_outside():
    """The program's gravity is -g."""
    true = cart_pole(up=True, forces={x: F})
    forward = F + (-s * m * l * w**2 - c * s * m * g) / (M + m * s**2)
    return true, [xdd - forward, al - (s * g - c * forward) / l]


def stacked_methods():
    true = cart_pole(up=True, forces={x: F})
    mass = [[M + m, m * l * c], [m * l * c, m * l**2]]
    return true, added(column(mass, [xdd, al]), column([[0, -m * l * w * s], [0, 0]], [xd, w]), [-F, -m * g * l * s])


def double_underscores():
    true = cart_pole(I, forces={x: u - b * xd})
    den = -(m**2) * l**2 * c**2 + l**2 * m**2 + l**2 * m * M + I * m + I * M
    one = -(w**2) * s * l**3 * m**2 - m**2 * l**2 * g * s * c - I * w**2 * s * l * m
    one += xd * b * l**2 * m - l**2 * m * u + I * xd * b - I * u
    two = (-(w**2) * s * c * l * m + xd * c * b - s * g * m - s * g * M - c * u) * m * l
    return true, [xdd + one / den, al - two / den]


def movable_origin():
    """The drag on the bob's turning is declared as the angle's friction."""
    true = cart_pole(forces={th: -b * l**2 * w})
    return true, [al + g / l * s + b / m * w, xdd - (l * w * w * s - g * s) / (1 + m / M)]


# A cart and two poles


def damped_signs():
    one, two = -b * w1 * (m1 + m2) * l1**2, -b1 * w2 * m2 * l2**2
    true = bobs((l1, m1), (l2, m2), cart=M, forces={x: F, th1: one, th2: two})
    near, far, cross = (m1 + m2) * l1 * c1, m2 * l2 * c2, m2 * l1 * l2 * C
    mass = [[M + m1 + m2, near, far], [near, (m1 + m2) * l1**2, cross], [far, cross, m2 * l2**2]]
    right = [
        F + (m1 + m2) * l1 * w1**2 * s1 + m2 * l2 * w2**2 * s2,
        -(m1 + m2) * g * l1 * s1 + m2 * l1 * l2 * w2**2 * S + one,
        -m2 * g * l2 * s2 - m2 * l1 * l2 * w1**2 * S + two,
    ]
    return true, added(column(mass, [xdd, a1, a2]), [-part for part in right])


def two_hooks():
    """Both loads hang from the trolley, to the left for positive angles."""
    bodies = [Body(M, x, 0), Body(m1, x - l1 * s1, -l1 * c1), Body(m2, x - l2 * s2, -l2 * c2)]
    true = Mechanism([CART, ONE, TWO], bodies, 0, {x: F})
    below = -m1 * c1**2 - m2 * c2**2 + M + m1 + m2
    first = -(l1 * m1 * s1 * w1 * w1) - l2 * m2 * s2 * w2 * w2 + F - (g * m1 * c1 * s1 + g * m2 * c2 * s2)
    second = -(m1 * c1 * s1 * w1 * w1) * l1 - l2 * m2 * c1 * s2 * w2 * w2 + c1 * F
    second -= -g * m2 * s1 * c2**2 + g * m2 * c1 * s2 * c2 + M * g * s1 + g * m1 * s1 + g * m2 * s1
    third = -l1 * m1 * c2 * s1 * w1 * w1 - m2 * c2 * s2 * w2 * w2 * l2 + c2 * F
    third -= -g * m1 * s2 * c1**2 + g * m1 * c2 * s1 * c1 + M * g * s2 + g * m1 * s2 + g * m2 * s2
    return true, [xdd - first / below, a1 - second / (l1 * below), a2 - third / (l2 * below)]


def pivoting():
    true = bobs((l1, m1), (l2, m2), cart=M, up=True, forces={x: F})
    near, far, cross = (m1 + m2) * l1 * c1, m2 * l2 * c2, m2 * l1 * l2 * C
    mass = [[M + m1 + m2, near, far], [near, (m1 + m2) * l1 * l1, cross], [far, cross, m2 * l2 * l2]]
    right = [
        F + (m1 + m2) * l1 * s1 * w1 * w1 + m2 * l2 * s2 * w2 * w2,
        (m1 + m2) * g * l1 * s1 - m2 * l1 * l2 * S * w2 * w2,
        m2 * g * l2 * s2 + m2 * l1 * l2 * S * w1 * w1,
    ]
    return true, added(column(mass, [xdd, a1, a2]), [-part for part in right])


# Arms and legs


def pivoted(cross, forces):
    """Two hanging links, inertias about the pivots; cross: what stands for m2 l1 lc2 in matrix and rates."""
    true = links(True, relative=True, forces=forces)
    mass = [[I1 + I2 + m2 * l1**2 + 2 * cross * c2, I2 + cross * c2], [I2 + cross * c2, I2]]
    turn = [[-2 * cross * s2 * w2, -cross * s2 * w2], [cross * s2 * w1, 0]]
    weight = [m1 * g * lc1 * s1 + m2 * g * (l1 * s1 + lc2 * s12), m2 * g * lc2 * s12]
    pushed = [-forces.get(th1, 0), -forces.get(th2, 0)]
    return true, added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight, pushed)


def half_of_a_half():
    """Both centres are in the middle."""
    true, rows = pivoted(m2 * l1 * lc2 / 2, {th2: u})
    return true, rows, {l1: 2 * lc1, l2: 2 * lc2}


def inertia_bracketed():
    pushed = {th1: -b * w1, th2: u - b * w2}
    true = chain([(l1, m1, l1, J1), (l2, m2, l2, J2)], relative=True, horizontal=True, forces=pushed)
    cross = m2 * (l2**2 + l1 * l2 * c2 + J2)
    mass = [[m1 * l1**2 + J1 + m2 * (l1**2 + l2**2 + 2 * l1 * l2 * c2) + J2, cross], [cross, l2**2 * m2 + J2]]
    tmp = l1 * l2 * m2 * s2
    turn = [-(2 * w1 * w2 + w2**2) * tmp, tmp * w1**2]
    weight = [((m1 + m2) * l2 * c1 + m2 * l2 * c12) * g, m2 * l2 * c12 * g]
    return true, added(column(mass, [a1, a2]), turn, weight, [b * w1, b * w2 - u])


def sine_of_the_rate():
    """The sine of a rate is no rational function of it: at rates that are angles of the exact comparison, as turns."""
    true = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    cross = m2 * l2**2 + m2 * l1 * l2 * c2
    mass = [[(m1 + m2) * l1**2 + m2 * l2**2 + 2 * m2 * l1 * l2 * c2, cross], [cross, m2 * l2**2]]
    turn = [-m2 * l1 * l2 * (2 * w1 * w2 + w2**2) * sin(w2), m2 * l1 * l2 * w1**2 * s2]
    weight = [(m1 + m2) * g * l1 * c1 + m2 * g * l2 * c12, m2 * g * l2 * c12]
    return true, added(column(mass, [a1, a2]), turn, weight, [-tau1, -tau2])


def expanded():
    d1, d2 = lc1, lc2
    true = links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    below = -(l1**2) * d2**2 * m2**2 * c2**2 + l1**2 * d2**2 * m2**2 + I2 * l1**2 * m2
    below += m1 * d1**2 * d2**2 * m2 + I2 * m1 * d1**2 + I1 * d2**2 * m2 + I1 * I2
    one = I2 * tau1 - I2 * tau2 + d2**2 * m2 * tau1 - d2**2 * m2 * tau2 - l1 * d2**2 * g * m2**2 * c1
    one += -I2 * l1 * g * m2 * c1 - I2 * d1 * g * m1 * c1 - l1 * d2 * m2 * tau2 * c2 + l1 * d2**3 * w1**2 * m2**2 * s2
    one += l1 * d2**3 * w2**2 * m2**2 * s2 + l1**2 * d2**2 * w1**2 * m2**2 * c2 * s2 + l1 * d2**2 * g * m2**2 * c12 * c2
    one += I2 * l1 * d2 * w1**2 * m2 * s2 + I2 * l1 * d2 * w2**2 * m2 * s2 - d1 * d2**2 * g * m1 * m2 * c1
    one += 2 * l1 * d2**3 * w1 * w2 * m2**2 * s2 + 2 * I2 * l1 * d2 * w1 * w2 * m2 * s2
    two = I2 * tau1 - I1 * tau2 - I2 * tau2 - d1**2 * m1 * tau2 + d2**2 * m2 * tau1 - d2**2 * m2 * tau2
    two += -(l1**2) * m2 * tau2 + l1**2 * d2 * g * m2**2 * c12 - l1 * d2**2 * g * m2**2 * c1 + I1 * d2 * g * m2 * c12
    two += -I2 * l1 * g * m2 * c1 - I2 * d1 * g * m1 * c1 + l1 * d2 * m2 * tau1 * c2 - 2 * l1 * d2 * m2 * tau2 * c2
    two += l1 * d2**3 * w1**2 * m2**2 * s2 + l1**3 * d2 * w1**2 * m2**2 * s2 + l1 * d2**3 * w2**2 * m2**2 * s2
    two += 2 * l1**2 * d2**2 * w1**2 * m2**2 * c2 * s2 + l1**2 * d2**2 * w2**2 * m2**2 * c2 * s2
    two += l1 * d2**2 * g * m2**2 * c12 * c2 - l1**2 * d2 * g * m2**2 * c1 * c2 + d1**2 * d2 * g * m1 * m2 * c12
    two += I1 * l1 * d2 * w1**2 * m2 * s2 + I2 * l1 * d2 * w1**2 * m2 * s2 + I2 * l1 * d2 * w2**2 * m2 * s2
    two += -d1 * d2**2 * g * m1 * m2 * c1 + 2 * l1 * d2**3 * w1 * w2 * m2**2 * s2
    two += 2 * l1**2 * d2**2 * w1 * w2 * m2**2 * c2 * s2 + l1 * d1**2 * d2 * w1**2 * m1 * m2 * s2
    two += 2 * I2 * l1 * d2 * w1 * w2 * m2 * s2 - l1 * d1 * d2 * g * m1 * m2 * c1 * c2
    return true, [a1 - one / below, a2 + two / below]


def nested_handles():
    """a: from the foot to the stance leg's mass, b: from the hip to the swing leg's."""
    top = (-l * s1, l * c1)
    bodies = [Body(m, -a * s1, a * c1), Body(mh, *top), Body(m, top[0] + b * s2, top[1] - b * c2)]
    mass = [[(mh + m) * l**2 + m * a**2, -m * l * b * C], [-m * l * b * C, m * b**2]]
    turn = [[0, -m * l * b * S * w2], [m * l * b * S * w1, 0]]
    weight = [-(mh * l + m * a + m * l) * g * s1, m * b * g * s2]
    return Mechanism([ONE, TWO], bodies), added(column(mass, [a1, a2]), column(turn, [w1, w2]), weight)


# The rest


def symbolic_residuals():
    """u: the motor's torque without the part of the wheel's rate, k: that part."""
    torque = u - k * phd
    bodies = [Body(m, l * s, l * c, I1 - m * l**2, th), Body(0, l * s, l * c, I2, ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {th: -torque, ph: torque})
    return true, [al - (m * l * g * s - torque) / I1, phdd - torque / I2]


def crane_acceleration():
    """The trolley's acceleration is A; mass and rope are 1."""
    true = Mechanism([ANGLE], [Body(1, P + s, -c)], 0, {th: -b * w}, False, {P: V, V: A})
    return true, [al + g * s + A * c + b * w]


def kapitza_damped():
    """Of a sin(w t) the acceleration is A."""
    true = Mechanism([ANGLE], [Body(m, l * s, Y + l * c)], 0, {th: -b * w}, False, {Y: U, U: A})
    return true, [al - (-b * w + l * m * (A + g) * s) / (l**2 * m)]


def torch_step():
    """A uniform rod."""
    true = pendulum(m * l**2 / 12, up=True, arm=l / 2, forces={th: u})
    return true, [al - (-3 * g / (2 * l) * -s + 3 / (m * l**2) * u)]


def drag():
    """r is the stretch; air's drag is D times the bob's speed."""
    long = r + l
    body = Body(m, long * s, -long * c)
    true = Mechanism([RADIUS, ANGLE], [body], half * k * r**2, {r: -D * rd, th: -D * long**2 * w})
    return true, [
        al - (-2 * rd * w / long - g * s / long - D / m * long * w),
        rdd - (long * w * w + g * c - k / m * r - D / m * rd),
    ]


PROOFS = {
    "cp-cpp-out-argument": out_argument(),
    "cp-rust-velocity-verlet": velocity_verlet(),
    "cp-mojo-comptime": comptime(),
    "cp-python-force-outside": force_outside(),
    "cp-torch-stacked-methods": stacked_methods(),
    "cp-matlab-double-underscores": double_underscores(),
    "cp-javascript-movable-origin": movable_origin(),
    "dc-jax-damped-signs": damped_signs(),
    "dc-matlab-two-hooks": two_hooks(),
    "dc-c-pivoting": pivoting(),
    "ac-julia-toolkit-broadcast": pivoted(m2 * l1 * lc2, {th1: tau1, th2: tau2}),
    "ac-julia-inertia-bracketed": inertia_bracketed(),
    "ac-cpp-half-of-a-half": half_of_a_half(),
    "arm-cpp-sine-of-the-rate": sine_of_the_rate(),
    "arm-matlab-expanded": expanded(),
    "leg-matlab-nested-handles": nested_handles(),
    "rw-matlab-symbolic-residuals": symbolic_residuals(),
    "mv-matlab-crane-acceleration": crane_acceleration(),
    "mv-python-kapitza-damped": kapitza_damped(),
    "sp-torch-step": torch_step(),
    "el-python-drag": drag(),
}
