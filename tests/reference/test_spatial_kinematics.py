"""Motion and energy in doubles against ball arithmetic, and against each other's change."""

import numpy as np
import pytest
import spatial_trees
from spatial_series import pose_series

from furiko.reference import spatial_kinematics
from furiko.reference.truth import spatial


def drawn(seed):
    rng = np.random.default_rng(seed)
    mechanism = spatial_trees.tree(rng, 5, free=seed % 2 == 0)
    states = [spatial_trees.state(rng, mechanism)[:2] for _ in range(3)]
    return mechanism, *map(np.array, zip(*states, strict=True))


@pytest.mark.parametrize("seed", range(8))
def test_energies_are_those_in_balls(seed):
    mechanism, q, v = drawn(seed)
    found = spatial_kinematics.energy(mechanism, q, v)
    proved = np.array([spatial.energy(mechanism, *state).float for state in zip(q, v, strict=True)])
    # A hundred operations on sums whose terms are at most some ten times the sum: 1e-13 is a thousand roundings.
    np.testing.assert_allclose(found, proved, rtol=1e-13, atol=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_frames_and_velocities_are_those_of_the_positions_series(seed):
    mechanism, q, v = drawn(seed)
    moved = spatial_kinematics.motion(mechanism, q, v)
    for state in range(len(q)):
        poses = pose_series(mechanism, q[state].tolist(), v[state].tolist(), [0.0] * mechanism.nv)
        for body, (here, rate, _) in enumerate(poses):
            pose, change = (np.array(part.tolist()).astype(float) for part in (here, rate))
            np.testing.assert_allclose(moved.rotation[state, body], pose[:3, :3], atol=1e-13)
            np.testing.assert_allclose(moved.position[state, body], pose[:3, 3], atol=1e-12)
            np.testing.assert_allclose(moved.linear[state, body], change[:3, 3], atol=1e-11)
            spin = change[:3, :3] @ pose[:3, :3].T
            np.testing.assert_allclose(moved.angular[state, body], [spin[2, 1], spin[0, 2], spin[1, 0]], atol=1e-12)
