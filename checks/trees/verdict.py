"""How an error that is held against its unit becomes a result; shared by the comparisons of trees."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...records.entries import to_entries
from ...reference.rounding.bounds import EPSILON
from .. import sharp
from ..cell import quotient, worst
from .cell import TreeCell
from .sharp import Usual, line

Array = NDArray[np.float64]

NO_STATE = "in every state rounding leaves no digit of an acceleration sure: M is too near to a singular one"


def judged(
    cell: TreeCell,
    check: str,
    error: Array,
    unit: Array,
    says: Callable[[int, tuple[int, ...]], str],
    details: dict[str, Any],
    theory: Array | None = None,
    usual: Usual | None = None,
) -> Result:
    """One result: the worst of ``error`` over ``unit``, (B, …) both, against the roundings that each state allows.

    ``says``: the sentence where it differs, for the number of the worst state and the rest of the worst index;
    ``theory``: of a matrix (B, nv, nv), what it should be, which is told entry by entry; ``usual``: what rounding
    usually does, so that a result within the bound may be loose.
    """
    allowed = cell.roundings.reshape(-1, *[1] * (error.ndim - 1))
    quotients = quotient(error, EPSILON * allowed * unit)
    excess = worst(quotients)
    state, *rest = excess.index
    bound = float(cell.roundings[state])
    agrees = excess.value <= 1
    if theory is not None:
        names = [cell.freedom(i) for i in range(theory.shape[-1])]
        roundings = bound * quotients[state]
        details = details | to_entries(
            cell.states.labels[state], names, names, theory[state], error[state], roundings, bound
        )
    found = line(cell, quotients, usual) if usual and agrees else None
    reason = "" if agrees else f"{says(state, tuple(rest))} in state {cell.states.labels[state]!r}"
    return cell.result(
        check,
        **sharp.verdict(agrees, found, reason),
        measured=excess.value * bound,
        allowed=bound,
        unit="ε",
        details={"states": len(cell.states), "worst state": cell.states.labels[state]}
        | details
        | (found.details() if found else {}),
    )
