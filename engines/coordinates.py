"""Absolute angles, which furiko speaks, and an engine's own: relative ones, in the engine's order of joints.

The change itself is that of :mod:`furiko.models.coordinates`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ..models.coordinates import forces_to_absolute, to_absolute, to_relative

Array = NDArray[np.float64]


class RelativeCoordinates:
    """The change between absolute angles and an engine's relative ones, for rows of states (B, n).

    ``parents``: each link's parent, coming before it; ``columns``: where the engine keeps each link's hinge, in the
    links' order where left out.
    """

    def __init__(self, parents: Sequence[int], columns: Sequence[int] | None = None) -> None:
        self._parents = tuple(map(int, parents))
        self._columns = np.arange(len(self._parents)) if columns is None else np.asarray(columns, dtype=np.intp)

    def relative(self, absolute: Array) -> Array:
        """q = S⁻¹ θ, in the engine's order."""
        own = to_relative(self._parents, absolute)
        relative = np.empty_like(own)
        relative[:, self._columns] = own
        return relative

    def rows(self, *absolute: Array) -> Iterator[tuple[Array, ...]]:
        """State after state, each of the given arrays (B, n) relative and in the engine's order, (n,)."""
        return zip(*map(self.relative, absolute), strict=True)

    def absolute(self, relative: Array) -> Array:
        """θ = S q."""
        return to_absolute(self._parents, relative[:, self._columns])

    def absolute_matrix(self, relative: Array) -> Array:
        """S D S⁻¹, (B, n, n), of derivatives D of relative accelerations by relative angles or rates."""
        columns = self._by_forces(relative)  # row i of D S⁻¹ is S⁻ᵀ times row i of D
        return self._of_accelerations(columns)

    def absolute_inverse_mass(self, relative: Array) -> Array:
        """S X Sᵀ, (B, n, n), of the inverse X of the mass matrix of relative angles."""
        rows = self._of_accelerations(relative.swapaxes(1, 2))
        return self._of_accelerations(rows.swapaxes(1, 2))

    def _of_accelerations(self, matrix: Array) -> Array:
        """S times a matrix (B, n, m) whose rows are in the engine's order."""
        count, n, wide = matrix.shape
        columns = matrix.swapaxes(1, 2).reshape(-1, n)
        return self.absolute(columns).reshape(count, wide, n).swapaxes(1, 2)

    def _by_forces(self, matrix: Array) -> Array:
        """A matrix (B, m, n) whose columns are in the engine's order, times S⁻¹."""
        return self.absolute_forces(matrix.reshape(-1, matrix.shape[-1])).reshape(matrix.shape)

    def absolute_forces(self, relative: Array) -> Array:
        """τ_abs = S⁻ᵀ τ_rel."""
        return forces_to_absolute(self._parents, relative[:, self._columns])


def along_across(points: Iterable[Sequence[float] | Array]) -> Array:
    """Points (x, y, z) of links that hang along -z at angle zero, as (along, across) of the planar tree, (n, 2)."""
    return np.array([(-z, x) for x, _, z in points])
