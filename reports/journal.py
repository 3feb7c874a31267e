"""A result stream that may be gone on with: what stands there is read, and new lines are appended after it.

A run that was killed leaves its header, the results that it had, and perhaps half a line. The half line is cut off; a
footer of a run that came to an end is taken off too, and a new one written when this one does. Each line is appended
by one write to a file that this process alone has open for writing, so that nobody ever reads two lines mixed.
"""

from __future__ import annotations

import fcntl
import os
from pathlib import Path
from types import TracebackType

from ..models.errors import InvalidInput
from ..records.check import Header, Result
from .report import Report
from .stream import StreamWriter, read_stream


class Journal:
    """A stream to go on with: ``results`` are those that stand there already.

    Raises :class:`InvalidInput` where the file cannot be written, holds the run of another command (``same`` tells what
    must not have changed), or another process is writing it.
    """

    def __init__(self, path: str | Path, header: Header) -> None:
        self.path = Path(path)
        self.header = header
        self.results: list[Result] = []
        self._writer: StreamWriter | None = None

    def __enter__(self) -> Journal:
        if self.path.exists() and self.path.stat().st_size:
            before = self._cut_back()
            if before is not None:
                self.results = list(before.results)
                self.header = before.header
                self._writer = _Appending(self.path, before)
        if self._writer is None:
            self._writer = StreamWriter(self.path, self.header)
        self._writer.__enter__()
        return self

    def write(self, result: Result) -> Result:
        """Append one result, on disk when this returns; returns it as it was written."""
        if self._writer is None:
            raise ValueError(f"{self.path}: the journal is closed")
        return self._writer.write(result)

    def finish(self, seconds: float) -> None:
        """Append the footer: this run came to its end."""
        if self._writer is not None:
            self._writer.finish(seconds)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._writer is not None:
            self._writer.__exit__(kind, error, trace)

    def _cut_back(self) -> Report | None:
        """The run that stands there, the file cut back to its last whole result; None where not even a header is."""
        with self.path.open("r+b") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise InvalidInput(
                    f"{self.path}: another run is writing it; give this one a folder of its own"
                ) from None
            content = file.read()
            whole = content.rfind(b"\n") + 1
            last = content.rfind(b"\n", 0, max(whole - 1, 0)) + 1
            if b'"kind":"footer"' in content[last:whole][:40]:
                whole = last
            file.truncate(whole)
        if not whole:
            return None
        before = read_stream(self.path)
        self._same(before.header)
        return before

    def _same(self, found: Header) -> None:
        for what, there, here in (
            ("seed", found.seed, self.header.seed),
            ("profile", found.profile, self.header.profile),
            ("furiko", found.furiko, self.header.furiko),
            *((name, found.versions.get(name), version) for name, version in self.header.versions.items()),
        ):
            if there != here:
                raise InvalidInput(
                    f"{self.path}: begun with {what} {there}, this is {here}; go on as it was begun, start anew with "
                    f"--fresh, or give another --out"
                )


class _Appending(StreamWriter):
    """Goes on with a stream that has its header and results."""

    def __init__(self, path: Path, before: Report) -> None:
        super().__init__(path, before.header)
        self._counts.update(result.outcome for result in before.results)

    def __enter__(self) -> StreamWriter:
        try:
            descriptor = os.open(self.path, os.O_WRONLY | os.O_APPEND | os.O_CLOEXEC)
            self._file = os.fdopen(descriptor, "ab", buffering=0)
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            self._size = self.path.stat().st_size
        except OSError as error:
            raise self._unwritable(error) from None
        return self
