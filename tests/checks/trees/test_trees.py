"""The comparisons of trees: a right engine agrees in all, each fault is found by its check and by no other."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from fake_tree_engines import FLOATING, SMALL, FewQuestions, NoForces

from furiko.checks.cache import _scene
from furiko.checks.jobs import CellJob, TruthJob, messages_of
from furiko.checks.jobs import Facts as FactsMessage
from furiko.checks.plan import PROFILES, Task, make_plan, random_states, skip
from furiko.checks.registry import CHECKS
from furiko.checks.trees import accelerations
from furiko.checks.trees.facts import TreeFacts, tree_facts
from furiko.checks.trees.verdict import judged
from furiko.engines import OWN_EQUATIONS, engine_info
from furiko.models import find_scene
from furiko.models.scene import scene_from_toml
from furiko.models.states import States
from furiko.models.trees.states import TreeStates, tree_states
from furiko.records.check import Result

STATES = 2
COMPARED = ("accelerations", "terms", "joint forces", "energy", "trajectory")


@pytest.fixture(scope="module")
def scene():
    return scene_from_toml(SMALL, "small")


@pytest.fixture(scope="module")
def facts(scene):
    (_, message) = messages_of(TruthJob(scene, STATES))
    assert isinstance(message, FactsMessage)
    return message.content


def results(scene, facts, engine, checks=COMPARED):
    task = Task(scene, f"fake_tree_engines:{engine}", checks, STATES)
    return [message for message in messages_of(CellJob(task, facts)) if isinstance(message, Result)]


def outcomes(found):
    return {result.check: result.outcome for result in found}


def test_a_right_engine_agrees_in_every_comparison(scene, facts):
    found = results(scene, facts, "Right")
    assert set(outcomes(found)) == {
        "accelerations",
        "terms M",
        "terms bias",
        "terms G",
        "terms passive",
        "joint forces",
        "energy",
        "trajectory RK4",
    }
    assert set(outcomes(found).values()) == {"agrees"}


@pytest.mark.parametrize(
    ("engine", "check", "says"),
    [
        ("WrongAccelerations", "accelerations", "the acceleration of 'pin'|the acceleration of 'rail'"),
        ("WrongMass", "terms M", "mass matrix: the entry of pin, pin is"),
        ("WrongVelocityTerms", "terms bias", "bias: the entry of"),
        ("WrongPassive", "terms passive", "forces of dampers and springs"),
        ("WrongForces", "joint forces", "the force of 'block' on what carries it|the force of 'rod'"),
        ("OtherPoint", "joint forces", "the moment of 'block' on what carries it|the moment of 'rod'"),
        ("OnTheLink", "joint forces", "on what carries it is off by"),
        ("WrongEnergy", "energy", "the kinetic energy is off by"),
        ("WrongHeight", "energy", "the potential energy is off by"),
        ("WrongScheme", "trajectory RK4", "order"),
    ],
)
def test_each_fault_is_found_by_its_check_and_no_other(scene, facts, engine, check, says):
    found = results(scene, facts, engine)
    differing = [result for result in found if result.outcome == "differs"]
    assert [result.check for result in differing] == [check]
    assert any(word in differing[0].reason for word in says.split("|"))
    if check != "trajectory RK4":
        assert "in state" in differing[0].reason


def test_a_run_that_ends_beside_the_motion_in_one_coordinate_alone(scene, facts):
    (result,) = results(scene, facts, "Beside", ("trajectory",))
    assert result.outcome == "differs"
    assert result.measured == pytest.approx(1e-4, rel=1e-6)


def test_a_scheme_of_one_order_less_differs_by_its_order_alone(scene, facts):
    """0.1 h³ is extrapolated to zero as well as a scheme of the fourth order may leave it, and still shows."""
    (result,) = results(scene, facts, "OneOrderLess", ("trajectory",))
    assert result.outcome == "differs"
    assert result.measured <= result.allowed
    assert result.reason == "RK4 is of order 4 and shows order 3.00"


def test_an_acceleration_leaves_a_residual_in_what_is_off_the_diagonal_too():
    """By hand: M = (2, 1; 1, 3) and accelerations that are off by (2, -1): rows of 3 and -1, not of 4 and -3."""
    found = compare_accelerations(np.array([[2.0, -1.0]]), np.array([[[2.0, 1.0], [1.0, 3.0]]]))
    assert found.measured == pytest.approx(3.0)


def compare_accelerations(error, mass):
    """The result for such errors in units of ε, (1, n), where the unit of each row is one."""
    ones = SimpleNamespace(residual=lambda *_, **__: np.ones(error.shape[1]))
    cell = SimpleNamespace(
        info=SimpleNamespace(algorithm="other", factorises=True, inverts=True),  # whose usual rounding is not known
        states=TreeStates(("one",), np.zeros_like(error), np.zeros_like(error)),
        facts=SimpleNamespace(error=lambda got: 2.0**-52 * error, mass_matrix=mass, high=np.ones_like(error)),
        engine=SimpleNamespace(accelerations=lambda q, v: np.ones_like(error)),
        answer=lambda name, found, shape: found,
        magnitudes=[ones],
        roundings=np.array([20.0]),
        freedom=str,
        result=lambda check, outcome, **fields: Result(
            scene="by hand", engine="none", check=check, outcome=outcome, **fields
        ),
    )
    (found,) = accelerations.compare(cell)
    return found


def test_gravity_that_is_off_shows_in_gravity_and_in_the_bias(scene, facts):
    found = outcomes(results(scene, facts, "WrongGravity"))
    assert {check for check, outcome in found.items() if outcome == "differs"} == {"terms G", "terms bias"}


def test_trajectories_are_not_run_where_accelerations_differ(scene, facts):
    found = outcomes(results(scene, facts, "WrongAccelerations"))
    assert found["trajectory"] == "skipped"


def test_the_potential_energy_may_be_off_by_a_constant(scene, facts):
    assert outcomes(results(scene, facts, "OtherZero", ("energy",))) == {"energy": "agrees"}


def test_bad_answers_are_errors_of_the_engine(scene, facts):
    (shape,) = results(scene, facts, "BadShape", ("accelerations",))
    assert shape.outcome == "error"
    assert "shape (6, 3), not (6, 2)" in shape.reason  # the given state, three named ones, two random ones
    (nan,) = results(scene, facts, "NotANumber", ("accelerations",))
    assert nan.outcome == "error"
    assert "first in state 'random 1'" in nan.reason


def test_what_is_skipped_has_its_reason(scene):
    documents_only = engine_info("exudyn-redundant")
    assert "takes the documents' mechanisms alone" in skip("accelerations", scene, documents_only)
    assert skip("accelerations", scene, FewQuestions.info) == "it has no springs"
    without_spring = scene_from_toml(SMALL.replace("stiffness = 4.0\n", ""), "small")
    assert skip("accelerations", without_spring, FewQuestions.info) == ""
    assert skip("energy", without_spring, FewQuestions.info) == "it has accelerations alone"
    for check in ("model fields", "horizon"):
        assert len(skip(check, scene, engine_info("mujoco")).split()) > 5
    assert "never forms the forces" in skip("joint forces", find_scene("cart-pole"), engine_info("exudyn-tree"))
    assert "does not offer the forces" in skip("joint forces", scene, NoForces.info)
    assert skip("invariant", scene, engine_info("pinocchio-aba")).startswith("Pinocchio computes dynamics")
    assert skip("invariant", find_scene("quadruped"), engine_info("mujoco")) == ""
    own = OWN_EQUATIONS
    assert "not of its images" in CHECKS["symmetry"].skipped(scene, own)
    assert "joints hold" in CHECKS["joint forces"].skipped(scene, own)
    assert skip("step map", find_scene("humanoid"), engine_info("mujoco")) == ""
    for name in ("arm-7", "quadruped", "humanoid"):
        assert skip("trajectory", find_scene(name), engine_info("mujoco")) == ""
    sprung = scene_from_toml(FLOATING.replace('kind = "ball"', 'kind = "ball"\nstiffness = 0.5'), "sprung")
    for check in ("invariant", "trajectory"):
        assert "jumps at half a turn" in skip(check, sprung, engine_info("mujoco"))
    assert skip("step map", sprung, engine_info("mujoco")) == ""
    at_once = replace(find_scene("arm-7"), duration=0.0)
    assert skip("trajectory", at_once, engine_info("mujoco")).startswith("the scene has no duration")


def test_every_check_says_what_it_does_with_trees():
    for check in CHECKS.values():
        assert check.trees


def test_at_most_twenty_states_of_a_tree_in_a_quick_run():
    tree, document = find_scene("humanoid"), find_scene("rods-2")
    assert random_states(tree, PROFILES["quick"]) == 20
    assert random_states(document, PROFILES["quick"]) == 200
    plan = make_plan(["humanoid", "rods-2"], ["mujoco"], "quick")
    assert {task.scene.name: task.random_states for task in plan.tasks} == {"humanoid": 20, "rods-2": 200}


def test_facts_survive_the_way_to_another_process(scene):
    facts = tree_facts(scene, tree_states(scene, 1))
    again = TreeFacts.from_bytes(facts.to_bytes())
    for name in (
        "high",
        "low",
        "mass_matrix",
        "bias",
        "gravity",
        "passive",
        "energy",
        "times",
        "end_q",
        "end_error",
        "forces",
    ):
        assert (getattr(again, name) == getattr(facts, name)).all()


def test_every_number_of_a_tree_is_in_its_key(scene):
    for old, new in (("0.7", "0.70001"), ("[0.1, 1.0, 0.2]", "[0.1, 1.0, 0.3]"), ("pin = -0.4", "pin = -0.5")):
        assert _scene(scene_from_toml(SMALL.replace(old, new), "small")) != _scene(scene)
    assert _scene(scene_from_toml(SMALL, "small")) == _scene(scene)


@pytest.mark.parametrize(("part", "outcome"), [(0.5, "agrees"), (2.0, "differs")])
def test_twice_what_rounding_explains_is_beyond_it_and_half_is_not(part, outcome):
    """Ten roundings of a unit of 3, in the second of two states."""
    cell = SimpleNamespace(
        states=States(("one", "two"), np.zeros((2, 1)), np.zeros((2, 1))),
        roundings=np.array([20.0, 10.0]),
        result=lambda check, **more: (check, more["outcome"], more["measured"], more["allowed"]),
    )
    error = np.array([[0.0], [part * 10 * 2.0**-52 * 3.0]])
    found = judged(cell, "energy", error, np.full((2, 1), 3.0), lambda *_: "off", {})
    assert found == ("energy", outcome, pytest.approx(part * 10), 10.0)
