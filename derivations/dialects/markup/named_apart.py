# ruff: noqa: E501 -- patterns stand on one line
r"""Names that a text gives in ways of its own: \text{temp} = …, M(q) beside a mass M, M^{-1}(q); and ∂ω/∂t for a rate."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from ..letters.every_text import everywhere
from ..statements import is_program
from ..table import known_of
from .chains import hamiltons_signs

_WORD = r"\\(?:text|operatorname|mathrm|mathit|textit|textrm|mathtt|texttt)\*?\s*\{\s*(?P<w>[A-Za-z]{2,12})\s*\}"
WORD = re.compile(rf"(?<![_^])(?<![_^]\{{){_WORD}")
SAID = re.compile(
    rf"(?:^|[$\n&]|\\\[|\\\\|\\begin\s*\{{[a-z]+\*?\}})(?:\s|&|\\[,;:! ]|\\q?quad(?![A-Za-z]))*{_WORD}\s*&?\s*:?="
)
NO_NAMES = frozenset(
    ("sin", "cos", "tan", "sgn", "sign", "where", "with", "and", "or", "so", "thus", "then", "KE", "PE")
)
_X = r"(?P<x>\\?[A-Za-z]+(?:\s*_\s*(?:\{\s*\w{1,6}\s*\}|\w))?)"
BY_TIME = re.compile(rf"\\[dt]?frac\s*\{{\s*\\partial\s*{_X}\s*\}}\s*\{{\s*\\partial\s*t\s*\}}")
ENERGIES = ("L", "T", "U", "V", "H", "E", "K")
_Q = r"(?:\\(?:mathbf|boldsymbol|bm|vec|mathrm)\s*\{\s*\\?[A-Za-z]+\s*\}|\\?[A-Za-z]+)"
_DOTTED = rf"(?:\\d?dot\s*\{{?\s*)?{_Q}\s*\}}?"
ARGUMENTS = rf"(?:\\left\s*)?\(\s*{_DOTTED}(?:\s*,\s*{_DOTTED})?\s*(?:\\right\s*)?\)"
INVERSE = re.compile(
    rf"(?P<m>\\(?:mathbf|boldsymbol|bm|mathrm)\s*\{{\s*[A-Z]\s*\}}|(?<![A-Za-z\\])[A-Z])\s*(?P<power>\^\s*\{{\s*-\s*1\s*\}})\s*(?P<of>{ARGUMENTS})"
)
PRODUCT = re.compile(
    rf"(?<![A-Za-z\\{{])(?P<m>[A-Z])\s*{ARGUMENTS}\s*\\dot\s*\{{?\s*{_Q}\s*\}}?(?P<is>\s*&?\s*:?=\s*\\begin\s*\{{[pbvB]?matrix)?"
)
MATRIX = re.compile(rf"(?<![A-Za-z\\{{])(?P<m>[A-Z])(?=\s*{ARGUMENTS})")

SO = re.compile(r"(?<=[\w)\s])[ \t]+=>[ \t]+(?=[^=\n{]{1,40}=[^=>\n]+$)", re.MULTILINE)  # A = B => C = D
IN_INDEX = re.compile(r"_\s*\{\s*\\(?:text|mathrm|textrm|mathit)\s*\{\s*(?P<x>[A-Za-z0-9]{1,8})\s*\}\s*\}")
ALONE = re.compile(  # a letter that a sentence mentions
    r"\$\$\s*(?P<x>(?:\\[A-Za-z]+|[A-Za-z])(?:\s*_\s*(?:\{\s*\w{1,6}\s*\}|\w))?)\s*\$\$(?=[ \t,.;]*[^\s$=\\])"
)
BREAK = re.compile(r"(?m)(?:(?<=[$:])|^)[ \t]*(?<!\\)\\[ \t]*$")  # Markdown's end of a line
FIRST_SIGN = re.compile(r"\A(?P<begin>\s*(?:\$\$|\\\[)\s*)=(?=[^$]*=)")  # what stood in front of it is left out
IN_MATRIX = re.compile(r"\\begin\s*\{(?P<of>[pbB]?matrix)\}.{1,4000}?\\end\s*\{(?P=of)\}", re.DOTALL)
TWO_MARKS = re.compile(r"(?<!\\)&\s*&")


def named_apart(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with such names as the reader knows them; programs stay."""
    quantities = known_of(data).quantities

    def one(text: str) -> str:
        if is_program(text):
            return text
        text = SO.sub(" ⇒ ", text)
        if "\\" not in text:
            return text
        text = IN_INDEX.sub(r"_{\g<x>}", hamiltons_signs(text))
        text = ALONE.sub(_mentioned, text)
        text = IN_MATRIX.sub(_columns, FIRST_SIGN.sub(r"\g<begin>", BREAK.sub("", text)))
        text = BY_TIME.sub(lambda m: m[0] if m["x"] in ENERGIES else rf"\frac{{d {m['x']}}}{{d t}}", text)
        return _words(_products(_matrices(INVERSE.sub(r"\g<m>\g<of>\g<power>", text), quantities)))

    return everywhere(data, one)


def _mentioned(found: re.Match[str]) -> str:
    """The letter in one pair of dollars, where the marks are not the end of one display and the beginning of another."""
    opens = found.string.count("$$", 0, found.start()) % 2 == 0
    return f"${found['x']}$" if opens else found[0]


def _columns(found: re.Match[str]) -> str:
    """A matrix with && between all its columns, with one mark for two."""
    text = found[0]
    return TWO_MARKS.sub("&", text) if "&" not in TWO_MARKS.sub("", text) else text


def _words(text: str) -> str:
    if re.search(r"\\Xi(?!_\{[A-Z]q\})", text):
        return text
    said = {m["w"] for m in SAID.finditer(text)} - NO_NAMES
    return WORD.sub(lambda m: rf" \Xi_{{{m['w']}}} " if m["w"] in said else m[0], text)


def _products(text: str) -> str:
    r"""A name for C(q, \dot q)\dot q, where the text says what column that is."""
    said = {m["m"] for m in PRODUCT.finditer(text) if m["is"]} if "\\Xi" not in text else set()
    return PRODUCT.sub(lambda m: rf" \Xi_{{{m['m']}q}} {m['is'] or ''}" if m["m"] in said else m[0], text)


def _matrices(text: str, quantities: Collection[str]) -> str:
    r"""\mathbf{M}(q), where M is a quantity too and M(q) is said to be something."""
    said = {m["m"] for m in MATRIX.finditer(text) if re.match(rf"\s*{ARGUMENTS}\s*&?\s*:?=", text[m.end() :])}
    apart = {
        name for name in said if name in quantities and re.search(rf"(?<![A-Za-z\\{{]){name}(?!\s*\(|[A-Za-z])", text)
    }
    return MATRIX.sub(lambda m: rf"\mathbf{{{m['m']}}}" if m["m"] in apart else m[0], text)
