# ruff: noqa: E501 -- patterns stand on one line
r"""The formulas of a text, without the words around them: markdown, displays $$…$$ and \[…\], inline $…$, plain lines."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ....models.errors import InvalidInput
from ..lines import DENIED
from ..markup.prose import AROUND, is_whole
from ..markup.prose import BRACED as DISPLAYSTYLE

_ENVIRONMENTS = (
    "cases|dcases|equation|align|alignat|gather|eqnarray|multline|flalign|displaymath|dmath|math|aligned|gathered|split"
)
FENCE = re.compile(r"(?ms)^[ \t]*(?P<mark>```|~~~)[ \t]*(?P<of>\w*)[^\n]*\n(?P<inner>.*?)^[ \t]*(?P=mark)[ \t]*$")
FORMULAS = ("", "math", "latex", "tex", "text", "txt")  # what a fence may say that it holds
FORMULA = re.compile(
    rf"\$\$(?P<a>.+?)\$\$|\\\[(?P<b>.+?)\\\]|(?P<c>\\begin\{{(?P<env>(?:{_ENVIRONMENTS})\*?)\}}.+?\\end\{{(?P=env)\}})"
    r"|(?<!\\)\$`?(?P<d>[^$]+?)`?\$|\\\((?P<e>.+?)\\\)",
    re.DOTALL,
)
MARKS = re.compile(
    r"(?m)^[ \t]*(?:>[ \t]?|#{1,6}[ \t]+|[-*+•▪‣◦][ \t]+(?=[^\d\s])|\d{1,2}[.)][ \t]+|\|[ \t]*)|[ \t]*\|[ \t]*$"
)
# Pairs of ** and __; ** behind a name, a number or a bracket is a power
BOLD = re.compile(
    r"(?<![A-Za-z0-9α-ωΑ-Ωϑϕϵ₀-₉_)\]}'′″\u0307\u0308*])(?P<mark>\*\*|__)(?=[^\s*_])(?P<inner>[^*\n]+?)(?<=\S)(?P=mark)(?![*_])"
)
IMAGE = re.compile(r"!?\[[^\[\]\n]{0,80}\]\([^()\n]{0,200}\)|<!--.{0,400}?-->|https?://\S{1,200}", re.DOTALL)
# What a page has around its formulas; a style may hide them, or strike them out
PAGE = re.compile(
    r"</?(?:div|p|br|span|center|details|summary|section|article|figure|ul|ol|li|h[1-6]|hr)(?:\s+(?:class|align|id)=\"(?![^\"]*hid)[^\"<>]{0,60}\"){0,3}\s*/?>",
    re.IGNORECASE,
)
SECTION = re.compile(
    r"\\(?:(?:sub){0,2}section|paragraph|chapter|textbf|emph|textit|text|item)\*?\s*(?:\{(?P<x>[^{}]{0,120})\})?"
)
LAYOUT = re.compile(
    r"\\(?:begin|end)\s*\{(?:itemize|enumerate|center|document|quote)\}|\\\\|\\(?:quad|qquad|bigskip|medskip|smallskip)(?![A-Za-z])|\\[,;: ]"
)
SIGN = re.compile(r"[=^{}\\<>]|\d\s*[+−]|[≈≪∂]")
OPERATORS = re.compile(r"[\s+\-−*/=·×]*[+\-−*/=·×][\s+\-−*/=·×]*")
WORD = re.compile(r"[^\W\d_]{2,}")
# In front of a formula of the same line: a word, or a few, and a colon
LABEL = re.compile(r"^[ \t]*(?P<label>(?:\([\w ]{1,12}\)[ \t]*)?[^\W\d_][^\n=$\\^{}*/:+]{1,60})[:：](?!=)[ \t]*(?=\S)")
LEAD = re.compile(
    r"^[ \t]*(?:[Ww]here|[Ww]ith|[Aa]nd|[Hh]ere|[Ll]et|[Dd]efine|[Mm]it|[Ww]obei|[Uu]nd|[Dd]ove|[Oo]ù|[Aa]vec|[Ss]oit|[Cc]on|[Dd]onde|где|其中|ただし|or|oder|i\.e\.)[ \t:,]+(?=[^=]{1,40}=)"
)
# Behind a formula, apart from it: words of a language, and no sign
BEHIND = re.compile(
    r"(?:\t|[ ]{2})\s*(?P<words>(?:[^\W\d_θϑφϕψαω][\w'’-]*[ ,]+){1,12}?(?=[^\W\d_]{3})(?!(?:sin|cos|tan)\b)[\w'’-]+(?:[ ,]+[\w'’-]+){0,12}\.?)[ \t]*$"
    r"|[ ]\((?P<aside>[\u3040-\u30ff\u4e00-\u9fff]{2,20}|[^\W\d_θϑφϕψαω][\w'’-]*(?:[ ,]+[^\W\d_][\w'’-]+){1,12})\)[ \t]*$"
)
# A sentence that says what a letter is: … accelerations (where Δ = θ₁ - θ₂):
WHERE = re.compile(
    r"^(?P<words>[^=+*/^_·\\{}\[\]]{12,400}?)[(,]\s*(?:where|with|wobei|mit|où|avec|donde|con|dove|где|其中)\s+(?P<said>[^\W\d_]\w{0,8}\s*:?=[^=:,;()]{1,60}(?:\([^()=]{1,40}\)[^=:,;()]{0,40})?)\)?\s*[:.：]?\s*$"
)
ADDS = re.compile(r"\b(?:plus|minus|times|over|by|if|when|while|for|unless|only|without|with|and|or)\b", re.IGNORECASE)
ONLY_WORDS = re.compile(r"^[^=\\^_{}]*$")
APPROXIMATE = re.compile(r"\\(?:approx|ll|gg|sim|simeq|lesssim|rightarrow|to)(?![A-Za-z])|[≈≪≫≃]")

MOST_MARKS = 400


@dataclass(frozen=True)
class Found:
    """A formula; ``inline``: in a sentence, where it may only mention something."""

    text: str
    inline: bool = False


def formulas_of(text: str) -> list[Found]:
    """The formulas of a text, in order. Raises InvalidInput where words deny them, or where they are not apart."""
    if sum(text.count(mark) for mark in ("$", "\\(", "\\[", "\\begin")) > MOST_MARKS:
        raise InvalidInput(f"more than {MOST_MARKS} marks of formulas; give the equations of motion alone")
    text = FENCE.sub(_fenced, text)
    if FORMULA.search(text):
        text = PAGE.sub("\n", text)
    matches = list(FORMULA.finditer(text))
    outside = _plain_words(FORMULA.sub(" \0 ", text))
    if not matches or SIGN.search(outside.replace("\0", " ")):
        return _of_lines(text)
    for between in outside.split("\0")[1:-1]:
        if OPERATORS.fullmatch(between):
            raise InvalidInput("a sign between two formulas: write each equation within one pair of $")
    deny(outside)
    found = []
    for m in matches:
        inline = m["d"] is not None or m["e"] is not None
        formula = next(m[k] for k in "abcde" if m[k] is not None)
        if inline and APPROXIMATE.search(formula) and not re.search(r"\\text", formula):
            raise InvalidInput(
                f"{formula.strip()[:40]}: an approximation in a sentence; the exact equations are judged"
            )
        shown = DISPLAYSTYLE.match(formula)
        found.append(Found(shown["inner"] if shown and is_whole(shown["inner"]) else formula, inline))
    displayed = any(not f.inline for f in found)
    return [f if displayed else Found(f.text, inline=True) for f in found]


def deny(words: str) -> None:
    """Raises InvalidInput where a sentence may say that an equation is not meant."""
    denied = DENIED.search(words)
    if denied:
        raise InvalidInput(
            f"a sentence says {denied[0]!r} beside the equations: give the equations that are meant, alone"
        )


def _fenced(found: re.Match[str]) -> str:
    if found["of"].lower() not in FORMULAS:
        return found[0]
    inner = found["inner"]
    if found["of"].lower() in ("math", "latex", "tex") and "$" not in inner and "\\[" not in inner:
        return f"\n$${inner}$$\n"
    return f"\n{inner}\n"


def _plain_words(text: str) -> str:
    """Words without what markdown and LaTeX put around them."""
    text = IMAGE.sub(" ", text)
    text = SECTION.sub(lambda m: f" {m['x'] or ''} ", AROUND.sub(" ", text))
    return MARKS.sub(" ", without_bold(LAYOUT.sub(" ", text)))


def without_bold(text: str) -> str:
    """Without the marks of bold words; a power stays."""
    return BOLD.sub(lambda m: m["inner"], text)


def _of_lines(text: str) -> list[Found]:
    """The lines that are formulas, of a text that has no marks around these."""
    quoted = [bool(re.match(r"[ \t]*>", line)) for line in text.split("\n") if line.strip()]
    if any(quoted) and not all(quoted):
        raise InvalidInput("quoted lines beside others: whose equations are meant? Give these alone")
    kept: list[str] = []
    said: list[str] = []
    for line in text.split("\n"):
        plain = without_bold(line)
        bare = MARKS.sub("", plain) if re.search(r"^[ \t]*(?:>|#|[-*+•▪‣◦][ \t]|\d{1,2}[.)][ \t])", plain) else plain
        if plain == line and line.lstrip()[:1] in "-+*":
            listed = MARKS.sub("", plain)  # a sign, as likely as the mark of a list, but before a word and a colon
            bare = listed if LABEL.match(listed) else line
        label = LABEL.match(bare)
        if label and "=" in bare and not re.fullmatch(r"[A-Za-z]", label["label"].strip()):
            said.append(label["label"])
            bare = " " * label.end() + bare[label.end() :]
        where = WHERE.match(bare)
        if where and len(WORD.findall(where["words"])) > 2:
            said.append(where["words"])
            bare = where["said"]
        lead = LEAD.match(bare)
        if lead:
            bare = bare[lead.end() :]
        if ONLY_WORDS.match(bare) and len(WORD.findall(bare)) >= 1 and _is_sentence(bare):
            said.append(bare)
            kept.append("")
            continue
        remark = BEHIND.search(bare)
        words = (remark["words"] or remark["aside"]) if remark else ""
        if remark and "=" in bare[: remark.start()] and not ADDS.match(words):
            said.append(words)
            bare = bare[: remark.start()]
        kept.append(bare)
    deny(" ".join(said))
    made = "\n".join(kept)
    return [Found(made)] if made.strip() else []


def _is_sentence(line: str) -> bool:
    """Whether a line without an equals sign is words: it ends in a colon, or has no sign of a sum or product."""
    return line.rstrip().endswith((":", "：", ".", "。")) or not re.search(r"[+\-−*/()\[\]·']", line)
