"""Formulas evaluated at one random point of a finite field, so that thousands of wrong derivations are compared fast.

At a point, a formula is a number modulo a prime of 61 bits, cos x and sin x being (z + 1/z)/2 and (z - 1/z)/2i with a
square root i of -1. Two different formulas of degree d agree there with probability at most d/2⁶¹, below 10⁻¹⁵ for
any derivation that is accepted; the wrong terms that are reported are computed exactly.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping
from functools import lru_cache

from .trig import COS, Formula, Space, digits

PRIME = 2305843009213693921  # the largest prime below 2⁶¹ that leaves 1 when divided by 4
ROOT = 583529827753931384  # ROOT² = -1 modulo PRIME
HALF = pow(2, -1, PRIME)
MOST_KEPT = 100_000  # products and waves whose values are kept: a point serves many derivations

Vector = dict[int, int]  # a row at the point: value of the coefficient of each product of motion


class RandomPoint:
    """Random values for all symbols of a space. ``equal_lengths``, ``equal_masses``: one value for all l, all m."""

    def __init__(self, space: Space, equal_lengths: bool = False, equal_masses: bool = False, seed: int = 0) -> None:
        draw = random.Random(f"furiko {space.n} {seed}")  # fixed: a verdict is the same every time
        n = space.n
        self.space = space
        self.values = [draw.randrange(2, PRIME) for _ in range(space.symbol_count)]
        if equal_lengths:
            self.values[2 * n : 3 * n] = [self.values[2 * n]] * n
        if equal_masses:
            self.values[3 * n : 4 * n] = [self.values[3 * n]] * n
        self.turns = [draw.randrange(2, PRIME) for _ in range(n)]  # e^{iθ/2}
        self.base = draw.randrange(2, PRIME)
        self._products: dict[int, int] = {}
        self._waves: dict[tuple[int, int], int] = {}
        self._weights: dict[int, int] = {}

    def elsewhere(self, values: Mapping[int, int]) -> RandomPoint:
        """The point with these values for the symbols at these places."""
        point = RandomPoint(self.space)
        point.values = [values.get(place, value) for place, value in enumerate(self.values)]
        point.turns, point.base = self.turns, self.base
        return point

    def value(self, f: Formula) -> int:
        """The formula at the point; the motion has values too."""
        if len(self._products) + len(self._waves) > MOST_KEPT:
            self._products.clear()
            self._waves.clear()
        total = 0
        for (e, h, s), c in f.terms.items():
            number = int(c.p) if c.q == 1 else int(c.p) * pow(int(c.q), -1, PRIME)
            total += number * self._product(e) * self._wave(h, s) % PRIME
        return total % PRIME

    def vector(self, row: Mapping[int, Formula]) -> Vector:
        """The coefficients of a row; those that vanish are left out."""
        values = ((q, self.value(f)) for q, f in row.items())
        return {q: value for q, value in values if value}

    def weight(self, q: int) -> int:
        """A random weight for each product of motion, by which a vector becomes one number."""
        found = self._weights.get(q)
        if found is None:
            if len(self._weights) > MOST_KEPT:
                self._weights.clear()
            found = self._weights[q] = pow(self.base, q % (PRIME - 1), PRIME)
        return found

    def linear(self, vector: Vector) -> int:
        """A number that is linear in the vector, and zero for no vector but zero (save with probability 2⁻⁶¹)."""
        return sum(value * self.weight(q) for q, value in vector.items()) % PRIME

    def projective(self, vector: Vector) -> int:
        """A number that is the same for a vector and its multiples."""
        if not vector:
            return 0
        first = vector[min(vector)]
        return self.linear(vector) * pow(first, -1, PRIME) % PRIME

    def _product(self, e: int) -> int:
        found = self._products.get(e)
        if found is None:
            found = 1
            for value, power in zip(self.values, digits(e, self.space.symbol_count), strict=True):
                if power:
                    found = found * pow(value, power, PRIME) % PRIME
            self._products[e] = found
        return found

    def _wave(self, h: int, phase: int) -> int:
        found = self._waves.get((h, phase))
        if found is None:
            turn = 1
            for value, power in zip(self.turns, digits(h, self.space.n), strict=True):
                if power:
                    turn = turn * pow(value, power, PRIME) % PRIME
            back = pow(turn, -1, PRIME)
            found = (turn + back) * HALF if phase == COS else (turn - back) * HALF * pow(ROOT, -1, PRIME)
            found = self._waves[h, phase] = found % PRIME
        return found


@lru_cache(maxsize=1 << 16)
def inverse(value: int) -> int:
    """1 / value: the same few coefficients stand in all derivations of a catalogue."""
    return pow(value, -1, PRIME)


@lru_cache(maxsize=64)
def point_of(space: Space) -> RandomPoint:
    """The point of a space at which systems are compared; always the same, so that their values can be kept."""
    return RandomPoint(space)


def combine(parts: Iterable[tuple[int, Vector]]) -> Vector:
    """Σ factor · vector."""
    total: Vector = {}
    for factor, vector in parts:
        for q, value in vector.items():
            total[q] = (total.get(q, 0) + factor * value) % PRIME
    return {q: value for q, value in total.items() if value}


def solved(rows: list[Vector], accelerations: list[int]) -> tuple[tuple[tuple[int, int], ...], ...] | None:
    """The accelerations that linear rows give, each as a sorted vector: the same for every equivalent system.

    ``accelerations``: the packed products that are α₁ … αₙ. None where the rows do not determine them.
    """
    n = len(accelerations)
    rows = [dict(row) for row in rows]
    if len(rows) != n:
        return None
    for place, q in enumerate(accelerations):
        pivot = next((k for k in range(place, n) if rows[k].get(q)), None)
        if pivot is None:
            return None
        rows[place], rows[pivot] = rows[pivot], rows[place]
        inverse = pow(rows[place][q], -1, PRIME)
        rows[place] = {key: value * inverse % PRIME for key, value in rows[place].items()}
        for k in range(n):
            factor = rows[k].get(q)
            if k != place and factor:
                rows[k] = combine([(1, rows[k]), (-factor, rows[place])])
    return tuple(tuple(sorted(row.items())) for row in rows)
