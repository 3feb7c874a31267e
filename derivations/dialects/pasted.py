"""What word processors and typesetters leave in a line: Word's linear form, Typst, decimal commas, LaTeX's remarks."""

from __future__ import annotations

import re

from .bracketed import padded
from .names import GREEK

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_LETTER = rf"(?:{_GREEK}|[A-Za-z]|[{''.join(GREEK.values())}])"
_INDEX = r"(?:_(?:\([0-9A-Za-z]{1,3}\)|\{\s*[0-9A-Za-z]{1,3}\s*\}|[0-9A-Za-z]))?"
INVISIBLE = str.maketrans(
    dict.fromkeys("\u2061\u2062\u2064\u200b\u200d\u2009\u202f\u00a0\ufeff", " ")
    | {"〖": "(", "〗": ")", "∕": "/", "⁄": "/", "∗": "*", "＊": "*"}
)
UNBRACED = re.compile(
    rf"\\(?:mathbf|boldsymbol|bm|vec|mathrm|mathit|pmb)\s*(?P<x>\\(?:{_GREEK})(?![A-Za-z])|(?<=\s)[A-Za-z](?![A-Za-z]))"
)
DOT_APART = re.compile("(?P<x>[^\\s\\W])(?P<blank>[ ]+)(?P<dots>[\u0307\u0308])")
TYPST_DOT = re.compile(
    rf"(?<![A-Za-z\\])(?:(?P<two>dot\.double|ddot|diaer)|dot)\(\s*(?P<x>{_LETTER}{_INDEX})\s*\)(?P<index>{_INDEX})"
)
DECIMAL_COMMA = re.compile(r"(?P<whole>(?<![0-9.])[0-9]+)\{,\}(?P<rest>[0-9]+)")
REMARK = re.compile(r"\\(?:nonumber|notag|allowbreak|hfill|medskip|strut|mathstrut|textstyle|noindent)(?![A-Za-z])")
SPACED = re.compile(
    r"\\(?:[vh]space|phantom|hphantom|vphantom|eqref|ref|cite)\*?\{[^{}]{0,40}\}|\\\\\[[^\[\]]{1,12}\]|\{\}"
)
NEGATIVE_SPACE = re.compile(r"\\!")
FONT = re.compile(r"\{\s*\\(?:bf|rm|it|cal|sf|boldsymbol)\s*(?P<x>\\?[A-Za-z]{1,8})\s*\}")
LETTERS = re.compile(
    r"\\(?:mathcal|mathscr|mathbb|mathbf|boldsymbol|bm|mathsf|vec|underline|mathfrak|pmb)\s*\{\s*(?P<x>\\?[A-Za-z]{1,8})\s*\}"
)


BRACED = re.compile(
    rf"(?P<before>\\(?:sin|cos|tan)\s*|(?<![A-Za-z_^\s}}])|(?<=\s))\{{\s*(?P<x>\\(?:{_GREEK})|[A-Za-z])\s*\}}(?=\s*_)"
)

DOT_IN_BRACES = re.compile(rf"\{{\s*(?P<x>\\d?dot\s*\{{\s*(?:\\(?:{_GREEK})|[A-Za-z])\s*\}})\s*\}}(?=\s*_)")


def pasted(line: str) -> str:
    """The line in the reader's notation."""
    line = DOT_APART.sub(lambda found: found["x"] + found["dots"] + found["blank"], line.translate(INVISIBLE))
    line = typst_dots(line)
    line = DECIMAL_COMMA.sub(lambda found: padded(f"{found['whole']}.{found['rest']}", found), line)
    line = REMARK.sub(lambda found: " " * len(found[0]), line)
    line = SPACED.sub(lambda found: ("\\\\" if found[0].startswith("\\\\") else "").ljust(len(found[0])), line)
    line = BRACED.sub(lambda found: f"{found['before']} {found['x']} ".ljust(len(found[0])), line)
    line = DOT_IN_BRACES.sub(lambda found: found["x"].rjust(len(found[0])), line)  # as Wikipedia writes
    line = NEGATIVE_SPACE.sub("  ", line)
    for pattern in (FONT, LETTERS, UNBRACED):
        line = pattern.sub(lambda found: f" {found['x']} ".rjust(len(found[0])), line)
    return line


def typst_dots(line: str) -> str:
    """dot.double(theta)_1 as theta_1''."""
    return TYPST_DOT.sub(_dotted, line)


def _dotted(found: re.Match[str]) -> str:
    index = (found["index"] or "").replace("(", "{").replace(")", "}")
    inner = found["x"].replace("(", "{").replace(")", "}")
    return padded(inner + index + ("''" if found["two"] else "'"), found)
