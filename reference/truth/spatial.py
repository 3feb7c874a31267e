"""The theory of any mechanism in space, in ball arithmetic: what an engine should compute in one state.

    M(q) a + bias(q, v) = passive(q, v) + torque

M has the armature on its diagonal; the bias is that of velocity and gravity; passive forces are −damping·v and the
springs'; dry friction, limits and contacts are left out. Coordinates and rates are MuJoCo's, as
:mod:`furiko.models.spatial_mechanism` has them; every double is taken as exact, and a quaternion stands for the
rotation of its direction. The motion itself is in :mod:`.spatial_motion`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.spatial_mechanism import PlacedJoint, SpatialMechanism
from ..arithmetic import Array
from .enclosures import BITS, MOST_BITS, RELATIVE_RADIUS, Enclosure, precision, rounded
from .spatial_motion import Motion, frobenius
from .spatial_solve import solution

Floats = NDArray[np.float64]

BODIES_PER_BIT = 8  # a chain of a thousand hinges needs some 140 bits; more bits cost less than a second attempt


@dataclass(frozen=True, eq=False)
class BallArray:
    """An array of ``balls`` (python-flint's arb), each of which holds the true value."""

    balls: Array

    @classmethod
    def symmetric(cls, entries: Array, places: Sequence[tuple[int, int]], size: int) -> BallArray:
        """The symmetric matrix (size, size) with these ``entries`` at ``places`` and zeros elsewhere.

        Only the entries are rounded, and once: of three hundred free bodies all but one in three hundred are zero.
        """
        if not places:
            return cls(np.full((size, size), arb(0), dtype=object))
        rows, columns = np.array(places).T

        def filled(values: Any, kind: Any, zero: Any) -> Any:
            full = np.full((size, size), zero, dtype=kind)
            full[rows, columns] = full[columns, rows] = values
            return full

        made = cls(filled(entries, object, arb(0)))
        parts = [filled(part, np.float64, 0.0) for part in rounded(entries)]
        made.__dict__["enclosure"] = Enclosure(*parts)  # where the property keeps it
        return made

    @cached_property
    def enclosure(self) -> Enclosure:
        """The same as two doubles and a radius for each number."""
        return Enclosure(*rounded(self.balls))

    @property
    def float(self) -> Floats:
        """The nearest doubles."""
        return self.enclosure.high

    @cached_property
    def radius(self) -> Floats:
        """How far the true values are from :attr:`float` at most."""
        return np.asarray(self.enclosure.error(self.float))


class SpatialTruth:
    """A mechanism's terms in one state, each computed when it is first asked for.

    Numbers are proved to ``2⁻⁸⁰`` of the largest of their array, or of the largest that was added up to it, and where
    the first precision does not do, it is raised. ArithmeticError where no precision does: accelerations where M is
    singular.
    """

    def __init__(self, mechanism: SpatialMechanism, q: Floats, v: Floats, torque: Floats, bits: int) -> None:
        self.mechanism, self.q, self.v, self.torque = mechanism, q, v, torque
        self._bits = bits + mechanism.nv // BODIES_PER_BIT
        self._motions: dict[int, Motion] = {}

    @cached_property
    def mass_matrix(self) -> BallArray:
        """M, (nv, nv)."""

        places: list[tuple[int, int]] = []

        def entries(motion: Motion) -> tuple[list[Any], float]:
            found = motion.mass_entries()
            places[:] = found
            return list(found.values()), 0.0

        proved = self._proved(entries)
        return BallArray.symmetric(proved, places, self.mechanism.nv)

    @cached_property
    def velocity(self) -> BallArray:
        """The bias without gravity, (nv,)."""
        return BallArray(self._proved(self._velocity))

    @cached_property
    def gravity(self) -> BallArray:
        """The bias of gravity, (nv,): what holds the mechanism at rest."""
        return BallArray(self._proved(self._gravity))

    @cached_property
    def bias(self) -> BallArray:
        """Velocity and gravity terms, (nv,)."""
        return BallArray(self._proved(self._bias))

    @cached_property
    def passive(self) -> BallArray:
        """Forces of dampers and springs, (nv,)."""
        return BallArray(self._proved(lambda motion: (self._passive(), 0.0)))

    @cached_property
    def accelerations(self) -> BallArray:
        """a, (nv,)."""
        usual = float(np.linalg.norm(self.mechanism.gravity) + np.square(self.v).max(initial=0.0))

        def solved(motion: Motion) -> tuple[list[Any], float]:
            return solution(motion, self._right(motion)), usual

        return BallArray(self._proved(solved))

    def joint_forces(self, accelerations: Floats) -> BallArray:
        """Force [N] and moment [N m] of each moving link on what carries it, in these accelerations (nv,); (links, 6).

        In the order of the links that have joints, in the world's axes, the moment about the origin of the link's
        frame. All that acts in its joints is in it, dampers and springs too; what turns rotors (armature) is not.
        """
        given = [arb(a) for a in np.asarray(accelerations, dtype=np.float64).tolist()]
        gravity = self.mechanism.gravity.tolist()

        def numbers(motion: Motion) -> tuple[list[Any], float]:
            found = motion.wrenches(given, gravity)
            weights = sum((abs(inertia[3, 3]) for inertia in motion.inertias), arb(0)) * max(map(abs, gravity))
            return [entry for wrench in found for entry in wrench.entries()], float(weights.abs_upper())

        return BallArray(self._proved(numbers).reshape(-1, 6))

    def residual(self, accelerations: Floats) -> BallArray:
        """M a + bias − passive − torque, (nv,), for an engine's accelerations a (nv,)."""
        given = [arb(a) for a in np.asarray(accelerations, dtype=np.float64).tolist()]

        def left(motion: Motion) -> tuple[list[Any], float]:
            inertial, right = motion.inertial_terms(given), self._right(motion)
            added = max((float(abs(x).upper()) for x in (*inertial, *right)), default=0.0)
            return [i - r for i, r in zip(inertial, right, strict=True)], added

        return BallArray(self._proved(left))

    def _right(self, motion: Motion) -> list[Any]:
        """passive + torque − bias."""
        bias, _ = self._bias(motion)
        return [p + t - b for p, t, b in zip(self._passive(), self.torque.tolist(), bias, strict=True)]

    def _bias(self, motion: Motion) -> tuple[list[Any], float]:
        (velocity, one), (gravity, other) = self._velocity(motion), self._gravity(motion)
        return [v + g for v, g in zip(velocity, gravity, strict=True)], max(one, other)

    def _velocity(self, motion: Motion) -> tuple[list[Any], float]:
        rates = max((float(frobenius(rate)) for rate in motion.momentum_rates), default=0.0)
        return motion.velocity_terms(), float(frobenius(motion.partial)) * rates

    def _gravity(self, motion: Motion) -> tuple[list[Any], float]:
        gravity = self.mechanism.gravity.tolist()
        return motion.gravity_terms(gravity), float(frobenius(motion.momenta)) * max(map(abs, gravity))

    def _passive(self) -> list[Any]:
        damping = self.mechanism.per_freedom("damping").tolist()
        found = [-arb(d) * rate for d, rate in zip(damping, self.v.tolist(), strict=True)]
        for placed in self.mechanism.joints:
            if placed.joint.stiffness:
                stiffness = arb(placed.joint.stiffness)
                for k, stretch in enumerate(_stretches(self.mechanism, placed, self.q)):
                    found[placed.at_v + k] -= stiffness * stretch
        return found

    def _proved(self, quantity: Callable[[Motion], tuple[list[Any], float]]) -> Array:
        """The balls of ``quantity``, narrow beside the largest of them or the number that comes with them."""

        def attempt(bits: int) -> tuple[list[Any], float]:
            if bits not in self._motions:
                self._motions[bits] = Motion(self.mechanism, self.q, self.v, bits)
            return quantity(self._motions[bits])

        return _narrow(attempt, self._bits)


def spatial_truth(
    mechanism: SpatialMechanism, q: Floats, v: Floats, torque: Floats | None = None, bits: int = BITS
) -> SpatialTruth:
    """The theory's terms of ``mechanism`` in the state ``q`` (nq,), ``v`` (nv,), under ``torque`` (nv,), zero if None.

    ``torque``: generalised forces [N m or N] in the coordinates of v. ``bits``: the working precision, raised where it
    does not do. Raises :class:`InvalidInput` for another shape, a number that is not finite, or a quaternion or axis of
    length zero.
    """
    state = [
        np.asarray(part, dtype=np.float64) for part in (q, v, np.zeros(mechanism.nv) if torque is None else torque)
    ]
    for name, part, size in zip(("q", "v", "torque"), state, (mechanism.nq, *(mechanism.nv,) * 2), strict=True):
        if part.shape != (size,):
            raise InvalidInput(f"{name}: {size} numbers are needed, got an array of shape {part.shape}")
        if not np.isfinite(part).all():
            raise InvalidInput(f"{name}: every number must be finite")
    _check(mechanism, state[0])
    return SpatialTruth(mechanism, state[0], state[1], state[2], bits)


def energy(mechanism: SpatialMechanism, q: Floats, v: Floats, bits: int = BITS) -> BallArray:
    """Kinetic and potential energy [J], (2,), of one state as in :func:`spatial_truth`.

    Kinetic with the armatures'; potential −Σ m g·c of all that moves, and the springs' ½ k × stretch².
    """
    truth = spatial_truth(mechanism, q, v)
    sprung = [placed for placed in mechanism.joints if placed.joint.stiffness]

    def both(bits: int) -> tuple[list[Any], float]:
        motion = Motion(mechanism, truth.q, truth.v, bits)
        springs = arb(0)
        for placed in sprung:
            for stretch in _stretches(mechanism, placed, truth.q):
                springs += arb(placed.joint.stiffness) * stretch * stretch / 2
        height, added = motion.height_energy(mechanism.gravity.tolist())
        kinetic = motion.kinetic_energy([arb(rate) for rate in truth.v.tolist()])
        return [kinetic, height + springs], float(added)

    return BallArray(_narrow(both, bits))


def _check(mechanism: SpatialMechanism, q: Floats) -> None:
    """Raise InvalidInput where a quaternion or an axis has no direction."""
    for body in mechanism.bodies:
        if not np.any(body.quaternion):
            raise InvalidInput(f"body {body.name!r}: its quaternion has length zero")
    for placed in mechanism.joints:
        joint = placed.joint
        if joint.kind in ("hinge", "slide") and not np.any(joint.axis):
            raise InvalidInput(f"joint {joint.name!r}: its axis has length zero")
        if joint.kind in ("ball", "free") and not np.any(q[placed.columns_q][-4:]):
            raise InvalidInput(f"joint {joint.name!r}: its quaternion in q has length zero")


def _stretches(mechanism: SpatialMechanism, placed: PlacedJoint, q: Floats) -> list[Any]:
    """How far a joint's spring is from rest, for each of its freedoms.

    A rotation's is that of its angle, at most π, along its axis, in the body's axes.
    """
    here = q[placed.columns_q].tolist()
    if placed.joint.kind in ("hinge", "slide"):
        return [arb(here[0]) - arb(placed.joint.springref)]
    if placed.joint.kind == "ball":
        return _rotation_vector([1.0, 0.0, 0.0, 0.0], here)
    body = mechanism.bodies[placed.body]
    shift = [arb(x) - arb(rest) for x, rest in zip(here[:3], body.position.tolist(), strict=True)]
    return shift + _rotation_vector(body.quaternion.tolist(), here[3:])


def _rotation_vector(rest: list[float], here: list[float]) -> list[Any]:
    """The rotation from one quaternion's direction to the other's as a vector in the turned axes [rad].

    With (w, r) the quotient of the quaternions, it is 2 r/w · atan(t)/t with t = |r|/|w|, and 1 − t²/3 ≤ atan(t)/t ≤ 1.
    """
    a, b, c, d = (arb(x) for x in rest)
    e, f, g, h = (arb(x) for x in here)
    w = a * e + b * f + c * g + d * h
    r = (
        a * f - b * e - c * h + d * g,
        a * g + b * h - c * e - d * f,
        a * h - b * g + c * f - d * e,
    )
    length = sum((part * part for part in r), arb(0)).sqrt()
    if w.is_zero():  # half a turn: either way round is as near, and MuJoCo takes this one
        return [arb.pi() * part / length for part in r]
    if w.contains(0):
        raise ZeroDivisionError("too few bits to tell which way round a rotation is shorter")
    t = length / abs(w)
    ratio = _near_one(t) if t.contains(0) else t.atan() / t
    return [2 * part / w * ratio for part in r]


def _near_one(t: Any) -> Any:
    """atan(t)/t for a ball about zero."""
    return arb(1, (t.abs_upper() ** 2 / 3).abs_upper())


def _narrow(attempt: Callable[[int], tuple[list[Any], float]], bits: int) -> Array:
    """The balls of the first attempt of which all are narrow enough, in ever more bits."""
    while True:
        try:
            with precision(bits):
                found, added = attempt(bits)
                widest = max((float(ball.rad()) for ball in found), default=0.0)
                largest = max((float(abs(ball).upper()) for ball in found), default=0.0)
        except ZeroDivisionError:  # balls too wide to divide by
            found, widest, largest, added = [], np.inf, 0.0, 0.0
        if widest <= RELATIVE_RADIUS * max(largest, added) < np.inf:
            return np.array(found, dtype=object)
        if bits >= MOST_BITS:
            raise ArithmeticError(
                f"no enclosure of this state with {bits} bits: its mass matrix is singular, or its numbers differ too "
                "much in size"
            )
        bits *= 2
