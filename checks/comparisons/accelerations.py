"""Accelerations: the engine's forward dynamics against the proven solution of the document's equations of motion."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, Amplitudes, allowed, turns
from ...reference.rounding.maximal_elimination import furthest_off
from .. import sharp
from ..cell import Cell, Worst, quotient, worst
from ..facts import forward_error

Array = NDArray[np.float64]

NAME = "accelerations"
SINGLE = 2.0**-23
SINGULAR = "the mass matrix is singular but for rounding: no digit of an acceleration is sure"


def compare(cell: Cell) -> Iterator[Result]:
    """Backward error in the engine's own coordinates decides; the forward error is shown beside the document's own.

    The true M applied to (engine's acceleration less the true one) is the residual of the engine's in the true
    equations, without the cancellation that computing it term by term would suffer.
    """
    cell, asked = cell.regular, len(cell.states)
    facts, system = cell.facts, cell.scene.system
    if not len(cell.states):
        yield cell.result(NAME, "skipped", reason=f"in every state {SINGULAR}")
        return
    got = cell.accelerations()
    error, judged = backward_error(cell, got, cell.amplitude)
    found = worst(np.where(judged[:, None], error, 0.0))
    bound = allowed(system.n, cell.info.accuracy)
    state, row = found.index
    forward = forward_error(facts, got)
    literal = forward_error(facts, facts.literal)
    moving = np.abs(facts.high).max(axis=-1) > np.abs(facts.high).max() * EPSILON
    cond = facts.cond_relative if cell.info.coordinates == "relative" else facts.cond_absolute
    details = {
        "states": len(cell.states),
        "states left out": asked - len(cell.states),
        "worst state": cell.states.labels[state],
        "worst angle": row + 1,
        "coordinates": cell.info.coordinates,
        "forward error": EPSILON * finite_max(forward, moving),
        "forward error, median": EPSILON * float(np.median(forward[moving])) if moving.any() else 0.0,
        "forward error of the document's formula": EPSILON * finite_max(literal, moving),
        "condition, absolute angles": finite_max(facts.cond_absolute, moving),
        "condition, engine's coordinates": finite_max(cond, moving),
        "inexact side": inexact_side(forward[moving], literal[moving]),
    }
    left = int((~judged).sum())
    if left:
        details["states not judged"] = left
    line = sharp_line(cell, got, error)
    yield cell.result(
        NAME,
        **sharp.verdict(found.value <= bound, line, _reason(found, bound, details) + _floor(cell)),
        measured=found.value,
        allowed=bound,
        unit="ε",
        details=details | (line.details() if line else {}),
    )
    if left and found.value <= bound:
        yield cell.not_judged(NAME, left)


def sharp_line(cell: Cell, accelerations: Array, backward: Array) -> sharp.Line | None:
    """Accelerations against what rounding does to each; ``backward`` error (B, n) chooses the states."""
    system, info = cell.scene.system, cell.info
    most = sharp.states_for_accelerations(info, system.n)
    if not most:
        return None
    at = sharp.chosen(backward.max(axis=-1), most)
    states, alpha = cell.states.at(at), cell.facts.high[at]
    size = sharp.widest(cell, spread.accelerations, states.theta, states.omega, alpha)
    factor = sharp.for_accelerations(info)
    return sharp.line(cell.facts.error(accelerations)[at], size, factor, states, len(cell.states))


def backward_error(cell: Cell, accelerations: Array, amplitude: Amplitudes) -> tuple[Array, NDArray[np.bool_]]:
    """Row residuals of ``accelerations`` in the true equations over Σ|terms|, in ε, (B, n); which states count, (B,).

    What elimination with row interchanges adds to the terms is seldom needed and costs more than all the rest: it is
    looked at in the states in which the others do not do. In maximal coordinates that is limited to about a second: the
    states furthest off are looked at. In the others, which do not count, the terms lack what elimination adds.
    """
    judged = np.ones(len(accelerations), dtype=np.bool_)
    system, theta, omega = cell.scene.system, cell.states.theta, cell.states.omega
    mass, turned = cell.mass, turns(theta)[:, None]
    error = cell.facts.error(accelerations)
    residual = amplitude.residual((mass @ error[..., None])[..., 0])
    rows = amplitude.rows(accelerations, omega) * turned
    allowance = EPSILON * allowed(system.n, cell.info.accuracy)
    beyond = np.asarray((np.abs(residual) > allowance * rows).any(axis=-1))
    if beyond.any():
        rows[beyond] = amplitude.rows(accelerations[beyond], omega[beyond], mass[beyond]) * turned[beyond]
        if cell.info.coordinates == "maximal":
            looked_at = furthest_off(beyond, quotient(residual, rows).max(axis=-1), cell.most_eliminations)
            rows[looked_at] += cell.elimination(theta[looked_at], omega[looked_at])[0]
            judged[beyond] = False
            judged[looked_at] = True
    return quotient(residual, EPSILON * rows), judged


def inexact_side(engine: Array, literal: Array) -> str:
    """Which side of a comparison carries the larger rounding: engine and document, each against the truth."""
    if not engine.size:
        return "neither"
    ours, theirs = float(np.max(literal)), float(np.max(engine))
    if max(ours, theirs) <= 64 or max(ours, theirs) <= 4 * min(ours, theirs):
        return "neither"
    return "engine" if theirs > ours else "document's formula"


def finite_max(values: Array, chosen: NDArray[np.bool_]) -> float:
    """The largest of the chosen values, 0 where there is none."""
    return float(np.max(values[chosen])) if chosen.any() else 0.0


def _floor(cell: Cell) -> str:
    """That an engine is held to less than double precision, where it is."""
    return f"; {cell.info.accuracy_reason}" if cell.info.accuracy >= SINGLE else ""


def _reason(found: Worst, bound: float, details: dict[str, Any]) -> str:
    if found.value > bound:
        return (
            f"the acceleration of angle {details['worst angle']} in state {details['worst state']!r} leaves a residual "
            f"of {found.value:.3g} ε of its equation's terms; rounding explains {bound:.3g} ε"
        )
    engine, formula = details["forward error"], details["forward error of the document's formula"]
    if details["inexact side"] == "neither":
        return f"both within {max(engine, formula):.1e} of the true accelerations"
    return (
        f"the {details['inexact side']} is the inexact side: the engine is within {engine:.1e} of the true "
        f"accelerations, the document's formula within {formula:.1e}"
    )
