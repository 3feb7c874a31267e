"""Closed forms: one pendulum by Jacobi's elliptic functions, and the chain of infinitely many rods by Bessel's.

A pendulum is θ̈ = -Ω² sin θ: a point mass on a string has Ω² = g/l, a uniform rod Ω² = 3g/(2l). With
k² = sin²(θ/2) + θ̇²/(4Ω²), which does not change:

    k < 1, swinging:   sin(θ/2) = k sn(Ωt + u₀; k),   cos(θ/2) = dn,   θ̇ = 2Ωk cn
    k > 1, turning:    θ/2 = ±am(Ωkt + u₀; 1/k),      θ̇ = ±2Ωk dn
    k = 1:             sin(θ/2) = tanh(u₀ ± Ωt),      θ̇ = ±2Ω / cosh

All in ball arithmetic, with as many bits as needed: also close to k = 1, where double precision has no correct digit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import RodChain
from ...models.errors import library
from .enclosures import MOST_BITS, precision

Floats = NDArray[np.float64]

FEWEST_BITS = 192
ACCURACY = 2.0**-60  # of a result, relative to max(1, |result|), before it is rounded to double


@dataclass(frozen=True)
class Pendulum:
    """θ̈ = -Ω² sin θ with Ω² = ``factor`` · gravity / length, the three numbers taken as exact."""

    length: float
    gravity: float = 9.81
    factor: float = 1.0

    def motion(self, theta: float, omega: float, times: Sequence[float] | Floats) -> tuple[Floats, Floats]:
        """θ [rad] and θ̇ [rad/s], shape (m,) each, at ``times`` [s] after (before, if negative) the state given.

        Correctly rounded or next to it. θ is not wrapped: it counts turns. Raises ArithmeticError where no number of
        bits decides whether the pendulum turns over.
        """
        rows = _precisely(lambda: _motion(self._squared_rate(), theta, omega, [float(t) for t in np.ravel(times)]))
        result = np.array(rows).reshape(-1, 2)
        return result[:, 0], result[:, 1]

    def period(self, theta: float, omega: float) -> float:
        """Time of one swing to and fro, or of one turn [s]; infinite where the motion never returns.

        Raises ArithmeticError as :meth:`motion` does.
        """
        return _precisely(lambda: [[_period(self._squared_rate(), theta, omega)]])[0][0]

    def _squared_rate(self) -> Any:
        from flint import arb

        return arb(self.factor) * arb(self.gravity) / arb(self.length)


def point_pendulum(length: float, gravity: float = 9.81) -> Pendulum:
    """A point mass on a massless rod [m]: Shiki's double pendulum with no second mass."""
    return Pendulum(length, gravity)


def rod_pendulum(system: RodChain) -> Pendulum:
    """A rod chain of one rod: Takeno (18) with n = 1, (l²/3) θ̈ + (l/2) g sin θ = 0. Raises ValueError for more."""
    if system.n != 1:
        raise ValueError(f"the closed form is that of one rod, not of {system.n}")
    return Pendulum(system.lengths[0], system.gravity, 1.5)


def hanging_chain_rates(length: float, gravity: float, count: int) -> Floats:
    """Angular rates [rad/s] of a hanging chain's first ``count`` small swings, Ω_i = (j₀ᵢ/2) √(g/L).

    The limit of many short rods of total length L (Bernoulli 1732); j₀ᵢ are the zeros of Bessel's J₀.
    """
    return np.asarray(library("scipy.special").jn_zeros(0, count) / 2 * math.sqrt(gravity / length))


def _precisely(evaluate: Callable[[], list[list[Any]]]) -> list[list[float]]:
    """Balls rounded to doubles, with more bits until they are narrow enough. ``evaluate`` may raise _TooWide."""
    bits = FEWEST_BITS
    while bits <= MOST_BITS:
        with precision(bits):
            try:
                rows = evaluate()
            except _TooWideError:
                rows = None
            if rows is not None and all(_narrow(ball) for row in rows for ball in row):
                return [[float(ball) for ball in row] for row in rows]
        bits *= 2
    raise ArithmeticError(f"{MOST_BITS} bits do not tell whether this pendulum turns over")


class _TooWideError(ArithmeticError):
    """A ball does not tell which case holds."""


def _narrow(ball: Any) -> bool:
    if not ball.is_finite():
        return bool(ball > 0)  # an infinite period
    return float(ball.rad()) <= ACCURACY * max(1.0, abs(float(ball)))


def _motion(squared_rate: Any, theta: float, omega: float, times: list[float]) -> list[list[Any]]:
    from flint import arb

    if squared_rate == 0 or (theta == 0 and omega == 0):
        return [[theta + arb(omega) * t, arb(omega)] for t in times]
    rate = squared_rate.sqrt()
    turns, half = _halved(theta)
    speed = arb(omega) / (2 * rate)
    k = (half.sin() ** 2 + speed**2).sqrt()
    beyond = half.cos() ** 2 - speed**2  # 1 - k², without cancellation at k = 1
    if beyond > 0:
        state = _swing(k, beyond, half, speed)
    elif beyond < 0:
        state = _turn(k, half, speed)
    elif beyond == 0:
        state = _separatrix(half, speed)
    else:
        raise _TooWideError
    rows = []
    for t in times:
        angle, velocity = state(rate * t)
        rows.append([2 * (angle + turns * arb.pi()), 2 * rate * velocity])
    return rows


def _halved(theta: float) -> tuple[int, Any]:
    """Whole turns in θ, and half of what is left of it, between -π/2 and π/2."""
    from flint import arb

    turns = round(theta / (2 * math.pi))
    return turns, arb(theta) / 2 - turns * arb.pi()


State = Callable[[Any], tuple[Any, Any]]


def _swing(k: Any, beyond: Any, half: Any, speed: Any) -> State:
    """θ/2 and θ̇/(2Ω) as a function of Ωt, for k < 1."""
    from flint import acb, arb

    functions = _jacobi(k**2, beyond)
    start = acb.elliptic_f(acb(arb.atan2(half.sin() / k, speed / k)), acb(k**2)).real

    def state(phase: Any) -> tuple[Any, Any]:
        sn, cn, dn = functions(start + phase)
        return arb.atan2(k * sn, dn), k * cn

    return state


def _turn(k: Any, half: Any, speed: Any) -> State:
    """The same for k > 1."""
    from flint import acb, arb

    sign = 1 if speed > 0 else -1
    m = 1 / k**2
    functions = _jacobi(m, 1 - m)
    quarter = acb(m).elliptic_k().real
    start = acb.elliptic_f(acb(half), acb(m)).real

    def state(phase: Any) -> tuple[Any, Any]:
        u = start + sign * k * phase
        halves = round(float(u / (2 * quarter)))
        sn, cn, dn = functions(u - 2 * quarter * halves)
        return arb.atan2(sn, cn) + halves * arb.pi(), sign * k * dn

    return state


def _separatrix(half: Any, speed: Any) -> State:
    """The same for k = 1: towards the upright position, which is never reached."""
    from flint import arb

    sign = 1 if speed > 0 else -1
    start = half.sin().atanh()

    def state(phase: Any) -> tuple[Any, Any]:
        u = start + sign * phase
        return arb.atan2(u.sinh(), arb(1)), sign / u.cosh()

    return state


def _jacobi(m: Any, complement: Any) -> Callable[[Any], tuple[Any, Any, Any]]:
    """sn, cn, dn with parameter m = k², by theta functions; ``complement`` is 1 - m."""
    import flint

    acb: Any = flint.acb  # its type stub calls the method modular_theta static
    quarter = acb(m).elliptic_k().real
    tau = acb(0, acb(complement).elliptic_k().real / quarter)
    _, two, three, four = (value.real for value in acb(0).modular_theta(tau))

    def functions(u: Any) -> tuple[Any, Any, Any]:
        t1, t2, t3, t4 = (value.real for value in acb(u / (2 * quarter)).modular_theta(tau))
        return three / two * t1 / t4, four / two * t2 / t4, four / three * t3 / t4

    return functions


def _period(squared_rate: Any, theta: float, omega: float) -> Any:
    from flint import acb, arb

    rate = squared_rate.sqrt()
    _, half = _halved(theta)
    if squared_rate == 0:
        return arb.pos_inf() if omega == 0 else 2 * arb.pi() / abs(arb(omega))
    speed = arb(omega) / (2 * rate)
    m = half.sin() ** 2 + speed**2
    beyond = half.cos() ** 2 - speed**2
    if beyond > 0:
        return 4 * acb(m).elliptic_k().real / rate
    if beyond < 0:
        return 2 * acb(1 / m).elliptic_k().real / (rate * m.sqrt())
    if beyond == 0:
        return arb.pos_inf()
    raise _TooWideError
