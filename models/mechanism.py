"""A planar tree of hinges as a model file has it: the links, and all that a real hinge has and an ideal one has not.

Link frames are those of :mod:`furiko.models.tree`, chosen so that in the file's reference configuration every absolute
angle is zero: *down* is the direction of gravity in the plane, and *across* lies so that positive angles lead to it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .errors import InvalidInput
from .spatial import HERE, NOTHING, Inertial, Pose
from .tree import SUPPORT, Link, PlanarTree

Array = NDArray[np.float64]

MOST_LINKS = 1_000
MOST_BODIES = 2_000  # those that are fixed to others included
# Axes this far from parallel [rad] still make a planar mechanism: files print axes with six digits or more. Engines are
# then held to no more than that; below, it is rounding.
PARALLEL = 2e-6
ROUNDING = 2.0**-49
FAR_APART = 8  # links that lie further apart along the axes than so many times their size blur each other by rounding
LARGEST = 1e9  # of any number of a link: engines give up beyond (MuJoCo at rates of 1e10)
NO_STOP = 1e3  # a limit further away [rad] is one that nothing reaches


@dataclass(frozen=True)
class Hinge:
    """What a hinge has besides its place, in the sense of the planar relative angle φ = θ − θ of the parent [rad].

    Its torque on the link [N m] is −damping·φ̇ − stiffness·(φ − rest) − friction·sign(φ̇), and −armature·φ̈ [kg m²].
    ``stops``: lowest and highest φ, or None. The file's own coordinate is ``sense``·φ + ``zero``.
    """

    name: str = ""
    armature: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    stops: tuple[float, float] | None = None
    sense: float = 1.0
    zero: float = 0.0

    @property
    def ideal(self) -> bool:
        """Whether it turns freely, as the documents' hinges do."""
        passive = (self.armature, self.damping, self.friction, self.stiffness)
        return not any(passive) and self.stops is None


@dataclass(frozen=True)
class Mechanism:
    """Links and their hinges, and gravity (along, across) of the plane [m/s²].

    ``gravity_vector``: gravity in the file's world; ``down`` and ``across``: the plane's axes there, (3,).
    ``link_names``: as the file has them. ``tilt``: how much not being quite planar may change a torque, relative to it:
    the hinges' axes' largest angle with each other, times how far the links lie apart along them over their size.
    """

    links: tuple[Link, ...]
    hinges: tuple[Hinge, ...]
    gravity: tuple[float, float]
    link_names: tuple[str, ...]
    gravity_vector: tuple[float, ...] = (0.0, 0.0, 0.0)
    down: tuple[float, ...] = (0.0, 0.0, -1.0)
    across: tuple[float, ...] = (1.0, 0.0, 0.0)
    tilt: float = 0.0

    @property
    def n(self) -> int:
        """Number of links, and of angles."""
        return len(self.links)

    @property
    def parents(self) -> tuple[int, ...]:
        """Parent of each link."""
        return tuple(link.parent for link in self.links)

    def ideal(self) -> Mechanism:
        """The same links on free hinges."""
        free = tuple(Hinge(name=h.name, sense=h.sense, zero=h.zero) for h in self.hinges)
        return replace(self, hinges=free)

    def tree(self) -> PlanarTree:
        """The links alone; gravity is along *down*, or this raises ValueError."""
        along, across = self.gravity
        if across != 0 or along < 0:
            raise ValueError("gravity is not along the frame's first axis")
        return PlanarTree(self.links, along)


def mechanism_of(tree: PlanarTree) -> Mechanism:
    """A planar tree of free hinges, named as furiko's own model files name them."""
    hinges = tuple(Hinge(name=name) for name in tree.names("hinge"))
    vector = (0.0, 0.0, -tree.gravity)
    return Mechanism(tree.links, hinges, (tree.gravity, 0.0), tree.names("link"), vector)


@dataclass(frozen=True)
class SpatialHinge:
    """A hinge of a body in space: axis and a point on it in the body's own frame, and what :class:`Hinge` has, in its
    own sense (the file's coordinate less its value in the reference configuration)."""

    name: str
    axis: Array
    anchor: Array
    armature: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    stops: tuple[float, float] | None = None
    zero: float = 0.0
    where: str = ""


@dataclass(frozen=True)
class Body:
    """A body in space: what carries it (index, or -1 for the world), its pose there in the reference configuration,
    the hinges between them (none: it is fixed), and its inertial in its own frame."""

    name: str
    parent: int
    pose: Pose
    hinges: tuple[SpatialHinge, ...] = ()
    inertial: Inertial = NOTHING
    where: str = ""


@dataclass(frozen=True)
class Plane:
    """The plane of motion in the world: unit vectors *down*, *across* and the hinges' common *axis*."""

    down: Array
    across: Array
    axis: Array

    def point(self, p: Array) -> tuple[float, float]:
        """(along, across) of a point or vector."""
        return float(p @ self.down), float(p @ self.across)


@dataclass
class _Merged:
    """A link in the making: everything fixed together between two generations of hinges. In world axes: ``anchor``,
    its hinge from its carrier's; ``inertial``, from its own."""

    parent: int
    anchor: Array
    hinge: SpatialHinge
    axis: Array
    name: str
    inertial: Inertial = field(default_factory=lambda: NOTHING)


def planar_mechanism(bodies: Sequence[Body], gravity: Array, plane: Plane | None = None) -> Mechanism:
    """The planar tree of hinges that these bodies are, what is fixed together fused into one link.

    ``gravity`` (3,) [m/s²]. ``plane`` is found where it is not given. Raises :class:`InvalidInput` naming the joint
    that is not parallel to the others, or the link that nothing gives an inertia.
    """
    merged = _merge(bodies)
    if not merged:
        raise InvalidInput("no hinge in it: at least one body must hang on a hinge")
    if len(merged) > MOST_LINKS:
        raise InvalidInput(f"{len(merged)} hinges; at most {MOST_LINKS} are taken")
    if plane is None:
        plane = find_plane(merged[0].axis, gravity, merged)
    links, hinges = [], []
    for link in merged:
        links.append(_link(link, plane))
        hinges.append(_hinge(link, plane))
    for planar, hinge, made in zip(links, hinges, merged, strict=True):
        _refuse_immense(planar, hinge, made)
    _refuse_weightless(links, [link.name for link in merged])
    along, across = plane.point(gravity)
    if abs(across) <= 4e-16 * abs(along):
        across = 0.0
    return Mechanism(
        tilt=_tilt(merged, plane),
        links=tuple(links),
        hinges=tuple(hinges),
        gravity=(along, across),
        link_names=tuple(link.name for link in merged),
        gravity_vector=tuple(map(float, gravity)),
        down=tuple(map(float, plane.down)),
        across=tuple(map(float, plane.across)),
    )


def _merge(bodies: Sequence[Body]) -> list[_Merged]:
    """Links in the bodies' order, in world axes; what is fixed to the world is left out.

    Points are counted from the hinge of the link that they are on, never from the world's origin: so no digits are lost
    far from it, and what was written exactly is read exactly.
    """
    merged: list[_Merged] = []
    poses: list[Pose] = []
    link_of_body: list[int] = []
    for body in bodies:
        carrier, carrying = (poses[body.parent], link_of_body[body.parent]) if body.parent >= 0 else (HERE, SUPPORT)
        pose = carrier @ body.pose
        for hinge in body.hinges:
            axis = pose.turn @ hinge.axis
            arm = pose.turn @ hinge.anchor
            merged.append(_Merged(carrying, pose.shift + arm, hinge, axis / np.linalg.norm(axis), body.name))
            carrying = len(merged) - 1
            pose = Pose(pose.turn, -arm)
        poses.append(pose)
        link_of_body.append(carrying)
        if carrying != SUPPORT:
            merged[carrying].inertial = merged[carrying].inertial + body.inertial.seen_from(pose)
    return merged


def find_plane(axis: Array, gravity: Array, merged: Sequence[_Merged] = ()) -> Plane:
    """The plane across ``axis``, its down along gravity, seen so that the axis points to −y rather than to +y.

    That is how furiko writes its own files (axis (0, −1, 0)), so that what looks the same has the same signs. Without
    gravity in the plane, down is the world's, or where the first hinge is across that, towards the first centre.
    """
    seen_from = axis if _first_sign((-axis[1], axis[0], axis[2])) >= 0 else -axis
    candidates = (gravity, np.array([0.0, 0.0, -1.0]), *(m.inertial.centre for m in merged))
    for candidate in candidates:
        flat = _across_axis(candidate, seen_from)
        if flat is not None:
            break
    else:
        flat = np.eye(3)[0] - seen_from[0] * seen_from
    down = flat / np.linalg.norm(flat)
    down = np.where(np.abs(down) < 4e-16, 0.0, down)
    return Plane(down, np.cross(seen_from, down), seen_from)


def _across_axis(vector: Array, axis: Array) -> Array | None:
    """The part of a vector across a unit ``axis``; None where nothing but rounding is left of it."""
    across = np.asarray(vector - (vector @ axis) * axis)
    return across if np.linalg.norm(across) > 1e-9 * max(float(np.linalg.norm(vector)), 1e-300) else None


def _first_sign(values: Sequence[float]) -> float:
    return next((math.copysign(1.0, value) for value in values if abs(value) > 1e-9), 1.0)


def _link(merged: _Merged, plane: Plane) -> Link:
    inertial = merged.inertial
    com = plane.point(inertial.centre) if inertial.mass or inertial.tensor.any() else (0.0, 0.0)
    return Link(
        parent=merged.parent,
        hinge=plane.point(merged.anchor),
        length=2 * math.hypot(*com),
        com=com,
        mass=inertial.mass,
        inertia=max(float(plane.axis @ inertial.tensor @ plane.axis), 0.0),
    )


def _hinge(merged: _Merged, plane: Plane) -> Hinge:
    given = merged.hinge
    parallel = float(merged.axis @ plane.axis)
    if np.linalg.norm(np.cross(merged.axis, plane.axis)) > PARALLEL:
        angle = math.degrees(math.acos(min(1.0, abs(parallel))))
        raise InvalidInput(
            f"{given.where or given.name}: not a planar mechanism: the axis of joint {given.name!r} is turned by "
            f"{angle:.3g}° from the first joint's; all hinges must be parallel"
        )
    sense = math.copysign(1.0, parallel)
    stops = None
    if given.stops is not None and min(map(abs, given.stops)) < NO_STOP:
        low, high = sorted(sense * stop for stop in given.stops)
        stops = (low, high)
    return Hinge(
        name=given.name,
        armature=given.armature,
        damping=given.damping,
        friction=given.friction,
        stiffness=given.stiffness,
        rest=sense * given.rest,
        stops=stops,
        sense=sense,
        zero=given.zero,
    )


def _tilt(merged: Sequence[_Merged], plane: Plane) -> float:
    largest = max(float(np.linalg.norm(np.cross(link.axis, plane.axis))) for link in merged)
    arms = [arm for link in merged for arm in (link.anchor, link.inertial.centre)]
    size = max(math.hypot(*plane.point(arm)) for arm in arms) or 1.0
    apart = sum(abs(float(arm @ plane.axis)) for arm in arms) / size
    if largest <= ROUNDING:
        return 2.0**-52 * apart if apart > FAR_APART else 0.0
    return largest * (1 + apart)


def _refuse_immense(link: Link, hinge: Hinge, merged: _Merged) -> None:
    numbers = {
        "a length [m]": max(map(abs, (*link.hinge, *link.com))),
        "its mass [kg]": link.mass,
        "its inertia [kg m²]": link.inertia,
        "a number of its hinge": max(hinge.armature, hinge.damping, hinge.friction, hinge.stiffness),
    }
    for name, value in numbers.items():
        if value > LARGEST:
            where = merged.hinge.where or merged.name
            raise InvalidInput(f"{where}: link {merged.name!r}: {name} is {value:g}; at most {LARGEST:g} is taken")


def _refuse_weightless(links: Sequence[Link], names: Sequence[str]) -> None:
    """A link on a hinge must resist it: by its own inertia about it, or by what it carries."""
    resisting = [link.inertia > 0 or (link.mass > 0 and any(link.com)) for link in links]
    for i in range(len(links) - 1, -1, -1):
        if not resisting[i]:
            raise InvalidInput(
                f"link {names[i]!r}: neither it nor anything it carries has an inertia about its hinge, so that its "
                "acceleration is not determined; give it a mass away from the hinge, or an inertia"
            )
        if links[i].parent != SUPPORT and any(links[i].hinge):
            resisting[links[i].parent] = True
