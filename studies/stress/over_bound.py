"""Accelerations of the documents' mechanisms against the bound of rounding: what no rounding explains is told apart.

The bound is the checks' own (:mod:`...reference.rounding.bounds`), in the coordinates in which the subject computes,
with its terms of underflow: where numbers are subnormal, digits are lost by no fault, and how many is bounded too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...checks.cell import Cell
from ...checks.comparisons.accelerations import backward_error
from ...checks.facts import SceneFacts
from ...engines import EngineInfo, engine_info
from ...models import NLegPendulum, RodChain, Scene
from ...models.states import States
from ...reference import mass_matrix
from ...reference.kernels.forward_dynamics import in_fitting_units
from ...reference.rounding.bounds import EPSILON, allowed, amplitudes
from ...reference.truth.enclosures import Enclosure
from .axes import Mechanism

Array = NDArray[np.float64]

DOCUMENT, KERNELS = "document", "kernels"
OWN = (DOCUMENT, KERNELS)
# furiko's own: rows of absolute angles, by elimination from the tips without interchanges, or a dense matrix with them.
_OWN = {
    name: EngineInfo(name, "", "", "", "furiko", "", coordinates="absolute", interchanges=interchanges)
    for name, interchanges in ((KERNELS, False), (DOCUMENT, True))
}


def over_bound(subject: str, system: Mechanism, theta: Array, omega: Array, truth: Enclosure, answer: Array) -> float:
    """The largest residual of all rows and states over what rounding may do to it, in this subject.

    Without states in which the mass matrix is singular to its rounding, and those whose bound takes too long to tell.
    """
    info = _OWN.get(subject) or engine_info(subject)
    system = fitted(system) if subject == KERNELS else system
    finite: NDArray[np.bool_] = np.asarray(np.isfinite(answer).all(axis=-1))
    if not finite.any():
        return 0.0
    states = States(tuple(map(str, range(len(theta)))), theta, omega).only(finite)
    facts = _facts(truth).only(finite)
    with np.errstate(all="ignore"):
        cell = Cell(Scene("stress", system), info, None, states, facts)  # type: ignore[arg-type]  # nothing is asked
        regular = cell.amplitude.regular(cell.mass, info.accuracy)
        error, judged = backward_error(cell, answer[finite], cell.amplitude)
    counted = error[regular & judged]
    return float(counted.max(initial=0.0)) / allowed(system.n, info.accuracy)


def fitted(system: Mechanism) -> Mechanism:
    """The system in the units of mass and length in which furiko's kernels compute; accelerations are the same."""
    masses, lengths, gravity = in_fitting_units(system)
    if isinstance(system, RodChain):
        return RodChain(tuple(lengths), density=float(masses[0] / lengths[0]), gravity=gravity)
    return NLegPendulum(tuple(lengths), tuple(masses), gravity)


def underflow(system: Mechanism, theta: Array, omega: Array, truth: Enclosure) -> Array:
    """What underflow may do to the kernels' accelerations, relative to the largest, (B,): M⁻¹ times its part of the
    bound, in each of the roundings that the bound counts."""
    inside = fitted(system)
    amplitude = amplitudes(inside, "absolute")
    lost = EPSILON * allowed(system.n) * amplitude.solution_underflow(omega, truth.high) + 0 * theta
    moved = amplitude.acceleration_errors(mass_matrix(inside, theta), lost).max(axis=-1)
    size = np.abs(truth.high).max(axis=-1)
    return np.asarray(np.divide(moved, size, out=np.zeros_like(moved), where=size > 0))


def _facts(truth: Enclosure) -> SceneFacts:
    """The truth alone, as the check's own function takes it."""
    rows = np.zeros((len(truth.high), 0))
    return SceneFacts(truth.high, truth.low, truth.radius, rows, rows, rows, rows, rows, rows, rows, rows)
