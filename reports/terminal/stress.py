"""The stress test's summary for a terminal: frontiers, steps, long runs, and what the chain does."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..words import count, figure, one_line, printable

Data = dict[str, Any]


def print_stress(found: Data, page: Path) -> None:
    """Print it; as wide as the terminal, or 160 columns in a pipe."""
    from rich.console import Console

    console = Console(width=None if sys.stdout.isatty() else 160, highlight=False, markup=False)
    single = [f for f in found["frontiers"] if not f["pair"]]
    if single:
        engines = list(dict.fromkeys(f["engine"] for f in single))
        at = {(f["axis"], f["engine"]): f for f in single}
        axes = dict.fromkeys(f["axis"] for f in single)
        rows = [(axis, *(_cell(at.get((axis, engine))) for engine in engines)) for axis in axes]
        _table(console, ("half the digits are lost", *engines), rows)
    failing = [f for f in found["frontiers"] if f["pair"] and f["status"] == "fails"]
    if failing:
        rows = [(f["engine"], f["axis"], f["fails at"], f["failure"]) for f in failing]
        _table(console, ("engine", "two at once", "from", "how"), rows)
    if found["condition"]:
        rows = [
            (r["posture"], r["coordinates"], f"n^{r['power']:.2f}" if r["power"] else "") for r in found["condition"]
        ]
        _table(console, ("condition of the mass matrix", "coordinates", "grows as"), rows)
    for stress in dict.fromkeys(s["stress"] for s in found["steps"]):
        _table(console, *_steps(stress, found["steps"]))
    rows = [
        (f"{r['engine']} {r['integrator']}", f"{r['steps']:,}", r["kind"] or r["failure"] or "not known yet",
         f"{r['exponent']:.2f}" if "exponent" in r else "", figure(r["largest"]))
        for r in found["long runs"] if r["steps"]
    ]  # fmt: skip
    if rows:
        _table(console, ("energy in the long run", "steps", "is", "H", "largest |ΔE|/E"), rows)
    for data in found["chain"]["swings"]:
        first = data["rows"][0]
        console.print(
            f"chain of {data['links']}: first swing's error is {first['coefficient']:.4g}/n^{data['power']}"
            f" at n = {data['n'][-1]}"
        )
    for sentence in found["chain"]["verdict"]:
        console.print(f"- {sentence}")
    console.print(_end(found, page))


def _cell(frontier: Data | None) -> str:
    if frontier is None or not frontier["curve"]:
        return "not asked yet"
    if frontier["status"] == "open":
        return "open"
    if frontier["status"] == "holds":
        return f"holds to {frontier['holds at']}"
    end = "" if frontier["failure"] == "half its digits lost" else f": {frontier['failure']}"
    return one_line(f"{frontier['fails at']}{end}", 60)


def _steps(stress: str, steps: Sequence[Data]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    mine = [s for s in steps if s["stress"] == stress]
    values = sorted({s["value"] for s in mine})
    at = {(s["engine"], s["integrator"], s["value"]): s for s in mine}
    rows = []
    for engine, integrator in dict.fromkeys((s["engine"], s["integrator"]) for s in mine):
        cells = [at[engine, integrator, value] for value in values]
        told = ["open" if not c["closed"] else "none" if c["step"] is None else f"{figure(c['step'])} s" for c in cells]
        rows.append((f"{engine} {integrator}", *told))
    unit = mine[0]["unit"]
    return (f"largest stable step by {stress}", *(f"{value:g} {unit}" for value in values)), rows


def _table(console: Any, heading: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> None:
    from rich.table import Table

    table = Table(*heading, box=None, header_style="bold", pad_edge=False)
    for row in rows:
        table.add_row(*map(printable, row))
    console.print(table)
    console.print()


def _end(found: Data, page: Path) -> str:
    broken = len(found["kernels"]["broken"])
    told = f"{count(found['cases'], 'case')}; "
    told += f"{count(broken, 'case')} where furiko's own kernels broke their promise; " if broken else ""
    if found["open"]:
        told += f"{count(found['open'], 'question')} open: run again with this folder to go on; "
    return f"{told}page: {page}"
