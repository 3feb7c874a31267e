"""Reads a file that a user named: a regular file, no larger than it may be, in UTF-8.

A device, a pipe or a socket may wait or deliver without end, so none is opened for reading. Every path that comes from
a user is read here.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import BinaryIO

from ..errors import InvalidInput

# Flags with which os.open gives the bytes themselves, as far as a system has them: no translation of line ends (on
# Windows), no waiting for the other end of a pipe, and nothing that a started process inherits.
RAW = getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0)
LONGEST_SHOWN = 200  # characters of a path in a message


def open_regular(path: str | Path) -> BinaryIO:
    """Open a file for reading bytes. Raises :class:`InvalidInput` where it is missing or no regular file."""
    try:
        descriptor = os.open(path, os.O_RDONLY | RAW)
    except (OSError, ValueError) as error:  # ValueError: a null byte in the name
        raise _unreadable(path, error) from None
    try:
        mode = os.fstat(descriptor).st_mode
        if stat.S_ISDIR(mode):
            raise InvalidInput(f"{shown(path)}: cannot be read: it is a folder; a file is needed")
        if not stat.S_ISREG(mode):
            raise InvalidInput(f"{shown(path)}: cannot be read: it is {_kind(mode)}; a regular file is needed")
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise


def read_bytes(path: str | Path, most: int) -> bytes:
    """The content of a file of at most ``most`` bytes. Raises :class:`InvalidInput`, the path in front."""
    with open_regular(path) as stream:
        try:
            content: bytes | None = stream.read(most + 1)
        except OSError as error:
            raise _unreadable(path, error) from None
    if content is None:
        raise InvalidInput(f"{shown(path)}: cannot be read: it has no content at present")
    if len(content) > most:
        raise InvalidInput(f"{shown(path)}: larger than {most:,} bytes, the limit for this kind of file")
    return content


def read_text(path: str | Path, most: int) -> str:
    """The text of a UTF-8 file of at most ``most`` bytes, without a byte order mark. Raises :class:`InvalidInput`."""
    content = read_bytes(path, most)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidInput(f"{shown(path)}: not UTF-8 text: {error.reason} at byte {error.start}") from None


def shown(path: str | Path) -> str:
    """A path as messages show it: the middle of a very long one is left out."""
    text = str(path)
    half = LONGEST_SHOWN // 2
    return text if len(text) <= LONGEST_SHOWN else f"{text[:half]} … {text[-half:]}"


def _unreadable(path: str | Path, error: OSError | ValueError) -> InvalidInput:
    reason = error.strerror if isinstance(error, OSError) else None
    return InvalidInput(f"{shown(path)}: cannot be read: {reason or error}")


def _kind(mode: int) -> str:
    if stat.S_ISFIFO(mode):
        return "a pipe"
    if stat.S_ISSOCK(mode):
        return "a socket"
    return "a device"
