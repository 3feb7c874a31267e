"""Kept proofs of open mechanisms: against the motion in doubles and its estimate, and proved anew."""

import json

import numpy as np
import pytest
from flint import arb

import furiko
from furiko.models import find_scene
from furiko.reference.proved import kept_trees
from furiko.reference.proved.kept import READ_BITS
from furiko.reference.truth import tree_end_points
from furiko.reference.truth.enclosures import precision

# How many of the four times are proved: two poles in a row on a cart are chaotic.
PROVED = {"acrobot": 4, "cart-pole": 4, "cart-two-poles": 1}


def test_those_that_move_in_a_plane_are_kept():
    entries = json.loads(kept_trees.PATH.read_text(encoding="utf-8"))
    assert sorted(entry["scene"] for entry in entries.values()) == sorted(PROVED)
    assert kept_trees.proof(find_scene("arm-7")) is None


@pytest.mark.parametrize(("name", "times"), PROVED.items())
def test_the_motion_in_doubles_is_within_its_own_estimate(name, times):
    scene = find_scene(name)
    proof, motion = kept_trees.proof(scene), tree_end_points.end_points(scene)
    off, proved = kept_trees.sure(motion.q, motion.error, proof)
    assert proved == (True,) * times + (False,) * (4 - times)
    assert (off <= 3 * motion.error + 2e-16 * np.abs(motion.q).max()).all()  # an estimate, and the rounding of q itself
    assert max(proof.radius) <= 1e-20
    wrong = motion.q.copy()
    wrong[0, 0] += 1e-9
    assert kept_trees.sure(wrong, motion.error, proof)[0][0] == pytest.approx(1e-9, rel=1e-3)
    estimated, none = kept_trees.sure(wrong, motion.error, None)
    assert none == (False,) * 4
    np.testing.assert_array_equal(estimated, motion.error)


@pytest.mark.parametrize("name", [pytest.param("acrobot", marks=pytest.mark.slow), "cart-pole", "cart-two-poles"])
def test_a_new_proof_meets_the_kept_one(name):
    scene = find_scene(name)
    proof = kept_trees.proof(scene)
    found = furiko.enclose(scene.system, scene.q, scene.v, [0.0, *proof.times], digits=12)  # other steps and orders
    assert found.complete
    with precision(READ_BITS):
        for new, old in ((found.theta, proof.theta), (found.omega, proof.omega)):
            for a, b in zip(new[1:].flat, old.flat, strict=True):
                assert (a + arb(0, 2 * b.rad())).contains(b)
                assert a.overlaps(b)
