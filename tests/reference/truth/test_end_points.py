"""Every end point that is kept, against a run of another kind: Taylor series in double precision."""

import numpy as np
import pytest

import furiko
from furiko.models import document_scenes, find_scene
from furiko.reference.truth import end_points

MOVING = [scene.name for scene in document_scenes() if scene.theta is not None and scene.duration]
# A run in double precision is off by a few roundings of its numbers, grown along the motion; 3.1 times ε × growth is
# the largest seen, and the growth in three random directions may miss the fastest one by a few times.
ROUNDINGS = 16 * 2.0**-52
NUDGE = 1e-9  # [rad, rad/s] far above rounding, far below where growth stops being linear


def both(run):
    return np.concatenate([run.theta, run.omega], axis=-1)[-4:]


def growth(scene, times, run):
    """How many times larger a small difference at the start has become at each time, (4,)."""
    random = np.random.default_rng(2018)
    found = np.zeros(4)
    for _ in range(3):
        theta, omega = random.choice([-NUDGE, NUDGE], (2, scene.system.n))
        moved = furiko.simulate(scene.system, np.array(scene.theta) + theta, np.array(scene.omega) + omega, times)
        found = np.maximum(found, np.abs(both(moved) - both(run)).max(axis=-1) / NUDGE)
    return found


def excess(name, shift=0.0):
    """Distance of the kept states from the run, over what rounding explains; ``shift``: a fault in the first angle."""
    scene = find_scene(name)
    times = [0.0, *end_points._times(scene.duration)]
    run = furiko.simulate(scene.system, scene.theta, scene.omega, times)
    kept = both(end_points.lookup(scene.system, scene.theta, scene.omega, scene.duration))
    kept[:, 0] += shift
    allowed = ROUNDINGS * np.maximum(growth(scene, times, run), 1.0) * np.maximum(np.abs(kept).max(axis=-1), 1.0)
    return np.abs(kept - both(run)).max(axis=-1) / allowed


@pytest.mark.parametrize("name", MOVING)
def test_kept_states_are_those_of_another_run(name):
    assert excess(name).max() <= 1.0


@pytest.mark.parametrize("name", MOVING)
def test_a_billionth_of_a_radian_is_noticed(name):
    assert excess(name, shift=1e-9).min() > 1.0
