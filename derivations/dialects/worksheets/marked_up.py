"""What Markdown and reStructuredText set apart without dollar signs: titles, code in a sentence, blocks of it."""

from __future__ import annotations

import re

TICKED = re.compile(r"(?<![`$\\])(?P<ticks>`{1,2})(?![`$])(?P<inner>[^`\n]{1,400})(?P=ticks)(?![`$])")
BLOCK = re.compile(r"(?ms)^[ \t]*```[ \t]*(?:text|txt|plain|math)?[ \t]*\n(?P<inner>.*?)^[ \t]*```[ \t]*$")
NAMES = re.compile(
    r"[\[(]?\s*[^\W\d][\w'₀-₉\u0307\u0308]*(?:\s*[,;]\s*[^\W\d][\w'₀-₉\u0307\u0308]*)*\s*[\])]?(?:\^?T|ᵀ)?"
)
UNDERLINE = re.compile(r"(?m)^(?P<title>[ \t]*[^\W\d_][^\n=]*\n)[ \t]*={3,}[ \t]*$")
OVERLINE = re.compile(r"(?m)\A\s*={3,}[ \t]*\n(?=[^\n=]+\n[ \t]*={3,}[ \t]*$)")


def without_underlines(text: str) -> str:
    """Without the signs that make a line above them a title."""
    return UNDERLINE.sub(lambda m: m["title"], OVERLINE.sub("", text))


def from_code(text: str) -> str:
    """A text of Markdown with its formulas in dollar signs, of which some stood in backticks among words.

    Names alone in backticks are words, and so is a list of names, ``x = [theta, omega]``. A text without code in its
    sentences stays as it is.
    """
    found = TICKED.findall(BLOCK.sub(" ", text))
    if not found or any("\\" in inner for _, inner in found):
        return text
    if re.search(r"(?m)^[ \t]*```[ \t]*(?!text|txt|plain|math)[A-Za-z]", text):
        return text  # a block in a language is a program
    outside = TICKED.sub(" ", BLOCK.sub(" ", text))
    if len(re.findall(r"[^\W\d_]{3,}", outside)) < 2:
        return text  # rows alone
    blocks = [m["inner"] for m in BLOCK.finditer(text)]
    kept = [f"\n$$\n{inner}\n$$\n" if "=" in inner else "\n" for inner in blocks]
    text = BLOCK.sub("\0", text)
    text = TICKED.sub(_code, text)
    for block in kept:
        text = text.replace("\0", block, 1)
    return text


def _code(found: re.Match[str]) -> str:
    left, sign, right = found["inner"].partition("=")
    if not sign or (NAMES.fullmatch(left.strip()) and NAMES.fullmatch(right.strip()) and re.search("[,;]", right)):
        return " "
    return f"${found['inner'].strip()}$"
