"""The sharp line: what rounding really does, held against real engines and against small planted errors."""

import time
from dataclasses import replace

import numpy as np
import pytest

from furiko.checks import sharp
from furiko.checks.comparisons import accelerations, energy, joint_forces, terms
from furiko.checks.registry import CHECKS as REGISTERED
from furiko.engines import ENGINES as ENGINE_INFO
from furiko.engines import Integrator
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.models.states import States
from furiko.reference.rounding import spread

ENGINES = ("mujoco", "pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba", "exudyn-tree", "exudyn-redundant")
CHECKS = (accelerations, terms, joint_forces, energy)
SCENES = (
    "double-pendulum",
    "double-pendulum-no-gravity",
    "n-leg-3-mass-ratio",
    "n-leg-8-equal",
    "n-leg-32",
    "rods-1",
    "rods-3-length-ratio",
    "rods-5-equal",
    "rods-20",
)


class Off:
    """A real engine whose answers are moved by so much: accelerations by ``error``, everything else as it is."""

    def __init__(self, engine, error):
        self._engine, self._error = engine, error

    def __getattr__(self, name):
        return getattr(self._engine, name)

    def accelerations(self, theta, omega):
        return self._engine.accelerations(theta, omega) + self._error


def results(cell):
    return [
        result
        for check in CHECKS
        if REGISTERED[check.NAME].needs not in cell.info.missing
        for result in check.compare(cell)
    ]


@pytest.fixture(scope="module")
def quotients():
    """The worst quotient of each check, engine and scene."""
    return {}


def measured(quotients, make_cell, engine):
    if engine not in quotients:
        quotients[engine] = [
            (scene, result)
            for scene in SCENES
            if scene != "n-leg-32" or engine != "pinocchio-aba-mjcf"
            for result in results(make_cell(engine, scene, 30))
        ]
    return quotients[engine]


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_engines_that_are_right_are_not_loose(quotients, make_cell, engine):
    for scene, result in measured(quotients, make_cell, engine):
        assert result.outcome in ("agrees", "skipped"), (scene, result)
        assert not result.loose, (scene, result)


def undeclared(cell):
    """The cell of an engine of which nobody has said how it computes."""
    unknown = {"algorithm": "unknown", "moments": "unknown", "placed": "unknown", "interchanges": None}
    return replace(cell, info=replace(cell.info, **unknown))


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES[:-1])
def test_an_engine_of_which_nobody_says_how_it_computes_is_not_loose(make_cell, engine):
    for scene in ("double-pendulum", "n-leg-8", "rods-3-length-ratio", "rods-20"):
        for result in results(undeclared(make_cell(engine, scene, 30))):
            assert result.outcome in ("agrees", "skipped"), (scene, result)
            assert not result.loose, (scene, result)


def test_of_what_is_not_known_the_way_with_the_most_rounding_counts(make_cell):
    """MuJoCo takes moments about the tree's centre of mass, of which a leg far from it feels the most."""
    cell = make_cell("mujoco", "n-leg-8", 30)
    about_hinges = replace(cell, info=replace(cell.info, moments="hinge"))
    states, alpha = cell.states, cell.facts.high

    def size(one):
        return sharp.widest(one, spread.accelerations, states.theta, states.omega, alpha)

    assert (size(undeclared(cell)) >= size(cell)).all()
    assert (size(cell) > 1.5 * size(about_hinges)).any()
    assert [result.loose for result in accelerations.compare(undeclared(cell))] == [False]


def test_in_absolute_angles_moments_are_taken_about_one_point_alone(make_cell):
    cell = undeclared(make_cell("fake_engines:Right", "n-leg-8", 30))
    assert {(way.info.algorithm, way.info.moments, way.info.interchanges) for way in cell.ways} == {
        ("aba", "hinge", False),
        ("crba", "hinge", False),
        ("crba", "hinge", True),
    }
    assert [result.loose for result in accelerations.compare(cell)] == [False]


@pytest.mark.parametrize("n", [3, 100])
def test_yet_an_error_far_beyond_rounding_is_loose(make_cell, n):
    """Of the last acceleration alone, which the proven bound of a long chain allows."""
    cell = undeclared(make_cell("pinocchio-crba", f"rods-{n}", 8))
    error = np.zeros(n)
    error[-1] = 1e-4 if n == 100 else 1e-11
    (found,) = accelerations.compare(replace(cell, engine=Off(cell.engine, error)))
    assert found.loose or found.outcome == "differs"
    assert not any(result.loose for result in accelerations.compare(cell))


ARTICULATED = tuple(name for name in ENGINES if ENGINE_INFO[name].algorithm == "aba")
FACTORIZED = tuple(name for name in ENGINES[:-1] if name not in ARTICULATED)
FACTORS = {
    "terms": sharp.TERMS,
    "joint forces": sharp.JOINT_FORCES,
    "energy": sharp.ENERGY,
}


@pytest.mark.slow
@pytest.mark.parametrize("check", FACTORS)
def test_no_factor_is_ten_times_too_wide_or_too_narrow(quotients, make_cell, check):
    """What engines that are right really do stays below each factor, and comes within ten times of it."""
    found = [
        result.details["sharp line"]["quotient"]
        for engine in ENGINES[:-1]
        for _, result in measured(quotients, make_cell, engine)
        if result.check.startswith(check) and "sharp line" in result.details
    ]
    assert FACTORS[check] / 10 < max(found) <= FACTORS[check]


@pytest.mark.slow
@pytest.mark.parametrize(("engines", "factor"), [(ARTICULATED, sharp.ARTICULATED), (FACTORIZED, sharp.ACCELERATIONS)])
def test_nor_are_those_of_accelerations(quotients, make_cell, engines, factor):
    found = [
        result.details["sharp line"]["quotient"]
        for engine in engines
        for _, result in measured(quotients, make_cell, engine)
        if result.check == "accelerations"
    ]
    assert factor / 10 < max(found) <= factor


def test_nor_is_that_of_maximal_coordinates(quotients, make_cell):
    found = [
        result.details["sharp line"]["quotient"]
        for _, result in measured(quotients, make_cell, "exudyn-redundant")
        if result.check in ("accelerations", "joint forces")
    ]
    assert sharp.MAXIMAL / 10 < max(found) <= sharp.MAXIMAL


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba", "exudyn-redundant"])
@pytest.mark.parametrize("scene", ["rods-20", "n-leg-32", "rods-100"])
def test_a_small_error_in_any_entry_is_loose(make_cell, engine, scene):
    cell = make_cell(engine, scene, 3)
    moving = np.array(["random" in label for label in cell.states.labels])
    cell = replace(cell, states=cell.states.only(moving), facts=cell.facts.only(moving))
    facts, system = cell.facts, cell.scene.system
    size = spread.accelerations(cell.info, system, cell.amplitude, cell.states.theta, cell.states.omega, facts.high)
    factor = sharp.for_accelerations(cell.info)
    line = factor * size / np.abs(facts.high)  # relative, of each entry
    for entry in (0, system.n // 2, system.n - 1):
        planted = np.zeros_like(size)
        planted[:, entry] = 100 * line[:, entry].min() * np.abs(facts.high[:, entry])
        (result,) = accelerations.compare(replace(cell, engine=Off(cell.engine, planted)))
        assert result.loose or result.outcome == "differs", (entry, result)
        if result.loose:
            assert result.details["sharp line"]["entry"] == [entry + 1]
            assert "within the proven bound" in result.reason


@pytest.mark.parametrize("engine", ENGINES)
def test_at_rest_and_stretched_straight_nothing_is_loose(make_cell, engine):
    chain = RodChain((1.0, 0.7, 0.5), 1.0, 0.0)
    for theta, omega in (((0.0,) * 3, (0.0,) * 3), ((0.7,) * 3, (1.5,) * 3), ((0.7,) * 3, (0.0,) * 3)):
        for result in results(make_cell(engine, Scene("straight", chain, theta, omega, random=0), 0)):
            assert result.outcome != "differs"
            assert not result.loose, result


ONE = States(("one",), np.zeros((1, 2)), np.zeros((1, 2)))


def test_where_nothing_is_rounded_nothing_may_be_off():
    nothing = sharp.line(np.zeros((1, 2)), np.zeros((1, 2)), 10.0, ONE, 1)
    assert (nothing.quotient, nothing.loose) == (0.0, False)
    something = sharp.line(np.array([[0.0, 1e-300]]), np.zeros((1, 2)), 10.0, ONE, 1)
    assert (something.loose, something.where) == (True, (1,))
    overflown = sharp.line(np.ones((1, 2)), np.array([[np.inf, np.nan]]), 10.0, ONE, 1)
    assert not overflown.loose


@pytest.mark.parametrize(("times", "loose"), [(0.99, False), (1.01, True), (2.0, True)])
def test_what_is_beyond_a_factor_times_the_spread_is_loose(times, loose):
    """A factor of 10, a spread of 2e-16: 2e-15; and where a solver's tolerance allows 3e-15 besides, 5e-15."""
    spread = np.full((1, 2), 2e-16)
    for besides, most in ((0.0, 2e-15), (3e-15, 5e-15)):
        found = sharp.line(np.array([[0.0, -times * most]]), spread, 10.0, ONE, 1, besides)
        assert (found.loose, found.where) == (loose, (1,))
        assert found.quotient == pytest.approx(10 * times, rel=1e-12)
        assert sharp.verdict(True, found, "") | {"reason": ""} == {"outcome": "agrees", "reason": ""} | (
            {"loose": True} if loose else {}
        )


def test_the_worst_states_are_chosen_and_some_of_all():
    excess = np.zeros(100)
    excess[[7, 70]] = 2.0, 1.0
    found = sharp.chosen(excess, 10)
    assert {7, 70, 0, 99} <= set(found.tolist())
    assert len(found) <= 10
    np.testing.assert_array_equal(sharp.chosen(excess[:5], 10), np.arange(5))


def test_a_wrong_engine_in_maximal_coordinates_differs_within_seconds(make_cell):
    cell = make_cell("exudyn-redundant", "rods-50", 20)
    started = time.process_time()
    (result,) = accelerations.compare(replace(cell, engine=Off(cell.engine, 1.0)))
    assert result.outcome == "differs"
    assert "states not judged" in result.details
    assert time.process_time() - started < 15


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-crba", "exudyn-tree"])
def test_what_squares_of_slow_rates_lose_is_rounding(make_cell, engine):
    """ω² is about 1e-315, which double precision holds to eight digits; terms are 1e92 times that."""
    system = NLegPendulum((2.7e36, 3.8e36, 3.2e36), (4.6e19, 3.1e18, 1.9e19), gravity=0.0)
    omega = (-3.460992552978651e-158, 8.88768517331926e-158, -3.0158355787265936e-157)
    cell = make_cell(engine, Scene("slow", system, (-0.03, 2.17, -1.3), omega))
    found = {result.check: result for result in terms.compare(cell) if result.outcome != "skipped"}
    assert "terms velocity" in found
    for result in found.values():
        assert (result.outcome, result.loose) == ("agrees", False), result


def test_each_algorithm_has_its_own_factor():
    """As the measurements in the module's head have them; a step's is no smaller than its accelerations'."""
    explicit, implicit = Integrator("RK4", 4), Integrator("GeneralizedAlpha", 2, tolerance=1e-12)
    expected = {
        "pinocchio-crba": (25.0, 25.0, 30.0),
        "pinocchio-aba": (15.0, 15.0, 30.0),
        "exudyn-redundant": (8.0, 10.0, 30.0),
    }
    for name, (solved, steps, iterated) in expected.items():
        info = ENGINE_INFO[name]
        assert sharp.for_accelerations(info) == solved
        assert (sharp.for_steps(info, explicit), sharp.for_steps(info, implicit)) == (steps, iterated)


@pytest.mark.parametrize(("n", "states"), [(4, 50), (50, 8), (100, 6), (200, 3), (201, 0)])
def test_terms_of_long_chains_are_looked_at_in_few_states(n, states):
    """Each state costs n rows of inverse dynamics: some 200 in all, 600 where that would be less than eight states."""
    assert sharp.states_for_terms(ENGINE_INFO["mujoco"], n) == states
    assert sharp.states_for_terms(replace(ENGINE_INFO["mujoco"], algorithm="other"), n) == 0


def test_how_many_states_a_cell_can_afford():
    """A thousand entries of accelerations and energies, 64 of symmetries; in maximal coordinates so many eliminations,
    of 1 ms and 40 µs for each square of the links, as fit into a quarter of a second.
    """
    tree, maximal = ENGINE_INFO["mujoco"], ENGINE_INFO["exudyn-redundant"]
    other = replace(tree, algorithm="other")
    assert [sharp.states_for_accelerations(tree, n) for n in (4, 1000)] == [250, 4]
    assert [sharp.states_for_accelerations(maximal, n) for n in (5, 50)] == [10, 2]
    assert [sharp.states_for_energy(tree, n) for n in (8, 1000)] == [125, 4]
    assert [sharp.states_for_symmetries(tree, n) for n in (4, 40, 65)] == [2, 1, 0]
    assert [sharp.states_for_symmetries(maximal, n) for n in (5, 38, 50)] == [2, 1, 0]
    for states in (sharp.states_for_accelerations, sharp.states_for_energy, sharp.states_for_symmetries):
        assert states(other, 4) == 0


def test_how_many_steps_are_taken_beside_an_engine():
    euler, fourth = Integrator("Euler", 1), Integrator("RK4", 4)
    implicit = Integrator("GeneralizedAlpha", 2, tolerance=1e-12)
    assert [sharp.steps_together(euler, 4, 1024), sharp.steps_together(implicit, 4, 1024)] == [64, 8]
    assert [sharp.steps_together(fourth, n, 1024) for n in (2, 4, 8, 100)] == [16, 16, 8, 4]
    assert [sharp.steps_together(fourth, n, 256) for n in (2, 100)] == [4, 4]


def test_of_an_odd_number_of_states_one_more_is_chosen_for_being_bad():
    excess = np.zeros(100)
    excess[[7, 30, 70]] = 3.0, 2.0, 1.0
    assert sharp.chosen(excess, 5).tolist() == [0, 7, 30, 70, 99]


def test_a_loose_entry_is_told_by_its_place_counted_from_one():
    errors = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 1e-14]]])
    found = sharp.line(errors, np.full((1, 2, 3), 1e-16), 10.0, ONE, 7)
    assert "entry [2, 3] in state 'one' is off by 100 times" in found.says
    told = found.details()["sharp line"]
    assert (told["entry"], told["states"], told["of states"]) == ([2, 3], 1, 7)
