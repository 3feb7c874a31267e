"""Predicted and measured horizons, against figures of an earlier program and against engines with a fault."""

import math
from dataclasses import replace

import numpy as np
import pytest
from fake_integrators import Astray, Damped, Fake

from furiko.checks import true_path
from furiko.checks.cell import Cell
from furiko.checks.comparisons import horizon
from furiko.checks.facts import SceneFacts, scene_facts
from furiko.checks.motions import divergence
from furiko.engines import Integrator, engine_info, load_engine
from furiko.models import RodChain, find_scene
from furiko.models.scene import Scene
from furiko.models.states import states
from furiko.reference.proved.kept import proof

FIVE_RODS = Scene("five", RodChain([1.0, 0.8, 0.6, 0.9, 0.7]), (2.0, 2.5, 1.5, 2.8, 0.7), (0.0,) * 5)


def integrator(cell, name):
    return next(one for one in cell.info.integrators if one.name == name)


def along(cell, name, step, duration):
    return horizon.horizon(cell, integrator(cell, name), horizon.true_motion(cell.scene, step, duration))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "engine", "name", "step", "parts"),
    [
        # Measured by a program of its own, with finite differences for the tangent flow: three digits.
        ("double-pendulum", "mujoco", "Euler", 1e-3, 0.194),
        ("double-pendulum", "mujoco", "RK4", 1e-2, 3.830),
        ("double-pendulum", "exudyn-tree", "RK44", 1e-2, 3.830),
        pytest.param(FIVE_RODS, "mujoco", "RK4", 1e-2, 1.010, marks=pytest.mark.slow),
        (FIVE_RODS, "mujoco", "RK4", 5e-3, 1.310),
        pytest.param("double-pendulum", "mujoco", "RK4", 1e-3, 8.837, marks=pytest.mark.slow),
        pytest.param("double-pendulum", "mujoco", "RK4", 5e-3, 5.830, marks=pytest.mark.slow),
        pytest.param(FIVE_RODS, "mujoco", "RK4", 1e-3, 2.968, marks=pytest.mark.slow),
    ],
)
def test_divergence_times_of_the_prototype(make_cell, scene, engine, name, step, parts):
    cell = make_cell(engine, scene)
    found = along(cell, name, step, 4.0 if parts < 4 else 10.0)
    predicted, measured = found.crossing(divergence.APART)
    assert measured == pytest.approx(parts, abs=0.001)
    assert predicted == pytest.approx(parts, abs=1.5 * step)
    assert found.miss() <= divergence.EXPLAINED


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "name"), [("exudyn-tree", "GeneralizedAlpha"), ("exudyn-redundant", "TrapezoidalIndex2")]
)
def test_schemes_with_a_memory_are_predicted_too(make_cell, engine, name):
    cell = make_cell(engine, "double-pendulum")
    found = along(cell, name, 5e-3, 4.0)
    predicted, measured = found.crossing(divergence.APART)
    assert found.from_time < measured < math.inf
    assert abs(predicted / measured - 1) < 0.03


@pytest.mark.slow
def test_a_run_that_parts_earlier_than_its_steps_explain_differs(make_cell, monkeypatch):
    monkeypatch.setattr(horizon, "STEPS", (5e-3,))
    monkeypatch.setattr(true_path, "LONGEST", 3.0)
    monkeypatch.setattr(divergence, "APART", 1e-6)
    monkeypatch.setattr(divergence, "NEAR", 1e-6)
    (sound,) = horizon.compare(make_cell(Fake, "double-pendulum"))
    assert sound.outcome == "agrees"
    assert "had to part" in sound.reason
    (astray,) = horizon.compare(make_cell(Astray, "double-pendulum"))
    assert astray.outcome == "differs"
    assert "had to part at" in astray.reason


@pytest.mark.slow
def test_another_model_is_told_from_a_scheme(make_cell, monkeypatch):
    monkeypatch.setattr(horizon, "STEPS", (5e-3, 2.5e-3))
    monkeypatch.setattr(true_path, "LONGEST", 1.0)
    _, second = horizon.compare(make_cell(Fake, "double-pendulum"))
    assert second.details["order of local errors"] == pytest.approx(4, abs=0.2)
    assert "need not part" in second.reason
    _, second = horizon.compare(make_cell(Damped, "double-pendulum"))
    assert second.outcome == "differs"
    assert "another model" in second.reason


@pytest.mark.slow
def test_the_true_motion_is_held_against_the_kept_proof():
    pytest.importorskip("heyoka")
    scene = find_scene("double-pendulum")
    kept = proof(scene.system, scene.theta, scene.omega, scene.duration)
    truth = horizon.true_motion(scene, 1e-2, 2.0)
    found = divergence.held(truth, kept)
    assert found.times == (0.25, 0.5, 1.0, 2.0)
    assert found.off < 1e-25  # quadruple precision, and what two seconds make of its rounding
    truth.low[100, 0] += 1e-20
    assert divergence.held(truth, kept).off == pytest.approx(1e-20, rel=1e-3)
    truth.high[100, 0] += 1e-9
    with pytest.raises(ArithmeticError, match="beside the proved one"):
        divergence.held(truth, kept)
    short = horizon.true_motion(scene, 1e-2, 0.4)
    assert divergence.held(short, kept).times == (0.25,)
    assert divergence.held(short, None).times == ()


@pytest.mark.parametrize(("later", "agrees"), [(0.0, True), (0.1, True), (-1.0, False), (1.0, False)])
def test_a_run_that_parts_too_early_or_too_late_is_missed_by_so_much(later, agrees):
    """Both errors grow e-fold in half a second: the predicted one is a thousandth after 5 s, the measured one later."""
    times = np.linspace(0.0, 10.0, 1001)
    predicted, measured = (1e-3 * np.exp(2 * (times - at)) for at in (5.0, 5.0 + later))
    nothing = np.zeros((0, 1))
    found = divergence.Horizon(None, 0.01, times, predicted, measured, nothing, 0.0, 0.5, nothing, nothing)
    known = math.log(1.05) / 2 + 1.5 * 0.01  # of a prediction to a twentieth, and a step and a half
    expected = max(0.0, abs(later) - known) / (5.0 + later)
    assert found.miss() == pytest.approx(expected, abs=0.01 / 4)  # of the grid of times
    assert (found.miss() <= divergence.EXPLAINED) == agrees


def test_errors_are_carried_by_the_flow():
    # e₁ = d₁, e₂ = Φ e₁ + d₂: twice, and one more.
    flow = np.repeat(2 * np.eye(2)[None], 3, axis=0)
    truth = divergence.TrueMotion(1.0, np.zeros((4, 2)), np.zeros((4, 2)), flow, None)
    carried, sizes = divergence.carry(truth, iter([np.full(2, 0.01)] * 3))
    np.testing.assert_allclose(carried[:, 0], [0, 0.01, 0.03, 0.07])
    np.testing.assert_allclose(sizes, 0.01)


def test_what_has_outgrown_all_sense_counts_as_infinite():
    assert divergence.largest_so_far(np.array([[0.1], [-0.3], [0.2], [np.nan]]), 5).tolist() == [
        0.1,
        0.3,
        0.3,
        *[math.inf] * 3,
    ]


def test_paths_of_an_adapter_without_any_are_made_step_by_step(make_cell):
    class Plain(Fake):
        path = property()  # as if it were not there

        def trajectory(self, theta, omega, integrator, step, steps):
            angles, rates = Fake.path(self, theta, omega, integrator, step, steps)
            return angles[-1], rates[-1]

    cell, state = make_cell(Plain, "double-pendulum"), np.array([2.0, 2.5, 0.0, 0.0])
    found = divergence.path(cell, cell.info.integrators[0], state, 1e-2, 5)
    expected = np.hstack(Fake(cell.scene.system).path(state[:2], state[2:], "RK4", 1e-2, 5))
    np.testing.assert_array_equal(found, expected)
    with pytest.raises(Exception, match="gives no paths"):
        divergence.path(cell, Integrator("RK4", 4, remembers=True), state, 1e-2, 5)


def test_the_command_prints_a_table(capsys):
    horizon.main(["double-pendulum", "--engine", "mujoco", "--step", "0.01", "--duration", "1"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 4
    assert "Euler" in lines[1]
    assert "0.020 s" in lines[1]
    assert "later" in lines[3]
    assert find_scene("double-pendulum").name in lines[1]


def test_a_motion_that_is_shown_begins_at_the_scene_and_ends_where_the_engine_does(make_cell):
    scene = find_scene("double-pendulum")
    cell = make_cell("mujoco", scene)
    found = along(cell, "RK4", 1e-2, 0.5)
    shown = divergence.motion(found)
    assert shown["theory"][0] == shown["engine"][0] == pytest.approx(list(scene.theta), abs=1e-4)
    assert (len(shown["times"]), shown["times"][-1]) == (51, 0.5)  # every step of a short motion
    assert np.abs(np.subtract(shown["theory"], shown["engine"])).max() < 1e-3  # they part at 3.83 s
    run = found.run.copy()
    run[20:] = math.inf
    assert divergence.motion(replace(found, run=run))["times"][-1] == pytest.approx(0.19)


def step_by_step(cell, scheme, truth):
    """The local errors as they are defined: one step from each true state, less the true state after it."""
    n = truth.high.shape[-1] // 2
    for k, flow in enumerate(truth.flow):
        end = cell.trajectory(truth.high[k, :n], truth.high[k, n:], scheme, truth.step, 1).ravel()
        yield end - truth.high[k + 1] - truth.low[k + 1] + flow @ truth.low[k]


@pytest.mark.parametrize(("engine", "name"), [("mujoco", "RK4"), ("mujoco", "Euler"), ("exudyn-tree", "RK67")])
def test_runs_of_several_steps_have_the_local_errors_of_single_ones(make_cell, engine, name):
    """To a hundredth: a run strays from the true motion, and its local errors are those of where it is."""
    cell = make_cell(engine, "double-pendulum")
    truth, scheme = horizon.true_motion(cell.scene, 5e-3, 2.0), integrator(cell, name)
    got = np.array(list(divergence._plain(cell, scheme, truth)))
    expected = np.array(list(step_by_step(cell, scheme, truth)))
    size = np.abs(expected).max(axis=-1, keepdims=True)
    assert (np.abs(got - expected) <= 0.01 * size + 64 * divergence.EPSILON).all()


def test_no_run_that_gives_local_errors_is_longer_than_a_fourth_of_what_came_before():
    assert [divergence.most_together(first) for first in (0, 7, 8, 100, 1000)] == [1, 1, 2, 25, 64]


def test_a_worker_follows_a_motion_once_for_all_engines(monkeypatch):
    """The true path comes with the scene's facts: a cell that looks for it elsewhere fails."""
    monkeypatch.setattr(true_path, "LONGEST", 0.5)
    scene = find_scene("double-pendulum")
    facts = scene_facts(scene, states(scene, 2), slopes=False, followed=True)
    assert facts.path.shape == facts.path_low.shape == (1001, 4)
    np.testing.assert_array_equal(facts.path[0], [*scene.theta, *scene.omega])
    kept = SceneFacts.from_bytes(facts.to_bytes())
    np.testing.assert_array_equal(kept.path_low, facts.path_low)
    np.testing.assert_array_equal(kept.only(np.arange(len(facts.high)) < 2).path, facts.path)
    cell = Cell(scene, engine_info("mujoco"), load_engine("mujoco", scene.system), states(scene, 2), facts)
    monkeypatch.setattr(horizon, "true_motion", None)
    assert {result.outcome for result in horizon.compare(cell)} == {"agrees"}
