"""Fits the tables of a TOML file into typed records, and says which field is wrong."""

from __future__ import annotations

import re
from typing import Any, TypeVar, get_args, get_type_hints

import msgspec

from ..errors import InvalidInput, nearest

R = TypeVar("R", bound=msgspec.Struct)


def fitted(tables: dict[str, Any], record: type[R]) -> R:
    """``tables`` as a record of this type. Raises :class:`InvalidInput` with the field in front."""
    try:
        return msgspec.convert(tables, record)
    except msgspec.ValidationError as error:
        raise InvalidInput(_field_first(str(error), record)) from None


def _field_first(message: str, record: type[msgspec.Struct]) -> str:
    """msgspec's ``Expected `float`, got `str` - at `$.system.lengths[0]``` with the field in front."""
    unknown = re.fullmatch(r"Object contains unknown field `(.*?)`(?: - at `\$\.?(.*)`)?", message, re.DOTALL)
    if unknown:
        field, table = unknown[1], unknown[2] or ""
        fields = _record_at(record, table).__struct_fields__
        where = f"{table}.{field}" if table else field
        return f"{where}: unknown field{nearest(field, fields)}; known are {', '.join(fields)}"
    what, _, where = message.partition(" - at `$.")
    return f"{where.rstrip('`')}: {_lower(what)}" if where else _lower(message)


def _record_at(record: type[msgspec.Struct], path: str) -> type[msgspec.Struct]:
    """The record that a table is fitted into; ``path``: ``system.links[0].joints[1]``."""
    for field in re.findall(r"(\w+)(?:\[[^\]]*\])?", path):
        record = next(part for part in _parts(get_type_hints(record)[field]) if issubclass(part, msgspec.Struct))
    return record


def _parts(annotation: Any) -> list[type]:
    """The classes in an annotation such as ``list[Link] | None``."""
    if isinstance(annotation, type) and not get_args(annotation):
        return [annotation]
    return [part for argument in get_args(annotation) for part in _parts(argument)]


def _lower(sentence: str) -> str:
    return (sentence[:1].lower() + sentence[1:]).replace("`", "'")
