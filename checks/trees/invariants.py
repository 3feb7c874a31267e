"""Invariants along trajectories, which need no truth: energy, momenta without gravity, and the way back.

As :mod:`furiko.checks.comparisons.invariants` has it, of mechanisms of hinges and slides, without their dampers. What
of momenta is kept without gravity is what the first joints leave free, where they have no springs:

* along each slide that comes first on a link, or behind other slides, the linear momentum of all that hangs there;
* about a hinge that comes first, or behind slides along its axis, the angular momentum about its pivot;
* about the axis of a hinge behind slides that span all directions across it, and have no armature, the angular momentum
  about the world's origin: a free base in a plane.

Rotors (armature) turn with their joint and count with it. What rounding leaves of a number is its slope at the end of
the run times the error of coordinates and rates there. That is what each acceleration is off by, and each step's last
digits, grown by exp(time × J), with J the magnitudes of the equations' slopes where the run starts: coordinates have
several units, and so has each entry of J.
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
from ...models.spatial_mechanism import WORLD, PlacedJoint, SpatialMechanism
from ...models.trees.images import without_dampers
from ...records.check import Result
from ...reference import spatial_kinematics
from ...reference.integration.tree_variation import NUDGE, accelerations, slopes
from ...reference.rounding.bounds import EPSILON
from ..motions.invariance import ENERGY, LARGEST_N, NAME, RUNS, SHORT, STEPS, WAY_BACK, Kept, result, too_large
from .cell import TreeCell
from .energy import energy_unit
from .symmetries import NO_STATE, inverse, mass_matrix, regular

Array = NDArray[np.float64]
Number = Callable[[Array, Array], Array]  # of states q, v (B, nv): (B,)

ALONG = 4 * EPSILON  # rounding of a product of directions of length one
TERMS = 32  # of the series of exp(x) for x ≤ 1: its terms have long become nothing


@dataclass(frozen=True, eq=False)
class Start:
    """A moving state, ``q`` and ``v`` (nv,), of a mechanism without dampers in an engine, and the coarsest step [s].

    ``slopes`` (2 nv, 2 nv): the magnitudes of those of (v, a) by (q, v).
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

    def run(self, integrator: Integrator, steps: int, q: Array, v: Array) -> Array:
        """q and v after the whole time in so many steps, (2, nv); NaN where it diverges."""
        return np.array(self.engine.trajectory(q, v, integrator.name, self.time / steps, steps))

    @cached_property
    def grown(self) -> Array:
        """What errors (2 nv,) at the start are at the end at most."""
        return exponential(self.time * self.slopes)

    def off(self, integrator: Integrator) -> Array:
        """The error of coordinates and rates that rounding and unfinished iterations leave in a run, (2 nv,)."""
        steps, factorised = STEPS << (RUNS - 1), self.cell.info.algorithm != "aba"
        a = accelerations(self.mechanism, self.q[None], self.v[None])[0].astype(np.float64)
        mass = mass_matrix(self.system, self.q.tobytes())
        units = self.cell.magnitudes_of(self.mechanism, self.q, self.v)
        rows = units.residual(a, mass, factorised=factorised)
        rows = self.cell.roundings_of(units) * EPSILON * rows + integrator.tolerance * np.linalg.norm(rows)
        rates = np.abs(self.v) + self.time * np.abs(a)
        places = np.abs(self.q) + 2 * np.abs([one.joint.ref for one in self.mechanism.joints]) + self.time * rates
        return np.concatenate(
            [EPSILON * steps * places, EPSILON * steps * rates + self.time * np.abs(inverse(mass)) @ rows]
        )


@dataclass(frozen=True, eq=False)
class Momentum:
    """What is kept of the momenta of all that hangs on the link ``root``: along or about a joint of it, ``placed``.

    ``about``: None for a slide's; else whether the angular momentum is that about the world's origin.
    """

    root: int
    placed: PlacedJoint
    about_origin: bool | None

    @property
    def kept(self) -> Kept:
        """Its name, unit and reason."""
        name = self.placed.joint.name
        if self.about_origin is None:
            says = f"without gravity no force acts along {name!r}"
            return Kept(f"momentum along {name}", "kg m/s", says)
        says = f"without gravity no torque acts about {name!r}"
        return Kept(f"angular momentum about {name}", "kg m²/s", says)

    def of(self, mechanism: SpatialMechanism) -> Number:
        """The number in states (B, nv)."""
        column, armature = self.placed.at_v, self.placed.joint.armature

        def number(q: Array, v: Array) -> Array:
            moved = spatial_kinematics.motion(mechanism, q, v)
            linear, angular = spatial_kinematics.momentum(mechanism, moved, self.root)
            if self.about_origin is None:
                along = linear
            else:
                along = angular if self.about_origin else angular - np.cross(moved.pivot[:, column], linear)
            return np.asarray((along * moved.axis[:, column]).sum(axis=-1) + armature * v[:, column])

        return number


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
    start, weightless = (begin(cell, system, q, v) for system in (ideal, replace(ideal, gravity=(0.0, 0.0, 0.0))))
    for integrator in cell.info.integrators:
        yield _energy(start, integrator)
        yield _way_back(start, integrator)
        ends = [weightless.run(integrator, STEPS << k, q, v) for k in range(RUNS)]
        for momentum in momenta(weightless.mechanism):
            yield _momentum(weightless, integrator, momentum, ends)


def begin(cell: TreeCell, system: TreeSystem, q: Array, v: Array) -> Start:
    """Choose the step: a quarter over the fastest rate at which links turn or states near this one part."""
    mechanism = system.mechanism()
    by_q, by_v = (np.abs(part[0]) for part in slopes(mechanism, q[None], v[None]))
    n = len(v)
    size = np.block([[np.zeros((n, n)), np.eye(n)], [by_q, by_v]])
    parting = float(np.abs(np.linalg.eigvals(size)).max(initial=0.0))
    turning = max((abs(float(v[one.at_v])) for one in mechanism.joints if one.joint.kind == "hinge"), default=0.0)
    fastest = max(parting, turning)
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


def momenta(mechanism: SpatialMechanism) -> list[Momentum]:
    """What is kept of momenta without gravity, by the first joints of every link that hangs on nothing that moves."""
    found: list[Momentum] = []
    moved: list[bool] = []
    for index, body in enumerate(mechanism.bodies):
        hangs = body.parent != WORLD and moved[body.parent]
        moved.append(hangs or bool(body.joints))
        if not hangs:
            found += _free([one for one in mechanism.joints if one.body == index])
    return found


def _free(joints: list[PlacedJoint]) -> Iterator[Momentum]:
    """Those of one link's joints."""
    slides: list[PlacedJoint] = []
    for one in joints:
        sprung = bool(one.joint.stiffness)
        if one.joint.kind == "slide":
            slides.append(one)
            if not sprung:
                yield Momentum(one.body, one, None)
            continue
        axis, directions = _direction(one), np.array([_direction(slide) for slide in slides]).reshape(-1, 3)
        if sprung or any(slide.joint.stiffness or slide.joint.armature for slide in slides):
            return
        across = directions - np.outer(directions @ axis, axis)
        if (np.abs(across) <= ALONG).all():
            yield Momentum(one.body, one, False)
        elif _spans(directions, axis):
            yield Momentum(one.body, one, True)
        return


def _spans(directions: Array, axis: Array) -> bool:
    """Whether directions (k, 3) span all that is across an axis: all of space, or two of them in that plane."""
    rank = int(np.linalg.matrix_rank(directions))
    return rank == 3 or (rank == 2 and bool((np.abs(directions @ axis) <= ALONG).all()))


def _direction(one: PlacedJoint) -> Array:
    return np.asarray(one.joint.axis / np.linalg.norm(one.joint.axis))


def slope(number: Number, q: Array, v: Array) -> Array:
    """|∂/∂(q, v)| of a number in one state, (2 nv,), by central differences."""
    n = len(q)
    nudges = NUDGE * np.eye(2 * n)
    ends = [number(q + way * nudges[:, :n], v + way * nudges[:, n:]) for way in (1, -1)]
    return np.asarray(np.abs(ends[0] - ends[1]) / (2 * NUDGE))


def _energy(start: Start, integrator: Integrator) -> Result:
    ends = [start.run(integrator, STEPS << k, start.q, start.v) for k in range(RUNS)]

    def number(q: Array, v: Array) -> Array:
        return np.asarray(spatial_kinematics.energy(start.mechanism, q, v).sum(axis=-1))

    assert start.cell.info.tree is not None
    own = "energy" not in start.cell.info.tree.missing

    def asked(q: Array, v: Array) -> Array:
        return start.engine.energy(q, v).sum(axis=-1) if own else number(q, v)

    def size(q: Array, v: Array) -> float:
        units = start.cell.magnitudes_of(start.mechanism, q, v)
        return start.cell.roundings_of(units) * float(energy_unit(start.mechanism, units).sum())

    return _of(start, integrator, ENERGY, ends, asked, number, size)


def _momentum(start: Start, integrator: Integrator, momentum: Momentum, ends: list[Array]) -> Result:
    number, column = momentum.of(start.mechanism), momentum.placed.at_v

    def size(q: Array, v: Array) -> float:
        """Its terms' magnitudes; about the origin, also the linear momentum's, which a slide has, times the way."""
        units = start.cell.magnitudes_of(start.mechanism, q, v)
        rows = units.mass_matrix @ units.once(v)
        found = rows[column]
        if momentum.about_origin:
            slide = next(one.at_v for one in start.mechanism.joints if one.body == momentum.root)
            pivot = spatial_kinematics.motion(start.mechanism, q[None], v[None]).pivot[0, column]
            found += float(np.linalg.norm(pivot)) * rows[slide]
        return start.cell.roundings_of(units) * float(found)

    return _of(start, integrator, momentum.kept, ends, number, number, size)


def _of(
    start: Start,
    integrator: Integrator,
    kept: Kept,
    ends: list[Array],
    asked: Number,
    number: Number,
    size: Callable[[Array, Array], float],
) -> Result:
    """The result for a number at the ``ends`` of the runs, as ``asked``, and as furiko computes it."""
    if not np.isfinite(ends).all():
        return result(start.cell, integrator, kept, start.step, [np.full(1, np.nan)], 0.0, {})
    first = asked(start.q[None], start.v[None])
    left = [asked(end[0][None], end[1][None]) - first for end in ends]
    q, v = ends[-1]
    noise = float(slope(number, q, v) @ (start.grown @ start.off(integrator)))
    noise += EPSILON * (size(q, v) + size(start.q, start.v))
    return result(start.cell, integrator, kept, start.step, left, float(noise), {})


def _way_back(start: Start, integrator: Integrator) -> Result:
    """Coordinates, and rates times the time of the run: that of the first way has grown on the second as well."""
    runs = []
    for k in range(RUNS):
        end = start.run(integrator, STEPS << k, start.q, start.v)
        if np.isfinite(end).all():
            end = start.run(integrator, STEPS << k, end[0], -end[1])
        runs.append(np.concatenate([end[0] - start.q, (-end[1] - start.v) * start.time]))
    off = start.off(integrator)
    places, rates = np.split(start.grown @ (start.grown @ off + off), 2)
    noise = float(max(places.max(initial=0.0), rates.max(initial=0.0) * start.time))
    return result(start.cell, integrator, Kept("there and back", "rad or m", WAY_BACK), start.step, runs, noise, {})
