"""The catalogue of mistakes: every operator at every place of one mechanism, each with its stable name."""

from __future__ import annotations

from functools import lru_cache

from ..algebra.symbols import Symbols
from ..steps.derivation import Mistake
from .energy import energy_mistakes
from .motion import motion_mistakes
from .rows import row_mistakes


@lru_cache(maxsize=16)
def catalogue(m: Symbols) -> tuple[Mistake, ...]:
    """Every single mistake that is known for a mechanism, earlier stages first; names are unique."""
    return (*energy_mistakes(m), *motion_mistakes(m), *row_mistakes(m))


def codes(m: Symbols) -> tuple[str, ...]:
    """The kinds of mistake, in order of first appearance."""
    return tuple(dict.fromkeys(mistake.code for mistake in catalogue(m)))
