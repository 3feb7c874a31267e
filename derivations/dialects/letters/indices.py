# ruff: noqa: E501 -- patterns stand on one line
r"""Indices in any font or alphabet: m_\mathrm{c}, J_\Delta, c₁₂; ell for ℓ; numbers with units by siunitx."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..names import FIGURES, GREEK
from .every_text import everywhere, lines_of

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_FONT = r"\\(?:mathrm|mathit|mathsf|mathbf|text|textrm|textit|textnormal|operatorname|rm)"
FONT_INDEX = re.compile(
    rf"_\s*(?:\{{\s*{_FONT}\s*\{{\s*(?P<both>[A-Za-z0-9, ]{{1,12}})\s*\}}\s*\}}|{_FONT}\s*\{{\s*(?P<x>[A-Za-z0-9, ]{{1,12}})\s*\}}"
    rf"|\{{\s*\\rm\s+(?P<old>[A-Za-z0-9]{{1,12}})\s*\}}|{_FONT}\s+(?P<bare>[A-Za-z0-9])(?![A-Za-z0-9]))"
)
MIXED_INDEX = re.compile(
    rf"_\s*\{{\s*(?P<a>[A-Za-z0-9]{{1,8}})?\s*,?\s*{_FONT}\s*\{{\s*(?P<b>[A-Za-z0-9]{{1,8}})\s*\}}\s*,?\s*(?P<c>[0-9]{{1,2}})?\s*\}}"
)
GREEK_INDEX = re.compile(rf"_\s*(?:\{{\s*\\(?P<braced>{_GREEK})\s*\}}|\\(?P<bare>{_GREEK})(?![A-Za-z]))")
SHORT_WAVE = re.compile("(?P<wave>(?<![A-Za-z])(?:g)?[csCS])(?P<low>[₁-₉]{1,2})(?![₀-₉])")
L = re.compile(r"(?<![\w\\.])l(?!\w)")
ELL = re.compile(r"(?<![A-Za-z\\])ell(?![A-Za-z])")
UNIT = re.compile(
    r"\\(?:SI|qty)\s*\{\s*(?P<x>[-+]?[0-9]{1,12}(?:[.,][0-9]{1,12})?)\s*\}\s*\{(?P<unit>[^{}]{0,80})\}"
    r"|\\num\s*\{\s*(?P<y>[-+]?[0-9]{1,12}(?:[.,][0-9]{1,12})?)\s*\}"
)
OWN_UNIT = re.compile(
    r"(?:\s|\\(?:meter|metre|second|kilogram|newton|joule|radian|per|squared?|cubed?|cubic|m|s|kg|N|J|rad|tothe\s*\d)(?![A-Za-z])|(?:kg|rad|[msNJ])(?![A-Za-z])|[/^.2~-])*"
)
WORD_BEHIND = re.compile(r"(?<=[A-Za-zα-ωℓ])(?P<low>[₀-₉]{1,2})_(?P<x>[A-Za-z]{2,8})(?![A-Za-z0-9_])")  # L₁_rest
COUNTED = re.compile(r"(?P<x>\\?[A-Za-zα-ωϕϑ]+)\s*\[\s*(?P<k>[0-9])\s*\]")
PROGRAM = re.compile(r"\b(?:def|function|lambda|return)\b|[;{]\s*\n")


def plain_indices(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with every index in plain figures and letters."""
    made = everywhere(data, _plain)
    bodies = made.get("bodies")
    if not isinstance(bodies, list) or not all(isinstance(b, dict) for b in bodies):
        return made
    said = [str(v) for b in bodies for k, v in b.items() if k not in ("name", "on")]
    if any(ELL.search(text) for text in said):
        _check_one_l([*said, *lines_of(made)])
        made = everywhere(made, lambda text: ELL.sub("ℓ", text))
    return _from_one(made, bodies)


def _check_one_l(texts: list[str]) -> None:
    """Raises InvalidInput where a file has l besides ell, which are one letter to the reader."""
    if any(L.search(text) for text in texts):
        raise InvalidInput(
            "l and ell are one letter here, ℓ, and both stand in this file; give one of them another name"
        )


def _plain(text: str) -> str:
    text = FONT_INDEX.sub(lambda m: "_{" + (m["both"] or m["x"] or m["old"] or m["bare"]).strip() + "}", text)
    text = MIXED_INDEX.sub(lambda m: "_{" + (m["a"] or "") + m["b"] + (m["c"] or "") + "}", text)
    text = GREEK_INDEX.sub(lambda m: "_{" + (m["braced"] or m["bare"]) + "}", text)
    text = WORD_BEHIND.sub(lambda m: "_{" + m["low"].translate(FIGURES) + m["x"] + "}", text)
    text = UNIT.sub(_number, text)
    return SHORT_WAVE.sub(lambda m: m["wave"] + "_{" + m["low"].translate(FIGURES) + "}", text)


def _number(found: re.Match[str]) -> str:
    """A number whose unit is SI's own; centimetres and degrees are numbers of something else."""
    if found["unit"] is not None and not OWN_UNIT.fullmatch(found["unit"]):
        raise InvalidInput(
            f"{found[0].strip()[:60]}: write numbers in metres, kilograms, seconds and radians, without units"
        )
    return " " + (found["x"] or found["y"]).replace(",", ".") + " "


def _from_one(data: dict[str, Any], bodies: list[dict[str, Any]]) -> dict[str, Any]:
    """theta[0], theta[1], … as theta_1, theta_2, …, where every coordinate is counted so."""
    found = [COUNTED.fullmatch(str(b.get("coordinate", ""))[:40].strip()) for b in bodies]
    letters = {m["x"] for m in found if m}
    if not found or not all(found) or len(letters) != 1:
        return data
    counted = [int(m["k"]) for m in found if m]
    if counted != list(range(len(found))):
        return data
    x = letters.pop()

    def one(text: str) -> str:
        if PROGRAM.search(text):  # a function's own list; its place in the state says what it is
            return text
        return re.sub(rf"(?<![A-Za-z\\]){re.escape(x)}\s*\[\s*([0-9])\s*\]", lambda m: f"{x}_{int(m[1]) + 1}", text)

    return everywhere(data, one)
