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
adds. The step is chosen so that the last terms are :func:`.starts.local_size` of the largest of the first, the order so
that this is cheapest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.systems import System
from ..kernels.ahead.load import kernel
from .layout import BROKEN, MORE, STATE
from .starts import (
    FINEST,
    STEPS_A_CALL,
    Starts,
    checked_starts,
    checked_times,
    checked_tolerance,
    empty_lanes,
    on_threads,
    run_lanes,
    step_accuracy,
    too_fast,
)

Array = NDArray[np.float64]


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
        """Estimated error at each time, shape (..., m): rad for angles, rates relative to the fastest.

        From a second run of higher order and smaller steps, made when first asked for: twice the difference, and not
        less than the rounding of the result and of the steps, ε √steps. An estimate, not a bound; near 1 no digit is
        correct.
        """
        theta, omega = self._finer()
        fastest = np.abs(self.omega).max(axis=(-2, -1), keepdims=True)
        rates = np.abs(self.omega - omega) / np.where(fastest > 0, fastest, 1)
        apart = np.maximum(np.abs(self.theta - theta), rates).max(axis=-1)
        # Each step rounds what it adds, so that two runs may agree by chance to less than what they have in common.
        steps = np.sqrt(self.steps)[..., np.newaxis]
        rounding = np.finfo(float).eps * (np.maximum(np.abs(self.theta).max(axis=-1), 1) + steps)
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
    system: System | Sequence[System],
    theta: Any,
    omega: Any,
    times: Any,
    tolerance: float = FINEST,
    *,
    threads: int | None = None,
) -> Trajectory:
    """The motion of ``system`` from ``theta`` [rad], ``omega`` [rad/s] at ``times[0]``, given at all ``times`` [s].

    ``theta``, ``omega``: shape (..., n), the leading axes an ensemble; ``times``: shape (m,), rising or falling,
    repeats allowed. ``system``: also several of one kind and number of links, one a start (theta of shape (B, n)), or
    all from one start (theta of shape (n,)). ``tolerance``: error wanted at the end (angles in rad, rates relative). A
    chaotic motion multiplies the rounding error of doubles, 1e-16, whatever the method; :attr:`Trajectory.error`
    estimates what was reached and :attr:`Trajectory.warning` says so where it is not the tolerance. ``threads``: at
    most so many, for ensembles. An ensemble's members run eight at a time and depend on none of the others; a motion
    that is run alone differs from the same one in an ensemble by rounding.
    Raises :class:`InvalidInput` for input that makes no sense, and for motions too fast to be followed to the end.
    """
    starts = checked_starts(system, theta, omega)
    moments = checked_times(times)
    wanted = checked_tolerance(tolerance)

    def finer() -> tuple[Array, Array]:
        return _integrate(starts, moments, *step_accuracy(wanted, finer=True), threads)[:2]

    out_theta, out_omega, steps = _integrate(starts, moments, *step_accuracy(wanted), threads)
    return Trajectory(moments, out_theta, out_omega, wanted, steps, finer)


@dataclass(frozen=True)
class _Runs:
    """Trajectories to compute, and where to write them: B rows each.

    masses, lengths, theta, omega: (B, n); gravity, steps: (B,); out_theta, out_omega: (B, m, n).
    """

    masses: Array
    lengths: Array
    gravity: Array
    theta: Array
    omega: Array
    steps: NDArray[np.int64]
    out_theta: Array
    out_omega: Array

    def part(self, rows: slice | int) -> _Runs:
        """Some of them; the arrays are views."""
        return _Runs(*(getattr(self, each.name)[rows] for each in fields(self)))


def _integrate(
    starts: Starts, times: Array, order: int, local: float, threads: int | None
) -> tuple[Array, Array, NDArray[np.int64]]:
    """All trajectories of an ensemble, in as many parts as threads."""
    kind, count = starts.kind, starts.count
    angles, rates = starts.rows()
    out_theta, out_omega = np.empty((2, count, len(times), starts.n))
    runs = _Runs(*starts.links(), angles, rates, np.zeros(count, np.int64), out_theta, out_omega)
    if count == 1:
        runs.steps[0] = _follow(kind, runs.part(0), times, order, local)
    else:
        on_threads(count, threads, lambda rows: _follow_lanes(kind, runs.part(rows), times, order, local))
    at_start = times == times[0]
    out_theta[:, at_start], out_omega[:, at_start] = angles[:, np.newaxis], rates[:, np.newaxis]  # to the last bit
    shape = (*starts.shape, len(times), starts.n)
    return out_theta.reshape(shape), out_omega.reshape(shape), runs.steps.reshape(starts.shape)


def _follow_lanes(kind: str, runs: _Runs, times: Array, order: int, local: float) -> None:
    """Many trajectories, eight at a time."""
    run = kernel("run_rod_lanes" if kind == "rod-chain" else "run_leg_lanes")
    state, factors, clock, lanes = empty_lanes(runs.theta.shape[1])
    given = runs.masses, runs.lengths, runs.gravity, runs.theta, runs.omega, times, order, local
    kept = state, factors, clock, lanes, runs.steps, runs.out_theta, runs.out_omega
    run_lanes(lambda steps: run(*given, *kept, steps), clock, lanes, times[-1])


def _follow(kind: str, run: _Runs, times: Array, order: int, local: float) -> int:
    """One trajectory, of which the arrays have one axis less. Returns the number of steps."""
    start, advance = kernel("start"), kernel("run_rods" if kind == "rod-chain" else "run_legs")
    state = np.zeros((len(run.theta), STATE))
    start(run.theta, run.omega, state)
    clock, counts = np.array([times[0], 0.0]), np.zeros(2, np.int64)
    given = run.masses, run.lengths, float(run.gravity), times, order, local
    status = MORE
    while status == MORE:
        status = advance(*given, state, clock, counts, run.out_theta, run.out_omega, STEPS_A_CALL)
    if status == BROKEN:
        raise too_fast(clock[0], times[-1])
    return int(counts[1])
