"""What a simulation in MuJoCo adds to the dynamics of a file: contacts at the start, the error of its time steps."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from ..protocol import Array
from .robot_mujoco import MujocoRobot

mujoco: Any = import_module("mujoco")

SECONDS = 1.0  # of the run whose energy is watched
MOST_STEPS = 2_000  # of it


@dataclass(frozen=True)
class Simulation:
    """``timestep`` [s] and ``integrator`` of the file; ``touching``: pairs of geoms in contact at its start.

    ``energy``: at the start and at the end of a run of ``seconds`` without contacts, limits, friction, dampers and
    actuators, [J], which would keep it; ``kinetic``: the largest kinetic energy on the way [J]. NaN where the run does
    not stay finite.
    """

    timestep: float
    integrator: str
    touching: tuple[str, ...]
    seconds: float
    energy: tuple[float, float]
    kinetic: float

    @property
    def drift(self) -> float:
        """The energy that was lost or won, over the kinetic energy that was there."""
        return abs(self.energy[1] - self.energy[0]) / self.kinetic if self.kinetic > 0 else 0.0


def simulate(robot: MujocoRobot, q: Array, v: Array) -> Simulation:
    """Step the file's own model from ``q`` (nq,), ``v`` (nv,), MuJoCo's coordinates, with its own integrator and step.

    Raises ValueError where MuJoCo has other coordinates.
    """
    model = copy.copy(robot.as_written)
    if (model.nq, model.nv) != (len(q), len(v)):
        raise ValueError(f"MuJoCo has {model.nq} coordinates, not {len(q)}")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pairs = [" and ".join(_geom(model, g) for g in contact.geom) for contact in data.contact[: data.ncon]]
    steps = min(MOST_STEPS, max(1, round(SECONDS / model.opt.timestep)))
    energy, kinetic = _run(model, q, v, steps)
    return Simulation(
        timestep=float(model.opt.timestep),
        integrator=mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_"),
        touching=tuple(dict.fromkeys(pairs)),
        seconds=steps * float(model.opt.timestep),
        energy=energy,
        kinetic=kinetic,
    )


def _run(model: Any, q: Array, v: Array, steps: int) -> tuple[tuple[float, float], float]:
    bits = mujoco.mjtDisableBit
    for bit in (bits.mjDSBL_CONSTRAINT, bits.mjDSBL_DAMPER, bits.mjDSBL_ACTUATION):
        model.opt.disableflags |= int(bit)
    model.opt.density = model.opt.viscosity = 0.0
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, v
    mujoco.mj_forward(model, data)
    start, kinetic = float(data.energy.sum()), 0.0
    for _ in range(steps):
        mujoco.mj_step(model, data)
        kinetic = max(kinetic, float(data.energy[1]))
    mujoco.mj_forward(model, data)
    finite = bool(np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all() and not _reset(data))
    end = float(data.energy.sum()) if finite else float("nan")
    return (start, end), kinetic


def _reset(data: Any) -> bool:
    """Whether MuJoCo has set the state back after an instability, which it does in silence."""
    bad = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
    return any(int(data.warning[int(kind)].number) for kind in bad)


def _geom(model: Any, geom: int) -> str:
    found = model.geom(int(geom))
    if found.name:
        return repr(found.name)
    body = model.body(int(found.bodyid[0]))
    return f"a geom of body {body.name!r}" if body.name else f"a geom of an unnamed body, the file's number {body.id}"
