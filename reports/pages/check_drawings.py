"""What the page draws: a mechanism swung out, and errors against their bounds; coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...records.check import Result, SceneEntry
from ..report import against, share
from ..words import figure, printable

MOST_LINKS = 200  # drawn of a longer mechanism; more cannot be told apart in a picture of this size

# Error plot, in the units of its own viewBox.
WIDTH, LEFT, RIGHT = 900, 250, 110  # the template draws to the same measures
LANE, ROW_PADDING = 9, 10  # every engine has a lane of its own in a check's row, so that no mark covers another
TOP, BOTTOM = 22, 40
ZERO_ROOM = 44  # for errors that are exactly zero, left of the logarithmic axis
DECADES = (-6, 12)  # what the axis shows at most; what lies outside stands at its end


@dataclass(frozen=True)
class Mechanism:
    """Lines (x1, y1, x2, y2) and bobs (x, y, r) in a box of ``width`` × ``height``; the support is at ``support``."""

    width: float
    height: float
    support: tuple[float, float]
    lines: tuple[tuple[float, float, float, float], ...]
    bobs: tuple[tuple[float, float, float], ...]
    left_out: int


@dataclass(frozen=True)
class Mark:
    """One engine's error: where, which engine (its place in the report's order), and in words."""

    x: float
    y: float
    engine: int
    words: str


@dataclass(frozen=True)
class Row:
    """One check: where its row begins and its middle is, and what is allowed, in words."""

    check: str
    top: float
    y: float
    allowed: str
    marks: tuple[Mark, ...]


@dataclass(frozen=True)
class ErrorPlot:
    """Errors as multiples of what is allowed, on a logarithmic axis; ``ticks`` are (x, exponent)."""

    height: float
    rows: tuple[Row, ...]
    ticks: tuple[tuple[float, str], ...]
    bound: float
    zero: float | None


def draw_mechanism(scene: SceneEntry, size: float = 150.0) -> Mechanism:
    """The links to scale. At rest they would hang on top of one another, so they are drawn swung out."""
    lengths = scene.lengths[:MOST_LINKS]
    angles = _swung(scene.system, len(lengths))
    tips: list[tuple[float, float]] = []
    segments = []
    for j, (length, angle) in enumerate(zip(lengths, angles, strict=True)):
        start = (0.0, 0.0) if j == 0 else tips[0] if scene.system == "n-leg" else tips[-1]
        tips.append((start[0] + length * math.sin(angle), start[1] + length * math.cos(angle)))
        segments.append((start, tips[-1]))
    across = [0.0, *(x for x, _ in tips)]
    down = [0.0, *(y for _, y in tips)]
    margin = 12.0
    scale = (size - 2 * margin) / (max(max(across) - min(across), max(down) - min(down)) or 1.0)
    left, top = margin - scale * min(across), margin - scale * min(down)

    def placed(point: tuple[float, float]) -> tuple[float, float]:
        return left + scale * point[0], top + scale * point[1]

    heaviest = max(scene.masses, default=1.0)
    bobs = [(*placed(tip), 2 + 4 * (mass / heaviest) ** (1 / 3)) for tip, mass in zip(tips, scene.masses, strict=False)]
    return Mechanism(
        width=2 * margin + scale * (max(across) - min(across)),
        height=2 * margin + scale * (max(down) - min(down)),
        support=placed((0.0, 0.0)),
        lines=tuple((*placed(start), *placed(end)) for start, end in segments),
        bobs=tuple(bobs) if scene.system == "n-leg" else (),
        left_out=len(scene.lengths) - len(lengths),
    )


def _swung(system: str, n: int) -> list[float]:
    """Angles that show every link: legs fanned out, a chain in a bow."""
    if system == "n-leg":
        legs = n - 1
        return [0.35, *(1.1 if legs == 1 else -1.1 + 2.2 * k / (legs - 1) for k in range(legs))][:n]
    return [0.9 - 1.5 * j / max(n - 1, 1) for j in range(n)]


def draw_errors(results: Sequence[Result], engines: Sequence[str]) -> ErrorPlot | None:
    """A row a check, a mark an engine; None where nothing was measured against a bound."""
    shown = [(result, value) for result in results if (value := share(result)) is not None]
    if not shown:
        return None
    place = {engine: i for i, engine in enumerate(engines)}
    logarithms = [math.log10(value) for _, value in shown if 0 < value < math.inf]
    low = max(math.floor(min([-1.0, *logarithms])), DECADES[0])
    high = min(math.ceil(max([1.0, *logarithms])), DECADES[1])
    zero = LEFT + 14 if any(value == 0 for _, value in shown) else None
    start = LEFT + (ZERO_ROOM if zero else 0) + 6
    stop = WIDTH - RIGHT - 6

    def across(value: float) -> float:
        if value == 0 and zero is not None:
            return zero
        exponent = min(max(math.log10(value), low), high) if value < math.inf else high
        return start + (stop - start) * (exponent - low) / (high - low)

    row_height = LANE * len(engines) + ROW_PADDING
    rows = []
    checks = dict.fromkeys(result.check for result, _ in shown)
    for i, check in enumerate(checks):
        top = TOP + i * row_height
        lanes = top + ROW_PADDING / 2
        of_check = [(result, value) for result, value in shown if result.check == check]
        marks = tuple(
            Mark(
                across(value),
                lanes + LANE * (place[result.engine] + 0.5),
                place[result.engine],
                f"{result.engine}, {result.check}: {against(result)}",
            )
            for result, value in of_check
        )
        rows.append(Row(check, top, top + row_height / 2, _allowed([result for result, _ in of_check]), marks))
    step = max(1, math.ceil((high - low) / 10))
    ticks = [exponent for exponent in range(low, high + 1) if exponent % step == 0]
    return ErrorPlot(
        height=TOP + len(rows) * row_height + BOTTOM,
        rows=tuple(rows),
        ticks=tuple((across(10.0**exponent), str(exponent).replace("-", "−")) for exponent in ticks),
        bound=across(1.0),
        zero=zero,
    )


def _allowed(results: Sequence[Result]) -> str:
    bounds = sorted({result.allowed for result in results if result.allowed is not None})
    unit = results[0].unit
    if len(bounds) > 1:
        return f"{figure(bounds[0])} … {figure(bounds[-1])} {unit}"
    return f"{figure(bounds[0])} {unit}"


# Small drawing of one horizon, in the units of its own viewBox; the template draws to the same measures.
HORIZON_WIDTH, HORIZON_HEIGHT, HORIZON_LEFT, HORIZON_BOTTOM = 230, 130, 34, 18
HORIZON_DECADES = (-16, 1)  # rad


@dataclass(frozen=True)
class HorizonPlot:
    """Predicted and measured error over time, as points of two lines, for one engine, integrator and step."""

    title: str
    predicted: str
    measured: str
    end: float  # s
    ticks: tuple[tuple[float, int], ...]  # y, exponent of ten
    words: str


def draw_horizons(results: Sequence[Result]) -> tuple[HorizonPlot, ...]:
    """One for each result that carries its errors over time."""
    return tuple(_horizon(result) for result in results if _history(result))


def _history(result: Result) -> list[tuple[float, float | None, float | None]]:
    found = result.details.get("errors over time")
    rows = found if isinstance(found, list) else []
    return [(row[0], row[1], row[2]) for row in rows if isinstance(row, list) and len(row) == 3 and _number(row[0])]


def _number(value: object) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool)


def _horizon(result: Result) -> HorizonPlot:
    rows = _history(result)
    end = max(float(time) for time, _, _ in rows) or 1.0
    return HorizonPlot(
        title=printable(f"{result.engine} {result.check.removeprefix('horizon ')}, {figure(_step(result))} s"),
        predicted=_line(rows, 1, end),
        measured=_line(rows, 2, end),
        end=end,
        ticks=tuple((_height(10.0**exponent), exponent) for exponent in (-15, -10, -5, 0)),
        words=result.reason,
    )


def _step(result: Result) -> float | None:
    step = result.details.get("step")
    return step if isinstance(step, float) else None


def _line(rows: Sequence[tuple[float, float | None, float | None]], column: int, end: float) -> str:
    """Points of an SVG polyline; times without a figure are left out."""
    width = HORIZON_WIDTH - HORIZON_LEFT - 6
    points = []
    for row in rows:
        value = row[column]
        if value is not None and _number(value) and value > 0:
            points.append(f"{HORIZON_LEFT + width * row[0] / end:.1f},{_height(float(value)):.1f}")
    return " ".join(points)


def _height(error: float) -> float:
    low, high = HORIZON_DECADES
    share_up = (min(max(math.log10(error), low), high) - low) / (high - low)
    return round((HORIZON_HEIGHT - HORIZON_BOTTOM) * (1 - share_up) + 4 * share_up, 1)
