"""The step map: one step of each of an engine's integrators is, to rounding, one step of a textbook scheme.

As :mod:`furiko.checks.comparisons.step_map` has it, of mechanisms of hinges and slides, whose coordinates are their own
rates' integrals. Where joints have dampers, an engine may also take their force at the end of the step: with D the
dampers and a the accelerations of the state before, semi-implicit Euler then is

    v⁺ = v + h (M + h D)⁻¹ M a,    q⁺ = q + h v⁺.

How far rounding takes angles, lengths and their rates apart is bounded for each coordinate, since their units differ.
The accelerations' error of row i is |M⁻¹| times the backward error that rounding explains; later stages start from the
earlier ones' errors e: these add (h² |∂a/∂q| + h |∂a/∂v|) e to it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...records.check import Result
from ...reference.integration.schemes import SCHEMES, Scheme
from ...reference.integration.tree_variation import accelerations, slopes
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.stepped import step_bound
from ..cell import quotient, worst
from ..motions.textbook import says_whose_step
from .cell import TreeCell

Array = NDArray[np.float64]
Wide = NDArray[Any]

NAME = "step map"

STATES = 3  # random states in which a step is taken
SHORT = 1 / 8  # step × fastest rate
OWN = 2.0  # the engine's accelerations have rounding, and the numbers that these ones are computed from


@dataclass(frozen=True)
class Steps:
    """The states (B, nv) from which an engine takes a step of ``h`` seconds, and what accelerations are there.

    ``by_q``, ``by_v``: |∂a/∂q| and |∂a/∂v|, (B, nv, nv), to some digits.
    """

    cell: TreeCell
    h: float
    q: Array
    v: Array
    by_q: Array
    by_v: Array

    @cached_property
    def mass(self) -> Array:
        """M, (B, nv, nv)."""
        return self.cell.facts.mass_matrix[-STATES:]

    @cached_property
    def accelerations(self) -> Array:
        """a, (B, nv)."""
        return self.cell.facts.high[-STATES:]

    def off(self, integrator: Integrator) -> Array:
        """The error of an engine's accelerations by rounding, and by iterations that end early, (B, nv).

        The residual that iterations leave is a norm over all rows, hence of any row.
        """
        units = np.array(
            [
                one.residual(a, mass, factorised=self.cell.info.algorithm != "aba")
                for one, a, mass in zip(self.cell.magnitudes[-STATES:], self.accelerations, self.mass, strict=True)
            ]
        )
        left = integrator.tolerance * np.linalg.norm(units, axis=-1, keepdims=True)
        backward = OWN * EPSILON * self.cell.roundings[-STATES:, None] * units + left
        return np.asarray((np.abs(np.linalg.inv(self.mass)) @ backward[..., None])[..., 0])


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each integrator."""
    steps = chosen_steps(cell)
    textbook = Textbook(steps)
    for integrator in cell.info.integrators:
        yield _compare(cell, integrator, steps, textbook)


def chosen_steps(cell: TreeCell) -> Steps:
    """The last of the cell's states (the random ones), and a step that is short for all of them."""
    q, v = cell.states.q[-STATES:], cell.states.v[-STATES:]
    by_q, by_v = map(np.abs, slopes(cell.mechanism, q, v))
    parting = math.sqrt(float(np.abs(by_q).sum(-1).max())) + float(np.abs(by_v).sum(-1).max())
    turning = [abs(v[:, one.at_v]).max() for one in cell.mechanism.joints if one.joint.kind == "hinge"]
    fastest = max(parting, *map(float, turning), 0.0)
    # A power of two, so that halves and sums of steps are exact.
    h = 2.0 ** math.floor(math.log2(SHORT / fastest)) if fastest > 0 else SHORT
    return Steps(cell, h, q, v, by_q, by_v)


class Textbook:
    """The steps of every scheme from the same states, computed when first asked for."""

    def __init__(self, steps: Steps) -> None:
        self._steps = steps
        self._ends: dict[str, Wide | None] = {}
        damping = np.diag(steps.cell.mechanism.per_freedom("damping"))
        self.schemes = (*SCHEMES, _with_damping_late(steps.mass, damping)) if damping.any() else SCHEMES

    def end(self, scheme: Scheme) -> Wide | None:
        """q and v after its step, (2, B, nv); None where the step is too long for it."""
        if scheme.name not in self._ends:
            q, v = self._steps.q.astype(np.longdouble), self._steps.v.astype(np.longdouble)
            try:
                ends = scheme.step(
                    lambda *at: accelerations(self._steps.cell.mechanism, *at), q, v, np.longdouble(self._steps.h)
                )
                self._ends[scheme.name] = np.stack(ends)
            except ArithmeticError:
                self._ends[scheme.name] = None
        return self._ends[scheme.name]


def _with_damping_late(mass: Array, damping: Array) -> Scheme:
    """Semi-implicit Euler with the dampers' force at the end of the step; ``mass``: M of the states it is taken from.

    (M + h D)⁻¹ M a is a − (M + h D)⁻¹ h D a, in which the second part, which double precision gives, is small.
    """

    def step(accelerations: Any, q: Wide, v: Wide, h: Any) -> tuple[Wide, Wide]:
        a = accelerations(q, v)
        late = float(h) * damping
        less = np.linalg.solve(mass + late, (late @ a.astype(np.float64)[..., None]))[..., 0]
        end = v + h * (a - less)
        return q + h * end, end

    return Scheme("semi-implicit Euler, dampers at the end of the step", 1, step, stages=2)


@dataclass(frozen=True)
class Fit:
    """A scheme, the worst of an engine's coordinates and rates over what rounding explains, and where it is."""

    scheme: Scheme
    excess: float
    place: tuple[int, ...]
    bound: float


def _compare(cell: TreeCell, integrator: Integrator, steps: Steps, textbook: Textbook) -> Result:
    ends = [cell.trajectory(q, v, integrator, steps.h, 1) for q, v in zip(steps.q, steps.v, strict=True)]
    got = np.stack(ends, axis=1)
    off = steps.off(integrator)
    bounds = {scheme.name: bound(scheme, off, steps) for scheme in textbook.schemes}

    def fits(schemes: list[Scheme]) -> list[Fit]:
        found = []
        for scheme in schemes:
            end = textbook.end(scheme)
            if end is not None:
                excess = worst(quotient(np.abs(got - end).astype(np.float64), bounds[scheme.name]))
                place = tuple(map(int, excess.index))
                found.append(Fit(scheme, excess.value, place, float(bounds[scheme.name][place])))
        return sorted(found, key=lambda one: one.excess)

    expected = [scheme for scheme in textbook.schemes if scheme.order == integrator.order]
    found = fits(expected)
    if not found or found[0].excess > 1:
        found = fits(list(textbook.schemes))
    name = f"{NAME} {integrator.name}"
    unsolved = [scheme.name for scheme in expected if textbook.end(scheme) is None]
    if not found or (unsolved and found[0].excess > 1):
        reason = f"a step of {steps.h:.3g} s from these states is too long for {unsolved[0]}, which it may be"
        return cell.result(name, "skipped", reason=reason)
    best, *rest = found
    agrees = best.excess <= 1 and best.scheme.order == integrator.order
    return cell.result(
        name,
        "agrees" if agrees else "differs",
        measured=best.excess * best.bound,
        allowed=best.bound,
        unit=_unit(cell, best.place),
        reason=_reason(cell, integrator, best, rest),
        details={
            "integrator": integrator.name,
            "scheme": best.scheme.name,
            "step": steps.h,
            "states": got.shape[1],
            "next best": {"scheme": rest[0].scheme.name, "error": rest[0].excess * rest[0].bound} if rest else None,
        },
    )


def bound(scheme: Scheme, first: Array, steps: Steps) -> Array:
    """How far rounding may take an engine from a scheme's step, in each coordinate and rate, (2, B, nv).

    ``first``: the accelerations' error in the first stage, (B, nv).
    """
    h, off = steps.h, first
    carried = h * h * steps.by_q + h * steps.by_v
    for _ in range(scheme.stages):
        off = first + (carried @ off[..., None])[..., 0]
    rates = np.abs(steps.v) + h * np.abs(steps.accelerations)
    # An engine may count from each joint's ref: that is taken off before the step, and added after it.
    counted = np.abs(steps.q) + 2 * np.abs([one.joint.ref for one in steps.cell.mechanism.joints])
    return step_bound(scheme, h, 0.0, off, counted + h * rates, rates)


def _unit(cell: TreeCell, place: tuple[int, ...]) -> str:
    """The unit of a coordinate or rate at ``place``: which of the two, the state, the degree of freedom."""
    which, _, freedom = place
    slides = {one.at_v for one in cell.mechanism.joints if one.joint.kind == "slide"}
    return ("m" if freedom in slides else "rad") + ("/s" if which else "")


def _reason(cell: TreeCell, integrator: Integrator, best: Fit, rest: list[Fit]) -> str:
    if best.excess > 1:
        unit = _unit(cell, best.place)
        return (
            f"one step of {integrator.name} is no textbook scheme's; the nearest, {best.scheme.name}, misses "
            f"{cell.freedom(best.place[2])!r} by {best.excess * best.bound:.3g} {unit}, and rounding explains "
            f"{best.bound:.3g}"
        )
    alike = [one.scheme.name for one in rest if one.excess <= 1]
    return says_whose_step(integrator, best.scheme.name, best.scheme.order, alike)
