"""A user's MJCF or URDF in Pinocchio, read by Pinocchio itself, solved by the articulated-body algorithm.

* Its MJCF reader ignores ``<option gravity>`` and URDF has none: gravity is set in the model.
* A hinge without limits in URDF (``continuous``) has two coordinates there, its angle's cosine and sine.
* The model has damping and friction, but no algorithm of forward dynamics applies them: the caller must.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ...models.mechanism import Mechanism
from ...models.projection import planar_mechanism
from ...models.readers.model_file import ModelFile
from ...models.spatial import Inertial, from_axis_angle, to_quaternion
from ...models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from ..protocol import Array
from .adapter import FileCoordinates, in_order

# Pinocchio is a C++ extension without types: Any, here and nowhere else.
pinocchio: Any = import_module("pinocchio")


class PinocchioFile:
    """The file in Pinocchio."""

    def __init__(self, model: ModelFile) -> None:
        self._file = model
        _refuse(model)
        self._model = _read(model)
        self._model.gravity.linear = np.array(model.mechanism.gravity_vector)
        names = list(self._model.names)
        known = [hinge.name for hinge in model.mechanism.hinges]
        missing = [name for name in known if name not in names]
        if missing or self._model.nv != len(known):
            raise ValueError(
                f"Pinocchio compiled {self._model.nv} degrees of freedom, the file has {len(known)}"
                + (f"; without joint {missing[0]!r}" if missing else "")
            )
        self._joints = [self._model.getJointId(name) for name in known]
        for j, link in zip(self._joints, model.mechanism.links, strict=True):
            if link.mass and link.inertia == 0:  # raised by boundinertia, which its MJCF reader applies
                held = self._model.inertias[j]
                self._model.inertias[j] = pinocchio.Inertia(held.mass, held.lever, np.zeros((3, 3)))
        self._data = self._model.createData()
        self._coordinates = FileCoordinates(model.mechanism, [self._model.idx_vs[j] for j in self._joints])
        # For each column of rates: the index of its coordinate, and whether that is an angle or its cosine and sine.
        by_column = sorted(self._joints, key=lambda j: int(self._model.idx_vs[j]))
        self._places = [(int(self._model.idx_qs[j]), int(self._model.nqs[j]) == 2) for j in by_column]

    def compiled(self) -> Mechanism:
        model, bodies = self._model, []
        zeros = {hinge.name: hinge.zero for hinge in self._file.mechanism.hinges}
        for j in range(1, model.njoints):
            name, column = model.names[j], int(model.idx_vs[j])
            axis = np.asarray(self._data.joints[j].S, dtype=np.float64).ravel()[3:]
            zero = zeros.get(name, 0.0)
            placement = model.jointPlacements[j]
            turn = to_quaternion(placement.rotation @ from_axis_angle(axis, zero))
            inertia = model.inertias[j]
            hinge = Joint(
                name=name,
                axis=axis,
                ref=zero,
                springref=zero,
                armature=float(model.armature[column]),
                damping=float(model.damping[column]),
                friction=float(model.friction[column]),
            )
            inertial = Inertial(float(inertia.mass), inertia.lever.copy(), inertia.inertia.copy())
            place = placement.translation.copy(), turn
            body = _link_of(self._file, name)
            bodies.append(RigidBody(body, int(model.parents[j]) - 1, *place, (hinge,), inertial))
        gravity = model.gravity.linear.copy()
        return in_order(
            planar_mechanism(SpatialMechanism(tuple(bodies), gravity), self._file.plane), self._file.mechanism
        )

    def notes(self) -> tuple[str, ...]:
        said = (
            ["Pinocchio's reader ignores the file's gravity: it was set in the model"]
            if self._file.language == "mjcf"
            else []
        )
        two = [name for name, (_, pair) in zip(self._model.names[1:], self._places, strict=False) if pair]
        if two:
            said.append(
                f"{len(two)} continuous joint{'s' * (len(two) > 1)} with two coordinates (cos, sin) each: nq ≠ nv"
            )
        return tuple(said)

    def settings(self) -> Mapping[str, Any]:
        return {"nq": int(self._model.nq), "nv": int(self._model.nv)}

    def integrator(self) -> None:
        return None

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        torques = np.zeros(self._model.nv)
        found = np.empty_like(theta)
        rates = self._coordinates.rates(omega)
        for row, (q, v) in enumerate(zip(self._positions(theta), rates, strict=True)):
            found[row] = pinocchio.aba(self._model, self._data, q, v, torques)
        return self._coordinates.absolute(found)

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        where = self._positions(theta), self._coordinates.rates(omega), self._coordinates.rates(alpha)
        rows = [pinocchio.rnea(self._model, self._data, q, v, a) for q, v, a in zip(*where, strict=True)]
        return self._coordinates.absolute_forces(np.array(rows).reshape(theta.shape))

    def _positions(self, theta: Array) -> Array:
        angles = self._coordinates.positions(theta)
        positions = np.empty((len(theta), self._model.nq))
        for column, (place, pair) in enumerate(self._places):
            if pair:
                positions[:, place], positions[:, place + 1] = np.cos(angles[:, column]), np.sin(angles[:, column])
            else:
                positions[:, place] = angles[:, column]
        return positions


def _refuse(file: ModelFile) -> None:
    """Refuse what its MJCF reader is known to drop silently."""
    if file.language != "mjcf":
        return
    if sum(body.parent < 0 for body in file.spatial.bodies) > 1:
        raise ValueError("of several bodies in the world Pinocchio's MJCF reader takes only the first")
    several = next((body for body in file.spatial.bodies if len(body.joints) > 1), None)
    if several is not None:
        raise ValueError(
            f"body {several.name!r} has {len(several.joints)} hinges, which Pinocchio joins into one joint"
        )


def _read(file: ModelFile) -> Any:
    if file.language == "urdf":
        return pinocchio.buildModelFromXML(file.text)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model.xml")
        path.write_text(file.text, encoding="utf-8")
        return pinocchio.buildModelFromMJCF(str(path))


def _link_of(file: ModelFile, hinge: str) -> str:
    names = [h.name for h in file.mechanism.hinges]
    return file.mechanism.link_names[names.index(hinge)] if hinge in names else hinge
