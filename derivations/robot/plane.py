"""A mechanism that moves in one plane, as an author draws it: x to the right, y upwards, angles counter-clockwise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.spatial import ZERO_INERTIAL, Inertial, Pose, from_quaternion, symmetric
from ...models.trees.system import TreeJoint, TreeLink, TreeSystem

Array = NDArray[np.float64]
PARALLEL = 1e-9  # files print axes and quaternions with so many digits or more, or are not meant to be planar


@dataclass(frozen=True)
class PlaneBody:
    """What one joint moves first, in the reference configuration; all that is fixed to a link is counted to it.

    ``parent``: index of the joint before it, -1 for the world; ``sense``: 1 where a hinge's positive rate turns
    counter-clockwise; ``slide``: the direction of a slide, (0, 0) for a hinge. ``anchor``, ``centre``: of the joint and
    of mass [m], in the plane; ``inertia`` about the centre [kg m²].
    """

    link: str
    joint: TreeJoint
    parent: int
    sense: int
    slide: tuple[float, float]
    anchor: tuple[float, float]
    mass: float
    centre: tuple[float, float]
    inertia: float

    @property
    def turns(self) -> bool:
        """Whether it is on a hinge."""
        return self.joint.kind == "hinge"


@dataclass(frozen=True)
class Plane:
    """``bodies``, one a joint, in the joints' order; ``gravity`` [m/s²], downwards."""

    bodies: tuple[PlaneBody, ...]
    gravity: float

    def hinges(self, k: int) -> tuple[int, ...]:
        """The hinges on the way to body k, itself included."""
        path: list[int] = []
        while k >= 0:
            if self.bodies[k].turns:
                path.insert(0, k)
            k = self.bodies[k].parent
        return tuple(path)

    def children(self, k: int) -> list[PlaneBody]:
        """The bodies that it carries."""
        return [body for body in self.bodies if body.parent == k]

    def reaches(self, k: int) -> tuple[float, float] | None:
        """From its joint to the one it carries, or to its centre of mass, or along the slide on it; None if not known.

        A vector whose direction is that of the body in the reference configuration.
        """
        own = self.bodies[k]
        ends = [body.anchor for body in self.children(k) if body.turns] or [own.centre if own.mass else own.anchor]
        ways = [(x - own.anchor[0], y - own.anchor[1]) for x, y in ends]
        away = [way for way in ways if math.hypot(*way) > PARALLEL]
        away = away or [body.slide for body in self.children(k) if not body.turns]
        if not away or any(math.dist(way, away[0]) > PARALLEL * math.hypot(*way) for way in away[1:]):
            return None
        return away[0]

    def angle(self, k: int) -> float:
        """Of a body on a hinge, from the downward vertical [rad], in the reference configuration."""
        way = self.reaches(k)
        if way is None:
            raise InvalidInput(f"the direction of {self.bodies[k].link!r} is not known: nothing of it is away from its "
                               "joint; leave out angles, from and sense, and use the joint's coordinate")  # fmt: skip
        return math.atan2(way[0], -way[1])


def plane_of(system: TreeSystem) -> Plane:
    """The mechanism in its plane. Raises :class:`InvalidInput` with the reason where it has none."""
    if any(joint.kind not in ("hinge", "slide") for joint in system.joints):
        raise InvalidInput("a ball or a free joint moves it out of a plane")
    poses = _poses(system)
    joints = [(i, joint) for i, link in enumerate(system.links) for joint in link.joints]
    axes = [_unit(poses[i].rotation @ np.array(joint.axis)) for i, joint in joints]
    right, up = _directions(system, axes)
    normal = np.cross(right, up)
    seen = np.array([right, up])
    bodies: list[PlaneBody] = []
    last: dict[int, int] = {}  # of a link: the joint that moves it last
    for k, (i, joint) in enumerate(joints):
        link = system.links[i]
        before = link.joints[link.joints.index(joint) - 1] if joint is not link.joints[0] else None
        parent = k - 1 if before is not None else _moved_by(system, link.parent, last)
        final = joint is link.joints[-1]
        last[i] = k
        mass, centre, inertia = _inertial(system, i, poses, seen, normal) if final else (0.0, (0.0, 0.0), 0.0)
        hinge = joint.kind == "hinge"
        sense = (1 if axes[k] @ normal > 0 else -1) if hinge else 1
        slide = (0.0, 0.0) if hinge else _pair(seen @ axes[k])
        anchor = _pair(seen @ poses[i].point(np.array(joint.anchor)))
        bodies.append(PlaneBody(link.name, joint, parent, sense, slide, anchor, mass, centre, inertia))
    return Plane(tuple(bodies), math.hypot(*system.gravity))


def _directions(system: TreeSystem, axes: list[Array]) -> tuple[Array, Array]:
    """Right and up in the world. Right is +x where that is in the plane, else +y."""
    gravity = np.array(system.gravity)
    up = _unit(-gravity) if any(system.gravity) else np.array([0.0, 0.0, 1.0])
    hinges = [axis for axis, joint in zip(axes, system.joints, strict=True) if joint.kind == "hinge"]
    slides = [axis for axis, joint in zip(axes, system.joints, strict=True) if joint.kind == "slide"]
    if hinges:
        normal = hinges[0]
    else:
        across = next((axis for axis in slides if np.linalg.norm(np.cross(axis, up)) > PARALLEL), np.array([1.0, 0, 0]))
        normal = _unit(np.cross(across, up))
    if any(np.linalg.norm(np.cross(axis, normal)) > PARALLEL for axis in hinges):
        raise InvalidInput("its hinges' axes are not parallel")
    if abs(normal @ up) > PARALLEL:
        raise InvalidInput("gravity is not in the plane in which its hinges turn")
    if any(abs(axis @ normal) > PARALLEL for axis in slides):
        raise InvalidInput("a slide leads out of the plane in which its hinges turn")
    right = np.cross(up, normal)
    first = next(x for x in right if abs(x) > PARALLEL)
    return (right if first > 0 else -right), up


def _moved_by(system: TreeSystem, link: int, last: dict[int, int]) -> int:
    while link >= 0:
        if link in last:
            return last[link]
        link = system.links[link].parent
    return -1


def _inertial(
    system: TreeSystem, index: int, poses: list[Pose], seen: Array, normal: Array
) -> tuple[float, tuple[float, float], float]:
    """Mass, centre and moment of inertia of a link and all that is fixed to it."""
    parts = [(i, link) for i, link in enumerate(system.links) if link.mass and _carrier(system, i) == index]
    if not parts:
        return 0.0, (0.0, 0.0), 0.0
    whole = sum((_of_link(link).transformed(poses[i]) for i, link in parts), ZERO_INERTIAL)
    return whole.mass, _pair(seen @ whole.centre), float(normal @ whole.tensor @ normal)


def _of_link(link: TreeLink) -> Inertial:
    return Inertial(link.mass, np.array(link.centre), symmetric(*link.inertia))


def _carrier(system: TreeSystem, i: int) -> int:
    """The link with a joint that carries link i, itself if it has one."""
    while i >= 0 and not system.links[i].joints:
        i = system.links[i].parent
    return i


def _poses(system: TreeSystem) -> list[Pose]:
    """Of each link in the world, in the reference configuration."""
    found: list[Pose] = []
    for link in system.links:
        own = Pose(from_quaternion(link.quaternion), np.array(link.position))
        found.append(found[link.parent] @ own if link.parent >= 0 else own)
    return found


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))


def _pair(vector: Array) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])
