"""The lever arms in an engine's velocities and moments, at their largest over all configurations.

Every length is that of a path along the links: no configuration has two points further apart than that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models import PlanarTree
from ...models.coordinates import absolute_from_relative
from ...models.tree import SUPPORT

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Levers:
    """Lengths [m], (n, n): row i for the engine's coordinate i, column k for link k; zero where i does not move k.

    ``arm``: from the hinge of coordinate i by the point about which the engine takes moments of link k to link k's
    centre of mass; ``to_point``: its first part, to that point, or None where the engine takes no moments but adds up
    the documents' sums.
    """

    arm: Array
    to_point: Array | None


def longest(several: Sequence[Levers]) -> Levers:
    """The longest of several sets in each entry: what bounds sums with any of them."""
    to_points = [levers.to_point for levers in several if levers.to_point is not None]
    return Levers(np.max([levers.arm for levers in several], axis=0), np.max(to_points, axis=0) if to_points else None)


def absolute_levers(tree: PlanarTree) -> Levers:
    """Lever arms of absolute angles: each moves its own link's part of the path to a centre of mass."""
    return Levers(_parts(tree)[1], None)


def relative_levers(tree: PlanarTree) -> Levers:
    """Lever arms of hinge angles, moments of each link about its own hinge: the path there, then to the centre."""
    carries = absolute_from_relative(tree.parents).T
    to_hinge, to_centre = _parts(tree)
    return Levers(carries @ to_centre, carries @ to_hinge)


def tree_levers(tree: PlanarTree) -> tuple[Levers, Levers]:
    """Lever arms of hinge angles, all moments taken about the whole tree's centre of mass; and their errors over ε.

    The centre of mass is the mean of the links', so that its path to a point is at most the mean of theirs, H_a to
    hinge a and D_k to centre k: the arm is D_k + H_a, and may be many times the true distance between the two. All
    points are placed in the world, each by a sum as long as the path P to it from the support, and known to P ε. The
    error of the centre of mass itself has no effect: moments may be taken about any point.
    """
    n = tree.n
    carries = absolute_from_relative(tree.parents).T
    roots = list(tree.roots())
    same_tree = carries[roots].T @ carries[roots]  # 1 where two links are of one tree
    weights = same_tree * [link.mass for link in tree.links]
    path = path_lengths(tree)[:, n:]
    to_hinge, to_centre = from_support(tree)
    mean = (path * np.vstack([weights, weights])).sum(axis=-1) / np.tile(weights.sum(axis=-1), 2)
    about = Levers(carries * (mean[n:] + mean[:n, None]), carries * mean[:n, None])
    placed = to_hinge[:, None]
    return about, Levers(carries * (to_centre + placed), carries * placed)


def world_levers(tree: PlanarTree) -> Levers:
    """Lever arms of hinge angles, all moments taken about the world's origin: from the hinge there, then to the centre.

    They are as long as the ways by which the points are placed, so that what the places are off by is no more.
    """
    carries = absolute_from_relative(tree.parents).T
    to_hinge, to_centre = from_support(tree)
    return Levers(carries * (to_hinge[:, None] + to_centre), carries * to_hinge[:, None])


def world_errors(tree: PlanarTree) -> Levers:
    """Errors over ε of the lever arms where a reader takes hinge places on links as differences of places in the world.

    Each place is then known to ε times the path from the support. On the path from hinge i to link k there are up to n
    of them, none further from the support than hinge k. A link's own centre of mass is not affected.
    """
    carries = absolute_from_relative(tree.parents).T - np.eye(tree.n)
    off = carries * from_support(tree)[0]
    return Levers(off, off)


def from_support(tree: PlanarTree) -> tuple[Array, Array]:
    """Lengths [m] of the paths from the support to each hinge and each centre of mass, (n,) each."""
    roots = list(tree.roots())
    held = absolute_from_relative(tree.parents)[:, roots] @ [np.hypot(*tree.links[root].hinge) for root in roots]
    to_hinge, to_centre = _parts(tree)
    return to_hinge.sum(axis=0) + held, to_centre.sum(axis=0) + held


def differences_lost(tree: PlanarTree) -> list[float]:
    """What each hinge's place on its parent loses [m] as the difference of two places in the world, in doubles.

    With all angles zero, along the links: places are added up from the support, and a difference is taken of each two.
    """
    world: list[float] = []
    lost: list[float] = []
    for link in tree.links:
        along = link.hinge[0]
        before = 0.0 if link.parent == SUPPORT else world[link.parent]
        world.append(before + along)
        lost.append((world[-1] - before) - along)
    return lost


def path_lengths(tree: PlanarTree) -> Array:
    """Lengths [m] of the paths along the links between any two of the n hinges and n centres of mass, (2n, 2n).

    From a hinge on a link to any point: the shortest path by the link's own hinge, its centre of mass or another hinge
    on it. Points of different trees, which no sum brings together, are left at zero.
    """
    n = tree.n
    path = np.zeros((2 * n, 2 * n))
    points: list[tuple[list[int], list[tuple[float, float]]]] = []  # what is fixed to each link, and where
    for i, link in enumerate(tree.links):
        points.append(([i, n + i], [(0.0, 0.0), link.com]))
        known = np.r_[0:i, n : n + i]
        if link.parent != SUPPORT:
            fixed, places = points[link.parent]
            gaps = np.hypot(*(np.array(places) - link.hinge).T)
            path[i, known] = path[known, i] = (gaps[:, None] + path[np.ix_(fixed, known)]).min(axis=0)
            fixed.append(i)
            places.append(link.hinge)
        reached = np.r_[known, i]
        path[n + i, reached] = path[reached, n + i] = path[i, reached] + np.hypot(*link.com)
    return path


def _parts(tree: PlanarTree) -> tuple[Array, Array]:
    """Each link's part (row) of the path to each hinge and each centre of mass (column), (n, n) each."""
    to_hinge = np.zeros((tree.n, tree.n))
    for k, link in enumerate(tree.links):
        if link.parent != SUPPORT:
            to_hinge[:, k] = to_hinge[:, link.parent]
            to_hinge[link.parent, k] += np.hypot(*link.hinge)
    return to_hinge, to_hinge + np.diag([np.hypot(*link.com) for link in tree.links])
