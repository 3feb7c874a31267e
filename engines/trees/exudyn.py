"""Exudyn with an open mechanism of hinges and slides: one ``ObjectKinematicTree``, in minimal coordinates.

* Each joint has a link of its own, all but a body's last without mass; its axis is the link's z axis.
* It has no ``ref``: angles and lengths are counted from there before they are handed on.
* Dampers and springs are its PD control of a joint towards a position, P (position − q) − D q̇.
* Accelerations are the initial accelerations that the implicit solver computes when it is initialised; it gives its
  mass matrix and right-hand side only after ``computeInitialAccelerations`` is switched off.
* Its potential energy is that of gravity, counted from all coordinates zero: the springs' ½ k × stretch² is added.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...models.spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose, from_z_axis
from ...models.spatial_mechanism import WORLD, Joint, SpatialMechanism
from ..exudyn_settings import Current, Initial, exudyn, items, quiet_settings, run
from ..protocol import Array

_SOLVER = exudyn.LinearSolverType.EigenDense
TYPES = {"hinge": exudyn.JointType.RevoluteZ, "slide": exudyn.JointType.PrismaticZ}


class ExudynMechanism:
    """The mechanism as one kinematic tree."""

    def __init__(self, mechanism: SpatialMechanism) -> None:
        joints = [placed.joint for placed in mechanism.joints]
        self._ref = np.array([joint.ref for joint in joints])
        self._rest = np.array([joint.springref for joint in joints]) - self._ref
        self._stiffness = np.array([joint.stiffness for joint in joints])
        damping = np.array([joint.damping for joint in joints])
        control = {
            "jointPControlVector": self._stiffness.tolist(),
            "jointDControlVector": damping.tolist(),
            "jointPositionOffsetVector": self._rest.tolist(),
            "jointVelocityOffsetVector": [0.0] * len(joints),
        }
        self._ideal, self._whole = _system(mechanism, {}), _system(mechanism, control)
        self._settings = quiet_settings(_SOLVER)
        self._at_rest = quiet_settings(_SOLVER)
        self._at_rest.timeIntegration.generalizedAlpha.computeInitialAccelerations = False

    def accelerations(self, q: Array, v: Array) -> Array:
        return self.driven(q, v, np.zeros_like(v))

    def driven(self, q: Array, v: Array, torque: Array) -> Array:
        """Accelerations (B, nv) under forces of the joints [N m or N], (B, nv)."""
        system, tree = self._whole
        solver = exudyn.MainSolverImplicitSecondOrder()
        found = np.empty_like(v)
        for row in range(len(q)):
            system.SetObjectParameter(tree, "jointForceVector", torque[row].tolist())
            _start_at(system, q[row] - self._ref, v[row])
            solver.InitializeSolver(system, self._settings)
            found[row] = system.systemData.GetODE2Coordinates_tt()
            solver.FinalizeSolver(system, self._settings)
        return found

    def mass_matrix(self, q: Array) -> Array:
        return np.array([mass for mass, _ in self._terms(q, np.zeros_like(q))])

    def bias(self, q: Array, v: Array) -> Array:
        return -np.array([forces for _, forces in self._terms(q, v)])

    def energy(self, q: Array, v: Array) -> Array:
        system, tree = self._ideal
        outputs = exudyn.OutputVariableType
        found = np.empty((len(q), 2))
        for row in range(len(q)):
            system.systemData.SetODE2Coordinates(q[row] - self._ref, Current)
            system.systemData.SetODE2Coordinates_t(v[row], Current)
            found[row] = [
                system.GetObjectOutputBody(tree, kind, [0.0, 0.0, 0.0], Current)
                for kind in (outputs.KineticEnergy, outputs.PotentialEnergy)
            ]
        found[:, 1] += (self._stiffness * (q - self._ref - self._rest) ** 2).sum(axis=-1) / 2
        return found

    def trajectory(self, q: Array, v: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        system, _ = self._whole
        _start_at(system, q - self._ref, v)
        (positions,), (rates,) = run(system, _SOLVER, integrator, step, steps, all_states=False)
        return positions + self._ref, rates

    def _terms(self, q: Array, v: Array) -> Iterator[tuple[Array, Array]]:
        """Mass matrix and right-hand side, without dampers and springs, in each state."""
        system, _ = self._ideal
        solver = exudyn.MainSolverImplicitSecondOrder()
        for row in range(len(q)):
            _start_at(system, q[row] - self._ref, v[row])
            solver.InitializeSolver(system, self._at_rest)
            solver.ComputeMassMatrix(system)
            solver.ComputeODE2RHS(system)
            yield np.array(solver.GetSystemMassMatrix()), np.array(solver.GetSystemResidual())
            solver.FinalizeSolver(system, self._at_rest)


def _system(mechanism: SpatialMechanism, control: dict[str, Any]) -> tuple[Any, int]:
    """The assembled system, and the number of its tree."""
    parents, placements, inertials = _links(mechanism)
    n = len(parents)
    system = exudyn.SystemContainer().AddSystem()
    zeros = [0.0] * n
    node = system.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=zeros,
            initialCoordinates=zeros,
            initialCoordinates_t=zeros,
            numberOfODE2Coordinates=n,
        )
    )
    tree = system.AddObject(
        items.ObjectKinematicTree(
            nodeNumber=node,
            gravity=mechanism.gravity.tolist(),
            baseOffset=[0.0, 0.0, 0.0],
            jointTypes=[TYPES[placed.joint.kind] for placed in mechanism.joints],
            linkParents=parents,
            jointTransformations=exudyn.Matrix3DList([pose.rotation for pose in placements]),
            jointOffsets=exudyn.Vector3DList([pose.translation.tolist() for pose in placements]),
            linkInertiasCOM=exudyn.Matrix3DList([inertial.tensor for inertial in inertials]),
            linkCOMs=exudyn.Vector3DList([inertial.centre.tolist() for inertial in inertials]),
            linkMasses=[float(inertial.mass) for inertial in inertials],
            **control,
        )
    )
    system.Assemble()
    return system, tree


def _links(mechanism: SpatialMechanism) -> tuple[list[int], list[Pose], list[Inertial]]:
    """A link for each joint: its parent, where the joint is in that one's frame, and all that is fixed to it."""
    parents: list[int] = []
    placements: list[Pose] = []
    inertials: list[Inertial] = []
    held: dict[int, tuple[int, Pose]] = {WORLD: (-1, IDENTITY)}  # of each body: its link, and its pose there
    for b, body in enumerate(mechanism.bodies):
        link, pose = held[body.parent]
        pose = pose @ body.pose
        for joint in body.joints:
            at = _joint_frame(joint)
            parents.append(link)
            placements.append(pose @ at)
            inertials.append(ZERO_INERTIAL)
            link, pose = len(parents) - 1, Pose(at.rotation.T, -at.rotation.T @ at.translation)
        held[b] = link, pose
        if link >= 0:
            inertials[link] = inertials[link] + body.inertial.transformed(pose)
    return parents, placements, inertials


def _joint_frame(joint: Joint) -> Pose:
    """A frame on the anchor with the joint's axis as its z axis, in the body's frame."""
    return Pose(from_z_axis(joint.axis), joint.anchor)


def _start_at(system: Any, q: Array, v: Array) -> None:
    system.systemData.SetODE2Coordinates(q, Initial)
    system.systemData.SetODE2Coordinates_t(v, Initial)
