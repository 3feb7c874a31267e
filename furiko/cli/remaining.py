"""How long a command will still take: by what its parts took so far, once that is known to a factor of two."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence

FACTOR = 2.0  # so well a time must be known to be shown
EARLIEST = 2.0  # [s] from the start: before, most of the time went into starting
# How far off the mean cost of a kind may be: of the same engine, check and size; of other engines; for each step to
# another size, twice as many links, which cost twice as much or so; of mechanisms of another system.
SAME, OTHER_ENGINE, STEP, OTHER_SYSTEM = 1.3, 2.0, 1.5, 8.0
FADES, MOST_DEARER = 0.99, 4.0  # the last hundred results tell what is so lately; a few outliers count no more
MOST_OFF = SAME * STEP  # of an expectation that is held against what a comparison cost
OFF = 0.25  # of its own length: so far off may the part be that runs, by the parts before it

MOST_BITS = 16  # no mechanism has 65,536 links

Place = tuple[str, str, str]  # scene, engine, check
Size = tuple[str, int]  # kind of system, links


def about(seconds: float | None) -> str:
    """``about 40 s left``, to one or two digits; empty where it is not known."""
    if seconds is None:
        return ""
    if seconds < 90:
        return f"about {5 * round(seconds / 5)} s left" if seconds >= 7.5 else "a few seconds left"
    if seconds < 5400:
        return f"about {seconds / 60:.0f} min left"
    return f"about {seconds / 3600:.1f} h left"


class Cells:
    """What is left of a cross-check.

    A comparison costs as much for each link as those of its kind have cost: same engine, check, kind of system, and
    links in powers of two. Until there are some, what it costs at the nearest size, or other engines, or elsewhere.
    """

    def __init__(self, planned: Iterable[tuple[Place, Size]]) -> None:
        """``planned``: each comparison, and the kind and size of its mechanism."""
        self._sizes = dict(planned)
        self._left = dict(self._sizes)
        self._costs: dict[tuple[str | int, ...], list[float]] = {}  # seconds, links
        self._spent = 0.0
        self._lately = [0.0, 0.0]  # what comparisons cost, and what was expected of them [s]

    def took(self, place: Place, seconds: float) -> None:
        """A result came, after so many seconds of work; a check may have several. 0: kept from an earlier run."""
        if place not in self._sizes:
            return
        first = self._left.pop(place, None) is not None
        if seconds > 0:
            (_, engine, check), (system, links) = place, self._sizes[place]
            expected, factor = self._cost(engine, check, system, links)
            if expected and factor <= MOST_OFF:
                self._lately[0] = FADES * self._lately[0] + seconds
                self._lately[1] = FADES * self._lately[1] + expected * first
            size = system, links.bit_length()
            for kind in ((engine, check, *size), (check, *size), (check,)):
                cost = self._costs.setdefault(kind, [0.0, 0])
                cost[0] += seconds
                cost[1] += links * first
            self._spent += seconds

    def remaining(self, elapsed: float) -> float | None:
        """Seconds still to go after ``elapsed`` [s]; None as long as they are not known to a factor of :data:`FACTOR`.

        Work is done at the rate at which it has been done so far, and costs what it costs lately, whatever else the
        machine does.
        """
        if not self._left or elapsed < EARLIEST or not self._spent:
            return None
        low = high = 0.0
        alike = Counter((place[1], place[2], *size) for place, size in self._left.items())
        for (engine, check, system, links), number in alike.items():
            cost, factor = self._cost(engine, check, system, links)
            if not cost:
                return None
            low, high = low + number * cost / factor, high + number * cost * factor
        return None if high > FACTOR**2 * low else self._dearer() * math.sqrt(low * high) * elapsed / self._spent

    def _dearer(self) -> float:
        """What comparisons cost lately over what those before them led to expect: other programs came, or went."""
        cost, expected = self._lately
        return min(max(cost / expected, 1 / MOST_DEARER), MOST_DEARER) if expected else 1.0

    def _cost(self, engine: str, check: str, system: str, links: int) -> tuple[float, float]:
        """What a comparison costs [s], and how far off that may be; 0 where nothing is known."""
        found = [(self._a_link(check), OTHER_SYSTEM)]
        bits = links.bit_length()
        for factor, who in ((SAME, (engine, check)), (OTHER_ENGINE, (check,))):
            sizes = sorted(range(MOST_BITS), key=lambda other: abs(other - bits))
            near = next((other for other in sizes if self._a_link(*who, system, other)), None)
            if near is not None:
                found.append((self._a_link(*who, system, near), factor * STEP ** abs(bits - near)))
        cost, factor = min(found, key=lambda one: one[1])
        return cost * links, factor

    def _a_link(self, *kind: str | int) -> float:
        seconds, links = self._costs.get(kind, (0.0, 0))
        return seconds / links if links else 0.0


class Parts:
    """What is left of a command whose parts have a planned time: those that are done say how much longer they take."""

    def __init__(self, planned: Sequence[float]) -> None:
        """``planned``: seconds of each part, in order."""
        self._planned = tuple(planned)
        self._ends: list[float] = []

    def begins(self, number: int, elapsed: float) -> None:
        """Part ``number``, from 0, begins ``elapsed`` [s] after the start of the command."""
        while len(self._ends) < number:
            self._ends.append(elapsed)

    def remaining(self, elapsed: float) -> float | None:
        """Seconds still to go; None before the first part is done, and near the end of the last."""
        done = len(self._ends)
        if not done or done >= len(self._planned):
            return None
        ratio = self._ends[-1] / sum(self._planned[:done])
        now, later = ratio * self._planned[done], ratio * sum(self._planned[done + 1 :])
        left = max(now - (elapsed - self._ends[-1]), 0.0) + later
        return left if left >= FACTOR * OFF * now else None  # less than that may be half or twice as much
