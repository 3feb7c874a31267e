"""One-parameter (or few-parameter) ways in which a mechanism can be another one, and the fit of each to measurements.

A family says: *this number of the mechanism is not what was expected*. Its free values are solved for by least squares
on the torques left over (Gauss-Newton; most are linear, then one step is exact), and it explains a measurement when
nothing is left that rounding does not explain.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..models.mechanism import Mechanism
from ..reference.planar_tree import NAMES, Parameters
from .measurement import Array, Measurement

STEPS = 12  # of Gauss-Newton; two or three are the rule
AT_ONCE = 400_000  # numbers in one batch of perturbed mechanisms


@dataclass(frozen=True)
class Family:
    """``apply(p, x)`` is the mechanism for free values x (…, d), p at zero; ``names`` the parameter of each value and
    ``links`` its index; ``sizes``: steps for differences, the order of the value's own size."""

    cause: str
    apply: Callable[[Parameters, Array], Parameters]
    names: tuple[str, ...]
    links: tuple[int, ...]
    sizes: Array
    relative: bool = False  # x is a factor less one

    @property
    def d(self) -> int:
        """How many values are free."""
        return len(self.names)


@dataclass(frozen=True)
class Fit:
    """A family's best values, their uncertainty from rounding, and the largest torque left over (in units of it)."""

    family: Family
    values: Array
    uncertainty: Array
    left: float

    @property
    def explains(self) -> bool:
        """Whether nothing is left that rounding does not explain."""
        return self.left <= 1


def added(cause: str, entries: Sequence[tuple[str, int]], p: Parameters, size: float) -> Family:
    """Each entry (parameter, link) is off by a value of its own."""

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
    return Family(cause, apply, tuple(names), tuple(links), np.array(sizes))


def scaled(cause: str, powers: Mapping[str, tuple[Sequence[int], int]], link: int, label: str) -> Family:
    """One factor 1 + x on several parameters: name → (links, power of the factor)."""

    def apply(base: Parameters, x: Array) -> Parameters:
        items = dict(base.items())
        for name, (which, power) in powers.items():
            factor = np.zeros(base.items()[name].shape[-1])
            factor[list(which)] = 1.0
            grown = (1 + x[..., 0, None]) ** power
            items[name] = items[name] * (1 + factor * (grown - 1))
        return Parameters(**items)

    return Family(cause, apply, (label,), (link,), np.array([0.1]), relative=True)


def unnormalised(link: int, n: int, parents: tuple[int, ...]) -> Family:
    """Joint ``link`` turns by (cos, sin) of length 1 + x: what it carries feels motion and gravity so much more."""
    carried = [j for j in range(n) if _carried_by(j, link, parents)]

    def apply(base: Parameters, x: Array) -> Parameters:
        items = dict(base.items())
        r = 1 + x[..., 0, None]
        mask = np.zeros(n)
        mask[carried] = 1.0
        below = np.array([1.0 if parent in carried else 0.0 for parent in parents])
        items["mass"] = items["mass"] * (1 + mask * (r * r - 1))
        for name in ("com_along", "com_across"):
            items[name] = items[name] * (1 + mask * (1 / r - 1))
        for name in ("hinge_along", "hinge_across"):
            items[name] = items[name] * (1 + below * (1 / r - 1))
        return Parameters(**items)

    return Family(
        "continuous-joint-not-normalised", apply, ("length of (cos, sin)",), (link,), np.array([0.05]), relative=True
    )


def _carried_by(j: int, link: int, parents: tuple[int, ...]) -> bool:
    while j >= 0:
        if j == link:
            return True
        j = parents[j]
    return False


def singles(mechanism: Mechanism, p: Parameters) -> list[Family]:
    """Every family of one place: one link's mass, one hinge's armature, gravity …, likelier ones first."""
    n, parents = mechanism.n, mechanism.parents
    inertia, damping, torque = _sizes(p)
    length = float(np.max(np.hypot(p.com_along, p.com_across), initial=0.0)) or 1.0
    families = [
        scaled("gravity", {"gravity_along": ([0], 1), "gravity_across": ([0], 1)}, -1, "gravity"),
        added("gravity-turned", [("gravity_along", 0), ("gravity_across", 0)], p, 1.0),
    ]
    for i in range(n):
        children = [c for c in range(n) if parents[c] == i]
        families += [
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
            families.append(scaled("length", reach, i, "length"))
        families.append(scaled("length", along | reach, i, "length"))
        if p.inertia[i]:
            families.append(scaled("length", along | reach | {"inertia": ([i], 2)}, i, "length"))
            families.append(scaled("length", along | reach | {"mass": ([i], 1), "inertia": ([i], 3)}, i, "length"))
        families += [
            scaled("com-displaced", along, i, "com"),
            added("com-displaced", [("com_along", i), ("com_across", i)], p, length),
        ]
        if parents[i] >= 0:
            families.append(added("length", [("hinge_along", i), ("hinge_across", i)], p, length))
        families.append(unnormalised(i, n, parents))
    return [family for family in families if _acts(family, p)]


def groups(mechanism: Mechanism, p: Parameters) -> list[Family]:
    """Every family of one kind everywhere: all armatures, all masses, all lengths by one factor …"""
    n = mechanism.n
    every = range(n)
    inertia, damping, torque = _sizes(p)
    length = float(np.max(np.hypot(p.com_along, p.com_across), initial=0.0)) or 1.0
    lengths: dict[str, tuple[Sequence[int], int]] = dict.fromkeys(
        ("com_along", "com_across", "hinge_along", "hinge_across"), (every, 1)
    )
    families = [
        scaled("length", lengths, -1, "every length"),
        scaled("length", lengths | {"inertia": (every, 2)}, -1, "every length"),
        scaled("mass", {"mass": (every, 1), "inertia": (every, 1)}, -1, "every mass"),
        scaled("mass", {"mass": (every, 1)}, -1, "every mass"),
        scaled("inertia", {"inertia": (every, 1)}, -1, "every inertia"),
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
        families.append(
            added("length", [(name, i) for i in carried for name in ("hinge_along", "hinge_across")], p, length)
        )
    return [family for family in families if _acts(family, p)]


def fit(family: Family, p: Parameters, measured: Measurement) -> Fit:
    """The family's values that leave the least, by Gauss-Newton from zero."""
    x = np.zeros(family.d)
    best: Fit | None = None
    sizes = family.sizes
    with np.errstate(all="ignore"):
        return _improved(family, p, measured, x, best, sizes)


def _improved(family: Family, p: Parameters, measured: Measurement, x: Array, best: Fit | None, sizes: Array) -> Fit:
    in_vain = 0
    for _ in range(STEPS):
        at = family.apply(p, x)
        scale = measured.scale(at)
        left = measured.left_over(at, scale)
        worst = float(np.max(np.abs(left)))
        columns = _columns(family, p, x, sizes, measured, scale)
        if not (np.isfinite(worst) and np.isfinite(columns).all()):
            break
        step, spread = _solve(columns, left.ravel())
        in_vain = in_vain + 1 if best is not None and worst > 0.5 * best.left else 0
        if best is None or worst < best.left:
            best = Fit(family, x.copy(), spread * sizes, worst)
        if in_vain > (0 if best.explains else 2):
            break
        x = x + step * sizes
        if not np.isfinite(x).all():
            break
    return best if best is not None else Fit(family, x, x, np.inf)


def screened(families: Sequence[Family], p: Parameters, measured: Measurement) -> list[tuple[float, Family]]:
    """How much of the torques left over one linear step of each family leaves (root mean square), least first.

    All families are perturbed in a few large batches.
    """
    scale = measured.scale(p)
    left = measured.left_over(p, scale).ravel()
    many = [(f, k, sign) for f in families for k in range(f.d) for sign in (1.0, -1.0)]
    per_batch = max(2, AT_ONCE // left.size // 2 * 2)
    responses = []
    for begin in range(0, len(many), per_batch):
        part = many[begin : begin + per_batch]
        stacked = _stack([f.apply(p, sign * f.sizes[k] * np.eye(f.d)[k]) for f, k, sign in part])
        responses.append(measured.left_over(stacked, scale).reshape(len(part), -1))
    every = np.concatenate(responses)
    derivative = (every[0::2] - every[1::2]) / 2
    found, column = [], 0
    for family in families:
        columns = derivative[column : column + family.d].T
        column += family.d
        step, _ = _solve(columns, left)
        found.append((float(np.sqrt(np.mean((left + columns @ step) ** 2))), family))
    return sorted(found, key=lambda item: item[0])


def _columns(family: Family, p: Parameters, x: Array, sizes: Array, measured: Measurement, scale: Array) -> Array:
    points = [x + sign * sizes[k] * 1e-3 * np.eye(family.d)[k] for k in range(family.d) for sign in (1.0, -1.0)]
    found = measured.left_over(_stack([family.apply(p, point) for point in points]), scale).reshape(2 * family.d, -1)
    return np.asarray((found[0::2] - found[1::2]).T / 2e-3)


def _solve(columns: Array, left: Array) -> tuple[Array, Array]:
    """−columns⁺ · left, and the spread of the solution for left-overs of one each."""
    if not (np.isfinite(columns).all() and np.isfinite(left).all()):  # numbers out of range: nothing to be had here
        return np.zeros(columns.shape[1]), np.full(columns.shape[1], np.inf)
    size = np.linalg.norm(columns, axis=0)
    size = np.where(size > 0, size, 1.0)
    inverse = np.linalg.pinv(columns / size, rcond=1e-12)
    return -(inverse @ left) / size, np.linalg.norm(inverse, axis=1) / size


def _stack(many: Sequence[Parameters]) -> Parameters:
    """Mechanisms along a new first axis, broadcast against states."""
    return Parameters(**{name: np.stack([p.items()[name] for p in many])[:, None, :] for name in NAMES})


def _sizes(p: Parameters) -> tuple[float, float, float]:
    """What a typical inertia about a hinge [kg m²], damping [N m s] and torque [N m] would be."""
    inertia = float(np.max(p.inertia + p.mass * (p.com_along**2 + p.com_across**2))) or 1.0
    gravity = float(np.hypot(p.gravity_along[0], p.gravity_across[0])) or 1.0
    return inertia, inertia, inertia * gravity


def _acts(family: Family, p: Parameters) -> bool:
    """Whether the family changes anything: a factor on zero does not."""
    moved = family.apply(p, family.sizes * np.ones(family.d))
    return any(not np.array_equal(moved.items()[name], p.items()[name]) for name in NAMES)
