"""Figures, and text that came from outside."""

from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.records.exit_status import AGREES, DIFFERS, INCOMPLETE, INTERNAL_ERROR, TERMINATED
from furiko.reports.words import (
    batch,
    duration,
    few,
    figure,
    last_line,
    link_words,
    list_of,
    listed,
    multiple,
    one_line,
    outcome_of,
    printable,
    speed_words,
    tally,
)


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


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (12.3, "12.3 s"),
        (1.0, "1 s"),
        (0.34, "340 ms"),
        (1.2e-6, "1.2 µs"),
        (8.71e-9, "8.71 ns"),
        (2e-12, "0.002 ns"),
        (99.94, "99.9 s"),
        (99.96, "100 s"),
        (123456.0, "123456 s"),
    ],
)
def test_durations(seconds, text):
    assert duration(seconds) == text


@pytest.mark.parametrize(("ratio", "text"), [(0.82, "0.82×"), (99.94, "99.9×"), (99.96, "100×"), (9400.0, "9,400×")])
def test_ratios(ratio, text):
    assert multiple(ratio) == text


def test_states_of_a_call_and_its_threads():
    assert batch(SimpleNamespace(states=4096, threads=1)) == "4,096"
    assert batch(SimpleNamespace(states=1, threads=2)) == "1, 2 threads"


def test_mechanisms_in_words():
    assert [link_words("n-leg", 2), link_words("n-leg", 4), link_words("rod-chain", 1)] == ["1 leg", "3 legs", "1 rod"]
    tree = SimpleNamespace(scene="cart-pole", system="tree", n=2)
    assert speed_words(tree) == "cart-pole, 2 degrees of freedom"
    assert speed_words(SimpleNamespace(scene="", system="rod-chain", n=100)) == "100 rods"


def test_many_names_are_so_many_more():
    assert listed(["b", "a", "b"]) == "b, a"
    assert listed("abcde", most=5) == "a, b, c, d, e"
    assert listed("abcdefg", most=3) == "a, b, c and 4 more"


def test_many_numbers_are_so_many_in_all():
    assert list_of([1.0, 0.8, 1 / 3]) == "1, 0.8, 0.333333"
    assert list_of(range(9)) == "0, 1, 2, 3, 4, 5, 6, 7, … (9 in all)"
    assert list_of(range(8)) == "0, 1, 2, 3, 4, 5, 6, 7"


def test_up_to_three_names_are_written_out():
    assert few(["c", "a", "b", "a"], "scene") == "a, b, c"
    assert few("abcd", "scene") == "4 scenes"


@pytest.mark.parametrize(
    ("number", "outcome", "text"),
    [
        (1, "agrees", "1 agrees"),
        (2, "agrees", "2 agree"),
        (0, "differs", "0 differ"),
        (1, "error", "1 error"),
        (1200, "error", "1,200 errors"),
        (3, "skipped", "3 skipped"),
        (4, "loose", "4 loose"),
    ],
)
def test_so_many_results_of_an_outcome(number, outcome, text):
    assert tally(number, outcome) == text
