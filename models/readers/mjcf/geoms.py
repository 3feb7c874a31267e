"""Mass, centre of mass and inertia of MJCF's geoms, from which a body without ``<inertial>`` has its own."""

from __future__ import annotations

import math

import numpy as np

from ...spatial import Inertial, to_quaternion
from ..attributes import Array, not_negative, number, numbers, word, yes
from ..placement import Placement, to_z_axis
from ..shapes import SIZES, shell, solid
from ..xml_file import Element
from .assets import Assets
from .frames import placed, placement_of
from .options import Compiler

DENSITY = 1000.0  # kg/m³, MJCF's default
SMALLEST, LARGEST = 1e-30, 1e9  # m; beyond, volumes are nothing or infinite
LEAST_MASS = 1e-14  # kg; lighter geoms MuJoCo leaves out
KINDS = ("plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf")
FROM_FILES = ("mesh", "sdf", "hfield")
ALONG = ("capsule", "cylinder", "ellipsoid", "box")  # may be given by fromto


def weighs(element: Element) -> bool:
    """Whether a geom, its defaults applied, has mass."""
    if element.get("type", "sphere") == "plane":
        return False
    if "mass" in element.attributes:
        return not_negative(element, "mass") > 0
    return not_negative(element, "density", DENSITY) > 0


def geom_inertial(element: Element, compiler: Compiler, assets: Assets) -> Inertial | None:
    """The inertial of a geom in the frame that it stands in; None where it has no mass.

    ``element`` has its defaults already. Raises :class:`InvalidInput` where its shape is not known.
    """
    kind = word(element, "type", KINDS, "sphere")
    rules = compiler.rules
    if rules.geoms_without_contact_weigh_nothing and not collides(element):
        return None
    if rules.mesh_weighs_one_kilogram and kind in ("mesh", "plane", "hfield"):
        return placed(Inertial(1.0, np.zeros(3), np.eye(3)), placement_of(element, compiler))
    if not weighs(element):
        return None
    unit, placement = _unit(element, kind, compiler, assets)
    mass = not_negative(element, "mass") if "mass" in element.attributes else _density(element) * unit.mass
    if mass <= LEAST_MASS:
        return None
    share = mass / unit.mass
    return placed(Inertial(float(mass), unit.centre, unit.tensor * share), placement)


def geom_placement(element: Element, compiler: Compiler, assets: Assets) -> Placement:
    """Where a geom that is no mesh is, its axes the principal ones, in the frame that it stands in."""
    return _size_and_placement(element, word(element, "type", KINDS, "sphere"), compiler, assets)[1]


def collides(element: Element) -> bool:
    """Whether a geom, its defaults applied, may touch another by its own ``contype`` and ``conaffinity``."""
    return number(element, "contype", 1.0) != 0 or number(element, "conaffinity", 1.0) != 0


def _density(element: Element) -> float:
    return not_negative(element, "density", DENSITY)


def _unit(element: Element, kind: str, compiler: Compiler, assets: Assets) -> tuple[Inertial, Placement]:
    """The inertial with density one in the geom's own frame, and where that is."""
    hollow = yes(element, "shellinertia", False)
    if kind == "sdf":
        raise element.wrong("the link's mass comes from a signed distance field; give the body an <inertial>")
    if kind == "mesh":
        if hollow:
            raise element.wrong("shellinertia: not for a mesh; its <mesh> says inertia='shell'")
        return assets.unit_mesh(element), placement_of(element, compiler)
    size, placement = _size_and_placement(element, kind, compiler, assets)
    if not SMALLEST < float(size.min()) <= float(size.max()) < LARGEST:
        raise element.wrong(f"size: from {SMALLEST:g} to {LARGEST:g} m are taken")
    if hollow and kind == "ellipsoid":
        raise element.wrong(
            "shellinertia: engines only approximate the surface of an ellipsoid; give the body an <inertial>"
        )
    amount, moments = (shell if hollow else solid)("box" if kind == "hfield" else kind, size)
    return Inertial(amount, np.zeros(3), np.diag(amount * moments)), placement


def _size_and_placement(element: Element, kind: str, compiler: Compiler, assets: Assets) -> tuple[Array, Placement]:
    if kind == "hfield":
        return assets.field_box(element), placement_of(element, compiler)
    if element.get("mesh"):
        return _fitted(element, kind, compiler, assets)
    count = SIZES[kind]
    sizes = numbers(element, "size", (1, 3))
    if "fromto" not in element.attributes or kind not in ALONG:
        if len(sizes) < count or (sizes[:count] <= 0).any():
            raise element.wrong(f"size={element.get('size')!r}: {count} positive number{'s' * (count > 1)} needed")
        return sizes[:count], placement_of(element, compiler)
    ends = numbers(element, "fromto", 6)
    span = ends[3:] - ends[:3]
    length = math.hypot(*span)
    if length < 1e-12 or not len(sizes) or sizes[0] <= 0:
        raise element.wrong("fromto: two different points and a positive size needed")
    placement = Placement((ends[:3] + ends[3:]) / 2, to_z_axis(span))
    half = length / 2
    full = np.array([sizes[0], half]) if count == 2 else np.array([sizes[0], sizes[0], half])
    return full, placement


def _fitted(element: Element, kind: str, compiler: Compiler, assets: Assets) -> tuple[Array, Placement]:
    """The primitive that stands for a mesh: sized by the box of the mesh's inertia, shortest axis first."""
    if compiler.fit_box:
        raise element.wrong("fitaabb: a geom fitted to the box around a mesh is not weighed; give it a size instead")
    mesh = assets.unit_mesh(element)
    moments, turn = np.linalg.eigh(mesh.tensor)
    moments, turn = moments[::-1], turn[:, ::-1]
    if np.linalg.det(turn) < 0:
        turn[:, 0] *= -1
    box = np.sqrt(1.5 * np.maximum(moments.sum() - 2 * moments, 0.0) / mesh.mass)
    x, y, z = box
    across = (x + y) / 2
    size = {
        "sphere": [(x + y + z) / 3],
        "capsule": [across, max(0.0, z - across / 2)],
        "cylinder": [across, z],
    }.get(kind, [x, y, z])
    principal = Placement(mesh.centre, to_quaternion(turn))
    scale = not_negative(element, "fitscale", 1.0)
    return scale * np.array(size), placement_of(element, compiler) @ principal
