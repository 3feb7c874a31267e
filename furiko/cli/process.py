"""The process of a command: signals that end it, and standard streams that may be closed, full, or nowhere.

It imports next to nothing: until it is there, signals do as Python has them.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import time

TYPE_CHECKING = False  # typing would take longer than all else here
if TYPE_CHECKING:
    from types import FrameType
    from typing import TextIO

SOON = 0.05  # [s] after which a signal that came where no exception leaves is raised again
AGAIN = 5.0  # [s] after which a signal that had no effect is raised again
QUIET = 2.0  # [s] in which a second signal is the same wish: a closed terminal sends several


class Stopped(KeyboardInterrupt):
    """A signal asked this process to end; it does so as after Ctrl-C: what is open is closed, workers are ended."""

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.status = 128 + number


class OutputFailed(Exception):
    """Standard output takes nothing more. No OSError, so that no library takes it for one of its own files."""

    def __init__(self, error: OSError) -> None:
        super().__init__(error.strerror or str(error))
        self.closed_by_reader = isinstance(error, BrokenPipeError)


class _Signals:
    """The signals that this process has received."""

    def __init__(self) -> None:
        self.last = -QUIET
        self.stopped: Stopped | None = None

    def stop(self, number: int, frame: FrameType | None) -> None:
        """End, unless that is under way."""
        before, self.last = self.last, time.monotonic()
        if self.last - before >= QUIET:
            self.stopped = Stopped(number)
            _alarm(AGAIN)
            raise self.stopped

    def stop_again(self, number: int, frame: FrameType | None) -> None:
        """Something has swallowed the exception: an engine's own code, or whoever catches all that it raises."""
        if self.stopped is not None:
            raise self.stopped


_signals = _Signals()


def catch_signals() -> None:
    """Raise :class:`Stopped` at SIGINT, SIGTERM and SIGHUP. A signal that this process was told to ignore stays so."""
    sys.unraisablehook = _unraisable
    if sys.platform != "win32":
        signal.signal(signal.SIGALRM, _signals.stop_again)
    for number in _numbers():
        if signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            signal.signal(number, _signals.stop)


def release_signals() -> None:
    """Have the signals end this process at once: all is done, and what the interpreter still does may be cut off."""
    for number in _numbers():
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)
    _alarm(0.0)


def _numbers() -> list[signal.Signals]:
    return [signal.SIGINT, signal.SIGTERM, *([signal.SIGHUP] if sys.platform != "win32" else [])]


def _unraisable(unraisable: sys.UnraisableHookArgs) -> None:
    """A signal that came in a callback of the interpreter's, as of an import's lock, is raised again outside of it."""
    if isinstance(unraisable.exc_value, Stopped):
        _alarm(SOON)
    else:
        sys.__unraisablehook__(unraisable)


def _alarm(seconds: float) -> None:
    """Have SIGALRM sent every so many seconds from now on; 0: no more. Windows has no such signal."""
    if sys.platform != "win32":
        signal.setitimer(signal.ITIMER_REAL, seconds, seconds)


def stopped() -> Stopped | None:
    """The signal that ends this process, if one came; it is not raised again.

    An engine's own code may have made another exception of it.
    """
    if _signals.stopped is not None:
        _alarm(0.0)
    return _signals.stopped


def open_standard_streams() -> None:
    """Give this process three standard streams whatever it was started with.

    A closed one is taken by ``/dev/null``, as the next file that is opened would take its number. What standard output
    cannot take raises :class:`OutputFailed`, once; what standard error cannot take is lost.
    """
    closed = {number for number in (0, 1, 2) if not _is_open(number)}
    for number in sorted(closed):
        # read-only for standard output, so that writing fails
        taken = os.open(os.devnull, os.O_WRONLY if number == 2 else os.O_RDONLY)
        if taken != number:
            os.dup2(taken, number)
            os.close(taken)
    sys.stdout = _text(_Raw(1, raises=True), sys.stdout)
    sys.stderr = _text(_Raw(2, raises=False), sys.stderr)


def flush() -> None:
    """Write what is left. Raises :class:`OutputFailed`."""
    if sys.stdout is not None:
        sys.stdout.flush()


class _Raw(io.FileIO):
    """A standard stream's file, never closed by its object."""

    def __init__(self, number: int, *, raises: bool) -> None:
        super().__init__(number, "wb", closefd=False)
        self._raises = raises
        self._failed = False

    def write(self, content: object, /) -> int:
        if not self._failed:
            try:
                return super().write(content) or 0  # type: ignore[arg-type]
            except OSError as error:
                self._failed = True  # the interpreter writes what is left when it ends: that must not fail again
                if self._raises:
                    raise OutputFailed(error) from None
        return memoryview(content).nbytes  # type: ignore[arg-type]


def _text(raw: _Raw, before: TextIO | None) -> io.TextIOWrapper:
    if before is not None:
        from contextlib import suppress  # signals are caught by now

        with suppress(OSError):
            before.flush()
    encoding = getattr(before, "encoding", None) or "utf-8"
    # a character that the encoding does not know is written out, and no error
    return io.TextIOWrapper(
        io.BufferedWriter(raw), encoding=encoding, errors="backslashreplace", line_buffering=raw.isatty()
    )


def _is_open(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return False
    return True
