"""What the terminal, the page and the Markdown of ``furiko sweep`` all say."""

from __future__ import annotations

from collections.abc import Sequence

from ..records.sweep import SweepFault, SweepGroup, SweepSummary, SweepTally
from .words import GLYPHS, count, duration, figure, one_line, tally

TALLIES = ("engine", "version", "cells", "agree", "loose", "differ", "failed", "skipped")
FAULTS = ("engine", "check", "", "times", "what", "first in")
LONGEST = 400  # characters of a reason


def headline(found: SweepSummary) -> str:
    """The whole in one sentence."""
    manifest = found.manifest
    size = f"{count(manifest.scenes, 'scene')} on {count(len(manifest.engines), 'engine')}"
    if not found.complete:
        return f"incomplete: {found.cells:,} of {count(manifest.cells, 'cell')} are there ({size})"
    return f"all {count(manifest.cells, 'cell')} are there ({size}): {verdict(found)}"


def verdict(found: SweepSummary) -> str:
    """How many results agree, differ, failed and were skipped."""
    agrees = sum(one.agrees - one.loose for one in found.tallies)
    loose, skipped = sum(one.loose for one in found.tallies), sum(one.skipped for one in found.tallies)
    differs, errors = sum(one.differs for one in found.tallies), sum(one.errors for one in found.tallies)
    words = [
        tally(differs, "differs") if differs else "",
        tally(errors, "error") if errors else "",
        tally(loose, "loose") if loose else "",
        tally(agrees, "agrees"),
        tally(skipped, "skipped") if skipped else "",
    ]
    return ", ".join(filter(None, words))


def flaws(found: SweepSummary) -> list[str]:
    """What is missing or wrong with the folder, in sentences."""
    said = list(found.flaws)
    if found.missing:
        more = "" if len(found.missing) < 20 else " and others"
        said.append(f"not there: {', '.join(found.missing[:3])}{more if len(found.missing) > 3 else ''}")
        said.append("run the same command with the same folder to go on")
    return said


def short(engine: str) -> str:
    """An engine's name; of one that is a path, the file's."""
    return engine.rpartition("/")[2] or engine


def tally_row(one: SweepTally) -> tuple[str, ...]:
    """One engine."""
    numbers = (one.cells, one.agrees - one.loose, one.loose, one.differs, one.errors, one.skipped)
    return (short(one.engine), ", ".join(one.versions), *(f"{number:,}" for number in numbers))


def fault_row(fault: SweepFault) -> tuple[str, ...]:
    """One kind of failure."""
    what = f"[{fault.cause}] {fault.reason}" if fault.cause else fault.reason
    glyph = f"{GLYPHS[fault.outcome]} {fault.outcome}"
    return (short(fault.engine), fault.check, glyph, f"{fault.times:,}", one_line(what, LONGEST), fault.scene)


def group_heading(parameters: Sequence[str]) -> tuple[str, ...]:
    """The heading of the table of groups."""
    results = ("engine", "check", "results", "of allowed", "typical error", "worst", "a state")
    return ("source", "n", *parameters, *results)


def group_row(group: SweepGroup, parameters: Sequence[str]) -> tuple[str, ...]:
    """One point of the grid, engine and check."""
    values = [f"{group.parameters[name]:.4g}" if name in group.parameters else "" for name in parameters]
    outcomes = {"differs": group.differs, "error": group.errors, "agrees": group.agrees, "skipped": group.skipped}
    results = "  ".join(f"{GLYPHS[name]} {number:,}" for name, number in outcomes.items() if number)  # type: ignore[index]
    return (
        group.source,
        str(group.n),
        *values,
        short(group.engine),
        group.check,
        results + (f"  ≈ {group.loose:,}" if group.loose else ""),
        figure(group.share),
        figure(group.error) + (" ε" if group.unit == "ε" else ""),
        figure(group.worst) + (" ε" if group.unit == "ε" else ""),
        "–" if group.time is None else duration(group.time),
    )


def varying(found: SweepSummary) -> list[str]:
    """The parameters that have several values, and ``n`` where it has."""
    names = ["n", *found.manifest.parameters]
    return [name for name in names if len({value(group, name) for group in found.groups} - {None}) > 1]


def value(group: SweepGroup, name: str) -> float | None:
    """A group's value of a parameter, or its degrees of freedom."""
    return float(group.n) if name == "n" else group.parameters.get(name)
