r"""Matrices drawn over several lines of plain text, in [ ], | | or ⎡ ⎣ ⎤ ⎦, as [[a, b], [c, d]] in one line."""

from __future__ import annotations

import re
from dataclasses import dataclass
from unicodedata import combining

LEFT, RIGHT = "[⎡⎢⎣⎛⎜⎝", "]⎤⎥⎦⎞⎟⎠"
PIECE = re.compile(rf"[{re.escape(LEFT)}](?P<inner>[^{re.escape(LEFT + RIGHT)}=;\\]*)[{re.escape(RIGHT)}]")
GAP = re.compile(r"[ \t\u00a0]{2,}|\t")
GOES_ON = re.compile(r"^\s*[-+−*/·×]\s*$")
BLANK = re.compile(r"(?<![-+−*/·])\s+(?![-+−*/·])")
IN_LINE = re.compile(r"\|(?P<inner>[^|\n=]*;[^|\n=]*)\|")
WIDE = re.compile(r"\|[^|]*\S(?:[ ]{2,}|\t)\S[^|]*\|")
TABLE = re.compile(r"(?m)^\s*\|?\s*:?-{3,}")
COMMA = re.compile(",")
MOST_LINES, MOST_COLUMNS = 60, 8


@dataclass(frozen=True)
class _Piece:
    """One row of a matrix: its line, where it starts and ends in that line, and the columns that it is seen in."""

    line: int
    start: int
    end: int
    left: int
    right: int
    inner: str


def from_drawn(text: str) -> str:
    """The text with each drawn matrix in the line that names it; any other text as it is."""
    text = _of_bars(text)
    lines = text.split("\n")
    if len(lines) < 2 or len(lines) > MOST_LINES or "\\" in text:
        return text
    pieces = [
        _Piece(k, m.start(), m.end(), _width(line[: m.start()]), _width(line[: m.end()]), m["inner"].strip())
        for k, line in enumerate(lines) for m in PIECE.finditer(line)
    ]  # fmt: skip
    stacks = [stack for stack in _stacks(pieces) if len(stack) > 1]
    if any(GOES_ON.search(lines[piece.line][piece.end :]) for stack in stacks for piece in stack[:-1]):
        return text  # a sum or a fraction in brackets, over two lines
    if not stacks:
        return text
    written: dict[_Piece, str] = {}
    for stack in stacks:
        matrix = _matrix([piece.inner for piece in stack])
        if matrix is None:
            return text
        # The line with anything besides rows of matrices is the one that goes on in words
        named = [piece for piece in stack if _rest(lines[piece.line], pieces, piece.line)]
        if len({piece.line for piece in named}) > 1:
            return text
        place = named[0] if named else stack[(len(stack) - 1) // 2]
        written |= dict.fromkeys(stack, "") | {place: matrix}
    return "\n".join(_line(k, line, [p for p in written if p.line == k], written) for k, line in enumerate(lines))


def _of_bars(text: str) -> str:
    """The text with brackets for bars that hold matrices: | a; b | in a line, or lines of | a  b | | c |."""
    if "|" not in text or "\\" in text or TABLE.search(text):
        return text
    text = IN_LINE.sub(_in_line, text)
    lines = text.split("\n")
    counts = [line.count("|") for line in lines]
    for k in range(len(lines) - 1):
        both = counts[k : k + 2]
        if both[0] == both[1] and both[0] > 3 and both[0] % 2 == 0 and all(map(WIDE.search, lines[k : k + 2])):
            lines[k : k + 2] = [_bracketed(line) for line in lines[k : k + 2]]
    return "\n".join(lines)


def _bracketed(line: str) -> str:
    """Every other bar as an opening bracket; of a line that has brackets already, the line itself."""
    parts = line.split("|")
    return "".join(part + ("[" if k % 2 == 0 else "]") for k, part in enumerate(parts[:-1])) + parts[-1]


def _in_line(found: re.Match[str]) -> str:
    """[[a, b], [c, d]] for | a, b; c, d |, whose entries commas or wide blanks part, or blanks where it is square."""
    rows = [row.strip() for row in found["inner"].split(";")]
    for separator in (COMMA, GAP, BLANK):
        wide = [[entry.strip() for entry in separator.split(row)] for row in rows]
        square = len(rows) == len(wide[0]) or separator is not BLANK
        if len(wide[0]) > 1 and len({len(row) for row in wide}) == 1 and square:
            matrix = _matrix([", ".join(row) for row in wide])
            return matrix or found[0]
    parts = {len(BLANK.split(row)) for row in rows}  # a column, unless its blanks may part entries as well
    return "[" + ", ".join(rows) + "]" if all(rows) and parts != {len(rows)} else found[0]


def _width(text: str) -> int:
    """The columns that a text takes."""
    return sum(not combining(c) for c in text)


def _stacks(pieces: list[_Piece]) -> list[list[_Piece]]:
    """Rows that stand below each other, in lines that follow each other."""
    stacks: list[list[_Piece]] = []
    for piece in pieces:
        above = next((s for s in stacks if s[-1].line == piece.line - 1 and _is_below(piece, s[-1])), None)
        if above is None:
            stacks.append([piece])
        else:
            above.append(piece)
    return stacks


def _is_below(one: _Piece, two: _Piece) -> bool:
    return abs(one.left - two.left) <= 1 or abs(one.right - two.right) <= 1


def _matrix(rows: list[str]) -> str | None:
    rows = [row for row in rows if row]  # between two rows a blank one is drawn
    if not rows:
        return None
    separator = COMMA if any("," in row for row in rows) else GAP
    wide = [[entry.strip() for entry in separator.split(row)] for row in rows]
    if len({len(row) for row in wide}) != 1 or len(wide[0]) > MOST_COLUMNS:
        return None
    if any(not entry or entry[0] in "+*/·=" or entry[-1] in "+-−*/·=" for row in wide for entry in row):
        return None  # a blank within an entry
    if len(wide[0]) == 1:
        return "[" + ", ".join(row[0] for row in wide) + "]"
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in wide) + "]"


def _rest(line: str, pieces: list[_Piece], at: int) -> str:
    return _line(at, line, [p for p in pieces if p.line == at], {}).strip()


def _line(_: int, line: str, pieces: list[_Piece], written: dict[_Piece, str]) -> str:
    for piece in sorted(pieces, key=lambda p: -p.start):
        line = line[: piece.start] + written.get(piece, "") + line[piece.end :]
    return line
