"""A user's model in Exudyn, which reads neither MJCF nor URDF: built from what furiko's reader understood.

It shows whether the equations of motion are right for the file as furiko reads it, not whether furiko reads it right.
Its kinematic tree has no armature and no dry friction; damping and springs it has.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...models import PlanarTree
from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ..exudyn_tree import ExudynTree
from ..protocol import Array


@dataclass(frozen=True)
class _Given:
    """A tree as an adapter wants its system."""

    given: PlanarTree

    def tree(self) -> PlanarTree:
        return self.given


class _Driven(ExudynTree):
    """A tree whose hinges have springs and dampers."""

    def drive(self, mechanism: Mechanism) -> None:
        hinges, torque = mechanism.hinges, self._units.energy
        for parameter, values in (
            ("jointPControlVector", [hinge.stiffness / torque for hinge in hinges]),
            ("jointDControlVector", [hinge.damping / (torque * self._units.time) for hinge in hinges]),
            ("jointPositionOffsetVector", [hinge.rest for hinge in hinges]),
            ("jointVelocityOffsetVector", [0.0] * len(hinges)),
        ):
            self._mbs.SetObjectParameter(self._tree, parameter, values)


class ExudynFile:
    """The file's mechanism in Exudyn."""

    def __init__(self, model: ModelFile) -> None:
        self._mechanism = mechanism = model.mechanism
        self._engine = _Driven(_Given(PlanarTree(mechanism.links, mechanism.gravity[0])))  # type: ignore[arg-type]
        if any(hinge.stiffness or hinge.damping for hinge in mechanism.hinges):
            self._engine.drive(mechanism)

    def compiled(self) -> Mechanism:
        fields, mechanism = self._engine.fields(), self._mechanism
        links = tuple(
            replace(link, hinge=tuple(hinge), com=tuple(com), mass=float(mass), inertia=float(inertia))
            for link, hinge, com, mass, inertia in zip(
                mechanism.links,
                fields.hinges.tolist(),
                fields.centres.tolist(),
                fields.masses,
                fields.inertias,
                strict=True,
            )
        )
        hinges = tuple(replace(h, armature=0.0, friction=0.0, limits=None) for h in mechanism.hinges)
        return replace(mechanism, links=links, hinges=hinges)

    def notes(self) -> tuple[str, ...]:
        said = ["Exudyn reads neither format: built from what furiko's reader understood"]
        if any(h.armature or h.friction for h in self._mechanism.hinges):
            said.append("Exudyn's kinematic tree has no armature and no dry friction: compared without them")
        return tuple(said)

    def settings(self) -> Mapping[str, Any]:
        return {}

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        return np.asarray(self._engine.accelerations(theta, omega))

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        return np.asarray(self._engine.inverse_dynamics(theta, omega, alpha))
