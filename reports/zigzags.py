"""Why a method's curve of time against error turns back: the machine's noise, rounding, or what is really so."""

from __future__ import annotations

from collections.abc import Sized
from itertools import pairwise

from ..records.bench import Motion, Point
from .words import count, duration, figure

STEP = "step [s]"  # the setting of a method with steps of one size


def zigzags(motion: Motion) -> list[str]:
    """A sentence for each method and kind of turn, with the largest of them.

    From a coarse setting to a fine one more is computed, so time ought to rise and the error to fall. Half the step is
    twice as many of the same steps: a time that falls there is noise, since other programs only ever add time. Of a
    tolerance it is noise where the fastest rounds rise.
    """
    methods = dict.fromkeys((point.engine, point.scheme) for point in motion.points)
    return [sentence for method in methods for sentence in _of_method(motion, method)]


def _of_method(motion: Motion, method: tuple[str, str]) -> list[str]:
    points = [p for p in motion.points if (p.engine, p.scheme) == method and p.error is not None]
    points.sort(key=lambda point: -point.setting)
    pairs = list(pairwise(points))
    name = ", ".join(method)
    faster = [pair for pair in pairs if pair[1].median < pair[0].median]
    found = []
    if faster:
        coarse, fine = max(faster, key=lambda pair: pair[0].median / pair[1].median)
        falls = f"{name}: the time falls from {_setting(coarse)} to {_setting(fine)}{_others(faster)}"
        found.append(f"{falls}: {_why(coarse, fine)}")
    larger = [pair for pair in pairs if (pair[1].error or 0.0) > (pair[0].error or 0.0)]
    if larger:
        coarse, fine = max(larger, key=lambda pair: (pair[1].error or 0.0) / (pair[0].error or 1e-300))
        found.append(
            f"{name}: the error grows from {_setting(coarse)} to {_setting(fine)}{_others(larger)}, "
            f"{figure(coarse.error)} to {figure(fine.error)}: rounding, or errors of the coarser run cancelled"
        )
    return found


def _why(coarse: Point, fine: Point) -> str:
    rounds = min(coarse.rounds, fine.rounds)
    fastest = f"{duration(coarse.minimum)} and {duration(fine.minimum)}"
    if rounds > 1 and fine.minimum >= coarse.minimum:
        times = figure(max(point.median / point.minimum for point in (coarse, fine)))
        return f"noise; the fastest rounds, {fastest}, rise; medians of {rounds} rounds are up to {times} times as long"
    if coarse.by == STEP:
        slowed = "its one round was" if coarse.rounds == 1 else f"all its {coarse.rounds} rounds were"
        return f"noise; more of the same steps cannot take less time: the machine was busy while {slowed} timed"
    if rounds == 1:
        return "one of the two was timed once, so nothing is known of its noise"
    return f"it is so in the fastest rounds too, {fastest}: fewer steps, or cheaper ones, meet this tolerance"


def _setting(point: Point) -> str:
    return f"step {point.setting:.3g} s" if point.by == STEP else f"{point.by} {point.setting:.3g}"


def _others(pairs: Sized) -> str:
    return "" if len(pairs) == 1 else f" (and {count(len(pairs) - 1, 'more time')})"
