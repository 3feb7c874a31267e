"""A user's MJCF or URDF in MuJoCo, read by MuJoCo itself.

The compiler refuses a moving body without inertia; where it does, it is made to raise the inertia (``boundinertia``),
and the file's own number is set in the compiled model, whose equations need no more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import numpy as np

from ...models.mechanism import Mechanism
from ...models.projection import planar_mechanism
from ...models.readers.model_file import ModelFile
from ...models.spatial import Inertial, Pose, from_quaternion
from ...models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from ..info import Integrator
from ..mujoco import quiet_data
from ..protocol import Array
from .adapter import FileCoordinates, in_order

# MuJoCo's bindings have no type stubs that fit: Any, here and nowhere else.
mujoco: Any = import_module("mujoco")

LEAST_INERTIA = {"mjcf": 1e-15, "urdf": 1e-14}  # the smallest that its two readers accept [kg m²]
ORDERS = {"EULER": 1, "RK4": 4, "IMPLICIT": 1, "IMPLICITFAST": 1}  # as its documentation gives them
REFUSED = ("mjMINVAL", "positive eigenvalues")
SWITCHES = {
    "contact": mujoco.mjtDisableBit.mjDSBL_CONTACT,
    "limit": mujoco.mjtDisableBit.mjDSBL_LIMIT,
    "frictionloss": mujoco.mjtDisableBit.mjDSBL_FRICTIONLOSS,
    "spring": mujoco.mjtDisableBit.mjDSBL_SPRING,
    "damper": mujoco.mjtDisableBit.mjDSBL_DAMPER,
    "gravity": mujoco.mjtDisableBit.mjDSBL_GRAVITY,
}


class MujocoFile:
    """The file in MuJoCo."""

    def __init__(self, model: ModelFile) -> None:
        # Otherwise MuJoCo writes a file MUJOCO_LOG.TXT into the current folder where a model is nearly singular.
        mujoco.set_mju_user_warning(lambda message: None)
        self._file = model
        self._notes: list[str] = []
        self._model = self._compile(model)
        hinges = model.mechanism.hinges
        if self._model.nv != len(hinges):
            raise ValueError(f"MuJoCo compiled {self._model.nv} degrees of freedom, the file has {len(hinges)}")
        columns = [int(self._model.joint(hinge.name).dofadr[0]) for hinge in hinges]
        if model.language == "urdf":  # which has no gravity
            self._model.opt.gravity[:] = model.mechanism.gravity_vector
        self._data = quiet_data(self._model)
        self._coordinates = FileCoordinates(model.mechanism, columns)

    def _compile(self, file: ModelFile) -> Any:
        try:
            compiled = mujoco.MjModel.from_xml_string(file.text)
        except ValueError as error:
            if not any(words in str(error) for words in REFUSED):
                raise
            compiled = self._with_least_inertia(file)
        for body in file.spatial.bodies:
            found = mujoco.mj_name2id(compiled, mujoco.mjtObj.mjOBJ_BODY, body.name)
            if found > 0 and not body.inertial.tensor.any():
                compiled.body_inertia[found] = 0.0
        return compiled

    def _with_least_inertia(self, file: ModelFile) -> Any:
        least = LEAST_INERTIA[file.language]
        bound = f'<compiler boundinertia="{least!r}"/>'
        if file.language == "urdf":
            bound = f"<mujoco>{bound}</mujoco>"
        start = file.text.index(">") + 1
        compiled = mujoco.MjModel.from_xml_string(file.text[:start] + bound + file.text[start:])
        self._notes.append(
            f"MuJoCo refuses a moving body without inertia: compiled with {least:g} kg m², which was set back to zero"
        )
        return compiled

    def compiled(self) -> Mechanism:
        model, bodies = self._model, []
        names = {hinge.name: hinge for hinge in self._file.mechanism.hinges}
        for b in range(1, model.nbody):
            first = int(model.body_jntadr[b])
            hinges = tuple(self._hinge(j, names) for j in range(first, first + int(model.body_jntnum[b])))
            place = model.body_pos[b].copy(), model.body_quat[b].copy()
            turned = Pose(from_quaternion(model.body_iquat[b]), model.body_ipos[b].copy())
            unturned = Inertial(float(model.body_mass[b]), np.zeros(3), np.diag(model.body_inertia[b]))
            name = model.body(b).name
            inertial = unturned.transformed(turned)
            bodies.append(RigidBody(name, int(model.body_parentid[b]) - 1, *place, hinges, inertial))
        off = model.opt.disableflags & int(SWITCHES["gravity"])
        gravity = np.zeros(3) if off else model.opt.gravity.copy()
        return in_order(
            planar_mechanism(SpatialMechanism(tuple(bodies), gravity), self._file.plane), self._file.mechanism
        )

    def _hinge(self, joint: int, names: Mapping[str, Any]) -> Joint:
        model = self._model
        dof, position = int(model.jnt_dofadr[joint]), int(model.jnt_qposadr[joint])
        name = model.joint(joint).name
        off = model.opt.disableflags
        no_constraint = bool(off & int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT))
        limited = bool(model.jnt_limited[joint]) and not no_constraint and not off & int(SWITCHES["limit"])
        low, high = map(float, model.jnt_range[joint])
        frictionless = no_constraint or bool(off & int(SWITCHES["frictionloss"]))
        return Joint(
            name=name,
            axis=model.jnt_axis[joint].copy(),
            anchor=model.jnt_pos[joint].copy(),
            ref=float(model.qpos0[position]),
            armature=float(model.dof_armature[dof]),
            damping=0.0 if off & int(SWITCHES["damper"]) else _linear(model.dof_damping[dof]),
            friction=0.0 if frictionless else float(model.dof_frictionloss[dof]),
            stiffness=0.0 if off & int(SWITCHES["spring"]) else _linear(model.jnt_stiffness[joint]),
            springref=float(model.qpos_spring[position]),
            limits=(low, high) if limited else None,
        )

    def notes(self) -> tuple[str, ...]:
        return tuple(self._notes)

    def settings(self) -> Mapping[str, Any]:
        option = self._model.opt
        return {
            "integrator": self._integrator_name(),
            "timestep": float(option.timestep),
            "geoms that may collide": int(((self._model.geom_contype | self._model.geom_conaffinity) != 0).sum()),
        }

    def contacts(self, theta: Array) -> list[tuple[int, str]]:
        """Rows of ``theta`` (B, n) in which geoms touch, with the pair's names."""
        model, data, found = self._model, self._data, []
        for row, q in enumerate(self._coordinates.positions(theta)):
            data.qpos[:], data.qvel[:] = q, 0.0
            mujoco.mj_forward(model, data)
            if data.ncon:
                found.append((row, " and ".join(self._geom(g) for g in data.contact[0].geom)))
        return found

    def _geom(self, geom: int) -> str:
        found = self._model.geom(geom)
        return repr(found.name) if found.name else f"one of body {self._model.body(int(found.bodyid[0])).name!r}"

    def accelerations(self, theta: Array, omega: Array, without: frozenset[str] = frozenset()) -> Array:
        model, data = self._model, self._data
        found = np.empty_like(theta)
        positions, rates = self._coordinates.positions(theta), self._coordinates.rates(omega)
        with _switched_off(model, without):
            for row, (q, v) in enumerate(zip(positions, rates, strict=True)):
                data.qpos[:], data.qvel[:] = q, v
                data.qacc_warmstart[:] = 0.0
                mujoco.mj_forward(model, data)
                found[row] = data.qacc
        return self._coordinates.absolute(found)

    def inverse_dynamics(
        self, theta: Array, omega: Array, alpha: Array, without: frozenset[str] = frozenset()
    ) -> Array:
        model, data = self._model, self._data
        forces = np.empty_like(theta)
        where = self._coordinates.positions(theta), self._coordinates.rates(omega), self._coordinates.rates(alpha)
        with _switched_off(model, without):
            for row, (q, v, a) in enumerate(zip(*where, strict=True)):
                data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
                mujoco.mj_inverse(model, data)
                forces[row] = data.qfrc_inverse
        return self._coordinates.absolute_forces(forces)

    def integrator(self) -> Integrator | None:
        name = self._integrator_name()
        return Integrator(name, ORDERS[name]) if name in ORDERS else None

    def trajectory(
        self,
        theta: Array,
        omega: Array,
        integrator: str,
        step: float,
        steps: int,
        without: frozenset[str] = frozenset(),
    ) -> tuple[Array, Array]:
        model, option = self._model, self._model.opt
        kept = option.timestep
        data = quiet_data(model)
        data.qpos[:], data.qvel[:] = (
            self._coordinates.positions(theta[None])[0],
            self._coordinates.rates(omega[None])[0],
        )
        with _switched_off(model, without):
            option.timestep = step
            try:
                mujoco.mj_step(model, data, nstep=steps)
            finally:
                option.timestep = kept
        return self._coordinates.angles(data.qpos[None])[0], self._coordinates.absolute(data.qvel[None])[0]

    def _integrator_name(self) -> str:
        return str(mujoco.mjtIntegrator(self._model.opt.integrator).name).removeprefix("mjINT_")


@contextmanager
def _switched_off(model: Any, features: frozenset[str]) -> Iterator[None]:
    kept = model.opt.disableflags
    for feature in features:
        model.opt.disableflags |= int(SWITCHES[feature])
    try:
        yield
    finally:
        model.opt.disableflags = kept


def _linear(coefficients: Any) -> float:
    return float(np.asarray(coefficients, dtype=np.float64).ravel()[0])
