"""Equations of motion of planar mechanisms from positions alone, and the exact comparison of printed rows with them.

Nothing of furiko is used. A mechanism is what its bodies' positions are; Lagrange's equations follow. Printed rows are
sympy expressions that are 0 when the row holds. They are evaluated in exact rational arithmetic at states with rational
sines and cosines: the rows are a rational function of these, so that a row which is not an identity vanishes at a
random point of 30 bits with a probability below degree / 2^30 (Schwartz and Zippel), and at eight below 1e-50.
"""

import random
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product

import sympy as sp

POINTS = 8
t = sp.Symbol("time")


def coordinate(name):
    """A coordinate, its rate and its acceleration."""
    return sp.symbols(f"{name} d{name} dd{name}", real=True)


@dataclass
class Body:
    """Mass, inertia about the centre, the centre's place, and the body's turn: expressions of the coordinates."""

    mass: object
    x: object
    y: object
    inertia: object = 0
    turn: object = 0


@dataclass
class Mechanism:
    """Bodies, the potential besides gravity's, and generalised forces, over coordinates (q, rate, acceleration)."""

    coordinates: list
    bodies: list
    potential: object = 0
    forces: dict = field(default_factory=dict)
    shifts: bool = True  # whether other conventions of the angles are to be tried for what is wrong
    phases: dict = field(default_factory=dict)  # angles that are given functions of time, and their rates


def rate(expression, mechanism):
    """Time derivative, by the chain rule."""
    total = sum(sp.diff(expression, q) * v + sp.diff(expression, v) * a for q, v, a in mechanism.coordinates)
    return total + sum(sp.diff(expression, phase) * speed for phase, speed in mechanism.phases.items())


def kinetic(mechanism):
    """Kinetic energy."""
    return sum(
        body.mass * (rate(body.x, mechanism) ** 2 + rate(body.y, mechanism) ** 2) / 2
        + body.inertia * rate(sp.sympify(body.turn), mechanism) ** 2 / 2
        for body in mechanism.bodies
    )


def potential(mechanism):
    """Potential energy."""
    g = sp.Symbol("g")
    return sum(body.mass * g * body.y for body in mechanism.bodies) + mechanism.potential


def lagrange(lagrangian, mechanism):
    """d/dt ∂L/∂q̇ − ∂L/∂q − Q, a row for each coordinate."""
    return [
        rate(sp.diff(lagrangian, v), mechanism) - sp.diff(lagrangian, q) - mechanism.forces.get(q, 0)
        for q, v, _ in mechanism.coordinates
    ]


def rows_of(mechanism):
    """The true rows."""
    return lagrange(kinetic(mechanism) - potential(mechanism), mechanism)


def momenta(mechanism):
    """Generalised momenta, and their time derivatives."""
    momentum = [sp.diff(kinetic(mechanism), v) for _, v, _ in mechanism.coordinates]
    return momentum, [rate(p, mechanism) for p in momentum]


def _turn(angle, circle):
    """Cosine and sine of an integer combination of angles, exactly."""
    c, s = Fraction(1), Fraction(0)
    for term, factor in sp.expand(angle).as_coefficients_dict().items():
        if term in circle:
            base, times = circle[term], int(factor)
            assert times == factor
        else:
            quarters = sp.nsimplify(term * factor / (sp.pi / 2))
            assert quarters.is_Integer, angle
            base, times = (Fraction(0), Fraction(1)), int(quarters)
        step = base if times > 0 else (base[0], -base[1])
        for _ in range(abs(times)):
            c, s = c * step[0] - s * step[1], c * step[1] + s * step[0]
    return c, s


def value_of(expression, circle, numbers):
    def exact(function):
        value = _turn(function.args[0], circle)[isinstance(function, sp.sin)]
        return sp.Rational(value.numerator, value.denominator)

    trigonometric = {f: exact(f) for f in sp.sympify(expression).atoms(sp.sin, sp.cos)}
    return sp.sympify(expression).xreplace(trigonometric).xreplace(numbers)


def state_of(expressions, mechanism, seed):
    draw = random.Random(seed)

    def number():
        return sp.Rational(draw.randrange(1, 2**30), draw.randrange(1, 2**30))

    symbols = sorted(set().union(*(sp.sympify(e).free_symbols for e in expressions)), key=str)
    circle, numbers = {}, {}
    for symbol in symbols:
        tangent = Fraction(draw.randrange(1, 2**30), draw.randrange(1, 2**30))
        circle[symbol] = ((1 - tangent**2) / (1 + tangent**2), 2 * tangent / (1 + tangent**2))
        numbers[symbol] = number()
    return circle, numbers


def _accelerations(rows, unknowns, circle, numbers):
    known = {s: n for s, n in numbers.items() if s not in unknowns}
    values = [value_of(row, circle, known) for row in rows]
    matrix = sp.Matrix([[sp.diff(value, a) for a in unknowns] for value in values])
    if matrix.free_symbols or matrix.det() == 0:
        return None
    return list(matrix.LUsolve(-sp.Matrix([value.xreplace(dict.fromkeys(unknowns, 0)) for value in values])))


def compare(printed, mechanism, special=None):
    """None if the printed rows have the true accelerations as their only solution; or the first state where not.

    special: values for which alone they are meant.
    """
    special = special or {}
    truth = [sp.sympify(row).subs(special) for row in rows_of(mechanism)]
    printed = [sp.sympify(row).subs(special) for row in printed]
    unknowns = [a for _, _, a in mechanism.coordinates]
    for seed in range(POINTS):
        circle, numbers = state_of([*truth, *printed, *unknowns], mechanism, seed)
        right = _accelerations(truth, unknowns, circle, numbers)
        found = _accelerations(printed, unknowns, circle, numbers)
        if found != right:
            return {
                "state": numbers,
                "true": [float(value) for value in right],
                "printed": None if found is None else [float(value) for value in found],
            }
    return None


def conventions(printed, mechanism):
    """The rows as they read with the angles from up, right or left, and with slides counted the other way."""
    angles = [q for q, _, _ in mechanism.coordinates if _is_angle(q, mechanism)]
    others = [c for c in mechanism.coordinates if c[0] not in angles]
    for turn, mirror in product((sp.Integer(0), sp.pi, sp.pi / 2, -sp.pi / 2), (1, -1)):
        swap = {angles[0]: angles[0] + turn} if _relative(mechanism) else {q: q + turn for q in angles}
        swap |= {symbol: mirror * symbol for c in others for symbol in c}
        yield (turn, mirror), [sp.sympify(row).subs(swap, simultaneous=True) for row in printed]


def _is_angle(q, mechanism):
    return any(q in f.free_symbols for body in mechanism.bodies for f in sp.sympify(body.x).atoms(sp.sin, sp.cos))


def _relative(mechanism):
    return any(
        len(f.args[0].free_symbols) > 1 for body in mechanism.bodies for f in sp.sympify(body.x).atoms(sp.sin, sp.cos)
    )


def rates_hold(rows, mechanism):
    """Whether rows without accelerations hold at random states."""
    for seed in range(8):
        circle, numbers = state_of([*rows, *(q for c in mechanism.coordinates for q in c)], mechanism, seed)
        if any(value_of(sp.sympify(row), circle, numbers) != 0 for row in rows):
            return False
    return True
