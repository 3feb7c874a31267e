"""The largest difference that rounding explains: bounds derived from the arithmetic, no tolerance typed in.

An engine that is right computes the exact answer of a slightly wrong problem: the mass matrix, the bias and the
angles it effectively used are off by roundings. So the residual that its accelerations leave in the true equations of
motion, row by row, is compared with the sum of the magnitudes of that row's terms (the *backward error*). It does not
depend on how ill-conditioned the problem is. It is taken in the engine's own coordinates, since rounding happens
there: with x the accelerations, M the mass matrix and b the bias (velocity and gravity terms) in those coordinates,

    |M x + b|_i  <=  c n ε  ( Σ_j sqrt(W_ii W_jj) |x_j|  +  β_i ).

W is M with every cosine one, which for these mechanisms is the chain stretched out straight: positive semidefinite and
entrywise not below |M|, so that sqrt(W_ii W_jj) bounds the factors' product in Cholesky's backward error (Higham,
Accuracy and Stability of Numerical Algorithms, theorem 10.3). β is the sum of the magnitudes of the bias' terms with
every sine one: an angle is known to ε, so a sine near zero is not known relatively better than that.

In absolute angles the velocity terms are those of the documents, Σ_j W_ij ω_j². In relative ones an engine gets them by
spatial algebra, from terms that are far larger than their sum. With F_k the sum of |q̇_a| over the hinges on the path to
link k, with V_k and U_k the same sum weighted by the lengths (:mod:`.lever_arms`) from hinge a to the point about which
link k's moments are taken and on to its centre of mass: the point's velocity is at most V_k, the momentum m_k U_k. The
acceleration that hinge a adds is its motion times q̇_a, turned with F_a and moved with V_a, together at most 2 F_k V_k.
The force is m_k (2 F_k V_k) and the momentum turned, m_k F_k U_k. The moment about the point is that force's,
and the velocity times the momentum: in v × m(v + ω × r) the v × m v cancels but for its rounding, m_k V_k U_k. With
A_ik the arm of the force about hinge i and inertias likewise (ω × Iω), the rows are

    β_i  =  Σ_{k in subtree i}  m_k (F_k (2 V_k + U_k) A_ik + V_k U_k) + I_k F_k²   + gravity.

An engine that takes all moments about the centre of mass of the whole tree has longer arms, and lengths that are known
less well than to their own ε: the products of two lengths, in W and in β, are then joined by those of one length and
the other's error, in units of ε.

All this is of numbers whose rounding is relative. A product or quotient below the smallest normal number is off by up
to half of the smallest positive one, η = ε × the smallest normal number, and this is multiplied by what the term is
still to be multiplied by. In which order an engine takes the factors it keeps to itself; whatever is left of them is at
most (1 + m)(1 + A)²(1 + g + swing), with m all mass, A the longest arm, swing the largest sum of an acceleration and a
squared rate. In the solution the factors L of M = LᵀDL come in besides: eliminated from the tips, a pivot D_j is at
least link j's own inertia about its hinge, w_j, and L_ji² ≤ W_ii / w_j.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, PlanarTree
from ...models.coordinates import absolute_from_relative
from ...models.states import QUANTUM, quantised
from .. import mass_matrix
from .lever_arms import (
    Levers,
    absolute_levers,
    longest,
    relative_levers,
    tree_levers,
    world_errors,
    world_levers,
)

Array = NDArray[np.float64]

EPSILON = 2.0**-52
SMALLEST = 2.0**-1022  # normal number
CACHED = 400_000  # numbers
BLOCK = 32  # columns eliminated one by one before the others follow

# Roundings that a term passes on its way through one link: sine and cosine (1 each) and their error's effect (1), a
# rotation and a shift of a spatial vector or inertia (6), its product with the inertia (3), its addition (1), and as
# much again for the sweep back.
ROUNDINGS_PER_LINK = 26


def allowed(n: int, accuracy: float = EPSILON) -> float:
    """The largest backward error that n links' roundings explain, in units of ε."""
    return ROUNDINGS_PER_LINK * n * accuracy / EPSILON


def turns(theta: Array) -> Array:
    """The factor by which rounded angles raise the backward error at each state, (B,) from (B, n).

    An engine is given θ_i − θ_parent, to ε/2 of a difference of at most 2|θ|: n of them on the path to a link put its
    angle off by nε|θ|, and the cosine of two links' by twice that. Up to half a turn this is a small part of 26 n ε;
    beyond, 26 n ε |θ|/π has room for it. Multiples of one power of two, if not too large, have exact differences.
    """
    largest = np.abs(theta).max(axis=-1, initial=0.0)
    exact = (quantised(theta) == theta).all(axis=-1) & (largest < QUANTUM / EPSILON)
    return np.where(exact, 1.0, np.maximum(1.0, largest / np.pi))


@dataclass(frozen=True)
class Amplitudes:
    """The magnitudes of a system's terms, in one set of coordinates.

    ``to_absolute``: S, with θ = S q, shape (n, n); ``carried``: 1 where a link (row) hangs below a link (column) or is
    it; ``levers``: the lengths that enter; ``errors``: what they are off by, in units of ε, where that is more than
    themselves; ``interchanges``: whether rows are interchanged in the solution; ``mass`` [kg], ``inertia`` [kg m²] and
    ``pivots``, the inertia about its own hinge, of each link, (n,); ``gravity`` [m/s²].
    """

    to_absolute: Array
    carried: Array
    levers: Levers
    errors: Levers | None
    interchanges: bool
    mass: Array
    inertia: Array
    pivots: Array
    gravity: float

    def rows(self, alpha: Array, omega: Array, mass: Array | None = None) -> Array:
        """Σ|terms| of each row of the equations of motion, in these coordinates [N m], (B, n) from (B, n).

        ``mass``: the absolute mass matrix at each state, (B, n, n); without it row interchanges are not counted.
        """
        factors = self.products if mass is None else self.factors(mass)
        solution = (factors @ np.abs(self.own(alpha))[..., None])[..., 0]
        underflow = self.solution_underflow(omega, alpha)
        return np.asarray(solution + underflow + self.velocity_terms(omega) + self.weights)

    def factors(self, mass: Array) -> Array:
        """Σ|terms| of each entry of the mass matrix and its factors, (B, n, n), or (n, n) for all states."""
        return self.products + interchanged(self.own_matrix(mass)) if self.interchanges else self.products

    def regular(self, mass: Array, accuracy: float) -> NDArray[np.bool_]:
        """Whether each mass matrix (B, n, n) is further from singular than rounding, (B,).

        Scaled by sqrt(W_ii) on both sides, so that rows of small and of large links count alike, its error has a norm
        of at most the largest sum of a row. Where its own smallest eigenvalue is above that, factorisations succeed
        (Higham, theorem 10.7) and the bound of their backward error holds; elsewhere neither is sure.
        """
        root = np.sqrt(np.diag(self.products))
        scale = np.outer(root, root)
        off = EPSILON * allowed(len(root), accuracy) * (self.factors(mass) / scale).sum(axis=-1).max(axis=-1)
        least = self.own_matrix(mass) / scale - np.multiply.outer(np.broadcast_to(off, len(mass)), np.eye(len(root)))
        if _positive_definite(least):  # all of them, as nearly always
            return np.ones(len(least), dtype=np.bool_)
        return np.array([_positive_definite(matrix) for matrix in least], dtype=np.bool_)

    def own_matrix(self, mass: Array) -> Array:
        """The mass matrix of these coordinates, from that of absolute angles, (B, n, n)."""
        return np.asarray(self.to_absolute.T @ mass @ self.to_absolute)

    @cached_property
    def products(self) -> Array:
        """sqrt(W_ii W_jj), a bound of Σ|terms| of each entry of the mass matrix and its factors, (n, n)."""
        arm = self.levers.arm
        root = np.sqrt(arm**2 @ self.mass + self.inertia @ self.to_absolute**2)
        found = np.outer(root, root) + self._underflow_unit
        for one, other in self._pairs[1:]:
            found += (one.arm * self.mass) @ other.arm.T
        return found

    @cached_property
    def weights(self) -> Array:
        """The gravity terms with every sine one [N m], (n,)."""
        arms = np.sum([levers.arm for levers in self._each], axis=0)
        return np.asarray(arms @ (self.mass * self.gravity) + self._underflow_unit * (1 + self.gravity))

    def velocity_terms(self, omega: Array) -> Array:
        """β without gravity [N m], (B, n)."""
        moment = self.path_sums(omega) ** 2 * self.inertia
        rows = self.underflow(omega) + np.zeros_like(omega)
        for one, other in self._pairs:
            rows += (self._velocity_accelerations(omega, one) * self.mass) @ other.arm.T
            moment += self._moment(omega, one, other) * self.mass
        return np.asarray(rows + moment @ self.to_absolute)

    def forces(self, alpha: Array, omega: Array) -> Array:
        """Σ|terms| of each joint reaction force, (B, n) [N]: mass × acceleration over the hinge's subtree."""
        magnitudes = np.abs(self.own(alpha))
        swing = np.sum(
            [magnitudes @ levers.arm + self._velocity_accelerations(omega, levers) for levers in self._each], axis=0
        )
        return np.asarray((self.mass * (self.gravity + swing)) @ self.carried + self.underflow(omega, alpha))

    def underflow(self, omega: Array, alpha: Array | None = None) -> Array:
        """The error by underflow below the smallest normal number, over ε, (B, 1): of each row, force, energy."""
        swing = self.path_sums(omega) ** 2 + (0 if alpha is None else self.path_sums(alpha))
        return np.asarray(self._underflow_unit * (1 + self.gravity + swing.max(axis=-1, keepdims=True)))

    def own(self, absolute: Array) -> Array:
        """Absolute accelerations (or rates) in these coordinates, (B, n)."""
        return np.asarray(absolute @ self.from_absolute.T)

    def path_sums(self, absolute: Array) -> Array:
        """Magnitudes that add up to each absolute rate or acceleration, (B, n): all those on its path."""
        return np.asarray(np.abs(self.own(absolute)) @ self.to_absolute.T)

    def residual(self, absolute: Array) -> Array:
        """Generalised forces of absolute angles as those of these coordinates, (B, n) [N m]."""
        return np.asarray(absolute @ self.to_absolute)

    def acceleration_errors(self, mass: Array, rows: Array) -> Array:
        """|M⁻¹ S⁻ᵀ| times magnitudes in rows of these coordinates: the accelerations that they may cause, (B, n)."""
        return np.asarray((np.abs(self.solution(mass)) @ rows[..., None])[..., 0])

    def solution(self, mass: Array) -> Array:
        """M⁻¹ S⁻ᵀ: absolute accelerations for torques in these coordinates, (B, n, n)."""
        return np.asarray(np.linalg.inv(mass) @ self.from_absolute.T)

    def solution_underflow(self, omega: Array, alpha: Array | None = None) -> Array:
        """The same as :meth:`underflow` in the rows of a solution, where the factors multiply it, (B, 1)."""
        return np.asarray(self._growth * self.underflow(omega, alpha))

    def entries(self) -> Array:
        """Σ|terms| of each entry of the absolute mass matrix, (n, n)."""
        return np.asarray(self.absolute_rows(self.absolute_rows(self.products).T).T)

    def absolute_rows(self, own: Array) -> Array:
        """Magnitudes in rows of these coordinates as magnitudes in rows of absolute ones, (..., n)."""
        return np.asarray(own @ np.abs(self.from_absolute))

    @cached_property
    def from_absolute(self) -> Array:
        """S⁻¹, (n, n)."""
        return np.asarray(np.linalg.inv(self.to_absolute), dtype=np.float64)

    @cached_property
    def _underflow_unit(self) -> float:
        longest = max(float(levers.arm.max()) for levers in self._each)
        return SMALLEST * float(1 + self.mass.sum()) * (1 + longest) ** 2

    @cached_property
    def _growth(self) -> float:
        """The largest entry of L; a pivot below ε of its row's diagonal entry would be rounding itself."""
        diagonal = np.diag(self.products)
        return float(np.sqrt(diagonal.max() / np.maximum(self.pivots, EPSILON * diagonal).min()))

    @property
    def _each(self) -> tuple[Levers, ...]:
        return (self.levers,) if self.errors is None else (self.levers, self.errors)

    @property
    def _pairs(self) -> tuple[tuple[Levers, Levers], ...]:
        """Lengths that are multiplied: both as they are, then either one with the other's error."""
        itself = (self.levers, self.levers)
        return (itself,) if self.errors is None else (itself, (self.levers, self.errors), (self.errors, self.levers))

    def _velocity_accelerations(self, omega: Array, levers: Levers) -> Array:
        """The velocity-dependent acceleration of each link's centre of mass, in magnitude, (B, n)."""
        if levers.to_point is None:
            return np.asarray(omega**2 @ levers.arm)
        return np.asarray(self.path_sums(omega) * (np.abs(self.own(omega)) @ (2 * levers.to_point + levers.arm)))

    def _moment(self, omega: Array, one: Levers, other: Levers) -> Array:
        """V_k U_k of each link, (B, n)."""
        if one.to_point is None:
            return np.zeros_like(omega)
        rates = np.abs(self.own(omega))
        return np.asarray((rates @ one.to_point) * (rates @ other.arm))


def interchanged(matrix: Array) -> Array:
    """|L||U| of Gaussian elimination with partial pivoting, rows where they were, (B, n, n).

    Its backward error is so much (Higham, theorem 9.3). Rows are interchanged by the size of their entries, so that a
    row of small entries may be added to one of large ones, and share in its rounding. A block of columns at a time, so
    that most of the work is products of matrices, and no more matrices at a time than a processor's cache holds.
    """
    count, n = matrix.shape[:2]
    together = max(1, CACHED // (n * n))
    if count > together:
        return np.concatenate([interchanged(matrix[i : i + together]) for i in range(0, count, together)])
    work = matrix.copy()
    states, order = np.arange(count), np.tile(np.arange(n), (count, 1))
    for start in range(0, n, BLOCK):
        stop = min(start + BLOCK, n)
        for k in range(start, stop):
            pivot = np.abs(work[:, k:, k]).argmax(axis=1) + k
            for rows in (work, order):
                kept = rows[states, k].copy()
                rows[states, k], rows[states, pivot] = rows[states, pivot], kept
            below, by = work[:, k + 1 :, k], work[:, k, None, k]
            below[:] = np.divide(below, by, out=np.zeros_like(below), where=by != 0)
            work[:, k + 1 :, k + 1 : stop] -= below[..., None] * work[:, k, None, k + 1 : stop]
        for k in range(start + 1, stop):
            work[:, k, None, stop:] -= work[:, k, None, start:k] @ work[:, start:k, stop:]
        work[:, stop:, stop:] -= work[:, stop:, start:stop] @ work[:, start:stop, stop:]
    found = np.empty_like(matrix)
    factors = np.abs(np.tril(work, -1) + np.eye(n)) @ np.abs(np.triu(work))
    np.put_along_axis(found, order[..., None], factors, axis=1)
    return found


def _positive_definite(matrix: Array) -> bool:
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        return False
    return True


@lru_cache(maxsize=32)  # a worker looks at one scene, and its images, with several engines
def amplitudes(
    system: DocumentSystem,
    coordinates: str,
    *,
    moments: str = "hinge",
    placed: str = "parent",
    interchanges: bool | None = False,
) -> Amplitudes:
    """The magnitudes of the system's terms in ``relative`` coordinates, or in absolute angles for any other word.

    The other arguments are those of the engines' ``EngineInfo``: ``moments`` about each link's ``hinge``, the
    ``tree``'s centre of mass or the ``world``'s origin, links ``placed`` on the ``parent`` or in the ``world``, rows
    with ``interchanges`` or without. What is unknown there counts as the largest of what it may be.
    """
    tree = system.tree()
    carried = absolute_from_relative(tree.parents)
    levers, errors = _levers(tree, coordinates, moments, placed)
    return Amplitudes(
        to_absolute=carried if coordinates == "relative" else np.eye(tree.n),
        carried=carried,
        levers=levers,
        errors=errors,
        interchanges=interchanges is not False,
        mass=np.array([link.mass for link in tree.links]),
        inertia=np.array([link.inertia for link in tree.links]),
        pivots=np.array([link.mass * np.hypot(*link.com) ** 2 + link.inertia for link in tree.links]),
        gravity=tree.gravity,
    )


def _levers(tree: PlanarTree, coordinates: str, moments: str, placed: str) -> tuple[Levers, Levers | None]:
    if coordinates != "relative":
        return absolute_levers(tree), None
    if moments == "unknown":
        made = [_levers(tree, coordinates, about, placed) for about in ("hinge", "tree", "world")]
        return longest([levers for levers, _ in made]), longest([errors for _, errors in made if errors is not None])
    if moments == "tree":
        return tree_levers(tree)
    if moments == "world":
        return world_levers(tree), None
    return relative_levers(tree), None if placed == "parent" else world_errors(tree)


def condition(system: DocumentSystem, theta: Array, amplitude: Amplitudes, alpha: Array, omega: Array) -> Array:
    """Relative forward error of accelerations per unit of backward error, at each state: (B,) from (B, n).

    A backward error η leaves accelerations off by at most η·cond of the largest one.
    """
    reach = amplitude.acceleration_errors(mass_matrix(system, theta), amplitude.rows(alpha, omega)).max(axis=-1)
    largest = np.abs(alpha).max(axis=-1)
    return np.asarray(np.divide(reach, largest, out=np.full_like(reach, np.inf), where=largest > 0))
