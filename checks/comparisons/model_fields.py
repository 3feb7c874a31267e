"""Model fields: what the engine compiled against what was asked, before any dynamics."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import ModelFields
from ...models import PlanarTree
from ...models.tree import SUPPORT
from ...records.check import Result
from ...reference.rounding.bounds import EPSILON
from ..cell import Cell

Array = NDArray[np.float64]

NAME = "model fields"
# Numbers are written exactly, so they should come back exactly; readers that pass them through an inertia about
# another point, or a rotation that is the identity, may round each a few times.
ROUNDINGS = 8


@dataclass(frozen=True)
class Field:
    """One field of the model: what was found, what was asked, and the magnitude that one ε of rounding refers to."""

    name: str
    unit: str
    found: Array
    asked: Array
    scale: Array

    def errors(self) -> Array:
        """|found - asked| in ε."""
        return np.asarray(np.abs(self.found - self.asked) / (EPSILON * self.scale))

    def says(self) -> str:
        """The worst entry in words."""
        index = np.unravel_index(int(self.errors().argmax()), self.asked.shape)
        where = "" if self.name == "gravity" else f" of link {index[0] + 1}"
        found, asked = f"{self.found[index]:.17g} {self.unit}", f"{self.asked[index]:.17g} {self.unit}"
        return f"{self.name}{where} is {found}, asked for {asked}"


def compare(cell: Cell) -> Iterator[Result]:
    """One result: the field that is furthest from what was asked."""
    tree = cell.scene.system.tree()
    got = cell.engine.fields()
    wrong = structure(got, tree)
    if wrong:
        yield cell.result(NAME, "differs", cause="joint-dropped-by-parser", reason=wrong)
        return
    fields = numbers(cell, got, tree)
    worst = max(fields, key=lambda field: float(field.errors().max()))
    error = float(worst.errors().max())
    agrees = error <= ROUNDINGS
    yield cell.result(
        NAME,
        "agrees" if agrees else "differs",
        measured=error,
        allowed=float(ROUNDINGS),
        unit="ε",
        reason="" if agrees else worst.says(),
        details={"field": worst.name},
    )


def structure(got: ModelFields, tree: PlanarTree) -> str:
    """A sentence where the engine's mechanism has other hinges or another branching, else an empty string."""
    if got.dofs != tree.n:
        return f"{got.dofs} degrees of freedom compiled, asked for {tree.n}"
    if tuple(got.parents) != tree.parents:
        return f"links hang on {tuple(got.parents)}, asked for {tree.parents}"
    return ""


def numbers(cell: Cell, got: ModelFields, tree: PlanarTree) -> list[Field]:
    """Every field that is a number.

    Rounding refers to the entry's own value. Where that is zero it refers to the size of its kind: gravity, or the
    least m r² of a link about its hinge (times a rate of 1/s for damping). For lengths it always refers to the reach of
    the mechanism: a reader may place links in the world first (Pinocchio's of MJCF does) and take differences then.
    """
    links = tree.links
    size = reach(tree)
    least = min(link.mass * float(np.hypot(*link.com)) ** 2 + link.inertia for link in links)
    rows = (
        ("hinge", "m", got.hinges, [link.hinge for link in links], size),
        ("centre of mass", "m", got.centres, [link.com for link in links], size),
        ("mass", "kg", got.masses, [link.mass for link in links], 1.0),
        ("inertia", "kg m²", got.inertias, [link.inertia for link in links], least),
        ("gravity", "m/s²", got.gravity, [0.0, 0.0, -tree.gravity], tree.gravity or 1.0),
        ("armature", "kg m²", got.armature, [0.0] * tree.n, least),
        ("damping", "N m s", got.damping, [0.0] * tree.n, least),
    )
    fields = []
    for name, unit, found, asked, zero in rows:
        wanted = np.array(asked, dtype=np.float64)
        own = (wanted != 0) & (unit != "m")
        scale = np.where(own, np.abs(wanted), zero)
        fields.append(Field(name, unit, cell.answer(name, found, wanted.shape), wanted, scale))
    return fields


def reach(tree: PlanarTree) -> float:
    """The longest way from the support to a hinge or a centre of mass [m]."""
    hinges: list[float] = []
    for link in tree.links:
        carried = 0.0 if link.parent == SUPPORT else hinges[link.parent]
        hinges.append(carried + float(np.hypot(*link.hinge)))
    return max(hinge + float(np.hypot(*link.com)) for hinge, link in zip(hinges, tree.links, strict=True))
