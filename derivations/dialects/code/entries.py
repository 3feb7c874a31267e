# ruff: noqa: E501 -- patterns stand on one line
"""Matrices and columns that a program fills entry by entry, written as one assignment where the last entry is given."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ....models.errors import InvalidInput

EMPTY = re.compile(
    r"(?m)^(?P<blank>[ \t]*)(?P<name>\w{1,24})\s*=\s*(?:(?:np|numpy|jnp)\.)?zeros\s*\(\s*(?:\(\s*(?P<a>[1-8])\s*,?\s*(?P<b>[1-8])?\s*,?\s*\)|(?P<c>[1-8])\s*,?\s*(?P<d>[1-8])?)\s*(?:,\s*dtype\s*=\s*\w+\s*)?\)\s*;?[ \t]*$"
)
FUNCTION = re.compile(r"(?m)^\s*function\b")
BESIDE = re.compile(r";[ \t]*(?=[A-Za-z]\w*\(\d(?:,\s*\d)?\)\s*=)")  # two entries on one line
MOST_ARRAYS = 8
LONGEST = 60_000


def filled(text: str) -> str:
    """The program with each such array in one assignment; any other text as it is."""
    at = 0
    if FUNCTION.search(text):
        text = BESIDE.sub(";\n", text)
    if EMPTY.search(text):
        text = _joined(text, "(" if FUNCTION.search(text) else "([{")
    for _ in range(MOST_ARRAYS):
        found = EMPTY.search(text, at)
        if found is None:
            break
        at = found.end()
        array = _array(text, found)
        if array.width or any(m["op"] for m in array.put.finditer(text)):  # a list that is filled in order is followed
            text, at = _filled(text, found, array), found.start()
        if len(text) > LONGEST:
            raise InvalidInput("with its matrices written out this program is too long; give the rows")
    return text


def _joined(text: str, opened: str) -> str:
    """Without line ends inside brackets; in MATLAB's square ones they end a row."""
    depth, made = 0, []
    for c in text:
        depth += (c in opened) - (c in {"(": ")", "[": "]", "{": "}"}.get(opened, ")]}"))
        made.append(" " if c == "\n" and depth > 0 else c)
    return "".join(made)


def _filled(text: str, found: re.Match[str], array: _Array) -> str:
    """The first array: each entry as a name of its own where it is given, and the whole behind the last."""
    puts = list(array.put.finditer(text, found.end()))
    if not puts:
        raise InvalidInput(f"{array.name} is zeros, and its entries are not given one by one; write the matrix out")
    given: set[tuple[int, int]] = set()

    def read(piece: str) -> str:
        return array.use.sub(lambda m: array.entry(m, given), piece)

    made, at = [text[: found.start()]], found.end()
    for one in puts:
        between = read(text[at : one.start()])
        if re.search(rf"(?<![\w.]){re.escape(array.name)}(?!\w)", between):
            raise InvalidInput(f"{array.name} is used before all its entries are given; give them first")
        place, value = array.place(one), read(one["value"].strip())
        if one["op"]:
            before = array.own(place) if place in given else "0"
            value = f"{before} {one['op']} ({value})"
        elif place in given:
            raise InvalidInput(f"{one[0].strip()[:30]!r}: an entry that is given twice; give each once")
        given.add(place)
        made += [between, f"{found['blank']}{array.own(place)} = {value}"]
        at = one.end()
    made += [f"\n{found['blank']}{array.name} = {array.whole(given)}\n", read(text[at:])]
    return "".join(made)


@dataclass(frozen=True)
class _Array:
    name: str
    prefix: str  # of the names of its entries
    height: int
    width: int  # 0 for a column
    first: int  # what entries are counted from
    put: re.Pattern[str]
    use: re.Pattern[str]

    def place(self, found: re.Match[str]) -> tuple[int, int]:
        """Of an entry, from 0. Raises InvalidInput where it is outside."""
        row, column = int(found["i"]) - self.first, (int(found["j"]) - self.first) if found["j"] else 0
        if not 0 <= row < self.height or not 0 <= column < max(self.width, 1) or (self.width > 1) != bool(found["j"]):
            raise InvalidInput(f"{found[0].strip()[:30]!r}: no entry of {self.name}, of {self.height} rows")
        return row, column

    def own(self, place: tuple[int, int]) -> str:
        """The name of an entry."""
        return f"{self.prefix}{place[0]}{place[1]}"

    def entry(self, found: re.Match[str], given: set[tuple[int, int]]) -> str:
        """What stands for an entry that is read."""
        place = self.place(found)
        return self.own(place) if place in given else "0"

    def whole(self, given: set[tuple[int, int]]) -> str:
        """All entries; those that are not given are nothing."""
        rows = [[self.own((i, j)) if (i, j) in given else "0" for j in range(max(self.width, 1))]
                for i in range(self.height)]  # fmt: skip
        if self.first:
            return "[" + "; ".join(", ".join(row) for row in rows) + "]"
        return "[" + ", ".join(f"[{', '.join(row)}]" if self.width > 1 else row[0] for row in rows) + "]"


def _array(text: str, found: re.Match[str]) -> _Array:
    name, matlab = found["name"], FUNCTION.search(text) is not None
    height = int(found["a"] or found["c"])
    width = int(found["b"] or found["d"] or (found["c"] if matlab and found["c"] else 0) or 0)
    opened, closed = (r"\(", r"\)") if matlab else (r"\[", r"\]")
    at = rf"(?<![\w.]){re.escape(name)}\s*{opened}\s*(?P<i>[0-8])\s*(?:(?:,|{closed}\s*{opened})\s*(?P<j>[0-8])\s*)?{closed}"
    put = re.compile(rf"(?m)^[ \t]*{at}\s*(?P<op>[-+])?=(?!=)\s*(?P<value>[^\n;]+);?[ \t]*$")
    prefix = next(
        word for word in (f"{name}entry", f"{name}part", f"{name}piece", f"{name}cell{name}") if word not in text
    )
    return _Array(name, prefix, height, width if width > 1 else 0, 1 if matlab else 0, put, re.compile(at))
