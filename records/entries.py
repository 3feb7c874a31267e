"""A matrix of the equations of motion, entry by entry, among a result's details: what reports draw as a heat map."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

ENTRIES = "entries"  # its name among the details
LARGEST = 12  # rows or columns: a picture of more is not read entry by entry
_HUGE = 1e300  # stands for infinity, which JSON does not have

Rows = Sequence[Sequence[float]]


class Entries(msgspec.Struct, frozen=True, kw_only=True):
    """One matrix in one state: that in which the engine is furthest off.

    ``theory``: what the equations of motion say; ``error``: the engine's less that; ``roundings``: the error over one ε
    of the entry's terms; ``allowed``: so many of them are explained by rounding.
    """

    state: str
    rows: list[str]
    columns: list[str]
    theory: list[list[float]]
    error: list[list[float]]
    roundings: list[list[float]]
    allowed: float


def to_entries(
    state: str, rows: Sequence[str], columns: Sequence[str], theory: Rows, error: Rows, roundings: Rows, allowed: float
) -> dict[str, Any]:
    """As an entry of a result's details; nothing where the matrix is too large to be read."""
    if not rows or len(rows) > LARGEST or len(columns) > LARGEST:
        return {}
    made = Entries(
        state=state,
        rows=list(rows),
        columns=list(columns),
        theory=_rounded(theory, 9),
        error=_rounded(error, 3),
        roundings=_rounded(roundings, 3),
        allowed=allowed,
    )
    return {ENTRIES: msgspec.structs.asdict(made)}


def entries_in(details: Mapping[str, Any]) -> Entries | None:
    """What a stream has; None where there is nothing, or not what it should be."""
    try:
        found = msgspec.convert(details.get(ENTRIES), Entries)
    except msgspec.ValidationError:
        return None
    height, width = len(found.rows), len(found.columns)
    tables = (found.theory, found.error, found.roundings)
    whole = all(len(table) == height and all(len(row) == width for row in table) for table in tables)
    finite = all(math.isfinite(value) for table in tables for row in table for value in row)
    sound = finite and math.isfinite(found.allowed) and found.allowed > 0
    return found if whole and sound and 0 < height <= LARGEST and 0 < width <= LARGEST else None


def _rounded(table: Rows, digits: int) -> list[list[float]]:
    return [[float(f"{min(max(float(value), -_HUGE), _HUGE):.{digits}g}") for value in row] for row in table]
