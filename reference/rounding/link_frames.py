"""RNEA and ABA of a planar tree in spatial algebra and link frames, as engines compute them (Featherstone 2008).

One text for any numbers that add, multiply and divide: it is run in :mod:`.monte_carlo`'s arithmetic to see what
rounding does. A link's frame has its origin at the joint that carries it, its first axis along the link. A spatial
vector is (angular, first, second component). Quantities are lists, one entry a link.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from ...models import PlanarTree
from ...models.tree import SUPPORT


class Spatial(NamedTuple):
    """A motion vector or a force vector of the plane."""

    w: Any
    x: Any
    y: Any

    def __add__(self, other: Spatial) -> Spatial:  # type: ignore[override]
        return Spatial(self.w + other.w, self.x + other.x, self.y + other.y)


STILL = Spatial(0.0, 0.0, 0.0)


class Inertia(NamedTuple):
    """A symmetric articulated-body inertia: rows and columns w, x, y."""

    ww: Any
    wx: Any
    wy: Any
    xx: Any
    xy: Any
    yy: Any

    def __add__(self, other: Inertia) -> Inertia:  # type: ignore[override]
        return Inertia(*(a + b for a, b in zip(self, other, strict=True)))

    def times(self, v: Spatial) -> Spatial:
        """The force that gives a motion."""
        return Spatial(
            self.ww * v.w + self.wx * v.x + self.wy * v.y,
            self.wx * v.w + self.xx * v.x + self.xy * v.y,
            self.wy * v.w + self.xy * v.x + self.yy * v.y,
        )


class Turn(NamedTuple):
    """From the parent's frame to the link's: cosine and sine of the joint angle, the joint's place on the parent.

    ``axis``: the rotation matrix's entry for the joint's own axis, one but for rounding: turned about an axis of any
    direction it is (1 - cos) + cos, which what is parallel to the axis is multiplied by.
    """

    cos: Any
    sin: Any
    x: Any
    y: Any
    axis: Any

    def motion(self, v: Spatial) -> Spatial:
        """A motion of the parent, seen from the link."""
        x, y = v.x - v.w * self.y, v.y + v.w * self.x
        return Spatial(v.w * self.axis, self.cos * x + self.sin * y, self.cos * y - self.sin * x)

    def force(self, f: Spatial) -> Spatial:
        """A force on the link, seen from the parent."""
        x, y = self.cos * f.x - self.sin * f.y, self.sin * f.x + self.cos * f.y
        return Spatial(f.w * self.axis + (self.x * y - self.y * x), x, y)

    def inertia(self, i: Inertia) -> Inertia:
        """An articulated inertia of the link, seen from the parent."""
        c, s = self.cos, self.sin
        hx, hy = (c * i.wx - s * i.wy) * self.axis, (s * i.wx + c * i.wy) * self.axis
        # R A Rᵀ, one product after the other
        first, second = (c * i.xx - s * i.xy, s * i.xx + c * i.xy), (c * i.xy - s * i.yy, s * i.xy + c * i.yy)
        xx = first[0] * c - second[0] * s
        xy = first[1] * c - second[1] * s
        yy = first[1] * s + second[1] * c
        # shifted by the joint's place r: the moment of a force is that about the joint, plus r × force
        gx, gy = hx - self.y * xx + self.x * xy, hy - self.y * xy + self.x * yy
        ww = i.ww * self.axis * self.axis - self.y * hx + self.x * hy - self.y * gx + self.x * gy
        return Inertia(ww, gx, gy, xx, xy, yy)


def rigid_inertia(tree: PlanarTree, i: int, rounded: Callable[[float], Any]) -> Inertia:
    """Link i's spatial inertia about its joint [kg, kg m, kg m²]; what double precision cannot hold is ``rounded``."""
    link = tree.links[i]
    mass, (x, y) = Fraction(link.mass), map(Fraction, link.com)

    def number(exact: Fraction) -> Any:
        value = float(exact)
        return value if Fraction(value) == exact else rounded(value)

    about_joint = Fraction(link.inertia) + mass * (x * x + y * y)
    return Inertia(number(about_joint), -number(mass * y), number(mass * x), link.mass, 0.0, link.mass)


def cross_motion(v: Spatial, rate: Any) -> Spatial:
    """v × (rate, 0, 0): the acceleration that a joint's rate makes in a moving frame."""
    return Spatial(0.0, v.y * rate, -(v.x * rate))


def cross_force(v: Spatial, h: Spatial) -> Spatial:
    """v ×* h: the rate of change of a momentum in a moving frame."""
    return Spatial(v.x * h.y - v.y * h.x, -(v.w * h.y), v.w * h.x)


def joint_turns(q: Sequence[Any], places: Sequence[tuple[Any, Any]]) -> list[Turn]:
    """Each joint's transformation, from relative angles and the joints' places on their parents."""
    found = []
    for angle, place in zip(q, places, strict=True):
        cos = angle.cos()
        found.append(Turn(cos, angle.sin(), *place, (1.0 - cos) + cos))
    return found


def velocities(tree: PlanarTree, turns: Sequence[Turn], rates: Sequence[Any]) -> list[Spatial]:
    """Each link's spatial velocity."""
    found: list[Spatial] = []
    for link, turn, rate in zip(tree.links, turns, rates, strict=True):
        carried = STILL if link.parent == SUPPORT else turn.motion(found[link.parent])
        found.append(Spatial(carried.w + rate, carried.x, carried.y))
    return found


def inverse_dynamics(
    tree: PlanarTree,
    turns: Sequence[Turn],
    rates: Sequence[Any],
    accelerations: Sequence[Any],
    *,
    gravity: Any,
    rounded: Callable[[float], Any],
) -> list[Spatial]:
    """RNEA: the spatial force through each joint in its link's frame; its first component is the torque [N m].

    ``rates`` and ``accelerations`` are relative [rad/s], [rad/s²]; ``gravity`` [m/s²] points along the support's frame.
    ``rounded`` makes a number of what double precision does not hold exactly. Featherstone 2008, table 5.1.
    """
    v = velocities(tree, turns, rates)
    a: list[Spatial] = []
    f: list[Spatial] = []
    for i, (link, turn) in enumerate(zip(tree.links, turns, strict=True)):
        base = Spatial(0.0, -gravity, 0.0)
        carried = turn.motion(base if link.parent == SUPPORT else a[link.parent])
        own = cross_motion(v[i], rates[i])
        a.append(Spatial(carried.w + accelerations[i], carried.x + own.x, carried.y + own.y))
        inertia = rigid_inertia(tree, i, rounded)
        f.append(inertia.times(a[i]) + cross_force(v[i], inertia.times(v[i])))
    for i in range(tree.n - 1, -1, -1):
        if tree.links[i].parent != SUPPORT:
            f[tree.links[i].parent] = f[tree.links[i].parent] + turns[i].force(f[i])
    return f


def in_world(tree: PlanarTree, turns: Sequence[Turn], forces: Sequence[Spatial]) -> list[tuple[Any, Any]]:
    """The forces, each in its link's frame, seen from the support: turned by the product of all turns on the way."""
    total: list[tuple[Any, Any]] = []
    for link, turn in zip(tree.links, turns, strict=True):
        if link.parent == SUPPORT:
            total.append((turn.cos, turn.sin))
        else:
            c, s = total[link.parent]
            total.append((c * turn.cos - s * turn.sin, s * turn.cos + c * turn.sin))
    return [(c * f.x - s * f.y, s * f.x + c * f.y) for (c, s), f in zip(total, forces, strict=True)]


def depths(tree: PlanarTree, turns: Sequence[Turn]) -> list[Any]:
    """Of the links' centres of mass below the support [m]: places in the world, joint after joint."""
    found: list[Any] = []
    frames: list[tuple[Any, Any, Any]] = []  # of each link: its joint's depth, cosine and sine of its angle
    for link, turn in zip(tree.links, turns, strict=True):
        if link.parent == SUPPORT:
            x, c, s = turn.x, turn.cos, turn.sin
        else:
            x, c, s = frames[link.parent]
            x = x + (c * turn.x - s * turn.y)
            c, s = c * turn.cos - s * turn.sin, s * turn.cos + c * turn.sin
        frames.append((x, c, s))
        found.append(x + (c * link.com[0] - s * link.com[1]))
    return found


def forward_dynamics(
    tree: PlanarTree,
    turns: Sequence[Turn],
    rates: Sequence[Any],
    *,
    gravity: float,
    rounded: Callable[[float], Any],
) -> list[Any]:
    """ABA: relative accelerations [rad/s²] without torques. Featherstone 2008, table 7.1; arguments as for RNEA."""
    v = velocities(tree, turns, rates)
    inertia = [rigid_inertia(tree, i, rounded) for i in range(tree.n)]
    bias = [cross_force(v[i], inertia[i].times(v[i])) for i in range(tree.n)]
    coriolis = [cross_motion(v[i], rates[i]) for i in range(tree.n)]
    for i in range(tree.n - 1, -1, -1):
        if tree.links[i].parent != SUPPORT:
            parent = tree.links[i].parent
            reduced, felt = _without_joint(inertia[i])
            share = -bias[i].w * (1.0 / inertia[i].ww)
            column = Spatial(inertia[i].ww * share, inertia[i].wx * share, inertia[i].wy * share)
            c = coriolis[i]
            _, x, y = reduced.times(c)
            left = bias[i] + Spatial(felt.w * c.w + felt.x * c.x + felt.y * c.y, x, y) + column
            inertia[parent] = inertia[parent] + turns[i].inertia(reduced)
            bias[parent] = bias[parent] + turns[i].force(left)
    a: list[Spatial] = []
    found: list[Any] = []
    for i, link in enumerate(tree.links):
        base = Spatial(0.0, -gravity, 0.0)
        carried = turns[i].motion(base if link.parent == SUPPORT else a[link.parent]) + coriolis[i]
        own = inertia[i]
        needed = bias[i].w + (own.ww * carried.w + own.wx * carried.x + own.wy * carried.y)
        found.append(-needed / own.ww)
        a.append(Spatial(carried.w + found[i], carried.x, carried.y))
    return found


def _without_joint(i: Inertia) -> tuple[Inertia, Spatial]:
    """I - (U / D) Uᵀ: what is left of an articulated inertia once its joint yields; and its first row as it stands.

    Its first row and column are zero but for rounding, which stands beside the inertias of what carries the link. These
    may be far smaller. U / D has been rounded, so that row and column are not the same: what carries the link has the
    column's, its acceleration meets the row. D (1 / D) may well be one: the last digit of D decides, which depends on
    how m l² is multiplied out and on how a file's numbers were read.
    """
    inverse = 1.0 / i.ww
    wx, wy = i.wx * inverse, i.wy * inverse
    one = i.ww * inverse
    row = Spatial(i.ww - one * i.ww, i.wx - one * i.wx, i.wy - one * i.wy)
    column = Inertia(
        row.w,
        i.wx - wx * i.ww,
        i.wy - wy * i.ww,
        i.xx - wx * i.wx,
        i.xy - wx * i.wy,
        i.yy - wy * i.wy,
    )
    return column, row
