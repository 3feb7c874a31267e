"""What the programs of this folder compute, entered by hand from their text, and what each describes.

The letters here are the mechanisms' own: a program's q1, a1, phi1 are th1, its r, b, d, r1 are l or l1.
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
from truth import Body, Mechanism, momenta

TWO, EQUAL, THREE = bobs((l1, m1), (l2, m2)), bobs((l, m), (l, m)), bobs((l1, m1), (l2, m2), (l3, m3))
D, S, C = th1 - th2, sin(th1 - th2), cos(th1 - th2)
s, c = sin(th), cos(th)
c1_, s1, c2, s2 = cos(th1), sin(th1), cos(th2), sin(th2)
phase, phase2, speed, speed2, size, size2 = sp.symbols("phase phase2 speed speed2 size size2")
d1, d2, omega, zeta = sp.symbols("d1 d2 omega zeta")
EARTH = {g: Rational(981, 100)}


def torch_acrobot():
    """By Cramer's rule, inertia about the pivots."""
    h = m2 * l1 * lc2
    d11, d12, d22 = I1 + I2 + m2 * l1**2 + 2 * h * c2, I2 + h * c2, I2
    g2 = m2 * g * lc2 * sin(th1 + th2)
    first = h * s2 * w2 * (2 * w1 + w2) - ((m1 * lc1 + m2 * l1) * g * s1 + g2)
    second = tau - h * s2 * w1**2 - g2
    det = d11 * d22 - d12 * d12
    rows = [a1 - (d22 * first - d12 * second) / det, a2 - (-d12 * first + d11 * second) / det]
    return links(True, relative=True, forces={th2: tau}), rows


def passive_arm():
    """r1 and r2 are lc1 and lc2."""
    mass12 = I2 + m2 * (lc2 * lc2 + l1 * lc2 * c2)
    mass = sp.Matrix(
        [
            [I1 + I2 + m1 * lc1 * lc1 + m2 * (l1 * l1 + lc2 * lc2 + 2 * l1 * lc2 * c2), mass12],
            [mass12, I2 + m2 * lc2 * lc2],
        ]
    )
    turn = sp.Matrix([-(m2 * l1 * w2 * w2 * lc2 * s2) - 2 * m2 * l1 * w1 * w2 * lc2 * s2, m2 * l1 * w1 * w1 * lc2 * s2])
    weight = sp.Matrix([g * s1 * (m2 * l1 + m1 * lc1) + g * m2 * lc2 * sin(th1 + th2), g * m2 * lc2 * sin(th1 + th2)])
    return links(False, relative=True), list(mass * sp.Matrix([a1, a2]) + turn + weight), EARTH


def arm_with_numbers():
    one, two, three = I1 + I2 + m1 * lc1**2 + m2 * (l1**2 + lc2**2), m2 * l1 * lc2, I2 + m2 * lc2**2
    mass = sp.Matrix([[one + 2 * two * c2, three + two * c2], [three + two * c2, three]])
    turn = sp.Matrix([[-two * s2 * w2, -two * s2 * (w1 + w2)], [two * s2 * w1, 0]])
    outer = m2 * lc2 * g * cos(th1 + th2)
    weight = sp.Matrix([(m1 * lc1 + m2 * l1) * g * c1_ + outer, outer])
    rows = list(mass * sp.Matrix([a1, a2]) + turn * sp.Matrix([w1, w2]) + weight - sp.Matrix([tau1, tau2]))
    half, tenth = Rational(1, 2), Rational(1, 10)
    numbers = {m1: 1, m2: 1, l1: 1, l2: 1, lc1: half, lc2: half, I1: tenth, I2: tenth, **EARTH}
    return links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2}), rows, numbers


def sympy_columns():
    one = l * m * (I * w**2 + g * l * m * c + l**2 * m * w**2) * s
    two = l * m * (g * (M + m) + l * m * w**2 * c) * s
    return cart_pole(I), [
        xdd - one / (I * M + I * m + M * l**2 * m + l**2 * m**2 * s**2),
        al - two / (l**2 * m**2 * c**2 - (I + l**2 * m) * (M + m)),
    ]


def name_again():
    mass = sp.Matrix([[M + m, -m * l * c], [-m * l * c, m * l**2]])
    turn, damping = sp.Matrix([[0, m * l * s * w], [0, 0]]), sp.Matrix([[b, 0], [0, 0]])
    rates = sp.Matrix([xd, w])
    push = sp.Matrix([u, 0]) - turn * rates - damping * rates - sp.Matrix([0, -m * l * g * s])
    return cart_pole(up=True, left=True, forces={x: u - b * xd}), list(mass * sp.Matrix([xdd, al]) - push)


def trolley():
    """dc, dp and r are d1, d2 and l."""
    one = l * (d1 * xd - m * (g * s * c + l * s * w**2) - u) - d2 * c * w
    two = d2 * w * (m + M) + m**2 * l**2 * s * c * w**2 + m * l * (g * s * (m + M) + c * (u - d1 * xd))
    return cart_pole(forces={x: u - d1 * xd, th: -d2 * w}), [
        xdd - one / (-l * (M + m * s**2)),
        al - two / (m * l**2 * (-M - m * s**2)),
    ]


def portuguese():
    """b and c are d2 and d1."""
    below = m**2 * l**2 * s**2 + M * m * l**2 + (M + m) * I
    one = d2 * m * l * w * c + m**2 * l**2 * g * s * c + (I + m * l**2) * (F - d1 * xd + m * l * s * w**2)
    two = F * m * l * c - d1 * m * l * xd * c + m**2 * l**2 * w**2 * s * c + (M + m) * (d2 * w + m * g * l * s)
    return cart_pole(I, forces={x: F - d1 * xd, th: -d2 * w}), [xdd - one / below, al + two / below]


def ccode():
    p, q, v, z = s1, c1_, s2, c2
    one = (
        -g * p * v**2
        + 2 * g * p
        - g * v * q * z
        + 2 * l * w1**2 * p * q * z**2
        - l * w1**2 * p * q
        - 2 * l * w1**2 * v * q**2 * z
        + l * w1**2 * v * z
        + l * w2**2 * p * z
        - l * w2**2 * v * q
    )
    below = l**2 * m * (p * v / 2 + q * z / 2) * (p * v + q * z) - l**2 * m
    two = (-p * v / 2 - q * z / 2) * (2 * g * l * m * p - l**2 * m * (-p * z + v * q) * w2**2) / below
    three = (g * l * m * v - l**2 * m * (p * z - v * q) * w1**2) / below
    return EQUAL, [a1 - one / (l * (p**2 * v**2 + 2 * p * v * q * z + q**2 * z**2 - 2)), a2 - two - three]


def processing():
    num1, num2, num3 = -g * (2 * m1 + m2) * s1, -m2 * g * sin(th1 - 2 * th2), -2 * m2 * S
    num4, num5 = w2 * w2 * l2 + w1 * w1 * l1 * C, 2 * S
    num6, num7, num8 = w1 * w1 * l1 * (m1 + m2), g * (m1 + m2) * c1_, w2 * w2 * l2 * m2 * C
    num9 = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    return TWO, [a1 - (num1 + num2 + num3 * num4) / (l1 * num9), a2 - num5 * (num6 + num7 + num8) / (l2 * num9)]


def first_joint_damped():
    """Q1_DAMPING is d1."""
    below = m1 - m2 * C**2 + m2
    one = (
        g * m1 * s1
        + g * m2 * sin(th1 - 2 * th2) / 2
        + g * m2 * s1 / 2
        + l1 * m2 * sin(2 * th1 - 2 * th2) * w1**2 / 2
        + l2 * m2 * S * w2**2
        + d1 * w1
    )
    two = -(m1 + m2) * (g * s2 - l1 * S * w1**2) + (g * m1 * s1 + g * m2 * s1 + l2 * m2 * S * w2**2 + d1 * w1) * C
    true = bobs((l1, m1), (l2, m2), forces={th1: -d1 * l1 * w1})
    return true, [a1 + one / (l1 * below), a2 - two / (l2 * below)]


def feenox():
    return TWO, [
        (m1 + m2) * l1**2 * a1 + m2 * l1 * l2 * a2 * C + m2 * l1 * l2 * w2**2 * S + l1 * (m1 + m2) * g * s1,
        m2 * l2**2 * a2 + m2 * l1 * l2 * a1 * C - m2 * l1 * l2 * w1**2 * S + l2 * m2 * g * s2,
    ]


def generated():
    p = th2 - th1
    below = m1 + m2 - m2 * cos(p) ** 2
    one = m2 * ((g * s2 + l1 * w1**2 * sin(p)) * cos(p) + l2 * w2**2 * sin(p)) - g * (m1 + m2) * s1
    two = (m1 + m2) * (g * (-s2 + cos(p) * s1) - l1 * w1**2 * sin(p)) - l2 * m2 * w2**2 * cos(p) * sin(p)
    return TWO, [a1 - one / (below * l1), a2 - two / (below * l2)]


EXTENSION = elastic(k * r**2 / 2, length=r0 + r)


def extension():
    return EXTENSION, [
        rdd - ((r0 + r) * w * w - k / m * r + g * c),
        al + (g * s + 2 * rd * w) / (r0 + r),
    ]


def springy():
    """b is r0."""
    return EXTENSION, [
        rdd - ((r + r0) * w**2 - k / m * r - g * (1 - c)),
        al + (2 * w * rd + g * s) / (r0 + r),
    ]


def two_directions():
    """The phases omegax t + phix and omegay t + phiy, and their rates."""
    body = Body(m, size * cos(phase) + l * s, size2 * cos(phase2) - l * c)
    true = Mechanism([ANGLE], [body], shifts=False, phases={phase: speed, phase2: speed2})
    push = size / l * speed**2 * cos(phase) * c - (g - size2 * speed2**2 * cos(phase2)) * s / l
    return true, [al - push]


def slide_and_link():
    """d is l."""
    true = Mechanism([CART, ANGLE], [Body(m1, x, 0), Body(m2, x + l * c, l * s, I, th)], 0, {x: tau1, th: tau2})
    mass, rates = sp.Matrix([[m1 + m2, -m2 * l * s], [-m2 * l * s, I + m2 * l**2]]), sp.Matrix([xd, w])
    lower = sp.Matrix([[0, 0], [0, -m2 * l * c]])
    up, side = sp.Matrix([[0, -m2 * l * c], [0, 0]]), sp.Matrix([[0, 0], [-m2 * l * c, 0]])
    one, two = (lower + lower) / 2, (up + side - (up + side)) / 2
    turn = sp.Matrix([(rates.T * one * rates)[0], (rates.T * two * rates)[0]])
    return true, list(mass * sp.Matrix([xdd, al]) + turn - sp.Matrix([tau1, tau2])), {g: 0}


def mass_matrix_wheel():
    true = chain([(l1, m1, lc1, I1), (0, m2, 0, I2)], relative=True, up=True, forces={th2: tau})
    mass = sp.Matrix([[m1 * lc1**2 + m2 * l1**2 + I1 + I2, I2], [I2, I2]])
    return true, list(mass * sp.Matrix([a1, a2]) - sp.Matrix([(m1 * lc1 + m2 * l1) * g * s1, tau]))


def toolkit():
    true = pendulum(forces={th: tau - 2 * zeta * omega * w})
    return true, [al + 2 * zeta * omega * w + omega**2 * s - tau], {m: 1, l: 1, g: omega**2}


def driven_rows():
    tenth = Rational(1, 10)
    true = pendulum(forces={th: cos(phase) - tenth * w})
    return true, [al - (cos(phase) - tenth * w - s)], {m: 1, l: 1, g: 1}


def haskell():
    true = pendulum()
    (p,), (force,) = momenta(true)
    number = Rational(98, 10)
    return true, [force + m * number * l * s], [w - p / (m * l * l)], {g: number}


def eliminated():
    """q[0], q[2], q[4] are th1, th2, th3."""
    m12, m012 = m2 + m3, m1 + m2 + m3
    mf = m012 / 4
    sin0, sin1, sin2 = sin(th1), sin(th2), sin(th3)
    cos01, cos02, cos12 = cos(th1 - th2), cos(th1 - th3), cos(th2 - th3)
    sin01, sin02, sin12 = sin(th1 - th2), sin(th1 - th3), sin(th2 - th3)
    r1, r2, r3 = m12 * cos01 * cos02 - m012 * cos12, m012 - m12 * cos01**2, -m012 + m3 * cos02**2
    inner = r1 * cos01 + r2 * cos02
    third = -g * sin2 + l1 * sin02 * w1**2 + l2 * sin12 * w2**2
    second = (
        -g * m2 * sin1 - g * m3 * sin1 + l1 * m2 * sin01 * w1**2 + l1 * m3 * sin01 * w1**2 - l3 * m3 * sin12 * w3**2
    )
    squared = -m3 * m12 * (-cos02 + cos(th1 - 2 * th2 + th3)) ** 2 * m012
    first = (
        g * m1 * sin0
        + g * m2 * sin0
        + g * m3 * sin0
        + l2 * m2 * sin01 * w2**2
        + l2 * m3 * sin01 * w2**2
        + l3 * m3 * sin02 * w3**2
    )
    below = m3 * r1**2 + m12 * r3 * r2
    one = (
        mf
        * (
            4 * m3 * m12 * inner * third * r2
            - 4 * (-m3 * inner * r1 + (m3 * r1**2 + m12 * r3 * r2) * cos01) * second
            - (squared + 4 * m3 * r1**2 + 4 * m12 * r3 * r2) * first
        )
        / (l1 * below * m012 * r2)
    )
    two = (
        -m3 * r1 * m012 * third * r2
        - (m3 * (r1 * cos01 + r2 * cos02) * r1 - (m3 * r1**2 + m12 * r3 * r2) * cos01) * first
        + m012 * r3 * r2 * second
    ) / (l2 * below * r2)
    last = -(m12 * inner * first + m12 * m012 * third * r2 - r1 * m012 * -second) / (l3 * (m3 * r1**2 + m12 * r3 * r2))
    return THREE, [a1 - one, a2 - two, a3 - last], EARTH


def julia_view():
    """C times the first two entries of x, which are the coordinates."""
    mass = sp.Matrix([[M + m, m * l * c], [m * l * c, m * l**2]])
    turn = sp.Matrix([[0, -m * th * l * s], [0, 0]])
    right = turn * sp.Matrix([x, th]) + sp.Matrix([0, m * g * l * s]) - sp.Matrix([u, 0])
    return cart_pole(forces={x: u}), list(mass * sp.Matrix([xdd, al]) + right)


def casadi_fractions():
    one = -m * l * s * w**2 + m * g * c * s + u
    two = -m * l * c * w**2 + u * c + (M + m) * g * s
    below = M + m - m * c**2
    numbers = {M: 1, m: Rational(1, 10), l: Rational(8, 10), **EARTH}
    return cart_pole(up=True, left=True, forces={x: u}), [xdd - one / below, al - two / (l * below)], numbers


def underscores():
    """A rod of half length l; 4 / 3 is four thirds."""
    one = (g * s * (M + m) - (F + m * l * th**2 * s) * c) / (Rational(4, 3) * l * (M + m) - m * l * c**2)
    two = (F - m * l * (al * c - xd**2 * s)) / (M + m)
    return cart_pole(m * l**2 / 3, up=True, forces={x: F}), [xdd - two, al - one]


def adjugate():
    """A motor at the second joint turns the second link against the first."""
    pairs = [(l1, m1, lc1, I1 - m1 * lc1**2), (l2, m2, lc2, I2 - m2 * lc2**2)]
    true = chain(pairs, horizontal=True, forces={th1: tau1 - tau2, th2: tau2})
    mass = sp.Matrix([[I1 + l1**2 * (m1 + 2 * m2), l1 * l2 * m2 * C], [l1 * l2 * m2 * C, I2 + l2**2 * m2]])
    turn = sp.Matrix([l1 * l2 * m2 * w2**2 * S, -l1 * l2 * m2 * w1**2 * S])
    weight = g * sp.Matrix([lc1 * m1 * c1_ + l2 * m2 * c2, lc2 * m2 * c2])
    return true, list(mass * sp.Matrix([a1, a2]) + turn + weight - sp.Matrix([tau1, tau2]))


def fortran():
    one = (-S * w2**2 - 2 * S * w1**2 * C + g / l * s2 * C - g / l * s1) / (1 - 2 * C**2)
    return EQUAL, [a1 - one, a2 - (-2 * C * a1 + 2 * S * w1**2 - g / l * s2)]


def eigen_members():
    """Uniform poles, their centres at l1 and l2, their lengths twice that."""
    true = chain([(2 * l1, m1, l1, m1 * l1**2 / 3), (2 * l2, m2, l2, m2 * l2**2 / 3)], up=True, cart=M, forces={x: F})
    long1, long2 = 2 * l1, 2 * l2
    h1, h2, h3 = M + m1 + m2, m1 * l1 + m2 * long1, m2 * l2
    h4, h5, h6 = (
        m1 * l1 * l1 + m2 * long1 * long1 + m1 * long1 * long1 / 3,
        m2 * l2 * long1,
        m2 * l2 * l2 + m2 * long2 * long2 / 3,
    )
    h7, h8 = m1 * l1 * g + m2 * long1 * g, m2 * l2 * g
    mass = sp.Matrix([[h1, h2 * c1_, h3 * c2], [h2 * c1_, h4, h5 * C], [h3 * c2, h5 * C, h6]])
    turn = sp.Matrix([[0, -h2 * w1 * s1, -h3 * w2 * s2], [0, 0, h5 * w2 * S], [0, -h5 * w1 * S, 0]])
    right = sp.Matrix([F, 0, 0]) - turn * sp.Matrix([xd, w1, w2]) - sp.Matrix([0, -h7 * s1, -h8 * s2])
    return true, list(mass * sp.Matrix([xdd, a1, a2]) - right)


def readme_rod():
    return pendulum(forces={th: tau}), [al + 3 * g / (2 * l) * s - 3 / (m * l**2) * tau]


def momenta_in_y():
    (p1, p2), (force1, force2) = momenta(TWO)
    around = m1 + m2 * S**2
    one = p1 * p2 * S / (l1 * l2 * around)
    two = (
        (l2**2 * m2 * p1**2 + l1**2 * (m1 + m2) * p2**2 - l1 * l2 * m2 * p1 * p2 * C)
        / (2 * l1**2 * l2**2 * around) ** 2
        * sin(2 * D)
    )
    rates = [
        w1 - (l2 * p1 - l1 * p2 * C) / (l1**2 * l2 * around),
        w2 - (l1 * (m1 + m2) * p2 - l2 * m2 * p1 * C) / (l1 * l2**2 * m2 * around),
    ]
    return TWO, [force1 + (m2 + m1) * g * l1 * s1 + one - two, force2 + m2 * g * l2 * s2 - one + two], rates


PROOFS = {
    "ac-torch-columns": torch_acrobot(),
    "arm-passive-odeint": passive_arm(),
    "arm-mcg-numbers": arm_with_numbers(),
    "arm-adjugate": adjugate(),
    "cp-sympy-columns": sympy_columns(),
    "cp-name-again": name_again(),
    "cp-modelica-trolley": trolley(),
    "cp-portuguese-struct": portuguese(),
    "cp-julia-view": julia_view(),
    "cp-casadi-fractions": casadi_fractions(),
    "cp-underscores": underscores(),
    "dc-eigen-members": eigen_members(),
    "dp-gsl-ccode": ccode(),
    "dp-processing-method": processing(),
    "dp-first-joint-damped": first_joint_damped(),
    "dp-feenox": feenox(),
    "dp-latex-generated": generated(),
    "dp-fortran-uses-first": fortran(),
    "dp-momenta-matlab": momenta_in_y(),
    "el-extension-odeint": extension(),
    "el-springy": springy(),
    "mv-two-directions": two_directions(),
    "pr-christoffel": slide_and_link(),
    "rw-mass-matrix": mass_matrix_wheel(),
    "sp-toolkit-operators": toolkit(),
    "sp-driven-rows": driven_rows(),
    "sp-haskell-hamilton": haskell(),
    "sp-r-desolve": (pendulum(), [al + g * s / l], EARTH),
    "sp-readme-rod": readme_rod(),
    "tp-eliminated": eliminated(),
}
