"""Where one frame is in another, with its rotation as a quaternion, which no product takes far from a rotation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..spatial import Pose, from_quaternion, from_x_and_y, to_quaternion
from .attributes import Array


@dataclass(frozen=True, eq=False)
class Placement:
    """A frame's ``position`` (3,) [m] and ``quaternion`` (4,) (w, x, y, z), of any length but zero, in an outer frame.

    ``a @ b`` is b, given in a, in a's outer frame. ``matrix`` (3, 3): what an engine turns by that has no rotation.
    """

    position: Array
    quaternion: Array
    matrix: Array | None = None

    @property
    def pose(self) -> Pose:
        """The same with the rotation as a matrix."""
        return Pose(from_quaternion(self.quaternion) if self.matrix is None else self.matrix, self.position)

    def __matmul__(self, other: Placement) -> Placement:
        return Placement(self.pose.point(other.position), product(self.quaternion, other.quaternion))


NO_ROTATION = np.array([1.0, 0.0, 0.0, 0.0])
HERE = Placement(np.zeros(3), NO_ROTATION)


def product(a: Any, b: Any) -> Array:
    """The quaternion of the rotation ``b`` followed, about the outer axes, by ``a``."""
    w, x, y, z = a
    return np.array(
        [
            w * b[0] - x * b[1] - y * b[2] - z * b[3],
            w * b[1] + x * b[0] + y * b[3] - z * b[2],
            w * b[2] - x * b[3] + y * b[0] + z * b[1],
            w * b[3] + x * b[2] - y * b[1] + z * b[0],
        ]
    )


def about_axis(axis: Any, angle: float) -> Array:
    """The quaternion of the rotation by ``angle`` [rad] about ``axis`` (3,), of any length but zero."""
    if angle == 0:
        return NO_ROTATION
    direction = np.asarray(axis, dtype=np.float64) / math.hypot(*axis)
    return np.concatenate([[math.cos(angle / 2)], math.sin(angle / 2) * direction])


def about_any_axis(axis: Any, angle: float) -> Array:
    """Rodrigues' formula with ``axis`` (3,) as it is: a rotation matrix (3, 3) only where its length is one."""
    a = np.asarray(axis, dtype=np.float64)
    cosine, across = math.cos(angle), np.cross(np.eye(3), a)
    return np.asarray(cosine * np.eye(3) + math.sin(angle) * across + (1 - cosine) * np.outer(a, a))


def by_euler(angles: Any, sequence: str) -> Array:
    """Successive rotations [rad] about x, y, z: lower case about the moved axes, upper case about the fixed ones."""
    turned = NO_ROTATION
    for angle, letter in zip(angles, sequence, strict=True):
        step = about_axis(np.eye(3)["xyz".index(letter.lower())], float(angle))
        turned = product(turned, step) if letter.islower() else product(step, turned)
    return turned


def to_z_axis(direction: Any) -> Array:
    """The quaternion of the smallest rotation that takes the third axis to ``direction`` (3,); for −z, about x."""
    z = np.asarray(direction, dtype=np.float64) / math.hypot(*direction)
    across = np.array([-z[1], z[0], 0.0])
    sine = math.hypot(*across)
    if sine == 0:
        return NO_ROTATION if z[2] > 0 else np.array([0.0, 1.0, 0.0, 0.0])
    return about_axis(across, math.atan2(sine, z[2]))


def to_x_and_y(six: Any) -> Array:
    """The quaternion of MJCF's ``xyaxes``: x along the first three numbers, y in their plane with the last three."""
    return to_quaternion(from_x_and_y(six))
