"""PyBullet, from URDF: its mass matrix and bias forces, and numpy's solution.

* A physics client of its own for each engine. The URDF is read from a file only.
* Inertias are taken from the file (a flag), not from the shapes.
* Its reaction forces of joints in motion are not those of the motion asked for, and are left out; its compiled model
  cannot be read back in full.
* Beyond a hundred links its mass matrix is wrong without a word.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..models import System, to_urdf
from .coordinates import RelativeCoordinates
from .protocol import Array
from .quiet import silenced

with silenced():  # it prints when it was built
    # PyBullet is a C extension without types: Any, here and nowhere else.
    pybullet: Any = import_module("pybullet")


class PyBullet:
    """Mass matrix by composite rigid bodies and bias by recursive Newton-Euler; the model from URDF."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        self._gravity = tree.gravity
        self._client = pybullet.connect(pybullet.DIRECT)
        if self._client < 0:
            raise RuntimeError("PyBullet has no room for another physics client")
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE | pybullet.URDF_MAINTAIN_LINK_ORDER
        with tempfile.TemporaryDirectory() as folder, silenced():
            path = Path(folder, "model.urdf")
            path.write_text(to_urdf(system), encoding="utf-8")
            self._body = pybullet.loadURDF(str(path), useFixedBase=True, flags=flags, physicsClientId=self._client)
        self._set_gravity(tree.gravity)
        joints = range(pybullet.getNumJoints(self._body, physicsClientId=self._client))
        found = [pybullet.getJointInfo(self._body, joint, physicsClientId=self._client) for joint in joints]
        names = [info[1].decode() for info in found if info[2] == pybullet.JOINT_REVOLUTE]
        self._coordinates = RelativeCoordinates(tree.parents, [names.index(name) for name in tree.names("hinge")])

    def __del__(self) -> None:
        if getattr(self, "_client", -1) >= 0:
            pybullet.disconnect(self._client)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._relative(theta, omega)):
            mass = pybullet.calculateMassMatrix(self._body, q, physicsClientId=self._client)
            bias = self._torques(q, v, [0.0] * len(q))
            found[row] = np.linalg.solve(np.array(mass), -np.array(bias))
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        self._set_gravity(self._gravity if gravity else 0.0)
        found = np.empty_like(theta)
        try:
            for row, state in enumerate(self._relative(theta, omega, alpha)):
                found[row] = self._torques(*state)
        finally:
            self._set_gravity(self._gravity)
        return self._coordinates.absolute_forces(found)

    def _torques(self, q: list[float], v: list[float], a: list[float]) -> Any:
        return pybullet.calculateInverseDynamics(self._body, q, v, a, physicsClientId=self._client)

    def _set_gravity(self, gravity: float) -> None:
        pybullet.setGravity(0.0, 0.0, -gravity, physicsClientId=self._client)

    def _relative(self, *absolute: Array) -> Iterator[tuple[list[float], ...]]:
        """Lists, which is what PyBullet takes."""
        rows = [self._coordinates.relative(values).tolist() for values in absolute]
        return zip(*rows, strict=True)
