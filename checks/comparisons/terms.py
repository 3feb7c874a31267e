"""The terms of the equations of motion, entry by entry, recovered from the engine's own inverse dynamics.

With τ(θ, ω, θ̈, g) the generalised forces of the absolute angles: column k of the mass matrix is τ(θ, 0, e_k, 0),
column k of the coefficients of ω_k² is τ(θ, e_k, 0, 0), gravity is τ(θ, 0, 0, g); and τ(θ, ω, 0, 0) with all rates at
once shows that there is nothing else: no products ω_j ω_k, nothing linear in the rates.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...models.states import States
from ...records.check import Result
from ...reference import centrifugal_matrix, gravity_vector, mass_matrix
from ...reference.rounding.bounds import EPSILON, allowed, turns
from ..cell import Cell, quotient, worst

Array = NDArray[np.float64]

NAME = "terms"
NEEDS = "inverse_dynamics"
ROWS = 4_000  # inverse dynamics evaluated in one cell, at most: long chains get fewer states, never fewer entries


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of M, C, G and the rest; what a scene has none of is skipped."""
    n = cell.scene.system.n
    chosen = slice(0, max(1, min(len(cell.states), ROWS // (2 * n + 2))))
    # The named states are special on purpose (many zeros); start from the other end, where the random ones are.
    states = cell.states
    states = States(states.labels[::-1][chosen], states.theta[::-1][chosen], states.omega[::-1][chosen])
    theta, omega = states.theta, states.omega
    entries = cell.amplitude.entries()
    yield _result(cell, "M", columns(cell, theta, "alpha") - mass_matrix(cell.scene.system, theta), entries, states)
    if cell.scene.system.gravity:
        rest = np.zeros_like(theta)
        error = cell.torques(theta, rest, rest, gravity=True) - gravity_vector(cell.scene.system, theta)
        yield _result(cell, "G", error, cell.amplitude.absolute_rows(cell.amplitude.weights), states)
    else:
        yield cell.result(f"{NAME} G", "skipped", reason="the scene has no gravity")
    if cell.states.omega.any():
        centrifugal = centrifugal_matrix(cell.scene.system, theta)
        entries = cell.amplitude.absolute_rows(cell.amplitude.velocity_terms(np.eye(cell.scene.system.n))).T
        yield _result(cell, "C", columns(cell, theta, "omega") - centrifugal, entries, states)
        error = cell.torques(theta, omega, np.zeros_like(theta), gravity=False)
        error -= (centrifugal @ (omega**2)[..., None])[..., 0]
        scale = cell.amplitude.absolute_rows(cell.amplitude.velocity_terms(omega))
        yield _result(cell, "velocity", error, scale, states)
    else:
        for term in ("C", "velocity"):
            yield cell.result(f"{NAME} {term}", "skipped", reason="every state of the scene is at rest")


def columns(cell: Cell, theta: Array, unit: str) -> Array:
    """The matrix whose column k is the response to a unit acceleration (or rate) of angle k alone, (B, n, n)."""
    count, n = theta.shape
    repeated = np.repeat(theta, n, axis=0)
    units = np.tile(np.eye(n), (count, 1))
    rest = np.zeros_like(units)
    omega, alpha = (rest, units) if unit == "alpha" else (units, rest)
    response = cell.torques(repeated, omega, alpha, gravity=False)
    return np.asarray(response.reshape(count, n, n).swapaxes(1, 2))


SAYS = {
    "M": "mass matrix",
    "C": "coefficients of the squared rates",
    "G": "gravity terms",
    "velocity": "velocity terms with all rates at once",
}


def _result(cell: Cell, term: str, error: Array, scale: Array, states: States) -> Result:
    raised = turns(states.theta).reshape(-1, *[1] * (error.ndim - 1))
    found = worst(quotient(error, EPSILON * raised * scale))
    bound = allowed(cell.scene.system.n)
    entry = f"{term}[{','.join(str(i + 1) for i in found.index[1:])}]"
    agrees = found.value <= bound
    reason = f"{SAYS[term]}: worst at {entry}"
    if not agrees:
        size, label = float(np.abs(error[found.index])), states.labels[found.index[0]]
        reason = f"{SAYS[term]}: {entry} is off by {size:.3g} in state {label!r}"
    return cell.result(
        f"{NAME} {term}",
        "agrees" if agrees else "differs",
        measured=found.value,
        allowed=bound,
        unit="ε",
        reason=reason,
        details={"entry": entry, "state": states.labels[found.index[0]], "states": len(states)},
    )
