"""How much of them there is, and the principal moments, of MJCF's primitive shapes, solid and hollow."""

from __future__ import annotations

import math

import numpy as np

from .attributes import Array

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}  # how many sizes each has


def solid(kind: str, size: Array) -> tuple[float, Array]:
    """Volume [m³], and principal moments of inertia (3,) of a unit of mass [m²], of a filled shape.

    ``size`` [m]: radius of a sphere; radius and half length of a capsule or cylinder; half axes of an ellipsoid; half
    sides of a box.
    """
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


def shell(kind: str, size: Array) -> tuple[float, Array]:
    """Surface [m²], and principal moments of inertia (3,) of a unit of mass [m²], of a shape that is all surface.

    ``size`` as in :func:`solid`; no ellipsoid.
    """
    if kind == "sphere":
        r = size[0]
        return 4 * math.pi * r * r, np.full(3, 2 / 3 * r * r)
    if kind == "box":
        return _hollow_box(size)
    r, half = size[0], size[1]
    wall = 4 * math.pi * r * half  # all of it at distance r from the axis
    wall_across = wall * (r * r / 2 + half * half / 3)
    if kind == "cylinder":
        ends = 2 * math.pi * r * r
        surface = wall + ends
        across = wall_across + ends * (r * r / 4 + half * half)
        along = wall * r * r + ends * r * r / 2
    else:
        # Half a hollow sphere has its centre of mass r/2 from the sphere's: (half + r/2)² − (r/2)² is the shift.
        ends = 4 * math.pi * r * r
        surface = wall + ends
        across = wall_across + ends * (2 / 3 * r * r + half * half + r * half)
        along = wall * r * r + ends * 2 / 3 * r * r
    return surface, np.array([across, across, along]) / surface


def _hollow_box(size: Array) -> tuple[float, Array]:
    """Two plates across each axis: each plate is at ± its half side, and reaches over the other two."""
    plates = np.array([size[1] * size[2], size[0] * size[2], size[0] * size[1]])
    second = np.zeros(3)  # ∫ x² over the surface, by axis
    for across in range(3):
        reach = np.where(np.arange(3) == across, 1.0, 1 / 3)
        second += 8 * plates[across] * reach * size[:3] ** 2
    surface = 8 * float(plates.sum())
    return surface, (second.sum() - second) / surface
