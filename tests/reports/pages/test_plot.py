"""Lines are drawn where the ticks say, and what an axis cannot show is left out."""

import pytest

from furiko.reports.pages.plot import LARGE, Series, draw, to_series


def places(ticks):
    return {tick.base + tick.exponent: tick.place for tick in ticks}


def test_a_plots_points_are_where_its_ticks_say():
    lines = {"a": [(1.0, 1.0), (100.0, 1e-4)]}
    plot = draw(to_series(lines, marked=True), "x", "y", log_x=True, log_y=True)
    across, up = places(plot.x_ticks), places(plot.y_ticks)
    assert plot.lines[0].marks[0][:2] == (across["1"], up["1"])
    assert plot.lines[0].marks[1][:2] == pytest.approx((across["102"], up["10−4"]))


def test_what_a_logarithm_cannot_hold_is_left_out():
    assert draw(to_series({"a": [(0.0, 1.0)]}), "x", "y", log_x=True) is None
    lines = {"a": [(1.0, 0.0), (1.0, 2.0)], "b": [(1.0, float("nan"))]}
    plot = draw(to_series(lines), "x", "y", log_y=True)
    assert [line.series.name for line in plot.lines] == ["a"]


def test_the_largest_x_is_on_the_left_where_x_falls():
    series = [Series("a", [(1e-3, 1.0, "coarse"), (1e-9, 2.0, "fine")], 0, 0)]
    plot = draw(series, "x", "y", frame=LARGE, log_x=True, log_y=True, falling_x=True)
    (coarse, _, _), (fine, _, _) = plot.lines[0].marks
    assert LARGE.left == coarse < fine == LARGE.right


def test_the_front_is_a_staircase():
    series = [Series("a", [(1e-1, 1.0, ""), (1e-2, 10.0, "")], 0, 0)]
    plot = draw(series, "x", "y", log_x=True, log_y=True, falling_x=True, front=[(1e-1, 1.0), (1e-2, 10.0)])
    low, high = plot.frame.bottom, plot.frame.top
    left, right = plot.frame.left, plot.frame.right
    assert plot.front == f"M{left:.1f} {low:.1f}L{left:.1f} {high:.1f}L{right:.1f} {high:.1f}"


def test_a_long_line_without_marks_is_thinned():
    plot = draw(to_series({"a": [(float(i), float(i)) for i in range(10_000)]}), "x", "y")
    assert plot.lines[0].path.count("L") == 399


def test_an_engine_keeps_its_colour_where_others_are_missing():
    (series,) = to_series({"b": [(1.0, 1.0)]}, order=["a", "b"])
    assert series.colour == 1
