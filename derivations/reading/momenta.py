"""Variables of an author's own that have derivatives: momenta, and letters that stand for rates.

``p_{\\theta_1}``, ``p_θ1``, ``p_x`` and ``p_1`` are one momentum; ``\\dot p_1``, ``dp_1/dt`` and ``p1_dot`` its
derivative. What is written in several characters is put into fewer, padded with blanks, so that a column stays the
column of what the author wrote.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from unicodedata import normalize

from ...models.errors import InvalidInput
from ..dialects.lines import LONGEST_LINE
from ..dialects.names import GREEK
from ..dialects.srepr import from_srepr
from .layout import laid_out
from .spellings import OF_TIME, D
from .vocabulary import Vocabulary

Kind = str  # "momentum": a variable of its own; "rate": the rate of the coordinate with its index
Coordinate = tuple[str, str]  # letter or word, and index
_INDEX = r"(?:\s*_\s*\{\s*[0-9]\s*\}|_?[0-9]|[₁-₉])?"
BEFORE = r"(?<![A-Zabce-z\\])(?<![A-Za-z]d)"  # no letter but the d of dp/dt
PRIMES = r"(?P<primes>['′]*)"
_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_ANY = r"(?:\s*_?\s*\{(?:[^{}]|\{[^{}]{0,20}\}){1,40}\}|_\\?[A-Za-z]+_?[0-9]?|_?[0-9]|[θϑφϕψ][₁-₉]?)?"
DERIVED = (  # a letter that has a derivative
    rf"(?<![A-Za-z\\])d\s*(?P<x>[pP]){_ANY}\s*/\s*dt(?![A-Za-z])",
    rf"(?<![A-Za-z\\])(?P<x>[pP]){_ANY}['′](?!['′])",
    "(?P<x>[A-Za-z])\u0307",
    r"\\dot\s*\{?\s*(?P<x>[A-Za-z])(?![A-Za-z])",
    r"(?<![A-Za-z\\])(?P<x>[A-Za-z])(?:_?[0-9])?_?dot(?![A-Za-z])",
    rf"(?<![A-Za-z\\])d\s*(?P<x>[A-Za-z]){_INDEX}\s*/\s*dt(?![A-Za-z])",
    rf"\\[dt]?frac\s*\{{\s*{D}\s*(?P<x>[A-Za-z])(?![A-Za-z])[^{{}}]{{0,12}}(?:\{{[^{{}}]{{0,12}}\}})?\s*\}}\s*\{{\s*{D}\s*t",
    rf"(?<![A-Za-z\\])(?P<x>[A-Za-z]){_INDEX}['′](?!['′])",
)
DERIVED_LETTER = tuple(re.compile(rule) for rule in DERIVED)
RATES = re.compile(
    rf"\\dot\s*\{{?\s*\\?(?:{_GREEK})|[{''.join(GREEK.values())}]\S{{0,3}}['′\u0307]|(?:{_GREEK})\S{{0,4}}(?:['′]|_?dot)"
    rf"|d\s*\\?(?:{_GREEK})|\\frac\s*\{{\s*{D}\s*\\(?:{_GREEK})"
)
NOT_NEW = frozenset("atwlmgqIdLMJG")  # letters that mean something already, or never a variable


@dataclass(frozen=True)
class Variable:
    """The letter, what it is, and the coordinates by name (empty where they are θ₁ … θₙ, or whatever letter)."""

    letter: str
    kind: Kind
    links: int
    coordinates: tuple[Coordinate, ...] = ()

    def rewritten(self, line: str) -> str:
        """The line with an index for each coordinate that is named, and a prime for each derivative."""
        if len(line) > LONGEST_LINE:
            return line
        line = line.replace("ṗ", "p\u0307").replace("Ṗ", "P\u0307")
        for pattern, k in self._named:
            line = pattern.sub(partial(self._numbered, k), line)
        line = re.sub(rf"(?<![A-Za-z\\])(?P<x>{self.letter}{_INDEX})\s*{OF_TIME}",
                      lambda found: found["x"].ljust(len(found[0])), line)  # fmt: skip
        for pattern in self._derivatives:
            line = pattern.sub(lambda found: (found["x"].strip() + "'").ljust(len(found[0])), line)
        return line

    def _numbered(self, k: int, found: re.Match[str]) -> str:
        return f"{found['head']}{k}{found['primes']}".ljust(len(found[0]))

    @cached_property
    def _named(self) -> list[tuple[re.Pattern[str], int]]:
        out = []
        start = rf"(?P<head>\\dot\s*\{{\s*{self.letter}\s*\}}|{BEFORE}{self.letter}\u0307?)"
        for k in range(1, self.links + 1):
            base, index = self.coordinates[k - 1] if self.coordinates else ("", str(k))
            low = rf"\s*_?\s*(?:\{{\s*{index}\s*\}}|{index}(?![0-9]))" if index else ""
            if base and base not in GREEK:
                names = [rf"{re.escape(base)}{low}"]
            else:
                one = base or _GREEK
                glyphs = GREEK[base] if base else "".join(GREEK.values())
                low = (rf"(?:{low}|" + "₀₁₂₃₄₅₆₇₈₉"[int(index)] + ")") if index.isdigit() and len(index) == 1 else low
                names = [rf"\\?(?:var)?(?:{one}){low}", rf"[{glyphs}]{low}"]
                if not index or self.links == 1:
                    names += [rf"\\?(?:var)?(?:{one})", rf"[{glyphs}]"]
            for name in names:
                out.append((rf"{start}\s*_\s*(?:\{{\s*{name}\s*\}}|{name}(?![A-Za-z])){PRIMES}", k))
                if base in GREEK or not base:
                    out.append((rf"{start}{name}(?![A-Za-z]){PRIMES}", k))
        return [(re.compile(pattern), k) for pattern, k in out]

    @cached_property
    def _derivatives(self) -> list[re.Pattern[str]]:
        x = rf"(?P<x>{self.letter}{_INDEX})\s*"
        rules = [
            rf"(?:Derivative|diff)\(\s*{x},\s*t\s*\)",
            rf"\\[dt]?frac\s*\{{\s*{D}\s*{x}\}}\s*\{{\s*{D}\s*t\s*\}}",
            rf"\\[dt]?frac\s*\{{\s*{D}\s*\}}\s*\{{\s*{D}\s*t\s*\}}\s*{x}",
            rf"(?<![A-Za-z]){D}\s*{x}/\s*{D}\s*t(?![A-Za-z])",
            rf"(?<![A-Za-z\\]){x}_?dot(?![A-Za-z0-9])",
            rf"(?<![A-Za-z\\])(?:d|dot_?){x}(?![A-Za-z0-9(])",
            rf"(?<![A-Za-z\\])(?P<x>{self.letter})_?dot_?(?P<i>[0-9])(?![A-Za-z0-9])",
        ]
        return [re.compile(rule) for rule in rules]


def has_momenta(data: Mapping[str, object]) -> bool:
    """Whether a file says that it has momenta."""
    return "hamiltonian" in data or "momenta" in data


def with_variable(words: Vocabulary, letter: Variable | None) -> Vocabulary:
    """The words, and the variable among them."""
    if letter is None:
        return words
    kind, meaning = ("P", "momentum") if letter.kind == "momentum" else ("w", "rate of the angle")
    return replace(words, letters={**words.letters, letter.letter: kind}, said=(*words.said, (letter.letter, meaning)))


def variable(
    texts: Sequence[str], links: int, *, momenta: bool, coordinates: tuple[Coordinate, ...] = (),
    taken: frozenset[str] = frozenset(),
) -> Variable | None:  # fmt: skip
    """The letter of these lines that has derivatives and means nothing yet; None where there is none.

    ``momenta``: the file says that it has momenta, so that p is one whatever stands there; ``taken``: names in use.
    """
    lines = [normalize("NFD", laid_out(from_srepr(line))) for line in texts if len(line) <= LONGEST_LINE]
    found: dict[str, None] = {}
    for line in lines:
        for pattern in DERIVED_LETTER:
            found |= dict.fromkeys(match["x"] for match in pattern.finditer(line))
    letters = [x for x in found if x not in NOT_NEW and x not in taken]
    if momenta:
        letters = [x for x in letters if x in "pP"] or [_momentum(lines, taken)]
    if not letters:
        return None
    if len(letters) > 1:
        raise InvalidInput(f"{' and '.join(letters)} both have derivatives; one letter for all momenta is needed")
    (letter,) = letters
    rates = any(RATES.search(line) for line in lines)
    kind = "momentum" if momenta or rates or letter in "pP" else "rate"
    _require_order(letter, links, coordinates, lines)
    return Variable(letter, kind, links, coordinates)


def _momentum(lines: Sequence[str], taken: frozenset[str]) -> str:
    text = "\n".join(lines)
    letter = "P" if not re.search(r"(?<![A-Za-z\\])p(?![a-z])", text) and re.search(r"(?<![A-Za-z\\])P", text) else "p"
    if letter in taken or any(re.fullmatch(rf"{letter}_?[0-9]", name) for name in taken):
        raise InvalidInput(f"{letter} is a quantity of the mechanism, and the momenta are {letter}1, {letter}2, …; "
                           "give the quantity another letter")  # fmt: skip
    return letter


def _require_order(letter: str, links: int, coordinates: tuple[Coordinate, ...], lines: Sequence[str]) -> None:
    """Raises InvalidInput where p_1 may be the momentum of the first body or of the coordinate with the index 1."""
    indices = [index for _, index in coordinates]
    if links == 1 or not any(indices) or indices == [str(k) for k in range(1, links + 1)]:
        return
    numbered = {found[1] for line in lines
                for found in re.finditer(rf"(?<![A-Za-z\\]){letter}\s*_?\s*\{{?\s*([0-9])", line)}  # fmt: skip
    if numbered and str(links) not in numbered:
        named = ", ".join(f"{letter}_{base}{index}" for base, index in coordinates)
        raise InvalidInput(f"whose momentum is {letter}{min(numbered)}? Name each by its coordinate: {named}")
