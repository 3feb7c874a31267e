"""Writes the mechanism of a scene of an open mechanism as MJCF or URDF."""

from __future__ import annotations

from ..trees.scene import TreeScene
from .spatial_mjcf import spatial_mjcf
from .spatial_urdf import spatial_urdf


def tree_to_mjcf(scene: TreeScene) -> str:
    """As an MJCF document. Raises :class:`InvalidInput` as :func:`spatial_mjcf` does."""
    return spatial_mjcf(scene.system.mechanism(), scene.name)


def tree_to_urdf(scene: TreeScene) -> str:
    """As a URDF document. Raises :class:`InvalidInput` naming what URDF cannot say."""
    return spatial_urdf(scene.system.mechanism(), scene.name)
