"""An open mechanism of hinges and slides in Exudyn, which reads neither MJCF nor URDF: furiko's reader built it.

It shows whether the equations of motion are right for the file as furiko reads it, not whether furiko reads it right.
"""

from __future__ import annotations

import numpy as np

from ...models.spatial_mechanism import SpatialMechanism
from ..protocol import Array
from .exudyn import ExudynMechanism


class ExudynRobot:
    """The mechanism as one kinematic tree (:class:`~furiko.engines.model_files.robot.BoundRobot`)."""

    def __init__(self, mechanism: SpatialMechanism) -> None:
        self._engine = ExudynMechanism(mechanism)
        self._damping, self._stiffness = mechanism.per_freedom("damping"), mechanism.per_freedom("stiffness")
        self._rest = np.array([placed.joint.springref for placed in mechanism.joints])

    def mass_matrix(self, q: Array) -> Array:
        return self._engine.mass_matrix(q)

    def bias(self, q: Array, v: Array) -> Array:
        return self._engine.bias(q, v)

    def passive(self, q: Array, v: Array) -> Array:
        """What its control of each joint is told to exert."""
        return np.asarray(-self._stiffness * (q - self._rest) - self._damping * v)

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        return self._engine.driven(q, v, torque)
