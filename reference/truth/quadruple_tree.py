"""Motions of small open mechanisms in quadruple precision: the articulated bodies' formulas as heyoka expressions.

As :mod:`.quadruple`, for trees of hinges and slides. The mechanism's own numbers (products of lengths and masses that
never change) are rounded to double precision: the motion is that of a mechanism beside it, by roundings.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import library
from ...models.spatial_mechanism import SpatialMechanism
from ..kernels.trees.plain import Numbers, follow
from ..kernels.trees.table import Table, table
from .quadruple import integrated, split

Floats = NDArray[np.float64]

LARGEST = 5  # degrees of freedom: expressions of more take minutes to compile


class _Expressions:
    """A program's memory, of heyoka expressions."""

    def __init__(self, rows: list[Any]) -> None:
        self.rows = rows
        self._hy = library("heyoka")

    def read(self, place: int, first: int, count: int) -> list[Any]:
        """``count`` of them from ``place + first`` on."""
        return self.rows[place + first : place + first + count]

    def write(self, place: int, first: int, values: Sequence[Any]) -> None:
        """Those from ``place + first`` on."""
        self.rows[place + first : place + first + len(values)] = values

    def sincos(self, angle: Any) -> tuple[Any, Any]:
        """Sine and cosine [rad]."""
        return self._hy.sin(angle), self._hy.cos(angle)

    def larger_size(self, _a: Any, b: Any) -> Any:
        """Nothing is noticed of sizes here: a motion that means nothing does not come to its end."""
        return b

    def larger(self, _a: Any, b: Any) -> Any:
        """As :meth:`larger_size`."""
        return b


def quadruple_tree_motion(
    mechanism: SpatialMechanism, q: Sequence[float], v: Sequence[float], times: Sequence[float]
) -> tuple[Floats, Floats]:
    """q [rad, m] and v [rad/s, m/s] at ``times`` [s], (T, 2 nv): the sum of the two, from a state at ``times[0]``.

    Of a mechanism of at most :data:`LARGEST` hinges and slides. Raises LibraryMissing without heyoka, ArithmeticError
    where the motion does not come to its end.
    """
    known = table(mechanism)
    states, _ = integrated(_equations(known), [*map(float, q), *map(float, v)], [*map(float, times)])
    return split(states)


def _equations(known: Table) -> list[tuple[Any, Any]]:
    """dq/dt = v and dv/dt as heyoka wants them."""
    hy = library("heyoka")
    q, v = ([hy.expression(f"{name}{i:02}") for i in range(known.nv)] for name in ("q", "v"))
    rows: list[Any] = [0.0] * known.size
    rows[known.at_q : known.at_v], rows[known.at_v : known.at_torque] = q, v
    follow(known, _Expressions(rows), Numbers(known.numbers))
    return [*zip(q, v, strict=True), *zip(v, rows[known.at_torque : known.signs], strict=True)]
