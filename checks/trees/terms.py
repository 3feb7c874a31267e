"""The terms of the equations of motion, entry by entry: mass matrix, bias, gravity, forces of dampers and springs."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from ...engines import TreeQuantity
from ...records.check import Result
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.spatial import FORCE_ROUNDINGS
from .cell import TreeCell
from .sharp import Usual, of_bias, of_mass_matrix
from .verdict import judged

Array = NDArray[np.float64]

NAME = "terms"
# The part of the check, the question to the engine, and what it is called.
PARTS: tuple[tuple[str, TreeQuantity, str], ...] = (
    ("M", "mass_matrix", "mass matrix"),
    ("bias", "bias", "bias"),
    ("G", "bias", "gravity terms"),
    ("passive", "passive", "forces of dampers and springs"),
)


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each part; what a scene has none of, or the engine cannot say, is skipped."""
    for part, quantity, words in PARTS:
        reason = _why_not(cell, part, quantity)
        if reason:
            yield cell.result(f"{NAME} {part}", "skipped", reason=reason)
            continue
        got, expected, unit = ANSWERS[part](cell)
        got = cell.answer(words, got, expected.shape)
        yield _result(cell, part, words, got, expected, unit, _usual(cell, part, got - expected))


def _why_not(cell: TreeCell, part: str, quantity: TreeQuantity) -> str:
    assert cell.info.tree is not None
    missing = cell.info.tree.missing.get(quantity, "")
    if missing:
        return missing
    if part == "G" and not any(cell.scene.system.gravity):
        return "the scene has no gravity"
    if part == "passive" and not any(joint.damping or joint.stiffness for joint in cell.scene.system.joints):
        return "the scene has neither dampers nor springs"
    return ""


def _usual(cell: TreeCell, part: str, error: Array) -> Usual | None:
    """What rounding does to a part; forces of dampers and springs have so few roundings that the bound says it."""
    if part == "M":
        return of_mass_matrix(cell, error)
    v = cell.states.v
    return None if part == "passive" else of_bias(cell, 0 * v if part == "G" else v, error)


def _result(
    cell: TreeCell, part: str, words: str, got: Array, expected: Array, unit: Array, usual: Usual | None
) -> Result:
    def says(state: int, index: tuple[int, ...]) -> str:
        where = ", ".join(cell.freedom(i) for i in index)
        at = (state, *index)
        return f"{words}: the entry of {where} is {got[at]:.9g}, and by the equations of motion {expected[at]:.9g}"

    theory = expected if part == "M" else None
    return judged(cell, f"{NAME} {part}", got - expected, unit, says, {}, theory, usual)


def _mass_matrix(cell: TreeCell) -> tuple[Array, Array, Array]:
    unit = np.array([units.mass_matrix for units in cell.magnitudes])
    return cell.engine.mass_matrix(cell.states.q), cell.facts.mass_matrix, unit


def _bias(cell: TreeCell) -> tuple[Array, Array, Array]:
    unit = np.array([units.bias for units in cell.magnitudes])
    return cell.engine.bias(cell.states.q, cell.states.v), cell.facts.bias, unit


def _gravity(cell: TreeCell) -> tuple[Array, Array, Array]:
    """What the bias is at rest."""
    unit = np.array([units.gravity for units in cell.magnitudes])
    return cell.engine.bias(cell.states.q, np.zeros_like(cell.states.v)), cell.facts.gravity, unit


def _passive(cell: TreeCell) -> tuple[Array, Array, Array]:
    """A sum of two products, or of a few more: a fixed number of roundings, however long the mechanism is."""
    roundings = FORCE_ROUNDINGS * cell.info.accuracy / EPSILON
    unit = np.array([units.passive for units in cell.magnitudes]) * (roundings / cell.roundings)[:, None]
    return cell.engine.passive(cell.states.q, cell.states.v), cell.facts.passive, unit


ANSWERS: dict[str, Callable[[TreeCell], tuple[Array, Array, Array]]] = {
    "M": _mass_matrix,
    "bias": _bias,
    "G": _gravity,
    "passive": _passive,
}
