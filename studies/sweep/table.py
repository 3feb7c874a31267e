"""A chunk's results on one engine as a Parquet file: made, read, and known by what it says of itself."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

import msgspec

from ...models.errors import library
from ...records.sweep import SweepMark, SweepRow

KEY = b"furiko"
PREFIX = "p_"  # of a parameter's column
_marks = msgspec.json.Decoder(SweepMark)


def column(parameter: str) -> str:
    """The column of a parameter."""
    return PREFIX + parameter


@cache
def _schema(parameters: tuple[str, ...]) -> Any:
    arrow = library("pyarrow")
    kinds = {int: arrow.int64(), float: arrow.float64(), bool: arrow.bool_()}
    hints = get_type_hints(SweepRow)
    fields = [
        (name, kinds.get(hints[name]) or (arrow.float64() if hints[name] == float | None else arrow.string()))
        for name in SweepRow.__struct_fields__
        if name != "parameters"
    ]
    return arrow.schema([*fields, *((column(name), arrow.float64()) for name in parameters)])


def to_parquet(rows: Sequence[SweepRow], mark: SweepMark, parameters: Sequence[str]) -> bytes:
    """The file's content. Raises :class:`furiko.LibraryMissing`."""
    arrow, parquet = library("pyarrow"), library("pyarrow.parquet")
    schema = _schema(tuple(parameters))
    names = [name for name in SweepRow.__struct_fields__ if name != "parameters"]
    columns: list[list[Any]] = [[getattr(row, name) for row in rows] for name in names]
    columns += [[row.parameters.get(name) for row in rows] for name in parameters]
    arrays = [arrow.array(values, type=field.type) for values, field in zip(columns, schema, strict=True)]
    marked = schema.with_metadata({KEY: msgspec.json.encode(mark)})
    with io.BytesIO() as file:
        parquet.write_table(arrow.Table.from_arrays(arrays, schema=marked), file, compression="zstd")
        return file.getvalue()


def mark_of(path: Path) -> SweepMark | None:
    """What a file says of itself; None for one that is damaged or none of a sweep's."""
    arrow, parquet = library("pyarrow"), library("pyarrow.parquet")
    try:
        metadata = parquet.read_metadata(path)
        mark = _marks.decode((metadata.metadata or {}).get(KEY, b""))
    except (OSError, arrow.ArrowException, msgspec.MsgspecError):
        return None
    return mark if mark.rows == metadata.num_rows else None


def cells_of(path: Path) -> list[int] | None:
    """The numbers of the cells in a file, in the order of their rows; None where it cannot be read."""
    arrow, parquet = library("pyarrow"), library("pyarrow.parquet")
    try:
        found: list[int] = parquet.read_table(path, columns=["cell"], partitioning=None).column("cell").to_pylist()
    except (OSError, arrow.ArrowException, KeyError):
        return None
    return found


def finite(details: Mapping[str, Any], name: str) -> float | None:
    """A number of a result's details; None where there is none."""
    value = details.get(name)
    return float(value) if isinstance(value, int | float) else None
