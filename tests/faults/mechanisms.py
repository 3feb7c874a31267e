"""Random mechanisms, and the changes that plant a fault in one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from furiko.models import Link, PlanarTree
from furiko.models.mechanism import Hinge, Mechanism
from furiko.models.tree import SUPPORT

GRAVITY = 9.81


@dataclass(frozen=True)
class Shape:
    """A tree as engines' adapters want their system."""

    given: PlanarTree
    kind: str = "planar-tree"

    @property
    def n(self):
        return self.given.n

    @property
    def gravity(self):
        return self.given.gravity

    @property
    def masses(self):
        return tuple(link.mass for link in self.given.links)

    @property
    def lengths(self):
        return tuple(link.length for link in self.given.links)

    def tree(self):
        return self.given


def random_tree(rng, n=None, kind=None, straight=None, bobs=None):
    """A chain, a star or any tree; centres and hinges on the links' axes or off them; some links point masses."""
    n = int(rng.integers(1, 11)) if n is None else n
    kind = rng.choice(["chain", "star", "tree"]) if kind is None else kind
    straight = rng.random() < 0.5 if straight is None else straight
    bobs = rng.random() < 0.25 if bobs is None else bobs

    def off():
        return 0.0 if straight else float(rng.uniform(-0.3, 0.3))

    links = []
    for i in range(n):
        parent = SUPPORT if i == 0 else {"chain": i - 1, "star": 0, "tree": int(rng.integers(-1, i))}[kind]
        length = float(rng.uniform(0.4, 1.3))
        mass = float(rng.uniform(0.3, 3.0))
        hinge = (0.0, 0.0) if i == 0 else (links[parent].length if parent >= 0 else 0.0, off())
        com = (length if bobs else float(rng.uniform(0.3, 0.7)) * length, off())
        inertia = 0.0 if bobs else mass * length**2 * float(rng.uniform(0.05, 0.12))
        links.append(Link(parent, hinge, length, com, mass, inertia))
    return PlanarTree(tuple(links), GRAVITY if rng.random() < 0.5 else float(rng.uniform(1, 20)))


def free(tree):
    """The tree as a mechanism on ideal hinges."""
    n = tree.n
    hinges = tuple(Hinge(name=f"hinge{i + 1:02}") for i in range(n))
    names = tuple(f"link{i + 1:02}" for i in range(n))
    return Mechanism(tree.links, hinges, (tree.gravity, 0.0), names, (0.0, 0.0, -tree.gravity))


def with_hinge(mechanism, i, **changes):
    hinges = list(mechanism.hinges)
    hinges[i] = replace(hinges[i], **changes)
    return replace(mechanism, hinges=tuple(hinges))


def with_link(mechanism, i, **changes):
    links = list(mechanism.links)
    links[i] = replace(links[i], **changes)
    return replace(mechanism, links=tuple(links))


def off(rng, least=0.02, most=0.5):
    """A factor near one and not one, or further off."""
    return float(1 + rng.choice([-1, 1]) * rng.uniform(least, most))


def fused(mechanism, k):
    """Leaf k fixed to the link that carries it."""
    lost = mechanism.links[k]
    p = lost.parent
    links = list(mechanism.links)
    if p >= 0:
        carrier = links[p]
        at = (lost.hinge[0] + lost.com[0], lost.hinge[1] + lost.com[1])
        links[p] = add_point(carrier, lost.mass, at)
        links[p] = replace(links[p], inertia=links[p].inertia + lost.inertia)
    kept = [i for i in range(mechanism.n) if i != k]
    place = {old: new for new, old in enumerate(kept)} | {SUPPORT: SUPPORT}
    return replace(
        mechanism,
        links=tuple(replace(links[i], parent=place[links[i].parent]) for i in kept),
        hinges=tuple(mechanism.hinges[i] for i in kept),
        link_names=tuple(mechanism.link_names[i] for i in kept),
    )


def mass_moved(mechanism, rng):
    """Some mass of a link that carries others, at their hinge, given to the one that hangs there: the same motion."""
    carried = [c for c, link in enumerate(mechanism.links) if link.parent >= 0]
    if not carried:
        return mechanism
    c = int(rng.choice(carried))
    p = mechanism.links[c].parent
    child, parent = mechanism.links[c], mechanism.links[p]
    moved = 0.1 * min(child.mass, parent.mass) * float(rng.uniform(-1, 1))
    more = add_point(child, moved, (0.0, 0.0))
    less = add_point(parent, -moved, child.hinge)
    if min(more.inertia, less.inertia) <= 0:
        return mechanism
    return with_link(with_link(mechanism, c, **changed(more)), p, **changed(less))


def add_point(link, mass, at):
    total = link.mass + mass
    com = tuple((link.mass * a + mass * b) / total for a, b in zip(link.com, at, strict=True))
    inertia = link.inertia + link.mass * math.dist(link.com, com) ** 2 + mass * math.dist(at, com) ** 2
    return replace(link, mass=total, com=com, inertia=inertia)


def changed(link):
    return {"mass": link.mass, "com": link.com, "inertia": link.inertia}
