"""Rigid bodies in space: poses, rotations as files write them, and inertias transformed, shifted and added.

Rotation matrices act on column vectors: a vector with components v in the rotated frame has R v in the outer one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SQUARED = (
    1e-100,
    1e100,
)  # components in between have squares, and products of these with others, in the range of doubles


def doubles(instance: object, *fields: str) -> None:
    """Turn numbers and arrays of less precision in these fields of a frozen dataclass into doubles, which hold them
    exactly: an engine's adapter would compute with them in single precision otherwise."""
    for name in fields:
        value = getattr(instance, name)
        if isinstance(value, np.ndarray | np.generic) and value.dtype.kind in "iuf" and value.dtype.itemsize <= 8:
            double = float(value) if value.ndim == 0 else np.asarray(value, dtype=np.float64)
            object.__setattr__(instance, name, double)


@dataclass(frozen=True)
class Pose:
    """A frame in an outer frame: the point p of the one is ``rotation`` p + ``translation`` in the other.

    ``rotation`` (3, 3) is orthogonal, ``translation`` (3,) in m. ``a @ b`` is b, given in a, in a's outer frame.
    """

    rotation: Array
    translation: Array

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.rotation @ other.rotation, self.rotation @ other.translation + self.translation)

    def point(self, p: Array) -> Array:
        """A point (3,) of this frame in the outer frame [m]."""
        return np.asarray(self.rotation @ p + self.translation)


IDENTITY = Pose(np.eye(3), np.zeros(3))


@dataclass(frozen=True)
class Inertial:
    """``mass`` [kg], ``centre`` of mass [m] (3,) and inertia ``tensor`` about it [kg m²] (3, 3), in one frame's axes.

    ``a + b``: the inertial of both bodies, fixed together.
    """

    mass: float
    centre: Array
    tensor: Array

    def __post_init__(self) -> None:
        doubles(self, "mass", "centre", "tensor")

    @property
    def weightless(self) -> bool:
        """Whether there is neither mass nor inertia."""
        return not self.mass and not self.tensor.any()

    def transformed(self, pose: Pose) -> Inertial:
        """The same inertial in the outer frame of ``pose``; it is given in the inner one."""
        return Inertial(self.mass, pose.point(self.centre), pose.rotation @ self.tensor @ pose.rotation.T)

    def __add__(self, other: Inertial) -> Inertial:
        if other.weightless:
            return self
        if self.weightless:
            return other
        mass = self.mass + other.mass
        share = other.mass / mass if mass > 0 else 0.5
        centre = self.centre + share * (other.centre - self.centre)
        return Inertial(mass, centre, self.tensor_about(centre) + other.tensor_about(centre))

    def tensor_about(self, point: Array) -> Array:
        """The inertia tensor [kg m²] (3, 3) about ``point`` (3,) [m], by the parallel axis theorem."""
        r = self.centre - point
        return np.asarray(self.tensor + self.mass * (r @ r * np.eye(3) - np.outer(r, r)))


ZERO_INERTIAL = Inertial(0.0, np.zeros(3), np.zeros((3, 3)))


def sized(q: Array) -> Array:
    """Quaternions (..., 4) or axes (..., 3) that can be squared: those whose squares leave the range of doubles are
    divided by their largest component, all others are as they were."""
    largest = np.abs(q).max(axis=-1, keepdims=True, initial=0.0)
    odd = ((largest < SQUARED[0]) | (largest > SQUARED[1])) & (largest > 0)
    return q / np.where(odd, largest, 1.0) if odd.any() else q


def unit(q: Array) -> Array:
    """Quaternions (..., 4) or axes (..., 3), of any length but zero, with length one."""
    with np.errstate(over="ignore"):
        length = np.linalg.norm(q, axis=-1, keepdims=True)
    if not ((length > SQUARED[0]) & (length < SQUARED[1])).all():
        q = sized(q)
        length = np.linalg.norm(q, axis=-1, keepdims=True)
    return np.asarray(q / length)


def from_quaternion(q: Any) -> Array:
    """The rotation matrix (3, 3) of a quaternion (w, x, y, z) of any length but zero."""
    q = np.asarray(q, dtype=np.float64)
    if not SQUARED[0] < math.hypot(*q) < SQUARED[1]:
        q = sized(q)
    w, x, y, z = q / math.hypot(*q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def to_quaternion(rotation: Array) -> Array:
    """The unit quaternion (w, x, y, z), w ≥ 0, of a rotation matrix.

    The eigenvector of the largest eigenvalue of Bar-Itzhack's matrix, well defined at every angle.
    """
    m = rotation
    k = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [0, m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2]],
            [0, 0, m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2]],
            [0, 0, 0, m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    q = np.linalg.eigh(k, UPLO="U")[1][:, -1]
    return np.asarray(q if q[0] >= 0 else -q)


def from_axis_angle(axis: Any, angle: float) -> Array:
    """The rotation matrix by ``angle`` [rad] about ``axis`` (3,), of any length but zero (Rodrigues' formula)."""
    axis = sized(np.asarray(axis, dtype=np.float64))
    x, y, z = axis / math.hypot(*axis)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return np.array(
        [
            [c + x * x * d, x * y * d - z * s, x * z * d + y * s],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d],
        ]
    )


def from_euler(angles: Any, sequence: str) -> Array:
    """Successive rotations [rad] about x, y, z: lower case about the moved axes, upper case about the fixed ones."""
    rotation = np.eye(3)
    for angle, letter in zip(angles, sequence, strict=True):
        step = from_axis_angle(np.eye(3)["xyz".index(letter.lower())], angle)
        rotation = rotation @ step if letter.islower() else step @ rotation
    return rotation


def from_roll_pitch_yaw(angles: Any) -> Array:
    """URDF's ``rpy`` [rad]: about the fixed x, then y, then z."""
    return from_euler(angles, "XYZ")


def from_z_axis(z: Any) -> Array:
    """The rotation by the smallest angle that takes the third axis to the direction of ``z`` (3,)."""
    direction = np.asarray(z, dtype=np.float64) / math.hypot(*z)
    axis = np.cross([0.0, 0.0, 1.0], direction)
    sine = math.hypot(*axis)
    if sine < 1e-300:
        return np.eye(3) if direction[2] > 0 else np.diag([1.0, -1.0, -1.0])
    return from_axis_angle(axis, math.atan2(sine, direction[2]))


def from_x_and_y(six: Any) -> Array:
    """MJCF's ``xyaxes``: first axis along the first three numbers, second in their plane with the last three."""
    x = np.asarray(six[:3], dtype=np.float64) / math.hypot(*six[:3])
    y = np.asarray(six[3:], dtype=np.float64)
    y = y - (x @ y) * x
    y = y / math.hypot(*y)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def symmetric(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> Array:
    """The symmetric tensor (3, 3) of these six components."""
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def components(tensor: Array) -> list[float]:
    """xx, yy, zz, xy, xz, yz of a symmetric tensor (3, 3), as :func:`symmetric` takes them."""
    return [float(tensor[i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
