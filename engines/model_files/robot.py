"""Engines that load any open mechanism from a user's own file, its bytes untouched, and how they are asked.

Everything is asked in the coordinates of a :class:`SpatialMechanism`, which are MuJoCo's, in rows: q (B, nq), v (B, nv)
and generalised forces (B, nv). An engine with other coordinates is mapped in ``robot_coordinates.py``. The equation of
motion is M(q) a + bias(q, v) = passive(q, v) + torque.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...models.spatial_mechanism import SpatialMechanism
from ..protocol import Array


class BoundRobot(Protocol):
    """An engine's model, asked in the coordinates of the mechanism that it was bound to."""

    def mass_matrix(self, q: Array) -> Array:
        """M [kg m², kg m, kg], (B, nv, nv), with the armature."""
        ...

    def bias(self, q: Array, v: Array) -> Array:
        """Forces [N m or N] that hold a = 0, with gravity and without passive forces, (B, nv)."""
        ...

    def passive(self, q: Array, v: Array) -> Array:
        """Forces of springs and dampers that the engine's own forward dynamics applies, (B, nv); zeros if none."""
        ...

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        """The engine's own forward dynamics under ``torque`` (B, nv) [N m or N]: (B, nv).

        Without contacts, limits, dry friction, actuators, equality constraints, tendons, fluid, gravity compensation.
        """
        ...


class RobotEngine(Protocol):
    """A user's file in an engine, as the engine's own reader reads it.

    Made from the file's ``path``, its ``language`` (``mjcf`` or ``urdf``) and ``folders`` in which meshes may lie that
    are not where the file says. Raises what the engine raises, or ValueError, where it refuses the file.
    """

    def __init__(self, path: Path, language: str, folders: Sequence[Path] = ()) -> None: ...

    def compiled(self, like: SpatialMechanism | None = None) -> SpatialMechanism:
        """What the engine holds, bodies and joints as it has them, poses in its own reference configuration.

        Where an engine joins fixed bodies, the one that moves has the inertial of all. Names are the engine's; those
        of joints and bodies that correspond to some of ``like`` are taken from there.
        """
        ...

    def joints(self) -> tuple[str, ...]:
        """Names of the joints that it has, in its order; those of ``compiled()``."""
        ...

    def bind(self, mechanism: SpatialMechanism) -> BoundRobot:
        """The engine in the mechanism's coordinates.

        Raises ValueError where its joints are not the mechanism's: it names those that are lost, additional, or of
        another kind.
        """
        ...


@dataclass(frozen=True)
class RobotReader:
    """How an engine loads a robot's file, known without importing it.

    ``adapter``: its class, ``module:Class``; ``module``, ``package``: to import and to install; ``languages``: those
    that it reads. Of the numbers of joints (``damping``, ``stiffness``, ``friction``) and ``gravity``, ``not_held`` are
    those that it does not read, and ``leaves_to_caller`` those that its forward dynamics does not apply.
    ``factorises``: whether its accelerations come from a factorised mass matrix.
    """

    name: str
    adapter: str
    module: str
    package: str
    languages: tuple[str, ...] = ("mjcf", "urdf")
    not_held: tuple[str, ...] = ()
    leaves_to_caller: tuple[str, ...] = ()
    factorises: bool = False

    def load(self, path: Path, language: str, folders: Sequence[Path] = ()) -> RobotEngine:
        """Import the engine and have it read the file. Exceptions of the engine are passed on."""
        module, _, name = self.adapter.partition(":")
        made: RobotEngine = getattr(importlib.import_module(module, __package__), name)(path, language, folders)
        return made


ROBOT_READERS: dict[str, RobotReader] = {
    reader.name: reader
    for reader in (
        RobotReader("mujoco", ".robot_mujoco:MujocoRobot", "mujoco", "mujoco", factorises=True),
        RobotReader(
            "pinocchio-aba",
            ".robot_pinocchio:PinocchioRobot",
            "pinocchio",
            "pin",
            not_held=("stiffness", "gravity"),
            leaves_to_caller=("damping", "stiffness"),
        ),
        RobotReader(
            "drake",
            ".robot_drake:DrakeRobot",
            "pydrake",
            "drake",
            not_held=("stiffness", "friction"),
            leaves_to_caller=("stiffness",),
        ),
    )
}
