"""Time against error at the end of a motion: every method from coarse to fine, then all of them timed in turn.

A method is refined until its time is spent or rounding stops it; nothing is said beyond the runs that were made.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...models import Scene
from ...records.bench import Motion, Point, Reach
from .methods import FURIKO, End, Method, end_error, methods, truth
from .timing import FEWEST, Subject, Times, interleaved, once

ERRORS = (1e-6, 1e-9, 1e-12)  # that ratios are given at
EXPLORING = 0.35  # of the scene's time goes into finding the errors, the rest into timing
NO_BETTER = 0.7  # two finer runs in a row whose error is not below this part of the best: rounding has been reached
LEAST = 0.1  # [s] that every method is given, however little the whole
PROBE = 0.04  # of the motion is run to see what a whole run takes
PATIENCE = 2.0  # times a method's share: what its first run may take
LOST = 1.0  # an end that is off by this has nothing to do with the motion any more
HOPELESS = 1e-3  # above it an error that does not fall is not yet rounding: steps may be too coarse to tell
Curve = Sequence[tuple[float, float]]  # (seconds, error) of a method's runs


@dataclass(frozen=True)
class Run:
    """One run of a method: its setting, the largest error of θ [rad] and ω [rad/s] at the end, the seconds it took."""

    method: Method
    setting: float
    error: float
    seconds: float


def work_precision(
    scene: Scene, engines: Sequence[str], budget: float, watch: Callable[[str], None] = lambda _: None
) -> Motion:
    """Measure one scene, which must have a state and a duration, in about ``budget`` [s]."""
    chosen, left_out = methods(scene, engines)
    runs: list[Run] = []
    stopped: dict[tuple[str, str], str] = {}
    left = EXPLORING * budget
    for i, method in enumerate(chosen):
        watch(f"{scene.name} {method.engine} {method.scheme}")
        # What a method does not use of its share is shared by those that follow.
        found, why = refine(method, partial(end_error, scene), max(left / (len(chosen) - i), LEAST))
        left = max(0.0, left - sum(run.seconds for run in found))
        runs += found
        stopped |= dict.fromkeys(((method.engine, method.named(context)) for context in method.contexts), why)
    watch(f"{scene.name}: in turn")
    points = _timed(runs, (1 - EXPLORING) * budget)
    return Motion(
        scene=scene.name,
        system=scene.system.kind,
        n=scene.system.n,
        duration=scene.duration,
        truth=float(truth(scene).error[-1]),
        points=points,
        reaches=reaches(points, stopped),
        left_out=left_out,
    )


def refine(method: Method, error: Callable[[End], float], share: float) -> tuple[list[Run], str]:
    """Runs from coarse to fine within ``share`` [s]; and why there are no finer ones, or none at all."""
    runs: list[Run] = []
    # Part of a run tells what a whole one would take; what is loaded or compiled at the first call does not count.
    probe = Subject(partial(method.run, method.settings[0], PROBE))
    once(probe)
    whole = once(probe) / PROBE
    if whole > PATIENCE * share:
        return runs, f"its coarsest run would take {whole:.2g} s, more than the time given (--budget)"
    spent, stuck, best = 0.0, 0, math.inf
    for setting in method.settings:
        growth = runs[-1].seconds / runs[-2].seconds if len(runs) > 1 else 2.0
        if runs and spent + min(max(growth, 1.0), 2.0) * runs[-1].seconds > share:
            return runs, "finer runs were not within the time given (--budget)"
        ends: list[End] = []
        seconds = once(Subject(partial(_keep, method, setting, ends)))
        runs.append(Run(method, setting, error(ends[-1]), seconds))
        spent += seconds
        stuck = stuck + 1 if runs[-1].error > NO_BETTER * best and best < HOPELESS else 0
        best = min(best, runs[-1].error)
        if stuck == 2:
            return runs, "rounding: finer runs end no nearer"
    return runs, "there is no finer setting"


def _keep(method: Method, setting: float, ends: list[End]) -> None:
    ends.append(method.run(setting))


def _timed(runs: Sequence[Run], budget: float) -> list[Point]:
    """All runs as points. Those that show nothing keep the one time that was taken.

    That is, where a coarser run of the same method was nearer, or the end has nothing to do with the motion any more.
    """
    worth: dict[str, tuple[Run, str]] = {}
    once_taken: list[Run] = []
    nearest: dict[Method, float] = {}
    for run in runs:
        if run.error < nearest.get(run.method, LOST):
            nearest[run.method] = run.error
            worth |= {f"{len(worth)} {context}": (run, context) for context in run.method.contexts}
        else:
            once_taken.append(run)
    round_seconds = sum(run.seconds for run, _ in worth.values()) + 1e-9
    times = interleaved(
        {
            key: Subject(partial(run.method.run, run.setting), run.method.contexts[context])
            for key, (run, context) in worth.items()
        },
        budget=budget,
        fewest=min(FEWEST, max(1, int(budget / round_seconds))),
        shortest=0.0,
    )
    found = [
        *((run, context, times[key]) for key, (run, context) in worth.items()),
        *((run, "", Times(np.array([run.seconds]))) for run in once_taken),
    ]
    fronts = front([(took.median, run.error if run.error < LOST else math.inf) for run, _, took in found])
    return [
        Point(
            engine=run.method.engine,
            scheme=run.method.named(context),
            setting=run.setting,
            by=run.method.by,
            error=run.error if math.isfinite(run.error) else None,
            minimum=took.minimum,
            median=took.median,
            rounds=len(took.seconds),
            front=on,
        )
        for (run, context, took), on in zip(found, fronts, strict=True)
    ]


def front(points: Curve) -> list[bool]:
    """Which of these (seconds, error) no other beats: none is as fast and nearer, or as near and faster."""
    best = math.inf
    kept = [False] * len(points)
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        _, error = points[i]
        if error < best:
            kept[i], best = True, error
    return kept


def reach(points: Curve, error: float) -> tuple[float, bool] | None:
    """Seconds to come within ``error``, on the points' own front, straight in logarithms between two of them.

    None where no point is as near. The coarsest one's seconds where that is nearer already, and True: it is at most
    that. Nothing is extrapolated. An error of zero counts as the least positive double.
    """
    kept = sorted(point for point, on in zip(points, front(points), strict=True) if on)
    for i, (seconds, off) in enumerate(kept):
        if off <= error:
            if i == 0 or off == error:
                return seconds, off < error
            before, above = kept[i - 1]
            coarse, asked, fine = (math.log(max(value, 5e-324)) for value in (above, error, off))
            return before * (seconds / before) ** ((coarse - asked) / (coarse - fine)), False
    return None


def reaches(points: Sequence[Point], stopped: dict[tuple[str, str], str]) -> list[Reach]:
    """Each method at each of :data:`ERRORS`: seconds by its medians, and their ratio to furiko's own."""
    curves: dict[tuple[str, str], list[tuple[float, float]]] = {key: [] for key in stopped}
    for point in points:
        if point.error is not None:
            curves[point.engine, point.scheme].append((point.median, point.error))
    found = []
    for error in ERRORS:
        own = next((reach(curve, error) for (engine, _), curve in curves.items() if engine == FURIKO), None)
        for (engine, scheme), curve in curves.items():
            got = reach(curve, error)
            nearest = min((off for _, off in curve), default=math.inf)
            found.append(
                Reach(
                    error=error,
                    engine=engine,
                    scheme=scheme,
                    seconds=got and got[0],
                    at_most=bool(got and got[1]),
                    ratio=got[0] / own[0] if got and own and engine != FURIKO else None,
                    reason="" if got else _why(nearest, stopped[engine, scheme]),
                )
            )
    return found


def _why(nearest: float, stopped: str) -> str:
    return f"nearest {nearest:.1e}; {stopped}" if nearest < math.inf else f"no run came to its end; {stopped}"
