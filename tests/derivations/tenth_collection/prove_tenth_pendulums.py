"""What the pendulums, springs, arms and wheels of this folder print, entered by hand, and what each describes.

The letters here are the mechanisms' own: an author's L_1, φ_1, \\ell_2, L_0 are l1, th1, l2, r0.
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
    I,
    a1,
    a2,
    a3,
    al,
    b,
    bobs,
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
    w,
    w1,
    w2,
    w3,
    wheel,
    x,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, coordinate, lagrange, momenta

half = Rational(1, 2)
th3 = coordinate("th3")[0]
d = th1 - th2
S, C = sin(d), cos(d)
s1, s2, c1, c2 = sin(th1), sin(th2), cos(th1), cos(th2)
s, c = sin(th), cos(th)
BOTH = m1 + m2
BOBS = bobs((l1, m1), (l2, m2))
p1, p2, gamma = sp.symbols("p1 p2 gamma")


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


def added(*columns):
    return [sum(parts) for parts in zip(*columns, strict=True)]


# Two bobs

UPPER = BOTH * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + BOTH * g * s1
LOWER = m2 * l2 * a2 + m2 * l1 * a1 * C - m2 * l1 * w1**2 * S + m2 * g * s2
SHORT = l2 * a2 + l1 * a1 * C - l1 * w1**2 * S + g * s2
MOVING = half * BOTH * l1**2 * w1**2 + half * m2 * l2**2 * w2**2 + m2 * l1 * l2 * w1 * w2 * C
HANGING = MOVING + BOTH * g * l1 * c1 + m2 * g * l2 * c2


def known():
    """The accelerations with the sine of θ1 - 2 θ2."""
    below = 2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2)
    one = -g * (2 * m1 + m2) * s1 - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    two = 2 * S * (w1**2 * l1 * BOTH + g * BOTH * c1 + w2**2 * l2 * m2 * C)
    return [a1 - one / (l1 * below), a2 - two / (l2 * below)]


def page_damped():
    true = bobs((l1, m1), (l2, m2), forces={th1: -gamma * w1, th2: -gamma * w2})
    return true, [UPPER + gamma * w1, LOWER + gamma * w2]


def page_lagrangian():
    return BOBS, lagrange(MOVING - BOTH * g * l1 * (1 - c1) - m2 * g * l2 * (1 - c2), BOBS)


def from_den():
    """The two texts' δ, Δ is -d."""
    den = BOTH * l1 - m2 * l1 * C**2
    one = -m2 * l1 * w1**2 * S * C + m2 * g * s2 * C - m2 * l2 * w2**2 * S - BOTH * g * s1
    two = m2 * l2 * w2**2 * S * C + BOTH * (g * s1 * C + l1 * w1**2 * S - g * s2)
    return BOBS, [a1 - one / den, a2 - two / (l2 / l1 * den)]


def wiki_energies():
    moving = half * m1 * (l1 * w1) ** 2 + half * m2 * ((l1 * w1) ** 2 + (l2 * w2) ** 2 + 2 * l1 * l2 * w1 * w2 * C)
    height = -m1 * g * l1 * c1 - m2 * g * (l1 * c1 + l2 * c2)
    return BOBS, lagrange(moving - height, BOBS)


def mathscr_bigg():
    true = bobs((l1, m1), (l2, m2), up=True)
    printed = half * m1 * w1**2 * l1**2 + half * m2 * (w2**2 * l2**2 + w1**2 * l2**2 + 2 * w1 * w2 * l1 * l2 * C)
    return true, lagrange(printed - g * (BOTH * l1 * c1 + m2 * l2 * c2), true)


def mathscr_omega():
    true = pendulum()
    return true, lagrange(half * m * w**2 - l * m * (1 - c) * g, true)


def partials_of_omega():
    """M is m1 + m2; the second row has the angles' squares."""
    upper, _ = known()
    two = 2 * S * (BOTH * th1**2 * l1 + g * BOTH * c1 + th2**2 * l2 * m2 * C)
    return BOBS, [upper, a2 - two / (l2 * (BOTH + m1 - m2 * cos(2 * th1 - 2 * th2)))]


def chain_over_fences():
    true = bobs((l1, m1), (l2, m2), up=True)
    return true, lagrange(MOVING - BOTH * g * l1 * c1 - m2 * g * l2 * c2, true)


def first_order(speeds, turns, true=BOBS):
    """Rows: the momenta's rates as printed; the rates of themselves: the angles' rates as printed."""
    place = dict(zip((p1, p2), momenta(true)[0], strict=True))
    rates = [v - speed.subs(place) for v, speed in zip((w1, w2), speeds, strict=True)]
    return true, [is_ - turn.subs(place) for is_, turn in zip(momenta(true)[1], turns, strict=True)], rates


def assencio(first_length, last_momentum):
    """h_1, h_2 and the four rows; what the two texts have differently is handed over."""
    below = m1 + m2 * S**2
    one = p1 * p2 * S / (l1 * l2 * below)
    two = m2 * l2**2 * p1**2 + BOTH * l1**2 * last_momentum**2 - 2 * m2 * l1 * l2 * p1 * p2 * C
    two /= 2 * l1**2 * l2**2 * below**2
    speeds = [
        (l2 * p1 - l1 * p2 * C) / (first_length**2 * l2 * below),
        (-m2 * l2 * p1 * C + BOTH * l1 * p2) / (m2 * l1 * l2**2 * below),
    ]
    return first_order(
        speeds, [-BOTH * g * l1 * s1 - one + two * sin(2 * d), -m2 * g * l2 * s2 + one - two * sin(2 * d)]
    )


def hamiltonian():
    above = m2 * l2**2 * p1**2 + BOTH * l1**2 * p2**2 - 2 * m2 * l1 * l2 * p1 * p2 * C
    energy = above / (2 * m2 * l1**2 * l2**2 * (m1 + m2 * S**2)) - BOTH * g * l1 * c1 - m2 * g * l2 * c2
    return first_order([sp.diff(energy, p) for p in (p1, p2)], [-sp.diff(energy, q) for q in (th1, th2)])


def sums():
    """Three of n; row k is divided by nothing."""
    true = bobs((l1, m1), (l2, m2), (l3, m3))
    angles, speeds, turns, lengths = (th1, th2, th3), (w1, w2, w3), (a1, a2, a3), (l1, l2, l3)
    rows = []
    for q, length in zip(angles, lengths, strict=True):
        row = 0
        for i in range(angles.index(q), 3):
            inner = g * sin(q)
            for j in range(i + 1):
                inner += lengths[j] * (turns[j] * cos(q - angles[j]) + speeds[j] ** 2 * sin(q - angles[j]))
            row += (m1, m2, m3)[i] * inner
        rows.append(length * row)
    return true, rows


def first_arm():
    """A spring from the support to the first bob, a rod from there to the second."""
    radius, swing, lower = RADIUS, ONE, TWO
    across, down = r * sin(th1), -r * cos(th1)
    bodies = [Body(m1, across, down), Body(m2, across + l2 * sin(th2), down - l2 * cos(th2))]
    true = Mechanism([radius, swing, lower], bodies, half * k * (r - r0) ** 2)
    along = r * w1**2 - BOTH * g * c1 / m2 - k * (r - r0) / m2 + l2 * w2**2 * C + l2 * a2 * S
    one = -BOTH * g * s1 - m2 * l2 * w2**2 * S - 2 * m2 * rd * w1 - m2 * l2 * a2 * C
    two = -m2 * g * s2 + m2 * r * w1**2 * S - m2 * r * a1 * C - 2 * m2 * rd * w2
    return true, [rdd - along, a1 - one / (BOTH * r), a2 - two / (m2 * l2)]


# One pendulum, damped, driven, on a support

F, A, O, t0, a, X, V = sp.symbols("F A omega0 F0 a X V")  # X: the drive's angle Ωt, V: Ω


def driven(force, damping, mass=m, arm=l):
    bob = Body(mass, arm * s, -arm * c)
    return Mechanism([ANGLE], [bob], 0, {th: force * cos(X) - damping * w}, False, {X: V})


def escaped():
    return driven(F, gamma, 1, 1), [al + gamma * w + s - F * cos(X)], {g: 1}


def omega_drive():
    return driven(A, gamma, 1, 1), [al + gamma * w + O**2 * s - A * cos(X)], {g: O**2}


def inertia_below():
    return driven(t0, b), [m * l**2 * al + m * g * l * s + b * w - t0 * cos(X)]


def divided():
    return driven(t0, b), [al + b / (m * l**2) * w + g / l * s - t0 / (m * l**2) * cos(X)]


def physical():
    return pendulum(I - m * l**2), [I * al + m * g * l * s]


def support(up):
    """The pivot is at a cos Ωt."""
    height = a * cos(X) + (l * c if up else -l * c)
    return Mechanism([ANGLE], [Body(m, l * s, height)], 0, {}, False, {X: V})


def docstring_unicode():
    return support(False), [al + g / l * s - a / l * V**2 * cos(X) * s]


def coriolis():
    return support(True), [l * al + 2 * (-a * V * sin(X)) * w + g * s]


# Springs

SPRING = half * k * (r - r0) ** 2
BOB = elastic(SPRING)
ALONG, ACROSS = rdd - r * w**2 - g * c + k / m * (r - r0), al + (2 * rd * w + g * s) / r


def docstring_lagrangian():
    printed = half * m * (rd**2 + r**2 * w**2) - half * k * (r - r0) ** 2 + m * g * r * c
    return BOB, lagrange(printed, BOB)


def indonesian_damped():
    cr, ct = sp.symbols("cr ct")
    true = Mechanism([RADIUS, ANGLE], [Body(1, r * s, -r * c)], SPRING, {r: -cr * rd, th: -ct * r**2 * w})
    return true, [rdd - r * w**2 - g * c + k * (r - r0) + cr * rd, al + g / r * s + ct * w + 2 * rd / r * w]


def spring_momenta(speeds, turns):
    place = dict(zip((p1, p2), momenta(BOB)[0], strict=True))  # p1 of r, p2 of θ
    rates = [v - speed.subs(place) for v, speed in zip((rd, w), speeds, strict=True)]
    return BOB, [is_ - turn.subs(place) for is_, turn in zip(momenta(BOB)[1], turns, strict=True)], rates


def spring_hamiltonian():
    energy = p2**2 / (2 * m * r**2) + p1**2 / (2 * m) + m * g * (r0 - r * c) + k / 2 * (r0 - r) ** 2
    return spring_momenta([sp.diff(energy, p) for p in (p1, p2)], [-sp.diff(energy, q) for q in (r, th)])


def left_brace():
    along = p2**2 / (m * r**3) + m * g * c + k * (r0 - r)
    return spring_momenta([p1 / m, p2 / (m * r**2)], [along, -m * g * r * s])


def leg():
    true = Mechanism([RADIUS, ANGLE], [Body(m, r * s, r * c)], SPRING)
    return true, [rdd - (r * w**2 - g * c + k * (r0 - r) / m), al - (g / r * s - 2 * rd * w / r)]


def fulcrum():
    true = Mechanism([CART, ANGLE], [Body(m, x + l * s, -l * c)], half * k * x**2)
    return true, [m * xdd + k * x + m * l * (al * c - w**2 * s), c * xdd + g * s + l * al]


# Two links

ARM = links(False, relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
FIRST = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2)
WEIGHTS = [(m1 * lc1 + m2 * l1) * g * c1 + m2 * lc2 * g * cos(th1 + th2), m2 * lc2 * g * cos(th1 + th2)]


def bold_inverse():
    between = m2 * (lc2**2 + l1 * lc2 * c2) + I2
    mass = [[FIRST + I1 + I2, between], [between, m2 * lc2**2 + I2]]
    h = m2 * l1 * lc2 * s2
    turn = [[-h * w2, -h * (w1 + w2)], [h * w1, 0]]
    return ARM, added(column(mass, [a1, a2]), column(turn, [w1, w2]), WEIGHTS, [-tau1, -tau2])


def spong():
    between = m2 * (lc2**2 + l1 * lc2 * c2 + I2)
    mass = [[FIRST + I1 + I2, between], [between, m2 * lc2**2 + I2]]
    turn = [
        -m2 * l1 * lc2 * s2 * w2**2 - 2 * m1 * l1 * lc2 * s2 * w1 * w2,
        m2 * l1 * lc2 * s2 * w1**2,
    ]
    return ARM, added(column(mass, [a1, a2]), turn, WEIGHTS, [-tau1, -tau2])


# Wheels


def motor_twice():
    """m1, lc1 and I1 are the arm's, I1 about the pivot; m2 and l1 the wheel's; I2 what the text calls effective."""
    outer, bearing = sp.symbols("outer bearing")
    bodies = [
        Body(m1, lc1 * s, lc1 * c, I1 - m1 * lc1**2, th),
        Body(m2, l1 * s, l1 * c, I2, th + ph),
    ]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {th: -b * w + outer, ph: tau - bearing * phd})
    weight = (m1 * lc1 + m2 * l1) * g
    mass = column([[I1 + m2 * l1**2 + I2, I2], [I2, I2]], [al, phdd])
    return true, [mass[0] - (weight * s - tau - b * w + outer), mass[1] - (tau - bearing * phd)]


def comment_implies():
    true = wheel(I1, I2, forces={ph: tau})
    return true, [I1 * al - m * g * l * s + tau, I2 * (phdd + al) - tau]


def twice_dotted():
    """The wheel's own angle, from the world."""
    bodies = [Body(m, l * s, -l * c), Body(0, l * s, -l * c, I, ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {th: tau, ph: -tau})
    return true, [m * l**2 * al + m * g * l * s - tau, I * phdd + tau]


PROOFS = {
    "dp-inline-in-list": (BOBS, [UPPER, SHORT]),
    "dp-readme-headed": (BOBS, [UPPER, SHORT]),
    "dp-page-lagrangian": page_lagrangian(),
    "dp-page-damped": page_damped(),
    "dp-chinese-delta-below": (BOBS, [UPPER, LOWER]),
    "dp-indented-displays": (BOBS, [UPPER, LOWER]),
    "sp-substitute-simplify": (pendulum(), [m * l**2 * al + m * g * l * s]),
    "dp-five-steps-lagrangian": (BOBS, lagrange(HANGING, BOBS)),
    "dp-five-steps-solved": (BOBS, known()),
    "dp-alpha-omega": (BOBS, known()),
    "dp-primes-in-tex": (BOBS, known()),
    "dp-rst-directives": (BOBS, known()),
    "dp-french-final": (BOBS, known()),
    "dp-brackets-below": from_den(),
    "dp-unicode-dens": from_den(),
    "dp-wiki-energies": wiki_energies(),
    "dp-mathscr-bigg": mathscr_bigg(),
    "sp-mathscr-omega": mathscr_omega(),
    "dp-partials-of-omega": partials_of_omega(),
    "dp-chain-over-fences": chain_over_fences(),
    "dp-docstring-dots": page_lagrangian(),
    "dp-hamilton-h-misprints": assencio(l2, p1),
    "dp-hamilton-spanish-h": assencio(l1, p2),
    "dp-hamiltonian-p-squared": hamiltonian(),
    "np-sums": sums(),
    "es-first-arm": first_arm(),
    "dr-escaped-by-pandoc": escaped(),
    "dr-omega-drive": omega_drive(),
    "dr-inertia-below": inertia_below(),
    "dr-divided": divided(),
    "pp-small-in-the-same-display": physical(),
    "ka-docstring-unicode": docstring_unicode(),
    "ka-coriolis-of-a-support": coriolis(),
    "el-primes-plain": (BOB, [ALONG, ACROSS]),
    "el-docstring-names": (BOB, [ALONG, ACROSS]),
    "el-docstring-lagrangian": docstring_lagrangian(),
    "el-typescript-comment": (BOB, [ALONG + 2 * g * c, ACROSS]),
    "el-indonesian-damped": indonesian_damped(),
    "el-hamiltonian": spring_hamiltonian(),
    "el-hamilton-left-brace": left_brace(),
    "sl-docstring-mixed": leg(),
    "ks-zeros-in-text": fulcrum(),
    "rr-spong-in-a-notebook": spong(),
    "rr-bold-inverse": bold_inverse(),
    "rw-motor-twice": motor_twice(),
    "rw-comment-implies": comment_implies(),
    "rw-omega-twice-dotted": twice_dotted(),
}
