"""First principles in the exact algebra: every symbol of the documents as a formula, to compare their equations with.

Positions are differentiated into velocities; a rod's kinetic energy is the integral over its mass (Simpson's rule is
exact for it, the speed squared being quadratic along a rod), so that no moment of inertia is put in; Lagrange's
equations are those of the energies that come out. Only the meaning of the letters is taken from the documents.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from ...reference.arithmetic import Objects
from ..algebra.multiples import divided
from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula, Space, constant, unit

Array = NDArray[Any]


class Exact:
    """A formula with the operators that the documents' equations are written with."""

    __slots__ = ("formula",)

    def __init__(self, formula: Formula) -> None:
        self.formula = formula

    def __add__(self, other: Any) -> Any:
        # numpy takes over where the other side is an array, element by element
        return NotImplemented if isinstance(other, np.ndarray) else Exact(self.formula + _formula(other))

    def __sub__(self, other: Any) -> Any:
        return NotImplemented if isinstance(other, np.ndarray) else Exact(self.formula - _formula(other))

    def __rsub__(self, other: Any) -> Exact:
        return Exact(_formula(other) - self.formula)

    def __mul__(self, other: Any) -> Any:
        return NotImplemented if isinstance(other, np.ndarray) else Exact(self.formula * _formula(other))

    __radd__, __rmul__ = __add__, __mul__

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return NotImplemented
        below = _formula(other)
        quotient = divided(self.formula, below) if self.formula else NOTHING
        if quotient is None:
            raise ArithmeticError("the quotient is no polynomial")
        return Exact(quotient)

    def __pow__(self, exponent: int) -> Exact:
        return Exact(self.formula.power(exponent))

    def __neg__(self) -> Exact:
        return Exact(-self.formula)

    def vanishes(self) -> bool:
        """Whether it is zero, for all values of all symbols."""
        return not self.formula


class Angle:
    """A sum of angles, the argument of cos or sin."""

    __slots__ = ("parts", "space")

    def __init__(self, space: Space, parts: dict[int, int]) -> None:
        self.space, self.parts = space, parts

    def __add__(self, other: Angle) -> Angle:
        return self._plus(other, 1)

    def __sub__(self, other: Angle) -> Angle:
        return self._plus(other, -1)

    def _plus(self, other: Angle, sign: int) -> Angle:
        keys = self.parts.keys() | other.parts.keys()
        return Angle(self.space, {k: self.parts.get(k, 0) + sign * other.parts.get(k, 0) for k in keys})

    def cos(self) -> Exact:
        """Its cosine."""
        return Exact(self.space.cos(self.parts))

    def sin(self) -> Exact:
        """Its sine."""
        return Exact(self.space.sin(self.parts))


def _formula(x: Any) -> Formula:
    if isinstance(x, Exact):
        return x.formula
    return constant(fmpq(*float(x).as_integer_ratio()))


def _number(x: Any) -> Any:
    return x if isinstance(x, Exact | Angle) else Exact(_formula(x))


def exact_arithmetic() -> Objects:
    """An arithmetic in which the documents' equations can be evaluated; it cannot solve linear systems."""
    return Objects("exact", _number, Angle.cos, Angle.sin)


def exact_values(m: Symbols, equal_lengths: bool = False) -> dict[str, Any]:
    """Every symbol of the documents, and what first principles give, for one mechanism; all as formulas."""
    s, n = m.space, m.n
    place = 2 * n

    def length(k: int) -> Formula:
        return s.symbol(place) if equal_lengths else s.l(k)

    def mass(k: int) -> Formula:
        return s.rho * length(k) if m.kind == "rod-chain" else s.m(k)

    joints = [[NOTHING, NOTHING]]  # where each link ends; in the star they start at the end of link 1
    starts, centres = [], []
    for k in range(n):
        start = joints[m.parent(k) + 1]
        whole = [length(k) * s.sin({k: 1}), -(length(k) * s.cos({k: 1}))]
        starts.append(start)
        joints.append([a + b for a, b in zip(start, whole, strict=True)])
        share = HALF if m.kind == "rod-chain" else fmpq(1)
        centres.append([a + b.times(share) for a, b in zip(start, whole, strict=True)])
    velocity = [[s.by_time(x) for x in point] for point in centres]
    kinetic = [
        _rod_energy(s, s.rho * length(k), (starts[k], centres[k], joints[k + 1]))
        if m.kind == "rod-chain"
        else (mass(k) * _squared(velocity[k])).times(HALF)
        for k in range(n)
    ]
    potential = [mass(k) * s.g * centres[k][1] for k in range(n)]
    lagrangian = _sum(kinetic) - _sum(potential)
    momentum = [s.by_rate(lagrangian, i) for i in range(n)]
    momentum_rate = [s.by_time(p) for p in momentum]
    slope = [s.by_angle(lagrangian, i) for i in range(n)]
    row = [a - b for a, b in zip(momentum_rate, slope, strict=True)]
    theta = np.empty(n, dtype=object)
    theta[:] = [Angle(s, {k: 1}) for k in range(n)]
    values: dict[str, Any] = {
        "xp": exact_arithmetic(), "theta": theta, "g": Exact(s.g), "rho": Exact(s.rho),
        "l": array(map(length, range(n))), "m": array(map(mass, range(n))),
        "omega": array(map(s.w, range(n))), "alpha": array(map(s.a, range(n))),
        "position": array(centres), "velocity": array(velocity), "speed_squared": array(map(_squared, velocity)),
        "lagrangian": Exact(lagrangian), "momentum": array(momentum), "momentum_rate": array(momentum_rate),
        "dL_dtheta": array(slope), "row": array(row),
    }  # fmt: skip
    values |= _matrices(m, row, [s.by_angle(_sum(potential), i) for i in range(n)])
    if m.kind == "rod-chain":
        values |= _forces(m, joints, centres, velocity, values)
    return values


def _matrices(m: Symbols, row: Sequence[Formula], gravity: Sequence[Formula]) -> dict[str, Any]:
    """Joint-space inertia matrix, matrix of the squared rates, and gravity, from Lagrange's rows."""
    s, n = m.space, m.n
    parts = [s.split(f) for f in row]
    inertia = array([[part.get(unit(k), NOTHING) for k in range(n)] for part in parts])
    squares = array([[part.get(2 * unit(n + k), NOTHING) for k in range(n)] for part in parts])
    return {"mass_matrix": inertia, "rate_matrix": squares, "gravity": array(gravity)}


def _forces(
    m: Symbols,
    joints: list[list[Formula]],
    centres: list[list[Formula]],
    velocity: list[list[Formula]],
    values: dict[str, Any],
) -> dict[str, Any]:
    """Takeno's vectors and coefficients: joint reaction forces from the balance of the subtree below a joint."""
    s, n = m.space, m.n
    acceleration = array([[s.by_time(x) for x in v] for v in velocity])
    mass, l = values["m"], values["l"]
    weight = np.empty((n, 2), dtype=object)
    weight[:, 0], weight[:, 1] = acceleration[:, 0] * mass, (acceleration[:, 1] + values["g"]) * mass
    force = array([[NOTHING, NOTHING] for _ in range(n + 1)])
    for k in reversed(range(n)):  # the links below joint k load it with their weight and inertia
        force[k] = force[k + 1] - weight[k]
    position = array(centres)
    cosines = np.array([Exact(s.cos({k: 1})) for k in range(n)], dtype=object)
    sines = np.array([Exact(s.sin({k: 1})) for k in range(n)], dtype=object)
    doubled = np.array([[mass[j] * position[j, c] for c in range(2)] for j in range(n)], dtype=object)
    carried = array([[NOTHING, NOTHING] for _ in range(n)])
    for j in range(n):
        carried[j] = doubled[j] + sum((doubled[i] * 2 for i in range(j + 1, n)), array([NOTHING, NOTHING]))
    differences = [[Exact(s.cos({j: 1, k: -1} if j != k else {})) for k in range(n)] for j in range(n)]
    directions = array([[s.sin({k: 1}), -s.cos({k: 1})] for k in range(n)])
    rho, g = values["rho"], values["g"]
    lengths = np.array([values["gravity"][j] / (rho * l[j] * g * sines[j]) for j in range(n)], dtype=object)
    alpha_jk = np.array(
        [[values["mass_matrix"][j, k] / (rho * l[j] * l[k] * differences[j][k]) for k in range(n)] for j in range(n)],
        dtype=object,
    )
    return {
        "r_hat": array(joints), "r": position, "r_ddot": acceleration, "T": force, "L": lengths, "alpha_jk": alpha_jk,
        "a": _along(s, position, cosines), "b": _along(s, carried, cosines), "carried": carried,
        "p_ddot": array([[s.by_time(s.by_time(x.formula)) for x in p] for p in directions]),
        "I": np.array([rho * l[j] ** 3 / 12 for j in range(n)], dtype=object),
        "A": np.array([[values["mass_matrix"][j, k] / (rho * l[j]) for k in range(n)] for j in range(n)], dtype=object),
        "B": np.array([[values["rate_matrix"][j, k] / (rho * l[j]) for k in range(n)] for j in range(n)], dtype=object),
    }  # fmt: skip


def _along(s: Space, points: Array, cosines: Array) -> Array:
    """The coefficient of p(θ_k) in each point: its x by θ_k, over cos θ_k."""
    n = len(cosines)
    return np.array(
        [[Exact(s.by_angle(points[j, 0].formula, k)) / cosines[k] for k in range(n)] for j in range(len(points))],
        dtype=object,
    )


def _rod_energy(s: Space, mass: Formula, points: Iterable[Sequence[Formula]]) -> Formula:
    """½ ∫ |v|² dm along a rod: Simpson's rule through its ends and its middle, exact for a quadratic."""
    first, middle, last = (_squared([s.by_time(x) for x in point]) for point in points)
    return (mass * (first + middle.times(4) + last)).times(fmpq(1, 12))


def _squared(vector: Sequence[Formula]) -> Formula:
    return _sum(x * x for x in vector)


def _sum(parts: Iterable[Formula]) -> Formula:
    total = NOTHING
    for part in parts:
        total = total + part
    return total


def array(formulas: Any) -> Array:
    """Formulas, nested in lists or not, as an array of :class:`Exact`."""
    nested = [list(f) if not isinstance(f, Formula) else f for f in formulas]
    if nested and isinstance(nested[0], list):
        return np.array([[Exact(f) for f in row] for row in nested], dtype=object)  # type: ignore[union-attr]
    out = np.empty(len(nested), dtype=object)
    out[:] = [Exact(f) for f in nested]  # type: ignore[arg-type]
    return out
