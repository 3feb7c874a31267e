"""What the carts, springs and wheels of this folder print, entered by hand from the text, and what each describes.

The letters here are the mechanisms' own: an author's m_\\text{cart}, θ, s, y are M, th, x, x.
"""

import sympy as sp
from mechanisms import (  # fmt: skip
    ANGLE,
    CART,
    RADIUS,
    WHEEL,
    F,
    I,
    M,
    al,
    b,
    b1,
    b2,
    cart_pole,
    elastic,
    g,
    k,
    l,
    m,
    ph,
    phdd,
    r,
    r0,
    rd,
    rdd,
    tau,
    th,
    u,
    w,
    wheel,
    x,
    xd,
    xdd,
)
from sympy import Rational, cos, sin
from truth import Body, Mechanism, coordinate, lagrange

half = Rational(1, 2)
s, c = sin(th), cos(th)
d, J, m1, m2, k1, k2 = sp.symbols("d J m1 m2 k1 k2")


def column(matrix, rates):
    return list(sp.Matrix(matrix) * sp.Matrix(rates))


# A cart and a point mass

PUSHED = cart_pole(up=True, forces={x: F})
ROWS = [(M + m) * xdd + m * l * al * c - m * l * w**2 * s - F, m * l * xdd * c + m * l**2 * al - m * g * l * s]
DIVIDED = [ROWS[0], l * al + xdd * c - g * s]
RUBBED = cart_pole(up=True, forces={x: u - d * xd})


def friction_right():
    return RUBBED, [(M + m) * xdd + m * l * al * c - m * l * w**2 * s - u + d * xd, ROWS[1]]


def solved_below_d():
    below = M + m - m * c**2
    push = u - d * xd + m * l * w**2 * s
    turn = -u * c + d * xd * c - m * l * w**2 * s * c + (M + m) * g * s
    return RUBBED, [xdd - (push - m * g * s * c) / below, al - turn / (l * below)]


LEFT = cart_pole(up=True, left=True, forces={x: F})


def numbers_above():
    return LEFT, [(M + m) * xdd - m * l * al * c + m * l * w**2 * s - F, l * al - xdd * c - g * s]


def secant():
    below = -m - M + m * c**2
    turn = F * c + g * m * s + g * M * s - l * m * w**2 * c * s
    push = (F * c - l * m * w**2 * c * s + g * m * c**2 * s) / c
    return LEFT, [al + turn / (l * below), xdd + push / below]


def backticks_state():
    below = M + m * s**2
    return PUSHED, [
        xdd - (F - m * g * s * c + m * l * w**2 * s) / below,
        al - ((M + m) * g * s - F * c - m * l * w**2 * s * c) / (l * below),
    ]


def docstring_four_thirds():
    turn = g * s - c * (F + m * l * w**2 * s) / (M + m)
    return PUSHED, [
        al - turn / (l * (Rational(4, 3) - m * c**2 / (M + m))),
        xdd - (F + m * l * (w**2 * s - al * c)) / (M + m),
    ]


def law_strings():
    return PUSHED, [(M + m) * xdd - m * l * al * c - F, l * al - g * s + xdd * c]


def typst_and():
    true = cart_pole(up=True, forces={th: -b * w})
    return true, [
        (M + m) * xdd + m * l * c * al - m * l * s * w**2,
        m * l * c * xdd + m * l**2 * al + b * w - m * g * l * s,
    ]


def typst_mat():
    true = cart_pole(up=True, forces={x: F, th: -b * w})
    mass = column([[M + m, m * l * c], [m * l * c, m * l**2]], [xdd, al])
    return true, [mass[0] - F - m * l * s * w**2, mass[1] - m * g * l * s + b * w]


# A cart and a pole with an inertia about its centre


def vietnamese_split():
    true = cart_pole(J, up=True, left=True, forces={x: F})
    return true, [
        M * xdd + m * xdd - m * l * al * c + m * l * w**2 * s - F,
        (m * l**2 + J) * al - m * l * xdd * c - m * g * l * s,
    ]


def vietnamese_friction():
    true = cart_pole(J, up=True, left=True, forces={x: F - b1 * xd, th: -b2 * w})
    return true, [
        (M + m) * xdd + b1 * xd - m * l * al * c + m * l * w**2 * s - F,
        (J + m * l**2) * al + b2 * w - m * l * xdd * c - m * g * l * s,
    ]


PLANK = cart_pole(I, up=True, forces={x: F - k * xd})


def one_sign_a_line():
    printed = half * (M + m) * xd**2 + m * l * xd * w * c + half * (I + m * l**2) * w**2 - m * g * l * c
    return PLANK, lagrange(printed, PLANK)


def doxygen_chinese():
    return PLANK, [
        (I + m * l**2) * al - m * g * l * s + m * l * c * xdd,
        (M + m) * xdd + m * l * c * al - m * l * s * w**2 + k * xd - F,
    ]


# A cart and a uniform rod, l its half

ROD = cart_pole(m * l**2 / 3, up=True, forces={x: F})
THIRDS = Rational(4, 3) * m * l**2


def underbraces():
    printed = half * M * xd**2 + half * m * (xd**2 + l**2 * w**2 + 2 * l * xd * w * c)
    printed += half * m * (2 * l) ** 2 / 12 * w**2 - m * g * l * c
    return ROD, lagrange(printed, ROD)


def rightarrow_rows():
    return ROD, [ROWS[0], THIRDS * al + m * l * xdd * c - m * g * l * s]


def matrix_u():
    mass = column([[M + m, m * l * c], [m * l * c, THIRDS]], [xdd, al])
    return ROD, [mass[0] - F - m * l * w**2 * s, mass[1] - m * g * l * s]


def states_in_cases():
    below = (M + m) * THIRDS - (m * l * c) ** 2
    push = F + m * l * w**2 * s
    return ROD, [
        xdd - (THIRDS * push - m**2 * l**2 * g * s * c) / below,
        al - (-m * l * c * push + (M + m) * m * g * l * s) / below,
    ]


def summary_list():
    true = cart_pole(m * l**2 / 3, up=True, forces={x: F - b1 * xd, th: -b2 * w})
    return true, [
        (M + m) * xdd + m * l * al * c - m * l * w**2 * s - F + b1 * xd,
        m * l * xdd * c + THIRDS * al - m * g * l * s + b2 * w,
    ]


def barto():
    """tmp, temp: what the cart's acceleration would be without the pole's."""
    short = (F + m * l * w**2 * s) / (M + m)
    below = l * (Rational(4, 3) - m * c**2 / (M + m))
    return ROD, [al - (g * s - c * short) / below, xdd - short + m * l * al * c / (M + m)]


def drawn_fractions():
    below = l * (Rational(4, 3) - m * c**2 / (M + m))
    turn = g * s + c * (-F - m * l * w**2 * s) / (M + m)
    return ROD, [al - turn / below, xdd - (F + m * l * (w**2 * s - al * c)) / (M + m)]


# A platform on a spring and a proof mass, flat

PLATFORM = cart_pole(I, up=True, potential=half * k * x**2, forces={th: u})
FLAT = {g: 0}


def newton_chains():
    """F_x and F_y, which the first display gives, put into the rows before they are gathered."""
    across = m * xdd + m * l * al * c - m * l * w**2 * s
    along = -m * l * (al * s + w**2 * c)
    return PLATFORM, [I * al - u - along * l * s + across * l * c, M * xdd + across + k * x], FLAT


def in_cases():
    return (
        PLATFORM,
        [
            (I + m * l**2) * al + m * l * xdd * c - u,
            m * l * c * al + (M + m) * xdd - m * l * w**2 * s + k * x,
        ],
        FLAT,
    )


BELOW = (I + m * l**2) * (M + m) - m**2 * l**2 * c**2


def inverse():
    right = [u, m * l * w**2 * s - k * x]
    solved = column([[M + m, -m * l * c], [-m * l * c, I + m * l**2]], right)
    return PLATFORM, [al - solved[0] / BELOW, xdd - solved[1] / BELOW], FLAT


def state_matrix():
    state = [th, w, x, xd]
    first = [0, -(m**2) * l**2 * w * s * c / BELOW, m * l * k * c / BELOW, 0]
    second = [0, (I + m * l**2) * m * l * w * s / BELOW, -k * (I + m * l**2) / BELOW, 0]
    turn, push = column([first, second], state)
    return PLATFORM, [al - turn - (M + m) / BELOW * u, xdd - push + m * l * c / BELOW * u], FLAT


# Springs, wheels, what is moved

BOB = elastic(half * k * (r - r0) ** 2)


def japanese():
    return BOB, [rdd - r * w**2 - g * c + k / m * (r - r0), al - (-g * s - 2 * rd * w) / r]


def japanese_inline():
    printed = half * m * (rd**2 + r**2 * w**2) + m * g * r * c - half * k * (r - r0) ** 2
    return BOB, lagrange(printed, BOB)


def korean_labels():
    return BOB, [g * s + 2 * rd * w + r * al, r * w**2 - k / m * (r - r0) + g * c - rdd]


def korean_solved():
    return BOB, [al + (g * s + 2 * rd * w) / r, rdd - r * w**2 + k / m * (r - r0) - g * c]


def turned_spring():
    """The arm's angle is X beside, its rate V, which does not change: the author's Ωt and Ω."""
    angle, speed = sp.symbols("X V")
    bob = Body(m, r * sin(angle), -r * cos(angle))
    true = Mechanism([RADIUS], [bob], half * k * (r - r0) ** 2, {}, False, {angle: speed})
    return true, [rdd - r * speed**2 + k / m * (r - r0) - g * cos(angle)]


def portuguese_tags():
    lp, lcp = sp.symbols("lp lcp")
    bodies = [Body(m1, lcp * s, -lcp * c, I, th), Body(m2, lp * s, -lp * c, J, th + ph)]
    true = Mechanism([ANGLE, WHEEL], bodies, 0, {ph: tau})
    return true, [
        (m1 * lcp**2 + m2 * lp**2 + I + J) * al + J * phdd + (m1 * g * lcp + m2 * g * lp) * s + tau,
        J * (al + phdd) - tau,
    ]


WHEELED = wheel(m * l**2, J, forces={ph: tau})


def tex_lagrangian():
    spin = w + coordinate("ph")[1]
    return WHEELED, lagrange(half * m * l**2 * w**2 + half * J * spin**2 - m * g * l * c, WHEELED)


def tex_rows():
    return WHEELED, [(m * l**2 + J) * al + J * phdd + m * g * l * s + tau, J * (al + phdd) - tau]


Y, YD, YDD = coordinate("y")
SPRINGS = half * k1 * x**2 + half * k2 * (Y - x) ** 2
BETWEEN = b2 * (YD - xd)
TWO = Mechanism(
    [CART, (Y, YD, YDD)], [Body(m1, x, 0), Body(m2, Y, 0)], SPRINGS, {x: u - b1 * xd + BETWEEN, Y: -BETWEEN}
)


def indonesian_states():
    one = -(k1 + k2) / m1 * x - (b1 + b2) / m1 * xd + k2 / m1 * Y + b2 / m1 * YD + u / m1
    two = k2 / m2 * x + b2 / m2 * xd - k2 / m2 * Y - b2 / m2 * YD
    return TWO, [xdd - one, YDD - two]


def indonesian_matrices():
    first = [-(k1 + k2) / m1, -(b1 + b2) / m1, k2 / m1, b2 / m1]
    second = [k2 / m2, b2 / m2, -k2 / m2, -b2 / m2]
    one, two = column([first, second], [x, xd, Y, YD])
    return TWO, [xdd - one - u / m1, YDD - two]


PROOFS = {
    "cp-french-eqref": (PUSHED, ROWS),
    "cp-friction-right": friction_right(),
    "cp-solved-below-d": solved_below_d(),
    "to-newton-chains": newton_chains(),
    "to-cases": in_cases(),
    "to-inverse": inverse(),
    "to-state-matrix": state_matrix(),
    "cp-vietnamese-split": vietnamese_split(),
    "cp-vietnamese-friction": vietnamese_friction(),
    "cp-underbraces": underbraces(),
    "cp-rightarrow-rows": rightarrow_rows(),
    "cp-matrix-u": matrix_u(),
    "cp-states-in-cases": states_in_cases(),
    "cp-one-sign-a-line": one_sign_a_line(),
    "cp-bullets-backticks": (PUSHED, DIVIDED),
    "cp-backticks-state": backticks_state(),
    "cp-implies": (PUSHED, DIVIDED),
    "cp-numbers-above": numbers_above(),
    "cp-secant": secant(),
    "cp-summary-list": summary_list(),
    "cp-fence-remarks": barto(),
    "cp-unicode-fences": (
        cart_pole(up=True, forces={x: F - b * xd}),
        [(M + m) * xdd + b * xd + m * l * al * c - m * l * w**2 * s - F, ROWS[1]],
    ),
    "cp-docstring-rows": (PUSHED, ROWS),
    "cp-docstring-four-thirds": docstring_four_thirds(),
    "cp-doxygen-chinese": doxygen_chinese(),
    "cp-rust-doc": (PUSHED, DIVIDED),
    "cp-wgsl-comment": barto(),
    "cp-drawn-fractions": drawn_fractions(),
    "cp-law-strings": law_strings(),
    "cp-typst-and": typst_and(),
    "cp-typst-mat": typst_mat(),
    "el-japanese": japanese(),
    "el-japanese-inline": japanese_inline(),
    "el-korean-labels": korean_labels(),
    "el-korean-solved": korean_solved(),
    "mv-turned-spring": turned_spring(),
    "rw-portuguese-tags": portuguese_tags(),
    "rw-tex-lagrangian": tex_lagrangian(),
    "rw-tex-rows": tex_rows(),
    "sl-indonesian-states": indonesian_states(),
    "sl-indonesian-abcd": indonesian_matrices(),
}
