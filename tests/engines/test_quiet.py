"""Engines say nothing and leave nothing lying about."""

import subprocess
import sys

import pytest

from furiko.engines import ENGINES

EVERYTHING = """
import sys, numpy as np
from furiko.engines import load_engine
from furiko.models import NLegPendulum, RodChain
for system in RodChain((1.0, 0.8, 0.6)), NLegPendulum((1.0, 0.8), (1.0, 0.3)):
    engine = load_engine(sys.argv[1], system)
    missing = engine.info.missing
    state = np.full((2, system.n), 0.3)
    engine.fields(), engine.accelerations(state, state), engine.accelerations(state, 1e200 * state)
    engine.energy(state, state)
    "inverse_dynamics" in missing or engine.inverse_dynamics(state, state, state)
    "joint_forces" in missing or engine.joint_forces(state, state, state)
    if sys.argv[1] == "mujoco":
        for system in NLegPendulum((1e-12, 1e-12), (1e14, 1e14)), RodChain((1e-7, 1e-7), 6e6):
            load_engine(sys.argv[1], system)
    for scheme in engine.info.integrators:
        engine.trajectory(state[0], state[0], scheme.name, 1e-3, 20)
        engine.trajectory(state[0], 1e5 * state[0], scheme.name, 1.0, 20)
        engine.trajectory(state[0], 1e200 * state[0], scheme.name, 1.0, 20)
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", list(ENGINES))
def test_nothing_printed_and_nothing_written(name, tmp_path):
    ran = subprocess.run(
        [sys.executable, "-W", "error", "-c", EVERYTHING, name],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "", "")
    assert list(tmp_path.iterdir()) == []
