"""The equations of a Modelica model, without remarks, types, annotations and quotes."""

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from ..markup.calls import parts_of
from ..statements import DOWNWARDS
from .definitions import Definitions

MODEL = re.compile(
    r"^\s*(?:within\s+[\w.]*\s*;\s*)?(?:partial\s+)?(?:model|block|class)\s+\w+(?P<head>.*?)\bequation\b(?P<rows>.*?)\bend\s+\w+\s*;?\s*$",
    re.DOTALL,
)
QUOTES = re.compile(r'"[^"]{0,300}"')
REMARKS = re.compile(r"//[^\n]*|/\*.{0,1000}?\*/", re.DOTALL)
BOUND = re.compile(
    r"^\s*(?P<before>(?:(?:protected|public|final|inner|outer|parameter|constant)\s+)*)(?:Real|[\w.]*SI\.\w+)\s+(?P<name>\w{1,30})\s*(?:\([^()]*\))?\s*=\s*(?P<value>[^=]{1,400})$"
)
OTHER = re.compile(r"\b(?:if|when|for|connect|assert|algorithm|initial|reinit|noEvent|pre)\b")
NUMBER = re.compile(r"[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?")  # right for every value is right for it
OF_LIBRARY = re.compile(r"Modelica\.")
MOST_ROWS = 24


def from_modelica(text: str) -> tuple[list[str], Definitions] | None:
    """The rows, and what parameters are by others; ``with_definitions`` finds other definitions among the rows.

    None where it is no model.
    """
    found = MODEL.match(text)
    if found is None:
        return None
    if DOWNWARDS.search(text):
        raise InvalidInput("g is a negative number here; give it without its sign, and the sign in the rows")
    body = REMARKS.sub(" ", QUOTES.sub(" ", found["rows"]))
    rows = [re.sub(r"\s+", " ", row).strip() for row in parts_of(body, ";")]
    rows = [row for row in rows if row and not re.match(r"annotation\s*\(", row)]
    other = next((m for row in rows if (m := OTHER.search(row))), None)
    if other:
        raise InvalidInput(f"{other[0]!r} in a Modelica model: write out the equations that hold")
    head = REMARKS.sub(" ", QUOTES.sub(" ", found["head"]))
    bound = [m for part in parts_of(head, ";") if (m := BOUND.match(part))]
    fixed = {m["name"]: m["value"].strip() for m in bound if re.search(r"parameter|constant", m["before"])}
    rows = [*(f"{m['name']} = {m['value'].strip()}" for m in bound if m["name"] not in fixed), *rows]
    if len(rows) > MOST_ROWS or not all(row.count("=") == 1 for row in rows):
        raise InvalidInput(f"a Modelica model with up to {MOST_ROWS} equations, one equals sign each, is read")
    used = " ".join([*rows, *fixed.values()])
    said = {n: v for n, v in fixed.items() if not NUMBER.fullmatch(v) and not OF_LIBRARY.match(v)}
    return rows, {n: v for n, v in said.items() if re.search(rf"(?<!\w){n}(?!\w)", used)}
