# ruff: noqa: E501 -- patterns stand on one line
r"""Rates and accelerations that a note names: ω_1 = \dot θ_1; \ddot x_1 = … of a point whose place is not said."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from ....models.errors import InvalidInput
from ..names import GREEK, plain_name, spelling
from .displays import Statement
from .letters import NAME, Names, alone, spelled, used, written_alone

_DOT = rf"\\(?P<dots>d?dot)\s*(?:\{{\s*(?P<a>{NAME})\s*\}}|(?P<b>\\[A-Za-z]+|[A-Za-z]))\s*(?P<i>_\s*(?:\{{\s*\w{{1,6}}\s*\}}|\w))?"
DERIVED = re.compile(rf"^\s*(?:{_DOT}|(?P<c>{NAME})(?P<primes>'{{1,2}}|\u0307|\u0308))\s*(?:[(\[]\s*t\s*[)\]])?\s*$")


def derived(side: str) -> tuple[str, int] | None:
    """The plain name that a side is a derivative of, and which; None where it is more, or none."""
    found = DERIVED.match(side)
    if found is None:
        return None
    name = plain_name((found["a"] or found["b"] or found["c"] or "") + (found["i"] or ""))
    count = 1 if found["dots"] == "dot" or found["primes"] in ("'", "\u0307") else 2
    return (name, count) if name else None


def named_rate(sides: Statement, names: Names) -> tuple[str, str, str] | None:
    r"""ω_1 = \dot θ_1, on either side: the name, as it is written, and the rate."""
    if len(sides) != 2:
        return None
    for one, two in (sides, sides[::-1]):
        of, name = derived(one), alone(two)
        if of and name and of[1] == 1 and of[0] in names.coordinates and name not in names.coordinates:
            return name, written_alone(two), one.strip()
    return None


def of_unknown_points(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with a name for \ddot x_1 wherever it stands, where x_1 is not said and \ddot x_1 = … is."""
    taken = set(names.all) | {name for sides in statements if (name := alone(sides[0]))}
    taken |= {rate[0] for sides in statements if (rate := named_rate(sides, names))}
    changes: dict[str, tuple[re.Pattern[str], str]] = {}
    for sides in statements:
        of = derived(sides[0]) if len(sides) == 2 else None
        if of is None or of[0] in taken or of[0] in ("t", "g"):
            continue
        if not any(spelling(c).search(sides[1]) for c in names.coordinates):
            continue
        letter = next((x for x in "BAQKSZ" if x + of[0] not in taken), "")
        pattern = _pattern(*of)
        if pattern.pattern in changes or not letter:
            raise InvalidInput(f"{sides[0].strip()[:30]} is said twice; give each equation once")
        taken.add(letter + of[0])
        changes[pattern.pattern] = pattern, f" {letter}_{{{of[0]}}} "
    return [tuple(_replaced(side, changes.values()) for side in sides) for sides in statements]


MOVED = re.compile(r"\\ddot|''|″|\u0308|\\dot\s*\{?\s*\\?omega|ω\u0307|\\[dt]?frac\s*\{\s*(?:\\mathrm\s*\{?\s*)?d")
TURNS = re.compile(r"\\?(?:sin|cos)(?![a-z])")


def with_evident_accelerations(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with \ddot θ_1 for α_1, where each angle's is said and no acceleration is written otherwise."""
    own = {"alpha" + c.removeprefix(word): c for c in names.coordinates for word in ("theta", "phi", "varphi", "psi")
           if c.startswith(word)}  # fmt: skip
    said = {name: " ".join(sides[1:]) for sides in statements if (name := alone(sides[0])) in own}
    texts = [side for sides in statements for side in sides]
    if (
        len(own) < len(names.coordinates) or said.keys() != own.keys() or own.keys() & names.all
        or names.relative or any(MOVED.search(text) for text in texts)
        or not all(TURNS.search(value) for value in said.values())
    ):  # fmt: skip
        return list(statements)
    changes = [(re.compile(spelling(name).pattern), f" \\ddot{{{spelled(c)}}} ") for name, c in own.items()]
    return [tuple(_in_words(side, changes) for side in sides) for sides in statements]


def _in_words(text: str, changes: Sequence[tuple[re.Pattern[str], str]]) -> str:
    for pattern, new in changes:
        text = pattern.sub(lambda _, new=new: new, text)  # type: ignore[misc]
    return text


_SQUARED = r"[^=()+−*/-]{1,40}(?:\^\s*(?:\{\s*2\s*\}|2)|²)"
SQUARES = re.compile(rf"\s*{_SQUARED}\s*(?:\+\s*{_SQUARED}\s*){{1,2}}")


def of_squared_speeds(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with a name for \dot x_1^2 + \dot y_1^2 in brackets, where that sum alone is said what it is."""
    made = list(statements)
    taken = set(names.all) | {name for sides in statements if (name := alone(sides[0]))}
    for k, sides in enumerate(made):
        if len(sides) < 2 or not SQUARES.fullmatch(sides[0]) or used(sides[0]) & names.all:
            continue
        inner = r"\s*".join(re.escape(c) for c in re.sub(r"\s", "", sides[0]))
        pattern = re.compile(rf"(?:\\left\s*)?\(\s*{inner}\s*(?:\\right\s*)?\)")
        others = [*made[:k], *made[k + 1 :]]
        name = next((f"{x}_{{{i}}}" for x in "SBZ" for i in range(1, 9) if f"{x}{i}" not in taken), "")
        if not name or not any(pattern.search(side) for other in others for side in other):
            continue
        taken.add(plain_name(name) or "")
        made = [tuple(pattern.sub(f" {name} ", side) for side in other) for other in made]
        made[k] = (name, *sides[1:])
    return made


def _replaced(text: str, changes: Iterable[tuple[re.Pattern[str], str]]) -> str:
    for pattern, new in changes:
        text = pattern.sub(new, text)
    return text


def _pattern(name: str, count: int) -> re.Pattern[str]:
    """How a first or second derivative of a name may be written."""
    x = rf"(?:{spelling(name).pattern})"
    base = next((w for w in sorted(GREEK, key=len, reverse=True) if name.startswith(w)), name[:1])
    index = name[len(base) :]
    low = rf"\s*_\s*(?:\{{\s*{re.escape(index)}\s*\}}|{re.escape(index)})" if index else ""
    letter = rf"\\{base}" if base in GREEK else re.escape(base)
    dots = "ddot" if count == 2 else "dot"
    of_time = r"(?:\s*[(\[]\s*t\s*[)\]])?"
    return re.compile(
        rf"(?:\\{dots}\s*\{{\s*{x}\s*\}}|\\{dots}\s*(?:\{{\s*{letter}\s*\}}|{letter}(?![A-Za-z])){low}"
        rf"|(?<![A-Za-z\\]){x}(?:{chr(39) * count}(?!{chr(39)})|{chr(0x306 + count)})){of_time}"
    )
