r"""Sums over links, written out: \sum_{i=1}^{2} m_i g y_i becomes (m_{1} g y_{1} + m_{2} g y_{2}).

A sum goes as far as the product that stands behind it, as it does in print: to the next plus or minus, or to the
bracket that ends it. Only subscripts, and the bounds of sums within it, are counted; any other use of the letter is
left for the reader to refuse.
"""

from __future__ import annotations

import re

from ...models.errors import InvalidInput
from .lines import BLANKS, LONGEST_LINE

_BLANK = r"(?:\s|\\[,;:! ])*"
SUM = re.compile(
    rf"(?:\\sum|∑)(?:\s*\\limits)?{_BLANK}_{_BLANK}\{{{_BLANK}(?P<letter>[a-z]){_BLANK}={_BLANK}(?P<first>[0-9nN]){_BLANK}\}}"
    rf"{_BLANK}\^{_BLANK}(?:\{{{_BLANK}(?P<last>[0-9nN]){_BLANK}\}}|(?P<bare>[0-9nN]))"
)
MOST_SUMS, MOST_LINKS = 60, 8
OPEN, CLOSE = "([{", ")]}"


def sums(line: str, count: int) -> str:
    """The line with its sums written out. ``count``: what n is, 0 where that is not known."""
    if len(line) > LONGEST_LINE or BLANKS.search(line) or not ("\\sum" in line or "∑" in line):
        return line
    for _ in range(MOST_SUMS):
        found = SUM.search(line)
        if found is None:
            return line
        first, last = (_bound(found[name], count) for name in ("first", "last" if found["last"] else "bare"))
        if first is None or last is None or last - first >= MOST_LINKS:
            return line
        end = _end(line, found.end())
        body = line[found.end() : end]
        if _at(body, found["letter"], first) == f"({body.strip()})":
            return line  # nothing is counted: what is meant is not certain
        terms = [_at(body, found["letter"], k) for k in range(first, last + 1)]
        line = f"{line[: found.start()]} ({' + '.join(terms) or '0'}) {line[end:]}"
        if len(line) > LONGEST_LINE:
            raise InvalidInput(f"with its sums written out this line is longer than {LONGEST_LINE} characters")
    return line


def _bound(text: str, count: int) -> int | None:
    if text.isdigit():
        return int(text)
    return count or None


def _end(line: str, start: int) -> int:
    """Where the product behind a sum ends."""
    depth, begun = 0, False
    at = start
    while at < len(line):
        c = line[at]
        if c == "\\":
            word = re.match(r"\\(?:[A-Za-z]+|.)", line[at:], re.DOTALL)
            command = word[0] if word else c
            if depth == 0 and command in ("\\\\", "\\qquad", "\\quad", "\\end", "\\pm"):
                return at
            if depth == 0 and command == "\\right":
                return at
            if command == "\\left":
                depth, at, begun = depth + 1, at + len(command) + 1, True
                continue
            if command == "\\right":
                depth, at = depth - 1, at + len(command) + 1
                continue
            begun = begun or command[1:].isalpha()
            at += len(command)
            continue
        if c in OPEN:
            depth += 1
        elif c in CLOSE:
            if depth == 0:
                return at
            depth -= 1
        elif depth == 0 and (c in "=,;&" or (begun and c in "+-−")):
            return at
        begun = begun or not c.isspace()
        at += 1
    return at


def _at(body: str, letter: str, k: int) -> str:
    """The body with a number for the letter, in subscripts and in the bounds of sums."""
    body = re.sub(rf"_\s*{letter}(?![A-Za-z0-9])", f"_{{{k}}}", body)
    body = re.sub(
        r"_\s*\{([^{}]{1,12})\}",
        lambda found: "_{" + re.sub(rf"(?<![A-Za-z]){letter}(?![A-Za-z])", str(k), found[1]) + "}", body,
    )  # fmt: skip
    body = re.sub(rf"(\\sum[^\^]{{1,30}}\^\s*)(?:\{{\s*{letter}\s*\}}|{letter}(?![A-Za-z]))", rf"\g<1>{{{k}}}", body)
    return f"({body.strip()})"
