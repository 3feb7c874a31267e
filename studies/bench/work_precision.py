"""Time against error at the end of a motion: every method from coarse to fine, then all runs timed in turn.

A method is refined until its time is spent or rounding stops it. Nothing is extrapolated beyond the runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...models import Scene
from ...records.bench import Motion, Point, Reach
from .methods import FURIKO, End, Method, end_error, methods, reference_error
from .motion_causes import motion_causes
from .timing import FEWEST, Subject, Times, interleaved, once

ERRORS = (1e-6, 1e-9, 1e-12)  # at which ratios are given
EXPLORING = 0.35  # of the scene's time for finding the errors; the rest is for timing
NO_BETTER = 0.7  # two finer runs in a row with errors above this part of the best: rounding has been reached
LEAST = 0.1  # [s] for every method, however small the budget
PROBE = 0.04  # part of the motion that is run to estimate the time of a whole run
PATIENCE = 2.0  # times a method's share: the longest time of its first run
MEANINGLESS = 1.0  # an error from here on [rad, rad/s] says nothing of the method
COARSE = 1e-3  # above it an error that does not fall is not yet rounding: the steps may be too large
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
        # The time that a method does not use is shared by those that follow.
        found, why = refine(method, partial(end_error, scene), max(left / (len(chosen) - i), LEAST))
        left = max(0.0, left - sum(run.seconds for run in found))
        runs += found
        stopped |= dict.fromkeys(((method.engine, method.named(context)) for context in method.contexts), why)
    watch(f"{scene.name}: in turn")
    points = _timed(runs, (1 - EXPLORING) * budget)
    off, proved = reference_error(scene)
    return Motion(
        scene=scene.name,
        system=scene.system.kind,
        n=scene.system.n,
        duration=scene.duration,
        truth=off,
        proved=proved,
        points=points,
        reaches=reaches(points, stopped),
        left_out=left_out,
        causes=motion_causes(scene, engines, watch),
    )


def refine(method: Method, error: Callable[[End], float], share: float) -> tuple[list[Run], str]:
    """Runs from coarse to fine within ``share`` [s]; and the reason why there are no finer ones, or none at all."""
    runs: list[Run] = []
    # Part of a run gives the time of a whole one. The first call is not counted: it loads and compiles.
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
        stuck = stuck + 1 if runs[-1].error > NO_BETTER * best and best < COARSE else 0
        best = min(best, runs[-1].error)
        if stuck == 2:
            return runs, "rounding: finer runs have no smaller error"
    return runs, "there is no finer setting"


def _keep(method: Method, setting: float, ends: list[End]) -> None:
    ends.append(method.run(setting))


def _timed(runs: Sequence[Run], budget: float) -> list[Point]:
    """All runs as points. Runs that say nothing are not timed again.

    Those are runs with a larger error than a coarser run of the same method, or with an error that is meaningless.
    """
    worth: dict[str, tuple[Run, str]] = {}
    once_taken: list[Run] = []
    nearest: dict[Method, float] = {}
    for run in runs:
        if run.error < nearest.get(run.method, MEANINGLESS):
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
    fronts = front([(took.median, run.error if run.error < MEANINGLESS else math.inf) for run, _, took in found])
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
    """Which of these (seconds, error) are on the Pareto front: no other is better in one and as good in the other."""
    best = math.inf
    kept = [False] * len(points)
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        _, error = points[i]
        if error < best:
            kept[i], best = True, error
    return kept


def reach(points: Curve, error: float) -> tuple[float, bool] | None:
    """Seconds to an error of ``error``: on the points' Pareto front, linear in logarithms between two points.

    None where no point has so small an error. Where the fastest point has a smaller one already: its seconds, and True,
    for an upper bound. Nothing is extrapolated. An error of zero counts as the smallest positive double.
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
    """Each method at each of :data:`ERRORS`: seconds from its medians, and their ratio to furiko's."""
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
    return f"smallest error {nearest:.1e}; {stopped}" if nearest < math.inf else f"no run finished; {stopped}"
