"""Maximal coordinates: x, y and angle of every link, with joint reaction forces as Lagrange multipliers.

Free bodies M q̈ + Gᵀ λ = f with the constraints C(q) = 0 that each link's hinge stays on its parent, G = ∂C/∂q. The
motion is the documents' own, but a scheme applied to these coordinates makes other steps, since the change to angles is
not linear. Plane x-y, y up, as in the documents. One state at a time; longdouble.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models import PlanarTree
from ..models.tree import SUPPORT
from .integration.schemes import AlphaScheme, generalized_alpha, newmark

Array = NDArray[Any]
Wide, WideComplex = np.longdouble, np.clongdouble
ITERATIONS = 20  # of Newton's method, each of which gains some ten of nineteen digits


class MaximalCoordinates:
    """A planar tree of links as free bodies and hinges; q has 3n entries (x, y of the centre of mass, angle)."""

    def __init__(self, tree: PlanarTree) -> None:
        links = tree.links
        self.n, self.parents = tree.n, tree.parents
        # Complex numbers x + iy: a point (along, across) of a link is (across - i along) turned by its angle.
        self._centre = np.array([_complex(link.com) for link in links])
        self._hinge = np.array(
            [
                _complex(link.hinge) - (_complex(links[link.parent].com) if link.parent != SUPPORT else 0)
                for link in links
            ]
        )
        self.mass = np.array([(link.mass, link.mass, link.inertia) for link in links], dtype=Wide).ravel()
        self.force = np.array([(0, -Wide(link.mass) * Wide(tree.gravity), 0) for link in links], dtype=Wide).ravel()

    def state(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """q and q̇, (3n,) each, of angles and rates (n,)."""
        turn = np.exp(1j * theta.astype(WideComplex))
        centre, rate = np.zeros(self.n, WideComplex), np.zeros(self.n, WideComplex)
        for i, parent in enumerate(self.parents):
            arm, held, moving = self._centre[i] * turn[i], self._hinge[i], WideComplex(0)
            if parent != SUPPORT:
                lever = self._hinge[i] * turn[parent]
                held, moving = centre[parent] + lever, rate[parent] + 1j * omega[parent] * lever
            centre[i], rate[i] = held + arm, moving + 1j * omega[i] * arm
        return _rows(centre, theta), _rows(rate, omega)

    def constraint(self, q: Array) -> Array:
        """C(q), (2n,) [m]: the distance of each link's hinge from its place on the parent."""
        centre, turn = self._complex_state(q)
        gap = centre - self._centre * turn
        for i, parent in enumerate(self.parents):
            gap[i] -= self._hinge[i] if parent == SUPPORT else centre[parent] + self._hinge[i] * turn[parent]
        return _pairs(gap)

    def jacobian(self, q: Array) -> Array:
        """G(q) = ∂C/∂q, (2n, 3n)."""
        _, turn = self._complex_state(q)
        G = np.zeros((self.n, 2, self.n, 3), Wide)
        for i, parent in enumerate(self.parents):
            _entry(G[i, :, i], 1, -1j * self._centre[i] * turn[i])
            if parent != SUPPORT:
                _entry(G[i, :, parent], -1, -1j * self._hinge[i] * turn[parent])
        return G.reshape(2 * self.n, 3 * self.n)

    def constraint_bias(self, q: Array, v: Array) -> Array:
        """Ġ q̇, (2n,) [m/s²]: C̈ without accelerations."""
        _, turn = self._complex_state(q)
        squared = v[2::3] ** 2
        found = squared * self._centre * turn
        for i, parent in enumerate(self.parents):
            if parent != SUPPORT:
                found[i] += squared[parent] * self._hinge[i] * turn[parent]
        return _pairs(found)

    def kkt_matrix(self, G: Array) -> NDArray[np.float64]:
        """(M, Gᵀ; G, 0) in double precision, (5n, 5n): accurate enough as the derivative in Newton's method."""
        k = 3 * self.n
        matrix = np.zeros((5 * self.n, 5 * self.n))
        matrix[range(k), range(k)] = self.mass
        matrix[:k, k:], matrix[k:, :k] = G.T, G
        return matrix

    def accelerations(self, q: Array, v: Array) -> Array:
        """Forward dynamics: q̈, (3n,), with C̈ = 0."""
        G, bias, k = self.jacobian(q), self.constraint_bias(q, v), 3 * self.n

        def residual(x: Array) -> Array:
            return np.concatenate([self.mass * x[:k] + G.T @ x[k:] - self.force, G @ x[:k] + bias])

        return _newton(residual, lambda x: self.kkt_matrix(G), np.zeros(5 * self.n, Wide))[:k]

    def _complex_state(self, q: Array) -> tuple[Array, Array]:
        return q[0::3] + 1j * q[1::3], np.exp(1j * q[2::3].astype(WideComplex))


def generalized_alpha_index_3(
    system: MaximalCoordinates, theta: Array, omega: Array, h: Any, radius: Any, steps: int = 1
) -> tuple[Array, Array]:
    """θ and ω, (n,) each, after steps of the generalized-α scheme that solves C(q) = 0 at the end of each.

    ``h``: the step [s]; ``radius``: ρ∞. Raises ArithmeticError where the step is too long to be solved.
    """
    return _run(system, theta, omega, h, generalized_alpha(radius), steps, velocities=False)


def trapezoidal_index_2(
    system: MaximalCoordinates, theta: Array, omega: Array, h: Any, steps: int = 1
) -> tuple[Array, Array]:
    """θ and ω, (n,) each, after steps of the trapezoidal rule that solves G(q) q̇ = 0; positions drift.

    Raises ArithmeticError where the step is too long to be solved.
    """
    return _run(system, theta, omega, h, newmark(Wide(1) / 4, Wide(1) / 2), steps, velocities=True)


def _run(
    system: MaximalCoordinates,
    theta: Array,
    omega: Array,
    h: Any,
    scheme: AlphaScheme,
    steps: int,
    *,
    velocities: bool,
) -> tuple[Array, Array]:
    q, v = system.state(theta, omega)
    before = kept = system.accelerations(q, v)
    for _ in range(steps):
        q, v, before, kept = _step(system, q, v, h, scheme, (before, kept), velocities=velocities)
    return q[2::3], v[2::3]


def _step(
    system: MaximalCoordinates,
    q: Array,
    v: Array,
    h: Any,
    scheme: AlphaScheme,
    accelerations: tuple[Array, Array],
    *,
    velocities: bool,
) -> tuple[Array, Array, Array, Array]:
    """q, q̇, the accelerations q̈ and the algorithmic ones after one step, each (3n,), from those before it."""
    (before, kept), k = accelerations, 3 * system.n
    share = (1 - scheme.alpha_f) / (1 - scheme.alpha_m)  # of the new acceleration in the algorithmic one

    def state(acceleration: Array) -> tuple[Array, Array]:
        return scheme.moved(q, v, h, kept, scheme.algorithmic(acceleration, before, kept))

    def residual(x: Array) -> Array:
        positions, rates = state(x[:k])
        G = system.jacobian(positions)
        unit = h * scheme.gamma * share if velocities else h * h * scheme.beta * share
        held = (G @ rates if velocities else system.constraint(positions)) / unit
        return np.concatenate([system.mass * x[:k] + G.T @ x[k:] - system.force, held])

    def derivative(x: Array) -> NDArray[np.float64]:
        return system.kkt_matrix(system.jacobian(state(x[:k])[0]))

    guess = np.concatenate([before, np.zeros(2 * system.n, Wide)])
    least = 1e-16 * float(np.abs(q).max() / (h * h))  # moves positions by a part of 1e-16, far less than engines' do
    after = _newton(residual, derivative, guess, least)[:k]
    return *state(after), after, scheme.algorithmic(after, before, kept)


def _newton(
    residual: Callable[[Array], Array],
    derivative: Callable[[Array], NDArray[np.float64]],
    guess: Array,
    least: float = 0.0,
) -> Array:
    """The root of the residual, by simplified Newton iterations until the changes no longer shrink.

    Raises ArithmeticError where the last change is above 1e-9 of the root and above ``least``.
    """
    x: Array = guess
    before = np.inf
    for _ in range(ITERATIONS):
        change = _solve(derivative(x), residual(x).astype(np.float64))
        x = x - change
        size = float(np.abs(change).max())
        # Positions are known to 1e-19, and so accelerations to 1e-19 / h²: the changes then no longer become smaller.
        if size == 0 or (size <= max(least, 1e-9 * float(np.abs(x).max())) and size >= before / 2):
            return x
        before = size
    raise ArithmeticError("the implicit step's equations were not solved: the step is too long")


def _solve(matrix: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """The solution of a KKT system, scaled: masses and inertias about a joint to one, then Jacobian rows to length one.

    Without scaling, links of very unlike masses and lengths leave no correct digits, and Newton's method does not end.
    """
    k = 3 * len(matrix) // 5
    inertia, jacobian = np.diag(matrix)[:k].copy(), matrix[k:, :k]
    inertia[2::3] += inertia[::3] * np.abs(jacobian[:, 2::3]).max(axis=0) ** 2
    scale = np.empty(len(matrix))
    scale[:k] = inertia**-0.5
    scale[k:] = 1 / np.linalg.norm(jacobian * scale[:k], axis=1)
    return np.asarray(scale * np.linalg.solve(scale[:, None] * matrix * scale, scale * right))


def _entry(block: Array, sign: int, lever: Any) -> None:
    block[0, 0] = block[1, 1] = sign
    block[0, 2], block[1, 2] = lever.real, lever.imag


def _complex(along_across: tuple[float, float]) -> Any:
    along, across = along_across
    return WideComplex(across) - 1j * WideComplex(along)


def _rows(point: Array, angle: Array) -> Array:
    return np.stack([np.real(point), np.imag(point), angle.astype(Wide)], axis=1).ravel()


def _pairs(point: Array) -> Array:
    return np.stack([np.real(point), np.imag(point)], axis=1).ravel()
