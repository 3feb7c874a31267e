"""The exit status of several answers."""

import pytest

from furiko.records.exit_status import (
    AGREES,
    BAD_INPUT,
    DIFFERS,
    INCOMPLETE,
    INTERNAL_ERROR,
    INTERRUPTED,
    TERMINATED,
    gravest,
)


@pytest.mark.parametrize(
    ("statuses", "expected"),
    [
        ([], AGREES),
        ([AGREES, AGREES], AGREES),
        ([AGREES, BAD_INPUT], BAD_INPUT),
        ([BAD_INPUT, DIFFERS, AGREES], DIFFERS),
        ([DIFFERS, INCOMPLETE], DIFFERS),
        ([INCOMPLETE, BAD_INPUT], INCOMPLETE),
        ([INTERNAL_ERROR, DIFFERS], DIFFERS),
        ([DIFFERS, TERMINATED], TERMINATED),
        ([AGREES, INTERRUPTED], INTERRUPTED),
    ],
)
def test_a_difference_outweighs_all_but_a_signal(statuses, expected):
    assert gravest(statuses) == expected
