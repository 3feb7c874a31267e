"""The terms of the equations of motion, entry by entry, recovered from the engine's own inverse dynamics.

With τ(θ, ω, θ̈, g) the generalised forces of the absolute angles: column k of the mass matrix is τ(θ, 0, e_k, 0),
column k of the coefficients of ω_k² is τ(θ, e_k, 0, 0), gravity is τ(θ, 0, 0, g); and τ(θ, ω, 0, 0) with all rates at
once shows that there is nothing else: no products ω_j ω_k, nothing linear in the rates.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.states import States
from ...records.check import Result
from ...records.entries import to_entries
from ...reference import centrifugal_matrix, gravity_vector, mass_matrix
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, allowed, turns
from .. import sharp
from ..cell import Cell, quotient, worst

Array = NDArray[np.float64]

NAME = "terms"
ROWS = 4_000  # inverse dynamics evaluated in one cell, at most: long chains get fewer states, never fewer entries


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of M, C, G and the rest; what a scene has none of is skipped."""
    n = cell.scene.system.n
    chosen = slice(0, max(1, min(len(cell.states), ROWS // (2 * n + 2))))
    # The named states are special on purpose (many zeros); start from the other end, where the random ones are.
    states = cell.states
    states = States(states.labels[::-1][chosen], states.theta[::-1][chosen], states.omega[::-1][chosen])
    theta, omega = states.theta, states.omega
    true = mass_matrix(cell.scene.system, theta)
    mass = columns(cell, theta, "alpha") - true
    looked_at, sizes = _spreads(cell, states, np.abs(mass).reshape(len(theta), -1).max(axis=-1))

    def result(term: str, error: Array, scale: Array, theory: Array | None = None) -> Result:
        line = None
        if sizes is not None:
            size: Array = getattr(sizes, SAYS[term][1])
            line = sharp.line(error[looked_at], size, sharp.TERMS, states.at(looked_at), len(states))
        return _result(cell, term, error, scale, states, line, theory)

    yield result("M", mass, cell.amplitude.entries(), true)
    if cell.scene.system.gravity:
        rest = np.zeros_like(theta)
        error = cell.torques(theta, rest, rest, gravity=True) - gravity_vector(cell.scene.system, theta)
        yield result("G", error, cell.amplitude.absolute_rows(cell.amplitude.weights))
    else:
        yield cell.result(f"{NAME} G", "skipped", reason="the scene has no gravity")
    if cell.states.omega.any():
        centrifugal = centrifugal_matrix(cell.scene.system, theta)
        entries = cell.amplitude.absolute_rows(cell.amplitude.velocity_terms(np.eye(cell.scene.system.n))).T
        yield result("C", columns(cell, theta, "omega") - centrifugal, entries, centrifugal)
        error = cell.torques(theta, omega, np.zeros_like(theta), gravity=False)
        error -= (centrifugal @ (omega**2)[..., None])[..., 0]
        yield result("velocity", error, cell.amplitude.absolute_rows(cell.amplitude.velocity_terms(omega)))
    else:
        for term in ("C", "velocity"):
            yield cell.result(f"{NAME} {term}", "skipped", reason="every state of the scene is at rest")


def _spreads(cell: Cell, states: States, excess: Array) -> tuple[NDArray[np.intp], spread.Terms | None]:
    """The effect of rounding on each term, in as many of the states as is affordable; None where in none."""
    most = sharp.states_for_terms(cell.info, cell.scene.system.n)
    at = sharp.chosen(excess, most)
    if not most:
        return at, None
    chosen = states.at(at)
    return at, widest_terms(cell, chosen)


def widest_terms(cell: Cell, states: States) -> spread.Terms:
    """The largest spread of each term in these states, as :func:`..sharp.widest`."""
    system, theta, omega = cell.scene.system, states.theta, states.omega
    ways = [vars(spread.terms(way.info, system, way.amplitude, theta, omega)) for way in cell.ways]
    return spread.Terms(**{term: np.max([way[term] for way in ways], axis=0) for term in ways[0]})


def columns(cell: Cell, theta: Array, unit: str) -> Array:
    """The matrix whose column k is the response to a unit acceleration (or rate) of angle k alone, (B, n, n)."""
    count, n = theta.shape
    repeated = np.repeat(theta, n, axis=0)
    units = np.tile(np.eye(n), (count, 1))
    rest = np.zeros_like(units)
    omega, alpha = (rest, units) if unit == "alpha" else (units, rest)
    response = cell.torques(repeated, omega, alpha, gravity=False)
    return np.asarray(response.reshape(count, n, n).swapaxes(1, 2))


# In words, and the name of its spread.
SAYS = {
    "M": ("mass matrix", "mass"),
    "C": ("coefficients of the squared rates", "coriolis"),
    "G": ("gravity terms", "gravity"),
    "velocity": ("velocity terms with all rates at once", "velocity"),
}


def _result(
    cell: Cell,
    term: str,
    error: Array,
    scale: Array,
    states: States,
    line: sharp.Line | None,
    theory: Array | None,
) -> Result:
    raised = turns(states.theta).reshape(-1, *[1] * (error.ndim - 1))
    quotients = quotient(error, EPSILON * raised * scale)
    found = worst(quotients)
    bound = allowed(cell.scene.system.n, cell.info.accuracy)
    entry = f"{term}[{','.join(str(i + 1) for i in found.index[1:])}]"
    agrees = found.value <= bound
    reason = f"{SAYS[term][0]}: worst at {entry}"
    if not agrees:
        size, label = float(np.abs(error[found.index])), states.labels[found.index[0]]
        reason = f"{SAYS[term][0]}: {entry} is off by {size:.3g} in state {label!r}"
    return cell.result(
        f"{NAME} {term}",
        **sharp.verdict(agrees, line, reason),
        measured=found.value,
        allowed=bound,
        unit="ε",
        details={"entry": entry, "state": states.labels[found.index[0]], "states": len(states)}
        | (line.details() if line else {})
        | ({} if theory is None else _entries(theory, error, quotients, states.labels, found.index[0], bound)),
    )


def _entries(
    theory: Array, error: Array, quotients: Array, labels: tuple[str, ...], state: int, bound: float
) -> dict[str, Any]:
    names = [str(k + 1) for k in range(theory.shape[-1])]
    return to_entries(labels[state], names, names, theory[state], error[state], quotients[state], bound)
