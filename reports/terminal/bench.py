"""A benchmark as tables in the terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from itertools import groupby
from pathlib import Path
from typing import TextIO

from ...records.bench import Bench, Motion, Reach, Skip, Speed
from ..bench_words import SAME, batch, duration, link_words, times
from ..words import figure
from .check import Page


def print_bench(found: Bench, path: str | Path | None = None, file: TextIO | None = None) -> None:
    """Print what was measured, and on what; ``path``: where the page is."""
    page = Page(file or sys.stdout, None)
    if page.console.width < 100 and not page.console.is_terminal:
        page.console.width = 140
    machine, versions = found.machine, found.versions
    page.line(f"furiko {found.furiko} bench, {found.seconds:.0f} s")
    threads = ", ".join(f"{key}: {value}" for key, value in found.threads.items())
    page.line(f"{', '.join(machine.values())} cores; {threads}")
    page.line(", ".join(f"{name} {version}" for name, version in versions.items()), "dim")
    for motion in found.motions:
        _motion(motion, page)
    for _, rows in groupby(found.speeds, key=lambda speed: (speed.system, speed.n)):
        _speeds(list(rows), page)
    if found.skips:
        _skips(found.skips, page)
    page.line()
    for note in found.notes if found.motions or found.speeds else ():
        page.line(note, "dim")
    if path is not None:
        page.line(f"Report: {path}")


def _motion(motion: Motion, page: Page) -> None:
    page.line()
    page.line(
        f"{motion.scene}: {link_words(motion.system, motion.n)}, {motion.duration:g} s: time to come within …", "bold"
    )
    errors = list(dict.fromkeys(reach.error for reach in motion.reaches))
    methods = dict.fromkeys((reach.engine, reach.scheme) for reach in motion.reaches)
    at = {(reach.engine, reach.scheme, reach.error): reach for reach in motion.reaches}
    on_front = {(point.engine, point.scheme) for point in motion.points if point.front}
    rows = [
        (
            ("* " if key in on_front else "  ") + key[0],
            key[1],
            *(reached(at[*key, error]) for error in errors),
            nearest(motion, key),
        )
        for key in methods
    ]
    _table(("  engine", "scheme", *(f"{error:g}" for error in errors), "its nearest"), rows, page)
    page.line("* on the Pareto front; in brackets: how many times furiko's own time", "dim")
    for reason, found in _reasons(motion).items():
        page.line(f"not reached by {'; '.join(found)}: {reason}", "dim")
    for sentence in motion.left_out:
        page.line(f"left out: {sentence}", "dim")


def _reasons(motion: Motion) -> dict[str, list[str]]:
    """Why methods stopped where they did, each reason with the methods that it stopped."""
    found: dict[str, list[str]] = {}
    for reach in motion.reaches:
        if reach.seconds is None:
            why = found.setdefault(reach.reason.rpartition("; ")[2], [])
            why += [method for method in [f"{reach.engine} {reach.scheme}"] if method not in why]
    return found


def nearest(motion: Motion, method: tuple[str, str]) -> str:
    """The smallest error that a method came to, and what it took."""
    found = [
        (point.error, point.median)
        for point in motion.points
        if (point.engine, point.scheme) == method and point.error is not None
    ]
    if not found:
        return "–"
    error, seconds = min(found)
    return f"{figure(error)} in {duration(seconds)}"


def reached(reach: Reach) -> str:
    """A time and its ratio, or that there is none."""
    if reach.seconds is None:
        return "not reached"
    ratio = f" ({times(reach.ratio)})" if reach.ratio is not None else ""
    return ("≤ " if reach.at_most else "") + duration(reach.seconds) + ratio


def _speeds(speeds: Sequence[Speed], page: Page) -> None:
    page.line()
    page.line(f"accelerations, {link_words(speeds[0].system, speeds[0].n)}: time a state", "bold")
    rows = [
        (
            speed.engine,
            speed.call,
            batch(speed),
            duration(speed.median),
            duration(speed.minimum),
            figure(speed.error),
            times(speed.ratio) if speed.ratio is not None else "",
        )
        for speed in speeds
    ]
    _table(("engine", "call", "states a call", "median", "minimum", "error", "furiko's"), rows, page)


def _skips(skips: Sequence[Skip], page: Page) -> None:
    page.line("\nWhat a check leaves out", "bold")
    rows = [
        (
            skip.name,
            SAME[skip.same].format(skip.verdicts),
            duration(skip.seconds_with),
            duration(skip.seconds_without),
            skip.says,
        )
        for skip in skips
    ]
    _table(("skip", "verdicts", "with it", "without", "what is left out"), rows, page)


def _table(heading: Sequence[str], rows: Iterable[Sequence[str]], page: Page) -> None:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="dim")
    for title in heading:
        table.add_column(page.text(title))
    for row in rows:
        table.add_row(*(page.text(cell) for cell in row))
    page.console.print(table)
