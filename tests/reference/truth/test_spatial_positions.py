"""The theory in space against a second one, which knows where bodies are and nothing of velocities (spatial_series)."""

import numpy as np
import pytest
import spatial_trees
from flint import arb, arb_mat
from spatial_series import Positions, entries

from furiko.reference.truth.enclosures import precision
from furiko.reference.truth.spatial import spatial_truth

SEEDS = range(12)


def drawn(seed):
    rng = np.random.default_rng(seed)
    mechanism = spatial_trees.tree(rng, int(rng.integers(1, 7)), free=seed % 2 == 0)
    return mechanism, *spatial_trees.state(rng, mechanism)


def same(ours, theirs):
    """Both hold the true value: they overlap; and both are narrow, so that this means something."""
    flat = entries(theirs).ravel()
    scale = max((float(abs(ball).upper()) for ball in flat), default=0.0)
    assert all(one.overlaps(other) for one, other in zip(ours.balls.ravel(), flat, strict=True))
    assert max((float(ball.rad()) for ball in (*ours.balls.ravel(), *flat)), default=0.0) <= 1e-20 * scale


@pytest.mark.parametrize("seed", SEEDS)
def test_terms_and_accelerations(seed):
    mechanism, q, v, torque = drawn(seed)
    truth = spatial_truth(mechanism, q, v, torque)
    with precision(192):
        other = Positions(mechanism, q, v)
        mass, bias, passive = other.mass_matrix(), other.bias(), other.passive()
        n = mechanism.nv
        right = [p + t - b for p, t, b in zip(passive, torque.tolist(), bias, strict=True)]
        solved = arb_mat(mass).solve(arb_mat(n, 1, right)).entries() if n else []
        same(truth.mass_matrix, mass)
        same(truth.bias, bias)
        same(truth.gravity, other.gravity())
        same(truth.velocity, other.forces(other.v, other.rest, [0, 0, 0]))
        same(truth.passive, passive)
        same(truth.accelerations, solved)


def test_the_residual_of_any_accelerations():
    mechanism, q, v, torque = drawn(4)
    given = np.random.default_rng(1).normal(size=mechanism.nv)
    left = spatial_truth(mechanism, q, v, torque).residual(given)
    with precision(192):
        other = Positions(mechanism, q, v)
        pulled = zip(
            other.forces(other.v, [arb(a) for a in given.tolist()], mechanism.gravity.tolist()),
            given.tolist(),
            mechanism.per_freedom("armature").tolist(),
            other.passive(),
            torque.tolist(),
            strict=True,
        )
        same(left, [force + arb(armature) * a - p - t for force, a, armature, p, t in pulled])
