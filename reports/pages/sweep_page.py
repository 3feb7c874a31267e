"""The page of ``furiko sweep``: engines, errors against each parameter and against time, what went wrong, the grid."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

from ...records.sweep import SweepGroup, SweepSummary
from ..sweeps import (
    FAULTS,
    TALLIES,
    fault_row,
    flaws,
    group_heading,
    group_row,
    headline,
    short,
    tally_row,
    value,
    varying,
)
from ..words import duration, figure
from .plot import KINDS, LARGE, Plot, Series, draw
from .rendering import render_with_plots

SMALLEST = 1e-18  # errors of zero are drawn here
MOST_GROUPS = 500  # rows of the table
LOG_FROM = 20.0  # a parameter whose largest value is so many times its smallest has a logarithmic axis


def to_html(found: SweepSummary) -> str:
    """The whole page as text; everything from engines is escaped."""
    parameters = found.manifest.parameters
    return render_with_plots(
        "sweep.html.j2",
        found=found,
        headline=headline(found),
        flaws=flaws(found),
        tallies=(TALLIES, [tally_row(one) for one in found.tallies]),
        faults=(FAULTS, [fault_row(one) for one in found.faults]),
        grid=(group_heading(parameters), [group_row(group, parameters) for group in found.groups[:MOST_GROUPS]]),
        left_out=len(found.groups[MOST_GROUPS:]) + found.groups_left_out,
        frontiers=[
            plot for check in _checks(found) for name in varying(found) if (plot := _against(found, check, name))
        ],
        fronts=[plot for check in _checks(found) if (plot := _front(found, check))],
    )


def _checks(found: SweepSummary) -> list[str]:
    return list(dict.fromkeys(group.check for group in found.groups if group.error is not None))


def _engines(found: SweepSummary) -> list[str]:
    return [one.engine for one in found.tallies]


def _against(found: SweepSummary, check: str, name: str) -> Plot | None:
    """The typical error against one parameter; a line an engine and source, the median over all other parameters."""
    mine = [group for group in found.groups if group.check == check and group.error is not None]
    sources = list(dict.fromkeys(group.source for group in mine))
    by_source = name != "n" and 1 < len(sources) <= KINDS
    series = []
    for engine in _engines(found):
        for source in sources if by_source else [None]:
            of_line = [g for g in mine if g.engine == engine and source in (None, g.source)]
            points = _points(of_line, name)
            if len(points) > 1:
                at = _engines(found).index(engine) % KINDS
                mark = sources.index(source) % KINDS if source is not None else at
                label = short(engine) if source is None else f"{short(engine)}, {source}"
                said = [(x, y, f"{label}: {name} {x:.4g}: {figure(y)}") for x, y in points]
                series.append(Series(label, said, at, mark, group=engine))
    values = [x for one in series for x, _, _ in one.points]
    log = bool(values) and min(values) > 0 and max(values) >= LOG_FROM * min(values)
    unit = next((group.unit for group in mine), "")
    title = f"{check}: typical error against {_words(name)}"
    return draw(series, _words(name), f"error, {unit}".rstrip(", "), title=title, log_x=log, log_y=True)


def _points(groups: Sequence[SweepGroup], name: str) -> list[tuple[float, float]]:
    found: dict[float, list[float]] = {}
    for group in groups:
        x = value(group, name)
        if x is not None and group.error is not None:
            found.setdefault(x, []).append(max(group.error, SMALLEST))
    return [(x, median(errors)) for x, errors in sorted(found.items())]


def _front(found: SweepSummary, check: str) -> Plot | None:
    """Time a state against error: a point for each group, and the staircase below which nothing was measured."""
    series, points = [], []
    for k, engine in enumerate(_engines(found)):
        mine = [
            (max(g.error, SMALLEST), g.time, f"{short(engine)}: {_at(g)}: {figure(g.error)} in {duration(g.time)}")
            for g in found.groups
            if g.check == check and g.engine == engine and g.error is not None and g.time is not None
        ]
        series.append(Series(short(engine), mine, k % KINDS, k % KINDS, group=engine, joined=False))
        points += [(error, seconds) for error, seconds, _ in mine]
    return draw(
        [one for one in series if one.points],
        "typical error",
        "time in the engine for one state [s]",
        title=f"{check}: time against error",
        frame=LARGE,
        log_x=True,
        log_y=True,
        falling_x=True,
        front=_best(points),
    )


def _best(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The points that no other beats in both, from the largest error."""
    best: list[tuple[float, float]] = []
    for error, seconds in sorted(points):
        if not best or seconds < best[-1][1]:
            best.append((error, seconds))
    return best[::-1]


def _at(group: SweepGroup) -> str:
    return ", ".join([group.source, *(f"{name} {one:.4g}" for name, one in group.parameters.items())])


def _words(name: str) -> str:
    return {"n": "degrees of freedom", "gravity": "gravity [m/s²]", "density": "density [kg/m]"}.get(name, name)
