"""Which release changed what, and which to look at next: by hand, on releases whose answers are made up."""

import numpy as np
import pytest

from furiko.studies.versions.changes import all_changes, changes_between, next_to_look_at
from furiko.studies.versions.looks import Look

RELEASES = [f"1.{k}" for k in range(17)]
KEY = ("rods-3", "accelerations")


def seen(answer, outcome="agrees", says=""):
    values = np.atleast_1d(np.array(answer, dtype=float))
    return {KEY: Look(*KEY, outcome, says, values.tobytes().hex(), values)}


def bisected(answers):
    """The releases that bisection looks at, and the changes that it then knows."""
    known = {RELEASES[0]: answers[0], RELEASES[-1]: answers[-1]}
    while wanted := next_to_look_at(RELEASES, known):
        known.update({release: answers[RELEASES.index(release)] for release in wanted})
    return known, all_changes(RELEASES, known)


@pytest.mark.parametrize("at", range(1, 17))
def test_the_one_that_changed_something_is_found_wherever_it_is(at):
    known, (change,) = bisected([seen(1.0 if k < at else 2.0) for k in range(17)])
    assert (change.before, change.release) == (RELEASES[at - 1], RELEASES[at])
    assert len(known) <= 2 + 4  # two ends, and log2 of sixteen steps between


def test_several_changes_are_all_found():
    steps = [0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3]
    _, changes = bisected([seen(float(step)) for step in steps])
    assert [change.release for change in changes] == ["1.3", "1.7", "1.13"]


def test_where_the_ends_answer_alike_nothing_between_is_looked_at():
    broken = [seen(2.0 if 4 <= k < 7 else 1.0) for k in range(17)]
    known, changes = bisected(broken)
    assert (len(known), changes) == (2, [])
    # looked at one by one both the break and the mending are there
    every = all_changes(RELEASES, dict(zip(RELEASES, broken, strict=True)))
    assert [change.release for change in every] == ["1.4", "1.7"]


def test_last_digits_are_told_apart_from_verdicts():
    old, near = seen([1.0, 2.0]), seen([1.0, 2.0 + 2**-51])
    (change,) = changes_between("a", "b", {"a": old, "b": near})
    assert change.kind == "rounding"
    assert "1 ε" in change.says  # 2⁻⁵¹ of the largest, 2: 2⁻⁵²
    wrong = seen([1.0, 2.0], "differs", "the inertia is 3")
    (change,) = changes_between("a", "b", {"a": old, "b": wrong})
    assert change.kind == "verdict"
    assert change.says == "agrees before; now differs (the inertia is 3)"


def test_numbers_in_a_sentence_may_have_other_last_digits():
    found = [seen(1.0, "differs", f"the inertia is {value}") for value in (0.123456781, 0.123456789, 0.2)]
    assert changes_between("a", "b", {"a": found[0], "b": found[1]}) == []
    assert len(changes_between("a", "b", {"a": found[0], "b": found[2]})) == 1


def test_an_answer_of_another_size_or_none_is_another_value():
    for other in ([1.0, 2.0, 3.0], [1.0, np.nan]):
        (change,) = changes_between("a", "b", {"a": seen([1.0, 2.0]), "b": seen(other)})
        assert change.kind == "values"


def test_a_question_that_only_one_is_asked_is_a_change():
    (change,) = changes_between("a", "b", {"a": {}, "b": seen(1.0)})
    assert (change.kind, change.says) == ("verdict", "is asked for the first time")
