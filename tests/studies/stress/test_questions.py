"""Which question comes next: every axis before any of them twice, whatever is found on the way."""

import time
from collections import Counter
from dataclasses import dataclass

import pytest

from furiko.studies.stress.frontier import next_rung, scouts
from furiko.studies.stress.questions import Questions

WEIGHTS = {"first": 3.0, "second": 1.0}


@dataclass(frozen=True)
class Ladder:
    """A search of a ladder whose rungs hold below ``fails``; some rungs may be heavy."""

    name: str
    top: int
    fails: int
    family: str = "first"
    heavy_from: int = 10**9
    compiled: bool = False


@dataclass(frozen=True)
class Rung:
    ladder: Ladder
    rung: int

    @property
    def heavy(self):
        return self.rung >= self.ladder.heavy_from

    @property
    def compiles(self):
        return self.ladder.compiled


def asked(ladders, count, seconds=lambda case: 1.0):
    """The first cases that are asked, one at a time, each answered at once."""
    answers = {ladder: {} for ladder in ladders}

    def next_case(ladder):
        rung = next_rung(answers[ladder], ladder.top)
        return None if rung is None else Rung(ladder, rung), len(answers[ladder])

    questions, found = Questions(ladders, next_case, WEIGHTS), []
    while len(found) < count and (chosen := questions.next()):
        ladder, case = chosen
        answers[ladder][case.rung] = case.rung < ladder.fails
        questions.answered(ladder, seconds(case))
        found.append(case)
    return found, questions.open


def test_a_run_that_is_cut_off_has_asked_every_axis_alike():
    # Some fail at once, some never: bisecting the first that fails would leave the last ones empty.
    ladders = [Ladder(f"axis {k}", top=40, fails=(3, 17, 41)[k % 3]) for k in range(20)]
    for count in (20, 33, 60):
        found, left = asked(ladders, count)
        each = Counter(case.ladder for case in found)
        assert len(each) == 20
        assert max(each.values()) - min(each.values()) <= 1
        assert left == 20
    everything, left = asked(ladders, 10_000)
    assert left == 0
    first = {ladder: [case.rung for case in everything if case.ladder == ladder] for ladder in ladders}
    # From coarse to fine: as the ladder's own order has it, the scouts up to the first that fails come first.
    for ladder, rungs in first.items():
        places = scouts(40)
        needed = [rung for rung in places if rung <= min([one for one in places if one >= ladder.fails], default=40)]
        assert rungs[: len(needed)] == needed


def test_what_takes_long_comes_last():
    ladders = [Ladder("heavy", 40, 41, heavy_from=20), Ladder("light", 40, 41)]
    found, _ = asked(ladders, 100)
    assert [case.heavy for case in found] == sorted(case.heavy for case in found)


def test_families_share_the_time_by_weight():
    ladders = [Ladder(f"{family} {k}", 40, 41, family) for family in WEIGHTS for k in range(15)]
    found, _ = asked(ladders, 80)
    shares = Counter(case.ladder.family for case in found)
    assert shares == {"first": 60, "second": 20}
    # A family whose cases take three times as long gets a third of them for the same time.
    found, _ = asked(ladders, 80, lambda case: 3.0 if case.ladder.family == "first" else 1.0)
    shares = Counter(case.ladder.family for case in found)
    assert shares["first"] == pytest.approx(shares["second"], abs=2)


def test_every_search_has_an_answer_before_any_has_two():
    """Also of a family with little weight, and of one whose cases take long; what is heavy can wait."""
    ladders = [Ladder(f"{family} {k}", 40, 41, family) for family in WEIGHTS for k in range(30)]
    ladders.append(Ladder("heavy", 40, 41, heavy_from=0))
    for slow in WEIGHTS:
        found, _ = asked(ladders, 61, lambda case, slow=slow: 20.0 if case.ladder.family == slow else 1.0)
        assert len({case.ladder for case in found[:60]}) == 60
        assert not any(case.heavy for case in found)


def test_what_is_compiled_comes_after_the_first_answers_of_its_family():
    ladders = [Ladder("kernels", 40, 41, compiled=True), Ladder("one", 40, 41), Ladder("another", 40, 41)]
    found, _ = asked(ladders, 4)
    assert [case.ladder.name for case in found] == ["one", "another", "kernels", "one"]


def test_one_that_is_being_answered_is_not_asked_again_and_is_still_open():
    ladder = Ladder("only", 40, 41)
    questions = Questions([ladder], lambda one: (Rung(one, 0), 0), WEIGHTS)
    assert questions.next() == (ladder, Rung(ladder, 0))
    assert (questions.next(), questions.open) == (None, 1)
    questions.answered(ladder, 0.0)
    assert questions.next() == (ladder, Rung(ladder, 0))


def test_choosing_among_many_costs_no_more_than_among_few():
    def seconds(count):
        ladders = [Ladder(str(k), 1, 2) for k in range(count)]
        questions = Questions(ladders, lambda one: (Rung(one, 0), 0), WEIGHTS)
        begun = time.perf_counter()
        for _ in range(300):
            search, _ = questions.next()
            questions.answered(search, 1.0)
        return time.perf_counter() - begun

    # log2(30,000) / log2(300) is 1.8; a walk over all of them would take a hundred times as long.
    assert min(seconds(30_000) for _ in range(3)) < 10 * min(seconds(300) for _ in range(3))
