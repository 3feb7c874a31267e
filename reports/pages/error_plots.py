"""Plots of a scene's errors: against their bounds, and over time; coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...records.check import Result
from ..report import against, share
from ..words import figure, printable
from .axes import Axis, Tick, path

# Errors against their bounds, in the units of the plot's own viewBox.
WIDTH, LEFT, RIGHT = 900, 250, 110
LANE, ROW_PADDING = 9, 10  # every engine has a lane of its own in a check's row, so that no mark covers another
TOP, BOTTOM = 22, 40
ZERO_ROOM = 44  # for errors that are exactly zero, left of the logarithmic axis
DECADES = (-6, 12)  # largest range of the axis; errors beyond it are drawn at its end
MOST_TICKS = 10


@dataclass(frozen=True)
class ErrorMark:
    """One engine's error: where, which engine (its place in the report's order), and in words."""

    x: float
    y: float
    engine: int
    words: str


@dataclass(frozen=True)
class CheckRow:
    """One check: where its row begins and its middle is, and what is allowed, in words."""

    check: str
    top: float
    y: float
    allowed: str
    marks: tuple[ErrorMark, ...]


@dataclass(frozen=True)
class ErrorPlot:
    """Errors as multiples of what is allowed, on a logarithmic axis; ``bound`` and ``zero``: where 1 and 0 stand."""

    width: float
    height: float
    left: float
    right: float
    rows: tuple[CheckRow, ...]
    ticks: tuple[Tick, ...]
    bound: float
    zero: float | None


def draw_errors(results: Sequence[Result], engines: Sequence[str]) -> ErrorPlot | None:
    """A row a check, a mark an engine; None where nothing was measured against a bound."""
    shown = [(result, value) for result in results if (value := share(result)) is not None]
    if not shown:
        return None
    zero = LEFT + 14 if any(value == 0 for _, value in shown) else None
    axis = _share_axis([value for _, value in shown], LEFT + (ZERO_ROOM if zero else 0) + 6)
    height = LANE * len(engines) + ROW_PADDING
    rows = []
    for i, check in enumerate(dict.fromkeys(result.check for result, _ in shown)):
        top = TOP + i * height
        of_check = [(result, value) for result, value in shown if result.check == check]
        marks = tuple(
            _mark(result, zero if value == 0 and zero else axis.at(value), top, engines) for result, value in of_check
        )
        rows.append(CheckRow(check, top, top + height / 2, _allowed([result for result, _ in of_check]), marks))
    return ErrorPlot(
        width=WIDTH,
        height=TOP + len(rows) * height + BOTTOM,
        left=LEFT,
        right=WIDTH - RIGHT,
        rows=tuple(rows),
        ticks=axis.ticks(MOST_TICKS),
        bound=axis.at(1.0),
        zero=zero,
    )


def _share_axis(shares: Sequence[float], start: float) -> Axis:
    """Decades that hold the errors, the bound and a decade to each side of it, as far as :data:`DECADES` go."""
    logarithms = [math.log10(value) for value in shares if 0 < value < math.inf]
    low = max(math.floor(min([-1.0, *logarithms])), DECADES[0])
    high = min(math.ceil(max([1.0, *logarithms])), DECADES[1])
    return Axis(low, high, start, WIDTH - RIGHT - 6, log=True)


def _mark(result: Result, x: float, top: float, engines: Sequence[str]) -> ErrorMark:
    engine = engines.index(result.engine)
    y = top + ROW_PADDING / 2 + LANE * (engine + 0.5)
    return ErrorMark(x, y, engine, f"{result.engine}, {result.check}: {against(result)}")


def _allowed(results: Sequence[Result]) -> str:
    bounds = sorted({result.allowed for result in results if result.allowed is not None})
    unit = results[0].unit
    if len(bounds) > 1:
        return f"{figure(bounds[0])} … {figure(bounds[-1])} {unit}"
    return f"{figure(bounds[0])} {unit}"


# Errors over time: a small drawing, in the units of its own viewBox.
SMALL_WIDTH, SMALL_HEIGHT = 230, 130
SMALL_LEFT, SMALL_RIGHT, SMALL_TOP, SMALL_BOTTOM = 34, 224, 4, 112
ANGLES = Axis(-16, 1, SMALL_BOTTOM, SMALL_TOP, log=True)  # rad
ANGLE_TICKS = 4

ErrorHistory = Sequence[tuple[float, float | None, float | None]]  # times [s], errors predicted and measured [rad]


@dataclass(frozen=True)
class HorizonPlot:
    """Predicted and measured error over time, as the paths of two lines, for one engine, integrator and step."""

    title: str
    width: float
    height: float
    left: float
    right: float
    predicted: str
    measured: str
    end: float  # s
    ticks: tuple[Tick, ...]
    words: str


def draw_horizons(results: Sequence[Result]) -> tuple[HorizonPlot, ...]:
    """One for each result that carries its errors over time."""
    return tuple(_horizon(result, history) for result in results if (history := _history(result)))


def _history(result: Result) -> ErrorHistory:
    found = result.details.get("errors over time")
    rows = found if isinstance(found, list) else []
    return [(row[0], row[1], row[2]) for row in rows if isinstance(row, list) and len(row) == 3 and _number(row[0])]


def _number(value: object) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool)


def _horizon(result: Result, history: ErrorHistory) -> HorizonPlot:
    end = max(float(time) for time, _, _ in history) or 1.0
    across = Axis(0.0, end, SMALL_LEFT, SMALL_RIGHT)
    step = result.details.get("step")
    said = figure(step if isinstance(step, float) else None)
    return HorizonPlot(
        title=printable(f"{result.engine} {result.check.removeprefix('horizon ')}, {said} s"),
        width=SMALL_WIDTH,
        height=SMALL_HEIGHT,
        left=SMALL_LEFT,
        right=SMALL_RIGHT,
        predicted=_curve([(time, error) for time, error, _ in history], across),
        measured=_curve([(time, error) for time, _, error in history], across),
        end=end,
        ticks=ANGLES.ticks(ANGLE_TICKS),
        words=result.reason,
    )


def _curve(points: Sequence[tuple[float, float | None]], across: Axis) -> str:
    """The path of a line; times without a figure are left out."""
    return path(
        [
            (across.at(time), ANGLES.at(float(error)))
            for time, error in points
            if error is not None and _number(error) and error > 0
        ]
    )
