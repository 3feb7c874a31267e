"""Engines that read a user's own model file: MuJoCo and Pinocchio by themselves, Exudyn through furiko's reader.

What they are given is :attr:`ModelFile.text`, which furiko's reader has accepted; they are asked in the absolute
angles of :class:`Mechanism`, like every engine.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...models.coordinates import forces_to_absolute, to_absolute, to_relative
from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ...models.tree import SUPPORT
from ..protocol import Array


class FileEngine(Protocol):
    """A model file in an engine. Angles and rates are absolute, shape (B, n), in the order of the file's mechanism."""

    def __init__(self, model: ModelFile) -> None: ...

    def compiled(self) -> Mechanism:
        """The mechanism as the engine holds it, links in the file's order where they are the file's."""
        ...

    def notes(self) -> tuple[str, ...]:
        """Sentences on what the engine was told besides the file."""
        ...

    def settings(self) -> Mapping[str, Any]:
        """What else it holds that a report should show."""
        ...

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        """θ̈ [rad/s²], (B, n); with features of the engine switched off where it has such switches."""
        ...

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        """Generalised forces [N m] of the absolute angles, (B, n)."""
        ...


@dataclass(frozen=True)
class Reader:
    """An engine's way to a file: ``adapter`` module:Class, ``features`` it can switch off, ``honours``: what of a
    hinge reaches its equations of motion; ``native``: whether it reads the file itself."""

    name: str
    adapter: str
    module: str
    package: str
    native: bool
    features: tuple[str, ...] = ()
    without: tuple[str, ...] = ()

    def load(self, model: ModelFile) -> FileEngine:
        """Import the engine and give it the file. What the engine raises passes through."""
        module, _, name = self.adapter.partition(":")
        made: FileEngine = getattr(importlib.import_module(module, __package__), name)(model)
        return made


READERS: dict[str, Reader] = {
    reader.name: reader
    for reader in (
        Reader(
            "mujoco",
            ".mujoco:MujocoFile",
            "mujoco",
            "mujoco",
            native=True,
            features=("contact", "limit", "frictionloss", "spring", "damper"),
        ),
        Reader("pinocchio-aba", ".pinocchio:PinocchioFile", "pinocchio", "pin", native=True),
        Reader(
            "exudyn-tree",
            ".exudyn:ExudynFile",
            "exudyn",
            "exudyn",
            native=False,
            without=("armature", "friction"),
        ),
    )
}


class FileCoordinates:
    """Between absolute angles and a file's joint coordinates q = sense·φ + zero, in an engine's order of columns."""

    def __init__(self, mechanism: Mechanism, columns: list[int]) -> None:
        self._parents = mechanism.parents
        self._columns = np.asarray(columns, dtype=np.intp)
        self._sense = np.array([hinge.sense for hinge in mechanism.hinges])
        self._zero = np.array([hinge.zero for hinge in mechanism.hinges])

    def positions(self, theta: Array) -> Array:
        """q, (B, n)."""
        return self._placed(self._sense * to_relative(self._parents, theta) + self._zero)

    def rates(self, omega: Array) -> Array:
        """q̇ or q̈, (B, n)."""
        return self._placed(self._sense * to_relative(self._parents, omega))

    def absolute(self, rates: Array) -> Array:
        """θ̇ or θ̈ from q̇ or q̈."""
        return to_absolute(self._parents, np.asarray(self._sense * rates[:, self._columns]))

    def absolute_forces(self, forces: Array) -> Array:
        """Generalised forces of θ from those of q."""
        return forces_to_absolute(self._parents, np.asarray(self._sense * forces[:, self._columns]))

    def _placed(self, values: Array) -> Array:
        placed = np.empty_like(values)
        placed[:, self._columns] = values
        return placed


def in_order(found: Mechanism, wanted: Mechanism) -> Mechanism:
    """``found`` with its links in the order of ``wanted``'s hinges, by name; as it is where they are others."""
    names = [hinge.name for hinge in found.hinges]
    order = [names.index(hinge.name) for hinge in wanted.hinges if hinge.name in names]
    if len(order) != found.n:
        return found
    place = {old: new for new, old in enumerate(order)} | {SUPPORT: SUPPORT}
    from dataclasses import replace

    links = tuple(replace(found.links[old], parent=place[found.links[old].parent]) for old in order)
    if any(link.parent >= i for i, link in enumerate(links)):
        return found
    return replace(
        found,
        links=links,
        hinges=tuple(found.hinges[old] for old in order),
        link_names=tuple(found.link_names[old] for old in order),
    )
