"""MuJoCo with an open mechanism that is given to it body by body (``MjSpec``), so that no reader of files takes part.

* A point mass or a thin rod has moments below 1e-15 kg m², which the compiler raises (``boundinertia``): those of
  tensors without products are set in the compiled model. That raising moves other tensors by no more than that.
* MuJoCo 3.3 turns other tensors to principal axes until no product exceeds 1e-7 of the largest moment; those that are
  left with more than rounding are turned here, and set in the compiled model.
* Accelerations are ``qacc_smooth``, what ``mj_forward`` finds before constraints, of which the model has none.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from ...models.spatial import unit
from ...models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism
from ...models.writers.mjcf import LEAST_INERTIA
from ..model_files.robot_coordinates import Block, RobotCoordinates
from ..model_files.robot_mujoco import BoundMujoco
from ..mujoco import INTEGRATORS, VERSION, compiled, empty_spec, keep_centres, quiet_data
from ..protocol import Array
from ..releases import has

# MuJoCo's bindings have no type stubs that fit: Any, here and nowhere else.
mujoco: Any = import_module("mujoco")

KINDS = {
    "hinge": mujoco.mjtJoint.mjJNT_HINGE,
    "slide": mujoco.mjtJoint.mjJNT_SLIDE,
    "ball": mujoco.mjtJoint.mjJNT_BALL,
    "free": mujoco.mjtJoint.mjJNT_FREE,
}
# A rotation, three moments and a rotation again, each rounded a few times; a compiler that stops early leaves 1e8.
ROUNDINGS = 64


class MujocoTree:
    """The mechanism in MuJoCo."""

    def __init__(self, mechanism: SpatialMechanism) -> None:
        mujoco.set_mju_user_warning(lambda message: None)  # else it writes MUJOCO_LOG.TXT
        self._model = _model(mechanism)
        joints = [self._model.joint(f"joint{k}").id for k in range(len(mechanism.joints))]
        at_q, at_v = self._model.jnt_qposadr[joints], self._model.jnt_dofadr[joints]
        blocks = [Block((k,), "same", int(at_q[k]), int(at_v[k])) for k in range(len(joints))]
        self._bound = BoundMujoco(self._model, RobotCoordinates(mechanism, blocks, mechanism.nq))
        self._data = quiet_data(self._model)
        self._columns_q = _columns(at_q, [placed.joint.coordinates for placed in mechanism.joints])
        self._columns_v = _columns(at_v, [placed.joint.freedoms for placed in mechanism.joints])
        self._links = [self._model.body(f"body{k}").id for k, body in enumerate(mechanism.bodies) if body.joints]
        ends = at_q + [placed.joint.coordinates for placed in mechanism.joints]
        turning = [placed.joint.kind in {"ball", "free"} for placed in mechanism.joints]
        self._quaternions = ends[turning] - 4

    @property
    def model(self) -> Any:
        """The compiled model."""
        return self._model

    @property
    def columns_v(self) -> Any:
        """The model's column of each of the mechanism's freedoms, (nv,)."""
        return self._columns_v

    def theirs(self, q: Array, v: Array) -> tuple[Array, Array]:
        """States (B, nq), (B, nv) in the model's columns."""
        rates = np.empty_like(v)
        rates[:, self._columns_v] = v
        return self.positions(q), rates

    def positions(self, q: Array) -> Array:
        """Coordinates (B, nq) in the model's columns, quaternions of length one."""
        positions = np.empty_like(q)
        positions[:, self._columns_q] = q
        for start in self._quaternions:
            positions[:, start : start + 4] = unit(positions[:, start : start + 4])
        return positions

    def ours(self, answers: Array) -> Array:
        """Answers (…, nv) in the mechanism's order."""
        return answers[..., self._columns_v]

    def accelerations(self, q: Array, v: Array) -> Array:
        return self._bound.accelerations(q, v, np.zeros_like(v))

    def mass_matrix(self, q: Array) -> Array:
        return self._bound.mass_matrix(q)

    def bias(self, q: Array, v: Array) -> Array:
        return self._bound.bias(q, v)

    def passive(self, q: Array, v: Array) -> Array:
        return self._bound.passive(q, v)

    def inverse_mass(self, q: Array) -> Array:
        return self._bound.inverse_mass(q)

    def joint_forces(self, q: Array, v: Array, a: Array) -> Array:
        model, data = self._model, self._data
        found = np.empty((len(q), len(self._links), 6))
        for row in range(len(q)):
            self._set(q[row], v[row])
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_fwdVelocity(model, data)
            data.qacc[self._columns_v] = a[row]
            mujoco.mj_rnePostConstraint(model, data)
            # Rows are torque about the tree's centre of mass, then force, in the world's axes, of parent on child.
            moment, force = -data.cfrc_int[self._links, :3], -data.cfrc_int[self._links, 3:]
            arm = data.subtree_com[model.body_rootid[self._links]] - data.xpos[self._links]
            found[row] = np.concatenate([force, moment + np.cross(arm, force)], axis=1)
        return found

    def energy(self, q: Array, v: Array) -> Array:
        found = np.empty((len(q), 2))
        for row in range(len(q)):
            self._set(q[row], v[row])
            mujoco.mj_fwdPosition(self._model, self._data)
            mujoco.mj_fwdVelocity(self._model, self._data)
            mujoco.mj_energyPos(self._model, self._data)
            mujoco.mj_energyVel(self._model, self._data)
            found[row] = self._data.energy[1], self._data.energy[0]
        return found

    def trajectory(self, q: Array, v: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        option = self._model.opt
        kept = option.integrator, option.timestep
        mujoco.mj_resetData(self._model, self._data)
        self._data.warning.number[:] = 1  # else a NaN is announced in a file
        self._set(q, v)
        option.integrator, option.timestep = INTEGRATORS[integrator], step
        try:
            mujoco.mj_step(self._model, self._data, nstep=steps)
        finally:
            option.integrator, option.timestep = kept
        return self._data.qpos[self._columns_q], self._data.qvel[self._columns_v]

    def _set(self, q: Array, v: Array) -> None:
        self._data.qpos[:], self._data.qvel[self._columns_v] = self.positions(q[None])[0], v


def _columns(starts: Array, sizes: list[int]) -> Any:
    """MuJoCo's column of each of the mechanism's, (nq,) or (nv,)."""
    return np.concatenate([np.arange(start, start + size) for start, size in zip(starts, sizes, strict=True)])


def _model(mechanism: SpatialMechanism) -> Any:
    spec = empty_spec(mechanism.gravity.tolist())
    bodies: list[Any] = []
    for k, body in enumerate(mechanism.bodies):
        parent = spec.worldbody if body.parent == WORLD else bodies[body.parent]
        bodies.append(_body(parent, body, k))
    for k, placed in enumerate(mechanism.joints):
        _joint(bodies[placed.body], placed.joint, f"joint{k}")
    model = compiled(spec)
    keep_centres(model)
    for k, body in enumerate(mechanism.bodies):
        moments = np.diag(body.inertial.tensor)
        if _diagonal(body) and (moments < LEAST_INERTIA).any() and body.inertial.mass:
            model.body_inertia[model.body(f"body{k}").id] = moments
        elif not _diagonal(body):
            _keep_tensor(model, model.body(f"body{k}").id, body.inertial.tensor)
    return model


def _keep_tensor(model: Any, number: int, tensor: Array) -> None:
    """Turn the tensor (3, 3) of one body to principal axes anew, where the compiler has left more than rounding."""
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[number])
    axes = turn.reshape(3, 3)
    held = axes @ np.diag(model.body_inertia[number]) @ axes.T
    if np.abs(held - tensor).max() <= ROUNDINGS * np.finfo(float).eps * np.abs(tensor).max():
        return
    moments, axes = np.linalg.eigh(tensor)
    axes[:, 0] *= np.sign(np.linalg.det(axes))  # a rotation, no reflection
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(axes).ravel())
    model.body_inertia[number], model.body_iquat[number] = moments, quaternion


def _body(parent: Any, body: RigidBody, k: int) -> Any:
    inertial, tensor = body.inertial, body.inertial.tensor
    moments = (
        {"inertia": np.diag(tensor).tolist()}
        if _diagonal(body)
        else {"fullinertia": tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]].tolist()}
    )
    return parent.add_body(
        name=f"body{k}",
        pos=body.position.tolist(),
        quat=body.quaternion.tolist(),
        mass=float(inertial.mass),
        ipos=inertial.centre.tolist(),
        explicitinertial=True,
        **moments,
    )


def _diagonal(body: RigidBody) -> bool:
    tensor = body.inertial.tensor
    return np.array_equal(tensor, np.diag(np.diag(tensor)))


def _joint(body: Any, joint: Joint, name: str) -> None:
    made = body.add_joint(name=name, type=KINDS[joint.kind], armature=joint.armature)
    if has("mujoco: a joint's damping is a polynomial", VERSION):
        made.damping[0], made.stiffness[0] = joint.damping, joint.stiffness
    else:
        made.damping, made.stiffness = joint.damping, joint.stiffness
    if joint.kind in ("hinge", "slide"):
        made.axis, made.ref, made.springref = joint.axis.tolist(), joint.ref, joint.springref
    if joint.kind != "free":
        made.pos = joint.anchor.tolist()
