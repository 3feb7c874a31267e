"""Sensitivity of a tree's motion to its state: slopes of its accelerations, and the tangent flow along a path.

Of mechanisms of hinges and slides. The slopes are central differences in extended precision, sure to some ten digits.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import SpatialMechanism
from ..kernels.trees.plain import in_extended_precision
from ..kernels.trees.table import table
from . import schemes

Floats = NDArray[np.float64]
Wide = NDArray[Any]

NUDGE = 2.0**-16  # [rad, m] and of rates: its square is what a difference neglects, its quotient with ε what it loses


def accelerations(mechanism: SpatialMechanism, q: Wide, v: Wide) -> Wide:
    """a of states (B, nv), in their arithmetic. Raises ArithmeticError where a state has none."""
    found = in_extended_precision(table(mechanism), q, v)
    if not np.isfinite(found).all():
        raise ArithmeticError("there are states without accelerations")
    return found


def slopes(mechanism: SpatialMechanism, q: Floats, v: Floats) -> tuple[Floats, Floats]:
    """∂a/∂q and ∂a/∂v in each state, (B, nv, nv); q, v (B, nv)."""
    start = np.stack([q, v]).astype(np.longdouble)
    n = mechanism.nv
    columns = [
        (accelerations(mechanism, *(start + nudge)) - accelerations(mechanism, *(start - nudge))) / (2 * NUDGE)
        for nudge in NUDGE * np.eye(2 * n).reshape(-1, 2, 1, n)
    ]
    by = np.stack(columns, axis=-1).astype(np.float64)
    return by[..., :n], by[..., n:]


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
