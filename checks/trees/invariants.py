"""Invariants along trajectories, which need no truth: energy, momenta, and the way back.

As :mod:`furiko.checks.comparisons.invariants` has it, of open mechanisms without their dampers. Which momenta are kept
is in :mod:`..motions.momenta`; those of free joints are looked at with gravity, in the runs of the energy.

What rounding leaves of a number is its slope at the end of the run times the error of coordinates and rates there. That
is what each acceleration is off by, and each step's last digits, grown by exp(time × J), with J the magnitudes of the
equations' slopes where the run starts: coordinates have several units, and so has each entry of J. An error of a place
is the move that leads to the right one; that of a body that turns at the rates ω is carried along, x' = … − ω × x.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator, TreeShape
from ...models import TreeSystem
from ...models.spatial_mechanism import SpatialMechanism
from ...models.trees.images import without_dampers
from ...records.check import Result
from ...reference import spatial_kinematics
from ...reference.integration.tree_places import difference, moved, plain, quaternions
from ...reference.integration.tree_variation import NUDGE, accelerations, fastest_turn, slopes
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.stepped import QUATERNION
from ..motions.invariance import ENERGY, LARGEST_N, NAME, RUNS, SHORT, STEPS, WAY_BACK, Kept, result, too_large
from ..motions.momenta import Momentum, Number, momenta
from .cell import TreeCell
from .energy import energy_unit
from .symmetries import inverse, mass_matrix, regular
from .verdict import NO_STATE

Array = NDArray[np.float64]
End = tuple[Array, Array]  # q (nq,) and v (nv,)

TERMS = 32  # of the series of exp(x) for x ≤ 1: its terms have long become nothing


@dataclass(frozen=True, eq=False)
class Start:
    """A moving state, ``q`` (nq,), ``v`` (nv,), of a mechanism without dampers in an engine, and the coarsest step [s].

    ``slopes`` (2 nv, 2 nv): the magnitudes of those of (v, a) by moves of the place and by v.
    """

    cell: TreeCell
    system: TreeSystem
    engine: TreeShape
    q: Array
    v: Array
    step: float
    slopes: Array

    @cached_property
    def mechanism(self) -> SpatialMechanism:
        """The same as arrays."""
        return self.system.mechanism()

    @property
    def time(self) -> float:
        """Of a whole run [s]."""
        return self.step * STEPS

    def run(self, integrator: Integrator, steps: int, q: Array, v: Array) -> End:
        """q and v after the whole time in so many steps; NaN where it diverges."""
        return self.engine.trajectory(q, v, integrator.name, self.time / steps, steps)

    def runs(self, integrator: Integrator) -> list[End]:
        """The ends of runs in ever shorter steps."""
        return [self.run(integrator, STEPS << k, self.q, self.v) for k in range(RUNS)]

    @cached_property
    def grown(self) -> Array:
        """What errors (2 nv,) at the start are at the end at most."""
        return exponential(self.time * self.slopes)

    def off(self, integrator: Integrator) -> Array:
        """The error of coordinates and rates that rounding and unfinished iterations leave in a run, (2 nv,)."""
        steps, rates = STEPS << (RUNS - 1), np.abs(self.v) + self.time * np.abs(self._accelerations)
        rounded, whole = self._rows
        rows = rounded + integrator.tolerance * whole
        sped = EPSILON * steps * rates + self.time * np.abs(inverse(self._mass)) @ rows
        return np.concatenate([EPSILON * steps * (self._places + self.time * rates), sped])

    @cached_property
    def _accelerations(self) -> Array:
        """Where the run starts, (nv,)."""
        found = accelerations(self.mechanism, self.q[None], self.v[None])
        return np.asarray(found[0], dtype=np.float64)

    @cached_property
    def _mass(self) -> Array:
        return mass_matrix(self.system, self.q.tobytes())

    @cached_property
    def _rows(self) -> tuple[Array, float]:
        """The residual of its equations that rounding explains, (nv,), and the norm of their terms."""
        units = self.cell.magnitudes_of(self.mechanism, self.q, self.v)
        info = self.cell.info
        rows = units.residual(self._accelerations, self._mass, factorised=info.factorises, inverted=info.inverts)
        return self.cell.roundings_of(units) * EPSILON * rows, float(np.linalg.norm(rows))

    @cached_property
    def _places(self) -> Array:
        """What a place is rounded by in a step, in ε, for each degree of freedom (nv,) [m or rad]."""
        refs = np.concatenate([np.full(one.joint.freedoms, one.joint.ref) for one in self.mechanism.joints])
        found = np.full(len(self.v), 2.0 * QUATERNION)
        of_q, of_v = plain(self.mechanism)
        found[of_v] = np.abs(self.q[of_q]) + 2 * np.abs(refs[of_v])
        return found


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result for each invariant and integrator."""
    if cell.mechanism.nv > LARGEST_N:
        yield too_large(cell, cell.mechanism.nv)
        return
    rows = regular(cell)
    if not len(rows):
        yield cell.result(NAME, "skipped", reason=NO_STATE)
        return
    q, v = cell.states.q[rows[-1]], cell.states.v[rows[-1]]
    ideal = without_dampers(cell.scene.system)
    start = begin(cell, ideal, q, v)
    falling, floating = ([one for one in momenta(start.mechanism) if one.falls == falls] for falls in (True, False))
    weightless = begin(cell, replace(ideal, gravity=(0.0, 0.0, 0.0)), q, v) if floating else start
    for integrator in cell.integrators:
        ends = start.runs(integrator)
        yield _energy(start, integrator, ends)
        yield _way_back(start, integrator, ends)
        for momentum in falling:
            yield _momentum(start, integrator, momentum, ends)
        if floating:
            ends = weightless.runs(integrator)
        for momentum in floating:
            yield _momentum(weightless, integrator, momentum, ends)


def begin(cell: TreeCell, system: TreeSystem, q: Array, v: Array) -> Start:
    """Choose the step: a quarter over the fastest rate at which links turn or states near this one part."""
    mechanism = system.mechanism()
    by_q, by_v = (np.abs(part[0]) for part in slopes(mechanism, q[None], v[None]))
    n = len(v)
    carried = np.zeros((n, n))
    for _, at in quaternions(mechanism):
        x, y, z = np.abs(v[at])
        carried[at, at] = [[0, z, y], [z, 0, x], [y, x, 0]]
    size = np.block([[carried, np.eye(n)], [by_q, by_v]])
    parting = float(np.abs(np.linalg.eigvals(size)).max(initial=0.0))
    fastest = max(parting, fastest_turn(mechanism, v[None]))
    step = 2.0 ** math.floor(math.log2(SHORT / fastest)) if fastest > 0 else SHORT
    engine = cell.engine if system == cell.scene.system else cell.engine.of(mechanism)
    return Start(cell, system, engine, q, v, step, size)


@np.errstate(over="ignore", invalid="ignore")
def exponential(matrix: Array) -> Array:
    """exp of a matrix without negative entries, so that nothing cancels: its series for a part of it, squared."""
    halvings = max(0, math.ceil(math.log2(max(float(matrix.sum(axis=1).max(initial=0.0)), 1.0))))
    part = matrix / 2.0**halvings
    term = found = np.eye(len(matrix))
    for k in range(1, TERMS):
        term = term @ part / k
        found = found + term
    for _ in range(halvings):
        found = found @ found
    return np.asarray(found)


def slope(number: Number, mechanism: SpatialMechanism, q: Array, v: Array) -> Array:
    """|∂/∂(q, v)| of a number in one state, (k, 2 nv), by central differences."""
    n = len(v)
    nudges = NUDGE * np.eye(2 * n)
    ends = [number(moved(mechanism, q, way * nudges[:, :n]), v + way * nudges[:, n:]) for way in (1, -1)]
    return np.asarray(np.abs(ends[0] - ends[1]).T / (2 * NUDGE))


def _energy(start: Start, integrator: Integrator, ends: list[End]) -> Result:
    def number(q: Array, v: Array) -> Array:
        return np.asarray(spatial_kinematics.energy(start.mechanism, q, v).sum(axis=-1, keepdims=True))

    assert start.cell.info.tree is not None
    own = "energy" not in start.cell.info.tree.missing

    def asked(q: Array, v: Array, _time: float) -> Array:
        return start.engine.energy(q, v).sum(axis=-1, keepdims=True) if own else number(q, v)

    def size(q: Array, v: Array, _time: float) -> float:
        units = start.cell.magnitudes_of(start.mechanism, q, v)
        return start.cell.roundings_of(units) * float(energy_unit(start.mechanism, units).sum())

    return _of(start, integrator, ENERGY, ends, asked, number, size)


def _momentum(start: Start, integrator: Integrator, momentum: Momentum, ends: list[End]) -> Result:
    def asked(q: Array, v: Array, time: float) -> Array:
        return momentum.of(start.mechanism, time)(q, v)

    def size(q: Array, v: Array, time: float) -> float:
        units = start.cell.magnitudes_of(start.mechanism, q, v)
        return start.cell.roundings_of(units) * momentum.size(start.mechanism, units, q, v, time)

    return _of(start, integrator, momentum.kept, ends, asked, momentum.of(start.mechanism), size)


def _of(
    start: Start,
    integrator: Integrator,
    kept: Kept,
    ends: list[End],
    asked: Callable[[Array, Array, float], Array],
    number: Number,
    size: Callable[[Array, Array, float], float],
) -> Result:
    """The result for a number at the ``ends`` of the runs, as ``asked`` after a time, and as furiko computes it."""
    if not _finite(ends):
        return result(start.cell, integrator, kept, start.step, [np.full(1, np.nan)], 0.0, {})
    first = asked(start.q[None], start.v[None], 0.0)
    left = [asked(q[None], v[None], start.time) - first for q, v in ends]
    q, v = ends[-1]
    noise = float((slope(number, start.mechanism, q, v) @ (start.grown @ start.off(integrator))).max())
    noise += EPSILON * (size(q, v, start.time) + size(start.q, start.v, 0.0))
    return result(start.cell, integrator, kept, start.step, left, float(noise), {})


def _finite(ends: list[End]) -> bool:
    return all(np.isfinite(part).all() for end in ends for part in end)


def _way_back(start: Start, integrator: Integrator, ends: list[End]) -> Result:
    """Coordinates, and rates times the time of the run: that of the first way has grown on the second as well."""
    runs = []
    for k, (q, v) in enumerate(ends):
        end = start.run(integrator, STEPS << k, q, -v) if _finite([(q, v)]) else (q, v)
        runs.append(np.concatenate([difference(start.mechanism, start.q, end[0]), (-end[1] - start.v) * start.time]))
    off = start.off(integrator)
    places, rates = np.split(start.grown @ (start.grown @ off + off), 2)
    noise = float(max(places.max(initial=0.0), rates.max(initial=0.0) * start.time))
    return result(start.cell, integrator, Kept("there and back", "rad or m", WAY_BACK), start.step, runs, noise, {})
