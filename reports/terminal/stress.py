"""The summary of a stress test in the terminal: frontiers, step sizes, long runs, and the chain."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from ...records.stress import AxisFrontier, StableStep, StressSummary, TreeRun
from ..words import count, figure, one_line
from .console import PlainConsole

WIDTH = 160  # columns in a pipe: a column for each engine

Rows = Sequence[tuple[str, ...]]


def print_stress(found: StressSummary, page: Path | None) -> None:
    """Print it; as wide as the terminal, or 160 columns in a pipe. ``page``: where the HTML page is, if it is."""
    console = PlainConsole(sys.stdout, None if sys.stdout.isatty() else WIDTH)
    for heading, rows in _tables(found):
        if rows:
            console.table(heading, rows, "bold")
            console.line()
    for swings in found.chain.swings:
        console.line(
            f"chain of {swings.links}: the error of its first natural frequency is "
            f"{swings.rows[0].coefficient:.4g}/n^{swings.power} at n = {swings.n[-1]}"
        )
    for sentence in found.chain.verdict:
        console.line(f"- {sentence}")
    console.line(_end(found, page))


def _tables(found: StressSummary) -> list[tuple[tuple[str, ...], Rows]]:
    """Each table: its heading and its rows."""
    return [
        _frontiers([f for f in found.frontiers if not f.pair and f.mechanism is None]),
        _tree_frontiers([f for f in found.frontiers if f.mechanism is not None]),
        _pairs([f for f in found.frontiers if f.pair and f.status == "fails"]),
        _conditions(found),
        *(_steps(stress, found.steps) for stress in dict.fromkeys(s.stress for s in found.steps)),
        _long_runs(found),
        _tree_runs(found.tree_runs),
    ]


def _frontiers(frontiers: Sequence[AxisFrontier]) -> tuple[tuple[str, ...], Rows]:
    engines = list(dict.fromkeys(f.engine for f in frontiers))
    at = {(f.axis, f.engine): f for f in frontiers}
    axes = dict.fromkeys(f.axis for f in frontiers)
    rows = [(axis, *(_frontier(at.get((axis, engine))) for engine in engines)) for axis in axes]
    return ("half the digits are lost from", *engines), rows


def _tree_frontiers(frontiers: Sequence[AxisFrontier]) -> tuple[tuple[str, ...], Rows]:
    """A row for each axis: on which of the mechanisms an engine fails first, or how far it holds on all of them."""
    engines = list(dict.fromkeys(f.engine for f in frontiers))
    rows = []
    for axis in dict.fromkeys(axis_of(f) for f in frontiers):
        of_axis = [f for f in frontiers if axis_of(f) == axis]
        rows.append((axis, *(_on_all([f for f in of_axis if f.engine == engine]) for engine in engines)))
    return ("open mechanisms fail from", *engines), rows


def axis_of(frontier: AxisFrontier) -> str:
    """The axis without its mechanism."""
    return frontier.axis.removeprefix(f"{frontier.mechanism}: ")


def _on_all(frontiers: Sequence[AxisFrontier]) -> str:
    taken = [f for f in frontiers if (f.fails, f.failure) != (0, "refused")]
    if frontiers and not taken:
        return "refused"
    failing = min((f for f in taken if f.fails is not None), key=lambda f: f.fails or 0, default=None)
    if failing is not None and failing.closed:
        why = failing.failure if failing.failure != "half its digits lost" else "digits"
        return one_line(f"{failing.fails_at} ({failing.mechanism}: {why})", 60)
    if any(f.status == "open" for f in taken):
        return "open"
    return _frontier(min(taken, key=lambda f: f.top, default=None))


def _frontier(frontier: AxisFrontier | None) -> str:
    if frontier is None or not frontier.curve:
        return "not run yet"
    if frontier.status == "open":
        return "open"
    if frontier.status == "holds":
        return f"holds to {frontier.holds_at}"
    end = "" if frontier.failure == "half its digits lost" else f": {frontier.failure}"
    return one_line(f"{frontier.fails_at}{end}", 60)


def _pairs(failing: Sequence[AxisFrontier]) -> tuple[tuple[str, ...], Rows]:
    rows = [(f.engine, f.axis, f.fails_at or "", f.failure or "") for f in failing]
    return ("engine", "two axes at once", "fails from", "failure"), rows


def _conditions(found: StressSummary) -> tuple[tuple[str, ...], Rows]:
    rows = [(c.posture, c.coordinates, f"n^{c.power:.2f}" if c.power else "") for c in found.condition]
    return ("condition of the mass matrix", "coordinates", "grows as"), rows


def _steps(stress: str, steps: Sequence[StableStep]) -> tuple[tuple[str, ...], Rows]:
    mine = [s for s in steps if s.stress == stress]
    values = sorted({s.value for s in mine})
    at = {(s.engine, s.integrator, s.value): s for s in mine}
    rows = [
        (f"{engine} {integrator}", *(_step(at[engine, integrator, value]) for value in values))
        for engine, integrator in dict.fromkeys((s.engine, s.integrator) for s in mine)
    ]
    unit = mine[0].unit
    return (f"largest stable step by {stress}", *(f"{value:g} {unit}" for value in values)), rows


def _step(found: StableStep) -> str:
    if not found.closed:
        return "open"
    return "none" if found.step is None else f"{figure(found.step)} s"


def _long_runs(found: StressSummary) -> tuple[tuple[str, ...], Rows]:
    rows = [
        (
            f"{run.engine} {run.integrator}",
            f"{run.steps:,}",
            run.kind or run.failure or "too few steps yet",
            "" if run.exponent is None else f"{run.exponent:.2f}",
            figure(run.largest),
        )
        for run in found.long_runs
        if run.steps
    ]
    return ("energy in the long run", "steps", "energy is", "H", "largest |ΔE|/E"), rows


def _tree_runs(runs: Sequence[TreeRun]) -> tuple[tuple[str, ...], Rows]:
    """A row for each engine, integrator and motion; how long each step keeps to it."""
    steps = sorted({run.step for run in runs}, reverse=True)
    at = {(run.engine, run.integrator, run.motion, run.step): run for run in runs}
    rows = [
        (f"{engine} {integrator}", motion, *(tree_run_words(at[engine, integrator, motion, step]) for step in steps))
        for engine, integrator, motion in dict.fromkeys((r.engine, r.integrator, r.motion) for r in runs)
        if all(at[engine, integrator, motion, step].failure != "refused" for step in steps)
    ]
    return ("open mechanisms keep to a known motion", "", *(f"step {step:g} s" for step in steps)), rows


def tree_run_words(run: TreeRun) -> str:
    """How long it keeps to the motion, and what ends it."""
    if not run.runs:
        return "not run yet"
    if run.fails_at is None:
        last = max(run.runs, key=lambda point: point.time)
        return f"{last.time:g} s, off by {figure(last.phase_error)}" + ("" if run.closed else "; open")
    held = "not 1 s" if run.holds_at is None else f"{run.holds_at:g} s"
    more = "" if run.closed else " (open)"
    return one_line(f"{held}{more}, then {run.failure}", 60)


def _end(found: StressSummary, page: Path | None) -> str:
    broken = len(found.kernels.broken)
    told = f"{count(found.cases, 'case')}; "
    told += f"{count(broken, 'case')} in which furiko's own kernels exceed their error bound; " if broken else ""
    if found.open:
        told += f"{count(found.open, 'question')} open: run again with the same folder to resume; "
    return f"{told}page: {page}" if page else told.rstrip("; ")
