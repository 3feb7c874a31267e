"""What stands in the brackets behind a word."""

from __future__ import annotations

import re
from collections.abc import Callable

MOST_CALLS = 200


def closing(line: str, opened: int) -> int:
    """The place of the bracket that closes the one at ``opened``; -1 where there is none."""
    depth = 0
    for at in range(opened, len(line)):
        depth += (line[at] in "([{") - (line[at] in ")]}")
        if depth == 0:
            return at
    return -1


def parts_of(text: str, separator: str) -> list[str]:
    """The parts between separators that stand outside all brackets."""
    parts, depth, start = [], 0, 0
    for at, c in enumerate(text):
        depth += (c in "([{") - (c in ")]}")
        if c == separator and depth == 0:
            parts.append(text[start:at].strip())
            start = at + 1
    return [*parts, text[start:].strip()]


def called(line: str, word: str, made: Callable[[list[str]], str], count: int, separator: str = ",") -> str:
    """The line with ``made`` of the arguments in place of each word(…); calls with another count stay as they are."""
    pattern = re.compile(rf"(?<![A-Za-z0-9_.]){word}\s*\(")
    at = 0
    for _ in range(MOST_CALLS):
        found = pattern.search(line, at)
        end = closing(line, found.end() - 1) if found else -1
        if found is None or end < 0:
            return line
        parts = [part for part in parts_of(line[found.end() : end], separator) if part]
        at = found.end()
        if parts and count in (0, len(parts)):
            line = line[: found.start()] + made(parts) + line[end + 1 :]
            at = found.start()
    return line
