"""Pinocchio, from URDF or MJCF: the articulated-body algorithm, or the mass matrix and its Cholesky factors.

* The PyPI package is ``pin``; the one called ``pinocchio`` there is something else.
* URDF has no gravity and the MJCF reader ignores ``<option gravity>``: gravity is set in the model.
* The MJCF reader takes only a file, and of several bodies on the support only the first. It applies ``boundinertia``,
  which gives point masses an inertia of 1e-15 kg m²; it is set back to zero.
* Joints are ordered depth first and siblings by name (URDF) or as written (MJCF): columns are found by name.
* One call, one state: the parallel routines give other roundings, and are no faster on two cores.
* Its data hold second derivatives of the kinematics, 6 n³ numbers, whatever is computed.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..models import InvalidInput, System, to_mjcf, to_urdf
from .coordinates import RelativeCoordinates, along_across
from .protocol import Array, BareCall, ModelFields, Native

# Pinocchio is a C++ extension without types: Any, here and nowhere else.
pinocchio: Any = import_module("pinocchio")


class _Pinocchio:
    """Shared by all variants, which differ in how the model is read and how accelerations are solved for."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        self._model = self._read(system)
        self._model.gravity.linear = np.array([0.0, 0.0, -tree.gravity])
        self._joints = [self._model.getJointId(name) for name in tree.names("hinge")]
        for joint, link in zip(self._joints, tree.links, strict=True):
            if link.inertia == 0:
                inertia = self._model.inertias[joint]
                self._model.inertias[joint] = pinocchio.Inertia(inertia.mass, inertia.lever, np.zeros((3, 3)))
        self._data = self._model.createData()
        self._coordinates = RelativeCoordinates(tree.parents, [self._model.idx_vs[joint] for joint in self._joints])

    @staticmethod
    def _read(system: System) -> Any:
        return pinocchio.buildModelFromXML(to_urdf(system))

    def _solver(self) -> Callable[[Array, Array], Array]:
        raise NotImplementedError

    def fields(self) -> ModelFields:
        model, joints = self._model, self._joints
        link_of_joint = {0: -1} | {joint: link for link, joint in enumerate(joints)}
        columns = [model.idx_vs[joint] for joint in joints]
        inertias = [model.inertias[joint] for joint in joints]
        return ModelFields(
            dofs=int(model.nv),
            parents=tuple(link_of_joint[model.parents[joint]] for joint in joints),
            hinges=along_across(model.jointPlacements[joint].translation for joint in joints),
            centres=along_across(inertia.lever for inertia in inertias),
            masses=np.array([inertia.mass for inertia in inertias]),
            inertias=np.array([inertia.inertia[1, 1] for inertia in inertias]),
            gravity=model.gravity.linear.copy(),
            armature=model.armature[columns],
            damping=model.damping[columns],
        )

    def accelerations(self, theta: Array, omega: Array) -> Array:
        solve = self._solver()
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            found[row] = solve(q, v)
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        model, data = self._model, self._data
        kept = model.gravity.linear.copy()
        if not gravity:
            model.gravity.linear = np.zeros(3)
        try:
            forces = [pinocchio.rnea(model, data, q, v, a) for q, v, a in self._coordinates.rows(theta, omega, alpha)]
        finally:
            model.gravity.linear = kept
        return self._coordinates.absolute_forces(np.array(forces).reshape(theta.shape))

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        model, data = self._model, self._data
        forces = np.empty((*theta.shape, 2))
        for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
            pinocchio.rnea(model, data, q, v, a)
            pinocchio.forwardKinematics(model, data, q)
            for link, joint in enumerate(self._joints):
                # data.f: the force of the parent on the child, in the child's axes.
                forces[row, link] = -(data.oMi[joint].rotation @ data.f[joint].linear)[[0, 2]]
        return forces

    def energy(self, theta: Array, omega: Array) -> Array:
        model, data = self._model, self._data
        energies = [
            (pinocchio.computeKineticEnergy(model, data, q, v), pinocchio.computePotentialEnergy(model, data, q))
            for q, v in self._coordinates.rows(theta, omega)
        ]
        return np.array(energies).reshape(-1, 2)

    def inverse_mass(self, theta: Array) -> Array:
        found = np.empty((*theta.shape, theta.shape[-1]))
        for row, (q,) in enumerate(self._coordinates.rows(theta)):
            found[row] = self._inverse_mass(q)
        return self._coordinates.absolute_inverse_mass(found)

    def _inverse_mass(self, q: Array) -> Array:
        raise NotImplementedError

    def native(self) -> Native:
        return Native(self._solver(), self._coordinates.relative, self._coordinates.absolute)


class PinocchioAba(_Pinocchio):
    """Articulated-body algorithm; the model from URDF."""

    def _solver(self) -> Callable[[Array, Array], Array]:
        model, data, aba, torques = self._model, self._data, pinocchio.aba, np.zeros(self._model.nv)
        return lambda q, v: aba(model, data, q, v, torques)

    def derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        model, data, torques = self._model, self._data, np.zeros(self._model.nv)
        found = np.empty((2, *theta.shape, theta.shape[-1]))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            pinocchio.computeABADerivatives(model, data, q, v, torques)
            found[0, row], found[1, row] = data.ddq_dq, data.ddq_dv
        return self._coordinates.absolute_matrix(found[0]), self._coordinates.absolute_matrix(found[1])

    def _inverse_mass(self, q: Array) -> Array:
        return both_triangles(pinocchio.computeMinverse(self._model, self._data, q))

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> dict[str, BareCall]:
        """``aba`` on the first state; ``threads`` has no use: there are no batches."""
        ((q, v),) = self._coordinates.rows(theta[:1], omega[:1])
        torques = np.zeros(self._model.nv)
        return {"aba": BareCall(1, partial(pinocchio.aba, self._model, self._data, q, v, torques))}


class PinocchioAbaMjcf(PinocchioAba):
    """Articulated-body algorithm; the model from MJCF."""

    @staticmethod
    def _read(system: System) -> Any:
        if len(system.tree().roots()) > 1:
            raise InvalidInput("pinocchio-aba-mjcf: from MJCF Pinocchio reads only the first body on the support")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "model.xml")
            path.write_text(to_mjcf(system), encoding="utf-8")
            return pinocchio.buildModelFromMJCF(str(path))


class PinocchioCrba(_Pinocchio):
    """Composite-rigid-body algorithm for the mass matrix, then Pinocchio's own Cholesky factors; from URDF."""

    def _solver(self) -> Callable[[Array, Array], Array]:
        model, data = self._model, self._data

        def solve(q: Array, v: Array) -> Array:
            pinocchio.crba(model, data, q)
            pinocchio.cholesky.decompose(model, data)
            bias = pinocchio.nonLinearEffects(model, data, q, v)
            return np.asarray(pinocchio.cholesky.solve(model, data, -bias))

        return solve

    def _inverse_mass(self, q: Array) -> Array:
        pinocchio.crba(self._model, self._data, q)
        pinocchio.cholesky.decompose(self._model, self._data)
        return np.asarray(pinocchio.cholesky.computeMinv(self._model, self._data))


def both_triangles(upper: Array) -> Array:
    """A symmetric matrix from its upper triangle, which is all that some of Pinocchio's algorithms fill."""
    return np.asarray(np.triu(upper) + np.triu(upper, 1).T)
