"""A little of each campaign that runs by itself: hostile inputs, printed derivations, two mistakes at once."""

import pytest
from hostile_grading import KINDS
from hostile_grading import campaign as hostile
from planted_campaign import campaign as planted
from printed_derivations import campaign as printed

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("kind", KINDS)
def test_hostile_inputs_end_in_a_verdict_or_in_one_line(kind):
    _, failures, _, _ = hostile(12, 5, kind)  # each within 2 s of its own time and 300 MB
    assert not failures


@pytest.mark.parametrize("wrong", [False, True])
def test_no_printed_derivation_is_misjudged(wrong):
    tally, bad, _ = printed(25, 9, wrong=wrong)
    assert sum(tally.values()) == 25
    assert not bad


def test_two_mistakes_are_named_or_others_for_the_same_equations():
    # of 144 that the campaign made with seeds 17, 33 and 34, 86 % were named as they were planted, and 93 % with those
    # that have the same equations; 24 of them deviate from that by 5 % each way, and by three times that once in 300
    tally, missed, _ = planted(24, 17, size=2)
    named = sum(count for what, count in tally.items() if not what.startswith(("terms alone", "NOT", "REFUSED")))
    assert not [line for line in missed if "NOT DETECTED" in line or "REFUSED" in line]
    assert named >= (0.93 - 3 * 0.052) * 24
