"""Rounding in maximal coordinates where the bodies come first, and the multipliers are had from a dense matrix.

Each free body is solved for alone, and what remains is G M⁻¹ Gᵀ λ = G M⁻¹ f + γ, with γ = Ġ q̇; then q̈ = M⁻¹ (f − Gᵀ λ).
It is elimination without an interchange between bodies and joints, and a light body's M⁻¹ is large: what rounds
between it and its joints meets the forces that heavy links exert through it. With magnitudes for all of these, every
sine and cosine one, and a body's coordinates about its hinge,

* a body's accelerations are M⁻¹ times a force, each formed: a residual |M| |M⁻¹| (|f| + |Gᵀ| |λ|) in its rows;
* the joints' rows keep |G| |M⁻¹| (|f| + |Gᵀ| |λ|), what meets in γ, and what the factorisation leaves. By orthogonal
  transformations that is relative to a column's length, not to an entry (Higham, Accuracy and Stability of Numerical
  Algorithms, theorem 19.4): Σ_j ‖a_j‖ |λ_j| in every row.

Where a lever is the difference of two places in the world, it is known to the last digits of these, δ: the joint has
another force's lever, δᵀ |λ|, and holds together what is a little elsewhere, δ |q̈|.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, PlanarTree
from ...models.tree import SUPPORT
from ...models.units import Units, in_units
from .. import mass_matrix
from .maximal_elimination import equations
from .monte_carlo import ONE_ROUNDING
from .norms import norm, product, vector_product

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _State:
    """Magnitudes in one state, coordinates x, y and angle of each body's hinge; all in ``units``.

    ``mass``: |M|, and ``inverse``: |M⁻¹|, (3n, 3n); ``jacobian``: |G|, and ``places``: what its levers are off by, in
    units of ε, (2n, 3n); ``force``: |f|, and ``moved``: |q̈|, (3n,); ``columns``: ‖a_j‖ |λ_j|, and ``multipliers``: |λ|,
    (2n,) each; ``rounded``: what meets in γ, (2n,); ``answer``: angular accelerations and multipliers, (3n, 5n), with
    the signs, for a unit in each row.
    """

    mass: Array
    inverse: Array
    jacobian: Array
    places: Array
    force: Array
    moved: Array
    columns: Array
    multipliers: Array
    rounded: Array
    answer: Array
    units: Units

    def most(self) -> Array:
        """Magnitudes that meet in the rows, (5n,), in units of ε."""
        force = self.inverse @ (self.force + self.jacobian.T @ self.multipliers)
        joints = self.jacobian @ force + self.places @ self.moved + self.rounded + self.columns.sum()
        return np.concatenate([self.mass @ force + self.places.T @ self.multipliers, joints])

    def usual(self) -> Array:
        """The root of the sum of their squares, (5n,)."""
        force = np.hypot(self.force, vector_product(self.jacobian.T, self.multipliers))
        bodies = vector_product(product(self.mass, self.inverse), force)
        joints = vector_product(product(self.jacobian, self.inverse), force)
        known = np.hypot(self.rounded, norm(self.columns))
        moment, elsewhere = vector_product(self.places.T, self.multipliers), vector_product(self.places, self.moved)
        return np.concatenate([np.hypot(bodies, moment), norm(np.stack([joints, known, elsewhere]), axis=0)])


def bodies_first(system: DocumentSystem, theta: Array, omega: Array, placed: str) -> tuple[Array, Array]:
    """Magnitudes in units of ε of the equations of motion and of the joint reaction forces: (B, n) [N m], (B, n) [N].

    For states (B, n), in the rows of the document's equations; ``placed`` as in ``engines.EngineInfo``.
    """
    n, pairs = system.n, []
    for angles, rates in zip(theta, omega, strict=True):
        state = _state(system, angles, rates, placed)
        size, units = state.most(), state.units
        rows = np.abs(mass_matrix(system, angles) / units.inertia @ state.answer[:n]) @ size
        forces = norm((np.abs(state.answer[n:]) @ size).reshape(n, 2))
        pairs.append((rows * units.energy, forces * units.force))
    by_row, by_force = (np.array(values) for values in zip(*pairs, strict=True))
    return by_row, by_force


def bodies_first_spread(system: DocumentSystem, theta: Array, omega: Array, placed: str) -> tuple[Array, Array]:
    """Root mean squares of what rounding does to accelerations, (B, n) [rad/s²], and to joints' forces, (B, n) [N]."""
    n, pairs = system.n, []
    for angles, rates in zip(theta, omega, strict=True):
        state = _state(system, angles, rates, placed)
        found = ONE_ROUNDING * vector_product(state.answer, state.usual())
        pairs.append((state.units.in_seconds(found[:n], 2), norm(found[n:].reshape(n, 2)) * state.units.force))
    alpha, forces = (np.array(values) for values in zip(*pairs, strict=True))
    return alpha, forces


def _state(system: DocumentSystem, theta: Array, omega: Array, placed: str) -> _State:
    at, k = equations(system, theta, omega), 3 * system.n
    tree, rates = in_units(system.tree(), at.units), np.abs(omega * at.units.time)
    inverse: Array = np.asarray(np.linalg.inv(at.matrix), dtype=np.float64)
    mass, joints = np.diag(at.matrix)[:k], at.matrix[k:, :k]
    unknowns = np.abs(inverse @ at.right)
    answer = inverse[np.r_[2:k:3, k : len(inverse)]]
    # A residual about the hinges is the transposed of the change of coordinates times one about the centres of mass.
    answer[:, :k] = answer[:, :k] @ _to_centres(joints[:, 2::3]).T  # the inverse of one is that with the other sign
    arms = np.array([np.hypot(*link.com) for link in tree.links], dtype=np.float64)
    to_centres = _to_centres(np.repeat(np.diag(arms), 2, axis=0))
    swing = np.repeat(mass[::3] * arms * rates**2, 3) * np.tile((1, 1, 0), system.n)
    jacobian, places = _jacobian(tree, np.asarray(norm(at.position.reshape(-1, 3)[:, :2])) + arms)
    return _State(
        mass=to_centres.T * mass @ to_centres,
        inverse=to_centres / mass @ to_centres.T,
        jacobian=jacobian,
        places=places * (placed != "parent"),
        force=to_centres.T @ (np.abs(at.right[:k]) + swing),
        moved=unknowns[:k],
        columns=norm((joints / mass) @ joints.T, axis=0) * unknowns[k:],
        multipliers=unknowns[k:],
        rounded=at.rounded[k:],
        answer=answer,
        units=at.units,
    )


def _to_centres(turned: Array) -> Array:
    """The matrix that makes centres' velocities of hinges', (3n, 3n); ``turned``: what a rate adds, (2n, n)."""
    n = turned.shape[1]
    found = np.eye(3 * n)
    for i in range(n):
        found[3 * i : 3 * i + 2, 3 * i + 2] = turned[2 * i : 2 * i + 2, i]
    return found


def _jacobian(tree: PlanarTree, far: Array) -> tuple[Array, Array]:
    """|G| of hinges, and what its levers are off by as differences of two places, in units of ε, (2n, 3n) each.

    ``far``: how far each link's hinge is from the support, at most, (n,).
    """
    found, places = np.zeros((2, tree.n, 2, tree.n, 3))
    for i, link in enumerate(tree.links):
        found[i, (0, 1), i, (0, 1)] = 1.0
        if link.parent != SUPPORT:
            found[i, (0, 1), link.parent, (0, 1)] = 1.0
            found[i, :, link.parent, 2] = np.hypot(*link.hinge)
            places[i, :, link.parent, 2] = far[i] + far[link.parent]
    shape = (2 * tree.n, 3 * tree.n)
    return found.reshape(shape), places.reshape(shape)
