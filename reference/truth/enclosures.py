"""Enclosures of the literal equations' values, by ball arithmetic.

Angles and rates are doubles, taken as exact; so are the mechanism's lengths, masses and gravity (a rod's mass is
ρ l_j, unrounded). Every value comes with a radius that is proved: the true value is not further away.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ..arithmetic import Array, balls
from ..documents import equations_of_motion as motion
from . import linear_solve as verified

Floats = NDArray[np.float64]

BITS = 128  # working precision: leaves more than 2⁻⁸⁰ even where a matrix's condition is 1e9
MOST_BITS = 16 * 1024
ENTRIES_AT_ONCE = 200_000  # balls held in memory at a time; each takes about a hundred bytes
AS_GOOD_AS_ZERO = 1e-300  # where a value is zero without its equation showing it
SMALLEST = 5e-324
RELATIVE_RADIUS = 2.0**-80  # promised, relative to the largest component of a state, unless that is as good as zero


@dataclass(frozen=True)
class Enclosure:
    """Values proved to be within ``radius`` of the unevaluated sum ``high + low``; ``high`` is the nearest double."""

    high: Floats
    low: Floats
    radius: Floats

    def error(self, values: Floats) -> Floats:
        """An upper bound of the error of ``values``, sharp up to the radius and rounding; same shape."""
        return np.asarray(np.abs((values - self.high) - self.low) + self.radius)

    @property
    def relative_radius(self) -> float:
        """The largest radius relative to the largest value of its row (the last axis)."""
        largest = np.abs(self.high).max(-1)
        return float(np.max(self.radius.max(-1) / np.where(largest > 0, largest, 1.0), initial=0.0))


@dataclass(frozen=True)
class Terms:
    """M [kg m²], C [kg m²] and G [N m] of M θ̈ + C θ̇² + G = 0, every entry within one rounding."""

    mass: Floats
    centrifugal: Floats
    gravity: Floats


def enclosed_accelerations(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """θ̈ [rad/s²] of the literal equations, Shiki (3.10) or Takeno (22); shape (…, n) in and out.

    The radius is at most 2⁻⁸⁰ of the largest component of a state; raises ArithmeticError where that fails.
    """
    return over_states(lambda t, w, a: a, system, theta, omega, (system.n,))


def enclosed_joint_forces(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """Joint reaction forces [N], Takeno's T_j and the star's, in the free motion; (…, n) in, (…, n, 2) out.

    Raises ArithmeticError as :func:`enclosed_accelerations` does.
    """
    return over_states(lambda t, w, a: motion.joint_forces(system, t, w, a), system, theta, omega, (system.n, 2))


def enclosed_energies(system: DocumentSystem, theta: Floats, omega: Floats) -> Enclosure:
    """Kinetic and potential energy [J], shape (…, 2)."""

    def both(t: Array, w: Array, a: Array) -> Array:
        return np.stack(motion.energies(system, t, w), axis=-1)

    return over_states(both, system, theta, omega, (2,), accelerate=None)


def enclosed_terms(system: DocumentSystem, theta: Floats) -> Terms:
    """The three terms of the equations of motion, every entry proved to one rounding; (…, n) in."""
    theta = np.asarray(theta, dtype=np.float64)
    n, batch = system.n, theta.shape[:-1]
    rows = theta.reshape(-1, n)
    chunks = [_terms(system, rows[part]) for part in _chunks(len(rows), n)]
    mass, centrifugal, gravity = (np.concatenate(parts) for parts in zip(*chunks, strict=True))
    return Terms(mass.reshape(*batch, n, n), centrifugal.reshape(*batch, n, n), gravity.reshape(*batch, n))


def accelerations_in_balls(system: DocumentSystem, theta: Array, omega: Array) -> Array:
    """θ̈ as balls for states given as balls, (B, n), at the precision that is set.

    Raises ZeroDivisionError where that precision cannot show the matrix to be regular.
    """
    equations = motion.literal_system(balls(), system, theta, omega)
    return verified.solve(equations.matrix, equations.right)


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Ball arithmetic at this working precision."""
    import flint

    with flint.ctx.workprec(bits):
        yield


def over_states(
    quantity: Callable[[Array, Array, Array], Array],
    system: DocumentSystem,
    theta: Floats,
    omega: Floats,
    shape: tuple[int, ...],
    accelerate: Callable[[DocumentSystem, Array, Array], Array] | None = accelerations_in_balls,
    *,
    bits: int = BITS,
    at_once: int | None = None,
) -> Enclosure:
    """``quantity`` of (θ, ω, θ̈) in balls, for every state, rounded.

    ``accelerate`` gives θ̈ as :func:`accelerations_in_balls` does; None where the quantity needs none. ``bits``: the
    fewest; ``at_once``: how many states share a precision, as many as fit in memory if not given.
    """
    theta, omega = np.broadcast_arrays(np.asarray(theta, dtype=np.float64), np.asarray(omega, dtype=np.float64))
    batch = theta.shape[:-1]
    t, w = theta.reshape(-1, system.n), omega.reshape(-1, system.n)

    def enclose(part: slice, _bits: int) -> Array:
        xp = balls()
        t_balls, w_balls = xp.array(t[part]), xp.array(w[part])
        return quantity(t_balls, w_balls, accelerate(system, t_balls, w_balls) if accelerate else t_balls)

    parts = [enclosed(partial(enclose, part), bits) for part in _chunks(len(t), system.n, at_once)]
    high, low, radius = (
        np.concatenate([part[k] for part in parts]) if parts else np.empty((0, *shape)) for k in range(3)
    )
    return Enclosure(*(values.reshape(*batch, *shape) for values in (high, low, radius)))


def enclosed(enclose: Callable[[int], Array], bits: int = BITS) -> tuple[Floats, Floats, Floats]:
    """High, low and radius of the balls of ``enclose``, a function of the bits it works with: as many as it needs.

    The radius promised is 2⁻⁸⁰ of the largest of each entry of the first axis. Raises ArithmeticError where no number
    of bits does.
    """
    while True:
        try:
            with precision(bits):
                found = rounded(enclose(bits))
        except ZeroDivisionError:  # balls too wide to divide by
            found = None
        if found is not None and _narrow(found[0], found[2]):
            return found
        if bits >= MOST_BITS:
            raise ArithmeticError(
                f"no enclosure of this state with {bits} bits: its mass matrix is singular, or its numbers differ too "
                "much in size"
            )
        bits *= 2


def _narrow(high: Floats, radius: Floats) -> bool:
    rows_high, rows_radius = np.abs(high).reshape(len(high), -1), radius.reshape(len(high), -1)
    largest = rows_high.max(-1, initial=0.0)
    return bool((rows_radius.max(-1, initial=0.0) <= np.maximum(RELATIVE_RADIUS * largest, AS_GOOD_AS_ZERO)).all())


def rounded(values: Array) -> tuple[Floats, Floats, Floats]:
    """Balls as a sum of two doubles and a radius."""
    high, low, radius = _split_each(values)
    return high.astype(np.float64), low.astype(np.float64), radius.astype(np.float64)


def _split(ball: Any) -> tuple[float, float, float]:
    high = float(ball)
    rest = ball - high
    low = float(rest)
    left = (rest - low).abs_upper()
    if left.is_zero():
        return high, low, 0.0
    return high, low, max(float(left) * (1 + 2.0**-52), SMALLEST)  # float() rounds to nearest


_split_each: Any = np.frompyfunc(_split, 1, 3)
_accuracy = np.frompyfunc(lambda ball: ball.rel_accuracy_bits(), 1, 1)


def _terms(system: DocumentSystem, theta: Floats) -> tuple[Floats, Floats, Floats]:
    bits = BITS
    while True:
        with precision(bits):
            angles = balls().array(theta)
            found = (
                motion.mass_matrix(system, angles),
                motion.centrifugal_matrix(system, angles),
                motion.gravity_vector(system, angles),
            )
            if all(_exact_or_accurate(term) for term in found) or bits >= MOST_BITS:
                mass, centrifugal, gravity = (term.astype(np.float64) for term in found)
                return mass, centrifugal, gravity
        bits *= 2


def _exact_or_accurate(term: Array) -> bool:
    return bool((_accuracy(balls().array(term)) > 60).all())


def _chunks(states: int, n: int, at_once: int | None = None) -> list[slice]:
    size = at_once or max(1, ENTRIES_AT_ONCE // (n * n))
    return [slice(i, i + size) for i in range(0, states, size)]
