"""All readers of this folder on a file whose one equation is a program."""

from __future__ import annotations

from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import rows_of
from .entries import filled
from .loops import unrolled


def plain_programs(data: dict[str, Any], count: int) -> dict[str, Any]:
    """The fields with the program in statements that are followed. ``count``: the coordinates."""
    rows, define = rows_of(data), data.get("define", {})
    if len(rows) != 1 or "=" not in rows[0][1] or not isinstance(define, dict):
        return data
    label, text = rows[0]
    try:
        changed = filled(unrolled(text, count))
    except InvalidInput as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    return data | {"equations": {label: changed}} if changed != text else data
