"""Absolute angles θ and relative ones q of a tree of links: a link's relative angle is its own less its parent's.

With S of θ = S q (an absolute angle is the sum of the relative ones on the path from the support), rates and
accelerations follow the same rule, and generalised forces the transposed one: τ_rel = Sᵀ τ_abs.

``parents`` is each link's parent, coming before it, or :data:`.tree.SUPPORT`. Values have the shape (…, n), one a link;
they are left as they are. One addition or subtraction a link, hence exact for numbers that are all multiples of one
power of two and not too large.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .tree import SUPPORT

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


def to_relative(parents: tuple[int, ...], absolute: Array) -> Array:
    """q = S⁻¹ θ of angles [rad], rates or accelerations."""
    links, their_parents = _on_links(parents)
    relative = absolute.copy()
    relative[..., links] -= absolute[..., their_parents]
    return relative


def to_absolute(parents: tuple[int, ...], relative: Array) -> Array:
    """θ = S q of angles [rad], rates or accelerations."""
    absolute = relative.copy()
    for links, their_parents in _generations(parents):
        absolute[..., links] += absolute[..., their_parents]
    return absolute


def forces_to_relative(parents: tuple[int, ...], forces: Array) -> Array:
    """τ_rel = Sᵀ τ_abs [N m]: each hinge's torque is the sum over its subtree."""
    relative = forces.copy()
    for link in range(len(parents) - 1, -1, -1):
        if parents[link] != SUPPORT:
            relative[..., parents[link]] += relative[..., link]
    return relative


def forces_to_absolute(parents: tuple[int, ...], forces: Array) -> Array:
    """τ_abs = S⁻ᵀ τ_rel [N m]: each hinge's torque less those of the link's children."""
    absolute = forces.copy()
    for link, parent in enumerate(parents):
        if parent != SUPPORT:
            absolute[..., parent] -= forces[..., link]
    return absolute


def absolute_from_relative(parents: tuple[int, ...]) -> Array:
    """S of θ = S q, shape (n, n): 1 where the link of the row is the column's or in its subtree, else 0."""
    matrix = np.eye(len(parents))
    for link, parent in enumerate(parents):
        if parent != SUPPORT:
            matrix[link] += matrix[parent]
    return matrix


@lru_cache(maxsize=64)
def _on_links(parents: tuple[int, ...]) -> tuple[Indices, Indices]:
    """The links whose parent is a link, and these parents."""
    indices = np.asarray(parents, dtype=np.intp)
    links = np.flatnonzero(indices != SUPPORT)
    return links, indices[links]


@lru_cache(maxsize=64)
def _generations(parents: tuple[int, ...]) -> tuple[tuple[Indices, Indices], ...]:
    """Links and their parents: first the children of links on the support, then the children of these, and so on."""
    indices = np.asarray(parents, dtype=np.intp)
    depth = np.zeros(len(parents), dtype=np.intp)
    for link, parent in enumerate(parents):
        if parent != SUPPORT:
            depth[link] = depth[parent] + 1
    by_depth = np.argsort(depth, kind="stable")
    starts = np.searchsorted(depth[by_depth], np.arange(1, depth.max(initial=0) + 1))
    return tuple((links, indices[links]) for links in np.split(by_depth, starts)[1:])
