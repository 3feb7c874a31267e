"""Derivatives of the engine's accelerations and its inverse mass matrix, in trees of hinges and slides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...diagnosis.slopes import cause_of, mistakes, of_own_accelerations
from ...records.check import Result
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.derivatives import DerivativeUnits, combined, polarised
from ...reference.rounding.spatial import Magnitudes
from ..cell import judge, relative_error, slopes
from ..facts import PART_OF
from .cell import TreeCell

Array = NDArray[np.float64]

NAME = "derivatives"
NOT_OFFERED = "the engine's adapter does not offer it"


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each of ∂a/∂q, ∂a/∂v and M⁻¹, by the residual that it leaves."""
    count, facts = len(cell.facts.slopes), cell.facts
    q, v = cell.states.q[-count:], cell.states.v[-count:]
    mass, labels = facts.mass_matrix[-count:], cell.states.labels[-count:]
    sizes = _units(cell, count)
    epsilons = EPSILON * cell.roundings[-count:]
    assert cell.info.tree is not None
    offers = cell.info.tree.offers
    answers = slopes(cell, [each for each in offers if each != "derivatives" or not _cannot(cell)], q, v)
    for part, ((name, quantity, words), unit) in enumerate(zip(PART_OF, sizes, strict=True)):
        got = answers[part]
        if got is None:
            why = _cannot(cell) or cell.info.tree.lacks.get(quantity, NOT_OFFERED)
            yield cell.result(f"{NAME} {name}", "skipped", reason=why)
            continue
        true = facts.slopes[:, part]
        error = (got - true) - facts.slopes_low[:, part]
        found = judge(mass @ error, unit, epsilons)
        state, row, column = found.worst.index
        where = f"{cell.freedom(row)}, {cell.freedom(column)}"
        fields: dict[str, Any] = {"reason": "", "cause": None}
        if not found.agrees:
            off, mistake = relative_error(error, true), cause_of(got, mistakes(part, facts.slopes, mass), true)
            if mistake is None and part < 2:
                mistake = of_own_accelerations(cell.engine.accelerations, part, q, v, true)
            says = f": {mistake.says}" if mistake else ""
            fields = {
                "reason": f"{words}: off by {off:.3g} of the largest entry, worst in the row of {cell.freedom(row)!r} "
                f"in state {labels[state]!r}{says}",
                "cause": mistake.cause if mistake else None,
            }
        yield cell.result(
            f"{NAME} {name}",
            "agrees" if found.agrees else "differs",
            details={
                "entry": where,
                "worst state": labels[state],
                "states": count,
                "forward error": relative_error(error, true),
            },
            **fields,
            **found.fields(),
        )


def _cannot(cell: TreeCell) -> str:
    """Why the engine has no derivatives of this mechanism, though it has of others; empty where it has."""
    assert cell.info.tree is not None
    features = cell.scene.system.features
    return next((why for feature, why in cell.info.tree.cannot_differentiate.items() if feature in features), "")


def _units(cell: TreeCell, count: int) -> tuple[Array, Array, Array]:
    """The units of the three residuals, (count, nv, nv) each: as for the documents' mechanisms."""
    origin = (cell.info.moments_of_offers or cell.info.moments) in ("world", "unknown")
    own = [Magnitudes(cell.mechanism, each.q, each.v, world=each.world, origin=origin) for each in cell.magnitudes]
    found = [
        _of_state(cell, units, accelerations, mass, inverse)
        for units, accelerations, mass, inverse in zip(
            own[-count:],
            cell.facts.high[-count:],
            cell.facts.mass_matrix[-count:],
            cell.facts.slopes[:, 2],
            strict=True,
        )
    ]
    return (
        np.array([each.of_positions for each in found]),
        np.array([each.of_rates for each in found]),
        np.array([each.inverse_mass for each in found]),
    )


def _of_state(cell: TreeCell, units: Magnitudes, accelerations: Array, mass: Array, inverse: Array) -> DerivativeUnits:
    root = np.sqrt(np.diag(mass))
    factors = units.mass_matrix + np.outer(root, root)

    def velocity_terms(rates: Array) -> Array:
        each = [Magnitudes(cell.mechanism, units.q, row, world=units.world, origin=units.origin) for row in rates]
        return np.array([one.bias - one.gravity for one in each])

    damping = np.diag(cell.mechanism.per_freedom("damping"))
    rates = polarised(velocity_terms, np.abs(units.v)) + damping
    rows = units.residual(accelerations, mass) + cell.mechanism.per_freedom("stiffness")
    return combined(factors, np.abs(inverse), rows, rates, np.eye(len(mass)))
