"""One run of the benchmark: its parts, its record, and its files."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
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
    "Errors of motions: the largest of θ [rad] and ω [rad/s] at the end, against a run in quadruple precision, which "
    "is held against a proof where one is kept. Errors of accelerations: relative to a state's largest, against "
    "enclosures in ball arithmetic.",
    "'not reached': no run of the method had so small an error. Nothing is extrapolated.",
)


@dataclass(frozen=True)
class Doing:
    """What is measured next, which part of the run it belongs to, and how long each part is planned to take [s]."""

    words: str
    part: int = 0
    planned: tuple[float, ...] = ()


class _Said:
    """Tells a caller what is measured, whatever measures it."""

    def __init__(self, watch: Callable[[Doing], None]) -> None:
        self.watch, self.planned, self.part = watch, (), -1

    planned: tuple[float, ...]

    def __call__(self, words: str) -> None:
        self.watch(Doing(words, max(self.part, 0), self.planned))

    def next_part(self) -> float:
        """Another part begins: the time that it may take [s]."""
        self.part += 1
        return self.planned[self.part]


def bench(
    scenes: Sequence[str] | None = None,
    engines: Sequence[str] | None = None,
    *,
    budget: float = 60.0,
    skips: bool = False,
    sharpness: bool = False,
    watch: Callable[[Doing], None] = lambda _: None,
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
    say = _Said(watch)
    names = engines_to_measure(engines)
    motions: list[Motion] = []
    speeds: list[Speed] = []
    skipped: list[Skip] = []
    sharp: list[Sharpness] = []
    if sharpness:
        from .studies.bench.sharpness import sharpness as measure_sharpness

        for name in scenes or document_catalogue():
            say(f"smallest error that is noticed: {name}")
            sharp += measure_sharpness([name], names)
    elif skips:
        from .studies.bench.skips import skips as measure_skips

        for name in scenes or ():
            find_document_scene(name, "furiko bench --skips")
        skipped = list(measure_skips(list(scenes or SKIP_SCENES), names, say))
    else:
        from .studies.bench.acceleration_speed import SIZES

        given = [_scene(name) for name in (BENCHMARKS if scenes is None else scenes)]
        chosen = [scene for scene in given if not isinstance(scene, TreeScene)]
        trees = [scene for scene in given if isinstance(scene, TreeScene)]
        moving = names if engines is not None else with_own_motions(names)
        both = scenes is None  # the rest of the budget goes into making models and reference solutions
        part = budget / len(given)
        weights = [scene.system.n**0.3 for scene in chosen]  # more links, longer runs
        moved = 0.55 * budget if both else part * len(chosen)
        cases = [(kind, n) for kind, sizes in SIZES.items() for n in sizes] if both else []
        say.planned = (
            *(moved * weight / sum(weights) for weight in weights),
            *(0.3 * budget / len(cases) for _ in cases),
            *(part for _ in trees),
        )
        motions = [_motion(scene, moving, say) for scene in chosen]
        speeds = [found for case in cases for found in _speeds(*case, names, say)]
        speeds += [found for scene in trees for found in _tree_speeds(scene, names, say)]
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


def _motion(scene: Scene, engines: Sequence[str], say: _Said) -> Motion:
    from .studies.bench.work_precision import work_precision

    return work_precision(scene, engines, say.next_part(), say)


def _speeds(kind: str, n: int, engines: Sequence[str], say: _Said) -> list[Speed]:
    from .studies.bench.acceleration_speed import speeds

    budget = say.next_part()
    say(f"accelerations of {kind}, {n} links")
    return speeds(kind, n, engines, budget, threads=_processors())


def _tree_speeds(scene: TreeScene, engines: Sequence[str], say: _Said) -> list[Speed]:
    from .studies.bench.tree_speed import tree_speeds

    budget = say.next_part()
    say(f"accelerations of {scene.name}")
    return list(tree_speeds(scene, engines, budget))


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


def with_own_motions(names: Sequence[str]) -> list[str]:
    """Of these engines those whose motions are run where none is named: the others integrate as one of them does."""
    from .studies.bench.methods import ENGINES

    return [name for name in names if name in ENGINES]


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
