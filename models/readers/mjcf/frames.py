"""Poses of MJCF elements: ``pos``, and one of MJCF's five ways to write a rotation."""

from __future__ import annotations

import math

import numpy as np

from ...spatial import Pose, from_axis_angle, from_euler, from_quaternion, from_x_and_y, from_z_axis
from ..attributes import Array, numbers
from ..xml_file import Element
from .options import Compiler

ROTATIONS = {"quat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3, "euler": 3}  # and how many numbers each has


def pose_of(element: Element, compiler: Compiler) -> Pose:
    """The element's pose in the frame that it stands in. Raises :class:`InvalidInput`."""
    return Pose(_rotation(element, compiler), numbers(element, "pos", 3, (0.0, 0.0, 0.0)))


def _rotation(element: Element, compiler: Compiler) -> Array:
    given = [name for name in ROTATIONS if name in element.attributes]
    if len(given) > 1:
        raise element.wrong(f"{' and '.join(given)}: only one orientation can be given")
    if not given:
        return np.eye(3)
    name = given[0]
    values = numbers(element, name, ROTATIONS[name])
    if name == "euler":
        return from_euler([compiler.angle(float(v)) for v in values], compiler.sequence)
    direction = values[:3] if name != "quat" else values
    if math.hypot(*direction) < 1e-10 or (
        name == "xyaxes" and np.linalg.norm(np.cross(values[:3], values[3:])) < 1e-10
    ):
        raise element.wrong(f"{name}={element.get(name)!r}: gives no direction")
    if name == "quat":
        return from_quaternion(values)
    if name == "axisangle":
        return from_axis_angle(values[:3], compiler.angle(float(values[3])))
    return from_x_and_y(values) if name == "xyaxes" else from_z_axis(values)
