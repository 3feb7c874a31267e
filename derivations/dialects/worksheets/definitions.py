"""Rows that only say what a name is, c = cos(θ₁ - θ₂), become definitions, each behind those that it needs."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import Any

from ..blocks import all_pieces
from ..letters.every_text import rows_of
from ..markup.calls import parts_of
from ..names import WRITTEN, plain_name, spelling
from ..statements import is_program
from ..table import known_of

SAID = re.compile(
    r"^\s*(?:&\s*)?(?P<name>\\?[A-Za-zα-ωΑ-Ω]\w{0,20}(?:\s*_\s*\{\s*\w{1,10}\s*\})?)\s*(?:&\s*)?(?::=|=(?!=)|\\equiv|\\coloneqq)\s*(?:&\s*)?(?P<value>[^=]+)$",
    re.DOTALL,
)
FORCE = re.compile(r"(?:[TNRSHVPF]|lambda)\w?")
MOVING = re.compile(
    r"\\d?dot|''|″|\u0308|\bder\s*\(|\bdiff\s*\(|Derivative|ddot|acc\b|\\[dt]?frac\s*\{\s*(?:\\mathrm\s*\{?\s*)?d\b"
)
MOST_ROWS, MOST_DEFINITIONS = 40, 30
Definitions = dict[str, str]


def definition(line: str, taken: Collection[str | None]) -> tuple[str, str] | None:
    """The name and what it is, where a row only says that; None for an equation of motion."""
    found = SAID.match(line)
    name = plain_name(found["name"]) if found else None
    if found is None or name is None or name in taken or FORCE.fullmatch(name) or name in ("g", "t", "pi"):
        return None
    return found["name"].strip(), found["value"].strip().rstrip(" ;,.")


def with_definitions(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with such rows among the definitions, where equations of motion are left."""
    rows, define = rows_of(data), data.get("define", {})
    known = known_of(data)
    if len(rows) == 1 and not is_program(rows[0][1]):
        rows = [(str(k), piece) for k, piece in enumerate(all_pieces(rows[0][1]), 1)]
    if not known.coordinates or not 1 < len(rows) <= MOST_ROWS or not isinstance(define, dict):
        return data
    taken = {*known.coordinates, *known.quantities, *(plain_name(str(name)) for name in define)}
    said: Definitions = {}
    left: list[tuple[str, str]] = []
    for label, line in rows:
        found = definition(line, taken)
        if found is None or plain_name(found[0]) in map(plain_name, said):
            left.append((label, line))
        else:
            said[found[0]] = found[1]
    if not said or not any(MOVING.search(line) for _, line in left) or len(said) > MOST_DEFINITIONS:
        return data
    ordered = in_order(said)
    used = " ".join([*(line for _, line in left), *said.values()])
    if not all(re.search(spelling(plain_name(name) or name).pattern, used) for name in said):
        return data  # what no row needs may be a statement of its own
    if ordered is None or any(_is_a_rate(value) for value in said.values()):
        return data
    return data | {"equations": dict(left), "define": {**define, **ordered}}


def _is_a_rate(value: str) -> bool:
    """Whether a value is a coordinate's rate alone, which is said of a name elsewhere."""
    return re.fullmatch(r"\s*\\d?dot\s*\{?\s*\\?\w+\s*\}?(?:_\{?\w+\}?)?\s*|\s*\w+'{1,2}\s*", value) is not None


def in_order(said: Mapping[str, str]) -> Definitions | None:
    """The definitions, each behind those that it needs, else as they stand; None where they go in a circle."""
    plain = {plain_name(name) or plain_name(name.partition("(")[0]) or name: name for name in said}
    needs = {key: {p for m in WRITTEN.finditer(said[name]) if (p := plain_name(m[0])) in plain} - {None}
             for key, name in plain.items()}  # fmt: skip
    made: Definitions = {}
    left = dict(plain)
    while left:
        key = next((key for key in left if not needs[key] & left.keys()), None)
        if key is None:
            return None
        made[left.pop(key)] = said[plain[key]]
    return made


def ordered(table: dict[str, Any]) -> dict[str, Any]:
    """Definitions of a file, whose tables have no order; as they stand where they are no texts, or go in a circle."""
    made = in_order(table) if all(isinstance(line, str) for line in table.values()) else None
    return table if made is None or len(made) < len(table) else dict(made)


def split_statements(text: str, ends: str) -> list[str]:
    """The statements of a session, each without what ends it; brackets and quotes keep theirs."""
    lines = text.split("\n") if "\n" in ends else [text]
    joined: list[str] = []
    depth = 0
    for part in lines:
        if joined and (depth > 0 or re.match(r"\s*[-+*/=]", part) or re.search(r"[-+*/=,]\s*$", joined[-1])):
            joined[-1] += " " + part
        else:
            joined.append(part)
        depth = sum((c in "([{") - (c in ")]}") for c in joined[-1])
    marks = [c for c in ends if c != "\n"]
    for mark in marks:
        joined = [piece for part in joined for piece in parts_of(part, mark)]
    return [part.strip() for part in joined if part.strip()]
