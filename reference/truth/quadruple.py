"""Trajectories in quadruple precision: the literal equations as heyoka expressions, integrated by Taylor series.

Not an enclosure: the error is estimated by a second run. Nothing is shared with the fast kernels: a dense system of
equations is eliminated symbolically, exactly as the document writes it. For long chains that would be millions of
terms; there the equations with the joint forces, Takeno (3) and (6), are solved along the chain instead, O(n). Beyond
fifty links the numbers are long doubles of 64 bits, eleven more than doubles have; the error estimate shows it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem, RodChain
from ...models.errors import library
from ..arithmetic import Arithmetic, Array, heyoka_arithmetic
from ..documents import equations_of_motion as motion
from .block_tridiagonal import chain_accelerations

Floats = NDArray[np.float64]

TOLERANCES = (1e-34, 1e-30)  # of the two runs; the difference of their orders and steps shows the error
LARGEST_QUADRUPLE_N = 50  # beyond, quadruple arithmetic, which is done in software, takes hours
EXTENDED_TOLERANCES = (1e-19, 1e-17)  # of 64-bit mantissas, where the processor has them
LARGEST_DENSE_N = 10  # beyond, the equations with the joint forces make the smaller expressions


@dataclass(frozen=True)
class QuadrupleTrajectory:
    """θ [rad] and ω [rad/s] at the times asked for, shape (times, n): the sums ``theta + theta_low`` and so on.

    ``error``: estimate of the largest error of the state at each time, shape (times,), from two runs that differ in
    order and step; in rad and rad/s.
    """

    theta: Floats
    omega: Floats
    theta_low: Floats
    omega_low: Floats
    error: Floats


def quadruple_trajectory(
    system: DocumentSystem,
    theta: Sequence[float] | Floats,
    omega: Sequence[float] | Floats,
    times: Sequence[float] | Floats,
) -> QuadrupleTrajectory:
    """The trajectory of the literal equations from a state (n,) at ``times[0]`` [s]; times may run backwards.

    Its error is estimated by a second run. Raises LibraryMissing without heyoka.
    """
    states, error = quadruple_states(system, [*map(float, theta)], [*map(float, omega)], [*map(float, times)])
    high, low = split(states)
    n = system.n
    return QuadrupleTrajectory(high[:, :n], high[:, n:], low[:, :n], low[:, n:], error)


def quadruple_path(
    system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], times: Floats
) -> tuple[Floats, Floats]:
    """θ and ω side by side at ``times`` [s], (times, 2n): the sum of the two, by one run, whose error is not estimated.

    A local error of the coarser tolerance, grown as fast as small differences do. Raises LibraryMissing without heyoka.
    """
    return split(_run(_equations(system), [*theta, *omega], times.tolist(), TOLERANCES[1], _heyoka().real128))


def split(states: Array) -> tuple[Floats, Floats]:
    """Numbers of more digits as sums of two doubles, the nearest one first."""
    high = states.astype(np.float64)
    return high, (states - high.astype(states.dtype)).astype(np.float64)


def from_decimals(digits: Sequence[Sequence[str]], error: Sequence[float], n: int) -> QuadrupleTrajectory:
    """A trajectory from rows of θ and ω written as decimals."""
    high = np.array([[float(number) for number in row] for row in digits]).reshape(-1, 2 * n)
    low = np.array([[float(Decimal(number) - Decimal(float(number))) for number in row] for row in digits]).reshape(
        -1, 2 * n
    )
    return QuadrupleTrajectory(high[:, :n], high[:, n:], low[:, :n], low[:, n:], np.array(error, dtype=np.float64))


def decimal_states(
    system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], times: Sequence[float]
) -> tuple[list[list[str]], list[float]]:
    """Rows of θ and ω as decimals of quadruple precision, and the error estimate of each row."""
    states, error = quadruple_states(system, theta, omega, times)
    return [[str(number) for number in row] for row in states], error.tolist()


def quadruple_states(
    system: DocumentSystem, theta: Sequence[float], omega: Sequence[float], times: Sequence[float]
) -> tuple[Array, Floats]:
    """θ and ω side by side, (times, 2n), in quadruple precision, and the error estimate of each row."""
    extended = system.n > LARGEST_QUADRUPLE_N and np.finfo(np.longdouble).nmant >= 63
    return integrated(_equations(system), [*theta, *omega], times, extended=extended)


def integrated(
    equations: list[tuple[Any, Any]], state: Sequence[float], times: Sequence[float], *, extended: bool = False
) -> tuple[Array, Floats]:
    """States at ``times``, (times, variables), from ``state`` at the first, and the error estimate of each row.

    ``equations``: heyoka's variables, each with the expression of its derivative; ``extended``: in long doubles.
    """
    number, tolerances, bits = (
        (np.longdouble, EXTENDED_TOLERANCES, 63) if extended else (_heyoka().real128, TOLERANCES, 112)
    )
    finer, coarser = (_run(equations, state, times, tolerance, number) for tolerance in tolerances)
    difference = np.abs(finer - coarser).max(-1).astype(np.float64)
    return finer, np.maximum(difference, 2.0**-bits * np.abs(finer).max(-1).astype(np.float64))


def _run(
    equations: list[tuple[Any, Any]], state: Sequence[float], times: Sequence[float], tolerance: float, number: Any
) -> Array:
    """States in this kind of number, real128 or long double, shape (times, 2 n)."""
    hy = _heyoka()
    grid = [number(float(t)) for t in times]
    integrator = hy.taylor_adaptive(
        equations,
        [number(float(x)) for x in state],
        time=grid[0],
        tol=number(tolerance),
        fp_type=number,
        compact_mode=True,
    )
    outcome, *_, states = integrator.propagate_grid(grid)
    if outcome != hy.taylor_outcome.time_limit:
        raise ArithmeticError(f"quadruple precision integration stopped early: {outcome.name}")
    return np.asarray(states)


def _equations(system: DocumentSystem) -> list[tuple[Any, Any]]:
    """dθ/dt = ω and dω/dt as heyoka wants them."""
    hy = _heyoka()
    xp = heyoka_arithmetic()
    theta = np.array(hy.make_vars(*(f"theta{i}" for i in range(system.n))), dtype=object).reshape(-1)
    omega = np.array(hy.make_vars(*(f"omega{i}" for i in range(system.n))), dtype=object).reshape(-1)
    alpha = accelerations(xp, system, theta, omega)
    return [*zip(theta, omega, strict=True), *zip(omega, alpha, strict=True)]


def accelerations(xp: Arithmetic, system: DocumentSystem, theta: Array, omega: Array) -> Array:
    """θ̈ of one state, (n,), in the form that is smallest as an expression."""
    if isinstance(system, RodChain) and system.n > LARGEST_DENSE_N:
        return chain_accelerations(xp, system, theta, omega)
    return motion.literal_accelerations(system, theta, omega)


def _heyoka() -> Any:
    return library("heyoka")
