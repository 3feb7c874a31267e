"""Trajectories: each of an engine's own integrators at four steps, against a truth in quadruple precision.

Two trajectories are never held against each other point by point: what an integrator of order p leaves after a fixed
time is C h^p + O(h^(p+1)). Four runs, at h, h/2, h/4 and h/8, give three things:

* the order that their differences show, which needs no truth: log₂ |y(h) - y(h/2)| / |y(h/2) - y(h/4)|, and the same
  of the finer three. The finer decides; that the coarser is near it shows that the expansion holds;
* where they converge to, and how sure that is (:mod:`furiko.reference.integration.richardson`);
* whether the truth lies there. If it does, the engine integrates the same mechanism.

In a chaotic motion errors grow until the expansion in h means nothing. The comparison therefore ends at the last of
the truth's times at which the coarse run is still near the fine one.

Rounding (:mod:`furiko.checks.motions.step_rounding`) comes on top, in each of the finest run's steps, and what it does
to a step grows until the end as any small difference does: how much, two runs from states beside the first tell.

What the extrapolation is sure to is far more than rounding. The sharp line is therefore drawn elsewhere: the coarsest
run, or the first of its steps, against the same steps of the textbook scheme, from which only rounding can part it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...models.states import States
from ...records.check import Result
from ...reference.integration.richardson import amplified
from ...reference.integration.schemes import SCHEMES
from ...reference.kernels.forward_dynamics import plain_accelerations
from ...reference.proved.kept import proof, sure
from ...reference.rounding.bounds import EPSILON
from ...reference.truth.end_points import PARTS, lookup
from .. import sharp
from ..cell import Cell, EngineFault
from ..motions.ladder import EndPoint, Ladder, Rounding, growth, run, settled
from ..motions.step_rounding import (
    Disturbed,
    conversion,
    disturbed,
    in_a_step,
    iterations_error,
    joints_apart,
    rounding_error,
    sharp_steps,
)
from ..motions.textbook import Candidate, candidates

Array = NDArray[np.float64]

NAME = "trajectory"

KERNELS = 1e-14  # what furiko's own accelerations are sure to, of the largest
ALIKE = 1e-6  # of a state: the step of another scheme of the same order is further off, or does not matter
TINY = 1e-300  # in place of zero, where nothing disturbs an entry that is zero
LARGEST_MAXIMAL = 20  # links of which maximal coordinates are stepped in extended precision beside an engine


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of the engine's integrators."""
    scene = cell.scene
    if scene.theta is None or scene.omega is None:
        return
    truth = lookup(scene.system, scene.theta, scene.omega, scene.duration)
    off, proved = sure(truth, proof(scene.system, scene.theta, scene.omega, scene.duration))
    error = (off + EPSILON * np.abs(truth.theta).max(-1)).tolist()
    points = tuple(map(EndPoint, [scene.duration * part for part in PARTS], truth.theta, error, proved))
    theta, omega = np.array([scene.theta, *truth.theta]), np.array([scene.omega, *truth.omega])
    states = theta, omega, plain_accelerations(scene.system, theta, omega)
    inexact = measured_error(cell, *states)
    for integrator in cell.info.integrators:
        yield _compare(cell, integrator, points, rounding(cell, integrator, *states, inexact), Passed(*states))


@dataclass(frozen=True)
class Passed:
    """States that the motion passes, the first being the scene's own, and their accelerations, (B, n) each."""

    theta: Array
    omega: Array
    alpha: Array


def _compare(
    cell: Cell, integrator: Integrator, points: tuple[EndPoint, ...], rounded: Rounding, passed: Passed
) -> Result:
    name, p = f"{NAME} {integrator.name}", integrator.order
    point, ladder = settled(cell, integrator, points, rounded)
    limit, uncertainty = ladder.limit(p)
    grown = growth(cell, integrator, ladder)
    noise = rounded.after(8 * ladder.steps, point.time, grown)
    bound = uncertainty + amplified(p) * noise + point.error
    if not math.isfinite(bound):
        raise EngineFault(f"{integrator.name}: a run from a state beside the scene's does not come to its end")
    missed = float(np.abs(limit - point.theta).max())
    coarser, order = ladder.orders()
    fits = order > p - 0.5 or not ladder.judges(p, noise)
    agrees = missed <= bound and fits
    line = sharp_line(cell, integrator, ladder, passed) if agrees and sharp.is_known(cell.info) else None
    return cell.result(
        name,
        **sharp.verdict(agrees, line, _reason(integrator, order, missed, bound, fits, ladder.settled(p))),
        measured=missed,
        allowed=bound,
        unit="rad",
        details={
            "integrator": integrator.name,
            "nominal order": p,
            "measured order": None if math.isnan(order) else order,
            "measured order, coarser runs": None if math.isnan(coarser) else coarser,
            "time": point.time,
            "truth": "proved" if point.proved else "estimated",
            "steps": [ladder.step / 2**k for k in range(4)],
            "errors": [_finite(float(np.abs(end[0] - point.theta).max())) for end in ladder.ends],
            "extrapolated error": missed,
            "rounding": noise,
            "growth of rounding": grown[0],
        }
        | (line.details() if line else {}),
    )


def sharp_line(cell: Cell, integrator: Integrator, ladder: Ladder, passed: Passed) -> sharp.Line | None:
    """The coarsest run's angles against those of the textbook scheme that it is, after the same steps.

    The two have the scheme's error in common, and rounding is all that is between them: by what it is in the states
    that the motion passes, sampled along the run. Where the first step is that of several schemes, which part later,
    the run may be any one's. None where no scheme of the order does as the first step does, or steps are too long.
    """
    theta, omega = passed.theta[:1], passed.omega[:1]
    if cell.info.coordinates == "maximal" and theta.size > LARGEST_MAXIMAL:
        return None
    steps = min(ladder.steps, sharp.steps_together(integrator, cell.scene.system.n, cell.few_steps))
    near, h = (passed.theta[:2], passed.omega[:2], passed.alpha[:2]), ladder.step
    by = disturbed(cell, integrator, *near, h, steps).worst()
    alike = schemes_of(cell, integrator, theta, omega, h, by)
    end = ladder.ends[0] if steps == ladder.steps or not alike else run(cell, integrator, steps * h, steps)
    state = States((f"after {steps} steps of {h:.3g} s",), theta, omega)
    factor = sharp.for_steps(cell.info, integrator)
    lines = []
    for candidate in alike:
        try:
            found = sharp_steps(cell, candidate, theta, omega, by, h, steps)
        except ArithmeticError:
            return None
        error = (end[:1] - found.exact[0]).astype(np.float64)
        lines.append(sharp.line(error, found.rounding[0], factor, state, 1, found.left[0]))
        if not lines[-1].loose:
            break
    return min(lines, key=lambda line: line.quotient, default=None)


def schemes_of(
    cell: Cell, integrator: Integrator, theta: Array, omega: Array, h: float, by: Disturbed
) -> list[Candidate]:
    """Textbook schemes of the integrator's order whose step from a state (1, n) may be the engine's, nearest first.

    Each entry is held against about what disturbs it in a step: schemes of one order may differ in an angle that is
    exact to its last digit by less than others' rates are off by. Near rest several do the same to rounding: all that
    are within the line's factor of it, in angles that may be differences of larger ones, are kept beside the nearest.
    None, where no step is the engine's to most of its digits.
    """
    got = run(cell, integrator, h, 1)
    factor = sharp.for_steps(cell.info, integrator)
    in_rates = h * (by.accelerations + by.left) + by.speeds + by.rates
    in_angles = h / 2 * in_rates + by.angles + by.turned
    found: list[Nearness] = []
    for candidate in candidates(cell, omega, literal=False):
        if candidate.scheme.order == integrator.order:
            try:
                end = np.concatenate(candidate.steps(theta, omega, h, 1)).astype(np.float64)
            except ArithmeticError:
                continue
            apart = np.abs(got - end)
            off = EPSILON * np.abs(end) + np.concatenate([in_angles, in_rates])
            widest = EPSILON * cell.amplitude.path_sums(end) + np.concatenate(in_a_step(candidate, by, h))
            found.append(
                Nearness(
                    candidate,
                    alike=bool((apart < ALIKE * (np.abs(end) + h * np.abs(end).max())).all()),
                    off=_times(apart, off),
                    least=_times(apart, np.maximum(off, widest)),
                )
            )
    nearest = min((one for one in found if one.alike), key=lambda one: one.off, default=None)
    if nearest is None:
        return []
    others = (one for one in found if one is not nearest and one.least <= factor)
    return [one.candidate for one in (nearest, *sorted(others, key=lambda one: one.off))]


@dataclass(frozen=True)
class Nearness:
    """How near a scheme's first step is to an engine's.

    ``alike``: to most digits; ``off``: in units of what disturbs each entry, ``least`` where that is the difference of
    larger ones.
    """

    candidate: Candidate
    alike: bool
    off: float
    least: float


def _times(apart: Array, off: Array) -> float:
    return float((apart / np.maximum(off, TINY)).max())


def measured_error(cell: Cell, theta: Array, omega: Array, alpha: Array) -> float:
    """How far the engine's accelerations are off on the way [rad/s²], from the true ones in states that it passes.

    In other states they are as far off, give or take a factor of ten, and in none further than rounding's own bound,
    which has room for the worst of everything at once.
    """
    bound = float(rounding_error(cell, theta, omega, alpha).max())
    try:
        answered = cell.answer("accelerations", cell.engine.accelerations(theta, omega), theta.shape)
    except Exception:
        return bound  # an engine that fails here has failed, or will, in a check of its own
    return min(bound, float(10 * np.abs(answered - alpha).max() + KERNELS * np.abs(alpha).max()))


def rounding(
    cell: Cell, integrator: Integrator, theta: Array, omega: Array, alpha: Array, accelerations: float
) -> Rounding:
    """The worst of what it is in the states (B, n) that the motion passes, with accelerations off by so much.

    A step adds a sum of stages to angles and rates: the addition is off by ε of these, the sum by ε of what changes in
    the step.
    """
    schemes = [scheme for scheme in SCHEMES if scheme.order == integrator.order]
    reach = max((scheme.reach for scheme in schemes), default=1.0)
    summed = 1 + max((scheme.stages for scheme in schemes), default=1)
    off = reach * (accelerations + iterations_error(cell, integrator, theta, omega, alpha).max())
    angles, rates, changes = (EPSILON * conversion(cell, np.abs(values)).max() for values in (theta, omega, alpha))
    if cell.info.coordinates == "maximal":
        # A joint that is apart in one step and not in the next has moved angles and rates there and back again.
        angles += joints_apart(cell, integrator, theta).max()
    return Rounding(float(angles), float(rates), float(summed * rates), float(off + summed * changes))


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _reason(integrator: Integrator, order: float, missed: float, bound: float, fits: bool, settled: bool) -> str:
    if not fits:
        return f"{integrator.name} is of order {integrator.order} and shows order {order:.2f}"
    if missed > bound and not settled:
        return f"{integrator.name} does not converge: order {order:.2f} with the finest steps"
    if missed > bound:
        return (
            f"{integrator.name} converges, but {missed:.3g} rad beside the true motion; its extrapolation to step zero "
            f"is sure to {bound:.3g} rad"
        )
    return f"order {order:.2f}; extrapolated to step zero the true motion is met"
