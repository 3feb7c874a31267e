"""How much two numbers may differ and still agree: bounds from the arithmetic, none typed in by feel.

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
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..models import PlanarTree
from ..models.tree import SUPPORT
from ..reference import gravity_vector, mass_matrix
from ..reference.motion import Mechanism

Array = NDArray[np.float64]

EPSILON = 2.0**-52

# Roundings that a term passes on its way through one link: sine and cosine (1 each) and their error's effect (1), a
# rotation and a shift of a spatial vector or inertia (6), its product with the inertia (3), its addition (1), and as
# much again for the sweep back.
ROUNDINGS_PER_LINK = 26


def allowed(n: int, accuracy: float = EPSILON) -> float:
    """The largest backward error that n links' roundings explain, in units of ε."""
    return ROUNDINGS_PER_LINK * n * accuracy / EPSILON


@dataclass(frozen=True)
class Amplitudes:
    """The magnitudes of a system's terms, in one set of coordinates.

    ``to_absolute``: S, with θ = S q, shape (n, n); ``root``: sqrt(W_ii), shape (n,); ``inertia``: W in absolute
    angles; ``gravity``: the gravity terms with every sine one, absolute.
    """

    to_absolute: Array
    root: Array
    inertia: Array
    gravity: Array

    def rows(self, alpha: Array, omega: Array) -> Array:
        """Σ|terms| of each row of the equations of motion, in these coordinates, (B, n) from (B, n)."""
        solve = self.root * (np.abs(self.own(alpha)) @ self.root)[..., None]
        bias: Array = (self.felt(omega) ** 2 @ self.inertia + self.gravity) @ self.to_absolute
        return np.asarray(solve + bias)

    def own(self, absolute: Array) -> Array:
        """Accelerations (or rates) in these coordinates."""
        return np.asarray(np.linalg.solve(self.to_absolute, absolute[..., None])[..., 0], dtype=np.float64)

    def felt(self, absolute: Array) -> Array:
        """Magnitudes that add up to each absolute rate or acceleration: in relative coordinates, all on the way."""
        return np.asarray(np.abs(self.own(absolute)) @ self.to_absolute.T)

    def residual(self, absolute: Array) -> Array:
        """Generalised forces of absolute angles as those of these coordinates."""
        return np.asarray(absolute @ self.to_absolute)

    def entries(self) -> Array:
        """Magnitudes that meet in each entry of the absolute mass matrix, (n, n)."""
        back = np.abs(np.linalg.inv(self.to_absolute))
        return np.asarray(back.T @ np.outer(self.root, self.root) @ back)

    def forces(self) -> Array:
        """Magnitudes that meet in each row of an absolute generalised force, per magnitude in own rows, (n, n)."""
        return np.asarray(np.abs(np.linalg.inv(self.to_absolute)).T)


def amplitudes(system: Mechanism, coordinates: str) -> Amplitudes:
    """Of the system's terms in ``relative`` coordinates, or in absolute angles for any other word."""
    tree = system.tree()
    to_absolute = relative_to_absolute(tree) if coordinates == "relative" else np.eye(tree.n)
    inertia = mass_matrix(system, np.zeros(tree.n))  # every cosine one
    gravity = gravity_vector(system, np.full(tree.n, np.pi / 2))  # every sine one
    own = to_absolute.T @ inertia @ to_absolute
    return Amplitudes(to_absolute, np.sqrt(np.diag(own)), inertia, gravity)


def relative_to_absolute(tree: PlanarTree) -> Array:
    """S of θ = S q: an absolute angle is the sum of the relative ones from the support to it, shape (n, n)."""
    matrix = np.eye(tree.n)
    for i, parent in enumerate(tree.parents):
        if parent != SUPPORT:
            matrix[i] += matrix[parent]
    return matrix


def condition(system: Mechanism, theta: Array, amplitude: Amplitudes, alpha: Array, omega: Array) -> Array:
    """Relative forward error of accelerations per unit of backward error, at each state: (B,) from (B, n).

    A backward error η leaves accelerations off by at most η·cond of the largest one.
    """
    inverse = np.linalg.inv(mass_matrix(system, theta))
    spread = np.abs(inverse @ amplitude_transform(amplitude))
    reach = (spread @ amplitude.rows(alpha, omega)[..., None])[..., 0].max(axis=-1)
    largest = np.abs(alpha).max(axis=-1)
    return np.asarray(np.divide(reach, largest, out=np.full_like(reach, np.inf), where=largest > 0))


def amplitude_transform(amplitude: Amplitudes) -> Array:
    """S⁻ᵀ: a residual in own coordinates as one in absolute angles."""
    return np.asarray(np.linalg.inv(amplitude.to_absolute).T)
