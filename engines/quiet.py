"""Silences engines that write past Python, to the standard streams of the process, and overhears what they write."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def silenced() -> Iterator[None]:
    """Discard standard output and standard error of the whole process in this context."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    kept = [os.dup(1), os.dup(2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
        for number, own in enumerate(kept, start=1):
            os.dup2(own, number)
            os.close(own)
        os.close(nowhere)


@contextmanager
def overheard() -> Iterator[Callable[[], str]]:
    """Like :func:`silenced`; what is yielded gives what was written to standard error in this context so far."""
    with silenced(), tempfile.TemporaryFile() as heard:
        os.dup2(heard.fileno(), 2)

        def written() -> str:
            heard.seek(0)
            return heard.read().decode(errors="replace")

        yield written
