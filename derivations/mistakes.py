"""The catalogue of mistakes: every operator at every place of one mechanism, each with its stable name."""

from __future__ import annotations

from functools import lru_cache

from .derivation import Mistake
from .mechanism import Mechanism
from .mistakes_energy import energy_mistakes
from .mistakes_motion import motion_mistakes
from .mistakes_rows import row_mistakes


@lru_cache(maxsize=16)
def catalogue(m: Mechanism) -> tuple[Mistake, ...]:
    """Every single mistake that is known for a mechanism, earlier stages first; names are unique."""
    return (*energy_mistakes(m), *motion_mistakes(m), *row_mistakes(m))


def codes(m: Mechanism) -> tuple[str, ...]:
    """The kinds of mistake, in order of first appearance."""
    return tuple(dict.fromkeys(mistake.code for mistake in catalogue(m)))
