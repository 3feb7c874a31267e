"""A benchmark as tables in the terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import TextIO

from ...records.bench import Bench, Motion, Reach, Sharpness, Skip, Speed
from ..words import SAME, batch, duration, figure, link_words, multiple, speed_words
from ..zigzags import zigzags
from .console import PlainConsole


def print_bench(found: Bench, path: str | Path | None = None, file: TextIO | None = None) -> None:
    """Print the measurements and the machine; ``path``: where the HTML page is."""
    console = PlainConsole(file or sys.stdout, None)
    machine, versions = found.machine, found.versions
    console.line(f"furiko {found.furiko} bench, {found.seconds:.0f} s")
    threads = ", ".join(f"{key}: {value}" for key, value in found.threads.items())
    console.line(f"{', '.join(machine.values())} cores; {threads}")
    console.line(", ".join(f"{name} {version}" for name, version in versions.items()), "dim")
    for motion in found.motions:
        _motion(motion, console)
    for _, rows in groupby(found.speeds, key=lambda speed: (speed.system, speed.scene, speed.n)):
        _speeds(list(rows), console)
    if found.skips:
        _skips(found.skips, console)
    if found.sharpness:
        _sharpness(found.sharpness, console)
    console.line()
    for note in found.notes if found.motions or found.speeds else ():
        console.line(note, "dim")
    if path is not None:
        console.line(f"Report: {path}")


def _motion(motion: Motion, console: PlainConsole) -> None:
    console.line()
    console.line(
        f"{motion.scene}: {link_words(motion.system, motion.n)}, {motion.duration:g} s: time to reach an error of …",
        "bold",
    )
    errors = list(dict.fromkeys(reach.error for reach in motion.reaches))
    methods = dict.fromkeys((reach.engine, reach.scheme) for reach in motion.reaches)
    at = {(reach.engine, reach.scheme, reach.error): reach for reach in motion.reaches}
    on_front = {(point.engine, point.scheme) for point in motion.points if point.front}
    rows = [
        (
            ("* " if key in on_front else "  ") + key[0],
            key[1],
            *(_reached(at[*key, error]) for error in errors),
            _nearest(motion, key),
        )
        for key in methods
    ]
    console.table(("  engine", "scheme", *(f"{error:g}" for error in errors), "smallest error"), rows)
    console.line("* on the Pareto front; in brackets: the time as a multiple of furiko's", "dim")
    truth = "the motion's end is proved, to within" if motion.proved else "the reference's estimated error:"
    console.line(f"{truth} {motion.truth:.0e}", "dim")
    for reason, found in _reasons(motion).items():
        console.line(f"not reached by {'; '.join(found)}: {reason}", "dim")
    for sentence in zigzags(motion):
        console.line(f"turns back: {sentence}", "dim")
    for sentence in motion.left_out:
        console.line(f"left out: {sentence}", "dim")
    for cause in motion.causes:
        console.line(f"{cause.cause}: {cause.says}", "differs")


def _reasons(motion: Motion) -> dict[str, list[str]]:
    """Each reason for which an error was not reached, with the methods that did not reach it."""
    found: dict[str, list[str]] = {}
    for reach in motion.reaches:
        if reach.seconds is None:
            why = found.setdefault(reach.reason.rpartition("; ")[2], [])
            why += [method for method in [f"{reach.engine} {reach.scheme}"] if method not in why]
    return found


def _nearest(motion: Motion, method: tuple[str, str]) -> str:
    """The smallest error that a method reached, and the time that it took."""
    found = [
        (point.error, point.median)
        for point in motion.points
        if (point.engine, point.scheme) == method and point.error is not None
    ]
    if not found:
        return "–"
    error, seconds = min(found)
    return f"{figure(error)} in {duration(seconds)}"


def _reached(reach: Reach) -> str:
    """A time and its ratio to furiko's own, or "not reached"."""
    if reach.seconds is None:
        return "not reached"
    ratio = f" ({multiple(reach.ratio)})" if reach.ratio is not None else ""
    return ("≤ " if reach.at_most else "") + duration(reach.seconds) + ratio


def _speeds(speeds: Sequence[Speed], console: PlainConsole) -> None:
    console.line()
    console.line(f"accelerations, {speed_words(speeds[0])}: time a state", "bold")
    rows = [
        (
            speed.engine,
            speed.call,
            batch(speed),
            duration(speed.median),
            duration(speed.minimum),
            figure(speed.error),
            multiple(speed.ratio) if speed.ratio is not None else "",
        )
        for speed in speeds
    ]
    console.table(("engine", "call", "states a call", "median", "minimum", "error", "× furiko's"), rows)


def _sharpness(rows: Sequence[Sharpness], console: PlainConsole) -> None:
    console.line("\nSmallest relative error of an entry that a check notices", "bold")
    cells = [
        (
            row.scene,
            row.engine,
            row.quantity,
            figure(row.noticed),
            figure(row.own),
            figure(row.ratio),
            str(row.entry),
            f"{row.found} of {row.planted}",
        )
        for row in rows
    ]
    heading = ("scene", "engine", "quantity", "noticed", "99 % of own", "ratio", "worst entry", "planted, found")
    console.table(heading, cells)


def _skips(skips: Sequence[Skip], console: PlainConsole) -> None:
    console.line("\nWork that a check skips", "bold")
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
    console.table(("skip", "verdicts", "with it", "without", "work skipped"), rows)
