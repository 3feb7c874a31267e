"""The backward error of elimination in maximal coordinates, where masses, inertias and lengths are in one matrix.

The KKT system of free bodies and hinges, (M, Gᵀ; G, 0) (q̈, λ) = b, is solved by Gaussian elimination with row
interchanges. Its backward error is |L||U||x| (Higham, Accuracy and Stability of Numerical Algorithms, theorem 9.3), not
row by row: a row of a light link may be added to one of a heavy link and share its rounding. The size depends on the
order in which unknowns are eliminated, which a sparse solver chooses by rules of its own. For the proven bound the
worst of several random orders is taken; for the spread, too, unless the solver's rules are known (COLAMD, SuperLU's
column ordering, which Eigen's ``SparseLU`` follows): then SuperLU itself is asked.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ...models.errors import library
from ...models.tree import SUPPORT
from ...models.units import Units, in_units, units_of
from .. import mass_matrix
from ..maximal_coordinates import MaximalCoordinates
from .bounds import interchanged
from .monte_carlo import ONE_ROUNDING
from .norms import norm, vector_product

Array = NDArray[np.float64]

ORDERS = 16  # random ones, for the proven bound
FEW_ORDERS = 3  # random ones, for the spread of long mechanisms
LONGEST = 200  # links of a mechanism that a spread is still had for, in one state
LONG = 12  # links of one, beyond which more orders would take too long
WORK = 6e8  # multiplications, of which elimination makes about so many in a second
ASIDE = 3e7  # what else a state costs, in the same unit


@dataclass(frozen=True)
class Equations:
    """The system in one state: matrix (5n, 5n), right-hand side, and magnitudes that meet in the latter, (5n,).

    ``levers``: of each entry of the matrix that is a lever's component, the lever's length, (5n, 5n). ``position`` and
    ``velocity``: of all coordinates, (3n,). All in ``units``.
    """

    matrix: Array
    levers: Array
    right: Array
    rounded: Array
    position: Array
    velocity: Array
    units: Units


def states_within_a_second(n: int, orders: int = ORDERS, ordering: str = "unknown") -> int:
    """In how many states of n links the elimination can be looked at in about a second, at least in one."""
    if ordering == "bodies":
        return max(1, int(1 / (1e-3 + 4e-6 * n**2)))
    return max(1, int(WORK / (orders * (5.0 * n) ** 3 + ASIDE)))


def furthest_off(beyond: NDArray[np.bool_], excess: Array, most: int) -> NDArray[np.intp]:
    """Of the states (B,) that are ``beyond`` a bound, the ``most`` with the most ``excess``."""
    return np.flatnonzero(beyond)[np.argsort(-excess[beyond], kind="stable")][:most]


def spread_states(n: int, ordering: str) -> int:
    """In how many states of n links a spread can be had in about a quarter of a second; 0: in none."""
    if ordering == "bodies":
        return int(0.25 / (1e-3 + 4e-6 * n**2)) or int(n <= LONGEST)
    if ordering == "colamd":
        return int(0.25 / (1e-3 + 4e-5 * n**2)) or int(n <= LONGEST)
    return states_within_a_second(n, _spread_orders(n) + 2) // 4 or int(n <= LONGEST)


def _spread_orders(n: int) -> int:
    """How many random orders a spread rests on, besides two: from the tips link by link, and as the unknowns stand."""
    return ORDERS if n <= LONG else FEW_ORDERS


def elimination(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Magnitudes in units of ε of the equations of motion and of the joint reaction forces: (B, n) [N m], (B, n) [N].

    For states (B, n). In the rows of the document's equations: M times the change of the angular accelerations that a
    residual |L||U||x| of the KKT system makes, and its change of the multipliers.
    Long mechanisms take seconds a state: see :func:`states_within_a_second`.
    """
    pairs = [_one(system, t, w) for t, w in zip(theta, omega, strict=True)]
    rows, forces = (np.array(values) for values in zip(*pairs, strict=True))
    return rows, forces


def _one(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    n, state = system.n, equations(system, theta, omega)
    units, matrix = state.units, state.matrix
    inverse = np.linalg.inv(matrix)
    unknowns = np.abs(np.linalg.solve(matrix, state.right))
    size = (_met(matrix[None], _random_orders(5 * n, ORDERS))[0] * unknowns).sum(axis=-1).max(axis=0)
    by_angle = np.abs(mass_matrix(system, theta) / units.inertia @ inverse[2 : 3 * n : 3])
    by_force = np.abs(inverse[3 * n :])
    forces = np.linalg.norm((by_force @ size).reshape(n, 2), axis=-1)
    return by_angle @ size * units.energy, forces * units.force


def maximal_spread(
    system: DocumentSystem, theta: Array, omega: Array, ordering: str = "unknown"
) -> tuple[Array, Array]:
    """Root mean squares of what rounding does to accelerations, (B, n) [rad/s²], and to joints' forces, (B, n) [N].

    Every entry of |L||U| and of the right-hand side moved by one rounding, independently of the others; an angle is
    known to ε, hence a lever's component to ε of the lever. The right-hand side is G q̇, differentiated along the
    motion: velocities meet there before they cancel. ``ordering`` as in ``engines.EngineInfo``.
    """
    n = system.n
    all_states = [equations(system, t, w) for t, w in zip(theta, omega, strict=True)]
    if ordering == "colamd":
        met = np.stack([_met_by_superlu(state.matrix) for state in all_states])
    else:
        orders = np.vstack([_from_the_tips(n), np.arange(5 * n), _random_orders(5 * n, _spread_orders(n))])
        met = _met(np.stack([state.matrix for state in all_states]), orders).max(axis=1)
    pairs = [_spread(n, state, entries) for state, entries in zip(all_states, met, strict=True)]
    alpha, forces = (np.array(values) for values in zip(*pairs, strict=True))
    return alpha, forces


def _spread(n: int, state: Equations, met: Array) -> tuple[Array, Array]:
    inverse, units = np.linalg.inv(state.matrix), state.units
    rows = np.hypot(vector_product(np.hypot(met, state.levers), inverse @ state.right), state.rounded)
    found = ONE_ROUNDING * vector_product(inverse, rows)
    forces = norm(found[3 * n :].reshape(n, 2))
    return units.in_seconds(found[2 : 3 * n : 3], 2), forces * units.force


def joint_spread(system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Root mean squares of what holding the joints together does to angles [rad] and rates [rad/s], (B, n) each.

    Places, velocities and levers are rounded where a joint's constraint, or its derivative, is evaluated.
    """
    n, pairs = system.n, []
    for angles, rates in zip(theta, omega, strict=True):
        state = equations(system, angles, rates)
        answer = np.linalg.inv(state.matrix)[2 : 3 * n : 3, 3 * n :]
        jacobian, lever = state.matrix[3 * n :, : 3 * n], state.levers[3 * n :, 2 : 3 * n : 3]
        position, velocity = (values.astype(np.float64) for values in (state.position, state.velocity))
        apart = np.hypot(vector_product(jacobian, position), norm(lever))
        parting = np.hypot(vector_product(jacobian, velocity), vector_product(lever, velocity[2::3]))
        pairs.append((vector_product(answer, apart), vector_product(answer, parting) / state.units.time))
    by_angle, by_rate = (ONE_ROUNDING * np.array(values) for values in zip(*pairs, strict=True))
    return by_angle, by_rate


def equations(system: DocumentSystem, theta: Array, omega: Array) -> Equations:
    """The system in one state, (n,) each."""
    tree, n = system.tree(), system.n
    units = units_of(tree).fitting(system.gravity, omega)
    bodies = MaximalCoordinates(in_units(tree, units))
    rates = omega * units.time
    q, v = bodies.state(theta, rates)
    G = bodies.jacobian(q)
    right = np.concatenate([bodies.force, -bodies.constraint_bias(q, v)]).astype(np.float64)
    # Of each joint: the velocities of both bodies' points there, and the rates with which they turn.
    turning = np.abs(rates)
    lever = np.hypot(*np.abs(G).astype(np.float64).reshape(n, 2, n, 3)[..., 2].swapaxes(0, 1))
    speed = np.hypot(*v.astype(np.float64).reshape(n, 3)[:, :2].T)
    held = np.array([0.0 if parent == SUPPORT else speed[parent] for parent in tree.parents])
    carrier = np.array([0.0 if parent == SUPPORT else turning[parent] for parent in tree.parents])
    meets = (speed + held + lever @ turning) * (turning + carrier)
    rounded = np.concatenate([np.zeros(3 * n), np.repeat(meets, 2)])
    levers = np.zeros((5 * n, 5 * n))
    levers[3 * n :, 2 : 3 * n : 3] = np.repeat(lever, 2, axis=0)
    return Equations(bodies.kkt_matrix(G), levers + levers.T, right, rounded, q, v, units)


def _met(matrices: Array, orders: NDArray[np.intp]) -> Array:
    """|L||U| of each matrix for each order of the unknowns, columns where they were, (B, orders, 5n, 5n)."""
    ordered = np.stack([matrices[:, :, order] for order in orders], axis=1)
    factors = interchanged(ordered.reshape(-1, *matrices.shape[1:])).reshape(ordered.shape)
    found = np.empty_like(factors)
    np.put_along_axis(found, orders[None, :, None, :], factors, axis=-1)
    return found


def _met_by_superlu(matrix: Array) -> Array:
    """|L||U| of SuperLU's own factors, rows and columns where they were, (5n, 5n)."""
    superlu, sparse = library("scipy.sparse.linalg"), library("scipy.sparse")
    found = superlu.splu(sparse.csc_array(matrix), permc_spec="COLAMD", diag_pivot_thresh=1.0)
    product = (abs(found.L) @ abs(found.U)).toarray()
    return np.asarray(product[np.ix_(found.perm_r, found.perm_c)])


def _random_orders(size: int, count: int) -> NDArray[np.intp]:
    generator = np.random.Generator(np.random.PCG64(1))
    return np.array([generator.permutation(size) for _ in range(count)])


def _from_the_tips(n: int) -> NDArray[np.intp]:
    """Each link's three coordinates, then the two forces of the joint that carries it, from the last to the first."""
    links = np.arange(n)[::-1, None]
    return np.hstack([3 * links + np.arange(3), 3 * n + 2 * links + np.arange(2)]).ravel()
