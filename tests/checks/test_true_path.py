"""The motion that is followed, against the proved states on its way."""

import pytest

from furiko.checks.true_path import STEPS, path
from furiko.models import find_scene
from furiko.reference.proved.kept import distance, proof


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rods-2-equal", "rods-5-chaotic"])
def test_it_passes_the_proved_states(name):
    scene, spacing = find_scene(name), STEPS[-1] / 2
    proved = proof(scene.system, scene.theta, scene.omega, scene.duration)
    high, low = path(scene, spacing, 1 + round(proved.times[-1] / spacing))
    for i, time in enumerate(proved.times):
        at = round(time / spacing)
        assert spacing * at == time
        # A hundred steps' local errors of 1e-30, grown a hundred times where the motion is followed longest.
        assert distance(proved, i, high[at], low[at]) < 1e-26
