"""Images of open mechanisms under their symmetries: mechanisms and states whose accelerations follow from the first.

Mirrored, counted in other axes, turned, scaled, with branches in another order, put together from halves. Numbers are
moved, their signs are changed, and they are multiplied by powers of two: all of it is exact in floating point, but for
a hinge's turn by 2π. A gravity of any direction goes along.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .system import COORDINATES, RATES, Kind, TreeJoint, TreeLink, TreeSystem, Vector

Array = NDArray[np.float64]
Signed = tuple[tuple[int, float], ...]  # of each component: which one it is made from, and with which sign

SAME: Signed = ((0, 1.0), (1, 1.0), (2, 1.0))
MIRRORED: Signed = ((0, -1.0), (1, 1.0), (2, 1.0))  # left and right changed over
MIRRORED_AXES: Signed = ((0, 1.0), (1, -1.0), (2, -1.0))  # what it makes of rotations: their axes are no arrows
RENAMED: Signed = ((2, 1.0), (0, 1.0), (1, 1.0))  # z is called x, x is called y, y is called z
HALF_TURN: Signed = ((0, -1.0), (1, -1.0), (2, 1.0))  # about z
HALF_TURNED: Signed = ((3, -1.0), (2, -1.0), (1, 1.0), (0, 1.0))  # the same before a rotation, as a quaternion
TENSOR = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # where its six components stand
TURN = 2 * np.pi


@dataclass(frozen=True)
class Map:
    """Numbers ``of`` the one, by index, each times a power of two or a sign, are those of the image."""

    of: list[int]
    times: list[float]

    def there(self, values: Array) -> Array:
        """(B, m) → (B, m)."""
        return np.asarray(values[:, self.of] * self.times)

    def back(self, values: Array) -> Array:
        """The reverse."""
        found = np.empty_like(values)
        found[:, self.of] = values / self.times
        return found


@dataclass(frozen=True, eq=False)
class Image:
    """The mechanism ``before`` and its image ``after``; ``q`` (B, nq), ``v`` (B, nv): the states' images there.

    ``accelerations``: takes those of ``before`` to those of ``after``. ``turned`` (nq,): by how many radians
    coordinates of hinges were turned, whose sum is rounded.
    """

    before: TreeSystem
    after: TreeSystem
    q: Array
    v: Array
    accelerations: Map
    turned: Array | None = None


def mirrored(system: TreeSystem, q: Array, v: Array) -> Image:
    """Left and right changed over, in every frame."""
    return _in_other_axes(system, q, v, MIRRORED, MIRRORED_AXES)


def renamed(system: TreeSystem, q: Array, v: Array) -> Image:
    """All of it turned by a third of a turn about (1, 1, 1), gravity too: every frame's axes are called otherwise."""
    return _in_other_axes(system, q, v, RENAMED, RENAMED)


def turned(system: TreeSystem, q: Array, v: Array) -> Image:
    """All of it turned by half a turn about the vertical, in the world alone: links keep their own axes."""

    def moved(link: TreeLink) -> TreeLink:
        if link.parent >= 0:
            return link
        return replace(link, position=_taken(HALF_TURN, link.position), quaternion=_taken(HALF_TURNED, link.quaternion))

    after = TreeSystem(tuple(map(moved, system.links)), _taken(HALF_TURN, system.gravity))
    places = _map(system, lambda joint: (*HALF_TURN, *_shifted(HALF_TURNED)) if joint.kind == "free" else None)
    rates = _map(system, lambda joint: (*HALF_TURN, *_shifted(SAME)) if joint.kind == "free" else None, rates=True)
    return Image(system, after, places.there(q), rates.there(v), rates)


def reversed_rates(system: TreeSystem, q: Array, v: Array) -> Image:
    """Time reversed, v → −v, of the mechanism without dampers."""
    ideal = without_dampers(system)
    return Image(ideal, ideal, q, -v, _map(system, lambda joint: None, rates=True))


def without_dampers(system: TreeSystem) -> TreeSystem:
    """The same, and nothing takes energy away."""
    links = (replace(link, joints=tuple(replace(joint, damping=0.0) for joint in link.joints)) for link in system.links)
    return replace(system, links=tuple(links))


def once_round(system: TreeSystem, q: Array, v: Array) -> Image | None:
    """Every hinge without a spring once round, this way and that; quaternions with the other sign."""
    by, signs = np.zeros(system.nq), np.ones(system.nq)
    at, way = 0, 1.0
    for joint in system.joints:
        end = at + COORDINATES[joint.kind]
        if joint.kind in ("ball", "free"):
            signs[end - 4 : end] = -1.0
        elif joint.kind == "hinge" and not joint.stiffness:
            by[at], way = way * TURN, -way
        at = end
    if not by.any() and (signs > 0).all():
        return None
    return Image(system, system, signs * q + by, v, _map(system, lambda joint: None, rates=True), by)


def branches_exchanged(system: TreeSystem, q: Array, v: Array) -> Image | None:
    """The links depth first, the last branch first."""
    order: list[int] = []
    left = [i for i, link in enumerate(system.links) if link.parent < 0]
    while left:
        order.append(left.pop())
        left += [i for i, link in enumerate(system.links) if link.parent == order[-1]]
    if order == list(range(len(order))):
        return None
    place = {old: new for new, old in enumerate(order)}
    links = [system.links[old] for old in order]
    after = replace(system, links=tuple(replace(link, parent=place.get(link.parent, -1)) for link in links))
    places, rates = (_blocks(system, order, sizes) for sizes in (COORDINATES, RATES))
    return Image(system, after, places.there(q), rates.there(v), rates)


def link_split(system: TreeSystem, q: Array, v: Array) -> Image | None:
    """The last link with a mass as two halves, one fixed to the other."""
    heavy = [i for i, link in enumerate(system.links) if link.mass]
    if not heavy:
        return None
    link = system.links[heavy[-1]]
    half = replace(link, mass=link.mass / 2, inertia=tuple(part / 2 for part in link.inertia))
    other = TreeLink(f"other half of {link.name}", heavy[-1], mass=half.mass, centre=link.centre, inertia=half.inertia)
    links = (*system.links[: heavy[-1]], half, *system.links[heavy[-1] + 1 :], other)
    return Image(system, replace(system, links=links), q, v, _map(system, lambda joint: None, rates=True))


def masses_scaled(system: TreeSystem, q: Array, v: Array) -> Image:
    """Eight times the mass, dampers and springs."""
    after = _scaled(system, 8.0, 1.0, 1.0)
    return Image(system, after, q, v, _map(system, lambda joint: None, rates=True))


def lengths_scaled(system: TreeSystem, q: Array, v: Array) -> Image | None:
    """Four times the length, and twice the time. A free joint has one number for what scales in two ways: not then."""
    if any(joint.kind == "free" and (joint.armature or joint.damping or joint.stiffness) for joint in system.joints):
        return None
    return _slowed(system, q, v, 4.0, 2.0)


def gravity_scaled(system: TreeSystem, q: Array, v: Array) -> Image | None:
    """Four times gravity and the springs, twice the dampers, and half the time."""
    return _slowed(system, q, v, 1.0, 0.5) if any(system.gravity) else None


def _slowed(system: TreeSystem, q: Array, v: Array, length: float, time: float) -> Image:
    """The image with so many times the lengths in which everything takes so many times as long."""
    after = _scaled(system, 1.0, length, time)
    places = _map(system, lambda joint: _times(joint, length, 1.0))
    rates = _map(system, lambda joint: _times(joint, length / time, 1 / time), rates=True)
    swings = _map(system, lambda joint: _times(joint, length / time**2, 1 / time**2), rates=True)
    return Image(system, after, places.there(q), rates.there(v), swings)


def _times(joint: TreeJoint, length: float, angle: float) -> Signed:
    """What multiplies a joint's coordinates, or rates: quaternions, whose angle is one, stay as they are."""
    if joint.kind == "slide":
        return ((0, length),)
    if joint.kind == "free":
        return (*((k, length) for k in range(3)), *((k, angle) for k in range(3, 7)))
    return tuple((k, angle) for k in range(4))


def _scaled(system: TreeSystem, mass: float, length: float, time: float) -> TreeSystem:
    """So many times the masses, lengths and times, of all that has units of them."""
    force, torque = mass * length / time**2, mass * length**2 / time**2

    def joint(one: TreeJoint) -> TreeJoint:
        slides = one.kind == "slide"
        far, pull = (length, force / length) if slides else (1.0, torque)
        return replace(
            one,
            anchor=_longer(length, one.anchor),
            ref=far * one.ref,
            springref=far * one.springref,
            armature=one.armature * (mass if slides else mass * length**2),
            damping=one.damping * pull * time,
            stiffness=one.stiffness * pull,
            limits=None if one.limits is None else (far * one.limits[0], far * one.limits[1]),
        )

    def link(one: TreeLink) -> TreeLink:
        return replace(
            one,
            position=_longer(length, one.position),
            mass=mass * one.mass,
            centre=_longer(length, one.centre),
            inertia=_longer(mass * length**2, one.inertia),
            joints=tuple(map(joint, one.joints)),
        )

    return TreeSystem(tuple(map(link, system.links)), _longer(length / time**2, system.gravity))


def _in_other_axes(system: TreeSystem, q: Array, v: Array, arrows: Signed, axes: Signed) -> Image:
    """Every frame's components changed: those of places and forces as ``arrows``, those of rotations as ``axes``."""

    def joint(one: TreeJoint) -> TreeJoint:
        axis = _taken(arrows if one.kind == "slide" else axes, one.axis)
        return replace(one, axis=axis, anchor=_taken(arrows, one.anchor))

    def link(one: TreeLink) -> TreeLink:
        return replace(
            one,
            position=_taken(arrows, one.position),
            quaternion=_taken(_as_quaternion(axes), one.quaternion),
            centre=_taken(arrows, one.centre),
            inertia=_tensor(arrows, one.inertia),
            joints=tuple(map(joint, one.joints)),
        )

    after = TreeSystem(tuple(map(link, system.links)), _taken(arrows, system.gravity))
    places = _map(system, lambda one: _of_joint(one, arrows, _as_quaternion(axes)))
    rates = _map(system, lambda one: _of_joint(one, arrows, axes), rates=True)
    return Image(system, after, places.there(q), rates.there(v), rates)


def _of_joint(joint: TreeJoint, arrows: Signed, turning: Signed) -> Signed | None:
    if joint.kind == "ball":
        return turning
    return (*arrows, *_shifted(turning)) if joint.kind == "free" else None


def _as_quaternion(axes: Signed) -> Signed:
    return ((0, 1.0), *((k + 1, sign) for k, sign in axes))


def _shifted(components: Signed) -> Signed:
    """The same three places on: behind a place or a velocity."""
    return tuple((k + 3, sign) for k, sign in components)


def _taken(components: Signed, values: Sequence[float]) -> Vector:
    return tuple(sign * values[k] for k, sign in components)


def _longer(factor: float, values: Sequence[float]) -> Vector:
    return tuple(factor * value for value in values)


def _tensor(arrows: Signed, inertia: Sequence[float]) -> Vector:
    """Its six components in the other axes."""
    found = []
    for i, j in TENSOR:
        (one, sign), (other, its) = arrows[i], arrows[j]
        found.append(sign * its * inertia[TENSOR.index((min(one, other), max(one, other)))])
    return tuple(found)


def _map(system: TreeSystem, of: Callable[[TreeJoint], Signed | None], *, rates: bool = False) -> Map:
    """The map of all coordinates, or rates, by that of each joint; None: as they are."""
    indices: list[int] = []
    factors: list[float] = []
    for joint in system.joints:
        size, at = (RATES if rates else COORDINATES)[joint.kind], len(indices)
        for k, factor in (of(joint) or tuple((k, 1.0) for k in range(size)))[:size]:
            indices.append(at + k)
            factors.append(factor)
    return Map(indices, factors)


def _blocks(system: TreeSystem, order: list[int], sizes: dict[Kind, int]) -> Map:
    """The map that takes the links' coordinates, or rates, in another order."""
    starts: list[int] = []
    at = 0
    for link in system.links:
        starts.append(at)
        at += sum(sizes[joint.kind] for joint in link.joints)
    ends = [*starts[1:], at]
    indices = [k for i in order for k in range(starts[i], ends[i])]
    return Map(indices, [1.0] * len(indices))
