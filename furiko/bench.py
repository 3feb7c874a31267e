"""One run of the benchmark: its parts, its record, and its files."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from . import __version__
from .engines import all_of, engine_names, engine_version, why_missing
from .models import (
    AnyScene,
    EngineMissing,
    InvalidInput,
    Scene,
    TreeScene,
    document_catalogue,
    find_document_scene,
    find_scene,
)
from .records import provenance
from .records.bench import Bench, Motion, Sharpness, Skip, Speed
from .studies.bench.scenes import BENCHMARKS

SKIP_SCENES = ("double-pendulum", "rods-5")
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
NOTES = (
    "All methods of a motion, and all calls of a table, ran in turn in one process, forwards and backwards, after a "
    "warm-up; times are the median of the rounds, ratios are ratios of medians or the median of the rounds' ratios.",
    "MuJoCo's Python package makes the C library read a clock several times in every step; 'timer off' is without it.",
    "Engines' accelerations are timed by their most direct calls, with the input in place, without furiko's adapters; "
    "those of trees through them.",
    "Errors of motions: the largest of θ [rad] and ω [rad/s] at the end, against a run in quadruple precision. Errors "
    "of accelerations: relative to a state's largest, against enclosures in ball arithmetic.",
    "'not reached': no run of the method had so small an error. Nothing is extrapolated.",
)
Watch = Callable[[str], None]


def bench(
    scenes: Sequence[str] | None = None,
    engines: Sequence[str] | None = None,
    *,
    budget: float = 60.0,
    skips: bool = False,
    sharpness: bool = False,
    watch: Watch = lambda _: None,
) -> Bench:
    """Measure time against error: motions of ``scenes``, and accelerations where no scenes are named.

    ``scenes``: the benchmark's own motions, scenes of the catalogue or TOML files; None for all of the benchmark's. Of
    a tree the accelerations are timed, not the motion.
    ``engines``: names, None for all that are installed. ``budget`` [s]: about the time of the run. ``skips``: measure
    what a check skips instead, without a limit of time. ``sharpness``: measure how small an error a check notices
    instead, in the scenes of the catalogue that are named or in all of them. ``watch`` is called with what is measured
    next.

    Raises :class:`InvalidInput` for unknown names and :class:`EngineMissing`, before anything runs.
    """
    begun = time.monotonic()
    started = provenance.now()
    names = engines_to_measure(engines)
    motions: list[Motion] = []
    speeds: list[Speed] = []
    skipped: list[Skip] = []
    sharp: list[Sharpness] = []
    if sharpness:
        from .studies.bench.sharpness import sharpness as measure_sharpness

        for name in scenes or document_catalogue():
            watch(f"smallest error that is noticed: {name}")
            sharp += measure_sharpness([name], names)
    elif skips:
        from .studies.bench.skips import skips as measure_skips

        for name in scenes or ():
            find_document_scene(name, "furiko bench --skips")
        skipped = list(measure_skips(list(scenes or SKIP_SCENES), names, watch))
    else:
        from .studies.bench.methods import ENGINES

        given = [_scene(name) for name in (BENCHMARKS if scenes is None else scenes)]
        chosen = [scene for scene in given if not isinstance(scene, TreeScene)]
        trees = [scene for scene in given if isinstance(scene, TreeScene)]
        moving = names if engines is not None else [name for name in names if name in ENGINES]
        both = scenes is None  # the rest of the budget goes into making models and reference solutions
        part = budget / len(given)
        motions = list(_motions(chosen, moving, 0.55 * budget if both else part * len(chosen), watch))
        speeds = list(_speeds(names, 0.3 * budget, watch)) if both else _tree_speeds(trees, names, part, watch)
    return Bench(
        furiko=__version__,
        started=started,
        command=provenance.command(),
        machine=provenance.machine(),
        threads={"each call": "1 thread unless a row says more", **_threads()},
        versions=provenance.versions(),
        budget=budget,
        seconds=time.monotonic() - begun,
        notes=list(NOTES),
        motions=motions,
        speeds=speeds,
        skips=skipped,
        sharpness=sharp,
    )


def _motions(scenes: Sequence[Scene], engines: Sequence[str], budget: float, watch: Watch) -> Iterator[Motion]:
    from .studies.bench.work_precision import work_precision

    weights = [scene.system.n**0.3 for scene in scenes]  # more links, longer runs
    for scene, weight in zip(scenes, weights, strict=True):
        yield work_precision(scene, engines, budget * weight / sum(weights), watch)


def _speeds(engines: Sequence[str], budget: float, watch: Watch) -> Iterator[Speed]:
    from .studies.bench.acceleration_speed import SIZES, speeds

    cases = [(kind, n) for kind, sizes in SIZES.items() for n in sizes]
    for kind, n in cases:
        watch(f"accelerations of {kind}, {n} links")
        yield from speeds(kind, n, engines, budget / len(cases), threads=_processors())


def _tree_speeds(scenes: Sequence[TreeScene], engines: Sequence[str], budget: float, watch: Watch) -> list[Speed]:
    from .studies.bench.tree_speed import tree_speeds

    found: list[Speed] = []
    for scene in scenes:
        watch(f"accelerations of {scene.name}")
        found += tree_speeds(scene, engines, budget)
    return found


def _scene(name: str) -> AnyScene:
    """A motion of the benchmark, or a scene.

    Raises :class:`InvalidInput` where a document's mechanism has no state or no duration. Of a tree, whose motion is
    not timed, the accelerations are.
    """
    scene = BENCHMARKS[name] if name in BENCHMARKS else find_scene(name)
    if isinstance(scene, TreeScene):
        return scene
    if scene.theta is None or not scene.duration:
        raise InvalidInput(f"scene {name!r}: it has no [state] with a duration, so there is no motion to time")
    return scene


def engines_to_measure(given: Sequence[str] | None) -> list[str]:
    """The engines by name. Raises :class:`EngineMissing` for one that was asked for and is not installed."""
    if given is None:
        return [name for name in engine_names() if engine_version(name)]
    names = all_of(given)
    for name in names:
        if why := why_missing(name):
            raise EngineMissing(f"{name}: {why}")
    return names


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1


def _threads() -> dict[str, str]:
    return {name: os.environ.get(name, "not set") for name in THREADS}


def write(folder: Path, found: Bench) -> Path:
    """Write ``bench.json`` and ``bench.html``, each completely or not at all; returns the page's path.

    Raises :class:`InvalidInput` where they cannot be written.
    """
    import msgspec

    from .models.writers.whole_file import make_folder, write_whole
    from .reports.pages.bench_page import to_html

    page = to_html(found)
    make_folder(folder)
    write_whole(folder / "bench.json", msgspec.json.format(msgspec.json.encode(found), indent=1).decode() + "\n")
    return write_whole(folder / "bench.html", page)
