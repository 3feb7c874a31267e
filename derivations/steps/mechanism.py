"""The equations of motion of any planar open mechanism, exactly, from the positions of its bodies.

A body's centre of mass is reached along segments, each of a length and in a direction; both may depend on coordinates:
a hinge turns what follows it, a slide is a segment as long as its coordinate. Kinetic and potential energy are sums
over the bodies, Lagrange's equations are those of their difference. Nothing else is put in.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

from ..algebra.equivalence import System
from ..algebra.fingerprint import point_of
from ..algebra.trig import COS, HALF, NOTHING, SIN, Formula, Space
from .derivation import add, lagrange_rows

Origin = Literal["down", "right", "up", "left"]
QUARTERS: dict[Origin, int] = {"down": 0, "right": 1, "up": 2, "left": 3}


@dataclass(frozen=True)
class Direction:
    """The angle Σ turns[k]·q_k + quarters·π/2 from the downward vertical, counter-clockwise."""

    turns: tuple[int, ...]
    quarters: int = 0

    def wave(self, space: Space, phase: int, by: int) -> Formula:
        """cos or sin of the angle, and of ``by`` quarter turns more."""
        sign = 1
        for _ in range((self.quarters + by) % 4):
            phase, sign = (SIN, -sign) if phase == COS else (COS, sign)
        f = space.wave({k: 2 * c for k, c in enumerate(self.turns) if c}, phase)
        return f if sign > 0 else -f

    def vector(self, space: Space, length: Formula) -> tuple[Formula, Formula]:
        """(length sin, -length cos): x to the right, y upwards."""
        return length * self.wave(space, SIN, 0), -(length * self.wave(space, COS, 0))


@dataclass(frozen=True)
class Segment:
    """A piece of the way to a centre of mass."""

    length: Formula
    direction: Direction


@dataclass(frozen=True)
class Body:
    """A body: mass, moment of inertia about its centre of mass, the way to that centre, and how it turns."""

    mass: Formula
    inertia: Formula
    way: tuple[Segment, ...]
    turns: tuple[int, ...]


@dataclass(frozen=True)
class Mechanism:
    """Bodies; ``elastic``: potential energy of springs; ``forces``: what stands on the right of Lagrange's equations.

    ``support``: the acceleration, to the right and upwards, of the support; the coordinates are relative to it.
    """

    space: Space
    bodies: tuple[Body, ...]
    elastic: Formula = NOTHING
    forces: tuple[Formula, ...] = ()
    weight: Formula | None = None  # g where it is None
    values: dict[int, Formula] = field(default_factory=dict, compare=False)  # symbols that stand for formulas
    moved: tuple[tuple[int, Formula], ...] = ()  # coordinates whose motion is given, and what stands for its force
    # What this one is with_values of: set there, and no argument, so that replace() does not keep it.
    without_values: Mechanism | None = field(default=None, init=False, compare=False, repr=False)

    @cached_property
    def positions(self) -> tuple[tuple[Formula, Formula], ...]:
        """Of each body's centre of mass: to the right and upwards of the support."""
        vectors = [[s.direction.vector(self.space, s.length) for s in body.way] for body in self.bodies]
        return tuple((self.valued(add(x for x, _ in way)), self.valued(add(y for _, y in way))) for way in vectors)

    @cached_property
    def rotation(self) -> Formula:
        """Σ ½ I ω²."""
        return self.valued(add(self._kinetic(body)[1] for body in self.bodies))

    def mass(self, b: int) -> Formula:
        """The mass of a body."""
        return self.valued(self.bodies[b].mass)

    @property
    def gravity(self) -> Formula:
        """g, or what stands for it."""
        return self.valued(self.space.g if self.weight is None else self.weight)

    @cached_property
    def springs(self) -> Formula:
        """What springs store."""
        return self.valued(self.elastic)

    @cached_property
    def driven(self) -> tuple[Formula, ...]:
        """The generalised force of each coordinate."""
        return tuple(self.valued(f) for f in self.forces) or (NOTHING,) * self.space.n

    @cached_property
    def kinetic(self) -> Formula:
        """T = Σ ½ m v² + ½ I ω²."""
        return self.valued(add(part for body in self.bodies for part in self._kinetic(body)))

    @cached_property
    def potential(self) -> Formula:
        """U = Σ m g y, and what springs store."""
        g = self.space.g if self.weight is None else self.weight
        heights = (add(s.direction.vector(self.space, s.length)[1] for s in body.way) for body in self.bodies)
        total = add(body.mass * g * y for body, y in zip(self.bodies, heights, strict=True))
        return self.valued(total + self.elastic)

    @cached_property
    def lagrangian(self) -> Formula:
        """T - U."""
        return self.kinetic - self.potential

    @cached_property
    def rows(self) -> tuple[Formula, ...]:
        """d/dt ∂L/∂q̇_i - ∂L/∂q_i - Q_i for each coordinate, each to be zero."""
        return tuple(row - force for row, force in zip(self.free_rows, self.driven, strict=True))

    @cached_property
    def free_rows(self) -> tuple[Formula, ...]:
        """The same without forces: Lagrange's equations of T - U alone."""
        plain = self.without_values
        if plain is not None and self.values_are_constant:
            # A constant may be put in before or after the derivatives; the rows without values serve many.
            return tuple(self.valued(row) for row in plain.free_rows)
        return tuple(lagrange_rows(self.space, self.lagrangian))

    @cached_property
    def parameters(self) -> frozenset[int]:
        """The places of the parameters that occur in the rows."""
        found = set().union(*(self.space.places(row) for row in self.rows))
        return frozenset(place for place in found if place >= 2 * self.space.n)

    @cached_property
    def system(self) -> System:
        """The rows, and their values at the point where systems of this space are compared.

        Where a motion is given, its acceleration is any function, here a symbol: the row would only say what brings it
        about, and with more such motions than the masses can have, these rows would determine nothing.
        """
        rows = list(self.rows)
        for k, symbol in self.moved:
            rows[k] = self.space.a(k) - symbol
        return System(self.space, rows, point_of(self.space))

    def with_values(self, values: dict[int, Formula]) -> Mechanism:
        """The same mechanism where the symbols at these places have these values."""
        if not values:
            return self
        valued = replace(self, values={**self.values, **values})
        object.__setattr__(valued, "without_values", self.without_values or self)
        return valued

    @cached_property
    def values_are_constant(self) -> bool:
        """Whether no value moves: none has an angle, a coordinate or a rate in it."""
        s = self.space
        moving = {*range(2 * s.n), *(range(4 * s.n + 2, 5 * s.n + 2) if s.extra else ())}
        return not any(
            moving & {place, *s.places(f)} or any(h or phase for _, h, phase in f.terms)
            for place, f in self.values.items()
        )

    def valued(self, f: Formula) -> Formula:
        """With the values of those symbols that have some."""
        return self.space.replace(f, self.values) if self.values else f

    def _kinetic(self, body: Body) -> tuple[Formula, Formula]:
        s = self.space
        vectors = [segment.direction.vector(s, segment.length) for segment in body.way]
        vx, vy = (s.by_time(add(vector[axis] for vector in vectors)) for axis in (0, 1))
        omega = add(s.w(k).times(c) for k, c in enumerate(body.turns) if c)
        half = body.mass.times(HALF)
        return half * (vx * vx + vy * vy), body.inertia.times(HALF) * omega * omega
