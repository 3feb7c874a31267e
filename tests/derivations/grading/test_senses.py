"""Drives, springs, dampers and dry friction in every convention of angles, against rows from positions alone.

A drive does work on its joint's own angle and a rest is a value of that angle, whatever way it is counted: as the
author's coordinates have it. The rows are derived by sympy, in the author's coordinates, and printed by it.
"""

from itertools import product

import pytest
import sympy as sp

from furiko.derivations.grading.grade import grade_text

t = sp.Symbol("t")
g, m1, m2, l1, l2, c1, c2, k1, k2, r1, r2, u1, u2 = sp.symbols("g m1 m2 l1 l2 c1 c2 k1 k2 r1 r2 u1 u2")
ZERO = {"down": 0, "up": sp.pi, "horizontal": sp.pi / 2}
SIGN = {"counter-clockwise": 1, "clockwise": -1}
BODY = """[[bodies]]
coordinate = "q{k}"
mass = "m{k}"
length = "l{k}"
damping = "c{k}"
spring = "k{k}"
rest = "r{k}"
drive = "u{k}"
"""
HEAD = "system = 'mechanism'\nangles = '{}'\nfrom = '{}'\nsense = {}\n"


def rows(angles, origin, senses, drive=1, rest=1):
    """Of two links. ``drive``, ``rest``: -1 to turn the second's round."""
    q1, q2 = (sp.Function(f"q{k}")(t) for k in (1, 2))
    s1, s2 = (SIGN[s] for s in senses)
    # Directions, counter-clockwise from the downward vertical; and how far each joint has turned in its angle's sense
    one = ZERO[origin] + s1 * q1
    two = ZERO[origin] + s2 * q2 if angles == "absolute" else one + s2 * q2
    turned = (q1, q2 - s1 * s2 * q1 if angles == "absolute" else q2)
    x1, y1 = l1 * sp.sin(one), -l1 * sp.cos(one)
    x2, y2 = x1 + l2 * sp.sin(two), y1 - l2 * sp.cos(two)
    kinetic = sum(m * (sp.diff(x, t) ** 2 + sp.diff(y, t) ** 2) / 2 for m, x, y in ((m1, x1, y1), (m2, x2, y2)))
    potential = m1 * g * y1 + m2 * g * y2 + k1 * (turned[0] - r1) ** 2 / 2 + k2 * (turned[1] - rest * r2) ** 2 / 2
    forces = (u1 - c1 * sp.diff(turned[0], t), drive * u2 - c2 * sp.diff(turned[1], t))
    made = []
    for q in (q1, q2):
        v = sp.diff(q, t)
        left = sp.diff(sp.diff(kinetic - potential, v), t) - sp.diff(kinetic - potential, q)
        work = sum(force * sp.diff(turn, q) for force, turn in zip(forces, turned, strict=True))
        made.append(sp.expand(left - work))
    return made


def graded(angles, origin, senses, **slips):
    text = HEAD.format(angles, origin, list(senses)) + "".join(BODY.format(k=k) for k in (1, 2)) + "[equations]\n"
    made = rows(angles, origin, senses, **slips)
    return grade_text(text + "".join(f"{k} = '''{row} = 0'''\n" for k, row in enumerate(made, 1)))


SENSES = list(product(SIGN, repeat=2))
CONVENTIONS = [*product(("absolute",), ZERO, SENSES), *product(("relative",), ("up",), SENSES)]


@pytest.mark.slow
@pytest.mark.parametrize(("angles", "origin", "senses"), CONVENTIONS)
def test_forces_follow_the_sense_of_their_own_angle(angles, origin, senses):
    found = graded(angles, origin, senses)
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize("slip", ["drive", "rest"])
@pytest.mark.parametrize("senses", SENSES)
def test_a_drive_or_a_rest_in_the_other_sense_is_wrong(senses, slip):
    assert graded("absolute", "up", senses, **{slip: -1}).verdict == "wrong"


def friction(senses, sign=1):
    """Two angles in these senses, dry friction at both joints; ``sign``: of the second's in its own row."""
    s = SIGN[senses[0]] * SIGN[senses[1]]
    body = '[[bodies]]\ncoordinate = "q{k}"\nmass = "m{k}"\nlength = "l{k}"\nfriction = "f{k}"\n'
    between = "q2' - q1'" if s > 0 else "q2' + q1'"
    gone, a = ("q1 - q2", "+") if s > 0 else ("q1 + q2", "-")
    # By hand: T = ½(m1+m2) l1² q1'² + ½ m2 l2² q2'² + s m2 l1 l2 q1' q2' cos(q1 - s q2), weights as ever; the joint's
    # friction acts on q2 by -f2 sgn(q2' - s q1'), and on q1 by s times its opposite.
    first = (f"(m1+m2) l1^2 q1'' + m2 l1 l2 ({s} q2'' cos({gone}) + q2'^2 sin({gone})) + (m1+m2) g l1 sin(q1)"
             f" = -f1 sgn(q1') {a} f2 sgn({between})")  # fmt: skip
    second = (f"m2 l2^2 q2'' + m2 l1 l2 ({s} q1'' cos({gone}) - {s} q1'^2 sin({gone})) + m2 g l2 sin(q2)"
              f" = {'-' if sign > 0 else ''} f2 sgn({between})")  # fmt: skip
    return grade_text(HEAD.format("absolute", "down", list(senses)) + body.format(k=1) + body.format(k=2)
                      + f"[equations]\n1 = '''{first}'''\n2 = '''{second}'''\n")  # fmt: skip


@pytest.mark.parametrize("senses", SENSES)
def test_dry_friction_between_links_in_either_sense(senses):
    assert friction(senses).verdict == "correct"
    assert friction(senses, sign=-1).verdict == "wrong"


CART = """system = 'mechanism'
from = 'up'
sense = 'clockwise'
[[bodies]]
coordinate = 'x'
joint = 'slide'
along = 'right'
mass = 'M'
drive = 'F'
spring = 'k'
rest = 'x0'
[[bodies]]
coordinate = 'q'
mass = 'm'
length = 'l'
drive = 'u'
[equations]
1 = '''(M+m) x'' + m l q'' cos q - m l q'^2 sin q + k (x - x0) = {force}'''
2 = '''m l^2 q'' + m l x'' cos q - m g l sin q = {torque}'''
"""


def test_a_slide_keeps_its_own_direction():
    """By hand: the bob is at x + l sin q, l cos q."""
    assert grade_text(CART.format(force="F", torque="u")).verdict == "correct"
    assert grade_text(CART.format(force="F", torque="-u")).verdict == "wrong"
    assert grade_text(CART.format(force="-F", torque="u")).verdict == "wrong"


def test_a_support_that_moves_and_a_drive():
    """By hand: the pivot at s to the right, the angle clockwise from up."""
    body = "[[bodies]]\ncoordinate = 's'\njoint = 'slide'\nmass = '0'\nmotion = 'given'\n"
    body += "[[bodies]]\ncoordinate = 'q'\nmass = 'm'\nlength = 'l'\ndrive = 'u'\n"
    row = "m l^2 q'' + m l s'' cos q - m g l sin q = "
    text = "system = 'mechanism'\nfrom = 'up'\nsense = 'clockwise'\n" + body + "[equations]\n1 = '''" + row
    assert grade_text(text + "u'''").verdict == "correct"
    assert grade_text(text + "-u'''").verdict == "wrong"


ON_RAIL = """[[bodies]]
name = "cart"
coordinate = "x"
joint = "slide"
mass = "M"
drive = "F"
"""
POLE = """[[bodies]]
coordinate = "a{k}"
mass = "m{k}"
length = "l{k}"
on = "cart"
"""


def poles(count):
    """Rows of a cart with poles whose angles are counted from upright to the side that the cart moves to: clockwise."""
    M, F = sp.symbols("M F")
    x = sp.Function("x")(t)
    angles = [sp.Function(f"a{k}")(t) for k in range(1, count + 1)]
    kinetic, potential = M * sp.diff(x, t) ** 2 / 2, 0
    for k, a in enumerate(angles, 1):
        m, l = sp.symbols(f"m{k} l{k}")
        kinetic += m * (sp.diff(x + l * sp.sin(a), t) ** 2 + sp.diff(l * sp.cos(a), t) ** 2) / 2
        potential += m * g * l * sp.cos(a)
    lagrangian = kinetic - potential
    forces = [F, *[0] * count]
    each = zip([x, *angles], forces, strict=True)
    return [sp.expand(sp.diff(lagrangian.diff(q.diff(t)), t) - lagrangian.diff(q) - force) for q, force in each]


def cart(head, count, made):
    """A verdict on these rows."""
    bodies = ON_RAIL + "".join(POLE.format(k=k) for k in range(1, count + 1))
    rows = "".join(f"{k} = '''{row} = 0'''\n" for k, row in enumerate(made, 1))
    return grade_text(f"system = 'mechanism'\n{head}\n{bodies}[equations]\n{rows}")


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("head", ["", "angles = 'absolute'", "from = 'up'", "sense = 'clockwise'"])
def test_poles_that_lean_the_way_the_cart_goes_are_right_where_the_sense_is_not_declared(head, count):
    made = poles(count)
    graded = cart(head, count, made)
    assert graded.verdict == "correct"
    assert graded.assumes == ("angles are measured from the upward vertical, clockwise",)
    assert cart("from = 'up'\nsense = 'clockwise'", count, made).assumes == ()
    assert cart("from = 'up'\nsense = 'counter-clockwise'", count, made).verdict == "wrong"
    push = sp.Function("x")(t).diff(t, 2)
    slip = [*made[:-1], made[-1] - 2 * push * made[-1].coeff(push)]  # the last pole feels the cart the other way
    assert cart(head, count, slip).verdict == "wrong"
