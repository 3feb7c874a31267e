"""Times of several calls, taken in turn, so that a slow phase of the machine hits them all and ratios hold."""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHORTEST = 1e-3  # [s] of one sample: ten thousand times the time to read the clock
LONG = 1.0  # [s]: a first call that takes longer needs no warm-up; loading and compiling are little of it
ROUNDS = 9
FEWEST = 3  # rounds, however long they take: a median of fewer means nothing


@dataclass(frozen=True)
class Subject:
    """A call to be timed, and the context in which it is timed (entered once per sample, outside the timing)."""

    call: Callable[[], object]
    around: Callable[[], AbstractContextManager[object]] = nullcontext


@dataclass(frozen=True)
class Times:
    """Seconds per call, one value for each round, shape (rounds,)."""

    seconds: Array

    @property
    def minimum(self) -> float:
        """The shortest time [s]: that of an undisturbed machine."""
        return float(self.seconds.min())

    @property
    def median(self) -> float:
        """The median time [s]."""
        return float(np.median(self.seconds))

    def over(self, other: Times) -> float:
        """This time over the other: the median of the ratios of the rounds."""
        return float(np.median(self.seconds / other.seconds))


def interleaved(
    subjects: Mapping[str, Subject],
    *,
    budget: float = math.inf,
    rounds: int = ROUNDS,
    fewest: int = FEWEST,
    shortest: float = SHORTEST,
) -> dict[str, Times]:
    """Time every subject once in every round, in alternating order, after a warm-up of each.

    No round begins after ``budget`` [s], but for the first ``fewest``. A sample is as many calls as fill ``shortest``
    [s]; with 0 it is one call, and there is no warm-up: the subjects have just run.
    """
    repeats = {name: _repeats(subject, shortest) if shortest > 0 else 1 for name, subject in subjects.items()}
    samples: dict[str, list[float]] = {name: [] for name in subjects}
    order = list(subjects)
    begun = time.perf_counter()
    for done in range(rounds):
        if done >= fewest and time.perf_counter() - begun > budget:
            break
        for name in order:
            samples[name].append(_sample(subjects[name], repeats[name]))
        order.reverse()  # so that a steady drift of the machine's speed favours none
    return {name: Times(np.array(found)) for name, found in samples.items()}


def once(subject: Subject) -> float:
    """Seconds of one call."""
    return _sample(subject, 1)


def _repeats(subject: Subject, shortest: float) -> int:
    """Calls in a sample, found by doubling; the very first call, which loads and compiles, is not counted."""
    if once(subject) > LONG:
        return 1
    count, taken = 1, once(subject)
    while taken < shortest:
        count = max(2 * count, min(16 * count, math.ceil(count * shortest / max(taken, 1e-9))))
        taken = _sample(subject, count) * count
    return count


def _sample(subject: Subject, calls: int) -> float:
    """Mean seconds of this many calls in a row, without the garbage collector."""
    call, numbers = subject.call, range(calls)
    collecting = gc.isenabled()
    with subject.around():
        gc.disable()
        try:
            begun = time.perf_counter()
            for _ in numbers:
                call()
            return (time.perf_counter() - begun) / calls
        finally:
            if collecting:
                gc.enable()
