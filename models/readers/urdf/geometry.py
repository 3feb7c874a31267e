"""What a link's collision geometry weighs at 1000 kg/m³: URDF gives it no mass, MuJoCo does where nothing else has."""

from __future__ import annotations

import numpy as np

from ...spatial import ZERO_INERTIAL, Inertial
from ..attributes import number, numbers
from ..meshes import mesh_inertial, read_mesh
from ..shapes import SIZES, solid
from ..xml_file import Element
from .folders import MeshFolders
from .joints import placement

DENSITY = 1000.0  # kg/m³, MuJoCo's default
SMALLEST, LARGEST = 1e-30, 1e9  # m; beyond, volumes are nothing or infinite


def collision_inertial(link: Element, folders: MeshFolders) -> Inertial:
    """The inertial of all its collision geometry in the link's frame. Raises :class:`InvalidInput`."""
    total = ZERO_INERTIAL
    for collision in link.all("collision"):
        for geometry in collision.all("geometry"):
            for shape in geometry.children[:1]:
                total = total + _weighed(shape, folders).transformed(placement(collision).pose)
    return total


def _weighed(shape: Element, folders: MeshFolders) -> Inertial:
    if shape.tag == "mesh":
        of_one = mesh_inertial(read_mesh(folders.find(shape)), "legacy", tuple(numbers(shape, "scale", 3, (1, 1, 1))))
        return Inertial(DENSITY * of_one.mass, of_one.centre, DENSITY * of_one.tensor)
    if shape.tag == "box":
        size = numbers(shape, "size", 3) / 2
    elif shape.tag in ("sphere", "cylinder", "capsule"):
        size = np.array([number(shape, "radius"), number(shape, "length") / 2])[: SIZES[shape.tag]]
    else:
        raise shape.wrong(f"<{shape.tag[:40]}>: a shape that is not weighed")
    if len(size) < SIZES[shape.tag] or not SMALLEST < size.min() <= size.max() < LARGEST:
        raise shape.wrong(f"sizes from {SMALLEST:g} to {LARGEST:g} m are taken")
    volume, unit = solid(shape.tag, size)
    mass = DENSITY * volume
    return Inertial(mass, np.zeros(3), np.diag(mass * unit))
