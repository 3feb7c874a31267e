"""How small differences grow along motions: ``furiko.lyapunov`` and ``furiko.stretching``.

The equations of motion's first variation is integrated with the motion, by the same Taylor steps
(:mod:`.taylor_tangents`): no difference quotient, and no trajectory beside the trajectory.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.states import natural_rate
from ...models.systems import System
from ..kernels.ahead.load import kernel
from ..kernels.sizes import EIGHT
from .layout import DIFFERENCE, FACTORS, SCALES
from .starts import (
    FINEST,
    Starts,
    checked_starts,
    checked_times,
    checked_tolerance,
    empty_lanes,
    on_threads,
    run_lanes,
    step_accuracy,
)

Array = NDArray[np.float64]
EPSILON = float(np.finfo(np.float64).eps)


@dataclass(frozen=True)
class Exponents:
    """Finite-time Lyapunov exponents at ``times`` [s], shape (m,), from the start at ``times[0]``.

    ``logarithm``, shape (..., m, k): natural logarithm of what the first, the second … direction has grown by, each
    orthogonal to those before; ``steps``, shape (...): Taylor steps of each start.
    """

    times: Array
    logarithm: Array
    tolerance: float
    steps: NDArray[np.int64]
    _finer: Callable[[], Array] = field(repr=False, compare=False)

    @property
    def exponents(self) -> Array:
        """Mean growth rates since ``times[0]`` [1/s], shape (..., m, k); not a number at that time."""
        return _rates(self.logarithm, self.times[:, np.newaxis])

    @cached_property
    def error(self) -> Array:
        """Estimated error of :attr:`exponents` [1/s], shape (..., m, k): an estimate, not a bound.

        Twice the difference from a second run of higher order and smaller steps, and not less than rounding. Where the
        motion is chaotic for so long that doubles lose it, the two runs are of two motions from about one state: then
        this says how much the mean growth of such motions varies. It says nothing on how far the exponent over a finite
        time is from its limit.
        """
        apart = 2 * np.abs(self.logarithm - self._finer()) + _rounding(self.steps)[..., np.newaxis]
        return _rates(apart, self.times[:, np.newaxis])


@dataclass(frozen=True)
class Stretching:
    """Growth of the small difference that grows most, from ``times[0]`` to each of ``times`` [s], shape (m,).

    ``logarithm``, shape (..., m): the natural logarithm of the factor, the largest singular value of the flow's
    derivative; ``direction``, shape (..., m, 2n): that difference at the start, (δθ [rad], δω by its unit), of length
    one, its sign free; ``steps``, shape (...): Taylor steps of each start.
    """

    times: Array
    logarithm: Array
    direction: Array
    tolerance: float
    steps: NDArray[np.int64]
    _finer: Callable[[], Array] = field(repr=False, compare=False)

    @property
    def exponent(self) -> Array:
        """Finite-time Lyapunov exponent (FTLE) [1/s], shape (..., m); not a number at ``times[0]``."""
        return _rates(self.logarithm, self.times)

    @cached_property
    def error(self) -> Array:
        """Estimated error of :attr:`logarithm`, shape (..., m), that is of the factor relative to it.

        As that of :class:`Exponents`: twice the difference from a finer run, and not less than rounding.
        """
        return np.asarray(2 * np.abs(self.logarithm - self._finer()) + _rounding(self.steps))


def lyapunov(
    system: System | Sequence[System],
    theta: Any,
    omega: Any,
    times: Any,
    tolerance: float = FINEST,
    *,
    count: int = 1,
    rate: float | None = None,
    threads: int | None = None,
) -> Exponents:
    """The ``count`` largest finite-time Lyapunov exponents along each motion from ``theta`` [rad], ``omega`` [rad/s].

    ``system``, ``theta``, ``omega`` (..., n), ``times`` (m,) [s], ``tolerance``, ``threads``: as of
    :func:`furiko.simulate`; many starts run eight at a time. ``count``: at most 2n, the whole spectrum. ``rate``
    [rad/s]: what δω counts by, so that it is δω of so much that is as large as δθ of one radian; √(g/L), of the longest
    chain of links, if not given (1 without gravity). For long times no exponent depends on it.

    The differences begin in directions at right angles that no symmetry makes special, the same in every call; they are
    carried by the equations of motion's first variation and made orthogonal after each step (Benettin et al. 1980).
    Raises :class:`InvalidInput` as :func:`furiko.simulate` does.
    """
    starts = checked_starts(system, theta, omega)
    if isinstance(count, bool) or not isinstance(count, int | np.integer) or not 1 <= count <= 2 * starts.n:
        raise InvalidInput(f"count: an integer from 1 to {2 * starts.n}, twice the links, is needed, got {count!r:.60}")
    first = general_directions(2 * starts.n)[: int(count)]
    run = _Run(starts, checked_times(times), first, _scales(starts, rate), threads)
    wanted = checked_tolerance(tolerance)
    found = run.grown(wanted)
    return Exponents(run.times, found.growth, wanted, found.steps, lambda: run.grown(wanted, finer=True).growth)


def stretching(
    system: System | Sequence[System],
    theta: Any,
    omega: Any,
    times: Any,
    tolerance: float = FINEST,
    *,
    rate: float | None = None,
    threads: int | None = None,
) -> Stretching:
    """How much the small difference that grows most has grown, along each motion from ``theta`` [rad], ``omega``.

    The largest singular value of the derivative of the flow from ``times[0]`` to each of ``times`` [s], as a logarithm;
    divided by the time it is the finite-time Lyapunov exponent whose ridges are Lagrangian coherent structures. Times
    may fall: then it is the stretching backwards. ``rate`` [rad/s]: what δω counts by, as of :func:`furiko.lyapunov`;
    this answer depends on it. All else as of :func:`furiko.simulate`.
    """
    starts = checked_starts(system, theta, omega)
    run = _Run(starts, checked_times(times), np.eye(2 * starts.n), _scales(starts, rate), threads)
    wanted = checked_tolerance(tolerance)
    found = run.grown(wanted, products=True)
    logarithm, direction = largest_growth(found)
    return Stretching(
        run.times,
        logarithm,
        direction,
        wanted,
        found.steps,
        lambda: largest_growth(run.grown(wanted, products=True, finer=True))[0],
    )


def lyapunov_time(system: System, theta: Array, omega: Array, duration: float) -> float:
    """The time [s] in which the most sensitive small difference grows e-fold, on average over ``duration`` [s].

    Of the motion from one state (n,). Where that is chaotic for so long that doubles lose it, it is of a motion from a
    state beside it; the growth is as typical. Infinite where nothing grows. A motion that is not chaotic has one too,
    about its duration: differences then grow in proportion to time.
    """
    grown = float(stretching(system, theta, omega, [0.0, duration]).logarithm[-1])
    return duration / grown if grown > 0 else float("inf")


def general_directions(size: int) -> Array:
    """Orthonormal directions, rows, that no symmetry of a mechanism makes special; the same ones always."""
    return np.linalg.qr(np.random.Generator(np.random.PCG64(17)).normal(size=(size, size)))[0]


@dataclass(frozen=True)
class Grown:
    """``growth``: (..., m, k); ``products``, (..., m, 2n, 2n), and ``size``, (..., m): R = products · e^size."""

    growth: Array
    products: Array
    size: Array
    steps: NDArray[np.int64]


def largest_growth(found: Grown) -> tuple[Array, Array]:
    """ln of the largest singular value, (..., m), and its direction at the start, (..., m, 2n)."""
    _, values, right = np.linalg.svd(found.products)
    return found.size + np.log(values[..., 0]), right[..., 0, :]


@dataclass(frozen=True)
class _Run:
    """Starts and differences; ``first``: rows (δθ, δω by ``scale``), orthonormal; ``scale``: (B,) [rad/s]."""

    starts: Starts
    times: Array
    first: Array
    scale: Array
    threads: int | None

    def grown(self, tolerance: float, *, products: bool = False, finer: bool = False) -> Grown:
        """How much the differences have grown at each time; ``finer``: in smaller steps of higher order."""
        starts, m, k = self.starts, len(self.times), len(self.first)
        order, local = step_accuracy(tolerance, finer=finer)
        total = starts.count
        given = (*starts.links(), *starts.rows())
        out = (
            *np.empty((2, total, m, starts.n)),
            np.empty((total, m, k)),
            np.empty((total if products else 0, m, k, k)),
            np.empty((total if products else 0, m)),
        )
        steps = np.zeros(total, np.int64)

        def follow(rows: slice) -> None:
            self._follow([a[rows] for a in given], order, local, steps[rows], [a[rows] for a in out], self.scale[rows])

        on_threads(total, self.threads, follow)
        growth, product, size = (a.reshape(*starts.shape, *a.shape[1:]) if len(a) == total else a for a in out[2:])
        growth[..., self.times == self.times[0], :] = 0.0
        return Grown(growth, product, size, steps.reshape(starts.shape))

    def _follow(
        self, given: list[Array], order: int, local: float, steps: NDArray[np.int64], out: list[Array], scale: Array
    ) -> None:
        run = kernel("run_rod_tangents" if self.starts.kind == "rod-chain" else "run_leg_tangents")
        n, k = self.starts.n, len(self.first)
        state, factors, clock, lanes = empty_lanes(n)
        first = np.ascontiguousarray(self.first.reshape(k, DIFFERENCE, n))
        still = np.zeros((n, FACTORS, EIGHT))
        differences, product = np.zeros((k, DIFFERENCE, n, EIGHT)), np.zeros((k, k, EIGHT))
        growth, scales = np.zeros((k, EIGHT)), np.zeros((SCALES, EIGHT))
        begun = *given, self.times, order, local, state, factors, clock, lanes, steps, *out[:2]
        beside = first, scale, still, differences, product, growth, scales, *out[2:]
        run_lanes(lambda count: run(*begun, *beside, count // k + 1), clock, lanes, self.times[-1])


def _scales(starts: Starts, rate: float | None) -> Array:
    """What δω counts by [rad/s], for each start."""
    if rate is None:
        return starts.each(natural_rate, ())
    if isinstance(rate, bool) or not isinstance(rate, int | float | np.floating) or not 1e-50 < rate < 1e50:
        raise InvalidInput(f"rate: a positive number [rad/s] is needed, got {rate!r:.60}")
    return np.full(starts.count, float(rate))


def _rates(logarithm: Array, times: Array) -> Array:
    """Divided by the time since the first; not a number there."""
    passed = np.abs(times - times[0])
    return np.asarray(logarithm / np.where(passed > 0, passed, np.nan))


def _rounding(steps: NDArray[np.int64]) -> Array:
    """What rounding leaves of a logarithm, (..., 1): each step rounds its factor, and a hundred terms are in one."""
    return np.asarray(100 * EPSILON * np.sqrt(1.0 + steps)[..., np.newaxis])
