"""Cuts a line of a derivation into tokens: plain ASCII, Unicode as it is typed, or LaTeX as a paper prints it.

Only the names of a pendulum's symbols, a few functions, numbers, brackets and signs are known; anything else ends in
an :class:`InvalidInput` with its column.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, NoReturn
from unicodedata import normalize

from flint import fmpq

from ...models.errors import InvalidInput, nearest
from ..dialects.lines import FULL_WIDTH, LONGEST_LINE
from ..dialects.names import GLYPHS, HIGH, LOWS, is_joined, plain_name, spelling, splits
from .spellings import plain
from .vocabulary import FUNCTIONS, Vocabulary

MOST_TOKENS = 12_000
LONGEST_NUMBER = 40  # digits
LARGEST_EXPONENT_OF_TEN = 40

Kind = Literal[
    "number", "symbol", "function", "name", "operator", "open", "close", "fraction", "separator", "matrix", "bar", "end"
]  # fmt: skip


ZERO = fmpq(0)


@dataclass(frozen=True)
class Token:
    """One token; ``at`` is the column it starts in, counted from 0. ``index`` is a symbol's, from 1, or 0 for none.

    ``less``: the index of what is subtracted, of an angle θ_AB = θ_A - θ_B; ``end``: the column behind the token.
    """

    kind: Kind
    text: str
    at: int
    index: int = 0
    value: fmpq = ZERO
    less: int = 0
    end: int = 0


def fail(at: int, message: str) -> NoReturn:
    """Raise InvalidInput with the column, counted from 1."""
    raise InvalidInput(f"column {at + 1}: {message}")


INDEXED = "twalmIcPD"
FASTER = {"t": "w", "w": "a", "P": "D"}  # what a dot makes of a letter

_SPACE = (
    r"\s|\\[,;:!>\s]|\\(?:left|right|[bB]igg?[lrm]?|quad|qquad|displaystyle|mathrm|rm|nonumber|limits)(?![A-Za-z])"
    r"|\\(?:tag|label)\{[^{}]{0,40}\}|\{\}|[~$]"
)
SPACING = re.compile(rf"(?:{_SPACE}|\\(?:begin|end)\{{(?!\w*matrix|array)[A-Za-z]{{1,20}}\*?\}}|\\\\|&)+")
IN_MATRIX = re.compile(rf"(?:{_SPACE})+")
MATRIX = re.compile(r"\\(?P<which>begin|end)\{(?P<name>[pbBv]?(?:small)?matrix|array)\}(?:\{[clr| ]{0,20}\})?")
SIGN = re.compile(r"\\?(?P<name>sgn|sign|abs|tanh)(?=\s*[({\\\[])")
SIGNS = re.compile(r"sgn|sign|abs|[|]|vert(?![A-Za-z])")
BARS = re.compile(r"\||\\[lr]?vert(?![A-Za-z])|\\mid(?![A-Za-z])")
OF_RATES = {"sgn": "sgn", "sign": "sgn", "abs": "abs"}
BY_TIME = re.compile(
    r"\\[dt]?frac\s*\{\s*(?:\\mathrm\s*)?\{?\s*d\s*\}?\s*\}\s*\{\s*(?:\\mathrm\s*)?\{?\s*d\s*\}?\s*t\s*\}"
    r"|(?<![A-Za-z\\])d\s*/\s*d\s*t(?![A-Za-z])|(?<![A-Za-z])(?:diff|Derivative)(?=\s*\()"
)
NUMBER = re.compile(r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
ANGLE = rf"(?:\\[A-Za-z]+|(?:var)?theta|omega|(?:var)?phi|psi|alpha|beta|gamma|th|[{''.join(GLYPHS)}]|[A-Za-z])"
INDEX = rf"(?:_?[0-9]+|_\s*\{{\s*[0-9A-Za-z]+\s*\}}|\{{\s*[0-9]+\s*\}}|_?[{LOWS}]+|_[A-Za-z])"
DOTTED = re.compile(
    rf"\\(?P<dots>d?dot)\s*(?:\{{\s*(?P<braced>{ANGLE})\s*(?P<inner>{INDEX})?\s*\}}|(?P<bare>{ANGLE}))"
    rf"\s*(?P<outer>{INDEX})?"
)
SYMBOL_INDEX = re.compile(rf"\s*(?P<index>{INDEX})")
LETTER_INDEX = re.compile(r"(?P<index>[A-Z]{1,2})(?![a-z])")
CENTRE = re.compile(
    r"(?:l|ℓ|\\ell)\s*(?:_\s*\{\s*c\s*,?\s*_?\s*(?P<braced>[0-9]{1,2})?\s*\}|_?c(?!os)_?(?P<bare>[0-9]{1,2}|[₀-₉]{1,2})?)"
)
PRIME = tuple("'′″")
PRIMES = re.compile("['′″]{1,2}")
DOTS = re.compile("[\u0307\u0308]{1,2}")
COMMAND = re.compile(r"\\[A-Za-z]+")
WORD = re.compile(r"[A-Za-z]+")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)?")
FRACTIONS = {"½": (1, 2), "⅓": (1, 3), "⅔": (2, 3), "¼": (1, 4), "¾": (3, 4), "⅙": (1, 6), "⅚": (5, 6), "⅛": (1, 8)}
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
SUPERSCRIPT = re.compile("⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
SUBSCRIPTS = str.maketrans(HIGH)
WITH_INDEX = re.compile(rf"\s*_|[0-9{LOWS}]")
OPERATORS = {
    "+": "+", "-": "-", "−": "-", "–": "-", "*": "*", "×": "*", "·": "*", "⋅": "*", "∙": "*", "/": "/", "÷": "/",
    "^": "^", "=": "=", "@": "*", "⧵": "left",
}  # fmt: skip
ADVICE = {  # what to write in place of LaTeX that stands for more than one line can say
    "\\sum": "write the sum out, a term for each link",
    "\\prod": "write the product out, a factor for each link",
    "\\int": "write what the integral comes to",
    "\\partial": 'write what the derivative comes to, or give lagrangian = "…" in place of its equations',
    "\\nabla": "write what the gradient comes to",
    "\\approx": "write an equation with =",
    "\\Rightarrow": "give one equation a row",
    "\\implies": "give one equation a row",
}
COMMAND_OPERATORS = {"\\cdot": "*", "\\times": "*", "\\div": "/", "\\over": "over"}
OPENING, CLOSING = {"(": ")", "[": "]", "{": "}"}, ")]}"


def tokenize(line: str, names: frozenset[str] = frozenset(), words: Vocabulary | None = None) -> list[Token]:
    """All tokens of a line, ending in one of kind ``end``. ``names`` are those that the file itself defines."""
    if len(line) > LONGEST_LINE:
        fail(LONGEST_LINE, f"the line is longer than {LONGEST_LINE} characters")
    return _Tokenizer(plain(_decomposed(line.translate(FULL_WIDTH)), names), names, words or Vocabulary()).all()


def _decomposed(line: str) -> str:
    """ẋ and ẍ, which are one character, as a letter and its dots."""
    return re.sub("[ẋẍẏÿṙṡż]", lambda found: normalize("NFD", found[0]), line)


class _Tokenizer:
    def __init__(self, line: str, names: frozenset[str], words: Vocabulary) -> None:
        self.line, self.names, self.words = line, names, words
        self.matrices: list[str] = []  # the environments that are open
        plain_names = frozenset(plain_name(name) or name for name in names)
        self.apart = words.apart | {n for n in names if not is_joined(n) and splits(plain_name(n) or n, plain_names)}
        self.own = [(name, spelling(plain_name(name) or name, name not in self.apart)) for name in sorted(names)]

    def all(self) -> list[Token]:
        line, tokens, at = self.line, [], 0
        while at < len(line):
            space = (IN_MATRIX if self.matrices else SPACING).match(line, at)
            if space:
                at = space.end()
                continue
            token, end = self.next(at)
            tokens.append(Token(token.kind, token.text, at, token.index, token.value, token.less, end))
            at = end
            if len(tokens) > MOST_TOKENS:
                fail(token.at, f"more than {MOST_TOKENS} symbols on one line")
        tokens.append(Token("end", "the end of the line", len(line), end=len(line)))
        return tokens

    def next(self, at: int) -> tuple[Token, int]:  # noqa: PLR0911 -- one for each kind
        line, c = self.line, self.line[at]
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
        if c in ",;&":
            return Token("separator", c, at), at + 1
        bar = BARS.match(line, at)
        if bar:
            return Token("bar", "|", at), bar.end()
        of_rates = self.of_rates(at)
        if of_rates:
            return of_rates
        by_time = BY_TIME.match(line, at)
        if by_time and c not in self.names:
            return Token(
                "function", "d/dt" if "d" in by_time[0][:-4] or "/" in by_time[0] else "diff", at
            ), by_time.end()
        if c == "\\":
            return self.command(at)
        return self.word(at)

    def command(self, at: int) -> tuple[Token, int]:  # noqa: PLR0911, PLR0912 -- one for each kind
        line = self.line
        matrix = MATRIX.match(line, at)
        if matrix:
            return self.matrix(at, matrix)
        if line.startswith("\\\\", at):
            return Token("separator", "\\\\", at), at + 2
        dotted = DOTTED.match(line, at)
        if dotted:
            return self.dotted(at, dotted)
        if line[at + 1 : at + 2] in ("{", "}"):
            bracket = line[at + 1]
            return Token("open" if bracket == "{" else "close", bracket, at), at + 2
        match = COMMAND.match(line, at)
        if match is None:
            fail(at, "a backslash that starts no LaTeX command")
        command = match[0]
        own = self.declared(at)
        if own:
            return own
        if command in COMMAND_OPERATORS:
            return Token("operator", COMMAND_OPERATORS[command], at), match.end()
        if command in FUNCTIONS:
            return Token("function", FUNCTIONS[command], at), match.end()
        if command in ("\\frac", "\\tfrac", "\\dfrac"):
            return Token("fraction", command, at), match.end()
        if command == "\\ell" and not self.words.declared and CENTRE.match(line, at):
            return self.word(at)
        if self.words.kind(command):
            return self.symbol(at, match.end(), command)
        if command in ADVICE:
            fail(at, f"{command} is not read; {ADVICE[command]}")
        if self.words.declared:
            fail(at, f"{command[:30]} is not known here; {self.declared_names()}")
        known = [*COMMAND_OPERATORS, *FUNCTIONS, "\\frac", "\\dot", "\\ddot", "\\begin{bmatrix}"]
        known += [k for k in self.words.letters if k[0] == "\\"]
        return fail(
            at,
            f"the LaTeX command {command[:30]} is not known here{nearest(command, known)}; "
            f"say what it is, as in [define] '{command[:20]}' = \"…\"",
        )

    def declared_names(self) -> str:
        """What is known where a file declares its mechanism, and what may be missing there."""
        words = {*self.names, *self.words.fixed, *self.words.numbers} - {"pi"}
        own = ", ".join(sorted(w for w in words if w.isascii() and w[0] != "\\")[:24])
        return (
            f"known are {own} of [[bodies]] and [define], their rates, cos and sin. Say in [define] what it is, or "
            "which body has it; ropes, closed loops, turning frames and springs between two bodies cannot be declared"
        )

    def matrix(self, at: int, found: re.Match[str]) -> tuple[Token, int]:
        name = found["name"]
        if found["which"] == "begin":
            self.matrices.append(name)
            return Token("matrix", name, at), found.end()
        if not self.matrices or self.matrices.pop() != name:
            fail(at, f"{found[0][:30]} was never begun")
        return Token("close", found[0], at), found.end()

    def dotted(self, at: int, match: re.Match[str]) -> tuple[Token, int]:
        word = match["braced"] or match["bare"]
        own = self.rate_of_own(at, match)
        if own:
            return own
        letter = self.words.kind(word)
        if letter is None:
            fail(at, f"the dot stands over {word}, which is not known as an angle here")
        for _ in range(len(match["dots"]) - len("dot") + 1):
            if letter not in FASTER:
                fail(at, "a third time derivative; an equation of motion has none")
            letter = FASTER[letter]
        written = match["inner"] or match["outer"]
        if match["inner"] and match["outer"]:
            fail(at, "two indices on one symbol")
        end = match.end()
        index, less = self.numbered(word, written, at)
        if word in self.words.fixed:
            if written:
                fail(at, f"{word} has no index where the mechanism is declared")
            index = self.words.fixed[word][1]
        return Token("symbol", letter, at, index=index, less=less), end

    def rate_of_own(self, at: int, match: re.Match[str]) -> tuple[Token, int] | None:
        """A dot over a name that the file defines, as over x_2 where x_2 is a rate; ``index``: how many dots."""
        written = match["inner"] or match["outer"] or ""
        short = plain_name((match["braced"] or match["bare"]) + written)
        found = next((name for name in self.names if (plain_name(name) or name) == short), None)
        if found is None:
            return None
        return Token("name", found, at, index=len(match["dots"]) - 2), match.end()

    def numbered(self, word: str, written: str | None, at: int) -> tuple[int, int]:
        """The place of the coordinate that a word with this index is, and of the one subtracted, or 0."""
        numbers = self.words.numbers.get(word)
        if numbers is None:
            return self.index(written, at)
        figures = re.sub(r"[_{},\s]", "", written or "").translate(SUBSCRIPTS)
        if not figures and not self.words.fixed:
            return 0, 0  # a column of all coordinates' rates, or an index forgotten
        if figures not in numbers:
            fail(at, f"{word}{figures[:12]} is no coordinate here")
        return numbers[figures], 0

    def index(self, text: str | None, at: int) -> tuple[int, int]:
        """A link's number, and that of the link whose symbol is subtracted (θ_AB), or 0."""
        if not text:
            return 0, 0
        figures = re.sub(r"[_{}\s]", "", text).translate(SUBSCRIPTS)
        letters = self.words.indices
        if figures.isalpha() and letters:
            if len(figures) > 2 or any(c not in letters for c in figures):
                fail(at, f"the index {figures[:12]} is not a link's; links are counted by {', '.join(letters)} here")
            return letters[figures[0]], letters[figures[1]] if len(figures) == 2 else 0
        if not figures.isdigit():
            fail(at, f"the index {figures[:12]} is not a number; links are counted 1, 2, …, or by one letter each")
        if len(figures) > 6:
            fail(at, f"the index {figures[:12]}… is too large")
        if int(figures) == 0:
            fail(at, "an index of 0; links are counted from 1")
        return int(figures), 0

    def symbol(self, at: int, end: int, word: str) -> tuple[Token, int]:
        """A symbol whose letter ends at ``end``: combining dots, an index, and primes may follow."""
        line, letter = self.line, self.words.kind(word)
        assert letter is not None
        while end < len(line) and line[end] in "\u0307\u0308":
            for _ in range(1 if line[end] == "\u0307" else 2):
                letter = _faster(letter, at)
            end += 1
        index, less = (self.words.fixed[word][1], 0) if word in self.words.fixed else (0, 0)
        if index and self.words.declared and WITH_INDEX.match(line, end):
            fail(at, f"{word} has no index where the mechanism is declared")
        if letter in INDEXED and not index:
            match = SYMBOL_INDEX.match(line, end)
            if match is None and self.words.indices and (word[0] == "\\" or not word.isascii() or len(word) > 1):
                match = LETTER_INDEX.match(line, end)
            elif match is None and self.words.indices and letter in "lmI":
                match = LETTER_INDEX.match(line, end)
                match = match if match and match["index"] in self.words.indices else None
            if match or word in self.words.numbers:
                index, less = self.numbered(word, match["index"] if match else "", at)
                end = match.end() if match else end
        while end < len(line) and line[end] in "'′″":
            for _ in range(2 if line[end] == "″" else 1):
                letter = _faster(letter, at)
            end += 1
        return Token("symbol", letter, at, index=index, less=less), end

    def declared(self, at: int, longer: int = 0) -> tuple[Token, int] | None:
        """The longest of the author's own names that stands here, if it is longer than ``longer``."""
        best, end = "", at + longer
        dots = DOTS.match(self.line, at + 1)  # ω̇₁, where the author says what ω₁ is
        over = dots[0] if dots and self.words.kind(self.line[at]) is None else ""
        line = self.line[: at + 1] + self.line[at + 1 + len(over) :]
        for name, pattern in self.own:
            found = pattern.match(line, at)
            if found and found.end() + len(over) > end:
                best, end = name, found.end() + len(over)
        if not best:
            return None
        primes = PRIMES.match(self.line, end)
        count = sum(2 if c == "″" else 1 for c in primes[0]) if primes else 0
        count += sum(1 if c == "\u0307" else 2 for c in over)
        return Token("name", best, at, index=count), end + (len(primes[0]) if primes else 0)

    def of_rates(self, at: int) -> tuple[Token, int] | None:
        """sgn, sign or abs, unless the author calls something else so."""
        found = SIGN.match(self.line, at)
        if found is None or found["name"] in self.names:
            return None
        if found["name"] == "tanh":
            fail(at, "tanh of a rate, as of smoothed friction, is not read; dry friction is: sgn(x'), with "
                     'friction = "F" where the mechanism is declared')  # fmt: skip
        return Token("function", OF_RATES[found["name"]], at), found.end()

    def word(self, at: int) -> tuple[Token, int]:
        line, names = self.line, self.names
        name = NAME.match(line, at)
        if name and name[0] in names and name[0] not in self.apart and line[name.end() : name.end() + 1] not in PRIME:
            return self.declared(at, len(name[0])) or (Token("name", name[0], at), name.end())
        word = next((w for w in self.words.words if line.startswith(w, at)), "")
        # names of the author may stand side by side, mgl, and before functions: the longest that fits is cut off
        least = len(word) if word in FUNCTIONS else max(len(word) - 1, 0)  # theta, where the coordinate is theta_1
        own = self.declared(at, least)
        if own:
            return own
        centre = None if self.words.declared else CENTRE.match(line, at)
        if centre:
            index, _ = self.index(centre["braced"] or centre["bare"], at)
            return Token("symbol", "c", at, index=index), centre.end()
        # letters may stand side by side (m1gl1): the longest known word that the rest starts with is cut off
        if word:
            if word in self.words.doubtful:
                fail(at, self.words.doubtful[word])
            if word in FUNCTIONS:
                return Token("function", FUNCTIONS[word], at), at + len(word)
            return self.symbol(at, at + len(word), word)
        shown = WORD.match(line, at)
        what = shown[0][:30] if shown else line[at]
        known = [*self.words.words, *names]
        if self.words.declared:
            fail(at, f"{what!r} is not known here{nearest(what, known) if shown else ''}; {self.declared_names()}")
        return fail(
            at,
            f"{what!r} is not known here{nearest(what, known) if shown else ''}; "
            "known are t, w, a (angle, rate, acceleration), l, m, g, rho, cos, sin, "
            f'and what the file says itself, as in [define] {what[:12]} = "…"',
        )


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


def _faster(letter: str, at: int) -> str:
    if letter not in FASTER:
        fail(at, "a time derivative of something that is not an angle or a rate")
    return FASTER[letter]
