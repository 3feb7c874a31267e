"""MuJoCo Warp with an open mechanism: the model that MuJoCo compiles from it (:mod:`.mujoco`)."""

from __future__ import annotations

from ...models.spatial_mechanism import SpatialMechanism
from ..mujoco_warp import Worlds
from ..protocol import Array
from .mujoco import MujocoTree


class MujocoWarpTree:
    """The mechanism in MuJoCo Warp."""

    def __init__(self, mechanism: SpatialMechanism) -> None:
        self._host = MujocoTree(mechanism)
        self._worlds = Worlds(self._host.model)

    def accelerations(self, q: Array, v: Array) -> Array:
        return self._host.ours(self._worlds.accelerations(*self._host.theirs(q, v)))

    def bias(self, q: Array, v: Array) -> Array:
        return self._host.ours(self._worlds.bias(*self._host.theirs(q, v)))

    def passive(self, q: Array, v: Array) -> Array:
        return self._host.ours(self._worlds.passive(*self._host.theirs(q, v)))

    def mass_matrix(self, q: Array) -> Array:
        rows = self._host.ours(self._worlds.mass_matrix(self._host.positions(q)))
        return rows[:, self._host.columns_v]

    def energy(self, q: Array, v: Array) -> Array:
        return self._worlds.energy(*self._host.theirs(q, v))
