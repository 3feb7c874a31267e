"""Derivatives of the engine's accelerations and its inverse mass matrix, against those of the equations of motion."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...diagnosis.slopes import Mistake, cause_of, conventions, mistakes, of_own_accelerations
from ...records.check import Result
from ...reference import centrifugal_matrix, gravity_vector, mass_matrix
from ...reference.rounding.bounds import EPSILON, allowed, turns
from ...reference.rounding.derivatives import units
from ..cell import Cell, judge, relative_error, slopes
from ..facts import PART_OF

Array = NDArray[np.float64]

NAME = "derivatives"


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of ∂a/∂q, ∂a/∂v and M⁻¹, by the residual that it leaves in the engine's own coordinates.

    M times (the engine's matrix less the true one) is that residual, without the cancellation of computing it term by
    term; columns, too, are taken to the engine's coordinates.
    """
    cell = cell.of_offers.regular
    count = len(cell.facts.slopes)
    if not count:
        yield cell.result(NAME, "skipped", reason="in every state the mass matrix is singular but for rounding")
        return
    states = cell.states.at(np.arange(len(cell.states) - count, len(cell.states)))
    theta, omega, alpha = states.theta, states.omega, cell.facts.high[-count:]
    n, mass = cell.scene.system.n, mass_matrix(cell.scene.system, theta)
    sizes = units(cell.amplitude, mass, alpha, omega)
    epsilons = EPSILON * allowed(n, cell.info.accuracy) * turns(theta)
    answers = slopes(cell, cell.info.offers, theta, omega)
    to_own, from_own = cell.amplitude.to_absolute, cell.amplitude.from_absolute
    columns = (to_own, to_own, from_own.T)
    each = (sizes.of_positions, sizes.of_rates, sizes.inverse_mass)
    for part, (name, quantity, words) in enumerate(PART_OF):
        got = answers[part]
        if got is None:
            why = cell.info.lacks.get(quantity, "the engine's adapter does not offer it")
            yield cell.result(f"{NAME} {name}", "skipped", reason=why)
            continue
        true = cell.facts.slopes[:, part]
        error = (got - true) - cell.facts.slopes_low[:, part]
        found = judge(to_own.T @ mass @ error @ columns[part], each[part], epsilons)
        state, row, column = found.worst.index
        entry, label = f"[{row + 1},{column + 1}]", states.labels[state]
        reason, cause = f"{words}: worst at {entry}", None
        if not found.agrees:
            mistake = cause_of(got, _mistakes(cell, part, theta, omega, alpha), true)
            if mistake is None and part < 2:
                mistake = of_own_accelerations(cell.engine.accelerations, part, theta, omega, true)
            cause = mistake.cause if mistake else None
            off, says = relative_error(error, true), f": {mistake.says}" if mistake else ""
            reason = f"{words}: off by {off:.3g} of the largest entry, worst in row {row + 1} in state {label!r}{says}"
        yield cell.result(
            f"{NAME} {name}",
            "agrees" if found.agrees else "differs",
            reason=reason,
            cause=cause,
            details={
                "entry": entry,
                "state": label,
                "states": count,
                "forward error": relative_error(error, true),
            },
            **found.fields(),
        )


def _mistakes(cell: Cell, part: int, theta: Array, omega: Array, alpha: Array) -> Iterator[Mistake]:
    system, true, mass = cell.scene.system, cell.facts.slopes, mass_matrix(cell.scene.system, theta)
    yield from mistakes(part, true, mass)
    yield from conventions(part, true[:, part], cell.amplitude.carried)
    if part:
        return
    slope = gravity_vector(system, theta + np.pi / 2)
    centrifugal, rest = centrifugal_matrix(system, theta), np.zeros_like(theta)
    for says, weight, a, w in (
        ("gravity's share is left out", 0 * slope, alpha, omega),
        ("the accelerations that are held are taken as zero", slope, rest, omega),
        ("the rates that are held are taken as zero", slope, alpha, rest),
    ):
        given = np.asarray(-np.linalg.solve(mass, _held(mass, centrifugal, weight, a, w)), dtype=np.float64)
        yield Mistake("derivative-lacks-term", says, given)


def _held(mass: Array, centrifugal: Array, slope: Array, alpha: Array, omega: Array) -> Array:
    """∂F/∂θ of the equations' left side, θ̈ and θ̇ held, (K, n, n): see :mod:`furiko.reference.truth.derivatives`."""
    found = centrifugal * alpha[:, None, :] - mass * omega[:, None, :] ** 2
    n = mass.shape[-1]
    found[:, range(n), range(n)] += slope - found.sum(axis=-1)
    return found
