"""How a mechanism in space moves, in balls: partial velocities, inertias and momenta, all at the world's origin.

Kane's equations. The partial velocity of degree of freedom j, its motion s_j = (w_j, u_j) for a unit rate, is the
angular velocity w_j and the velocity u_j of the point of the moved body that is at the world's origin O. Taken at one
fixed point it is the same for every body that j moves, so that sums over bodies go into the inertias. With b the bodies
that j moves, V_b = Σ s_j v_j, 𝕀_b the inertia about O (6 × 6), and ζ_b = Σ ṡ_j v_j, where ṡ_j is s_j carried by the
frame that it is fixed in:

    M_ij = s_i · Σ_b 𝕀_b s_j                       b: the bodies that both i and j move
    row i of the velocity terms = s_i · Σ_b d(𝕀_b V_b)/dt,  d(𝕀 V)/dt = 𝕀 ζ + (ω × L + u × P, ω × P),  (L, P) = 𝕀 V
    row i of gravity = −s_i · Σ_b 𝕀_b (0, g)

Bodies that are fixed to their parents are one *group* with it. Rotations are those of exact unit quaternions: every
double of the mechanism and of the state is taken as exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from ...models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism

Floats = NDArray[np.float64]
Vector = tuple[Any, Any, Any]  # of balls
IDENTITY = arb_mat([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
STILL = arb_mat(6, 1)
FEW = 40  # entries alone are faster than a product of matrices where at most one in so many is not zero


@dataclass(eq=False)
class Group:
    """Bodies fixed to one another, in the frame of the one that has the joints.

    ``parent``: index of the group that it hangs on, or :data:`WORLD`; ``rotation`` and ``position`` in that one's frame
    where its joints leave it. ``mass``, first ``moment`` and inertia ``tensor`` about its frame's origin. ``joints``:
    each with its first columns in q and v, its unit axis, as a vector and as the matrix of its cross product, and its
    anchor.
    """

    parent: int
    rotation: Any
    position: Vector
    mass: Any
    moment: Vector
    tensor: Any
    joints: list[tuple[Joint, int, int, Vector, Any, Vector]] = field(default_factory=list)


@lru_cache(maxsize=8)
def groups(mechanism: SpatialMechanism, bits: int) -> tuple[Group, ...]:
    """The moving groups of a mechanism in balls of the precision that is set, which must be ``bits``."""
    found: list[Group] = []
    world = Group(WORLD, IDENTITY, _vector((0, 0, 0)), arb(0), _vector((0, 0, 0)), arb_mat(3, 3))
    frames: list[tuple[int, Any, Vector]] = []  # of each body: its group, and its pose in that one's frame
    at = {(placed.body, placed.joint.name): placed for placed in mechanism.joints}
    for index, body in enumerate(mechanism.bodies):
        parent, rotation, position = frames[body.parent] if body.parent != WORLD else (WORLD, *_rest())
        position = _sum(position, _turned(rotation, _vector(body.position)))
        rotation = rotation * from_quaternion(body.quaternion.tolist())
        if body.joints:
            found.append(Group(parent, rotation, position, arb(0), _vector((0, 0, 0)), arb_mat(3, 3)))
            for joint in body.joints:
                placed = at[index, joint.name]
                axis = unit(_vector(joint.axis)) if joint.kind in ("hinge", "slide") else _vector((0, 0, 0))
                joint_frame = (axis, crossing(axis), _vector(joint.anchor))
                found[-1].joints.append((joint, placed.at_q, placed.at_v, *joint_frame))
            parent, (rotation, position) = len(found) - 1, _rest()
        frames.append((parent, rotation, position))
        _add(found[parent] if parent != WORLD else world, body, rotation, position)
    return tuple(found)


def _add(group: Group, body: RigidBody, rotation: Any, position: Vector) -> None:
    """Add the body's inertial, its frame being there in the group's."""
    inertial = body.inertial
    if inertial.weightless:
        return
    mass, tensor = arb(inertial.mass), _matrix(inertial.tensor)
    centre = _sum(position, _turned(rotation, _vector(inertial.centre)))
    group.mass += mass
    group.moment = _sum(group.moment, scaled(mass, centre))
    symmetric = (tensor + tensor.transpose()) / 2  # what a rounded transformation left apart has no meaning
    across = crossing(centre)
    group.tensor = group.tensor + rotation * symmetric * rotation.transpose() - across * across * mass


class Motion:
    """Partial velocities and inertias of one state, at the precision that is set when it is made and used.

    ``q`` (nq,), ``v`` (nv,): doubles. Raises ZeroDivisionError for a quaternion of length zero.
    """

    def __init__(self, mechanism: SpatialMechanism, q: Floats, v: Floats, bits: int) -> None:
        self.groups = groups(mechanism, bits)
        self.freedoms: list[Any] = []  # s_j, as columns (6, 1)
        self.moves: list[int] = []  # of each freedom: the group that it moves first
        self.inertias: list[Any] = []  # 𝕀 of each group, (6, 6)
        self.velocities: list[Any] = []
        self.drifts: list[Any] = []  # ζ
        self.poses: list[tuple[Any, Vector, Any]] = []  # rotation, position, and what the first's midpoint is off by
        self.armature = [arb(a) for a in mechanism.per_freedom("armature").tolist()]
        coordinates, rates = q.tolist(), [arb(rate) for rate in v.tolist()]
        for index, group in enumerate(self.groups):
            self._place(index, group, coordinates, rates)

    def _place(self, index: int, group: Group, q: list[float], v: list[Any]) -> None:
        if group.parent == WORLD:
            base, origin, off = IDENTITY, _vector((0, 0, 0)), arb(0)
            velocity, drift = STILL, STILL
        else:
            base, origin, off = self.poses[group.parent]
            velocity, drift = self.velocities[group.parent], self.drifts[group.parent]
        within, position = group.rotation, _sum(origin, _turned(base, group.position))
        for joint, at_q, at_v, axis, across, anchor in group.joints:
            here = q[at_q : at_q + joint.coordinates]
            if joint.kind == "free":
                within, position = from_quaternion(here[3:]), _vector(here[:3])
                motions = [_column([0, 0, 0, *_unit_vector(k)]) for k in range(3)] + _turning(within, position)
            else:
                within, position, motions = _moved(joint, here, axis, across, anchor, base, within, position)
            own = [motion * v[at_v + k] for k, motion in enumerate(motions)]
            self.freedoms += motions
            self.moves += [index] * len(motions)
            velocity = velocity + _total(own)
            # A free joint's first three keep their directions in the world, everything else turns with the frame.
            drift = drift + _motion_cross(velocity, _total(own[3:] if joint.kind == "free" else own))
        rotation, off = _carried(base, off, within)
        self.poses.append((rotation, position, off))
        self.velocities.append(velocity)
        self.drifts.append(drift)
        self.inertias.append(_about_origin(group, rotation, position))

    @cached_property
    def composites(self) -> list[Any]:
        """Σ 𝕀 over each group and all that hangs on it."""
        return self._subtrees(self.inertias)

    @cached_property
    def partial(self) -> Any:
        """Every s_j as a row, (nv, 6)."""
        return _rows(self.freedoms)

    @cached_property
    def momenta(self) -> Any:
        """Every 𝕀 s_j of all that j moves, as a row, (nv, 6)."""
        return _rows([self.composites[b] * s for b, s in zip(self.moves, self.freedoms, strict=True)])

    def _mass_entry(self, i: int, j: int) -> Any:
        """Entry ij of M, where i moves what j moves, without the armature."""
        return sum((self.partial[i, k] * self.momenta[j, k] for k in range(6)), arb(0))

    def mass_entries(self) -> dict[tuple[int, int], Any]:
        """The entries of M on and above its diagonal, with the armature on it, less those that are always zero."""
        before = self._freedoms_before()
        pairs = [(i, j) for j, those in enumerate(before) for i in (*those, j)]
        if len(pairs) * FEW < len(before) ** 2:  # many trees beside each other: almost all entries are zero
            every = {pair: self._mass_entry(*pair) for pair in pairs}
        else:
            every = self.partial * self.momenta.transpose()  # right where i moves what j moves
        found = {(i, j): every[i, j] for i, j in pairs}
        return found | {(j, j): every[j, j] + armature for j, armature in enumerate(self.armature)}

    @cached_property
    def momentum_rates(self) -> list[Any]:
        """d(𝕀 V)/dt of each group where no rate changes."""
        return [
            inertia * drift + _force_cross(velocity, inertia * velocity)
            for inertia, drift, velocity in zip(self.inertias, self.drifts, self.velocities, strict=True)
        ]

    def velocity_terms(self) -> list[Any]:
        """Generalised forces that the motion needs where no rate changes, without gravity."""
        return self._rows_of(self.momentum_rates)

    def gravity_terms(self, gravity: Sequence[Any]) -> list[Any]:
        """Generalised forces that hold the mechanism against gravity."""
        return list((self.momenta * _column([0, 0, 0, *(-g for g in gravity)])).entries())

    def inertial_terms(self, accelerations: Sequence[Any]) -> list[Any]:
        """M a, in O(n)."""
        swings = self.swings(accelerations)
        rows = self._rows_of([inertia * swing for inertia, swing in zip(self.inertias, swings, strict=True)])
        return [row + i * a for row, i, a in zip(rows, self.armature, accelerations, strict=True)]

    def swings(self, accelerations: Sequence[Any]) -> list[Any]:
        """Σ s_j a_j of each group, (6, 1) each: its acceleration, but for what its velocity makes of it."""
        found: list[Any] = []
        at = 0
        for index, group in enumerate(self.groups):
            swing = found[group.parent] if group.parent != WORLD else STILL
            while at < len(self.moves) and self.moves[at] == index:
                swing = swing + self.freedoms[at] * accelerations[at]
                at += 1
            found.append(swing)
        return found

    def wrenches(self, accelerations: Sequence[Any], gravity: Sequence[Any]) -> list[Any]:
        """What each group exerts on what carries it in the motion with these accelerations, (6, 1) each.

        The force, then the moment about the origin of the group's frame, in the world's axes: Newton's and Euler's laws
        for all that hangs there, the sum of its weights less the rates of its momenta.
        """
        weight = _column([0, 0, 0, *(-g for g in gravity)])
        moving = zip(self.inertias, self.swings(accelerations), self.momentum_rates, strict=True)
        sums = self._subtrees([inertia * (swing + weight) + rate for inertia, swing, rate in moving])
        found = []
        for total, (_, origin, _) in zip(sums, self.poses, strict=True):
            *moment, x, y, z = (-total).entries()
            force = (x, y, z)
            found.append(_column([*force, *_difference((moment[0], moment[1], moment[2]), cross(origin, force))]))
        return found

    def kinetic_energy(self, rates: Sequence[Any]) -> Any:
        """½ Σ V·𝕀V and the armatures' [J]."""
        moving = zip(self.velocities, self.inertias, strict=True)
        total = sum(((v.transpose() * inertia * v)[0, 0] for v, inertia in moving), arb(0))
        return (total + sum((i * rate * rate for i, rate in zip(self.armature, rates, strict=True)), arb(0))) / 2

    def height_energy(self, gravity: Sequence[Any]) -> tuple[Any, Any]:
        """−Σ m g·c [J] over all that moves, and the sum of its terms' magnitudes."""
        total, added = arb(0), arb(0)
        for group, (rotation, position, _) in zip(self.groups, self.poses, strict=True):
            for parts in (scaled(group.mass, position), _turned(rotation, group.moment)):
                for g, part in zip(gravity, parts, strict=True):
                    total, added = total - part * g, added + abs(part * g)
        return total, added

    def _rows_of(self, forces: list[Any]) -> list[Any]:
        """s_j · Σ forces on what j moves."""
        sums = self._subtrees(forces)
        return [(s.transpose() * sums[b])[0, 0] for b, s in zip(self.moves, self.freedoms, strict=True)]

    def _subtrees(self, values: list[Any]) -> list[Any]:
        sums = list(values)
        for index in reversed(range(len(sums))):
            parent = self.groups[index].parent
            if parent != WORLD:
                sums[parent] = sums[parent] + sums[index]
        return sums

    def _freedoms_before(self) -> list[list[int]]:
        """Of each freedom, those before it that move all that it moves."""
        own: list[list[int]] = [[] for _ in self.groups]
        for j, group in enumerate(self.moves):
            own[group].append(j)
        above: list[list[int]] = []
        for parent in (group.parent for group in self.groups):
            above.append(above[parent] + own[parent] if parent != WORLD else [])
        return [above[b] + [i for i in own[b] if i < j] for j, b in enumerate(self.moves)]


def _moved(
    joint: Joint, q: list[float], axis: Vector, across: Any, anchor: Vector, base: Any, within: Any, position: Vector
) -> tuple[Any, Vector, list[Any]]:
    """The pose after the joint, and the partial velocities of its freedoms; ``within`` the frame ``base``."""
    rotation = base * within
    if joint.kind == "slide":
        direction = _turned(rotation, axis)
        way = arb(q[0]) - arb(joint.ref)
        return within, _sum(position, scaled(way, direction)), [_column([0, 0, 0, *direction])]
    pivot = _sum(position, _turned(rotation, anchor))
    if joint.kind == "hinge":
        sine, cosine = (arb(q[0]) - arb(joint.ref)).sin_cos()
        direction = _turned(rotation, axis)
        within = within * (IDENTITY + across * sine + across * across * (1 - cosine))
        motions = [_column([*direction, *cross(pivot, direction)])]
    else:
        within = within * from_quaternion(q)
        motions = _turning(base * within, pivot)
    return within, _difference(pivot, _turned(base * within, anchor)), motions


def _carried(base: Any, off: Any, within: Any) -> tuple[Any, Any]:
    """base · within, of two rotations, and what its midpoint is off by at most, in the Frobenius norm.

    ``off``: the same of ``base``. A rotation leaves that norm as it is, so that errors add up along a chain; the balls
    of entry-wise products would grow by half a bit or more a body.
    """
    middle = within.mid()
    product = base.mid() * middle
    exact = product.mid()
    off = (off + (1 + off) * frobenius(within - middle) + frobenius(product - exact)).abs_upper()
    return exact + arb_mat(3, 3, [arb(0, off)] * 9), off


def _turning(rotation: Any, pivot: Vector) -> list[Any]:
    """Partial velocities of the angular velocity in the body's axes, about ``pivot``."""
    columns = zip(*rotation.tolist(), strict=True)
    return [_column([*axis, *cross(pivot, axis)]) for axis in columns]


def _about_origin(group: Group, rotation: Any, position: Vector) -> Any:
    """𝕀 (6, 6) of a group whose frame is there, from its inertial about its frame's origin."""
    m, x = group.mass, position
    moment = _turned(rotation, group.moment)
    at, to = crossing(x), crossing(moment)
    tensor = rotation * group.tensor * rotation.transpose() - at * at * m - at * to - to * at
    (a, b, c), (_, d, e), (_, _, f) = tensor.tolist()
    p, q, r = _sum(scaled(m, x), moment)
    z = arb(0)
    return arb_mat(
        [
            [a, b, c, z, -r, q],
            [b, d, e, r, z, -p],
            [c, e, f, -q, p, z],
            [z, r, -q, m, z, z],
            [-r, z, p, z, m, z],
            [q, -p, z, z, z, m],
        ]
    )


def from_quaternion(q: Sequence[float]) -> Any:
    """The rotation matrix of the exact unit quaternion along q (w, x, y, z). Raises ZeroDivisionError for zeros."""
    if not any(q):
        raise ZeroDivisionError("a quaternion of length zero is no rotation")
    w, x, y, z = (arb(part) for part in q)
    across = crossing((x, y, z))
    return IDENTITY + (across * w + across * across) * (2 / (w * w + x * x + y * y + z * z))


def frobenius(matrix: Any) -> Any:
    """An upper bound of the Frobenius norm of the matrices in the balls, exact."""
    return (matrix.transpose() * matrix).trace().abs_upper().sqrt().abs_upper()


def unit(v: Vector) -> Vector:
    """v in unit length. Raises ZeroDivisionError for zeros."""
    if all(part.is_zero() for part in v):
        raise ZeroDivisionError("an axis of length zero has no direction")
    return scaled(1 / dot(v, v).sqrt(), v)


def crossing(v: Vector) -> Any:
    """The matrix [v]× with [v]× u = v × u."""
    x, y, z = v
    return arb_mat([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def cross(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    """a × b."""
    (a0, a1, a2), (b0, b1, b2) = a, b
    return a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """a · b."""
    (a0, a1, a2), (b0, b1, b2) = a, b
    return a0 * b0 + a1 * b1 + a2 * b2


def scaled(factor: Any, v: Vector) -> Vector:
    """factor · v."""
    return factor * v[0], factor * v[1], factor * v[2]


def _motion_cross(velocity: Any, motion: Any) -> Any:
    """The rate of a motion that a frame of this velocity carries."""
    v, m = velocity.entries(), motion.entries()
    return _column([*cross(v[:3], m[:3]), *_sum(cross(v[:3], m[3:]), cross(v[3:], m[:3]))])


def _force_cross(velocity: Any, momentum: Any) -> Any:
    """The rate of a momentum that a frame of this velocity carries."""
    v, p = velocity.entries(), momentum.entries()
    return _column([*_sum(cross(v[:3], p[:3]), cross(v[3:], p[3:])), *cross(v[:3], p[3:])])


def _turned(rotation: Any, v: Vector) -> Vector:
    x, y, z = (rotation * _column(v)).entries()
    return x, y, z


def _sum(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _difference(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _total(parts: Iterable[Any]) -> Any:
    return sum(parts, start=STILL)


def _column(values: Sequence[Any]) -> Any:
    return arb_mat(len(values), 1, list(values))


def _rows(columns: list[Any]) -> Any:
    return arb_mat(len(columns), 6, [entry for column in columns for entry in column.entries()])


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = (arb(float(value)) for value in values)
    return x, y, z


def _unit_vector(k: int) -> Vector:
    return _vector(float(k == i) for i in range(3))


def _matrix(values: Floats) -> Any:
    return arb_mat(values.tolist())


def _rest() -> tuple[Any, Vector]:
    return IDENTITY, _vector((0, 0, 0))
