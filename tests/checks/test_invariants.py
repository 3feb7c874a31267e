"""Invariants along trajectories pass engines that are right and fail those with friction or a drive."""

import numpy as np
import pytest
from motion_zoo import Damped, Fake, Geared, Pushed

from furiko.checks import invariants
from furiko.engines import ENGINES


def outcomes(cell):
    return {result.check.removeprefix("invariant "): result.outcome for result in invariants.compare(cell)}


@pytest.mark.parametrize("engine", [name for name, info in ENGINES.items() if info.integrators])
@pytest.mark.parametrize("scene", ["two-legs", "rods-3"])
def test_every_integrator_keeps_what_is_to_be_kept(make_cell, engine, scene):
    found = outcomes(make_cell(engine, scene))
    assert len(found) == 3 * len(ENGINES[engine].integrators)
    assert set(found.values()) == {"agrees"}, found


@pytest.mark.parametrize(
    ("fake", "differs"),
    [
        (Fake, set()),
        (Damped, {"energy RK4", "there and back RK4", "angular momentum RK4"}),
        # A constant torque has a potential: it does no work on the way there that it takes back.
        (Pushed, {"energy RK4", "angular momentum RK4"}),
        (Geared, {"energy RK4", "angular momentum RK4"}),
    ],
)
def test_a_fault_of_1e_7_changes_what_it_should(make_cell, fake, differs):
    found = outcomes(make_cell(fake, "two-legs"))
    assert {check for check, outcome in found.items() if outcome == "differs"} == differs


def test_extrapolation_of_a_known_series():
    runs = [np.array([3.0 * h**2 + 5.0 * h**3]) for h in (0.1, 0.05, 0.025)]
    limit, uncertainty = invariants.extrapolated(runs, 2)
    # 3h² falls out; of 5h³ the extrapolation leaves -5h³/6 at the finer of its two steps' double.
    assert limit < uncertainty < 5 * 0.1**3
    moved, uncertainty = invariants.extrapolated([run + 0.01 for run in runs], 2)
    assert moved > uncertainty


def test_coming_to_grief_is_skipped_and_said(make_cell):
    class Lost(Fake):
        def trajectory(self, theta, omega, integrator, step, steps):
            return np.full_like(theta, np.nan), np.full_like(theta, np.nan)

    assert set(outcomes(make_cell(Lost, "two-legs")).values()) == {"skipped"}
