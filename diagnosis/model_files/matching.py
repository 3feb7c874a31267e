"""The links of a file assigned to those of a mechanism, and their frames turned alike: one mechanism, other frames.

A file may turn a link's frame, write links in another order, look at them from behind, or shift mass from a link to its
parent at their hinge, without changing the motion. Only what is left after that is a difference.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...models.errors import library
from ...models.mechanism import Mechanism
from ...models.tree import SUPPORT, Link
from ..measurement import Array

MOST_CHILDREN_PERMUTED = 6  # of one link: up to here all their orders are tried


def rearranged(found: Mechanism, order: Sequence[int], turns: Sequence[float]) -> Mechanism:
    """Links in the order given (new → old), each new link's frame, its zero angle, turned by ``turns`` [rad]."""
    place = {old: new for new, old in enumerate(order)} | {SUPPORT: SUPPORT}
    links, hinges = [], []
    for new, old in enumerate(order):
        link, hinge = found.links[old], found.hinges[old]
        parent = place[link.parent]
        base = turns[parent] if parent != SUPPORT else 0.0
        links.append(replace(link, parent=parent, hinge=_turn(link.hinge, -base), com=_turn(link.com, -turns[new])))
        shift = turns[new] - base
        stops = None if hinge.limits is None else (hinge.limits[0] - shift, hinge.limits[1] - shift)
        hinges.append(replace(hinge, rest=hinge.rest - shift if hinge.stiffness else 0.0, limits=stops))
    return replace(
        found,
        links=tuple(links),
        hinges=tuple(hinges),
        link_names=tuple(found.link_names[old] for old in order),
    )


def mirrored(found: Mechanism) -> Mechanism:
    """The same mechanism seen from behind: all angles change sign."""
    links = tuple(replace(k, hinge=(k.hinge[0], -k.hinge[1]), com=(k.com[0], -k.com[1])) for k in found.links)
    hinges = tuple(
        replace(h, rest=-h.rest, sense=-h.sense, limits=None if h.limits is None else (-h.limits[1], -h.limits[0]))
        for h in found.hinges
    )
    gravity = (found.gravity[0], -found.gravity[1])
    return replace(found, links=links, hinges=hinges, gravity=gravity, across=tuple(-x for x in found.across))


def _turn(p: tuple[float, float], angle: float) -> tuple[float, float]:
    if angle == 0:
        return p
    c, s = _cos_sin(angle)
    return p[0] * c - p[1] * s, p[0] * s + p[1] * c


def _cos_sin(angle: float) -> tuple[float, float]:
    """Exact at the quarter turns, where files are."""
    quarters = angle / (math.pi / 2)
    if abs(quarters - round(quarters)) < 1e-15 * max(1, abs(quarters)):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(angle), math.sin(angle)


@dataclass(frozen=True)
class BaseParameters:
    """Base parameters: exactly what the motion depends on, for each link.

    ``inertia`` [kg m²] about its hinge, with the mass of its whole subtree at the children's hinges; ``moment`` [kg m],
    its first moment; ``coupling`` [kg m²] to each ancestor; ``weight`` [N m]: complex numbers whose argument depends on
    the links' frames.
    """

    inertia: Array
    moment: Array  # complex, (n,)
    coupling: Array  # complex, (n, n): [i, j], j in the subtree of i
    weight: Array  # complex, (n,)


def base_parameters(m: Mechanism) -> BaseParameters:
    """M_jj = inertia_j; M_ij = Re(coupling_ij e^{i(θ_j − θ_i)}); gravity's row j has weight_j."""
    n = m.n
    mass = np.array([k.mass for k in m.links])
    hinge = np.array([complex(*k.hinge) for k in m.links])
    com = np.array([complex(*k.com) for k in m.links])
    inertia = np.array([k.inertia for k in m.links]) + mass * np.abs(com) ** 2
    moment = mass * com
    total = mass.copy()
    for j in range(n - 1, -1, -1):
        parent = m.links[j].parent
        if parent != SUPPORT:
            total[parent] += total[j]
            moment[parent] += total[j] * hinge[j]
            inertia[parent] += total[j] * abs(hinge[j]) ** 2
    coupling = np.zeros((n, n), dtype=complex)
    for j in range(n):
        child, i = j, m.links[j].parent
        while i != SUPPORT:
            coupling[i, j] = np.conj(hinge[child]) * moment[j]
            child, i = i, m.links[i].parent
    weight = np.conj(complex(*m.gravity)) * moment
    return BaseParameters(inertia, moment, coupling, weight)


def natural_turns(found: Mechanism, expected: Mechanism) -> Iterator[list[float]]:
    """Angles [rad] by which to turn each link's frame so that it lies as the expected one does, likelier ones first.

    Not at all; by its children's hinges, or its centre of mass where it has no children; by its first moment; by its
    centre of mass.
    """
    n = found.n
    yield [0.0] * n
    got, wanted = base_parameters(found), base_parameters(expected)
    by_hinge, by_moment, by_com = [], [], []
    for i in range(n):
        carried = [c for c in range(n) if expected.links[c].parent == i]
        hinges = sum(complex(*expected.links[c].hinge).conjugate() * complex(*found.links[c].hinge) for c in carried)
        com = complex(*expected.links[i].com).conjugate() * complex(*found.links[i].com)
        moment = complex(np.conj(wanted.moment[i]) * got.moment[i])
        by_hinge.append(_argument(hinges or com or moment))
        by_com.append(_argument(com or hinges or moment))
        by_moment.append(_argument(moment or com or hinges))
    yield by_hinge
    yield by_moment
    yield by_com


def _argument(z: complex) -> float:
    if z == 0:
        return 0.0
    angle = math.atan2(z.imag, z.real)
    for quarter in (0.0, math.pi / 2, -math.pi / 2, math.pi):
        if abs(angle - quarter) < 1e-12:
            return quarter
    return math.pi if abs(angle + math.pi) < 1e-12 else angle


def same_motion(found: Mechanism, expected: Mechanism, tolerance: float = 1e-12) -> bool:
    """Whether both have the same motion on ideal hinges, for some zero angle of each link.

    ``tolerance``: relative. In the base parameters a link's frame shows only as an argument of complex numbers, which
    one of them gives for each link.
    """
    a, b = base_parameters(found), base_parameters(expected)
    turn = _frames_turned(a, b, expected.parents, has_gravity=any(expected.gravity) or any(found.gravity))
    scale = max(float(np.max(np.abs(b.inertia))), 1e-300)
    # Each link has its own tolerance: a light link on a heavy one is compared with its own inertia.
    own = np.maximum(np.abs(b.inertia), 1e-12 * scale)
    if (np.abs(a.inertia - b.inertia) > tolerance * own).any():
        return False
    aligned = a.coupling * turn[:, None] / turn[None, :]
    sizes = np.sqrt(np.outer(own, own))
    if (np.abs(aligned - b.coupling) > tolerance * sizes).any():
        return False
    g = abs(complex(*expected.gravity)) or abs(complex(*found.gravity)) or 1.0
    total = sum(link.mass for link in expected.links)
    sizes_of_weight = np.maximum(np.abs(b.weight), g * np.sqrt(own * total))
    return bool((np.abs(a.weight / turn - b.weight) <= tolerance * sizes_of_weight).all())


def _frames_turned(a: BaseParameters, b: BaseParameters, parents: Sequence[int], has_gravity: bool) -> Array:
    """e^{iψ} for each link, ψ the angle by which its frame is turned: from its weight, or without gravity from its
    coupling to its parent (the zero angle of a link on the world is then arbitrary)."""
    turn = np.ones(len(parents), dtype=complex)
    for j, parent in enumerate(parents):
        if has_gravity:
            seen = a.moment[j] * np.conj(b.moment[j])
        elif parent != SUPPORT:
            seen = a.coupling[parent, j] * turn[parent] * np.conj(b.coupling[parent, j])
        else:
            continue
        if abs(seen) > 0:
            turn[j] = seen / abs(seen)
    return turn


def orders(found: Mechanism, expected: Mechanism) -> Iterator[list[int]]:
    """Orders in which ``found``'s links are ``expected``'s, the likeliest first; none if the trees differ."""
    if found.n != expected.n:
        return
    yielded = []
    if found.parents == expected.parents:
        yielded.append(list(range(found.n)))
        yield yielded[0]
    best = _match(found, SUPPORT, expected, SUPPORT)
    if best is None:
        return
    _, pairs = best
    order = [pairs[i] for i in range(expected.n)]
    if order not in yielded:
        yield order


def _match(found: Mechanism, a: int, expected: Mechanism, b: int) -> tuple[float, dict[int, int]] | None:
    """Least difference between the subtrees of link a and of link b, and the assignment: expected → found."""
    memo: dict[tuple[int, int], tuple[float, dict[int, int]] | None] = {}
    ours = {i: [c for c in range(found.n) if found.links[c].parent == i] for i in range(-1, found.n)}
    theirs = {i: [c for c in range(expected.n) if expected.links[c].parent == i] for i in range(-1, expected.n)}

    def match(i: int, j: int) -> tuple[float, dict[int, int]] | None:
        if (i, j) not in memo:
            memo[i, j] = best(i, j)
        return memo[i, j]

    def best(i: int, j: int) -> tuple[float, dict[int, int]] | None:
        mine, wanted = ours[i], theirs[j]
        if len(mine) != len(wanted):
            return None
        own = 0.0 if i == SUPPORT else difference_of_links(found, i, expected, j)
        if not mine:
            return own, {} if i == SUPPORT else {j: i}
        costs = {(x, y): match(x, y) for x in mine for y in wanted}
        chosen: tuple[float, tuple[int, ...]] | None = None
        for way in _assignments(mine, wanted, costs):
            parts = [costs[x, y] for x, y in zip(way, wanted, strict=True)]
            if all(part is not None for part in parts):
                total = sum(part[0] for part in parts if part is not None)
                if chosen is None or total < chosen[0] - 1e-12:
                    chosen = total, way
        if chosen is None:
            return None
        pairs = {} if i == SUPPORT else {j: i}
        for x, y in zip(chosen[1], wanted, strict=True):
            part = costs[x, y]
            pairs |= part[1] if part is not None else {}
        return own + chosen[0], pairs

    # Deepest first, so that the recursion stays shallow in long chains.
    for i in range(found.n - 1, -1, -1):
        for j in range(expected.n - 1, -1, -1):
            match(i, j)
    return match(a, b)


def _assignments(
    mine: list[int], wanted: list[int], costs: dict[tuple[int, int], tuple[float, dict[int, int]] | None]
) -> Iterator[tuple[int, ...]]:
    if len(mine) <= MOST_CHILDREN_PERMUTED:
        yield from itertools.permutations(mine)
        return
    matrix = np.array([[(costs[x, y] or (1e9, {}))[0] for x in mine] for y in wanted])
    rows, columns = library("scipy.optimize").linear_sum_assignment(matrix)
    yield tuple(mine[c] for _, c in sorted(zip(rows, columns, strict=True)))


def difference_of_links(found: Mechanism, i: int, expected: Mechanism, j: int) -> float:
    """A sum of relative differences of two links' numbers, each at most one."""
    a, b = found.links[i], expected.links[j]
    pairs = (
        (a.mass, b.mass),
        (math.hypot(*a.com), math.hypot(*b.com)),
        (math.hypot(*a.hinge), math.hypot(*b.hinge)),
        (a.inertia + a.mass * math.hypot(*a.com) ** 2, b.inertia + b.mass * math.hypot(*b.com) ** 2),
    )
    return sum(min(1.0, abs(x - y) / max(abs(x), abs(y), 1e-300)) for x, y in pairs)


def without_hinge(m: Mechanism, k: int) -> Mechanism:
    """The mechanism with link k fixed to its parent at angle zero (to the world: left out)."""
    parent = m.links[k].parent
    place = {SUPPORT: SUPPORT}
    links: list[Link] = []
    hinges, names = [], []
    removed = m.links[k]
    for i, link in enumerate(m.links):
        if i == k:
            place[i] = place[parent]
            continue
        place[i] = len(links)
        moved = link
        if link.parent == k and parent != SUPPORT:
            moved = replace(link, hinge=(link.hinge[0] + removed.hinge[0], link.hinge[1] + removed.hinge[1]))
        if i == parent:
            moved = _merged(link, removed)
        links.append(replace(moved, parent=place[link.parent]))
        hinges.append(m.hinges[i])
        names.append(m.link_names[i])
    return replace(m, links=tuple(links), hinges=tuple(hinges), link_names=tuple(names))


def _merged(link: Link, removed: Link) -> Link:
    total = link.mass + removed.mass
    at = (removed.hinge[0] + removed.com[0], removed.hinge[1] + removed.com[1])
    share = removed.mass / total if total else 0.0
    com = (link.com[0] + share * (at[0] - link.com[0]), link.com[1] + share * (at[1] - link.com[1]))
    inertia = link.inertia + removed.inertia
    inertia += link.mass * math.dist(link.com, com) ** 2 + removed.mass * math.dist(at, com) ** 2
    return replace(link, mass=total, com=com, inertia=inertia)
