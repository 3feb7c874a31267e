"""Entries of a mass matrix that are lost where joints are not numbered subtree by subtree.

Four hinges about one axis, each with a ball about it whose moment is 1 kg m²: an entry of the mass matrix is the number
of bodies that the later joint carries, where the earlier one carries it, and zero elsewhere.
"""

from __future__ import annotations

import numpy as np
import pytest

from furiko.diagnosis.robots.numbering import LostEntry, lost_entry
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism

BALL = Inertial(1.0, np.zeros(3), np.eye(3))
# a carries b and c, and b carries d: numbered subtree by subtree, and otherwise.
IN_ORDER = {"a": -1, "b": 0, "d": 1, "c": 0}
OUT_OF_ORDER = {"a": -1, "b": 0, "c": 0, "d": 1}
LOST = ((0, 2), (0, 3), (1, 3))  # by hand, and Pinocchio's crba, below
RIGHT = np.array([[4.0, 2, 1, 1], [2, 2, 0, 1], [1, 0, 1, 0], [1, 1, 0, 1]])


def tree(numbered):
    joint = {name: Joint(name, "hinge", axis=np.array([0.0, 0, 1])) for name in numbered}
    bodies = [RigidBody(name, parent, joints=(joint[name],), inertial=BALL) for name, parent in numbered.items()]
    return SpatialMechanism(tuple(bodies), np.array([0, 0, -9.81]))


class Holding:
    """An engine that has this mass matrix in every state."""

    def __init__(self, matrix):
        self._matrix = matrix

    def mass_matrix(self, q):
        return np.array([self._matrix for _ in q])


def without(*entries, matrix=RIGHT):
    found = matrix.copy()
    for i, j in entries:
        found[i, j] = found[j, i] = 0
    return Holding(found)


def test_entries_that_the_numbering_loses_are_told():
    assert lost_entry(without(*LOST), tree(OUT_OF_ORDER)) == LostEntry("a", "c", 1.0)


@pytest.mark.parametrize("entries", [(), LOST[:1], (*LOST, (0, 1))])
def test_what_else_is_wrong_has_another_cause(entries):
    """None is lost, some that should be are not, one besides is."""
    assert lost_entry(without(*entries), tree(OUT_OF_ORDER)) is None


def test_in_order_nothing_is_lost():
    matrix = RIGHT[np.ix_([0, 1, 3, 2], [0, 1, 3, 2])]
    assert lost_entry(without((0, 1), matrix=matrix), tree(IN_ORDER)) is None


def test_pinocchio_loses_these():
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.Model()
    for name, parent in OUT_OF_ORDER.items():
        joint = model.addJoint(parent + 1, pinocchio.JointModelRZ(), pinocchio.SE3.Identity(), name)
        model.appendBodyToJoint(joint, pinocchio.Inertia(1.0, np.zeros(3), np.eye(3)), pinocchio.SE3.Identity())
    found = pinocchio.crba(model, model.createData(), np.zeros(4))
    assert np.array_equal(np.triu(found), np.triu(without(*LOST)._matrix))
