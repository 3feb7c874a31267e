"""AsciiMath between backticks, `m ell ddot theta`, and dots that an encyclopedia's text puts above: theta^(..)_1."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import everywhere
from ..names import GREEK

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_X = rf"(?:{_GREEK}|[A-Za-z]|[{''.join(GREEK.values())}])"
_I = r"(?:_\(\s*[0-9A-Za-z]{1,3}\s*\)|_\{\s*[0-9A-Za-z]{1,3}\s*\}|_[0-9A-Za-z])?"
TICKED = re.compile(r"(?<!`)`(?P<inner>[^`]{1,4000})`(?!`)")
WHOLE = re.compile(r"\s*`(?P<inner>[^`]{1,4000})`\s*[.,;]?\s*")
WORDS = re.compile(r"(?:\s|[,;.:]|\b(?:and|und|et|the|cart|pole|pendulum|row|equations?|of|motion)\b)*", re.IGNORECASE)
DOT = re.compile(
    rf"(?<![A-Za-z])(?P<two>d)?dot\s*(?:\(\s*(?P<a>{_X})(?P<ai>{_I})\s*\)|\{{\s*(?P<b>{_X})(?P<bi>{_I})\s*\}}|\s(?P<c>{_X}))(?P<i>{_I})"
)
ABOVE = re.compile(
    rf"(?P<x>(?<![A-Za-z])(?:{_GREEK})|(?:{_GREEK})|[xyrqs])\^(?:\((?P<dots>\.{{1,2}})\)|(?P<one>\.(?![0-9])))(?P<i>{_I})"
)
FRACTION = re.compile(
    r"(?<![A-Za-z])frac\s*(?:\{(?P<a>[^{}]{1,200})\}\s*\{(?P<b>[^{}]{1,200})\}|\((?P<c>[^()]{1,200})\)\s*\((?P<d>[^()]{1,200})\))"
)


def without_ticks(data: dict[str, Any]) -> dict[str, Any]:
    """The fields without the backticks around a whole formula; a backslash and a blank is a blank of AsciiMath."""

    def one(text: str) -> str:
        found = WHOLE.fullmatch(text)
        if found is None:
            return text
        inner = re.sub(r"\\\s", " ", found["inner"])
        return inner if "\\" in inner else _formula(inner)

    return everywhere(data, one)


def from_asciimath(text: str) -> str:
    """The formulas between backticks, a row a line; any other text with dots above letters as primes."""
    found = [m["inner"] for m in TICKED.finditer(text)]
    if not found or "\\" in text:
        return ABOVE.sub(_above, text) if "^." in text or "^(." in text else text
    if not WORDS.fullmatch(TICKED.sub(" ", text)):
        raise InvalidInput("words between the formulas in backticks: give the formulas alone, a row each")
    return "\n".join(_formula(line) for line in found)


def _formula(line: str) -> str:
    if re.search(r'\btext\s*\(|"', line):
        raise InvalidInput("words in a formula of AsciiMath: give the formula alone")
    line = FRACTION.sub(lambda m: f"(({m['a'] or m['c']})/({m['b'] or m['d']}))", line)
    line = re.sub(r"(?<![A-Za-z])xx(?![A-Za-z])", "*", line)
    return ABOVE.sub(_above, DOT.sub(_dotted, line))


def _index(*written: str | None) -> str:
    return next((w.replace("(", "{").replace(")", "}") for w in written if w), "")


def _dotted(found: re.Match[str]) -> str:
    if (found["ai"] or found["bi"]) and found["i"]:
        raise InvalidInput(f"two indices, {found[0].strip()[:20]}")
    letter = found["a"] or found["b"] or found["c"]
    return letter + _index(found["ai"], found["bi"], found["i"]) + ("''" if found["two"] else "'")


def _above(found: re.Match[str]) -> str:
    primes = "'" * len(found["dots"] or ".")
    return found["x"] + _index(found["i"]) + primes
