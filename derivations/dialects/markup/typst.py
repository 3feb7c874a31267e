"""A block equation of Typst: rows end in a backslash, & aligns, dot.double(phi)_1, frac(a, b), mat(a, b; c, d)."""

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from .calls import called

BLOCK = re.compile(r"^\s*\$(?P<inner>[^$]*)\$\s*(?:<[\w:.-]{1,40}>)?\s*[.,]?\s*$", re.DOTALL)
MARKS = re.compile(r"\b(?:dot(?:\.double)?|diaer|frac|mat|dv|vec|cases|lr|upright|op)\s*\(|\\\s*\n|\\\s*$")
LATEX = re.compile(r"\\[A-Za-z{(\[]")
ROW_ENDS = re.compile(r"\\\s+|\\$")
VARIANT = re.compile(r"\b(?P<x>phi|theta|epsilon|rho|sigma)\.alt\b")
DOT = re.compile(r"\bdot\.op\b|\btimes\b|\bast\b")
SPACES = re.compile(r"\b(?:quad|wide|thin|med|thick)\b")
DIF = re.compile(r"\b(?:dif|upright\(d\))(?=[\s^])\s*")
PRIME = re.compile(r"\s*\bprime(?P<two>\.double)?\b")


def from_typst(text: str) -> str:
    """The equations of a block, a row a line; any other text as it is."""
    found = BLOCK.match(text)
    if found is None or LATEX.search(text) or not MARKS.search(text):
        return text
    line = found["inner"]
    if '"' in line or "#" in line:
        raise InvalidInput("words or code in a Typst equation: give the formulas alone")
    line = VARIANT.sub(lambda m: "var" + m["x"], DOT.sub("*", SPACES.sub(" ", line)))
    line = PRIME.sub(lambda m: "''" if m["two"] else "'", line)
    line = DIF.sub("d", line)
    line = called(line, "dv", _by_time, 0)
    line = called(line, "frac", lambda parts: f"(({parts[0]})/({parts[1]}))", 2)
    line = called(line, "lr", lambda parts: parts[0], 1)
    line = called(line, "upright", lambda parts: parts[0], 1)
    line = called(line, "cases", " \\\n ".join, 0)
    line = called(line, "vec", lambda parts: "[" + ", ".join(parts) + "]", 0)
    line = called(line, "mat", lambda rows: "[" + ", ".join(f"[{row}]" for row in rows) + "]", 0, ";")
    rows = [re.sub(r"\s+", " ", row.replace("&", " ")).strip() for row in ROW_ENDS.split(line)]
    return "\n".join(_joined([row.rstrip(" ,.") for row in rows if row]))


def _by_time(parts: list[str]) -> str:
    """dv(theta, t, 2) of physica as theta''."""
    order = parts[2].strip() if len(parts) > 2 else "1"
    if len(parts) < 2 or parts[1].strip() != "t" or order not in ("1", "2"):
        raise InvalidInput("dv of Typst with anything but a name and t: write theta'' or dot.double(theta)")
    name = re.sub(r"\(t\)$", "", parts[0].strip())
    return f"dot.double({name})" if order == "2" else f"dot({name})"


def _joined(rows: list[str]) -> list[str]:
    """Rows that go on in the next begin with a sign there."""
    made: list[str] = []
    for row in rows:
        if made and re.match(r"[-+−*=]", row) and row.count("=") + made[-1].count("=") == 1:
            made[-1] += " " + row
        else:
            made.append(row)
    return made
