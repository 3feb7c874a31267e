"""The truth about one scene of an open mechanism, computed once and shared by every engine's cells."""

from __future__ import annotations

import io
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ...models import TreeScene
from ...models.trees.states import TreeStates
from ...reference.truth.spatial import energy, spatial_truth
from ...reference.truth.spatial_derivatives import spatial_derivatives
from ...reference.truth.tree_end_points import end_points, moves, times
from ..facts import FORCE_STATES, PARTS, slope_states

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TreeFacts:
    """``high + low``: the proven accelerations, (B, nv), to far more than double precision.

    The nearest doubles of the proven ``mass_matrix`` (B, nv, nv), ``bias``, ``gravity``, ``passive`` (B, nv) and
    ``energy`` (B, 2): kinetic and potential. ``times`` (T,) [s], ``end_q`` (T, nq) and ``end_v`` (T, nv), ``end_error``
    (T,): the scene's motion and how sure it is, T = 0 where it has none. ``slopes``, ``slopes_low``: ∂a/∂q, ∂a/∂v and
    M⁻¹ in the last states, (K, 3, nv, nv), K = 0 where no engine is asked, or the mechanism has balls or free joints.
    ``forces``: the true joint forces in the last states, in the accelerations ``high``, (min(B, 20), links, 6).
    """

    high: Array
    low: Array
    mass_matrix: Array
    bias: Array
    gravity: Array
    passive: Array
    energy: Array
    times: Array
    end_q: Array
    end_v: Array
    end_error: Array
    slopes: Array
    slopes_low: Array
    forces: Array

    def to_bytes(self) -> bytes:
        """The arrays as one npz file, which is read without running anything."""
        with io.BytesIO() as file:
            np.savez(file, **{field.name: getattr(self, field.name) for field in fields(self)})
            return file.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> TreeFacts:
        """The reverse."""
        with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
            return cls(**{field.name: arrays[field.name] for field in fields(cls)})

    def error(self, accelerations: Array) -> Array:
        """``accelerations`` less the true ones, to double precision's relative accuracy."""
        return (accelerations - self.high) - self.low


def tree_facts(scene: TreeScene, states: TreeStates, *, motion: bool = True, slopes: bool = True) -> TreeFacts:
    """Compute them in ball arithmetic, the ``motion`` and the derivatives (``slopes``) too if asked for.

    Raises ArithmeticError where a state has no accelerations, or the motion no end.
    """
    mechanism = scene.system.mechanism()
    truths = [spatial_truth(mechanism, q, v) for q, v in zip(states.q, states.v, strict=True)]
    nv = mechanism.nv
    slopes_high, slopes_low = _slopes(scene, states, slope_states(nv) if slopes and differentiable(scene) else 0)
    accelerations = [truth.accelerations.enclosure for truth in truths]
    high = np.array([each.high for each in accelerations]).reshape(-1, nv)
    chosen = slice(-FORCE_STATES, None)
    forces = [truth.joint_forces(a).float for truth, a in zip(truths[chosen], high[chosen], strict=True)]
    return TreeFacts(
        high=high,
        low=np.array([each.low for each in accelerations]).reshape(-1, nv),
        mass_matrix=np.array([truth.mass_matrix.float for truth in truths]).reshape(-1, nv, nv),
        bias=np.array([truth.bias.float for truth in truths]).reshape(-1, nv),
        gravity=np.array([truth.gravity.float for truth in truths]).reshape(-1, nv),
        passive=np.array([truth.passive.float for truth in truths]).reshape(-1, nv),
        energy=np.array(
            [energy(mechanism, q, v).float for q, v in zip(states.q, states.v, strict=True)],
        ).reshape(-1, 2),
        slopes=slopes_high,
        slopes_low=slopes_low,
        forces=np.array(forces).reshape(len(forces), -1, 6),
        **_motion(scene if motion and moves(scene) else None),
    )


def differentiable(scene: TreeScene) -> bool:
    """Whether derivatives by positions are the same in every convention: hinges and slides alone."""
    return not {"ball", "free"} & scene.system.features


def _slopes(scene: TreeScene, states: TreeStates, count: int) -> tuple[Array, Array]:
    """High and low parts of the three matrices in the last ``count`` states, (count, 3, nv, nv) each."""
    mechanism = scene.system.mechanism()
    first = max(0, len(states.q) - count)
    each = [spatial_derivatives(mechanism, q, v) for q, v in zip(states.q[first:], states.v[first:], strict=True)]
    shape = (-1, 3, mechanism.nv, mechanism.nv)
    high, low = (
        np.array([[getattr(getattr(found, part), side) for part in PARTS] for found in each]).reshape(shape)
        for side in ("high", "low")
    )
    return high, low


def _motion(scene: TreeScene | None) -> dict[str, Array]:
    if scene is None:
        return {"times": np.zeros(0), "end_q": np.zeros((0, 0)), "end_v": np.zeros((0, 0)), "end_error": np.zeros(0)}
    found = end_points(scene)
    return {"times": np.array(times(scene)), "end_q": found.q, "end_v": found.v, "end_error": found.error}
