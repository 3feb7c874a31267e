"""How an author counts what the joints of a mechanism count: s = T q + offset, the rates likewise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from flint import arb

from ...models.errors import InvalidInput, nearest
from ...models.trees.own import OwnEquations
from ...models.trees.system import TreeSystem
from ..reading.submission import ORIGINS, SENSES
from ..steps.conventions import Convention
from ..steps.mechanism import QUARTERS
from .plane import Plane

SNAPPED = 1e-9  # rad; a direction so near to a quarter turn is one: files print angles with that many digits or more
MOST_SENSES = 3  # hinges whose senses are tried one by one


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


def convention_of(own: OwnEquations, n: int) -> Convention | None:
    """As the file declares it; None where it does not. Raises :class:`InvalidInput`."""
    if not own.declares_angles:
        return None
    if own.angles not in ("", "absolute", "relative"):
        raise InvalidInput(f"angles: {own.angles!r:.40} is not known; give 'absolute' or 'relative'")
    if own.origin and own.origin not in ORIGINS:
        raise InvalidInput(f"from: {own.origin!r:.40} is not known{nearest(own.origin, ORIGINS)}; "
                           f"give one of {', '.join(ORIGINS)}")  # fmt: skip
    if any(sense not in SENSES for sense in own.senses) or len(own.senses) not in (0, 1, n):
        raise InvalidInput("sense: give 'counter-clockwise' or 'clockwise', or a list of one for each joint")
    senses = tuple(SENSES[sense] for sense in own.senses)
    return Convention(
        own.angles == "relative", ORIGINS[own.origin or "down"], senses * n if len(senses) == 1 else senses
    )


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
    convention = convention_of(own, system.n)
    if convention is None:
        return joint_coordinates(system.n)
    if plane is None:
        raise InvalidInput(f"angles: {why_not}; leave out angles, from and sense, and use the joints' coordinates")
    return coordinates_in(plane, convention)
