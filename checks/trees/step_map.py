"""The step map: one step of each of an engine's integrators is, to rounding, one step of a textbook scheme.

As :mod:`furiko.checks.comparisons.step_map` has it; with quaternions there are several ways to take one
(:mod:`furiko.reference.integration.tree_schemes`). Where joints have dampers, an engine may also take their force at
the end of the step: with D the dampers and a the accelerations of the state before, semi-implicit Euler then is

    v⁺ = v + h (M + h D)⁻¹ M a,    q⁺ = q ⊕ h v⁺.

How far rounding takes coordinates and rates apart is bounded for each, since their units differ. The accelerations'
error of row i is |M⁻¹| times the backward error that rounding explains; later stages start from the earlier ones'
errors e: these add (h² |∂a/∂q| + h |∂a/∂v|) e to it. A rotation that is off by x is a quaternion Q that is off by
½ Q (0, x), by half of |x| in any of its components; an engine's quaternion may have the other sign, which is the same
rotation, but no other length.
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
from ...models.spatial_mechanism import SpatialMechanism
from ...records.check import Result
from ...reference.integration.tree_places import plain, quaternions
from ...reference.integration.tree_schemes import TreeScheme, lone_free_bodies, tree_schemes
from ...reference.integration.tree_variation import fastest_turn, slopes
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.stepped import QUATERNION, step_bound
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
    """The states (B, nq), (B, nv) from which an engine takes a step of ``h`` seconds, and what accelerations are there.

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
        factorised, inverted = self.cell.info.factorises, self.cell.info.inverts
        units = np.array(
            [
                one.residual(a, mass, factorised=factorised, inverted=inverted)
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
    for integrator in cell.integrators:
        if integrator.lone_body and lone_free_bodies(cell.mechanism):
            yield cell.result(f"{NAME} {integrator.name}", "skipped", reason=integrator.lone_body)
            continue
        yield _compare(cell, integrator, steps, textbook)


def chosen_steps(cell: TreeCell) -> Steps:
    """The last of the cell's states (the random ones), and a step that is short for all of them."""
    q, v = cell.states.q[-STATES:], cell.states.v[-STATES:]
    by_q, by_v = map(np.abs, slopes(cell.mechanism, q, v))
    parting = math.sqrt(float(np.abs(by_q).sum(-1).max())) + float(np.abs(by_v).sum(-1).max())
    fastest = max(parting, fastest_turn(cell.mechanism, v))
    # A power of two, so that halves and sums of steps are exact.
    h = 2.0 ** math.floor(math.log2(SHORT / fastest)) if fastest > 0 else SHORT
    return Steps(cell, h, q, v, by_q, by_v)


class Textbook:
    """The steps of every scheme from the same states, computed when first asked for."""

    def __init__(self, steps: Steps) -> None:
        self._steps = steps
        self._ends: dict[str, Wide | None] = {}
        self.schemes = tree_schemes(steps.cell.mechanism, steps.mass)

    def end(self, scheme: TreeScheme) -> Wide | None:
        """q and v after its step side by side, (B, nq + nv); None where the step is too long for it."""
        if scheme.name not in self._ends:
            q, v = self._steps.q.astype(np.longdouble), self._steps.v.astype(np.longdouble)
            try:
                self._ends[scheme.name] = np.concatenate(scheme.step(q, v, np.longdouble(self._steps.h)), axis=-1)
            except ArithmeticError:
                self._ends[scheme.name] = None
        return self._ends[scheme.name]


@dataclass(frozen=True)
class Fit:
    """A scheme, the worst of an engine's coordinates and rates over what rounding explains, and where it is."""

    scheme: TreeScheme
    excess: float
    place: tuple[int, ...]
    bound: float


def _compare(cell: TreeCell, integrator: Integrator, steps: Steps, textbook: Textbook) -> Result:
    ends = [cell.run(q, v, integrator, steps.h, 1) for q, v in zip(steps.q, steps.v, strict=True)]
    got = np.array([np.concatenate(end) for end in ends])
    off = steps.off(integrator)
    bounds = {scheme.name: bound(scheme, off, steps) for scheme in textbook.schemes}

    def fits(schemes: list[TreeScheme]) -> list[Fit]:
        found = []
        for scheme in schemes:
            end = textbook.end(scheme)
            if end is not None:
                error = alike(cell.mechanism, got, end) - end
                excess = worst(quotient(error.astype(np.float64), bounds[scheme.name]))
                place = tuple(map(int, excess.index))
                found.append(Fit(scheme, excess.value, place, float(bounds[scheme.name][place])))
        return sorted(found, key=lambda one: one.excess)

    expected = [scheme for scheme in textbook.schemes if scheme.order == integrator.order]
    found = fits(expected)
    if not found or found[0].excess > 1:
        found = fits(textbook.schemes)
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
        unit=_where(cell, best.place)[1] or None,
        reason=_reason(cell, integrator, best, rest),
        details={
            "integrator": integrator.name,
            "scheme": best.scheme.name,
            "step": steps.h,
            "states": len(got),
            "next best": {"scheme": rest[0].scheme.name, "error": rest[0].excess * rest[0].bound} if rest else None,
        },
    )


def alike(mechanism: SpatialMechanism, got: Array, end: Wide) -> Array:
    """``got`` (B, nq + nv) with each quaternion in the sign that is nearer to that of ``end``."""
    found = got.copy()
    for at, _ in quaternions(mechanism):
        found[:, at] *= np.where((got[:, at] * end[:, at]).sum(axis=-1, keepdims=True) < 0, -1, 1)
    return found


def bound(scheme: TreeScheme, first: Array, steps: Steps) -> Array:
    """How far rounding may take an engine from a scheme's step, in each coordinate and rate, (B, nq + nv).

    ``first``: the accelerations' error in the first stage, (B, nv).
    """
    h, mechanism = steps.h, steps.cell.mechanism
    turned = np.zeros(mechanism.nv)
    for _, at_v in quaternions(mechanism):
        turned[at_v] = 2 * QUATERNION * EPSILON  # [rad], of each stage's rotation
    off = first = first + steps.by_q @ turned
    carried = h * h * steps.by_q + h * steps.by_v
    for _ in range(scheme.stages):
        off = first + (carried @ off[..., None])[..., 0]
    rates = np.abs(steps.v) + h * np.abs(steps.accelerations)
    places, of_q, of_v = h * rates, *plain(mechanism)
    # An engine may count from each joint's ref: that is taken off before the step, and added after it.
    refs = np.concatenate([np.full(one.joint.freedoms, one.joint.ref) for one in mechanism.joints])
    places[:, of_v] += np.abs(steps.q[:, of_q]) + 2 * np.abs(refs[of_v])
    moves, of_rates = step_bound(scheme, h, 0.0, off, places, rates)
    found = np.empty_like(steps.q)
    found[:, of_q] = moves[:, of_v]
    for at_q, at_v in quaternions(mechanism):
        sums = (QUATERNION + scheme.stages + 2) * EPSILON
        found[:, at_q] = np.linalg.norm(moves[:, at_v], axis=-1, keepdims=True) / 2 + sums
    return np.concatenate([found, of_rates], axis=-1)


def _where(cell: TreeCell, place: tuple[int, ...]) -> tuple[str, str]:
    """What is at a ``place``, the state and the column, is called, and its unit; a quaternion has none."""
    _, column = place
    mechanism, rate = cell.mechanism, column >= cell.mechanism.nq
    if rate:
        freedom = column - mechanism.nq
    else:
        of_q, of_v = plain(mechanism)
        if column not in of_q:
            joint = next(one for one in mechanism.joints if column < one.columns_q.stop)
            return f"the quaternion of {joint.joint.name!r}", ""
        freedom = int(of_v[np.searchsorted(of_q, column)])
    joint = next(one for one in mechanism.joints if freedom < one.columns_v.stop)
    along = joint.joint.kind == "slide" or (joint.joint.kind == "free" and freedom < joint.at_v + 3)
    return repr(cell.freedom(freedom)), ("m" if along else "rad") + ("/s" if rate else "")


def _reason(cell: TreeCell, integrator: Integrator, best: Fit, rest: list[Fit]) -> str:
    if best.excess > 1:
        what, unit = _where(cell, best.place)
        return (
            f"one step of {integrator.name} is no textbook scheme's; the nearest, {best.scheme.name}, misses "
            f"{what} by {f'{best.excess * best.bound:.3g} {unit}'.strip()}, and rounding explains "
            f"{best.bound:.3g}"
        )
    others = [one.scheme.name for one in rest if one.excess <= 1]
    slower = f", of order {integrator.turning} where bodies tumble" if integrator.turning == integrator.order else ""
    return says_whose_step(integrator, best.scheme.name + slower, best.scheme.order, others)
