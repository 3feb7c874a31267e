"""The parts of any planar mechanism's derivation that a mistake may change, and what a mistake is.

The way to a body's centre of mass is a sum of segments. Rows are linear in the Lagrangian, so that what a mistake adds
to it is all that is needed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from ...algebra.notation import pretty
from ...algebra.trig import COS, HALF, NOTHING, SIN, Formula
from ...steps.derivation import Stage, add
from ...steps.mechanism import Direction, Mechanism, Segment

Vector = tuple[Formula, Formula]


@dataclass(frozen=True)
class AnyMistake:
    """A mistake in any mechanism. ``energy``: what it adds to T - U; ``rows``: what it adds to each row.

    ``half_hidden``: a position is wrong and only one of the two energies shows it, where a mistake would say as much.
    """

    code: str
    stage: Stage
    english: str
    japanese: str
    energy: Formula = NOTHING
    rows: dict[int, Formula] = field(default_factory=dict)
    half_hidden: bool = False

    @property
    def size(self) -> int:
        """How many terms it changes: of the energies, or of the rows."""
        return len(self.energy) + sum(map(len, self.rows.values()))


@dataclass(frozen=True)
class Words:
    """How the author calls things: one name each."""

    coordinates: tuple[str, ...]
    rates: tuple[str, ...]
    accelerations: tuple[str, ...]
    bodies: tuple[str, ...]


def shown(words: Words, ascii_text: str) -> str:
    """A formula in the author's letters."""
    names = {"t": words.coordinates, "q": words.coordinates, "w": words.rates, "a": words.accelerations}
    return pretty(re.sub(r"\b([tqwa])([0-9]+)\b", lambda found: names[found[1]][int(found[2]) - 1], ascii_text))


class Parts:
    """The velocity and the height of every body, segment by segment."""

    def __init__(self, mechanism: Mechanism, words: Words) -> None:
        self.m, self.words, self.space = mechanism, words, mechanism.space
        self.ways = [body.way for body in mechanism.bodies]
        self.velocities = [[self.velocity(x) for x in way] for way in self.ways]
        self.heights = [[x.direction.vector(self.space, x.length)[1] for x in way] for way in self.ways]

    def velocity(self, x: Segment) -> Vector:
        """d/dt of a segment."""
        along, up = x.direction.vector(self.space, x.length)
        return self.space.by_time(along), self.space.by_time(up)

    def turning(self, x: Segment, rate: Formula) -> Vector:
        """A segment's velocity from turning alone, at this rate."""
        d = x.direction
        return x.length * d.wave(self.space, COS, 0) * rate, x.length * d.wave(self.space, SIN, 0) * rate

    def rate(self, turns: Sequence[int]) -> Formula:
        """Σ turns · ω."""
        return add(self.space.w(k).times(c) for k, c in enumerate(turns) if c)

    def kinetic(self, b: int, vectors: Sequence[Vector]) -> Formula:
        """½ m |Σ v|²."""
        x, y = add(v[0] for v in vectors), add(v[1] for v in vectors)
        return self.m.bodies[b].mass.times(HALF) * (x * x + y * y)

    def cross(self, b: int, i: int, j: int) -> Formula:
        """m v_i · v_j: what ½ m |Σ v|² has of two segments together."""
        (x, y), (other_x, other_y) = self.velocities[b][i], self.velocities[b][j]
        return self.m.bodies[b].mass * (x * other_x + y * other_y)

    def weight(self, b: int) -> Formula:
        """m g."""
        return self.m.bodies[b].mass * (self.space.g if self.m.weight is None else self.m.weight)

    def changed(self, b: int, at: int, made: Made) -> Formula:
        """What T - U gains where segment ``at`` of body b has another velocity, or another height."""
        total, height = NOTHING, made.height
        if made.vector is not None:
            other = [made.vector if k == at else v for k, v in enumerate(self.velocities[b])]
            total = self.kinetic(b, other) - self.kinetic(b, self.velocities[b])
        if height is not None:
            total = total - self.weight(b) * (height - self.heights[b][at])
        return total

    def turned(self, b: int, rate: Formula) -> Formula:
        """What T gains where body b turns at another rate."""
        body = self.m.bodies[b]
        return body.inertia.times(HALF) * (rate * rate - self.rate(body.turns).power(2))

    def carried(self, x: Segment) -> list[tuple[int, int]]:
        """Every body with this segment on its way, and where."""
        return [
            (b, k)
            for b, way in enumerate(self.ways)
            for k, other in enumerate(way)
            if other.direction == x.direction and other.length == x.length
        ]


@dataclass(frozen=True)
class Made:
    """What a mistake makes of a segment; None: nothing. ``rate``: at which its body then turns."""

    vector: Vector | None
    height: Formula | None = None
    rate: Formula | None = None


Change = Callable[[Segment], Made | None]


def angle_name(p: Parts, direction: Direction) -> str:
    """The angle of a direction in the author's coordinates."""
    return sum_of(p.words.coordinates, direction.turns) or "the slide"


def rate_name(p: Parts, turns: Sequence[int]) -> str:
    """The rate Σ turns · ω in the author's letters."""
    return sum_of(p.words.rates, turns)


def sum_of(names: Sequence[str], turns: Sequence[int]) -> str:
    """A sum of names with signs."""
    parts = [("− " if c < 0 else "+ ") + names[k] for k, c in enumerate(turns) if c]
    text = " ".join(parts).removeprefix("+ ")
    return "−" + text[2:] if text.startswith("− ") else text
