"""Both mechanisms from nothing but where their points are: differentiated by sympy, evaluated to 60 digits.

Independent of every equation of the documents: a rod is an integral over its mass, not a moment of inertia, and the
equations of motion are Lagrange's of the energies that come out.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction

import mpmath
import numpy as np
import sympy as sp

DIGITS = 60


@dataclass(frozen=True)
class Moving:
    """A mechanism in symbols θ, ω, α with numbers for everything else; its state, rational."""

    theta: list
    omega: list
    alpha: list
    state: dict

    def rate(self, expression):
        """Time derivative."""
        return sum(
            expression.diff(t) * w + expression.diff(w) * a
            for t, w, a in zip(self.theta, self.omega, self.alpha, strict=True)
        )

    def number(self, expression, alpha=None):
        """To 60 digits, at the state; with numbers for α where given."""
        values = {**self.state, **(dict(zip(self.alpha, alpha, strict=True)) if alpha is not None else {})}
        names = [*self.theta, *self.omega, *self.alpha]
        function = sp.lambdify(names, sp.sympify(expression), "mpmath")
        with mpmath.workdps(DIGITS):
            return mpmath.mpf(function(*(_mpf(values.get(name, 0)) for name in names)))

    def numbers(self, expressions, alpha=None):
        """The same for an array of expressions."""
        array = np.array(expressions, dtype=object)
        flat = [self.number(expression, alpha) for expression in array.ravel()]
        result = np.empty(len(flat), dtype=object)
        result[:] = flat
        return result.reshape(array.shape)


def _mpf(value):
    return mpmath.mpf(value.numerator) / value.denominator if isinstance(value, Fraction) else mpmath.mpf(value)


def moving(n, seed):
    """Symbols, and a random rational state."""
    draw = random.Random(seed)
    theta, omega, alpha = (list(sp.symbols(f"{name}1:{n + 1}", real=True)) for name in ("theta", "omega", "alpha"))
    state = {symbol: Fraction(draw.randint(-300, 300), 100) for symbol in (*theta, *omega)}
    return Moving(theta, omega, alpha, state)


def star(l, m, g, seed):
    """Shiki's values of every symbol, from positions alone; l, m, g rational."""
    n = len(l)
    f = moving(n, seed)
    sin, cos = [sp.sin(t) for t in f.theta], [sp.cos(t) for t in f.theta]
    position = [
        [l[0] * sin[0] + (l[i] * sin[i] if i else 0), -l[0] * cos[0] - (l[i] * cos[i] if i else 0)] for i in range(n)
    ]
    velocity = [[f.rate(x) for x in point] for point in position]
    squared = [u**2 + v**2 for u, v in velocity]
    kinetic = sum(mi * v / 2 for mi, v in zip(m, squared, strict=True))
    potential = sum(mi * g * point[1] for mi, point in zip(m, position, strict=True))
    weights = [[0, mi * g] for mi in m]
    accelerations = [[f.rate(u) for u in point] for point in velocity]
    each = [
        [-(mi * a + w) for a, w in zip(acc, weight, strict=True)]
        for mi, acc, weight in zip(m, accelerations, weights, strict=True)
    ]
    forces = [[sum(row[k] for row in each) for k in range(2)], *each[1:]]
    return f, {
        "position": position,
        "velocity": velocity,
        "speed_squared": squared,
        "r_ddot": accelerations,
        "forces": forces,
        **_lagrange(f, kinetic, potential),
    }


def chain(l, rho, g, seed):
    """Takeno's values, every rod an integral over its length; l, rho, g rational."""
    n = len(l)
    f = moving(n, seed)
    s = sp.Symbol("s", real=True)
    direction = [[sp.sin(t), -sp.cos(t)] for t in f.theta]
    joint = [[sp.Integer(0), sp.Integer(0)]]
    for length, p in zip(l, direction, strict=True):
        joint.append([joint[-1][0] + length * p[0], joint[-1][1] + length * p[1]])
    kinetic = potential = 0
    mass, centre, momentum = [], [], []
    for j, length in enumerate(l):
        point = [joint[j][k] + s * direction[j][k] for k in range(2)]
        velocity = [f.rate(x) for x in point]

        def over_rod(density, length=length):
            return sp.integrate(sp.expand(density), (s, 0, length))

        kinetic += over_rod(rho * (velocity[0] ** 2 + velocity[1] ** 2) / 2)
        potential += over_rod(rho * g * point[1])
        mass.append(over_rod(sp.sympify(rho)))
        centre.append([over_rod(rho * x) / mass[-1] for x in point])
        momentum.append([over_rod(rho * v) for v in velocity])
    # The rods from j on are accelerated by their weight and by -T at the joint that carries them.
    below = [[sum(momentum[i][k] for i in range(j, n)) for k in range(2)] for j in range(n)]
    forces = [
        [-f.rate(sp.sympify(below[j][0])), -f.rate(sp.sympify(below[j][1])) - g * sum(mass[j:])] for j in range(n)
    ] + [[0, 0]]
    return f, {
        "position": joint,
        "centre": centre,
        "r_ddot": [[f.rate(f.rate(x)) for x in point] for point in centre],
        "p_ddot": [[f.rate(f.rate(x)) for x in p] for p in direction],
        "mass": mass,
        "forces": forces,
        "inertia": [sp.integrate(rho * (s - sp.Rational(length) / 2) ** 2, (s, 0, length)) for length in l],
        **_lagrange(f, kinetic, potential),
    }


def _lagrange(f, kinetic, potential):
    """Lagrange's equations of these energies, solved for α at the state."""
    lagrangian = kinetic - potential
    n = len(f.theta)
    momentum = [lagrangian.diff(w) for w in f.omega]
    rate = [f.rate(p) for p in momentum]
    by_angle = [lagrangian.diff(t) for t in f.theta]
    residual = [a - b for a, b in zip(rate, by_angle, strict=True)]
    mass_matrix = [[p.diff(w) for w in f.omega] for p in momentum]
    free = f.numbers([r.subs(dict.fromkeys(f.alpha, 0)) for r in residual])
    with mpmath.workdps(DIGITS):
        solution = mpmath.lu_solve(mpmath.matrix(f.numbers(mass_matrix).tolist()), mpmath.matrix([-x for x in free]))
    return {
        "lagrangian": lagrangian,
        "kinetic": kinetic,
        "potential": potential,
        "momentum": momentum,
        "momentum_rate": rate,
        "dL_dtheta": by_angle,
        "mass_matrix": mass_matrix,
        "squared_rates": [[r.diff(w, 2) / 2 for w in f.omega] for r in residual],
        "gravity": [potential.diff(t) for t in f.theta],
        "alpha": [solution[i] for i in range(n)],
    }
