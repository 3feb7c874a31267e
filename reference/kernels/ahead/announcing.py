"""Says on a terminal that a first call is waited for, where that takes a while: it would stall without a word.

Nothing is written into a pipe or a file.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

LONG = 1.0  # [s] before a word is said


def saying_later(line: str) -> threading.Timer:
    """A timer that says it after a while, unless it is cancelled."""
    timer = threading.Timer(LONG, say, (line,))
    timer.daemon = True
    timer.start()
    return timer


@contextmanager
def announced(line: str) -> Iterator[None]:
    """Say it if what is done meanwhile takes a while."""
    timer = saying_later(line)
    try:
        yield
    finally:
        timer.cancel()


def say(line: str) -> None:
    """One line on standard error, if it is a terminal."""
    if sys.stderr is None or not sys.stderr.isatty():
        return
    sys.stderr.write(f"furiko: {line}\n")
    sys.stderr.flush()
