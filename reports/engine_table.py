"""The public table of engines: versions, quantities, systems, times, what they cannot do, and what is wrong with them.

Made from the streams of runs; times, limits and defects are handed in, since a stream has none of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..records.check import OUTCOMES, EngineEntry, Result
from .report import Report

KINDS = {"n-leg": "stars", "rod-chain": "chains", "tree": "trees"}
QUANTITIES = ("accelerations", "symmetry", "terms", "derivatives", "joint forces", "energy", "step map", "trajectory")


@dataclass(frozen=True)
class Defect:
    """A defect as an engine's maintainer would want to hear of it: measured now, on the installed ``version``.

    ``file``: the smallest input, complete; ``expected``: by which derivation; ``got``: what the engine gave.
    """

    engine: str
    version: str
    title: str
    what: str
    file: str
    expected: str
    got: str


def engine_table(
    reports: Sequence[Report],
    times: Mapping[str, Mapping[str, float]],
    limits: Mapping[str, Sequence[str]],
    defects: Sequence[Defect],
    command: str,
) -> str:
    """The page, in Markdown.

    ``times``: by engine and scene, µs a state; ``limits``: by engine, sentences on what it cannot do; ``command``: what
    made the page.
    """
    return "\n".join(_lines(reports, times, limits, defects, command)) + "\n"


def _lines(
    reports: Sequence[Report],
    times: Mapping[str, Mapping[str, float]],
    limits: Mapping[str, Sequence[str]],
    defects: Sequence[Defect],
    command: str,
) -> Iterator[str]:
    engines = {entry.name: entry for report in reports for entry in report.header.engines if entry.version}
    results = [result for report in reports for result in report.results if result.engine in engines]
    of_engine = {name: [result for result in results if result.engine == name] for name in engines}
    yield from _head(reports, engines, results, command)
    yield from _outcomes(engines, of_engine, times)
    yield from _distances(reports, of_engine)
    yield "\n## What differs\n"
    yield from _differing(results)
    yield "\n## What each cannot do\n"
    yield from (f"* `{name}`: {'; '.join(limits[name])}." for name in engines if limits.get(name))
    yield "\n## Defects found\n"
    yield "Each was measured when this page was made, and is told as its maintainer would want to receive it. Nothing"
    yield "was sent."
    for defect in defects:
        yield from _issue(defect)


def _head(
    reports: Sequence[Report], engines: Mapping[str, EngineEntry], results: Sequence[Result], command: str
) -> Iterator[str]:
    first = reports[0].header
    packages = {entry.package or name.removesuffix("-maximal") for name, entry in engines.items()}
    machine = ", ".join(f"{key} {value}" for key, value in first.machine.items())
    yield "# Engines, measured\n"
    scenes = {result.scene for result in results}
    yield f"{len(engines)} formulations of {len(packages)} engines, on {len(scenes)} scenes. Made by\n"
    yield f"    {command}\n"
    yield f"with furiko {first.furiko}, from runs of {first.started[:10]} ({machine}):\n"
    for report in reports:
        yield f"    {report.header.command}{'' if report.complete else '  (cut off: what came before is counted)'}"


def _outcomes(
    engines: Mapping[str, EngineEntry],
    of_engine: Mapping[str, list[Result]],
    times: Mapping[str, Mapping[str, float]],
) -> Iterator[str]:
    yield "\n## What came of it\n"
    yield "Comparisons by outcome; *loose* are those that agree and are further off than rounding usually is. Times"
    yield "are µs a state for the accelerations of 256 states through furiko's adapter, on a machine that was busy:"
    yield "orders of magnitude.\n"
    scenes = list(dict.fromkeys(scene for each in times.values() for scene in each))
    yield from _table(
        ("engine", "version", "formulation", "scenes", *OUTCOMES, "loose", *(f"µs, {scene}" for scene in scenes)),
        (
            (
                f"`{name}`",
                entry.version,
                entry.formulation,
                str(len({result.scene for result in of_engine[name] if result.outcome in ("agrees", "differs")})),
                *(str(sum(result.outcome == outcome for result in of_engine[name])) for outcome in OUTCOMES),
                str(sum(result.loose for result in of_engine[name])),
                *(_short(times.get(name, {}).get(scene)) for scene in scenes),
            )
            for name, entry in engines.items()
        ),
    )


def _distances(reports: Sequence[Report], of_engine: Mapping[str, list[Result]]) -> Iterator[str]:
    kinds = {scene.name: scene.system for report in reports for scene in report.header.scenes}
    yield "\n## How far off\n"
    yield "The worst error of each quantity over all scenes of a kind, as a multiple of rounding (ε = 2⁻⁵² of the"
    yield "sum of the magnitudes that are added up; what is allowed grows with the number of links), and in brackets"
    yield "how many times that of the engine's own best scene. The first column is the distance from the proved"
    yield "accelerations, relative to the largest: it contains how ill-conditioned the mechanism is. Per cent: of what"
    yield "is allowed, of quantities that have no such unit."
    for kind, words in KINDS.items():
        rows = list(_errors(of_engine, kinds, kind))
        if rows:
            yield f"\n### {words.capitalize()}\n"
            yield from _table(("engine", "forward error", *QUANTITIES), rows)


def _differing(results: Sequence[Result]) -> Iterator[str]:
    found = [result for result in results if result.outcome in ("differs", "error")]
    if not found:
        yield "Nothing."
    for result in found:
        cause = f" Cause: `{result.cause}`." if result.cause else ""
        yield f"* `{result.engine}`, {result.scene}, {result.check}: {result.reason.rstrip('.')}.{cause}"


def _errors(of_engine: Mapping[str, list[Result]], kinds: Mapping[str, str], kind: str) -> Iterator[list[str]]:
    for name, results in of_engine.items():
        here = [result for result in results if kinds.get(result.scene) == kind]
        forward = [
            float(result.details["forward error"])
            for result in here
            if result.comparison == "accelerations" and "forward error" in result.details
        ]
        cells = [_worst([result for result in here if result.comparison == quantity]) for quantity in QUANTITIES]
        if any(cell != "–" for cell in cells):
            yield [f"`{name}`", f"{max(forward):.0e}" if forward else "–", *cells]


def _worst(results: list[Result]) -> str:
    """In ε with the quotient to the best scene; of a quantity that has no such unit, in per cent of what is allowed."""
    by_scene: dict[str, float] = {}
    share = 0.0
    for result in results:
        if result.measured is None:
            continue
        if result.unit == "ε":
            by_scene[result.scene] = max(by_scene.get(result.scene, 0.0), result.measured)
        elif result.allowed:
            share = max(share, result.measured / result.allowed)
    if not by_scene:
        return f"{100 * share:.2g} %" if share else "–"
    worst, best = max(by_scene.values()), min((value for value in by_scene.values() if value > 0), default=0.0)
    return f"{worst:.2g}" + (f" (×{worst / best:.2g})" if best and len(by_scene) > 1 else "")


def _issue(defect: Defect) -> Iterator[str]:
    yield f"\n### {defect.engine} {defect.version}: {defect.title}\n"
    yield defect.what
    yield "\n```python"
    yield defect.file.strip()
    yield "```\n"
    yield f"*Expected*: {defect.expected}"
    yield f"\n*Got*: {defect.got}"


def _short(value: float | None) -> str:
    return "–" if value is None else f"{value:.2g}" if value < 100 else f"{value:.0f}"


def _table(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(heading)} |"
    yield f"|{'---|' * len(heading)}"
    for row in rows:
        yield f"| {' | '.join(text.replace('|', '/') for text in row)} |"
