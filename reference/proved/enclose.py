"""``furiko.enclose``: intervals that are proved to contain the exact motion."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.mechanism import Mechanism
from ...models.spatial_mechanism import SpatialMechanism
from ...models.systems import System
from ...models.tree import PlanarTree
from ...models.trees.system import TreeSystem
from ..integration.starts import checked_times
from ..limits import checked_state
from .clouds import Cloud, box
from .follow import Limits, Progress, follow
from .form import Planar, planar
from .joints import in_joints
from .joints import start as start_in_joints
from .trees import planar_tree

Floats = NDArray[np.float64]
Balls = NDArray[Any]  # of python-flint's arb

DIGITS = 15  # what doubles hold
MOST_DIGITS = 1000
MOST_BITS = 4096  # of a step: beyond, a motion is called out of reach
WIDEST = -3.0  # log₂ of the largest radius of a cloud with a start as wide as asked: an eighth of a radian
SPARE = 6  # bits more than the growth seen so far asks for
# Directions (see clouds.py) cost twice as many series as there are coordinates, and save what balls alone lose. They
# are carried for a start that is a set, and where a run has shown that it is as much as this.
LOST = 700  # bits, from the start to the end; measured on three rods (cheaper without) and five (as cheap)
MOST_DIRECTED = 24  # coordinates and rates: beyond, precision is cheaper whatever is lost


@dataclass(frozen=True)
class Enclosed:
    """Intervals that contain the exact motion, at each of ``times`` [s] that was reached.

    ``times``, shape (m,): those of the times asked for, in their order, up to where the motion is proved.
    ``theta`` [rad], ``omega`` [rad/s]: balls (python-flint's ``arb``: ``mid()`` and ``rad()`` are exact), shape (m, n);
    of an open mechanism in space its joints' coordinates and rates, of what slides [m], [m/s]. ``theta_low``,
    ``theta_high``, ``omega_low``, ``omega_high``: the same as doubles, rounded outwards. ``proved_until``: the last
    time [s] up to which every interval is proved and as narrow as asked; it is the last time asked for if
    :attr:`complete`, else ``why`` says what ended it. ``bits``: of the steps' own errors; ``steps``: how many;
    ``seconds``: what it took.
    """

    times: Floats
    theta: Balls
    omega: Balls
    proved_until: float
    complete: bool
    why: str
    bits: int
    steps: int
    seconds: float
    theta_low: Floats = field(init=False, repr=False)
    theta_high: Floats = field(init=False, repr=False)
    omega_low: Floats = field(init=False, repr=False)
    omega_high: Floats = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for name in ("theta", "omega"):
            low, high = outward(getattr(self, name))
            object.__setattr__(self, f"{name}_low", low)
            object.__setattr__(self, f"{name}_high", high)

    @property
    def radius(self) -> Floats:
        """The largest radius at each time, of all angles [rad] and rates [rad/s], rounded up; shape (m,)."""
        found = [max(above(a.rad()) for a in (*t, *w)) for t, w in zip(self.theta, self.omega, strict=True)]
        return np.array(found, dtype=np.float64)

    def contains(self, theta: Any, omega: Any) -> NDArray[np.bool_]:
        """Whether these doubles are in the intervals; shape (m, n) in and out."""
        theta, omega = np.asarray(theta, np.float64), np.asarray(omega, np.float64)
        held = (self.theta_low <= theta) & (theta <= self.theta_high)
        return np.asarray(held & (self.omega_low <= omega) & (omega <= self.omega_high))


def enclose(
    system: System | PlanarTree | Mechanism | TreeSystem | SpatialMechanism,
    theta: Any,
    omega: Any,
    times: Any,
    digits: int = DIGITS,
    *,
    radius: float | tuple[float, float] = 0.0,
    seconds: float | None = None,
    watch: Callable[[float, float], None] | None = None,
) -> Enclosed:
    """Proved intervals of the motion of ``system`` from ``theta`` [rad], ``omega`` [rad/s] at ``times[0]``.

    ``system``: a document's system, a planar tree, or a mechanism with dampers and springs (friction is refused); or an
    open mechanism in space (``furiko.models.find_scene("cart-pole").system``) whose joints keep it in a plane: hinges
    about x, y or z of the world, slides across it before any hinge of their branch. Its ``theta`` and ``omega``, and
    those of the answer, are its joints' own coordinates q and rates v, in their order; limits act on nothing.
    ``theta``, ``omega``: shape (n,), doubles taken as exact; ``radius``: how much wider the start is, every angle and
    rate by the same, or a pair [rad], [rad/s]: the intervals then hold the motions of all those states. ``times`` [s]:
    shape (m,), rising or falling. ``digits``: a radius of at most 10^-digits is wanted, of the angles and the rates;
    with a ``radius`` there is no such goal. ``seconds``: after so long, what is proved by then is the answer.
    ``watch(time, log2_of_the_radius)`` is called after each step; an exception in it, or an interrupt, ends the run.

    How it is proved is in the pages on proved trajectories. A motion whose bounds grow beyond what 4096 bits hold is
    proved as far as it goes: look at ``complete`` or ``proved_until``. Raises InvalidInput for input that makes no
    sense.
    """
    from flint import arb

    began = clock.monotonic()
    mechanism = planar_tree(system) if isinstance(system, TreeSystem | SpatialMechanism) else planar(system)
    angles, rates = _state(mechanism, theta, omega)
    moments = [float(t) for t in checked_times(times)]
    if isinstance(digits, bool) or not isinstance(digits, int | np.integer) or not 1 <= digits <= MOST_DIGITS:
        raise InvalidInput(f"digits: an integer from 1 to {MOST_DIGITS} is needed, got {digits!r:.60}")
    x_radius, v_radius = _radii(radius)
    wide = x_radius > 0 or v_radius > 0
    deadline = math.inf if seconds is None else began + _positive_seconds(seconds)
    if mechanism.joints:
        start = start_in_joints(mechanism, angles, rates, (x_radius, v_radius))
    else:
        start = box([arb(a, x_radius) for a in angles], [arb(a, v_radius) for a in rates], directions=wide)
    goal = WIDEST if wide else -math.log2(10.0) * int(digits) - 1e-9
    if mechanism.joints and not wide:
        goal -= 1  # a joint's coordinate is a difference of two absolute angles
    if wide:
        bits = max(53, 24 - math.floor(math.log2(max(x_radius, v_radius))))
        progress = follow(mechanism, start, moments, bits, Limits(goal, deadline, watch))
    else:
        bits, progress = _with_enough_bits(mechanism, start, moments, Limits(goal, deadline, watch))
    return _enclosed(mechanism, progress, moments, bits, wide, clock.monotonic() - began)


def _with_enough_bits(p: Planar, start: Cloud, times: list[float], limits: Limits) -> tuple[int, Progress]:
    """The first run that comes to its end, each with as many bits more as the growth seen before asks for."""
    bits = math.ceil(-limits.widest) + 32
    best: tuple[int, Progress] | None = None
    whole = abs(times[-1] - times[0])
    while True:
        progress = follow(p, start, times, bits, limits)
        if best is None or _further(progress, best[1], times[0]):
            best = bits, progress
        if progress.stopped != "width" or bits >= MOST_BITS:
            return best[0], replace(best[1], stopped=progress.stopped)  # a later run may have ended for another reason
        done = abs(progress.time - times[0])
        lost, ratio = bits + limits.widest, whole / done if done else math.inf
        if not start.frame and lost * ratio > LOST and 2 * p.n <= MOST_DIRECTED:
            start = box(start.x, start.v, directions=True)
            bits = math.ceil(-limits.widest) + 64
        else:
            bits = min(MOST_BITS, max(bits + 32, math.ceil(min(3.0, 1.1 * ratio) * lost - limits.widest) + SPARE))


def _further(a: Progress, b: Progress, start: float) -> bool:
    return abs(a.time - start) > abs(b.time - start)


def _enclosed(p: Planar, progress: Progress, times: list[float], bits: int, wide: bool, seconds: float) -> Enclosed:
    rows = progress.rows
    complete = len(rows) == len(times)
    values = _values(p, rows, bits)
    n = len(rows[0].x)
    theta = np.empty((len(rows), n), dtype=object)
    omega = np.empty((len(rows), n), dtype=object)
    for i, (x, v) in enumerate(values):
        theta[i], omega[i] = x, v
    until = times[-1] if complete else progress.time
    why = {
        "": "",
        "time": "the time limit",
        "width": "the start's width has grown too far"
        if wide
        else f"the bounds grow beyond what {bits} bits hold: the motion is chaotic, or long",
        "step": "no step was proved there: a mass matrix that balls cannot show to be regular, or rates too fast",
    }[progress.stopped]
    return Enclosed(np.array(times[: len(rows)]), theta, omega, until, complete, why, bits, progress.steps, seconds)


def _values(p: Planar, rows: Sequence[Cloud], bits: int) -> list[tuple[list[Any], list[Any]]]:
    import flint

    with flint.ctx.workprec(bits + 64):
        return [(in_joints(p, row) if p.joints else row).values() for row in rows]


def outward(balls: Balls) -> tuple[Floats, Floats]:
    """Lower and upper ends of balls as doubles, rounded outwards; the same shape."""
    low, high = np.empty(balls.shape), np.empty(balls.shape)
    for place, ball in np.ndenumerate(balls):
        low[place], high[place] = -above(-ball), above(ball)
    return low, high


def above(ball: Any) -> float:
    """The least double that is not below the ball's upper end, or the next."""
    from flint import arb

    upper = ball.upper()
    nearest = float(upper)
    return nearest if arb(nearest) >= upper else math.nextafter(nearest, math.inf)


def _state(p: Planar, theta: Any, omega: Any) -> tuple[list[float], list[float]]:
    angles, rates = checked_state(p, theta, omega)
    if angles.ndim != 1:
        raise InvalidInput(f"theta: one state is enclosed at a time, shape ({p.n},), got shape {angles.shape}")
    return angles.tolist(), rates.tolist()


def _radii(radius: float | tuple[float, float]) -> tuple[float, float]:
    pair = tuple(radius) if isinstance(radius, tuple | list) else (radius, radius)
    fits = len(pair) == 2 and all(
        isinstance(r, int | float | np.floating) and not isinstance(r, bool) and 0 <= r <= 1 for r in pair
    )
    if not fits:
        raise InvalidInput(f"radius: a number from 0 to 1, or a pair of them, is needed, got {radius!r:.60}")
    return float(pair[0]), float(pair[1])


def _positive_seconds(seconds: Any) -> float:
    if isinstance(seconds, bool) or not isinstance(seconds, int | float | np.floating) or not seconds > 0:
        raise InvalidInput(f"seconds: a positive number is needed, got {seconds!r:.60}")
    return float(seconds)
