"""A map of step size against number of rods, coloured by what fails first; coordinates only, no markup."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

SQUARE = (30.0, 9.0)  # width and height of one square
LEFT, TOP, BOTTOM, RIGHT = 70.0, 6.0, 34.0, 10.0
LABELLED = 4  # every fourth row has its label


@dataclass(frozen=True)
class Square:
    """One run, or what follows from others: where, which kind of failure (0: it holds), and in words."""

    x: float
    y: float
    kind: int
    measured: bool
    words: str


@dataclass(frozen=True)
class StabilityMap:
    """Squares of ``size`` in columns and rows with their labels (place, words)."""

    title: str
    width: float
    height: float
    left: float
    size: tuple[float, float]
    squares: tuple[Square, ...]
    columns: tuple[tuple[float, str], ...]
    rows: tuple[tuple[float, str], ...]


@dataclass(frozen=True)
class Column:
    """``runs``: the kind of failure (0: none) of every row that was run; ``holds``: the last row that holds."""

    label: str
    runs: Mapping[int, int]
    holds: int


def draw_map(title: str, columns: Sequence[Column], rows: Sequence[str], kinds: Sequence[str]) -> StabilityMap:
    """The map, first row at the bottom; ``rows`` and ``kinds`` in words.

    What was not run follows: rows up to the last that holds hold, those above fail as the next one below did.
    """
    bottom = TOP + len(rows) * SQUARE[1]
    return StabilityMap(
        title,
        LEFT + len(columns) * SQUARE[0] + RIGHT,
        bottom + BOTTOM,
        LEFT,
        SQUARE,
        tuple(square for i, column in enumerate(columns) for square in _squares(i, column, rows, kinds)),
        tuple((LEFT + (i + 0.5) * SQUARE[0], column.label) for i, column in enumerate(columns)),
        tuple((bottom - (i + 0.25) * SQUARE[1], words) for i, words in enumerate(rows) if i % LABELLED == 0),
    )


def _squares(place: int, column: Column, rows: Sequence[str], kinds: Sequence[str]) -> list[Square]:
    found = []
    kind = 0
    for i, row in enumerate(rows):
        measured = i in column.runs
        kind = column.runs[i] if measured else 0 if i <= column.holds else kind
        words = f"{column.label}, step {row}: {kinds[kind]}{'' if measured else ' (follows)'}"
        y = TOP + (len(rows) - 1 - i) * SQUARE[1]
        found.append(Square(LEFT + place * SQUARE[0], y, kind, measured, words))
    return found
