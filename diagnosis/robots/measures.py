"""An engine's mass matrix, bias, passive forces and accelerations, held against the truth of what the engine holds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ...engines.model_files.robot import BoundRobot
from ...models.spatial_mechanism import Array, SpatialMechanism
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.spatial import Magnitudes, magnitudes
from ...reference.truth.spatial import SpatialTruth, spatial_truth
from .states import STATES, probe_states, random_torques

# Of so many freedoms one state moves each in a posture of its own; what is wrong in all postures shows in three.
MANY, STATES_OF_MANY = 300, 3
INDEFINITE = 1e-10  # below rounding of eigenvalues of a matrix with ones on its diagonal
MASS_MATRIX = "mass matrix"  # what it is called as a quantity


@dataclass(frozen=True)
class Measured:
    """The worst entry of one ``quantity`` over the states: ``ratio`` of its difference to what rounding explains.

    ``where``: the joint; ``found`` and ``expected``: the engine's number and the true one, ``allowed``: how far apart
    rounding may bring them.
    """

    quantity: str
    ratio: float
    where: str
    found: float
    expected: float
    allowed: float

    def to_json(self) -> dict[str, Any]:
        """For ``furiko diagnose --json``."""
        return asdict(self)


def measured(bound: BoundRobot, mechanism: SpatialMechanism, *, factorised: bool = True) -> list[Measured]:
    """Each quantity of an engine against the truth of ``mechanism``, which is what the engine holds.

    Without accelerations where these are :func:`not_determined`. ``factorised``: whether its accelerations come from a
    factorised mass matrix. Raises RuntimeError where an answer has the wrong shape, NaN or infinity.
    """
    if not mechanism.nv:
        return []
    q, v = probe_states(mechanism, STATES if mechanism.nv <= MANY else STATES_OF_MANY)
    truths = [spatial_truth(mechanism, q[k], v[k]) for k in range(len(q))]
    units = magnitudes(mechanism, q, v)
    rows = [*_terms(bound, mechanism, truths, units)]
    matrix, bias = (np.array([getattr(t, name).float for t in truths]) for name in ("mass_matrix", "bias"))
    if not_determined(mechanism, truths):
        return rows
    for quantity, torque in (
        ("accelerations", np.zeros_like(v)),
        ("driven accelerations", random_torques(matrix, bias)),
    ):
        rows.append(_accelerations(quantity, bound, mechanism, truths, units, torque, factorised))
    return rows


def not_determined(mechanism: SpatialMechanism, truths: Sequence[SpatialTruth] | None = None) -> str:
    """Why the accelerations of one of the states mean nothing, with the joint, or nothing where they do.

    ``truths``: those of the states, by default of all in which a robot is looked at.
    """
    if truths is None:
        q, v = probe_states(mechanism)
        truths = [spatial_truth(mechanism, q[k], v[k]) for k in range(len(q))]
    return next((why for why in (_why_not_determined(mechanism, truth) for truth in truths) if why), "")


def _why_not_determined(mechanism: SpatialMechanism, truth: SpatialTruth) -> str:
    """An entry of the mass matrix' diagonal that encloses zero: its row is zero then, for no body has a negative
    inertia. Where a file gives one, a freedom may be driven backwards by a force, and bounds rest on √M."""
    freedoms = [placed.joint.name for placed in mechanism.joints for _ in range(placed.joint.freedoms)]
    diagonal = truth.mass_matrix.balls.diagonal()
    weightless = next((name for name, entry in zip(freedoms, diagonal, strict=True) if 0 in entry), "")
    if weightless:
        return f"joint {weightless!r} moves no mass"
    matrix = truth.mass_matrix.float
    scale = np.sqrt(np.abs(np.diag(matrix)))
    least = float(np.linalg.eigvalsh(matrix / np.outer(scale, scale)).min(initial=1.0))
    return "the mass matrix is not positive definite, for an inertia is negative" if least < -INDEFINITE else ""


def worst(measurements: Sequence[Measured]) -> Measured | None:
    """The first of the quantities that is beyond rounding, in the order mass matrix, bias, passive, accelerations."""
    beyond = [one for one in measurements if not one.ratio <= 1]
    return beyond[0] if beyond else None


def _terms(
    bound: BoundRobot, mechanism: SpatialMechanism, truths: list[SpatialTruth], units: list[Magnitudes]
) -> Iterator[Measured]:
    q, v = (np.array([getattr(t, name) for t in truths]) for name in "qv")
    nv = mechanism.nv
    matrix = _finite(MASS_MATRIX, bound.mass_matrix(q), (len(q), nv, nv))
    expected = np.array([truth.mass_matrix.float for truth in truths])
    allowed = np.array([unit.roundings * EPSILON * unit.mass_matrix for unit in units])
    yield _worst(MASS_MATRIX, mechanism, matrix, expected, allowed)
    bias = _finite("bias", bound.bias(q, v), v.shape)
    allowed = np.array([unit.roundings * EPSILON * unit.bias for unit in units])
    yield _worst("bias", mechanism, bias, np.array([truth.bias.float for truth in truths]), allowed)


def _accelerations(
    quantity: str,
    bound: BoundRobot,
    mechanism: SpatialMechanism,
    truths: list[SpatialTruth],
    units: list[Magnitudes],
    torque: Array,
    factorised: bool,
) -> Measured:
    """The accelerations by their residual in the equations of motion, row by row; in forces."""
    q, v = (np.array([getattr(t, name) for t in truths]) for name in "qv")
    found = _finite(quantity, bound.accelerations(q, v, torque), v.shape)
    residual = np.array([_residual(*state) for state in zip(truths, found, torque, strict=True)])
    masses = [truth.mass_matrix.float for truth in truths]
    states = zip(units, found, masses, torque, strict=True)
    rows = [(u.roundings, u.residual(*row, factorised=factorised, inverted=not factorised)) for u, *row in states]
    allowed = np.array([roundings * EPSILON * unit for roundings, unit in rows])
    return _worst(f"force of {quantity}", mechanism, residual, np.zeros_like(residual), allowed)


def _residual(undriven: SpatialTruth, found: Array, torque: Array) -> Array:
    """M a + bias − passive − torque for an engine's accelerations, from the truth of the state without torque."""
    from flint import arb

    balls = undriven.residual(found).balls
    return np.array([float((ball - arb(float(t))).mid()) for ball, t in zip(balls, torque, strict=True)])


def _worst(quantity: str, mechanism: SpatialMechanism, found: Array, expected: Array, allowed: Array) -> Measured:
    ratio = np.abs(found - expected) / np.maximum(allowed, 1e-290)
    at = np.unravel_index(int(np.argmax(ratio)), ratio.shape)
    freedoms = [placed.joint.name for placed in mechanism.joints for _ in range(placed.joint.freedoms)]
    where = " and ".join(dict.fromkeys(f"joint {freedoms[int(k)]!r}" for k in at[1:]))
    return Measured(quantity, float(ratio[at]), where, float(found[at]), float(expected[at]), float(allowed[at]))


def _finite(quantity: str, answer: object, shape: tuple[int, ...]) -> Array:
    values = np.asarray(answer, dtype=np.float64)
    if values.shape != shape:
        raise RuntimeError(f"{quantity}: shape {values.shape} returned, {shape} expected")
    if not np.isfinite(values).all():
        raise RuntimeError(f"{quantity}: {int((~np.isfinite(values)).sum())} of {values.size} values are not finite")
    return values
