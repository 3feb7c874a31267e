"""URDF's joints: fixed, revolute, continuous, prismatic, planar, floating, and MuJoCo's spherical."""

from __future__ import annotations

import numpy as np

from ...spatial import from_quaternion
from ...spatial_mechanism import Joint
from ..attributes import Array, axis, not_negative, number, numbers, word
from ..placement import Placement, by_euler, to_z_axis
from ..rules import UrdfRules
from ..xml_file import Element
from .notes import Notes

KINDS = ("revolute", "continuous", "fixed", "prismatic", "floating", "planar", "spherical")
LARGEST_ANGLE = 1e6  # rad, of a rotation; beyond, degrees or worse are meant
NO_LIMITS = "a revolute or prismatic joint without <limit>: URDF asks for one; it is read as without limits"
TURNED = "its limits are the wrong way round: they are left out"
UNDEFINED = "URDF does not define damping and friction of such a joint: they are read as of each of its freedoms"


def placement(element: Element) -> Placement:
    """The ``<origin>`` in an element. Raises :class:`InvalidInput`."""
    origin = element.first("origin") or Element("origin", {})
    angles = numbers(origin, "rpy", 3, (0.0, 0.0, 0.0))
    if (np.abs(angles) > LARGEST_ANGLE).any():
        raise origin.wrong(f"rpy={origin.get('rpy')[:60]!r}: angles in radians are needed")
    return Placement(numbers(origin, "xyz", 3, (0.0, 0.0, 0.0)), by_euler(angles, "XYZ"))


def kind_of(joint: Element) -> str:
    """The joint's type. Raises :class:`InvalidInput`."""
    return word(joint, "type", KINDS, "")


def read_joints(joint: Element, rules: UrdfRules, notes: Notes, armature: float = 0.0) -> tuple[Joint, ...]:
    """What a ``<joint>`` lets its child do; none for a fixed one. Raises :class:`InvalidInput`.

    ``armature`` [kg m² or kg] comes from elsewhere: URDF has none.

    A planar joint is two slides, ``NAME_TX`` and ``NAME_TY``, and the hinge ``NAME_RZ`` about its axis: as MuJoCo has
    it, whose names these are. The slides' axes are x and y turned by the smallest rotation that takes z to the axis.
    """
    kind = kind_of(joint)
    if kind == "fixed":
        return ()
    dynamics = joint.first("dynamics") or Element("dynamics", {})
    name, where = joint.get("name"), str(joint)
    if kind == "planar":
        return _planar(joint, dynamics, rules, notes)
    damping, friction = not_negative(dynamics, "damping"), not_negative(dynamics, "friction")
    if kind == "floating":
        if damping or friction:
            notes.add(UNDEFINED, joint)
        if rules.damping_dropped_on_planar_and_floating:
            damping = friction = 0.0
        return (Joint(name, "free", damping=damping, friction=friction, where=where),)
    if kind == "spherical":
        notes.add("a spherical joint is MuJoCo's own: other engines refuse the file", joint)
        return (Joint(name, "ball", damping=damping, friction=friction, where=where),)
    return (
        Joint(
            name,
            "slide" if kind == "prismatic" else "hinge",
            axis=_axis(joint),
            armature=armature,
            damping=damping,
            friction=friction,
            limits=None if kind == "continuous" else _limits(joint, notes),
            where=where,
        ),
    )


def rotor_inertias(root: Element) -> dict[str, float]:
    """By joint, the rotor inertia that Drake's own tags give it [kg m²], seen through its gear."""
    found: dict[str, float] = {}
    for transmission in root.all("transmission"):
        for joint in transmission.all("joint"):
            for actuator in transmission.all("actuator"):
                rotor = number(actuator.first("drake:rotor_inertia") or Element("", {}), "value", 0.0)
                gear = number(actuator.first("drake:gear_ratio") or Element("", {}), "value", 1.0)
                found[joint.get("name")] = found.get(joint.get("name"), 0.0) + rotor * gear * gear
    return found


def _axis(joint: Element) -> Array:
    given = joint.first("axis") or Element("axis", {})
    return axis(given, "xyz", (1.0, 0.0, 0.0))


def _planar(joint: Element, dynamics: Element, rules: UrdfRules, notes: Notes) -> tuple[Joint, ...]:
    turned = from_quaternion(to_z_axis(np.array([0.0, 0.0, 1.0]) if rules.planar_axis_ignored else _axis(joint)))
    resistances = []
    for number_name in ("damping", "friction"):
        values = numbers(dynamics, number_name, (1, 3), (0.0,))
        if len(values) == 2 or (values < 0).any():
            raise dynamics.wrong(f"{number_name}: one number or three, not negative, are needed")
        if values.any():
            notes.add(UNDEFINED, joint)
        values = np.broadcast_to(values, 3)
        resistances.append(np.zeros(3) if rules.damping_dropped_on_planar_and_floating else values)
    kinds = (("TX", "slide"), ("TY", "slide"), ("RZ", "hinge"))
    return tuple(
        Joint(
            f"{joint.get('name')}_{ending}",
            kind,
            axis=turned[:, k],
            damping=float(resistances[0][k]),
            friction=float(resistances[1][k]),
            where=str(joint),
        )
        for k, (ending, kind) in enumerate(kinds)
    )


def _limits(joint: Element, notes: Notes) -> tuple[float, float] | None:
    limit = joint.first("limit")
    if limit is None:
        notes.add(NO_LIMITS, joint)
        return None
    low, high = number(limit, "lower"), number(limit, "upper")
    if low > high:
        notes.add(TURNED, joint)
        return None
    return low, high
