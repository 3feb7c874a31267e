"""Derivatives of the accelerations of an open mechanism of hinges and slides, exact, in ball arithmetic.

Newton's and Euler's equations at the world's origin, as in :mod:`.spatial_motion`: with s_i the motion of freedom i for
a unit rate, V and A a group's velocity and acceleration (gravity's in it), 𝕀 its inertia about the origin, and the sums
over the freedoms that move it,

    V = Σ s_i v_i,   A = −g + Σ (s_i a_i + V_i × s_i v_i),   f = 𝕀 A + V ×* 𝕀 V,   τ_i = s_i · Σ f of all that i moves.

A coordinate q_k displaces all that it moves as one rigid body, by s_k. So ∂s_i/∂q_k = s_k × s_i for the freedoms i
behind k, ∂𝕀/∂q_k = s_k ×* 𝕀 − 𝕀 s_k ×, and the rest follows by the product rule: nothing is differenced. All columns k
are carried along at once. As τ less the passive forces stays zero, M ∂a/∂q = −∂τ/∂q, and for v likewise.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.spatial_mechanism import WORLD, SpatialMechanism
from ..arithmetic import Array
from . import enclosures as proved
from .derivatives import Derivatives
from .spatial import BODIES_PER_BIT
from .spatial_motion import Motion, crossing
from .spatial_solve import solution

Floats = NDArray[np.float64]


def spatial_derivatives(mechanism: SpatialMechanism, q: Floats, v: Floats) -> Derivatives:
    """∂a/∂q, ∂a/∂v and M⁻¹ of ``mechanism``, dampers and springs included, in the state ``q``, ``v`` (nv,) each.

    Enclosures of shape (nv, nv), proved to 2⁻⁸⁰ of each matrix' largest entry. Raises :class:`InvalidInput` for balls
    and free joints, whose positions have other derivatives in every convention; ArithmeticError where M is singular.
    """
    if any(placed.joint.kind not in ("hinge", "slide") for placed in mechanism.joints):
        raise InvalidInput("derivatives are those of hinges and slides")
    bits = proved.BITS + mechanism.nv // BODIES_PER_BIT
    parts = proved.enclosed(partial(_in_balls, mechanism, q, v), bits)
    return Derivatives(*(proved.Enclosure(*matrix) for matrix in zip(*parts, strict=True)))


def _in_balls(mechanism: SpatialMechanism, q: Floats, v: Floats, bits: int) -> Array:
    motion, n = Motion(mechanism, q, v, bits), mechanism.nv
    damping, stiffness = (mechanism.per_freedom(what).tolist() for what in ("damping", "stiffness"))
    gravity = mechanism.gravity.tolist()
    bias = zip(motion.velocity_terms(), motion.gravity_terms(gravity), strict=True)
    stretches: list[Any] = [0.0] * n
    for placed in mechanism.joints:
        stretches[placed.at_v] = arb(float(q[placed.at_q])) - arb(placed.joint.springref)
    springs = [stiffness[j] * stretches[j] + damping[j] * arb(float(v[j])) for j in range(n)]
    a = solution(motion, [-one - other - spring for (one, other), spring in zip(bias, springs, strict=True)])
    of_positions, of_rates = _forces(motion, [arb(float(rate)) for rate in v], a, gravity)
    for j in range(n):
        of_positions[j, j] += arb(stiffness[j])
        of_rates[j, j] += arb(damping[j])
    mass = arb_mat(n, n)
    for (i, j), entry in motion.mass_entries().items():
        mass[i, j] = mass[j, i] = entry
    matrices = (-of_positions, -of_rates, arb_mat(n, n, [int(i == k) for i in range(n) for k in range(n)]))
    return np.array([mass.solve(right).tolist() for right in matrices], dtype=object).reshape(3, n, n)


def _forces(motion: Motion, v: list[Any], a: list[Any], gravity: list[float]) -> tuple[Any, Any]:
    """∂τ/∂q and ∂τ/∂v of M a + bias, (nv, nv), rates and accelerations held."""
    n, count = len(v), len(motion.groups)
    nothing = arb_mat(6, n)
    # Of each group: velocity, acceleration, their derivatives by q and by v, and the motions that move it, as columns.
    rest = (arb_mat(6, 1), arb_mat(6, 1, [0, 0, 0, *(-arb(g) for g in gravity)]), *(nothing,) * 5)
    states: list[tuple[Any, ...]] = []
    turned: list[Any] = []  # ∂s_i/∂q
    at = 0
    for index, group in enumerate(motion.groups):
        velocity, swing, v_q, a_q, v_v, a_v, path = states[group.parent] if group.parent != WORLD else rest
        while at < n and motion.moves[at] == index:
            s, across = motion.freedoms[at], _cross(motion.freedoms[at])
            s_q = -across * path
            velocity = velocity + s * v[at]
            drift = _cross(velocity) * s
            v_q, v_v = v_q + s_q * v[at], v_v + _at_column(s, at, n)
            swing = swing + s * a[at] + drift * v[at]
            a_q = a_q + s_q * a[at] + (_cross(velocity) * s_q - across * v_q) * v[at]
            a_v = a_v - across * v_v * v[at] + _at_column(drift, at, n)
            path = path + _at_column(s, at, n)
            turned.append(s_q)
            at += 1
        states.append((velocity, swing, v_q, a_q, v_v, a_v, path))
    forces: list[tuple[Any, ...]] = []
    for inertia, (velocity, swing, v_q, a_q, v_v, a_v, path) in zip(motion.inertias, states, strict=True):
        momentum, push, turn = inertia * velocity, inertia * swing, -_cross(velocity).transpose()
        moved = _exchanged(momentum) + inertia * _cross(velocity)
        by_q = inertia * a_q + (_exchanged(push) + inertia * _cross(swing)) * path
        by_q = by_q + _exchanged(momentum) * v_q + turn * (moved * path + inertia * v_q)
        by_v = inertia * a_v + _exchanged(momentum) * v_v + turn * (inertia * v_v)
        forces.append((push + turn * momentum, by_q, by_v))
    for number in reversed(range(count)):
        parent = motion.groups[number].parent
        if parent != WORLD:
            forces[parent] = tuple(x + y for x, y in zip(forces[parent], forces[number], strict=True))
    of_q, of_v = arb_mat(n, n), arb_mat(n, n)
    for i, (moved_first, s) in enumerate(zip(motion.moves, motion.freedoms, strict=True)):
        force, by_q, by_v = forces[moved_first]
        row_q = s.transpose() * by_q + force.transpose() * turned[i]
        row_v = s.transpose() * by_v
        for k in range(n):
            of_q[i, k], of_v[i, k] = row_q[0, k], row_v[0, k]
    return of_q, of_v


def _at_column(vector: Any, column: int, n: int) -> Any:
    found = arb_mat(6, n)
    for row in range(6):
        found[row, column] = vector[row, 0]
    return found


def _blocks(a: Any, b: Any, c: Any, d: Any) -> Any:
    top = zip(a.tolist(), b.tolist(), strict=True)
    return arb_mat([x + y for x, y in (*top, *zip(c.tolist(), d.tolist(), strict=True))])


def _cross(motion: Any) -> Any:
    """The matrix with [V]× s = V × s, of motions; its transpose's negative is V ×* of forces."""
    parts = motion.entries()
    turn = crossing(parts[:3])
    return _blocks(turn, arb_mat(3, 3), crossing(parts[3:]), turn)


def _exchanged(force: Any) -> Any:
    """The matrix with (s ×* p) = [p] s, of a force or momentum p."""
    parts = force.entries()
    turn = crossing(parts[3:])
    return -_blocks(crossing(parts[:3]), turn, turn, arb_mat(3, 3))
