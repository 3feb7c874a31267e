"""Invariants along trajectories pass engines that are right and fail those with friction or a drive."""

from dataclasses import replace

import numpy as np
import pytest
from fake_integrators import Damped, Fake, Geared, Pushed

from furiko.checks.comparisons import invariants
from furiko.engines import ENGINES, engine_version
from furiko.models import NLegPendulum, Scene


def outcomes(cell):
    return {result.check.removeprefix("invariant "): result.outcome for result in invariants.compare(cell)}


@pytest.mark.slow
@pytest.mark.parametrize("engine", [name for name, info in ENGINES.items() if info.integrators])
@pytest.mark.parametrize("scene", ["two-legs", "rods-3"])
def test_every_integrator_keeps_what_is_to_be_kept(make_cell, engine, scene):
    found = outcomes(make_cell(engine, scene))
    assert len(found) == 3 * len(ENGINES[engine].integrators)
    assert set(found.values()) == {"agrees"}, found


@pytest.mark.slow
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


def test_coming_to_grief_is_skipped_and_said(make_cell):
    class Lost(Fake):
        def trajectory(self, theta, omega, integrator, step, steps):
            return np.full_like(theta, np.nan), np.full_like(theta, np.nan)

    class LostWithEnergy(Lost):
        @classmethod
        def about(cls):
            return replace(super().about(), missing={})

        def energy(self, theta, omega):
            assert np.isfinite(theta).all()
            return np.zeros((1, 2))

    for engine in (Lost, LostWithEnergy):
        assert set(outcomes(make_cell(engine, "two-legs")).values()) == {"skipped"}


def test_steps_that_are_too_long_for_the_motion_are_skipped_and_said(make_cell):
    """Tiny unlike legs part within a millisecond: each run is chaotic, whatever its step, and nothing can be said."""
    system = NLegPendulum((7.948327493937984e-05, 2.265858990996021e-05), (103964.93900292696, 417466.4752368388), 9.81)
    start = (-0.5802336304099969, 1.3267644669327083), (-0.18151458486915936, 0.9809978172346038)
    for engine in (name for name in ("mujoco", "exudyn-tree") if engine_version(name)):
        cell = make_cell(engine, Scene("wide-78-44", system, *start, 0.002205561427945191), 200)
        found = list(invariants.compare(cell))
        assert "differs" not in {result.outcome for result in found}, found
        assert any("do not fall" in result.reason for result in found), found


def test_energy_is_kept_by_the_engines_own_account_of_it(make_cell):
    """An account that has a part of the angle too much: its motion keeps the documents' energy, and not this."""
    cell = make_cell("fake_engines:Right", "double-pendulum", 3)

    class Account:
        def __getattr__(self, name):
            return getattr(cell.engine, name)

        def energy(self, theta, omega):
            return cell.engine.energy(theta, omega) + 1e-3 * theta

    found = {result.check: result for result in invariants.compare(replace(cell, engine=Account()))}
    assert found["invariant energy RK4"].outcome == "differs"
    assert found["invariant there and back RK4"].outcome == "agrees"
