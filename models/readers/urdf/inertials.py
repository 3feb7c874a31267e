"""The inertials of URDF's links, as they are written, and as engines read them that do not take them so."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...spatial import ZERO_INERTIAL, Inertial, symmetric
from ..attributes import Array, number
from ..rules import UrdfRules
from ..xml_file import Element
from .extension import Extension
from .folders import MeshFolders
from .geometry import DENSITY, collision_inertial
from .joints import kind_of, placement
from .notes import Notes
from .spaces import space_behind
from .tree import Place

SIX = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
ROUNDED = 1e-9  # relative: principal moments may miss A + B ≥ C by what rounding to ten digits does

NOTHING = 1e-15  # kg m²: MuJoCo takes less than this for none


class Inertials:
    """Reads the inertials of links; ``tensors``: by link, one before its rotation, and that rotation (3, 3)."""

    def __init__(self, rules: UrdfRules, extension: Extension, folders: MeshFolders, notes: Notes) -> None:
        self.tensors: dict[str, tuple[Inertial, Array]] = {}
        self._rules = rules
        self._extension = extension
        self._folders = folders
        self._notes = notes

    def of_links(self, places: Sequence[Place]) -> list[Inertial]:
        """The inertial of each link in its own frame. Raises :class:`InvalidInput` where one is incomplete."""
        found = [self._of_link(place.link) for place in places]
        fixed = [place.joint is not None and kind_of(place.joint) == "fixed" for place in places]
        if self._rules.fixed_massless_inertia_dropped and self._extension.fuses:
            found = [
                ZERO_INERTIAL if is_fixed and inertial.mass == 0 else inertial
                for inertial, is_fixed in zip(found, fixed, strict=True)
            ]
        if self._extension.total_mass > 0:
            found = self._scaled(found, places, fixed)
        return found

    def _of_link(self, link: Element) -> Inertial:
        given = link.first("inertial")
        found = ZERO_INERTIAL if given is None else self._given(given, link.get("name"))
        extension, weigh = self._extension, self._rules.collision_weighs and given is None
        if extension.from_geoms == "true" or (weigh and extension.from_geoms == "auto"):
            low, high = extension.groups
            of_geoms = collision_inertial(link, self._folders) if low <= 0 <= high else ZERO_INERTIAL
            found = of_geoms if of_geoms.mass > 0 else found
        if self._rules.impossible_inertia_becomes_sphere and _impossible(found):
            found = _sphere(found)
        return extension.bounded(found)

    def _given(self, given: Element, link: str) -> Inertial:
        mass_element, moments = given.first("mass"), given.first("inertia")
        if mass_element is None or "value" not in mass_element.attributes:
            raise given.wrong("<mass value=> is needed")
        mass = number(mass_element, "value")
        missing = [name for name in SIX if moments is None or name not in moments.attributes]
        if moments is None or missing:
            raise given.wrong(
                f"<inertia {' '.join(f'{name}=' for name in SIX)}> is needed, {', '.join(missing)} missing"
            )
        tensor = symmetric(*(number(moments, name) for name in SIX))
        if self._rules.space_behind_number_rejected:
            if space_behind(mass_element, "value"):
                return ZERO_INERTIAL
            if space_behind(moments, *SIX):
                tensor = np.zeros((3, 3))
        found = Inertial(mass, np.zeros(3), tensor)
        if _impossible(found):
            self._notes.add(_why(found), given)
        pose = placement(given).pose
        if self._rules.inertial_rotation_lost:
            pose = replace(pose, rotation=np.eye(3))
        self.tensors[link] = (Inertial(mass, pose.translation, tensor), pose.rotation)
        return found.transformed(pose)

    def _scaled(self, inertials: list[Inertial], places: Sequence[Place], fixed: Sequence[bool]) -> list[Inertial]:
        """Those with the masses that ``settotalmass`` gives them: of all links, or of those that move, where the
        others have been fused with the world."""
        still: list[bool] = []
        for place, is_fixed in zip(places, fixed, strict=True):
            still.append(place.joint is None or (is_fixed and still[place.parent]))
        counted = [not (at_rest and self._extension.fuses) for at_rest in still]
        total = sum(inertial.mass for inertial, counts in zip(inertials, counted, strict=True) if counts)
        if total <= 0:
            return inertials
        scale = self._extension.total_mass / total
        return [Inertial(i.mass * scale, i.centre, i.tensor * scale) for i in inertials]


def _impossible(inertial: Inertial) -> bool:
    """Whether no rigid body has it: a negative mass or moment, A + B < C, or an inertia without mass."""
    a, b, c = np.linalg.eigvalsh(inertial.tensor)
    slack = ROUNDED * max(abs(a), abs(c)) + NOTHING
    return bool(
        inertial.mass < 0 or a < -slack or a + b < c - slack or (inertial.mass == 0 and bool(inertial.tensor.any()))
    )


def _why(inertial: Inertial) -> str:
    a, b, c = np.linalg.eigvalsh(inertial.tensor)
    if inertial.mass < 0:
        return "no body has a negative mass; it is read as it stands"
    if inertial.mass == 0:
        return "an inertia without a mass: no body has it; it is read as it stands"
    if a < 0:
        return f"no body has a negative principal moment of inertia ({a:.4g} kg m²); it is read as it stands"
    return f"no body has principal moments {a:.4g}, {b:.4g}, {c:.4g} kg m² (A + B < C); they are read as they stand"


def _sphere(inertial: Inertial) -> Inertial:
    """A ball of water in its place: of its mass, or of one kilogram where it has none."""
    mass = inertial.mass if inertial.mass > 0 else 1.0
    radius = (3 * mass / (4 * math.pi * DENSITY)) ** (1 / 3)
    return Inertial(mass, inertial.centre, np.eye(3) * (2 / 5 * mass * radius * radius))


def weighed_by_meshes(link: Element, rules: UrdfRules) -> bool:
    """Whether an engine with these ``rules`` may weigh the link by a mesh."""
    geometries = (geometry for collision in link.all("collision") for geometry in collision.all("geometry"))
    return (rules.collision_weighs or rules.extension_honoured) and any(g.first("mesh") for g in geometries)
