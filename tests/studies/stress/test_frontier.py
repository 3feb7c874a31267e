"""Frontiers by bisection: whatever the ladder, found in logarithmic time, and from answers in any order."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from furiko.studies.stress.frontier import SCOUTS, Frontier, frontier, next_rung, scouts


def climb(fails_from, top):
    answers = {}
    while (rung := next_rung(answers, top)) is not None:
        assert rung not in answers
        assert 0 <= rung <= top
        answers[rung] = rung < fails_from
    return answers


@given(top=some.integers(0, 500), data=some.data())
@settings(deadline=None, max_examples=200)
def test_every_frontier_is_found(top, data):
    fails_from = data.draw(some.integers(0, top + 1))
    answers = climb(fails_from, top)
    expected = Frontier(top, None, True) if fails_from > top else Frontier(fails_from - 1, fails_from, True)
    assert frontier(answers, top) == expected
    # A fifth of the ladder is left after the scouts; each question halves it.
    assert len(answers) <= SCOUTS + 1 + math.ceil(math.log2(top / SCOUTS + 2))


def test_a_failure_that_goes_away_again_is_seen():
    answers = {}
    while (rung := next_rung(answers, 40)) is not None:
        answers[rung] = not 18 <= rung <= 22
    assert frontier(answers, 40) == Frontier(17, 18, True)


@pytest.mark.parametrize("fails_from", [0, 3, 17, 41])
def test_a_search_that_was_cut_off_asks_for_the_same_rungs(fails_from):
    whole = list(climb(fails_from, 40).items())
    for cut in range(len(whole)):
        assert next_rung(dict(reversed(whole[:cut])), 40) == whole[cut][0]


def test_an_open_frontier_says_how_wide_it_is():
    assert frontier({}, 40) == Frontier(-1, None, False)
    assert frontier({0: True, 10: True, 20: False}, 40) == Frontier(10, 20, False)
    assert frontier({0: True, 10: True, 20: False}, 40).width == 9


def test_scouts_reach_from_end_to_end():
    assert scouts(40) == [0, 10, 20, 30, 40]
    assert scouts(0) == [0]


def test_a_failure_that_came_early_does_not_hide_what_lies_below():
    assert next_rung({40: False}, 40) == 0
    assert next_rung({0: True, 40: False}, 40) == 10
