# ruff: noqa: E501 -- patterns stand on one line
r"""Names in a note: what stands alone on a side, what is used where, and names in fonts or with arguments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any
from unicodedata import normalize

from ..given_names import ACCENT, OVER
from ..names import GLYPHS, GREEK, LOWS, base_word, plain_name, spelling
from ..table import known_of

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_BASE = rf"(?:\\(?:{_GREEK}|ell)(?![A-Za-z])|[A-Za-z]+|[{''.join(GLYPHS)}])"
_INDEX = rf"(?:\s*_\s*\{{[^{{}}]{{1,16}}\}}|\s*_\s*[0-9A-Za-z]|[0-9]{{1,2}}|[{LOWS}]{{1,4}})?"
NAME = rf"{_BASE}{_INDEX}"
_INSIDE = rf"(?:\s*(?:\\d?dot\s*)?\{{?\s*{NAME}\s*\}}?['\u0307\u0308]*\s*)"
ARGUMENTS = rf"\s*(?:\\left\s*)?\({_INSIDE}(?:[,;]{_INSIDE}){{0,3}}(?:\\right\s*)?\)"
ALONE = re.compile(rf"^\s*(?P<name>{NAME})\s*(?P<of>{ARGUMENTS})?\s*$")
FONT = re.compile(
    r"\\(?:mathbf|boldsymbol|bm|mathrm|mathcal|mathscr|mathsf|mathit|mathbb|text|vec|underline|pmb|operatorname)\s*(?:\{\s*(?P<x>\\?[A-Za-z]{1,10})\s*\}|(?P<y>[A-Za-z])(?![A-Za-z]))"
)
WORDY = {"sin", "cos", "tan", "sgn", "sign", "abs", "sqrt", "d", "t", "g", "pi", "left", "right", "frac", "tfrac", "dfrac",
         "dot", "ddot", "cdot", "times", "begin", "end", "inv", "T", "top", "e", "partial", "big", "over"}  # fmt: skip
USED = re.compile(rf"\\(?P<command>[A-Za-z]+)(?P<i>{_INDEX})|(?P<word>[A-Za-z]|[{''.join(GLYPHS)}])(?P<j>{_INDEX})")
WAVE = re.compile(r"(?<![A-Za-z\\])(?:sin|cos|tan)(?![A-Za-z])")
DOTS = re.compile("[\u0307\u0308]")  # above a letter, ẋ_1
OF_WAVE = re.compile(r"^\s*\\?(?P<of>sin|cos)(?![A-Za-z])\s*(?P<inner>[^^]*)$")
ENVIRONMENT = re.compile(r"\\(?:begin|end)\s*\{\w+\*?\}(?:\{[clr|]*\})?")


TWICE = re.compile(r"\s*(?:\\ddot(?![A-Za-z])[^=+*/^()-]{1,30}|[^=+*/^()'-]{1,20}(?:''|\u0308)[₀-₉]?)\s*$")


@dataclass(frozen=True)
class Names:
    """What a file declares, plain: coordinates in order, quantities, names of its own."""

    coordinates: tuple[str, ...]
    quantities: frozenset[str]
    defined: frozenset[str]
    relative: bool
    slides: tuple[bool, ...]
    driven: bool  # whether anything but weight acts
    seconds: frozenset[str] = frozenset()  # names that the file has for accelerations

    @property
    def all(self) -> frozenset[str]:
        """Every name that has a meaning."""
        return frozenset({*self.coordinates, *self.quantities, *self.defined, "g", "t", "pi"})


def names_of(data: Mapping[str, Any]) -> Names:
    """The names that the fields declare."""
    known, define = known_of(data), data.get("define", {})
    bodies = data.get("bodies")
    bodies = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    own = frozenset(p for x in define if (p := plain_name(str(x)))) if isinstance(define, dict) else frozenset()
    seconds = {plain_name(str(x)) or "" for x, value in define.items() if TWICE.match(str(value)[:60])} if own else ()
    return Names(
        known.coordinates, known.quantities, own, known.relative, tuple(b.get("joint") == "slide" for b in bodies),
        any(name in b for b in bodies for name in ("drive", "damping", "friction", "motion")), frozenset(seconds),
    )  # fmt: skip


def alone(side: str) -> str | None:
    """The plain name that is all of a side, its arguments left out; None where there is more."""
    found = ALONE.match(unfonted(side))
    return plain_name(found["name"]) if found else None


def is_abbreviation(name: str, side: str, names: Names) -> bool:
    r"""Whether a side is a sum of coordinates, or the sine or cosine of one, and its name is of these: c_1 = cos θ_1."""
    found = OF_WAVE.match(side)
    inner = re.sub(r"\\(?:left|right|[,;:! ])|[()\s{}]", " ", found["inner"] if found else side)
    inner = re.sub(r"_ (\w{1,4}) ", r"_{\1}", inner)
    parts = [plain_name(part.strip()) or "" for part in re.split(r"[+−-]", inner) if part.strip()]
    if not parts or not all(part in names.coordinates for part in parts) or (found is None and len(parts) < 2):
        return False
    if found and name[0].lower() in "sc" and name[0].lower() != found["of"][0]:
        return False
    figures = [re.sub("[^0-9]", "", x) for x in ("".join(parts), "".join(parts[::-1]), name)]
    return figures[2] in ("", *figures[:2])


def written_alone(side: str) -> str:
    """Such a side as ``define`` takes it."""
    return re.sub(r"\s+", " ", unfonted(side)).strip()


def unfonted(text: str) -> str:
    """Letters without their fonts."""

    def one(found: re.Match[str]) -> str:
        behind = "" if found.string[found.end() : found.end() + 1] == "_" else " "
        return found[0] if _is_word(found["x"]) else f" {found['x'] or found['y']}{behind}"

    return FONT.sub(one, text)


def _is_word(inner: str | None) -> bool:
    return inner is not None and len(inner.lstrip("\\")) > 1 and inner[0] != "\\"


def used(text: str) -> set[str]:
    """The plain names that may stand in a text, letter by letter."""
    found: set[str] = set()
    for m in USED.finditer(WAVE.sub(" ", ENVIRONMENT.sub(" ", text))):
        base = m["command"] or m["word"]
        if m["command"] and base not in GREEK and base != "ell":
            continue
        name = plain_name(("\\" if m["command"] else "") + base + (m["i"] or m["j"] or ""))
        found.add(name or base)
        if m["j"] and re.fullmatch(r"[0-9]{1,2}", m["j"]):
            found.add(base)
    return found


def spelled(name: str) -> str:
    """A plain name as LaTeX."""
    word = next((w for w in sorted(GREEK, key=len, reverse=True) if name.startswith(w)), name[:1])
    index = name[len(word) :]
    return (f"\\{word}" if word in GREEK else word) + (f"_{{{index}}}" if index else "")


def uses(name: str, texts: Iterable[str]) -> bool:
    """Whether a plain name stands in one of these texts."""
    pattern = re.compile(rf"(?<![A-Za-z\\]){spelling(name).pattern}|(?<=[A-Za-z]){spelling(name).pattern}")
    return any(pattern.search(DOTS.sub("", normalize("NFD", unfonted(text)))) for text in texts)


def with_accents(text: str) -> str:
    r"""Letters with a hat, a bar or a tilde as names of their own."""

    def word(found: re.Match[str]) -> str:
        index = found["braced"] or found["low"]
        base = base_word(found["x"] or found["y"])
        return f" {base}{OVER.get(found['accent'], found['accent'])}" + (f"_{{{index}}} " if index else " ")

    return ACCENT.sub(word, text)


def with_bold_apart(text: str, names: Names) -> str:
    r"""The text with a name of its own for a matrix \mathbf M, where M is a quantity."""
    plain = BOLD.sub(" ", text)

    def one(found: re.Match[str]) -> str:
        letter = found["x"] or found["y"]
        both = letter in names.all and re.search(rf"(?<![A-Za-z\\{{]){letter}(?![A-Za-z])", plain)
        return f" {letter}_{{9}} " if both else found[0]

    return BOLD.sub(one, text)


BOLD = re.compile(
    r"\\(?:mathbf|boldsymbol|bm|pmb|mathcal|mathbb|mathsf)\s*(?:\{\s*(?P<x>[A-Za-z])\s*\}|(?P<y>[A-Za-z])(?![A-Za-z]))"
)
