"""The step map: one step of each of an engine's integrators is, to rounding, one step of a textbook scheme.

No trajectory and no truth are needed, only the reference's accelerations in extended precision: from a few random
states the engine takes one step, and so does every scheme of :mod:`furiko.reference.integration.schemes` that has the
order the engine's makers give theirs. The one that fits is named. An order that is measured passes any error of that
order; this does not: a wrong scheme misses by a power of step × fastest rate, 1e-9 and more, the right one by 1e-15.

How far rounding takes them apart is bounded, not chosen: see :mod:`furiko.checks.motions.step_rounding`, and for the
sharp line sampled (:mod:`furiko.reference.rounding.stepped`, which has the bound's arithmetic of one step, too).

The step is an eighth over the fastest rate at which links turn or nearby states part
(:func:`furiko.reference.variation.fastest_rate`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...records.check import Result
from ...reference.integration.variation import fastest_rate
from ...reference.rounding.stepped import step_bound
from .. import sharp
from ..cell import Cell, quotient, worst
from ..motions.step_rounding import (
    acceleration_error,
    conversion,
    disturbed,
    joints_apart,
    rate_of_positions,
    sharp_steps,
)
from ..motions.textbook import MAXIMAL, Candidate, candidates, says_whose_step

Array = NDArray[np.float64]
Wide = NDArray[Any]

NAME = "step map"

STATES = 3  # random states in which a step is taken
SHORT = 1 / 8  # step × fastest rate
LARGEST_N = 20  # links; beyond, extended precision takes longer than all other checks together


@dataclass(frozen=True)
class Steps:
    """States (B, n), the engine's coordinates after one step from each, and how long that is [s]."""

    theta: Array
    omega: Array
    alpha: Array
    h: float


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each integrator."""
    n = cell.scene.system.n
    if n > LARGEST_N:
        reason = f"schemes are applied in extended precision up to {LARGEST_N} links, not to {n}"
        yield cell.result(NAME, "skipped", reason=reason)
        return
    steps = chosen_steps(cell)
    textbook = Textbook(cell, steps)
    for integrator in cell.info.integrators:
        yield _compare(cell, integrator, steps, textbook)


def chosen_steps(cell: Cell) -> Steps:
    """The last of the cell's states (the random ones), and a step that is short for all of them."""
    theta, omega = cell.states.theta[-STATES:], cell.states.omega[-STATES:]
    fastest = max(float(fastest_rate(cell.scene.system, theta, omega).max()), float(np.abs(omega).max()))
    # A power of two, so that halves and sums of steps are exact.
    h = 2.0 ** math.floor(math.log2(SHORT / fastest)) if fastest > 0 else SHORT
    return Steps(theta, omega, cell.facts.high[-STATES:], h)


class Textbook:
    """The steps of every candidate from the same states, computed when first asked for."""

    def __init__(self, cell: Cell, steps: Steps) -> None:
        self._steps = steps
        self._candidates = candidates(cell, steps.omega)
        self._ends: dict[str, tuple[Wide, Wide]] = {}

    def of_order(self, order: int | None) -> list[Candidate]:
        """The candidates of this order, all of them for None."""
        return [candidate for candidate in self._candidates if order in (None, candidate.scheme.order)]

    def end(self, candidate: Candidate) -> tuple[Wide, Wide]:
        """θ and ω after its step, (B, n) each."""
        if candidate.name not in self._ends:
            self._ends[candidate.name] = candidate.end(self._steps.theta, self._steps.omega, self._steps.h)
        return self._ends[candidate.name]


def _compare(cell: Cell, integrator: Integrator, steps: Steps, textbook: Textbook) -> Result:
    pairs = zip(steps.theta, steps.omega, strict=True)
    got = np.array([cell.trajectory(t, w, integrator, steps.h, 1) for t, w in pairs])
    off = acceleration_error(cell, integrator, steps.theta, steps.omega, steps.alpha)

    def bounds(candidate: Candidate) -> Array:
        return rounding_bounds(cell, integrator, steps, candidate, off)

    unsolved: list[str] = []

    def all_fits(order: int | None) -> list[SchemeFit]:
        found = []
        for one in textbook.of_order(order):
            try:
                found.append(fit(got, textbook, one, bounds(one)))
            except ArithmeticError:  # an implicit scheme's equations: the step is too long for it
                unsolved.append(one.name)
        return sorted(found, key=lambda one: one.excess)

    fits = all_fits(integrator.order)
    if not fits or fits[0].excess > 1:
        fits = all_fits(None)
    if unsolved and (not fits or fits[0].excess > 1):
        reason = f"a step of {steps.h:.3g} s from these states is too long for {unsolved[0]}, which it may be"
        return cell.result(f"{NAME} {integrator.name}", "skipped", reason=reason)
    best, *rest = fits
    agrees = best.excess <= 1 and best.candidate.scheme.order == integrator.order
    within = [one.candidate for one in fits if one.excess <= 1] if agrees and not unsolved else []
    line = sharp_line(cell, integrator, steps, textbook, within, got) if sharp.is_known(cell.info) else None
    return cell.result(
        f"{NAME} {integrator.name}",
        **sharp.verdict(agrees, line, _reason(integrator, fits)),
        measured=best.measured,
        allowed=best.bound,
        unit="rad/s",
        details={
            "integrator": integrator.name,
            "scheme": best.candidate.scheme.name,
            "coordinates": best.candidate.coordinates,
            "step": steps.h,
            "states": len(got),
            "error of the angles": best.angles,
            "next best": {"scheme": rest[0].candidate.name, "error": rest[0].measured} if rest else None,
        }
        | (line.details() if line else {}),
    )


def sharp_line(
    cell: Cell, integrator: Integrator, steps: Steps, textbook: Textbook, within: list[Candidate], got: Array
) -> sharp.Line | None:
    """The engine's step (B, 2, n) against what rounding does to each angle and rate of it; None where it is not known.

    ``within``: the schemes whose step is the engine's within the proven bound. It may be any of them, and the bound,
    which has room for the worst, does not tell which: the one that rounding explains best is.
    """
    if not within:
        return None
    by = disturbed(cell, integrator, steps.theta, steps.omega, steps.alpha, steps.h)
    states = cell.states.at(np.arange(len(cell.states))[-STATES:])
    factor = sharp.for_steps(cell.info, integrator)
    lines: list[sharp.Line] = []
    for candidate in within:
        size = sharp_steps(cell, candidate, steps.theta, steps.omega, by, steps.h)
        error = (got - np.stack(textbook.end(candidate), axis=1)).astype(np.float64)
        rounding, left = (values.swapaxes(0, 1) for values in (size.rounding, size.left))
        lines.append(sharp.line(error, rounding, factor, states, len(states), left))
        if not lines[-1].loose:
            break
    return min(lines, key=lambda line: line.quotient)


@dataclass(frozen=True)
class SchemeFit:
    """How far a candidate is from what the engine did: worst rate [rad/s] and its bound, worst angle [rad].

    ``excess``: the worst of all angles and rates over their bounds. Where that is an angle's, ``measured`` is the rate
    that would be as bad.
    """

    candidate: Candidate
    excess: float
    bound: float
    angles: float

    @property
    def measured(self) -> float:
        """[rad/s]."""
        return self.excess * self.bound


def fit(got: Array, textbook: Textbook, candidate: Candidate, bounds: Array) -> SchemeFit:
    """Hold the engine's step, (B, 2, n), against a candidate's; ``bounds`` of angles and rates, (2, B, 1)."""
    angles, rates = textbook.end(candidate)
    off = np.abs(np.stack([got[:, 0] - angles, got[:, 1] - rates])).astype(np.float64)
    excess = worst(quotient(off, np.broadcast_to(bounds, off.shape)))
    bound = float(bounds[1, excess.index[1]].max())
    return SchemeFit(candidate, excess.value, bound, float(off[0].max()))


def rounding_bounds(
    cell: Cell, integrator: Integrator, steps: Steps, candidate: Candidate, acceleration: Array
) -> Array:
    """How far rounding may take angles and rates apart, (2, B, 1), with accelerations off by so much, (B,)."""
    h = steps.h
    size = np.abs(steps.omega) + h * np.abs(steps.alpha)
    turns = np.abs(steps.theta) + h * size
    angles, rates = step_bound(
        candidate.scheme, h, SHORT / h, acceleration, conversion(cell, turns), conversion(cell, size)
    )
    if candidate.coordinates == MAXIMAL:
        apart = joints_apart(cell, integrator, steps.theta)
        angles, rates = angles + apart, rates + rate_of_positions(h) * apart
    return np.stack([angles, rates])[..., None]


def _reason(integrator: Integrator, fits: list[SchemeFit]) -> str:
    best = fits[0]
    name = best.candidate.name
    if best.excess > 1:
        return (
            f"one step of {integrator.name} is no textbook scheme's; the nearest, {name}, misses by "
            f"{best.measured:.3g} rad/s, and rounding explains {best.bound:.3g}"
        )
    alike = [one.candidate.name for one in fits[1:] if one.excess <= 1]
    return says_whose_step(integrator, name, best.candidate.scheme.order, alike)
