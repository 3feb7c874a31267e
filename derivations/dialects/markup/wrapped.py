r"""Formulas as the tools of pages wrap them: math directives, template tags, comments of programs, {\displaystyle …}.

What is taken away says nothing of mechanics; what it holds stands as a display, $$…$$.
"""

from __future__ import annotations

import re
from typing import Any

from ..letters.every_text import everywhere
from ..statements import is_program
from .around.comments import uncommented
from .around.drawn import from_drawn
from .around.elements import without_elements
from .around.fractions import from_fractions
from .around.sites import from_sites
from .around.strings import from_strings, undoubled
from .own_macros import with_own_macros
from .prose import BRACED, is_whole
from .typst_text import typst_text

# reStructuredText: what is indented below, behind options as :label:
DIRECTIVE = re.compile(
    r"(?m)^(?P<in>[ \t]*)\.\. math::[ \t]*(?P<first>[^\n]*)\n(?P<inner>(?:[ \t]*\n|(?P=in)[ \t]+[^\n]*(?:\n|\Z))*)"
)
OPTION = re.compile(r"(?m)^[ \t]*:(?:label|name|nowrap|class)s?:[^\n]*$")
ROLE = re.compile(r":math:`(?P<inner>[^`$]{1,300})`")
_TAG = r"(?:math|katex|latex|mathjax|equation|raw|mathblock)"
TAGS = re.compile(
    rf"\{{%-?\s*(?P<of>{_TAG})\b[^%{{}}]{{0,40}}%\}}(?P<a>.*?)\{{%-?\s*(?:end(?:(?P=of))?|/(?P=of))\s*-?%\}}"
    rf"|\{{\{{[<%]\s*(?P<to>{_TAG})\b[^<>{{}}]{{0,40}}[>%]\}}\}}(?P<b>.*?)\{{\{{[<%]\s*/\s*(?P=to)\s*[>%]\}}\}}",
    re.DOTALL,
)
DISPLAYED = re.compile(r"\$|\\\[|\\begin\s*\{(?:equation|align|gather|eqnarray|multline|displaymath)")
FENCED = re.compile(r"(?m)^[ \t]*(?:```|~~~)")
# A line in backticks, as an item of a list or alone
TICKED = re.compile(r"(?m)^[ \t]*(?:[-*+][ \t]+|\d{1,2}[.)][ \t]+)?`(?P<inner>[^`\n]{1,400})`[ \t]*[.,;]?[ \t]*$")
# A letter, or some, that a sentence beside fences mentions in backticks
MENTIONED = re.compile(r"(?<!`)`[^\W\d_]\w{0,8}(?:\s*,\s*[^\W\d_]\w{0,8}){0,7}`(?!`)(?=[\s,.;:)(])")
# Formulas in backticks within a sentence
TICKS = re.compile(r"(?<!`)`(?P<inner>[^`\n=]{1,200}=[^`\n=]{1,400})`(?!`)[.,;]?")
WORDED = re.compile(r"(?<![^\W\d_])[^\W\d_]{2,40}\s{1,9}[^\W\d_]{2}")
ESCAPED = re.compile(r"(?<!\\)\\_")  # an index of LaTeX that Markdown would take for italics


def unwrapped(data: dict[str, Any]) -> dict[str, Any]:
    """The fields without what such tools put around formulas; programs stay."""
    return everywhere(data, _unwrapped)


def _unwrapped(text: str) -> str:
    text = uncommented(from_strings(text))
    if is_program(text):
        return text
    fenced = FENCED.search(text) is not None
    text = with_own_macros(from_sites(undoubled(without_elements(text))))
    text = typst_text(from_drawn(from_fractions(text)))
    text = TAGS.sub(lambda m: _display(m["a"] or m["b"] or ""), text)
    if ".. math::" in text:
        text = DIRECTIVE.sub(_of_directive, text)
    text = ROLE.sub(lambda m: f"${m['inner']}$", text)
    if fenced:  # beside formulas in fences, a line in backticks is one more
        text = MENTIONED.sub(" ", TICKED.sub(lambda m: m["inner"], text))
    elif not re.search(r"[$\\]|ddot", text) and WORDED.search(TICKS.sub(" ", text)):
        text = TICKS.sub(lambda m: f"\n{m['inner']}\n", text)
    lines = [line for line in text.split("\n") if line.strip()]
    braced = [BRACED.match(line) for line in lines]
    if len(lines) > 1 and all(m and is_whole(m["inner"]) for m in braced):
        text = "\n".join(_display(m["inner"]) for m in braced if m)
    return ESCAPED.sub("_", text)


def _of_directive(found: re.Match[str]) -> str:
    """What a directive holds: an equation between blank lines each, as Sphinx prints them."""
    whole = f"{found['first']}\n{OPTION.sub('', found['inner'])}"
    parts = [part for part in re.split(r"\n[ \t]*\n", whole) if part.strip()]
    apart = "\\begin" not in whole and all(part.count("=") > 0 for part in parts)
    return "".join(_display(part) for part in (parts if apart else [whole]))


def _display(inner: str) -> str:
    return f"\n{inner}\n" if DISPLAYED.search(inner) else f"\n$${inner.strip()}$$\n"
