"""Why a curve of time against error turns back: by medians and fastest rounds that are made up."""

import pytest

from furiko.records.bench import Motion, Point
from furiko.reports.zigzags import zigzags


def point(setting, error, median, minimum, rounds=5, by="step [s]"):
    return Point(
        engine="mujoco", scheme="RK4", setting=setting, by=by, error=error, median=median, minimum=minimum,
        rounds=rounds, front=False,
    )  # fmt: skip


def said(*points):
    return zigzags(
        Motion(scene="s", system="rod-chain", n=2, duration=1, truth=0, points=list(points), reaches=[], left_out=[])
    )


def test_a_curve_that_rises_needs_no_word():
    assert said(point(0.02, 1e-3, 1e-3, 9e-4), point(0.01, 1e-4, 2e-3, 2e-3), point(0.005, None, 1e-3, 1e-3)) == []


@pytest.mark.parametrize(
    ("coarse", "fine", "words"),
    [
        # the fastest rounds rise as the steps do: 1 ms, 2 ms; the coarse median is 4 times its fastest round
        (
            point(0.02, 1e-3, 4e-3, 1e-3),
            point(0.01, 1e-4, 2e-3, 2e-3),
            "mujoco, RK4: the time falls from step 0.02 s to step 0.01 s: noise; the fastest rounds, 1 ms and 2 ms, "
            "rise; medians of 5 rounds are up to 4 times as long",
        ),
        (
            point(0.02, 1e-3, 4e-3, 4e-3, rounds=2),
            point(0.01, 1e-4, 2e-3, 2e-3, rounds=2),
            "noise; more of the same steps cannot take less time: the machine was busy while all its 2 rounds were",
        ),
        (
            point(1e-6, 1e-3, 4e-3, 4e-3, by="tolerance"),
            point(1e-7, 1e-4, 2e-3, 2e-3, by="tolerance"),
            "it is so in the fastest rounds too, 4 ms and 2 ms: fewer steps, or cheaper ones, meet this tolerance",
        ),
        (
            point(1e-6, 1e-3, 4e-3, 4e-3, rounds=1, by="tolerance"),
            point(1e-7, 1e-4, 2e-3, 2e-3, by="tolerance"),
            "one of the two was timed once, so nothing is known of its noise",
        ),
        (
            point(0.02, 1e-9, 1e-3, 1e-3),
            point(0.01, 3e-9, 2e-3, 2e-3, rounds=1),
            "the error grows from step 0.02 s to step 0.01 s, 1.0e-9 to 3.0e-9: rounding, or",
        ),
    ],
)
def test_a_turn_has_its_reason(coarse, fine, words):
    (sentence,) = said(fine, coarse)
    assert words in sentence


def test_of_several_turns_the_largest_is_told():
    (sentence,) = said(
        point(0.08, 1e-1, 1.1e-3, 1e-4), point(0.04, 1e-2, 1e-3, 2e-4), point(0.02, 1e-3, 4e-3, 4e-4),
        point(0.01, 1e-4, 2e-3, 8e-4),
    )  # fmt: skip
    assert "from step 0.02 s to step 0.01 s (and 1 more time)" in sentence
