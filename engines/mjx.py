"""MJX, MuJoCo's equations written in JAX, in double and in single precision; batches by ``jax.vmap``.

* The model is the one that MuJoCo compiles from furiko's MJCF, with the exact inertias set (:mod:`.mujoco`).
* JAX computes in single precision unless it is told otherwise; here that is told for each call, so that both engines
  run in one process.
* A compiled function serves one shape of batch: states are asked in chunks of one size, the last filled up.
* What is compiled depends on the mechanism's structure and not on its numbers: models are arguments.
* MJX prints a line where it cannot import Warp, which it does not need.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from importlib import import_module
from typing import Any

import numpy as np

from ..models import System
from .mujoco import Mujoco
from .protocol import Array
from .quiet import silenced

# JAX and MJX have no types that fit: Any, here and nowhere else.
jax: Any = import_module("jax")
with silenced():
    mjx: Any = import_module("mujoco.mjx")

CHUNK = 64  # states that are computed at once


class Mjx:
    """MJX in double precision."""

    double = True

    def __init__(self, system: System) -> None:
        host = Mujoco(system)
        self._coordinates = host.coordinates
        host.model.opt.enableflags = 0
        host.model.geom_rbound[:] = 0  # shapes are there to be seen; of numbers that are no arguments they alone differ
        with self._precision():
            self._model = mjx.put_model(host.model)
            self._data = mjx.make_data(host.model)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return self._coordinates.absolute(self._each("accelerations", theta, omega))

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        name = "inverse dynamics" if gravity else "inverse dynamics, weightless"
        return self._coordinates.absolute_forces(self._each(name, theta, omega, alpha))

    def derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """By JAX's forward mode through the engine's own accelerations."""
        found = self._each("derivatives", theta, omega)
        return self._coordinates.absolute_matrix(found[:, 0]), self._coordinates.absolute_matrix(found[:, 1])

    def _each(self, name: str, *absolute: Array) -> Array:
        """A question's answers, (B, …), for rows (B, n), a chunk at a time."""
        given = [self._coordinates.relative(rows) for rows in absolute]
        count = len(given[0])
        found: list[Array] = []
        with self._precision():
            for start in range(0, max(count, 1), CHUNK):
                rows = [part[start : start + CHUNK] for part in given]
                filled = [np.concatenate([part, np.zeros((CHUNK - len(part), part.shape[-1]))]) for part in rows]
                answer = np.asarray(_compiled(name)(self._model, self._data, *filled), dtype=np.float64)
                found.append(answer[: len(rows[0])])
        return np.concatenate(found)

    def _precision(self) -> Any:
        return jax.enable_x64(self.double)


class MjxSingle(Mjx):
    """MJX in single precision, as JAX has it by default."""

    double = False


def _accelerations(model: Any, data: Any, q: Any, v: Any) -> Any:
    return mjx.forward(model, data.replace(qpos=q, qvel=v)).qacc


def _inverse_dynamics(weight: float, model: Any, data: Any, q: Any, v: Any, a: Any) -> Any:
    model = model.tree_replace({"opt.gravity": model.opt.gravity * weight})
    return mjx.inverse(model, data.replace(qpos=q, qvel=v, qacc=a)).qfrc_inverse


def _derivatives(model: Any, data: Any, q: Any, v: Any) -> Any:
    by_both = jax.jacfwd(partial(_accelerations, model, data), argnums=(0, 1))
    return jax.numpy.stack(by_both(q, v))


_QUESTIONS: dict[str, tuple[Callable[..., Any], int]] = {
    "accelerations": (_accelerations, 2),
    "inverse dynamics": (partial(_inverse_dynamics, 1.0), 3),
    "inverse dynamics, weightless": (partial(_inverse_dynamics, 0.0), 3),
    "derivatives": (_derivatives, 2),
}


@cache
def _compiled(name: str) -> Callable[..., Any]:
    function, arrays = _QUESTIONS[name]
    batched: Callable[..., Any] = jax.jit(jax.vmap(function, in_axes=(None, None) + (0,) * arrays))
    return batched
