"""What the stress test's pages draw: lines on two axes, and maps of coloured cells; coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

WIDTH, HEIGHT = 520.0, 300.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 14.0, 12.0, 44.0
MOST_POINTS = 400  # of a line; more cannot be told apart

Points = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Line:
    """A line's points as an SVG attribute, its marks (x, y, in words), its colour's number, and its name."""

    points: str
    marks: tuple[tuple[float, float, str], ...]
    colour: int
    name: str


@dataclass(frozen=True)
class Plot:
    """Lines in a frame; ``across`` and ``up`` are ticks (place, label)."""

    title: str
    across_label: str
    up_label: str
    across: tuple[tuple[float, str], ...]
    up: tuple[tuple[float, str], ...]
    lines: tuple[Line, ...]
    width: float = WIDTH
    height: float = HEIGHT
    left: float = LEFT
    right: float = WIDTH - RIGHT
    top: float = TOP
    bottom: float = HEIGHT - BOTTOM


def draw(
    title: str,
    lines: Mapping[str, Points],
    across_label: str,
    up_label: str,
    *,
    log_x: bool = False,
    log_y: bool = False,
    marked: bool = False,
    colours: Mapping[str, int] | None = None,
) -> Plot | None:
    """A plot of named lines; points that a logarithmic axis cannot hold are left out. None where nothing is left."""
    kept = {name: [(x, y) for x, y in points if _fits(x, log_x) and _fits(y, log_y)] for name, points in lines.items()}
    kept = {name: points for name, points in kept.items() if points}
    if not kept:
        return None
    xs, ys = ([_scaled(p[i], log) for points in kept.values() for p in points] for i, log in ((0, log_x), (1, log_y)))
    x_range, y_range = _range(xs, log_x), _range(ys, log_y)

    def place(x: float, y: float) -> tuple[float, float]:
        right = LEFT + (WIDTH - LEFT - RIGHT) * (_scaled(x, log_x) - x_range[0]) / (x_range[1] - x_range[0])
        down = HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (_scaled(y, log_y) - y_range[0]) / (y_range[1] - y_range[0])
        return round(right, 1), round(down, 1)

    drawn = []
    for number, (name, points) in enumerate(kept.items()):
        placed = [place(x, y) for x, y in points]
        thinned = placed[:: max(1, len(placed) // MOST_POINTS)]
        marks = (
            tuple((*at, f"{name}: {x:.4g}, {y:.3g}") for at, (x, y) in zip(placed, points, strict=True))
            if marked
            else ()
        )
        colour = (colours or {}).get(name, number) % 8
        drawn.append(Line(" ".join(f"{x},{y}" for x, y in thinned), marks, colour, name))
    return Plot(
        title,
        across_label,
        up_label,
        tuple((place(_unscaled(v, log_x), _unscaled(y_range[0], log_y))[0], w) for v, w in _ticks(x_range, log_x)),
        tuple((place(_unscaled(x_range[0], log_x), _unscaled(v, log_y))[1], w) for v, w in _ticks(y_range, log_y)),
        tuple(drawn),
    )


@dataclass(frozen=True)
class Square:
    """One cell of a map: where, which kind, whether it was looked at or follows from others, and in words."""

    x: float
    y: float
    kind: int
    measured: bool
    words: str


@dataclass(frozen=True)
class Map:
    """Cells of ``size`` in columns and rows with their labels (place, words)."""

    title: str
    width: float
    height: float
    size: tuple[float, float]
    squares: tuple[Square, ...]
    columns: tuple[tuple[float, str], ...]
    rows: tuple[tuple[float, str], ...]


CELL = (30.0, 9.0)
MAP_LEFT, MAP_TOP, MAP_BOTTOM = 70.0, 6.0, 34.0


def draw_map(
    title: str,
    columns: Sequence[tuple[str, Mapping[int, int], int]],
    rows: Sequence[str],
    kinds: Sequence[str],
) -> Map:
    """A map: for each column its label, the kind of every row that was looked at, and the last row that holds.

    What was not looked at follows: rows up to the frontier hold (kind 0), those above fail as the next one below did.
    """
    squares = []
    for i, (label, found, holds) in enumerate(columns):
        last = 0
        for row in range(len(rows)):
            measured = row in found
            last = found[row] if measured else 0 if row <= holds else last
            words = f"{label}, step {rows[row]}: {kinds[last]}{'' if measured else ' (follows)'}"
            y = MAP_TOP + (len(rows) - 1 - row) * CELL[1]
            squares.append(Square(MAP_LEFT + i * CELL[0], y, last, measured, words))
    bottom = MAP_TOP + len(rows) * CELL[1]
    marked = [(bottom - (row + 0.25) * CELL[1], words) for row, words in enumerate(rows) if row % 4 == 0]
    return Map(
        title,
        MAP_LEFT + len(columns) * CELL[0] + 10,
        bottom + MAP_BOTTOM,
        CELL,
        tuple(squares),
        tuple((MAP_LEFT + (i + 0.5) * CELL[0], label) for i, (label, _, _) in enumerate(columns)),
        tuple(marked),
    )


@dataclass(frozen=True)
class Picture:
    """Curves of one instant, to one scale, in a square: points as an SVG attribute, colour's number, name."""

    title: str
    size: float
    curves: tuple[tuple[str, int, str], ...]
    support: tuple[float, float]


def draw_curves(
    title: str, curves: Mapping[str, Sequence[Sequence[float]]], reach: float, size: float = 240.0
) -> Picture:
    """Chains hanging from one support, each with joints (x, z) [m]."""
    scale = size / (2 * reach)

    def place(point: Sequence[float]) -> str:
        return f"{size / 2 + scale * point[0]:.1f},{size / 5 - scale * point[1]:.1f}"

    drawn = tuple(
        (" ".join(map(place, [(0.0, 0.0), *points])), number % 8, name)
        for number, (name, points) in enumerate(curves.items())
    )
    return Picture(title, size, drawn, (size / 2, size / 5))


def _fits(value: float | None, log: bool) -> bool:
    return value is not None and math.isfinite(value) and (not log or value > 0)


def _scaled(value: float, log: bool) -> float:
    return math.log10(value) if log else value


def _unscaled(value: float, log: bool) -> float:
    return 10.0**value if log else value


def _range(values: Sequence[float], log: bool) -> tuple[float, float]:
    low, high = min(values), max(values)
    if log:
        low, high = float(math.floor(low + 1e-9)), float(math.ceil(high - 1e-9))
    elif low > 0 and low < 0.5 * high:
        low = 0.0
    if high <= low:
        high, low = low + 1, low - (0 if log else 1)
    return low, high


def _ticks(span: tuple[float, float], log: bool) -> list[tuple[float, str]]:
    low, high = span
    if log:
        decades = max(1, math.ceil((high - low) / 8))
        return [(float(e), f"1e{e}".replace("-", "−")) for e in range(round(low), round(high) + 1, decades)]
    step = 10.0 ** math.floor(math.log10((high - low) / 4))
    step *= next(m for m in (1, 2, 5, 10) if (high - low) / (step * m) <= 6)
    first = math.ceil(low / step - 1e-9)
    return [(k * step, f"{k * step:.6g}") for k in range(first, math.floor(high / step + 1e-9) + 1)]
