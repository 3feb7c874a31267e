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

_SYMPY = r"(?<![A-Za-z_0-9.])(?:(?:sp|sympy|sm|sy)\.)?"
_INT = r"\s*[-+]?[0-9]{1,12}\s*"
EXACT = re.compile(
    rf"{_SYMPY}(?:(?P<fraction>Rational|Fraction)\s*\((?P<a>{_INT}),(?P<b>{_INT})\)"
    rf"|(?P<whole>Rational|Integer|S|sympify|nsimplify)\s*\((?:(?P<n>{_INT})|\s*(?P<q>[\"'])(?P<t>{_INT}(?:/{_INT})?)(?P=q)\s*)\)"
    r"|(?P<half>S\.(?:Half|One|NegativeOne))(?![A-Za-z_]))"
)
OF_S = {"S.Half": "(1/2)", "S.One": "1", "S.NegativeOne": "(-1)"}
METHOD = re.compile(r"\.(?P<name>sin|cos|tan|sqrt|abs|powi|powf|pow)\s{0,4}\((?P<of>\s{0,4}[0-9.]{0,4}\s{0,4})\)")
RECEIVER = re.compile(r"[A-Za-z_]\w{0,40}(?:\[\d\])?$")
KEYWORDS = re.compile(r"(?m)^\s*(?:(?:const|let|var|mut|auto|double|float|f64)\s+){1,3}(?=\w+\s*(?::\s*\w+\s*)?=)")


def program(line: str, names: frozenset[str]) -> str:
    """The line without comments, and with ^ for powers. ``names``: the author's own."""
    if not names & {"Rational", "S", "Integer", "Fraction"}:
        line = EXACT.sub(_exact, line)
    for pattern in COMMENTS:
        line = pattern.sub(lambda found: " " * len(found[0]), line)
    if "\\" not in line:
        line = FORTRAN_COMMENT.sub(lambda found: " " * len(found[0]), line)
        line = FORTRAN_GOES_ON.sub(lambda found: " " * len(found[0]), line)
        line = FORTRAN_NUMBER.sub(lambda found: f"{found['mantissa']}e{found['exponent']}", line)
        line = FORTRAN_FUNCTION.sub(" ", line)
        line = STD.sub(lambda found: " " * len(found[0]), line)
        line = OF_RATE.sub(lambda found: found[0] if found[0] in names else padded(f"{found['x']}'", found), line)
        line = KEYWORDS.sub(lambda found: " " * len(found[0]), line)
        line = methods(line)
    return _squares(_powers(line))


def _exact(found: re.Match[str]) -> str:
    """sympy's exact numbers, Rational(2, 3) and S(1)/2, as formulas have them."""
    if found["fraction"]:
        return padded(f"(({found['a'].strip()})/({found['b'].strip()}))", found)
    if found["half"]:
        return padded(OF_S[found["half"]], found)
    return padded(f"({(found['n'] or found['t']).strip()})", found)


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


def methods(line: str) -> str:
    """x.sin() of Rust and its kin as sin(x), x.powi(2) as (x)^2."""
    for _ in range(MOST_FUNCTIONS):
        found = METHOD.search(line)
        start = _receiver(line, found.start()) if found else -1
        if found is None or start < 0:
            return line
        of, inner = found["of"].strip().removesuffix(".0").rstrip("."), line[start : found.start()]
        if found["name"].startswith("pow"):
            made = f"({inner})^{of}" if of.isdigit() else None
        else:
            made = f"{found['name']}({inner})" if not of else None
        if made is None:
            return line
        line = f"{line[:start]}({made}){line[found.end() :]}"
    return line


def _receiver(line: str, end: int) -> int:
    """Where the name or the bracket that ends here begins; -1 where there is none."""
    if line[end - 1 : end] != ")":
        name = RECEIVER.search(line[max(0, end - 44) : end])
        return end - len(name[0]) if name else -1
    depth = 0
    for at in range(end - 1, max(-1, end - LONGEST_ARGUMENT), -1):
        depth += (line[at] == ")") - (line[at] == "(")
        if depth == 0:
            called = re.search(r"[A-Za-z_.]{1,40}$", line[max(0, at - 40) : at])
            return at - len(called[0]) if called else at
    return -1


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
