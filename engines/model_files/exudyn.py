"""A user's model in Exudyn, which reads neither MJCF nor URDF: the model is built by furiko's reader.

It shows whether the equations of motion are right for the file as furiko reads it, not whether furiko reads it right.
Its kinematic tree has damping and springs, but neither armature nor dry friction.
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
class _TreeOnly:
    """A planar tree in the place of the system that an adapter is made for."""

    planar_tree: PlanarTree

    def tree(self) -> PlanarTree:
        return self.planar_tree


class _WithPassiveTorques(ExudynTree):
    """A tree whose hinges have springs and dampers."""

    def set_passive_torques(self, mechanism: Mechanism) -> None:
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
        self._engine = _WithPassiveTorques(_TreeOnly(PlanarTree(mechanism.links, mechanism.gravity[0])))  # type: ignore[arg-type]
        if any(hinge.stiffness or hinge.damping for hinge in mechanism.hinges):
            self._engine.set_passive_torques(mechanism)

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
        said = ["Exudyn reads neither format: the model was built by furiko's reader"]
        if any(h.armature or h.friction for h in self._mechanism.hinges):
            said.append("Exudyn's kinematic tree has no armature and no dry friction: compared without them")
        return tuple(said)

    def settings(self) -> Mapping[str, Any]:
        return {}

    def integrator(self) -> None:
        return None

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        return np.asarray(self._engine.accelerations(theta, omega))

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        return np.asarray(self._engine.inverse_dynamics(theta, omega, alpha))
