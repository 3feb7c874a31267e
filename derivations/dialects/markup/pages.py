"""All readers of this folder, one after another, on the equations of a file."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import rows_of
from ..names import plain_name
from ..statements import is_program
from ..table import known_of
from .asciimath import from_asciimath
from .chains import hamiltons_signs, two_statements
from .html import from_html
from .mathml import from_mathml
from .prose import from_arrow, from_displays, from_headed, from_inline, from_quoted, numbered
from .typst import from_typst

READERS = (from_quoted, from_mathml, from_html, from_typst, from_asciimath, from_inline, from_displays,
           from_headed, from_arrow, hamiltons_signs)  # fmt: skip
MOST_ROWS = 16


def from_pages(data: dict[str, Any], count: int) -> dict[str, Any]:
    """The fields with formulas alone. ``count``: the coordinates, 0 where that is not known."""
    rows = rows_of(data)
    if not rows:
        return data
    known = known_of(data)
    names = {*known.coordinates, *known.quantities, *(plain_name(str(x)) or "" for x in data.get("define", {}))}
    found: list[tuple[str, str]] = []
    for label, text in rows:
        try:
            lines = _lines(text, names)
        except InvalidInput as error:
            raise type(error)(f"equations.{label:.40}: {error}") from None
        found += [(label, line) for line in lines]
    if len(found) == len(rows):
        made = data | {"equations": dict(found)} if found != rows else data
    else:
        made = data | {"equations": {str(k): line for k, (_, line) in enumerate(found, 1)}}
    return two_statements(made, count)


def _lines(text: str, names: set[str]) -> list[str]:
    if is_program(text) or "Symbol(" in text:
        return [text]
    changed = text
    for reader in READERS:
        changed = reader(changed)
    rows = numbered(changed, names)
    if rows is not None and len(rows) <= MOST_ROWS:
        return rows
    lines = [line for line in changed.split("\n") if line.strip()]
    cut = changed != text and 1 < len(lines) <= MOST_ROWS and all(line.count("=") == 1 for line in lines)
    if cut and not any(re.match(r"\s*[-+−*/]", line) for line in lines[1:]):
        return lines
    return [changed]
