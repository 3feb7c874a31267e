r"""Names as an author writes them in ``define``: \tilde{F}_1, \Delta\theta, {\bf M}(q), \alpha_1(\theta_1)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from .names import plain_name

ACCENT = re.compile(
    r"\\(?P<accent>tilde|widetilde|bar|overline|hat|widehat|check|breve)\s*(?:\{\s*(?P<x>\\?[A-Za-z]{1,8})\s*\}|(?P<y>[A-Za-z]))"
    r"(?:\s*_\s*(?:\{\s*(?P<braced>\w{1,6})\s*\}|(?P<low>\w)))?"
)
OVER = {"widetilde": "tilde", "overline": "bar", "widehat": "hat"}
DIFFERENCE = re.compile(r"(?:\\Delta|Δ|∆)\s*(?P<x>\\(?:var)?(?:theta|phi)|\\psi|\\alpha|[θϑφϕψα])(?![A-Za-z])")
ARGUMENTS = re.compile(r"^(?P<name>.{1,40}?)\s*(?P<arguments>\((?:[^()]|\([^()]*\)){1,60}\))\s*$", re.DOTALL)
MATRIX = re.compile(r"\\begin\{[a-zA-Z]*(?:matrix|array)\}|^\s*(?:np\.)?(?:array|Matrix)?\s*\(?\s*\[")
_FONT = r"(?:\\(?:boldsymbol|mathbf|bm|vec)\s*)?\{?\s*"
_X = rf"\s*(?:\\d?dot\s*)?\{{?\s*{_FONT}(?:\\?(?:theta|Theta|phi|q)|[θϕφq]|dq|qd|qdot|x)\s*\}}?\s*\}}?\s*"
OF_COORDINATES = rf"(?:\\left\s*)?\({_X}(?:,{_X}){{0,2}}(?:\\right\s*)?\)"
Mapped = Callable[[Mapping[str, Any], Callable[[str], str]], dict[str, Any]]


def shorter_names(data: dict[str, Any], mapped: Mapped) -> dict[str, Any]:
    """The fields with plain names in place of these, in what is defined and wherever it is used."""
    define = data.get("define")
    made = mapped(data, _accents)
    if not isinstance(define, dict):
        return made
    renamed: dict[str, str] = {}
    for key in define:
        name = _accents(_spelled(str(key)))
        found = ARGUMENTS.match(name)
        if found and plain_name(found["name"]) is not None:
            made = mapped(made, _without_arguments(found["name"], found["arguments"]))
            name = found["name"]
        renamed[key] = re.sub(r"\s", "", name)
    matrices = [renamed[key] for key, value in define.items() if isinstance(value, str) and MATRIX.search(value)]
    for name in matrices:
        made = mapped(made, _of_coordinates(name))
    if any("Delta" in name and plain_name(name) for name in renamed.values()):
        made = mapped(made, lambda line: DIFFERENCE.sub(_difference, line))
    if len(set(renamed.values())) < len(renamed):
        return made
    return made | {"define": {renamed[key]: value for key, value in made["define"].items()}}


def _spelled(name: str) -> str:
    """A name in ``define`` without fonts; Δθ as one word."""
    name = re.sub(r"\{\s*\\(?:bf|rm|it|cal)\s*(\\?[A-Za-z]{1,8})\s*\}", r"\1", name)
    name = re.sub(r"\\(?:mathbf|mathrm|mathcal|boldsymbol|bm|text|vec)\s*\{\s*(\\?[A-Za-z]{1,8})\s*\}", r"\1", name)
    name = re.sub(r"(?<![A-Za-z0-9_\\])([A-Za-z]+)\[\s*([0-9]{1,2})\s*\]", r"\1_\2", name)
    return DIFFERENCE.sub(lambda found: _difference(found).strip(), name)


def _difference(found: re.Match[str]) -> str:
    r"""\Delta\theta as a word of its own."""
    letter = plain_name(found["x"].replace("var", "")) or "x"
    return f" Delta{letter}".ljust(len(found[0]))


def _accents(line: str) -> str:
    def word(found: re.Match[str]) -> str:
        accent = OVER.get(found["accent"], found["accent"])
        index = found["braced"] or found["low"]
        return (f" {plain_name(found['x'] or found['y'])}{accent}" + (f"_{index}" if index else "")).ljust(
            len(found[0])
        )

    return ACCENT.sub(word, line)


def _of_coordinates(name: str) -> Callable[[str], str]:
    r"""What takes (q, \dot q) away behind a matrix: the coordinates together are no factor."""
    spaced = r"\s*".join(re.escape(c) for c in name)
    pattern = re.compile(rf"(?<![A-Za-z\\])(?P<name>{spaced}\s*)(?P<of>{OF_COORDINATES})")
    return lambda line: pattern.sub(lambda found: found["name"] + " " * len(found["of"]), line)


def _without_arguments(name: str, arguments: str) -> Callable[[str], str]:
    r"""What takes (q, \dot q) away behind a name that its author defined so."""
    inner = r"\s*".join(re.escape(c) for c in re.sub(r"\s|\\left|\\right|\\,", "", arguments))
    spaced = r"\s*".join(re.escape(c) for c in re.sub(r"\s", "", name))
    pattern = re.compile(rf"(?<![A-Za-z\\])(?P<name>{spaced})\s*{inner}")
    return lambda line: pattern.sub(lambda found: found["name"].ljust(len(found[0])), line)
