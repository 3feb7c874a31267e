"""Trajectories by Taylor series: ``furiko.simulate``.

The series of both systems follow from the equations of :mod:`furiko.reference.kernels.elimination`, order by order,
without expanding any product but four a link. Let φ(t) = θ(t) - θ(t0) be a link's turn within the step and use the
frame it starts in, where p = (cos φ, sin φ), q = (-sin φ, cos φ). With coefficients of t^k in brackets, c = cos φ, s =
sin φ, ω = φ':

    (k+1) s[k+1] = (c ω)[k],   (k+1) c[k+1] = -(s ω)[k],   s[0] = 0,  c[0] = 1
    l p''[k] = (0, lθ''[k]) + W[k],   W[k] = l (k+1) (-Σ s[i] ω[k+1-i],  Σ c[i] ω[k+1-i]),  i = 1 … k+1

so W is known before θ''[k] is. **Rods** (Takeno (3), (6)): (m/3) lθ'' = q·F with F = T_j - (m/2) a_{j-1}, hence

    (m/3) lθ''[k] = q[0]·F[k] + R[k],   R[k] = Σ (c[i] F^q[k-i] - s[i] F^p[k-i]),  i = 1 … k

and with T[k] = -(Λ a_j[k] + β) every order has the same Λ, κ as the first: they are factored once a step. Up the chain

    β'_p = (κ(A m/3 + D) + m/2) W_p + κB (m W_q/3 + R) + β_p - κB β_q
    β'_q = κ ((m/2 + C) R + m (m/6 + C/3) W_q - (m/6) (B W_p + β_q))

(what cancels is multiplied out, as in :mod:`furiko.reference.kernels.elimination`), rotated into the parent's frame;
down it τ = R - B W_p - C W_q - β_q and b + lθ'' = κ(τ - B a - (m/6) b). At k = 0, where W_p = -l ω² and W_q = R = 0,
this is the elimination itself.

**N legs** (Shiki (3.9)): with A = a_1 and Φ = m1 A + Σ m_i (A + l_i p_i''), q_1·Φ = 0 and l_i θi'' = -q_i·A, hence
l_i θi''[k] = -q_i·A[k] - R_i[k], and with A = (A_p, G) in the frame of link 1

    G[k] = -(R_1 + Σ m_i (C_i (W_i,q - R_i) - S_i (C_i A_p + W_i,p))) / (m1 + Σ m_i S_i²)

where R_i is the convolution above of q_i with A (legs) or of q_1 with Φ (link 1).

Angles and rates are carried as sums of two doubles and angles within half a turn, so that a step rounds only what it
adds. The step is chosen so that the last terms are :func:`local_size` of the largest of the first, the order so that
this is cheapest.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.systems import System
from ..kernels.forward_dynamics import link_masses, processors, thread_pool
from ..limits import checked_state

Array = NDArray[np.float64]

FINEST = 1e-14  # a tolerance below this asks for more than doubles hold
SAFETY = 1e-2  # the error of a step over the tolerance: errors add up, and grow with the motion
STEPS_A_CALL = 20_000  # after so many, Python is given a chance to see an interrupt


@dataclass(frozen=True)
class Trajectory:
    """A motion at the times that were asked for.

    ``times`` [s], shape (m,); ``theta`` [rad] and ``omega`` [rad/s], shape (..., m, n), angles continuous in time;
    ``steps``: how many Taylor steps each trajectory took, shape (...).
    """

    times: Array
    theta: Array
    omega: Array
    tolerance: float
    steps: NDArray[np.int64]
    _finer: Callable[[], tuple[Array, Array]] = field(repr=False, compare=False)

    @cached_property
    def error(self) -> Array:
        """Estimated error at each time, shape (..., m): rad for angles, rates relative to the largest |ω|.

        From a second run of higher order and smaller steps, made when first asked for: twice the difference, and not
        less than the rounding of the result. An estimate, not a bound; near 1 no digit is correct.
        """
        theta, omega = self._finer()
        fastest = np.abs(self.omega).max(axis=(-2, -1), keepdims=True)
        rates = np.abs(self.omega - omega) / np.where(fastest > 0, fastest, 1)
        apart = np.maximum(np.abs(self.theta - theta), rates).max(axis=-1)
        rounding = np.finfo(float).eps * np.maximum(np.abs(self.theta).max(axis=-1), 1)
        return np.where(self.times == self.times[0], 0, 2 * apart + rounding)

    @property
    def warning(self) -> str:
        """Empty if the estimated error stays within the tolerance; else a sentence on what was reached and why."""
        worst = float(self.error.max(initial=0))
        if worst <= self.tolerance:
            return ""
        grown = worst / np.finfo(float).eps
        cause = (
            "double precision holds no more"
            if grown < 100
            else f"the motion, or its length, multiplies rounding errors by about {grown:.0e}"
        )
        return f"tolerance {self.tolerance:g} not reached, estimated error {worst:.1e}: {cause}"


def simulate(
    system: System, theta: Any, omega: Any, times: Any, tolerance: float = FINEST, *, threads: int | None = None
) -> Trajectory:
    """The motion of ``system`` from ``theta`` [rad], ``omega`` [rad/s] at ``times[0]``, given at all ``times`` [s].

    ``theta``, ``omega``: shape (..., n), the leading axes an ensemble; ``times``: shape (m,), rising or falling,
    repeats allowed. ``tolerance``: error wanted at the end (angles in rad, rates relative). A chaotic motion
    multiplies the rounding error of doubles, 1e-16, whatever the method; :attr:`Trajectory.error` estimates what was
    reached and :attr:`Trajectory.warning` says so where it is not the tolerance. ``threads``: at most so many, for
    ensembles.
    Raises :class:`InvalidInput` for input that makes no sense, and for motions too fast to be followed to the end.
    """
    angles, rates = checked_state(system, theta, omega)
    moments = checked_times(times)
    if not (isinstance(tolerance, int | float | np.floating) and 0 < tolerance <= 0.1):
        raise InvalidInput(f"tolerance: must be above 0 and at most 0.1, got {tolerance!r}")
    local = local_size(float(tolerance))
    order = best_order(local)

    def finer() -> tuple[Array, Array]:
        return _integrate(system, angles, rates, moments, order + 4, local * SAFETY, threads)[:2]

    out_theta, out_omega, steps = _integrate(system, angles, rates, moments, order, local, threads)
    return Trajectory(moments, out_theta, out_omega, float(tolerance), steps, finer)


def local_size(tolerance: float) -> float:
    """The size of a step's last terms relative to its first; at the finest below rounding."""
    return SAFETY * max(tolerance, FINEST)


def best_order(local: float) -> int:
    """The order P at which reaching ``local`` costs least.

    The step grows as local^(1/P). Work that grows as P² (the convolutions) is least at P = -ln(local)/2 (Jorba and Zou
    2005), work that grows as P at twice that; measured for 2, 5 and 100 rods, the best is flat about 0.72.
    """
    return max(6, math.ceil(-0.72 * math.log(local)))


def _integrate(
    system: System, theta: Array, omega: Array, times: Array, order: int, local: float, threads: int | None
) -> tuple[Array, Array, NDArray[np.int64]]:
    """All trajectories of an ensemble, each by one thread."""
    n = system.n
    starts = theta.reshape(-1, n), omega.reshape(-1, n)
    count = len(starts[0])
    out_theta, out_omega = np.empty((2, count, len(times), n))
    steps = np.zeros(count, np.int64)

    def one(b: int) -> int:
        return _follow(system, starts[0][b], starts[1][b], times, order, local, out_theta[b], out_omega[b])

    workers = min(processors(threads), count)
    spread = thread_pool().map if workers > 1 else map
    for first, taken in enumerate(spread(lambda first: [*map(one, range(first, count, workers))], range(workers))):
        steps[first::workers] = taken
    shape = (*theta.shape[:-1], len(times), n)
    return out_theta.reshape(shape), out_omega.reshape(shape), steps.reshape(theta.shape[:-1])


def _follow(
    system: System,
    theta: Array,
    omega: Array,
    times: Array,
    order: int,
    local: float,
    out_theta: Array,
    out_omega: Array,
) -> int:
    """One trajectory; writes (m, n) outputs and returns the number of steps."""
    from . import taylor_compiled as compiled

    kind = compiled.RODS if system.kind == "rod-chain" else compiled.LEGS
    masses, lengths = link_masses(system), np.array(system.lengths)
    state = np.zeros((system.n, compiled.STATE))
    compiled.start(theta, omega, state)
    clock, counts = np.array([times[0], 0.0]), np.zeros(2, np.int64)
    status = compiled.MORE
    while status == compiled.MORE:
        status = compiled.run(
            kind,
            masses,
            lengths,
            system.gravity,
            times,
            order,
            local,
            state,
            clock,
            counts,
            out_theta,
            out_omega,
            STEPS_A_CALL,
        )
    if status == compiled.BROKEN:
        raise InvalidInput(f"omega: the motion is too fast to be followed from t = {clock[0]:g} s to {times[-1]:g} s")
    at_start = times == times[0]
    out_theta[at_start], out_omega[at_start] = theta, omega  # as given, to the last bit
    return int(counts[1])


def checked_times(times: Any) -> Array:
    """``times`` as float64, (m,), finite and in order. Raises InvalidInput."""
    try:
        moments = np.array(times, np.float64)
    except (TypeError, ValueError):
        raise InvalidInput(f"times: an array of numbers is needed, got {str(times)[:60]}") from None
    if moments.ndim != 1 or len(moments) == 0:
        raise InvalidInput(f"times: one axis with at least one time is needed, got shape {moments.shape}")
    if not np.isfinite(moments).all():
        raise InvalidInput(f"times: must be finite, got {float(moments[~np.isfinite(moments)][0])}")
    steps = np.diff(moments)
    if (steps > 0).any() and (steps < 0).any():
        turn = int(np.argmax(steps * (moments[-1] - moments[0] or steps[np.nonzero(steps)[0][0]]) < 0)) + 1
        raise InvalidInput(
            f"times: must rise or fall throughout, but times[{turn - 1}] = {moments[turn - 1]:g} is followed by "
            f"times[{turn}] = {moments[turn]:g}"
        )
    return moments
