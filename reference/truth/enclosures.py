"""Truth: what the literal equations give, enclosed by ball arithmetic, and trajectories in quadruple precision.

Angles and rates are doubles, taken for exactly what they are; so are the mechanism's lengths, masses and gravity (a
rod's mass is ρ l_j, unrounded). Every value comes with the radius of a ball that is proved to hold the true one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arithmetic import Array, balls
from ..documents import equations_of_motion as motion
from ..documents.equations_of_motion import Mechanism
from . import linear_solve as verified
from . import quadruple
from .end_points import lookup
from .quadruple import TrueTrajectory

__all__ = [
    "Terms",
    "TrueTrajectory",
    "Truth",
    "enclosed_accelerations",
    "lookup",
    "precision",
    "true_accelerations",
    "true_energy",
    "true_joint_forces",
    "true_terms",
    "true_trajectory",
]

Floats = NDArray[np.float64]

BITS = 128  # working precision: leaves more than 2⁻⁸⁰ even where a matrix's condition is 1e9
MOST_BITS = 16 * 1024
ENTRIES_AT_ONCE = 200_000  # balls held in memory at a time; each takes about a hundred bytes
AS_GOOD_AS_ZERO = 1e-300  # where a value is zero without its equation showing it
SMALLEST = 5e-324
RELATIVE_RADIUS = 2.0**-80  # promised, relative to the largest component of a state, unless that is as good as zero


@dataclass(frozen=True)
class Truth:
    """True values: each within ``radius`` of the unevaluated sum ``high + low``; ``high`` is the nearest double."""

    high: Floats
    low: Floats
    radius: Floats

    def error(self, values: Floats) -> Floats:
        """How far ``values`` are from the truth, at most (and, but for the radius and rounding, exactly)."""
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


def true_accelerations(system: Mechanism, theta: Floats, omega: Floats) -> Truth:
    """θ̈ [rad/s²] of the literal equations, Shiki (3.10) or Takeno (22); shape (…, n) in and out."""
    return _over_states(lambda t, w, a: a, system, theta, omega, (system.n,))


def true_joint_forces(system: Mechanism, theta: Floats, omega: Floats) -> Truth:
    """Takeno's T_j [N] in the true motion, and the star's forces likewise; (…, n) in, (…, n, 2) out."""
    return _over_states(lambda t, w, a: motion.joint_forces(system, t, w, a), system, theta, omega, (system.n, 2))


def true_energy(system: Mechanism, theta: Floats, omega: Floats) -> Truth:
    """Kinetic and potential energy [J], shape (…, 2)."""

    def both(t: Array, w: Array, a: Array) -> Array:
        return np.stack(motion.energy(system, t, w), axis=-1)

    return _over_states(both, system, theta, omega, (2,), accelerate=False)


def true_terms(system: Mechanism, theta: Floats) -> Terms:
    """The three terms of the equations of motion, entry by entry; (…, n) in."""
    theta = np.asarray(theta, dtype=np.float64)
    n, batch = system.n, theta.shape[:-1]
    rows = theta.reshape(-1, n)
    chunks = [_terms(system, rows[part]) for part in _chunks(len(rows), n)]
    mass, centrifugal, gravity = (np.concatenate(parts) for parts in zip(*chunks, strict=True))
    return Terms(mass.reshape(*batch, n, n), centrifugal.reshape(*batch, n, n), gravity.reshape(*batch, n))


def enclosed_accelerations(system: Mechanism, theta: Array, omega: Array) -> Array:
    """θ̈ as balls for states given as balls, (B, n), at the precision that is set. Raises ZeroDivisionError."""
    equations = motion.literal_system(balls(), system, theta, omega)
    return verified.solve(equations.matrix, equations.right)


def true_trajectory(
    system: Mechanism, theta: Sequence[float] | Floats, omega: Sequence[float] | Floats, times: Sequence[float] | Floats
) -> TrueTrajectory:
    """The trajectory of the literal equations from a state (n,) at ``times[0]``, in quadruple precision.

    Not an enclosure: its error is estimated by a second run. Raises EngineMissing without heyoka.
    """
    return quadruple.integrate(system, [*map(float, theta)], [*map(float, omega)], [*map(float, times)])


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Ball arithmetic at this working precision."""
    import flint

    with flint.ctx.workprec(bits):
        yield


def _over_states(
    quantity: Callable[[Array, Array, Array], Array],
    system: Mechanism,
    theta: Floats,
    omega: Floats,
    shape: tuple[int, ...],
    accelerate: bool = True,
) -> Truth:
    """``quantity`` of (θ, ω, θ̈) in balls, for every state, a chunk at a time, rounded."""
    theta, omega = np.broadcast_arrays(np.asarray(theta, dtype=np.float64), np.asarray(omega, dtype=np.float64))
    batch = theta.shape[:-1]
    t, w = theta.reshape(-1, system.n), omega.reshape(-1, system.n)

    def enclose(part: slice) -> Array:
        xp = balls()
        t_balls, w_balls = xp.array(t[part]), xp.array(w[part])
        return quantity(t_balls, w_balls, enclosed_accelerations(system, t_balls, w_balls) if accelerate else t_balls)

    parts = [_rounded_precisely(partial(enclose, part)) for part in _chunks(len(t), system.n)]
    high, low, radius = (
        np.concatenate([part[k] for part in parts]) if parts else np.empty((0, *shape)) for k in range(3)
    )
    return Truth(*(values.reshape(*batch, *shape) for values in (high, low, radius)))


def _rounded_precisely(enclose: Callable[[], Array]) -> tuple[Floats, Floats, Floats]:
    """High, low and radius of what ``enclose`` gives, with as many bits as the promised radius needs."""
    bits = BITS
    while True:
        try:
            with precision(bits):
                high, low, radius = _rounded(enclose())
        except ZeroDivisionError:  # balls too wide to divide by
            radius = None
        if radius is not None and _narrow(high, radius):
            return high, low, radius
        if bits >= MOST_BITS:
            raise ArithmeticError(
                f"no enclosure of this state's truth with {bits} bits: its numbers differ too much in size"
            )
        bits *= 2


def _narrow(high: Floats, radius: Floats) -> bool:
    rows_high, rows_radius = np.abs(high).reshape(len(high), -1), radius.reshape(len(high), -1)
    return bool((rows_radius.max(-1) <= np.maximum(RELATIVE_RADIUS * rows_high.max(-1), AS_GOOD_AS_ZERO)).all())


def _rounded(values: Array) -> tuple[Floats, Floats, Floats]:
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


_split_each = np.frompyfunc(_split, 1, 3)
_accuracy = np.frompyfunc(lambda ball: ball.rel_accuracy_bits(), 1, 1)


def _terms(system: Mechanism, theta: Floats) -> tuple[Floats, Floats, Floats]:
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


def _chunks(states: int, n: int) -> list[slice]:
    size = max(1, ENTRIES_AT_ONCE // (n * n))
    return [slice(i, i + size) for i in range(0, states, size)]


def main() -> None:
    """Compute the true end points of the catalogue's scenes and of the benchmarks anew.

    ``python -m furiko.reference.truth.enclosures``
    """
    from ...models import find_scenes
    from ...models.benchmark_scenes import BENCHMARKS
    from . import end_points as endpoints

    for scenes, path in ((find_scenes(None), endpoints.PATH), ([*BENCHMARKS.values()], endpoints.BENCHMARKS_PATH)):
        print(f"{endpoints.write(scenes, path)} end points written to {path}")


if __name__ == "__main__":
    main()
