"""Exudyn in maximal coordinates: a free body (x, y, angle) for each link, held together by revolute joints.

* Exudyn's plane is x-y with y up. Each body's origin is its centre of mass, its angle the absolute one.
* Joints are constraints; their forces are Lagrange multipliers, positive for the force on the parent.
* Accelerations are the initial accelerations that the implicit solver computes. For them it differentiates the velocity
  constraint numerically, one coordinate at a time, by a single forward difference: with the default step they are
  wrong by up to 1e-6. A revolute joint's velocity constraint is a·cos φ + b·sin φ + c in each body's angle φ, though,
  so that three forward differences, with steps of a quarter turn, three quarters and a whole one, give its derivative
  exactly: see :data:`STEPS`.
* Linear solver: Eigen's sparse LU; the dense ones cost a hundred times as much at a hundred links.
* The mechanism is scaled to units that fit it (:mod:`furiko.models.units`), and each state to a unit of time.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ..models import PlanarTree, System
from ..models.tree import SUPPORT
from ..models.units import in_units, units_of
from .exudyn_settings import Current, Initial, exudyn, items, quiet_settings, run
from .protocol import Array, ModelFields

_SOLVER = exudyn.LinearSolverType.EigenSparse

# For f(φ) = a cos φ + b sin φ + c let D(h) = (f(φ+h) - f(φ))/h. Then f'(φ) = (f(φ+π/2) - f(φ+3π/2))/2
# = π/4 D(π/2) - 3π/4 D(3π/2), and D(2π) = 0. What the solver returns is x₀ + K D(h); the weights below, whose sum is 1,
# make x₀ + K f' of three such answers.
STEPS = np.pi * np.array([0.5, 1.5, 2.0])
WEIGHTS = np.array([np.pi / 4, -3 * np.pi / 4, 1 + np.pi / 2])


class ExudynRedundant:
    """The mechanism as bodies and joints."""

    def __init__(self, system: System) -> None:
        self._units = units_of(system.tree())
        self._gravity = system.tree().gravity
        tree = in_units(system.tree(), self._units)
        self._links = _Links(tree)
        self._mbs = exudyn.SystemContainer().AddSystem()
        self._bodies: list[Any] = []
        self._loads: list[Any] = []
        self._joints: list[Any] = []
        self._build(tree)
        self._settings = quiet_settings(_SOLVER)

    def _build(self, tree: PlanarTree) -> None:
        mbs = self._mbs
        ground = mbs.AddObject(items.ObjectGround())
        for link in tree.links:
            node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0.0, 0.0, 0.0]))
            body = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=link.mass, inertia=link.inertia))
            load = items.LoadMassProportional(
                markerNumber=mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body)), loadVector=[0.0, -tree.gravity, 0.0]
            )
            parent, centre = (
                (ground, (0.0, 0.0))
                if link.parent == SUPPORT
                else (self._bodies[link.parent], tree.links[link.parent].com)
            )
            on_parent = items.MarkerBodyPosition(bodyNumber=parent, localPosition=_point(link.hinge, centre))
            on_body = items.MarkerBodyPosition(bodyNumber=body, localPosition=_point((0.0, 0.0), link.com))
            markers = [mbs.AddMarker(on_parent), mbs.AddMarker(on_body)]
            self._joints.append(mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers)))
            self._loads.append(mbs.AddLoad(load))
            self._bodies.append(body)
        mbs.Assemble()

    def fields(self) -> ModelFields:
        mbs = self._mbs
        bodies = [mbs.GetObject(body) for body in self._bodies]
        link_of_body = {int(body): link for link, body in enumerate(self._bodies)}
        centres = np.empty((len(bodies), 2))
        hinges = np.empty((len(bodies), 2))
        parents = []
        for row, joint in enumerate(self._joints):
            on_parent, on_body = (mbs.GetMarker(marker) for marker in mbs.GetObject(joint)["markerNumbers"])
            parent = link_of_body.get(int(on_parent["bodyNumber"]), SUPPORT)
            parents.append(parent)
            centres[row] = -_along_across(on_body["localPosition"])
            # Both are measured from a centre of mass; the parent's comes before its children's.
            hinges[row] = _along_across(on_parent["localPosition"]) + (centres[parent] if parent != SUPPORT else 0.0)
        size, units = mbs.systemData, self._units
        return ModelFields(
            dofs=size.ODE2Size() - size.AEsize(),
            parents=tuple(parents),
            hinges=hinges * units.length,
            centres=centres * units.length,
            masses=np.array([body["mass"] for body in bodies]) * units.mass,
            inertias=np.array([body["inertia"] for body in bodies]) * units.inertia,
            gravity=self._load_on_a_unit_of_mass() * units.acceleration,
            armature=np.zeros(len(bodies)),  # a revolute joint has neither
            damping=np.zeros(len(bodies)),
        )

    def _load_on_a_unit_of_mass(self) -> Array:
        """Gravity (3,), which must be the same for every body; else NaN."""
        loads = np.array([self._mbs.GetLoad(load)["loadVector"] for load in self._loads])
        x, y, z = loads[0] if (loads == loads[0]).all() else np.full(3, np.nan)
        return np.array([x, -z, y])

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return self._solve(theta, omega)[0][:, 2::3]

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        """The multipliers come with Exudyn's own accelerations: ``alpha`` is ignored."""
        return self._solve(theta, omega)[1]

    def energy(self, theta: Array, omega: Array) -> Array:
        """Kinetic: Exudyn's output for each body. Potential: it has none for loads; each load times its height."""
        mbs, outputs = self._mbs, exudyn.OutputVariableType
        mass = np.array([mbs.GetObjectParameter(body, "mass") for body in self._bodies])
        loads = np.array([mbs.GetLoad(load)["loadVector"] for load in self._loads])
        energies = np.empty((len(theta), 2))
        positions, rates = self._links.states(theta, omega)
        for row, (q, v) in enumerate(zip(positions, rates, strict=True)):
            mbs.systemData.SetODE2Coordinates(q, Current)
            mbs.systemData.SetODE2Coordinates_t(v, Current)
            kinetic, centre = (
                np.array([mbs.GetObjectOutputBody(body, kind, [0.0, 0.0, 0.0], Current) for body in self._bodies])
                for kind in (outputs.KineticEnergy, outputs.Position)
            )
            energies[row] = kinetic.sum(), -(mass * (loads * centre).sum(axis=1)).sum()
        return energies * self._units.energy

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        (angles,), (rates,) = self._run(theta, omega, integrator, step, steps, all_states=False)
        return angles, rates

    def path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        return self._run(theta, omega, integrator, step, steps, all_states=True)

    def gap(self) -> float:
        """Largest distance [m] between the two points that a joint holds together, at the end of the last run."""
        mbs, position = self._mbs, exudyn.OutputVariableType.Position
        ends = [
            [mbs.GetMarkerOutput(marker, position, Current) for marker in mbs.GetObject(joint)["markerNumbers"]]
            for joint in self._joints
        ]
        return float(np.linalg.norm(np.subtract(*np.swapaxes(ends, 0, 1)), axis=-1).max()) * self._units.length

    def _run(
        self, theta: Array, omega: Array, integrator: str, step: float, steps: int, *, all_states: bool
    ) -> tuple[Array, Array]:
        """Started from the accelerations of :meth:`_solve_one`: those that the solver would compute are off by 1e-6."""
        units = self._units.fitting(self._gravity, omega, step)
        data = self._mbs.systemData
        with self._in_unit_of_time(units.time):
            ((position,), (rate,)) = self._links.states(theta[None], units.time * omega[None])
            accelerations, _ = self._solve_one(position, rate)
            data.SetODE2Coordinates(position, Initial)
            data.SetODE2Coordinates_t(rate, Initial)
            coordinates, speeds = run(
                self._mbs,
                _SOLVER,
                integrator,
                step / units.time,
                steps,
                accelerations=accelerations,
                all_states=all_states,
            )
        return coordinates[:, 2::3], units.in_seconds(speeds[:, 2::3])

    def _solve(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """Accelerations of all coordinates (B, 3n) and the joints' multipliers (B, n, 2)."""
        accelerations = np.zeros((len(theta), 3 * theta.shape[1]))
        forces = np.zeros((*theta.shape, 2))
        fitting = [self._units.fitting(self._gravity, rates) for rates in omega]
        seconds = np.array([units.time for units in fitting])
        positions, rates = self._links.states(theta, omega * seconds[:, None])
        for units in set(fitting):  # together, because loads are set one by one
            with self._in_unit_of_time(units.time):
                for row in np.flatnonzero(seconds == units.time):
                    found, multipliers = self._solve_one(positions[row], rates[row])
                    accelerations[row] = units.in_seconds(found, power=2)
                    forces[row] = multipliers * units.force
        return accelerations, forces

    def _solve_one(self, position: Array, rate: Array) -> tuple[Array, Array]:
        """Accelerations (3n,) and multipliers (n, 2) in the unit of time that the loads are in."""
        mbs, data, settings = self._mbs, self._mbs.systemData, self._settings
        differencing = settings.timeIntegration.newton.numericalDifferentiation
        solver = exudyn.MainSolverImplicitSecondOrder()
        accelerations, forces = np.zeros(len(position)), np.zeros((len(position) // 3, 2))
        data.SetODE2Coordinates(position, Initial)
        data.SetODE2Coordinates_t(rate, Initial)
        # A step is relativeEpsilon times the coordinate, or times minimumCoordinateSize where that is more.
        size = differencing.minimumCoordinateSize = max(float(np.abs(position[2::3]).max(initial=0.0)), 1.0)
        for weight, step in zip(WEIGHTS, STEPS, strict=True):
            differencing.relativeEpsilon = step / size
            solver.InitializeSolver(mbs, settings)
            accelerations += weight * data.GetODE2Coordinates_tt()
            forces += weight * data.GetAECoordinates().reshape(-1, 2)
            solver.FinalizeSolver(mbs, settings)
        return accelerations, forces

    @contextmanager
    def _in_unit_of_time(self, unit: float) -> Iterator[None]:
        """With the loads scaled to this unit of time [s]."""
        mbs = self._mbs
        kept = [mbs.GetLoad(load)["loadVector"] for load in self._loads] if self._gravity and unit != 1 else []
        for load, vector in zip(self._loads, kept, strict=False):
            mbs.SetLoadParameter(load, "loadVector", [g * unit * unit for g in vector])
        try:
            yield
        finally:
            for load, vector in zip(self._loads, kept, strict=False):
                mbs.SetLoadParameter(load, "loadVector", vector)


class _Links:
    """Positions and velocities of the bodies for given angles and rates, which satisfy the joints' constraints."""

    def __init__(self, tree: PlanarTree) -> None:
        self._parents = tree.parents
        self._hinges = np.array([link.hinge for link in tree.links])
        self._centres = np.array([link.com for link in tree.links])

    def states(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """Coordinates (x, y, angle) of each body's centre of mass and their rates, each of shape (B, 3n)."""
        # Complex numbers x + iy: a link's (along, across) is along·(-i) + across, turned by its angle.
        turn = np.exp(1j * theta)
        hinge, hinge_rate = np.zeros_like(turn), np.zeros_like(turn)
        for link, parent in enumerate(self._parents):
            if parent != SUPPORT:
                arm = turn[:, parent] * _complex(self._hinges[link])
                hinge[:, link] = hinge[:, parent] + arm
                hinge_rate[:, link] = hinge_rate[:, parent] + 1j * omega[:, parent] * arm
        arm = turn * _complex(self._centres.T)
        centre, rate = hinge + arm, hinge_rate + 1j * omega * arm
        position = np.stack([centre.real, centre.imag, theta], axis=-1)
        velocity = np.stack([rate.real, rate.imag, omega], axis=-1)
        flat = (len(theta), 3 * theta.shape[1])
        return position.reshape(flat), velocity.reshape(flat)


def _complex(along_across: Array) -> Any:
    along, across = along_across
    return across - 1j * along


def _point(along_across: tuple[float, float], origin: tuple[float, float]) -> list[float]:
    return [along_across[1] - origin[1], origin[0] - along_across[0], 0.0]


def _along_across(point: Array) -> Array:
    return np.array([-point[1], point[0]])
