"""A planar tree of hinged links as a mechanism in space, as furiko's own model files have it.

Up is +z, the plane x-z, every hinge turns about (0, −1, 0), so that a positive angle moves a link to +x; the point
(along, across) of a link's frame is (across, 0, −along) of its body's.
"""

from __future__ import annotations

import numpy as np

from .spatial import Inertial
from .spatial_mechanism import Array, Joint, RigidBody, SpatialMechanism
from .tree import PlanarTree


def spatial_mechanism_of(tree: PlanarTree) -> SpatialMechanism:
    """``tree`` in space. Its coordinates are each link's angle less its parent's [rad], in the links' order.

    Links and hinges are named as in furiko's model files. Only the moment of inertia about the hinge's direction takes
    part in planar motion; the other two are given the same.
    """
    names = zip(tree.names("link"), tree.names("hinge"), strict=True)
    axis = np.array([0.0, -1.0, 0.0])
    bodies = tuple(
        RigidBody(
            name,
            link.parent,
            position=_point(link.hinge),
            joints=(Joint(hinge, axis=axis),),
            inertial=Inertial(link.mass, _point(link.com), link.inertia * np.eye(3)),
        )
        for link, (name, hinge) in zip(tree.links, names, strict=True)
    )
    return SpatialMechanism(bodies, np.array([0.0, 0.0, -tree.gravity]))


def _point(along_across: tuple[float, float]) -> Array:
    along, across = along_across
    return np.array([across, 0.0, 0.0 - along])
