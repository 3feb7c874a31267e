"""Where something stops working, found by bisection on a ladder; one question at a time, answered by whoever asks.

Everything is a function of the answers so far, so that a search that was cut off goes on where it stood, and that two
processes never need to agree on anything but what is written down. From the easy end a few rungs are looked at, evenly
spaced; between the last that held and the first that did not the search bisects.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

SCOUTS = 4  # the ladder is looked at in so many places, so that a failure that goes away again is seen all the same


@dataclass(frozen=True)
class Frontier:
    """``holds``: the last rung known to hold before the first known to fail (-1: none does); ``fails``: that one.

    ``fails`` is None where every rung looked at holds. ``closed``: no rung between the two is left, or no scout is.
    """

    holds: int
    fails: int | None
    closed: bool

    @property
    def width(self) -> int:
        """How many rungs lie between, by which the frontier is not known."""
        return 0 if self.fails is None else self.fails - self.holds - 1


def scouts(top: int) -> list[int]:
    """The rungs that are looked at first, from the easy end."""
    return sorted({round(top * part / SCOUTS) for part in range(SCOUTS + 1)})


def frontier(answers: Mapping[int, bool], top: int) -> Frontier:
    """The frontier that the answers (rung: whether it holds) show so far."""
    failing = [rung for rung, holds in answers.items() if not holds]
    if not failing:
        return Frontier(max(answers, default=-1), None, next_rung(answers, top) is None)
    first = min(failing)
    below = max((rung for rung, holds in answers.items() if holds and rung < first), default=-1)
    return Frontier(below, first, below == first - 1)


def next_rung(answers: Mapping[int, bool], top: int) -> int | None:
    """The rung to look at next; None where the frontier is known."""
    failing = [rung for rung, holds in answers.items() if not holds]
    ahead = [rung for rung in scouts(top) if rung not in answers]
    if not failing:
        return ahead[0] if ahead else None
    first = min(failing)
    before = [rung for rung in ahead if rung < first]
    if before:
        return before[0]
    below = max((rung for rung, holds in answers.items() if holds and rung < first), default=-1)
    return None if first - below <= 1 else (first + below) // 2
