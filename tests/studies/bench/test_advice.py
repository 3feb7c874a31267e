"""``furiko advise``: against methods whose errors are known by construction, and one engine against other truth."""

import math
from dataclasses import replace

import numpy as np
import pytest

from furiko.advise import advise
from furiko.cli.main import run
from furiko.engines import load_engine
from furiko.models import InvalidInput, find_scene
from furiko.studies.bench import advice
from furiko.studies.bench.methods import STEP, TOLERANCE, Method, truth

SCENE = replace(find_scene("double-pendulum"), duration=1.0)
TRUE = advice.Reference(np.zeros((3, 2)), np.zeros((3, 2)), 1e-15)


def method(error, by=STEP, settings=(1e-2, 1e-4, 1e-6)):
    """A method that is off by error(setting, part) at the motion at rest."""

    def reach(setting, part=1.0):
        return np.full(2, error(setting, part)), np.zeros(2)

    return Method("engine", "scheme", by, settings, reach)


@pytest.mark.parametrize("order", [1, 2, 4])
@pytest.mark.parametrize("asked", [1e-3, 1e-6])
def test_the_largest_step_is_that_of_the_order(order, asked):
    tried, reason = advice.coarsest(method(lambda h, _: 30 * h**order), SCENE, TRUE, asked, math.inf)
    halvings = math.ceil(math.log2((30 / asked) ** (1 / order) / 16))  # 30 (1/(16·2^k))^p ≤ asked
    assert reason == ""
    assert tried[-2].setting == 1 / (16 << max(halvings, 0))


def test_an_error_that_is_small_by_chance_does_not_count():
    tried, reason = advice.coarsest(method(lambda h, _: 0.0 if h == 1 / 64 else h**2), SCENE, TRUE, 1e-6, math.inf)
    assert reason == ""
    assert tried[-2].setting == 1 / 1024  # h² ≤ 1e-6; 1/64 alone is exact


def test_an_error_in_the_middle_of_the_motion_counts():
    tried, _ = advice.coarsest(method(lambda h, part: h if part == 0.5 else 0.0), SCENE, TRUE, 1e-3, math.inf)
    assert tried[-2].setting == 1 / 1024


def test_runs_that_fail_are_coarse_ones():
    def failing(h, _):
        if h > 0.01:
            raise RuntimeError("Newton did not converge")
        return math.nan if h > 0.005 else h

    tried, reason = advice.coarsest(method(failing), SCENE, TRUE, 1e-3, math.inf)
    assert reason == ""
    assert tried[-2].setting == 1 / 1024
    assert [trial.error for trial in tried[:3]] == [math.inf] * 3


def test_rounding_ends_the_search():
    tried, reason = advice.coarsest(method(lambda h, _: max(h**4, 1e-5)), SCENE, TRUE, 1e-6, math.inf)
    assert "rounding" in reason
    assert len(tried) < 10


def test_what_would_take_too_long_is_not_run():
    tried, reason = advice.coarsest(method(lambda h, _: h), SCENE, TRUE, 1e-12, 1e-4)
    assert "(--budget)" in reason
    assert len(tried) < advice.HALVINGS


def test_tolerances_are_taken_from_coarse_to_fine():
    tried, reason = advice.coarsest(method(lambda t, _: 3 * t, TOLERANCE), SCENE, TRUE, 1e-3, math.inf)
    assert reason == ""
    assert tried[-2].setting == 1e-4


def test_the_step_advised_for_an_engine_keeps_the_error_and_four_times_it_does_not():
    """Held against the motion in quadruple precision, which the advice has not seen."""
    asked, scene = 1e-6, find_scene("double-pendulum")
    found = advise("double-pendulum", error=asked, engines=["mujoco"], budget=20)
    assert found.duration == scene.duration
    advised = next(each for each in found.advised if each.scheme == "RK4")
    engine, true = load_engine("mujoco", scene.system), truth(scene)

    def off(step):
        steps = round(scene.duration / step)
        end = engine.trajectory(np.array(scene.theta), np.array(scene.omega), "RK4", scene.duration / steps, steps)
        return np.abs(np.array(end) - (true.theta[-1], true.omega[-1])).max()

    assert off(advised.setting) <= asked < off(4 * advised.setting)
    assert advised.coarser_setting == 2 * advised.setting
    assert advised.coarser_error > asked


def test_a_motion_that_is_not_known_well_enough_is_refused():
    with pytest.raises(InvalidInput, match=r"cannot be told after .* it is known well enough at .*--until"):
        advise("rods-5", error=1e-9, until=60.0, engines=["mujoco"])


@pytest.mark.parametrize(
    ("scene", "says"),
    [("rods-100", "no \\[state\\] with a duration|no motion")],
)
def test_what_has_no_motion_is_refused(scene, says):
    with pytest.raises(InvalidInput, match=says):
        advise(scene)


def test_the_command_says_what_to_use_first(capsys):
    assert run(["advise", "double-pendulum", "-e", "exudyn-tree", "--error", "1e-4", "--until", "1"]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.startswith("Use exudyn-tree with ")
    assert "over 1 s" in first


def test_where_no_engine_keeps_the_error_the_run_is_incomplete(capsys):
    status = run(["advise", "double-pendulum", "-e", "exudyn-redundant", "--error", "1e-12", "--budget", "1"])
    shown = capsys.readouterr().out
    assert status == 3
    assert shown.startswith("No engine's integrator keeps an error of 1e-12")
    assert "Not within 1e-12" in shown
