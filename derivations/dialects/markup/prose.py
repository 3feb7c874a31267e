# ruff: noqa: E501 -- patterns stand on one line
r"""Formulas among words: quoted e-mails, sentences around displays, headings, rows with numbers, a heading's arrow."""

from __future__ import annotations

import re
from collections.abc import Collection

from ....models.errors import InvalidInput
from ..lines import DENIED

QUOTED = re.compile(r"(?m)^[ \t]*(?:>[ \t]?)+")
DISPLAY = re.compile(
    r"\$\$(?P<a>.+?)\$\$|\\\[(?P<b>.+?)\\\]|\\begin\{(?P<env>equation|align|gather|eqnarray|displaymath)(?P<star>\*?)\}(?P<c>.+?)\\end\{(?P=env)(?P=star)\}",
    re.DOTALL,
)
AROUND = re.compile(
    r"\\(?:begin|end|label|tag|ref|eqref)\*?\s*\{[^{}]{0,40}\}|\\(?:noindent|nonumber|notag|centering|par)(?![A-Za-z])"
)
INLINE = re.compile(r"(?<!\$)\$[^$]{1,200}\$(?!\$)|\\\([^$]{1,200}?\\\)")
ALONE = re.compile(
    r"^\s*(?:[-*+]\s+|[0-9]{1,2}\.\s+|>\s*)?(?:\$\$(?P<two>[^$]+)\$\$|\$`?(?P<one>[^$]+?)`?\$|\\\((?P<round>.+?)\\\))\s*[.,;]?\s*(?:\\{1,2}|<br\s*/?>)?\s*$"
)
# In front of a row, the coordinate whose row it is: \theta : …
HEAD = re.compile(r"^\s*\\?[A-Za-zθϑφϕψαβ]{1,12}(?:_(?:\w|\{\w{1,4}\}))?\s*:(?!=)\s*(?=[^:]*=)")
WORDS = re.compile(r"[^\W\d_]{2,}")
SIGNS = re.compile(r"[=^_{}\\+*/<>|]")
ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")
NUMBERED = re.compile(
    r"(?m)^[ \t]*(?:\((?P<a>[0-9]{1,2}|[IV]{1,4}|[a-h]|[ivx]{1,4})\)|(?P<b>[0-9]{1,2})[.)](?=[ \t]))[ \t]*(?=\S)"
)
HEADED = re.compile(r"(?m)^[ \t]*[^\W\d_][^\n=$\\^{}*/]{1,80}[:：][ \t]*\n(?=[^\n]*=)")
ARROW = re.compile(
    r"^\s*(?:\\(?:overset|stackrel|underset)\s*\{\s*\\(?:curvearrow|circlearrow|acwopencirclearrow|right|left|up|down)[a-z]*\s*\}\s*\{\s*[A-Z]\s*\}"
    r"|\\(?:curvearrow|circlearrow|up|down|right)(?:left|right|arrow)[a-z]*\s*(?:\([A-Z]\)|[A-Z])?)\s*:"
)
MOST_DISPLAYS = 16  # without words between them
BRACED = re.compile(r"^\s*\{\s*\\displaystyle\s*(?P<inner>.*)\}\s*[.,]?\s*$", re.DOTALL)


class FormulasInWords(InvalidInput):
    """Sentences that have formulas of their own: whether they state something is for a reader of notes."""


def from_quoted(text: str) -> str:
    """A quoted e-mail without its marks; any other text as it is."""
    lines = [line for line in text.split("\n") if line.strip()]
    if not lines or not all(line.lstrip().startswith(">") for line in lines):
        return text
    return QUOTED.sub("", text)


def from_displays(text: str) -> str:
    """The displayed formulas of a text with sentences around them; any other text as it is."""
    found = list(DISPLAY.finditer(text))
    outside = AROUND.sub(" ", DISPLAY.sub("\n", text))
    if not found or (not 2 <= len(found) <= MOST_DISPLAYS and not WORDS.search(re.sub(r"\\[A-Za-z]+", " ", outside))):
        return text
    denied = DENIED.search(outside)
    if denied:
        raise InvalidInput(
            f"a sentence says {denied[0]!r} between the equations: give the equations that are meant, alone"
        )
    inline = INLINE.findall(outside)
    words = INLINE.sub(" ", outside)
    if any("=" in part or "\\approx" in part for part in inline) or SIGNS.search(words):
        raise FormulasInWords("a sentence between the displayed equations has formulas too: give the equations alone, and "
                           "what letters stand for in [define]")  # fmt: skip
    parts = [(m["a"] or m["b"] or m[0]).strip() for m in found]
    rows = [re.sub(r"\s*(?:\\,|\\;|\\ |~)?[.,;，．、。；]\s*$", "", part) for part in parts]
    return " \\\\ ".join(re.sub(r"\s+", " ", row) for row in rows)


def from_inline(text: str) -> str:
    """Lines that are one formula in dollar signs each, as a README has them, without these; any other text as it is."""
    lines = [line for line in text.split("\n") if line.strip()]
    found = [ALONE.match(line) for line in lines]
    if len(lines) < 2 or not all(found):
        return text
    said = [HEAD.sub("", (m["one"] or m["two"] or m["round"]).strip().rstrip(" .,;")) for m in found if m]
    return "\n".join(said)


def from_headed(text: str) -> str:
    """Without a line of words and a colon above a formula; any other text as it is."""
    if "\\" in text or not HEADED.search(text):
        return text
    denied = DENIED.search(" ".join(HEADED.findall(text)))
    if denied:
        raise InvalidInput(f"a heading says {denied[0]!r}: give the equations that are meant, alone")
    return HEADED.sub("\n", text)


def from_arrow(text: str) -> str:
    """Without the arrow that says which way a moment turns, and the {\\displaystyle …} of an alternative text."""
    braced = BRACED.match(text)
    if braced and is_whole(braced["inner"]):
        text = braced["inner"]
    return ARROW.sub(" ", text, count=1)


def is_whole(inner: str) -> bool:
    """Whether every brace in a text is closed in it."""
    depth = 0
    for at, c in enumerate(inner):
        if c in "{}" and inner[at - 1 : at] != "\\":
            depth += 1 if c == "{" else -1
        if depth < 0:
            return False
    return depth == 0


def numbered(text: str, names: Collection[str]) -> list[str] | None:
    """The rows behind (1), (2), … or (I), (II), … at the beginnings of lines; None where there are no such rows.

    ``names``: what the file declares. Raises InvalidInput where a number may be a factor of its row.
    """
    found = list(NUMBERED.finditer(text))
    if len(found) < 2 or text[: found[0].start()].strip():
        return None
    said = [m["a"] or m["b"] for m in found]
    if not any(said == [str(k + first) for k in range(len(said))] for first in range(1, 30)) and said not in (
        list(ROMAN[: len(said)]), [r.lower() for r in ROMAN[: len(said)]], list("abcdefgh"[: len(said)])
    ):  # fmt: skip
        return None
    doubtful = next((s for s in said if s in names), None)
    if doubtful:
        raise InvalidInput(f"({doubtful}) in front of a row: its number, or the quantity {doubtful}? Leave numbers out")
    rows = [text[a.end() : b] for a, b in zip(found, [*(m.start() for m in found[1:]), len(text)], strict=True)]
    rows = [re.sub(r"\s+", " ", row).strip(" ;,") for row in rows]
    return rows if all(row.count("=") == 1 for row in rows) else None
