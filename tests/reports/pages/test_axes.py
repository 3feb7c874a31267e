"""Axes hold their values, and ticks are at round numbers."""

import math

import pytest

from furiko.reports.pages.axes import Axis, fits, linear_axis, log_axis, path


@pytest.mark.parametrize("values", [[1.0], [0.0], [-1.0, 3.0], [5.0, 9.0], [1.0, 100.0]])
def test_a_linear_axis_holds_its_values(values):
    axis = linear_axis(values, 0.0, 100.0)
    assert all(0 <= axis.at(value) <= 100 for value in values)
    assert axis.low < axis.high


def test_a_linear_axis_begins_at_zero_where_zero_is_near():
    assert linear_axis([1.0, 100.0], 0, 1).low == 0
    assert linear_axis([60.0, 100.0], 0, 1).low == 60


@pytest.mark.parametrize(("values", "ends"), [([1.0], (0, 1)), ([2.0, 1e3], (0, 3)), ([1e-4, 1e-4 + 1e-15], (-4, -3))])
def test_a_logarithmic_axis_has_whole_decades(values, ends):
    axis = log_axis(values, 0.0, 1.0)
    assert (axis.low, axis.high) == ends


def test_values_beyond_are_drawn_at_the_end():
    axis = Axis(-2, 2, 0.0, 100.0, log=True)
    assert [axis.at(value) for value in (0.0, 1e-9, 1.0, 1e9, math.inf)] == [0.0, 0.0, 50.0, 100.0, 100.0]


def test_ticks_are_at_multiples_of_a_round_step_and_no_more_than_asked():
    decades = Axis(-7, 5, 0.0, 12.0, log=True).ticks(6)
    assert [(tick.base, tick.exponent) for tick in decades] == [
        ("10", "−6"), ("10", "−4"), ("10", "−2"), ("1", ""), ("10", "2"), ("10", "4"),
    ]  # fmt: skip
    steps = Axis(-0.3, 1.1, 0.0, 14.0).ticks(6)
    assert [tick.base for tick in steps] == ["0", "0.5", "1"]
    assert [tick.place for tick in steps] == pytest.approx([3.0, 8.0, 13.0])


@pytest.mark.parametrize(("value", "log", "shown"), [(0.0, False, True), (0.0, True, False), (None, False, False)])
def test_what_an_axis_can_show(value, log, shown):
    assert fits(value, log) is shown


def test_one_point_makes_no_line():
    assert path([(1.0, 2.0)]) == ""
    assert path([(1.0, 2.0), (3.04, 4.0)]) == "M1.0 2.0L3.0 4.0"
