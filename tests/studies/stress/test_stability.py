"""What fails first in a run, and what energy does in the long run: each kind told from series that are known."""

import numpy as np
import pytest

from furiko.reference.documents.equations_of_motion import energies
from furiko.studies.stress.failures import of_answer, of_energy, of_path
from furiko.studies.stress.stability import (
    TOP,
    LongRunCase,
    StabilityCase,
    classify,
    first_failure,
    problem,
    step,
    steps,
)

MANY = 1001
time = np.linspace(0, 1, MANY)


def drawn(seed):
    return np.random.default_rng(seed)


@pytest.mark.parametrize("seed", range(10))
def test_what_is_bounded_is_told(seed):
    phases = drawn(seed).uniform(0, 6, 3)
    waves = sum(np.sin(2 * np.pi * f * time + p) for f, p in zip((97.3, 41.7, 203.1), phases, strict=True))
    assert classify(waves + drawn(seed).normal(0, 0.5, MANY), 10).kind == "bounded"


@pytest.mark.parametrize("seed", range(10))
def test_a_random_walk_is_told(seed):
    # H of one walk of 1000 steps over these lags scatters by 0.08 about a half: a quarter is three of that.
    found = classify(np.cumsum(drawn(seed).normal(size=MANY)), 10)
    assert found.kind == "random walk"


@pytest.mark.parametrize("seed", range(5))
def test_a_line_is_told_with_its_rate(seed):
    found = classify(3.0 * time + drawn(seed).normal(0, 0.02, MANY), 10)
    assert found.kind == "linear"
    assert found.rate * 10 * (MANY - 1) == pytest.approx(3.0, rel=0.01)


@pytest.mark.parametrize("growth", [5.0, 12.0, 30.0])
def test_an_exponential_is_told_with_its_rate(growth):
    found = classify(1e-6 * np.exp(growth * time) + drawn(0).normal(0, 1e-9, MANY), 10)
    assert found.kind == "exponential"
    assert found.rate * 10 * (MANY - 1) == pytest.approx(growth, rel=0.06)  # the fit's grid is that coarse


def test_nothing_at_all_is_bounded_and_too_little_is_refused():
    assert classify(np.zeros(100), 1).kind == "bounded"
    with pytest.raises(ValueError, match="too few"):
        classify([0.0] * 10, 1)


def test_a_nan_is_found_and_when():
    theta, omega = np.arange(8.0)[:, None], np.ones((8, 1))
    assert of_path(theta, omega) is None
    omega[5:] = np.nan
    assert of_path(theta, omega) == ("NaN", 5)


def test_a_silent_reset_is_found_and_rest_is_none():
    theta, omega = np.arange(8.0)[:, None], np.ones((8, 1))
    theta[4:] = theta[:4]
    assert of_path(theta, omega) == ("silent reset", 4)
    rest = np.zeros((8, 1))
    assert of_path(rest, rest) is None


def test_what_comes_first_in_a_run_is_its_failure():
    theta, omega = np.arange(8.0)[:, None], np.ones((8, 1))
    theta[4] = theta[0]
    omega[6] = np.nan
    assert of_path(theta, omega) == ("silent reset", 4)
    theta[4], theta[6], omega[6] = 4.0, theta[0], 1.0
    omega[3] = np.inf
    assert of_path(theta, omega) == ("NaN", 3)
    omega[3], theta[6] = 1.0, 6.0
    theta[5, 0] = np.nan  # the angle alone
    assert of_path(theta, omega) == ("NaN", 5)


def test_a_state_of_several_links_is_the_initial_one_only_if_every_angle_and_rate_is():
    theta = np.outer(np.arange(6.0), [1.0, 0.0])  # the second angle stays where it was
    omega = np.ones((6, 2))
    assert of_path(theta, omega) is None
    theta[4] = theta[0]
    omega[4, 1] = 2.0  # an angle that comes back with another rate is a swing
    assert of_path(theta, omega) is None
    omega[4, 1] = 1.0
    assert of_path(theta, omega) == ("silent reset", 4)
    omega[2, 0] = np.nan
    assert of_path(theta, omega) == ("NaN", 2)


def test_energy_that_runs_away_is_found_and_when():
    values = np.array([1.0, 1.2, 0.9, 1.6, 3.0])
    assert of_energy(values, 1.0, 0.5) == 3
    assert of_energy(np.array([1.0, np.inf]), 1.0, 0.5) == 1
    assert of_energy(values[:3], 1.0, 0.5) is None
    assert of_energy(np.array([1.0, 1.5, 0.25]), 1.0, 0.5) == 2  # at the limit it is not beyond it
    assert of_energy(np.array([1.0, 3.0, 9.0]), 4.0, 0.5) == 2


def test_answers_are_named_by_their_error():
    fine = np.ones((2, 3))
    assert of_answer(fine, 1e-9) is None
    assert of_answer(fine, 1e-7) == "half its digits lost"
    assert of_answer(fine, 0.5) == "wrong numbers that look right"
    assert of_answer(fine * np.nan, 0.0) == "NaN"
    one = fine.copy()
    one[1, 2] = np.inf
    assert of_answer(one, 0.0) == "NaN"
    # Half the digits of a double are 2⁻²⁶, and a hundredth is the second digit.
    assert of_answer(fine, 2.0**-26) is None
    assert of_answer(fine, 0.0099) == "half its digits lost"
    assert of_answer(fine, 0.01) == "wrong numbers that look right"


def test_what_shows_first_names_the_failure():
    given = problem("links", 1.0, 0)
    still = np.repeat(given.theta[None], 9, axis=0), np.zeros((9, 1))
    assert first_failure(given, *still)[0] is None
    assert first_failure(given, *still, gap=0.2)[0] == "joints come apart"
    theta, omega = (rows.copy() for rows in still)
    omega[4:] = 50.0
    omega[7:] = np.nan
    with np.errstate(all="ignore"):
        failure, when, _ = first_failure(given, theta, omega)
    assert (failure, when) == ("energy runs away", 4)


def test_energy_above_rest_is_the_height():
    given = problem("links", 1.0, 0)
    assert given.scale == pytest.approx(9.81 * 0.5 * (1 - np.cos(given.theta[0])), rel=1e-12)
    assert float(sum(energies(given.system, given.theta, given.omega))) == pytest.approx(given.scale - 9.81 / 2)


def test_rungs_are_half_octaves_of_one_swing():
    assert steps(TOP) == 1
    assert steps(0) == 4096
    assert step(TOP - 2, 1.0) == pytest.approx(0.5)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "failure"),
    [("Resets", "silent reset"), ("ComesApart", "joints come apart"), ("EndsInNaN", "NaN")],
)
def test_each_way_to_fail_is_named(engine, failure):
    # A step of one swing (2 s) over 4096 is half a millisecond: all is well; over 128 it is 16 ms.
    fine = StabilityCase(f"fake_engines_stress:{engine}", "Euler", "links", 1.0, 0, 0).run()
    assert (fine.outcome, fine.details["failure"]) == ("agrees", None)
    long = StabilityCase(f"fake_engines_stress:{engine}", "Euler", "links", 1.0, 10, 0).run()
    assert (long.outcome, long.details["failure"]) == ("differs", failure)


def test_a_long_run_goes_on_from_part_to_part():
    first = LongRunCase("fake_engines:Right", "RK4", 0, 20_000).run()
    start = tuple(first.details["theta"]), tuple(first.details["omega"])
    second = LongRunCase("fake_engines:Right", "RK4", 1, 20_000, start).run()
    assert first.details["steps"] == second.details["steps"] == 200
    assert len(first.details["drift"]) == 10
    # RK4 at 1 ms: an error of (h ω)⁵ a step, ω ~ 10/s, 400 steps
    assert abs(second.details["drift"][-1]) < 400 * (1e-3 * 10) ** 5
    assert first.details["theta"] != second.details["theta"]
