"""The true motion of a scene that is followed until trajectories part, in quadruple precision."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..models import InvalidInput, LibraryMissing, Scene
from ..reference.integration.tangents import lyapunov_time
from ..reference.truth.quadruple import quadruple_path

Array = NDArray[np.float64]

STEPS = (1e-2, 5e-3, 1e-3)  # [s]; every one a multiple of the last
LONGEST = 10.0  # [s]
FOLDS = 20.0  # Lyapunov times; a local error of a few roundings has grown past every threshold here by then


def followed(scene: Scene) -> float:
    """How long a scene's motion is followed [s]: a whole number of the longest steps."""
    theta, omega = _start(scene)
    try:
        folding = lyapunov_time(scene.system, np.array(theta), np.array(omega), scene.duration)
    except LibraryMissing:  # without a compiler: as long as can be, which takes longer and shows no less
        folding = LONGEST
    return STEPS[0] * round(min(LONGEST, FOLDS * folding) / STEPS[0])


def true_path(scene: Scene) -> tuple[Array, Array]:
    """The motion at every half of the finest step, for as long as it is followed, (P, 2n): the sum of the two."""
    return path(scene, STEPS[-1] / 2, 2 * round(followed(scene) / STEPS[-1]) + 1)


@lru_cache(maxsize=4)
def path(scene: Scene, spacing: float, points: int) -> tuple[Array, Array]:
    """θ and ω side by side at so many times, ``spacing`` seconds apart, (points, 2n): the sum of the two.

    Of local errors of 1e-30, which grow 5e8 times in twenty Lyapunov times: far below the roundings that are followed.
    """
    return quadruple_path(scene.system, *_start(scene), spacing * np.arange(points, dtype=np.float64))


def _start(scene: Scene) -> tuple[tuple[float, ...], tuple[float, ...]]:
    if scene.theta is None or scene.omega is None:
        raise InvalidInput(f"scene {scene.name!r} has no state for a trajectory to start from")
    return scene.theta, scene.omega
