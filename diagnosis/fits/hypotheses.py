"""Hypotheses: one number, or a few numbers, of a mechanism are not what was expected.

The free values of each are solved for in :mod:`.fitting`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...models.mechanism import Mechanism
from ...reference.planar_tree import NAMES, Parameters
from ..finding import Finding
from ..measurement import Array, Measurement

Basis = Callable[[Parameters, Measurement], Array]


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Other values for some of a mechanism's parameters.

    ``apply(p, x)``: the parameters for free values x (…, d), equal to p at x = 0; ``names``: the parameter that each
    value changes, and ``links`` its index; ``sizes``: steps for finite differences, each of its value's magnitude.
    """

    cause: str
    apply: Callable[[Parameters, Array], Parameters]
    names: tuple[str, ...]
    links: tuple[int, ...]
    sizes: Array
    relative: bool = False  # x is a factor minus one
    parts: tuple[Hypothesis, ...] = ()  # of a combined hypothesis, whose values are theirs side by side
    basis: Basis | None = None  # torques (d, S, n) that the engine has besides, for values of one
    tell: Callable[[float, float, Parameters, str], list[Finding]] | None = None  # from value and uncertainty
    wanted: float | None = None  # the one value that means anything
    known: Callable[[float, Parameters], bool] | None = None  # whether a value has a name
    place: str = ""  # of a fault of the code: the term or terms, and where the fault shows
    within: tuple[str, ...] = ()  # the places of all terms of its kind, and of those in its row

    @property
    def d(self) -> int:
        """How many values are free."""
        return len(self.names)


def added(cause: str, entries: Sequence[tuple[str, int]], p: Parameters, size: float) -> Hypothesis:
    """Each entry (parameter, link) is off by a value of its own; ``size``: the values' magnitude where p has none."""

    def apply(base: Parameters, x: Array) -> Parameters:
        items = dict(base.items())
        for column, (name, at) in enumerate(entries):
            unit = np.zeros(base.items()[name].shape[-1])
            unit[at] = 1.0
            items[name] = items[name] + x[..., column, None] * unit
        return Parameters(**items)

    sizes = []
    for name, _ in entries:
        value = float(np.max(np.abs(p.items()[name])))
        sizes.append(value or size)
    names, links = zip(*entries, strict=True)
    return Hypothesis(cause, apply, tuple(names), tuple(links), np.array(sizes))


def scaled(cause: str, powers: Mapping[str, tuple[Sequence[int], int]], link: int, label: str) -> Hypothesis:
    """One factor 1 + x on several parameters: name → (links, power of the factor); ``link``: −1 for all links."""

    def apply(base: Parameters, x: Array) -> Parameters:
        items = dict(base.items())
        for name, (which, power) in powers.items():
            factor = np.zeros(base.items()[name].shape[-1])
            factor[list(which)] = 1.0
            grown = (1 + x[..., 0, None]) ** power
            items[name] = items[name] * (1 + factor * (grown - 1))
        return Parameters(**items)

    return Hypothesis(cause, apply, (label,), (link,), np.array([0.1]), relative=True)


def unnormalised(link: int, n: int, parents: tuple[int, ...]) -> Hypothesis:
    """The joint of ``link`` has a pair (cos, sin) of length 1 + x, which scales all of its subtree's displacements."""
    subtree = [j for j in range(n) if _in_subtree(j, link, parents)]

    def apply(base: Parameters, x: Array) -> Parameters:
        items = dict(base.items())
        r = 1 + x[..., 0, None]
        mask = np.zeros(n)
        mask[subtree] = 1.0
        below = np.array([1.0 if parent in subtree else 0.0 for parent in parents])
        items["mass"] = items["mass"] * (1 + mask * (r * r - 1))
        for name in ("com_along", "com_across"):
            items[name] = items[name] * (1 + mask * (1 / r - 1))
        for name in ("hinge_along", "hinge_across"):
            items[name] = items[name] * (1 + below * (1 / r - 1))
        return Parameters(**items)

    return Hypothesis(
        "continuous-joint-not-normalised", apply, ("length of (cos, sin)",), (link,), np.array([0.05]), relative=True
    )


def all_unnormalised(parents: tuple[int, ...]) -> Hypothesis:
    """Every joint has a pair (cos, sin) of length 1 + x."""
    n = len(parents)
    each = [unnormalised(i, n, parents) for i in range(n)]

    def apply(base: Parameters, x: Array) -> Parameters:
        for hypothesis in each:
            base = hypothesis.apply(base, x)
        return base

    return Hypothesis(
        "continuous-joint-not-normalised", apply, ("length of (cos, sin)",), (-1,), np.array([0.05]), relative=True
    )


def other_bodies(mechanism: Mechanism, p: Parameters) -> list[Hypothesis]:
    """Point masses at the links' ends in place of bodies, and uniform rods in place of point masses."""
    lengths = np.array([link.length for link in mechanism.links])
    kinds = (
        ("rods-as-point-masses", lengths, np.zeros_like(lengths)),
        ("point-masses-as-rods", lengths / 2, lengths**2 / 12),
    )
    return [_bodies(cause, reach, square) for cause, reach, square in kinds]


def _bodies(cause: str, reach: Array, square: Array) -> Hypothesis:
    """A share x of the way to centres of mass at ``reach`` [m] and inertias of ``square`` [m²] times the mass."""

    def apply(base: Parameters, x: Array) -> Parameters:
        share, items = x[..., 0, None], dict(base.items())
        items["com_along"] = items["com_along"] + share * (reach - base.com_along)
        items["com_across"] = items["com_across"] * (1 - share)
        items["inertia"] = items["inertia"] + share * (square * base.mass - base.inertia)
        return Parameters(**items)

    def tell(value: float, spread: float, p: Parameters, who: str) -> list[Finding]:
        return [bodies_finding(cause, who)]

    return Hypothesis(cause, apply, ("bodies",), (-1,), np.array([0.1]), tell=tell, wanted=1.0)


def bodies_finding(cause: str, who: str) -> Finding:
    """The finding of other bodies than expected."""
    points, rods = "point masses at the links' ends", "uniform rods"
    found, expected = (points, rods) if cause == "rods-as-point-masses" else (rods, points)
    return Finding(cause, "every link", found, expected, f"{who}: {found} found, {expected} expected")


def _in_subtree(j: int, link: int, parents: tuple[int, ...]) -> bool:
    while j >= 0:
        if j == link:
            return True
        j = parents[j]
    return False


def singles(mechanism: Mechanism, p: Parameters) -> list[Hypothesis]:
    """Every hypothesis of one place: one link's mass, one hinge's armature, gravity …, likelier ones first."""
    n, parents = mechanism.n, mechanism.parents
    inertia, damping, torque = _sizes(p)
    length = float(np.max(np.hypot(p.com_along, p.com_across), initial=0.0)) or 1.0
    hypotheses = [
        scaled("gravity", {"gravity_along": ([0], 1), "gravity_across": ([0], 1)}, -1, "gravity"),
        added("gravity-turned", [("gravity_along", 0), ("gravity_across", 0)], p, 1.0),
    ]
    for i in range(n):
        children = [c for c in range(n) if parents[c] == i]
        hypotheses += [
            added("armature", [("armature", i)], p, inertia),
            added("damping", [("damping", i)], p, damping),
            added("dry-friction", [("friction", i)], p, torque),
            added("stiffness", [("stiffness", i)], p, torque),
            added("stiffness", [("stiffness", i), ("preload", i)], p, torque),
            scaled("mass", {"mass": ([i], 1)}, i, "mass"),
            scaled("mass", {"mass": ([i], 1), "inertia": ([i], 1)}, i, "mass"),
            added("inertia", [("inertia", i)], p, inertia),
        ]
        along: dict[str, tuple[Sequence[int], int]] = {"com_along": ([i], 1), "com_across": ([i], 1)}
        reach: dict[str, tuple[Sequence[int], int]] = (
            {"hinge_along": (children, 1), "hinge_across": (children, 1)} if children else {}
        )
        if children:
            hypotheses.append(scaled("length", reach, i, "length"))
        hypotheses.append(scaled("length", along | reach, i, "length"))
        if p.inertia[i]:
            hypotheses.append(scaled("length", along | reach | {"inertia": ([i], 2)}, i, "length"))
            hypotheses.append(scaled("length", along | reach | {"mass": ([i], 1), "inertia": ([i], 3)}, i, "length"))
        hypotheses += [
            scaled("com-displaced", along, i, "com"),
            added("com-displaced", [("com_along", i), ("com_across", i)], p, length),
        ]
        if parents[i] >= 0:
            hypotheses.append(added("length", [("hinge_along", i), ("hinge_across", i)], p, length))
        hypotheses.append(unnormalised(i, n, parents))
    return [hypothesis for hypothesis in hypotheses if _acts(hypothesis, p)]


def factors(mechanism: Mechanism, p: Parameters) -> list[Hypothesis]:
    """Every hypothesis of one factor for all links: density, lengths, pairs (cos, sin) …"""
    every = range(mechanism.n)
    lengths: dict[str, tuple[Sequence[int], int]] = dict.fromkeys(
        ("com_along", "com_across", "hinge_along", "hinge_across"), (every, 1)
    )
    hypotheses = [
        scaled("density", {"mass": (every, 1), "inertia": (every, 1)}, -1, "every mass"),
        scaled("length", lengths, -1, "every length"),
        scaled("length", lengths | {"inertia": (every, 2)}, -1, "every length"),
        scaled("length", lengths | {"mass": (every, 1), "inertia": (every, 3)}, -1, "every length"),
        scaled("mass", {"mass": (every, 1)}, -1, "every mass"),
        scaled("inertia", {"inertia": (every, 1)}, -1, "every inertia"),
        all_unnormalised(mechanism.parents),
        *other_bodies(mechanism, p),
    ]
    return [hypothesis for hypothesis in hypotheses if _acts(hypothesis, p)] if mechanism.n > 1 else []


def groups(mechanism: Mechanism, p: Parameters) -> list[Hypothesis]:
    """Every hypothesis of one kind everywhere, each with a value of its own: all armatures, all masses …"""
    n = mechanism.n
    every = range(n)
    inertia, damping, torque = _sizes(p)
    length = float(np.max(np.hypot(p.com_along, p.com_across), initial=0.0)) or 1.0
    hypotheses = [
        added("armature", [("armature", i) for i in every], p, inertia),
        added("damping", [("damping", i) for i in every], p, damping),
        added("dry-friction", [("friction", i) for i in every], p, torque),
        added("stiffness", [(name, i) for i in every for name in ("stiffness", "preload")], p, torque),
        added("mass", [("mass", i) for i in every], p, 1.0),
        added("inertia", [("inertia", i) for i in every], p, inertia),
        added("com-displaced", [(name, i) for i in every for name in ("com_along", "com_across")], p, length),
    ]
    carried = [i for i in every if mechanism.parents[i] >= 0]
    if carried:
        hypotheses.append(
            added("length", [(name, i) for i in carried for name in ("hinge_along", "hinge_across")], p, length)
        )
    return [hypothesis for hypothesis in hypotheses if _acts(hypothesis, p)]


def combined(hypotheses: Sequence[Hypothesis]) -> Hypothesis:
    """All the hypotheses at once, their values side by side."""

    def apply(base: Parameters, x: Array) -> Parameters:
        start = 0
        for hypothesis in hypotheses:
            base = hypothesis.apply(base, x[..., start : start + hypothesis.d])
            start += hypothesis.d
        return base

    def basis(base: Parameters, measured: Measurement) -> Array:
        blank = np.zeros_like(measured.theta)
        parts = [h.basis(base, measured) if h.basis else np.stack([blank] * h.d) for h in hypotheses]
        return np.concatenate(parts)

    return Hypothesis(
        cause="several",
        basis=basis if any(h.basis for h in hypotheses) else None,
        apply=apply,
        names=tuple(name for h in hypotheses for name in h.names),
        links=tuple(i for h in hypotheses for i in h.links),
        sizes=np.concatenate([h.sizes for h in hypotheses]),
        parts=tuple(hypotheses),
    )


def _sizes(p: Parameters) -> tuple[float, float, float]:
    """A typical inertia about a hinge [kg m²], damping [N m s] and torque [N m]."""
    inertia = float(np.max(p.inertia + p.mass * (p.com_along**2 + p.com_across**2))) or 1.0
    gravity = float(np.hypot(p.gravity_along[0], p.gravity_across[0])) or 1.0
    return inertia, inertia, inertia * gravity


def _acts(hypothesis: Hypothesis, p: Parameters) -> bool:
    """Whether the hypothesis changes anything: a factor on zero does not."""
    moved = hypothesis.apply(p, hypothesis.sizes * np.ones(hypothesis.d))
    return any(not np.array_equal(moved.items()[name], p.items()[name]) for name in NAMES)
