"""The names in a text: which it uses, which of them it says the value of, and which have dots as coordinates have."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from unicodedata import normalize

from .....models.errors import InvalidInput
from ....dialects.letters.every_text import lines_of
from ....dialects.markup.asciimath import without_ticks
from ....dialects.markup.environments import plain_environments
from ....dialects.markup.macros import plain_macros
from ....dialects.markup.printed import plainly_printed
from ....dialects.markup.wrapped import unwrapped
from ....dialects.names import GREEK, LOWS, plain_name
from ....dialects.table import TABLES

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_GLYPHS = "".join(GREEK.values())
_LETTER = rf"(?:\\(?:{_GREEK}|ell)(?![A-Za-z])|[A-Za-z]+|[{_GLYPHS}ℓ])"
_INDEX = rf"(?:\s*_\s*\{{[^{{}}=+*/-]{{1,16}}\}}|_?[0-9]+|_[A-Za-z0-9]+|\s*_\s*\\[a-z]+(?![A-Za-z])|[{LOWS}]{{1,4}})"
NAME = re.compile(rf"(?P<base>{_LETTER})(?P<index>{_INDEX})?")
WORD = re.compile(r"(?P<base>[^\W\d_]\w*)(?P<index>)")
DERIVATIVE = re.compile(
    r"(?<![A-Za-z])d\s*(?:t(?![A-Za-z])|\^?\{?[2²]|(?=\\?[a-zA-Z]*\s*\}\s*\{\s*d\s*t|\s*\}))|(?<=frac\{)\s*d(?![A-Za-z])"
)
MARKED = re.compile(
    r"\$\$.+?\$\$|\$[^$\n]+\$|\\\[.+?\\\]|\\\(.+?\\\)|```.*?```"
    r"|\\begin\{(?P<env>equation|align|gather|eqnarray|displaymath|multline|aligned)(?P<star>\*?)\}.+?\\end\{(?P=env)(?P=star)\}",
    re.DOTALL,
)
WORDS_INSIDE = re.compile(
    r"(?<!_)(?<!_\{)\\(?:text|mbox|textrm|textbf|textit|mathrm)\s*\{[^{}]*[^\W\d_]{3}[^{}]*\}|\\(?:begin|end|tag|label|ref|eqref)\*?\s*\{[^{}]*\}(?:\{[clr|@{}]*\})?"
)
KEYWORDS = frozenset([
    "double", "float", "int", "void", "return", "class", "var", "let", "const", "this", "self", "def", "function",
    "end", "import", "from", "lambda", "Math", "math", "np", "sp", "struct", "static", "public", "private",
    "final", "auto", "for", "if", "else", "in", "range", "as", "with", "do", "while", "array", "zeros", "dot",
    "dtheta", "state", "params", "std", "func", "fn", "real", "integer", "parameter", "module", "subroutine",
    "call", "begin", "then", "not", "and", "or", "None", "true", "false", "True", "False", "new", "type", "mut",
    "use", "val",
])  # fmt: skip
RATE_WORDS = ("{}dot", "{}ddot", "d{}", "{}d", "{}Dot", "{}dd", "dd{}", "{}p", "{}v", "v{}", "{}t", "w{}", "omega{}")
GIVEN = re.compile(r"(?:\[[^\]\n]*\]|\([\d, ]*\)){0,2}\s*(?::=|=(?!=)|\+=|<<)")
MATRIX = re.compile(r"[A-Z]")
UNPACKED = re.compile(
    r"(?m)^[ \t]*[\[(]?(?P<names>\w+(?:\s*,\s*\w+)+)[\])]?\s*=(?!=)\s*(?P<of>[xyszquvrXYSZQ]|yy|state|State)\b"
)
STATE = re.compile(r"(?<![\w.])(\w+)\s*(?:\[\s*\d|\(\s*\d\s*\))")
OF_COORDINATES = re.compile(r"(?:\\left\s*)?\(\s*\{?\s*(?:q|\\?theta|\\dot|x\s*,|θ)")
BOLD = re.compile(r"\\(?:mathbf|boldsymbol|bm|mathcal|vec|underline|mathbb)\s*\{?\s*(?:\\?[A-Za-z]+)\s*\}?(?!\s*_)")
TYPE = re.compile(r"[A-Z](?=\w*[a-z])\w{3,}")
DRIVE = re.compile(r"(?:F|f|u|tau|Q|Gamma)\w{0,3}")
WAVE = re.compile(r"[cs][0-9]{1,2}")  # sines and cosines, of robotics
STOP = frozenset([
    "the", "and", "for", "with", "are", "is", "of", "in", "to", "by", "we", "as", "at", "be", "or", "from", "on",
    "an", "it", "so", "if", "where", "then", "this", "that",
])  # fmt: skip
FONT = re.compile(r"\\(?:mathrm|mathit|mathsf|mathbf|boldsymbol|bm|text|textrm|textit|operatorname|rm)\b\s*")
IN_BRACES = re.compile(r"\{\s*([A-Za-z0-9_]{1,12})\s*\}")
COMMAND = re.compile(rf"\\(?!(?:{_GREEK}|ell)(?![A-Za-z]))[A-Za-z]+")
COMMENT = re.compile(r"(?m)(?:^|\s)(?:#|//|%)[^\n]*$|/\*.*?\*/", re.DOTALL)
NUMBER = re.compile(r":?=\s*[-+]?[0-9.]+(?:e[-+]?[0-9]+)?[fd]?\s*(?:[;,)\n#/%]|$)")  # of a parameter
FUNCTIONS = frozenset([
    "sin", "cos", "tan", "cot", "sec", "csc", "exp", "sqrt", "ln", "log", "abs", "sign", "sgn", "atan", "arctan",
    "dt", "dx", "g", "t", "pi", "diff",
])  # fmt: skip
GREEK_NAMES = frozenset(GREEK)
_ONE = rf"(?P<base>{_LETTER})(?P<in>{_INDEX})?"
_TIME = r"\s*(?:\(\s*t\s*\)|\[\s*t\s*\])?\s*"
DOTTED = (  # twice, then once
    (
        re.compile(rf"\\ddot\s*\{{?\s*{_ONE}\s*\}}?(?P<out>{_INDEX})?"),
        re.compile(rf"(?<![A-Za-z\\]){_ONE}{_TIME}(?:''|″|′′)"),
        re.compile(rf"(?P<base>{_LETTER})\u0308(?P<in>{_INDEX})?"),
        re.compile(rf"d\^?\{{?[2²]\}}?\s*{_ONE}{_TIME}\}}?\s*(?:\{{|/)\s*\{{?\s*d\s*t"),
        re.compile(rf"ddot\s*\(?\s*{_ONE}"),
    ),
    (
        re.compile(rf"\\dot\s*\{{?\s*{_ONE}\s*\}}?(?P<out>{_INDEX})?"),
        re.compile(rf"(?<![A-Za-z\\]){_ONE}{_TIME}['′]"),
        re.compile(rf"(?P<base>{_LETTER})\u0307(?P<in>{_INDEX})?"),
        re.compile(rf"(?<![A-Za-z])d\s*{_ONE}{_TIME}\}}?\s*(?:\{{|/)\s*\{{?\s*d\s*t"),
    ),
)
ANGLES = re.compile(
    r"(?:theta|vartheta|varphi|phi|psi|alpha|beta|gamma|alfa|th|al|be|tilt|angle|ang|sway|q|a|b)\w{0,3}"
)
SLIDES = re.compile(r"(?:x|s|p|y|z|r|pos|xi|rho|u|w|h|l|L|d|e|q)\w{0,2}")
COORDINATE = re.compile(rf"(?:{ANGLES.pattern}|{SLIDES.pattern})")
MOST_NAMES = 90


@dataclass(frozen=True)
class Letters:
    """``names``: as they are written, by their plain ones, in the order in which they stand there.

    ``unsaid``: those plain names that the text neither defines nor calls; ``dotted``: coordinates, by their dots.
    """

    names: Mapping[str, str]
    unsaid: frozenset[str]
    dotted: tuple[str, ...]
    is_code: bool

    def like(self, pattern: re.Pattern[str]) -> list[str]:
        """The plain names that are as a pattern says, of those that the text does not define."""
        return [name for name in self.names if name in self.unsaid and pattern.fullmatch(name)]


def letters_of(data: Mapping[str, Any]) -> Letters:
    """The letters of these fields of a derivation."""
    equations = data.get("equations")
    text = "\n".join([equations] if isinstance(equations, str) else lines_of(_plain(data)))
    is_code = not re.search(r"\\[A-Za-z]{2}", text) and re.search(r"\w\s*\*+\s*[\w(]", text) is not None
    raw, text = text, COMMENT.sub("\n", text) if is_code else _formulas(text)
    dotted = () if is_code else _dotted(FONT.sub("", raw))
    bare = COMMAND.sub(" ", DERIVATIVE.sub(" ", text))
    said = {
        plain
        for table in TABLES
        if isinstance(data.get(table), dict)
        for key in data[table]
        if (plain := plain_name(str(key)))
    }
    names: dict[str, str] = {}
    for found in (WORD if is_code else NAME).finditer(bare):
        for written in _apart(found, is_code=is_code):
            plain = plain_name(written)
            if (
                plain
                and plain not in FUNCTIONS
                and not (is_code and (plain in KEYWORDS or TYPE.fullmatch(plain)))
                and len(names) < MOST_NAMES
            ):
                names.setdefault(plain, written)
        behind = bare[found.end() : found.end() + 40].lstrip()
        is_given = GIVEN.match(behind) and not NUMBER.match(behind)
        if (
            is_given
            or (behind.startswith("(") and len(found["base"]) > 1)
            or (MATRIX.fullmatch(found[0]) and OF_COORDINATES.match(behind))
        ):
            plain = plain_name(found[0]) or ""
            if is_code or not DRIVE.fullmatch(plain):  # F = … is an equation
                said.add(plain)
    if is_code:
        said |= _state(text)
        dotted = tuple(written for x, written in names.items() if COORDINATE.fullmatch(x) and _has_rate(x, names))
    columns = {name for name in names if any(name + k in said for k in "12")}  # s of s_1, whose value is said
    columns |= {x for x in names if WAVE.fullmatch(x)} if "c12" in names or {"c2", "s2"} <= names.keys() else set()
    if not is_code and "matrix" in raw:
        dotted = tuple(x for x in dotted if plain_name(x) != "q" or len(dotted) == 1)
        masses = [x for x in names if x.startswith("m")]
        columns |= set("ABCDGHKNXZ") | ({"M"} if len(masses) > 1 else set())
    columns |= {plain_name(x) or "" for x in dotted if x not in _entries(dotted, names)}
    return Letters(names, frozenset(names) - said - columns, _entries(dotted, names), is_code)


def _state(text: str) -> set[str]:
    """What a program takes from its state, and what it calls that."""
    words = [word for found in UNPACKED.finditer(text) for word in (*found["names"].split(","), found["of"] or "")]
    words += [found[1] for found in STATE.finditer(text)]
    return {plain for word in words if (plain := plain_name(word))}


def _has_rate(name: str, names: Mapping[str, str]) -> bool:
    """Whether a program has another name for the rate of this one."""
    return any(form.format(name) in names for form in RATE_WORDS)


def _entries(dotted: tuple[str, ...], names: Mapping[str, str]) -> tuple[str, ...]:
    """q_1 and q_2 in place of q, where the column of coordinates has the dots."""
    found: list[str] = []
    for written in dotted:
        plain = plain_name(written) or ""
        found += [names[plain + k] for k in "1234" if plain + "2" in names and plain + k in names] or [written]
    return tuple(dict.fromkeys(found))


def _plain(data: Mapping[str, Any]) -> Mapping[str, Any]:
    try:
        return plain_macros(plainly_printed(plain_environments(without_ticks(unwrapped(dict(data))))))
    except InvalidInput:
        return data


def _formulas(text: str) -> str:
    """What is marked as a formula, where something is; without words."""
    marked = [found[0] for found in MARKED.finditer(text)]
    text = "\n".join(marked) if marked else text
    text = BOLD.sub(" ", WORDS_INSIDE.sub(" ", text))
    return IN_BRACES.sub(r"{\1}", FONT.sub("", text))


def _apart(found: re.Match[str], *, is_code: bool) -> list[str]:
    """Letters side by side, m g l, are one name each where products have no signs."""
    base, index = found["base"], found["index"] or ""
    if not is_code and (
        base.lower() in STOP or (len(base) > 4 and base.isascii() and base.isalpha() and base not in GREEK_NAMES)
    ):
        return []
    if is_code or len(base) < 2 or base.startswith("\\") or base in GREEK_NAMES or base in FUNCTIONS or len(base) > 4:
        return [found[0]]
    return [*base[:-1], base[-1] + index]


def _dotted(text: str) -> tuple[str, ...]:
    names: dict[str, str] = {}
    text = normalize("NFD", text)
    for patterns in DOTTED:
        for pattern in patterns:
            for found in pattern.finditer(text):
                groups = found.groupdict()
                written = groups["base"] + (groups.get("in") or groups.get("out") or "")
                plain = plain_name(written)
                if plain and plain not in FUNCTIONS:
                    names.setdefault(plain, written)
    return tuple(names.values())
