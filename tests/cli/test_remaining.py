"""The time that is left is shown once it is known to a factor of two, and then it is."""

import random
from itertools import pairwise

import pytest

from furiko.cli.remaining import Cells, Parts, about

CHECKS = {"accelerations": 1.0, "terms": 1.0, "trajectory": 5.0, "energy": 0.2}
ENGINES = {"fast": 1.0, "slow": 1.8, "middle": 1.3}


def check_run(seed, truth=0.15):
    """A made-up run on two workers: what a check costs grows with the links, and scatters; before the first result of a
    scene its truth is computed. Times of results and what was said to be left after each."""
    draw = random.Random(seed)
    planned = [((f"s{i}", engine, check), ("rod-chain", n)) for i, n in enumerate((2, 3, 5, 8, 9, 20, 33, 60, 100) * 3)
               for engine in ENGINES for check in CHECKS]  # fmt: skip
    cells = Cells(planned)
    clock, said = 1.0, []
    for (scene, engine, check), (_, n) in sorted(planned, key=lambda one: (-one[1][1], one[0])):
        seconds = 0.05 * CHECKS[check] * ENGINES[engine] * n**0.8 * draw.lognormvariate(0, 0.3)
        clock += seconds / 2 + truth * seconds
        cells.took((scene, engine, check), seconds)
        said.append((clock, cells.remaining(clock)))
    return said


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_what_is_shown_is_within_a_factor_of_two(seed):
    said = check_run(seed)
    end = said[-1][0]
    shown = [(at, left) for at, left in said if left is not None]
    assert shown[0][0] < 0.6 * end
    wrong = [
        (at, left, end - at) for at, left in shown if not 0.5 <= left / (end - at) <= 2.0 and end - at > 0.02 * end
    ]
    assert wrong == []
    assert said[-1][1] is None


def test_nothing_is_said_of_what_has_not_been_seen():
    cells = Cells(
        [
            (("a", "e", "energy"), ("rod-chain", 2)),
            (("a", "e", "trajectory"), ("rod-chain", 2)),
            (("b", "e", "energy"), ("rod-chain", 2)),
        ]
    )
    cells.took(("a", "e", "energy"), 1.0)
    assert cells.remaining(10.0) is None  # what a trajectory costs is not known
    cells.took(("a", "e", "trajectory"), 3.0)
    assert cells.remaining(1.0) is None  # too early
    assert cells.remaining(8.0) == pytest.approx(2.0)  # 1 s of work, at 4 s of work in 8 s


def test_another_size_is_not_known_to_a_factor_of_two():
    cells = Cells([(("a", "e", "energy"), ("rod-chain", 2)), (("b", "e", "energy"), ("rod-chain", 100))])
    cells.took(("a", "e", "energy"), 1.0)
    assert cells.remaining(8.0) is None


def test_kept_results_cost_nothing_and_say_nothing():
    cells = Cells([(("a", "e", "energy"), ("rod-chain", 2)), (("b", "e", "energy"), ("rod-chain", 2))])
    cells.took(("a", "e", "energy"), 0.0)
    cells.took(("unknown", "e", "energy"), 9.0)
    assert cells.remaining(5.0) is None


def test_several_results_of_a_check_are_one_comparison():
    cells = Cells([(("a", "e", "terms"), ("rod-chain", 2)), (("b", "e", "terms"), ("rod-chain", 2))])
    for _ in range(4):
        cells.took(("a", "e", "terms"), 0.25)
    assert cells.remaining(4.0) == pytest.approx(4.0)


@pytest.mark.parametrize("stretch", [0.7, 1.0, 3.0])
def test_parts_take_as_much_longer_as_those_before(stretch):
    planned = [10.0, 20.0, 5.0, 5.0]
    parts, ends = Parts(planned), [0.0]
    for part in planned:
        ends.append(ends[-1] + stretch * part * (1.2 if part == 20.0 else 1.0))  # one is slower than was planned
    assert parts.remaining(ends[1] / 2) is None
    for number, (begin, end) in enumerate(pairwise(ends)):
        parts.begins(number, begin)
        for share in (0.0, 0.3, 0.6, 0.9, 0.99):
            now = begin + share * (end - begin)
            left = parts.remaining(now)
            assert (left is None) or number > 0
            assert left is None or 0.5 <= left / (ends[-1] - now) <= 2.0


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (None, ""), (2.0, "a few seconds left"), (8.0, "about 10 s left"), (42.0, "about 40 s left"),
        (200.0, "about 3 min left"), (7000.0, "about 1.9 h left"),
    ],
)  # fmt: skip
def test_a_time_is_said_as_well_as_it_is_known(seconds, words):
    assert about(seconds) == words
