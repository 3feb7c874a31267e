# ruff: noqa: E501 -- patterns stand on one line
r"""What a program's comment has around formulas: marks in front of lines, quotes of a docstring, Doxygen's \f[ … \f]."""

from __future__ import annotations

import re

COMMENT = re.compile(r"[ \t]*(?://[/!]?|#['!]?|%{1,3}|--|;{1,3}|!)(?=\s|$)")
MAIL = re.compile(r"[ \t]*>[ \t]?")
BLOCK = re.compile(r"^\s*/\*[*!]?(?P<inner>.*)\*/\s*$", re.DOTALL)
QUOTED = re.compile(r"^\s*(?:@doc\s+)?(?:raw|[rRuUfF])?(?P<q>\"\"\"|''')(?P<inner>.*?)(?P=q)\s*$", re.DOTALL)
BRACKETED = re.compile(
    r"^\s*(?:\(\*+|\{-[|]?|--\[\[|<!--|#=|%\{|/-[-!]?)(?P<inner>.*?)(?:\*+\)|-\}|\]\]|-->|=#|%\}|-/)\s*$", re.DOTALL
)
STARRED = re.compile(r"(?m)^[ \t]*\*(?=\s)")
DISPLAYED = re.compile(r"[\\@]f\[(?P<inner>.*?)[\\@]f\]", re.DOTALL)
INLINE = re.compile(r"[\\@]f\$(?P<a>[^$]*?)[\\@]f\$|[\\@]f\((?P<b>.*?)[\\@]f\)", re.DOTALL)
BRACED = re.compile(r"[\\@]f\{(?P<of>[A-Za-z]+\*?)\}\s*\{?(?P<inner>.*?)[\\@]f\}", re.DOTALL)
# What Doxygen, Javadoc and Sphinx say before a sentence, and no formula
TAG = re.compile(
    r"(?m)^[ \t]*[\\@](?:brief|details|note|remarks?|par|see|sa|file|class|param(?:\[\w+\])?|returns?)(?![A-Za-z])"
)


def uncommented(text: str) -> str:
    """The text without these; any other as it is."""
    for pattern in (BLOCK, QUOTED, BRACKETED):
        found = pattern.match(text)
        if found and not any(mark in found["inner"] for mark in ("*/", '"""', "'''")):
            text = STARRED.sub("", found["inner"]) if pattern is BLOCK else found["inner"]
            break
    else:
        text = _without_marks(text)
    return _of_doxygen(text)


def _without_marks(text: str) -> str:
    for _ in range(3):  # a quotation, of a mail or of Markdown
        said = [line for line in text.split("\n") if line.strip()]
        if not said or not all(MAIL.match(line) for line in said):
            break
        text = "\n".join(MAIL.sub("", line, count=1) for line in text.split("\n"))
    lines = text.split("\n")
    said = [line for line in lines if line.strip()]
    for mark in (COMMENT, STARRED):
        if said and all(mark.match(line) for line in said):
            return "\n".join(mark.sub("", line, count=1) for line in lines)
    return text


def _of_doxygen(text: str) -> str:
    if not re.search(r"[\\@]f[\[$({]", text):
        return text
    text = DISPLAYED.sub(lambda m: f"\n$${m['inner'].strip()}$$\n", text)
    text = BRACED.sub(lambda m: f"\n\\begin{{{m['of']}}}{m['inner']}\\end{{{m['of']}}}\n", text)
    text = INLINE.sub(lambda m: f"${(m['a'] or m['b'] or '').strip()}$", text)
    return TAG.sub("", text)
