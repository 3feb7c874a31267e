"""The catalogue of mistakes: every kind of mistake at every place of one mechanism, each with its stable name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from ..algebra.symbols import Symbols
from ..steps.derivation import Mistake, correct_derivation
from .bodies import point_mass_mistakes, rod_mistakes
from .energies import energy_mistakes, lagrangian_mistakes
from .every_mass import every_mass_mistakes
from .lagrange_equations import lagrange_mistakes
from .matrix_form import matrix_mistakes, row_mistakes
from .newton_euler import newton_euler_mistakes
from .positions import position_mistakes
from .row_terms import term_mistakes
from .velocities import speed_mistakes, velocity_mistakes


@lru_cache(maxsize=16)
def catalogue(m: Symbols) -> tuple[Mistake, ...]:
    """Every single mistake that is known for a mechanism, earlier stages first; names are unique.

    The order matters: of mistakes that explain a derivation equally well, the first is named.
    """
    return (*_up_to_lagrangian(m), *lagrange_mistakes(m), *newton_euler_mistakes(m), *_in_rows(m))


def _up_to_lagrangian(m: Symbols) -> Iterator[Mistake]:
    for b in range(m.n):
        yield from position_mistakes(m, b)
        yield from velocity_mistakes(m, b)
        yield from speed_mistakes(m, b)
        yield from energy_mistakes(m, b)
        yield from lagrangian_mistakes(m, b)
    yield from every_mass_mistakes(m)
    yield from rod_mistakes(m) if m.kind == "rod-chain" else point_mass_mistakes(m)


def _in_rows(m: Symbols) -> Iterator[Mistake]:
    for i, row in enumerate(correct_derivation(m).rows):
        yield from term_mistakes(m, i, row)
        yield from row_mistakes(m, i)
    yield from matrix_mistakes(m)
