"""What rounding may do to an engine's terms and accelerations of a mechanism in space: bounds for each row.

As in :mod:`..bounds`, an engine that is right computes the exact answer of a slightly wrong problem, and what it is off
by is compared with the sum of the magnitudes of the row's terms. In space rotating a vector mixes its components, so
that magnitudes are norms; and what holds a free base at rest adds up to zero, so that they are summed over the bodies
before anything cancels. With b a body that degree of freedom i moves, c its centre of mass,

    u_ib   the velocity of c for a unit rate: the *length of the way* from the joint to c, or 1 for a translation
    w_i    1 for a rotation, 0 for a translation
    F_b = Σ w_j |q̇_j|,  U_b = Σ u_jb |q̇_j|   over all that move b: its angular velocity, its velocity, as added up

the unit of entry ij of the mass matrix is Σ_b m_b u_ib u_jb + |I_b| w_i w_j, over what both move, and that of row i of
the bias, as derived in :mod:`..bounds`,

    Σ_b  m_b (3 F_b U_b u_ib + w_i U_b²) + w_i |I_b| F_b²  +  m_b |g| u_ib.

Ways are measured along the joints, since differences of places are known to ε of the places. An engine may place bodies
in the world, and take moments about the centre of mass of all that hangs together, as MuJoCo does: then u_ib is the way
from the joint to that point and on to c, and every length has an error of ε of the way from the world's origin, which
multiplies what the length itself multiplies. The three degrees of freedom of a ball, and the two threes of a free
joint, share one magnitude, the norm: an engine may have them in other axes than MuJoCo's.

Accelerations are judged by the residual that they leave. Its unit is that of the mass matrix times |a|, the bias', the
forces that are applied; and for engines that factorise M, √M_ii Σ √M_jj |a_j| (Higham, theorem 10.3). That bound is one
of the first order: where M is nearer to a singular matrix than its own rounding, a factorisation may fail, and nothing
is known of what it leaves (:meth:`Magnitudes.regular`).

A product below the smallest normal number is off by up to η = ε × that number, as in :mod:`..bounds`: whatever it is
still to be multiplied by is at most (1 + Σm + Σ|I|)(1 + A)², with A the longest u, times 1 + |g| + F² + the sum of the
|a|, and in a solution the largest entry of its factors, at most √(max M_ii / min D) with D the pivots.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ....models.spatial import unit
from ....models.spatial_mechanism import WORLD, Array, PlacedJoint, SpatialMechanism
from ... import spatial_kinematics
from ..bounds import EPSILON, ROUNDINGS_PER_LINK, SMALLEST
from .blocks import Blocks

FORCE_ROUNDINGS = 16  # of a spring's: quotient of quaternions, its norm, arc tangent, products


def components(mechanism: SpatialMechanism) -> list[slice]:
    """The degrees of freedom that are components of a vector, three by three."""
    joints = [one for one in mechanism.joints if one.joint.freedoms >= 3]
    return [slice(at, at + 3) for one in joints for at in range(one.at_v, one.at_v + one.joint.freedoms, 3)]


@dataclass(frozen=True)
class Lengths:
    """Lengths that enter a sum, and what they are off by in units of ε beyond their own rounding; same shapes."""

    own: Array
    off: Array

    def times(self, other: Lengths) -> Array:
        """Their products, to the first order in what they are off by."""
        return self.own * other.own + self.own * other.off + self.off * other.own


class Magnitudes:
    """The units of rounding of one state ``q`` (nq,), for rates ``v`` (nv,), zero if None.

    ``world``: whether the engine places bodies in the world and takes moments about the centre of mass of the whole.
    The lengths then are those of either way of computing, whichever is larger; otherwise those along the joints.
    ``origin``: whether it takes moments about the world's origin: the way from the joint there, and on to the centre.
    ``together``: whether the joints of one body may be one joint of the engine's, whose block it inverts as a ball's.
    """

    def __init__(
        self,
        mechanism: SpatialMechanism,
        q: Array,
        v: Array | None = None,
        *,
        world: bool = True,
        origin: bool = False,
        together: bool = False,
        moved: spatial_kinematics.Motion | None = None,
    ) -> None:
        """``moved``: where all bodies are in this state, if that is known already."""
        self.mechanism, self.q = mechanism, np.asarray(q, dtype=np.float64)
        self.v = np.zeros(mechanism.nv) if v is None else np.asarray(v, dtype=np.float64)
        self.world, self.origin, self.together = world, origin, together
        self._known = moved
        self._mass = np.abs([body.inertial.mass for body in mechanism.bodies])  # a file may have a negative one
        self._tensor = np.array([np.linalg.norm(body.inertial.tensor, 2) for body in mechanism.bodies])

    @cached_property
    def roundings(self) -> float:
        """How many roundings, in units of ε, the unit of a row allows.

        So many a link as in the plane, a link being a joint or a body on the longest way from the world, two more for
        taking a tensor to its principal axes and back (MuJoCo's iteration leaves at most 44 of its norm in a hundred
        thousand random ones, 14 in the median), and one for each body that is added up. A hinge's angle is known to ε
        of itself, which beyond half a turn is more than that.
        """
        depth = [0] * len(self.mechanism.bodies)
        for index, body in enumerate(self.mechanism.bodies):
            before = depth[body.parent] if body.parent != WORLD else 0
            depth[index] = before + max(1, len(body.joints))
        turned = [
            abs(self.q[one.at_q]) + abs(one.joint.ref) for one in self.mechanism.joints if one.joint.kind == "hinge"
        ]
        turns = max(1.0, max(turned, default=0.0) / np.pi)
        return (ROUNDINGS_PER_LINK * (2 + max(depth, default=0)) + len(depth)) * turns

    @cached_property
    def mass_matrix(self) -> Array:
        """The unit of each entry of M, (nv, nv)."""
        levers, turns = self._levers, self._turns
        own, off = levers.own * np.sqrt(self._mass), levers.off * np.sqrt(self._mass)
        found = own @ own.T + own @ off.T + off @ own.T
        found += (turns * self._tensor) @ turns.T
        return np.asarray(found + self._armature + self._underflow)

    @cached_property
    def _armature(self) -> Array:
        """The armatures, (nv, nv): in other axes those of a vector are beside the diagonal, too."""
        found = np.diag(self.mechanism.per_freedom("armature"))
        for part in self._threes:
            found[part, part] = found[part.start, part.start]
        return np.asarray(found)

    @cached_property
    def bias(self) -> Array:
        """The unit of each row of the bias, (nv,)."""
        return np.asarray(self._bias.sum(axis=1) + self._underflow_in_motion)

    @cached_property
    def _bias(self) -> Array:
        """The share of each body in each row of the bias, (nv, bodies)."""
        levers, rates = self._levers, self.once(self.v)
        spin = rates @ self._turns
        speed = Lengths(rates @ levers.own, rates @ levers.off)
        swing = Lengths(3 * spin * speed.own, 3 * spin * speed.off)
        turning = self._turns * (self._mass * speed.times(speed) + self._tensor * spin**2)
        return np.asarray(levers.times(swing) * self._mass + turning + self._weights)

    @cached_property
    def gravity(self) -> Array:
        """The unit of each row of gravity's share of the bias, (nv,)."""
        return np.asarray(self._weights.sum(axis=1) + self._underflow * (1 + np.linalg.norm(self.mechanism.gravity)))

    @cached_property
    def _weights(self) -> Array:
        levers = self._levers
        return np.asarray((levers.own + levers.off) * self._mass * np.linalg.norm(self.mechanism.gravity))

    @cached_property
    def passive(self) -> Array:
        """Σ|terms| of the dampers' and springs' forces, (nv,)."""
        found = self.mechanism.per_freedom("damping") * self.rates(self.v) + SMALLEST
        for one in self.mechanism.joints:
            here, joint = self.q[one.columns_q], one.joint
            if joint.kind in ("hinge", "slide"):
                found[one.at_v] += joint.stiffness * (abs(here[0]) + abs(joint.springref))
                continue
            found[one.columns_v][-3:] += joint.stiffness * (np.pi + self._jump(one))
            if joint.kind == "free":
                rest = np.linalg.norm(self.mechanism.bodies[one.body].position)
                found[one.columns_v][:3] += joint.stiffness * (np.linalg.norm(here[:3]) + rest)
        return found

    def _jump(self, placed: PlacedJoint) -> float:
        """Over ε, what the pull of a ball's or a free joint's spring jumps by at half a turn, where that is so near
        that rounding decides which way round is the shorter one; else nothing."""
        body, here = self.mechanism.bodies[placed.body], unit(self.q[placed.columns_q][-4:])
        rest = unit(body.quaternion) if placed.joint.kind == "free" else np.array([1.0, 0.0, 0.0, 0.0])
        return 2 * np.pi / EPSILON if abs(float(here @ rest)) <= FORCE_ROUNDINGS * EPSILON else 0.0

    def rates(self, values: Array) -> Array:
        """|values| (nv,), the norm for each of three that are components of a vector."""
        found = np.abs(np.asarray(values, dtype=np.float64))
        for part in self._threes:
            largest = float(found[part].max())
            found[part] = largest * np.linalg.norm(found[part] / (largest or 1.0))  # squares may be out of range
        return found

    def once(self, values: Array) -> Array:
        """The same for sums, in which the norm is to be counted once: as the first of the three."""
        found = self.rates(values)
        for part in self._threes:
            found[part][1:] = 0
        return found

    @cached_property
    def _threes(self) -> list[slice]:
        return components(self.mechanism)

    def residual(
        self,
        accelerations: Array,
        mass: Array,
        torque: Array | None = None,
        *,
        factorised: bool = True,
        inverted: bool = True,
    ) -> Array:
        """The unit of each row of M a + bias − passive − torque, (nv,); ``mass``: M (nv, nv), to a few digits.

        ``factorised``: whether the engine may factorise M; ``inverted``: whether it may eliminate a joint at a time,
        and then inverts its block.
        """
        with np.errstate(over="ignore", invalid="ignore"):  # beyond the range of doubles nothing is known
            rows = self._rows(accelerations, mass, torque, factorised=factorised, inverted=inverted)
        return np.where(np.isnan(rows), np.inf, rows)

    def _rows(
        self, accelerations: Array, mass: Array, torque: Array | None, *, factorised: bool, inverted: bool
    ) -> Array:
        swings, rates = self.once(accelerations), self.once(self.v)
        for one in self.mechanism.joints:
            if one.joint.kind == "free":  # what a turning frame adds to an acceleration given in its axes
                swings[one.at_v] += rates[one.at_v] * rates[one.at_v + 3]
        levers = self._levers
        swing = Lengths(swings @ levers.own, swings @ levers.off)
        shares = levers.times(swing) * self._mass + self._turns * (self._tensor * (swings @ self._turns)) + self._bias
        rows = shares.sum(axis=1) + self._armature @ swings + self.passive
        if torque is not None:
            rows = rows + self.rates(torque)
        if inverted:
            rows = rows + self._inverted(mass, rows, shares, swings)
        if factorised:
            squares = np.diag(mass).copy()
            for part in self._threes:
                squares[part] = squares[part].sum()  # whichever axes the engine has
            root = np.sqrt(squares)
            rows = rows + root * (root @ swings)
        return np.asarray(rows + self._growth(mass) * (self._underflow_in_motion + self._underflow * swings.sum()))

    def regular(self, mass: Array, accuracy: float = EPSILON) -> bool:
        """Whether M (nv, nv) is further from singular than its rounding: only then is :meth:`residual` a bound.

        As :meth:`..bounds.Amplitudes.regular` has it: scaled by the roots of its unit's diagonal on both sides, M is
        off by a matrix whose norm is at most its largest sum of a row. Where M's smallest eigenvalue is above that,
        factorisations succeed (Higham, theorem 10.7).
        """
        root = np.sqrt(np.diag(self.mass_matrix))
        scale = np.outer(root, root)
        off = self.roundings * accuracy * float((self.mass_matrix / scale + 1.0).sum(axis=1).max(initial=0.0))
        return bool(np.linalg.eigvalsh(mass / scale).min(initial=np.inf) > off)

    def joint_forces(self, accelerations: Array) -> Array:
        """The units of force [N] and moment [N m] of each moving link on what carries it, (links, 2).

        As rows of :meth:`residual` for a translation and a rotation about the origin of the link's frame: the sum of
        the magnitudes over all that hangs there. Forces may come from the joint's pivot to that origin.
        """
        levers, rates, swings = self._levers, self.once(self.v), self.once(accelerations)
        for one in self.mechanism.joints:
            if one.joint.kind == "free":
                swings[one.at_v] += rates[one.at_v] * rates[one.at_v + 3]
        spin, swing = rates @ self._turns, Lengths(swings @ levers.own, swings @ levers.off)
        speed = Lengths(rates @ levers.own, rates @ levers.off)
        weight = float(np.linalg.norm(self.mechanism.gravity))
        pull = Lengths(swing.own + 3 * spin * speed.own + weight, swing.off + 3 * spin * speed.off)
        turning = self._mass * speed.times(speed) + self._tensor * (spin**2 + swings @ self._turns)
        found = []
        for index, body in enumerate(self.mechanism.bodies):
            if body.joints:
                below, arm = self._below(index), self._arms(index)
                forces = self._mass * (pull.own + pull.off)
                found.append([forces[below].sum(), (self._mass * arm.times(pull) + turning)[below].sum()])
        return np.array(found).reshape(-1, 2)

    def _arms(self, body: int) -> Lengths:
        """The way from the origin of a link's frame, past its joints, to every body's centre, (bodies,)."""
        pivots, frames, centres = self._ways
        nearest = pivots[self._first_moved == body].min()
        along = np.maximum(centres - nearest, 0.0) + frames[body] - nearest + EPSILON * centres
        if not self.world:
            return Lengths(along, np.zeros_like(along))
        middle, far, places, _ = self._places()
        about = float(np.linalg.norm(self._moved.position[0, body] - middle[body]))
        return Lengths(np.maximum(along, about + np.linalg.norm(places - middle, axis=-1)), far)

    def _inverted(self, mass: Array, rows: Array, shares: Array, swings: Array) -> Array:
        """What inverting the blocks of balls and free joints adds to the units ``rows``, (nv,)."""
        blocks = Blocks(self.mechanism, self._moves, self._first_moved, self.together)
        return blocks.inverted(mass, rows, shares, swings, self._pull)

    @cached_property
    def _pull(self) -> Array:
        """Gravity's share of each row, (nv,)."""
        return np.asarray(self._weights.sum(axis=1))

    @cached_property
    def _underflow(self) -> float:
        """What underflow may do to a product of masses and lengths, over ε."""
        longest = float((self._levers.own + self._levers.off).max(initial=0.0))
        return SMALLEST * float(1 + self._mass.sum() + self._tensor.sum()) * (1 + longest) ** 2

    @cached_property
    def _underflow_in_motion(self) -> float:
        """The same where accelerations of gravity and of rates multiply it."""
        spin = float((self.once(self.v) @ self._turns).max(initial=0.0))
        return self._underflow * (1 + float(np.linalg.norm(self.mechanism.gravity)) + spin * spin)

    @staticmethod
    def _growth(mass: Array) -> float:
        """The largest entry that the factors of M may have; a pivot below ε of the diagonal is rounding itself."""
        diagonal = np.diag(mass)
        largest = float(diagonal.max(initial=0.0))
        if not largest > 0:
            return 1.0
        try:
            factors = np.linalg.cholesky((mass / largest)[::-1, ::-1])
            least = float(np.diag(factors).min()) ** 2
        except np.linalg.LinAlgError:
            least = 0.0
        return float(np.sqrt(1 / max(least, EPSILON)))

    def _below(self, body: int) -> NDArray[np.bool_]:
        """Whether each body is this one or hangs on it, (bodies,)."""
        found = np.zeros(len(self.mechanism.bodies), dtype=np.bool_)
        for index, other in enumerate(self.mechanism.bodies):
            found[index] = index == body or (other.parent != WORLD and found[other.parent])
        return found

    @cached_property
    def _moved(self) -> spatial_kinematics.Motion:
        if self._known is not None:
            return self._known
        return spatial_kinematics.motion(self.mechanism, self.q[None], self.v[None])

    @cached_property
    def _turns(self) -> Array:
        """w_i where degree of freedom i moves body b, (nv, bodies)."""
        turning = np.ones(self.mechanism.nv, dtype=np.bool_)
        for one in self.mechanism.joints:
            if one.joint.kind == "slide":
                turning[one.at_v] = False
            if one.joint.kind == "free":
                turning[one.columns_v][:3] = False
        return np.asarray(self._moves * turning[:, None])

    @cached_property
    def _moves(self) -> Array:
        """1 where a degree of freedom (row) moves a body (column), else 0."""
        found = np.zeros((self.mechanism.nv, len(self.mechanism.bodies)))
        for one in self.mechanism.joints:
            found[one.columns_v, one.body] = 1
        for index, body in enumerate(self.mechanism.bodies):
            if body.parent != WORLD:
                found[:, index] += found[:, body.parent]
        return found

    @cached_property
    def _ways(self) -> tuple[Array, Array, Array]:
        """Length of the way from the world to each joint's pivot (nv,), to each body's frame and on to its centre.

        Along a body's position, then from one joint's anchor to the next one's, and along what has slid.
        """
        frames = np.zeros(len(self.mechanism.bodies))
        pivots = np.zeros(self.mechanism.nv)
        joints: dict[int, list[int]] = {index: [] for index in range(len(frames))}
        for number, one in enumerate(self.mechanism.joints):
            joints[one.body].append(number)
        for index, body in enumerate(self.mechanism.bodies):
            way = (frames[body.parent] if body.parent != WORLD else 0.0) + float(np.linalg.norm(body.position))
            for number in joints[index]:
                one = self.mechanism.joints[number]
                if one.joint.kind == "free":
                    way = float(np.linalg.norm(self.q[one.columns_q][:3]))
                elif one.joint.kind == "slide":
                    way += abs(self.q[one.at_q]) + abs(one.joint.ref)
                else:
                    way += float(np.linalg.norm(one.joint.anchor))
                pivots[one.columns_v] = way
                if one.joint.kind in ("hinge", "ball"):
                    way += float(np.linalg.norm(one.joint.anchor))
            frames[index] = way
        centres = frames + [float(np.linalg.norm(body.inertial.centre)) for body in self.mechanism.bodies]
        return pivots, frames, centres

    @cached_property
    def _levers(self) -> Lengths:
        """u_ib, (nv, bodies)."""
        pivots, _, centres = self._ways
        along = np.maximum(centres[None] - pivots[:, None], 0.0) + EPSILON * centres[None]  # known no better
        off = np.zeros_like(along)
        if self.world:
            middle, far, places, at = self._places()
            about = np.linalg.norm(at - middle[self._first_moved], axis=-1)[:, None]
            along = np.maximum(along, about + np.linalg.norm(places - middle, axis=-1)[None])
            off = np.broadcast_to(far[None], along.shape)
        if self.origin:
            along = np.maximum(along, pivots[:, None] + centres[None])
        turning = self._turns > 0
        return Lengths(np.where(turning, along, self._moves), np.where(turning, off, 0.0))

    @cached_property
    def _first_moved(self) -> NDArray[np.intp]:
        """The body of each degree of freedom's joint, (nv,)."""
        found = np.zeros(self.mechanism.nv, dtype=np.intp)
        for one in self.mechanism.joints:
            found[one.columns_v] = one.body
        return found

    def _places(self) -> tuple[Array, Array, Array, Array]:
        """For each body the centre of mass of all that hangs together with it and the longest way to any of that.

        And every body's own centre, and each degree of freedom's pivot.
        """
        moved = self._moved
        centres = np.stack([body.inertial.centre for body in self.mechanism.bodies])
        places = moved.position[0] + np.einsum("bik,bk->bi", moved.rotation[0], centres)
        root = np.arange(len(places))
        for index, body in enumerate(self.mechanism.bodies):
            if body.parent != WORLD:
                root[index] = root[body.parent]
        middle, far = np.empty_like(places), np.empty(len(places))
        for which in np.unique(root):
            these = root == which
            weights = self._mass[these] if self._mass[these].sum() > 0 else np.ones(these.sum())
            middle[these] = np.average(places[these], axis=0, weights=weights)
            far[these] = self._ways[2][these].max()
        return middle, far, places, moved.pivot[0]


def magnitudes(mechanism: SpatialMechanism, q: Array, v: Array) -> list[Magnitudes]:
    """Those of each state, ``q`` (B, nq), ``v`` (B, nv): the bodies are placed in all of them at once."""
    moved = spatial_kinematics.motion(mechanism, q, v)
    return [Magnitudes(mechanism, q[k], v[k], moved=moved.of_state(k)) for k in range(len(q))]
