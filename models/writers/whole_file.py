"""Writes a text file completely or not at all."""

from __future__ import annotations

import os
from pathlib import Path

from ..errors import InvalidInput


def write_whole(path: Path, text: str) -> Path:
    """Write a draft beside the file, then rename it: a reader sees the old file or the new one, never half of one.

    UTF-8, line ends as given. The file behind a link is replaced, not the link; a device or a pipe is written directly.
    Returns ``path``. Raises :class:`InvalidInput` where it cannot be written; then nothing has changed.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_text(text, encoding="utf-8", newline="\n")
        else:
            _replace(path.resolve(), text)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror or error}") from None
    return path


def _replace(path: Path, text: str) -> None:
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="utf-8", newline="\n")
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
