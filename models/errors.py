"""The two errors that a user can correct: invalid input, and an engine that is not installed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class InvalidInput(ValueError):
    """A user's input is invalid; the message says what, where, and what would be right."""


class EngineMissing(RuntimeError):
    """An engine that was asked for cannot be imported; the message says how to install it."""


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint naming the known word closest to ``word``: `` (did you mean 'x'?)``, or an empty string."""
    close = difflib.get_close_matches(word, list(known), n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""
