"""Units in which numbers of the documents' mechanisms are subnormal, and the bound that tells what that may cost."""

import numpy as np
import pytest
from fake_engines import Right

from furiko.reference.truth.newton_euler import enclosed_accelerations
from furiko.stress import stress
from furiko.studies.stress.accelerations import AccelerationCase
from furiko.studies.stress.axes import AXES, UNITS, find_axes, pairs

ENGINE = "fake_engines:Right"
NAMES = tuple(axis.name for axis in AXES if UNITS in axis.fields)


def test_the_axes_are_those_of_masses_lengths_and_times_and_of_all_three_on_both_kinds():
    kinds = {name: find_axes((name,))[0].base.kind for name in NAMES}
    stems = ("small-mass", "small-length", "slow", "subnormal")
    assert kinds == {f"{s}-rods": "rod-chain" for s in stems} | {f"{s}-legs": "n-leg" for s in stems}
    assert not any(name in pair.name.split(" x ") for pair in pairs() for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_other_units_are_the_same_motion(name):
    """By dimensions: θ'' is the same in every unit of mass and length, and (unit of time)² smaller in that of time."""
    (axis,) = find_axes((name,))
    factors = {}
    for rung in (0, 10):
        recipe = axis.recipe(rung)
        theta, omega = recipe.draw("seed")
        found = enclosed_accelerations(recipe.system(), theta[:3], omega[:3]).high
        factors[rung] = found / recipe.of_time**2
    assert factors[10] == pytest.approx(factors[0], rel=1e-14)


def test_the_last_rungs_are_where_products_are_subnormal():
    (slow,), (small,) = find_axes(("slow-rods",)), find_axes(("subnormal-rods",))
    _, omega = slow.recipe(slow.top).draw("seed")
    assert 0 < (omega**2).max() < 2.0**-1022  # the squares of rates that are far from it
    recipe = small.recipe(38)
    system, (_, omega) = recipe.system(), recipe.draw("seed")
    assert np.abs(omega).max() > 1e-153
    torque = max(system.masses) * max(system.lengths) ** 2
    assert torque * (omega**2).max() == 0  # below the smallest number, though all the factors are not


@pytest.mark.parametrize("name", NAMES)
def test_furikos_own_kernels_lose_nothing_but_what_is_subnormal_in_the_answer(name):
    (axis,) = find_axes((name,))
    for rung in range(0, axis.top + 1, 8):
        recipe = axis.recipe(rung)
        result = AccelerationCase(name, "kernels", rung, 1).run()
        assert result.outcome == "agrees"
        assert result.details["error over bound"] < 0.1
        if recipe.of_time > 2.0**-480:  # accelerations are above the normal range's end by all their digits
            assert result.measured < 1e-14


def test_at_the_end_what_is_lost_is_explained_by_underflow_and_told():
    (axis,) = find_axes(("subnormal-rods",))
    result = AccelerationCase("subnormal-rods", "kernels", axis.top, 1).run()
    assert (result.outcome, result.details["failure"]) == ("agrees", "half its digits lost")
    assert "numbers below the normal range may do" in result.reason


@pytest.mark.parametrize("rung", [0, 20, 40])
def test_an_engine_that_is_off_by_more_than_rounding_is_found_in_every_unit(monkeypatch, rung):
    true = Right.accelerations
    monkeypatch.setattr(Right, "accelerations", lambda self, t, w: true(self, t, w) * (1 + 1e-9))
    result = AccelerationCase("slow-rods", ENGINE, rung, 1).run()
    assert (result.outcome, result.details["failure"]) == ("differs", "more than rounding")
    assert result.details["error over bound"] > 100
    monkeypatch.undo()
    assert AccelerationCase("slow-rods", ENGINE, rung, 1).run().outcome == "agrees"


def test_an_engine_that_flushes_subnormals_is_found_on_units_alone(monkeypatch):
    """Squares of rates below the normal range are zero, more than underflow may do not far below it."""
    true = Right.accelerations

    def flushing(self, theta, omega):
        lost = (np.abs(omega).max() ** 2) < 2.0**-1022
        return true(self, theta, omega) * (0.0 if lost else 1.0)

    monkeypatch.setattr(Right, "accelerations", flushing)
    assert AccelerationCase("slow-rods", ENGINE, 50, 1).run().outcome == "agrees"
    result = AccelerationCase("slow-rods", ENGINE, 52, 1).run()
    assert result.details["failure"] == "wrong numbers that look right"
    assert result.details["error over bound"] > 1


@pytest.mark.slow
@pytest.mark.sweep
def test_no_engine_that_is_right_is_beyond_the_bound_anywhere():
    """The bound of rounding, underflow included, is derived: on no rung of any axis is a right engine beyond it."""
    found = stress(["accelerations"], None, budget=600)
    over = {(f.engine, f.axis): max([p.error_over_bound or 0.0 for p in f.curve], default=0) for f in found.frontiers}
    assert max(over.values()) <= 1, [name for name, value in over.items() if value > 1]
    assert not found.kernels.broken
