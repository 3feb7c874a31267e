"""Ways in which readers of model files go wrong, and what each link would be then: compared with what it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from ..models import Link
from ..models.projection import Body
from ..models.readers.model_file import ModelFile
from ..models.spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose
from .finding import Finding, joint
from .measurement import Array

ALIKE = 1e-9  # relative: a pattern is recognised within this
# Mass, centre of mass (along, across) and inertia of a link.
Weights = tuple[float, tuple[float, float], float]


@dataclass(frozen=True)
class Suspects:
    """What each link's inertial would be for each way in which readers of files go wrong: cause → links → (mass,
    (along, across) of the centre, inertia)."""

    wrong: Mapping[str, Mapping[int, Weights]] = field(default_factory=dict)


SAYS = {
    "urdf-inertial-rpy-lost": "its inertia is that of the tensor without its rotation",
    "inertial-com-rotated": "its centre of mass is turned by the rotation that is meant for the tensor alone",
    "fused-static-frame": "what is fixed to it was added as if the fixed joint were not turned",
    "inertia-from-geoms": "mass and inertia are those of its geoms, not those of its inertial",
    "inertial-ignored": "mass and inertia are default values, not those of its inertial",
}


def suspect(i: int, got: Link, suspects: Suspects) -> str | None:
    """The first way of going wrong that gives exactly what was found."""
    mass, com, inertia = got.mass, got.com, got.inertia
    for cause, links in suspects.wrong.items():
        if i not in links:
            continue
        m, c, inert = links[i]
        size = max(math.hypot(*c), 1e-12)
        near = abs(mass - m) <= ALIKE * max(m, 1e-300) and abs(inertia - inert) <= ALIKE * max(
            inert, m * size * size * 1e-3, 1e-300
        )
        if near and (math.dist(com, c) <= ALIKE * size or m == 0):
            return cause
    return None


def suspects(file: ModelFile, own: bool = False) -> Suspects:
    """Each way in which a reader of this file may go wrong, and what each link would be then.

    ``own``: it is the file itself that is held against something: then what its geoms weigh may be what is wrong.
    """
    rotation_lost: dict[int, Weights] = {}
    turned: dict[int, Weights] = {}
    fused: dict[int, Weights] = {}
    drawn: dict[int, Weights] = {}
    ignored: dict[int, Weights] = {}
    right = _links_of(file, lambda body: body.inertial)
    lost = _links_of(file, lambda body: _lost(file, body.name, body.inertial))
    com = _links_of(file, lambda body: _com_turned(file, body.name, body.inertial))
    unfused = _links_of(file, lambda body: body.inertial, turn_fixed=False)
    geoms = _links_of(file, lambda body: file.geoms.get(body.name, ZERO_INERTIAL))
    unit = _links_of(file, lambda body: Inertial(1.0, np.zeros(3), np.eye(3)))
    for i, value in right.items():
        for found, place in ((lost, rotation_lost), (com, turned), (unfused, fused), (geoms, drawn), (unit, ignored)):
            if not _near(found[i], value):
                place[i] = found[i]
    if file.from_geoms:
        drawn = {i: geoms[i] for i in right} if own else {}
    wrong = {
        "urdf-inertial-rpy-lost": rotation_lost,
        "inertial-com-rotated": turned,
        "fused-static-frame": fused,
        "inertia-from-geoms": drawn,
        "inertial-ignored": ignored,
    }
    return Suspects({cause: links for cause, links in wrong.items() if links})


def _near(a: Weights, b: Weights) -> bool:
    flat_a, flat_b = (a[0], *a[1], a[2]), (b[0], *b[1], b[2])
    return all(abs(x - y) <= ALIKE * max(abs(x), abs(y)) + 1e-15 for x, y in zip(flat_a, flat_b, strict=True))


def _lost(file: ModelFile, name: str, right: Inertial) -> Inertial:
    if name not in file.tensors:
        return right
    unturned, _ = file.tensors[name]
    return Inertial(right.mass, right.centre, unturned.tensor)


def _com_turned(file: ModelFile, name: str, right: Inertial) -> Inertial:
    if name not in file.tensors:
        return right
    _, turn = file.tensors[name]
    return Inertial(right.mass, turn @ right.centre, right.tensor)


def _links_of(file: ModelFile, inertial: Callable[[Body], Inertial], turn_fixed: bool = True) -> dict[int, Weights]:
    """Mass, centre and inertia of each link with other inertials for the bodies."""
    plane = file.plane
    poses: list[Pose] = []
    link_of: list[int] = []
    totals: list[Inertial] = []
    anchors: list[Array] = []
    seen: list[Pose] = []
    for body in file.bodies:
        carrier, carrying, at = (
            (poses[body.parent], link_of[body.parent], seen[body.parent])
            if body.parent >= 0
            else (IDENTITY, -1, IDENTITY)
        )
        pose = carrier @ body.pose
        fixed = not body.hinges and carrying >= 0
        looks = Pose(at.rotation, (at @ body.pose).translation) if fixed and not turn_fixed else at @ body.pose
        for hinge in body.hinges:
            totals.append(ZERO_INERTIAL)
            anchors.append(pose.point(hinge.anchor))
            carrying = len(totals) - 1
            looks = pose
        poses.append(pose)
        seen.append(looks)
        link_of.append(carrying)
        if carrying >= 0:
            totals[carrying] = totals[carrying] + inertial(body).transformed(looks)
    found = {}
    for i, (total, anchor) in enumerate(zip(totals, anchors, strict=True)):
        com = plane.point(total.centre - anchor) if total.mass else (0.0, 0.0)
        found[i] = (total.mass, com, float(plane.axis @ total.tensor @ plane.axis))
    return found


def degrees_in_file(file: ModelFile) -> Iterator[Finding]:
    """Angles of a file in degrees that were surely meant in radians: limits less than a few degrees about zero that are
    round fractions of π when read the other way."""
    if file.language != "mjcf":
        return
    for i, hinge in enumerate(file.mechanism.hinges):
        if hinge.limits is None:
            continue
        ends = [end * 180 / math.pi for end in hinge.limits]
        widest = max(map(abs, ends))
        if widest <= 2 * math.pi + 1e-3 and any(_part_of_pi(end) for end in ends if end):
            name = joint(file.mechanism, i)
            says = (
                f"the file: {name}: range {ends[0]:.6g} to {ends[1]:.6g} is read in degrees, MJCF's default; it looks "
                "like radians: say <compiler angle='radian'/>"
            )
            yield Finding("degree-vs-radian", name, hinge.limits[1], ends[1], says)


def _part_of_pi(angle: float) -> bool:
    return any(
        abs(abs(angle) * k / math.pi - round(abs(angle) * k / math.pi)) < 2e-3 and abs(angle) > 0.2
        for k in (1, 2, 3, 4, 6)
    )
