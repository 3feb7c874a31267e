"""What carts, springs, wheels and arms of this folder print, entered by hand, and what each is said to describe."""

import sympy as sp
from mechanisms import (  # fmt: skip
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
    cart_pole,
    chain,
    g,
    k,
    l,
    l1,
    l2,
    lc1,
    lc2,
    m,
    m1,
    m2,
    ph,
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
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, lagrange

S1, S2, C1, C2, S12, C12 = sin(th1), sin(th2), cos(th1), cos(th2), sin(th1 + th2), cos(th1 + th2)
s, c = sin(th), cos(th)
gamma, sign, m0 = sp.symbols("gamma sgn m0")


def ctms(pull=1):
    true = cart_pole(inertia=I, forces={x: F - b * xd})
    return true, [(M + m) * xdd + b * xd + m * l * al * c - m * l * w**2 * s - F,
                  (I + m * l**2) * al + m * g * l * s + pull * m * l * xdd * c]  # fmt: skip


def astrom():
    """The angle to the left of the upward vertical."""
    true = cart_pole(inertia=I, up=True, left=True, forces={x: F - b * xd, th: -gamma * w})
    return true, [(M + m) * xdd - m * l * c * al + b * xd + m * l * s * w**2 - F,
                  -m * l * c * xdd + (I + m * l**2) * al + gamma * w - m * g * l * s]  # fmt: skip


def tedrake():
    true = cart_pole(forces={x: u})
    return true, [
        (M + m) * xdd + m * l * c * al - m * l * w * s * w - u,
        m * l * c * xdd + m * l**2 * al + m * g * l * s,
    ]


def tedrake_solved():
    true = cart_pole(forces={x: F})
    below = M + m * s**2
    return true, [xdd - (F + m * s * (l * w**2 + g * c)) / below,
                  al - (-F * c - m * l * w**2 * c * s - (M + m) * g * s) / (l * below)]  # fmt: skip


def florian(thirds=4, friction=0):
    """A uniform pole of half length l, to the right of the upward vertical."""
    true = cart_pole(inertia=m * l**2 / 3, up=True, forces={x: F, th: -friction * w})
    above = g * s + c * (-F - m * l * w**2 * s) / (M + m) - friction * w / (m * l)
    return true, [al - above / (l * (Rational(thirds, 3) - m * c**2 / (M + m))),
                  xdd - (F + m * l * (w**2 * s - al * c)) / (M + m)]  # fmt: skip


def modelica():
    true = cart_pole(forces={x: F})
    return true, [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s - F,
        m * l * xdd * c + m * l**2 * al + m * g * l * s,
    ]


def on_a_spring():
    true = cart_pole(mass=m, bob=M, potential=k * x**2 / 2)
    printed = (m + M) * xd**2 / 2 + M * (l**2 * w**2 + 2 * xd * l * w * c) / 2 - k * x**2 / 2 + M * g * l * c
    return true, lagrange(printed, true)


def twice_mixed():
    true = cart_pole(mass=m1, bob=m2)
    return true, [(m1 + m2) * xdd + 2 * m2 * l * (al * c - w**2 * s), l * al + 2 * xdd * c + g * s]


def two_poles():
    bodies = [Body(M, x, sp.Integer(0))]
    bodies += [Body(mass, x + arm * sin(q), -arm * cos(q), mass * arm**2 / 3, q) for mass, arm, q in
               ((m1, l1, th1), (m2, l2, th2))]  # fmt: skip
    true = Mechanism([CART, (th1, w1, a1), (th2, w2, a2)], bodies, 0, {x: F})
    force = sum(mass * arm * v**2 * sin(q) + Rational(3, 4) * mass * cos(q) * g * sin(q) for mass, arm, q, v in
                ((m1, l1, th1, w1), (m2, l2, th2, w2)))  # fmt: skip
    masses = sum(mass * (1 - Rational(3, 4) * cos(q) ** 2) for mass, q in ((m1, th1), (m2, th2)))
    poles = [acc + Rational(3, 4) / arm * (xdd * cos(q) + g * sin(q)) for acc, arm, q in ((a1, l1, th1), (a2, l2, th2))]
    return true, [xdd - (F + force) / (M + masses), *poles]


def dry():
    true = cart_pole(up=True, forces={x: F - b * sign})
    return true, [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s + b * sign - F,
        m * l**2 * al + m * l * xdd * c - m * g * l * s,
    ]


def quanser():
    true = cart_pole(inertia=I, up=True, forces={x: F - b * xd, th: -gamma * w})
    return true, [(M + m) * xdd + m * l * c * al - m * l * s * w**2 - F + b * xd,
                  m * l * c * xdd + (I + m * l**2) * al - m * g * l * s + gamma * w]  # fmt: skip


def two_links_on_a_cart():
    true = chain([(l1, m1, lc1, I1), (l2, m2, lc2, I2)], up=True, cart=m0, forces={x: F})
    e, n = th1 - th2, m1 * lc1 + m2 * l1
    return true, [
        (m0 + m1 + m2) * xdd + n * (a1 * C1 - w1**2 * S1) + m2 * lc2 * (a2 * C2 - w2**2 * S2) - F,
        (I1 + m1 * lc1**2 + m2 * l1**2) * a1
        + n * xdd * C1
        + m2 * l1 * lc2 * (a2 * cos(e) + w2**2 * sin(e))
        - n * g * S1,
        (I2 + m2 * lc2**2) * a2
        + m2 * lc2 * xdd * C2
        + m2 * l1 * lc2 * (a1 * cos(e) - w1**2 * sin(e))
        - m2 * g * lc2 * S2,
    ]


def spring(length, rest, printed):
    """A bob at ``length`` on a spring that is stretched by r − rest."""
    true = Mechanism([(r, rd, rdd), (th, w, al)], [Body(m, length * s, -length * c)], k * (r - rest) ** 2 / 2)
    return true, printed if isinstance(printed, list) else lagrange(printed, true)


def spong_wheel():
    """I2 about the wheel's axle, which is at l1 and carries m2."""
    bodies = [Body(m1, lc1 * s, lc1 * c, I1, th), Body(m2, l1 * s, l1 * c, I2, th + ph)]
    true = Mechanism([(th, w, al), (ph, sp.Symbol("dph", real=True), phdd)], bodies, 0, {ph: tau})
    d11 = m1 * lc1**2 + m2 * l1**2 + I1 + I2
    return true, [d11 * al + I2 * phdd - (m1 * lc1 + m2 * l1) * g * s, I2 * al + I2 * phdd - tau]


def motor_reaction():
    true = wheel(I1, I2, forces={ph: tau})
    return true, [al - (m * g * l * s + tau) / I1, phdd - tau / I2 + al]


def arm(pivot=False, horizontal=True, coriolis=2, forces=None, gravity=g):
    """Two links, rows with a factor of the Coriolis term and what drives them."""
    one, two = (0, 0) if pivot else (m1 * lc1**2, m2 * lc2**2)
    inner, outer = (m1 * lc1**2, m2 * lc2**2) if pivot else (0, 0)
    true = chain(
        [(l1, m1, lc1, I1 - inner), (l2, m2, lc2, I2 - outer)], relative=True, horizontal=horizontal, forces=forces
    )
    turn, both = (C1, C12) if horizontal else (S1, S12)
    h = m2 * l1 * lc2
    forces = forces or {}
    return true, [
        (I1 + one + I2 + two + m2 * l1**2 + 2 * h * C2) * a1 + (I2 + two + h * C2) * a2 - coriolis * h * S2 * w1 * w2
        - h * S2 * w2**2 + (m1 * lc1 + m2 * l1) * gravity * turn + m2 * lc2 * gravity * both - forces.get(th1, 0),
        (I2 + two + h * C2) * a1 + (I2 + two) * a2 + h * S2 * w1**2 + m2 * lc2 * gravity * both - forces.get(th2, 0),
    ]  # fmt: skip


def twice_christoffel():
    true, (first, second) = arm(forces={th1: tau1, th2: tau2})
    h = m2 * l1 * lc2 * S2
    return true, [first + 2 * h * w1 * w2 + h * w2**2 - 2 * h * w2 * w1 - h * (w1 + w2) * w2, second]


def lying_flat():
    return *arm(forces={th1: tau1, th2: tau2}, gravity=0), {g: 0}


def slide_on_an_arm(coriolis=2):
    """d2 as r."""
    bodies = [Body(m1, l1 * c, l1 * s, I1, th), Body(m2, r * c, r * s)]
    true = Mechanism([(th, w, al), (r, rd, rdd)], bodies, 0, {th: tau1, r: tau2})
    return true, [
        (m1 * l1**2 + I1 + m2 * r**2) * al + coriolis * m2 * r * w * rd + (m1 * l1 + m2 * r) * g * c - tau1,
        m2 * rdd - m2 * r * w**2 + m2 * g * s - tau2,
    ]


BOTH = {th1: tau1, th2: tau2}
PROOFS = {
    "cp-astrom": astrom(), "cp-ctms": ctms(), "cp-ctms-sign": ctms(pull=-1), "cp-underactuated": tedrake(),
    "cp-underactuated-solved": tedrake_solved(), "cp-florian": florian(friction=gamma), "cp-barto": florian(thirds=2),
    "cp-modelica": modelica(), "cp-lagrangian-spong": on_a_spring(), "cp-landau": twice_mixed(),
    "cp-double-pole": two_poles(), "cp-dry": dry(), "cp-quanser": quanser(), "dc-two-rods": two_links_on_a_cart(),
    "el-morin": spring(l + r, 0, [m * rdd - m * (l + r) * w**2 - m * g * c + k * r,
                                  m * (l + r) * al + 2 * m * rd * w + m * g * s]),
    "el-morin-half": spring(l + r, 0, m * (rd**2 + r**2 * w**2) / 2 + m * g * (l + r) * c - k * r**2 / 2),
    "el-python": spring(r, r0, [rdd - r * w**2 + k / m * (r - r0) - g * c, al + g / r * s + 2 * rd * w / r]),
    "rw-spong": spong_wheel(), "rw-torque": motor_reaction(),
    "ac-pendubot": arm(forces={th1: tau1}), "ac-matlab": arm(horizontal=False, forces={th2: u}),
    "ac-coriolis": arm(pivot=True, horizontal=False, coriolis=1, forces={th2: tau}),
    "arm-asada": arm(forces=BOTH), "arm-siciliano": arm(forces=BOTH), "arm-half-christoffel": twice_christoffel(),
    "arm-mls": lying_flat(), "arm-rp": slide_on_an_arm(), "arm-rp-coriolis": slide_on_an_arm(coriolis=1),
}  # fmt: skip
