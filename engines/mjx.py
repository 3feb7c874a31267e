"""MJX, MuJoCo's equations written in JAX, in double and in single precision; batches by ``jax.vmap``.

* The model is the one that MuJoCo compiles from furiko's MJCF, with the exact inertias set (:mod:`.mujoco`).
* JAX computes in single precision unless it is told otherwise; here that is told for each call, so that both engines
  run in one process.
* A compiled function serves one shape of batch: states are asked in chunks of one size, the last filled up.
* What is compiled depends on the mechanism's structure and not on its numbers: models are arguments.
* MJX writes its recursions out link by link, and where XLA compiles for a CPU it fuses them: each link's numbers are
  computed anew in each that needs them, which takes twice as long with every link (20 s a batch of 64 at 20 links).
  There it compiles without fusion, and without optimising machine code that runs a few times: 1 to 2 s a link.
* On a GPU JAX multiplies matrices of single precision with ten bits of each number, unless it is told to use them all.
* JAX takes most of a GPU's memory when it starts, which leaves none to another worker: here it takes what it needs.
* MJX prints a line where it cannot import Warp, which it does not need.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from importlib import import_module
from typing import Any

import numpy as np

from ..models import System
from .mujoco import Mujoco
from .protocol import Array, BareCall
from .quiet import silenced

os.environ.setdefault("XLA_PYTHON_CLIENT_PREALLOCATE", "false")
# JAX and MJX have no types that fit: Any, here and nowhere else.
jax: Any = import_module("jax")
with silenced():
    mjx: Any = import_module("mujoco.mjx")

CHUNK = 64  # states that are computed at once
LARGE_CHUNK = 4096  # on a GPU, where so many cost what one costs
CPU_OPTIONS = {"xla_disable_hlo_passes": "fusion", "xla_backend_optimization_level": 0}


class Batches:
    """A model of MuJoCo's in MJX, in one precision, asked in its own coordinates."""

    def __init__(self, model: Any, *, double: bool) -> None:
        model.opt.enableflags = 0
        model.geom_rbound[:] = 0  # shapes are there to be seen; of numbers that are no arguments they alone differ
        self._double = double
        with self._precision():
            self._model = mjx.put_model(model)
            self._data = mjx.make_data(model)

    def each(self, name: str, *given: Array) -> Array:
        """A question's answers, (B, …), for rows (B, nq) or (B, nv), a chunk at a time."""
        count, chunk = len(given[0]), _chunk(name)
        found: list[Array] = []
        with self._precision():
            for start in range(0, max(count, 1), chunk):
                rows = [part[start : start + chunk] for part in given]
                filled = [np.concatenate([part, np.ones((chunk - len(part), part.shape[-1]))]) for part in rows]
                answer = np.asarray(_compiled(name)(self._model, self._data, *filled), dtype=np.float64)
                found.append(answer[: len(rows[0])])
        return np.concatenate(found)

    def bare(self, q: Array, v: Array) -> BareCall:
        """Accelerations of these states, which are on the device already, compiled for as many."""
        with self._precision():
            given = [jax.numpy.asarray(rows) for rows in (q, v)]

        def call() -> None:
            with self._precision():
                _compiled("accelerations")(self._model, self._data, *given).block_until_ready()

        return BareCall(len(q), call)

    @contextmanager
    def _precision(self) -> Iterator[None]:
        with jax.enable_x64(self._double), jax.default_matmul_precision("highest"):
            yield


class Mjx:
    """MJX in double precision."""

    double = True

    def __init__(self, system: System) -> None:
        host = Mujoco(system)
        self._coordinates = host.coordinates
        self._batches = Batches(host.model, double=self.double)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return self._coordinates.absolute(self._each("accelerations", theta, omega))

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        states = [self._coordinates.relative(rows) for rows in (theta, omega, alpha)]
        weights = np.full((len(theta), 1), float(gravity))
        return self._coordinates.absolute_forces(self._batches.each("inverse dynamics", *states, weights))

    def derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """By JAX's forward mode through the engine's own accelerations."""
        found = self._each("derivatives", theta, omega)
        return self._coordinates.absolute_matrix(found[:, 0]), self._coordinates.absolute_matrix(found[:, 1])

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> dict[str, BareCall]:
        """``mjx.forward`` under ``jit`` and ``vmap``; JAX chooses the threads."""
        return {"mjx.forward": self._batches.bare(*map(self._coordinates.relative, (theta, omega)))}

    def _each(self, name: str, *absolute: Array) -> Array:
        return self._batches.each(name, *(self._coordinates.relative(rows) for rows in absolute))


class MjxSingle(Mjx):
    """MJX in single precision, as JAX has it by default."""

    double = False


def _accelerations(model: Any, data: Any, q: Any, v: Any) -> Any:
    return mjx.forward(model, data.replace(qpos=q, qvel=v)).qacc


def _inverse_dynamics(model: Any, data: Any, q: Any, v: Any, a: Any, weight: Any) -> Any:
    model = model.tree_replace({"opt.gravity": model.opt.gravity * weight})
    return mjx.inverse(model, data.replace(qpos=q, qvel=v, qacc=a)).qfrc_inverse


def _derivatives(model: Any, data: Any, q: Any, v: Any) -> Any:
    by_both = jax.jacfwd(partial(_accelerations, model, data), argnums=(0, 1))
    return jax.numpy.stack(by_both(q, v))


def _terms(model: Any, data: Any, q: Any, v: Any) -> Any:
    """Accelerations, bias, passive forces and the mass matrix, (3 + nv, nv): compiled once for all."""
    data = mjx.forward(model, data.replace(qpos=q, qvel=v))
    rows = jax.numpy.stack([data.qacc, data.qfrc_bias, data.qfrc_passive])
    return jax.numpy.concatenate([rows, mjx.full_m(model, data)])


_QUESTIONS: dict[str, tuple[Callable[..., Any], int]] = {
    "accelerations": (_accelerations, 2),
    "inverse dynamics": (_inverse_dynamics, 4),
    "derivatives": (_derivatives, 2),
    "terms": (_terms, 2),
}


def _chunk(name: str) -> int:
    """Derivatives are 2n states each."""
    return CHUNK if _on_cpu() or name == "derivatives" else LARGE_CHUNK


def _on_cpu() -> bool:
    return bool(jax.default_backend() == "cpu")


@cache
def _compiled(name: str) -> Callable[..., Any]:
    function, arrays = _QUESTIONS[name]
    batched: Callable[..., Any] = jax.jit(
        jax.vmap(function, in_axes=(None, None) + (0,) * arrays), compiler_options=CPU_OPTIONS if _on_cpu() else None
    )
    return batched
