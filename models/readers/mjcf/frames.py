"""Where MJCF elements are: ``pos``, and one of MJCF's five ways to write a rotation."""

from __future__ import annotations

import math

import numpy as np

from ..attributes import Array, numbers
from ..placement import NO_ROTATION, Placement, about_axis, by_euler, to_x_and_y, to_z_axis
from ..xml_file import Element
from .options import Compiler

ROTATIONS = {"quat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3, "euler": 3}  # and how many numbers each has


def placement_of(element: Element, compiler: Compiler) -> Placement:
    """Where the element is in the frame that it stands in. Raises :class:`InvalidInput`."""
    return Placement(numbers(element, "pos", 3, (0.0, 0.0, 0.0)), _quaternion(element, compiler))


def _quaternion(element: Element, compiler: Compiler) -> Array:
    given = [name for name in ROTATIONS if name in element.attributes]
    if len(given) > 1:
        raise element.wrong(f"{' and '.join(given)}: only one orientation can be given")
    if not given:
        return NO_ROTATION
    name = given[0]
    values = numbers(element, name, ROTATIONS[name])
    if name == "euler":
        return by_euler([compiler.angle(float(v)) for v in values], compiler.sequence)
    direction = values[:3] if name != "quat" else values
    if math.hypot(*direction) < 1e-10 or (
        name == "xyaxes" and np.linalg.norm(np.cross(values[:3], values[3:])) < 1e-10
    ):
        raise element.wrong(f"{name}={element.get(name)!r}: gives no direction")
    if name == "quat":
        return values
    if name == "axisangle":
        return about_axis(values[:3], compiler.angle(float(values[3])))
    return to_x_and_y(values) if name == "xyaxes" else to_z_axis(values)
