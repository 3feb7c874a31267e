"""Time against error at the end of a motion: every method from coarse to fine, then all of them timed in turn.

A method is refined until its time is spent or rounding stops it; nothing is said beyond the runs that were made.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from ..models import Scene
from ..models.bench import Motion, Point, Reach
from .methods import FURIKO, End, Method, end_error, methods, truth
from .timing import Subject, Times, interleaved, once

ERRORS = (1e-6, 1e-9, 1e-12)  # that ratios are given at
EXPLORING = 0.22  # of the scene's time goes into finding the errors, the rest into three rounds of timing or more
NO_BETTER = 0.7  # two finer runs in a row whose error is not below this part of the best: rounding has been reached


@dataclass(frozen=True)
class Run:
    """One run of a method: its setting, the largest error of θ [rad] and ω [rad/s] at the end, the seconds it took."""

    method: Method
    setting: float
    error: float
    seconds: float

    @property
    def subject(self) -> Subject:
        """What is timed."""
        return Subject(partial(self.method.run, self.setting), self.method.around)


def work_precision(
    scene: Scene, engines: Sequence[str], budget: float, watch: Callable[[str], None] = lambda _: None
) -> Motion:
    """Measure one scene, which must have a state and a duration, in about ``budget`` [s]."""
    chosen, left_out = methods(scene, engines)
    share = EXPLORING * budget / len(chosen)
    runs: list[Run] = []
    stopped: dict[tuple[str, str], str] = {}
    for method in chosen:
        watch(f"{scene.name} {method.engine} {method.scheme}")
        found, stopped[method.engine, method.scheme] = refine(method, partial(end_error, scene), share)
        runs += found
    watch(f"{scene.name}: {len(runs)} runs in turn")
    times = interleaved(
        {str(i): run.subject for i, run in enumerate(runs)}, budget=(1 - EXPLORING) * budget, shortest=0.0
    )
    timed = [(run, times[str(i)]) for i, run in enumerate(runs)]
    return Motion(
        scene=scene.name,
        system=scene.system.kind,
        n=scene.system.n,
        duration=scene.duration,
        truth=float(truth(scene).error[-1]),
        points=_points(timed),
        reaches=reaches(timed, stopped),
        left_out=left_out,
    )


def refine(method: Method, error: Callable[[End], float], share: float) -> tuple[list[Run], str]:
    """Runs from coarse to fine within ``share`` [s], at least one; and why there are no finer ones."""
    runs: list[Run] = []
    spent, stuck, best = 0.0, 0, math.inf
    for setting in method.settings:
        if len(runs) > 1:
            growth = max(1.0, runs[-1].seconds / runs[-2].seconds)
            if spent + min(growth, 2.0) * runs[-1].seconds > share:
                return runs, "finer runs were not within the time given"
        ends: list[End] = []
        call = partial(_keep, method, setting, ends)
        if not runs:
            call()  # warm: what is loaded or compiled at the first call is no part of the method
        seconds = once(Subject(call, method.around))
        run = Run(method, setting, error(ends[-1]), seconds)
        runs.append(run)
        spent += seconds
        stuck = stuck + 1 if run.error > NO_BETTER * best and best < math.inf else 0
        best = min(best, run.error)
        if stuck == 2 and best < 1e-3:
            return runs, "rounding: finer runs end no nearer"
    return runs, "no finer setting was tried"


def _keep(method: Method, setting: float, ends: list[End]) -> None:
    ends.append(method.run(setting))


def front(points: Sequence[tuple[float, float]]) -> list[bool]:
    """Which of these (seconds, error) no other beats: none is as fast and nearer, or as near and faster."""
    best = math.inf
    kept = [False] * len(points)
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        _, error = points[i]
        if error < best and math.isfinite(error):
            kept[i], best = True, error
    return kept


def reach(points: Sequence[tuple[float, float]], error: float) -> tuple[float, bool] | None:
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
            logs = [math.log(max(value, 5e-324)) for value in (above, error, off)]
            part = (logs[0] - logs[1]) / (logs[0] - logs[2])
            return before * (seconds / before) ** part, False
    return None


def _points(timed: Sequence[tuple[Run, Times]]) -> list[Point]:
    fronts = front([(times.median, run.error) for run, times in timed])
    return [
        Point(
            engine=run.method.engine,
            scheme=run.method.scheme,
            setting=run.setting,
            by=run.method.by,
            error=run.error,
            minimum=times.minimum,
            median=times.median,
            rounds=len(times.seconds),
            front=on,
        )
        for (run, times), on in zip(timed, fronts, strict=True)
    ]


def reaches(timed: Sequence[tuple[Run, Times]], stopped: dict[tuple[str, str], str]) -> list[Reach]:
    """Each method at each of :data:`ERRORS`: seconds by its medians, and their ratio to furiko's own."""
    curves: dict[tuple[str, str], list[tuple[float, float]]] = {key: [] for key in stopped}
    for run, times in timed:
        curves[run.method.engine, run.method.scheme].append((times.median, run.error))
    found = []
    for error in ERRORS:
        own = next((reach(curve, error) for (engine, _), curve in curves.items() if engine == FURIKO), None)
        for (engine, scheme), curve in curves.items():
            got = reach(curve, error)
            best = min(off for _, off in curve)
            found.append(
                Reach(
                    error=error,
                    engine=engine,
                    scheme=scheme,
                    seconds=got and got[0],
                    at_most=bool(got and got[1]),
                    ratio=got[0] / own[0] if got and own and engine != FURIKO else None,
                    reason="" if got else f"nearest {best:.1e}; {stopped[engine, scheme]}",
                )
            )
    return found
