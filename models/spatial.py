"""Rigid bodies in space: how files write rotations, and how inertias are turned, moved and added."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Where a frame is in another: ``turn`` (3, 3) and ``shift`` [m] (3,); a point p of it is turn·p + shift there."""

    turn: Array
    shift: Array

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.turn @ other.turn, self.turn @ other.shift + self.shift)

    def point(self, p: Array) -> Array:
        """A point of this frame in the other."""
        return np.asarray(self.turn @ p + self.shift)


HERE = Pose(np.eye(3), np.zeros(3))


@dataclass(frozen=True)
class Inertial:
    """Mass [kg], centre of mass [m] (3,) and inertia tensor about it [kg m²] (3, 3), in some frame's axes."""

    mass: float
    centre: Array
    tensor: Array

    def seen_from(self, pose: Pose) -> Inertial:
        """The same in the frame that ``pose`` is given in."""
        return Inertial(self.mass, pose.point(self.centre), pose.turn @ self.tensor @ pose.turn.T)

    def __add__(self, other: Inertial) -> Inertial:
        if other.mass == 0 and not other.tensor.any():
            return self
        if self.mass == 0 and not self.tensor.any():
            return other
        mass = self.mass + other.mass
        share = other.mass / mass if mass > 0 else 0.5
        centre = self.centre + share * (other.centre - self.centre)
        return Inertial(mass, centre, self.about(centre) + other.about(centre))

    def about(self, point: Array) -> Array:
        """The tensor about another point."""
        r = self.centre - point
        return np.asarray(self.tensor + self.mass * (r @ r * np.eye(3) - np.outer(r, r)))


NOTHING = Inertial(0.0, np.zeros(3), np.zeros((3, 3)))


def from_quaternion(q: Any) -> Array:
    """The rotation of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = np.asarray(q, dtype=np.float64) / math.hypot(*q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def to_quaternion(turn: Array) -> Array:
    """The quaternion (w, x, y, z) of a rotation: the eigenvector that belongs to it, well defined at every angle."""
    m = turn
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


def about(axis: Any, angle: float) -> Array:
    """The rotation by ``angle`` [rad] about ``axis``, of any length but zero."""
    x, y, z = np.asarray(axis, dtype=np.float64) / math.hypot(*axis)
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
    turn = np.eye(3)
    for angle, letter in zip(angles, sequence, strict=True):
        step = about(np.eye(3)["xyz".index(letter.lower())], angle)
        turn = turn @ step if letter.islower() else step @ turn
    return turn


def from_roll_pitch_yaw(angles: Any) -> Array:
    """URDF's ``rpy`` [rad]: about the fixed x, then y, then z."""
    return from_euler(angles, "XYZ")


def from_z_axis(z: Any) -> Array:
    """The least rotation that takes the third axis to ``z``."""
    direction = np.asarray(z, dtype=np.float64) / math.hypot(*z)
    axis = np.cross([0.0, 0.0, 1.0], direction)
    sine = math.hypot(*axis)
    if sine < 1e-300:
        return np.eye(3) if direction[2] > 0 else np.diag([1.0, -1.0, -1.0])
    return about(axis, math.atan2(sine, direction[2]))


def from_x_and_y(six: Any) -> Array:
    """The rotation whose first axis is along the first three numbers, the second in their plane with the last three."""
    x = np.asarray(six[:3], dtype=np.float64) / math.hypot(*six[:3])
    y = np.asarray(six[3:], dtype=np.float64)
    y = y - (x @ y) * x
    y = y / math.hypot(*y)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def symmetric(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> Array:
    """The symmetric tensor of these six."""
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
