"""The exit status of every command."""

from __future__ import annotations

AGREES = 0  # everything that ran agrees, and everything that was asked for ran
DIFFERS = 1  # something differs
BAD_INPUT = 2  # wrong usage or wrong input
INCOMPLETE = 3  # an engine that was asked for is missing or failed, or the run did not finish
INTERRUPTED = 130  # interrupted (Ctrl-C), or the reader of standard output closed it
