"""A user's own equations in numbers: A(s) s̈ + b(s, ṡ) = 0, in ball arithmetic, so that they have no rounding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...reference.truth.enclosures import precision, rounded
from ..algebra.signs import Form, signs_in
from ..algebra.trig import COS, Formula, Space
from .coordinates import Coordinates

Floats = NDArray[np.float64]
BITS = 256  # of equations that people write; what cancels in them leaves far more than a double has
PARTS = ("velocity", "gravity", "passive")


@dataclass(frozen=True)
class _Term:
    """coefficient · Π symbol^power · cos or sin(Σ halves θ/2)."""

    row: int
    acceleration: int  # the coordinate whose acceleration stands in it; -1: none
    part: int  # of PARTS, where none does
    coefficient: fmpq
    rates: tuple[tuple[int, int], ...]
    places: tuple[tuple[int, int], ...]
    gravity: int
    halves: tuple[tuple[int, int], ...]
    phase: int
    signs: tuple[Form, ...] = ()  # of rates


class OwnMotion:
    """Rows of a space whose own symbols have numbers, as functions of the joints' coordinates q and rates v.

    ``dampers``: of the joints, [N m s or N s/m], for the rows of a Lagrangian, which can have none; these rows are then
    those of the joints' coordinates.
    """

    def __init__(
        self, space: Space, rows: Sequence[Formula], coordinates: Coordinates, gravity: float,
        dampers: Sequence[float] | None = None,
    ) -> None:  # fmt: skip
        self.n, self.coordinates, self.gravity = space.n, coordinates, gravity
        self.dampers = dampers
        self.terms = _terms(space, rows)

    def parts(self, q: Floats, v: Floats) -> tuple[list[list[Any]], list[list[Any]]]:
        """A T (n, n), of the joints' accelerations, and b by its parts, (3, n): velocity, gravity, passive."""
        n = self.n
        s = self.coordinates.positions([arb(x) for x in q.tolist()])
        w = self.coordinates.rates([arb(x) for x in v.tolist()])
        g, waves = arb(self.gravity), {}
        matrix = [[arb(0)] * n for _ in range(n)]
        rest = [[arb(0)] * n for _ in PARTS]
        for term in self.terms:
            key = term.halves, term.phase
            if key not in waves:
                angle = sum((s[k] * h for k, h in term.halves), arb(0)) / 2
                waves[key] = angle.cos() if term.phase == COS else angle.sin()
            value = waves[key] * arb(term.coefficient)
            for numbers, powers in ((w, term.rates), (s, term.places)):
                for k, power in powers:
                    value *= numbers[k] ** power
            for form in term.signs:
                value *= sum((w[k] * c for k, c in form), arb(0)).sgn()
            if term.gravity:
                value *= g**term.gravity
            if term.acceleration < 0:
                rest[term.part][term.row] += value
                continue
            for j, factor in enumerate(self.coordinates.turns[term.acceleration]):
                if factor:
                    matrix[term.row][j] += value * factor
        return (matrix, rest) if self.dampers is None else self._of_joints(matrix, rest, v, self.dampers)

    def _of_joints(
        self, matrix: list[list[Any]], rest: list[list[Any]], v: Floats, dampers: Sequence[float]
    ) -> tuple[list[list[Any]], list[list[Any]]]:
        """Tᵀ times the rows, and the forces of the dampers."""
        turns, n = self.coordinates.turns, range(self.n)
        matrix = [[sum((turns[i][j] * matrix[i][k] for i in n if turns[i][j]), arb(0)) for k in n] for j in n]
        rest = [[sum((turns[i][j] * part[i] for i in n if turns[i][j]), arb(0)) for j in n] for part in rest]
        passive = PARTS.index("passive")
        rest[passive] = [b + arb(d) * arb(x) for b, d, x in zip(rest[passive], dampers, v.tolist(), strict=True)]
        return matrix, rest

    def accelerations(self, q: Floats, v: Floats) -> Floats:
        """a (B, n), the nearest doubles; NaN in a state in which the rows do not determine them."""
        found = [self._acceleration(*state) for state in zip(q, v, strict=True)]
        return np.array(found).reshape(-1, self.n)

    def _acceleration(self, q: Floats, v: Floats) -> Floats:
        with precision(BITS):
            matrix, rest = self.parts(q, v)
            right = [[-sum(part[i] for part in rest)] for i in range(self.n)]
            try:
                solved = arb_mat(matrix).solve(arb_mat(right))
            except ZeroDivisionError:
                return np.full(self.n, np.nan)
            return rounded(np.array([solved[i, 0] for i in range(self.n)], dtype=object))[0]

    def floats(self, q: Floats, v: Floats) -> tuple[Floats, Floats]:
        """A T (B, n, n) and b by parts (B, 3, n), the nearest doubles."""
        with precision(BITS):
            both = [self.parts(*state) for state in zip(q, v, strict=True)]
            matrices = [[[float(x) for x in row] for row in matrix] for matrix, _ in both]
            rests = [[[float(x) for x in row] for row in rest] for _, rest in both]
        return np.array(matrices).reshape(-1, self.n, self.n), np.array(rests).reshape(-1, len(PARTS), self.n)


def _terms(space: Space, rows: Sequence[Formula]) -> list[_Term]:
    n, found = space.n, []
    with_gravity = any(powers[4 * n] for row in rows for powers, *_ in space.monomials(row))
    forms = signs_in(space)
    for i, row in enumerate(rows):
        for powers, halves, phase, c in space.monomials(row):
            accelerations = [k for k in range(n) if powers[k]]
            if len(accelerations) > 1 or any(powers[k] != 1 for k in accelerations):
                raise InvalidInput(f"equations: in row {i + 1} accelerations are multiplied by one another")
            rates = tuple((k, powers[n + k]) for k in range(n) if powers[n + k])
            if accelerations and rates and any(power < 0 for _, power in rates):
                raise InvalidInput(f"equations: row {i + 1} divides by a rate")
            places = tuple((k, powers[4 * n + 2 + k]) for k in range(n) if powers[4 * n + 2 + k])
            turned = tuple((k, h) for k, h in enumerate(halves) if h)
            signs = tuple(form for place, form in forms.items() if powers[place])
            part = _part(sum(power for _, power in rates), bool(powers[4 * n]), with_gravity)
            part = PARTS.index("passive") if signs else part
            acceleration = accelerations[0] if accelerations else -1
            found.append(_Term(i, acceleration, part, c, rates, places, powers[4 * n], turned, phase, signs))
    return found


def _part(rate_power: int, has_gravity: bool, with_gravity: bool) -> int:
    """Squares of rates are of the velocity; what is left of them without g, where g is written, of springs."""
    if rate_power == 2:
        return PARTS.index("velocity")
    if rate_power == 0 and (has_gravity or not with_gravity):
        return PARTS.index("gravity")
    return PARTS.index("passive")
