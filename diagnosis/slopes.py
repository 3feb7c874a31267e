"""Why an engine's derivatives of accelerations, or its M⁻¹, are wrong.

A wrong matrix is often a right one of something else: each such mistake is tried, and named where it gives to nine
digits what the engine gave.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Of the largest entry: far above what rounding does to matrices computed in double precision, and far below what
# another matrix would leave.
SAME = 1e-9


@dataclass(frozen=True)
class Mistake:
    """``cause``: a code; ``says``: what the matrix then is; ``gives`` (K, n, n): that matrix."""

    cause: str
    says: str
    gives: Array


def mistakes(part: int, true: Array, mass: Array) -> Iterator[Mistake]:
    """What any engine may give in the place of part 0, 1 or 2 of the truth (K, 3, n, n)."""
    right = true[:, part]
    yield Mistake("derivative-sign", "it has the opposite sign", -right)
    yield Mistake("derivative-transposed", "it is transposed", right.swapaxes(1, 2))
    yield Mistake("factor-two", "it is twice what it should be", 2 * right)
    yield Mistake("factor-half", "it is half of what it should be", right / 2)
    if part == 2:
        yield Mistake("mass-matrix-for-inverse", "it is the mass matrix itself", mass)
        return
    yield Mistake("derivatives-exchanged", "it is the other derivative", true[:, 1 - part])
    forces = -mass @ right
    yield Mistake("derivative-of-forces", "it is that of inverse dynamics: −M⁻¹ is not applied", forces)
    yield Mistake("derivative-of-forces", "it is that of forces: M⁻¹ is not applied", -forces)


def conventions(part: int, right: Array, to_absolute: Array) -> Iterator[Mistake]:
    """The matrix in other angles: with S the change, S⁻¹ D S and S⁻¹ X S⁻ᵀ are those of relative ones."""
    to_relative = np.asarray(np.linalg.inv(to_absolute), dtype=np.float64)
    back, on = (to_absolute, to_relative) if part < 2 else (to_relative.T, to_absolute.T)
    same = np.eye(len(to_absolute))
    for says, rows, columns in (
        ("it is that of relative angles", to_relative, back),
        ("its rows alone are absolute", same, back),
        ("its columns alone are absolute", to_relative, same),
        ("it is made absolute twice", to_absolute, on),
    ):
        yield Mistake("angle-convention", says, rows @ right @ columns)


def cause_of(got: Array, candidates: Iterator[Mistake], right: Array) -> Mistake | None:
    """The first mistake that gives what the engine gave, in all states (K, n, n); none that is the truth itself."""
    for one in candidates:
        size = float(np.abs(one.gives).max(initial=0.0))
        if not _same(one.gives, right, size) and _same(got, one.gives, size):
            return one
    return None


def _same(one: Array, other: Array, size: float) -> bool:
    return float(np.abs(one - other).max(initial=0.0)) <= SAME * size


# Of the largest entry: central differences over 2⁻¹⁷ of accelerations of double precision are good to some 1e-9.
DIFFERENCED = 1e-6
STEP = 2.0**-17


def of_own_accelerations(
    ask: Callable[[Array, Array], Array], part: int, q: Array, v: Array, right: Array
) -> Mistake | None:
    """Named where the engine's own accelerations ``ask`` have the true derivatives, by central differences.

    ``q``, ``v``: the states (K, n); ``right``: the true matrices of part 0 or 1 (K, n, n).
    """
    found = np.empty_like(right)
    for k in range(q.shape[-1]):
        step = np.zeros(q.shape[-1])
        step[k] = STEP
        ahead, behind = ((q + step, v), (q - step, v)) if part == 0 else ((q, v + step), (q, v - step))
        found[:, :, k] = (ask(*ahead) - ask(*behind)) / (2 * STEP)
    if float(np.abs(found - right).max(initial=0.0)) > DIFFERENCED * float(np.abs(right).max(initial=0.0)):
        return None
    says = "the engine's own accelerations, differenced, have the true derivatives: it differentiates wrongly"
    return Mistake("derivatives-of-others", says, found)
