"""Richardson's extrapolation to step zero, and its error estimate.

A scheme of order p leaves C h^p + β h^(p+1) + γ h^(p+2) + … after a fixed time. Two runs, 2h and h, eliminate the first
term: E = y(h) + (y(h) - y(2h)) / (2^p - 1). Of four runs come three such values, E₁, E₂, E₃ from coarse to fine. Two of
them differ by the next terms; but where these cancel at one step a single difference tells nothing, so both are used.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def at_step_zero(runs: Sequence[Array], order: int) -> tuple[Array, float]:
    """E₃ of four runs at h, h/2, h/4 and h/8, any shape, and an estimate of the error of its worst entry.

    With A = 2^(p+1) and x = h/8, E₃ = βx^(p+1) + γx^(p+2), β and γ not those of y, and so

        D₁ = E₂ - E₃ = (A - 1) βx^(p+1) + (2A - 1) γx^(p+2),
        D₂ = E₁ - E₂ = A (A - 1) βx^(p+1) + 2A (2A - 1) γx^(p+2).

    Solved for both terms: neither |D₁| nor |D₂| / 2A being more than U, |E₃| ≤ (4/(A - 1) + 3/(2A - 1)) U. That is less
    than U from order 2 on; U is then what later terms may be.
    """
    *_, fine = values = _extrapolated(runs, order)
    a = 2 ** (order + 1)
    coarser, finer = _differences(values)
    return fine, max(1.0, 4 / (a - 1) + 3 / (2 * a - 1)) * max(finer, coarser / (2 * a))


def follows(runs: Sequence[Array], order: int) -> bool:
    """Whether E₁, E₂, E₃ near each other as the next terms make them: D₂ / D₁ is 2^(p+1), 2^(p+2), 2^(p+3) of each.

    It is more where terms cancel in D₁, or where later ones dominate in the coarsest run: E₃ is then less
    certain than at half the step.
    """
    coarser, finer = _differences(_extrapolated(runs, order))
    return coarser <= 2.0 ** (order + 4) * finer


def settles(runs: Sequence[Array], order: int, noise: float) -> bool:
    """Whether E₁, E₂, E₃ near each other at least as fast as the scheme's own error: D₂ ≥ 2^p D₁.

    Less, and the steps are too long for the motion: nothing follows from E₃. Nor does it where the finer runs
    themselves near each other more slowly than half an order below the scheme's. Differences within ``noise`` tell
    nothing.
    """
    coarse, fine = _differences(runs[1:])
    if noise < fine > coarse / 2.0 ** (order - 0.5):
        return False
    coarser, finer = _differences(_extrapolated(runs, order))
    return finer <= noise or coarser >= 2.0**order * finer


def amplified(order: int) -> float:
    """The largest factor by which E₃ multiplies an error of its two runs, such as rounding."""
    return (2.0**order + 1) / (2.0**order - 1)


def _extrapolated(runs: Sequence[Array], order: int) -> list[Array]:
    return [b + (b - a) / (2**order - 1) for a, b in pairwise(runs)]


def _differences(values: Sequence[Array]) -> tuple[float, float]:
    """|D₂| and |D₁|, of their worst entries."""
    coarser, finer = (float(np.abs(b - a).max()) for a, b in pairwise(values))
    return coarser, finer
