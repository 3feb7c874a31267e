"""Every check passes an engine that is right and fails one that is wrong in what it looks at, and in nothing else."""

import pytest

from furiko.records.entries import entries_in


def outcomes(results):
    return {check: result.outcome for check, result in results.items()}


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["double-pendulum", "two-legs", "n-leg-3-mass-ratio", "rods-3", "rods-5-no-gravity"])
def test_the_right_engine_agrees_in_everything(run_cell, scene):
    results = run_cell("fake_engines:Right", scene)
    skipped = {check: result.reason for check, result in results.items() if result.outcome == "skipped"}
    assert skipped == ({"terms G": "the scene has no gravity"} if scene == "rods-5-no-gravity" else {})
    assert set(outcomes(results).values()) - {"skipped"} == {"agrees"}, results
    expected = {"model fields", "accelerations", "terms M", "terms C", "terms velocity", "joint forces", "energy"}
    assert set(results) >= expected | {"step map RK4", "trajectory RK4"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "differs"),
    [
        ("AlwaysWrong", {"accelerations", "symmetry mirror", "symmetry length scale", "symmetry gravity scale"}),
        ("SlightlyWrong", {"accelerations"}),
        ("SignFlipped", {"accelerations", "terms G"}),
        ("ProductOfRates", {"terms velocity"}),
        ("HeavyEntry", {"terms M"}),
        ("WrongFields", {"model fields"}),
        ("HiddenArmature", {"model fields"}),
        ("DroppedJoint", {"model fields"}),
        ("WrongForces", {"joint forces"}),
        ("WrongEnergy", {"energy"}),
        ("LateByOneStep", {"step map RK4", "trajectory RK4"}),
        ("LowOrder", {"step map RK4", "trajectory RK4"}),
        ("Damped", {"step map RK4", "trajectory RK4"}),
    ],
)
def test_a_fault_is_found_by_the_check_that_looks_there_and_by_no_other(run_cell, engine, differs):
    results = run_cell(f"fake_engines:{engine}")
    found = {check for check, result in results.items() if result.outcome == "differs"}
    assert found == differs
    for check in differs:
        assert results[check].reason, check


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "says"),
    [
        ("Nan", "1 of .* values are NaN or infinite, first in state 'inverted'"),
        ("WrongShape", r"shape \(36, 2\) where \(37, 2\)"),
        ("NotNumbers", "could not convert string to float: 'fast'"),
    ],
)
def test_a_bad_answer_is_an_error_of_its_own_check(run_cell, engine, says):
    results = run_cell(f"fake_engines:{engine}")
    assert results["accelerations"].outcome == "error"
    import re

    assert re.search(says, results["accelerations"].reason)
    # Symmetries ask for accelerations, and step maps for the fake engines' trajectories, which are made of them.
    asking = ("accelerations", "symmetry", "step map")
    others = {check: outcome for check, outcome in outcomes(results).items() if not check.startswith(asking)}
    assert set(others.values()) == {"agrees"}


@pytest.mark.slow
def test_a_matrix_is_told_entry_by_entry(run_cell):
    """The fake engine adds 1e-10 to the torque of angle 2 for a unit acceleration of angle 1."""
    found = entries_in(run_cell("fake_engines:HeavyEntry", "n-leg-3")["terms M"].details)
    assert [[round(value * 1e10, 3) for value in row] for row in found.error] == [
        [0, 0, 0, 0],
        [1, 0, 0, 0],
        *[[0] * 4] * 2,
    ]
    tree = entries_in(run_cell("fake_tree_engines:WrongMass", "cart-pole")["terms M"].details)
    assert tree.rows == ["track", "pivot"]
    assert tree.error[1][1] == pytest.approx(1e-9 * tree.theory[1][1], rel=1e-2)  # the error has three digits
    assert tree.roundings[1][1] > tree.allowed
    assert (tree.error[0][0], tree.error[0][1]) == (0, 0)


def test_a_trajectory_is_not_run_where_accelerations_differ(run_cell):
    results = run_cell("fake_engines:AlwaysWrong")
    assert results["trajectory"].outcome == "skipped"
    assert "accelerations differ" in results["trajectory"].reason


def test_an_exception_becomes_an_error_with_its_traceback(run_cell):
    result = run_cell("fake_engines:Raising")["energy"]
    assert (result.outcome, result.reason) == ("error", "ZeroDivisionError: no energy today")
    assert "in energy" in result.details["traceback"]


def test_a_scene_at_rest_needs_no_velocity_terms(run_cell, tmp_path):
    scene = tmp_path / "still.toml"
    scene.write_text(
        '[system]\nkind = "rod-chain"\nlengths = [1.0, 0.5]\n[state]\ntheta = [1.0, 2.0]\n'
        '[samples]\nrandom = 0\nnamed = ["hanging", "horizontal"]\n'
    )
    results = run_cell("fake_engines:Right", str(scene))
    for check in ("terms C", "terms velocity"):
        assert (results[check].outcome, results[check].reason) == ("skipped", "every state of the scene is at rest")
    assert {results[check].outcome for check in ("accelerations", "terms M", "terms G", "energy")} == {"agrees"}


@pytest.mark.slow
def test_a_difference_is_given_its_cause_and_says_what_was_measured(run_cell):
    results = run_cell("fake_engines:SignFlipped", "rods-3")
    for check in ("accelerations", "terms G"):
        assert results[check].cause == "angle-convention"
        assert results[check].reason
        assert "upward vertical" not in results[check].reason  # said once, in the cell's diagnosis
    assert run_cell("fake_engines:HiddenArmature")["model fields"].outcome == "differs"


def test_single_precision_is_said_where_it_is_what_an_engine_is_held_to(run_cell, monkeypatch):
    import fake_engines

    from furiko.records.check import Result

    single = {"accuracy": 2.0**-23, "accuracy_reason": "single precision, its own", "algorithm": "other"}
    monkeypatch.setattr(fake_engines.Right, "info", fake_engines.about("Right", **single))
    found = run_cell("fake_engines:Right", "rods-2", "smoke")["accelerations"]
    assert isinstance(found, Result)
    assert found.outcome == "agrees"
    assert found.reason.endswith("; single precision, its own")
