"""Which numbers of a mechanism differ between two readings of it: joints, placements, masses, inertias and the rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ...models.readers.mjcf.inertials import POINT_MASS_BOUND
from ...models.spatial_mechanism import WORLD, Array, SpatialMechanism
from .moving_links import MovingLink, SeenJoint, coordinates_of, moving_links

# Readers turn frames into one another, diagonalise tensors and add up meshes: 1e-14 of the sizes where both are right.
# What is written with ten digits or fewer is far beyond this.
SAME = 1e-11
EPSILON = 2.0**-52
NUMBERS = ("armature", "damping", "friction", "stiffness")  # of a joint, zero where it is ideal


@dataclass(frozen=True)
class FieldDifference:
    """One number, vector or tensor that differs: the ``cause`` it is called, ``where``, what was ``found`` and what
    was ``expected``, the ``unit``, and ``size``: the difference over the largest such number of the mechanism."""

    cause: str
    where: str
    field: str
    found: object
    expected: object
    unit: str
    size: float


def field_differences(
    found: SpatialMechanism,
    expected: SpatialMechanism,
    *,
    limits: bool = False,
    ignored: Iterable[str] = (),
    mesh_axes: float = 0.0,
) -> list[FieldDifference]:
    """What ``found`` has otherwise than ``expected``, joints that are missing first, then link by link from the root.

    Links are recognised by the name of their last joint. Both are seen in the reference configuration of ``expected``;
    a frame that is placed otherwise is named where it is, not again in the links that it carries. ``limits``: whether
    ranges of joints count; ``ignored``: numbers of joints that do not (``friction`` …). ``mesh_axes``: of a mesh that
    ``found`` keeps in its principal axes, the largest product of inertia that these leave, over the largest moment.
    """
    return list(_differences(found, expected, limits, frozenset(ignored), mesh_axes))


def _differences(
    found: SpatialMechanism, expected: SpatialMechanism, limits: bool, ignored: frozenset[str], mesh_axes: float
) -> Iterator[FieldDifference]:
    theirs = moving_links(found, coordinates_of(expected, expected.reference, found))
    ours = moving_links(expected)
    known = {link.key: link for link in theirs}
    yield from _joints(theirs, ours)
    if "gravity" not in ignored:
        yield from _gravity(found.gravity, expected.gravity)
    scale = _Scale(ours)
    for link in ours:
        other = known.get(link.key)
        if other is not None and _kinds(other) == _kinds(link):
            turn = _turn(theirs, other, ours, link)
            yield from _placement(other, link, turn, scale)
            yield from _joint_numbers(other, link, limits, ignored)
            yield from _inertial(other, link, turn, scale, mesh_axes)


def _joints(theirs: tuple[MovingLink, ...], ours: tuple[MovingLink, ...]) -> Iterator[FieldDifference]:
    their_joints = {s.joint.name: s.joint for link in theirs for s in link.joints}
    our_joints = {s.joint.name: s.joint for link in ours for s in link.joints}
    for name, joint in our_joints.items():
        if name not in their_joints:
            yield FieldDifference(
                "joint-dropped-by-parser", f"joint {name!r}", "joint", "none", joint.kind, "", float("inf")
            )
        elif their_joints[name].kind != joint.kind:
            yield FieldDifference(
                "joint-type", f"joint {name!r}", "kind", their_joints[name].kind, joint.kind, "", float("inf")
            )
    for name, joint in their_joints.items():
        if name not in our_joints:
            yield FieldDifference("joint-added", f"joint {name!r}", "joint", joint.kind, "none", "", float("inf"))
    for link in ours:
        other = next((o for o in theirs if o.key == link.key), None)
        if other is None:
            continue
        above, theirs_above = _parent_key(ours, link), _parent_key(theirs, other)
        if above != theirs_above or [s.joint.name for s in other.joints] != [s.joint.name for s in link.joints]:
            chain, wanted = _chain(theirs_above, other), _chain(above, link)
            yield FieldDifference("joint-order", f"joint {link.key!r}", "joints above", chain, wanted, "", float("inf"))


def _parent_key(links: tuple[MovingLink, ...], link: MovingLink) -> str:
    return "the world" if link.parent == WORLD else links[link.parent].key


def _chain(above: str, link: MovingLink) -> str:
    return " → ".join([above, *(seen.joint.name for seen in link.joints)])


def _kinds(link: MovingLink) -> list[tuple[str, str]]:
    return [(seen.joint.name, seen.joint.kind) for seen in link.joints]


class _Scale:
    """The sizes that differences are held against: of the whole mechanism, so that a tiny link is not over-read."""

    def __init__(self, links: tuple[MovingLink, ...]) -> None:
        arms = [float(np.linalg.norm(seen.arm)) for link in links for seen in link.joints]
        centres = [float(np.linalg.norm(link.inertial.centre)) for link in links]
        self.length = max([*arms, *centres], default=0.0) or 1.0


def _turn(theirs: tuple[MovingLink, ...], other: MovingLink, ours: tuple[MovingLink, ...], link: MovingLink) -> Array:
    """The rotation that takes the other reading's world axes, as its parent link has them, to ours."""
    if WORLD in {link.parent, other.parent}:
        return np.eye(3)
    return np.asarray(ours[link.parent].turned @ theirs[other.parent].turned.T)


def _differs(found: Array, expected: Array, turn: Array, scale: float) -> float:
    """How far two vectors are apart over ``scale``, in the world or as the parent link has them, if that is less."""
    return float(min(np.linalg.norm(found - expected), np.linalg.norm(turn @ found - expected))) / scale


def _placement(other: MovingLink, link: MovingLink, turn: Array, scale: _Scale) -> Iterator[FieldDifference]:
    for theirs, ours in zip(other.joints, link.joints, strict=True):
        where = f"joint {ours.joint.name!r}"
        size = _differs(theirs.axis, ours.axis, turn, 1.0)
        if size > SAME:
            if np.linalg.norm(theirs.axis + ours.axis) <= SAME:
                yield FieldDifference("angle-convention", where, "axis", _list(theirs.axis), _list(ours.axis), "", size)
                continue
            yield FieldDifference("joint-axis", where, "axis", _list(theirs.axis), _list(ours.axis), "", size)
        size = _differs(theirs.arm, ours.arm, turn, scale.length)
        if size > SAME and not _turned_axis_only(theirs, ours):
            yield FieldDifference("joint-placement", where, "place", _list(theirs.arm), _list(ours.arm), "m", size)


def _turned_axis_only(theirs: SeenJoint, ours: SeenJoint) -> bool:
    """Whether the arms differ only because each is seen across another axis."""
    a, b = theirs.axis, ours.axis
    across_both = ours.arm - (ours.arm @ a) * a
    return bool(np.linalg.norm(theirs.arm - across_both) <= SAME * max(float(np.linalg.norm(ours.arm)), 1e-300)) and (
        float(np.linalg.norm(a - b)) > SAME
    )


UNITS_TURNING = {"armature": "kg m²", "damping": "N m s/rad", "friction": "N m", "stiffness": "N m/rad"}
UNITS_SLIDING = {"armature": "kg", "damping": "N s/m", "friction": "N", "stiffness": "N/m"}
CAUSE_OF = {"friction": "dry-friction"}


def _joint_numbers(
    other: MovingLink, link: MovingLink, limits: bool, ignored: frozenset[str]
) -> Iterator[FieldDifference]:
    for theirs, ours in zip(other.joints, link.joints, strict=True):
        where, units = f"joint {ours.joint.name!r}", UNITS_SLIDING if ours.joint.kind == "slide" else UNITS_TURNING
        for name in NUMBERS:
            found, wanted = getattr(theirs.joint, name), getattr(ours.joint, name)
            size = abs(found - wanted) / max(abs(found), abs(wanted), 1e-300)
            if name not in ignored and size > SAME:
                yield FieldDifference(CAUSE_OF.get(name, name), where, name, found, wanted, units[name], size)
        spring = ours.joint.stiffness and theirs.joint.stiffness and ours.joint.kind in ("hinge", "slide")
        if spring and "stiffness" not in ignored:
            found, wanted = theirs.joint.springref, ours.joint.springref
            if abs(found - wanted) > SAME * max(abs(wanted), 1.0):
                unit = "m" if ours.joint.kind == "slide" else "rad"
                yield FieldDifference("spring-reference", where, "springref", found, wanted, unit, abs(found - wanted))
        if limits and not _same_limits(theirs.joint.limits, ours.joint.limits):
            found_, wanted_ = theirs.joint.limits or "none", ours.joint.limits or "none"
            yield FieldDifference("joint-limit", where, "limits", str(found_), str(wanted_), "", 1.0)


def _same_limits(found: tuple[float, float] | None, expected: tuple[float, float] | None) -> bool:
    if found is None or expected is None:
        return found is expected
    return bool(np.allclose(found, expected, rtol=SAME, atol=SAME))


def _inertial(
    other: MovingLink, link: MovingLink, turn: Array, scale: _Scale, mesh_axes: float
) -> Iterator[FieldDifference]:
    theirs, ours, where = other.inertial, link.inertial, f"link {link.name!r}"
    heavy = max(abs(theirs.mass), abs(ours.mass))
    if abs(theirs.mass - ours.mass) > SAME * heavy:
        size = abs(theirs.mass - ours.mass) / heavy
        yield FieldDifference("mass", where, "mass", theirs.mass, ours.mass, "kg", size)
    if ours.mass and theirs.mass:
        length = max(scale.length, 1e-300)
        size = _differs(theirs.centre, ours.centre, turn, length)
        if size > SAME:
            yield FieldDifference(
                "com-displaced", where, "centre of mass", _list(theirs.centre), _list(ours.centre), "m", size
            )
    largest = max(float(np.abs(theirs.tensor).max()), float(np.abs(ours.tensor).max()))
    # A tensor about the centre of mass is a difference of larger ones where bodies are fixed together.
    rounding = 64 * EPSILON * heavy * scale.length**2
    # Three products of inertia of at most e each make up a tensor of the norm 2 e, whatever the axes.
    rounding += 2 * mesh_axes * link.meshes
    if not ours.tensor.any():  # a point mass, which MuJoCo compiles with as much
        rounding += 2 * POINT_MASS_BOUND
    if largest:
        apart = min(
            float(np.abs(theirs.tensor - ours.tensor).max()),
            float(np.abs(turn @ theirs.tensor @ turn.T - ours.tensor).max()),
        )
        if apart > SAME * largest + rounding:
            found, wanted = _six(theirs.tensor), _six(ours.tensor)
            yield FieldDifference("inertia", where, "inertia", found, wanted, "kg m²", apart / largest)


def _gravity(found: Array, expected: Array) -> Iterator[FieldDifference]:
    apart, size = float(np.linalg.norm(found - expected)), float(np.linalg.norm(expected))
    if apart <= SAME * max(size, 1e-300):
        return
    turned = abs(float(np.linalg.norm(found)) - size) <= SAME * size
    cause = "gravity-turned" if turned else "gravity"
    yield FieldDifference(cause, "gravity", "gravity", _list(found), _list(expected), "m/s²", apart / max(size, 1e-300))


def _list(values: Array) -> list[float]:
    return [float(value) for value in values]


def _six(tensor: Array) -> list[float]:
    """xx, yy, zz, xy, xz, yz."""
    t = tensor
    return [float(v) for v in (t[0, 0], t[1, 1], t[2, 2], t[0, 1], t[0, 2], t[1, 2])]
