"""What the grader must show: as many of each kind as a minute takes.

``python tests/grader_score.py`` measures all of it: every single mistake, 1,000 pairs, 1,000 rewritings, 10,000
malformed inputs.
"""

import pytest
from grader_score import cold, hostile_inputs, pairs, rewritings, singles, table


def share(tally, *beginnings):
    counted = {what: count for what, count in tally.counts.items() if not what.startswith("left out")}
    return sum(count for what, count in counted.items() if what.startswith(beginnings)) / sum(counted.values())


def check_singles(tally):
    assert share(tally, "NOT", "FALSELY", "no term") == 0, table([tally])
    # the catalogue's own names, or another for provably the same equations, which nobody could tell apart
    # (or right if angles are from elsewhere, which is said)
    assert share(tally, "named first", "named under another", "equivalent", "right on a condition") >= 0.98


@pytest.mark.slow
@pytest.mark.sweep
def test_single_mistakes():
    check_singles(singles((2, 3)))


@pytest.mark.slow
def test_single_mistakes_of_four_links():
    check_singles(singles((4,), part=0.1))


@pytest.mark.slow
@pytest.mark.sweep
def test_pairs():
    tally = pairs(200)
    assert share(tally, "both named", "right on a condition") >= 0.85, table([tally])
    assert share(tally, "NOT") == 0


@pytest.mark.slow
@pytest.mark.parametrize("count", [40, pytest.param(250, marks=pytest.mark.sweep)])
def test_rewritings(count):
    tally = rewritings(count)
    assert share(tally, "correct") == 1, table([tally])


def check_hostile(tally):
    assert not {"TRACEBACK", "NOT ONE LINE"} & tally.counts.keys(), table([tally])
    assert tally.slowest < 10  # no hang; a second or two where a machine is busy
    (memory,) = (what for what in tally.counts if what.startswith("memory"))
    assert int(memory.split()[-2]) < 1500  # MB, of the whole test process


@pytest.mark.slow
@pytest.mark.parametrize("count", [200, pytest.param(1_500, marks=pytest.mark.sweep)])
def test_hostile_inputs(count):
    check_hostile(hostile_inputs(count))


def test_the_first_verdict_is_wrong_as_it_must_be():
    assert all(what.endswith("wrong") for what in cold((3,)).counts)


def test_the_table_shows_every_count():
    tally = rewritings(3)
    assert "100.0 %  correct" in table([tally])
