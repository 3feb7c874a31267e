"""Inverse and forward dynamics in spatial vectors, for joints in Monte-Carlo arithmetic.

With r from the parent's point to the joint's, S a freedom's motion at its point, I a body's inertia there,

    v = v_p + S q̇,    a = a_p + v_p × S q̇ + S q̈,    F = I a + v ×* I v,    τ = S·F,

and for articulated bodies the kernels' own steps, all freedoms of a joint at once (R. Featherstone, Rigid Body Dynamics
Algorithms, 2008, chapters 5 and 7).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..kernels.trees.formulas import ARM, SHIFT, TURN, moved, reduced
from ..kernels.trees.vectors import add, cross, dot, full, plus_cross, scaled, times, transposed, upper
from .joints import Freedoms, Joint, Placed, Run, placed_joints

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Moving:
    """v = (ω, u) of a joint's body at its point, and c = v_p × S q̇, the acceleration that rates alone make."""

    omega: list[Any]
    speed: list[Any]
    turn: list[Any]
    shift: list[Any]


def along(freedoms: Freedoms, rates: list[Any] | dict[int, Any]) -> list[Any]:
    """Σ s_k times the rate of each freedom."""
    total: list[Any] = [0.0, 0.0, 0.0]
    for column, axis in freedoms:
        total = add(total, scaled(rates[column], axis))
    return total


def columns(run: Run, values: Array) -> list[Any]:
    """A number of every sample and state for each column of values (B, n)."""
    return [run.state(values[:, k]) for k in range(values.shape[1])]


def _motions(placed: list[Placed], rates: list[Any]) -> list[Moving]:
    """The motion of each joint's body."""
    found: list[Moving] = []
    for one in placed:
        joint = one.joint
        omega, speed = ([0.0] * 3, [0.0] * 3)
        if joint.parent >= 0:
            before = found[joint.parent]
            omega, speed = before.omega, plus_cross(before.speed, before.omega, one.arm)
        spin, push, slip = (along(freedoms, rates) for freedoms in (joint.turns, one.pushes, joint.slides))
        sliding = add(speed, slip)  # a free joint slides first
        shift = plus_cross(cross(omega, add(push, slip)), sliding, spin)
        found.append(Moving(add(omega, spin), add(sliding, push), cross(omega, spin), shift))
    return found


def _velocity_force(one: Placed, moving: Moving) -> tuple[list[Any], list[Any]]:
    """v ×* I v, as moment and force."""
    about, along = one.times_inertia(moving.omega, moving.speed)
    return plus_cross(cross(moving.omega, about), moving.speed, along), cross(moving.omega, along)


def inverse_dynamics(run: Run, placed: list[Placed], v: Array, accelerations: Array, gravity: list[float]) -> list[Any]:
    """Generalised forces, one of each freedom."""
    swings, motions = columns(run, accelerations), _motions(placed, columns(run, v))
    falling: list[tuple[list[Any], list[Any]]] = []
    forces: list[tuple[list[Any], list[Any]]] = []
    for one, moving in zip(placed, motions, strict=True):
        joint = one.joint
        alpha, a = falling[joint.parent] if joint.parent >= 0 else ([0.0] * 3, [-g for g in gravity])
        a = add(add(plus_cross(a, alpha, one.arm), moving.shift), along(one.pushes, swings))
        a = add(a, along(joint.slides, swings))
        alpha = add(add(alpha, moving.turn), along(joint.turns, swings))
        falling.append((alpha, a))
        (torque, force), (turned, pushed) = one.times_inertia(alpha, a), _velocity_force(one, moving)
        forces.append((add(torque, turned), add(force, pushed)))
    for number in reversed(range(len(forces))):
        one, (torque, force) = placed[number], forces[number]
        if one.joint.parent >= 0:
            torque_p, force_p = forces[one.joint.parent]
            forces[one.joint.parent] = plus_cross(add(torque_p, torque), one.arm, force), add(force_p, force)
    found: dict[int, Any] = {}
    for one, (torque, force) in zip(placed, forces, strict=True):
        for (column, axis), (_, push) in zip(one.joint.turns, one.pushes, strict=True):
            found[column] = dot(axis, torque) + dot(push, force)
        found |= {column: dot(axis, force) for column, axis in one.joint.slides}
    return [
        found[column] + armature * swing if armature else found[column]
        for column, (swing, armature) in enumerate(zip(swings, run.armature.tolist(), strict=True))
    ]


def forward_dynamics(run: Run, v: Array, forces: list[Any], gravity: list[float]) -> list[Any]:
    """Accelerations by articulated bodies, each at its joint's own point."""
    placed = placed_joints(run, "hinge")
    motions = _motions(placed, columns(run, v))
    bodies = [_body(one, moving) for one, moving in zip(placed, motions, strict=True)]
    gone: dict[int, tuple[Any, list[Any]]] = {}  # of each freedom: k and w
    for number in reversed(range(len(placed))):
        joint, moving = placed[number].joint, motions[number]
        left = _eliminated(run, joint, bodies[number], forces, gone)
        if joint.parent >= 0:
            shifted = moved(_Shift(joint.arm, moving.turn, moving.shift), 0, left)
            bodies[joint.parent] = _parts([a + b for a, b in zip(_flat(bodies[joint.parent]), shifted, strict=True)])
    found: dict[int, Any] = {}
    falling: list[tuple[list[Any], list[Any]]] = []
    for one, moving in zip(placed, motions, strict=True):
        joint = one.joint
        alpha, a = falling[joint.parent] if joint.parent >= 0 else ([0.0] * 3, [-g for g in gravity])
        a = add(plus_cross(a, alpha, one.arm), moving.shift)
        alpha = add(alpha, moving.turn)
        for column, _ in joint.turns + joint.slides:
            swing, share = gone[column]
            for part, motion in zip(share, [*alpha, *a], strict=True):
                swing = swing - part * motion
            found[column] = swing
        falling.append((add(alpha, along(joint.turns, found)), add(a, along(joint.slides, found))))
    return [found[column] for column in range(len(forces))]


def _body(one: Placed, moving: Moving) -> tuple[Any, ...]:
    """A, B, M, n₀, f₀ of a body alone."""
    (x, y, z), mass = one.moment, one.joint.mass
    B = [0.0, -z, y, z, 0.0, -x, -y, x, 0.0]
    return (upper(one.tensor), B, [mass, 0.0, 0.0, mass, 0.0, mass], *_velocity_force(one, moving))


def _flat(parts: tuple[Any, ...]) -> list[Any]:
    return [number for part in parts for number in part]


def _parts(numbers: list[Any]) -> tuple[Any, ...]:
    return numbers[:6], numbers[6:15], numbers[15:21], numbers[21:24], numbers[24:]


def _eliminated(
    run: Run, joint: Joint, before: tuple[Any, ...], forces: list[Any], gone: dict[int, tuple[Any, list[Any]]]
) -> tuple[Any, ...]:
    """The inertia less what a joint's freedoms take out of it, all at once; k and w of each are kept in ``gone``.

    With U = I S, D = Sᵀ U + armature: w = U D⁻¹, k = D⁻¹ (τ − Sᵀ p), the inverse by Cholesky's factors.
    """
    A, B, M, n, f = before
    columns = [column for column, _ in joint.turns + joint.slides]
    u = [(times(full(A), axis), times(transposed(B), axis)) for _, axis in joint.turns]
    u += [(times(B, axis), times(full(M), axis)) for _, axis in joint.slides]

    def along(motion: tuple[Any, Any]) -> list[Any]:
        return [dot(axis, motion[0]) for _, axis in joint.turns] + [dot(axis, motion[1]) for _, axis in joint.slides]

    block = [along(pair) for pair in u]
    for i, column in enumerate(columns):
        block[i][i] = block[i][i] + float(run.armature[column])
    inverse = _inverse(block)
    left = [forces[column] - bias for column, bias in zip(columns, along((n, f)), strict=True)]
    after = before
    for i, column in enumerate(columns):
        share: tuple[list[Any], list[Any]] = ([0.0] * 3, [0.0] * 3)
        k: Any = 0.0
        for j, (turned, pushed) in enumerate(u):
            share = add(share[0], scaled(inverse[i][j], turned)), add(share[1], scaled(inverse[i][j], pushed))
            k = k + inverse[i][j] * left[j]
        gone[column] = k, [*share[0], *share[1]]
        after = reduced(after, u[i], (*share, k))
    return after


def _inverse(matrix: list[list[Any]]) -> list[list[Any]]:
    """The inverse of a positive definite matrix: of its Cholesky factor, times itself."""
    size = len(matrix)
    if size == 1:
        return [[1.0 / matrix[0][0]]]
    factor: list[list[Any]] = [[0.0] * size for _ in range(size)]
    inverse: list[list[Any]] = [[0.0] * size for _ in range(size)]  # of the factor
    for i in range(size):
        for j in range(i + 1):
            rest = matrix[i][j]
            for k in range(j):
                rest = rest - factor[i][k] * factor[j][k]
            factor[i][j] = rest.sqrt() if i == j else rest / factor[j][j]
        for j in range(i + 1):
            rest = 1.0 if i == j else 0.0
            for k in range(j, i):
                rest = rest - factor[i][k] * inverse[k][j]
            inverse[i][j] = rest / factor[i][i]
    found: list[list[Any]] = [[0.0] * size for _ in range(size)]
    for i in range(size):
        for j in range(size):
            for k in range(max(i, j), size):
                found[i][j] = found[i][j] + inverse[k][i] * inverse[k][j]
    return found


@dataclass(frozen=True)
class _Shift:
    """What the kernels' formula for going to the parent's point reads of a joint."""

    arm: list[Any]
    turn: list[Any]
    shift: list[Any]

    def read(self, place: int, first: int, count: int) -> list[Any]:
        return {ARM: self.arm, TURN: self.turn, SHIFT: self.shift}[first]
