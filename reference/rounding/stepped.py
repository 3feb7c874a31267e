"""The spread that rounding gives to a state after steps of an integrator: the steps in Monte-Carlo arithmetic.

Two things are moved at random, each by its own size: the accelerations, all along a run by the same part of their
spread (what an engine has of its mechanism's constants is off by the same in every step), and after every step angles
and rates by the last digits of what they are in the engine's own coordinates. Everything else is the scheme itself, so
that errors grow, or fade, as the motion makes them. The errors are magnified far above double precision's own.

The worst that rounding can do in one step is bounded, not sampled: :func:`step_bound`. A scheme hands the
accelerations' errors on to the rates times the step, to the angles times its square; that later stages start from
earlier ones' errors multiplies them by at most exp(stages × step × fastest rate).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from ..integration.schemes import Scheme, run
from ..integration.tree_schemes import TreeScheme
from ..kernels.forward_dynamics import plain_accelerations
from .bounds import EPSILON, Amplitudes
from .monte_carlo import ONE_ROUNDING
from .norms import root_mean_square

Array = NDArray[np.float64]

SAMPLES = 16  # the spread is then known to a fifth of itself
SEED = 20261127
# Far above what rounds in these runs themselves, and so small that errors which grow a million times stay linear.
MAGNIFIED = 2.0**14
# ε of a quaternion's components, of length one: five half ε to make it so, or the 1e-15 by which MuJoCo lets its length
# be, two for the sines and cosines of half a turn, four for the four products of each component.
QUATERNION = 12


@dataclass(frozen=True)
class Ends:
    """Angles [rad] and rates [rad/s] after the steps, (2, B, n): those of the scheme itself, in extended precision, and
    root mean squares of what rounding, and what iterations ``left``, makes of them."""

    exact: NDArray[Any]
    rounding: Array
    left: Array


def stepped(
    scheme: Scheme,
    system: DocumentSystem,
    amplitude: Amplitudes,
    state: tuple[Array, Array],
    h: float,
    steps: int,
    off: Array,
    *,
    left: Array,
    apart: Array | float = 0.0,
) -> Ends:
    """Steps of ``h`` seconds from states (B, n).

    ``off``: root mean square of the accelerations' error by rounding [rad/s²], (B, n), and what an implicit scheme's
    iterations leave in them besides; ``apart``: of what else rounding does to the angles in a step [rad], (B, n).
    Raises ArithmeticError where a run does not come to an end.
    """
    random = np.random.Generator(np.random.PCG64(SEED))
    # Runs: the scheme's own, those with roundings, those with what iterations leave.
    shape = (1 + SAMPLES * (2 if left.any() else 1), *off.shape)

    def rounded(size: Array) -> NDArray[Any]:
        """Random roundings of such sizes in those runs that have them."""
        found = np.zeros(shape)
        found[1 : 1 + SAMPLES] = MAGNIFIED * size * random.standard_normal((SAMPLES, *off.shape))
        return found

    with np.errstate(over="ignore"):
        moved = rounded(off)
        if left.any():
            moved[1 + SAMPLES :] = MAGNIFIED * left * random.standard_normal((SAMPLES, *off.shape))

    def accelerations(angles: Any, rates: Any) -> Any:
        return plain_accelerations(system, angles, rates) + moved

    def last_digits(values: Any) -> Any:
        own = np.abs(values[0].astype(np.float64) @ amplitude.from_absolute.T)
        return rounded(ONE_ROUNDING * own) @ amplitude.to_absolute.T

    def then(angles: Any, rates: Any) -> Any:
        return angles + last_digits(angles) + rounded(apart + 0 * off), rates + last_digits(rates)

    theta, omega = (np.broadcast_to(values, shape).astype(np.longdouble) for values in state)
    with np.errstate(all="ignore"):
        ends = np.stack(run(scheme, accelerations, theta, omega, h, steps, then))
    if not np.isfinite(ends).all():
        raise ArithmeticError("a run does not come to its end")
    errors = (ends[:, 1:] - ends[:, :1]).astype(np.float64) / MAGNIFIED
    spread = root_mean_square(errors[:, :SAMPLES], 1)
    kept = root_mean_square(errors[:, SAMPLES:], 1) if left.any() else np.zeros_like(spread)
    return Ends(ends[:, 0], spread, kept)


def step_bound(scheme: Scheme | TreeScheme, h: float, fastest: float, off: Array, angles: Array, rates: Array) -> Array:
    """How far rounding may take angles [rad] and rates [rad/s] from those of one step of ``h`` seconds, (2, …).

    ``fastest`` [1/s]: the rate at which nearby states part; ``off``: the accelerations' error [rad/s²]; ``angles``
    [rad], ``rates`` [rad/s]: the magnitudes that are added up to them, changes of coordinates included; (…) each.
    """
    amplified = scheme.reach * math.exp(scheme.stages * h * fastest)
    sums = EPSILON * (scheme.stages + 2)  # additions of a term for each stage, and the changes of coordinates
    of_rates = h * amplified * off + sums * rates
    return np.stack([h * of_rates + sums * angles, of_rates])
