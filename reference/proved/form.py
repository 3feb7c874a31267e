"""A planar mechanism's numbers as balls, in the form in which the series need them.

Links count from the support outwards. A coordinate is a link's absolute angle [rad] or, where the link slides, its
displacement [m] along a direction that stays as it is: everything before a slide slides too.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...models.errors import InvalidInput
from ...models.mechanism import Hinge, Mechanism
from ...models.systems import RodChain, System
from ...models.tree import SUPPORT, Link, PlanarTree

Number = float | Fraction  # exact: a double is the binary fraction that it is
Pair = tuple[Number, Number]


@dataclass(frozen=True)
class PlanarLink:
    """A link and the joint that moves it, in exact numbers.

    ``parent``, ``hinge``, ``com``, ``mass``, ``inertia``: as :class:`~furiko.models.tree.Link` has them; ``armature``,
    ``damping``, ``stiffness``, ``rest``: as :class:`~furiko.models.mechanism.Hinge` has them, of a slide in kg, N s/m,
    N/m and m. ``slide``: None, or what it slides along, (along, across), of any length but zero; all links before it
    slide too.
    """

    parent: int
    hinge: Pair
    com: Pair
    mass: Number
    inertia: Number
    armature: Number = 0.0
    damping: Number = 0.0
    stiffness: Number = 0.0
    rest: Number = 0.0
    slide: Pair | None = None


@dataclass(frozen=True)
class JointCoordinate:
    """A joint's own coordinate: ``sense`` (1, -1) times (the link's coordinate less its parent's angle), + ``zero``."""

    sense: int = 1
    zero: float = 0.0


@dataclass(frozen=True)
class Planar:
    """A mechanism as exact numbers: what the series are of.

    ``gravity``: (along, across) [m/s²]. ``rods``: the chain whose masses ρ l and inertias ρ l³/12 are not rounded.
    ``joints``: how the coordinates of states are read, one a link; empty where they are the links' own.
    """

    links: tuple[PlanarLink, ...]
    gravity: Pair
    rods: RodChain | None = None
    joints: tuple[JointCoordinate, ...] = ()

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return len(self.links)

    @cached_property
    def turning_parents(self) -> tuple[int, ...]:
        """For each link the parent whose angle its joint's is counted from; SUPPORT where that does not turn."""
        fixed = [SUPPORT if link.parent == SUPPORT else self.links[link.parent].slide for link in self.links]
        return tuple(link.parent if slide is None else SUPPORT for link, slide in zip(self.links, fixed, strict=True))


def planar(system: System | PlanarTree | Mechanism) -> Planar:
    """The mechanism of a document's system or of a planar tree.

    Raises InvalidInput where a hinge rubs: friction jumps with the sign of the rate, and there is no Taylor series.
    """
    if isinstance(system, Mechanism):
        links = zip(system.links, system.hinges, system.link_names, strict=True)
        return Planar(tuple(_link(*one) for one in links), system.gravity)
    tree = system if isinstance(system, PlanarTree) else system.tree()
    rods = system if isinstance(system, RodChain) else None
    return Planar(tuple(_link(link, Hinge(), "") for link in tree.links), (tree.gravity, 0.0), rods)


def _link(link: Link, hinge: Hinge, name: str) -> PlanarLink:
    refuse_friction(name, hinge.friction, "N m")
    return PlanarLink(
        parent=link.parent,
        hinge=link.hinge,
        com=link.com,
        mass=link.mass,
        inertia=link.inertia,
        armature=hinge.armature,
        damping=hinge.damping,
        stiffness=hinge.stiffness,
        rest=hinge.rest,
    )


def refuse_friction(name: str, friction: float, unit: str) -> None:
    """Raise InvalidInput where a joint rubs."""
    if friction:
        raise InvalidInput(
            f"{name}: friction {friction:g} {unit} jumps with the sign of the rate, and such a motion has no "
            "Taylor series: set it to 0, or use damping"
        )


@dataclass(frozen=True)
class Form:
    """The numbers of a :class:`Planar` in balls of the precision that was set; a list has one entry a link.

    ``com``, ``hinge``: (along, across) [m], the second None where it is zero; ``slide``: the direction or None;
    ``armature``: None where it is zero. ``own``: numbers of the links whose joints have dampers or springs.
    """

    n: int
    parents: tuple[int, ...]
    turning_parent: tuple[int, ...]  # the parent whose angle a joint's is counted from, or SUPPORT
    gravity: tuple[Any, Any]
    mass: list[Any]
    inertia: list[Any]
    com: list[tuple[Any, Any]]
    hinge: list[tuple[Any, Any]]
    slide: list[tuple[Any, Any] | None]
    armature: list[Any]
    damping: list[Any]
    stiffness: list[Any]
    preload: list[Any]
    own: tuple[int, ...]


def form_of(p: Planar) -> Form:
    """The numbers at the precision of ``flint.ctx``."""
    from flint import arb

    links = p.links
    mass = [_ball(link.mass) for link in links]
    inertia = [_ball(link.inertia) for link in links]
    if p.rods is not None:
        mass = [arb(p.rods.density) * l for l in p.rods.lengths]
        inertia = [m * arb(l) * l / 12 for m, l in zip(mass, p.rods.lengths, strict=True)]
    return Form(
        n=p.n,
        parents=tuple(link.parent for link in links),
        turning_parent=p.turning_parents,
        gravity=(_ball(p.gravity[0]), _ball(p.gravity[1])),
        mass=mass,
        inertia=inertia,
        com=[_pair(link.com) for link in links],
        hinge=[_pair(link.hinge) for link in links],
        slide=[None if link.slide is None else _direction(link.slide) for link in links],
        armature=[_ball(link.armature) if link.armature else None for link in links],
        damping=[_ball(link.damping) for link in links],
        stiffness=[_ball(link.stiffness) for link in links],
        preload=[_ball(link.stiffness) * _ball(link.rest) for link in links],
        own=tuple(i for i, link in enumerate(links) if link.damping or link.stiffness),
    )


def _ball(number: Number) -> Any:
    from flint import arb, fmpq

    return arb(fmpq(number.numerator, number.denominator)) if isinstance(number, Fraction) else arb(number)


def _pair(point: Pair) -> tuple[Any, Any]:
    return _ball(point[0]), _ball(point[1]) if point[1] else None


def _direction(way: Pair) -> tuple[Any, Any]:
    """The unit vector along ``way``; exact where that is along an axis."""
    along, across = _ball(way[0]), _ball(way[1])
    length = (along * along + across * across).sqrt()
    return along / length, across / length
