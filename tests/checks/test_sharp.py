"""The sharp line: what rounding really does, held against real engines and against small planted errors."""

import time
from dataclasses import replace

import numpy as np
import pytest

from furiko.checks import sharp
from furiko.checks.comparisons import accelerations, energy, joint_forces, terms
from furiko.checks.registry import CHECKS as REGISTERED
from furiko.engines import ENGINES as ENGINE_INFO
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
