"""Lines of programs: comments, Fortran's numbers and functions, pow(x, 2), np.square(x), names such as dw1."""

from __future__ import annotations

import re

from .bracketed import LONGEST_ARGUMENT, MOST_FUNCTIONS, closing, padded

COMMENTS = (
    re.compile(r"/\*(?:[^*]|\*(?!/)){0,500}\*/|\(\*(?:[^*]|\*(?!\))){0,500}\*\)"),
    re.compile(r"(?:#|//|(?<!\\)%)[^\n]*"),
)
FORTRAN_COMMENT = re.compile(r"(?<=\s)!(?!=)[^\n]*")
FORTRAN_GOES_ON = re.compile(r"&[ \t]*\n[ \t]*&?")
FORTRAN_NUMBER = re.compile(r"(?<![A-Za-z_0-9.])(?P<mantissa>[0-9]+\.?[0-9]*|\.[0-9]+)[dD](?P<exponent>[+-]?[0-9]+)")
FORTRAN_FUNCTION = re.compile(r"(?<![A-Za-z_\\])[dD](?=(?:sin|cos|tan|sqrt|sign)\s*\()")
POWER = re.compile(r"(?<![A-Za-z_])(?:(?:Math|np|numpy|math|jnp)\.|std::)?(?:power|pow)\s{0,4}\(")
SQUARE = re.compile(r"(?<![A-Za-z_])(?:(?:np|numpy|jnp|torch)\.)?square\s{0,4}\(")
STD = re.compile(r"(?<![A-Za-z_])(?:std::|Math\.|cmath\.|ca\.|casadi\.|cs\.)(?=[a-z])")
RATE = r"(?:omega|w|ω)[_]?[0-9]{0,2}"
OF_RATE = re.compile(rf"(?<![A-Za-z_\\])d(?P<x>{RATE})(?:_?dt)?(?![A-Za-z0-9_(/])")


def program(line: str, names: frozenset[str]) -> str:
    """The line without comments, and with ^ for powers. ``names``: the author's own."""
    for pattern in COMMENTS:
        line = pattern.sub(lambda found: " " * len(found[0]), line)
    if "\\" not in line:
        line = FORTRAN_COMMENT.sub(lambda found: " " * len(found[0]), line)
        line = FORTRAN_GOES_ON.sub(lambda found: " " * len(found[0]), line)
        line = FORTRAN_NUMBER.sub(lambda found: f"{found['mantissa']}e{found['exponent']}", line)
        line = FORTRAN_FUNCTION.sub(" ", line)
        line = STD.sub(lambda found: " " * len(found[0]), line)
        line = OF_RATE.sub(lambda found: found[0] if found[0] in names else padded(f"{found['x']}'", found), line)
    return _squares(_powers(line))


def _powers(line: str) -> str:
    """pow(x, 2) as (x)^(2)."""
    at = 0
    for _ in range(MOST_FUNCTIONS):
        found = POWER.search(line, at)
        if found is None:
            break
        opened, at = found.end() - 1, found.end()
        end, comma = closing(line, opened), _comma(line, opened)
        if 0 < comma < end:
            base, exponent = line[opened + 1 : comma], line[comma + 1 : end].strip()
            written = f"({base})^({exponent})"
            line = line[: found.start()] + written.rjust(end + 1 - found.start()) + line[end + 1 :]
            at = found.start()
    return line


def _squares(line: str) -> str:
    at = 0
    for _ in range(MOST_FUNCTIONS):
        found = SQUARE.search(line, at)
        if found is None:
            break
        opened, at = found.end() - 1, found.end()
        end = closing(line, opened)
        if end > 0:
            written = f"{line[opened : end + 1]}^2"
            line = line[: found.start()] + written.rjust(end + 1 - found.start()) + line[end + 1 :]
            at = found.start()
    return line


def _comma(line: str, opened: int) -> int:
    """The first comma within this bracket but within no other."""
    depth = 0
    for at in range(opened, min(len(line), opened + LONGEST_ARGUMENT)):
        depth += (line[at] in "([{") - (line[at] in ")]}")
        if depth == 1 and line[at] == ",":
            return at
        if not depth:
            break
    return -1
