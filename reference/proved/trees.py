"""An open mechanism in space whose joints keep it in a plane, as a :class:`~.form.Planar`: in exact numbers.

The doubles of a mechanism are binary fractions, a quaternion's rotation (of any length) has rational entries, and so
have poses, centres of mass and moments of inertia. Nothing is rounded: what is proved is proved of the mechanism given.

*along* and *across* are two axes of the world, the hinges turn about the third, and every link's frame is such that its
angle is zero in the reference configuration. What acts across the plane, gravity's part there too, the joints bear.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from ...models.errors import InvalidInput
from ...models.spatial_mechanism import Array, Joint, RigidBody, SpatialMechanism
from ...models.tree import SUPPORT
from ...models.trees.system import TreeSystem
from .form import JointCoordinate, Planar, PlanarLink, refuse_friction

Point = tuple[Fraction, ...]
Rows = tuple[Point, ...]

ZERO = Fraction(0)
UPRIGHT: Rows = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))
AXES = "xyz"
MOST_BODIES = 200  # turned by quaternions, each makes fractions 400 bits longer: a second or two; motions cost far more


@dataclass(frozen=True)
class _Placed:
    """A body in the reference configuration: ``rotation`` and ``origin`` in the world, the link that it belongs to."""

    rotation: Rows
    origin: Point
    link: int


@dataclass(frozen=True)
class _Matter:
    """Mass, centre of mass in the world and moment of inertia about it and the plane's normal."""

    mass: Fraction = ZERO
    centre: Point = (ZERO, ZERO, ZERO)
    inertia: Fraction = ZERO


@dataclass(frozen=True)
class _Moved:
    """A joint in the world's reference configuration: ``axis`` of any length, ``anchor``, and the link before it."""

    joint: Joint
    axis: Point
    anchor: Point
    parent: int


def planar_tree(system: TreeSystem | SpatialMechanism) -> Planar:
    """The planar mechanism that this is, whose coordinates are its joints', in their order.

    Limits act on nothing, as everywhere. Raises InvalidInput naming the first joint that does not fit: neither hinge
    nor slide; an axis that is not exactly the plane's; a slide that a hinge turns; dry friction. Also for more than
    200 bodies.
    """
    mechanism = system.mechanism() if isinstance(system, TreeSystem) else system
    if len(mechanism.bodies) > MOST_BODIES:
        raise InvalidInput(f"{len(mechanism.bodies)} bodies: motions of at most {MOST_BODIES} are enclosed")
    moved, placed = _moved(mechanism.bodies)
    if not moved:
        raise InvalidInput("no joint: nothing moves")
    for one in moved:
        _refuse_kind(one.joint)
    normal = _normal(moved)
    plane = ((normal + 1) % 3, (normal + 2) % 3)  # turned from the one to the other, about +normal
    matter = _matter(mechanism.bodies, placed, len(moved), normal)
    links: list[PlanarLink] = []
    for one, its in zip(moved, matter, strict=True):
        links.append(_link(one, its, links, moved, plane))
    joints = (
        JointCoordinate(-1 if one.joint.kind == "hinge" and one.axis[normal] < 0 else 1, float(one.joint.ref))
        for one in moved
    )
    gravity = _point(mechanism.gravity)
    return Planar(tuple(links), (gravity[plane[0]], gravity[plane[1]]), joints=tuple(joints))


def _moved(bodies: Sequence[RigidBody]) -> tuple[list[_Moved], list[_Placed]]:
    """All joints in their order, and where the bodies are; a joint's number is that of its link."""
    moved: list[_Moved] = []
    placed: list[_Placed] = []
    for body in bodies:
        outer = placed[body.parent] if body.parent >= 0 else _Placed(UPRIGHT, (ZERO, ZERO, ZERO), SUPPORT)
        rotation = _product(outer.rotation, _rotation(_point(body.quaternion)))
        origin = _sum(outer.origin, _applied(outer.rotation, _point(body.position)))
        link = outer.link
        for joint in body.joints:
            anchor = _sum(origin, _applied(rotation, _point(joint.anchor)))
            moved.append(_Moved(joint, _applied(rotation, _point(joint.axis)), anchor, link))
            link = len(moved) - 1
        placed.append(_Placed(rotation, origin, link))
    return moved, placed


def _refuse_kind(joint: Joint) -> None:
    if joint.kind not in ("hinge", "slide"):
        raise InvalidInput(
            f"joint {joint.name!r}: a {joint.kind} joint leaves the plane; motions of hinges about one axis, and of "
            "slides before them, are enclosed"
        )
    refuse_friction(f"joint {joint.name!r}", joint.friction, "N m" if joint.kind == "hinge" else "N")


def _normal(moved: Sequence[_Moved]) -> int:
    """The number of the world's axis about which all hinges turn and across which all slides go."""
    hinges = [one for one in moved if one.joint.kind == "hinge"]
    for one in hinges[:1]:
        if sum(map(bool, one.axis)) != 1:
            raise InvalidInput(
                f"joint {one.joint.name!r}: its axis is not exactly along x, y or z of the world, and motions in other "
                "planes are not enclosed"
            )
    free = [k for k in range(3) if all(not one.axis[k] for one in moved if one.joint.kind == "slide")]
    normal = next((k for k in range(3) if hinges[0].axis[k]), 0) if hinges else (free or [0])[0]
    for one in moved:
        in_plane = [one.axis[(normal + 1) % 3], one.axis[(normal + 2) % 3]]
        if one.joint.kind == "hinge" and any(in_plane):
            raise InvalidInput(
                f"joint {one.joint.name!r}: its axis is not exactly parallel to {AXES[normal]}, about which "
                f"{hinges[0].joint.name!r} turns: not a planar mechanism"
            )
        if one.joint.kind == "slide" and one.axis[normal]:
            raise InvalidInput(
                f"joint {one.joint.name!r}: it does not slide exactly across {AXES[normal]}, the plane's normal: not a "
                "planar mechanism"
            )
    return normal


def _matter(bodies: Sequence[RigidBody], placed: Sequence[_Placed], links: int, normal: int) -> list[_Matter]:
    """What each link consists of: the bodies that are fixed together."""
    found = [_Matter() for _ in range(links)]
    for body, at in zip(bodies, placed, strict=True):
        if at.link == SUPPORT:
            continue
        row = at.rotation[normal]
        tensor = [_point(line) for line in body.inertial.tensor]
        moment = _dot(row, [_dot(line, row) for line in tensor])
        centre = _sum(at.origin, _applied(at.rotation, _point(body.inertial.centre)))
        found[at.link] = _added(found[at.link], _Matter(Fraction(float(body.inertial.mass)), centre, moment), normal)
    return found


def _added(a: _Matter, b: _Matter, normal: int) -> _Matter:
    """Both, fixed together: Steiner's theorem about the common centre of mass."""
    mass = a.mass + b.mass
    if not a.mass or not b.mass:
        return replace(a if a.mass else b, inertia=a.inertia + b.inertia)
    centre = tuple((a.mass * x + b.mass * y) / mass for x, y in zip(a.centre, b.centre, strict=True))
    apart = sum(((x - y) ** 2 for k, (x, y) in enumerate(zip(a.centre, b.centre, strict=True)) if k != normal), ZERO)
    return _Matter(mass, centre, a.inertia + b.inertia + a.mass * b.mass / mass * apart)


def _link(
    one: _Moved, its: _Matter, before: Sequence[PlanarLink], moved: Sequence[_Moved], plane: tuple[int, int]
) -> PlanarLink:
    joint, slides = one.joint, one.joint.kind == "slide"
    if slides and one.parent != SUPPORT and before[one.parent].slide is None:
        raise InvalidInput(
            f"joint {joint.name!r}: it slides along what {moved[one.parent].joint.name!r} turns; a slide is enclosed "
            "where no hinge is before it"
        )
    base = (ZERO, ZERO, ZERO) if one.parent == SUPPORT else moved[one.parent].anchor
    centre = its.centre if its.mass else one.anchor
    sense = -1 if not slides and sum(one.axis) < 0 else 1

    def pair(point: Point, origin: Point) -> tuple[Fraction, Fraction]:
        return point[plane[0]] - origin[plane[0]], point[plane[1]] - origin[plane[1]]

    return PlanarLink(
        parent=one.parent,
        hinge=pair(one.anchor, base),
        com=pair(centre, one.anchor),
        mass=its.mass,
        inertia=its.inertia,
        armature=float(joint.armature),
        damping=float(joint.damping),
        stiffness=float(joint.stiffness),
        rest=sense * (Fraction(float(joint.springref)) - Fraction(float(joint.ref))),
        slide=pair(one.axis, (ZERO, ZERO, ZERO)) if slides else None,
    )


def _rotation(q: Point) -> Rows:
    """The rotation of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = q
    s = 2 / _dot(q, q)
    return (
        (1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)),
        (s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)),
        (s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)),
    )


def _point(values: Iterable[float] | Array) -> Point:
    return tuple(Fraction(float(value)) for value in values)


def _dot(a: Iterable[Fraction], b: Iterable[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


def _sum(a: Point, b: Point) -> Point:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def _applied(rows: Rows, point: Point) -> Point:
    return tuple(_dot(row, point) for row in rows)


def _product(a: Rows, b: Rows) -> Rows:
    columns = tuple(zip(*b, strict=True))
    return tuple(tuple(_dot(row, column) for column in columns) for row in a)
