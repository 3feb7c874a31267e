"""The records of ``furiko sweep``: a row of its table, its manifest, and the summary that ``--json`` prints."""

from __future__ import annotations

from typing import Literal

import msgspec

from .check import Outcome

FORMAT = 1


class SweepRow(msgspec.Struct, frozen=True, kw_only=True):
    """One comparison in one cell: a row of the Parquet files, where each parameter is a column ``p_NAME``.

    ``cell``: number of the cell in the plan; ``scene``: its scene, by a name that says all that was chosen; ``source``:
    the scene or the kind of random mechanism that was varied; ``n``: degrees of freedom; ``version``: of the engine,
    where it ran; ``comparison``: the check, ``check``: which part of it. ``error``: the largest error of an
    acceleration relative to the largest acceleration of its state; ``measured``, ``allowed``, ``unit``, ``loose``,
    ``cause``, ``reason``, ``seconds``, ``in_engine`` as in a result of ``furiko check``; ``states``: how many the
    engine was asked in. ``traceback``: of a failure.
    """

    cell: int
    scene: str
    source: str
    system: str
    n: int
    seed: int
    engine: str
    version: str
    comparison: str
    check: str
    outcome: Outcome
    loose: bool
    measured: float | None
    allowed: float | None
    unit: str
    error: float | None
    states: int
    seconds: float
    in_engine: float
    cause: str | None
    reason: str
    traceback: str
    parameters: dict[str, float]


class SweepMark(msgspec.Struct, frozen=True, kw_only=True):
    """What a Parquet file says of itself: of which sweep it is, which part, and how much is in it."""

    format: int = FORMAT
    digest: str  # of the sweep
    chunk: int
    engine: str
    cells: int
    rows: int


class SweepEngine(msgspec.Struct, frozen=True, kw_only=True):
    """An engine of a sweep, as it was when the sweep began; ``folder``: of its files below ``results``."""

    name: str
    formulation: str
    package: str
    version: str
    folder: str


class SweepManifest(msgspec.Struct, frozen=True, kw_only=True):
    """``manifest.json``: what was planned. ``digest``: of everything that decides what is in a cell.

    ``text``: of the file that declares the sweep; ``code``: digest of furiko's own code.
    """

    format: int = FORMAT
    furiko: str
    code: str
    digest: str
    started: str
    command: str
    machine: dict[str, str]
    versions: dict[str, str]
    file: str
    text: str
    engines: list[SweepEngine]
    checks: list[str]
    parameters: list[str]
    cells: int
    scenes: int
    chunk: int  # scenes in a chunk
    chunks: int


class SweepGroup(msgspec.Struct, frozen=True, kw_only=True):
    """All seeds of one point of the grid, one engine and one check.

    ``share``: the largest error as a multiple of what is allowed; ``error``: the median over the cells of the largest
    error (relative, of accelerations; else in ``unit``), ``worst``: the largest; ``time``: the median time in the
    engine for one state [s], None where it was not asked state by state.
    """

    source: str
    n: int
    parameters: dict[str, float]
    engine: str
    check: str
    agrees: int
    differs: int
    skipped: int
    errors: int
    loose: int
    share: float | None
    error: float | None
    worst: float | None
    unit: str
    time: float | None


class SweepFault(msgspec.Struct, frozen=True, kw_only=True):
    """What went wrong in the same way in several cells: how often, and in which scene first."""

    engine: str
    check: str
    outcome: Literal["differs", "error"]
    cause: str | None
    reason: str  # of the first; figures in the others may differ
    times: int
    scene: str
    cell: int


class SweepTally(msgspec.Struct, frozen=True, kw_only=True):
    """The results of one engine, and the versions that gave them."""

    engine: str
    versions: list[str]
    cells: int
    agrees: int
    differs: int
    skipped: int
    errors: int
    loose: int


class SweepSummary(msgspec.Struct, frozen=True, kw_only=True):
    """A sweep as far as it is there. ``cells`` of ``manifest.cells`` are; ``missing``: some of the files that are not.

    ``complete``: every planned cell is there, once. ``flaws``: what is wrong with the folder, in sentences.
    """

    manifest: SweepManifest
    cells: int
    complete: bool
    missing: list[str]
    flaws: list[str]
    tallies: list[SweepTally]
    groups: list[SweepGroup]
    groups_left_out: int
    faults: list[SweepFault]
