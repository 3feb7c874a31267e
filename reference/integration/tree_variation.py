"""Sensitivity of a tree's motion to its state: slopes of its accelerations, and the tangent flow along a path.

The slopes are central differences in extended precision, sure to some ten digits; the flow is of mechanisms of hinges
and slides.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import SpatialMechanism
from ..kernels.trees.plain import in_extended_precision
from ..kernels.trees.springs import sprung
from ..kernels.trees.table import kept_table
from . import schemes
from .tree_places import moved, quaternions

Floats = NDArray[np.float64]
Wide = NDArray[Any]

NUDGE = 2.0**-16  # [rad, m] and of rates: its square is what a difference neglects, its quotient with ε what it loses
MOST = 2**22  # numbers in memory at a time


def accelerations(mechanism: SpatialMechanism, q: Wide, v: Wide) -> Wide:
    """a of states q (B, nq), v (B, nv), in their arithmetic. Raises ArithmeticError where a state has none."""
    found = in_extended_precision(kept_table(mechanism), q, v, sprung(mechanism, q, None))
    if not np.isfinite(found).all():
        raise ArithmeticError("there are states without accelerations")
    return found


def slopes(mechanism: SpatialMechanism, q: Floats, v: Floats) -> tuple[Floats, Floats]:
    """∂a/∂q and ∂a/∂v in each state, (B, nv, nv); q (B, nq), v (B, nv).

    By places as :func:`.tree_places.moved` moves them: of rotations by turns about the moved body's axes.
    """
    n = mechanism.nv
    by = _differences(mechanism, q, v, NUDGE * np.eye(2 * n)).astype(np.float64)
    return by[..., :n], by[..., n:]


def rate_slopes(mechanism: SpatialMechanism, q: Floats, v: Floats) -> Wide:
    """∂a/∂v in each state, (B, nv, nv), in extended precision: a is quadratic in rates, so that any nudge is exact."""
    nothing, unit = np.zeros((mechanism.nv,) * 2), np.eye(mechanism.nv)
    return _differences(mechanism, q, v, np.hstack([nothing, unit]))


def _differences(mechanism: SpatialMechanism, q: Floats, v: Floats, nudges: Floats) -> Wide:
    """(a(+) − a(−)) / 2 for each of some nudges of places and rates (K, 2 nv), over its size, (B, nv, K)."""
    wide_q, wide_v, n = q.astype(np.longdouble), v.astype(np.longdouble), mechanism.nv
    parts = math.ceil(2 * len(nudges) * len(q) * kept_table(mechanism).size / MOST)
    columns = []
    for some in np.array_split(nudges[:, None], max(parts, 1)):
        both = np.stack([some, -some])
        at_q = moved(mechanism, wide_q, both[..., :n]).reshape(-1, mechanism.nq)
        ends = accelerations(mechanism, at_q, (wide_v + both[..., n:]).reshape(-1, n))
        more, less = ends.reshape(*both.shape[:2], len(q), n)
        columns.append((more - less) / (2 * np.abs(some).max(axis=-1, keepdims=True)))
    return np.moveaxis(np.concatenate(columns), 0, -1)


def fastest_turn(mechanism: SpatialMechanism, v: Floats) -> float:
    """The largest rate at which a joint turns in states (B, nv) [rad/s]."""
    hinges = [abs(v[:, one.at_v]).max() for one in mechanism.joints if one.joint.kind == "hinge"]
    others = [np.linalg.norm(v[:, at], axis=-1).max() for _, at in quaternions(mechanism)]
    return max(map(float, (*hinges, *others)), default=0.0)


def tree_flow(mechanism: SpatialMechanism, q: Floats, v: Floats, step: float) -> Floats:
    """Φ of each step along a path, (K, 2 nv, 2 nv), as :func:`furiko.reference.integration.variation.tangent_flow`.

    ``q``, ``v``: the path at K + 1 times, ``step`` [s] apart, and at those half-way between, (2K + 1, nv).
    """
    by_q, by_v = slopes(mechanism, q, v)
    n = mechanism.nv
    J = np.zeros((len(q), 2 * n, 2 * n))
    J[:, :n, n:] = np.eye(n)
    J[:, n:, :n], J[:, n:, n:] = by_q, by_v
    at = {0.0: J[0:-1:2], 0.5: J[1::2], 1.0: J[2::2]}
    return np.asarray(schemes.classical_step(lambda part, flow: at[part] @ flow, np.eye(2 * n), step))
