"""Where MJCF elements are: ``pos``, and one of MJCF's five ways to write a rotation."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ...spatial import Inertial, to_quaternion
from ..attributes import Array, numbers
from ..placement import NO_ROTATION, Placement, about_any_axis, about_axis, by_euler, to_x_and_y, to_z_axis
from ..xml_file import Element
from .options import Compiler

ROTATIONS = {"quat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3, "euler": 3}  # and how many numbers each has
SAME_LENGTH = 1e-14  # of one: an axis that is off by some roundings is of length one


def placement_of(element: Element, compiler: Compiler) -> Placement:
    """Where the element is in the frame that it stands in. Raises :class:`InvalidInput`."""
    position, quaternion = numbers(element, "pos", 3, (0.0, 0.0, 0.0)), _quaternion(element, compiler)
    if compiler.rules.axis_not_normalised and "axisangle" in element.attributes:
        given = numbers(element, "axisangle", 4)
        if abs(math.hypot(*given[:3]) - 1) > SAME_LENGTH:
            return _turned_by_no_rotation(position, about_any_axis(given[:3], compiler.angle(float(given[3]))))
    return Placement(position, quaternion)


def placed(inertial: Inertial, placement: Placement) -> Inertial:
    """A geom's ``inertial``, given in its frame, in the frame that the geom's ``placement`` is given in."""
    turned = inertial.transformed(placement.pose)
    if placement.matrix is None:
        return turned
    # Pinocchio turns S, which is symmetric, with 15 products: R(S − S₃₃)Rᵀ + S₃₃ and, last, what keeps the trace.
    last = float(inertial.tensor[2, 2])
    tensor = placement.matrix @ (inertial.tensor - last * np.eye(3)) @ placement.matrix.T + last * np.eye(3)
    tensor[0, 0] = np.trace(inertial.tensor) - tensor[1, 1] - tensor[2, 2]
    return replace(turned, tensor=tensor)


def _turned_by_no_rotation(position: Array, matrix: Array) -> Placement:
    """A geom or inertial is turned by the ``matrix``; Pinocchio completes its first two columns for a body."""
    x, y = matrix[:, 0], matrix[:, 1]
    return Placement(position, to_quaternion(np.column_stack([x, y, np.cross(x, y)])), matrix)


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
