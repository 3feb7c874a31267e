"""Free bodies whose frame is moved to the centre of mass, along the principal axes: ``align`` and ``alignfree``.

MuJoCo does so with a free body that carries no other. Its rates are then those of the centre of mass and about the
principal axes, so that the mass matrix is diagonal. Which axes these are is written where the body has ``diaginertia``
or a single geom; otherwise that of the largest moment is first. Of each axis both senses are as good: no number of the
dynamics depends on it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..spatial import Inertial, Pose, to_quaternion
from ..spatial_mechanism import RigidBody
from .attributes import Array


def with_aligned(
    bodies: Sequence[RigidBody],
    chosen: Sequence[int],
    axes: Mapping[str, Array] | None = None,
    note: Callable[[str], None] | None = None,
) -> list[RigidBody]:
    """The bodies, of which the ``chosen`` ones are aligned if they carry none.

    ``axes``: by a body's name the principal axes, columns of a rotation (3, 3), that the document itself writes;
    ``note`` is given a sentence on each.
    """
    found, parents = list(bodies), {body.parent for body in bodies}
    for index in chosen:
        body = bodies[index]
        if index in parents or body.inertial.weightless:
            continue
        found[index] = aligned(body, (axes or {}).get(body.name))
        if note is not None:
            note(
                f"body {body.name!r}: its frame is moved to its centre of mass, along its principal axes (align); the "
                "coordinates of its free joint are those of that frame"
            )
    return found


def aligned(body: RigidBody, axes: Array | None) -> RigidBody:
    """The body in the frame of its inertial, whose ``axes`` are columns (3, 3); None: the largest moment first."""
    inertial = body.inertial
    turned = principal_axes(inertial.tensor) if axes is None else axes
    pose = body.pose @ Pose(turned, inertial.centre)
    moved = Inertial(inertial.mass, np.zeros(3), turned.T @ inertial.tensor @ turned)
    return replace(body, position=pose.translation, quaternion=to_quaternion(pose.rotation), inertial=moved)


def principal_axes(tensor: Array) -> Array:
    """A rotation (3, 3) whose columns are principal axes of a ``tensor`` (3, 3), that of the largest moment first."""
    axes = np.linalg.eigh(tensor)[1][:, ::-1]
    return np.asarray(axes if np.linalg.det(axes) > 0 else axes * np.array([-1.0, 1.0, 1.0]))
