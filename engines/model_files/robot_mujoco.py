"""MuJoCo's own reading of a user's MJCF or URDF, any open mechanism, and its dynamics without what is not compared.

What is switched off after the file is compiled, so that ``mj_forward`` leaves in ``qacc_smooth`` gravity, inertia,
springs, dampers and the applied torque alone:

* contacts, limits, dry friction and equality constraints (mimic joints of a URDF too): ``mjDSBL_CONSTRAINT``;
* actuators: ``mjDSBL_ACTUATION``, and their armature and damping set to 0, which the flag leaves;
* tendons: stiffness, damping and armature set to 0;
* fluid: density and viscosity 0; gravity compensation: ``body_gravcomp`` 0;
* what the enable flags turn on (sleeping bodies, inverse dynamics of discrete time …), and integrators that change the
  accelerations: Euler instead, which touches them in ``mj_step`` only.

The file's own flags for gravity, springs and dampers stay. Flexible bodies are refused. None of MuJoCo's
own plugins exerts passive forces.
"""

from __future__ import annotations

import copy
import posixpath
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from ...models.readers.bounded_file import read_bytes
from ...models.readers.folders import in_own_package
from ...models.readers.meshes import LARGEST_MESH
from ...models.readers.named_folders import NamedFolders
from ...models.spatial import Inertial, from_quaternion
from ...models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from ..mujoco import SAME_FRAME, VERSION, quiet_data
from ..protocol import Array
from ..quiet import silenced
from ..releases import has
from .robot_coordinates import Block, EngineState, RobotCoordinates
from .robot_joints import HeldJoint, match, named_alike, unique
from .robot_meshes import names_packages

# MuJoCo's bindings have no type stubs that fit: Any, here and nowhere else.
mujoco: Any = import_module("mujoco")

KINDS = {
    int(mujoco.mjtJoint.mjJNT_FREE): "free",
    int(mujoco.mjtJoint.mjJNT_BALL): "ball",
    int(mujoco.mjtJoint.mjJNT_SLIDE): "slide",
    int(mujoco.mjtJoint.mjJNT_HINGE): "hinge",
}
if has("mujoco: springs and dampers are switched off one by one", VERSION):
    SPRINGS_OFF, DAMPERS_OFF = int(mujoco.mjtDisableBit.mjDSBL_SPRING), int(mujoco.mjtDisableBit.mjDSBL_DAMPER)
else:
    SPRINGS_OFF = DAMPERS_OFF = int(mujoco.mjtDisableBit.mjDSBL_PASSIVE)
# Arrays of the compiled model that act in forward dynamics beside joints, bodies and gravity.
SET_TO_ZERO = (
    "actuator_armature",
    "actuator_damping",
    "actuator_dampingpoly",
    "tendon_stiffness",
    "tendon_stiffnesspoly",
    "tendon_damping",
    "tendon_dampingpoly",
    "tendon_armature",
    "body_gravcomp",
)
NAMES_READ = (".xml", ".urdf")


class MujocoRobot:
    """The file in MuJoCo; ``as_written``: its ``MjModel`` with all that it has, which takes long to compile."""

    def __init__(self, path: Path, language: str, folders: Sequence[Path] = ()) -> None:
        # Otherwise MuJoCo writes a file MUJOCO_LOG.TXT into the current folder where a model is nearly singular.
        mujoco.set_mju_user_warning(lambda message: None)
        with silenced():
            self.as_written = _loaded(path, folders)
        self._model = copy.copy(self.as_written)
        if self._model.nflex:
            raise ValueError("the file has flexible bodies, whose forces MuJoCo cannot leave out")
        _switch_off(self._model)

    def compiled(self, like: SpatialMechanism | None = None) -> SpatialMechanism:
        model = self._model
        names = iter(self.joints())
        bodies: list[RigidBody] = []
        for b in range(1, model.nbody):
            first = int(model.body_jntadr[b])
            joints = tuple(self._joint(j, next(names)) for j in range(first, first + int(model.body_jntnum[b])))
            bodies.append(
                RigidBody(
                    name=model.body(b).name,
                    parent=int(model.body_parentid[b]) - 1,
                    position=model.body_pos[b].copy(),
                    quaternion=model.body_quat[b].copy(),
                    joints=joints,
                    inertial=_inertial(model, b),
                )
            )
        if like is not None:
            bodies = named_alike(bodies, self._held(), like)
        off = model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
        return SpatialMechanism(tuple(bodies), np.zeros(3) if off else model.opt.gravity.copy())

    def _joint(self, j: int, name: str) -> Joint:
        model, kind = self._model, KINDS[int(self._model.jnt_type[j])]
        dof, position = int(model.jnt_dofadr[j]), int(model.jnt_qposadr[j])
        single = kind in {"hinge", "slide"}
        off = model.opt.disableflags
        low, high = (float(end) for end in model.jnt_range[j])
        return Joint(
            name=name,
            kind=kind,
            axis=model.jnt_axis[j].copy(),
            anchor=model.jnt_pos[j].copy() if kind != "free" else np.zeros(3),
            ref=float(model.qpos0[position]) if single else 0.0,
            armature=float(model.dof_armature[dof]),
            damping=0.0 if off & DAMPERS_OFF else float(model.dof_damping[dof]),
            friction=float(model.dof_frictionloss[dof]),
            stiffness=0.0 if off & SPRINGS_OFF else float(model.jnt_stiffness[j]),
            springref=float(model.qpos_spring[position]) if single else 0.0,
            limits=(low, high) if model.jnt_limited[j] else None,
        )

    def joints(self) -> tuple[str, ...]:
        names = (self._model.joint(j).name for j in range(self._model.njnt))
        return tuple(unique(name or f"unnamed joint {j + 1}" for j, name in enumerate(names)))

    def _held(self) -> list[HeldJoint]:
        model, shown = self._model, self.joints()
        return [
            HeldJoint(
                name=model.joint(j).name,
                kind=KINDS[int(model.jnt_type[j])],
                body=model.body(int(model.jnt_bodyid[j])).name,
                shown=shown[j],
            )
            for j in range(model.njnt)
        ]

    def bind(self, mechanism: SpatialMechanism) -> BoundMujoco:
        model = self._model
        blocks = [
            Block((i,), "same", int(model.jnt_qposadr[j]), int(model.jnt_dofadr[j]))
            for i, j in enumerate(match(mechanism, self._held(), "MuJoCo"))
        ]
        return BoundMujoco(model, RobotCoordinates(mechanism, blocks, int(model.nq)))


class BoundMujoco:
    """MuJoCo's model, asked in a mechanism's coordinates."""

    def __init__(self, model: Any, coordinates: RobotCoordinates) -> None:
        self._model, self._coordinates = model, coordinates
        self._data = quiet_data(model)

    def mass_matrix(self, q: Array) -> Array:
        found = np.empty((len(q), self._model.nv, self._model.nv))
        matrix = np.empty(found.shape[1:])
        for row, state in enumerate(self._states(q, np.zeros((len(q), self._model.nv)))):
            mujoco.mj_fwdPosition(self._model, self._data)
            if has("mujoco: mj_fullM takes MjData", VERSION):
                mujoco.mj_fullM(self._model, self._data, matrix)
            else:
                mujoco.mj_fullM(self._model, matrix, self._data.qM)
            found[row] = state.our_matrix(matrix)
        return found

    def inverse_mass(self, q: Array) -> Array:
        """M⁻¹, (B, nv, nv), by the factors of M that the engine has."""
        found, units = np.empty((len(q), self._model.nv, self._model.nv)), np.eye(self._model.nv)
        columns = np.empty_like(units)
        for row, state in enumerate(self._states(q, np.zeros((len(q), self._model.nv)))):
            mujoco.mj_fwdPosition(self._model, self._data)
            mujoco.mj_solveM(self._model, self._data, columns, units)  # each row is a force, and its acceleration
            found[row] = state.our_matrix(columns.T)
        return found

    def bias(self, q: Array, v: Array) -> Array:
        return self._velocity_terms(q, v, self._data.qfrc_bias)

    def passive(self, q: Array, v: Array) -> Array:
        return self._velocity_terms(q, v, self._data.qfrc_passive)

    def _velocity_terms(self, q: Array, v: Array, term: Array) -> Array:
        found = np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            mujoco.mj_fwdPosition(self._model, self._data)
            mujoco.mj_fwdVelocity(self._model, self._data)
            found[row] = state.ours(term)
        return found

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        found = np.empty_like(v)
        for row, state in enumerate(self._states(q, v)):
            self._data.qfrc_applied[:] = state.theirs(torque[row])
            mujoco.mj_forwardSkip(self._model, self._data, int(mujoco.mjtStage.mjSTAGE_NONE), 1)  # without sensors
            found[row] = state.ours(self._data.qacc_smooth)
        return found

    def _states(self, q: Array, v: Array) -> Iterator[EngineState]:
        """Each row's state, written into ``MjData``."""
        for positions, rates in zip(q, v, strict=True):
            state = self._coordinates.state(positions, rates)
            self._data.qpos[:], self._data.qvel[:] = state.positions, state.rates
            yield state


def _switch_off(model: Any) -> None:
    option, bits = model.opt, mujoco.mjtDisableBit
    option.disableflags |= int(bits.mjDSBL_CONSTRAINT) | int(bits.mjDSBL_ACTUATION)
    option.enableflags = 0
    option.integrator = int(mujoco.mjtIntegrator.mjINT_EULER)
    option.density = option.viscosity = 0.0
    for name in SET_TO_ZERO:
        if hasattr(model, name):  # an older release has fewer of them
            getattr(model, name)[:] = 0.0


def _inertial(model: Any, body: int) -> Inertial:
    """As MuJoCo uses it: within 1e-6 m or rad of the body's own frame it takes that frame (``body_sameframe``)."""
    same, (of_body, turned_alike) = int(model.body_sameframe[body]), SAME_FRAME
    centre = np.zeros(3) if same == of_body else model.body_ipos[body].copy()
    turned = same == of_body or same == turned_alike != 0
    axes = np.eye(3) if turned else from_quaternion(model.body_iquat[body])
    return Inertial(float(model.body_mass[body]), centre, axes @ np.diag(model.body_inertia[body]) @ axes.T)


def _loaded(path: Path, folders: Sequence[Path]) -> Any:
    """The file's ``MjModel``; what is not where the file says is handed over in memory, each under a name of its own.

    MuJoCo keeps what it is handed by the bare name: of two files ``base.stl`` in two folders it would take one for
    both.
    """
    if not folders and not names_packages(path):
        return mujoco.MjModel.from_xml_path(str(path))
    spec = _spec(path)
    contents: dict[str, bytes] = {}
    for asset, found in _elsewhere(spec, path, NamedFolders(path, folders)):
        asset.name = asset.name or PurePosixPath(asset.file).stem
        asset.file = f"{len(contents)}_{found.name}"
        contents[asset.file] = read_bytes(found, LARGEST_MESH)
    if not contents:
        return mujoco.MjModel.from_xml_path(str(path))
    spec.assets = contents
    return spec.compile()


def _spec(path: Path) -> Any:
    """The file's ``MjSpec``, which MuJoCo makes only of a file called ``.xml`` or ``.urdf``, unlike its ``MjModel``."""
    if path.suffix in NAMES_READ:
        return mujoco.MjSpec.from_file(str(path))
    name = f"{path}.xml"  # in the same folder, for what the file names lies beside it
    return mujoco.MjSpec.from_file(name, include={name: path.read_bytes()})


def _elsewhere(spec: Any, path: Path, folders: NamedFolders) -> Iterator[tuple[Any, Path]]:
    """The assets whose files are not where the file says, but in its package or one of the folders; where they are."""
    for kind, folder in (("meshes", spec.meshdir), ("hfields", spec.meshdir), ("textures", spec.texturedir)):
        for asset in getattr(spec, kind):
            name = asset.file.replace("\\", "/")
            if not name or (path.parent / folder / name).is_file():
                continue
            found = in_own_package(path, name) or folders.find(name if "://" in name else posixpath.join(folder, name))
            if found is not None:
                yield asset, found
