"""How an author counts what the joints of a mechanism count: s = T q + offset, the rates likewise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from flint import arb

from ...models.errors import InvalidInput
from ...models.trees.own import OwnEquations
from ...models.trees.system import TreeSystem
from ..reading.motion.convention import convention_of
from ..steps.conventions import MOST_SENSES, Convention
from ..steps.mechanism import QUARTERS
from .plane import Plane

SNAPPED = 1e-9  # rad; a direction so near to a quarter turn is one: files print angles with that many digits or more


@dataclass(frozen=True)
class Coordinates:
    """s_k = Σ turns[k][j] q_j + quarters[k] π/2 + rest[k]; ``convention``: None for the joints' own coordinates."""

    turns: tuple[tuple[int, ...], ...]
    quarters: tuple[int, ...]
    rest: tuple[float, ...]
    convention: Convention | None = None

    def positions(self, q: list[Any]) -> list[Any]:
        """The author's coordinates, in balls, of the joints'."""
        rates = self.rates(q)
        half = arb.pi() / 2
        return [s + n * half + arb(r) for s, n, r in zip(rates, self.quarters, self.rest, strict=True)]

    def rates(self, v: list[Any]) -> list[Any]:
        """The author's rates of the joints'."""
        return [sum((c * x for c, x in zip(row, v, strict=True) if c), arb(0)) for row in self.turns]


def joint_coordinates(n: int) -> Coordinates:
    """The joints' own."""
    turns = tuple(tuple(int(j == k) for j in range(n)) for k in range(n))
    return Coordinates(turns, (0,) * n, (0.0,) * n)


def declared_convention(own: OwnEquations, n: int) -> Convention | None:
    """As the file declares it; None where it does not. Raises :class:`InvalidInput`."""
    if not own.declares_angles:
        return None
    senses = own.senses[0] if len(own.senses) == 1 else own.senses
    given = {"angles": own.angles, "from": own.origin, "sense": senses}
    return convention_of({field: value for field, value in given.items() if value}, n)


def coordinates_in(plane: Plane, convention: Convention) -> Coordinates:
    """The angles that a convention counts; slides keep their joints' coordinates. Raises :class:`InvalidInput`."""
    n = len(plane.bodies)
    turns, quarters, rest = [], [], []
    for k, body in enumerate(plane.bodies):
        row, offset = [0] * n, 0.0
        if not body.turns:
            row[k] = 1
        else:
            *before, last = plane.hinges(k)
            sense, offset, counted = convention.sense(k), plane.angle(k), [*before, last]
            if convention.relative and before:
                offset, counted = offset - plane.angle(before[-1]), [last]
            else:
                offset -= QUARTERS[convention.origin] * math.pi / 2
            for j in counted:
                row[j] = sense * plane.bodies[j].sense
                offset -= plane.bodies[j].sense * plane.bodies[j].joint.ref
            offset = math.remainder(sense * offset, 2 * math.pi)
        near = round(offset / (math.pi / 2))
        snaps = abs(offset - near * math.pi / 2) <= SNAPPED
        turns.append(tuple(row))
        quarters.append(near if snaps else 0)
        rest.append(0.0 if snaps else offset)
    return Coordinates(tuple(turns), tuple(quarters), tuple(rest), convention)


def other_conventions(plane: Plane) -> Iterator[Convention]:
    """Every way in which people count angles, the likeliest first."""
    n = len(plane.bodies)
    hinges = [k for k, body in enumerate(plane.bodies) if body.turns]
    mixed = len(hinges) <= MOST_SENSES
    for signs in product((1, -1), repeat=len(hinges)):
        if mixed or len(set(signs)) == 1:
            senses = [1] * n
            for k, sign in zip(hinges, signs, strict=True):
                senses[k] = sign
            for relative in (False, True) if len(hinges) > 1 else (False,):
                for origin in QUARTERS:
                    yield Convention(relative, origin, tuple(senses))


def read_coordinates(system: TreeSystem, own: OwnEquations, plane: Plane | None, why_not: str) -> Coordinates:
    """As the file declares them. Raises :class:`InvalidInput` where it declares angles of no plane."""
    convention = declared_convention(own, system.n)
    if convention is None:
        return joint_coordinates(system.n)
    if plane is None:
        raise InvalidInput(f"angles: {why_not}; leave out angles, from and sense, and use the joints' coordinates")
    return coordinates_in(plane, convention)
