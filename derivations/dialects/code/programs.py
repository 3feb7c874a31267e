"""All readers of this folder on a file whose one equation is a program."""

from __future__ import annotations

from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import rows_of
from ..table import known_of
from .entries import filled
from .julia import plain_julia
from .loops import unrolled
from .pointers import from_pointers, from_struct


def plain_programs(data: dict[str, Any], count: int) -> dict[str, Any]:
    """The fields with the program in statements that are followed. ``count``: the coordinates."""
    rows, define = rows_of(data), data.get("define", {})
    if len(rows) != 1 or "=" not in rows[0][1] or not isinstance(define, dict):
        return data
    label, text = rows[0]
    try:
        pointed = from_pointers(text, known_of(data).coordinates)
        if pointed:
            made = {str(k): row for k, row in enumerate(pointed[0], 1)}
            return data | {"equations": made, "define": {**define, **pointed[1]}}
        changed = filled(unrolled(plain_julia(from_struct(text)), count))
    except InvalidInput as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    return data | {"equations": {label: changed}} if changed != text else data
