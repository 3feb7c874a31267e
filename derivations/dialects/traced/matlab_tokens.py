# ruff: noqa: E501 -- patterns stand on one line
"""MATLAB's and Octave's text cut into tokens: what is a transpose and what a quote, where a matrix has its blanks."""

from __future__ import annotations

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.(?![*/^\\'])[0-9]*)?|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?)"
    r"|(?P<word>[^\W\d]\w*)"
    r"|(?P<sign>\.\*|\./|\.\^|\.\\|\.'|==|~=|!=|<=|>=|&&|\|\||\+=|-=|\*=|/=|[-+*/\\^()\[\]{},;:=<>@.~&|!'\"\n])"
)
BLOCK_REMARK = re.compile(r"(?ms)^[ \t]*[%#]\{[ \t]*$.*?^[ \t]*[%#]\}[ \t]*$")
SCILAB = re.compile(r"(?m)^[^%#'\"\n]*//")  # its remarks; in MATLAB two divisions stand side by side nowhere
SCILAB_BLOCK = re.compile(r"/\*(?:[^*]|\*(?!/)){0,2000}\*/")
MOST_TOKENS = 12_000


class NoMatlab(ValueError):
    """The text is none."""


@dataclass(frozen=True)
class Token:
    """``kind``: number, word, sign, text or end; ``gap``: a blank stands before it; ``after``: one stands behind."""

    kind: str
    text: str
    at: int
    gap: bool
    after: bool


def _past_blanks(text: str, at: int) -> tuple[int, bool]:
    """Where the next token begins, and whether a blank, or a line that goes on, stands before it."""
    start = at
    while at < len(text):
        if text[at] in " \t\r":
            at += 1
        elif text.startswith("...", at):
            end = text.find("\n", at)
            at = len(text) if end < 0 else end + 1
        else:
            break
    return at, at > start


def _of_scilab(text: str) -> str:
    """Scilab's remarks as MATLAB's, and %pi as pi. Raises NoMatlab for another number of its own, %e or %i."""
    text = re.sub(r"%pi(?!\w)", " pi", SCILAB_BLOCK.sub(" ", text))
    if any("%" in line.partition("//")[0] for line in text.split("\n")):
        raise NoMatlab
    return text.replace("//", "%%")


def tokens_of(text: str) -> list[Token]:  # noqa: PLR0912 -- one for each kind
    """The tokens, without remarks. Raises NoMatlab where the text is none."""
    text = BLOCK_REMARK.sub("", text)
    text = _of_scilab(text) if SCILAB.search(text) else text
    found: list[Token] = []
    opened: list[str] = []
    at = 0
    while at < len(text):
        at, gap = _past_blanks(text, at)
        if at >= len(text):
            break
        c = text[at]
        if c in "%#":
            end = text.find("\n", at)
            at = len(text) if end < 0 else end
            continue
        before = found[-1] if found else None
        is_turned = (
            c == "'" and before is not None and not (gap and opened and opened[-1] in "[{")
            and (before.kind in ("number", "word") or before.text in (")", "]", "}", "'", ".'")) and before.kind != "text"
        )  # fmt: skip
        if c in "'\"" and not is_turned:
            end = at + 1
            while end < len(text) and text[end] != "\n":
                if text[end] == c and text[end + 1 : end + 2] == c:
                    end += 2
                elif text[end] == c:
                    break
                else:
                    end += 1
            if end >= len(text) or text[end] != c:
                raise NoMatlab
            found.append(Token("text", text[at + 1 : end], at, gap, _past_blanks(text, end + 1)[1]))
            at = end + 1
            continue
        match = TOKEN.match(text, at)
        if match is None:
            raise NoMatlab
        kind = match.lastgroup or "sign"
        at = match.end()
        written = match[0]
        if written in ("(", "[", "{"):
            opened.append(written)
        elif written in (")", "]", "}") and opened:
            opened.pop()
        if written == "\n" and opened and opened[-1] == "(":
            continue
        found.append(Token(kind, written, match.start(), gap, _past_blanks(text, at)[1]))
        if len(found) > MOST_TOKENS:
            raise NoMatlab
    return [*found, Token("end", "", len(text), True, True)]
