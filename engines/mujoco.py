"""MuJoCo, driven through ``mj_forward`` and ``mj_inverse`` on one model and one ``MjData``.

* The model is the MJCF document that furiko writes. Readers of XML fail on deep nesting, so that a longer chain is
  built by ``MjSpec``, body by body; where both ways work they give the same accelerations to the last bit.
* The compiler refuses a body whose inertia is below 1e-15 kg m², though the equations need none: where a link has less
  the compiler raises it (``boundinertia``), and the exact number is set in the compiled model.
* It also treats a centre of mass within 1e-6 m of the hinge as one at the hinge (``body_sameframe``), and ignores the
  exact one, which the compiled model has all the same: that is reversed.
* ``mj_step`` and the batch module announce a NaN on standard error and in a file MUJOCO_LOG.TXT, the first time that
  an ``MjData`` meets one. Its warning counters are therefore set before it starts. ``mujoco.batch`` keeps its own
  ``MjData``, which cannot be silenced; at two hundred states it saves no more than what making it costs.
* After a NaN ``mj_step`` starts again from the initial state unless ``autoreset`` is off.
* Joint forces (``cfrc_int``) are only computed for sensors, or when ``mj_rnePostConstraint`` is called.
"""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..models import InvalidInput, PlanarTree, System, to_mjcf
from ..models.writers.mjcf import DEEPEST, LEAST_INERTIA
from .coordinates import RelativeCoordinates, along_across
from .protocol import Array, BareCall, ModelFields
from .releases import has

# MuJoCo's bindings have no type stubs that fit: Any, here and nowhere else.
mujoco: Any = import_module("mujoco")

VERSION: str = mujoco.__version__
AUTORESET = ' autoreset="disable"'
# Of body_sameframe: the inertial is in the body's frame, or turned like it.
SAME_FRAME = (
    (int(mujoco.mjtSameFrame.mjSAMEFRAME_BODY), int(mujoco.mjtSameFrame.mjSAMEFRAME_BODYROT))
    if has("mujoco: body_sameframe tells a centre of mass from its axes", VERSION)
    else (1, 0)  # before, it was whether both are the body's own
)

ENERGY = int(mujoco.mjtEnableBit.mjENBL_ENERGY)
INTEGRATORS = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}


class Mujoco:
    """The mechanism in MuJoCo, in relative coordinates."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        # The compiler's own MjData cannot be silenced, and warns of inertias that are set afterwards.
        mujoco.set_mju_user_warning(lambda message: None)
        deep = tree.depth > DEEPEST or any(0 < link.inertia < LEAST_INERTIA for link in tree.links)
        if deep and not has("mujoco: MjSpec builds and compiles", VERSION):
            raise InvalidInput(f"MuJoCo {VERSION} holds no inertia between 0 and {LEAST_INERTIA:g} kg m²")
        self._model = model_from_spec(tree) if deep else mujoco.MjModel.from_xml_string(_mjcf(system))
        self._bodies = np.array([self._model.body(name).id for name in tree.names("link")])
        self._hinges = np.array([self._model.joint(name).id for name in tree.names("hinge")])
        for body, link in zip(self._bodies, tree.links, strict=True):
            if link.inertia < LEAST_INERTIA:
                self._model.body_inertia[body] = link.inertia
        keep_centres(self._model)
        if has("mujoco: energies are computed though their flag is off", VERSION):
            # Energies are computed only when they are asked for.
            self._model.opt.enableflags &= ~ENERGY
        self._data = quiet_data(self._model)
        self._moving = quiet_data(self._model)
        self._coordinates = RelativeCoordinates(tree.parents, self._model.jnt_dofadr[self._hinges])

    @property
    def model(self) -> Any:
        """The compiled model."""
        return self._model

    @property
    def coordinates(self) -> RelativeCoordinates:
        """From absolute angles to the model's, and back."""
        return self._coordinates

    def fields(self) -> ModelFields:
        model, bodies, hinges = self._model, self._bodies, self._hinges
        link_of_body = {0: -1} | {int(body): link for link, body in enumerate(bodies)}
        dofs = model.jnt_dofadr[hinges]
        gravity_off = model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
        return ModelFields(
            dofs=int(model.nv),
            parents=tuple(link_of_body[int(parent)] for parent in model.body_parentid[bodies]),
            hinges=along_across(model.body_pos[bodies]),
            centres=along_across(model.body_ipos[bodies]),
            masses=model.body_mass[bodies].copy(),
            inertias=np.array([_inertia_about_y(model, body) for body in bodies]),
            gravity=np.zeros(3) if gravity_off else model.opt.gravity.copy(),
            armature=model.dof_armature[dofs].copy(),
            damping=np.asarray(model.dof_damping[dofs], dtype=np.float64).reshape(len(dofs), -1)[:, 0].copy(),
        )

    def accelerations(self, theta: Array, omega: Array) -> Array:
        model, data, forward = self._model, self._data, mujoco.mj_forward
        position, rate, acceleration = data.qpos, data.qvel, data.qacc
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            position[:], rate[:] = q, v
            forward(model, data)
            found[row] = acceleration
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        model, data = self._model, self._data
        forces = np.empty_like(theta)
        kept = model.opt.disableflags
        if not gravity:
            model.opt.disableflags = kept | int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
        try:
            for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
                data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
                mujoco.mj_inverse(model, data)
                forces[row] = data.qfrc_inverse
        finally:
            model.opt.disableflags = kept
        return self._coordinates.absolute_forces(forces)

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        model, data = self._model, self._data
        forces = np.empty((*theta.shape, 2))
        for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
            data.qpos[:], data.qvel[:] = q, v
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_fwdVelocity(model, data)
            data.qacc[:] = a
            mujoco.mj_rnePostConstraint(model, data)
            # Rows are torque, then force, in the world's axes, of the parent on the child.
            forces[row] = -data.cfrc_int[self._bodies][:, [3, 5]]
        return forces

    def inverse_mass(self, theta: Array) -> Array:
        model, data, n = self._model, self._data, theta.shape[-1]
        found, units = np.empty((*theta.shape, n)), np.eye(n)
        for row, (q,) in enumerate(self._coordinates.rows(theta)):
            data.qpos[:] = q
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_solveM(model, data, found[row], units)  # a row of units is a force, a row found its acceleration
        return self._coordinates.absolute_inverse_mass(found.swapaxes(1, 2))

    def energy(self, theta: Array, omega: Array) -> Array:
        model, data = self._model, self._data
        energies = np.empty((len(theta), 2))
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            data.qpos[:], data.qvel[:] = q, v
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_fwdVelocity(model, data)
            mujoco.mj_energyPos(model, data)
            mujoco.mj_energyVel(model, data)
            energies[row] = data.energy[1], data.energy[0]
        return energies

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        angles, rates = self._run(theta, omega, integrator, step, [steps])
        return angles[-1], rates[-1]

    def path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        return self._run(theta, omega, integrator, step, [1] * steps)

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> dict[str, BareCall]:
        """``mj_forward`` on the first state, and the batch module on all of them."""
        batch = import_module("mujoco.batch").Batch(self._model, len(theta), threads)
        batch.qpos, batch.qvel = self._coordinates.relative(theta), self._coordinates.relative(omega)
        batch.bind("qacc")  # else it would return nothing
        self._data.qpos[:], self._data.qvel[:] = batch.qpos[0], batch.qvel[0]
        return {
            "mj_forward": BareCall(1, partial(mujoco.mj_forward, self._model, self._data)),
            "batch.Batch.forward": BareCall(len(theta), batch.forward),
        }

    def lighter(self) -> dict[str, Callable[[], AbstractContextManager[None]]]:
        return {"timer off": _timer_off}

    def _run(self, theta: Array, omega: Array, integrator: str, step: float, strides: list[int]) -> tuple[Array, Array]:
        """The state at the start and after each stride of so many steps, (strides + 1, n) each."""
        model, data, option = self._model, self._moving, self._model.opt
        mujoco.mj_resetData(model, data)
        _silence(data)
        ((data.qpos[:], data.qvel[:]),) = self._coordinates.rows(theta[None], omega[None])
        angles, rates = [data.qpos.copy()], [data.qvel.copy()]
        kept = option.integrator, option.timestep
        option.integrator, option.timestep = INTEGRATORS[integrator], step
        try:
            for stride in strides:
                mujoco.mj_step(model, data, nstep=stride)
                angles.append(data.qpos.copy())
                rates.append(data.qvel.copy())
        finally:
            option.integrator, option.timestep = kept
        return self._coordinates.absolute(np.array(angles)), self._coordinates.absolute(np.array(rates))


def _mjcf(system: System) -> str:
    """furiko's MJCF; without what a release does not know."""
    text = to_mjcf(system)
    return text if has("mujoco: autoreset can be switched off", VERSION) else text.replace(AUTORESET, "")


def model_from_spec(tree: PlanarTree) -> Any:
    """The compiled model that furiko's MJCF describes, without its geoms, built without XML."""
    spec = empty_spec([0.0, 0.0, -tree.gravity])
    bodies: list[Any] = []
    for link, body_name, hinge_name in zip(tree.links, tree.names("link"), tree.names("hinge"), strict=True):
        parent = bodies[link.parent] if link.parent >= 0 else spec.worldbody
        body = parent.add_body(
            name=body_name,
            pos=_point(link.hinge),
            mass=link.mass,
            ipos=_point(link.com),
            inertia=[link.inertia] * 3,
            explicitinertial=True,
        )
        body.add_joint(name=hinge_name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0.0, -1.0, 0.0])
        bodies.append(body)
    return compiled(spec)


def empty_spec(gravity: list[float]) -> Any:
    """A specification without bodies; its compiler keeps what is added, and no motion is constrained or reset."""
    spec = mujoco.MjSpec()
    spec.modelname = "furiko"
    compiler, option = spec.compiler, spec.option
    compiler.degree = False
    compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE
    compiler.balanceinertia = compiler.autolimits = False
    compiler.boundinertia = LEAST_INERTIA
    option.gravity = gravity
    if not has("mujoco: energies are computed though their flag is off", VERSION):
        option.enableflags = ENERGY
    option.disableflags = int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT) | int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    return spec


def compiled(spec: Any) -> Any:
    """The model of a specification."""
    with warnings.catch_warnings():  # this way the compiler's warnings are Python's
        warnings.simplefilter("ignore")
        return spec.compile()


def keep_centres(model: Any) -> None:
    """Make the compiled model use each centre of mass as it is given, however near the hinge."""
    same, turned = SAME_FRAME
    wrong = (model.body_sameframe == same) & model.body_ipos.any(axis=1)
    model.body_sameframe[wrong] = turned
    # A lone such body is "simple": its inertia is that of the posture in which it was compiled.
    model.body_simple[wrong] = 0
    model.dof_simplenum[wrong[model.dof_bodyid]] = 0


@contextmanager
def _timer_off() -> Iterator[None]:
    """Without the clock that the Python package, unlike the C library, reads several times in every step.

    ``mujoco.set_mjcb_time(None)`` does not remove it: the package's own clock stays set.
    """
    (library,) = Path(mujoco.__file__).parent.glob("*mujoco.*[0-9]*")
    clock = ctypes.c_void_p.in_dll(ctypes.CDLL(str(library)), "mjcb_time")
    kept, clock.value = clock.value, None
    try:
        yield
    finally:
        clock.value = kept


def quiet_data(model: Any) -> Any:
    """An ``MjData`` that neither prints nor writes MUJOCO_LOG.TXT."""
    data = mujoco.MjData(model)
    _silence(data)
    return data


def _silence(data: Any) -> None:
    """Set its warning counters: it then neither prints nor writes MUJOCO_LOG.TXT."""
    data.warning.number[:] = 1


def _point(along_across: tuple[float, float]) -> list[float]:
    along, across = along_across
    return [across, 0.0, 0.0 - along]


def _inertia_about_y(model: Any, body: int) -> float:
    """The moment of inertia [kg m²] about the hinge axis, from the principal moments and their axes."""
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    return float(turn.reshape(3, 3)[1] ** 2 @ model.body_inertia[body])
