"""What arms, carts, single pendulums, springs and wheels print, entered by hand, and what each is said to describe."""

import sympy as sp
from mechanisms import (
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
    u,
    w,
    w1,
    w2,
    wheel,
    x,
    xd,
    xdd,
)  # fmt: skip
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange

half = Rational(1, 2)
D = th1 - th2
S1, S2, C2, S12, C1, C12 = sin(th1), sin(th2), cos(th2), sin(th1 + th2), cos(th1), cos(th1 + th2)
ELBOW = links(pivot=True, relative=True, forces={th2: u})
ELBOW_CENTRE = links(pivot=False, relative=True, forces={th2: u})
ARM = links(pivot=False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
CRAIG = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})


def manipulator():
    """M, C, τ_g, B of the acrobot about its pivots, row by row."""
    m12 = I2 + l1 * lc2 * m2 * C2
    gravity2 = -g * lc2 * m2 * S12
    gravity1 = -g * lc1 * m1 * S1 - g * m2 * (l1 * S1 + lc2 * S12)
    return [
        (I1 + I2 + l1**2 * m2 + 2 * l1 * lc2 * m2 * C2) * a1 + m12 * a2
        + (-2 * w2 * l1 * lc2 * m2 * S2) * w1 + (-w2 * l1 * lc2 * m2 * S2) * w2 - gravity1,
        m12 * a1 + I2 * a2 + w1 * l1 * lc2 * m2 * S2 * w1 - gravity2 - u,
    ]  # fmt: skip


def tomlab():
    t_a, t_b = m2 * g * l2, m2 * l1 * lc2
    h11, h12, h22 = I1 + I2 + m2 * l1**2 + 2 * t_b * C2, I2 + t_b * C2, I2
    phi1 = 2 * t_b * S2 * w1 * w2 + t_b * S2 * w2**2 - (m1 * lc1 + m2 * l1) * g * S1 - t_a * S12 - b1 * w1
    phi2 = u - t_b * S2 * w1**2 - t_a * S12 - b2 * w2
    det = h11 * h22 - h12**2
    return [a1 - (h22 * phi1 - h12 * phi2) / det, a2 - (-h12 * phi1 + h11 * phi2) / det]


def issue_393():
    return (half * m1 * lc1**2 * w1**2 + half * I1 * w1**2
            + half * m2 * (l1**2 * w1**2 + lc2**2 * (w1 + w2) ** 2 + 2 * l1 * lc2 * w1 * (w1 + w2) * C2)
            + half * I2 * w2**2 + m1 * g * lc1 * C1 + m2 * g * (l1 * C1 + lc2 * C12))  # fmt: skip


def gym_acrobot(book):
    d1 = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * C2) + I1 + I2
    d2 = m2 * (lc2**2 + l1 * lc2 * C2) + I2
    phi2 = m2 * lc2 * g * cos(th1 + th2 - sp.pi / 2)
    phi1 = (-m2 * l1 * lc2 * w2**2 * S2 - 2 * m2 * l1 * lc2 * w2 * w1 * S2
            + (m1 * lc1 + m2 * l1) * g * cos(th1 - sp.pi / 2) + phi2)  # fmt: skip
    centrifugal = m2 * l1 * lc2 * w1**2 * S2 if book else 0
    return [
        a2 - (u + d2 / d1 * phi1 - centrifugal - phi2) / (m2 * lc2**2 + I2 - d2**2 / d1),
        a1 + (d2 * a2 + phi1) / d1,
    ]


def craig():
    return [
        -tau1 + m2 * l2**2 * (a1 + a2) + m2 * l1 * l2 * C2 * (2 * a1 + a2) + (m1 + m2) * l1**2 * a1
        - m2 * l1 * l2 * S2 * w2**2 - 2 * m2 * l1 * l2 * S2 * w1 * w2 + m2 * l2 * g * C12 + (m1 + m2) * l1 * g * C1,
        -tau2 + m2 * l1 * l2 * C2 * a1 + m2 * l1 * l2 * S2 * w1**2 + m2 * l2 * g * C12 + m2 * l2**2 * (a1 + a2),
    ]  # fmt: skip


def spong(square=2):
    d11 = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * C2) + I1 + I2
    d12, d22 = m2 * (lc2**2 + l1 * lc2 * C2) + I2, m2 * lc2**2 + I2
    h = m2 * l1 * lc2 * S2
    g2 = m2 * lc2 * g * C12
    g1 = (m1 * lc1 + m2 * l1) * g * C1 + g2
    return [d11 * a1 + d12 * a2 - h * w1 * w2 - h * w2 * w1 - h * w2**square + g1 - tau1,
            d12 * a1 + d22 * a2 + h * w1**2 + g2 - tau2]  # fmt: skip


def double_cart(mistakes):
    """Two links with centres lc, lengths l, on a cart; angles from the upward vertical, to the right."""
    d1, d2, d3 = M + m1 + m2, m1 * lc1 + m2 * l1, m2 * lc2
    d4 = m1 * lc1**2 + m2 * (l2 if mistakes else l1) ** 2 + I1
    d5, d6, f1, f2 = m2 * l1 * lc2, m2 * lc2**2 + I2, (m1 * lc1 + m2 * l1) * g, m2 * lc2 * g
    c32 = d5 * sin(D) * w1 if mistakes else -d5 * sin(D) * w1
    return [
        d1 * xdd + d2 * C1 * a1 + d3 * C2 * a2 - d2 * S1 * w1 * w1 - d3 * S2 * w2 * w2 - u,
        d2 * C1 * xdd + d4 * a1 + d5 * cos(D) * a2 + d5 * sin(D) * w2 * w2 - f1 * S1,
        d3 * C2 * xdd + d5 * cos(D) * a1 + d6 * a2 + c32 * w1 - f2 * S2,
    ]


def equal_l2():
    both = m1 + m2
    return both / 2 * (xd**2 + 2 * l1 * (w1 * xd - g) * C1 + l1**2 * w1**2) + m2 / 2 * (
        l2**2 * w2**2 + 2 * l2 * (w2 * xd - g) * C2 + 2 * l1 * l2 * w1 * w2 * cos(D)
    )


def balancing():
    kinetic = (half * m1 * (xd**2 + (l1 * w1) ** 2 + 2 * l1 * w1 * xd * C1)
               + half * m2 * ((xd + l1 * w1 * C1 + l2 * w2 * C2) ** 2 + (l1 * w1 * S1 + l2 * w2 * S2) ** 2)
               + half * M * xd**2)  # fmt: skip
    return kinetic - (-m1 * g * l1 * C1 - m2 * g * (l1 * C1 + l2 * C2))


S, C = sin(th), cos(th)
HINGED = {x: F, th: -b2 * w}
FRICTION = {x: F - b * xd}
CART_BOB = (M + m) * xdd + m * l * al * C - m * l * w**2 * S
SPRING = k * x**2 / 2
RODL = m * l**2 / 3


def rod_energies():
    return M / 2 * xd**2 + m / 2 * (xd**2 + l**2 * w**2 / 3 + l * xd * w * C) - (-m * g * l / 2 * C)


def solved_up(force):
    """Cart and bob from the upward vertical."""
    below = M + m - m * C**2
    return [xdd - (force + m * l * w**2 * S - m * g * S * C) / below,
            al - ((M + m) * g * S - C * (force + m * l * w**2 * S)) / ((M + m) * l - m * l * C**2)]  # fmt: skip


def gym_cart():
    temp = (F + m * l * w**2 * S) / (M + m)
    return [
        al - (g * S - C * temp) / (l * (Rational(4, 3) - m * C**2 / (M + m))),
        xdd - temp + m * l * al * C / (M + m),
    ]


def backslash():
    return [(M + m) * xdd + m * l * C * al - (F - b * xd + m * l * w**2 * S), m * l * C * xdd + m * l**2 * al
            - (-b2 * w - m * g * l * S)]  # fmt: skip


def matlab_phi():
    ky = m**2 * l**2 * C**2 - (M + m) * (I + m * l**2)
    return [
        xdd - ((I + m * l**2) * (b * xd - m * l * w**2 * S - F) + m**2 * l**2 * g * S * C) / ky,
        al - (F * m * l * C - b * m * l * xd * C - (M + m) * m * l * g * S + m**2 * l**2 * w**2 * S * C) / ky,
    ]


def game_cart():
    return [
        al - (-m * w**2 * S * C - (g / l) * (M + m) * S) / (M + m - m * C**2),
        xdd + m * l / (M + m) * (al * C - w**2 * S),
    ]


SE_ROWS = [xdd * C + l * al - g * S, (m + M) * xdd + m * l * (al * C - w**2 * S) + k * x]
SE_X = xdd - (-k * x - m * l * (-S * w**2 - g / l * C * S)) / (m + M - m * C**2)


def brunton():
    d = m * l * l * (M + m * (1 - C**2))
    inner = m * l * w**2 * S - b * xd
    return [
        xdd - ((-(m**2) * l**2 * g * C * S + m * l**2 * inner) / d + m * l * l / d * F),
        al - (((m + M) * m * g * l * S - m * l * C * inner) / d - m * l * C / d * F),
    ]


def wiki_cart():
    return half * (M + m) * xd**2 - m * l * xd * w * C + half * m * l**2 * w**2 - m * g * l * C


LEFT_UP = cart_pole(up=True, left=True)
RIGHT_UP = cart_pole(up=True)
HUNG = bobs((l1, m1), (l2, m2), cart=0)
CARTED = bobs((l1, m1), (l2, m2), cart=M)
RIGHT = chain([(l1, m1, lc1, I1), (l2, m2, lc2, I2)], cart=M, up=True, forces={x: u})
STRETCHED = elastic(k * (r - r0) ** 2 / 2)
a = sp.Symbol("a", positive=True)
HANGING = elastic(k * (r + m * g / k) ** 2 / 2, length=a + r)
WHEEL = wheel(I1, I2, forces={th: -b1 * w, ph: tau - b2 * phd})
CUBE = wheel(I1 + m * l**2, I2, up=False, forces={ph: u})
f, fd, fdd = CART
KAPITZA = Mechanism([CART, (th, w, al)], [Body(m, l * S, f + l * C)], 0, {x: sp.Symbol("P")})


def scribd_wheel():
    arm = Body(m1, lc1 * S, lc1 * C, I1, th)
    return Mechanism([(th, w, al), (ph, phd, phdd)], [arm, Body(m2, l2 * S, l2 * C, I2, th + ph)])


def scribd_lagrangian():
    return (half * (m1 * lc1**2 + m2 * l2**2 + I1 + I2) * w**2 + I2 * w * phd + half * I2 * phd**2
            - (m1 * lc1 + m2 * l2) * g * C)  # fmt: skip


PROOFS = {
    "ac-kidyco-matrices": (ELBOW, manipulator()),
    "ac-tedrake-short": (ELBOW, manipulator()),
    "ac-tomlab": (links(pivot=True, relative=True, forces={th1: -b1 * w1, th2: u - b2 * w2}), tomlab()),
    "ac-issue-393": (links(pivot=False, relative=True), lagrange(issue_393(), links(pivot=False, relative=True))),
    "ac-gym-book": (ELBOW_CENTRE, gym_acrobot(book=True)),
    "ac-gym-nips": (ELBOW_CENTRE, gym_acrobot(book=False)),
    "arm-craig": (CRAIG, craig()),
    "arm-boxed": (CRAIG, craig()[::-1]),
    "arm-spong-matrices": (ARM, spong()),
    "arm-lost-square": (ARM, spong(square=1)),
    "arm-christoffel": (ARM, spong()),
    "dc-bogdanov": (RIGHT, double_cart(mistakes=False)),
    "dc-krishnamoorthi": (RIGHT, double_cart(mistakes=True)),
    "dc-equal-l2": (HUNG, lagrange(equal_l2(), HUNG)),
    "dc-balancing-energies": (CARTED, lagrange(balancing(), CARTED)),
    "cp-dasimagin": (cart_pole(I, forces=HINGED), [
        m * xdd * l * C + al * (m * l**2 + I) + m * g * l * S + b2 * w, xdd * (M + m) + m * l * al * C
        - m * l * w**2 * S - F]),
    "cp-rod-energies": (cart_pole(m * l**2 / 12, arm=l / 2), lagrange(rod_energies(), cart_pole())),
    "cp-lund": (cart_pole(I, forces=FRICTION), [
        CART_BOB + b * xd - F, (I + m * l**2) * al + m * g * l * S + m * l * xdd * C]),
    "cp-readme-sign": (cart_pole(forces=FRICTION), [
        CART_BOB + b * xd - F, m * l**2 * al + m * g * l * S - m * l * xdd * C]),
    "cp-chinese-rows": (cart_pole(up=True, forces={x: F}), [
        CART_BOB - F, m * l**2 * al + m * l * xdd * C - m * g * l * S]),
    "cp-chinese-solved": (cart_pole(up=True, forces={x: F}), solved_up(F)),
    "cp-chinese-rod-matrix": (cart_pole(m * l**2 / 12, up=True, left=True, arm=l / 2, forces={x: F}), [
        m * l**2 / 3 * al - m * l * C / 2 * xdd - m * g * l * S / 2,
        -m * l * C / 2 * al + (M + m) * xdd - (F - m * l * S * w**2 / 2)]),
    "cp-gym-latex": (cart_pole(RODL, up=True, forces={x: F}), gym_cart()),
    "cp-gym-python": (cart_pole(RODL, up=True, forces={x: F}), gym_cart()),
    "cp-casadi-docstring": (cart_pole(RODL, up=True, left=True, forces={x: F}), [
        xdd * C + g * S * l - Rational(4, 3) * l * al, (M + m) * xdd - (F + m * l * w**2 * S - m * l * al * C)]),
    "cp-matlab-backslash": (cart_pole(forces={x: F - b * xd, th: -b2 * w}), backslash()),
    "cp-matlab-phi": (cart_pole(I, up=True, forces=FRICTION), matlab_phi()),
    "cp-game": (cart_pole(), game_cart()),
    "cp-spring-left": (cart_pole(left=True, potential=SPRING), [
        (M + m) * xdd - m * l * C * al + m * l * S * w**2 + k * x, m * l**2 * al - m * l * C * xdd + m * g * l * S]),
    "cp-spring-se-rows": (cart_pole(up=True, potential=SPRING), SE_ROWS),
    "cp-spring-se-solved": (cart_pole(potential=SPRING), [SE_X, al - (-g * S - C * xdd) / l]),
    "cp-spring-se-mixed": (cart_pole(potential=SPRING), [SE_ROWS[0], SE_X]),
    "cp-wiki-lagrangian": (LEFT_UP, lagrange(wiki_cart(), LEFT_UP)),
    "cp-wiki-rows": (cart_pole(up=True, left=True, forces={x: F}), [
        (M + m) * xdd - m * l * al * C + m * l * w**2 * S - F, l * al - g * S - xdd * C]),
    "cp-brunton": (cart_pole(up=True, forces=FRICTION), brunton()),
    "cp-casadi-book": (RIGHT_UP, lagrange(
        half * xd**2 + m * l * xd * w * C + half * m * l**2 * w**2 - m * g * l * C, RIGHT_UP)),
    "sp-schawe-euler": (pendulum(), [al + m * g * l * S]),
    "sp-gym-pendulum": (pendulum(m * l**2 / 12, up=True, arm=l / 2, forces={th: u}), [
        al - (-3 * g / (2 * l) * sin(th + sp.pi) + 3 / (m * l**2) * u)]),
    "sp-underactuated-125": (pendulum(forces={th: -b * m * l**2 * w}), [al - (-g / l * C - b * w)]),
    "sp-physical": (pendulum(I - m * l**2), [I * al + l * m * g * S]),
    "sp-eta": (pendulum(up=True, forces={th: -b * w}), [al - (g / l * S - b / (m * l**2) * w)]),
    "sp-inverted-mess": (pendulum(), [m * l**2 * al - m * l * w**2 - m * g * l * C]),
    "el-soton-energies": (STRETCHED, lagrange(
        half * m * (rd**2 + r**2 * w**2) - (-m * g * r * C + half * k * (r - r0) ** 2), STRETCHED)),
    "el-game": (STRETCHED, [
        rdd - (r * w**2 - k / m * (r - r0) + g * C), al - (-(2 * rd * w) / r - g / r * S)]),
    "el-physicsforums": (HANGING, lagrange(
        half * m * rd**2 + half * m * r**2 * w**2 + m * g * r * C - half * k * r**2, HANGING)),
    "el-coriolis": (STRETCHED, [m * rdd - m * r * w**2 - m * g * C + k * (r - r0), r * al + rd * w + g * S]),
    "rw-dreaazy-rows": (WHEEL, [
        al * (I1 + I2) + I2 * phdd - m * g * l * S + b1 * w, I2 * phdd + I2 * al - tau + b2 * phd]),
    "rw-dreaazy-lagrangian": (wheel(I1, I2), lagrange(
        half * I2 * (w + phd) ** 2 + half * I1 * w - m * g * l * C, wheel(I1, I2))),
    "rw-cube-rows": (CUBE, [(I1 + m * l**2 + I2) * al + I2 * phdd + m * g * l * C, I2 * (al + phdd) - u]),
    "rw-cube-lagrangian": (CUBE, lagrange(
        half * (I1 + m * l**2) * w**2 + I2 * (w + phd) ** 2 + m * g * l * C, CUBE)),
    "rw-scribd-energies": (scribd_wheel(), lagrange(scribd_lagrangian(), scribd_wheel())),
    # One row: with the support's motion given, its own row is the true one, which only says what force moves it
    "mv-nakanishi": (KAPITZA, [lagrange(
        half * m * ((l * w * C) ** 2 + (fd - l * w * S) ** 2) - m * g * (f + l * C), KAPITZA)[0],
        al - (g / l + fdd / l) * S]),
}  # fmt: skip
