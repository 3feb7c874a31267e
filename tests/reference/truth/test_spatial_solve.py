"""The proof of accelerations in O(n): against dense elimination in many bits, and that it sees what is wrong."""

import numpy as np
import pytest
import spatial_trees
from flint import arb, arb_mat

from furiko.reference.truth import spatial_solve
from furiko.reference.truth.enclosures import precision
from furiko.reference.truth.spatial import spatial_truth
from furiko.reference.truth.spatial_motion import Motion


def drawn(n, branching):
    rng = np.random.default_rng(n)
    mechanism = spatial_trees.chain(rng, n, branching)
    return mechanism, *spatial_trees.state(rng, mechanism)


@pytest.mark.parametrize("branching", [0.0, 0.4])
def test_dense_elimination_of_forty_bodies(branching):
    mechanism, q, v, torque = drawn(40, branching)
    truth = spatial_truth(mechanism, q, v, torque)
    with precision(600):
        motion = Motion(mechanism, q, v, 600)
        right = truth._right(motion)
        mass = arb_mat(spatial_truth(mechanism, q, v, bits=600).mass_matrix.balls.tolist())
        dense = mass.solve(arb_mat(40, 1, right)).entries()
        assert max(float(ball.rad()) for ball in dense) < 1e-60
        assert all(one.overlaps(other) for one, other in zip(truth.accelerations.balls, dense, strict=True))
    assert truth.accelerations.enclosure.relative_radius < 2.0**-80


def test_a_chain_of_three_hundred_leaves_what_its_accelerations_leave():
    """At any precision the balls overlap, and the residual of the midpoints is rounding alone."""
    mechanism, q, v, torque = drawn(300, 0.0)
    narrow = spatial_truth(mechanism, q, v, torque, bits=512).accelerations
    wide = spatial_truth(mechanism, q, v, torque).accelerations
    assert all(one.overlaps(other) for one, other in zip(wide.balls, narrow.balls, strict=True))
    with precision(512):
        motion = Motion(mechanism, q, v, 512)
        truth = spatial_truth(mechanism, q, v, torque)
        left = zip(motion.inertial_terms(list(narrow.balls)), truth._right(motion), strict=True)
        assert all((a - b).contains(0) for a, b in left)


def test_the_proof_notices_a_wrong_acceleration(monkeypatch):
    mechanism, q, v, torque = drawn(12, 0.4)
    right = spatial_truth(mechanism, q, v, torque).accelerations
    substituted = spatial_solve._substituted

    def off(*arguments):
        return [x + arb(1e-20) for x in substituted(*arguments)]

    monkeypatch.setattr(spatial_solve, "_substituted", off)
    with precision(128):
        motion = Motion(mechanism, q, v, 128)
        balls = spatial_solve.solution(motion, spatial_truth(mechanism, q, v, torque)._right(motion))
        assert all(ball.overlaps(a) for ball, a in zip(balls, right.balls, strict=True))
        assert min(float(ball.rad()) for ball in balls) > 1e-21  # with the right ones it is 1e-35


@pytest.mark.parametrize(("off", "regular"), [(-60, True), (3, False)])
def test_the_proof_notices_wrong_factors(monkeypatch, off, regular):
    """Inertias altered on their way to the support are those of another matrix: one close by, or one that is not."""
    mechanism, q, v, torque = drawn(12, 0.4)
    right = spatial_truth(mechanism, q, v, torque).accelerations
    symmetric = spatial_solve._symmetric
    monkeypatch.setattr(spatial_solve, "_symmetric", lambda matrix: (symmetric(matrix) * (1 + arb(2) ** off)).mid())
    with precision(128):
        motion = Motion(mechanism, q, v, 128)
        wanted = spatial_truth(mechanism, q, v, torque)._right(motion)
        if regular:
            balls = spatial_solve.solution(motion, wanted)
            assert all(ball.overlaps(a) for ball, a in zip(balls, right.balls, strict=True))
            assert min(float(ball.rad()) for ball in balls) > 1e-20  # 2⁻⁶⁰ is 9e-19; with the right ones it is 1e-35
        else:
            with pytest.raises(ZeroDivisionError, match="regular"):
                spatial_solve.solution(motion, wanted)
