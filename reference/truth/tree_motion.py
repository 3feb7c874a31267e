"""The motion of an open mechanism, from accelerations that are proved in every state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models.errors import library
from ...models.spatial_mechanism import SpatialMechanism
from ..integration.tree_places import difference, normalised, rates_of_coordinates
from .spatial import spatial_truth

Floats = NDArray[np.float64]

COARSE, FINE = 1e-10, 1e-13  # relative and absolute error of one step


@dataclass(frozen=True)
class TreeMotion:
    """q (T, nq) and v (T, nv) at some times, and how sure both are, (T,); of rotations by the turn that parts them."""

    q: Floats
    v: Floats
    error: Floats


def tree_motion(mechanism: SpatialMechanism, q: Floats, v: Floats, times: Sequence[float]) -> TreeMotion:
    """The state at ``times`` [s], rising, after the state ``q`` (nq,), ``v`` (nv,); quaternions of length one.

    By SciPy's DOP853 in double precision, twice. The errors of its steps are a thousandth in the finer run, so that the
    difference of the two is nearly all the coarser one's error and far more than the finer one's, which is given.
    Raises ArithmeticError where the motion does not come to its end.
    """
    coarse, fine = (_run(mechanism, q, v, times, tolerance) for tolerance in (COARSE, FINE))
    n = mechanism.nq
    apart = np.hstack([difference(mechanism, fine[:, :n], coarse[:, :n]), fine[:, n:] - coarse[:, n:]])
    return TreeMotion(normalised(mechanism, fine[:, :n]), fine[:, n:], np.abs(apart).max(axis=-1))


def _run(mechanism: SpatialMechanism, q: Floats, v: Floats, times: Sequence[float], tolerance: float) -> Floats:
    n = mechanism.nq

    def rates(_time: float, state: Floats) -> Floats:
        at, speed = state[:n], state[n:]
        a = spatial_truth(mechanism, at, speed).accelerations.float
        return np.concatenate([rates_of_coordinates(mechanism, at, speed), a])

    begin = np.concatenate([normalised(mechanism, q), v])
    solved = library("scipy.integrate").solve_ivp(
        rates, (0.0, times[-1]), begin, "DOP853", rtol=tolerance, atol=tolerance, t_eval=times
    )
    if not solved.success or solved.y.shape[1] != len(times):
        raise ArithmeticError(f"the motion does not come to its end: {solved.message}")
    return np.asarray(solved.y.T, dtype=np.float64)
