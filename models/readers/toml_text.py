"""Parses a TOML text that nobody vouches for: bounded in nesting, keys and numbers before ``tomllib`` sees it.

``tomllib`` takes time that grows with the square of a key's dots (26 s and 1.6 GB for 20,000), and nests as deep as the
brackets do.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any

from ..errors import InvalidInput

MOST_DOTS = 16  # in one key
MOST_KEYS = 100_000  # parts of keys, and arrays, in one file
DEEPEST = 32  # brackets
LONGEST_WORD = 1000  # characters of a bare key or a number

_INTERESTING = re.compile(r"""["'#\[\]{}=.,\n]""")
_QUOTED = {
    '"""': re.compile(r'(?:[^"\\]++|\\.|"(?!""))*+"{3,5}', re.DOTALL),
    "'''": re.compile(r"(?:[^']++|'(?!''))*+'{3,5}", re.DOTALL),
    '"': re.compile(r'(?:[^"\\\n]++|\\[^\n])*+"'),
    "'": re.compile(r"[^'\n]*'"),
}


def parse_toml(text: str) -> dict[str, Any]:
    """The table that a text describes. Raises :class:`InvalidInput` with line and column."""
    _require_bounded(text)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InvalidInput(f"not TOML: {error!s:.200}") from None
    except RecursionError:
        raise InvalidInput("not TOML: nested too deeply") from None
    except ValueError as error:  # an integer of thousands of digits, a date that does not exist
        raise InvalidInput(f"not TOML: {error!s:.200}") from None


def _require_bounded(text: str) -> None:
    """Refuse what would cost ``tomllib`` more than the text's own length.

    Strings and comments are passed over. After a string that has no end ``tomllib`` stops, so this does too.
    """
    at = dots = depth = keys = 0
    for _ in range(len(text) + 1):
        found = _INTERESTING.search(text, at)
        end = found.start() if found else len(text)
        if end - at > LONGEST_WORD and len(text[at:end].strip()) > LONGEST_WORD:
            raise _too_much(text, at, f"a word of more than {LONGEST_WORD} characters outside quotes")
        if found is None:
            return
        mark = found[0]
        at = found.end()
        if mark in "\"'#":
            passed = _end_of_string(text, end, mark)
            if passed is None:
                return
            at = passed
        elif mark == ".":
            dots += 1
            if dots > MOST_DOTS:
                raise _too_much(text, end, f"a key of more than {MOST_DOTS} dots")
        else:
            if mark in "=]":
                keys += 1 + dots
                if keys > MOST_KEYS:
                    raise _too_much(text, end, f"more than {MOST_KEYS} keys and arrays")
            dots = 0
            depth += (mark in "[{") - (mark in "]}")
            if depth > DEEPEST:
                raise _too_much(text, end, f"nested too deeply, more than {DEEPEST} brackets")


def _end_of_string(text: str, begin: int, mark: str) -> int | None:
    """Where the string or comment that begins here ends; None where it does not."""
    if mark == "#":
        line_end = text.find("\n", begin)
        return None if line_end < 0 else line_end
    opening = mark * 3 if text.startswith(mark * 3, begin) else mark
    closed = _QUOTED[opening].match(text, begin + len(opening))
    return None if closed is None else closed.end()


def _too_much(text: str, at: int, says: str) -> InvalidInput:
    line = text.count("\n", 0, at) + 1
    column = at - text.rfind("\n", 0, at)
    return InvalidInput(f"not TOML of a size that is read: {says} (at line {line}, column {column})")
