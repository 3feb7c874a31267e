"""MuJoCo Warp, MuJoCo's equations in NVIDIA's Warp, for many states (worlds) at once, in single precision.

* It runs on a CUDA device where there is one; elsewhere on Warp's own CPU device, with the same source.
* The model is the one that MuJoCo compiles from furiko's MJCF, with the exact inertias set (:mod:`.mujoco`).
* It refuses a flag that it does not know, and it knows no ``autoreset``: steps alone have that.
* Without room for contacts and constraints its solver does not start, and ``qacc`` is ``qacc_smooth``.
* Each of its arrays has a row for each world; ``numpy()`` waits for the device, and may share memory on the CPU.
* Warp compiles a kernel when it is first launched, 20 s for all of them, and keeps it on disk.
* Warp says where it keeps kernels, what it compiles and that it found no CUDA driver, past Python.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models import System
from .mujoco import Mujoco, mujoco
from .protocol import Array, BareCall
from .quiet import silenced

# Warp and MuJoCo Warp have no types that fit: Any, here and nowhere else.
with silenced():
    warp: Any = import_module("warp")
    warp.config.log_level = warp.LOG_ERROR
    warp.init()
    mujoco_warp: Any = import_module("mujoco_warp")

CHUNK = 8192  # worlds that are computed at once: a chain of 100 links needs 1 GB
GRAVITY_OFF = int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)


class Worlds:
    """A model of MuJoCo's on Warp's device, asked in its own coordinates, a chunk of states at a time."""

    def __init__(self, model: Any) -> None:
        model.opt.enableflags = 0
        model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
        self._host = model
        self._model = mujoco_warp.put_model(model)
        self._data: Any = None
        starts, self._counts = model.M_rowadr, model.M_rownnz
        self._entries = np.concatenate(
            [np.arange(start, start + count) for start, count in zip(starts, self._counts, strict=True)]
        )

    def accelerations(self, q: Array, v: Array) -> Array:
        return self._each(lambda data: self._forward(data).qacc, q, v)

    def bias(self, q: Array, v: Array) -> Array:
        return self._each(lambda data: self._forward(data).qfrc_bias, q, v)

    def passive(self, q: Array, v: Array) -> Array:
        return self._each(lambda data: self._forward(data).qfrc_passive, q, v)

    def inverse_dynamics(self, q: Array, v: Array, a: Array, *, gravity: bool) -> Array:
        kept = self._model.opt.disableflags
        if not gravity:
            self._model.opt.disableflags = kept | GRAVITY_OFF
        try:
            return self._each(self._inverse, q, v, a)
        finally:
            self._model.opt.disableflags = kept

    def mass_matrix(self, q: Array) -> Array:
        """M, (B, nv, nv): the engine keeps the lower triangle's entries that are not zero."""
        held = self._each(lambda data: self._forward(data).M, q, np.zeros((len(q), self._host.nv)))
        rows, columns = np.repeat(np.arange(self._host.nv), self._counts), self._host.M_colind[self._entries]
        full = np.zeros((len(q), self._host.nv, self._host.nv))
        full[:, rows, columns] = full[:, columns, rows] = held[:, self._entries]
        return full

    def energy(self, q: Array, v: Array) -> Array:
        """Kinetic and potential, (B, 2)."""
        return self._each(self._energies, q, v)[:, ::-1]

    def bare(self, q: Array, v: Array) -> dict[str, BareCall]:
        """Accelerations of these states, which are on the device already: launched one by one, and as one graph."""
        data = mujoco_warp.make_data(self._host, nworld=len(q), nconmax=0, njmax=0)
        data.qpos.assign(_single(q))
        data.qvel.assign(_single(v))

        def launched() -> None:
            self._forward(data)
            warp.synchronize()

        calls = {"forward": BareCall(len(q), launched)}
        if warp.get_device().is_cuda:
            launched()  # kernels are compiled and loaded before they are recorded
            with warp.ScopedCapture() as capture:
                self._forward(data)

            def replayed() -> None:
                warp.capture_launch(capture.graph)
                warp.synchronize()

            calls["forward, as a CUDA graph"] = BareCall(len(q), replayed)
        return calls

    def _forward(self, data: Any) -> Any:
        mujoco_warp.forward(self._model, data)
        return data

    def _inverse(self, data: Any) -> Any:
        mujoco_warp.inverse(self._model, data)
        return data.qfrc_inverse

    def _energies(self, data: Any) -> Any:
        mujoco_warp.fwd_position(self._model, data)
        mujoco_warp.energy_pos(self._model, data)
        mujoco_warp.energy_vel(self._model, data)
        return data.energy

    def _each(self, ask: Callable[[Any], Any], *given: Array) -> Array:
        """A question's answers, (B, …); ``given``: positions, rates and accelerations, as many as it has."""
        count = len(given[0])
        found: list[Array] = []
        for start in range(0, max(count, 1), CHUNK):
            rows = [part[start : start + CHUNK] for part in given]
            data = self._room(max(len(rows[0]), 1))
            for array, part in zip((data.qpos, data.qvel, data.qacc), rows, strict=False):
                if len(part):
                    array.assign(_single(part))
            found.append(ask(data).numpy()[: len(rows[0])].astype(np.float64))
        return np.concatenate(found)

    def _room(self, worlds: int) -> Any:
        """Data of so many worlds: those of the last call where they fit, for nothing is kept in them."""
        if self._data is None or self._data.nworld != worlds:
            self._data = mujoco_warp.make_data(self._host, nworld=worlds, nconmax=0, njmax=0)
        return self._data


class MujocoWarp:
    """A document's mechanism in MuJoCo Warp."""

    def __init__(self, system: System) -> None:
        host = Mujoco(system)
        self._coordinates = host.coordinates
        self._worlds = Worlds(host.model)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return self._coordinates.absolute(self._worlds.accelerations(*self._relative(theta, omega)))

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        found = self._worlds.inverse_dynamics(*self._relative(theta, omega, alpha), gravity=gravity)
        return self._coordinates.absolute_forces(found)

    def energy(self, theta: Array, omega: Array) -> Array:
        return self._worlds.energy(*self._relative(theta, omega))

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> dict[str, BareCall]:
        """``mujoco_warp.forward``; on a CPU it has one thread."""
        return self._worlds.bare(*self._relative(theta, omega))

    def _relative(self, *absolute: Array) -> list[Array]:
        return [self._coordinates.relative(rows) for rows in absolute]


def _single(rows: Array) -> NDArray[np.float32]:
    """In single precision; what is too large for it is infinite there."""
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(rows, dtype=np.float32)
