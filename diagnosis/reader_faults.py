"""Known faults of readers of model files: what each link would be with each of them, to compare with what it is.

Besides, what a file says and hardly means: angles in degrees, inertias from geoms.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping

import numpy as np

from ..models import Link
from ..models.readers.model_file import ModelFile
from ..models.spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose
from ..models.spatial_mechanism import RigidBody
from .finding import Finding, joint_label
from .measurement import Array

PATTERN_TOLERANCE = 1e-9  # relative: a pattern is recognised within this
# Mass [kg], centre of mass (along, across) [m] and inertia about it [kg m²] of a link.
PlanarInertial = tuple[float, tuple[float, float], float]
# Cause → link → its inertial if the reader made this fault; only links that would then be another.
ReaderFaults = Mapping[str, Mapping[int, PlanarInertial]]

FAULT_SENTENCES = {
    "urdf-inertial-rpy-lost": "its inertia is that of the tensor without the rotation of its axes",
    "inertial-com-rotated": "its centre of mass is rotated by the rotation that belongs to the tensor alone",
    "fused-static-frame": "a body fixed to it was added without the rotation of the fixed joint",
    "inertia-from-geoms": "mass and inertia are those of its geoms, not those of its inertial",
    "inertial-ignored": "mass and inertia are default values, not those of its inertial",
}


def matching_fault(i: int, found: Link, faults: ReaderFaults) -> str | None:
    """The cause of the first fault that gives link ``i`` exactly the mass, centre and inertia that were found."""
    mass, com, inertia = found.mass, found.com, found.inertia
    for cause, links in faults.items():
        if i not in links:
            continue
        m, c, inert = links[i]
        size = max(math.hypot(*c), 1e-12)
        near = abs(mass - m) <= PATTERN_TOLERANCE * max(m, 1e-300) and abs(inertia - inert) <= PATTERN_TOLERANCE * max(
            inert, m * size * size * 1e-3, 1e-300
        )
        if near and (math.dist(com, c) <= PATTERN_TOLERANCE * size or m == 0):
            return cause
    return None


def possible_reader_faults(file: ModelFile, own_geoms: bool = False) -> ReaderFaults:
    """Each link of the file as each known fault of a reader would have it.

    ``own_geoms``: the file itself is compared with something: a file that takes its inertias from geoms may then be
    the one that is wrong.
    """
    right = _planar_inertials(file, lambda body: body.inertial)
    with_fault = {
        "urdf-inertial-rpy-lost": _planar_inertials(file, lambda body: _without_tensor_rotation(file, body)),
        "inertial-com-rotated": _planar_inertials(file, lambda body: _with_centre_rotated(file, body)),
        "fused-static-frame": _planar_inertials(file, lambda body: body.inertial, turn_fixed=False),
        "inertia-from-geoms": _planar_inertials(file, lambda body: file.geoms.get(body.name, ZERO_INERTIAL)),
        "inertial-ignored": _planar_inertials(file, lambda body: Inertial(1.0, np.zeros(3), np.eye(3))),
    }
    faults = {
        cause: {i: links[i] for i, value in right.items() if not _near(links[i], value)}
        for cause, links in with_fault.items()
    }
    if file.from_geoms:
        faults["inertia-from-geoms"] = with_fault["inertia-from-geoms"] if own_geoms else {}
    return {cause: links for cause, links in faults.items() if links}


def _near(a: PlanarInertial, b: PlanarInertial) -> bool:
    flat_a, flat_b = (a[0], *a[1], a[2]), (b[0], *b[1], b[2])
    return all(
        abs(x - y) <= PATTERN_TOLERANCE * max(abs(x), abs(y)) + 1e-15 for x, y in zip(flat_a, flat_b, strict=True)
    )


def _without_tensor_rotation(file: ModelFile, body: RigidBody) -> Inertial:
    right = body.inertial
    if body.name not in file.tensors:
        return right
    unturned, _ = file.tensors[body.name]
    return Inertial(right.mass, right.centre, unturned.tensor)


def _with_centre_rotated(file: ModelFile, body: RigidBody) -> Inertial:
    right = body.inertial
    if body.name not in file.tensors:
        return right
    _, turn = file.tensors[body.name]
    return Inertial(right.mass, turn @ right.centre, right.tensor)


def _planar_inertials(
    file: ModelFile, inertial: Callable[[RigidBody], Inertial], turn_fixed: bool = True
) -> dict[int, PlanarInertial]:
    """Mass, centre and inertia of each link, with ``inertial(body)`` for each body.

    ``turn_fixed``: turn what is fixed to another body as its frame is turned.
    """
    plane = file.plane
    poses: list[Pose] = []
    link_of: list[int] = []
    totals: list[Inertial] = []
    anchors: list[Array] = []
    assumed_poses: list[Pose] = []
    for body in file.spatial.bodies:
        carrier, carrying, at = (
            (poses[body.parent], link_of[body.parent], assumed_poses[body.parent])
            if body.parent >= 0
            else (IDENTITY, -1, IDENTITY)
        )
        pose = carrier @ body.pose
        fixed = not body.joints and carrying >= 0
        assumed = Pose(at.rotation, (at @ body.pose).translation) if fixed and not turn_fixed else at @ body.pose
        for hinge in body.joints:
            totals.append(ZERO_INERTIAL)
            anchors.append(pose.point(hinge.anchor))
            carrying = len(totals) - 1
            assumed = pose
        poses.append(pose)
        assumed_poses.append(assumed)
        link_of.append(carrying)
        if carrying >= 0:
            totals[carrying] = totals[carrying] + inertial(body).transformed(assumed)
    found = {}
    for i, (total, anchor) in enumerate(zip(totals, anchors, strict=True)):
        com = plane.point(total.centre - anchor) if total.mass else (0.0, 0.0)
        found[i] = (total.mass, com, float(plane.axis @ total.tensor @ plane.axis))
    return found


def degrees_in_file(file: ModelFile) -> Iterator[Finding]:
    """Joint limits that are read in degrees and were surely meant in radians: less than a few degrees about zero, and
    round fractions of π if read in radians."""
    if file.language != "mjcf":
        return
    for i, hinge in enumerate(file.mechanism.hinges):
        if hinge.limits is None:
            continue
        ends = [end * 180 / math.pi for end in hinge.limits]
        widest = max(map(abs, ends))
        if widest <= 2 * math.pi + 1e-3 and any(_fraction_of_pi(end) for end in ends if end):
            name = joint_label(file.mechanism, i)
            says = (
                f"the file: {name}: range {ends[0]:.6g} to {ends[1]:.6g} is read in degrees, MJCF's default, but looks "
                "like radians; for radians write <compiler angle='radian'/>"
            )
            yield Finding("degree-vs-radian", name, hinge.limits[1], ends[1], says)


def _fraction_of_pi(angle: float) -> bool:
    return any(
        abs(abs(angle) * k / math.pi - round(abs(angle) * k / math.pi)) < 2e-3 and abs(angle) > 0.2
        for k in (1, 2, 3, 4, 6)
    )


def inertia_from_geoms(file: ModelFile, findings: list[Finding], who: str = "the file") -> list[Finding]:
    """Where bodies have the inertia of their geoms and links differ, that is named first."""
    by_link = {"mass", "inertia", "com-displaced", "inertial-com-rotated", "length"}
    if not file.from_geoms or not any(finding.cause in by_link for finding in findings):
        return []
    has_inertials = any(name in file.tensors for name in file.from_geoms)
    why = (
        "the compiler option inertiafromgeom ignores the inertials" if has_inertials else "the bodies have no inertial"
    )
    names = ", ".join(file.from_geoms[:3]) + (" …" if len(file.from_geoms) > 3 else "")
    says = f"{who}: {names}: mass and inertia come from the geoms: {why}"
    if who != "the file":
        says = f"{who}: {names}: the file gives no inertial, and this engine computes another one from the geoms"
    return [Finding("inertia-from-geoms", f"link {names}", None, None, says)]
