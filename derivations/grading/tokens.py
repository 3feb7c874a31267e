"""Cuts a line of a derivation into tokens: plain ASCII, Unicode as it is typed, or LaTeX as a paper prints it.

Only the names of a pendulum's symbols, a few functions, numbers, brackets and signs are known; anything else ends in
an :class:`InvalidInput` with its column.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, NoReturn

from flint import fmpq

from ...models.errors import InvalidInput, nearest

LONGEST_LINE = 20_000  # characters; a chain of four rods needs about 1000
MOST_TOKENS = 12_000
LONGEST_NUMBER = 40  # digits
LARGEST_EXPONENT_OF_TEN = 40

Kind = Literal["number", "symbol", "function", "name", "operator", "open", "close", "fraction", "end"]


ZERO = fmpq(0)


@dataclass(frozen=True)
class Token:
    """One token; ``at`` is the column it starts in, counted from 0. ``index`` is a symbol's, from 1, or 0 for none."""

    kind: Kind
    text: str
    at: int
    index: int = 0
    value: fmpq = ZERO


def fail(at: int, message: str) -> NoReturn:
    """Raise InvalidInput with the column, counted from 1."""
    raise InvalidInput(f"column {at + 1}: {message}")


# Letters of the symbols: t angle, w rate, a acceleration, l, m, g, r density, I a rod's own inertia.
LETTERS = {
    "theta": "t", "t": "t", "θ": "t", "ϑ": "t", "\\theta": "t", "\\vartheta": "t",
    "omega": "w", "w": "w", "ω": "w", "\\omega": "w",
    "alpha": "a", "a": "a", "α": "a", "\\alpha": "a",
    "l": "l", "ℓ": "l", "\\ell": "l", "m": "m", "g": "g",
    "rho": "r", "ρ": "r", "\\rho": "r", "I": "I", "pi": "p", "π": "p", "\\pi": "p",
}  # fmt: skip
INDEXED = "twalmI"
FUNCTIONS = {"cos": "cos", "sin": "sin", "tan": "tan", "\\cos": "cos", "\\sin": "sin", "\\tan": "tan"}
FASTER = {"t": "w", "w": "a"}  # what a dot makes of a letter

SPACING = re.compile(
    r"(?:\s|\\[,;:!> ]|\\(?:left|right|[bB]igg?[lrm]?|quad|qquad|displaystyle|mathrm|rm|nonumber|limits)(?![A-Za-z])"
    r"|\\(?:begin|end)\{[A-Za-z]{1,20}\*?\}|\\(?:tag|label)\{[^{}]{0,40}\}|\\\\|\{\}|[&~$])+"
)
NUMBER = re.compile(r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
ANGLE = r"(?:\\theta|\\vartheta|theta|t|[θϑ]|\\omega|omega|w|ω)"
INDEX = r"(?:_?[0-9]+|_\s*\{\s*[0-9]+\s*\}|\{\s*[0-9]+\s*\}|_?[₀-₉]+)"
DOTTED = re.compile(
    rf"\\(?P<dots>d?dot)\s*(?:\{{\s*(?P<braced>{ANGLE})\s*(?P<inner>{INDEX})?\s*\}}|(?P<bare>{ANGLE}))"
    rf"\s*(?P<outer>{INDEX})?"
)
SYMBOL_INDEX = re.compile(rf"\s*(?P<index>{INDEX})")
COMMAND = re.compile(r"\\[A-Za-z]+")
WORD = re.compile(r"[A-Za-z]+")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)?")
FRACTIONS = {"½": (1, 2), "⅓": (1, 3), "⅔": (2, 3), "¼": (1, 4), "¾": (3, 4), "⅙": (1, 6), "⅚": (5, 6), "⅛": (1, 8)}
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
SUPERSCRIPT = re.compile("⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
OPERATORS = {
    "+": "+", "-": "-", "−": "-", "–": "-", "*": "*", "×": "*", "·": "*", "⋅": "*", "∙": "*", "/": "/", "÷": "/",
    "^": "^", "=": "=",
}  # fmt: skip
COMMAND_OPERATORS = {"\\cdot": "*", "\\times": "*", "\\div": "/"}
OPENING, CLOSING = {"(": ")", "[": "]", "{": "}"}, ")]}"
# Full-width characters, as a Japanese keyboard types them, stand for their ASCII twins, one for one.
FULL_WIDTH = {0xFF01 + i: 0x21 + i for i in range(94)} | {0x3000: 0x20}


def tokenize(line: str, names: frozenset[str] = frozenset()) -> list[Token]:
    """All tokens of a line, ending in one of kind ``end``. ``names`` are those that the file itself defines."""
    if len(line) > LONGEST_LINE:
        fail(LONGEST_LINE, f"the line is longer than {LONGEST_LINE} characters")
    line = line.translate(FULL_WIDTH)
    tokens: list[Token] = []
    at = 0
    while at < len(line):
        space = SPACING.match(line, at)
        if space:
            at = space.end()
            continue
        token, at = _next(line, at, names)
        tokens.append(token)
        if len(tokens) > MOST_TOKENS:
            fail(token.at, f"more than {MOST_TOKENS} symbols on one line")
    tokens.append(Token("end", "the end of the line", len(line)))
    return tokens


def _next(line: str, at: int, names: frozenset[str]) -> tuple[Token, int]:  # noqa: PLR0911 -- one for each kind
    c = line[at]
    if c in "0123456789" or (c == "." and NUMBER.match(line, at)):
        return _number(line, at)
    if c in FRACTIONS:
        return Token("number", c, at, value=fmpq(*FRACTIONS[c])), at + 1
    power = SUPERSCRIPT.match(line, at)
    if power:
        return Token("operator", "^" + power[0].translate(SUPERSCRIPTS), at), power.end()
    if line.startswith("**", at):
        return Token("operator", "^", at), at + 2
    if c in OPERATORS:
        return Token("operator", OPERATORS[c], at), at + 1
    if c in OPENING:
        return Token("open", c, at), at + 1
    if c in CLOSING:
        return Token("close", c, at), at + 1
    if c == "\\":
        return _command(line, at)
    return _word(line, at, names)


def _number(line: str, at: int) -> tuple[Token, int]:
    match = NUMBER.match(line, at)
    assert match is not None
    text = match[0]
    mantissa, _, exponent = text.lower().partition("e")
    if len(mantissa) > LONGEST_NUMBER or len(exponent) > 4 or abs(int(exponent or 0)) > LARGEST_EXPONENT_OF_TEN:
        fail(
            at,
            f"the number {text[:20]}… is too long; {LONGEST_NUMBER} digits and e±{LARGEST_EXPONENT_OF_TEN} are enough",
        )
    whole, _, decimals = mantissa.partition(".")
    shift = int(exponent or 0) - len(decimals)
    value = fmpq(int((whole + decimals) or "0")) * (fmpq(10**shift) if shift >= 0 else fmpq(1, 10**-shift))
    return Token("number", text, at, value=value), match.end()


def _command(line: str, at: int) -> tuple[Token, int]:  # noqa: PLR0911 -- one for each kind
    dotted = DOTTED.match(line, at)
    if dotted:
        return _dotted(at, dotted)
    if line[at + 1 : at + 2] in ("{", "}"):
        bracket = line[at + 1]
        return Token("open" if bracket == "{" else "close", bracket, at), at + 2
    match = COMMAND.match(line, at)
    if match is None:
        fail(at, "a backslash that starts no LaTeX command")
    command = match[0]
    if command in COMMAND_OPERATORS:
        return Token("operator", COMMAND_OPERATORS[command], at), match.end()
    if command in FUNCTIONS:
        return Token("function", FUNCTIONS[command], at), match.end()
    if command in ("\\frac", "\\tfrac", "\\dfrac"):
        return Token("fraction", command, at), match.end()
    if command in LETTERS:
        return _symbol(line, at, match.end(), LETTERS[command])
    known = [*COMMAND_OPERATORS, *FUNCTIONS, "\\frac", "\\dot", "\\ddot", *(k for k in LETTERS if k[0] == "\\")]
    return fail(at, f"the LaTeX command {command[:30]} is not known here{nearest(command, known)}")


def _dotted(at: int, match: re.Match[str]) -> tuple[Token, int]:
    letter = LETTERS[match["braced"] or match["bare"]]
    for _ in range(len(match["dots"]) - len("dot") + 1):
        if letter not in FASTER:
            fail(at, "a third time derivative; an equation of motion has none")
        letter = FASTER[letter]
    written = match["inner"] or match["outer"]
    if match["inner"] and match["outer"]:
        fail(at, "two indices on one symbol")
    return Token("symbol", letter, at, index=_index(written, at)), match.end()


def _index(text: str | None, at: int) -> int:
    if not text:
        return 0
    figures = re.sub(r"[_{}\s]", "", text).translate(SUBSCRIPTS)
    if len(figures) > 6:
        fail(at, f"the index {figures[:12]}… is too large")
    if int(figures) == 0:
        fail(at, "an index of 0; links are counted from 1")
    return int(figures)


def _symbol(line: str, at: int, end: int, letter: str) -> tuple[Token, int]:
    """A symbol whose letter ends at ``end``: combining dots, an index, and primes may follow."""
    while end < len(line) and line[end] in "\u0307\u0308":
        for _ in range(1 if line[end] == "\u0307" else 2):
            letter = _faster(letter, at)
        end += 1
    index = 0
    if letter in INDEXED:
        match = SYMBOL_INDEX.match(line, end)
        if match:
            index, end = _index(match["index"], at), match.end()
    while end < len(line) and line[end] in "'′″":
        for _ in range(2 if line[end] == "″" else 1):
            letter = _faster(letter, at)
        end += 1
    return Token("symbol", letter, at, index=index), end


def _faster(letter: str, at: int) -> str:
    if letter not in FASTER:
        fail(at, "a time derivative of something that is not an angle or a rate")
    return FASTER[letter]


def _word(line: str, at: int, names: frozenset[str]) -> tuple[Token, int]:
    name = NAME.match(line, at)
    if name and name[0] in names:
        return Token("name", name[0], at), name.end()
    # letters may stand side by side (m1gl1): the longest known word that the rest starts with is cut off
    for word in sorted((*LETTERS, *FUNCTIONS), key=len, reverse=True):
        if line.startswith(word, at) and word[0] != "\\":
            if word in FUNCTIONS:
                return Token("function", FUNCTIONS[word], at), at + len(word)
            return _symbol(line, at, at + len(word), LETTERS[word])
    shown = WORD.match(line, at)
    what = shown[0][:30] if shown else line[at]
    known = [w for w in (*LETTERS, *FUNCTIONS, *names) if w[0] != "\\"]
    return fail(
        at,
        f"{what!r} is not known here{nearest(what, known) if shown else ''}; "
        "known are t, w, a (angle, rate, acceleration), l, m, g, rho, cos, sin",
    )
