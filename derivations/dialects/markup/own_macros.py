# ruff: noqa: E501 -- patterns stand on one line
r"""Macros that a text defines itself, \newcommand{\tha}{\theta_1}, \def\ddt#1{\frac{d #1}{dt}}, put in where they stand."""

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from .macros import closes

_HEAD = r"\\(?:(?:re)?newcommand|providecommand|DeclareRobustCommand|newcommandx)\*?\s*(?:\{\s*\\(?P<a>[A-Za-z]+)\s*\}|\\(?P<b>[A-Za-z]+))\s*(?:\[(?P<count>[0-4])\])?\s*(?:\[(?P<default>[^\[\]]{0,20})\])?\s*(?=\{)"
_DEF = r"\\(?:[gex]?def)\s*\\(?P<c>[A-Za-z]+)\s*(?P<marks>(?:#[1-4]\s*){0,4})(?=\{)"
_OPERATOR = r"\\DeclareMathOperator\*?\s*(?:\{\s*\\(?P<d>[A-Za-z]+)\s*\}|\\(?P<e>[A-Za-z]+))\s*(?=\{)"
DEFINED = re.compile(rf"{_HEAD}|{_DEF}|{_OPERATOR}")
LET = re.compile(r"\\let\s*\\(?P<name>[A-Za-z]+)\s*=?\s*\\(?P<of>[A-Za-z]+)(?![A-Za-z])")
# What a document has in front of its text
PREAMBLE = re.compile(
    r"(?m)^[ \t]*\\(?:documentclass|usepackage|RequirePackage|title|author|date|maketitle|pagestyle|geometry|hypersetup|sisetup|setlength|bibliographystyle|bibliography)\s*(?:\[[^\[\]]{0,200}\])?(?:\{[^{}]{0,200}\}){0,2}[ \t]*$|\\(?:begin|end)\s*\{document\}"
)
MOST_MACROS, MOST_USES, LONGEST = 60, 400, 20_000


def with_own_macros(text: str) -> str:
    """The text with what its macros stand for; any other text as it is. Raises InvalidInput where that has no end."""
    if "\\documentclass" in text or "\\begin{document}" in text or "\\usepackage" in text:
        text = PREAMBLE.sub("", text)
    macros: dict[str, tuple[int, str | None, str]] = {}
    for _ in range(MOST_MACROS):
        found = DEFINED.search(text)
        end = closes(text, found.end()) if found else -1
        if found is None or end < 0:
            break
        name = next(x for x in (found[k] for k in "abcde") if x)
        body = text[found.end() + 1 : end]
        if found["d"] or found["e"]:
            body = f"\\operatorname{{{body}}}"
        count = len(re.findall("#", found["marks"])) if found["marks"] else int(found["count"] or 0)
        macros[name] = (count, found["default"], body)
        text = text[: found.start()] + text[end + 1 :]
    for found in list(LET.finditer(text)):
        macros[found["name"]] = (0, None, f"\\{found['of']}")
    text = LET.sub("", text)
    return _expanded(text, macros) if macros else text


def _expanded(text: str, macros: dict[str, tuple[int, str | None, str]]) -> str:
    use = re.compile(rf"\\(?P<name>{'|'.join(sorted(macros, key=len, reverse=True))})(?![A-Za-z])")
    for _ in range(MOST_USES):
        found = use.search(text)
        if found is None:
            return text
        count, default, body = macros[found["name"]]
        arguments, at = _arguments(text, found.end(), count, default)
        for k, argument in enumerate(arguments, 1):
            body = body.replace(f"#{k}", argument)
        # \dot\tha takes the whole of what the macro stands for
        alone = re.search(r"\\d?dot\s*$|[_^]\s*$", text[: found.start()]) is not None
        made = (
            f"{{{body}}}"
            if alone
            else body + (" " if re.search(r"[A-Za-z]$", body) and text[at : at + 1].isalpha() else "")
        )
        text = text[: found.start()] + made + text[at:]
        if len(text) > LONGEST:
            break
    raise InvalidInput("macros of its own that are put in again and again: write the formulas with these put in")


def _arguments(text: str, at: int, count: int, default: str | None) -> tuple[list[str], int]:
    found: list[str] = []
    optional = re.compile(r"\s*\[(?P<x>[^\[\]]{0,60})\]").match(text, at) if default is not None else None
    if default is not None:
        found.append(optional["x"] if optional else default)
        at = optional.end() if optional else at
    while len(found) < count:
        blank = len(text[at:]) - len(text[at:].lstrip())
        start = at + blank
        if text[start : start + 1] == "{":
            end = closes(text, start)
            if end < 0:
                raise InvalidInput("a macro of its own whose argument has no end: write the formulas with it put in")
            found.append(text[start + 1 : end])
            at = end + 1
        else:
            one = re.compile(r"\\[A-Za-z]+|\S").match(text, start)
            if one is None:
                raise InvalidInput("a macro of its own without its argument: write the formulas with it put in")
            found.append(one[0])
            at = one.end()
    return found, at
