"""A mechanism with its states, and what is done to the two: heavier, longer, faster, farther, in smaller units.

Every change takes a :class:`Posed` and the number of the axis. Factors are powers of two, so that a change of units is
exact as long as no number is subnormal: the truth then is the same, or the same times a power of two.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ....models.trees.system import COORDINATES, RATES, TreeJoint, TreeLink, TreeSystem, Vector

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Posed:
    """``system`` in the states ``q`` (B, nq), ``v`` (B, nv)."""

    system: TreeSystem
    q: Array
    v: Array


Change = Callable[[Posed, float], Posed]


def unchanged(posed: Posed, _: float) -> Posed:
    """The same."""
    return posed


def heavy_links(posed: Posed, factor: float) -> Posed:
    """Every second link, counted from the world, is heavier: light ones hang on heavy ones and carry them."""
    return _links(posed, _odd(posed.system), lambda link: weighing(link, factor))


def light_tips(posed: Posed, factor: float) -> Posed:
    """The last links are lighter, and with them the armature, damping and stiffness of their joints."""
    return _links(posed, _tips(posed.system), lambda link: _in_all(link, factor))


def long_links(posed: Posed, factor: float) -> Posed:
    """Every second link, counted from the world, is longer, its mass the same."""
    odd = _odd(posed.system)
    links = tuple(
        replace(
            _shaped(link, factor) if i in odd else link,
            position=_times(link.position, factor) if link.parent in odd else link.position,
        )
        for i, link in enumerate(posed.system.links)
    )
    return replace(posed, system=replace(posed.system, links=links))


def fast(posed: Posed, factor: float) -> Posed:
    """All rates are larger."""
    return replace(posed, v=posed.v * factor)


def many_turns(posed: Posed, angle: float) -> Posed:
    """Hinges count up to so many radians more, each another part of it."""
    q = posed.q.copy()
    for at_q, _, joint in placed(posed.system):
        if joint.kind == "hinge":
            q[:, at_q] += np.round(angle * np.cos(at_q + 1.0))
    return replace(posed, q=q)


def straight(posed: Posed, part: float) -> Posed:
    """Hinges and slides keep so much of their way from the reference configuration."""
    q, reference = posed.q.copy(), np.array(posed.system.reference)
    for at_q, _, joint in placed(posed.system):
        if COORDINATES[joint.kind] == 1:
            q[:, at_q] = reference[at_q] + part * (q[:, at_q] - reference[at_q])
    return replace(posed, q=q)


def far_base(posed: Posed, way: float) -> Posed:
    """What floats or slides on the world is farther away [m]."""
    q = posed.q.copy()
    for at_q, _, length in _bases(posed.system):
        q[:, at_q : at_q + length] += way * np.array([1.0, -0.5, 0.25])[:length]
    return replace(posed, q=q)


def fast_base(posed: Posed, speed: float) -> Posed:
    """What floats or slides on the world moves faster [m/s]."""
    v = posed.v.copy()
    for _, at_v, length in _bases(posed.system):
        v[:, at_v : at_v + length] += speed * np.array([0.5, 1.0, -0.25])[:length]
    return replace(posed, v=v)


def quaternion_lengths(posed: Posed, factor: float) -> Posed:
    """Quaternions of another length, which stand for the same rotation."""
    q = posed.q.copy()
    for columns in quaternions(posed.system):
        q[:, columns] *= factor
    return replace(posed, q=q)


def half_turns(posed: Posed, part: float) -> Posed:
    """Balls and free joints are near half a turn: their quaternions' first component is smaller."""
    q = posed.q.copy()
    for columns in quaternions(posed.system):
        q[:, columns.start] *= part
    return replace(posed, q=q)


def smaller_masses(posed: Posed, factor: float) -> Posed:
    """Another unit of mass: masses, moments, armature, damping and stiffness are smaller; accelerations the same."""
    return _links(posed, set(range(len(posed.system.links))), lambda link: _in_all(link, factor))


def smaller_lengths(posed: Posed, factor: float) -> Posed:
    """Another unit of length: all lengths, speeds and gravity are smaller; angular accelerations are the same."""

    def joint_of(joint: TreeJoint) -> TreeJoint:
        if joint.kind == "slide":
            return replace(joint, ref=joint.ref * factor, springref=joint.springref * factor)
        return _driven(joint, factor**2) if joint.kind != "free" else joint

    def smaller(link: TreeLink) -> TreeLink:
        joints = tuple(map(joint_of, _shaped_joints(link, factor)))
        return replace(_shaped(link, factor), position=_times(link.position, factor), joints=joints)

    q, v = posed.q.copy(), posed.v.copy()
    for at_q, at_v, joint in placed(posed.system):
        moved = {"slide": 1, "free": 3}.get(joint.kind, 0)
        q[:, at_q : at_q + moved] *= factor
        v[:, at_v : at_v + moved] *= factor
    system = replace(posed.system, links=tuple(map(smaller, posed.system.links)))
    return Posed(replace(system, gravity=_times(system.gravity, factor)), q, v)


def slower(posed: Posed, factor: float) -> Posed:
    """Another unit of time: rates and damping are smaller, gravity and stiffness by the square, as accelerations."""

    def softer(link: TreeLink) -> TreeLink:
        joints = tuple(
            replace(joint, damping=joint.damping * factor, stiffness=joint.stiffness * factor**2)
            for joint in link.joints
        )
        return replace(link, joints=joints)

    system = replace(posed.system, links=tuple(map(softer, posed.system.links)))
    return Posed(replace(system, gravity=_times(system.gravity, factor**2)), posed.q, posed.v * factor)


def near_gimbal_lock(posed: Posed, angle: float) -> Posed:
    """The second joint, a hinge, is so far from a right angle [rad]."""
    q = posed.q.copy()
    q[:, 1] = math.pi / 2 - angle
    return replace(posed, q=q)


def placed(system: TreeSystem) -> list[tuple[int, int, TreeJoint]]:
    """Each joint with its first column in q and in v."""
    found, at_q, at_v = [], 0, 0
    for joint in system.joints:
        found.append((at_q, at_v, joint))
        at_q += COORDINATES[joint.kind]
        at_v += RATES[joint.kind]
    return found


def quaternions(system: TreeSystem) -> list[slice]:
    """The columns of q that are quaternions."""
    ends = [(at_q + COORDINATES[joint.kind], joint) for at_q, _, joint in placed(system)]
    return [slice(end - 4, end) for end, joint in ends if joint.kind in ("ball", "free")]


def moves_on_the_world(system: TreeSystem) -> bool:
    """Whether something floats or slides there."""
    return bool(_bases(system))


def weighing(link: TreeLink, factor: float) -> TreeLink:
    """The link with so many times its mass, of the same shape."""
    return replace(link, mass=link.mass * factor, inertia=_times(link.inertia, factor))


def _in_all(link: TreeLink, factor: float) -> TreeLink:
    """The same, with so many times the armature, damping and stiffness of its joints, too."""
    return replace(weighing(link, factor), joints=tuple(_driven(joint, factor) for joint in link.joints))


def _bases(system: TreeSystem) -> list[tuple[int, int, int]]:
    """First columns in q and v of what moves along on the world, and how many they are."""
    names = {joint.name for link in system.links if link.parent == -1 for joint in link.joints}
    lengths = {"slide": 1, "free": 3}
    return [
        (at_q, at_v, lengths[joint.kind])
        for at_q, at_v, joint in placed(system)
        if joint.name in names and joint.kind in lengths
    ]


def _depths(system: TreeSystem) -> list[int]:
    """How many moving links lie between each link and the world; what is fixed counts as what it is fixed to."""
    found: list[int] = []
    for link in system.links:
        before = found[link.parent] if link.parent >= 0 else -1
        found.append(before + bool(link.joints))
    return found


def _odd(system: TreeSystem) -> set[int]:
    return {i for i, depth in enumerate(_depths(system)) if depth % 2}


def _tips(system: TreeSystem) -> set[int]:
    """Links that carry no moving one, and move."""
    carries: set[int] = set()
    for link in system.links:
        parent = link.parent
        while link.joints and parent >= 0:
            carries.add(parent)
            parent = system.links[parent].parent
    depths = _depths(system)
    return {i for i in range(len(system.links)) if i not in carries and depths[i] >= 0}


def _links(posed: Posed, which: set[int], change: Callable[[TreeLink], TreeLink]) -> Posed:
    links = tuple(change(link) if i in which else link for i, link in enumerate(posed.system.links))
    return replace(posed, system=replace(posed.system, links=links))


def _shaped(link: TreeLink, factor: float) -> TreeLink:
    """The link with all its own lengths multiplied, its mass the same."""
    return replace(
        link,
        centre=_times(link.centre, factor),
        inertia=_times(link.inertia, factor**2),
        joints=_shaped_joints(link, factor),
    )


def _shaped_joints(link: TreeLink, factor: float) -> tuple[TreeJoint, ...]:
    return tuple(replace(joint, anchor=_times(joint.anchor, factor)) for joint in link.joints)


def _driven(joint: TreeJoint, factor: float) -> TreeJoint:
    """The joint with so many times its armature, damping and stiffness."""
    return replace(
        joint,
        armature=joint.armature * factor,
        damping=joint.damping * factor,
        stiffness=joint.stiffness * factor,
    )


def _times(vector: Vector, factor: float) -> Vector:
    return tuple(x * factor for x in vector)
