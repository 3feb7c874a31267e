"""A sweep in the terminal: engines in a table, what went wrong, and the grid where it is small."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TextIO

from ...records.sweep import SweepSummary
from ..sweeps import TALLIES, fault_row, flaws, group_heading, group_row, headline, tally_row
from .console import PlainConsole

MOST_FAULTS, MOST_GROUPS = 8, 24
NARROW = 100  # columns: below, a reason stands on a line of its own


def print_sweep(found: SweepSummary, page: Path | None, file: TextIO | None = None) -> None:
    """Print it; as wide as the terminal, or 120 columns in a pipe. ``page``: where the page is."""
    console = PlainConsole(file or sys.stdout, None)
    console.line(headline(found), "bold")
    for sentence in flaws(found):
        console.line(sentence)
    console.line()
    console.table(TALLIES, map(tally_row, found.tallies))
    if found.faults:
        console.line("\nWhat went wrong", "bold")
        for fault in found.faults[:MOST_FAULTS]:
            engine, check, outcome, times, what, scene = fault_row(fault)
            console.line(f"{engine}, {check}: {outcome} × {times}: {what}")
            console.line(f"  first in {scene}")
        more = len(found.faults) - MOST_FAULTS
        if more > 0:
            console.line(f"and {more} other kinds: on the page")
    if found.groups and console.rich.width >= NARROW:
        _groups(found, console)
    if page is not None:
        console.line(f"\nPage: {page}")


def _groups(found: SweepSummary, console: PlainConsole) -> None:
    if len(found.groups) > MOST_GROUPS:
        console.line(f"\nThe grid has {len(found.groups) + found.groups_left_out:,} rows: on the page")
        return
    console.line("\nThe grid, over all seeds", "bold")
    parameters = found.manifest.parameters
    console.table(group_heading(parameters), [group_row(group, parameters) for group in found.groups])
