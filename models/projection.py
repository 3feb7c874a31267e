"""The planar mechanism that a mechanism in space is: bodies fixed together become one link, and hinges get signs.

Every model file and every compiled model is read as a mechanism in space, and projected here, by one rule, so that the
same mechanism has the same angles wherever it comes from.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import InvalidInput
from .mechanism import Hinge, Mechanism
from .spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose
from .spatial_mechanism import Joint, SpatialMechanism
from .tree import SUPPORT, Link

Array = NDArray[np.float64]

MOST_LINKS = 1_000
MOST_BODIES = 2_000  # bodies that are fixed to others included
# Axes this far from parallel [rad] still make a planar mechanism: files print axes with six digits or more. Engines are
# then held to no more than that; below ROUNDING, it is rounding.
PARALLEL = 2e-6
ROUNDING = 2.0**-49
LARGEST_OFFSET = 8  # sum of the links' offsets along the axes, over their size: beyond it, their rounding counts
ROUNDINGS_OF_AN_AXIS = (
    16  # of each component, through some rotations: a matrix of a quaternion has four, its product two
)
LARGEST = 1e9  # of any number of a link: engines fail beyond (MuJoCo at rates of 1e10)
UNREACHED = 1e3  # rad; limits further away than this on both sides are taken for none


@dataclass(frozen=True)
class Plane:
    """The plane of motion in the world: unit vectors (3,) ``down``, ``across`` and the hinges' common ``axis``."""

    down: Array
    across: Array
    axis: Array

    def point(self, p: Array) -> tuple[float, float]:
        """(along, across) of a point or vector (3,)."""
        return float(p @ self.down), float(p @ self.across)


@dataclass
class _SpatialLink:
    """A link before it is projected: all bodies fixed together. In world axes: ``anchor``, its hinge as seen from its
    parent's hinge; ``axis``; ``inertial``, as seen from its own hinge."""

    parent: int
    anchor: Array
    hinge: Joint
    axis: Array
    name: str
    inertial: Inertial = ZERO_INERTIAL


def planar_mechanism(mechanism: SpatialMechanism, plane: Plane | None = None) -> Mechanism:
    """The planar mechanism that ``mechanism`` is; bodies fixed together are one link.

    ``plane``: found by :func:`find_plane` where it is not given. Raises :class:`InvalidInput` naming the joint that is
    no hinge or not parallel to the others, or the link without any inertia.
    """
    found, gravity = _fused(mechanism), mechanism.gravity
    if not found:
        raise InvalidInput("no hinge: at least one body must be on a hinge")
    if len(found) > MOST_LINKS:
        raise InvalidInput(f"{len(found)} hinges; at most {MOST_LINKS} are taken")
    if plane is None:
        plane = find_plane(found[0].axis, gravity, found)
    links, hinges = [], []
    for link in found:
        links.append(_link(link, plane))
        hinges.append(_hinge(link, plane))
    for planar, hinge, link in zip(links, hinges, found, strict=True):
        _refuse_immense(planar, hinge, link)
    _refuse_weightless(links, [link.name for link in found])
    along, across = plane.point(gravity)
    if abs(across) <= 4e-16 * abs(along):
        across = 0.0
    return Mechanism(
        tilt=max(_tilt(found, plane), _steepness(gravity, plane)),
        links=tuple(links),
        hinges=tuple(hinges),
        gravity=(along, across),
        link_names=tuple(link.name for link in found),
        gravity_vector=tuple(map(float, gravity)),
        down=tuple(map(float, plane.down)),
        across=tuple(map(float, plane.across)),
    )


def _fused(mechanism: SpatialMechanism) -> list[_SpatialLink]:
    """Links in the bodies' order, in world axes; bodies fixed to the world are left out.

    Points are relative to the hinge of their link, never to the world's origin: so no digits are lost far from it, and
    numbers that were written exactly are read exactly.
    """
    found: list[_SpatialLink] = []
    poses: list[Pose] = []
    link_of_body: list[int] = []
    for body in mechanism.bodies:
        parent_pose, link = (poses[body.parent], link_of_body[body.parent]) if body.parent >= 0 else (IDENTITY, SUPPORT)
        pose = parent_pose @ body.pose
        for hinge in body.joints:
            if hinge.kind != "hinge":
                raise InvalidInput(f"{hinge.where}: a joint of type {hinge.kind!r}: not a planar tree of hinges")
            axis = pose.rotation @ hinge.axis
            arm = pose.rotation @ hinge.anchor
            found.append(_SpatialLink(link, pose.translation + arm, hinge, axis / np.linalg.norm(axis), body.name))
            link = len(found) - 1
            pose = Pose(pose.rotation, -arm)
        poses.append(pose)
        link_of_body.append(link)
        if link != SUPPORT:
            found[link].inertial = found[link].inertial + body.inertial.transformed(pose)
    return found


def find_plane(axis: Array, gravity: Array, links: Sequence[_SpatialLink] = ()) -> Plane:
    """The plane across ``axis`` (3,), with *down* along ``gravity`` (3,) and an axis that points to −y rather than +y.

    That is how furiko writes its own files (axis (0, −1, 0)), so that mechanisms that look the same have the same
    signs. Without gravity in the plane, down is that of the world (−z), else towards the first link's centre of mass
    that is not on the axis.
    """
    normal = axis if _first_sign((-axis[1], axis[0], axis[2])) >= 0 else -axis
    candidates = (gravity, np.array([0.0, 0.0, -1.0]), *(link.inertial.centre for link in links))
    for candidate in candidates:
        flat = _across_axis(candidate, normal)
        if flat is not None:
            break
    else:
        flat = np.eye(3)[0] - normal[0] * normal
    down = flat / np.linalg.norm(flat)
    down = np.where(np.abs(down) < 4e-16, 0.0, down)
    return Plane(down, np.cross(normal, down), normal)


def _across_axis(vector: Array, axis: Array) -> Array | None:
    """The part of a vector across a unit ``axis``; None where nothing but rounding is left of it.

    What is left along the axis of a small part is taken off once more, so that it is across to rounding.
    """
    across = np.asarray(vector - (vector @ axis) * axis)
    if not np.linalg.norm(across) > 1e-9 * max(float(np.linalg.norm(vector)), 1e-300):
        return None
    return np.asarray(across - (across @ axis) * axis)


def _first_sign(values: Sequence[float]) -> float:
    return next((math.copysign(1.0, value) for value in values if abs(value) > 1e-9), 1.0)


def _link(link: _SpatialLink, plane: Plane) -> Link:
    inertial = link.inertial
    com = plane.point(inertial.centre) if inertial.mass or inertial.tensor.any() else (0.0, 0.0)
    moment = float(plane.axis @ inertial.tensor @ plane.axis)
    if inertial.mass < 0 or moment < -1e-12 * float(np.abs(inertial.tensor).max()):  # less is rounding
        raise InvalidInput(f"link {link.name!r}: a negative mass, or moment of inertia about its hinge")
    return Link(
        parent=link.parent,
        hinge=plane.point(link.anchor),
        length=2 * math.hypot(*com),
        com=com,
        mass=inertial.mass,
        inertia=max(moment, 0.0),
    )


def _hinge(link: _SpatialLink, plane: Plane) -> Hinge:
    given = link.hinge
    parallel = float(link.axis @ plane.axis)
    if np.linalg.norm(np.cross(link.axis, plane.axis)) > PARALLEL:
        angle = math.degrees(math.acos(min(1.0, abs(parallel))))
        raise InvalidInput(
            f"{given.where or given.name}: not a planar mechanism: the axis of joint {given.name!r} is turned by "
            f"{angle:.3g}° from the first joint's; all hinges must be parallel"
        )
    sense = math.copysign(1.0, parallel)
    limits = None
    if given.limits is not None:
        turns = [limit - given.ref for limit in given.limits]
        if turns[0] > -UNREACHED or turns[1] < UNREACHED:
            low, high = sorted(sense * turn for turn in turns)
            limits = (low, high)
    return Hinge(
        name=given.name,
        armature=given.armature,
        damping=given.damping,
        friction=given.friction,
        stiffness=given.stiffness,
        rest=sense * (given.springref - given.ref),
        limits=limits,
        sense=sense,
        zero=given.ref,
    )


def _tilt(links: Sequence[_SpatialLink], plane: Plane) -> float:
    largest = max(float(np.linalg.norm(np.cross(link.axis, plane.axis))) for link in links)
    arms = [arm for link in links for arm in (link.anchor, link.inertial.centre)]
    size = max(math.hypot(*plane.point(arm)) for arm in arms) or 1.0
    offsets = sum(abs(float(arm @ plane.axis)) for arm in arms) / size
    if largest <= ROUNDING:
        return 2.0**-52 * offsets if offsets > LARGEST_OFFSET else 0.0
    return largest * (1 + offsets)


def _steepness(gravity: Array, plane: Plane) -> float:
    """What rounding does to gravity in the plane, relative to it, where almost all of it is along the hinges' axes."""
    in_plane, whole = math.hypot(*plane.point(gravity)), float(np.linalg.norm(gravity))
    if not 1e-9 * whole < in_plane * LARGEST_OFFSET < whole:
        return 0.0
    return ROUNDINGS_OF_AN_AXIS * 2.0**-52 * whole / in_plane


def _refuse_immense(link: Link, hinge: Hinge, given: _SpatialLink) -> None:
    numbers = {
        "a length [m]": max(map(abs, (*link.hinge, *link.com))),
        "its mass [kg]": link.mass,
        "its inertia [kg m²]": link.inertia,
        "a number of its hinge": max(hinge.armature, hinge.damping, hinge.friction, hinge.stiffness),
    }
    for name, value in numbers.items():
        if value > LARGEST:
            where = given.hinge.where or given.name
            raise InvalidInput(f"{where}: link {given.name!r}: {name} is {value:g}; at most {LARGEST:g} is taken")


def _refuse_weightless(links: Sequence[Link], names: Sequence[str]) -> None:
    """Refuse a hinge about which neither its link nor any link of the subtree has an inertia."""
    resisting = [link.inertia > 0 or (link.mass > 0 and any(link.com)) for link in links]
    for i in range(len(links) - 1, -1, -1):
        if not resisting[i]:
            raise InvalidInput(
                f"link {names[i]!r}: neither it nor its subtree has an inertia about its hinge, so that its "
                "acceleration is not determined; give it a mass away from the hinge, or an inertia"
            )
        if links[i].parent != SUPPORT and any(links[i].hinge):
            resisting[links[i].parent] = True
