"""The truth about one scene, computed once and shared by every engine's cells."""

from __future__ import annotations

import io
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from ..engines import Offer
from ..models import LibraryMissing, Scene
from ..models.states import States
from ..reference import literal_accelerations
from ..reference.rounding.bounds import EPSILON, SMALLEST, amplitudes, condition
from ..reference.truth import enclosures, newton_euler
from ..reference.truth.derivatives import Derivatives, enclosed_derivatives

Array = NDArray[np.float64]


LITERAL = 8  # angles, up to which the dense matrix of the literal equations is as fast as O(n)
FORCE_STATES = 20  # joint forces are compared in the last so many states: a proven sum costs more than the engine's
SLOPE_STATES = 10  # the same for derivatives, at most,
SLOPE_ENTRIES = 10_000  # and of each matrix so many entries in all, a few tenths of a second of proofs
PARTS = ("of_positions", "of_rates", "inverse_mass")
# The part of the check, the question to the engine, and what it is called.
PART_OF: tuple[tuple[str, Offer, str], ...] = (
    ("∂a/∂q", "derivatives", "derivatives by positions"),
    ("∂a/∂v", "derivatives", "derivatives by rates"),
    ("M⁻¹", "inverse_mass", "inverse of the mass matrix"),
)


@dataclass(frozen=True)
class SceneFacts:
    """``high + low``: the proven accelerations, (B, n), to far more than double precision; ``radius``: their proven
    uncertainty. ``literal``: the document's own formula in double precision, (B, n). ``forces``: the true joint forces
    in the last states, (min(B, 20), n, 2) [N]. ``cond_absolute``, ``cond_relative``: what a backward error of one ε in
    those coordinates does to the accelerations, in ε, (B,). ``slopes``, ``slopes_low``: ∂θ̈/∂θ, ∂θ̈/∂θ̇ and M⁻¹ in the
    last states, (K, 3, n, n) each, K = 0 where no engine is asked for them. ``path + path_low``: the true motion,
    (P, 2n), as :func:`.true_path.true_path` has it, P = 0 where it is not followed.
    """

    high: Array
    low: Array
    radius: Array
    literal: Array
    forces: Array
    cond_absolute: Array
    cond_relative: Array
    slopes: Array
    slopes_low: Array
    path: Array
    path_low: Array

    def to_bytes(self) -> bytes:
        """The arrays as one npz file, which is read without running anything."""
        with io.BytesIO() as file:
            np.savez(file, **{field.name: getattr(self, field.name) for field in fields(self)})
            return file.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> SceneFacts:
        """The reverse."""
        with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
            return cls(**{field.name: arrays[field.name] for field in fields(cls)})

    def only(self, chosen: NDArray[np.bool_]) -> SceneFacts:
        """Those of some of the states."""
        names = [field.name for field in fields(self) if field.name not in ("path", "path_low")]
        rows = {name: getattr(self, name) for name in names}
        return replace(self, **{name: row[chosen[len(chosen) - len(row) :]] for name, row in rows.items()})

    def error(self, accelerations: Array) -> Array:
        """``accelerations`` less the true ones, to double precision's relative accuracy."""
        return (accelerations - self.high) - self.low


def scene_facts(scene: Scene, states: States, *, slopes: bool = True, followed: bool = False) -> SceneFacts:
    """Compute them in ball arithmetic: of short mechanisms from the document's last equation, solved as it stands.

    Long ones take Newton's and Euler's, from which the document derives it: the same numbers, proved as well (the tests
    hold both against each other), at a tenth of the time for a hundred rods. ``slopes``: the derivatives too;
    ``followed``: the true motion.
    """
    system, theta, omega = scene.system, states.theta, states.omega
    proofs = enclosures if system.n <= LITERAL else newton_euler
    truth = proofs.enclosed_accelerations(system, theta, omega)
    path, path_low = _path(scene) if followed else _no_path(scene)
    last = len(theta) - (slope_states(system.n) if slopes else 0)
    high, low = stacked(enclosed_derivatives(system, theta[max(last, 0) :], omega[max(last, 0) :]))
    return SceneFacts(
        high=truth.high,
        low=truth.low,
        radius=truth.radius,
        literal=literal_accelerations(system, theta, omega),
        forces=proofs.enclosed_joint_forces(system, theta[-FORCE_STATES:], omega[-FORCE_STATES:]).high,
        cond_absolute=condition(system, theta, amplitudes(system, "absolute"), truth.high, omega),
        cond_relative=condition(system, theta, amplitudes(system, "relative"), truth.high, omega),
        slopes=high,
        slopes_low=low,
        path=path,
        path_low=path_low,
    )


def _path(scene: Scene) -> tuple[Array, Array]:
    """The true motion; no rows where it cannot be had, which the check that needs it finds out, and says."""
    from .true_path import true_path  # compiled tangents and quadruple precision, which few runs need

    try:
        return true_path(scene)
    except (LibraryMissing, ArithmeticError):
        return _no_path(scene)


def _no_path(scene: Scene) -> tuple[Array, Array]:
    nothing = np.zeros((0, 2 * scene.system.n))
    return nothing, nothing


def slope_states(n: int) -> int:
    """In how many states of a mechanism of ``n`` freedoms derivatives are proved."""
    return max(1, min(SLOPE_STATES, SLOPE_ENTRIES // max(1, n * n)))


def stacked(found: Derivatives) -> tuple[Array, Array]:
    """The three matrices of each state, high and low parts, (K, 3, n, n) each."""
    each = [getattr(found, part) for part in PARTS]
    return np.stack([part.high for part in each], axis=1), np.stack([part.low for part in each], axis=1)


def forward_error(facts: SceneFacts, accelerations: Array) -> Array:
    """Largest error over largest acceleration, in ε, at each state (norm-wise); (B,) from (B, n)."""
    error = np.abs(facts.error(accelerations)).max(axis=-1)
    size = np.abs(facts.high).max(axis=-1)
    scale = np.maximum(size * EPSILON, SMALLEST * EPSILON)  # below it no number is known better
    return np.asarray(np.divide(error, scale, out=np.where(error > 0, np.inf, 0.0), where=size > 0))
