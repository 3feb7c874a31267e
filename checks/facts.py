"""The truth about one scene, computed once and shared by every engine's cells."""

from __future__ import annotations

import io
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ..models import Scene
from ..models.states import States
from ..reference import literal_accelerations
from ..reference.rounding.bounds import EPSILON, SMALLEST, amplitudes, condition
from ..reference.truth import enclosures, newton_euler

Array = NDArray[np.float64]


LITERAL = 8  # angles, up to which the dense matrix of the literal equations is as fast as O(n)
FORCE_STATES = 20  # joint forces are compared in the last so many states: a proven sum costs more than the engine's


@dataclass(frozen=True)
class SceneFacts:
    """``high + low``: the proven accelerations, (B, n), to far more than double precision; ``radius``: their proven
    uncertainty. ``literal``: the document's own formula in double precision, (B, n). ``forces``: the true joint forces
    in the last states, (min(B, 20), n, 2) [N]. ``cond_absolute``, ``cond_relative``: what a backward error of one ε in
    those coordinates does to the accelerations, in ε, (B,).
    """

    high: Array
    low: Array
    radius: Array
    literal: Array
    forces: Array
    cond_absolute: Array
    cond_relative: Array

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
        rows = {field.name: getattr(self, field.name) for field in fields(self)}
        last = chosen[-FORCE_STATES:]
        return SceneFacts(**{name: row[last if name == "forces" else chosen] for name, row in rows.items()})

    def error(self, accelerations: Array) -> Array:
        """``accelerations`` less the true ones, to double precision's relative accuracy."""
        return (accelerations - self.high) - self.low


def scene_facts(scene: Scene, states: States) -> SceneFacts:
    """Compute them in ball arithmetic: of short mechanisms from the document's last equation, solved as it stands.

    Long ones take Newton's and Euler's, from which the document derives it: the same numbers, proved as well (the tests
    hold both against each other), at a tenth of the time for a hundred rods.
    """
    system, theta, omega = scene.system, states.theta, states.omega
    proofs = enclosures if system.n <= LITERAL else newton_euler
    truth = proofs.enclosed_accelerations(system, theta, omega)
    return SceneFacts(
        high=truth.high,
        low=truth.low,
        radius=truth.radius,
        literal=literal_accelerations(system, theta, omega),
        forces=proofs.enclosed_joint_forces(system, theta[-FORCE_STATES:], omega[-FORCE_STATES:]).high,
        cond_absolute=condition(system, theta, amplitudes(system, "absolute"), truth.high, omega),
        cond_relative=condition(system, theta, amplitudes(system, "relative"), truth.high, omega),
    )


def forward_error(facts: SceneFacts, accelerations: Array) -> Array:
    """Largest error over largest acceleration, in ε, at each state (norm-wise); (B,) from (B, n)."""
    error = np.abs(facts.error(accelerations)).max(axis=-1)
    size = np.abs(facts.high).max(axis=-1)
    scale = np.maximum(size * EPSILON, SMALLEST * EPSILON)  # below it no number is known better
    return np.asarray(np.divide(error, scale, out=np.where(error > 0, np.inf, 0.0), where=size > 0))
