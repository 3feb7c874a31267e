"""Writes a file completely or not at all."""

from __future__ import annotations

import errno
import os
import tempfile
import time
from pathlib import Path

from ..errors import InvalidInput
from ..readers.bounded_file import RAW, shown

PATIENCE = 1.0  # [s] for a pipe's reader to open it


def write_whole(path: Path, text: str) -> Path:
    """Write a draft beside the file, then rename it: a reader sees the old file or the new one, never half of one.

    UTF-8, line ends as given. The file behind a link is replaced, not the link; a device or a pipe is written directly.
    Returns ``path``. Raises :class:`InvalidInput` where it cannot be written; then nothing has changed.
    """
    try:
        if path.exists() and not path.is_file():
            _write_through(path, text.encode())
        else:
            replace_file(path.resolve(), text.encode())
    except OSError as error:
        raise _unwritable(path, error) from None
    return path


def require_writable(path: Path) -> None:
    """Raise :class:`InvalidInput` where :func:`write_whole` could not write: asked before hours of work, not after."""
    try:
        if path.is_dir():
            raise InvalidInput(f"{shown(path)}: cannot be written: Is a directory")
        if path.exists() and not path.is_file():
            return  # a device or a pipe
        draft = _draft(path.resolve())
        try:
            draft.touch()
        finally:
            draft.unlink(missing_ok=True)
    except OSError as error:
        raise _unwritable(path, error) from None


def make_folder(folder: Path) -> None:
    """Make a folder that files can be written in. Raises :class:`InvalidInput` where that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise _unwritable(folder, error) from None


def _write_through(path: Path, content: bytes) -> None:
    """Write to a device, or to a pipe. One that nobody reads is an error, and not waited for without end."""
    with os.fdopen(_opened(path), "wb") as file:
        if hasattr(os, "set_blocking"):
            os.set_blocking(file.fileno(), True)
        file.write(content)


def _opened(path: Path) -> int:
    end = time.monotonic() + PATIENCE
    while True:
        try:
            return os.open(path, os.O_WRONLY | RAW)
        except OSError as error:
            if error.errno != errno.ENXIO or time.monotonic() > end:
                raise
            time.sleep(0.02)


def _unwritable(path: Path, error: OSError) -> InvalidInput:
    return InvalidInput(f"{shown(path)}: cannot be written: {error.strerror or error}")


def _draft(path: Path) -> Path:
    return path.with_name(f".{path.name}.{os.getpid()}")


def replace_file(path: Path, content: bytes) -> None:
    """Write a draft beside the file, then rename it. Raises OSError where that fails; then nothing has changed."""
    draft = _draft(path)
    try:
        draft.write_bytes(content)
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
