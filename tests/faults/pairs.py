"""Two faults in one engine: numbers of its mechanism, terms of its code, conventions, buffers.

A fault of each kind is drawn by itself; a pair has two different causes, at most one of them a convention or a buffer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from furiko.engines import load_engine
from furiko.models import PlanarTree

from .code import IN_CODE, TermByTerm, unchanged
from .engines import InOtherConvention, WrappedEngine, sums
from .mechanisms import Shape, free, off, random_tree, with_hinge, with_link

REAL = ("mujoco", "pinocchio-aba", "exudyn-tree")


def heavier(rng, m):
    i = int(rng.integers(m.n))
    return with_link(m, i, mass=m.links[i].mass * off(rng))


def other_inertia(rng, m):
    i = int(rng.integers(m.n))
    return with_link(m, i, inertia=m.links[i].inertia * off(rng))


def other_gravity(rng, m):
    return replace(m, gravity=(m.gravity[0] * off(rng), 0.0))


def longer(rng, m):
    i = max(link.parent for link in m.links)
    factor = off(rng)
    for c in range(m.n):
        if m.links[c].parent == i:
            m = with_link(m, c, hinge=tuple(factor * x for x in m.links[c].hinge))
    return m


def displaced(rng, m):
    i = int(rng.integers(m.n))
    a, b = m.links[i].com
    return with_link(m, i, com=(a + 0.1, b + float(rng.uniform(0.05, 0.2))))


def denser(rng, m):
    factor = off(rng)
    for i in range(m.n):
        m = with_link(m, i, mass=m.links[i].mass * factor, inertia=m.links[i].inertia * factor)
    return m


def damped(rng, m):
    return with_hinge(m, int(rng.integers(m.n)), damping=float(10 ** rng.uniform(-3, 0)))


def with_rotor(rng, m):
    return with_hinge(m, int(rng.integers(1, m.n)), armature=float(10 ** rng.uniform(-3, -1)))


IN_MECHANISM = {
    "mass": heavier,
    "inertia": other_inertia,
    "gravity": other_gravity,
    "length": longer,
    "com-displaced": displaced,
    "density": denser,
    "damping": damped,
    "armature": with_rotor,
}


def relative_angles(rng, engine, tree):
    return InOtherConvention(engine, sums(tree))


def upside_down(rng, engine, tree):
    return InOtherConvention(engine, np.eye(tree.n), offset=math.pi)


def in_degrees(rng, engine, tree):
    return InOtherConvention(engine, 180 / math.pi * np.eye(tree.n))


def swapped_joints(rng, engine, tree):
    way = np.arange(tree.n)
    a, b = rng.choice(tree.n, 2, replace=False)
    way[a], way[b] = b, a
    s = sums(tree)
    return InOtherConvention(engine, s @ np.eye(tree.n)[way] @ np.linalg.inv(s))


class Late(WrappedEngine):
    """Its buffer is read before it is renewed."""

    def accelerations(self, theta, omega):
        return np.roll(super().accelerations(theta, omega), 1, axis=0)


def late_buffer(rng, engine, tree):
    return Late(engine, False)


IN_CONVENTION = {
    "angle-convention": relative_angles,
    "angle-convention ": upside_down,
    "degree-vs-radian": in_degrees,
    "joint-order": swapped_joints,
    "stale-derived-state": late_buffer,
}
KINDS = {"mechanism": IN_MECHANISM, "code": IN_CODE, "convention": IN_CONVENTION}
ALL_VELOCITY_TERMS = {"velocity-terms-sign", "velocity-terms-forgotten"}  # of terms that are missing, no sign is wrong
ONLY_TERM_BY_TERM = {"damping", "armature"}  # real engines are built from trees, whose hinges are ideal


@dataclass(frozen=True)
class Planted:
    """An engine, the mechanism expected, and the causes that are in it."""

    engine: object
    wanted: object
    causes: tuple[str, ...]


def drawn(rng, how_many):
    """An engine with so many faults (0, 1 or 2)."""
    tree = random_tree(rng, n=int(rng.integers(2, 6)), bobs=False)
    while max(tree.parents) < 0:  # pendulums side by side have no relative angle
        tree = random_tree(rng, n=tree.n, bobs=False)
    wanted = free(tree)
    kinds = []
    for _ in range(how_many):
        left = [kind for kind in KINDS if kind != "convention" or "convention" not in kinds]
        kinds.append(str(rng.choice(left)))
    names: list[str] = []
    for kind in kinds:
        left = [name for name in KINDS[kind] if name not in names and not {name, *names} >= ALL_VELOCITY_TERMS]
        names.append(str(rng.choice(left)))
    mechanism, code = wanted, []
    for kind, name in zip(kinds, names, strict=True):
        if kind == "mechanism":
            mechanism = IN_MECHANISM[name](rng, mechanism)
        elif kind == "code":
            code.append((name in ALL_VELOCITY_TERMS, IN_CODE[name](rng, mechanism)))
    # All terms of a kind last: a sine in place of a cosine is that of the right velocity terms, not of missing ones.
    changes = [change for _, change in sorted(code, key=lambda found: found[0])]
    engine = _engine(rng, mechanism, changes, ONLY_TERM_BY_TERM & set(names))
    for kind, name in zip(kinds, names, strict=True):
        if kind == "convention":
            engine = IN_CONVENTION[name](rng, engine, tree)
    return Planted(engine, wanted, tuple(name.strip() for name in names))


def _engine(rng, mechanism, changes, hinged):
    if changes or hinged or rng.random() < 0.3:

        def change(*terms):
            for one in changes:
                terms = one(*terms)
            return terms

        return Silent(TermByTerm(mechanism, change if changes else unchanged))
    tree = PlanarTree(mechanism.links, mechanism.gravity[0])
    return WrappedEngine(load_engine(str(rng.choice(REAL)), Shape(tree)), shows=bool(rng.random() < 0.5))


class Silent(WrappedEngine):
    """An engine that is no adapter of furiko's."""

    def __init__(self, engine):
        self._engine, self.shows = engine, False
