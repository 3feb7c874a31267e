"""First principles in ball arithmetic, at random points, for mechanisms too long to be written out in symbols.

Derivatives come from numbers with three nilpotent units (u² = v² = w² = 0: for time, for a displacement, for a rate),
so that nothing is approximated: every result is a ball that contains the true value. Where two expressions differ,
their balls do not meet, and that is a proof; where they are the same, the balls contain zero.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq
from numpy.typing import NDArray

from ...reference.arithmetic import balls

Array = NDArray[Any]
TIME, SHIFT, RATE = 1, 2, 4  # bits of the nilpotent units; a part is named by the units it has


class Nilpotent:
    """Σ over subsets of the units: parts[bits] · units."""

    __slots__ = ("parts",)

    def __init__(self, parts: dict[int, arb]) -> None:
        self.parts = parts

    def __add__(self, other: Nilpotent) -> Nilpotent:
        parts = dict(self.parts)
        for bits, x in other.parts.items():
            parts[bits] = parts[bits] + x if bits in parts else x
        return Nilpotent(parts)

    def __sub__(self, other: Nilpotent) -> Nilpotent:
        return self + other.scaled(arb(-1))

    def __mul__(self, other: Nilpotent) -> Nilpotent:
        parts: dict[int, arb] = {}
        for a, x in self.parts.items():
            for b, y in other.parts.items():
                if not a & b:
                    parts[a | b] = parts[a | b] + x * y if a | b in parts else x * y
        return Nilpotent(parts)

    def scaled(self, factor: arb) -> Nilpotent:
        """Times a plain number."""
        return Nilpotent({bits: factor * x for bits, x in self.parts.items()})

    def part(self, bits: int) -> arb:
        """One part."""
        return self.parts.get(bits, arb(0))

    def without(self, unit: int) -> Nilpotent:
        """The coefficient of a unit, as a number in the other units."""
        return Nilpotent({bits & ~unit: x for bits, x in self.parts.items() if bits & unit})

    def cos_sin(self) -> tuple[Nilpotent, Nilpotent]:
        """Taylor's formula; the fourth power of the nilpotent part is zero."""
        value = self.part(0)
        rest = Nilpotent({bits: x for bits, x in self.parts.items() if bits})
        sine, cosine = value.sin_cos()
        square = rest * rest
        even = Nilpotent({0: arb(1)}) - square.scaled(arb(fmpq(1, 2)))
        odd = rest - (square * rest).scaled(arb(fmpq(1, 6)))
        return even.scaled(cosine) - odd.scaled(sine), even.scaled(sine) + odd.scaled(cosine)


def number(x: arb) -> Nilpotent:
    """A plain number."""
    return Nilpotent({0: x})


class BallPoint:
    """Random parameters and a random state of one mechanism, and what first principles give there."""

    def __init__(self, kind: str, n: int, seed: int, equal_lengths: bool = False) -> None:
        draw = random.Random(f"furiko audit {kind} {n} {seed} {equal_lengths}")
        self.kind, self.n = kind, n

        def positive(count: int) -> Array:
            return _array([arb(fmpq(draw.randrange(2**38, 2**41), 2**40)) for _ in range(count)])

        def signed(count: int) -> Array:
            return _array([arb(fmpq(draw.randrange(-(2**42), 2**42), 2**40)) for _ in range(count)])

        self.l = _array([positive(1)[0]] * n) if equal_lengths else positive(n)
        self.rho, self.g = positive(2)
        self.m = self.l * self.rho if kind == "rod-chain" else positive(n)
        self.theta, self.omega, self.alpha = signed(n), signed(n), signed(n)

    def points(self, theta: Sequence[Nilpotent]) -> tuple[list[list[Nilpotent]], list[list[Nilpotent]]]:
        """Where each link ends (the support first) and where its mass centre is, from the angles."""
        zero = number(arb(0))
        joints, centres = [[zero, zero]], []
        for k in range(self.n):
            parent = k - 1 if self.kind == "rod-chain" or k == 0 else 0
            cosine, sine = theta[k].cos_sin()
            start = joints[parent + 1]
            whole = [sine.scaled(self.l[k]), cosine.scaled(-self.l[k])]
            joints.append([a + b for a, b in zip(start, whole, strict=True)])
            share = arb(fmpq(1, 2)) if self.kind == "rod-chain" else arb(1)
            centres.append([a + b.scaled(share) for a, b in zip(start, whole, strict=True)])
        return joints, centres

    def lagrangian(self, theta: Sequence[Nilpotent], omega: Sequence[Nilpotent]) -> Nilpotent:
        """T - U; velocities are the positions' derivative along ω, a rod's energy is Simpson's integral over it."""
        shift = Nilpotent({SHIFT: arb(1)})
        moved = [t + w * shift for t, w in zip(theta, omega, strict=True)]
        joints, centres = self.points(moved)
        total = number(arb(0))
        for k in range(self.n):
            here = [x.without(SHIFT) for x in centres[k]]
            speed = here[0] * here[0] + here[1] * here[1]
            if self.kind == "rod-chain":
                ends = [[x.without(SHIFT) for x in joints[k]], [x.without(SHIFT) for x in joints[k + 1]]]
                first, last = (x * x + y * y for x, y in ends)
                speed = (first + speed.scaled(arb(4)) + last).scaled(arb(fmpq(1, 6)))
            height = Nilpotent({bits: x for bits, x in centres[k][1].parts.items() if not bits & SHIFT})
            total = total + speed.scaled(self.m[k] / 2) - height.scaled(self.m[k] * self.g)
        return total

    def momentum(self, i: int, alpha: Array) -> tuple[arb, arb]:
        """∂L/∂ω_i and its time derivative along the motion with these accelerations."""
        theta = [Nilpotent({0: t, TIME: w}) for t, w in zip(self.theta, self.omega, strict=True)]
        omega = [Nilpotent({0: w, TIME: a}) for w, a in zip(self.omega, alpha, strict=True)]
        omega[i] = omega[i] + Nilpotent({RATE: arb(1)})
        value = self.lagrangian(theta, omega)
        return value.part(RATE), value.part(RATE | TIME)

    def slope(self, i: int) -> arb:
        """∂L/∂θ_i."""
        theta = [number(t) for t in self.theta]
        theta[i] = theta[i] + Nilpotent({TIME: arb(1)})
        return self.lagrangian(theta, [number(w) for w in self.omega]).part(TIME)

    def values(self, solve: bool) -> dict[str, Any]:
        """Every symbol of the documents. ``solve``: the accelerations are those of the true motion."""
        n = self.n
        slope = _array([self.slope(i) for i in range(n)])
        inertia, rates, gravity = self._matrices()
        if solve:
            at_rest = _array([self.momentum(i, _zeros(n))[1] for i in range(n)]) - slope
            self.alpha = _array(arb_mat(inertia.tolist()).solve(arb_mat([[-x] for x in at_rest])).entries())
        both = [self.momentum(i, self.alpha) for i in range(n)]
        momentum, rate = _array([p for p, _ in both]), _array([r for _, r in both])
        joints, centres, velocity, acceleration = self._kinematics()
        values = {
            "xp": balls(), "l": self.l, "m": self.m, "g": self.g, "rho": self.rho, "e": _array([arb(1)] * n),
            "theta": self.theta, "omega": self.omega, "alpha": self.alpha, "index": 0,
            "position": centres, "velocity": velocity, "speed_squared": (velocity**2).sum(-1),
            "lagrangian": self.lagrangian([number(t) for t in self.theta], [number(w) for w in self.omega]).part(0),
            "momentum": momentum, "momentum_rate": rate, "dL_dtheta": slope, "row": rate - slope,
            "mass_matrix": inertia, "rate_matrix": rates, "gravity": gravity,
            "A": inertia / self.l[:, None],
            "B": rates * self.omega**2 / self.l[:, None] + np.diag(gravity / self.l),
        }  # fmt: skip
        return values | self._forces(values, joints, acceleration) if self.kind == "rod-chain" else values

    def _matrices(self) -> tuple[Array, Array, Array]:
        """Joint-space inertia matrix, matrix of the squared rates, and gravity, column by column."""
        n, omega, g = self.n, self.omega, self.g
        inertia, rates = _zeros((n, n)), _zeros((n, n))
        gravity = _zeros(n)
        self.omega = _zeros(n)
        gravity[:] = [-self.slope(i) for i in range(n)]
        self.g = arb(0)
        for k in range(n):
            unit = _zeros(n)
            unit[k] = arb(1)
            self.omega = _zeros(n)
            inertia[:, k] = [self.momentum(i, unit)[1] for i in range(n)]
            self.omega = unit
            rates[:, k] = [self.momentum(i, _zeros(n))[1] - self.slope(i) for i in range(n)]
        self.omega, self.g = omega, g
        return inertia, rates, gravity

    def _kinematics(self) -> tuple[Array, Array, Array, Array]:
        """Joints, centres, and the centres' velocities and accelerations."""
        half = arb(fmpq(1, 2))
        # two nilpotent units for time: d²/dt² is the part with both, θ(t) = θ + ω t + α t²/2 and t² = 2 u v
        theta = [
            Nilpotent({0: t, TIME: w, SHIFT: w, TIME | SHIFT: 2 * half * a})
            for t, w, a in zip(self.theta, self.omega, self.alpha, strict=True)
        ]
        joints, centres = self.points(theta)
        where = np.array([[x.part(0) for x in point] for point in joints], dtype=object)
        parts = [np.array([[x.part(b) for x in point] for point in centres], dtype=object) for b in (0, TIME, 3)]
        return where, parts[0], parts[1], parts[2]

    def _forces(self, v: dict[str, Any], joints: Array, acceleration: Array) -> dict[str, Any]:
        """Takeno's vectors and coefficients; joint reaction forces from the balance of the subtree below a joint."""
        n, l, m, rho, g = self.n, self.l, self.m, self.rho, self.g
        up = np.array([arb(0), arb(1)], dtype=object)
        force = _zeros((n + 1, 2))
        for k in reversed(range(n)):
            force[k] = force[k + 1] - m[k] * (acceleration[k] + g * up)
        weighted = m[:, None] * v["position"]
        carried = np.array([weighted[j] + 2 * weighted[j + 1 :].sum(0) for j in range(n)], dtype=object)
        along = self._along()
        cosines = np.array([[(a - b).cos() for b in self.theta] for a in self.theta], dtype=object)
        sines = np.array([t.sin() for t in self.theta], dtype=object)
        cos = np.array([t.cos() for t in self.theta], dtype=object)
        w2 = self.omega**2
        return {
            "r_hat": joints, "r": v["position"], "r_ddot": acceleration, "T": force, "carried": carried,
            "L": v["gravity"] / (rho * l * g * sines),
            "alpha_jk": v["mass_matrix"] / (rho * l[:, None] * l * cosines),
            "a": along, "b": m[:, None] * along
            + 2 * np.array([(m[j + 1 :, None] * along[j + 1 :]).sum(0) for j in range(n)], dtype=object),
            "p_ddot": np.stack([cos * self.alpha - sines * w2, sines * self.alpha + cos * w2], axis=-1),
            "I": np.array([_rod_integral(rho, x) for x in l], dtype=object),
            "A": v["mass_matrix"] / (rho * l[:, None]), "B": v["rate_matrix"] / (rho * l[:, None]),
        }  # fmt: skip

    def _along(self) -> Array:
        """The coefficient of p(θ_k) in each centre: its x by θ_k, over cos θ_k."""
        out = _zeros((self.n, self.n))
        for k in range(self.n):
            theta = [number(t) for t in self.theta]
            theta[k] = theta[k] + Nilpotent({TIME: arb(1)})
            _, centres = self.points(theta)
            out[:, k] = [point[0].part(TIME) / self.theta[k].cos() for point in centres]
        return out


@lru_cache(maxsize=32)
def ball_values(kind: str, n: int, seed: int, equal_lengths: bool = False, solve: bool = False) -> dict[str, Any]:
    """The symbols at one random point; the same every time."""
    return BallPoint(kind, n, seed, equal_lengths).values(solve)


def _rod_integral(rho: arb, l: arb) -> arb:
    """∫ ρ x² dx from -l/2 to l/2 by Simpson's rule, exact for x²."""
    return rho * l / 6 * (2 * (l / 2) ** 2)


def _array(values: Sequence[Any]) -> Array:
    out = np.empty(len(values), dtype=object)
    out[:] = list(values)
    return out


def _zeros(shape: int | tuple[int, ...]) -> Array:
    out = np.empty(shape, dtype=object)
    out.fill(arb(0))
    return out
