# ruff: noqa: E501 -- patterns and tables stand on one line
"""Fortran's statements, in free and in fixed form: without remarks, continued lines as one."""

from __future__ import annotations

import re
from collections.abc import Collection

FIXED = re.compile(r"(?m)^     [^ 0\n]")
GOES_ON = re.compile(r"&[ \t]*(?:![^\n]*)?\n")
WORDS = frozenset((
    "subroutine", "function", "end", "if", "then", "else", "elseif", "do", "call", "return", "program", "module", "contains",
    "result", "associate", "pure", "recursive", "elemental", "parameter", "real", "integer", "double", "precision", "implicit",
    "none", "common", "dimension", "continue", "intent", "in", "out", "inout", "enddo", "endif", "while", "select", "case",
))  # fmt: skip


def lines_of(text: str) -> list[str]:
    """Statements without remarks; continued lines as one."""
    is_fixed = FIXED.search(text) is not None and GOES_ON.search(text) is None
    made: list[str] = []
    goes_on = False
    for raw in text.split("\n"):
        if re.match(r"[cC*][ \t]|[cC*]$|[cC*][-=*]", raw) and not re.match(r"(?i)c\s*=", raw):
            continue
        line = _without_remark(raw).rstrip()
        if not line.strip():
            continue
        if is_fixed and re.match(r"     [^ 0]", line) and made:
            made[-1] += " " + line[6:]
            continue
        bare = line.strip()
        if goes_on and made:
            made[-1] += " " + bare.removeprefix("&").removesuffix("&")
        else:
            made.append(bare.removesuffix("&"))
        goes_on = bare.endswith("&")
    return [part.strip() for line in made for part in line.split(";") if part.strip()]


def _without_remark(line: str) -> str:
    """Up to an exclamation mark that stands in no text."""
    bare = re.sub(r"'[^'\n]*'|\"[^\"\n]*\"", lambda m: m[0].replace("!", " "), line)
    return line[: bare.find("!")] if "!" in bare else line


def one_spelling(text: str, known: Collection[str]) -> str:
    """Each name in one spelling, the file's own where it has one: Fortran's capitals are small letters."""
    said: dict[str, str] = {}
    for name in sorted(known):
        said.setdefault(name.lower(), name)
    doubled = {name.lower() for name in known if sum(other.lower() == name.lower() for other in known) > 1}

    def one(found: re.Match[str]) -> str:
        word = found[0]
        if word.lower() in WORDS:
            return word.lower()
        return word if word.lower() in doubled and word in known else said.setdefault(word.lower(), word.lower())

    return re.sub(r"(?<![\w.])[A-Za-z_]\w*", one, text)
