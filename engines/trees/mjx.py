"""MJX with an open mechanism: the model that MuJoCo compiles from it (:mod:`.mujoco`), in both precisions."""

from __future__ import annotations

import numpy as np

from ...models.spatial_mechanism import SpatialMechanism
from ..mjx import Batches
from ..protocol import Array
from .mujoco import MujocoTree


class MjxTree:
    """The mechanism in MJX, in double precision."""

    double = True

    def __init__(self, mechanism: SpatialMechanism) -> None:
        self._host = MujocoTree(mechanism)
        self._batches = Batches(self._host.model, double=self.double)

    def accelerations(self, q: Array, v: Array) -> Array:
        return self._terms(q, v)[:, 0]

    def bias(self, q: Array, v: Array) -> Array:
        return self._terms(q, v)[:, 1]

    def passive(self, q: Array, v: Array) -> Array:
        return self._terms(q, v)[:, 2]

    def mass_matrix(self, q: Array) -> Array:
        return self._terms(q, np.zeros((len(q), self._host.model.nv)))[:, 3:]

    def derivatives(self, q: Array, v: Array) -> tuple[Array, Array]:
        """By JAX's forward mode through the engine's own accelerations; of hinges and slides."""
        found = self._host.ours(self._batches.each("derivatives", *self._host.theirs(q, v)))
        columns = self._host.columns_v
        return found[:, 0][:, columns], found[:, 1][:, columns]

    def _terms(self, q: Array, v: Array) -> Array:
        """Accelerations, bias, passive forces and the mass matrix, (B, 3 + nv, nv)."""
        found = self._host.ours(self._batches.each("terms", *self._host.theirs(q, v)))
        return np.concatenate([found[:, :3], found[:, 3:][:, self._host.columns_v]], axis=1)


class MjxSingleTree(MjxTree):
    """The mechanism in MJX, in single precision."""

    double = False
