"""Accelerations: the engine's forward dynamics against the proven solution of M a + bias = passive."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...reference.rounding.bounds import EPSILON
from .cell import TreeCell
from .sharp import of_accelerations
from .verdict import NO_STATE, judged

Array = NDArray[np.float64]

NAME = "accelerations"


def compare(cell: TreeCell) -> Iterator[Result]:
    """The residual that the engine's accelerations leave decides; the forward error is shown.

    The true M applied to (engine's acceleration less the true one) is that residual, without the cancellation that
    computing it term by term would suffer. Its unit is that of :meth:`Magnitudes.residual`. Where M is singular to
    rounding that is no bound, and a state in which an engine is beyond it is left out.
    """
    facts, states = cell.facts, cell.states
    got = cell.answer(NAME, cell.engine.accelerations(states.q, states.v), states.v.shape)
    error = facts.error(got)
    residual = (facts.mass_matrix @ error[..., None])[..., 0]
    factorised, inverted = cell.info.factorises, cell.info.inverts
    unit = np.array(
        [
            units.residual(accelerations, mass, factorised=factorised, inverted=inverted)
            for units, accelerations, mass in zip(cell.magnitudes, got, facts.mass_matrix, strict=True)
        ]
    )
    forward = np.abs(error).max(axis=-1)
    size = np.abs(facts.high).max(axis=-1)
    relative = np.divide(forward, size, out=np.where(forward > 0, np.inf, 0.0), where=size > 0)

    def says(state: int, index: tuple[int, ...]) -> str:
        (row,) = index
        return (
            f"the acceleration of {cell.freedom(row)!r} is {got[state, row]:.9g}, "
            f"and by the equations of motion {facts.high[state, row]:.9g}"
        )

    moving = size > size.max(initial=0.0) * EPSILON
    details: dict[str, Any] = {"forward error": float(relative[moving].max(initial=0.0))}
    left_out = unsure(cell, residual, unit)
    if left_out.any():
        details["states left out"] = int(left_out.sum())
        residual = np.where(left_out[:, None], 0.0, residual)
    if left_out.all() and len(left_out):
        yield cell.result(NAME, "skipped", reason=NO_STATE)
        return
    yield judged(cell, NAME, residual, unit, says, details, usual=of_accelerations(cell, error))


def unsure(cell: TreeCell, residual: Array, unit: Array) -> NDArray[np.bool_]:
    """Whether an engine is beyond the bound in a state (B,) in which M is singular to its rounding."""
    allowed = EPSILON * cell.roundings[:, None] * unit
    found = np.asarray((np.abs(residual) > allowed).any(axis=-1))
    for state in np.flatnonzero(found):
        found[state] = not cell.magnitudes[state].regular(cell.facts.mass_matrix[state], cell.info.accuracy)
    return found
