# ruff: noqa: E501 -- patterns stand on one line
"""Loops of a Python function, for i in range(n), written out: with the count that the mechanism has, and no more."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ....models.errors import InvalidInput
from ..markup.calls import parts_of
from .whole_numbers import whole_number

LOOP = re.compile(
    r"^(?P<blank>[ \t]*)for\s+(?P<of>\w{1,20})\s+in\s+range\s*\((?P<bounds>[^\n]{1,80})\)\s*:\s*(?P<rest>[^\n]*)$"
)
COUNT = re.compile(
    r"(?m)^\s*(?P<name>n|N|num|nlinks|n_links|links)\s*=\s*(?P<value>[0-9]{1,2}|len\s*\(\s*(?:m|M|ms|masses|l|L|ls|lengths)\s*\))\s*$"
)
DEFAULT = re.compile(
    r"def\s+\w+\s*\([^)]*?\b(?P<name>n|N|num|nlinks|n_links|links)\s*(?:=\s*(?P<value>[0-9]{1,2}))?\s*[,)]"
)
MOST_LINES = 400
HINT = "loops as for i in range(n), with n as many as there are links, are followed; write others out"


def unrolled(text: str, count: int) -> str:
    """The function with its loops written out; any other text as it is. ``count``: what n is."""
    if "range(" not in text.replace(" ", "") or not re.search(r"(?m)^\s*def\s", text):
        return text
    names: dict[str, int] = {}
    found = COUNT.search(text)
    default = DEFAULT.search(text)
    for match in (found, default):
        if match is None:
            continue
        value = match["value"]
        if not re.search(rf"\brange\s*\([^\n]*\b{match['name']}\b", text):
            continue  # a force, maybe
        if value and value.isdigit() and int(value) != count:
            raise InvalidInput(f"{match['name']} = {value}, and the mechanism has {count} coordinates")
        names[match["name"]] = count
    lines = _lines(text.split("\n"), names, 0)
    made = "\n".join(_counted(line, names) for line in lines)
    return re.sub(COUNT, "", made) if found else made


def _lines(lines: list[str], names: Mapping[str, int], depth: int) -> list[str]:
    made: list[str] = []
    at = 0
    if depth > 4:
        raise InvalidInput(f"more than four loops in one another; {HINT}")
    while at < len(lines):
        found = LOOP.match(lines[at].partition("#")[0].rstrip())
        if found is None:
            made.append(lines[at])
            at += 1
            continue
        body, behind = _body(lines, at, found)
        for value in _range(found["bounds"], names):
            here = {**names, found["of"]: value}
            made += [_counted(line, here) for line in _lines(body, here, depth + 1)]
            if len(made) > MOST_LINES:
                raise InvalidInput(f"with its loops written out this function has more than {MOST_LINES} lines; {HINT}")
        at = behind
    return made


def _body(lines: list[str], at: int, found: re.Match[str]) -> tuple[list[str], int]:
    """The lines of a loop, one step further left, and where the next statement is."""
    blank = len(found["blank"].expandtabs())
    if found["rest"].strip():
        return [" " * blank + found["rest"].strip()], at + 1
    body: list[str] = []
    behind = at + 1
    while behind < len(lines):
        line = lines[behind].expandtabs()
        if line.strip() and len(line) - len(line.lstrip()) <= blank:
            break
        body.append(line[4:] if line[: blank + 4].isspace() else line)
        behind += 1
    if not any(line.strip() for line in body):
        raise InvalidInput(f"a loop without a body; {HINT}")
    steps = {len(line) - len(line.lstrip()) for line in body if line.strip()}
    least = min(steps)
    return [" " * blank + line[least:] if line.strip() else "" for line in body], behind


def _range(bounds: str, names: Mapping[str, int]) -> range:
    values = [whole_number(part, names) for part in parts_of(bounds, ",")]
    known = [v for v in values if v is not None]
    if len(known) < len(values) or not 1 <= len(known) <= 3 or (len(known) == 3 and not known[2]):
        raise InvalidInput(f"range({bounds[:40]}): {HINT}")
    return range(*known)


def _counted(line: str, names: Mapping[str, int]) -> str:
    """The line with numbers for whole-number expressions in names alone: in indices, bounds, and wherever they stand."""
    if re.match(r"\s*def\s", line):
        return line
    if re.match(r"\s*(?:if|elif|else|while|for|continue|break)\b", line):
        raise InvalidInput(f"{line.strip()[:40]!r} in a function with loops; {HINT}")
    line = re.sub(r"\[([^\[\]]{1,40})\]", lambda m: "[" + _index(m[1], names) + "]", line)
    extreme = r"(?<![\w.])(?:max|min)\s*\(([\w\s,+-]{1,40})\)"
    line = re.sub(extreme, lambda m: _number(m[0], names), line)
    for name, value in names.items():
        line = re.sub(rf"(?<![\w.\]])\b{name}\b(?!\s*[=(\[.](?!=))", str(value), line)
    return line


def _number(text: str, names: Mapping[str, int]) -> str:
    value = whole_number(text, names)
    return text if value is None else f"{value}"


def _index(inner: str, names: Mapping[str, int]) -> str:
    """i, j of M[i, j], and :n of y[:n]."""
    made = []
    for part in inner.split(","):
        ends = [("" if not end.strip() else _number(end, names)) for end in part.split(":")]
        made.append(":".join(ends))
    return ", ".join(x.strip() for x in made)
