"""The message and the exit status of a command that failed, by the kind of the exception."""

from __future__ import annotations

import errno
import os
import re
import tempfile
import traceback
from dataclasses import dataclass
from typing import TYPE_CHECKING

import click

from ..records.exit_status import BAD_INPUT, CLOSED_PIPE, INCOMPLETE, INTERNAL_ERROR, INTERRUPTED
from ..records.printable import printable
from .process import OutputFailed, Stopped

if TYPE_CHECKING:
    from ..records.errors import Error

LONGEST = 2000  # characters of a message
SHOW_TRACEBACK = "FURIKO_TRACEBACK"

# Failures of the machine, not of furiko: a full or read-only disk, no memory, processes or file handles left.
_OF_THE_MACHINE = {
    errno.EACCES, errno.EAGAIN, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE, errno.ENOMEM,
    errno.ENOSPC, errno.EPERM, errno.EROFS,
}  # fmt: skip
_HELP = {
    errno.EMFILE: "raise the limit of open files, as with 'ulimit -n 1024'",
    errno.ENFILE: "close other programs: the system has no file handle left",
    errno.ENOMEM: "free memory, or use fewer --jobs",
    errno.EAGAIN: "raise the limit of processes, or use fewer --jobs",
    errno.ENOSPC: "free space on the disk, or set TMPDIR to a folder with space",
    errno.EDQUOT: "free space on the disk, or set TMPDIR to a folder with space",
}
_SENTENCE = re.compile(r"(cannot|not|no|internal|got|missing|unknown|this)\b", re.IGNORECASE)  # how no place begins


@dataclass(frozen=True)
class Failure:
    """``message``: one line, ``where: what; help`` as far as each is known; empty for nothing to say."""

    message: str
    status: int

    def record(self) -> Error:
        """The failure as documents have it."""
        from ..records.errors import Error  # most runs print none

        what, where, help_ = self.parts()
        return Error(what=what, where=where, help=help_)

    def parts(self) -> tuple[str, str, str]:
        """What, where and help, each as far as the message has it."""
        where, what = _split_place(self.message)
        hint = re.search(r" ?\((did you mean [^()]*\?)\)|; |: (?=pip install )", what, re.IGNORECASE)
        if hint is None:
            return what, where, ""
        rest = what[hint.end() :].removeprefix("; ")
        return what[: hint.start()], where, "; ".join(filter(None, [hint[1] or "", rest]))


def failure_of(error: BaseException) -> Failure:
    """The message of an exception, and the exit status."""
    if isinstance(error, Stopped):
        return _interrupted(f"interrupted by {error}", error.status)
    if isinstance(error, KeyboardInterrupt | click.Abort):
        return _interrupted("interrupted", INTERRUPTED)
    if isinstance(error, OutputFailed):
        if error.closed_by_reader:
            return Failure("", CLOSED_PIPE)
        return Failure(_line(f"standard output: cannot be written: {error}"), INCOMPLETE)
    if isinstance(error, click.ClickException):
        return Failure(_usage(error), BAD_INPUT)
    return _expected(error) or _internal(error)


def _expected(error: BaseException) -> Failure | None:  # noqa: PLR0911 -- one for each kind
    """Failures that are the user's or the machine's to mend; None for a mistake in furiko."""
    # Imported here, not above: a check starts its workers before it imports numpy.
    from ..models.errors import InvalidInput, LibraryMissing

    if isinstance(error, InvalidInput):
        return Failure(_line(str(error)), BAD_INPUT)
    if isinstance(error, LibraryMissing):
        return Failure(_line(str(error)), INCOMPLETE)
    if isinstance(error, MemoryError):
        return Failure("out of memory; free memory, or use fewer --jobs or smaller scenes", INCOMPLETE)
    if isinstance(error, OSError):
        return _of_the_machine(error)
    text = str(error)
    if isinstance(error, ImportError) and os.strerror(errno.EMFILE) in text:
        return Failure(_line(f"{text}; {_HELP[errno.EMFILE]}"), INCOMPLETE)
    if isinstance(error, RuntimeError) and "can't start new thread" in text:
        return Failure(f"no further thread can be started; {_HELP[errno.EAGAIN]}", INCOMPLETE)
    return None


def _of_the_machine(error: OSError) -> Failure | None:
    no_temporary_folder = isinstance(error, FileNotFoundError) and "temporary directory" in str(error)
    if error.errno not in _OF_THE_MACHINE and not no_temporary_folder:
        return None
    where = f"{os.fsdecode(error.filename)}: " if isinstance(error.filename, str | bytes) else ""
    hint = _HELP.get(error.errno or 0, "set TMPDIR to a folder that can be written" if no_temporary_folder else "")
    return Failure(_line(f"{where}{error.strerror or error}" + (f"; {hint}" if hint else "")), INCOMPLETE)


def _internal(error: BaseException) -> Failure:
    """A mistake in furiko: one line; the traceback goes into a file, or to standard error where the user asks so."""
    what = f"internal error: {type(error).__name__}: {str(error)[:300]}; this is a mistake in furiko, please report it"
    trace = printable("".join(traceback.format_exception(error)))
    if os.environ.get(SHOW_TRACEBACK):
        click.echo(trace, err=True, nl=False)
        return Failure(_line(what), INTERNAL_ERROR)
    try:
        descriptor, path = tempfile.mkstemp(prefix="furiko-error-", suffix=".txt")
        with os.fdopen(descriptor, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write(trace)
        found = f"with {path}, which has the traceback"
    except OSError:
        found = f"with the traceback, which {SHOW_TRACEBACK}=1 prints"
    return Failure(_line(f"{what} {found}"), INTERNAL_ERROR)


def _interrupted(what: str, status: int) -> Failure:
    return Failure(f"{what}; a stream of results that was being written has no footer: incomplete", status)


def _usage(error: click.ClickException) -> str:
    message = error.format_message()
    context = error.ctx if isinstance(error, click.UsageError) else None
    if context is not None and isinstance(error, click.NoSuchOption | click.BadArgumentUsage | click.MissingParameter):
        message = f"{message.rstrip('.')}; '{context.command_path} --help' lists what it takes"
    return _line(message)


def _line(text: str) -> str:
    """One line that a terminal can show."""
    line = printable(" ".join(text.split()))
    half = LONGEST // 2
    return line if len(line) <= LONGEST else f"{line[:half]} … {line[-half:]}"


def _split_place(message: str) -> tuple[str, str]:
    """The place in front of a message (file, field, engine, option), and the rest."""
    parts = message.split(": ")
    places = 0
    while places < min(3, len(parts) - 1) and not _SENTENCE.match(parts[places]) and len(parts[places].split()) <= 4:
        places += 1
    return ": ".join(parts[:places]), ": ".join(parts[places:])
