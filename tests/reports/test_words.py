"""Figures, and text that came from outside."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.records.exit_status import AGREES, DIFFERS, INCOMPLETE, INTERNAL_ERROR, TERMINATED
from furiko.reports.words import figure, last_line, one_line, outcome_of, printable


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (3.14159, "3.1"),
        (0.0314159, "0.031"),
        (99.4, "99"),
        (99.6, "100"),
        (314.159, "314"),
        (9999.4, "9999"),
        (9999.6, "1.0e4"),
        (12345, "1.2e4"),
        (1.23e-14, "1.2e-14"),
        (-2.5e9, "-2.5e9"),
        (5e-324, "4.9e-324"),
        (None, "–"),
        (float("inf"), "∞"),
        (float("-inf"), "−∞"),
        (float("nan"), "NaN"),
    ],
)
def test_figures(value, text):
    assert figure(value) == text


@settings(deadline=None)
@given(st.floats(-1e308, 1e308))
def test_a_figure_is_right_to_its_two_digits(value):
    assert float(figure(value)) == pytest.approx(value, rel=0.051)  # half a unit of the second digit: at most 5 %


@settings(deadline=None)
@given(st.text())
def test_text_from_outside_has_nothing_to_act_on(text):
    assert all(c.isprintable() or c == "\n" for c in printable(text))
    assert one_line(text).isprintable()
    assert len(one_line(text, 10)) <= 10


def test_what_would_act_is_written_out():
    assert printable("a\x1b[31mb\u202ec\x00\ud800") == "a\\x1b[31mb\\u202ec\\x00\\ud800"
    assert printable("θ̈ ≤ 2⁻⁵² 振り子") == "θ̈ ≤ 2⁻⁵² 振り子"


def test_spaces_of_other_scripts_are_spaces_and_controls_are_not():
    assert printable("1\u00a0000\u202fm") == "1 000 m"
    assert printable("\x0b\x1f\x85") == "\\x0b\\x1f\\x85"


def test_of_a_traceback_the_last_line_tells():
    assert last_line("Traceback (most recent call last):\n  File x\nValueError: no") == "ValueError: no"
    assert last_line("first\nsecond") == "first\nsecond"


def test_only_a_whole_run_that_agrees_has_its_glyph():
    assert [outcome_of(status) for status in (AGREES, DIFFERS)] == ["agrees", "differs"]
    assert {outcome_of(status) for status in (INCOMPLETE, INTERNAL_ERROR, TERMINATED)} == {"error"}
