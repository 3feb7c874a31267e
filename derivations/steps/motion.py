"""The motion that any rows give, right or wrong: to show the effect of a mistake, not for precise simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...reference.integration.schemes import classical_step
from ..algebra.symbols import Symbols
from ..algebra.trig import COS, digits
from .derivation import Row

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ParameterValues:
    """Numbers for the symbols: lengths [m], masses [kg] or, of rods, the line density [kg/m], gravity [m/s²]."""

    lengths: tuple[float, ...]
    masses: tuple[float, ...] = ()
    density: float = 1.0
    gravity: float = 9.81

    def values(self, m: Symbols) -> dict[int, float]:
        """By place of the symbol."""
        n = m.n
        values = {2 * n + k: l for k, l in enumerate(self.lengths)} | {4 * n: self.gravity, 4 * n + 1: self.density}
        return values | {3 * n + k: x for k, x in enumerate(self.masses)}


class RowMotion:
    """Accelerations that rows give, for numbers in place of l, m, g, ρ; batched over states."""

    def __init__(self, m: Symbols, rows: Sequence[Row], parameters: ParameterValues) -> None:
        self.n = n = m.n
        values = parameters.values(m)
        coefficients, waves, phases, places, powers = [], [], [], [], []
        for i, row in enumerate(rows):
            for q, f in row.items():
                motion = digits(q, 2 * n)
                for (e, h, phase), c in f.terms.items():
                    coefficients.append(float(c.p) / float(c.q) * _product(values, digits(e, m.space.symbol_count)))
                    waves.append([half / 2 for half in digits(h, n)])
                    phases.append(0.0 if phase == COS else -np.pi / 2)
                    places.append((i, next((k for k in range(n) if motion[k]), n)))
                    powers.append(motion[n:])
        self.coefficients, self.phases = np.array(coefficients), np.array(phases)
        self.waves, self.powers = np.array(waves), np.array(powers)
        # sums terms into the entries of the matrix (n, n) and, as column n, of the rest
        self.gather = np.zeros((len(places), n * (n + 1)))
        for term, (i, k) in enumerate(places):
            self.gather[term, i * (n + 1) + k] = 1.0

    def accelerations(self, theta: Array, omega: Array) -> Array:
        """θ̈ [rad/s²], shape (B, n); NaN where the rows do not determine it."""
        waves = np.cos(theta @ self.waves.T + self.phases)
        rates = np.prod(omega[:, None, :] ** self.powers, axis=2)
        entries = ((self.coefficients * waves * rates) @ self.gather).reshape(-1, self.n, self.n + 1)
        try:
            return np.asarray(np.linalg.solve(entries[..., : self.n], -entries[..., self.n, None])[..., 0])
        except np.linalg.LinAlgError:
            return np.full(theta.shape, np.nan)

    def trajectory(self, theta: Array, omega: Array, duration: float, steps: int) -> Array:
        """Angles at ``steps + 1`` equal times from one state, shape (steps + 1, n), by classical Runge-Kutta."""
        y = np.concatenate([theta, omega])[None, :]
        out = [y[0, : self.n]]
        with np.errstate(all="ignore"):
            for _ in range(steps):
                y = self.step(y, duration / steps)
                out.append(y[0, : self.n])
        return np.array(out)

    def step(self, y: Array, h: float) -> Array:
        """One step of classical Runge-Kutta; ``y``: angles and rates, shape (B, 2n)."""
        return classical_step(self._slope, y, h)

    def _slope(self, _: float, y: Array) -> Array:
        theta, omega = y[:, : self.n], y[:, self.n :]
        return np.concatenate([omega, self.accelerations(theta, omega)], axis=1)


def _product(values: Mapping[int, float], exponents: Sequence[int]) -> float:
    result = 1.0
    for place, power in enumerate(exponents):
        if power:
            result *= values[place] ** power
    return result


def divergence_time(one: RowMotion, two: RowMotion, theta: Array, omega: Array, duration: float, steps: int) -> float:
    """When the angles of two motions from one state first differ by 0.1 rad [s]; infinity if they do not."""
    a = b = np.concatenate([theta, omega])[None, :]
    h = duration / steps
    with np.errstate(all="ignore"):
        for k in range(1, steps + 1):
            a, b = one.step(a, h), two.step(b, h)
            if not np.abs(a - b)[0, : one.n].max() <= 0.1:
                return k * h
    return float("inf")
