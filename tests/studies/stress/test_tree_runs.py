"""Motions of open mechanisms that are known for ever, and what runs of engines' integrators keep of them."""

import numpy as np
import pytest
from fake_tree_engines import Right

from furiko.reference.truth.spatial import energy
from furiko.reference.truth.tree_motion import tree_motion
from furiko.stress import stress
from furiko.studies.stress.trees.motions import angle_between, known_motions
from furiko.studies.stress.trees.runs import STEPS, TIMES, TOP, TreeRunCase, energy_drift, kept

NAMES = tuple(known_motions())
TURNING = ("thrown", "top")


@pytest.mark.parametrize("name", NAMES)
def test_the_closed_form_is_the_motion_that_proven_accelerations_give(name):
    known = known_motions()[name]
    times = [0.7, 1.5, 4.0]
    found = tree_motion(known.system.mechanism(), np.array(known.q), np.array(known.v), times)
    for time, q, v, sure in zip(times, found.q, found.v, found.error, strict=True):
        now = kept(known, time, q, v)
        assert now.phase <= 100 * sure + 1e-11
        assert now.energy < 1e-11
        assert now.failure is None


@pytest.mark.parametrize("name", NAMES)
def test_another_moment_is_another_state(name):
    """A phase that is off by a hundredth of a second is an error of about the rate times that, at every time."""
    known = known_motions()[name]
    found = tree_motion(known.system.mechanism(), np.array(known.q), np.array(known.v), [0.7, 1.57, 3.1])
    for time, q, v in zip([0.7, 1.57, 3.1], found.q, found.v, strict=True):
        assert 2e-3 < known.error(time + 0.01, q, v) < 0.1


def test_a_fall_turns_as_much_energy_from_one_into_the_other_as_the_body_has_fallen():
    known = known_motions()["thrown"]
    falls = 2.0 * 9.81 * (9.81 * 100**2 / 2 - 100 * height_speed(known))
    assert known.energy_at(100.0) - known.scale == pytest.approx(falls, rel=1e-12)


def height_speed(known):
    """Of the centre of mass at the start [m/s], by differences of its height along the proven motion."""
    found = tree_motion(known.system.mechanism(), np.array(known.q), np.array(known.v), [1.0])
    _, potential = energy(known.system.mechanism(), np.array(known.q), np.array(known.v)).float
    then = energy(known.system.mechanism(), found.q[0], found.v[0]).float[1]
    return (then - potential) / (2.0 * 9.81) + 9.81 / 2


def test_the_angle_between_rotations_is_exact_near_zero_and_at_half_a_turn():
    turn = lambda a: np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])  # noqa: E731
    for angle in (1e-12, 0.3, 3.0):
        assert angle_between(turn(0.0), turn(angle)) == pytest.approx(angle, rel=1e-3 if angle < 1e-9 else 1e-9)


def test_energy_and_lengths_that_drift_are_seen():
    known = known_motions()["top"]
    q, v = np.array(known.q), np.array(known.v)
    assert energy_drift(known, 5.0, q, v * 1.1) == pytest.approx(
        0.21, rel=1e-9
    )  # over 1: it began with 1, has 1.21 now
    assert kept(known, 0.0, q * (1 + 1e-6), v).failure == "quaternions lose their length"
    assert kept(known, 0.0, q * (1 + 1e-9), v).failure is None
    assert kept(known, 0.0, q, v * 2).failure == "energy runs away"
    assert kept(known, 0.0, q * np.nan, v).failure == "NaN"


def ran(**fields):
    given = {"engine": "mujoco", "integrator": "RK4", "motion": "top", "step": 0.01, "rung": 4} | fields
    return TreeRunCase(**given).run()


def test_a_scheme_of_first_order_turns_the_top_too_fast_by_an_error_in_proportion_to_its_step():
    coarse, fine = (ran(integrator="Euler", step=step, rung=1).details["phase error"] for step in (0.01, 0.002))
    assert 4 < coarse / fine < 6  # 5


def test_a_scheme_of_fourth_order_keeps_to_all_of_them_for_a_hundred_seconds():
    for name in NAMES:
        result = ran(motion=name)
        assert result.outcome == "agrees", name
        assert result.details["length drift"] < 1e-14
        assert result.details["energy drift"] < 1e-6


def test_what_an_engine_cannot_hold_is_refused():
    result = ran(engine="exudyn-tree", integrator="RK44")
    assert (result.outcome, result.details["failure"]) == ("skipped", "refused")
    assert "hinges and slides alone" in result.reason


def test_an_integrator_that_forgets_to_normalise_is_named(monkeypatch):
    true = Right.trajectory

    def longer(self, q, v, *how):
        end, rates = true(self, q, v, *how)
        return end * (1 + 1e-6), rates

    monkeypatch.setattr(Right, "trajectory", longer)
    result = ran(engine="fake_tree_engines:Right", integrator="RK4", motion="top", rung=0, step=0.04)
    assert result.details["failure"] == "quaternions lose their length"


def test_long_times_and_many_steps_are_asked_for_last_and_given_time():
    assert [TIMES[rung] for rung in range(TOP + 1) if TreeRunCase("e", "i", "top", 0.01, rung).heavy] == [3e3, 1e4]
    assert TreeRunCase("e", "i", "top", 0.002, TOP).takes >= 600


@pytest.mark.slow
def test_a_run_says_how_long_each_step_keeps_to_it_in_words_and_on_the_page(tmp_path, capsys):
    from furiko.cli.main import run

    assert run(["stress", "-a", "tree runs", "-e", "mujoco", "--budget", "25", "--out", str(tmp_path)]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "open mechanisms keep to a known motion" in text
    assert "phase lost" in text
    page = (tmp_path / "stress.html").read_text(encoding="utf-8")
    assert "motions that are known for ever" in page


@pytest.mark.slow
@pytest.mark.sweep
def test_a_thousand_seconds_are_known_of_every_integrator_and_step():
    found = stress(["tree runs"], ["mujoco", "exudyn-tree"], budget=240)
    assert {run.step for run in found.tree_runs} == set(STEPS)
    for run in found.tree_runs:
        if run.failure != "refused":
            assert run.fails_at is not None or max(point.time for point in run.runs) >= 1000
