"""Which mistake in reading explains what an engine holds: each is made by furiko's own reader, and named if it fits.

An engine's known mistakes are flags of :mod:`furiko.models.readers.rules`, which its ``RobotReader`` names. The
smallest set of them with which furiko reads exactly what the engine holds is the explanation; where no set does, the
one that leaves the fewest differences is, and what it leaves is named number by number.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ...models import InvalidInput
from ...models.readers.rules import Rules, with_mistakes
from ...models.spatial_mechanism import SpatialMechanism
from .fields import field_differences
from .numbers import FieldDifference
from .same_names import called_as

Read = Callable[[Rules], SpatialMechanism]  # the file, read with these mistakes


@dataclass(frozen=True)
class Explanation:
    """``mistakes``: flags, each with what it alone changes in the reading; ``left``: differences that they leave."""

    mistakes: tuple[tuple[str, tuple[FieldDifference, ...]], ...]
    left: tuple[FieldDifference, ...]


def explain_reading(
    read: Read,
    language: str,
    left: Callable[[SpatialMechanism], list[FieldDifference]],
    candidates: Sequence[str],
) -> Explanation:
    """Why what an engine holds is not what the file says.

    ``read``: furiko's reader; ``left``: what a reading leaves different from what the engine holds; ``candidates``:
    flags of ``language``, the likelier ones first.
    """
    return _Search(read, language, left).explained(candidates)


class _Search:
    """``left``: what a reading leaves different from what the engine holds."""

    def __init__(self, read: Read, language: str, left: Callable[[SpatialMechanism], list[FieldDifference]]) -> None:
        self._read, self._language, self._left_by = read, language, left
        self._known: dict[frozenset[str], SpatialMechanism | None] = {}

    def explained(self, candidates: Sequence[str]) -> Explanation:
        effective: list[str] = []
        for flag in candidates:
            if self._changes(flag, ()):
                effective.append(flag)
                if self._fits(effective):  # the likelier ones explain all: each other one would be read in vain
                    break
        if not self._fits(effective):
            effective = self._besides(effective, candidates)
        chosen = self._smallest(effective) if self._fits(effective) else self._greedy(effective)
        reading = self._reading(chosen)
        left = self._left_by(reading) if reading is not None else []
        named = ((flag, tuple(self._changes(flag, ()) or self._changes(flag, chosen))) for flag in chosen)
        return Explanation(tuple(named), tuple(left))

    def _besides(self, effective: list[str], candidates: Sequence[str]) -> list[str]:
        """The ``effective`` mistakes, and those that change a reading only where these are made."""
        together, reading = self._reading(effective), self._reading(candidates)
        if together is not None and reading is not None and not field_differences(reading, together):
            return effective
        return [flag for flag in candidates if flag in effective or self._changes(flag, effective)]

    def _changes(self, flag: str, others: Sequence[str]) -> list[FieldDifference]:
        """What one mistake changes beside ``others``; nothing where the file cannot be read with it."""
        with_it = self._reading([*others, flag])
        without = self._reading([other for other in others if other != flag])
        if with_it is None or without is None:
            return []
        return field_differences(called_as(with_it, without), without)

    def _smallest(self, flags: list[str]) -> list[str]:
        """The mistakes without which the reading is no longer the engine's."""
        kept = list(flags)
        for flag in reversed(flags):
            without = [other for other in kept if other != flag]
            if self._fits(without):
                kept = without
        return kept

    def _greedy(self, flags: list[str]) -> list[str]:
        chosen: list[str] = []
        least = self._left(chosen)
        while True:
            tried = [(self._left([*chosen, flag]), k) for k, flag in enumerate(flags) if flag not in chosen]
            if not tried or min(tried)[0] >= least:
                return chosen
            least, best = min(tried)
            chosen.append(flags[best])

    def _fits(self, flags: Sequence[str]) -> bool:
        return self._left(flags) == 0

    def _left(self, flags: Sequence[str]) -> int:
        reading = self._reading(flags)
        if reading is None:
            return 10**9
        return len(self._left_by(reading))

    def _reading(self, flags: Sequence[str]) -> SpatialMechanism | None:
        key = frozenset(flags)
        if key not in self._known:
            try:
                self._known[key] = self._read(with_mistakes(self._language, flags))
            except InvalidInput:
                self._known[key] = None
        return self._known[key]
