"""Which momenta of an open mechanism are kept, by the joints with which it hangs in the world.

What the first joints of a link leave free, where they have no springs, of all that hangs there. Without gravity,

* along each slide that comes first, or behind other slides, the linear momentum;
* about a hinge that comes first, or behind slides along its axis, the angular momentum about its pivot, and about a
  ball that comes first in all directions;
* about the axis of a hinge behind slides that span all directions across it, and have no armature, the angular momentum
  about the world's origin: a free base in a plane. About a ball behind slides in all directions, that in all.

And with gravity g, of a free joint, in all directions, the linear momentum less m g t after a time t, and, if it has no
armature, the angular momentum about the centre of mass. With armature, on which no weight acts, only without gravity,
and about the world's origin.

Rotors (armature) turn with their joint and count with it: those of a ball's three freedoms are as one that has no axis.
Those of a free joint are a mass J at the origin O of its body's frame and as much inertia about every axis through it:
J v̇ along the world's axes and J ω̇ along the body's, where ω̇ has the same components as in the world's. So J v comes to
the momentum, and J ω + O × J v to the angular momentum about the world's origin.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import WORLD, PlacedJoint, SpatialMechanism
from ...reference import spatial_kinematics
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.spatial import Magnitudes
from .invariance import Kept

Array = NDArray[np.float64]
Number = Callable[[Array, Array], Array]  # of states q (B, nq), v (B, nv): (B, k)

ALONG = 4 * EPSILON  # rounding of a product of directions of length one


@dataclass(frozen=True, eq=False)
class Momentum:
    """What is kept of the momenta of all that hangs on the link ``root``: along or about a joint of it, ``placed``.

    ``about``: None for a linear one; else the point about which the angular momentum is taken.
    """

    root: int
    placed: PlacedJoint
    about: Literal["pivot", "origin", "centre"] | None

    @property
    def falls(self) -> bool:
        """Whether it is kept with gravity, too."""
        return self._free and self.about != "origin"

    @property
    def _free(self) -> bool:
        return self.placed.joint.kind == "free"

    @property
    def kept(self) -> Kept:
        """Its name, unit and reason."""
        name = self.placed.joint.name
        if self.falls and self.about is None:
            return Kept(f"momentum of {name}", "kg m/s", f"nothing but gravity acts on what hangs on {name!r}")
        if self.falls:
            says = f"gravity exerts no torque about the centre of mass of what hangs on {name!r}"
            return Kept(f"angular momentum of {name}", "kg m²/s", says)
        if self.about is None:
            return Kept(f"momentum along {name}", "kg m/s", f"without gravity no force acts along {name!r}")
        return Kept(f"angular momentum about {name}", "kg m²/s", f"without gravity no torque acts about {name!r}")

    @property
    def _columns(self) -> slice:
        """The freedoms of its joint that have it."""
        at = self.placed.columns_v
        if not self._free:
            return at
        return slice(at.start, at.start + 3) if self.about is None else slice(at.start + 3, at.stop)

    def of(self, mechanism: SpatialMechanism, time: float = 0.0) -> Number:
        """The number in states (B, nq), (B, nv) after so many seconds: one of a slide or hinge, else in three axes."""
        at, armature = self._columns, self.placed.joint.armature

        def number(q: Array, v: Array) -> Array:
            moved = spatial_kinematics.motion(mechanism, q, v)
            axes, pivot = moved.axis[:, at], moved.pivot[:, at.start]
            point = np.zeros_like(pivot) if self.about == "origin" else pivot
            if self.about == "centre":
                point, _ = spatial_kinematics.centre_of_mass(mechanism, moved, self.root)
            linear, angular = spatial_kinematics.momentum(mechanism, moved, self.root, point)
            whole = linear if self.about is None else angular
            if self._free and self.about == "origin":
                whole = whole + np.cross(pivot, armature * v[:, self.placed.columns_v][:, :3])
            rotors = armature * v[:, at]
            if axes.shape[1] == 1:
                return np.asarray((whole[:, None] * axes).sum(axis=-1) + rotors)
            return np.asarray(whole + (rotors[..., None] * axes).sum(axis=1) - time * self._weight(mechanism, moved))

        return number

    def _weight(self, mechanism: SpatialMechanism, moved: spatial_kinematics.Motion) -> Array:
        """What gravity adds to it in a second, (3,)."""
        if not self.falls or self.about is not None:
            return np.zeros(3)
        _, mass = spatial_kinematics.centre_of_mass(mechanism, moved, self.root)
        return np.asarray(mass * mechanism.gravity)

    def size(self, mechanism: SpatialMechanism, units: Magnitudes, q: Array, v: Array, time: float) -> float:
        """The magnitudes of its terms in one state, of which some are rounded.

        About another point than the joint's, also those of the linear momentum times the way to it, or from the
        world's origin, whichever a place is rounded by.
        """
        rows = units.mass_matrix @ units.once(v)
        found = float(np.linalg.norm(rows[self._columns]))
        moved = spatial_kinematics.motion(mechanism, q[None], v[None])
        pivot = float(np.linalg.norm(moved.pivot[0, self._columns.start]))
        if self.about is None:
            return found + time * float(np.linalg.norm(self._weight(mechanism, moved)))
        if self.about == "origin":
            first = next(one.at_v for one in mechanism.joints if one.body == self.root)
            return found + pivot * float(rows[first])
        if self.about == "centre":
            centre, _ = spatial_kinematics.centre_of_mass(mechanism, moved, self.root)
            way = 2 * pivot + float(np.linalg.norm(centre))
            return found + way * float(np.linalg.norm(rows[self.placed.columns_v][:3]))
        return found


def momenta(mechanism: SpatialMechanism) -> list[Momentum]:
    """Those of a mechanism without dampers, by the first joints of every link that hangs on nothing that moves."""
    found: list[Momentum] = []
    moved: list[bool] = []
    for index, body in enumerate(mechanism.bodies):
        hangs = body.parent != WORLD and moved[body.parent]
        moved.append(hangs or bool(body.joints))
        if not hangs:
            found += _free([one for one in mechanism.joints if one.body == index])
    return found


def _free(joints: list[PlacedJoint]) -> Iterator[Momentum]:
    """Those of one link's joints."""
    slides: list[PlacedJoint] = []
    for one in joints:
        joint = one.joint
        if joint.kind == "slide":
            slides.append(one)
            if not joint.stiffness:
                yield Momentum(one.body, one, None)
            continue
        if joint.stiffness or any(slide.joint.stiffness or slide.joint.armature for slide in slides):
            return
        if joint.kind == "free":
            yield Momentum(one.body, one, None)
            yield Momentum(one.body, one, "origin" if joint.armature else "centre")
            return
        yield from _about(one, np.array([_direction(slide) for slide in slides]).reshape(-1, 3))
        return


def _about(one: PlacedJoint, directions: Array) -> Iterator[Momentum]:
    """That of a hinge or ball behind slides in these directions (k, 3)."""
    if one.joint.kind == "ball":
        if not len(directions) or np.linalg.matrix_rank(directions) == 3:
            yield Momentum(one.body, one, "origin" if len(directions) else "pivot")
        return
    axis = _direction(one)
    across = directions - np.outer(directions @ axis, axis)
    if (np.abs(across) <= ALONG).all():
        yield Momentum(one.body, one, "pivot")
    elif _spans(directions, axis):
        yield Momentum(one.body, one, "origin")


def _spans(directions: Array, axis: Array) -> bool:
    """Whether directions (k, 3) span all that is across an axis: all of space, or two of them in that plane."""
    rank = int(np.linalg.matrix_rank(directions))
    return rank == 3 or (rank == 2 and bool((np.abs(directions @ axis) <= ALONG).all()))


def _direction(one: PlacedJoint) -> Array:
    return np.asarray(one.joint.axis / np.linalg.norm(one.joint.axis))
