"""How a line is laid out, made plain: boxes, words in upright letters, dots set above, lines that go on, full stops.

What is taken away leaves blanks, so that a column stays the column of what the author wrote.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from ...models.errors import InvalidInput
from ..dialects.lines import FULL_WIDTH

BLANKS = r"(?:\s|\\[,;:!>\s]|\\\\|\\q?quad(?![A-Za-z])|[$}]|\\end\{[a-z]+\*?\}|\\(?:tag|label)\{[^{}]{0,40}\})"
STOP = re.compile(rf"(?:(?<!\\)[.,;、。，．](?={BLANKS}{{0,60}}$))")
CONTINUED = re.compile(r"\.\.\.[^\n]{0,200}(?=\n)|(?<!\\)\\(?=\n)")
UPRIGHT = re.compile(
    r"(?P<low>_\s*)?\\(?:mathrm|mathit|mathsf|mathbf|boldsymbol|bm|text|textrm|textit|operatorname)\*?"
    r"\s*\{(?P<inner>[^{}\\]{0,40})\}"
)
BOXES = re.compile(r"\\(?:boxed|fbox)\s*\{")
_DOTS = r"(?:\\cdot|\.|\\bullet|\\,|\s){1,12}"
SET_ABOVE = (
    re.compile(rf"\\(?:overset|stackrel)\s*\{{(?P<dots>{_DOTS})\}}\s*\{{(?P<x>[^{{}}]{{1,20}})\}}"),
    re.compile(rf"\\mathop\s*\{{(?P<x>[^{{}}]{{1,20}})\}}\s*\\limits\s*\^\s*\{{(?P<dots>{_DOTS})\}}"),
)
GREEK = r"\\(?:var)?(?:theta|phi)|\\(?:psi|alpha|beta|gamma)|[θϑφϕψ]"
# A dot over a square stands over the letter: an angle itself is in no equation, so it is no rate of a square
SQUARED = re.compile(
    rf"(?P<dotted>\\d?dot\s*\{{\s*(?:{GREEK})\s*(?:_\s*(?:\{{\s*\w+\s*\}}|\w))?)\s*(?P<power>\^(?:\{{\s*\d\s*\}}|\d))\s*\}}"
)
BLANK_OR_DIVISION = re.compile(r"(?<=[^\s\\])\\(?= \S)")
TRANSPOSED = re.compile(r"(?P<list>\[[^\[\];]{0,2000}\])(?:\.?'|ᵀ|⊤|\^\s*T(?![A-Za-z_]))")
MATLAB = re.compile(r"\[[^\[\]]*;[^\[\]]*\]")
_ENTRY = r"(?:[A-Za-z]{1,3}_?[1-9]{2}|0)"  # M11, which is an entry and no factor
NUMBERED = re.compile(rf"\[\s*{_ENTRY}(?:[ \t]+{_ENTRY})+\s*(?:;\s*{_ENTRY}(?:[ \t]+{_ENTRY})+\s*)+\]")
ENTRY_ENDS = re.compile(r"(?<=[\w)'])(?P<blank>[ \t]+)(?=[\w(]|[+-][\w(])")

_OF = r"\s*(?:\([^=()]{0,200}\)\s*)?"
LEFT_SIDE = {  # what people write in front of an energy
    "kinetic": re.compile(rf"^\s*(?:[TK]|KE|E_?\{{?k\}}?|\\mathcal\s*\{{?\s*T\s*\}}?){_OF}="),
    "potential": re.compile(rf"^\s*(?:[UV]|PE|E_?\{{?p\}}?|\\mathcal\s*\{{?\s*[UV]\s*\}}?){_OF}="),
    "lagrangian": re.compile(
        rf"^\s*(?:L|\\mathcal\s*\{{?\s*L\s*\}}?|\\mathscr\s*\{{?\s*L\s*\}}?|ℒ|𝓛){_OF}(?:=\s*T\s*[-−]\s*[UV]\s*)?="
    ),
    "hamiltonian": re.compile(
        rf"^\s*(?:H|\\mathcal\s*\{{?\s*H\s*\}}?|\\mathscr\s*\{{?\s*H\s*\}}?|ℋ){_OF}(?:=\s*T\s*\+\s*[UV]\s*)?="
    ),
}


def laid_out(line: str) -> str:
    """The line without layout, of the same length, but for what stands behind its end."""
    line = CONTINUED.sub(_blank, line)
    line = _unboxed(line)
    line = UPRIGHT.sub(_upright, line)
    for pattern in SET_ABOVE:
        line = pattern.sub(_dotted, line)
    line = SQUARED.sub(lambda found: found["dotted"] + "}" + found["power"].ljust(_rest(found)), line)
    if "\\" not in line.replace("\\\\", "") or not re.search(r"\\[A-Za-z,;:!]", line):
        line = _matlab(line)
    return re.sub(r"(?<!\\)\\$", "", STOP.sub(" ", line).rstrip())  # of a blank that LaTeX has as a command


def _rest(found: re.Match[str]) -> int:
    return len(found[0]) - len(found["dotted"]) - 1


def _blank(found: re.Match[str]) -> str:
    return " " * len(found[0])


def _upright(found: re.Match[str]) -> str:
    inner = found["inner"]
    if found["low"]:  # an index keeps its braces
        return ("_{" + inner.strip() + "}").ljust(len(found[0]))
    return (" " * (len(found[0]) - len(inner) - 1) + inner) + " "


def _dotted(found: re.Match[str]) -> str:
    count = len(re.findall(r"\\cdot|\\bullet|\.", found["dots"]))
    made = ("\\" + "d" * count + "ot{" + found["x"] + "}") if count in (1, 2) else found[0]
    return made.ljust(len(found[0])) if len(made) <= len(found[0]) else found[0]


def _unboxed(line: str) -> str:
    for _ in range(8):
        found = BOXES.search(line)
        if found is None:
            return line
        depth, at = 1, found.end()
        while at < len(line) and depth:
            depth += (line[at] == "{") - (line[at] == "}")
            at += 1
        if depth:
            return line
        line = line[: found.start()] + " " * len(found[0]) + line[found.end() : at - 1] + " " + line[at:]
    return line


def _matlab(line: str) -> str:
    """A transposed list, which is a column anyhow; entries with a blank between; A \\\\ b."""
    line = TRANSPOSED.sub(lambda found: found["list"].ljust(len(found[0])), line)
    line = MATLAB.sub(lambda found: _entries(found[0]), line)
    if BLANK_OR_DIVISION.search(line):
        raise InvalidInput(
            "a backslash with a blank behind it: MATLAB's division, or LaTeX's blank? Write A\\b, or leave it out"
        )
    return re.sub(r"(?<!\\)\\(?!\\)", "⧵", line)


def _entries(matrix: str) -> str:
    """Commas for blanks, where products have a star, in every row, and so a blank is none."""
    if NUMBERED.fullmatch(matrix):
        return re.sub(r"(?<=[0-9])[ \t](?=[ \t]*[A-Za-z0-9])", ",", matrix)
    if "," in matrix or not all("*" in row for row in matrix[1:-1].split(";")):
        return matrix
    depth, out = 0, list(matrix)
    blanks = {found.start("blank") for found in ENTRY_ENDS.finditer(matrix)}
    for at, c in enumerate(matrix):
        depth += (c == "(") - (c == ")")
        if at in blanks and not depth:
            out[at] = ","
    commas = "".join(out)
    return commas if len({row.count(",") for row in commas[1:-1].split(";")}) == 1 else matrix


def equations_of(line: str) -> list[str]:
    """The rows of a text that has several, each with one equals sign, in place; else the line alone."""
    for separator in ("\\\\", "\n"):
        pieces, start = [], 0
        for at in [*_places(line, separator), len(line)]:
            pieces.append(" " * start + line[start:at])
            start = at + len(separator)
        pieces = [piece for piece in pieces if re.sub(r"\\(?:begin|end)\{[^{}]*\}|[&\s]", "", piece)]
        if len(pieces) > 1 and all(piece.count("=") == 1 for piece in pieces):
            return pieces
    return [line]


def _places(line: str, separator: str) -> list[int]:
    """Where the separator stands outside brackets and matrices."""
    depth, found, at = 0, [], 0
    while at < len(line):
        begun = re.compile(r"\\(begin|end)\{[a-zA-Z]*(?:matrix|array)\}").match(line, at)
        if begun:
            depth += 1 if begun[1] == "begin" else -1
            at = begun.end()
            continue
        if line.startswith(separator, at) and depth == 0:
            found.append(at)
            at += len(separator)
            continue
        depth += (line[at] in "([{") - (line[at] in ")]}")
        at += 1
    return found


def texts_of(data: dict[str, Any]) -> Iterable[str]:
    """All lines of mathematics in a file."""
    for table in ("define", "positions", "velocities", "momenta", "equations", "solved"):
        found = data.get(table)
        entries = found.values() if isinstance(found, dict) else found if isinstance(found, list) else ()
        yield from (entry.translate(FULL_WIDTH) for entry in entries if isinstance(entry, str))
        if table == "momenta" and isinstance(found, dict):
            yield from (name.translate(FULL_WIDTH) for name in found)
    for name, left in LEFT_SIDE.items():
        if isinstance(data.get(name), str):
            yield left.sub("", data[name]).translate(FULL_WIDTH)
