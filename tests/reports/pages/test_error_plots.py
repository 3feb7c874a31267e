"""Errors are drawn on their side of the bound, and errors over time once."""

import itertools
import re

import pytest

from furiko.reports.pages.check_page import to_html
from furiko.reports.pages.error_plots import draw_errors


def test_marks_stand_left_of_the_bound_exactly_where_errors_are_within_it(make):
    shares = [0.0, 1e-300, 1e-3, 0.999, 1.0, 1.001, 1e3, 1e300]
    results = [make.result(check=str(i), measured=s * 64, allowed=64) for i, s in enumerate(shares)]
    results.append(make.result("differs", check="nothing allowed", measured=1e-9, allowed=0))
    plot = draw_errors(results, ["mujoco"])
    positions = [row.marks[0].x for row in plot.rows]
    assert positions[:8] == sorted(positions[:8])
    assert [x < plot.bound - 1e-9 for x in positions[:4]] == [True] * 4
    assert positions[4] == pytest.approx(plot.bound)
    assert all(x > plot.bound for x in positions[5:])
    assert len({(mark.x, mark.y) for row in plot.rows for mark in row.marks}) == len(results)
    decade = plot.ticks[1].place - plot.ticks[0].place
    assert all(b.place - a.place == pytest.approx(decade) for a, b in itertools.pairwise(plot.ticks))


def test_engines_have_lanes_of_their_own(make):
    plot = draw_errors([make.result(engine=e) for e in "abcdef"], list("abcdef"))
    heights = [mark.y for mark in plot.rows[0].marks]
    assert heights == sorted(heights)
    assert min(b - a for a, b in itertools.pairwise(heights)) >= 8  # a mark is 8 high


def test_nothing_measured_nothing_drawn(make):
    assert draw_errors([make.result("skipped")], ["mujoco"]) is None


def test_errors_over_time_are_drawn_once_and_not_listed(make):
    history = [[0.5, 1e-7, 2e-7], [1.0, 1e-6, 2e-6], [2.0, 1e-3, None], [3.0, None, "x"], ["no", 1, 1], 7]
    details = {"errors over time": history, "step": 0.01, "Lyapunov time": 0.5}
    page = to_html(make.report(make.result(check="horizon RK4", details=details)))
    line = '<path class="{}" d="([^"]*)"'
    plot = [re.findall(line.format(word), page)[0] for word in ("measured", "predicted")]
    assert [points.count("L") for points in plot] == [1, 2]
    assert "Lyapunov time</dt><dd>0.5 s" in page
    assert "errors over time</th>" not in page
