"""Which numbers of a mechanism differ between two readings of it: joints, placements, masses, inertias and the rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from ...models.spatial_mechanism import WORLD, Array, SpatialMechanism
from .moving_links import MovingLink, SeenJoint, coordinates_of, moving_links
from .numbers import (
    SAME,
    FieldDifference,
    apart,
    axis_difference,
    inertial_differences,
    joint_numbers,
    largest_length,
    plain,
    uncertain_tensor,
)
from .own_frames import own_frame_differences


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
    a frame that is placed otherwise is named where it is, not again in the links that it carries. Where both have the
    same bodies and fewer numbers differ in the bodies' own frames, it is these (:mod:`.own_frames`).

    ``limits``: whether ranges of joints count; ``ignored``: numbers of joints that do not (``friction`` …).
    ``mesh_axes``: of a mesh that ``found`` keeps in its principal axes, the largest product of inertia that these
    leave, over the largest moment.
    """
    theirs = moving_links(found, coordinates_of(expected, expected.reference, found))
    ours = moving_links(expected)
    length, left_out = largest_length(ours), frozenset(ignored)
    differences = [*_joints(theirs, ours)]
    if "gravity" not in left_out:
        differences += _gravity(found.gravity, expected.gravity)
    seen = _of_links(theirs, ours, length, limits, left_out, mesh_axes)
    if seen:
        written = own_frame_differences(found, expected, length, limits=limits, ignored=left_out, mesh_axes=mesh_axes)
        # Both lists are complete: the shorter one says what is wrong, and the longer one what follows from it.
        seen = written if written and len(written) <= len(seen) else seen
    return differences + seen


def _of_links(
    theirs: tuple[MovingLink, ...],
    ours: tuple[MovingLink, ...],
    length: float,
    limits: bool,
    ignored: frozenset[str],
    mesh_axes: float,
) -> list[FieldDifference]:
    """What the links have otherwise, whatever frames the readings use."""
    known = {link.key: link for link in theirs}
    found: list[FieldDifference] = []
    for link in ours:
        other = known.get(link.key)
        if other is None or _kinds(other) != _kinds(link):
            continue
        turn = _turn(theirs, other, ours, link)
        found += _placement(other, link, turn, length)
        for one, seen in zip(other.joints, link.joints, strict=True):
            found += joint_numbers(one.joint, seen.joint, limits, ignored)
        uncertain = uncertain_tensor(mesh_axes, link.meshes)
        found += inertial_differences(other.inertial, link.inertial, f"link {link.name!r}", turn, length, uncertain)
    return found


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


def _turn(theirs: tuple[MovingLink, ...], other: MovingLink, ours: tuple[MovingLink, ...], link: MovingLink) -> Array:
    """The rotation that takes the other reading's world axes, as its parent link has them, to ours."""
    if WORLD in {link.parent, other.parent}:
        return np.eye(3)
    return np.asarray(ours[link.parent].turned @ theirs[other.parent].turned.T)


def _placement(other: MovingLink, link: MovingLink, turn: Array, length: float) -> Iterator[FieldDifference]:
    for theirs, ours in zip(other.joints, link.joints, strict=True):
        where = f"joint {ours.joint.name!r}"
        axis = axis_difference(theirs.axis, ours.axis, where, turn)
        if axis is not None:
            yield axis
            if axis.cause == "angle-convention":
                continue
        size = apart(theirs.arm, ours.arm, turn) / length
        if size > SAME and not _turned_axis_only(theirs, ours):
            yield FieldDifference("joint-placement", where, "place", plain(theirs.arm), plain(ours.arm), "m", size)


def _turned_axis_only(theirs: SeenJoint, ours: SeenJoint) -> bool:
    """Whether the arms differ only because each is seen across another axis."""
    a, b = theirs.axis, ours.axis
    across_both = ours.arm - (ours.arm @ a) * a
    return bool(np.linalg.norm(theirs.arm - across_both) <= SAME * max(float(np.linalg.norm(ours.arm)), 1e-300)) and (
        float(np.linalg.norm(a - b)) > SAME
    )


def _gravity(found: Array, expected: Array) -> Iterator[FieldDifference]:
    off, size = float(np.linalg.norm(found - expected)), float(np.linalg.norm(expected))
    if off <= SAME * max(size, 1e-300):
        return
    turned = abs(float(np.linalg.norm(found)) - size) <= SAME * size
    cause = "gravity-turned" if turned else "gravity"
    yield FieldDifference(cause, "gravity", "gravity", plain(found), plain(expected), "m/s²", off / max(size, 1e-300))
