"""Finds the numbers that an author put for lengths and masses: guessed here, by least squares, and proved elsewhere.

The rows given, solved at random states, give accelerations; the mechanism's equations with unknown parameters p are to
hold there. Gauss–Newton in log p, from a few starts. Parameters that the equations do not determine (all masses scaled;
lengths and gravity scaled together) are fixed first.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from ..algebra.equivalence import line
from ..algebra.trig import COS, Formula, Space, constant, digits

Array = NDArray[np.float64]
STATES, STARTS, STEPS = 12, 4, 40
FINEST = 10_000  # denominators of the numbers that people write
CLOSE = 1e-9  # residuals at the solution: rounding, with condition numbers below 1e6


def fitted(space: Space, given: Sequence[Formula], right: Sequence[Formula], free: Sequence[int],
           fixed: dict[int, Formula]) -> dict[int, Formula] | None:  # fmt: skip
    """Rational values for the symbols at ``free`` with which the right rows may be those given; None where none fit.

    ``fixed``: values of what is not determined.
    """
    draw = random.Random(f"furiko {space.n} {len(free)}")
    values = np.array([draw.uniform(0.6, 1.7) for _ in range(space.symbol_count)])
    for place, f in fixed.items():
        values[place] = float(Fraction(str(f.number())))
    states = _States(space, values, draw)
    accelerations = states.solved(given)
    if accelerations is None:
        return None
    x = _least_squares(states, right, accelerations, list(free), draw)
    if x is None:
        return None
    found: dict[int, Formula] = dict(fixed)
    for place, value in zip(free, np.exp(x), strict=True):
        near = Fraction(float(value)).limit_denominator(FINEST)
        if abs(float(near) - value) > 1e-6 * value or not near:
            return None
        found[place] = constant(fmpq(near.numerator, near.denominator))
    return found


class _States:
    """Random states in double precision."""

    def __init__(self, space: Space, values: Array, draw: random.Random) -> None:
        self.space, self.values = space, values
        n = space.n
        self.theta = np.array([[draw.uniform(-3, 3) for _ in range(n)] for _ in range(STATES)])
        self.omega = np.array([[draw.uniform(-2, 2) for _ in range(n)] for _ in range(STATES)])

    def table(self, f: Formula, accelerations: Array | None, free: Sequence[int]) -> tuple[Array, Array]:
        """A formula's terms at the states, without the free symbols (STATES, terms), and the powers of those."""
        n, space = self.space.n, self.space
        columns, powers = [], []
        for (e, h, s), c in f.terms.items():
            exponents = digits(e, space.symbol_count)
            angle = self.theta @ np.array(digits(h, n)) / 2
            term = float(int(c.p)) / float(int(c.q)) * (np.cos(angle) if s == COS else np.sin(angle))
            for place, power in enumerate(exponents):
                if not power or place in free:
                    continue
                if place < n:
                    assert accelerations is not None
                    term = term * accelerations[:, place] ** power
                elif place < 2 * n:
                    term = term * self.omega[:, place - n] ** float(power)
                else:
                    term = term * self.values[place] ** float(power)
            columns.append(term)
            powers.append([exponents[place] for place in free])
        if not columns:
            return np.zeros((STATES, 1)), np.zeros((1, len(free)))
        return np.array(columns).T, np.array(powers, dtype=float)

    def solved(self, rows: Sequence[Formula]) -> Array | None:
        """The accelerations that rows give, shape (STATES, n); None where they give none."""
        lines = [line(self.space, f) for f in rows]
        if len(lines) != self.space.n or any(x is None for x in lines):
            return None
        entries = np.array([[self.table(f, None, ())[0].sum(axis=1) for f in x] for x in lines if x is not None])
        entries = entries.transpose(2, 0, 1)
        try:
            return np.asarray(np.linalg.solve(entries[..., :-1], -entries[..., -1:])[..., 0])
        except np.linalg.LinAlgError:
            return None


def _least_squares(
    states: _States, right: Sequence[Formula], accelerations: Array, free: list[int], draw: random.Random
) -> Array | None:
    tables = [states.table(row, accelerations, free) for row in right]
    with np.errstate(all="ignore"):
        for start in range(STARTS):
            x: Array = np.array([draw.uniform(-1, 1) if start else 0.0 for _ in free])
            damping = 1e-2
            residual, jacobian = _residual(tables, x)
            for _ in range(STEPS):
                normal = jacobian.T @ jacobian
                step = np.linalg.lstsq(normal + damping * np.eye(len(x)), -jacobian.T @ residual, rcond=None)[0]
                there: Array = np.asarray(x + np.clip(step, -1, 1), dtype=np.float64)
                moved, slope = _residual(tables, there)
                if moved @ moved < residual @ residual:
                    x, residual, jacobian, damping = there, moved, slope, damping / 10
                else:
                    damping *= 10
                if np.abs(residual).max() < 1e-14 or damping > 1e12:
                    break
            if np.abs(residual).max() < CLOSE:
                return x
    return None


def _residual(tables: list[tuple[Array, Array]], x: Array) -> tuple[Array, Array]:
    """Each row over the sum of its terms' magnitudes, and the derivatives (of the row alone)."""
    residuals, slopes = [], []
    for terms, powers in tables:
        weighted = terms * np.exp(powers @ x)
        scale = np.abs(weighted).sum(axis=1) + 1e-300
        value = weighted.sum(axis=1) / scale
        change = (weighted @ powers) / scale[:, None]
        size = (np.abs(weighted) @ powers) / scale[:, None]
        residuals.append(value)
        slopes.append(change - value[:, None] * size)
    return np.nan_to_num(np.concatenate(residuals), nan=1.0), np.nan_to_num(np.concatenate(slopes))
