"""An open mechanism in space: rigid bodies in a tree, the joints between them, and gravity.

Everything that moves in furiko is one of these: a robot read from a file, a cart-pole, and the documents' pendulums.

**Coordinates** are MuJoCo's, joint after joint in the bodies' order. A hinge has one angle [rad], a slide one length
[m]; a ball a quaternion (w, x, y, z), and as rates the angular velocity in the moved body's axes [rad/s]; a free joint
its body's place (3) [m] and quaternion (4) in the world, and as rates the velocity of that place in world axes [m/s],
then the angular velocity in the body's axes [rad/s]. Quaternions of any length but zero stand for the rotation of
their direction. Numbers of less precision than doubles (float32) are taken as the doubles that they are.

**Kinematics.** A body's frame is at ``position``, turned by ``quaternion``, in its parent's frame; then its joints move
it, in their order, each in the frame that the joints before it have moved: a slide by ``(q − ref)·axis``, a hinge by
``q − ref`` about ``axis`` through ``anchor``, a ball about ``anchor``. A body with a free joint is where its
coordinates say, whatever its ``position`` and ``quaternion``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .errors import InvalidInput
from .spatial import ZERO_INERTIAL, Inertial, Pose, doubles, from_quaternion, unit

Array = NDArray[np.float64]

WORLD = -1  # the parent of bodies that hang in the world
COORDINATES = {"hinge": 1, "slide": 1, "ball": 4, "free": 7}  # of each kind of joint
RATES = {"hinge": 1, "slide": 1, "ball": 3, "free": 6}  # degrees of freedom


def _point() -> Array:
    return np.zeros(3)


@dataclass(frozen=True, eq=False)
class Joint:
    """One joint. ``axis`` (3,), of any length but zero, and ``anchor`` (3,) [m] are in the body's own frame.

    ``ref``: the coordinate of a hinge [rad] or slide [m] in the reference configuration. Each degree of freedom has
    ``armature`` [kg m² or kg], which is added to the diagonal of the mass matrix, ``damping`` [N m s or N s/m],
    ``friction`` (dry) [N m or N]. ``stiffness`` [N m/rad or N/m] pulls towards ``springref``, its coordinate at
    rest; a ball's or free joint's spring is at rest in the reference configuration. ``limits``: lowest and highest
    coordinate, for a ball the largest angle as the second, or None. ``where``: its place in the file, for messages.
    """

    name: str
    kind: str = "hinge"
    axis: Array = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    anchor: Array = field(default_factory=_point)
    ref: float = 0.0
    armature: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    springref: float = 0.0
    limits: tuple[float, float] | None = None
    where: str = ""

    def __post_init__(self) -> None:
        doubles(self, "axis", "anchor", "ref", "armature", "damping", "friction", "stiffness", "springref")

    @property
    def coordinates(self) -> int:
        """How many numbers its position has."""
        return COORDINATES[self.kind]

    @property
    def freedoms(self) -> int:
        """How many degrees of freedom, and numbers its velocity has."""
        return RATES[self.kind]


@dataclass(frozen=True, eq=False)
class RigidBody:
    """A rigid body: the index of its ``parent`` (:data:`WORLD` for the world), its pose there, joints and inertial.

    ``position`` (3,) [m] and ``quaternion`` (4,) (w, x, y, z), of any length but zero: in the parent's frame, in the
    reference configuration. No joint: fixed to the parent. ``inertial``: in the body's own frame. ``where``: its place
    in the file, for messages. ``meshes`` [kg m²]: the largest moments of inertia of the meshes that it is weighed by,
    added up; engines that keep a mesh in its principal axes know these to so many digits only.
    """

    name: str
    parent: int
    position: Array = field(default_factory=_point)
    quaternion: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0, 0.0]))
    joints: tuple[Joint, ...] = ()
    inertial: Inertial = ZERO_INERTIAL
    where: str = ""
    meshes: float = 0.0

    def __post_init__(self) -> None:
        doubles(self, "position", "quaternion", "meshes")

    @property
    def pose(self) -> Pose:
        """Its frame in its parent's, in the reference configuration."""
        return Pose(from_quaternion(self.quaternion), self.position)


@dataclass(frozen=True)
class PlacedJoint:
    """A joint with the index of its ``body`` and its first column in q (``at_q``) and v (``at_v``)."""

    joint: Joint
    body: int
    at_q: int
    at_v: int

    @property
    def columns_q(self) -> slice:
        """Its columns of q."""
        return slice(self.at_q, self.at_q + self.joint.coordinates)

    @property
    def columns_v(self) -> slice:
        """Its columns of v."""
        return slice(self.at_v, self.at_v + self.joint.freedoms)


@dataclass(frozen=True, eq=False)
class SpatialMechanism:
    """``bodies``, parents before children, and ``gravity`` (3,) in the world [m/s²].

    Raises :class:`InvalidInput` where a parent comes after its child, two joints have one name, or a free joint is not
    alone on a body of the world.
    """

    bodies: tuple[RigidBody, ...]
    gravity: Array

    def __post_init__(self) -> None:
        doubles(self, "gravity")
        names: set[str] = set()
        for index, body in enumerate(self.bodies):
            if not WORLD <= body.parent < index:
                raise InvalidInput(f"body {body.name!r}: its parent must come before it")
            for joint in body.joints:
                if joint.name in names:
                    raise InvalidInput(f"two joints are called {joint.name!r}; names must be unique")
                names.add(joint.name)
                if joint.kind == "free" and (body.parent != WORLD or len(body.joints) > 1):
                    raise InvalidInput(f"joint {joint.name!r}: a free joint must be alone, on a body of the world")

    @cached_property
    def joints(self) -> tuple[PlacedJoint, ...]:
        """All joints, in the order of their coordinates."""
        return tuple(self._placed())

    def _placed(self) -> Iterator[PlacedJoint]:
        at_q = at_v = 0
        for index, body in enumerate(self.bodies):
            for joint in body.joints:
                yield PlacedJoint(joint, index, at_q, at_v)
                at_q += joint.coordinates
                at_v += joint.freedoms

    @property
    def nq(self) -> int:
        """Number of coordinates."""
        return sum(placed.joint.coordinates for placed in self.joints)

    @property
    def nv(self) -> int:
        """Number of degrees of freedom."""
        return sum(placed.joint.freedoms for placed in self.joints)

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, in the order of their coordinates."""
        return tuple(placed.joint.name for placed in self.joints)

    def per_freedom(self, number: str) -> Array:
        """``armature``, ``damping``, ``friction`` or ``stiffness`` of each degree of freedom, (nv,)."""
        values = [np.full(placed.joint.freedoms, getattr(placed.joint, number)) for placed in self.joints]
        return np.concatenate(values) if values else np.zeros(0)

    @cached_property
    def reference(self) -> Array:
        """The coordinates (nq,) of the reference configuration, in which every body has the pose that is given."""
        q: list[float] = []
        for placed in self.joints:
            body, joint = self.bodies[placed.body], placed.joint
            if joint.kind == "free":
                q += [*body.position, *unit(body.quaternion)]
            elif joint.kind == "ball":
                q += [1.0, 0.0, 0.0, 0.0]
            else:
                q.append(joint.ref)
        return np.array(q)
