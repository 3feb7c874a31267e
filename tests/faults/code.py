"""Engines that solve equations of motion written out term by term, in which faults of code are planted.

Equations are those of absolute angles: row i is Σ_j M_ij θ̈_j + Σ_j C_ij θ̇_j² + G_i.
"""

from __future__ import annotations

import numpy as np

from furiko.models.mechanism import Mechanism
from furiko.reference import planar_tree as planar


def unchanged(mass, velocity, gravity):
    return mass, velocity, gravity


class TermByTerm:
    """An engine of another making: no word on what it compiled, forward and inverse dynamics from the same terms.

    ``change(mass, velocity, gravity)`` returns the three as this engine has them.
    """

    def __init__(self, mechanism: Mechanism, change=unchanged):
        self.parents, self.p, self.change = mechanism.parents, planar.parameters(mechanism), change

    def matrices(self, theta):
        """M and C (B, n, n), and G with the hinges' own torques at rest (B, n)."""
        n, p = len(self.parents), self.p
        units = np.eye(n)
        mass = planar.mass_matrix(self.parents, p, theta)
        columns = [planar.velocity_terms(self.parents, p, theta, np.broadcast_to(u, theta.shape)) for u in units]
        return self.change(mass, np.stack(columns, axis=-1), planar.gravity_terms(self.parents, p, theta))

    def rows(self, velocity, gravity, theta, omega):
        return (velocity @ (omega**2)[..., None])[..., 0] + gravity + self.hinges(theta, omega)

    def hinges(self, theta, omega):
        """Torques of dampers and springs, which no fault of code is in."""
        names = ("mass", "inertia", "armature")
        alone = planar.Parameters(**{k: v * 0 if k in names else v for k, v in self.p.items().items()})
        return planar.inverse_dynamics(self.parents, alone, theta, omega, np.zeros_like(theta))

    def accelerations(self, theta, omega):
        mass, velocity, gravity = self.matrices(theta)
        return np.linalg.solve(mass, -self.rows(velocity, gravity, theta, omega)[..., None])[..., 0]

    def inverse_dynamics(self, theta, omega, alpha):
        mass, velocity, gravity = self.matrices(theta)
        return (mass @ alpha[..., None])[..., 0] + self.rows(velocity, gravity, theta, omega)


def velocity_sign(rng, mechanism):
    return lambda mass, velocity, gravity: (mass, -velocity, gravity)


def velocity_forgotten(rng, mechanism):
    return lambda mass, velocity, gravity: (mass, 0 * velocity, gravity)


def entry(rng, mechanism, factor):
    """One term with a factor: of C off the diagonal, of M off it, or of G, where it is not zero."""
    n, kind = mechanism.n, str(rng.choice(["mass", "velocity", "gravity"]))
    i, j = int(rng.integers(n)), int(rng.integers(n))
    coupled = [(a, b) for a in range(n) for b in range(n) if a != b and _on_one_path(mechanism, a, b)]
    if kind != "gravity" and coupled:
        i, j = coupled[int(rng.integers(len(coupled)))]

    def change(mass, velocity, gravity):
        mass, velocity, gravity = mass.copy(), velocity.copy(), gravity.copy()
        if kind == "gravity" or not coupled:
            gravity[:, i] *= factor
        else:
            (mass if kind == "mass" else velocity)[:, i, j] *= factor
        return mass, velocity, gravity

    return change


def _on_one_path(mechanism, a, b):
    def path(i):
        return {i} if i < 0 else {i} | path(mechanism.parents[i])

    return a in path(b) or b in path(a)


def sine_for_cosine(rng, mechanism):
    n = mechanism.n
    coupled = [(a, b) for a in range(n) for b in range(n) if a != b and _on_one_path(mechanism, a, b)]
    i, j = coupled[int(rng.integers(len(coupled)))]

    def change(mass, velocity, gravity):
        swapped = mass.copy()
        swapped[:, i, j] = velocity[:, i, j]
        return swapped, velocity, gravity

    return change


IN_CODE = {
    "velocity-terms-sign": velocity_sign,
    "velocity-terms-forgotten": velocity_forgotten,
    "sign": lambda rng, m: entry(rng, m, -1.0),
    "term-missing": lambda rng, m: entry(rng, m, 0.0),
    "factor-two": lambda rng, m: entry(rng, m, 2.0),
    "factor-half": lambda rng, m: entry(rng, m, 0.5),
    "sin-for-cos": sine_for_cosine,
}
