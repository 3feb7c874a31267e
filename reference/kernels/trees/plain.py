"""A table's program in plain numpy: a row of the memory is a number of every state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .formulas import PIVOT, SIGNS
from .table import PIECES, Array, Table

BLOCK = 512  # states at a time: more would leave the processor's cache


class Memory:
    """Rows of numbers, one a state."""

    def __init__(self, rows: NDArray[Any]) -> None:
        self.rows = rows

    def read(self, place: int, first: int, count: int) -> list[Any]:
        """``count`` rows from ``place + first`` on."""
        return list(self.rows[place + first : place + first + count])

    def write(self, place: int, first: int, values: Sequence[Any]) -> None:
        """The rows from ``place + first`` on."""
        for i, value in enumerate(values):
            self.rows[place + first + i] = value

    def sincos(self, angle: Any) -> tuple[Any, Any]:
        """Sine and cosine [rad]."""
        return np.sin(angle), np.cos(angle)

    def larger_size(self, a: Any, b: Any) -> Any:
        """The larger of |a| and b."""
        return np.fmax(np.abs(a), b)

    def larger(self, a: Any, b: Any) -> Any:
        """The larger of two."""
        return np.fmax(a, b)


class Numbers:
    """Numbers that are the same in every state."""

    def __init__(self, numbers: NDArray[Any]) -> None:
        self._numbers = numbers

    def read(self, place: int, first: int, count: int) -> list[Any]:
        """``count`` numbers from ``place + first`` on."""
        found: list[Any] = self._numbers[place + first : place + first + count].tolist()
        return found


def in_extended_precision(
    table: Table, q: NDArray[Any], v: NDArray[Any], torque: NDArray[Any] | None = None
) -> NDArray[Any]:
    """The accelerations of states a row each, (B, nv), in the arithmetic of q and v, under ``torque`` (B, nv).

    The mechanism's numbers are rounded to double precision. Not finite where they mean nothing.
    """
    out = np.empty_like(v)
    _block(table, q, v, torque, out)
    return out


def run(table: Table, q: Array, v: Array, torque: Array | None, out: Array) -> tuple[float, float, float]:
    """The accelerations of states a row each into ``out``; returns the signs."""
    finite, largest, pivot = 0.0, 0.0, -np.inf
    for first in range(0, len(q), BLOCK):
        part = slice(first, first + BLOCK)
        signs = _block(table, q[part], v[part], None if torque is None else torque[part], out[part])
        finite += float(signs[0].sum())
        largest, pivot = max(largest, float(signs[1].max())), max(pivot, float(signs[2].max()))
    return finite, largest, pivot


def _block(
    table: Table, q: NDArray[Any], v: NDArray[Any], torque: NDArray[Any] | None, out: NDArray[Any]
) -> NDArray[Any]:
    rows = np.zeros((table.size, len(q)), dtype=q.dtype)
    rows[table.at_q : table.at_v], rows[table.at_v : table.at_torque] = q.T, v.T
    if torque is not None:
        rows[table.at_torque : table.signs] = torque.T
    signs: NDArray[Any] = rows[table.signs :][:SIGNS]
    signs[PIVOT] = -np.inf
    with np.errstate(all="ignore"):  # what is wrong shows in the signs
        follow(table, Memory(rows), Numbers(table.numbers.astype(q.dtype, copy=False)))
    out[...] = rows[table.at_torque : table.signs].T
    return signs


def follow(table: Table, memory: Any, numbers: Any) -> None:
    """Each piece of the program, on a memory like :class:`Memory` and numbers like :class:`Numbers`."""
    for number, *places in table.program.tolist():
        piece = PIECES[number]
        piece(memory, numbers, *places[: piece.__code__.co_argcount - 2])
