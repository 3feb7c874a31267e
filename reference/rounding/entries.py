"""Magnitudes of each entry of the mass matrix of an engine's own coordinates, and in its levers, in a given state.

Magnitudes that rounding is relative to, before they cancel: of an entry as its factorisation adds it up, and of
distances as differences of the points that the engine knows.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, PlanarTree
from ...models.tree import SUPPORT
from .bounds import Amplitudes, interchanged

Array = NDArray[np.float64]


class Geometry(Protocol):
    """Of an engine: where its rounding arises, see ``engines.EngineInfo``."""

    @property
    def coordinates(self) -> str: ...
    @property
    def moments(self) -> str: ...
    @property
    def interchanges(self) -> bool | None: ...


def entries(how: Geometry, system: DocumentSystem, amplitude: Amplitudes, theta: Array, mass: Array) -> Array:
    """F_ij of :mod:`.spread`, (B, n, n) [kg m²]; ``mass``: the absolute mass matrix at each state (B, n)."""
    own = amplitude.own_matrix(mass)
    met = interchanged(own) if how.interchanges else _cholesky(own)
    if how.moments == "tree":
        met = met + _about_the_centre_of_mass(system.tree(), amplitude, theta)
    if amplitude.errors is not None and how.moments != "tree":
        cross = (levers(system.tree(), amplitude, theta) * amplitude.mass) @ amplitude.errors.arm.T
        met = met + cross + cross.swapaxes(1, 2)
    return met


def reach(how: Geometry, system: DocumentSystem, amplitude: Amplitudes, theta: Array) -> Array:
    """Lengths that meet in the lever of coordinate i (row) to the centre of mass of link k, (B, n, n) [m]."""
    if how.coordinates != "relative":
        return np.broadcast_to(amplitude.levers.arm, (len(theta), *amplitude.levers.arm.shape))
    tree = system.tree()
    found = levers(tree, amplitude, theta)
    if how.moments == "tree":
        hinge, centre = (np.abs(points) for points in places(tree, theta))
        found = found + 2 * amplitude.carried.T * (hinge[:, :, None] + centre[:, None, :])
    elif amplitude.errors is not None:
        found = found + amplitude.errors.arm
    return found


def levers(tree: PlanarTree, amplitude: Amplitudes, theta: Array) -> Array:
    """Distance from hinge i (row) to the centre of mass of each link k that it carries, (B, n, n) [m]."""
    hinge, centre = places(tree, theta)
    return np.asarray(amplitude.carried.T * np.abs(centre[:, None, :] - hinge[:, :, None]))


def places(tree: PlanarTree, theta: Array) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Hinges and centres of mass from the support, (B, n) each: down + i × to +x [m]."""
    turn = np.exp(1j * theta)
    hinge, centre = np.empty_like(turn), np.empty_like(turn)
    for i, link in enumerate(tree.links):
        held = complex(*link.hinge)
        hinge[:, i] = held if link.parent == SUPPORT else hinge[:, link.parent] + held * turn[:, link.parent]
        centre[:, i] = hinge[:, i] + complex(*link.com) * turn[:, i]
    return hinge, centre


def speeds(tree: PlanarTree, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Of each link's hinge and centre of mass, (B, n) each [m/s]."""
    turning = omega * np.exp(1j * theta)
    hinge, centre = np.zeros_like(turning), np.empty_like(turning)
    for i, link in enumerate(tree.links):
        if link.parent != SUPPORT:
            hinge[:, i] = hinge[:, link.parent] + complex(*link.hinge) * turning[:, link.parent]
        centre[:, i] = hinge[:, i] + complex(*link.com) * turning[:, i]
    return np.abs(hinge), np.abs(centre)


def _cholesky(own: Array) -> Array:
    """|L|ᵀ|L| of M = LᵀL, eliminated from the tips, as engines do it."""
    try:
        lower = np.abs(np.linalg.cholesky(own[:, ::-1, ::-1]))
    except np.linalg.LinAlgError:  # but for rounding it has no factors: at most the product of the diagonals' roots
        root = np.sqrt(np.abs(np.diagonal(own, axis1=1, axis2=2)))
        return np.asarray(root[:, :, None] * root[:, None, :])
    return np.asarray((lower @ lower.swapaxes(1, 2))[:, ::-1, ::-1])


def _about_the_centre_of_mass(tree: PlanarTree, amplitude: Amplitudes, theta: Array) -> Array:
    """Of an entry whose inertias and axes are taken about the whole tree's centre of mass, in the world.

    The distances to it are longer than those that count and cancel, and each is a difference of places in the world.
    """
    hinge, centre = places(tree, theta)
    mass, carries = amplitude.mass, amplitude.carried.T
    middle = (centre @ mass / mass.sum())[:, None]
    arm = carries * (np.abs(centre - middle)[:, None, :] + np.abs(hinge - middle)[:, :, None])
    known = carries * (np.abs(centre)[:, None, :] + np.abs(hinge)[:, :, None])
    cross = (levers(tree, amplitude, theta) * mass) @ known.swapaxes(1, 2)
    inertias = (carries * amplitude.inertia) @ carries.T
    return np.asarray((arm * mass) @ arm.swapaxes(1, 2) + inertias + cross + cross.swapaxes(1, 2))
