"""One record a check: its module is there, bears its name, and each comparison has a record."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from furiko.checks.plan import PROFILES, make_plan, plan_of, random_states
from furiko.checks.registry import CHECKS
from furiko.engines import OWN_EQUATIONS, EngineInfo, engine_info
from furiko.models import find_scene

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("check", CHECKS.values(), ids=lambda check: check.name)
def test_a_check_is_what_its_record_says(check):
    module = import_module(f"furiko.checks.comparisons.{check.module}")
    assert check.name == module.NAME
    assert callable(module.compare)
    assert check.meaning.endswith(".")
    assert check.bound


def test_every_comparison_has_a_record():
    files = {path.stem for path in (ROOT / "checks" / "comparisons").glob("*.py")} - {"__init__"}
    assert files == {check.module for check in CHECKS.values()}


def test_a_check_says_why_it_is_skipped():
    info = EngineInfo("none", "", "", "", "", "", "absolute", missing={"trajectory": "it has no integrator"})
    scene = find_scene("rods-2")
    assert CHECKS["step map"].skipped(scene, info) == "it has no integrator"
    assert CHECKS["accelerations"].skipped(scene, info) == ""
    assert "not tagged 'chaotic'" in CHECKS["horizon"].why_not(scene, info)


def test_each_profile_has_the_checks_and_states_that_it_says():
    """A quick run leaves out what takes seconds, and nothing else."""
    every = {"model fields", "accelerations", "symmetry", "terms", "joint forces", "energy", "derivatives", "step map"}
    every |= {"trajectory"}
    assert PROFILES["smoke"].checks == ("accelerations",)
    assert set(PROFILES["quick"].checks) == every
    assert set(PROFILES["full"].checks) == {*every, "invariant", "horizon"}
    states = {name: make_plan(["rods-1"], ["mujoco"], name).tasks[0].random_states for name in PROFILES}
    assert states == {"smoke": 20, "quick": 200, "full": 1000}


def test_own_equations_are_asked_of_scenes_that_have_some():
    """Not named, a scene without any says nothing of them; named, it is skipped in a sentence."""
    scene, own, smoke = find_scene("rods-1"), (replace(OWN_EQUATIONS),), PROFILES["smoke"]
    silent = plan_of((scene,), own, smoke, asked=False)
    assert (silent.tasks, silent.settled) == ((), ())
    (named,) = plan_of((scene,), own, smoke, asked=True, absent={OWN_EQUATIONS.name: ""}).settled
    assert (named.outcome, named.reason) == ("skipped", "the scene has no equations of a user's own")


def test_an_engine_that_is_missing_is_an_error_unless_nobody_named_it():
    info, scene = engine_info("mujoco"), find_scene("rods-1")
    for more, outcome in (({}, "error"), ({"asked": True}, "error"), ({"asked": False}, "skipped")):
        (found,) = plan_of((scene,), (info,), PROFILES["smoke"], absent={"mujoco": "not installed"}, **more).settled
        assert (found.outcome, found.reason) == (outcome, "not installed")


@pytest.mark.parametrize(("profile", "states"), [("smoke", 2), ("quick", 20), ("full", 100)])
def test_a_tree_has_a_tenth_of_the_random_states(profile, states):
    assert random_states(find_scene("arm-7"), PROFILES[profile]) == states
    assert random_states(find_scene("rods-1"), PROFILES[profile]) == 10 * states


@pytest.mark.parametrize(("name", "states"), [("rods-10", 200), ("rods-20", 100), ("rods-50", 40), ("rods-100", 20)])
def test_of_long_chains_as_many_accelerations_are_compared_as_of_ten_links(name, states):
    assert random_states(find_scene(name), PROFILES["quick"]) == states
