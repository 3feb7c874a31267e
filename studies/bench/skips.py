"""Measures what a check skips: the same verdicts with each skip and without it, and the seconds of both.

A skip is turned off by running the same work in a way to which it does not apply: a truth computed anew for each
engine, trajectories run alone, an empty cache. So the code that skips needs no switch.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from ...checks.cache import Cache
from ...checks.jobs import CellJob, Facts, TruthJob, messages_of
from ...checks.plan import Plan, Task, make_plan
from ...checks.runner import run
from ...engines import engine_names
from ...engines.workers.processes import worker_processes
from ...models import AnyScene, Scene
from ...records.bench import Skip
from ...records.check import Result

Verdicts = dict[tuple[str, str, str], str]
REPEATS = 3  # runs each way, in turn; the fastest counts

# A process of its own that checks one task, after it has imported some engines; prints the verdicts and the seconds.
_FRESH = """
import json, sys, time
begun = time.perf_counter()
from furiko.studies.bench.skips import check_task
scene, engine, others = sys.argv[1], sys.argv[2], sys.argv[3:]
print(json.dumps([check_task(scene, engine, others), time.perf_counter() - begun]))
"""


def skips(
    scenes: Sequence[str], engines: Sequence[str], watch: Callable[[str], None] = lambda _: None
) -> Iterator[Skip]:
    """Measure each skip on these scenes and engines, which must be installed."""
    plan = make_plan(list(scenes), list(engines), "quick")
    for prove in (_cache, _truth, _trajectory, _velocity, _imports):
        watch(f"skips: {prove.__name__.strip('_')}")
        yield prove(plan)


def _cache(plan: Plan) -> Skip:
    """A run without a cache, one that fills it, and one that finds everything in it."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Cache(Path(folder))
        without, seconds_without = _timed(lambda: _run(plan, Cache(None)))
        filled = _run(plan, cache)
        found, seconds_with = _timed(lambda: _run(plan, cache))
    says = "a result whose scene, engine, version, check and source are those of an earlier run comes from the cache"
    return _skip("cache", says, found, without, seconds_with, seconds_without, also=filled == without)


def _run(plan: Plan, cache: Cache) -> Verdicts:
    """The verdicts of a whole run, on worker processes of its own."""
    with worker_processes() as source:
        records = run(plan, cache=cache, source=source)
        return _verdicts(record for record in records if isinstance(record, Result))


def _truth(plan: Plan) -> Skip:
    """Every task with its scene's truth shared, and with its own; no trajectories, whose time is set by a clock."""
    tasks = [replace(task, checks=tuple(c for c in task.checks if c != "trajectory")) for task in plan.tasks]

    def shared() -> Verdicts:
        truths = {task.scene.name: _facts(task) for task in tasks}
        return _verdicts(result for task in tasks for result in _cell(task, truths[task.scene.name]))

    def own() -> Verdicts:
        return _verdicts(result for task in tasks for result in _cell(task, _facts(task)))

    (found, seconds_with), (without, seconds_without) = _in_turn(shared, own)
    says = "the truth is computed once a scene, not once an engine"
    return _skip("truth", says, found, without, seconds_with, seconds_without)


def _trajectory(plan: Plan) -> Skip:
    """Each task as a whole, and its trajectories run alone, so that nothing skips them."""
    tasks = [(task, _facts(task)) for task in plan.tasks if "trajectory" in task.checks]

    def together() -> Verdicts:
        return _whole(result for task, facts in tasks for result in _cell(task, facts))

    def apart() -> Verdicts:
        parts = (
            (replace(task, checks=checks), facts)
            for task, facts in tasks
            for checks in (tuple(check for check in task.checks if check != "trajectory"), ("trajectory",))
        )
        return _whole(result for task, facts in parts for result in _cell(task, facts))

    together()  # imports at first use are not timed
    without, seconds_without = _timed(apart)
    found, seconds_with = _timed(together)
    differing = sum(verdict == "differs" for verdict in found.values())
    says = f"no trajectory where the accelerations differ; here {differing} of {len(found)} cells differ"
    return _skip("trajectory", says, found, without, seconds_with, seconds_without)


def _velocity(plan: Plan) -> Skip:
    """Terms in a scene at rest, and in the same scene with one more state, which moves."""
    tasks = [replace(task, checks=("terms",)) for task in plan.tasks if "terms" in task.checks]

    def verdicts(*named: str) -> Callable[[], Verdicts]:
        asked = [replace(task, scene=_only(task.scene, named)) for task in tasks]
        given = [(task, _facts(task)) for task in asked]
        return lambda: _verdicts(result for task, facts in given for result in _cell(task, facts))

    (at_rest, seconds_with), (moving, seconds_without) = _in_turn(
        verdicts("hanging", "horizontal"), verdicts("hanging", "horizontal", "whirling")
    )
    run_in_both = {key: verdict for key, verdict in at_rest.items() if verdict != "skipped"}
    left_out = [moving[key] for key, verdict in at_rest.items() if verdict == "skipped" and key in moving]
    says = f"no velocity terms in a scene at rest: {len(left_out)} comparisons left out"
    agree = all(verdict == "agrees" for verdict in left_out)
    shared = {key: moving[key] for key in run_in_both}
    return _skip("velocity terms", says, run_in_both, shared, seconds_with, seconds_without, also=agree)


def _imports(plan: Plan) -> Skip:
    """One engine's check in a fresh process, and in one that has imported all engines first."""
    task = plan.tasks[0]
    everything = [name for name in engine_names() if name != task.engine]
    ways: dict[bool, tuple[Verdicts, float]] = {}
    for _ in range(REPEATS):
        for alone in (True, False):
            found, seconds = _fresh(task, [] if alone else everything)
            ways[alone] = found, min(seconds, ways.get(alone, (found, seconds))[1])
    (found, seconds_with), (without, seconds_without) = ways[True], ways[False]
    says = f"engines are imported only where they are run: {task.scene.name} on {task.engine}, a fresh process"
    return _skip("imports", says, found, without, seconds_with, seconds_without)


def check_task(scene: str, engine: str, others: Sequence[str]) -> list[list[str]]:
    """Verdicts of one scene's accelerations on one engine, in this process, once ``others`` are imported as well."""
    from ...engines import load_engine
    from ...models import find_document_scene

    for name in others:
        load_engine(name, find_document_scene(scene, "furiko bench --skips").system)
    task = replace(make_plan([scene], [engine], "smoke").tasks[0], random_states=1)
    return [[*key, verdict] for key, verdict in _verdicts(_cell(task, _facts(task))).items()]


def _fresh(task: Task, others: Sequence[str]) -> tuple[Verdicts, float]:
    command = [sys.executable, "-c", _FRESH, task.scene.name, task.engine, *others]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows, seconds = json.loads(done.stdout)
    return {(scene, engine, check): verdict for scene, engine, check, verdict in rows}, seconds


def _only(scene: AnyScene, named: tuple[str, ...]) -> Scene:
    """The scene in these named states alone."""
    assert isinstance(scene, Scene)  # the caller refuses trees
    return replace(scene, theta=None, omega=None, duration=0.0, random=0, named=named)


def _facts(task: Task) -> bytes:
    job = TruthJob(task.scene, task.random_states)
    (facts,) = (message for message in messages_of(job) if isinstance(message, Facts))
    return facts.content


def _cell(task: Task, facts: bytes) -> Iterator[Result]:
    return (message for message in messages_of(CellJob(task, facts)) if isinstance(message, Result))


def _verdicts(results: Iterable[Result]) -> Verdicts:
    return {(result.scene, result.engine, result.check): result.outcome for result in results}


def _whole(results: Iterable[Result]) -> Verdicts:
    """One verdict a cell: its worst."""
    worst: Verdicts = {}
    for result in results:
        key = result.scene, result.engine, ""
        worst[key] = max(worst.get(key, "skipped"), result.outcome, key=_RANKS.index)
    return worst


_RANKS = ["skipped", "agrees", "differs", "error"]


def _timed(make: Callable[[], Verdicts]) -> tuple[Verdicts, float]:
    begun = time.perf_counter()
    found = make()
    return found, time.perf_counter() - begun


def _in_turn(*ways: Callable[[], Verdicts]) -> list[tuple[Verdicts, float]]:
    """The verdicts of each way and the least of its seconds, timed in turn after each has run once."""
    for way in ways:
        way()
    rounds = [[_timed(way) for way in ways] for _ in range(REPEATS)]
    return [(found[0][0], min(seconds for _, seconds in found)) for found in zip(*rounds, strict=True)]


def _skip(
    name: str,
    says: str,
    found: Verdicts,
    without: Verdicts,
    seconds_with: float,
    seconds_without: float,
    also: bool = True,
) -> Skip:
    return Skip(
        name=name,
        says=says,
        same=found == without and also,
        verdicts=len(without),
        seconds_with=seconds_with,
        seconds_without=seconds_without,
    )
