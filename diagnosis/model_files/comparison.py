"""A model file against another mechanism: the ideal one of its own links, a scene's, or another file's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ..differences import differences
from ..finding import Finding, joint_label
from ..reader_faults import inertia_from_geoms, possible_reader_faults
from .matching import mirrored, natural_turns, orders, rearranged, same_motion, without_hinge

SAME_MOTION_WITHOUT_HINGE = 1e-9  # relative tolerance when one hinge is left out
RankedView = tuple[tuple[float, ...], list[Finding]]


def compare_with_ideal(mechanism: Mechanism) -> list[Finding]:
    """Properties of a hinge in the file that an ideal hinge does not have: damping, armature, limits …"""
    return differences(mechanism, mechanism.ideal(), "the file", "an ideal hinge has")


def compare_with(file: ModelFile, expected: Mechanism) -> list[Finding]:
    """Differences of the file from ``expected``, with links and frames assigned so that the fewest are left."""
    found = file.mechanism
    if found.n != expected.n:
        return _other_number_of_hinges(found, expected)
    views = _ranked_views(file, expected)
    if not views:
        parents, others = [p + 1 for p in found.parents], [p + 1 for p in expected.parents]
        says = f"the file: parents of the links: found {parents}, expected {others} (0: the world)"
        return [Finding("joint-order", "the file", str(found.parents), str(expected.parents), says)]
    best = min(views, key=lambda view: view[0])[1]
    return _gravity_not_along_axes(found, best) + inertia_from_geoms(file, best) + best


def _ranked_views(file: ModelFile, expected: Mechanism) -> list[RankedView]:
    """(rank, differences) for each way to assign links and to turn frames; the least rank is the best way."""
    faults = possible_reader_faults(file, own_geoms=True)
    views: list[RankedView] = []
    for side, seen in enumerate((file.mechanism, mirrored(file.mechanism))):
        for order in orders(seen, expected):
            ordered = rearranged(seen, order, [0.0] * seen.n)
            alike = same_motion(ordered.ideal(), expected.ideal())
            kept = faults if order == sorted(order) else None
            for way, turns in enumerate(natural_turns(ordered, expected)):
                view = _without_rounding_of_gravity(rearranged(ordered, range(ordered.n), turns), expected)
                differ = differences(view, expected, "the file", faults=kept)
                if alike:  # numbers that do not change the motion are no difference
                    differ = [finding for finding in differ if finding.where.startswith("joint")]
                degrees = any(finding.cause == "degree-vs-radian" for finding in differ)
                views.append(((not alike, *_size(differ), way, not degrees, side), differ))
    return views


def _size(findings: list[Finding]) -> tuple[int, int]:
    """How many places the findings name, then how many findings: the fewer, the better the assignment."""
    counted = [finding for finding in findings if finding.cause != "degree-vs-radian"]  # always beside another
    return len({finding.where for finding in counted}), len(counted)


def _without_rounding_of_gravity(view: Mechanism, expected: Mechanism) -> Mechanism:
    gravity = expected.gravity if np.allclose(view.gravity, expected.gravity, rtol=1e-14, atol=0) else view.gravity
    return replace(view, gravity=gravity)


def _gravity_not_along_axes(found: Mechanism, others: list[Finding]) -> list[Finding]:
    """Gravity at an angle to the world's axes, along which the links lie in the file's reference configuration."""
    vector = np.array(found.gravity_vector)
    size = float(np.linalg.norm(vector))
    if not size or np.abs(vector).max() > size * (1 - 1e-12):
        return []
    straight = [k.com for k in found.links if any(k.com)] + [
        k.hinge for k in found.links if any(k.hinge) and k.parent >= 0
    ]
    down, across = np.array(found.down), np.array(found.across)
    for along, sideways in straight:
        direction = along * down + sideways * across
        if np.abs(direction).max() < np.linalg.norm(direction) * (1 - 1e-9):
            return []
    angles = {round(float(np.arctan2(c[1], c[0])), 9) for c in straight}
    if any(abs(angle) < 1e-9 for angle in angles) or any("gravity" in f.cause for f in others):
        return []
    angle = min((float(np.degrees(a)) for a in angles), key=abs)
    says = (
        f"the file: gravity {found.gravity_vector} is rotated by {angle:.6g}° from the axes along which the links lie"
    )
    return [Finding("gravity-turned", "gravity", angle, 0.0, says)]


def _other_number_of_hinges(found: Mechanism, expected: Mechanism) -> list[Finding]:
    """A missing or an additional hinge; which one, if leaving it out makes the two mechanisms alike."""
    missing = found.n < expected.n
    larger, smaller = (expected, found) if missing else (found, expected)
    cause = "joint-dropped-by-parser" if missing else "joint-added"
    which = None
    if larger.n == smaller.n + 1:
        which = next((k for k in range(larger.n) if _same_motion(without_hinge(larger, k), smaller)), None)
    where = joint_label(larger, which) if which is not None else "the file"
    says = f"the file: found {found.n} hinges, expected {expected.n}"
    if which is not None:
        says += f"; {'missing' if missing else 'not expected'}: {where}"
    return [Finding(cause, where, found.n, expected.n, says)]


def _same_motion(a: Mechanism, b: Mechanism) -> bool:
    """Whether both move alike on ideal hinges, in some order of the links."""
    one, other = a.ideal(), b.ideal()
    return any(
        same_motion(rearranged(one, order, [0.0] * a.n), other, SAME_MOTION_WITHOUT_HINGE)
        for order in orders(one, other)
    )
