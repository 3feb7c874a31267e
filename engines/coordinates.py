"""Absolute angles, which furiko speaks, and an engine's own: each hinge's angle relative to the link that carries it.

With θ = S q (a link's absolute angle is the sum of the relative ones from the support to it), rates and accelerations
follow the same rule, and generalised forces the transposed one: τ_abs = S⁻ᵀ τ_rel.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..models.tree import SUPPORT

Array = NDArray[np.float64]


class RelativeCoordinates:
    """The change between absolute angles and an engine's relative ones, for rows of states (B, n).

    ``parents``: each link's parent, coming before it; ``columns``: where the engine keeps each link's hinge, in the
    links' order where left out. One subtraction or addition a link and a state, hence exact for numbers that are all
    multiples of one power of two and not too large.
    """

    def __init__(self, parents: Sequence[int], columns: Sequence[int] | None = None) -> None:
        self._parents = np.asarray(parents, dtype=np.intp)
        self._carried = np.flatnonzero(self._parents != SUPPORT)
        self._columns = np.arange(len(self._parents)) if columns is None else np.asarray(columns, dtype=np.intp)
        self._generations = _generations(self._parents)

    def relative(self, absolute: Array) -> Array:
        """q = S⁻¹ θ, in the engine's order."""
        own = absolute.copy()
        own[:, self._carried] -= absolute[:, self._parents[self._carried]]
        relative = np.empty_like(own)
        relative[:, self._columns] = own
        return relative

    def absolute(self, relative: Array) -> Array:
        """θ = S q."""
        angles = relative[:, self._columns]
        for links in self._generations:
            angles[:, links] += angles[:, self._parents[links]]
        return angles

    def absolute_forces(self, relative: Array) -> Array:
        """τ_abs = S⁻ᵀ τ_rel: each hinge's torque less those of the hinges that the link carries."""
        torques = relative[:, self._columns]
        forces = torques.copy()
        for link in self._carried:
            forces[:, self._parents[link]] -= torques[:, link]
        return forces


def _generations(parents: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """The links carried by links on the support, then those carried by these, and so on."""
    depth = np.zeros(len(parents), dtype=np.intp)
    for link, parent in enumerate(parents):
        if parent != SUPPORT:
            depth[link] = depth[parent] + 1
    by_depth = np.argsort(depth, kind="stable")
    starts = np.searchsorted(depth[by_depth], np.arange(1, depth.max(initial=0) + 1))
    return np.split(by_depth, starts)[1:]
