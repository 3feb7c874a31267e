"""What a sweep's files say together: tallies, groups over the seeds, and what went wrong, in the order of its weight.

The files are read one engine at a time, and of them the columns that are needed.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from ...models.errors import library
from ...records.sweep import SweepFault, SweepGroup, SweepSummary, SweepTally
from .folder import SweepFolder
from .table import column

MOST_GROUPS = 5_000  # of a summary
MOST_FAULTS = 50
FIGURES = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")  # in which reasons of one kind differ
LONGEST_REASON = 1_000  # characters


def summarise(folder: SweepFolder) -> SweepSummary:
    """Reconcile a folder with its plan, and sum up what is there. Raises :class:`furiko.LibraryMissing`."""
    there = folder.reconciled()
    manifest = folder.manifest
    groups = _Groups(manifest.parameters)
    tallies = []
    flaws, missing = list(there.flaws), set(there.missing)
    for engine in manifest.engines:
        tally, versions, cells = Counter[str](), set[str](), set[int]()
        for chunk in range(manifest.chunks):
            path = folder.file(engine.name, chunk)
            if path.relative_to(folder.path).as_posix() in missing:
                continue
            rows = _columns(path, manifest.parameters)
            groups.add(engine.name, rows)
            tally.update(rows["outcome"])
            tally["loose"] += sum(rows["loose"])
            versions.update(rows["version"])
            cells.update(rows["cell"])
        if len(versions) > 1:
            flaws.append(f"{engine.name}: answers of several versions, {', '.join(sorted(versions))}")
        tallies.append(
            SweepTally(
                engine=engine.name,
                versions=sorted(versions),
                cells=len(cells),
                agrees=tally["agrees"],
                differs=tally["differs"],
                skipped=tally["skipped"],
                errors=tally["error"],
                loose=tally["loose"],
            )
        )
    found = groups.records()
    return SweepSummary(
        manifest=manifest,
        cells=there.cells,
        complete=not there.missing and not flaws and there.cells == manifest.cells,
        missing=list(there.missing[:20]),
        flaws=flaws,
        tallies=tallies,
        groups=found[:MOST_GROUPS],
        groups_left_out=max(0, len(found) - MOST_GROUPS),
        faults=groups.worst_faults(),
    )


COLUMNS = (
    "cell",
    "scene",
    "source",
    "n",
    "version",
    "check",
    "outcome",
    "loose",
    "measured",
    "allowed",
    "unit",
    "error",
    "states",
    "in_engine",
    "cause",
    "reason",
)


def _columns(path: Path, parameters: Sequence[str]) -> dict[str, list[Any]]:
    table = library("pyarrow.parquet").read_table(path, columns=[*COLUMNS, *map(column, parameters)], partitioning=None)
    found: dict[str, list[Any]] = table.to_pydict()
    return found


@dataclass
class _Group:
    outcomes: Counter[str] = field(default_factory=Counter)
    loose: int = 0
    share: float | None = None
    errors: list[float] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    unit: str = ""


@dataclass
class _Fault:
    reason: str
    scene: str
    cell: int
    times: int = 0


class _Groups:
    """Results by point of the grid, engine and check; and failures by what they have in common."""

    def __init__(self, parameters: Sequence[str]) -> None:
        self._parameters = parameters
        self._groups: dict[tuple[Any, ...], _Group] = {}
        self._faults: dict[tuple[Any, ...], _Fault] = {}

    def add(self, engine: str, rows: dict[str, list[Any]]) -> None:
        """The rows of a file, by column."""
        values = list(zip(*(rows[column(name)] for name in self._parameters), strict=True)) or [()] * len(rows["cell"])
        for k, outcome in enumerate(rows["outcome"]):
            key = (rows["source"][k], rows["n"][k], values[k], engine, rows["check"][k])
            _add(self._groups.setdefault(key, _Group()), {name: rows[name][k] for name in COLUMNS})
            if outcome in ("differs", "error"):
                alike = rows["cause"][k] or FIGURES.sub("#", rows["reason"][k].replace(rows["scene"][k], ""))
                fault = self._faults.setdefault(
                    (engine, rows["check"][k], outcome, rows["cause"][k], alike),
                    _Fault(rows["reason"][k][:LONGEST_REASON], rows["scene"][k], rows["cell"][k]),
                )
                fault.times += 1

    def records(self) -> list[SweepGroup]:
        """All groups, in the order in which they came."""
        return list(self._records())

    def _records(self) -> Iterator[SweepGroup]:
        for (source, n, values, engine, check), group in self._groups.items():
            pairs = zip(self._parameters, values, strict=True)
            yield SweepGroup(
                source=source,
                n=n,
                parameters={name: value for name, value in pairs if value is not None},
                engine=engine,
                check=check,
                agrees=group.outcomes["agrees"],
                differs=group.outcomes["differs"],
                skipped=group.outcomes["skipped"],
                errors=group.outcomes["error"],
                loose=group.loose,
                share=group.share,
                error=median(group.errors) if group.errors else None,
                worst=max(group.errors, default=None),
                unit=group.unit,
                time=median(group.times) if group.times else None,
            )

    def worst_faults(self) -> list[SweepFault]:
        """The most frequent faults, failures of an engine after differences."""
        order = sorted(self._faults.items(), key=lambda one: (one[0][2] != "differs", -one[1].times))
        return [
            SweepFault(
                engine=engine,
                check=check,
                outcome=outcome,
                cause=cause,
                reason=fault.reason,
                times=fault.times,
                scene=fault.scene,
                cell=fault.cell,
            )
            for (engine, check, outcome, cause, _), fault in order[:MOST_FAULTS]
        ]


def _add(group: _Group, row: dict[str, Any]) -> None:
    group.outcomes[row["outcome"]] += 1
    group.loose += row["loose"]
    if row["measured"] is None:
        return
    if row["allowed"]:
        share = row["measured"] / row["allowed"]
        group.share = share if group.share is None else max(group.share, share)
    error = row["error"] if row["error"] is not None else row["measured"]
    group.unit = "of the largest acceleration" if row["error"] is not None else row["unit"]
    if math.isfinite(error):
        group.errors.append(error)
    # One call is made for all states of a scene where accelerations are compared, and nowhere else.
    if row["check"] == "accelerations" and row["states"] and row["in_engine"]:
        group.times.append(row["in_engine"] / row["states"])
