# ruff: noqa: E501 -- patterns stand on one line
"""The fields of a file whose one equation is a program of another language, with a function of Python's in its place."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from ....models.errors import InvalidInput
from ..languages.braces import from_braces, is_braced
from ..languages.by_words import from_words
from ..languages.equations import stated
from ..languages.haskell import from_haskell
from ..languages.program import LONGEST_PROGRAM, RETURN, Function, Program
from ..letters.every_text import rows_of
from ..names import plain_name
from ..statements import DOWNWARDS
from ..table import known_of
from .neutral import Asked, neutral, state_of

DEEPEST = 40  # brackets in one another
ENTRY = re.compile(r"(?P<name>\w+)\s*[\[(]\s*(?P<k>\d{1,2})\s*[\])]")

TYPED = re.compile(r"(?m)^\s*(?:(?:static|const|constexpr)\s+)*(?:double|float|real_t|scalar_t|Scalar)\s+\w+\s*=[^\n]*")
# A line of LaTeX, and no comment
PRINTED = re.compile(r"(?m)^(?![ \t]*(?://|#|%|\*|--|!|;))[^\n]*\\(?:ddot|dot|cos|sin)(?![A-Za-z])")
WAVE = re.compile(r"\b[dD]?(?:sin|cos)f?\s*\(|\.(?:sin|cos)\s*\(|solve|inverse", re.IGNORECASE)


def from_languages(data: dict[str, Any], count: int) -> dict[str, Any]:
    """The fields with the program as one that is followed. ``count``: the coordinates."""
    rows, define = rows_of(data), data.get("define", {})
    if (
        len(rows) != 1
        or not isinstance(define, dict)
        or not 1 <= count <= 8
        or not all(isinstance(v, str) for v in define.values())
    ):
        return data
    label, text = rows[0]
    if len(text) > LONGEST_PROGRAM or _depth(text) > DEEPEST:
        return data  # what is so large or so deep, the reader refuses
    try:
        asked = asked_of(data, define, count)
        names = {*asked.known, *asked.coordinates, *(str(key) for key in define)}
        rows_said = stated(text, names) or _of_haskell(text, asked, names)
        if rows_said and isinstance(rows_said, tuple):
            return data | {
                "equations": {str(k): row for k, row in enumerate(rows_said[0], 1)},
                "define": {**define, **rows_said[1]},
            }
        program = rows_said if isinstance(rows_said, Program) else program_of(text)
        if program is None:
            return data
        if DOWNWARDS.search(text):
            raise InvalidInput("g is a negative number here; give it without its sign, and the sign in the rows")
        made, said = _made(program, asked)
    except InvalidInput as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    kept = {key: value for key, value in define.items() if not ENTRY.fullmatch(str(key).strip())}
    return data | {"equations": {label: made}, "define": {**kept, **said}}


def _of_haskell(text: str, asked: Asked, names: Collection[str]) -> Program | tuple[list[str], dict[str, str]] | None:
    found = from_haskell(text, names, asked.coordinates)
    return (found, {}) if isinstance(found, list) else found


def _depth(text: str) -> int:
    """How deep brackets stand in one another, at most."""
    depth = deepest = 0
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        deepest = max(deepest, depth)
    return deepest


def program_of(text: str) -> Program | None:
    """The program of a text; None where its language is another's to read."""
    if "\\begin" in text or "\\frac" in text or "Symbol(" in text or PRINTED.search(text):
        return None
    program = from_words(text)
    if program is not None:
        return program
    return from_braces(text) if is_braced(text) or is_lines_of_c(text) else None


def is_lines_of_c(text: str) -> bool:
    """Whether a text without braces declares what it computes as C does, with a type for each."""
    return "{" not in text and len(TYPED.findall(text)) > 1


def asked_of(data: Mapping[str, Any], define: Mapping[str, str], count: int) -> Asked:
    """What the file declares."""
    known = known_of(data)
    bodies = data.get("bodies")
    bodies = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    slides = frozenset(c for c, b in zip(known.coordinates, bodies, strict=False) if b.get("joint") == "slide")
    if data.get("system") in ("cart-pole", "cart-rod", "cart-double-pole"):
        slides |= {"x"}
    given = {
        f"{m['name']}[{m['k']}]": str(value)
        for key, value in define.items()
        if (m := ENTRY.fullmatch(str(key).strip()))
    }
    given |= {str(key): str(value) for key, value in define.items() if re.fullmatch(r"\w+(?:\.\w+)+", str(key))}
    names = known.quantities | {str(key) for key in define} | {plain_name(str(key)) or "" for key in define} | {"g"}
    if not known.coordinates:
        names |= {f"{letter}{k}" for letter in "mlLMI" for k in ("", 1, 2, 3, 4)}
    count -= sum(b.get("motion") == "given" for b in bodies)
    return Asked(count, known.coordinates, slides, frozenset(names) - set(known.coordinates), given)


def _made(program: Program, asked: Asked) -> tuple[str, dict[str, str]]:
    """The one function that has the equations of motion."""
    found: list[tuple[Function, tuple[str, dict[str, str]]]] = []
    reasons: list[tuple[tuple[bool, int], str]] = []  # the likeliest function's is said
    functions = list(program.functions)
    if not functions and program.outside:
        functions = [Function("", (), program.outside)]
        program = Program(tuple(functions), (), program.first, program.whole, program.powers)
    for function in functions:
        if not _may_move(function, asked, functions):
            continue
        try:
            found.append((function, neutral(program, function, asked)))
        except InvalidInput as error:
            reasons.append(((bool(state_of(function, asked)), len(function.statements)), str(error)))
    texts = {made for _, (made, _) in found}
    if len(texts) == 1:
        return found[0][1]
    if len(texts) > 1:
        raise InvalidInput(f"{len(found)} functions may have the equations of motion; give the text of one")
    if reasons:
        raise InvalidInput(max(reasons)[1])
    raise InvalidInput("no function with the equations of motion is found; give the text of the one that has them")


def _may_move(function: Function, asked: Asked, functions: Sequence[Function]) -> bool:
    """Whether a function may have the equations: it has a wave, itself or by another, or solves, and says something."""
    text = " ".join(s.value for s in function.statements)
    enough = (
        any(s.target == RETURN or "+" in s.op for s in function.statements) or len(function.statements) >= asked.count
    )
    called = set(re.findall(r"(\w+)\s*\(", text))
    text += " ".join(s.value for f in functions if f.name in called and f is not function for s in f.statements)
    return enough and WAVE.search(text) is not None
