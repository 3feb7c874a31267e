# ruff: noqa: E501 -- patterns stand on one line
r"""Several equations in one text, as pages print them: gather, cases, a brace before an array, \qquad, "and".

What names a term (\underbrace), numbers an equation or remarks on it (\text{…}) is taken away; a text that is then
several equations becomes as many rows. What can be cut in two ways is left as it is, for the reader to refuse.
"""

from __future__ import annotations

import re
from typing import Any

from ...models.errors import InvalidInput
from .lines import BLANKS, LONGEST_LINE

COMMENT = re.compile(r"(?<!\\)%[^\n]*")
NUMBERED = re.compile(r"\\(?:tag|label)\*?\s*\{[^{}]{0,60}\}|\\(?:nonumber|notag|displaystyle)(?![A-Za-z])")
NAMED = re.compile(
    r"\\(?P<which>underbrace|overbrace|underline|overline|textcolor\s*\{\w{1,20}\}|color\s*\{\w{1,20}\}\s*(?=\{))\s*(?=\{)"
)
SUM_SIGN = re.compile(r"[+−–-]")
SUM_BEFORE = re.compile(r"(?:^|[=+(&\[]|\\\\)(?:\s|\\[,;:! ])*$")
SUM_BEHIND = re.compile(r"(?:\s|\\[,;:! ])*(?:$|[-+−=)&,;.\]]|\\\\|\\end|\\q?quad)")
UNDER = re.compile(r"\s*[_^]\s*(?=\{)")
SO = r"\\(?:therefore|because|Rightarrow|implies|Longrightarrow|longrightarrow|Leftrightarrow|iff|to)(?![A-Za-z])"
LEADS = re.compile(
    rf"^(?P<before>(?:\s|&|\\[,;:! ]|\\q?quad(?![A-Za-z])|[∴⇒→])*)"
    rf"(?P<so>(?:(?:{SO}|[∴⇒→])(?:\s|\\[,;:! ]|\\q?quad(?![A-Za-z]))*)+)"
)
REMARK = re.compile(r"\\(?:text|textrm|textit|textbf|mbox|mathrm|intertext)\s*\{(?P<inner>[^{}$\\]{0,80})\}")
INDEX_BEFORE = re.compile(r"[_^]\s*$")
_GAP = r"(?:\s|\\[,;:! ]|&|\\q?quad(?![A-Za-z]))"
ROW_STARTS = re.compile(rf"(?:^|\\\\|\}}|⁂){_GAP}{{0,20}}$")
HEAD_ENDS = re.compile(r"\s{0,9}(?::|&|\\q?quad(?![A-Za-z]))")
APART = re.compile(rf"(?:[,;.&]|\\q?quad){_GAP}{{0,20}}$")
ROW_STOPS = re.compile(rf"{_GAP}{{0,20}}[.,;]?{_GAP}{{0,20}}(?:$|\\\\|\\end|\\q?quad)")
AND = re.compile(r"\s*(?:and|und|et|oraz|och|及び|および|と|,|;|&)\s*")
SYSTEM = re.compile(
    r"(?:\\left\s*(?:\\\{|\\lbrace|\.)\s*)?\\begin\s*\{(?P<of>cases|array|aligned|alignedat|gathered|split|matrix|align|gather)(?P<star>\*?)\}"
    r"(?:\s*\{[clr|@{}\s0-9]{0,20}\})?(?P<inner>.*?)\\end\s*\{(?P=of)(?P=star)\}(?:\s*\\right\s*(?:\.|\\\}|\\rbrace))?",
    re.DOTALL,
)
ROW_ENDS = re.compile(r"\\\\(?:\s*\[[^\[\]]{1,12}\])?")
BETWEEN = re.compile(r"[,;.]?\s*(?:\\q?quad(?![A-Za-z])\s*)+(?:[,;]\s*)?|[,;]\s+")
WIDE_AND_SIGN = re.compile(r"(?<![,;.\s])\s*&?\s*(?:\\q?quad(?![A-Za-z])\s*)+[+−–-]")
WORDS = re.compile(r"(?<=[\w)\]}'])\s*[,;]?\s+(?:and|und|et)\s+(?=[\w(\\θφϕψα])")
PLACEHOLDER = "⁂"  # stands for "and": in no formula
WHERE = re.compile(
    r"^(?:\s|\\[,; ]|\\q?quad)*(?:where|with|wobei|mit|où|avec|(?:for|für|pour)\b"
    r"|\\(?:text|mbox|textrm|mathrm)\s*\{\s*(?:where|with|wobei|mit|où|avec|ただし))"
)
CONTINUES = re.compile(
    r"^(?:\s|&|\{\}|\\[,;:! ]|\\q?quad(?![A-Za-z])|\\(?:left|right)\s*\.)*"
    r"(?:[+−–-]|\\(?:cdot|times)(?![A-Za-z])|=)"
)
BARE = re.compile(r"^(?:\s|\\[,; ]|&)*\\?[A-Za-zΔδα-ω]+(?:_?\{?\w{1,4}\}?)?\s*:?=")  # Δ = …
_D = r"(?:\\mathrm\s*\{\s*d\s*\}|\\rm d|d)"
_PARTIAL = r"(?:\\partial|∂)"
_TO_RATE = rf"[^=]{{0,40}}?{_PARTIAL}[^=]{{1,160}}?{_PARTIAL}[^=]{{1,80}}?"
_TO_COORDINATE = rf"[-−][^=]{{0,40}}?{_PARTIAL}[^=]{{1,80}}?{_PARTIAL}[^=+]{{1,60}}?="
LAGRANGE = re.compile(
    rf"^(?:\s|&|\$)*(?:\\[dt]?frac\s*\{{\s*{_D}\s*\}}\s*\{{\s*{_D}\s*t\s*\}}|d\s*/\s*dt)"
    rf"{_TO_RATE}{_TO_COORDINATE}(?=[^=]+=[^=]*$)"
)
BRACKETS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}
ARROW = re.compile(r"(?<=\S)\s*(?:->|→|:>|\\\[Rule\])\s*")
RULES = re.compile(r"^\s*\{+\s*(?P<inner>[^{}]*(?:->|→)[^{}]*)\}+\s*$", re.DOTALL)
LIST = re.compile(r"^\s*\{(?P<inner>[^{}]*==[^{}]*)\}\s*$", re.DOTALL)
TWO_EQUALS = re.compile(r"(?<![=<>!])==(?!=)")
BULLET = re.compile(r"(?m)^\s*[•▪‣◦]\s*")
DASHED = re.compile(r"^\s*[-−–][ \t]+(?!\*\*|[^\W\d_]{2,}[^=:\n]{0,40}[:：])[^$]*=[^$]*$")
SOLVED = re.compile(  # an acceleration alone on the left: no sign in front of it has a sense
    r"^\s*[-−–][ \t]+(?=(?:\\ddot\s*\{?\s*\\?[A-Za-z]+\s*\}?(?:_\{?\w{1,3}\}?)?|[^\W\d_]+(?:_?\w{1,3})?(?:''|″)|[^\W\d_]\u0308[₀-₉]?)\s*=)"
)
COUNTED = re.compile(r"(?m)^\s*\(?(?P<k>[0-9]{1,2})\)\s+(?=\S)")
# Behind a display, $$…$$ (1), it is within no formula
NUMBER = re.compile(
    r"(?:(?P<far>\s{2,}|\t|\\q?quad\s*|(?<=\$\$)\s*|(?<=\\\])\s*)|\s)\((?:[0-9]{1,3}(?:\.[0-9]{1,3})?[a-z]?)\)\s*$"
)
OPERATOR = re.compile(r"(?:[-+*/=^−·×(\[{]|\\(?:cdot|times|left\s*\())\s*$")  # what stands behind it is an operand
MODEL = re.compile(r"^\s*(?:partial\s+)?model\s+\w+.*?\bequation\b(?P<rows>.*?)\bend\s+\w+\s*;?\s*$", re.DOTALL)
# A matrix keeps the marks between its entries
IN_MATRIX_OR_MARK = re.compile(
    r"\\begin\s*\{(?P<of>[pbBvV]?(?:small)?matrix|array)\}.*?\\end\s*\{(?P=of)\}|&", re.DOTALL
)
BAR = re.compile(r"(?:[=+(−-]\s*|^\s*)(?:[-−–]\s+[-−–]|[-−–]{2,}|[—―_]{1,})(?:\s|$)")
MOST_ROWS = 16
MOST_NAMED = 60


def rows_of_blocks(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with a row for each equation of a text that has several."""
    made = dict(data)
    for name in ("equations", "solved"):
        table = data.get(name)
        if not isinstance(table, dict | list):
            continue
        entries = list(table.items()) if isinstance(table, dict) else [(str(k), x) for k, x in enumerate(table, 1)]
        if len(entries) > MOST_ROWS or not all(
            isinstance(line, str) and len(line) <= LONGEST_LINE for _, line in entries
        ):
            continue
        found = [(label, row) for label, line in entries for row in equations_in(line)]
        if len(found) == len(entries):
            made[name] = dict(found)
        elif len(found) <= MOST_ROWS:
            made[name] = {str(k): row for k, (_, row) in enumerate(found, 1)}
    return made


def equations_in(line: str) -> list[str]:
    """The equations of a text; the text as it stands where it is one, or where it may be cut in two ways."""
    if "Symbol(" in line or BLANKS.search(line):
        return [line]
    model = MODEL.match(line)
    if model:
        return [row.strip() for row in model["rows"].split(";") if row.strip()]
    if "───" in line or _is_drawn(line):
        raise InvalidInput(
            "column 1: an expression printed on several lines: write each fraction in one line, (a)/(b); sympy prints such "
            "lines by str(…), srepr(…) or latex(…)"
        )
    line = _without_dashes(line)
    rules = RULES.match(line)
    if rules:
        line = ARROW.sub(" = ", rules["inner"])
    listed = LIST.match(line)
    if listed and all(len(TWO_EQUALS.findall(part)) == 1 for part in _cut(listed["inner"], re.compile(","))):
        line = TWO_EQUALS.sub("= ", listed["inner"])
    if "\\" in line:
        line = _without_remarks(line)
        line = SYSTEM.sub(_of_system, line)
    line = BULLET.sub("", line)
    counted = [int(m["k"]) for m in COUNTED.finditer(line)]
    if len(counted) > 1 and counted == list(range(counted[0], counted[0] + len(counted))):
        line = COUNTED.sub("", line)
    elif counted and counted[0] > 1 and COUNTED.match(line):
        raise InvalidInput(f"({counted[0]}) in front: the number of the equation, or a factor? Leave it out, or write "
                           "* behind it")  # fmt: skip
    bare = LAGRANGE.sub(" ", _led(line))  # what stands behind its second sign is the row
    pieces = _pieces(bare)
    rows = [LAGRANGE.sub(" ", _led(piece)) for piece in pieces] if len(pieces) > 1 else [bare]
    return [_without_number(row) for row in rows]


def _without_dashes(text: str) -> str:
    """A list of solved rows without its marks. Raises InvalidInput where each mark may be a minus sign as well."""
    lines = [line for line in text.split("\n") if line.strip()]
    if len(lines) < 2 or not all(DASHED.match(line) for line in lines):
        return text
    solved = [SOLVED.match(line) for line in lines]
    if not all(solved):
        raise InvalidInput("a dash in front of every line: the mark of a list, or a minus sign? Leave the marks out, or "
                           "write the signs without a blank behind")  # fmt: skip
    return "\n".join(line[m.end() :] for line, m in zip(lines, solved, strict=True) if m)


def _is_drawn(text: str) -> bool:
    """Whether a fraction's bar may stand in a line, its top and bottom in the lines above and below."""
    lines = text.split("\n")
    bars = [k for k, line in enumerate(lines) if BAR.search(line)] if "\\" not in text else []
    return any(
        0 < k < len(lines) - 1 and all(lines[j].strip() and "=" not in lines[j] for j in (k - 1, k + 1)) for k in bars
    )


def _without_number(row: str) -> str:
    """The row without its number, (12), which stands apart behind it."""
    found = NUMBER.search(row)
    if found is None or "=" not in row or OPERATOR.search(row[: found.start()]):
        return row
    if not found["far"]:
        raise InvalidInput(f"{found[0].strip()} at the end: the number of the equation, or a factor? Leave it out, or "
                           "write * before it")  # fmt: skip
    return row[: found.start()]


def _without_remarks(line: str) -> str:
    line = COMMENT.sub("", line)
    line = unnamed(NUMBERED.sub(" ", line))

    def remark(found: re.Match[str]) -> str:
        inner, before, behind = found["inner"], line[: found.start()], line[found.end() :]
        if INDEX_BEFORE.search(before):
            return found[0]
        if AND.fullmatch(inner):
            return PLACEHOLDER
        # A word that stands apart, at an end of its row; any other may be a name, and a factor
        heads = ROW_STARTS.search(before) and (inner.rstrip().endswith(":") or HEAD_ENDS.match(behind))
        tails = APART.search(before) and ROW_STOPS.match(behind)
        is_word = (
            re.search(r"[^\W\d_]{3}|\(\d+\)|^\s*\([^\W\d_]{2,}[^()]*\)\s*$", inner)
            and "=" not in inner
            and not WHERE.match(found[0])
        )
        return " " if is_word and (heads or tails) else found[0]

    return REMARK.sub(remark, line)


def unnamed(line: str) -> str:
    r"""\underbrace{X}_{Y} as X."""
    for _ in range(MOST_NAMED):
        found = NAMED.search(line)
        end = _group_ends(line, found.end()) if found else -1
        if found is None or end < 0:
            return line
        if found["which"] == "overline" or found["which"] == "underline":  # may be part of a name
            return line
        name = UNDER.match(line, end)
        behind = _group_ends(line, name.end()) if name else end
        if behind < 0:
            return line
        inner = line[found.end() + 1 : end - 1]
        if len(_cut(re.sub(r"^\s*[+−–-]", "", inner), SUM_SIGN)) > 1 and not (
            SUM_BEFORE.search(line[: found.start()]) and SUM_BEHIND.match(line, behind)
        ):
            return line  # 2\\underbrace{a + b}: whether the brace binds as a bracket does is the author's secret
        line = f"{line[: found.start()]} {inner} {line[behind:]}"
    return line


def _group_ends(line: str, at: int) -> int:
    """Behind the brace that closes the one at ``at``; -1 where there is none."""
    depth = 0
    for place in range(at, len(line)):
        if line[place] in "{}" and line[place - 1 : place] != "\\":
            depth += 1 if line[place] == "{" else -1
            if depth == 0:
                return place + 1
    return -1


def _of_system(found: re.Match[str]) -> str:
    """A brace before equations is none of a matrix: its rows have an equals sign each."""
    rows = [row for row in ROW_ENDS.split(found["inner"]) if re.sub(r"[&\s]", "", row)]
    if len(rows) > 1 and all(row.count("=") == 1 for row in rows):
        return " \\\\ ".join(row.replace("&", " ") for row in rows)
    return found[0]


def _led(line: str) -> str:
    """Without "therefore" in front."""
    return LEADS.sub(lambda found: found["before"], line)


def _pieces(line: str) -> list[str]:
    """The equations; the line alone where that is not certain."""
    for cut in (_at_row_ends, _at_spaces, _at_words, _at_lines):
        pieces = cut(line)
        if len(pieces) > 1 and all(
            LAGRANGE.sub(" ", piece).count("=") == 1 and not WHERE.match(piece) for piece in pieces
        ):
            said = [BARE.match(piece) is not None for piece in pieces]
            return [line] if any(said) and not said[0] else pieces  # a row, and what a letter in it is
    return [line]


def all_pieces(line: str) -> list[str]:
    """The equations between row ends, wide blanks and line ends, what letters are among them; the line where unsure."""
    if "\\" in line:
        line = SYSTEM.sub(_of_system, _without_remarks(line))
    pieces = [piece for row in _at_row_ends(line) for piece in _at_spaces(row)] if "\\" in line else _at_lines(line)
    pieces = [piece for piece in pieces if piece.strip(" $.,;&\n")]
    sure = all(piece.count("=") == 1 and not WHERE.match(piece) for piece in pieces)
    return pieces if sure and len(pieces) > 1 else [line]


def _at_row_ends(line: str) -> list[str]:
    pieces = [re.sub(r"\\(?:begin|end)\s*\{(?:align|gather|eqnarray|equation|multline|aligned|gathered|split|cases"
                     r"|flalign|alignat)\*?\}"
                     r"(?:\{\d\})?", " ", piece) for piece in _cut(line, ROW_ENDS)]  # fmt: skip
    rows: list[str] = []
    for piece in (p for p in pieces if re.sub(r"[&\s.$]|\\[,;]", "", p)):
        # A row that goes on begins with a sign; the sides of an equals sign in two columns are eqnarray's
        if rows and CONTINUES.match(piece) and not _is_done(rows[-1]):
            rows[-1] += " " + re.sub(r"^((?:\s|&)*)", r"\1", piece)
        else:
            rows.append(piece)
    return [IN_MATRIX_OR_MARK.sub(lambda found: found[0] if found[0] != "&" else " ", row) for row in rows]


def _is_done(row: str) -> bool:
    """Whether a row has both its sides and a full stop."""
    return "=" in row and re.search(r"[,;.](?:\s|\\[,;:! ]|\$)*$", row) is not None


def _at_spaces(line: str) -> list[str]:
    if WIDE_AND_SIGN.search(line):
        return [line]  # a row that goes on behind a wide blank, or one that begins with a sign?
    return [piece for part in _cut(line, BETWEEN) for piece in part.split(PLACEHOLDER) if piece.strip(" $.,;")]


def _at_words(line: str) -> list[str]:
    return [piece for part in _cut(line, WORDS) for piece in part.split(PLACEHOLDER) if piece.strip(" $.,;")]


def _at_lines(line: str) -> list[str]:
    """Lines with an equation each; those that go on in the next have an open bracket or a sign there."""
    if "\\" in line:
        return [line]
    rows: list[str] = []
    for piece in _cut(line, re.compile(r"\n\s*|;\s*\n?")):
        if not piece.strip():
            continue
        if rows and (CONTINUES.match(piece) or re.search(r"[-+*/=]\s*$", rows[-1])):
            rows[-1] += " " + piece
        else:
            rows.append(piece)
    return rows


def _cut(line: str, separator: re.Pattern[str]) -> list[str]:
    """The parts between separators outside brackets and matrices."""
    depth, pieces, start, at = 0, [], 0, 0
    inside = re.compile(r"\\(?P<which>begin|end)\s*\{(?:[pbBvV]?(?:small)?matrix|array|cases)\}")
    while at < len(line):
        begun = inside.match(line, at)
        if begun:
            depth += 1 if begun["which"] == "begin" else -1
            at = begun.end()
            continue
        found = separator.match(line, at) if depth == 0 else None
        if found and found.end() > at:
            pieces.append(line[start:at])
            start = at = found.end()
            continue
        if line[at] == "\\" and line[at + 1 : at + 2] in ("{", "}", "\\"):
            at += 2
            continue
        depth += BRACKETS.get(line[at], 0)
        at += 1
    return [*pieces, line[start:]]
