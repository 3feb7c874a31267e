"""Engines that load a user's own model file: MuJoCo and Pinocchio read it themselves, Exudyn through furiko's reader.

They are given :attr:`ModelFile.text`, which furiko's reader has accepted, and are asked in the absolute angles of
:class:`Mechanism`, like every engine.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from ...models.coordinates import forces_to_absolute, to_absolute, to_relative
from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ...models.tree import SUPPORT
from ..info import Integrator
from ..protocol import Array


class FileEngine(Protocol):
    """A model file in an engine. Angles and rates are absolute, shape (B, n), in the order of the file's mechanism."""

    def __init__(self, model: ModelFile) -> None: ...

    def compiled(self) -> Mechanism:
        """The mechanism as the engine holds it, links in the file's order where they are the file's."""
        ...

    def notes(self) -> tuple[str, ...]:
        """Sentences on changes to the model and settings that are not in the file."""
        ...

    def settings(self) -> Mapping[str, Any]:
        """Further settings of the engine that a report should show."""
        ...

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        """θ̈ [rad/s²], (B, n); ``without`` the features of its reader that are named, see :class:`Reader`."""
        ...

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        """Generalised forces [N m] of the absolute angles, (B, n)."""
        ...

    def integrator(self) -> Integrator | None:
        """The integrator that the file asks for; None where the engine has none, or the file cannot ask for one."""
        ...

    def trajectory(
        self,
        theta: Array,
        omega: Array,
        integrator: str,
        step: float,
        steps: int,
        without: frozenset[str] = frozenset(),
    ) -> tuple[Array, Array]:
        """θ [rad] and ω [rad/s], (n,) each, after ``steps`` steps of ``step`` [s]. Only with an :meth:`integrator`."""
        ...

    def contacts(self, theta: Array) -> list[tuple[int, str]]:
        """Rows of ``theta`` (B, n) in which geoms touch, with the pair's names. Only with the feature ``contact``."""
        ...


@dataclass(frozen=True)
class Reader:
    """How an engine loads a model file, known without importing it.

    ``adapter``: its class, ``module:Class``; ``module``, ``package``: to import and to install; ``native``: whether the
    engine reads the file itself; ``features``: those it can switch off; ``without``: fields of a hinge that do not
    reach its equations of motion.
    """

    name: str
    adapter: str
    module: str
    package: str
    native: bool
    features: tuple[str, ...] = ()
    without: tuple[str, ...] = ()

    def load(self, model: ModelFile) -> FileEngine:
        """Import the engine and load the file into it. Exceptions of the engine are passed on."""
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
        Reader(
            "pinocchio-aba",
            ".pinocchio:PinocchioFile",
            "pinocchio",
            "pin",
            native=True,
            without=("damping", "friction", "stiffness"),  # its forward dynamics leaves them to the caller
        ),
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
    """Conversion between absolute angles and a file's joint coordinates q = sense·φ + zero, for rows (B, n).

    ``columns``: the engine's column of each link's hinge.
    """

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

    def angles(self, positions: Array) -> Array:
        """θ from q: the reverse of :meth:`positions`."""
        return to_absolute(self._parents, np.asarray(self._sense * (positions[:, self._columns] - self._zero)))

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
    """``found`` with its links in the order of ``wanted``'s hinges, by name; unchanged where the names differ."""
    names = [hinge.name for hinge in found.hinges]
    order = [names.index(hinge.name) for hinge in wanted.hinges if hinge.name in names]
    if len(order) != found.n:
        return found
    place = {old: new for new, old in enumerate(order)} | {SUPPORT: SUPPORT}
    links = tuple(replace(found.links[old], parent=place[found.links[old].parent]) for old in order)
    if any(link.parent >= i for i, link in enumerate(links)):
        return found
    return replace(
        found,
        links=links,
        hinges=tuple(found.hinges[old] for old in order),
        link_names=tuple(found.link_names[old] for old in order),
    )
