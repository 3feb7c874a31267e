"""Numbers of two readings held together: when they are the same, and how a difference is told."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ...models.readers.mjcf.inertials import POINT_MASS_BOUND
from ...models.spatial import Inertial, components
from ...models.spatial_mechanism import Array, Joint
from ...reference.rounding.bounds import EPSILON
from .moving_links import MovingLink

# Readers turn frames into one another, diagonalise tensors and add up meshes: 1e-14 of the sizes where both are right.
# What is written with ten digits or fewer is far beyond this.
SAME = 1e-11
NUMBERS = ("armature", "damping", "friction", "stiffness")  # of a joint, zero where it is ideal
UNITS_TURNING = {"armature": "kg m²", "damping": "N m s/rad", "friction": "N m", "stiffness": "N m/rad"}
UNITS_SLIDING = {"armature": "kg", "damping": "N s/m", "friction": "N", "stiffness": "N/m"}
CAUSE_OF = {"friction": "dry-friction"}


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


def largest_length(links: Iterable[MovingLink]) -> float:
    """The length [m] that distances are held against: of the whole mechanism, so that a tiny link is not over-read.

    Radii of gyration too: of one free body, whose mesh is centred to rounding, nothing else is a length.
    """
    links = tuple(links)
    arms = [float(np.linalg.norm(seen.arm)) for link in links for seen in link.joints]
    centres = [float(np.linalg.norm(link.inertial.centre)) for link in links]
    weighed = [link.inertial for link in links if link.inertial.mass > 0]
    radii = [math.sqrt(max(0.0, float(np.trace(inertial.tensor))) / 2 / inertial.mass) for inertial in weighed]
    return max([*arms, *centres, *radii], default=0.0) or 1.0


def joint_numbers(theirs: Joint, ours: Joint, limits: bool, ignored: frozenset[str]) -> Iterator[FieldDifference]:
    """What a joint has besides its place: ``limits`` and the numbers that are ``ignored`` as in the comparison."""
    where, units = f"joint {ours.name!r}", UNITS_SLIDING if ours.kind == "slide" else UNITS_TURNING
    for name in NUMBERS:
        found, wanted = getattr(theirs, name), getattr(ours, name)
        size = abs(found - wanted) / max(abs(found), abs(wanted), 1e-300)
        if name not in ignored and size > SAME:
            yield FieldDifference(CAUSE_OF.get(name, name), where, name, found, wanted, units[name], size)
    spring = ours.stiffness and theirs.stiffness and ours.kind in ("hinge", "slide")
    if spring and "stiffness" not in ignored:
        yield from coordinate_difference("spring-reference", "springref", theirs, ours)
    if limits and not _same_limits(theirs.limits, ours.limits):
        found_, wanted_ = theirs.limits or "none", ours.limits or "none"
        yield FieldDifference("joint-limit", where, "limits", str(found_), str(wanted_), "", 1.0)


def coordinate_difference(cause: str, name: str, theirs: Joint, ours: Joint) -> Iterator[FieldDifference]:
    """Of a hinge or slide the coordinate that is called ``name``: nothing where it is the same."""
    found, wanted = getattr(theirs, name), getattr(ours, name)
    if abs(found - wanted) > SAME * max(abs(wanted), 1.0):
        unit = "m" if ours.kind == "slide" else "rad"
        yield FieldDifference(cause, f"joint {ours.name!r}", name, found, wanted, unit, abs(found - wanted))


def axis_difference(theirs: Array, ours: Array, where: str, turn: Array) -> FieldDifference | None:
    """Two axes of a joint, unit vectors (3,): None where they are the same, as they are or with ``theirs`` turned."""
    size = apart(theirs, ours, turn)
    if not size > SAME:
        return None
    cause = "angle-convention" if np.linalg.norm(theirs + ours) <= SAME else "joint-axis"
    return FieldDifference(cause, where, "axis", plain(theirs), plain(ours), "", size)


def _same_limits(found: tuple[float, float] | None, expected: tuple[float, float] | None) -> bool:
    if found is None or expected is None:
        return found is expected
    return bool(np.allclose(found, expected, rtol=SAME, atol=SAME))


def inertial_differences(
    theirs: Inertial, ours: Inertial, where: str, turn: Array, length: float, uncertain: float
) -> Iterator[FieldDifference]:
    """Mass, centre and tensor of two inertials, in the axes that they are given in or with ``theirs`` turned.

    ``turn`` (3, 3); ``length`` [m]: of the mechanism; ``uncertain`` [kg m²]: how far apart tensors may be besides.
    """
    heavy = max(abs(theirs.mass), abs(ours.mass))
    if abs(theirs.mass - ours.mass) > SAME * heavy:
        size = abs(theirs.mass - ours.mass) / heavy
        yield FieldDifference("mass", where, "mass", theirs.mass, ours.mass, "kg", size)
    if ours.mass and theirs.mass:
        size = apart(theirs.centre, ours.centre, turn) / max(length, 1e-300)
        if size > SAME:
            yield FieldDifference(
                "com-displaced", where, "centre of mass", plain(theirs.centre), plain(ours.centre), "m", size
            )
    largest = max(float(np.abs(theirs.tensor).max()), float(np.abs(ours.tensor).max()))
    # A tensor about the centre of mass is a difference of larger ones where bodies are fixed together.
    rounding = 64 * EPSILON * heavy * length**2 + uncertain
    if not ours.tensor.any():  # a point mass, which MuJoCo compiles with as much
        rounding += 2 * POINT_MASS_BOUND
    if largest:
        far = min(
            float(np.abs(theirs.tensor - ours.tensor).max()),
            float(np.abs(turn @ theirs.tensor @ turn.T - ours.tensor).max()),
        )
        if far > SAME * largest + rounding:
            found, wanted = components(theirs.tensor), components(ours.tensor)
            yield FieldDifference("inertia", where, "inertia", found, wanted, "kg m²", far / largest)


def uncertain_tensor(mesh_axes: float, meshes: float) -> float:
    """How far apart tensors may be that are kept in principal axes to so many digits [kg m²].

    Three products of inertia of at most e each make up a tensor of the norm 2 e, whatever the axes.
    """
    return 2 * mesh_axes * meshes


def apart(found: Array, expected: Array, turn: Array) -> float:
    """How far two vectors are apart, as they are or with the first one turned, if that is less."""
    return float(min(np.linalg.norm(found - expected), np.linalg.norm(turn @ found - expected)))


def plain(values: Iterable[float]) -> list[float]:
    """An array's numbers, as Python has them."""
    return [float(value) for value in values]
