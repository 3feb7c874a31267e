"""Exudyn in minimal coordinates: one ``ObjectKinematicTree`` whose coordinates are the relative hinge angles.

* Exudyn's plane is x-y with y up; hinges turn about +z, so that angles keep their sign.
* Accelerations are the initial accelerations that the implicit solver computes when it is initialised; it gives its
  mass matrix and right-hand side only after ``computeInitialAccelerations`` is switched off.
* Linear solver: Eigen's dense LU. Exudyn's own (the default) inverts the matrix, which costs a factor of thirty in
  accuracy at a hundred links, and time.
* The potential energy is counted from the reference configuration (all angles zero), not from the support.
* The mechanism is scaled to units that fit it, see :mod:`furiko.models.units`; in a motion the unit of time, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ..models import System
from ..models.units import in_units, units_of
from .coordinates import RelativeCoordinates
from .exudyn_settings import Current, Initial, exudyn, items, quiet_settings, run, run_adaptive
from .protocol import Array, ModelFields

_SOLVER = exudyn.LinearSolverType.EigenDense


class ExudynTree:
    """The mechanism as one kinematic tree."""

    def __init__(self, system: System) -> None:
        self._units = units_of(system.tree())
        self._gravity = system.tree().gravity
        tree = in_units(system.tree(), self._units)
        links, n = tree.links, tree.n
        self._mbs = exudyn.SystemContainer().AddSystem()
        self._node = self._mbs.AddNode(
            items.NodeGenericODE2(
                referenceCoordinates=[0.0] * n,
                initialCoordinates=[0.0] * n,
                initialCoordinates_t=[0.0] * n,
                numberOfODE2Coordinates=n,
            )
        )
        self._tree = self._mbs.AddObject(
            items.ObjectKinematicTree(
                nodeNumber=self._node,
                gravity=[0.0, -tree.gravity, 0.0],
                baseOffset=[0.0, 0.0, 0.0],
                jointTypes=[exudyn.JointType.RevoluteZ] * n,
                linkParents=list(tree.parents),
                jointTransformations=exudyn.Matrix3DList([np.eye(3)] * n),
                jointOffsets=exudyn.Vector3DList([_point(link.hinge) for link in links]),
                linkInertiasCOM=exudyn.Matrix3DList([np.eye(3) * link.inertia for link in links]),
                linkCOMs=exudyn.Vector3DList([_point(link.com) for link in links]),
                linkMasses=[link.mass for link in links],
            )
        )
        self._mbs.Assemble()
        self._settings = quiet_settings(_SOLVER)
        self._at_rest = quiet_settings(_SOLVER)
        self._at_rest.timeIntegration.generalizedAlpha.computeInitialAccelerations = False
        self._coordinates = RelativeCoordinates(tree.parents)

    def fields(self) -> ModelFields:
        held = self._mbs.GetObject(self._tree)
        n = self._mbs.systemData.ODE2Size()
        x, y, z = held["gravity"]
        damping = held["jointDControlVector"]
        units = self._units
        return ModelFields(
            dofs=n,
            parents=tuple(held["linkParents"]),
            hinges=_along_across(held["jointOffsets"]) * units.length,
            centres=_along_across(held["linkCOMs"]) * units.length,
            masses=np.array(held["linkMasses"]) * units.mass,
            inertias=np.array([inertia[2, 2] for inertia in _items(held["linkInertiasCOM"])]) * units.inertia,
            gravity=np.array([x, -z, y]) * units.acceleration,
            armature=np.zeros(n),  # Exudyn has none
            damping=(np.array(damping) if len(damping) else np.zeros(n)) * (units.energy * units.time),
        )

    def accelerations(self, theta: Array, omega: Array) -> Array:
        found = np.empty_like(theta)
        solver = exudyn.MainSolverImplicitSecondOrder()
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            self._start_at(q, v)
            solver.InitializeSolver(self._mbs, self._settings)
            found[row] = self._mbs.systemData.GetODE2Coordinates_tt()
            solver.FinalizeSolver(self._mbs, self._settings)
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        forces = np.empty_like(theta)
        solver = exudyn.MainSolverImplicitSecondOrder()
        # Its mass matrix and forces do not depend on accelerations: rows that ask for column after column share them.
        last_q, last_v, mass, residual = (np.empty(0) for _ in range(4))
        with self._in_unit_of_time(1.0 if gravity else 0.0):
            for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
                if not (np.array_equal(q, last_q) and np.array_equal(v, last_v)):
                    self._start_at(q, v)
                    solver.InitializeSolver(self._mbs, self._at_rest)
                    if not np.array_equal(q, last_q):
                        solver.ComputeMassMatrix(self._mbs)
                        mass = solver.GetSystemMassMatrix()
                    solver.ComputeODE2RHS(self._mbs)
                    residual = solver.GetSystemResidual()
                    solver.FinalizeSolver(self._mbs, self._at_rest)
                    last_q, last_v = q, v
                forces[row] = mass @ a - residual
        return self._coordinates.absolute_forces(forces) * self._units.energy

    def energy(self, theta: Array, omega: Array) -> Array:
        # With all links level, to the one side and to the other, the heights of each mass above the support cancel.
        level = np.repeat([[np.pi / 2], [-np.pi / 2]], theta.shape[1], axis=1)
        energies = self._energies(theta, omega)
        energies[:, 1] -= self._energies(level, np.zeros_like(level))[:, 1].mean()
        return energies * self._units.energy

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        (angles,), (rates,) = self._run(theta, omega, integrator, step, steps, all_states=False)
        return angles, rates

    def path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        return self._run(theta, omega, integrator, step, steps, all_states=True)

    def adaptive(
        self, theta: Array, omega: Array, scheme: str, duration: float, tolerance: float
    ) -> tuple[Array, Array]:
        self._start_at(*(row[0] for row in map(self._coordinates.relative, (theta[None], omega[None]))))
        angles, rates = run_adaptive(self._mbs, _SOLVER, scheme, duration, tolerance)
        return self._coordinates.absolute(angles[None])[0], self._coordinates.absolute(rates[None])[0]

    def _run(
        self, theta: Array, omega: Array, integrator: str, step: float, steps: int, *, all_states: bool
    ) -> tuple[Array, Array]:
        units = self._units.fitting(self._gravity, omega, step)
        self._start_at(*(row[0] for row in map(self._coordinates.relative, (theta[None], units.time * omega[None]))))
        with self._in_unit_of_time(units.time):
            angles, rates = run(self._mbs, _SOLVER, integrator, step / units.time, steps, all_states=all_states)
        return self._coordinates.absolute(angles), units.in_seconds(self._coordinates.absolute(rates))

    def _energies(self, theta: Array, omega: Array) -> Array:
        data, outputs = self._mbs.systemData, exudyn.OutputVariableType
        energies = np.empty((len(theta), 2))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            data.SetODE2Coordinates(q, Current)
            data.SetODE2Coordinates_t(v, Current)
            energies[row] = [
                self._mbs.GetObjectOutputBody(self._tree, kind, [0.0, 0.0, 0.0], Current)
                for kind in (outputs.KineticEnergy, outputs.PotentialEnergy)
            ]
        return energies

    @contextmanager
    def _in_unit_of_time(self, unit: float) -> Iterator[None]:
        """With gravity scaled to this unit of time [s]; a unit of 0 s switches it off."""
        kept = self._mbs.GetObjectParameter(self._tree, "gravity")
        self._mbs.SetObjectParameter(self._tree, "gravity", [g * unit * unit for g in kept])
        try:
            yield
        finally:
            self._mbs.SetObjectParameter(self._tree, "gravity", kept)

    def _start_at(self, q: Array, v: Array) -> None:
        self._mbs.systemData.SetODE2Coordinates(q, Initial)
        self._mbs.systemData.SetODE2Coordinates_t(v, Initial)


def _point(along_across: tuple[float, float]) -> list[float]:
    along, across = along_across
    return [across, 0.0 - along, 0.0]


def _along_across(points: Any) -> Array:
    return np.array([(-y, x) for x, y, _ in _items(points)])


def _items(exudyn_list: Any) -> list[Any]:
    """The items of one of Exudyn's lists, which cannot be iterated over: past the end they raise the wrong error."""
    return [exudyn_list[i] for i in range(len(exudyn_list))]
