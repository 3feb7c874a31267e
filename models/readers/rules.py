"""Named deviations from what MJCF and URDF documents say: each flag has furiko's reader make one engine's mistake.

A reading with a flag is what an engine that makes this mistake has; where it reproduces the engine's numbers, the
mistake is named. Without flags the reader does as the formats' documentation says.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace
from typing import Any


def _mistake(says: str) -> Any:
    """A flag, not set; ``says`` continues "the engine …"."""
    return field(default=False, metadata={"says": says})


@dataclass(frozen=True)
class MjcfRules:
    """What an engine does differently from MuJoCo's documentation where it reads MJCF."""

    first_root_only: bool = _mistake("reads only the first <body> of the world")
    geoms_without_contact_weigh_nothing: bool = _mistake('gives no mass to geoms with contype="0" and conaffinity="0"')
    pose_of_first_fixed_body_dropped: bool = _mistake("drops the pose of the first body where it has no joint")
    mesh_weighs_one_kilogram: bool = _mistake(
        "gives each geom of type mesh, plane or hfield 1 kg and the inertia diag(1, 1, 1) kg m² at its pos"
    )
    inertial_without_inertia_is_unit: bool = _mistake("gives an <inertial> without inertia diag(1, 1, 1) kg m²")
    first_worldbody_again: bool = _mistake("reads the first <worldbody> again in place of each later one")
    default_joint_pos_dropped: bool = _mistake("ignores the pos of a joint that comes from a default class")
    default_geom_mass_dropped: bool = _mistake("ignores the mass of a geom that comes from a default class")
    default_geom_pose_dropped: bool = _mistake("ignores the pose of a geom that comes from a default class")
    childclass_behind_class: bool = _mistake("puts the childclass behind an element's own class")
    total_mass_ignored: bool = _mistake("ignores settotalmass")
    inertia_group_ignored: bool = _mistake("ignores inertiagrouprange: geoms of every group weigh")
    balance_inertia_ignored: bool = _mistake("ignores balanceinertia")
    bound_inertia_on_given_axes: bool = _mistake(
        "applies boundmass and boundinertia to <inertial> alone, and to its diagonal as it is written"
    )
    bound_ignored: bool = _mistake("ignores boundmass and boundinertia")
    upper_euler_as_lower: bool = _mistake("reads upper-case letters of eulerseq (fixed axes) as lower-case ones")
    axis_not_normalised: bool = _mistake(
        "takes the axis of axisangle as it is written, not of length one, and turns by a matrix that is no rotation"
    )
    include_not_followed: bool = _mistake("does not follow <include>")
    late_sections_ignored: bool = _mistake("ignores <default> and <compiler> after <worldbody>")
    later_sections_ignored: bool = _mistake("reads only the first of several <compiler> or <default>")
    bare_bodies_lost: bool = _mistake(
        "loses a <body> without any attribute, with its joints, and hangs its children in the world"
    )
    unnamed_sibling_twice: bool = _mistake(
        "reads the first of several unnamed sibling bodies again in place of each other one"
    )
    first_ref_ignored: bool = _mistake("ignores ref of the first of several joints of a body")
    gravity_not_read: bool = _mistake("does not read gravity: 9.81 m/s² along −z, whatever the file says")
    gravity_flag_ignored: bool = _mistake('does not read <flag gravity="disable"/>: gravity acts')
    damping_dropped_on_free_and_ball: bool = _mistake("drops damping and dry friction of free and ball joints")
    damping_dropped_on_free: bool = _mistake("drops damping of free joints")
    springdamper_ignored: bool = _mistake("ignores springdamper: joints have their own stiffness and damping")
    springs_not_held: bool = _mistake("has no joint springs")
    pos_of_last_joint_for_all: bool = _mistake(
        "applies the pose of a body with several joints at the last of them, not the first"
    )
    armature_needs_actuator: bool = _mistake("drops armature of joints without an actuator")
    nested_class_inherits_nothing: bool = _mistake(
        "has a nested default class inherit nothing for an element that the class does not mention itself"
    )
    frame_ignored: bool = _mistake("ignores <frame> and <replicate> and all that is inside")
    align_ignored: bool = _mistake("ignores align and alignfree: a free body keeps the frame that is written")
    attach_ignored: bool = _mistake("ignores <attach> and all that it stands for")


@dataclass(frozen=True)
class UrdfRules:
    """What an engine does differently from URDF's documentation where it reads URDF."""

    planar_axis_ignored: bool = _mistake("ignores the axis of planar joints: the plane is always that of x and y")
    damping_dropped_on_planar_and_floating: bool = _mistake("drops damping and friction of planar and floating joints")
    fixed_massless_inertia_dropped: bool = _mistake(
        "drops the inertia of a link without mass where it is fixed to another link (fusestatic)"
    )
    space_behind_number_rejected: bool = _mistake(
        "takes a number with a space or an end of line behind it for none, and leaves out the inertial from there on"
    )
    inertial_rotation_lost: bool = _mistake("drops the rotation of an inertial: <inertial><origin rpy=…/>")
    collision_weighs: bool = _mistake("gives links without <inertial> the mass of their collision geometry, 1000 kg/m³")
    extension_honoured: bool = _mistake("does what MuJoCo's own <mujoco> in the file says")
    impossible_inertia_becomes_sphere: bool = _mistake(
        "puts a solid sphere of 1000 kg/m³, of 1 kg if massless, for an inertial that no rigid body has"
    )
    drake_rotor_counted: bool = _mistake("adds the rotor inertias that Drake's own tags in <transmission> give")


@dataclass(frozen=True)
class Rules:
    """How both formats are read."""

    mjcf: MjcfRules = MjcfRules()
    urdf: UrdfRules = UrdfRules()


AS_DOCUMENTED = Rules()


def flags_of(rules: type[MjcfRules | UrdfRules]) -> dict[str, str]:
    """The flags of a format, by name, each with the sentence that says what such an engine does."""
    return {flag.name: flag.metadata["says"] for flag in fields(rules)}


def with_mjcf(*flags: str) -> Rules:
    """MJCF read with these mistakes. Raises TypeError for a name that is no flag."""
    return replace(AS_DOCUMENTED, mjcf=MjcfRules(**dict.fromkeys(flags, True)))


def with_urdf(*flags: str) -> Rules:
    """URDF read with these mistakes. Raises TypeError for a name that is no flag."""
    return replace(AS_DOCUMENTED, urdf=UrdfRules(**dict.fromkeys(flags, True)))


def mistakes_in(language: str) -> dict[str, str]:
    """The flags of ``mjcf`` or ``urdf``, by name, with their sentences."""
    return flags_of(MjcfRules if language == "mjcf" else UrdfRules)


def with_mistakes(language: str, flags: Iterable[str]) -> Rules:
    """``mjcf`` or ``urdf`` read with these mistakes."""
    return with_mjcf(*flags) if language == "mjcf" else with_urdf(*flags)
