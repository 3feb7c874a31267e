"""A plot of lines and marks on two axes: coordinates only; ``plot.html.j2`` draws them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .axes import Axis, Tick, fits, linear_axis, log_axis, path

KINDS = 8  # of marks, and of colours
LINEAR_TICKS = 6  # at most, on a linear axis
MOST_POINTS = 400  # of a line without marks; more cannot be told apart

Point = tuple[float, float, str]
Points = Sequence[tuple[float, float]]  # without words


@dataclass(frozen=True)
class Frame:
    """Size of a drawing and the edges of the plot in it; ``decades``: most ticks on a logarithmic axis."""

    width: float
    height: float
    left: float
    right: float
    top: float
    bottom: float
    decades: int


LARGE = Frame(760, 430, left=74, right=744, top=14, bottom=384, decades=12)
SMALL = Frame(520, 300, left=62, right=500, top=12, bottom=256, decades=8)


@dataclass(frozen=True)
class Series:
    """A line through points (x, y, what a mark says when pointed at).

    ``colour`` and ``mark`` are numbers below :data:`KINDS`; no marks are drawn where ``mark`` is None. ``group``: what
    it is shown and hidden with, as its engine; empty for itself alone. ``joined``: a line goes through the marks.
    """

    name: str
    points: Sequence[Point]
    colour: int
    mark: int | None = None
    dashed: bool = False
    group: str = ""
    joined: bool = True


@dataclass(frozen=True)
class Line:
    """A series to scale: ``path`` for the line, (x, y, words) for the marks."""

    series: Series
    path: str
    marks: tuple[Point, ...]


@dataclass(frozen=True)
class Plot:
    """``front``: the path of a staircase below which nothing was measured; empty for none. ``across``, ``up``: the
    axes as the page's script reads them: low, high, start, stop, whether logarithmic."""

    title: str
    x_label: str
    y_label: str
    frame: Frame
    x_ticks: tuple[Tick, ...]
    y_ticks: tuple[Tick, ...]
    lines: tuple[Line, ...]
    front: str
    across: str
    up: str


def draw(
    series: Sequence[Series],
    x_label: str,
    y_label: str,
    *,
    title: str = "",
    frame: Frame = SMALL,
    log_x: bool = False,
    log_y: bool = False,
    falling_x: bool = False,
    front: Sequence[tuple[float, float]] = (),
) -> Plot | None:
    """Series to scale; None where no point is left.

    Points that an axis cannot show are left out (not finite; not above zero on a logarithmic axis). ``falling_x``: the
    largest x is on the left. ``front``: points (x, y) of a staircase, from the largest x.
    """
    kept = [(one, [p for p in one.points if fits(p[0], log_x) and fits(p[1], log_y)]) for one in series]
    kept = [(one, points) for one, points in kept if points]
    if not kept:
        return None
    ends = (frame.right, frame.left) if falling_x else (frame.left, frame.right)
    across = (log_axis if log_x else linear_axis)([x for _, points in kept for x, _, _ in points], *ends)
    up = (log_axis if log_y else linear_axis)([y for _, points in kept for _, y, _ in points], frame.bottom, frame.top)
    return Plot(
        title,
        x_label,
        y_label,
        frame,
        across.ticks(frame.decades if log_x else LINEAR_TICKS),
        up.ticks(frame.decades if log_y else LINEAR_TICKS),
        tuple(_line(one, points, across, up) for one, points in kept),
        path(_stairs(front, across, up)),
        _axis(across),
        _axis(up),
    )


def _axis(axis: Axis) -> str:
    return json.dumps([axis.low, axis.high, axis.start, axis.stop, axis.log])


def _line(series: Series, points: Sequence[Point], across: Axis, up: Axis) -> Line:
    placed = [(across.at(x), up.at(y), words) for x, y, words in points]
    if series.mark is not None:
        return Line(series, path([(x, y) for x, y, _ in placed]) if series.joined else "", tuple(placed))
    thinned = placed[:: max(1, len(placed) // MOST_POINTS)]
    return Line(series, path([(x, y) for x, y, _ in thinned]), ())


def _stairs(points: Sequence[tuple[float, float]], across: Axis, up: Axis) -> list[tuple[float, float]]:
    stairs: list[tuple[float, float]] = []
    for x, y in points:
        if stairs:
            stairs.append((stairs[-1][0], up.at(y)))
        stairs.append((across.at(x), up.at(y)))
    return stairs


def to_series(lines: Mapping[str, Points], *, marked: bool = False, order: Sequence[str] = ()) -> list[Series]:
    """A series for each line; its colour, and its mark if ``marked``, by its place in ``order``, else in ``lines``."""
    places = {name: i % KINDS for i, name in enumerate(order or lines)}
    return [
        Series(
            name,
            [(x, y, f"{name}: {x:.4g}, {y:.3g}" if marked else "") for x, y in points],
            places[name],
            places[name] if marked else None,
        )
        for name, points in lines.items()
    ]
