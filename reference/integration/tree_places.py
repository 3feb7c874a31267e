"""Places of an open mechanism: coordinates that are moved by what its degrees of freedom move, and their difference.

A hinge's or slide's coordinate, and a free joint's place, are added to. A quaternion is turned about the moved body's
axes by a rotation vector: Q ⊕ x = Q/|Q| · (cos |x|/2, sin(|x|/2) x/|x|), where a body is that has turned at the rates
x/h for a time h. So coordinates (…, nq) and moves (…, nv) go together, in any number type.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import PlacedJoint, SpatialMechanism

Wide = NDArray[Any]
Columns = NDArray[np.intp]

TURNING = ("ball", "free")
SMALL = 1e-2  # [rad]: below it what a series leaves out is less than 1e-18 of a rate, above it what a formula cancels


def plain(mechanism: SpatialMechanism) -> tuple[Columns, Columns]:
    """The columns of q that are no quaternion's, and those of v that are their rates."""
    of_q, of_v = np.ones(mechanism.nq, np.bool_), np.ones(mechanism.nv, np.bool_)
    for at_q, at_v in quaternions(mechanism):
        of_q[at_q] = of_v[at_v] = False
    return np.flatnonzero(of_q), np.flatnonzero(of_v)


def quaternions(mechanism: SpatialMechanism) -> list[tuple[slice, slice]]:
    """Of every ball and free joint its quaternion in q, and its angular velocity in v."""
    return [turning(joint) for joint in mechanism.joints if joint.joint.kind in TURNING]


def turning(joint: PlacedJoint) -> tuple[slice, slice]:
    """A ball's or free joint's quaternion in q, and its angular velocity in v."""
    return slice(joint.columns_q.stop - 4, joint.columns_q.stop), slice(joint.columns_v.stop - 3, joint.columns_v.stop)


def moved(mechanism: SpatialMechanism, q: Wide, by: Wide) -> Wide:
    """q ⊕ by: coordinates (…, nq) after the moves ``by`` (…, nv) [rad, m], quaternions of length one."""
    of_q, of_v = plain(mechanism)
    batch = np.broadcast_shapes(q.shape[:-1], by.shape[:-1])
    found = np.empty((*batch, mechanism.nq), np.result_type(q, by))
    found[..., of_q] = q[..., of_q] + by[..., of_v]
    for at_q, at_v in quaternions(mechanism):
        found[..., at_q] = _product(_unit(q[..., at_q]), _exponential(by[..., at_v]))
    return found


def difference(mechanism: SpatialMechanism, q: Wide, other: Wide) -> Wide:
    """The move (…, nv) from ``q`` to ``other``, (…, nq) both: of a rotation the shorter way round."""
    of_q, of_v = plain(mechanism)
    batch = np.broadcast_shapes(q.shape[:-1], other.shape[:-1])
    found = np.empty((*batch, mechanism.nv), np.result_type(q, other))
    found[..., of_v] = other[..., of_q] - q[..., of_q]
    for at_q, at_v in quaternions(mechanism):
        back = _unit(q[..., at_q]) * np.array([1, -1, -1, -1])
        found[..., at_v] = _vector(_product(back, _unit(other[..., at_q])))
    return found


def normalised(mechanism: SpatialMechanism, q: Wide) -> Wide:
    """q (…, nq) with quaternions of length one."""
    found = q.copy()
    for at, _ in quaternions(mechanism):
        found[..., at] = _unit(q[..., at])
    return found


def rates_of_coordinates(mechanism: SpatialMechanism, q: Wide, v: Wide) -> Wide:
    """dq/dt (…, nq) at the rates v (…, nv): of a quaternion half its product with its rates."""
    found = np.empty_like(q)
    of_q, of_v = plain(mechanism)
    found[..., of_q] = v[..., of_v]
    for at_q, at_v in quaternions(mechanism):
        rate = v[..., at_v]
        found[..., at_q] = _product(q[..., at_q], np.concatenate([0 * rate[..., :1], rate], axis=-1)) / 2
    return found


def rates_of_moves(mechanism: SpatialMechanism, by: Wide, v: Wide) -> Wide:
    """dx/dt (…, nv) of the move x = ``by`` from a fixed place to one that has the rates v (…, nv).

    Of a rotation it is v + x × v / 2 + (1 - t cot t) x × (x × v) / 4t², t = |x|/2: the derivative of the exponential,
    inverted.
    """
    found = v.copy()
    for _, at in quaternions(mechanism):
        x, rate = by[..., at], v[..., at]
        once = np.cross(x, rate)
        found[..., at] = rate + once / 2 + _second(x) * np.cross(x, once)
    return found


def _second(vector: Wide) -> Wide:
    """(1 - t cot t) / 4t², t half the length of a vector (…, 3), or its series 1/12 + t²/180 + t⁴/1890 + t⁶/18900."""
    t = np.sqrt((vector * vector).sum(axis=-1, keepdims=True)) / 2
    large = np.where(t > SMALL, t, 1)
    series = (1 + t**2 / 15 + t**4 * 2 / 315 + t**6 / 1575) / 12
    return np.asarray(np.where(t > SMALL, (1 - large / np.tan(large)) / (4 * large**2), series))


def _unit(quaternion: Wide) -> Wide:
    return np.asarray(quaternion / np.sqrt((quaternion * quaternion).sum(axis=-1, keepdims=True)))


def _exponential(vector: Wide) -> Wide:
    """The rotation by a vector (…, 3) [rad] as a quaternion."""
    angle = np.sqrt((vector * vector).sum(axis=-1, keepdims=True))
    axis = vector / np.where(angle > 0, angle, 1)
    return np.concatenate([np.cos(angle / 2), np.sin(angle / 2) * axis], axis=-1)


def _vector(quaternion: Wide) -> Wide:
    """The shorter rotation that a quaternion of length one stands for, (…, 3) [rad]."""
    w, r = quaternion[..., :1], quaternion[..., 1:]
    size = np.sqrt((r * r).sum(axis=-1, keepdims=True))
    angle = 2 * np.arctan2(size, np.abs(w)) * np.where(w < 0, -1, 1)
    return np.asarray(r * (angle / np.where(size > 0, size, 1)))


def _product(first: Wide, second: Wide) -> Wide:
    """The product of quaternions (…, 4): the second rotation in the axes that the first has moved."""
    a, r, b, s = first[..., :1], first[..., 1:], second[..., :1], second[..., 1:]
    real = a * b - (r * s).sum(axis=-1, keepdims=True)
    return np.concatenate([real, a * s + b * r + np.cross(r, s)], axis=-1)
