"""The page ``stress.html``: frontiers of accelerations, stable step sizes, long runs and failures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...models.writers.whole_file import write_whole
from ...records.check import Header
from ...records.stress import (
    HALF_THE_DIGITS,
    AxisFrontier,
    ConditionGrowth,
    EnergyDrift,
    StableStep,
    StressSummary,
)
from .chain_page import chain_page
from .plot import Plot, draw, to_series
from .rendering import render_with_plots

PAGE, CHAIN_PAGE = "stress.html", "chain.html"
HOLDS = "holds"
SMALLEST_ERROR = 1e-17  # errors of zero are drawn here
ROWS = 25  # of a stability map; from one to the next the step grows by √2
SQUARE = (30.0, 9.0)  # width and height of one square
LEFT, TOP, BOTTOM, RIGHT = 70.0, 6.0, 34.0, 10.0
LABELLED = 4  # every fourth row has its label


def write_pages(folder: Path, summary: StressSummary, header: Header) -> tuple[Path, Path]:
    """Write both pages into the folder, each whole or not at all; returns their paths."""
    return (
        write_whole(folder / PAGE, stress_page(summary, header)),
        write_whole(folder / CHAIN_PAGE, chain_page(summary, header)),
    )


def stress_page(summary: StressSummary, header: Header) -> str:
    """The whole page as text."""
    single = [f for f in summary.frontiers if not f.pair and f.mechanism is None]
    trees = [f for f in summary.frontiers if f.mechanism is not None]
    pairs = [f for f in summary.frontiers if f.pair]
    engines = list(dict.fromkeys(f.engine for f in summary.frontiers if f.mechanism is None))
    of_trees = list(dict.fromkeys(f.engine for f in trees))
    return render_with_plots(
        "stress.html.j2",
        ("style.css", "stress.css"),
        summary=summary,
        header=header,
        engines=engines,
        half=HALF_THE_DIGITS,
        rows=_by_axis(single, engines),
        trees=_by_axis(trees, of_trees),
        tree_engines=of_trees,
        pairs=[f for f in pairs if f.status == "fails"],
        pairs_asked=len(pairs),
        pairs_closed=sum(f.closed for f in pairs),
        curves=[plot for axis in _axes(single) if (plot := _curve(axis, single, engines))],
        condition=_condition(summary.condition),
        stresses=_stresses(summary.steps),
        maps=_maps(summary.steps),
        kinds=_kinds(summary.steps),
        long_runs=[run for run in summary.long_runs if run.steps],
        tree_runs=[run for run in summary.tree_runs if run.runs and run.failure != "refused"],
        drifts=[plot for run in summary.long_runs if (plot := _drift(run))],
    )


def _axes(frontiers: Sequence[AxisFrontier]) -> list[str]:
    return list(dict.fromkeys(f.axis for f in frontiers))


def _by_axis(
    frontiers: Sequence[AxisFrontier], engines: Sequence[str]
) -> list[tuple[AxisFrontier, list[AxisFrontier | None]]]:
    """Each axis (any of its frontiers, for its words) and its frontier for each engine."""
    found = {(f.axis, f.engine): f for f in frontiers}
    rows = []
    for axis in _axes(frontiers):
        of_axis = [found.get((axis, engine)) for engine in engines]
        rows.append((next(f for f in of_axis if f), of_axis))
    return rows


def _curve(axis: str, frontiers: Sequence[AxisFrontier], engines: Sequence[str]) -> Plot | None:
    of_axis = [f for f in frontiers if f.axis == axis]
    lines = {
        f.engine: [(p.value, max(p.error, SMALLEST_ERROR)) for p in f.curve if p.error is not None] for f in of_axis
    }
    series = to_series({name: points for name, points in lines.items() if len(points) > 1}, marked=True, order=engines)
    return draw(series, "", "typical relative error", title=f"{axis}: {of_axis[0].says}", log_x=True, log_y=True)


def _condition(rows: Sequence[ConditionGrowth]) -> Plot | None:
    lines = {f"{row.posture}, {row.coordinates}": list(zip(row.n, row.condition, strict=True)) for row in rows}
    title = "Condition number of the mass matrix"
    return draw(to_series(lines, marked=True), "links", "λ max / λ min", title=title, log_x=True, log_y=True)


@dataclass(frozen=True)
class StepTable:
    """For each engine and integrator: what was found at each value of what is varied."""

    stress: str
    unit: str
    values: list[float]
    rows: list[tuple[str, list[StableStep | None]]]


def _stresses(steps: Sequence[StableStep]) -> list[StepTable]:
    return [_step_table([s for s in steps if s.stress == stress]) for stress in dict.fromkeys(s.stress for s in steps)]


def _step_table(steps: Sequence[StableStep]) -> StepTable:
    values = sorted({s.value for s in steps})
    at = {(s.engine, s.integrator, s.value): s for s in steps}
    rows = [
        (f"{engine} {integrator}", [at.get((engine, integrator, value)) for value in values])
        for engine, integrator in _integrators(steps)
    ]
    return StepTable(steps[0].stress, steps[0].unit, values, rows)


def _integrators(steps: Sequence[StableStep]) -> list[tuple[str, str]]:
    return list(dict.fromkeys((s.engine, s.integrator) for s in steps))


def _kinds(steps: Sequence[StableStep]) -> list[str]:
    """Kinds of failure of the maps, in the order of their colours."""
    return [HOLDS, *dict.fromkeys(run.failure for s in steps for run in s.runs if run.failure)]


def _maps(steps: Sequence[StableStep]) -> list[StabilityMap]:
    """Step × links for each engine and integrator."""
    kinds = _kinds(steps)
    links = [s for s in steps if s.stress == "links" and s.runs]
    return [
        _map(f"{engine} {integrator}", [s for s in links if (s.engine, s.integrator) == (engine, integrator)], kinds)
        for engine, integrator in _integrators(links)
    ]


def _map(title: str, steps: Sequence[StableStep], kinds: Sequence[str]) -> StabilityMap:
    columns = [
        Column(f"{s.value:g}", {run.rung: kinds.index(run.failure or HOLDS) for run in s.runs}, s.rung) for s in steps
    ]
    known = steps[0].runs[0]
    rows = [f"{known.step * 2 ** ((row - known.rung) / 2):.1e} s" for row in range(ROWS)]
    return draw_map(title, columns, rows, kinds)


def _drift(run: EnergyDrift) -> Plot | None:
    if len(run.drift) <= 2:
        return None
    interval = len(run.drift) - 1
    points = [(i * run.steps / interval, value) for i, value in enumerate(run.drift)]
    return draw(to_series({"energy": points}), "steps", "ΔE / E", title=f"{run.engine} {run.integrator}")


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
