"""How an engine fails: each way recognised and named, so that none passes for another or for success.

What kills or holds up the process in which an engine runs is seen from outside (:mod:`.searches`); the rest is told
from its answers. A failure is a finding about the engine and never ends a run.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...records.stress import HALF_THE_DIGITS

Array = NDArray[np.float64]

Failure = Literal[
    "half its digits lost",
    "more than rounding",
    "wrong numbers that look right",
    "NaN",
    "silent reset",
    "energy runs away",
    "joints come apart",
    "phase lost",
    "quaternions lose their length",
    "exception",
    "hang",
    "crash",
    "refused",
    "no truth",
]

NO_DIGITS = 0.01  # an error that no one would call rounding: finite, unannounced, and wrong in the second digit


def of_answer(answer: Array, error: float, over: float | None = None) -> Failure | None:
    """The failure of accelerations whose typical relative error is ``error``; None where they will do.

    ``over``: the worst residual over what rounding may do to it; None where that is not known.
    """
    if not np.isfinite(answer).all():
        return "NaN"
    if error >= NO_DIGITS:
        return "wrong numbers that look right"
    if over is not None and over > 1:
        return "more than rounding"
    return "half its digits lost" if error > HALF_THE_DIGITS else None


def of_path(theta: Array, omega: Array) -> tuple[Failure, int] | None:
    """The failure of a run's states (K + 1, n), and at which of them it shows first; None where nothing is.

    A silent reset: a state after the second that is the initial one to the last bit, though the motion had left it.
    Of a motion that does come back no more than digits agree.
    """
    bad = ~(np.isfinite(theta) & np.isfinite(omega)).all(axis=-1)
    back = (theta == theta[0]).all(axis=-1) & (omega == omega[0]).all(axis=-1)
    moved = ~back
    seen_moving = np.concatenate([[False], np.cumsum(moved)[:-1] > 0])
    reset = back & seen_moving
    found: list[tuple[int, Failure]] = []
    if bad.any():
        found.append((int(bad.argmax()), "NaN"))
    if reset.any():
        found.append((int(reset.argmax()), "silent reset"))
    if not found:
        return None
    state, failure = min(found)
    return failure, state


def of_energy(energy: Array, scale: float, most: float) -> int | None:
    """The first of a run's states at which |E - E₀| exceeds ``most`` times ``scale``, or is not finite."""
    with np.errstate(all="ignore"):
        off = ~(np.abs(energy - energy[0]) <= most * scale)
    return int(off.argmax()) if off.any() else None
