"""Symmetries: what an engine must answer alike of mechanisms that look alike, whoever is right; no truth is needed.

As :mod:`furiko.checks.comparisons.symmetries` has it, of any open mechanism: each image
(:mod:`furiko.models.trees.images`) is exact in floating point but for the turn by 2π, whose rounding is carried through
the accelerations' slopes. Two answers a may therefore differ by the rounding of each: |M⁻¹| times the residual that
rounding explains, which is what :mod:`.accelerations` allows of one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from ...engines import cannot
from ...models import TreeSystem
from ...models.trees import images
from ...models.trees.images import Image
from ...records.check import Result
from ...reference.integration.tree_variation import NUDGE, accelerations
from ...reference.rounding.bounds import EPSILON
from ...reference.truth.spatial import spatial_truth
from .. import sharp
from ..cell import quotient, worst
from .cell import TreeCell
from .sharp import of_accelerations
from .verdict import NO_STATE

Array = NDArray[np.float64]

NAME = "symmetry"

STATES = 3  # random ones; every symmetry is asked for in each
TWO_PI_ERROR = 2.45e-16  # 2π lies within it of its double
SURE = 1 / 4  # beyond it rounding times the condition number of M leaves no digit of accelerations that is sure
BOTH = np.sqrt(2.0)  # the spread of the difference of two answers, in that of one


@dataclass(frozen=True)
class Symmetry:
    """``says`` what it is, in words; ``image`` gives None for mechanisms that do not have it."""

    name: str
    says: str
    image: Callable[[TreeSystem, Array, Array], Image | None]


SYMMETRIES = (
    Symmetry("mirror", "the mirror image moves as the mirror image of the motion", images.mirrored),
    Symmetry("axes", "no axis is another than the others where gravity goes along", images.renamed),
    Symmetry("turn", "no direction is another than the others but that of gravity", images.turned),
    Symmetry(
        "reversal", "without dampers accelerations are the same when all rates are reversed", images.reversed_rates
    ),
    Symmetry("2π", "an angle and the same once round are one place", images.once_round),
    Symmetry("permutation", "branches may be counted in any order", images.branches_exchanged),
    Symmetry("split link", "two halves that are fixed together are one link", images.link_split),
    Symmetry("mass scale", "eight times the mass everywhere changes no motion", images.masses_scaled),
    Symmetry("length scale", "four times the length takes twice the time", images.lengths_scaled),
    Symmetry("gravity scale", "four times gravity takes half the time", images.gravity_scaled),
)


@dataclass(frozen=True, eq=False)
class Asked:
    """A mechanism in states ``q`` (B, nq), ``v`` (B, nv) that an engine was asked about, and its ``answer`` (B, nv)."""

    cell: TreeCell
    system: TreeSystem
    q: Array
    v: Array
    answer: Array

    @cached_property
    def mass(self) -> Array:
        """M, (B, nv, nv)."""
        return np.array([mass_matrix(self.system, row.tobytes()) for row in self.q])

    @cached_property
    def rounding(self) -> Array:
        """How far rounding may take the answer from the exact one, (B, nv)."""
        info = self.cell.info
        found = []
        for q, v, answer, mass in zip(self.q, self.v, self.answer, self.mass, strict=True):
            units = self.cell.magnitudes_of(self.system.mechanism(), q, v)
            rows = units.residual(answer, mass, factorised=info.factorises, inverted=info.inverts)
            rows = self.cell.roundings_of(units) * EPSILON * rows
            found.append(np.abs(inverse(mass)) @ rows)
        return np.array(found)


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each symmetry that the mechanism has."""
    rows = regular(cell)[-STATES:]
    if not len(rows):
        yield cell.result(NAME, "skipped", reason=NO_STATE)
        return
    states = cell.states.at(rows)
    firsts: dict[TreeSystem, Asked] = {}
    spread = _spread(cell, rows)
    for symmetry in SYMMETRIES:
        image = symmetry.image(cell.scene.system, states.q, states.v)
        if image is None:
            continue
        why_not = cannot(cell.info, image.after)
        if why_not:
            yield cell.result(f"{NAME} {symmetry.name}", "skipped", reason=f"the image: {why_not}")
            continue
        if image.before not in firsts:
            firsts[image.before] = _asked(cell, image.before, states.q, states.v)
        second = _asked(cell, image.after, image.q, image.v)
        yield _result(cell, symmetry, image, firsts[image.before], second, rows, spread)


def regular(cell: TreeCell) -> NDArray[np.intp]:
    """Numbers of the states in which digits of accelerations are sure, by M scaled to a diagonal of ones."""
    mass = cell.facts.mass_matrix
    root = np.sqrt(np.diagonal(mass, axis1=1, axis2=2))
    condition = np.array([np.linalg.cond(one / np.outer(by, by)) for one, by in zip(mass, root, strict=True)])
    return np.flatnonzero(cell.roundings * EPSILON * condition < SURE)


@lru_cache(maxsize=256)  # a worker looks at one scene with several engines
def mass_matrix(system: TreeSystem, q: bytes) -> Array:
    """M (nv, nv) at ``q``, the doubles of a state as bytes."""
    return spatial_truth(system.mechanism(), np.frombuffer(q), np.zeros(system.n)).mass_matrix.float


def inverse(mass: Array) -> Array:
    """M⁻¹, of M scaled to a diagonal of ones: its rows have several units."""
    root = np.sqrt(np.diag(mass))
    return np.asarray(np.linalg.inv(mass / np.outer(root, root)) / np.outer(root, root))


def by_angles(image: Image, q: Array, v: Array) -> Array:
    """What rounding of the turned angles does to accelerations at most, (B, nv)."""
    found = np.zeros_like(v)
    if image.turned is None:
        return found
    mechanism, wide = image.before.mechanism(), v.astype(np.longdouble)
    for column in np.flatnonzero(image.turned):
        nudge = NUDGE * np.eye(q.shape[1])[column]
        ends = (accelerations(mechanism, (q + way * nudge).astype(np.longdouble), wide) for way in (1, -1))
        slope = np.abs(np.subtract(*ends)).astype(np.float64) / (2 * NUDGE)
        moved = EPSILON / 2 * np.abs(image.q[:, column]) + TWO_PI_ERROR
        found += moved[:, None] * slope
    return found


def _asked(cell: TreeCell, system: TreeSystem, q: Array, v: Array) -> Asked:
    own = system == cell.scene.system
    engine = cell.engine if own else cell.engine.of(system.mechanism())
    return Asked(cell, system, q, v, cell.answer("accelerations", engine.accelerations(q, v), v.shape))


def _spread(cell: TreeCell, rows: NDArray[np.intp]) -> Array | None:
    """How far apart rounding usually takes two answers in these states, (B, nv); None where that is not known."""
    if not sharp.is_known(cell.info):
        return None
    usual = of_accelerations(cell, cell.facts.high)
    return np.asarray(BOTH * np.max([usual.spread(way, rows) for way in cell.info.ways], axis=0))


def _result(
    cell: TreeCell,
    symmetry: Symmetry,
    image: Image,
    first: Asked,
    second: Asked,
    rows: NDArray[np.intp],
    spread: Array | None,
) -> Result:
    states = cell.states.at(rows)
    back = image.accelerations.back
    besides = by_angles(image, states.q, states.v)
    difference = first.answer - back(second.answer)
    bound = first.rounding + np.abs(back(second.rounding)) + besides
    found = worst(quotient(difference, bound))
    state, freedom = found.index
    agrees = found.value <= 1
    where = f"{cell.freedom(freedom)!r} in state {states.labels[state]!r} answers otherwise"
    line = None
    if agrees and spread is not None and image.before == cell.scene.system:
        factor = of_accelerations(cell, difference).factor
        line = sharp.line(difference, spread, factor, states, len(states), besides)
    return cell.result(
        f"{NAME} {symmetry.name}",
        **sharp.verdict(agrees, line, symmetry.says if agrees else f"it should be that {symmetry.says}; {where}"),
        measured=found.value,
        allowed=1.0,
        unit="×",
        details={"states": len(states), "state": states.labels[state], "freedom": cell.freedom(freedom)}
        | (line.details() if line else {}),
    )
