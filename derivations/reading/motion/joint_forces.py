"""Whether a force that one row alone has is one that a rod or a slide holds: such a row says nothing of the motion.

``T = m g cos θ + m l θ̇²`` only says what T is, and is of no account for the motion. It is right where T is what the
bodies behind a joint need: the sum of m (a - g) over them, along the rod, across it, or to the right and upwards.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...algebra.equivalence import solve
from ...algebra.fingerprint import PRIME, RandomPoint, point_of
from ...algebra.trig import CONSTANT_ONE, COS, NOTHING, SIN, Formula, Space
from ...steps.conventions import Convention
from ...steps.declared import Declared
from ...steps.families import family
from ...steps.mechanism import Direction, Mechanism

Row = tuple[str, Formula]


def bodies_of(declared: Declared | None, kind: str, space: Space, convention: Convention) -> Mechanism | None:
    """The mechanism as it is declared; None where its bodies are not known for certain."""
    if declared is not None:
        return declared.mechanism(convention)
    return family(kind, space, convention) if kind in ("point-masses", "n-leg") else None


def is_held(mechanism: Mechanism, rows: Sequence[Row], forces: Sequence[str], force: str) -> bool:
    """Whether the rows give this force a value that a joint's force has, while the motion is the true one.

    Also where the rows contradict the true motion, in which case they are wrong whatever the force is.
    """
    space = mechanism.space
    point = point_of(space)
    n = space.n
    lines = mechanism.system.numbers
    motion = solve([line[:n] for line in lines], [-line[n] for line in lines])
    if motion is None:
        return False
    there = point.elsewhere(dict(enumerate(motion)))
    equations = [_of_forces(space, f, forces, there) for _, f in rows]
    value = _solved(equations, list(forces).index(force))
    if value is None:
        return True
    if force[0] == "T":  # a tension pulls
        return value in (-there.value(f) % PRIME for f, is_along in _candidates(mechanism) if is_along)
    return any(value in (x, -x % PRIME) for x in (there.value(f) for f, _ in _candidates(mechanism)))


def _of_forces(space: Space, f: Formula, forces: Sequence[str], there: RandomPoint) -> list[int]:
    """The coefficients of the forces in a row, and minus what is left."""
    places = [space.own_place(name) for name in forces]
    rest = space.replace(f, dict.fromkeys(places, NOTHING))
    return [*(there.value(space.by_symbol(f, place)) for place in places), -there.value(rest) % PRIME]


def _solved(equations: list[list[int]], which: int) -> int | None:
    """One unknown of linear equations; None where they contradict each other, or do not determine it."""
    rows = [list(row) for row in equations]
    count = len(rows[0]) - 1
    done = 0
    pivots: dict[int, int] = {}
    for column in range(count):
        pivot = next((k for k in range(done, len(rows)) if rows[k][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        inverse = pow(rows[done][column], -1, PRIME)
        rows[done] = [x * inverse % PRIME for x in rows[done]]
        for k, row in enumerate(rows):
            if k != done and row[column]:
                rows[k] = [(x - row[column] * y) % PRIME for x, y in zip(row, rows[done], strict=True)]
        pivots[column] = done
        done += 1
    if any(row[count] for row in rows[done:]) or which not in pivots:
        return None
    return rows[pivots[which]][count]


def _candidates(mechanism: Mechanism) -> Iterator[tuple[Formula, bool]]:
    """What joints hold, to the right, upwards, across and along each direction; and whether it is along."""
    space = mechanism.space
    accelerations = [
        (space.by_time(space.by_time(x)), space.by_time(space.by_time(y)) + mechanism.gravity)
        for x, y in mechanism.positions
    ]
    directions = {s.direction for body in mechanism.bodies for s in body.way}
    for direction in directions:
        behind = [b for b, body in enumerate(mechanism.bodies) if any(s.direction == direction for s in body.way)]
        x, y = NOTHING, NOTHING
        for b in behind:
            x, y = x + mechanism.mass(b) * accelerations[b][0], y + mechanism.mass(b) * accelerations[b][1]
        along = _unit(space, direction, 0)
        across = _unit(space, direction, 1)
        yield from ((x, False), (y, False), (x * across[0] + y * across[1], False))
        yield x * along[0] + y * along[1], True


def _unit(space: Space, direction: Direction, turns: int) -> tuple[Formula, Formula]:
    """A vector of length 1: sine, and minus cosine, as of a direction from the downward vertical."""
    return CONSTANT_ONE * direction.wave(space, SIN, turns), -(CONSTANT_ONE * direction.wave(space, COS, turns))
