"""The runs in a folder, and what each says of each engine, beside the run before it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ...models.errors import InvalidInput
from ...models.readers.bounded_file import shown
from ...records.check import Outcome
from ..compare import Comparison, compare
from ..report import Report, gravest, worst_rounding
from ..stream import STREAM, read_stream
from ..words import Word, word

MOST_RUNS = 500  # the oldest of more are left out


@dataclass(frozen=True)
class OfEngine:
    """What one run says of one engine.

    ``broke``, ``fixed``: numbers of comparisons that differ or fail and did not in the last run before that has the
    engine, and the other way round; None in the first. ``other_version``: than in that run.
    """

    engine: str
    package: str
    version: str
    counts: Counter[Word]
    outcome: Outcome | None  # the gravest; None where nothing was asked of it
    rounding: float | None  # the worst error [ε]
    broke: int | None = None
    fixed: int | None = None
    other_version: bool = False


@dataclass(frozen=True)
class Run:
    """One run of a folder, told without its results."""

    name: str
    started: str
    furiko: str
    profile: str
    verdict: str
    exit_status: int
    engines: dict[str, OfEngine]


@dataclass(frozen=True)
class History:
    """``runs``: the latest first; ``unreadable``: a sentence for each file that is none, or is no whole stream."""

    runs: tuple[Run, ...]
    unreadable: tuple[str, ...] = ()
    left_out: int = 0
    engines: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        names = dict.fromkeys(name for run in self.runs for name in run.engines)
        object.__setattr__(self, "engines", tuple(names))


def read_history(folder: Path) -> History:
    """Every ``report.jsonl`` in the folder and in the folders in it, by the time at which they started.

    Raises :class:`InvalidInput` where there is none.
    """
    try:
        inside = sorted(path for path in folder.iterdir() if path.is_dir())
    except OSError as error:
        raise InvalidInput(f"{shown(folder)}: cannot be read: {error.strerror or error}") from None
    paths = [path for path in (folder / STREAM, *(each / STREAM for each in inside)) if path.is_file()]
    if not paths:
        raise InvalidInput(f"{shown(folder)}: no {STREAM} in it or in a folder in it; furiko check --out writes one")
    # The headers say in which order; then each run is read beside the last one of each engine, and no more are kept.
    started: list[tuple[str, Path]] = []
    unreadable = []
    for path in paths:
        try:
            started.append((read_stream(path).header.started, path))
        except InvalidInput as error:
            unreadable.append(str(error))
    started.sort(key=lambda item: item[0])
    runs: list[Run] = []
    before: dict[str, Report] = {}  # the last run of each engine
    for _, path in started[-MOST_RUNS:]:
        report = read_stream(path)
        runs.append(_run(path.parent.name or str(path.parent), report, before))
        before |= dict.fromkeys(report.engines, report)
    return History(tuple(reversed(runs)), tuple(unreadable), max(0, len(started) - MOST_RUNS))


def _run(name: str, report: Report, before: Mapping[str, Report]) -> Run:
    header = report.header
    earlier = {id(run): run for engine in report.engines if (run := before.get(engine))}  # most engines have the same
    comparisons = {key: compare(run, report) for key, run in earlier.items()}
    engines = {engine: _of_engine(engine, report, comparisons.get(id(before.get(engine)))) for engine in report.engines}
    return Run(name, header.started, header.furiko, header.profile, report.verdict, report.exit_status, engines)


def _of_engine(engine: str, report: Report, since: Comparison | None) -> OfEngine:
    results = [result for result in report.results if result.engine == engine]
    entry = report.engine(engine)
    broke = fixed = None
    other = False
    if since is not None:
        there = since.before.engine(engine)
        marks = Counter(change.mark for change in since.changes if change.result.engine == engine)
        broke, fixed = marks["!"], marks["*"]
        other = bool(entry and there and entry.version != there.version)
    return OfEngine(
        engine=engine,
        package=entry.package if entry else "",
        version=entry.version if entry else "",
        counts=Counter(word(result) for result in results),
        outcome=gravest(result.outcome for result in results),
        rounding=worst_rounding(results),
        broke=broke,
        fixed=fixed,
        other_version=other,
    )
