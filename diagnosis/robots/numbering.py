"""A mass matrix that lacks entries because the engine's joints are not numbered subtree by subtree.

The composite-rigid-body algorithm goes through the joints from the last to the first, and hands the columns of a joint
and of all that it carries to its parent. An implementation that takes these to be the next columns hands on others
where they are not: those that it leaves behind, and those that it writes nothing over, stay zero. Accelerations and
bias, which ask each joint for its parent alone, are right.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engines.model_files.robot import BoundRobot
from ...models.spatial_mechanism import WORLD, Array, SpatialMechanism
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.spatial import magnitudes
from ...reference.truth.spatial import spatial_truth
from ..finding import Finding
from .states import probe_states


@dataclass(frozen=True)
class LostEntry:
    """An entry of the mass matrix that is zero and should be ``expected``, of the joints ``one`` and ``other``."""

    one: str
    other: str
    expected: float


def lost_entry(bound: BoundRobot, mechanism: SpatialMechanism) -> LostEntry | None:
    """The first entry that is lost, if the numbering explains all that is wrong with the mass matrix in every state."""
    lost = _lost(mechanism)
    if not lost.any():
        return None
    q, v = probe_states(mechanism)
    units = magnitudes(mechanism, q, v)
    matrices = np.asarray(bound.mass_matrix(q), dtype=np.float64)
    first: LostEntry | None = None
    for k, unit in enumerate(units):
        expected = spatial_truth(mechanism, q[k], v[k]).mass_matrix.float
        wrong = np.triu(np.abs(matrices[k] - expected) > unit.roundings * EPSILON * unit.mass_matrix)
        if (matrices[k][lost] != 0).any() or wrong[np.logical_not(lost)].any():
            return None
        places = np.argwhere(wrong & lost)
        if first is None and len(places):
            i, j = places[0]
            names = [placed.joint.name for placed in mechanism.joints for _ in range(placed.joint.freedoms)]
            first = LostEntry(names[i], names[j], float(expected[i, j]))
    return first


def lost_entry_finding(engine: str, lost: LostEntry) -> Finding:
    """The cause in words."""
    says = (
        f"{engine}: the mass matrix at joint {lost.one!r} and joint {lost.other!r} is 0, the mechanism that it holds "
        f"has {lost.expected:.9g}: its joints are not numbered subtree by subtree, as its mass matrix needs them"
    )
    return Finding("joints-out-of-order", f"{engine}: joint {lost.one!r}", 0.0, lost.expected, says)


def _lost(mechanism: SpatialMechanism) -> Array:
    """Whether entries of the mass matrix' upper triangle (nv, nv) are lost in the algorithm's bookkeeping."""
    nv, columns, above = mechanism.nv, _columns(mechanism), _moved_by(mechanism)
    moving = [index for index, body in enumerate(mechanism.bodies) if body.joints]
    carried = {index: len(columns[index]) for index in moving}  # freedoms of a body and of all that it carries
    for index in reversed(moving):
        if above[index] != WORLD:
            carried[above[index]] += carried[index]
    handed = {index: np.zeros(nv, dtype=bool) for index in moving}  # which columns each body has
    has = np.zeros((nv, nv), dtype=bool)
    for index in reversed(moving):
        first = columns[index][0]
        block = slice(first, first + carried[index])
        handed[index][columns[index]] = True
        has[columns[index], block] = handed[index][block]
        if above[index] != WORLD:
            handed[above[index]][block] = handed[index][block]
    return np.triu(_carries(mechanism, columns, above) & ~has)


def _carries(mechanism: SpatialMechanism, columns: list[list[int]], above: list[int]) -> Array:
    """Whether the freedom of a row is of the same body as that of a column, or of one that carries it (nv, nv)."""
    found = np.zeros((mechanism.nv, mechanism.nv), dtype=bool)
    for index, own in enumerate(columns):
        at = index
        while at != WORLD and own:
            found[np.ix_(columns[at], own)] = True
            at = above[at]
    return found


def _moved_by(mechanism: SpatialMechanism) -> list[int]:
    """Of each body the next one above it that has joints, or the world."""
    found: list[int] = []
    for body in mechanism.bodies:
        at = body.parent
        while at != WORLD and not mechanism.bodies[at].joints:
            at = mechanism.bodies[at].parent
        found.append(at)
    return found


def _columns(mechanism: SpatialMechanism) -> list[list[int]]:
    """The freedoms of each body's own joints."""
    found: list[list[int]] = []
    next_one = 0
    for body in mechanism.bodies:
        count = sum(joint.freedoms for joint in body.joints)
        found.append([*range(next_one, next_one + count)])
        next_one += count
    return found
