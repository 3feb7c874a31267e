"""The spread that rounding gives to terms and accelerations of a mechanism in space, entry by entry.

As :mod:`..rounding.sampled` in the plane: inverse dynamics (RNEA) and articulated bodies (ABA), :mod:`.dynamics`, are
run in Monte-Carlo arithmetic, each joint at its own point. An engine that takes moments about the centre of mass of all
that hangs together (MuJoCo) has bodies placed in the world first, and its spatial vectors at that point.

The mass matrix is what unit accelerations take, a column each. Engines that factorise it have the accelerations' spread
of M⁻¹ (δM a + δbias), rows taken as independent, δM with the last digits of the factors (Higham, theorem 10.3).
"""

from __future__ import annotations

import contextlib

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import SpatialMechanism
from ..rounding.bounds import EPSILON, interchanged
from ..rounding.monte_carlo import ONE_ROUNDING, spread
from ..rounding.spatial import components
from ..rounding.spread import Formulation
from . import dynamics
from .joints import Run, placed_joints

Array = NDArray[np.float64]

OF_A_FORCE = 4.0  # of a spring's and a damper's: differences, products and sums, and what is added to the bias


def mass_matrix(how: Formulation, mechanism: SpatialMechanism, q: Array) -> Array:
    """The spread of each entry of M, (B, nv, nv), in states ``q`` (B, nq)."""
    count, nv = len(q), mechanism.nv
    columns = np.tile(np.eye(nv), (count, 1))
    each = _inverse_dynamics(how, mechanism, np.repeat(q, nv, axis=0), 0 * columns, columns, 0.0)
    exact, spreads = (part.reshape(count, nv, nv).swapaxes(1, 2) for part in each)
    for axis in (1, 2):
        spreads = _in_any_axes(how, mechanism, exact, spreads, axis)
    return spreads


def bias(how: Formulation, mechanism: SpatialMechanism, q: Array, v: Array) -> Array:
    """The spread of each row of the bias, (B, nv); at rest, of gravity's share of it."""
    return _in_any_axes(how, mechanism, *_inverse_dynamics(how, mechanism, q, v, 0 * v, 1.0), 1)


def _in_any_axes(how: Formulation, mechanism: SpatialMechanism, exact: Array, spreads: Array, axis: int) -> Array:
    """Spreads along ``axis`` where an engine may have the components of a vector in other axes than MuJoCo's.

    Each is then a sum of all three, and has the last digits of the longest.
    """
    found = spreads.copy()
    for three in components(mechanism):
        part = (slice(None),) * axis + (three,)
        size = np.linalg.norm(exact[part], axis=axis, keepdims=True) * ONE_ROUNDING * _coarser(how)
        found[part] = np.hypot(np.linalg.norm(spreads[part], axis=axis, keepdims=True), size)
    return found


def accelerations(
    how: Formulation,
    mechanism: SpatialMechanism,
    q: Array,
    v: Array,
    exact: Array,
    mass: Array,
    torque: Array,
    terms: Array,
) -> Array:
    """The spread of each acceleration, (B, nv), around the ``exact`` ones.

    ``mass``: M (B, nv, nv); ``torque``: what acts along each freedom besides gravity, (B, nv), a sum of ``terms`` of
    that magnitude.
    """
    if how.algorithm == "aba":
        run = Run(mechanism, how, q)
        pushed = [run.off(column, OF_A_FORCE * size) for column, size in zip(torque.T, terms.T, strict=True)]
        found = run.values(dynamics.forward_dynamics(run, v, pushed, [float(g) for g in mechanism.gravity]))
        return _in_any_axes(how, mechanism, exact, spread(found, exact), 1)
    factors = ONE_ROUNDING * _coarser(how) * _factors(how, mass)
    met = mass_matrix(how, mechanism, q) ** 2 + factors**2
    lost = OF_A_FORCE * ONE_ROUNDING * _coarser(how) * terms
    rows = (met @ (exact**2)[..., None])[..., 0] + bias(how, mechanism, q, v) ** 2 + lost**2
    inverse = np.linalg.inv(mass)
    return _in_any_axes(how, mechanism, exact, np.sqrt((inverse**2 @ rows[..., None])[..., 0]), 1)


def _factors(how: Formulation, mass: Array) -> Array:
    """Σ|terms| of each entry of the factors' product, (B, nv, nv): |L||Lᵀ| of a factorisation from the last freedom up.

    It leaves what is zero between two branches so. Where it cannot be known, its bound √M_ii √M_jj; and where rows are
    interchanged, what meets in them then.
    """
    if how.interchanges is False:
        with contextlib.suppress(np.linalg.LinAlgError):  # too near to singular
            factor = np.abs(np.linalg.cholesky(mass[:, ::-1, ::-1]))
            return np.asarray((factor @ factor.swapaxes(1, 2))[:, ::-1, ::-1])
    root = np.sqrt(np.diagonal(mass, axis1=1, axis2=2))
    bound = np.asarray(root[:, :, None] * root[:, None, :])
    return bound if how.interchanges is False else np.maximum(bound, interchanged(mass))


def _inverse_dynamics(
    how: Formulation, mechanism: SpatialMechanism, q: Array, v: Array, accelerations: Array, gravity: float
) -> tuple[Array, Array]:
    """Generalised forces (B, nv) and their spread; ``gravity``: times the mechanism's own."""
    run = Run(mechanism, how, q)
    down = [gravity * float(g) for g in mechanism.gravity]
    values = run.values(dynamics.inverse_dynamics(run, placed_joints(run, how.moments), v, accelerations, down))
    middle = values.mean(axis=0)
    return middle, spread(values, middle)


def _coarser(how: Formulation) -> float:
    return how.accuracy / EPSILON
