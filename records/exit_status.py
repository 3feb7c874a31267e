"""The exit status of every command."""

from __future__ import annotations

from collections.abc import Iterable

AGREES = 0  # everything that ran agrees, and everything that was asked for ran
DIFFERS = 1  # something differs, or is loose where --sharp asks for it
BAD_INPUT = 2  # wrong usage or wrong input
INCOMPLETE = 3  # an engine that was asked for is missing or failed, a result is missing, or an output was not written
INTERNAL_ERROR = 70  # a mistake in furiko
HUNG_UP = 129  # SIGHUP: the terminal was closed
INTERRUPTED = 130  # SIGINT: Ctrl-C
CLOSED_PIPE = 141  # the reader of standard output closed it
TERMINATED = 143  # SIGTERM


def gravest(statuses: Iterable[int]) -> int:
    """The exit status of several answers: :data:`AGREES` for none.

    One that a signal ended outweighs all, as what was left is not known; then a difference, which is what was asked
    about; then the highest: a failure of furiko, an incomplete answer, bad input.
    """
    found = set(statuses)
    ended = max(found, default=AGREES)
    return DIFFERS if DIFFERS in found and ended <= 128 else ended
