"""DART, from URDF: Featherstone's articulated bodies, its own recursive Newton-Euler inverse dynamics.

* The module's package on PyPI is ``dartpy``. Its reader moved from ``dartpy.utils`` to ``dartpy.io``.
* URDF has no gravity: it is set in the skeleton. ``getGravity`` is a view, not a copy.
* Degrees of freedom are found by name.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from ..models import System, to_urdf
from .coordinates import RelativeCoordinates, along_across
from .protocol import Array, ModelFields
from .quiet import silenced

# DART is a C++ extension without types: Any, here and nowhere else.
dart: Any = import_module("dartpy")


class Dart:
    """Articulated-body algorithm; the model from URDF."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        loader = (dart.io if hasattr(dart, "io") else dart.utils).DartLoader()
        with silenced():
            self._skeleton = loader.parseSkeletonString(to_urdf(system), "")
        self._skeleton.setGravity([0.0, 0.0, -tree.gravity])
        self._joints = [self._skeleton.getJoint(name) for name in tree.names("hinge")]
        self._bodies = [self._skeleton.getBodyNode(name) for name in tree.names("link")]
        names = [self._skeleton.getDof(i).getName() for i in range(self._skeleton.getNumDofs())]
        self._columns = [names.index(name) for name in tree.names("hinge")]
        self._coordinates = RelativeCoordinates(tree.parents, self._columns)

    def fields(self) -> ModelFields:
        index = {body.getName(): i for i, body in enumerate(self._bodies)}
        parents = [joint.getParentBodyNode() for joint in self._joints]
        inertias = [body.getInertia() for body in self._bodies]
        return ModelFields(
            dofs=int(self._skeleton.getNumDofs()),
            parents=tuple(-1 if parent is None else index[parent.getName()] for parent in parents),
            hinges=along_across([j.getTransformFromParentBodyNode().translation() for j in self._joints]),
            centres=along_across([inertia.getLocalCOM() for inertia in inertias]),
            masses=np.array([inertia.getMass() for inertia in inertias]),
            inertias=np.array([inertia.getMoment()[1, 1] for inertia in inertias]),
            gravity=np.array(self._skeleton.getGravity()),
            armature=np.zeros(len(self._joints)),  # DART knows none
            damping=np.array([joint.getDampingCoefficient(0) for joint in self._joints]),
        )

    def inverse_mass(self, theta: Array) -> Array:
        found = np.empty((*theta.shape, theta.shape[-1]))
        for row, (q,) in enumerate(self._coordinates.rows(theta)):
            self._set(q, np.zeros_like(q))
            found[row] = self._skeleton.getInvMassMatrix()
        return self._coordinates.absolute_inverse_mass(found)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            self._set(q, v)
            self._skeleton.computeForwardDynamics()
            found[row] = self._skeleton.getAccelerations()
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        kept = np.array(self._skeleton.getGravity())
        if not gravity:
            self._skeleton.setGravity(np.zeros(3))
        found = np.empty_like(theta)
        try:
            for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
                self._set(q, v, a)
                self._skeleton.computeInverseDynamics(False, False, False)
                found[row] = self._skeleton.getForces()
        finally:
            self._skeleton.setGravity(kept)
            self._skeleton.setForces(np.zeros(theta.shape[1]))
        return self._coordinates.absolute_forces(found)

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        found = np.empty((*theta.shape, 2))
        for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
            self._set(q, v, a)
            self._skeleton.computeInverseDynamics(False, False, False)
            for link, body in enumerate(self._bodies):
                # The force of the parent on the body, in the body's axes, whose origin is the hinge.
                turned = body.getWorldTransform().rotation()
                found[row, link] = -(turned @ np.array(body.getBodyForce())[3:])[[0, 2]]
        self._skeleton.setForces(np.zeros(theta.shape[1]))
        return found

    def energy(self, theta: Array, omega: Array) -> Array:
        found = np.empty((len(theta), 2))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            self._set(q, v)
            found[row] = self._skeleton.computeKineticEnergy(), self._skeleton.computePotentialEnergy()
        return found

    def _set(self, q: Array, v: Array, a: Array | None = None) -> None:
        self._skeleton.setPositions(q)
        self._skeleton.setVelocities(v)
        if a is not None:
            self._skeleton.setAccelerations(a)
