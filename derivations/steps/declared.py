"""Mechanisms that a derivation declares: bodies on hinges and slides, with springs, dampers and drives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ..algebra.signs import sign_of
from ..algebra.trig import HALF, NOTHING, Formula, Space, constant
from .conventions import Convention
from .derivation import add
from .mechanism import Body, Direction, Mechanism, Segment

Along = Literal["right", "up", "down", "link"]
QUARTERS = {"down": 0, "right": 1, "up": 2}
Form = dict[int, int]  # a joint's own motion as a sum of coordinates


@dataclass(frozen=True)
class Joined:
    """A body on a joint; body k has coordinate k. ``on``: the body that carries it, or -1 for the support.

    ``slide``: the direction of a slide, None for a hinge. ``length``: from its joint to where it carries others;
    ``at``: where the joint sits on the carrier, from the carrier's joint. ``centre``, ``inertia``: of its mass, the
    inertia about the centre of mass. ``stiffness``, ``rest``, ``damping``, ``friction``, ``drive``: at its joint;
    ``friction`` is dry, a force or torque against the motion.
    """

    name: str
    on: int
    slide: Along | None
    mass: Formula
    length: Formula
    centre: Formula
    inertia: Formula
    at: Formula | None = None
    stiffness: Formula = NOTHING
    rest: Formula = NOTHING
    damping: Formula = NOTHING
    friction: Formula = NOTHING
    drive: Formula = NOTHING
    given: bool = False  # its motion is given; its drive is whatever brings that about

    @property
    def quantities(self) -> tuple[Formula, ...]:
        """All but the drive."""
        own = (self.mass, self.length, self.centre, self.inertia, self.stiffness, self.rest)
        passive = (self.damping, self.friction)
        return (*own, *passive) if self.at is None else (*own, *passive, self.at)


@dataclass(frozen=True)
class Declared:
    """A whole mechanism. ``coordinates``: their names, one a body."""

    space: Space
    bodies: tuple[Joined, ...]
    coordinates: tuple[str, ...]

    def __hash__(self) -> int:
        return id(self)

    def mechanism(self, convention: Convention) -> Mechanism:
        """Built with the angles counted in this way."""
        n, space = self.space.n, self.space
        placed = [self._place(k, convention) for k in range(n)]
        forces = [NOTHING] * n
        elastic = NOTHING
        for k, body in enumerate(self.bodies):
            form = self.own_motion(k, convention)
            rate = add(space.w(i).times(c) for i, c in form.items())
            stretch = add(space.q(i).times(c) for i, c in form.items()) - body.rest
            elastic = elastic + body.stiffness.times(HALF) * stretch * stretch
            for i, c in form.items():
                forces[i] = forces[i] + (body.drive - body.damping * rate - self.dry_friction(k, form)).times(c)
        moved = tuple((k, self.bodies[k].drive) for k in self.given)
        return Mechanism(space, tuple(placed), elastic, tuple(forces), moved=moved)

    def dry_friction(self, k: int, motion: Form) -> Formula:
        """What dry friction takes from the drive of joint k while it moves: its size times the sign of the rate."""
        friction = self.bodies[k].friction
        sign = sign_of(self.space, motion) if friction else NOTHING
        assert sign is not None  # a mechanism with friction has all signs of joints' rates
        return friction * sign

    @property
    def given(self) -> tuple[int, ...]:
        """The coordinates whose motion is given."""
        return tuple(k for k, body in enumerate(self.bodies) if body.given)

    def free_drives(self, rows: Sequence[Formula]) -> tuple[int, ...]:
        """The coordinates that an own force drives which these rows, and the other bodies, never mention.

        Their equations only say what that force is, so that rows without them hold for every motion of theirs.
        """
        found = []
        for k, body in enumerate(self.bodies):
            places = self.space.places(body.drive)
            others = [f for j, x in enumerate(self.bodies) for f in (*x.quantities, *(() if j == k else (x.drive,)))]
            alone = body.drive.is_monomial() and len(places) == 1
            if alone and not any(places & self.space.places(f) for f in (*others, *rows)):
                found.append(k)
        return tuple(found)

    def sentence(self) -> tuple[str, str]:
        """What it is, in English and Japanese."""
        english, japanese = [], []
        for body, coordinate in zip(self.bodies, self.coordinates, strict=True):
            carrier = "the support" if body.on < 0 else self.bodies[body.on].name
            ja = "支点" if body.on < 0 else self.bodies[body.on].name
            way = {"right": "to the right", "up": "upwards", "down": "downwards", "link": f"along {carrier}"}
            moves = f"hinged on {carrier}" if body.slide is None else f"sliding {way[body.slide]} on {carrier}"
            joint = "回転" if body.slide is None else "直動"
            given = ", its motion given" if body.given else ""
            english.append(f"{body.name} {moves} ({coordinate}{given})")
            given = "、運動は与えられる" if body.given else ""
            japanese.append(f"{ja} に{joint}関節で付く {body.name}（{coordinate}{given}）")
        return "; ".join(english), "；".join(japanese)

    def _chain(self, k: int) -> list[int]:
        chain = [k]
        while self.bodies[chain[0]].on >= 0:
            chain.insert(0, self.bodies[chain[0]].on)
        return chain

    def _hinges(self, k: int) -> tuple[int, ...]:
        return tuple(j for j in self._chain(k) if self.bodies[j].slide is None)

    def _direction(self, k: int, convention: Convention) -> Direction:
        """Of a body: of the last hinge on the way to it; straight down where there is none."""
        hinges = self._hinges(k)
        return convention.direction(hinges, self.space.n) if hinges else Direction((0,) * self.space.n)

    def own_motion(self, k: int, convention: Convention) -> Form:
        """How far joint k itself has moved, in the coordinates, and in the sense in which its own one is counted.

        So a drive along an angle, and a rest that is a value of the angle, mean the same whatever the sense is.
        """
        if self.bodies[k].slide is not None or convention.relative:
            return {k: 1}
        before = self._hinges(k)[:-1]
        return {k: 1} | ({before[-1]: -convention.sense(k) * convention.sense(before[-1])} if before else {})

    def _place(self, k: int, convention: Convention) -> Body:
        way: list[Segment] = []
        chain = self._chain(k)
        for j in chain:
            body = self.bodies[j]
            direction = self._direction(j, convention)
            if body.slide is not None:
                way.append(Segment(self.space.q(j), self._slide(j, convention)))
            after = chain[chain.index(j) + 1] if j != k else None
            if after is None:
                way.append(Segment(body.centre, direction))
            else:
                place = self.bodies[after].at
                way.append(Segment(body.length if place is None else place, direction))
        body = self.bodies[k]
        turns = self._direction(k, convention).turns
        mass, inertia = self._of_support(k)
        return Body(mass, inertia, tuple(s for s in way if s.length), turns)

    def _of_support(self, k: int) -> tuple[Formula, Formula]:
        """Mass and inertia; 1 of a support without mass that is moved as it is said to be.

        What moves it takes up what these add, and no other row has them; without them the mass matrix of a point mass
        on a support that moves in two directions is singular.
        """
        body = self.bodies[k]
        moved = all(self.bodies[j].given for j in self._chain(k))
        if not moved or body.mass or body.inertia:
            return body.mass, body.inertia
        return constant(1), constant(1)

    def _slide(self, k: int, convention: Convention) -> Direction:
        body = self.bodies[k]
        if body.slide == "link":
            return self._direction(k, convention)
        assert body.slide is not None
        return Direction((0,) * self.space.n, QUARTERS[body.slide])


def pivot_to_centre(inertia: Formula, mass: Formula, centre: Formula) -> Formula:
    """The moment of inertia about the centre of mass, from that about the joint (Steiner)."""
    return inertia - mass * centre * centre
