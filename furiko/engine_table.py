"""The public table of engines: streams of runs, times, limits and defects, put together."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from .engines import EngineInfo, cannot, engine_info, load_engine
from .models import EngineMissing, InvalidInput, Scene, find_document_scene
from .models.states import states
from .reports.engine_table import Defect, engine_table
from .reports.report import Report
from .reports.stream import read_stream
from .studies.defects import Measured, measured

TIMED = ("double-pendulum", "rods-5", "rods-20")
STATES = 256
SECONDS = 0.2  # of repetitions, for one figure


def table_of_runs(runs: Sequence[str | Path], command: str, pythons: Sequence[str] = ()) -> str:
    """The page of runs, in Markdown.

    ``runs``: folders or files of results; ``pythons``: further Pythons whose packages are probed for defects.
    """
    reports = [read_stream(Path(run) / "report.jsonl" if Path(run).is_dir() else run) for run in runs]
    names = list(dict.fromkeys(e.name for report in reports for e in report.header.engines if e.version))
    infos = {name: info for name in names if (info := _info(name)) is not None}
    defects = measured() + [each for python in pythons for each in measured(python)]
    return engine_table(
        reports,
        {name: _times(name, info, reports) for name, info in infos.items()},
        {name: _limits(info) for name, info in infos.items()},
        [_defect(each) for each in {(each.probe.engine, each.version): each for each in defects}.values()],
        command,
    )


def _info(name: str) -> EngineInfo | None:
    try:
        return engine_info(name)
    except (InvalidInput, EngineMissing):
        return None


def _times(name: str, info: EngineInfo, reports: Sequence[Report]) -> dict[str, float]:
    """By scene, µs a state of the accelerations of many states, the fastest of several; of scenes that it ran."""
    ran = {r.scene for report in reports for r in report.results if r.engine == name and r.measured is not None}
    found = {}
    for scene in TIMED:
        if scene in ran:
            found[scene] = _time(name, info, find_document_scene(scene, "timing"))
    return {scene: value for scene, value in found.items() if value is not None}


def _time(name: str, info: EngineInfo, scene: Scene) -> float | None:
    if cannot(info, scene.system):
        return None
    try:
        engine = load_engine(name, scene.system)
    except EngineMissing:
        return None
    looked_at = states(scene, STATES)
    theta, omega = looked_at.theta[-STATES:], looked_at.omega[-STATES:]
    engine.accelerations(theta, omega)  # what is compiled or kept at the first call is no time of a state
    best, end = np.inf, time.perf_counter() + SECONDS
    while True:
        start = time.perf_counter()
        engine.accelerations(theta, omega)
        best = min(best, time.perf_counter() - start)
        if time.perf_counter() > end:
            return float(best) / len(theta) * 1e6


def _limits(info: EngineInfo) -> list[str]:
    """Sentences on what an engine cannot do."""
    found = [f"no {what.replace('_', ' ')}: {why}" for what, why in (*info.missing.items(), *info.lacks.items())]
    if info.largest_n_reason:
        found.append(f"at most {info.largest_n} links: {info.largest_n_reason}")
    if info.least_reason:
        found.append(f"masses from {info.least_mass:.2g} kg on: {info.least_reason}")
    if info.no_point_masses:
        found.append(f"no point masses: {info.no_point_masses}")
    if info.tree is None:
        found.append("no trees but the documents' mechanisms")
    else:
        found += [f"trees with {what}: {why}" for what, why in info.tree.cannot_hold.items()]
        found += [f"derivatives of {what}: {why}" for what, why in info.tree.cannot_differentiate.items()]
    return found


def _defect(found: Measured) -> Defect:
    probe = found.probe
    return Defect(
        engine=probe.engine,
        version=found.version,
        title=probe.title,
        what=probe.what,
        file=probe.program,
        expected=f"`{_numbers(found.expected)}`, {probe.derivation}.",
        got=f"`{_numbers(found.got)}`.",
    )


def _numbers(values: Sequence[float]) -> str:
    return "[" + ", ".join(f"{value:.8f}" for value in values) + "]"
