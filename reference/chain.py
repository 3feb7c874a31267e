"""The limit of Takeno's section 6: a hanging chain as n rods of total length L, n → ∞.

**Small swings.** Takeno (18) linearised about the hanging chain reads Σ_k α_jk l_k θ''_k + g L_j θ_j = 0, a full
matrix. In the joints' displacements y_j, θ_j = (y_j - y_{j-1})/l_j with y_0 = 0, kinetic and potential energy are
sums over single rods, so that both matrices are tridiagonal: a rod of mass m whose ends move by u and v has the kinetic
energy m (u² + uv + v²)/6 and, under the tension g (m_j/2 + Σ_{i>j} m_i) of (12), the potential one tension ·
(v - u)²/(2 l). Point masses at the joints in place of rods have m v²/2 and the tension g Σ_{i≥j} m_i. The limit of
both is Bernoulli's ω_k = (j₀,k/2) √(g/L).

**Large motions.** All n start from rest in one curve, given by its slope φ(s): rod j at φ((j - ½) L/n). The motion is
that of :mod:`.integration.taylor`; it shows whether place and speed of the tip converge with n.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..models import InvalidInput, RodChain
from ..models.errors import library
from .documents.equations_of_motion import energies
from .integration.schemes import classical_step
from .truth.closed_forms import hanging_chain_rates

Array = NDArray[np.float64]
Links = Literal["rods", "point masses"]

LENGTH, GRAVITY = 1.0, 9.81
DENSE = 40  # links up to which the dense solver finds all modes as fast as the sparse one finds a few
TALLEST = 1.0  # rad: the bow's slope at the support
SLOPE = -0.5  # rad: how much less it is at the tip


def small_swings(n: int, links: Links, count: int, length: float = LENGTH, gravity: float = GRAVITY) -> Array:
    """Angular rates [rad/s] of the ``count`` ≤ n slowest small swings of n equal links, rising."""
    mass, stiffness = matrices(n, links, length, gravity)
    if n <= DENSE:
        squares = library("scipy.linalg").eigh(_full(stiffness), _full(mass), eigvals_only=True)[:count]
    else:
        sparse, solver = library("scipy.sparse"), library("scipy.sparse.linalg")
        M, K = (
            sparse.diags_array([band[1][1:], band[0], band[1][1:]], offsets=[-1, 0, 1]).tocsc()
            for band in (mass, stiffness)
        )
        start = np.linspace(0, 1, n)  # fixed: the solver's own would be random
        squares = np.sort(solver.eigsh(K, k=count, M=M, sigma=0, v0=start, tol=0, return_eigenvectors=False))
    return np.asarray(np.sqrt(squares))


def matrices(n: int, links: Links, length: float = LENGTH, gravity: float = GRAVITY) -> tuple[Array, Array]:
    """Mass and stiffness in the joints' displacements, for ρ = 1: (2, n) each, the diagonal and the one before it."""
    l = length / n
    below = np.arange(n - 1, -1, -1.0)  # links below each
    mass, stiffness = np.zeros((2, n)), np.zeros((2, n))
    if links == "rods":
        tension = gravity * l * (below + 0.5)
        mass[0] = l / 3
        mass[0, :-1] += l / 3
        mass[1, 1:] = l / 6
    else:
        tension = gravity * l * (below + 1)
        mass[0] = l
    stiffness[0] = tension / l
    stiffness[0, :-1] += tension[1:] / l
    stiffness[1, 1:] = -tension[1:] / l
    return mass, stiffness


def swing_errors(n: int, links: Links, count: int = 10) -> Array:
    """Relative differences of the first swings' rates from Bernoulli's, ``count`` of them or n."""
    count = min(count, n)
    limit = hanging_chain_rates(LENGTH, GRAVITY, count)
    return np.asarray(small_swings(n, links, count) / limit - 1)


def order(numbers: Sequence[float], errors: Sequence[float]) -> float:
    """p of errors ~ n^-p, by least squares of the logarithms."""
    return -float(np.polyfit(np.log(numbers), np.log(np.abs(errors)), 1)[0])


def chain(n: int) -> RodChain:
    """n equal rods, 1 m in all."""
    return RodChain((LENGTH / n,) * n, gravity=GRAVITY)


def bow(n: int, amplitude: float = 1.0) -> Array:
    """Angles [rad] of the curve from which every chain starts, (n,)."""
    s = (np.arange(n) + 0.5) / n
    return amplitude * (TALLEST + SLOPE * s)


@dataclass(frozen=True)
class Motion:
    """Part of a chain's motion.

    ``times`` [s] (m,); ``tip`` (m, 2): place of the free end [m], x and z; ``speed`` (m,) [m/s] of it; ``fastest``
    (m,): the largest |ω| [rad/s]; ``energy`` (m,): of the whole, above rest [J]; ``curves`` (m, points, 2): joints [m];
    ``theta``, ``omega``: the last state, (n,); ``steps`` taken; ``seconds`` of computing.
    """

    times: Array
    tip: Array
    speed: Array
    fastest: Array
    energy: Array
    curves: Array
    theta: Array
    omega: Array
    steps: int
    seconds: float


MOST_POINTS = 100  # of a curve that is drawn


def move(system: RodChain, theta: Any, omega: Any, times: Sequence[float] | Array, tolerance: float = 1e-12) -> Motion:
    """The motion from a state (n,) at ``times[0]`` [s]. Raises InvalidInput as :func:`.integration.taylor.simulate`."""
    from .integration.taylor import simulate

    n = system.n
    begun = time.perf_counter()
    moved = simulate(system, theta, omega, times, tolerance)
    seconds = time.perf_counter() - begun
    l = np.array(system.lengths)
    across = np.cumsum(l * np.sin(moved.theta), axis=-1)
    up = -np.cumsum(l * np.cos(moved.theta), axis=-1)
    rate = np.stack(
        [(l * np.cos(moved.theta) * moved.omega).sum(-1), (l * np.sin(moved.theta) * moved.omega).sum(-1)], axis=-1
    )
    _, lowest = energies(system, np.zeros(n), np.zeros(n))
    shown = np.unique(np.linspace(0, n - 1, min(n, MOST_POINTS)).round().astype(int))
    return Motion(
        times=np.asarray(moved.times),
        tip=np.stack([across[:, -1], up[:, -1]], axis=-1),
        speed=np.linalg.norm(rate, axis=-1),
        fastest=np.abs(moved.omega).max(axis=-1),
        energy=np.asarray(sum(energies(system, moved.theta, moved.omega)) - lowest),
        curves=np.stack([across[:, shown], up[:, shown]], axis=-1),
        theta=moved.theta[-1],
        omega=moved.omega[-1],
        steps=int(np.sum(moved.steps)),
        seconds=seconds,
    )


def largest_step(n: int, duration: float = 1.0, most: float = 0.5) -> float:
    """The longest step [s], to a tenth, with which the classical Runge-Kutta scheme keeps a chain's energy.

    Kept: within ``most`` of the energy above rest, over ``duration`` [s] from the bow.
    """
    shortest = 0.2 / (2 * math.sqrt(3) * n * math.sqrt(GRAVITY / LENGTH))  # a small part of the fastest swing's period
    good, bad = shortest, duration
    if not _keeps(n, good, duration, most):
        return 0.0
    while bad / good > 1.1:
        middle = math.sqrt(good * bad)
        if _keeps(n, middle, duration, most):
            good = middle
        else:
            bad = middle
    return good


def _keeps(n: int, step: float, duration: float, most: float) -> bool:
    from .kernels.forward_dynamics import kernel_of

    system = chain(n)
    kernel = kernel_of(system)

    def slope(_: float, state: Array) -> Array:
        return np.stack([state[1], kernel(*state)])

    state = np.stack([bow(n), np.zeros(n)])
    _, lowest = energies(system, state[0] * 0, state[1])
    first = float(sum(energies(system, *state)))
    count = math.ceil(duration / step)
    with np.errstate(all="ignore"):
        for k in range(count):
            try:
                state = classical_step(slope, state, duration / count)
            except InvalidInput:  # beyond what the kernels take
                return False
            if k % 64 == 0 or k == count - 1:
                now = float(sum(energies(system, *state)))
                if not abs(now - first) <= most * (first - lowest):
                    return False
    return True


def _full(band: Array) -> Array:
    return np.asarray(np.diag(band[0]) + np.diag(band[1, 1:], 1) + np.diag(band[1, 1:], -1))
