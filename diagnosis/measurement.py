"""An engine's answers in many states, and their residuals in a planar mechanism's equations of motion.

The engine's accelerations are put into the equations (:func:`furiko.reference.planar_tree.inverse_dynamics`): the
residual torque is divided by what rounding explains of it. That gives one number for each state and hinge, at most one
where engine and mechanism are the same, and linear in most of the mechanism's parameters, so that these can be solved
for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models.coordinates import forces_to_relative, to_absolute, to_relative
from ..models.mechanism import Mechanism
from ..models.tree import SUPPORT
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from ..reference.rounding.bounds import EPSILON, allowed

Array = NDArray[np.float64]

# Roundings a body in readers of model files, which turn frames into one another; an engine's own count has them not.
READER_ROUNDINGS = 4
LEAST_STATES = 32
ANGLE_QUANTUM = 2.0**-30  # [rad], and [rad/s] of rates


@dataclass(frozen=True, eq=False)
class Measurement:
    """States, accelerations and the generalised forces that belong to them, according to the engine.

    ``theta`` [rad], ``omega`` [rad/s], ``alpha`` [rad/s²] and ``torque`` [N m], shape (S, n), of absolute angles.
    ``forward`` (S,): rows of forward dynamics, without applied torques. ``accuracy``: relative accuracy of the engine's
    operations.
    """

    parents: tuple[int, ...]
    theta: Array
    omega: Array
    alpha: Array
    torque: Array
    forward: NDArray[np.bool_]
    accuracy: float = EPSILON

    def __len__(self) -> int:
        return len(self.theta)

    def tolerances(self, p: Parameters) -> Array:
        """The part that rounding explains of each hinge's residual torque [N m], (S, n)."""
        bound = READER_ROUNDINGS * allowed(len(self.parents), self.accuracy) * EPSILON
        sizes = planar.magnitudes(self.parents, p, self.theta, self.omega, self.alpha)
        # An engine that factorises the mass matrix has its rounding there: see :mod:`furiko.reference.rounding.bounds`.
        root = np.sqrt(planar.stretched_inertias(self.parents, p))
        coupled = np.abs(to_relative(self.parents, self.alpha)) @ root
        return np.asarray(np.maximum(bound * np.maximum(sizes, root * coupled[:, None]), 1e-290))

    def residuals(self, p: Parameters, tolerances: Array) -> Array:
        """Residual torque of each hinge over ``tolerances``; leading axes of ``p`` come first: (…, S, n)."""
        rows = planar.inverse_dynamics(self.parents, p, self.theta, self.omega, self.alpha) - self.torque
        return np.asarray(forces_to_relative(self.parents, rows) / tolerances)

    def worst(self, p: Parameters) -> float:
        """The largest residual over its tolerance: at most one where the engine has these parameters."""
        return float(np.max(np.abs(self.residuals(p, self.tolerances(p))), initial=0.0))

    def only(self, chosen: NDArray[np.bool_]) -> Measurement:
        """The chosen (S,) rows alone."""
        theta, omega, alpha, torque = (rows[chosen] for rows in (self.theta, self.omega, self.alpha, self.torque))
        return Measurement(self.parents, theta, omega, alpha, torque, self.forward[chosen], self.accuracy)


def probe_states(mechanism: Mechanism, count: int = LEAST_STATES, seed: int = 1) -> tuple[Array, Array]:
    """Absolute angles [rad] and rates [rad/s] for comparisons, shape (count, n) each.

    Angles all round the circle, inside the joint limits where there are some; rates of both signs, none small.
    Multiples of a power of two, so that relative angles are exact.
    """
    generator = np.random.Generator(np.random.PCG64(seed))
    n = mechanism.n
    phi = generator.uniform(-np.pi, np.pi, (count, n))
    for i, hinge in enumerate(mechanism.hinges):
        if hinge.limits is not None and hinge.limits[0] < hinge.limits[1]:
            phi[:, i] = generator.uniform(*_within_a_turn(*hinge.limits), count)
    hinges = sum(float(np.hypot(*link.hinge)) for link in mechanism.links)
    centres = [float(np.hypot(*link.com)) for link in mechanism.links]
    natural = np.sqrt(max(float(np.hypot(*mechanism.gravity)), 1.0) / max(hinges, *centres, 1e-3))
    rates = natural * generator.uniform(0.5, 3.0, (count, n)) * generator.choice([-1.0, 1.0], (count, n))
    return to_absolute(mechanism.parents, _quantised(phi)), to_absolute(mechanism.parents, _quantised(rates))


def _within_a_turn(low: float, high: float) -> tuple[float, float]:
    """The part of a hinge's range that lies within half a turn of the angle in it that is nearest to zero [rad]."""
    margin = 0.02 * (high - low)
    low, high = low + margin, high - margin
    middle = min(max(0.0, low), high)  # zero is outside many a range: degrees in a file whose angles are radians
    return max(low, middle - np.pi), min(high, middle + np.pi)


def _quantised(values: Array) -> Array:
    return np.asarray(np.round(values / ANGLE_QUANTUM) * ANGLE_QUANTUM)


def measure(engine: Any, mechanism: Mechanism, accuracy: float = EPSILON, seed: int = 1) -> Measurement:
    """Ask an engine for forward dynamics in :func:`probe_states`, and for inverse dynamics where it has them.

    Raises RuntimeError where an answer has the wrong shape, NaN or infinity.
    """
    theta, omega = probe_states(mechanism, max(LEAST_STATES, 2 * mechanism.n), seed)
    alpha = _finite("accelerations", engine.accelerations(theta, omega), theta.shape)
    parts = [(theta, omega, alpha, np.zeros_like(alpha))]
    if has_inverse_dynamics(engine):
        generator = np.random.Generator(np.random.PCG64(seed + 1))
        given = _quantised(np.abs(omega).max() ** 2 * generator.uniform(-1, 1, theta.shape))
        torque = _finite("inverse dynamics", engine.inverse_dynamics(theta, omega, given), theta.shape)
        parts.append((theta, omega, given, torque))
    theta, omega, alpha, torque = (np.concatenate([part[k] for part in parts]) for k in range(4))
    forward = np.concatenate([np.full(len(part[0]), k == 0) for k, part in enumerate(parts)])
    return Measurement(mechanism.parents, theta, omega, alpha, torque, forward, accuracy)


def acceleration_error(
    parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array, alpha: Array, tolerance: float = 0.0
) -> Array:
    """The error of an engine's accelerations by rounding [rad/s²], (S, n).

    ``tolerance``: of an implicit scheme's iterations, relative to the first residual or to n of the largest link's
    torques, as :mod:`furiko.reference.rounding.iterations` has it; what they leave may be in any one row.
    """
    zero = np.zeros_like(theta)
    scale = Measurement(parents, theta, omega, alpha, zero, np.ones(len(theta), dtype=bool)).tolerances(p)
    if tolerance:
        sizes = planar.magnitudes(parents, p, theta, omega, alpha)
        first = np.linalg.norm(sizes, axis=-1)
        scale = scale + tolerance * np.maximum(first, len(parents) * sizes.max(axis=-1))[:, None]
    inverse = np.linalg.inv(planar.mass_matrix(parents, p, theta))
    spread = scale.copy()
    for i, parent in enumerate(parents):
        if parent != SUPPORT:
            spread[:, parent] += scale[:, i]
    return np.asarray((np.abs(inverse) @ spread[..., None])[..., 0])


def has_inverse_dynamics(engine: Any) -> bool:
    """Whether the engine has inverse dynamics."""
    info = getattr(engine, "info", None)
    missing = getattr(info, "missing", {})
    return hasattr(engine, "inverse_dynamics") and "inverse_dynamics" not in missing


def _finite(quantity: str, answer: object, shape: tuple[int, ...]) -> Array:
    values = np.asarray(answer, dtype=np.float64)
    if values.shape != shape:
        raise RuntimeError(f"{quantity}: shape {values.shape} returned, {shape} expected")
    if not np.isfinite(values).all():
        raise RuntimeError(
            f"{quantity}: {int((~np.isfinite(values)).sum())} of {values.size} values are NaN or infinite"
        )
    return values
