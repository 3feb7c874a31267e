# ruff: noqa: E501 -- patterns stand on one line
r"""Commands of LaTeX's packages for derivatives and brackets, as plain LaTeX: \dv[2]{θ}{t}, \od{θ}{t}, \odd{θ}{t}, \Ddot, \qty.

Of physics, derivative, commath and diffcoeff, and macros that many call so. A command with other arguments stays, and is
refused where it is read.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from ..letters.every_text import everywhere
from ..names import plain_name
from ..statements import is_program
from ..table import known_of

_ORDINARY = "dv|derivative|odv|od|dod|tod|deriv|der|diff|odd|dodd"
_PARTIAL = "pdv|partialderivative|pderivative|pd|dpd|tpd|pderiv|diffp|pdd"
DERIVATIVE = re.compile(
    rf"\\(?P<name>{_ORDINARY}|{_PARTIAL})(?![A-Za-z])\*?\s*(?:\[\s*(?:order\s*=\s*)?\{{?\s*(?P<order>[1-3])\s*\}}?\s*\])?\s*(?=\{{)"
)
ALONE = ("dv", "derivative", "pdv", "partialderivative", "pderivative")  # \dv{t} is d/dt
SECOND = ("odd", "dodd", "pdd")
NAME = re.compile(r"\s*(?P<x>\\?[A-Za-z]+(?:\s*_\s*(?:\{[^{}]{1,8}\}|\w))?)\s*(?:\(\s*t\s*\))?\s*")
DIFFERENTIAL = re.compile(r"(?<=\{)\s*\\(?:dd|dif|diff|ud|rd|d)(?![A-Za-z])(?:\[\s*2\s*\])?")
BEGINS = re.compile(r"\\(?P<which>begin|end)\s+\{")
DOTS = re.compile(r"\\D(?P<dots>d?)ot(?=\s*[{\\A-Za-z])")
ABOVE = re.compile(r"\\(?:overset|stackrel)\s*\{\s*(?P<dots>(?:\\cdot|\\bullet|\.|\s){1,24})\s*\}\s*(?=\{)")
FRACTION = re.compile(r"\\(?:nicefrac|sfrac|cfrac|flatfrac)(?=\s*\{)")
# \qty{9.81}{\metre} is a number with its unit
BRACKET = re.compile(
    r"\\(?:qty|quantity|pqty|bqty|Bqty|mleft|mright)(?![A-Za-z])(?!\s*\{[^{}]*\}\s*\{)(?=\s*[(){}\[\]\\])"
)
# As an encyclopedia's text has it, {\\frac {\\mathrm {d} }{\\mathrm {d} t}}{\\left(…\\right)}
_D = r"(?:\\mathrm\s*\{\s*d\s*\}|d)"
BY_TIME = re.compile(
    rf"\{{\s*\\[dt]?frac\s*\{{\s*{_D}\s*\}}\s*\{{\s*{_D}\s*t\s*\}}\s*\}}(?=\s*\{{?\s*(?:\\left\s*)?[(\[])"
)
PAREN = re.compile(r"\\[lr](?P<of>paren|brack)(?![A-Za-z])")
BOLD = re.compile(r"\\(?:vb|va|vu)\*?(?=\s*\{)")
UPRIGHT = re.compile(r"\\mathop\s*\{\s*\}\s*(?:\\!)?\s*")
PRIMES = re.compile(r"\^\s*\{\s*(?P<p>(?:\\prime\s*){1,2})\}|\^\s*\\prime(?![A-Za-z])")
_M = r"(?:\\(?:mathbf|boldsymbol|bm|mathrm)\s*(?:\{\s*(?P<a>[A-Z])\s*\}|(?P<b>[A-Z])(?![A-Za-z]))|(?P<c>[A-Z])(?![A-Za-z_]))"
DETERMINANT = re.compile(
    rf"\\(?:det|operatorname\s*\{{\s*det\s*\}})\s*(?P<open>(?:\\left\s*)?\(\s*)?{_M}(?(open)\s*(?:\\right\s*)?\))"
)
# Scheme's {D}^{2}\\theta\\left(t\\right): D of a function of time that is a coordinate
OPERATOR = re.compile(
    r"(?<!_\{)(?<![A-Za-z\\_])(?:\{\s*D\s*\}|D)\s*(?P<two>\^\s*(?:\{\s*2\s*\}|2))?\s*(?P<x>\\?[A-Za-z]+(?:\s*_\s*(?:\{\s*\w{1,8}\s*\}|\w))?)\s*(?:\\left\s*)?\(\s*t\s*(?:\\right\s*)?\)"
)
MOST = 200


def plain_macros(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with plain LaTeX in place of these commands; programs, and texts without LaTeX, stay."""
    made = everywhere(data, _plain)
    known, define = known_of(made), made.get("define", {})
    own = {*known.quantities, *known.coordinates, *(map(str, define) if isinstance(define, dict) else ())}
    if "D" in own or not known.coordinates:
        return made
    return everywhere(made, lambda text: OPERATOR.sub(lambda m: _by_operator(m, known.coordinates), text))


def _by_operator(found: re.Match[str], coordinates: Collection[str]) -> str:
    dots = "ddot" if found["two"] else "dot"
    return f" \\{dots}{{{found['x'].strip()}}} " if plain_name(found["x"]) in coordinates else found[0]


def _plain(text: str) -> str:
    if "\\" not in text or is_program(text):
        return text
    text = BEGINS.sub(lambda m: f"\\{m['which']}{{", text)
    text = BY_TIME.sub(lambda _: r"\frac{d}{dt}", text)
    text = DOTS.sub(lambda m: f"\\{m['dots']}dot", text)
    text = ABOVE.sub(_dotted, text)
    for _ in range(MOST):
        changed = _one_derivative(text)
        if changed == text:
            break
        text = changed
    text = DIFFERENTIAL.sub(lambda m: "d^2 " if "[" in m[0] else "d ", text)
    text = FRACTION.sub(lambda _: "\\frac", UPRIGHT.sub("", text))
    text = BOLD.sub(lambda _: "\\mathbf", BRACKET.sub(_bracket, text))
    text = PAREN.sub(lambda m: {"paren": "()", "brack": "[]"}[m["of"]][m[0][1] == "r"], text)
    text = PRIMES.sub(lambda m: "'" * (m["p"].count("prime") if m["p"] else 1), text)
    return DETERMINANT.sub(lambda m: f" D_{{det{m['a'] or m['b'] or m['c']}}} ", text)


def _bracket(found: re.Match[str]) -> str:
    name = found[0][1:]
    return {"mleft": "\\left", "mright": "\\right"}.get(name, "")


def _dotted(found: re.Match[str]) -> str:
    count = len(re.findall(r"\\cdot|\\bullet|\.", found["dots"]))
    return {1: "\\dot", 2: "\\ddot"}.get(count, found[0])


def _one_derivative(text: str) -> str:
    """The text with the first command that has the arguments of a derivative as a fraction, or as dots by time."""
    for found in DERIVATIVE.finditer(text):
        name = found["name"]
        groups, end = _groups(text, found.end())
        if len(groups) == 1 and name in ALONE:
            groups = ["", *groups]
        if len(groups) != 2:
            continue
        order = 2 if name in SECOND else int(found["order"] or 1)
        made = _fraction(groups[0], groups[1], order, "\\partial " if name in _PARTIAL.split("|") else "d ")
        return text[: found.start()] + made + text[end:]
    return text


def _fraction(of: str, by: str, order: int, d: str) -> str:
    power = f"^{order}" if order > 1 else ""
    name = NAME.fullmatch(of)
    if name and by.strip() == "t" and order < 3 and d == "d ":
        return f"\\{'d' * order}ot{{{name['x']}}} "
    below = f"{{{d}{by}{power}}}"
    if not of.strip() or name or "partial" in d:
        return f"\\frac{{{d.strip()}{power} {of}}}{below}"
    return f"\\frac{{{d.strip()}{power}}}{below}\\left({of}\\right)"


def _groups(text: str, at: int) -> tuple[list[str], int]:
    """The groups in braces that follow each other from ``at``, at most three, and where the last ends."""
    found: list[str] = []
    while len(found) < 3:
        start = at + len(text[at:]) - len(text[at:].lstrip())
        end = closes(text, start)
        if end < 0:
            break
        found.append(text[start + 1 : end])
        at = end + 1
    return found, at


def closes(text: str, at: int) -> int:
    """Where the brace at ``at`` is closed; -1 where there is none."""
    depth = 0
    for place in range(at, len(text)):
        if text[place] in "{}" and text[place - 1 : place] != "\\":
            depth += 1 if text[place] == "{" else -1
        if depth == 0:
            return place if place > at else -1
    return -1
