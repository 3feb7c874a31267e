"""Text that came from outside, made safe for a terminal, a browser or a JSON reader."""

from __future__ import annotations

from typing import Any


def printable(text: str) -> str:
    """The text with everything that a terminal, a browser or an XML reader might act on written out as an escape.

    Kept are letters, marks, digits, signs, spaces and line ends; control and formatting characters (ANSI escapes,
    right-to-left overrides), lone surrogates and code points without a meaning become ``\\x1b``, ``\\u202e``.
    """
    if text.isprintable():
        return text
    text = text.replace("\r\n", "\n").replace("\t", "    ")
    return "".join(c if c.isprintable() or c == "\n" else _written_out(c) for c in text)


def printable_json(text: str, *, ascii_only: bool = False) -> str:
    """A JSON text with the same characters, or all but ASCII, written as JSON escapes; it means the same as before.

    Outside its strings a JSON text has ASCII and line ends alone, so that every such character is in a string.
    """
    if text.isprintable() and not (ascii_only and not text.isascii()):
        return text
    return "".join(
        c if c == "\n" or (c.isprintable() and (c.isascii() or not ascii_only)) else _json_escape(c) for c in text
    )


def without_surrogates(value: Any) -> Any:
    """Plain data with lone surrogates written out: a file name that is not UTF-8 has them, JSON text cannot."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode()
    if isinstance(value, dict):
        return {without_surrogates(key): without_surrogates(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [without_surrogates(entry) for entry in value]
    return value


def _written_out(character: str) -> str:
    if character.isspace() and character > "\x9f":  # a no-break space is a space, a form feed is not
        return " "
    return character.encode("unicode_escape").decode()


def _json_escape(character: str) -> str:
    units = character.encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[i]:02x}{units[i + 1]:02x}" for i in range(0, len(units), 2))
