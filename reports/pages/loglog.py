"""A plot with two logarithmic axes: coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

WIDTH, HEIGHT = 760, 430  # of the viewBox; the template draws to the same measures
LEFT, RIGHT, TOP, BOTTOM = 74, 16, 14, 46
MOST_TICKS = 12
KINDS = 8  # of marks, and of colours


@dataclass(frozen=True)
class Series:
    """A line with a mark at each point (x, y, in words); ``colour`` and ``mark`` are numbers below :data:`KINDS`."""

    name: str
    points: tuple[tuple[float, float, str], ...]
    colour: int
    mark: int
    dashed: bool = False


@dataclass(frozen=True)
class Line:
    """A series in the units of the viewBox: ``path`` for the line, (x, y, words) for the marks."""

    series: Series
    path: str
    marks: tuple[tuple[float, float, str], ...]


@dataclass(frozen=True)
class LogLog:
    """Ticks are (place, exponent of ten)."""

    lines: tuple[Line, ...]
    x_ticks: tuple[tuple[float, str], ...]
    y_ticks: tuple[tuple[float, str], ...]
    front: str  # the path of a staircase below which nothing was measured; empty for none


def draw(
    series: Sequence[Series], *, falling_x: bool = False, front: Sequence[tuple[float, float]] = ()
) -> LogLog | None:
    """Series to scale; None where there is no point. x and y must be positive.

    ``falling_x``: the largest x on the left. ``front``: points (x, y) of a staircase, from the largest x.
    """
    points = [point for one in series for point in one.points]
    if not points:
        return None
    across = _axis([x for x, _, _ in points], LEFT, WIDTH - RIGHT, falling_x)
    up = _axis([y for _, y, _ in points], HEIGHT - BOTTOM, TOP, False)
    lines = tuple(
        Line(
            one,
            _path([(across.at(x), up.at(y)) for x, y, _ in one.points]),
            tuple((across.at(x), up.at(y), words) for x, y, words in one.points),
        )
        for one in series
        if one.points
    )
    stairs: list[tuple[float, float]] = []
    for x, y in front:
        if stairs:
            stairs.append((stairs[-1][0], up.at(y)))
        stairs.append((across.at(x), up.at(y)))
    return LogLog(lines, across.ticks(), up.ticks(), _path(stairs))


@dataclass(frozen=True)
class _Axis:
    """From ``low`` to ``high``, exponents of ten, drawn from ``start`` to ``stop``."""

    low: int
    high: int
    start: float
    stop: float

    def at(self, value: float) -> float:
        part = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + (self.stop - self.start) * part

    def ticks(self) -> tuple[tuple[float, str], ...]:
        step = max(1, math.ceil((self.high - self.low) / MOST_TICKS))
        exponents = [e for e in range(self.low, self.high + 1) if e % step == 0]
        return tuple((self.at(10.0**e), str(e).replace("-", "−")) for e in exponents)


def _axis(values: Sequence[float], start: float, stop: float, falling: bool) -> _Axis:
    logs = [math.log10(value) for value in values]
    low, high = math.floor(min(logs)), math.ceil(max(logs))
    high = max(high, low + 1)
    return _Axis(low, high, stop, start) if falling else _Axis(low, high, start, stop)


def _path(points: Sequence[tuple[float, float]]) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) if len(points) > 1 else ""
