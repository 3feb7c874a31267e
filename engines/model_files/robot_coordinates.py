"""From the coordinates of a mechanism, which are MuJoCo's, to an engine's own, and back.

An engine's rates are v' = T(q) v. Here T only reorders columns and turns blocks of three or two of them, so that
T⁻¹ = Tᵀ. With a' = T a + Ṫ v and torque' = T torque the equation M' a' + bias' = torque' becomes

    M = Tᵀ M' T,    bias = Tᵀ (bias' + M' Ṫ v),    a = Tᵀ (a' − Ṫ v).

Ways in which an engine has a joint:

* ``same``: as MuJoCo; ``pair``: an angle as its cosine and sine;
* ``quaternion-last``: a ball's quaternion as x, y, z, w;
* ``free-in-body``: Pinocchio's free joint: pose in the joint's own placement, quaternion last, the velocity of the
  body's origin in the body's axes before the angular velocity: T turns it by Rᵀ, and Ṫ v is −ω × Rᵀẋ;
* ``plane-in-body``: Pinocchio's planar joint: x, y, cosine, sine, the velocity in the moved axes;
* ``roll-pitch-yaw``: Drake's ball: three angles, and the angular velocity in the axes that do not move: T is R;
* ``free-in-world``: Drake's free joint: quaternion, place; first the angular velocity, in world axes: T is R there;
* ``plane``: Drake's planar joint: x, y, angle, along axes of its own in that plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...models.spatial import IDENTITY, Pose, from_quaternion, sized, to_quaternion, unit
from ...models.spatial_mechanism import SpatialMechanism
from ..protocol import Array


@dataclass(frozen=True)
class Block:
    """A joint of an engine: which of the mechanism's ``joints`` it is, how it has them, its first columns.

    ``joints``: indices, one, or for a planar joint its two slides and its hinge. ``placement``: a free joint's.
    ``plane`` (2, 2): takes the two slides' coordinates to those along the engine's axes.
    """

    joints: tuple[int, ...]
    way: str
    at_q: int
    at_v: int
    placement: Pose = IDENTITY
    plane: Array = field(default_factory=lambda: np.eye(2))


@dataclass(frozen=True)
class EngineState:
    """One state in an engine's coordinates, with what is needed to go back.

    ``positions`` (nq',), ``rates`` (nv',), ``drift`` (nv',) = Ṫ v; ``columns`` (nv,): the engine's column of each of
    the mechanism's freedoms; ``turns``: the engine's columns that are turned, and by what.
    """

    positions: Array
    rates: Array
    drift: Array
    columns: NDArray[np.intp]
    turns: tuple[tuple[slice, Array], ...]

    def theirs(self, vector: Array) -> Array:
        """T x, for rates and for forces (nv,)."""
        made = np.empty_like(vector)
        made[self.columns] = vector
        for columns, turn in self.turns:
            made[columns] = turn @ made[columns]
        return made

    def ours(self, vector: Array) -> Array:
        """Tᵀ x', for rates and for forces (nv,)."""
        made = np.array(vector, dtype=np.float64)
        for columns, turn in self.turns:
            made[columns] = turn.T @ made[columns]
        return made[self.columns]

    def our_matrix(self, matrix: Array) -> Array:
        """Tᵀ M' T, (nv, nv)."""
        made = np.array(matrix, dtype=np.float64)
        for columns, turn in self.turns:
            made[columns, :] = turn.T @ made[columns, :]
            made[:, columns] = made[:, columns] @ turn
        return made[np.ix_(self.columns, self.columns)]


class RobotCoordinates:
    """The conversion for a mechanism whose joints an engine has as ``blocks``."""

    def __init__(self, mechanism: SpatialMechanism, blocks: Sequence[Block], nq: int) -> None:
        self._placed, self._blocks, self._nq = mechanism.joints, tuple(blocks), nq
        columns = np.empty(mechanism.nv, dtype=np.intp)
        for block in self._blocks:
            at = block.at_v
            for index in block.joints:
                placed = self._placed[index]
                theirs = np.arange(at, at + placed.joint.freedoms)
                columns[placed.columns_v] = np.roll(theirs, 3) if block.way == "free-in-world" else theirs
                at += placed.joint.freedoms
        self._columns = columns

    def state(self, q: Array, v: Array) -> EngineState:
        """One state, q (nq,) and v (nv,), in the engine's coordinates."""
        positions, drift = np.zeros(self._nq), np.zeros(len(v))
        turns: list[tuple[slice, Array]] = []
        rates = np.empty(len(v))
        rates[self._columns] = v
        for block in self._blocks:
            self._position(block, q, positions)
            turned = self._turn(block, q)
            if turned is None:
                continue
            columns, turn = turned
            rates[columns] = turn @ rates[columns]
            turns.append((columns, turn))
            if block.way in {"free-in-body", "plane-in-body"}:
                drift[columns] = self._drift(block, rates)
        return EngineState(positions, rates, drift, self._columns, tuple(turns))

    def _position(self, block: Block, q: Array, into: Array) -> None:
        at, placed = block.at_q, self._placed[block.joints[0]]
        own = q[placed.columns_q]
        if block.way == "same":
            into[at : at + placed.joint.coordinates] = _unit(own, placed.joint.kind)
        elif block.way == "pair":
            into[at : at + 2] = np.cos(own[0]), np.sin(own[0])
        elif block.way == "quaternion-last":
            into[at : at + 4] = _last(own)
        elif block.way == "free-in-body":
            turned = block.placement.rotation.T
            into[at : at + 3] = turned @ (own[:3] - block.placement.translation)
            into[at + 3 : at + 7] = _last(_times(_conjugate(block.placement.rotation), sized(own[3:])))
        elif block.way == "roll-pitch-yaw":
            into[at : at + 3] = roll_pitch_yaw(from_quaternion(own))
        elif block.way == "free-in-world":
            into[at : at + 4], into[at + 4 : at + 7] = unit(own[3:]), own[:3]
        else:
            x, y, angle = (float(q[self._placed[index].at_q]) for index in block.joints)
            if block.way == "plane":
                into[at : at + 3] = [*(block.plane @ [x, y]), angle]
            else:
                into[at : at + 4] = x, y, np.cos(angle), np.sin(angle)

    def _turn(self, block: Block, q: Array) -> tuple[slice, Array] | None:
        if block.way == "free-in-body":
            quaternion = q[self._placed[block.joints[0]].columns_q][3:]
            return slice(block.at_v, block.at_v + 3), from_quaternion(quaternion).T
        if block.way == "plane-in-body":
            angle = q[self._placed[block.joints[2]].at_q]
            c, s = np.cos(angle), np.sin(angle)
            return slice(block.at_v, block.at_v + 2), np.array([[c, s], [-s, c]])
        if block.way in {"roll-pitch-yaw", "free-in-world"}:
            quaternion = q[self._placed[block.joints[0]].columns_q][-4:]
            return slice(block.at_v, block.at_v + 3), from_quaternion(quaternion)
        if block.way == "plane":
            return slice(block.at_v, block.at_v + 2), block.plane
        return None

    @staticmethod
    def _drift(block: Block, rates: Array) -> Array:
        """−ω × the turned velocity: the moved axes turn under a velocity that stays."""
        at = block.at_v
        if block.way == "free-in-body":
            return -np.cross(rates[at + 3 : at + 6], rates[at : at + 3])
        along, across, turning = rates[at : at + 3]
        return np.array([turning * across, -turning * along])


def _unit(own: Array, kind: str) -> Array:
    """A joint's coordinates with its quaternion of length one."""
    if kind in {"ball", "free"}:
        return np.concatenate([own[:-4], unit(own[-4:])])
    return own


def _last(quaternion: Array) -> Array:
    """Of length one, as x, y, z, w."""
    return np.roll(unit(quaternion), -1)


def _conjugate(rotation: Array) -> Array:
    """The quaternion (w, x, y, z) of the inverse of a rotation matrix; exactly one for the identity."""
    if np.array_equal(rotation, np.eye(3)):
        return np.array([1.0, 0.0, 0.0, 0.0])
    return to_quaternion(rotation.T)


def _times(a: Array, b: Array) -> Array:
    """The product of two quaternions (w, x, y, z)."""
    w, u = a[0], a[1:]
    return np.concatenate([[w * b[0] - u @ b[1:]], w * b[1:] + b[0] * u + np.cross(u, b[1:])])


def roll_pitch_yaw(rotation: Array) -> Array:
    """The angles (3,) of the rotation about the fixed x, then y, then z, |pitch| ≤ π/2.

    Yaw is computed from what the rotation leaves when roll is undone, so that the three give the rotation back to
    rounding where pitch is near a right angle and roll is badly determined.
    """
    r = rotation
    roll = np.arctan2(r[2, 1], r[2, 2])
    s, c = np.sin(roll), np.cos(roll)
    pitch = np.arctan2(-r[2, 0], s * r[2, 1] + c * r[2, 2])
    yaw = np.arctan2(s * r[0, 2] - c * r[0, 1], c * r[1, 1] - s * r[1, 2])
    return np.array([roll, pitch, yaw])
