"""Mass, centre of mass and inertia of MJCF's geoms, from which a body without ``<inertial>`` has its own."""

from __future__ import annotations

import math

import numpy as np

from ...spatial import Inertial, Pose, from_z_axis
from ..attributes import Array, not_negative, numbers
from ..xml_file import Element

DENSITY = 1000.0  # kg/m³, MJCF's default
SOLID = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}  # and how many sizes each has
SMALLEST, LARGEST = 1e-30, 1e9  # m; beyond, volumes are nothing or infinite
MASSLESS = ("plane", "hfield")
ALONG = ("capsule", "cylinder", "ellipsoid", "box")  # may be given by fromto


def geom_inertial(element: Element, frame: Pose) -> Inertial | None:
    """The inertial of a geom in its body's frame; None where it has no mass.

    ``element`` has its defaults already; ``frame`` is its pose in the body. Raises :class:`InvalidInput` for a shape
    that is defined in another file (a mesh).
    """
    kind = element.get("type", "sphere")
    if kind in MASSLESS:
        return None
    given = "mass" in element.attributes
    if (given and not_negative(element, "mass") == 0) or (not given and not_negative(element, "density", DENSITY) == 0):
        return None
    if kind not in SOLID:
        raise element.wrong(
            f"the link's mass comes from a geom of type {kind!r:.40}, whose shape furiko does not load; give the body "
            "an <inertial>, or the geom mass='0'"
        )
    if element.get("shellinertia") == "true":
        raise element.wrong("shellinertia: not supported; give the body an <inertial>")
    size, pose = _size_and_pose(element, kind, frame)
    if not SMALLEST < float(size[: SOLID[kind]].min()) <= float(size.max()) < LARGEST:
        raise element.wrong(f"size: from {SMALLEST:g} to {LARGEST:g} m are taken")
    volume, unit = _solid(kind, size)
    mass = not_negative(element, "mass") if given else not_negative(element, "density", DENSITY) * volume
    return Inertial(mass, np.zeros(3), np.diag(mass * unit)).transformed(pose)


def _size_and_pose(element: Element, kind: str, frame: Pose) -> tuple[Array, Pose]:
    count = SOLID[kind]
    sizes = numbers(element, "size", (1, 3))
    if "fromto" not in element.attributes or kind not in ALONG:
        if len(sizes) < count or (sizes[:count] <= 0).any():
            raise element.wrong(f"size={element.get('size')!r}: {count} positive number{'s' * (count > 1)} needed")
        return sizes, frame
    ends = numbers(element, "fromto", 6)
    span = ends[3:] - ends[:3]
    length = math.hypot(*span)
    if length < 1e-12 or not len(sizes) or sizes[0] <= 0:
        raise element.wrong("fromto: two different points and a positive size needed")
    # MuJoCo turns the geom's z axis to point from the second end to the first.
    pose = Pose(from_z_axis(-span), (ends[:3] + ends[3:]) / 2)
    half = length / 2
    full = np.array([sizes[0], half]) if count == 2 else np.array([sizes[0], sizes[0], half])
    return full, pose


def _solid(kind: str, size: Array) -> tuple[float, Array]:
    """Volume [m³], and principal moments of inertia (3,) of a unit of mass [m²]."""
    if kind == "sphere":
        r = size[0]
        return 4 / 3 * math.pi * r**3, np.full(3, 2 / 5 * r * r)
    if kind == "box":
        x, y, z = size[:3] ** 2
        return 8 * float(np.prod(size[:3])), np.array([y + z, x + z, x + y]) / 3
    if kind == "ellipsoid":
        x, y, z = size[:3] ** 2
        return 4 / 3 * math.pi * float(np.prod(size[:3])), np.array([y + z, x + z, x + y]) / 5
    r, half = size[0], size[1]
    height = 2 * half
    if kind == "cylinder":
        across = (3 * r * r + height * height) / 12
        return math.pi * r * r * height, np.array([across, across, r * r / 2])
    # A capsule: a cylinder and the two halves of a sphere, whose centres of mass are 3r/8 beyond its ends.
    body, ball = math.pi * r * r * height, 4 / 3 * math.pi * r**3
    volume = body + ball
    across = body * (3 * r * r + height * height) / 12 + ball * (2 / 5 * r * r + half * half + 3 / 4 * r * half)
    along = body * r * r / 2 + ball * 2 / 5 * r * r
    return volume, np.array([across, across, along]) / volume
