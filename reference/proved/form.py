"""A planar mechanism's numbers as balls, in the form in which the series need them.

Links count from the support outwards. A coordinate is a link's absolute angle [rad] or, where the link slides, its
displacement [m] along a direction that stays as it is: everything before a slide slides too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...models.errors import InvalidInput
from ...models.mechanism import Hinge, Mechanism
from ...models.systems import RodChain, System
from ...models.tree import SUPPORT, PlanarTree

Pair = tuple[float, float]


@dataclass(frozen=True)
class Carriage:
    """What a link slides along: a unit vector (along gravity, across it), exact."""

    along: float
    across: float


@dataclass(frozen=True)
class Planar:
    """A mechanism as exact numbers: what the series are of.

    ``mechanism``: its links and hinges (friction is refused, limits are not reached); ``slides``: for each link None,
    or the direction that it slides in. ``rods``: the chain whose masses ρ l and inertias ρ l³/12 are not rounded.
    """

    mechanism: Mechanism
    slides: tuple[Carriage | None, ...]
    rods: RodChain | None = None

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return self.mechanism.n


def planar(system: System | PlanarTree | Mechanism | Planar) -> Planar:
    """The mechanism of a document's system or of a planar tree.

    Raises InvalidInput where a hinge rubs (friction jumps with the sign of the rate: there is no Taylor series), or
    where links without mass could move at no cost.
    """
    if isinstance(system, Planar):
        return system
    if isinstance(system, Mechanism):
        mechanism, rods = system, None
    else:
        tree = system if isinstance(system, PlanarTree) else system.tree()
        hinges = tuple(Hinge(name=name) for name in tree.names("hinge"))
        mechanism = Mechanism(tree.links, hinges, (tree.gravity, 0.0), tree.names("link"))
        rods = system if isinstance(system, RodChain) else None
    for hinge, name in zip(mechanism.hinges, mechanism.link_names, strict=True):
        if hinge.friction:
            raise InvalidInput(
                f"{name}: friction {hinge.friction:g} N m jumps with the sign of the rate, and such a motion has no "
                "Taylor series: set it to 0, or use damping"
            )
    return Planar(mechanism, (None,) * mechanism.n, rods)


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

    mechanism = p.mechanism
    links, hinges, parents = mechanism.links, mechanism.hinges, mechanism.parents
    mass = [arb(link.mass) for link in links]
    inertia = [arb(link.inertia) for link in links]
    if p.rods is not None:
        mass = [arb(p.rods.density) * l for l in p.rods.lengths]
        inertia = [m * arb(l) * l / 12 for m, l in zip(mass, p.rods.lengths, strict=True)]
    slides = p.slides
    return Form(
        n=p.n,
        parents=parents,
        turning_parent=tuple(SUPPORT if q == SUPPORT or slides[q] else q for q in parents),
        gravity=(arb(mechanism.gravity[0]), arb(mechanism.gravity[1])),
        mass=mass,
        inertia=inertia,
        com=[_pair(link.com) for link in links],
        hinge=[_pair(link.hinge) for link in links],
        slide=[None if s is None else (arb(s.along), arb(s.across)) for s in slides],
        armature=[arb(hinge.armature) if hinge.armature else None for hinge in hinges],
        damping=[arb(hinge.damping) for hinge in hinges],
        stiffness=[arb(hinge.stiffness) for hinge in hinges],
        preload=[arb(hinge.stiffness) * hinge.rest for hinge in hinges],
        own=tuple(i for i, hinge in enumerate(hinges) if hinge.damping or hinge.stiffness),
    )


def _pair(point: Pair) -> tuple[Any, Any]:
    from flint import arb

    return arb(point[0]), arb(point[1]) if point[1] else None
