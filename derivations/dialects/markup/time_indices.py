# ruff: noqa: E501 -- patterns stand on one line
r"""Derivatives by time that an index or a word says: \\theta_{tt}, \\partial_t^2\\theta, theta_double_dot, theta_dot_dot."""

from __future__ import annotations

import re
from collections.abc import Collection

from ..names import plain_name, spelling

_NAME = r"(?P<x>\\?[A-Za-z]+(?:_(?:\{\w{1,4}\}|[0-9]))?)"
WORDS = re.compile(
    r"(?<![\w\\])(?P<x>[A-Za-z]+(?:_?[0-9])?)_?(?P<two>(?:double_?|dd|2)_?dot|dot_?dot|dotdot|DoubleDot|_dot_dot)(?![A-Za-z])"
)
OPERATOR = re.compile(
    rf"\\partial\s*_\s*(?:(?P<two>\{{\s*tt\s*\}}|\{{\s*t\s*\}}\s*\^\s*\{{?\s*2\s*\}}?|t\s*\^\s*\{{?\s*2\s*\}}?)|t|\{{\s*t\s*\}})\s*{_NAME}(?:\s*\(\s*t\s*\))?"
)


def in_indices(text: str, coordinates: Collection[str], names: Collection[str]) -> str:
    """The text with dots or primes in place of these, where the name is a coordinate's. ``names``: all that is declared."""
    text = WORDS.sub(lambda m: f"{m['x']}_ddot" if plain_name(m["x"]) in coordinates else m[0], text)
    if "\\partial" in text and "\\frac" not in text.partition("\\partial")[0][-8:]:
        text = OPERATOR.sub(lambda m: _dotted(m, coordinates), text)
    for name in coordinates:
        if f"{name}tt" not in names and f"{name}t" not in names:
            text = _of_indices(text, name)
    return text


def _dotted(found: re.Match[str], coordinates: Collection[str]) -> str:
    if plain_name(found["x"]) not in coordinates:
        return found[0]
    return f"\\{'ddot' if found['two'] else 'dot'}{{{found['x']}}}"


def _of_indices(text: str, name: str) -> str:
    r"""\\theta_{tt} as \\ddot{\\theta}, and \\theta_t as its rate, where both or the first stand."""
    bare = re.match(r"(?P<x>[A-Za-z]+?)(?P<i>[0-9]*)$", name)
    if bare is None:
        return text
    letter = spelling(bare["x"]).pattern.partition("(?!\\s*_")[0]
    i = rf"(?:{bare['i']}\s*,?\s*)" if bare["i"] else ""
    second = re.compile(
        rf"(?<![A-Za-z\\])(?P<x>{letter})\s*_\s*(?:\{{\s*{i}tt\s*\}}|{'' if i else 'tt(?![A-Za-z0-9])'})"
        if not i
        else rf"(?<![A-Za-z\\])(?P<x>{letter})\s*_\s*\{{\s*{i}tt\s*\}}"
    )
    if not second.search(text):
        return text
    first = re.compile(rf"(?<![A-Za-z\\])(?P<x>{letter})\s*_\s*(?:\{{\s*{i}t\s*\}}{'' if i else '|t(?![A-Za-z0-9])'})")
    low = f"_{{{bare['i']}}}" if bare["i"] else ""
    text = second.sub(lambda m: f"\\ddot{{{m['x']}{low}}} " if m["x"][0] == "\\" else f"{m['x']}{low}'' ", text)
    return first.sub(lambda m: f"\\dot{{{m['x']}{low}}} " if m["x"][0] == "\\" else f"{m['x']}{low}' ", text)
