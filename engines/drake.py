"""Drake, from URDF, in continuous time: articulated bodies, or the mass matrix and a dense solution.

* The plant's time derivatives are its articulated-body algorithm; setting a state marks all that was kept as stale.
* URDF has no gravity: it is set in the plant's gravity field.
* Reaction forces are those of the plant's own accelerations, with their errors: they are left out.
"""

from __future__ import annotations

from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np

from ..models import System, to_urdf
from .coordinates import RelativeCoordinates, along_across
from .protocol import Array, ModelFields
from .quiet import silenced

# Drake is a C++ extension: Any, here and nowhere else. Its module "all" would import matplotlib.
plants: Any = import_module("pydrake.multibody.plant")
autodiff: Any = import_module("pydrake.autodiffutils")
parsing: Any = import_module("pydrake.multibody.parsing")
trees: Any = import_module("pydrake.multibody.tree")


class DrakeAba:
    """Articulated-body algorithm; the model from URDF."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        self._plant = plants.MultibodyPlant(0.0)
        with silenced():
            parsing.Parser(self._plant).AddModelsFromString(to_urdf(system), "urdf")
        self._plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -tree.gravity])
        self._plant.Finalize()
        self._context = self._plant.CreateDefaultContext()
        self._joints = [self._plant.GetJointByName(name) for name in tree.names("hinge")]
        self._bodies = [joint.child_body() for joint in self._joints]
        self._coordinates = RelativeCoordinates(tree.parents, [joint.velocity_start() for joint in self._joints])

    def fields(self) -> ModelFields:
        index = {body.index(): i for i, body in enumerate(self._bodies)}
        inertias = [body.CalcSpatialInertiaInBodyFrame(self._context) for body in self._bodies]
        about_centre = [inertia.Shift(inertia.get_com()).CalcRotationalInertia() for inertia in inertias]
        return ModelFields(
            dofs=int(self._plant.num_velocities()),
            parents=tuple(index.get(joint.parent_body().index(), -1) for joint in self._joints),
            hinges=along_across([j.frame_on_parent().GetFixedPoseInBodyFrame().translation() for j in self._joints]),
            centres=along_across([inertia.get_com() for inertia in inertias]),
            masses=np.array([inertia.get_mass() for inertia in inertias]),
            inertias=np.array([inertia.get_moments()[1] for inertia in about_centre]),
            gravity=np.array(self._plant.gravity_field().gravity_vector()),
            armature=np.zeros(len(self._joints)),  # of actuators, and there are none
            damping=np.array([joint.default_damping_vector()[0] for joint in self._joints]),
        )

    def accelerations(self, theta: Array, omega: Array) -> Array:
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            self._set(q, v)
            found[row] = self._solve()
        return self._coordinates.absolute(found)

    def _solve(self) -> Array:
        return np.array(self._plant.EvalTimeDerivatives(self._context).CopyToVector()[self._plant.num_positions() :])

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        found = np.empty_like(theta)
        for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
            self._set(q, v)
            forces = trees.MultibodyForces_[float](self._plant)
            if gravity:
                self._plant.CalcForceElementsContribution(self._context, forces)
            found[row] = self._plant.CalcInverseDynamics(self._context, a, forces)
        return self._coordinates.absolute_forces(found)

    def derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """By the same algorithm on numbers that carry their derivatives (``AutoDiffXd``)."""
        plant, n = self._differentiating, theta.shape[-1]
        context, first = plant.CreateDefaultContext(), plant.num_positions()
        found = np.empty((2, *theta.shape, n))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            plant.SetPositionsAndVelocities(context, autodiff.InitializeAutoDiff(np.concatenate([q, v])))
            slopes = autodiff.ExtractGradient(plant.EvalTimeDerivatives(context).CopyToVector()[first:])
            found[0, row], found[1, row] = slopes[:, :n], slopes[:, n:]
        return self._coordinates.absolute_matrix(found[0]), self._coordinates.absolute_matrix(found[1])

    @cached_property
    def _differentiating(self) -> Any:
        return self._plant.ToAutoDiffXd()

    def energy(self, theta: Array, omega: Array) -> Array:
        found = np.empty((len(theta), 2))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            self._set(q, v)
            found[row] = self._plant.CalcKineticEnergy(self._context), self._plant.CalcPotentialEnergy(self._context)
        return found

    def _set(self, q: Array, v: Array) -> None:
        self._plant.SetPositionsAndVelocities(self._context, np.concatenate([q, v]))


class DrakeCrba(DrakeAba):
    """Mass matrix, bias and gravity of the plant, and numpy's solution with row interchanges."""

    def _solve(self) -> Array:
        plant, context = self._plant, self._context
        forces = plant.CalcGravityGeneralizedForces(context) - plant.CalcBiasTerm(context)
        return np.linalg.solve(plant.CalcMassMatrix(context), forces)
