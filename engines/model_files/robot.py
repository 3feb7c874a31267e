"""Engines that load any open mechanism from a user's own file, its bytes untouched, and how they are asked.

Everything is asked in the coordinates of a :class:`SpatialMechanism`, which are MuJoCo's, in rows: q (B, nq), v (B, nv)
and generalised forces (B, nv). An engine with other coordinates is mapped in ``robot_coordinates.py``. The equation of
motion is M(q) a + bias(q, v) = passive(q, v) + torque.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from ...models.spatial_mechanism import SpatialMechanism
from ..protocol import Array

# MuJoCo 4.0 turns a mesh to principal axes until no product of inertia exceeds 1e-7 of the largest moment: of 400
# random tetrahedra the worst leaves 9.99e-8, whatever their size. Other inertias are turned to rounding.
MESH_AXES = 1e-7
# Pinocchio has no springs, and gravity is a number of its model that its users set: neither is a mistake in reading.
PINOCCHIO_MJCF = (
    "first_root_only",
    "geoms_without_contact_weigh_nothing",
    "pose_of_first_fixed_body_dropped",
    "mesh_weighs_one_kilogram",
    "inertial_without_inertia_is_unit",
    "first_worldbody_again",
    "default_joint_pos_dropped",
    "default_geom_mass_dropped",
    "default_geom_pose_dropped",
    "childclass_behind_class",
    "total_mass_ignored",
    "inertia_group_ignored",
    "balance_inertia_ignored",
    "bound_inertia_on_given_axes",
    "bound_ignored",
    "upper_euler_as_lower",
    "axis_not_normalised",
    "include_not_followed",
    "late_sections_ignored",
    "later_sections_ignored",
    "bare_bodies_lost",
    "unnamed_sibling_twice",
    "first_ref_ignored",
    "gravity_flag_ignored",
    "damping_dropped_on_free_and_ball",
    "springdamper_ignored",
    "attach_ignored",
    "frame_ignored",
    "align_ignored",
)
DRAKE_MJCF = (
    "pos_of_last_joint_for_all",
    "armature_needs_actuator",
    "nested_class_inherits_nothing",
    "damping_dropped_on_free",
    "attach_ignored",
    "frame_ignored",
    "total_mass_ignored",
    "inertia_group_ignored",
    "balance_inertia_ignored",
    "bound_ignored",
    "align_ignored",
)


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
    ``factorises``: whether its accelerations come from a factorised mass matrix. ``mesh_axes``: of meshes, which it
    keeps in their principal axes, the largest product of inertia that these leave, over the largest moment.
    ``same_frame``: so near its body's frame, in m and as parts of a quaternion, an inertial is taken to be in it.
    ``mistakes``: by language the flags of :mod:`furiko.models.readers.rules` that it is known to make, the likelier
    ones first. ``most_freedoms``: of more than so many it is not asked to read the file; 0 where nothing speaks
    against any number.
    """

    name: str
    adapter: str
    module: str
    package: str
    languages: tuple[str, ...] = ("mjcf", "urdf")
    not_held: tuple[str, ...] = ()
    leaves_to_caller: tuple[str, ...] = ()
    factorises: bool = False
    mesh_axes: float = 0.0
    same_frame: float = 0.0
    mistakes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    most_freedoms: int = 0

    def load(self, path: Path, language: str, folders: Sequence[Path] = ()) -> RobotEngine:
        """Import the engine and have it read the file. Exceptions of the engine are passed on."""
        module, _, name = self.adapter.partition(":")
        made: RobotEngine = getattr(importlib.import_module(module, __package__), name)(path, language, folders)
        return made


ROBOT_READERS: dict[str, RobotReader] = {
    reader.name: reader
    for reader in (
        RobotReader(
            "mujoco",
            ".robot_mujoco:MujocoRobot",
            "mujoco",
            "mujoco",
            factorises=True,
            mesh_axes=MESH_AXES,
            same_frame=1e-6,
            mistakes={
                "urdf": (
                    "extension_honoured",
                    "fixed_massless_inertia_dropped",
                    "collision_weighs",
                    "inertial_rotation_lost",
                )
            },
        ),
        RobotReader(
            "pinocchio-aba",
            ".robot_pinocchio:PinocchioRobot",
            "pinocchio",
            "pin",
            not_held=("stiffness", "gravity"),
            leaves_to_caller=("damping", "stiffness"),
            most_freedoms=400,  # its reader makes the workspace, of gigabytes beyond, and takes minutes
            mistakes={
                "mjcf": PINOCCHIO_MJCF,
                "urdf": (
                    "planar_axis_ignored",
                    "space_behind_number_rejected",
                    "damping_dropped_on_planar_and_floating",
                ),
            },
        ),
        RobotReader(
            "drake",
            ".robot_drake:DrakeRobot",
            "pydrake",
            "drake",
            not_held=("stiffness", "friction"),
            leaves_to_caller=("stiffness",),
            mistakes={"mjcf": DRAKE_MJCF, "urdf": ("impossible_inertia_becomes_sphere", "drake_rotor_counted")},
        ),
    )
}
