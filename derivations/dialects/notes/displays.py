# ruff: noqa: E501 -- patterns stand on one line
r"""What a formula states: its equations, each as its sides, however they are laid out over lines and columns."""

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from ..blocks import unnamed

COMMENT = re.compile(r"(?<!\\)%[^\n]*")
ENDED = re.compile(r"\\tag\*?\s*\{[^{}]{0,60}\}")
LOST = re.compile(
    r"\\label\s*\{[^{}]{0,60}\}|\\(?:nonumber|notag|displaystyle|textstyle|centering|noindent|allowbreak|hfill|strut|mathstrut|limits|[bB]igg?[lrm]?)(?![A-Za-z])"
    r"|\\(?:[vh]?phantom|[vh]space\*?|color|rule|vspace)\s*\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}|\\color\s*\[\w*\]\s*\{[^{}]*\}|\{\}"
    r"|\\bf(?![A-Za-z])|\\(?:left|right)\s*\."
)
COLOURED = re.compile(
    r"\\(?:textcolor|colorbox|fcolorbox)\s*(?:\{[^{}]*\})+?\s*(?=\{)|\\(?:boxed|fbox|ensuremath|mathbox)\s*(?=\{)"
)
STRUCK = re.compile(r"\\x?b?cancel\s*\{")
OUTER = re.compile(
    r"\\(?:begin|end)\s*\{(?:equation|align|alignat|gather|eqnarray|multline|flalign|displaymath|dmath|math|aligned|alignedat|gathered|split|subequations)\*?\}(?:\s*\{\d\}|\[[tcb]\])?"
)
SYSTEM = re.compile(
    r"(?:\\left\s*(?:\\\{|\\lbrace|\.)|\\\{)?\s*\\begin\s*\{(?P<of>cases|dcases|rcases|array|matrix)\}(?:\s*\{[clr|@{}\s0-9]{0,20}\})?(?P<inner>.*?)\\end\s*\{(?P=of)\}(?:\s*\\right\s*(?:\.|\\\}|\\rbrace))?",
    re.DOTALL,
)
BRACED = re.compile(
    r"\\left\s*(?:\\\{|\\lbrace|\[|\.)\s*(?P<inner>\\begin\s*\{(?P<of>aligned|alignedat|gathered|split|align|gather)\*?\}.*?\\end\s*\{(?P=of)\*?\})(?:\s*\\right\s*(?:\.|\\\}|\\rbrace|\]))?",
    re.DOTALL,
)
ROW_END = re.compile(r"\\\\(?:\s*\[[^\[\]]{1,12}\])?|\\cr(?![A-Za-z])|\\newline(?![A-Za-z])")
LEADS = re.compile(
    r"\\(?:therefore|because|Rightarrow|implies|Longrightarrow|longrightarrow|Leftrightarrow|Longleftrightarrow|iff|leadsto|quad\\Rightarrow)(?![A-Za-z])|[∴⇒⇔⟹⟺→]"
)
WIDE = re.compile(r"\\q?quad(?![A-Za-z])|\\hspace\*?\{[^{}]*\}|\\enspace(?![A-Za-z])|[ \t]{6,}(?=\S)")
TEXT = re.compile(
    r"\\(?:text|textrm|textit|textbf|mbox|intertext|mathrm|rm|hbox|textnormal|shortintertext)\s*\{(?P<inner>[^{}$\\]{0,120})\}"
)
EQUALS = re.compile(
    r":=|==|\\coloneqq(?![A-Za-z])|\\equiv(?![A-Za-z])|\\triangleq(?![A-Za-z])|\\(?:overset|stackrel)\s*\{[^{}=]{0,30}\}\s*\{\s*=\s*\}|=:|=|≡|≔"
)
LABEL = re.compile(
    r"^[\s&]*(?:\(\s*[\w\\{}.' ]{1,14}\s*\)|\\text[a-z]*\s*\{[^{}]{1,60}\}|\\?[A-Za-z]{1,12}(?:_\{?\w{1,6}\}?)?|\d{1,2})\s*:(?!=)(?:[\s&]|\\q?quad(?![A-Za-z])|\\[,;:! ])*"
)
STARTS = re.compile(
    r"^(?:\s|&|~|\\[,;:! ]|\\q?quad(?![A-Za-z])|\\left\s*\.|\\right\s*\.)*(?P<sign>[+−–-]|\\(?:cdot|times|pm)(?![A-Za-z])|[*·×/])"
)
GOES_ON = re.compile(r"(?:[-+−–=*/·×]|\\(?:cdot|times)|\\left\s*[.(\[]|[(\[{])(?:\s|&|\\[,;:! ])*$")
STOPPED = re.compile(r"[,;.。，、](?:\s|\\[,;:! ]|~|\$|&)*$")
NUMBER = re.compile(r"(?:\s|\\[,;:! ])*\(\s*(?:\d{1,3}(?:\.\d{1,3})?[a-z]?|[ivx]{1,4}|\*+)\s*\)\s*$")
BLANK = re.compile(r"(?:\s|[&.,;~$]|\\[,;:! ]|\\q?quad(?![A-Za-z])|\\(?:left|right)\s*\.|\{\}|ㅤ|ㆍ)*")
_AND = r"(?:and|und|et|with|where|mit|wobei|dove|où|avec|con|donde|en donde|siendo|где|其中|ただし|ここで)"
NEXT = re.compile(
    rf"[,;]?\s+{_AND}[\s:,]+(?=\\?[A-Za-zα-ωΑ-Ω][^=,;]{{0,40}}?=)|[,;](?:\s|~|\\[,;:! ])+(?=\\?[A-Za-zα-ωΑ-Ω][^=;]{{0,40}}?=)"
    r"|[,;](?=(?:\\d?dot\s*)?\{?\\?[A-Za-zα-ωΑ-Ω]+(?:_\w|_\{\w{1,4}\})?\}?(?:_\w|_\{\w{1,4}\})?\s*=)"
)
MOST_PIECES = 60
END = "⁂"
Statement = tuple[str, ...]


def statements_of(formula: str) -> list[Statement]:
    """The equations of a formula, each as its sides. Raises InvalidInput where it can be cut in two ways."""
    text = _bare(formula)
    statements: list[Statement] = []
    for row in _rows(text):
        for part in _apart(LABEL.sub("", row, count=1) if "=" in row else row):
            sides = _sides(LABEL.sub("", part, count=1) if "=" in part else part)
            if len(sides) == 1 and _is_words(sides[0]):
                continue
            if sides[0] == "" and statements:  # = … of the row before
                statements[-1] = (*statements[-1], *sides[1:])
                continue
            statements.append(tuple(sides))
    return statements


def has_arrow(formula: str) -> bool:
    """Whether an arrow stands between two equations of one row."""
    rows = _rows(_bare(formula))
    # a law, of derivatives of the Lagrangian, is no premise: whether it is one is asked where it is read
    return any(
        len([p for p in cut(row, LEADS) if _equals(p) and "partial" not in p and "∂" not in p]) > 1 for row in rows
    )


def _bare(text: str) -> str:
    if STRUCK.search(text):
        raise InvalidInput("\\cancel: terms that are struck out; leave them out")
    text = COMMENT.sub("", text)
    text = unnamed(LOST.sub(" ", _uncovered(text)))
    text = ENDED.sub(f" {END} ", text)
    text = BRACED.sub(lambda m: m["inner"], text)
    for _ in range(4):
        made = SYSTEM.sub(_of_system, text)
        if made == text:
            break
        text = made
    text = re.sub(
        r"\\overrightarrow\s*\{[^{}]{1,12}(?:\{[^{}]{1,8}\})?[^{}]{0,4}\}\s*=\s*(?=\s*⁑)|\\vec\s*\{[^{}]{1,12}\}(?:_\w|_\{\w+\})?\s*=\s*(?=\s*⁑)"
        r"|(?:^|(?<=\n))\s*(?:\\d?dot\s*\{?\s*)?\{?\s*(?:\\(?:mathbf|boldsymbol|bm|vec|mathrm|underline)\s*\{?\s*)?[A-Za-z](?:_\w|_\{\w+\})?[\s}]{0,4}(?:\(t\)\s*)?&?\s*:?=\s*(?=\s*⁑)",
        " ",
        text,
    )
    text = text.replace("⁑", " ")
    text = OUTER.sub("\n", text)
    return TEXT.sub(_text, text)


def _uncovered(text: str) -> str:
    """Without boxes and colours; what is in them stays, as it is seen."""
    for _ in range(60):
        found = COLOURED.search(text)
        end = _group_ends(text, found.end()) if found else -1
        if found is None or end < 0:
            return text
        text = f"{text[: found.start()]} {text[found.end() + 1 : end - 1]} {text[end:]}"
    return text


def _group_ends(text: str, at: int) -> int:
    """Behind the brace that closes the one at ``at``; -1 where there is none."""
    depth = 0
    for place in range(at, len(text)):
        if text[place] in "{}" and text[place - 1 : place] != "\\":
            depth += 1 if text[place] == "{" else -1
            if depth == 0:
                return place + 1
    return -1


def _of_system(found: re.Match[str]) -> str:
    """A brace before equations: its rows, each with an equals sign, or going on in the next."""
    rows = [row for row in ROW_END.split(found["inner"]) if not BLANK.fullmatch(row)]
    if len(rows) < 2 or sum("=" in row for row in rows) < 2:
        return found[0]
    return " ⁑ " + " \\\\ ".join(row.replace("&", " ") for row in rows) + " \\\\ "


def _text(found: re.Match[str]) -> str:
    """A word in a formula, which stands apart or joins two equations; a name stays."""
    inner = found["inner"].strip()
    before = found.string[max(0, found.start() - 20) : found.start()]
    if re.search(r"[_^]\s*$", before) or re.search(r"\\d?dot\s*\{?\s*$", before):
        return found[0]
    if re.fullmatch(
        r"(?:and|und|et|y|e|och|oraz|with|where|mit|wobei|où|avec|con|en donde|donde|dove|где|и|及び|および|ただし|其中|or|oder|ou|,|;|&)[\s:,]*",
        inner,
    ):
        return " \\qquad "
    if re.fullmatch(r"\([^\W\d_]{2,}[^()=]*\)", inner):  # (Eq. 1), (de …): where it stands, or comes from
        return " \\qquad "
    if re.fullmatch(r"[\w ]{1,3}|cos|sin|tan|sgn|sign|diff|const|total|com|pendulum|wheel|cart|pole|rod|bob", inner):
        return found[0]
    if WORDS.search(inner) and "=" not in inner:
        return " \\qquad "
    return found[0]


# A letter, with dots, an index and a power: what stands in front of = in a list of equations
LETTER = re.compile(
    r"^\s*(?:\\d?dot\s*)?(?:\{\s*\\?[A-Za-z]+\s*(?:_\s*(?:\{\w{1,6}\}|\w))?\s*\}|\\?[A-Za-z]+)\s*(?:_\s*(?:\{\w{1,8}\}|\w))?\s*$"
)
WORDS = re.compile(r"[^\W\d_]{3,}|[\u3040-\u30ff\u4e00-\u9fff]")


def _is_words(side: str) -> bool:
    if BLANK.fullmatch(side.replace(END, " ")) or NUMBER.fullmatch(side):
        return True
    return (
        re.fullmatch(r"(?:[^\W\d_]|[\s,.:;()'’-])+", side) is not None
        and WORDS.search(side) is not None
        and not re.search(r"[θφϕψαω]|sin|cos", side)
    )


def _rows(text: str) -> list[str]:
    """The rows of a display; one that goes on in the next is joined with it."""
    separator = ROW_END if ROW_END.search(text) or "\\" in text else re.compile(r"\n|;\s*\n?")
    pieces = cut(text, separator)
    if "\\" in text and len(pieces) == 1:  # row ends in matrices are none of these rows
        pieces = _lines(text)
    pieces = [p for p in pieces if not BLANK.fullmatch(p.replace(END, " "))]
    if len(pieces) > MOST_PIECES:
        raise InvalidInput(f"more than {MOST_PIECES} lines in one formula; give the equations of motion alone")
    rows: list[str] = []
    for k, piece in enumerate(pieces):
        if not rows:
            rows.append(piece)
            continue
        before = rows[-1]
        has, had = bool(_equals(piece)), bool(_equals(before))
        signed = STARTS.match(piece) is not None
        if re.match(r"^(?:\s|&|\\[,;:! ])*(?:=|\\equiv)", piece):  # the row before, once more
            rows[-1] = f"{before} {piece}" if END not in before else before.replace(END, " ") + piece
        elif GOES_ON.search(before) or not had:
            rows[-1] = f"{before} {piece}"
        elif not has and signed and END not in before:
            after = pieces[k + 1] if k + 1 < len(pieces) else ""
            if re.search(r"=(?:\s|&|\\[,;:! ])*0(?:\s|[,;.&~]|\\[,;:! ])*$", before) or STOPPED.search(before):
                rows.append(piece)
            elif after and _equals(after) and STARTS.match(after) and "&" not in text:
                raise InvalidInput("a line that begins with a sign: is it the end of the row above, or the beginning of "
                                   "the next? Give each equation in one line")  # fmt: skip
            else:
                rows[-1] = f"{before} {piece}"
        else:
            rows.append(piece)
    apart = [column for row in rows for column in _columns(row)]
    return [re.sub(r"\s+", " ", _without_marks(row).replace(END, " ")) for row in apart]


def _lines(text: str) -> list[str]:
    r"""The lines of a text without \\\\, or what blank lines part, where each is an equation by itself; else the text."""
    for separator in (r"\n[ \t]*\n", r"\n"):
        lines = [line for line in cut(text, re.compile(separator)) if line.strip(" \t\n$")]
        if len(lines) > 1 and not any(GOES_ON.search(line) or STARTS.match(line) for line in lines):
            sides = [_sides(part) for line in lines for part in cut(line, WIDE) if part.strip()]
            if all(len(_equals(line)) == 1 for line in lines) or all(
                len(x) > 1 and LETTER.match(x[0]) and not LETTER.match(x[-1]) for x in sides
            ):
                return lines
    return [text]


def _columns(row: str) -> list[str]:
    """A &= B & C &= D: two equations side by side."""
    cells = cut(row, re.compile("&"))
    pairs = ["".join(cells[k : k + 2]) for k in range(0, len(cells), 2)]
    apart = len(pairs) > 1 and all(len(_equals(pair)) == 1 and not re.match(r"\s*=", pair) for pair in pairs)
    return pairs if apart and all(pair.strip() for pair in pairs) else [row]


def _equals(piece: str) -> list[int]:
    return [start for start, _ in _places(piece, EQUALS)]


IN_MATRIX_OR_MARK = re.compile(
    r"\\begin\s*\{(?P<of>[pbBvV]?(?:small)?matrix|array)\}.*?\\end\s*\{(?P=of)\}|&", re.DOTALL
)


def _without_marks(row: str) -> str:
    """Without what aligns columns; a matrix keeps its own."""
    return IN_MATRIX_OR_MARK.sub(lambda m: m[0] if m[0] != "&" else " ", row)


def _apart(row: str) -> list[str]:
    """Equations side by side: wide blanks, arrows, a comma before the next name and its equals sign."""
    parts: list[str] = []
    for lead in cut(row, LEADS):
        for piece in cut(lead, WIDE):
            if BLANK.fullmatch(piece) or NUMBER.fullmatch(piece):
                continue
            if (
                (parts and STARTS.match(piece) and not (_equals(piece) and _equals(parts[-1])))
                or (parts and GOES_ON.search(parts[-1]) and not STOPPED.search(parts[-1]))
                or (parts and not _equals(parts[-1]) and re.match(r"\s*=", piece))
                or (parts and re.match(r"\s*=", piece))
            ):
                parts[-1] += " " + piece
            elif parts and STARTS.match(piece) and not re.search(r"[,;.]\s*$", parts[-1]):
                raise InvalidInput(
                    "a wide blank before a sign: does the equation go on, or does another begin? Give each a row"
                )
            elif parts and not _equals(piece):
                _require_words(piece)
            else:
                parts.append(piece)
    return [p for part in parts for p in (cut(part, NEXT) if len(_equals(part)) > 1 else [part])]


def _require_words(piece: str) -> None:
    """Behind an equation, something without an equals sign: words, or a count of links."""
    if _is_words(piece) or re.fullmatch(r"[\s(,.]*(?:\\forall)?\s*[ij]\s*(?:\\in|∈).*", piece):
        return
    raise InvalidInput(f"{piece.strip()[:40]!r} stands beside an equation: give it a row, or leave it out")


def _sides(part: str) -> list[str]:
    part = re.sub(r"(?<!\\)[,;.:。，、：](?:\s|\\[,;:! ]|~|\$)*$", "", re.sub(r"(?<!\\)\s+$", "", part.lstrip()))
    sides, start = [], 0
    for at, end in _places(part, EQUALS):
        sides.append(part[start:at])
        start = end
    sides.append(part[start:])
    return [re.sub(r"^(?:\s|~|\\[,;:! ])+|(?:\s|~|\\[,;:! ])+$", "", side) for side in sides]


BRACKETS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}
INSIDE = re.compile(r"\\(?P<which>begin|end)\s*\{(?:[pbBvV]?(?:small)?matrix|array|cases)\}")


def _places(text: str, separator: re.Pattern[str]) -> list[tuple[int, int]]:
    """Where separators stand outside brackets and matrices."""
    depth, found, at = 0, [], 0
    while at < len(text):
        begun = INSIDE.match(text, at)
        if begun:
            depth += 1 if begun["which"] == "begin" else -1
            at = begun.end()
            continue
        match = separator.match(text, at) if depth <= 0 else None
        if match and match.end() > at:
            found.append((at, match.end()))
            at = match.end()
            continue
        if text[at] == "\\" and text[at + 1 : at + 2] in ("{", "}", "\\", "[", "]", "(", ")", ",", ";", "|"):
            at += 2
            continue
        side = re.compile(r"\\(?:left|right)\s*(?:\\[{}|]|[.|<>])").match(text, at)
        if side:
            at = side.end()
            continue
        depth += BRACKETS.get(text[at], 0)
        at += 1
    return found


def cut(text: str, separator: re.Pattern[str]) -> list[str]:
    """The parts between separators outside brackets and matrices."""
    parts, start = [], 0
    for at, end in _places(text, separator):
        parts.append(text[start:at])
        start = end
    return [*parts, text[start:]]
