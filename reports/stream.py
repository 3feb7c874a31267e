"""The result stream, ``report.jsonl``: written line by line as results come, read back with every line checked.

A stream is complete only with its footer, and only :meth:`StreamWriter.finish` writes one. The footer has a digest of
all that stands before it: a figure that was changed afterwards does not pass for what a run measured. JSON has no NaN
and no infinity: a figure that is not finite is written as null, and the result's reason says which it was.
"""

from __future__ import annotations

import hashlib
import math
import os
import sys
from collections import Counter
from collections.abc import Iterator
from io import FileIO
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO

import msgspec

from ..models.errors import InvalidInput
from ..models.readers.bounded_file import RAW, open_regular, shown
from ..records.check import FORMAT, Diagnosis, Footer, Header, Record, Result
from ..records.findings import Difference
from ..records.printable import without_surrogates
from .locking import lock
from .report import Report
from .words import Word, word

STREAM = "report.jsonl"

# Bounds for what is read and written, so that a huge file gives a message and does not fill the memory. A full
# run of the catalogue is 2 MB, and the header of a scene with ten thousand links half a megabyte.
LARGEST_LINE = 8_000_000  # bytes
LARGEST_STREAM = 64_000_000  # bytes; as text up to four times as much, and diff reads two
MOST_VALUES = 3_000_000  # commas and brackets, a bound of the memory that the records take
DIGEST_FIELD = b'"digest":"'
LONGEST_REASON = 20_000  # characters; a traceback fits

_decoder = msgspec.json.Decoder(Record)


class _Head(msgspec.Struct):
    """The fields that a header of any format has."""

    kind: Any = None
    format: Any = FORMAT
    furiko: Any = None


class StreamWriter:
    """Writes one stream: the header on entering, each result at once, the footer only on :meth:`finish`.

    A run that is interrupted, fails, or cannot write leaves a stream without a footer, and readers say so. Raises
    :class:`InvalidInput` with the path where the file cannot be written or another run is writing it.

    >>> with StreamWriter("report.jsonl", header) as stream:
    ...     for result in results:
    ...         stream.write(result)
    ...     stream.finish()
    """

    def __init__(self, path: str | Path, header: Header) -> None:
        self.path = Path(path)
        self._header = header
        self._file: FileIO | None = None
        self._counts: Counter[Word] = Counter()
        self._diagnoses = 0
        self._size = self._values = 0
        self._seal = hashlib.sha256()  # of all that was written

    def __enter__(self) -> StreamWriter:
        try:
            self._file = _alone(self.path)
        except OSError as error:
            raise self._unwritable(error) from None
        self._line(self._header)
        return self

    def write(self, result: Result) -> Result:
        """Append one result, on disk when this returns. Returns it as it was written, with finite figures only."""
        written = _finite(result)
        self._line(written)
        self._counts[word(written)] += 1
        return written

    def write_diagnosis(self, diagnosis: Diagnosis) -> Diagnosis:
        """Append one diagnosis, on disk when this returns. Returns it as it was written."""
        written = msgspec.structs.replace(
            diagnosis,
            findings=[_finite_finding(finding) for finding in diagnosis.findings],
            alternatives=[_finite_finding(finding) for finding in diagnosis.alternatives],
        )
        self._line(written)
        self._diagnoses += 1
        return written

    def finish(self, seconds: float = 0.0) -> Footer:
        """Append the footer, with the counts of what was written, and close. ``seconds``: how long the run took."""
        footer = Footer(
            agrees=self._counts["agrees"] + self._counts["loose"],
            differs=self._counts["differs"],
            skipped=self._counts["skipped"],
            error=self._counts["error"],
            loose=self._counts["loose"],
            diagnoses=self._diagnoses,
            seconds=seconds,
        )
        seal = self._seal.copy()
        seal.update(_sealed_part(_encode(footer)))
        footer = msgspec.structs.replace(footer, digest=seal.hexdigest())
        self._line(footer)
        self._close()
        return footer

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()

    def _line(self, record: Record) -> None:
        if self._file is None:
            raise ValueError(f"{self.path}: the stream is closed, or an earlier line of it could not be written")
        line = _encode(record) + b"\n"
        self._seal.update(line)
        self._size += len(line)
        self._values += _values(line)
        if len(line) > LARGEST_LINE or self._size > LARGEST_STREAM or self._values > MOST_VALUES:
            self._close()
            raise InvalidInput(f"{self.path}: would be larger than can be read back; run fewer scenes at a time")
        rest = memoryview(line)
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError as error:
            self._close()
            raise self._unwritable(error) from None
        except BaseException:  # an interrupt may have left half a line: nothing may follow it
            self._close()
            raise

    def _close(self) -> None:
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _unwritable(self, error: OSError) -> InvalidInput:
        if isinstance(error, BlockingIOError):
            return InvalidInput(f"{self.path}: another run is writing it; give this one a folder of its own")
        return InvalidInput(f"{self.path}: cannot be written: {error.strerror or error}")


def read_stream(source: str | Path | BinaryIO) -> Report:
    """Read a stream from its path, the folder it is in, or an open binary file, checking every line.

    A stream that was cut off is read as far as it goes and is not ``complete``. Raises :class:`InvalidInput` with
    file and line if it cannot be read, is no result stream or of another format, or if a line is no record of it or out
    of order.
    """
    if not isinstance(source, str | Path):
        return _read(source, str(getattr(source, "name", "stream")))
    path = Path(source)
    try:
        path = path / STREAM if os.path.isdir(path) else path  # os.path's takes any name
        with open_regular(path) as file:
            return _read(file, shown(path))
    except OSError as error:
        raise InvalidInput(f"{shown(path)}: cannot be read: {error.strerror or error}") from None


def _read(file: BinaryIO, name: str) -> Report:
    header: Header | None = None
    footer: Footer | None = None
    results: list[Result] = []
    diagnoses: list[Diagnosis] = []
    seal, altered = hashlib.sha256(), False
    for number, line in enumerate(_lines(file, name), start=1):
        where = f"{name}, line {number}"
        if footer is not None:
            raise InvalidInput(f"{where}: something follows the footer, which is the last line of a run")
        if not line.endswith(b"\n"):
            break  # half a line, at which the run was cut off
        if number == 1:
            _require_this_format(line, where)
        record = _decode(line, where)
        if header is None:
            if not isinstance(record, Header):
                raise InvalidInput(f"{where}: a result stream begins with its header, this one does not")
            header = record
        elif isinstance(record, Header):
            raise InvalidInput(f"{where}: a second header; one file holds one run")
        elif isinstance(record, Footer):
            footer = record
            seal.update(_sealed_part(line))
            altered = seal.hexdigest() != footer.digest
        elif isinstance(record, Diagnosis):
            diagnoses.append(record)
        else:
            results.append(record)
        seal.update(line)
    if header is None:
        raise InvalidInput(f"{name}: empty, or cut off within its header; it holds no result")
    return Report(header, tuple(results), footer, tuple(diagnoses), altered)


def _sealed_part(footer: bytes) -> bytes:
    """The footer's line up to the value of its digest."""
    return footer[: footer.rfind(DIGEST_FIELD) + len(DIGEST_FIELD)]


def _lines(file: BinaryIO, name: str) -> Iterator[bytes]:
    """The lines with their line ends. Raises :class:`InvalidInput` where a line or the whole is too large."""
    size = number = values = 0
    while line := file.readline(LARGEST_LINE + 1):
        number += 1
        size += len(line)
        if len(line) > LARGEST_LINE:
            raise InvalidInput(f"{name}, line {number}: longer than {LARGEST_LINE // 1_000_000} MB, no record is")
        if size > LARGEST_STREAM:
            raise InvalidInput(f"{name}: larger than {LARGEST_STREAM // 1_000_000} MB, no run is")
        values += _values(line)
        if values > MOST_VALUES:
            raise InvalidInput(
                f"{name}, line {number}: more than {MOST_VALUES:,} values up to here, no run has so many"
            )
        yield line


def _values(line: bytes) -> int:
    return line.count(b",") + line.count(b"[") + line.count(b"{")


def _decode(line: bytes, where: str) -> Record:
    if not line.strip():
        raise InvalidInput(f"{where}: empty; every line of a result stream is one JSON object")
    try:
        record: Record = _decoder.decode(line)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise InvalidInput(f"{where}: {_told(error)}") from None
    return record


def _require_this_format(line: bytes, where: str) -> None:
    """Refuse a first line of another format, whatever else that format has in it.

    A line in which no format can be found is left to the decoder, which says what is wrong with it.
    """
    try:
        head = msgspec.json.decode(line, type=_Head)
    except (ValueError, RecursionError):
        return
    if head.kind == "header" and head.format != FORMAT:
        writer = f"furiko {head.furiko:.40}" if isinstance(head.furiko, str) else "the furiko"
        raise InvalidInput(
            f"{where}: this stream has format {head.format!r:.40}, and this furiko reads format {FORMAT}; "
            f"read it with {writer} that wrote it, or make the run again with this one"
        )


def _told(error: Exception) -> str:
    if isinstance(error, RecursionError):
        return "nested too deeply"
    if isinstance(error, UnicodeDecodeError):
        return f"not UTF-8 text: {error.reason}"
    sentence = str(error).replace("`", "'")
    return f"not a record of a result stream: {sentence[:1].lower()}{sentence[1:]}"


def _alone(path: Path) -> FileIO:
    """Open the file, empty, so that only this process writes it until it closes it."""
    # a pipe without a reader is an error, and is not waited for
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | RAW, 0o666)
    if sys.platform != "win32":
        os.set_blocking(descriptor, True)
    file = FileIO(descriptor, "wb")
    try:
        lock(descriptor)
        if path.is_file():  # a device or a pipe has nothing to empty
            os.ftruncate(descriptor, 0)
    except BaseException:
        file.close()
        raise
    return file


def _finite(result: Result) -> Result:
    """The result with null for a figure that is not finite, and the reason saying so.

    A result that agrees with a figure that is not finite becomes an error.
    """
    said = [
        f"{field} is {float(value)}"
        for field in ("measured", "allowed", "line")
        if (value := getattr(result, field)) is not None and not math.isfinite(value)
    ]
    reason = _clipped("; ".join([*said, *([result.reason] if result.reason else [])]))
    if not said:
        return result if reason == result.reason else msgspec.structs.replace(result, reason=reason)
    return msgspec.structs.replace(
        result,
        measured=_finite_or_none(result.measured),
        allowed=_finite_or_none(result.allowed),
        line=_finite_or_none(result.line),
        reason=reason,
        outcome="error" if result.outcome == "agrees" else result.outcome,
    )


def _finite_finding(finding: Difference) -> Difference:
    """The finding with words for a number that is not finite."""
    values = {
        field: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for field in ("measured", "expected")
        for value in [getattr(finding, field)]
    }
    return msgspec.structs.replace(finding, says=_clipped(finding.says), **values)


def _finite_or_none(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def _clipped(reason: str) -> str:
    """A reason that is too long keeps its beginning and its end, where a traceback names the exception."""
    if len(reason) <= LONGEST_REASON:
        return reason
    half = LONGEST_REASON // 2
    return f"{reason[:half]}\n… {len(reason) - 2 * half} characters left out …\n{reason[-half:]}"


def _encode(record: Record) -> bytes:
    try:
        return _encoder.encode(record)
    except UnicodeEncodeError:  # a file name that is not UTF-8 comes as lone surrogates, which JSON text cannot hold
        return _encoder.encode(without_surrogates(msgspec.to_builtins(record, enc_hook=_plain)))


def _plain(value: Any) -> Any:
    """Numpy's scalars and arrays as Python's own, without importing numpy."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise NotImplementedError(f"{type(value).__name__} has no place in a result stream")


_encoder = msgspec.json.Encoder(enc_hook=_plain)
