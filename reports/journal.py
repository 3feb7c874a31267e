"""A result stream that can be resumed: the earlier results are read, and new lines are appended after them.

A run that was killed leaves its header, its results so far, and perhaps half a line. The half line is cut off. The
footer of a finished run is removed too, and a new one is written at the end of this run. Each line is appended by one
write to a file that only this process has open for writing, so that lines of two runs never mix.
"""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

from ..models.errors import InvalidInput
from ..models.readers.bounded_file import RAW, open_regular, shown
from ..records.check import Header, Result
from .locking import lock
from .report import Report
from .stream import LARGEST_STREAM, StreamWriter, read_stream
from .words import word

HEADER_START = b'{"kind":"header"'


class Journal:
    """A stream to resume, or to begin where the file is missing or empty; ``results``: those of the earlier run.

    Raises :class:`InvalidInput` where the file cannot be written, is no stream of this format, holds a run with another
    seed, profile or version, or another process is writing it.
    """

    def __init__(self, path: str | Path, header: Header) -> None:
        self.path = Path(path)
        self.header = header
        self.results: list[Result] = []
        self._writer: StreamWriter | None = None

    def __enter__(self) -> Journal:
        if os.path.exists(self.path) and self.path.stat().st_size:
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
        """Append the footer: this run is complete."""
        if self._writer is not None:
            self._writer.finish(seconds)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._writer is not None:
            self._writer.__exit__(kind, error, trace)

    def _cut_back(self) -> Report | None:
        """The earlier run, its file cut back to the last whole result; None where it has no whole header.

        The file is changed only when it is known to be a stream of this format, of the same run.
        """
        with self._open() as file:
            try:
                lock(file.fileno())
            except BlockingIOError:
                raise InvalidInput(
                    f"{self.path}: another run is writing it; give this one a folder of its own"
                ) from None
            content = file.read(LARGEST_STREAM + 1)
            if len(content) > LARGEST_STREAM:
                raise InvalidInput(f"{self.path}: larger than {LARGEST_STREAM // 1_000_000} MB, no run is")
            if b"\n" not in content:
                if content[: len(HEADER_START)] != HEADER_START[: len(content)]:
                    raise InvalidInput(f"{self.path}: not a result stream; give this run a folder of its own")
                return None  # cut off within its header: begun anew
            file.seek(0)
            before = read_stream(file)
            self._require_same_run(before.header)
            if before.altered:
                raise InvalidInput(
                    f"{self.path}: altered or damaged: the digest in its footer is of other lines; start anew with "
                    "--fresh, or give another --out"
                )
            file.truncate(_end_of_results(content))
        return before

    def _open(self) -> BinaryIO:
        open_regular(self.path).close()  # a pipe would wait, a device deliver without end
        try:
            return self.path.open("r+b")
        except OSError as error:
            raise InvalidInput(f"{shown(self.path)}: cannot be written: {error.strerror or error}") from None

    def _require_same_run(self, found: Header) -> None:
        for what, there, here in (
            ("seed", found.seed, self.header.seed),
            ("profile", found.profile, self.header.profile),
            ("furiko", found.furiko, self.header.furiko),
            *((name, found.versions.get(name), version) for name, version in self.header.versions.items()),
        ):
            if there != here:
                raise InvalidInput(
                    f"{self.path}: that run has {what} {there}, this one {here}; use the same, "
                    f"start anew with --fresh, or give another --out"
                )


def _end_of_results(content: bytes) -> int:
    """Bytes up to the last whole line that is no footer."""
    whole = content.rfind(b"\n") + 1
    last = content.rfind(b"\n", 0, whole - 1) + 1
    return last if b'"kind":"footer"' in content[last:whole][:40] else whole


class _Appending(StreamWriter):
    """Appends to a stream that has its header and results already."""

    def __init__(self, path: Path, before: Report) -> None:
        super().__init__(path, before.header)
        self._counts.update(word(result) for result in before.results)
        self._diagnoses = len(before.diagnoses)

    def __enter__(self) -> StreamWriter:
        try:
            descriptor = os.open(self.path, os.O_WRONLY | os.O_APPEND | RAW)
            self._file = os.fdopen(descriptor, "ab", buffering=0)
            lock(descriptor)
            self._size = self.path.stat().st_size
            self._seal.update(self.path.read_bytes())
        except OSError as error:
            raise self._unwritable(error) from None
        return self
