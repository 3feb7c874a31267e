"""Which question is asked next: of every axis something first, coarse before fine.

First every search has one answer, whatever its family; then families share the time by weight. In a family the search
with fewest answers is next, so that each is looked at in as many places as the others, whatever the time allows; cases
that take long come after all that do not, and of searches with as many answers those for which a process has to compile
machine code first. To choose one, and to take its answer, costs a time that grows with the
logarithm of how many there are.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Generic, Protocol, TypeVar


class Asks(Protocol):
    """A search, as far as it is looked at here."""

    @property
    def family(self) -> str:
        """Those that share a part of the time."""
        ...


S = TypeVar("S", bound=Asks)
C = TypeVar("C")


class Questions(Generic[S, C]):
    """The searches that wait, and those that are being answered.

    ``next_case``: the case that a search needs next (None: all is known), and how many answers it has; ``weights``: of
    the families, in their order.
    """

    def __init__(
        self, searches: Sequence[S], next_case: Callable[[S], tuple[C | None, int]], weights: Mapping[str, float]
    ) -> None:
        self._next_case, self._weights = next_case, weights
        self._families = {name: number for number, name in enumerate(weights)}
        self._waiting: defaultdict[str, list[tuple[tuple[bool, int, bool, int], S, C]]] = defaultdict(list)
        self._spent: defaultdict[str, float] = defaultdict(float)
        self._places: dict[S, int] = {}
        self._asked: set[S] = set()
        for place, search in enumerate(searches):
            self._places[search] = place
            self._put(search)

    @property
    def open(self) -> int:
        """How many searches wait for an answer, or are being answered."""
        return sum(map(len, self._waiting.values())) + len(self._asked)

    def next(self) -> tuple[S, C] | None:
        """The next search and its case; its family may have none while others run its last."""
        families = [name for name, waiting in self._waiting.items() if waiting]
        if not families:
            return None
        unanswered = [name for name in families if self._waiting[name][0][0][:2] == (False, 0)]
        turn = min(
            unanswered or families, key=lambda name: (self._spent[name] / self._weights[name], self._families[name])
        )
        _, search, case = heapq.heappop(self._waiting[turn])
        self._asked.add(search)
        return search, case

    def answered(self, search: S, seconds: float) -> None:
        """A search has its answer, which took so long."""
        self._asked.remove(search)
        self._spent[search.family] += seconds
        self._put(search)

    def _put(self, search: S) -> None:
        case, answers = self._next_case(search)
        if case is not None:
            late = bool(getattr(case, "compiles", False))
            urgency = (bool(getattr(case, "heavy", False)), answers, late, self._places[search])
            heapq.heappush(self._waiting[search.family], (urgency, search, case))
