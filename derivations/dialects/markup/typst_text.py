"""Several displays of a Typst text, $ … $ <label> each, and what its code has around one: #box($ … $), #text(20pt)[$ … $]."""
# ruff: noqa: E501 -- patterns stand on one line

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from ..lines import DENIED
from ..pasted import typst_dots
from .typst import BLOCK, LATEX, MARKS, from_typst

# What leaves a formula as it is; what hides or strikes it out is none of these
_SHOWN = r"(?:box|boxed|rect|block|text|align|pad|highlight|emph|strong|figure|math\.equation|grid|stack)"
CODE = re.compile(
    rf"#{_SHOWN}(?:\(\s*(?:[^()$#]{{0,120}},)?\s*|(?:\([^()$#]{{0,120}}\))?\s*\[\s*)(?P<inner>\$[^$]*\$)\s*,?\s*[)\]]"
)
DELIMITER = re.compile(r",?\s*delim:\s*(?:#none|none|\"[^\"]{0,2}\"|\([^()]{0,12}\))")
INDEX = re.compile(
    r"(?<![A-Za-z])(?P<x>(?:[A-Za-z]|theta|phi|psi|alpha|beta|tau|omega|ell|rho|mu))_\(\s*(?P<i>\w{1,4}(?:[ ,]+\w{1,4}){0,2})\s*\)"
)
FIGURES = re.compile(r"(?<![A-Za-z])(?P<x>[A-Za-z]|ell|tau|theta)_(?P<i>[1-9]{2})(?![0-9A-Za-z])")
BETWEEN = re.compile(r",?\s*\bq?quad\b\s*")
DISPLAY = re.compile(r"\$\s[^$]*\s\$(?:[ \t]*<[\w:.-]{1,40}>)?")
INLINE = re.compile(r"\$[^$\s](?:[^$]*[^$\s])?\$")
PREAMBLE = re.compile(r"(?m)^[ \t]*(?:#(?:import|set|show|let|include|pagebreak|v|h)\b[^\n]*|=+[ \t][^\n]*)$")
MOST = 60


def typst_text(text: str) -> str:
    """The equations of such a text, a row a line; any other text, and one display, as it is."""
    text = _without_code(text)
    if LATEX.search(text):
        return text
    text = INDEX.sub(lambda m: f"{m['x']}_{{{re.sub(r'[ ,]', '', m['i'])}}}", text)
    text = _without_words(text)
    lines = [line for line in text.split("\n") if line.strip()]
    if not lines or not all(BLOCK.match(line) for line in lines) or not MARKS.search(text) or "\\" in text:
        return text
    pieces = [piece for line in lines for piece in _equations(BLOCK.sub(lambda m: m["inner"], line))]
    if len(pieces) < 2:
        return text
    return "\n".join(typst_dots(FIGURES.sub(r"\g<x>_{\g<i>}", piece)) for piece in pieces)


def _without_words(text: str) -> str:
    """Its displays, a line each, where sentences stand around them. Raises InvalidInput where words deny them."""
    displays = list(DISPLAY.finditer(text))
    outside = INLINE.sub(" ", DISPLAY.sub(" ", PREAMBLE.sub("", text)))
    if not displays or not MARKS.search(text) or re.search(r"[$#]", outside) or not re.search(r"[^\W\d_]{2}", outside):
        return text
    stated = [m[0] for m in INLINE.finditer(DISPLAY.sub(" ", text)) if "=" in m[0]]
    denied = DENIED.search(outside)
    if denied:
        raise InvalidInput(
            f"a sentence says {denied[0]!r} beside the equations: give the equations that are meant, alone"
        )
    return "\n".join(re.sub(r"\s*\n\s*", " ", line) for line in (*(m[0] for m in displays), *stated))


def _equations(inner: str) -> list[str]:
    """Equations side by side, each with its equals sign, as rows."""
    parts = BETWEEN.split(inner)
    apart = parts if all(part.count("=") == 1 for part in parts) else [inner]
    # a display without a mark of Typst is read as the others are
    return [from_typst(f"$ {part.strip().rstrip(' ,.')} $").strip(" $") for part in apart]


def _without_code(text: str) -> str:
    for _ in range(MOST):
        found = CODE.search(text)
        if found is None:
            break
        within = text[: found.start()].count("$") % 2 == 1
        inner = found["inner"][1:-1] if within else found["inner"]
        text = text[: found.start()] + inner + text[found.end() :]
    return DELIMITER.sub("", text) if re.search(r"\bcases\s*\(", text) else text
