# ruff: noqa: E501 -- patterns stand on one line
r"""What people print around letters that says nothing of mechanics: c o s, = 0!, \note in front, \tau_c(\mathrm{yön}).

And \frac{d\dot x}{dt} for \ddot x, and a row [0 \quad 1] for a matrix.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from ..letters.every_text import everywhere
from ..names import GLYPHS, GREEK, plain_name
from ..statements import is_program
from ..table import known_of
from .time_indices import in_indices

HIGH = re.compile(r"(?<=[\w)\]'])[²³]")
LOW = re.compile(r"(?<=[A-Za-z}\])])[ \t]*(?P<mark>[_^])[ \t]*(?=[\w{\\])")  # m _ { 1 } of a converter
IN_BRACES = re.compile(r"\{\s*\\(?P<wave>sin|cos|tan)\s*\}(?=\s*\^)")
# The number of an equation in front of it, (Eq. 1)\qquad
HEAD = re.compile(
    r"(?P<start>^|\$|\\\[|\n|\\\\)\s*\(\s*(?:[Ee]qn?|Gl|[ÉéEe]c|式)\.?(?:\\[;, ]|\s|~)*[0-9]{1,3}(?:\.[0-9]{1,3})?[a-z]?\s*\)\s*(?:\\q?quad(?![A-Za-z])\s*)+"
)
JOINED = re.compile(r"\$\$\s*\$\$(?=\s*(?:=|[+−-](?:[^$=]|\$(?!\$))*\$\$))")  # one equation in two displays
SPACED = re.compile(r"(?<![A-Za-z\\])(?:c\s+o\s+s|s\s+i\s+n|t\s+a\s+n)(?=\s*[({\\])")
_END = r"(?:\s|\\[,;:! ]|[.,;$`])*(?:$|\\\\|\\end|\\\]|\\\)|\n|\$|\}\s*$)"
# Sine and tangent in Spanish, Italian, Portuguese, French, German and Russian
SINE = re.compile(
    r"\\(?:operatorname|mathrm|text|textrm|mathop|rm|mathsf)\*?\s*\{\s*(?:\\mathrm\s*\{\s*)?(?P<a>sen|sin|cos|tg|tan)\s*(?:\}\s*)?\}|\\(?P<b>sen|tg|Sin|Cos|Tan)(?![A-Za-z])|(?<![\w\\.])(?P<c>sen|tg|Sen)(?=\s*(?:[²^]?\d?\s*[(]|[²\s]?\s?[θϑφϕψα]))"
)
NAMES = {"sen": "sin", "Sen": "sin", "tg": "tan", "Sin": "sin", "Cos": "cos", "Tan": "tan"}
ABOVE = re.compile("[\u0307\u0308]")
CITED = re.compile(
    r"~?\\(?:cite[a-zA-Z]*|autoref|cref|Cref|eqref|ref|nameref|footnotemark|pageref)\*?(?:\[[^\[\]]{0,60}\]){0,2}\{[^{}]{0,120}\}"
)
# Behind a row: its unit in brackets, or for which times it holds
_UNIT = r"\s*(?:\\(?:mathrm|text|textrm|rm|si|unit)\s*\{[^{}=]{1,40}\}\s*[/·]?\s*)+(?:\\right\s*)?"
UNIT = re.compile(
    rf"(?:\\[,;: ]|\s|~){{0,12}}(?:\\q?quad(?![A-Za-z])(?:\\[,;: ]|\s|~){{0,12}}(?:\\left\s*)?[\[(]{_UNIT}[\])]|\\[,;: ]\s*(?:\\left\s*)?\[{_UNIT}\])(?=\s*(?:$|\\\\|\$|\\\]|\\end|[.,]))"
)
TIMES = re.compile(
    r"[,;]?(?:\\q?quad(?![A-Za-z])|\\[,;:! ]|\s|~){0,12}(?:\\(?:text|mathrm|textrm)\s*\{\s*(?:for|für|pour|para|per)(?:\s+all|\s+alle|\s+tout)?\s*\})?(?:\\[,;: ]|\s)*(?:\\forall\s*|∀\s*)?(?<![A-Za-z])t\s*(?:\\(?:geq?|geqslant|gt|in)(?![A-Za-z])|≥|>|∈)\s*(?:t_\{?0\}?|0|\\mathbb\s*\{?\s*R\s*\}?(?:\s*_?\s*\{?[+≥0\\a-z ]{0,8}\}?)?|\[[^\[\]()=]{1,20}[\])])(?=\s*(?:$|\\\\|\$|\\\]|\\end|[.,]))"
)
# The number of an equation behind dots or in a circle, as in Japan, China and Korea
_DOTS = r"(?:\\[cl]?dots[bcmi]?(?![A-Za-z])|…|⋯|(?<!・)・{2,12}(?!・)|(?<!·)·{3,12}(?!·)|(?<!\.)\.{3,12}(?!\.)|\\text\s*\{\s*(?:…|・|·|⋯|\.)+\s*\})"
_WIDE = r"(?:\s|\\[,;:! ]|\\q?quad(?![A-Za-z])|~){0,12}"
COUNT = re.compile(
    rf"{_WIDE}(?:(?:{_DOTS}{_WIDE}){{1,6}}(?:[(（]\s*\w{{1,4}}(?:[.-]\d{{1,2}})?\s*[)）]|(?:\\(?:text|mathrm|textcircled)\s*\{{?)?\s*[①-⑳Ⓐ-ⓩ0-9]\s*\}}?|\\text\s*\{{\s*[(（]\s*\w{{1,4}}\s*[)）]\s*\}})|(?:\\(?:text|mathrm)\s*\{{\s*)?[①-⑳]\s*\}}?)(?=\s*[.,，。]?\s*(?:$|\n|\\\\|\$|\\\]|\\end))"
)
OF_TIME = re.compile(r"\{\s*\\left\s*\(\s*t\s*\\right\s*\)\s*\}")
# Newton's law as a head, \sum M_O = J\ddot\theta: …
LAW = re.compile(
    r"(?P<start>^|\n|\$|\\\[|\\\\|\\begin\s*\{(?:equation|align|gather|aligned|gathered|split)\*?\})(?P<blank>(?:\s|&|\\[,;:! ])*)(?:\\sum|∑|Σ)\s*(?:\\(?:vec|mathbf|bm)\s*)?\{?(?:[FMTNQ]|\\tau|τ|\\Gamma)\}?(?:\s*_\s*(?:\{[^{}=:]{1,12}\}|\w))?\s*(?:=\s*&?\s*[mMJIΘ](?:_\s*(?:\{\w{1,6}\}|\w))?\s*(?:\\,)?\s*(?:\\ddot\s*\{?\s*(?:\\[a-z]+|[a-z])\s*\}?|\\alpha|a)(?:_\s*(?:\{\w{1,6}\}|\w))?\s*)?(?:[:：](?!=)|\\(?:implies|Rightarrow|Longrightarrow|Leftrightarrow|iff|to)(?![A-Za-z])|⇒|⟹)(?:\s|&|\\[,;:! ]|\\q?quad(?![A-Za-z]))*(?=[^=]*=)"
)
EMPHASIS = re.compile(rf"(?P<before>=(?:\s|\\[,;:! ]|&)*0)(?:\s|\\[,;:! ]){{0,3}}!(?P<behind>{_END})")
MUST = re.compile(
    r"\\(?:overset|stackrel)\s*\{\s*(?:!|\?|\\text\s*\{\s*!\s*\}|\\mathrm\s*\{\s*def\.?\s*\}|\\text\s*\{\s*def\.?\s*\}|def)\s*\}\s*(?:\{\s*=\s*\}|=)|\\(?:eqdef|stackeq)(?![A-Za-z])"
)
_STARTS = r"(?P<start>^|\$\$|\\\[|\\begin\s*\{(?:equation|align|gather|aligned|gathered|split)\*?\}|\\\\)(?P<blank>(?:\s|&|\\[,;:! ])*)"
# A mark in front of a formula: macros of notes, and signs that no product has
MARK = re.compile(
    rf"{_STARTS}\\(?:note|important|result|remark|warning|attention|hint|keyeq|boxeq|star|bigstar|bullet|checkmark|blacktriangleright|triangleright|blacksquare|Box|square|dagger|ast|circledast|looparrowright|hookrightarrow|leadsto|rightsquigarrow)(?![A-Za-z])(?!\s*[_^{{(=+\-])"
)
_D = r"(?:\\mathrm\s*\{\s*d\s*\}|\{\s*\\rm\s+d\s*\}|\\text\s*\{\s*d\s*\}|\\operatorname\s*\{\s*d\s*\}|\\mathrm\s*d|\\rm\s+d|d)"
_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_X = rf"(?:\\(?:{_GREEK})(?![A-Za-z])|[A-Za-z])"
_LOW = r"(?:\s*_\s*(?:\{[^{}]{1,8}\}|\w))?"
_RATE = rf"(?:\{{\s*)?\\dot\s*(?:\{{\s*(?P<a>{_X}{_LOW})\s*\}}|(?P<b>{_X}))(?P<i>{_LOW})(?:\s*\}})?\s*(?:\(\s*t\s*\))?"
_ABOVE = r"[\u0307]"
_GLYPH = rf"(?P<g>[A-Za-z{''.join(GLYPHS)}])(?P<gi>[₀-₉]{{0,2}})"
BY_TIME = (
    re.compile(rf"\\[dtc]?frac\s*\{{\s*{_D}\s*{_RATE}\s*\}}\s*\{{\s*{_D}\s*t\s*\}}"),
    re.compile(
        rf"\\[dtc]?frac\s*\{{\s*{_D}\s*\}}\s*\{{\s*{_D}\s*t\s*\}}\s*(?!\\dot\s*\{{?\s*\w+\s*\}}?\s*[({{^]){_RATE}(?=(?:\s|\\[,;:! ])*(?:$|[=+−&,;.}}$)\]-]|\\\\|\\(?:q?quad|end|right)(?![A-Za-z])))"
    ),
    re.compile(rf"(?<![A-Za-z\\]){_D}\s*{_RATE}\s*/\s*{_D}\s*t(?![A-Za-z])"),
    re.compile(rf"(?<![A-Za-z\\])d\s*{_GLYPH}{_ABOVE}(?P<gj>[₀-₉]{{0,2}})\s*/\s*dt(?![A-Za-z])"),
)
ROW = re.compile(
    r"(?<![A-Za-z0-9_\])}])(?:\\left\s*)?\[(?P<inner>[^\[\]=&]{1,200}?\\q?quad[^\[\]=&]{1,200}?)(?:\\right\s*)?\]"
)
WIDE = re.compile(r"\\q?quad(?![A-Za-z])")
ROW_ENDS = re.compile(r"\\\\(?:\s*\[[^\[\]]{1,12}\])?")
ARGUMENT = re.compile(
    r"(?<![A-Za-z\\])(?P<x>\\?[A-Za-z]{1,24}(?:\s*_\s*(?:\{[^{}\\]{1,12}\}|\w))?)\s*(?:\\left\s*)?\(\s*\\(?:mathrm|text|textrm|mathit|textit|rm|mbox)\s*\{(?P<word>[^\W\d_][\w .-]{2,30})\}\s*(?:\\right\s*)?\)"
)

_MATRIX = r"\\begin\s*\{(?P<of>[pbB]?(?:small)?matrix|array)\}(?:\s*\{[clr|@{}\s]{0,20}\})?(?P<inner>(?:(?!\\begin).){1,2000}?)\\end\s*\{(?P=of)\}"
_T = r"(?:\\(?:top|intercal)(?![A-Za-z])|\\(?:mathrm|mathsf|text|textsf|mathit|mathbf)\s*\{\s*T\s*\}|\\(?:rm|sf|mathrm)\s+T(?![A-Za-z])|T(?![A-Za-z])|⊤)"
_TURN = rf"\s*(?:\^\s*(?:\{{\s*(?:{_T}|t)\s*\}}|{_T})|ᵀ)"
TURNED = re.compile(rf"(?:\\left\s*[(\[]\s*)?{_MATRIX}(?:\s*\\right\s*[)\]])?{_TURN}", re.DOTALL)
_NAME = rf"(?:\\?[A-Za-z]+|[{''.join(GLYPHS)}])"
_LOW_ANY = r"(?:_\s*(?:\{\s*\w{1,6}\s*\}|\w)|[₀-₉]{1,2})"
ENTRY = re.compile(
    rf"\s*(?:\\d?dot)?\s*\{{?\s*(?P<x>{_NAME}[\u0307\u0308]{{0,2}}\s*{_LOW_ANY}?)\s*\}}?\s*(?P<i>{_LOW_ANY})?['′″]{{0,2}}\s*"
)
LISTED = re.compile(r"(?<=[\w}\u0307\u0308'])\s*(?:\\left\s*)?\((?P<inner>[^()=+*/^]{3,200})\)")


OVER = re.compile(
    r"\{(?P<top>(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*?)\\over(?![A-Za-z])(?P<below>(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}"
)


def plainly_printed(data: dict[str, Any]) -> dict[str, Any]:
    """The fields without these; programs stay."""
    known = known_of(data)
    names = {*known.coordinates, *known.quantities}

    def noted(found: re.Match[str]) -> str:
        return found["x"] if plain_name(found["x"]) in names and plain_name(found["word"]) not in names else found[0]

    def one(text: str) -> str:
        if is_program(text):
            return text
        text = ARGUMENT.sub(noted, in_indices(_plain(text), known.coordinates, names))
        return LISTED.sub(lambda m: " " if _depends(m["inner"], known.coordinates) else m[0], text)

    return everywhere(data, one)


def _plain(text: str) -> str:
    if "*" in text and "\\" not in text:  # as a program writes, but for its powers
        text = HIGH.sub(lambda m: "^" + "23"["²³".index(m[0])], text)
    text = SPACED.sub(lambda m: re.sub(r"\s", "", m[0]) + " ", text)
    text = EMPHASIS.sub(lambda m: m["before"] + m["behind"], MUST.sub(" = ", text))
    text = COUNT.sub("", SINE.sub(_wave, text))
    if "\\" in text:
        text = JOINED.sub(" ", HEAD.sub(lambda m: m["start"], IN_BRACES.sub(r"\\\g<wave> ", text)))
        text = LOW.sub(r"\g<mark>", text)
        text = TIMES.sub("", UNIT.sub("", CITED.sub(" ", text)))
        text = LAW.sub(lambda m: m["start"] + m["blank"], OF_TIME.sub("(t)", text))
        text = MARK.sub(lambda m: m["start"] + m["blank"], text)
        for _ in range(40):
            text, count = OVER.subn(lambda m: f"{{\\frac{{{m['top'].strip()}}}{{{m['below'].strip()}}}}}", text)
            if not count:
                break
        text = TURNED.sub(_turned, ROW.sub(_row, text))
    for pattern in BY_TIME:
        text = pattern.sub(_twice, text)
    return text


def _wave(found: re.Match[str]) -> str:
    name = next(x for x in (found["a"], found["b"], found["c"]) if x)
    return ("" if found["c"] else "\\") + NAMES.get(name, name) + ("" if found["b"] or found["c"] else " ")


def _twice(found: re.Match[str]) -> str:
    groups = found.groupdict()
    if groups.get("g"):
        return f"{groups['g']}\u0308{groups['gi'] or groups['gj'] or ''} "
    name = (groups["a"] or groups["b"] or "").strip()
    return f"\\ddot{{{name}{(groups['i'] or '').strip()}}} "


def _depends(inner: str, coordinates: Collection[str]) -> bool:
    """Whether a list in brackets has coordinates and their rates alone: what a quantity depends on, and no factor."""
    parts = re.split(r"[,;]", re.sub(r"\\(?:left|right|[,;:! ])", " ", inner))
    found = [ENTRY.fullmatch(part) for part in parts]
    names = [plain_name(ABOVE.sub("", m["x"]) + (m["i"] or "")) for m in found if m]
    return len(parts) > 1 and all(found) and all(x in coordinates or (x == "t" and "\\" in inner) for x in names)


def _turned(found: re.Match[str]) -> str:
    """A matrix that is written with rows for columns."""
    rows = [[x.strip() for x in row.split("&")] for row in ROW_ENDS.split(found["inner"]) if row.strip()]
    if len({len(row) for row in rows}) != 1:
        return found[0]
    inner = " \\\\ ".join(" & ".join(column) for column in zip(*rows, strict=True))
    return f" \\begin{{bmatrix}} {inner} \\end{{bmatrix}} "


def _row(found: re.Match[str]) -> str:
    r"""[0 \quad 1] as a matrix of one row."""
    entries = [part.strip() for part in WIDE.split(found["inner"])]
    if not all(entries) or any(entry.endswith((",", ";")) or entry[0] in "+-*/=" for entry in entries[1:]):
        return found[0]
    return " \\begin{bmatrix} " + " & ".join(entries) + " \\end{bmatrix}"
