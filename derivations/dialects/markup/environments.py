# ruff: noqa: E501 -- patterns stand on one line
r"""Environments and matrices of LaTeX's packages as plain ones: IEEEeqnarray, empheq, numcases, \mqty(…), \pmatrix{…\cr}."""

from __future__ import annotations

import re
from typing import Any

from ..letters.every_text import everywhere
from ..statements import is_program
from .calls import closing

BEGINS = re.compile(
    r"\\begin\s*\{(?:IEEEeqnarray(?:box)?|empheq|darray|dgroup|dseries|mathleft|fleqn|xalignat|xxalignat|alignedat|alignat|DispWithArrows|WithArrows|resizedalign)\*?\}(?:\s*(?:\[[^\[\]]{0,60}\]|\{[^{}]{0,40}\})){0,3}"
)
ENDS = re.compile(
    r"\\end\s*\{(?:IEEEeqnarray(?:box)?|empheq|darray|dgroup|dseries|mathleft|fleqn|xalignat|xxalignat|alignedat|alignat|DispWithArrows|WithArrows|resizedalign)\*?\}"
)
INSIDE = re.compile(r"\\begin\s*\{(?:equation|align|gather|math|displaymath)\*?\}|\$|\\\[")
ALONE = re.compile(
    r"\\(?:begin|end)\s*\{(?:dgroup|dseries|mathleft|fleqn|mdframed|tcolorbox|framed|center|figure|small|footnotesize|minipage|keyeq|important|theorem|proof|example|definition|boxedminipage|linenomath|subequations|adjustbox|quote)\*?\}(?:\s*(?:\[[^\[\]]{0,60}\]|\{[^{}]{0,60}\})){0,2}"
)
NUMBERED = re.compile(r"\\IEEE(?:yes|no)(?:number|subnumber)\*?|\\IEEE(?:eqnarraymulticol)?strut\w*|\\IEEEnonumber")
SPANS = re.compile(
    r"\\(?:IEEEeqnarraymulticol|multicolumn)\s*\{\s*\d\s*\}\s*\{[^{}]{0,8}\}\s*(?=\{)|\\(?:mathrlap|mathllap|mathclap|smash|mathstrut|Aboxed|tcbhighmath|tcboxmath|highlight|colorboxed|hl)\s*(?:\[[^\[\]]{0,20}\]\s*)?(?=\{)|\\resizebox\s*\{[^{}]*\}\s*\{[^{}]*\}\s*(?=\{)|\\scalebox\s*\{[^{}]*\}\s*(?=\{)"
)
CASES = re.compile(r"\\begin\s*\{(?:sub)?numcases\}\s*(?:\{[^{}]{0,60}\})?")
CASES_END = re.compile(r"\\end\s*\{(?:sub)?numcases\}")
MATRIX = re.compile(r"\\(?P<kind>s?[pbvBP]?)m(?:qty|atrixquantity)\*?\s*(?=[({\[|])")
OLD = re.compile(r"\\(?P<kind>[pbv]?)matrix\s*(?=\{)")
KINDS = {"p": "pmatrix", "b": "bmatrix", "v": "vmatrix", "B": "Bmatrix", "": "matrix"}
INTERTEXT = re.compile(r"\\(?:short)?intertext\s*\{(?P<inner>[^{}]*(?:\$[^$]*\$[^{}]*)*)\}")
MOST = 60


def plain_environments(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with plain environments in place of these; programs, and texts without LaTeX, stay."""
    return everywhere(data, _plain)


def _plain(text: str) -> str:
    if "\\" not in text or is_program(text):
        return text
    for pattern in (MATRIX, OLD):
        text = _with_matrices(text, pattern)
    text = NUMBERED.sub(" ", text)
    text = CASES_END.sub(lambda _: "\\end{cases}", CASES.sub(lambda _: "\\begin{cases}", text))
    text = ALONE.sub("\n", text)
    displayed = _is_displayed(text)
    text = BEGINS.sub(lambda _: "\n" if displayed else "\\begin{align}", text)
    text = ENDS.sub(lambda _: "\n" if displayed else "\\end{align}", text)
    return _without_spans(text)


def _is_displayed(text: str) -> bool:
    """Whether the first of these environments stands within a display, where align may not."""
    found = BEGINS.search(text)
    return found is not None and INSIDE.search(text[: found.start()]) is not None


def _with_matrices(text: str, pattern: re.Pattern[str]) -> str:
    for _ in range(MOST):
        found = pattern.search(text)
        end = closing(text, found.end()) if found and text[found.end()] != "|" else -1
        if found is None or end < 0:
            return text
        opened = text[found.end()]
        kind = found["kind"].removeprefix("s")[-1:] or ("" if opened == "{" else {"(": "p", "[": "b"}[opened])
        inner = re.sub(r"\\cr(?![A-Za-z])", lambda _: "\\\\", text[found.end() + 1 : end]).strip()
        inner = re.sub(r"\\\\\s*$", "", inner)
        name = KINDS[kind.lower() if kind == "P" else kind]
        text = f"{text[: found.start()]} \\begin{{{name}}} {inner} \\end{{{name}}} {text[end + 1 :]}"
    return text


def _without_spans(text: str) -> str:
    for _ in range(MOST):
        found = SPANS.search(text)
        end = closing(text, found.end()) if found else -1
        if found is None or end < 0:
            return text
        text = f"{text[: found.start()]} {text[found.end() + 1 : end]} {text[end + 1 :]}"
    return text
