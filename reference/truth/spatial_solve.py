"""Proved accelerations of a mechanism in space in O(n): M x = right, with the mechanism's structure.

One freedom after another is eliminated from the tips. With A the motion of what freedom j hangs on and P the inertia of
all that it carries, eliminated so far, completing the square gives

    (A + s x)·P(A + s x) + a x²  =  d (x + k·A)² + A·P'A,     d = s·Ps + a,   k = Ps/d,   P' = P − d k kᵀ

(a: the armature), hence x·Mx = Σ d_j (x_j + k_j·A_j)². In balls the radii of P would grow by several bits a joint. So
it is done with midpoints, and *proved* afterwards. The numbers d, k stand for a matrix M̂ of their own; what every step
left of its identity is a quadratic form in (A, x) with coefficients that one step's balls enclose. With

    m_j = (M̂⁻¹)_jj   and   C_j,   A_j·y ≤ √(y·C_j y) √(x·M̂x) for every y

(from the support to the tips C ↦ (1 − s kᵀ) C (1 − s kᵀ)ᵀ + s sᵀ/d, m = k·Ck + 1/d) all of them together are at most
θ x·M̂x, with θ the sum of each form's norm times (tr C_j + m_j). Where θ < 1, M ≥ (1 − θ) M̂, and an approximate solution
that leaves the residual ρ is off by at most

    |e_j|  ≤  √m_j Σ_i √m_i |ρ_i| / (1 − θ).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import arb, arb_mat

from ...models.spatial_mechanism import WORLD
from .spatial_motion import Motion, frobenius

ROUNDED_EVERY = 6  # freedoms; the balls of a bound may grow by some 40 bits until they are rounded away
_UNIT = arb_mat([[int(i == k) for k in range(6)] for i in range(6)])


@dataclass(frozen=True)
class _Step:
    """What is kept of a freedom's elimination: s (6, 1) in balls, kᵀ (1, 6) and d exact, the norm of what was left."""

    motion: Any
    share: Any
    pivot: Any
    left: Any


def solution(motion: Motion, right: Sequence[Any]) -> list[Any]:
    """Balls that hold the x with M x = right. Raises ZeroDivisionError where this precision does not show M regular."""
    steps, left = _eliminated(motion)
    found = _substituted(motion, steps, right)
    residual = [r - row for r, row in zip(right, motion.inertial_terms(found), strict=True)]
    roots, share = _compliance(motion, steps, left)
    if not share < 1:
        raise ZeroDivisionError("too few bits to show the mass matrix to be regular")
    reach = sum((root * r.abs_upper() for root, r in zip(roots, residual, strict=True)), arb(0)) / (1 - share)
    return [x + arb(0, (root * reach).abs_upper()) for x, root in zip(found, roots, strict=True)]


def _eliminated(motion: Motion) -> tuple[list[_Step], list[Any]]:
    """The steps in the freedoms' order, and for each group the norm that rounding its inertia left."""
    steps: list[Any] = [None] * len(motion.freedoms)
    carried: list[Any] = list(motion.inertias)
    left: list[Any] = [None] * len(carried)
    j = len(steps)
    for group in reversed(range(len(carried))):
        inertia = carried[group].mid()
        left[group] = frobenius(carried[group] - inertia)
        while j and motion.moves[j - 1] == group:
            j -= 1
            steps[j], inertia = _step(motion.freedoms[j], inertia, motion.armature[j])
        parent = motion.groups[group].parent
        if parent != WORLD:
            carried[parent] = carried[parent] + inertia
    return steps, left


def _step(freedom: Any, inertia: Any, armature: Any) -> tuple[_Step, Any]:
    momentum = inertia * freedom
    exact = (freedom.transpose() * momentum)[0, 0] + armature
    pivot = exact.mid()
    if not pivot > 0:
        raise ZeroDivisionError("a pivot is not positive in this precision")
    share = (momentum.transpose() / pivot).mid()
    after = inertia - share.transpose() * share * pivot
    rest = _symmetric(after)
    left = frobenius(after - rest) + 2 * frobenius(momentum.transpose() - share * pivot) + (exact - pivot).abs_upper()
    return _Step(freedom, share, pivot, left.abs_upper()), rest


def _substituted(motion: Motion, steps: list[_Step], right: Sequence[Any]) -> list[Any]:
    """M̂⁻¹ right, close to it but not proved."""
    n = len(steps)
    forces = [arb_mat(6, 1) for _ in motion.groups]
    scaled: list[Any] = [arb(0)] * n
    for j in reversed(range(n)):
        group, step = motion.moves[j], steps[j]
        rest = (right[j] - (step.motion.transpose() * forces[group])[0, 0]).mid()
        scaled[j] = (rest / step.pivot).mid()
        forces[group] = (forces[group] + step.share.transpose() * rest).mid()
        parent = motion.groups[group].parent
        if parent != WORLD and (j == 0 or motion.moves[j - 1] != group):
            forces[parent] = (forces[parent] + forces[group]).mid()
    swings: list[Any] = []
    found: list[Any] = []
    for j, step in enumerate(steps):
        group = motion.moves[j]
        if group == len(swings):
            parent = motion.groups[group].parent
            swings.append(swings[parent] if parent != WORLD else arb_mat(6, 1))
        found.append((scaled[j] - (step.share * swings[group])[0, 0]).mid())
        swings[group] = (swings[group] + step.motion * found[j]).mid()
    return found


def _compliance(motion: Motion, steps: list[_Step], left: list[Any]) -> tuple[list[Any], Any]:
    """An upper bound of every √m_j, and θ."""
    nothing = arb_mat(6, 6)
    share = arb(0)
    after: list[Any] = []  # C of each group, not below the true one
    roots: list[Any] = []
    j = 0
    for group, off in zip(motion.groups, left, strict=True):
        before = after[group.parent] if group.parent != WORLD else nothing
        while j < len(steps) and motion.moves[j] == len(after):
            step = steps[j]
            turned = before * step.share.transpose()
            own = ((step.share * turned)[0, 0] + 1 / step.pivot).abs_upper()
            share += step.left * (before.trace() + own)
            roots.append(own.sqrt().abs_upper())
            mixed = step.motion * turned.transpose()
            spread = step.motion * step.motion.transpose() * own
            before = before - mixed - mixed.transpose() + spread
            j += 1
            if j % ROUNDED_EVERY == 0:
                before = _not_below(before)
        share += off * before.trace()
        after.append(before)
    return roots, share


def _not_below(matrix: Any) -> Any:
    """An exact symmetric matrix that is not below any of those in the balls."""
    middle = _symmetric(matrix)
    off = frobenius(matrix - middle)
    return middle + _UNIT * off


def _symmetric(matrix: Any) -> Any:
    """An exact symmetric matrix close to this one."""
    return ((matrix + matrix.transpose()) / 2).mid()
