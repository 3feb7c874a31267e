"""Joint forces: what each link exerts on its carrier, against Newton's sum over all that hangs below (Takeno (8))."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, allowed, turns
from ...reference.rounding.maximal_elimination import furthest_off
from .. import sharp
from ..cell import Cell, quotient, worst
from ..facts import FORCE_STATES

Array = NDArray[np.float64]

NAME = "joint forces"


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
    judged = np.ones(len(theta), dtype=np.bool_)
    if cell.info.coordinates == "maximal" and beyond.any():  # seldom, and costs more than all the rest
        looked_at = furthest_off(beyond, quotient(error, scale).max(axis=-1), cell.most_eliminations)
        scale[looked_at] += cell.elimination(theta[looked_at], omega[looked_at])[1]
        judged[beyond] = False
        judged[looked_at] = True
    excess, left = quotient(error, EPSILON * scale), int((~judged).sum())
    found = worst(np.where(judged[:, None], excess, 0.0))
    largest = np.linalg.norm(expected, axis=-1).max(axis=-1)
    relative = worst(quotient(error.max(axis=-1), largest)).value
    state, joint = found.index
    label = states.labels[chosen][state]
    agrees = found.value <= bound
    reason = f"the force at joint {joint + 1} is off by {float(error[state, joint]):.3g} N in state {label!r}"
    line = sharp_line(cell, error, excess.max(axis=-1))
    details: dict[str, Any] = {"relative": relative, "joint": joint + 1, "state": label, "states": len(theta)}
    if left:
        details["states not judged"] = left
    yield cell.result(
        NAME,
        **sharp.verdict(agrees, line, cell.info.accuracy_reason if agrees else reason),
        measured=found.value,
        allowed=bound,
        unit="ε",
        details=details | (line.details() if line else {}),
    )
    if left and agrees:
        yield cell.not_judged(NAME, left)


def sharp_line(cell: Cell, error: Array, excess: Array) -> sharp.Line | None:
    """Lengths of errors (B, n) [N] in the last states against what rounding does to each."""
    system, info, count = cell.scene.system, cell.info, len(error)
    most = sharp.states_for_accelerations(info, system.n)
    if not most:
        return None
    at = sharp.chosen(excess, most)
    states = cell.states.at(np.arange(len(cell.states))[-count:][at])
    alpha = cell.facts.high[-count:][at]
    size = sharp.widest(cell, spread.joint_forces, states.theta, states.omega, alpha)
    factor = sharp.MAXIMAL if info.coordinates == "maximal" else sharp.JOINT_FORCES
    return sharp.line(error[at], size, factor, states, count)
