"""Reads a derivation: a TOML file with the equations of motion, or the Lagrangian, of one of the two mechanisms."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from ...models.errors import InvalidInput, nearest
from ...models.readers.bounded_file import read_text, shown
from ...models.readers.toml_text import parse_toml
from ..algebra.quotient import Quotient
from ..algebra.symbols import KINDS, Symbols, symbols_of
from ..algebra.trig import Formula
from .evaluation import Evaluation
from .parser import parse_equation, parse_expression
from .tokens import FUNCTIONS, LETTERS

LARGEST_FILE = 200_000  # characters; a chain of twenty rods, every sum multiplied out, has 150 000
MOST_LINKS = 20
MOST_DEFINITIONS = 40
FIELDS = ("system", "links", "angles", "equations", "lagrangian", "define", "title", "author")
ANGLES = ("absolute", "relative")

T = TypeVar("T")


@dataclass(frozen=True)
class Submission:
    """A derivation that was read.

    ``rows``: each equation as (its label, left side minus right side, cleared of denominators); ``lagrangian``: in
    place of them, over its denominator; ``relative``: its angles are measured from the link above;
    ``equal_lengths``, ``equal_masses``: l, m without an index is used for all of them.
    """

    symbols: Symbols
    rows: tuple[tuple[str, Formula], ...]
    lagrangian: Formula | None
    relative: bool
    equal_lengths: bool
    equal_masses: bool


def read_submission(source: str | os.PathLike[str]) -> Submission:
    """Read a file. Raises InvalidInput, with the place, where it is not a derivation."""
    path = Path(source)
    text = read_text(path, 4 * LARGEST_FILE)
    try:
        return parse_submission(text)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def parse_submission(text: str) -> Submission:
    """Read the text of such a file."""
    if len(text) > LARGEST_FILE:
        raise InvalidInput(f"longer than {LARGEST_FILE} characters; a derivation is not")
    data = parse_toml(text)
    for name in data:
        if name not in FIELDS:
            raise InvalidInput(f"{name!r:.40}: no such field{nearest(name, FIELDS)}; known are {', '.join(FIELDS)}")
    symbols = _symbols(data)
    angles = data.get("angles", "absolute")
    if angles not in ANGLES:
        raise InvalidInput(f"angles: {angles!r:.40} is not known; give 'absolute' (from the vertical) or 'relative'")
    evaluation = Evaluation(symbols)
    _define(evaluation, data.get("define", {}))
    has_equations, has_lagrangian = "equations" in data, "lagrangian" in data
    if has_equations == has_lagrangian:
        raise InvalidInput('give either [equations], one row each, or lagrangian = "…"')
    rows = _rows(evaluation, data["equations"]) if has_equations else ()
    lagrangian = _lagrangian(evaluation, data["lagrangian"]) if has_lagrangian else None
    return Submission(
        symbols, rows, lagrangian, angles == "relative", evaluation.equal_lengths, evaluation.equal_masses
    )


def _symbols(data: dict[str, Any]) -> Symbols:
    kind, links = data.get("system"), data.get("links")
    if kind not in KINDS:
        hint = nearest(kind, KINDS) if isinstance(kind, str) and len(kind) < 100 else ""
        raise InvalidInput(f"system: {kind!r:.40} is not known{hint}; give 'n-leg' or 'rod-chain'")
    least = 2 if kind == "n-leg" else 1
    if type(links) is not int or not least <= links <= MOST_LINKS:
        raise InvalidInput(f"links: the number of angles is needed, from {least} to {MOST_LINKS}, got {links!r:.40}")
    return symbols_of(kind, links)


def _define(evaluation: Evaluation, table: object) -> None:
    if not isinstance(table, dict) or len(table) > MOST_DEFINITIONS:
        raise InvalidInput(f'define: a table of at most {MOST_DEFINITIONS} names is needed, as in M = "m1 + m2"')
    for name, line in table.items():
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)?", name) or name in LETTERS or name in FUNCTIONS:
            raise InvalidInput(f"define.{name!s:.40}: a name is a letter, then letters and digits, and not one in use")
        if re.fullmatch(r"(t|w|a|l|m|I|theta|omega|alpha)_?[0-9]+", name):
            raise InvalidInput(f"define.{name!s:.40}: already has a meaning")
        node = _located(f"define.{name}", _expression, evaluation, line)
        evaluation.definitions[name] = node


def _expression(evaluation: Evaluation, line: object) -> Any:
    return parse_expression(_line(line), frozenset(evaluation.definitions))


def _rows(evaluation: Evaluation, table: object) -> tuple[tuple[str, Formula], ...]:
    n = evaluation.space.n
    if isinstance(table, list):
        table = {str(i): line for i, line in enumerate(table, 1)}
    if not isinstance(table, dict) or not table:
        raise InvalidInput('equations: a table of rows is needed, as in 1 = "m1*l1^2*a1 = -m1*g*l1*sin(t1)"')
    if len(table) > n:
        raise InvalidInput(f"equations: {len(table)} rows for {n} angles; one row for each angle is needed")
    return tuple(
        (str(label)[:40], _located(f"equations.{label!s:.40}", _row, evaluation, line)) for label, line in table.items()
    )


def _row(evaluation: Evaluation, line: object) -> Formula:
    left, right = parse_equation(_line(line), frozenset(evaluation.definitions))
    return evaluation.value(left).plus(evaluation.value(right), -1, evaluation.budget).numerator


def _lagrangian(evaluation: Evaluation, line: object) -> Formula:
    def read() -> Quotient:
        written = re.sub(r"^\s*(L|\\mathcal\s*\{?\s*L\s*\}?)\s*=", lambda m: " " * len(m[0]), _line(line))
        return evaluation.value(parse_expression(written, frozenset(evaluation.definitions)))

    value = _located("lagrangian", read)
    if value.denominator:
        raise InvalidInput("lagrangian: column 1: a sum in a denominator; a Lagrangian has none")
    return value.numerator


def _line(line: object) -> str:
    if not isinstance(line, str):
        raise InvalidInput(f"column 1: a text in quotes is needed, got {line!r:.40}")
    return re.sub(r"[.,;、。，．]$", "", line.rstrip())


def _located(where: str, read: Callable[..., T], *arguments: Any) -> T:
    """The result of ``read``; where it raises InvalidInput, the field is put before the message."""
    try:
        return read(*arguments)
    except InvalidInput as error:
        raise InvalidInput(f"{where}: {error}") from None
