"""Joint forces: what each link exerts on its carrier, against Newton's sum over all that hangs below (Takeno (8))."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...reference.rounding.bounds import EPSILON, allowed, turns
from ...reference.rounding.maximal_elimination import elimination
from ..cell import Cell, quotient, worst
from ..facts import FORCE_STATES

Array = NDArray[np.float64]

NAME = "joint forces"
NEEDS = "joint_forces"


def compare(cell: Cell) -> Iterator[Result]:
    """The engine's forces in the true motion, over the sum of the magnitudes of the forces that make them up."""
    states = cell.states
    chosen = slice(-FORCE_STATES, None)
    theta, omega, alpha = states.theta[chosen], states.omega[chosen], cell.facts.high[chosen]
    expected = cell.facts.forces
    got = cell.answer("joint forces", cell.engine.joint_forces(theta, omega, alpha), expected.shape)
    error = np.linalg.norm(got - expected, axis=-1)
    scale = cell.amplitude.forces(alpha, omega) * turns(theta)[:, None]
    bound = allowed(cell.scene.system.n, cell.info.accuracy)
    beyond = (error > bound * EPSILON * scale).any(axis=-1)
    if cell.info.coordinates == "maximal" and beyond.any():  # seldom, and costs more than all the rest
        scale[beyond] += elimination(cell.scene.system, theta[beyond], omega[beyond])[1]
    found = worst(quotient(error, EPSILON * scale))
    largest = np.linalg.norm(expected, axis=-1).max(axis=-1)
    relative = worst(quotient(error.max(axis=-1), largest)).value
    state, joint = found.index
    label = states.labels[chosen][state]
    agrees = found.value <= bound
    yield cell.result(
        NAME,
        "agrees" if agrees else "differs",
        measured=found.value,
        allowed=bound,
        unit="ε",
        reason=cell.info.accuracy_reason
        if agrees
        else f"the force at joint {joint + 1} is off by {float(error[state, joint]):.3g} N in state {label!r}",
        details={"relative": relative, "joint": joint + 1, "state": label, "states": len(theta)},
    )
