"""The exit status of several answers."""

import signal

import pytest

from furiko.records.exit_status import (
    AGREES,
    BAD_INPUT,
    CLOSED_PIPE,
    DIFFERS,
    HUNG_UP,
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
        ([DIFFERS, HUNG_UP], HUNG_UP),
        ([DIFFERS, TERMINATED], TERMINATED),
        ([AGREES, INTERRUPTED], INTERRUPTED),
    ],
)
def test_a_difference_outweighs_all_but_a_signal(statuses, expected):
    assert gravest(statuses) == expected


def test_each_status_is_what_the_manual_says():
    """Shells and CIs go by the numbers: 128 and a signal's number (POSIX), 70 for a fault of one's own (sysexits)."""
    assert (AGREES, DIFFERS, BAD_INPUT, INCOMPLETE, INTERNAL_ERROR) == (0, 1, 2, 3, 70)
    named = {
        HUNG_UP: signal.SIGHUP,
        INTERRUPTED: signal.SIGINT,
        CLOSED_PIPE: signal.SIGPIPE,
        TERMINATED: signal.SIGTERM,
    }
    assert all(status == 128 + number for status, number in named.items())
