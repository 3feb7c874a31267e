"""Invariants along trajectories, which need no truth: energy, angular momentum without gravity, and the way back.

From one moving state each integrator runs over the same time four times, each in twice as many steps as before. What a
run leaves of an invariant is a scheme's error, C h^p + O(h^(p+1)) for order p, or there is friction or a drive in the
model. Extrapolation to step zero (:mod:`furiko.reference.integration.richardson`) tells which: what it gives must be
zero within its own uncertainty and what rounding leaves.

* Energy: by the engine's own account of it, where it has one.
* Angular momentum about the support, for the mechanism without gravity: Σ_j (M ω)_j of the documents' mass matrix. No
  force but the support's acts on it then.
* There and back: with all rates reversed half-way, a run ends where it began, all rates reversed. Rates count as the
  angles by which links turn in the time of the run, so that no unit of time decides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...engines import AnyShape, Integrator
from ...models import LibraryMissing, Scene
from ...models.systems import DocumentSystem
from ...records.check import Result
from ...reference import energies, literal_accelerations, mass_matrix
from ...reference.integration.tangents import lyapunov_time
from ...reference.integration.variation import fastest_rate
from ...reference.rounding.bounds import EPSILON, Amplitudes, allowed
from ..cell import Cell
from ..motions.invariance import ENERGY, LARGEST_N, NAME, RUNS, SHORT, STEPS, WAY_BACK, Kept, result, too_large
from ..motions.step_rounding import acceleration_error, joints_apart, rate_of_positions
from .energy import energy_amplitudes

__all__ = ("NAME", "compare")

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Start:
    """A moving state (n,) of a mechanism in an engine, the magnitudes of its terms there, and the coarsest step [s].

    ``growth``: how much a small difference can have grown over the run: exp(time × fastest rate). ``off``: error of
    the rates [rad/s] that each integrator's rounding and unfinished iterations may leave at the end of a run, before
    it has grown; by the integrator's name.
    """

    system: DocumentSystem
    engine: AnyShape
    amplitude: Amplitudes
    theta: Array
    omega: Array
    step: float
    growth: float
    off: dict[str, float]

    @property
    def time(self) -> float:
        """Of a whole run [s]."""
        return self.step * STEPS

    def run(self, integrator: Integrator, steps: int, theta: Array, omega: Array) -> tuple[Array, Array]:
        """θ and ω after the whole time in so many steps."""
        return self.engine.trajectory(theta, omega, integrator.name, self.time / steps, steps)


def compare(cell: Cell) -> Iterator[Result]:
    """Three results for each integrator."""
    system = cell.scene.system
    if system.n > LARGEST_N:
        yield too_large(cell, system.n)
        return
    theta, omega = cell.states.theta[-1], cell.states.omega[-1]
    start = begin(cell, system, cell.engine, theta, omega)
    without_gravity = replace(system, gravity=0.0)
    engine = cell.engine.of(without_gravity) if system.gravity else cell.engine
    weightless = begin(cell, without_gravity, engine, theta, omega)
    for integrator in cell.info.integrators:
        for invariant in INVARIANTS:
            yield _compare(cell, integrator, start, invariant)
        yield _compare(cell, integrator, weightless, MOMENTUM)


def begin(cell: Cell, system: DocumentSystem, engine: AnyShape, theta: Array, omega: Array) -> Start:
    """Choose the step: a quarter over the fastest rate at which links turn or states near this one part."""
    fastest = max(float(fastest_rate(system, theta, omega)), float(np.abs(omega).max()))
    step = 2.0 ** math.floor(math.log2(SHORT / fastest)) if fastest > 0 else SHORT
    time, alpha = step * STEPS, literal_accelerations(system, theta, omega)
    rates = float(np.abs(omega).max() + time * np.abs(alpha).max())
    steps = STEPS << (RUNS - 1)
    off = {
        integrator.name: EPSILON * steps * rates
        + time * float(acceleration_error(cell, integrator, theta[None], omega[None], alpha[None])[0])
        + _by_joints(cell, integrator, theta, time / steps)
        for integrator in cell.info.integrators
    }
    return Start(system, engine, cell.amplitude_of(system), theta, omega, step, math.exp(time * fastest), off)


def _by_joints(cell: Cell, integrator: Integrator, theta: Array, h: float) -> float:
    """Error of the rates [rad/s] by the rounding of joints that are held together, in steps of ``h`` seconds."""
    if cell.info.coordinates != "maximal":
        return 0.0
    return float(rate_of_positions(h) * joints_apart(cell, integrator, theta[None])[0])


@dataclass(frozen=True)
class Invariant:
    """What is ``left`` of it after a run in so many steps, and what of that is ``noise``: by rounding alone."""

    kept: Kept
    left: Callable[[Start, Integrator, int], Array]
    noise: Callable[[Start, Integrator], float]


def _compare(cell: Cell, integrator: Integrator, start: Start, invariant: Invariant) -> Result:
    runs = [np.atleast_1d(invariant.left(start, integrator, STEPS << k)) for k in range(RUNS)]
    noise = invariant.noise(start, integrator) if np.isfinite(runs).all() else 0.0
    details = {"Lyapunov time": _lyapunov_time(cell.scene)}
    return result(cell, integrator, invariant.kept, start.step, runs, noise, details)


@lru_cache(maxsize=1)  # a worker looks at one scene with several integrators and engines
def _lyapunov_time(scene: Scene) -> float | None:
    """Of the scene's own motion [s]; None where nothing moves in it, nothing grows, or there is no compiler."""
    if scene.theta is None or scene.omega is None or not scene.duration:
        return None
    try:
        found = lyapunov_time(scene.system, np.array(scene.theta), np.array(scene.omega), scene.duration)
    except LibraryMissing:
        return None
    return found if math.isfinite(found) else None


def energy_left(start: Start, integrator: Integrator, steps: int) -> Array:
    """Energy at the end less that at the start [J]."""
    theta, omega = start.run(integrator, steps, start.theta, start.omega)
    if not (np.isfinite(theta).all() and np.isfinite(omega).all()):
        return np.array([np.nan])
    return np.array([_energy(start, theta, omega) - _energy(start, start.theta, start.omega)])


def _energy(start: Start, theta: Array, omega: Array) -> float:
    if "energy" in start.engine.info.missing:
        return float(sum(energies(start.system, theta, omega)))
    return float(start.engine.energy(theta, omega).sum())


def energy_noise(start: Start, integrator: Integrator) -> float:
    """[J]: |M ω| times the rates' error, and the sum's own rounding."""
    size = energy_amplitudes(start.system.tree(), start.amplitude, start.omega[None]).sum()
    off = start.growth * start.off[integrator.name]
    return float(off * np.abs(_stretched(start) @ np.abs(start.omega)).sum() + EPSILON * allowed(start.system.n) * size)


def _stretched(start: Start) -> Array:
    """The mass matrix with every cosine one: no entry is larger in any other state."""
    return mass_matrix(start.system, np.zeros_like(start.theta))


def momentum_left(start: Start, integrator: Integrator, steps: int) -> Array:
    """Angular momentum about the support at the end less that at the start [kg m²/s]."""
    theta, omega = start.run(integrator, steps, start.theta, start.omega)
    return np.array([_momentum(start.system, theta, omega) - _momentum(start.system, start.theta, start.omega)])


def _momentum(system: DocumentSystem, theta: Array, omega: Array) -> float:
    return float((mass_matrix(system, theta) @ omega).sum())


def momentum_noise(start: Start, integrator: Integrator) -> float:
    """[kg m²/s]: Σ|M_jk| times the rates' error, and the sum's own rounding."""
    M = _stretched(start)
    off = start.growth * start.off[integrator.name]
    return float(off * M.sum() + EPSILON * allowed(start.system.n) * (M @ np.abs(start.omega)).sum())


def way_back_left(start: Start, integrator: Integrator, steps: int) -> Array:
    """Where the way there and back ends, less where it began: angles, and rates times the time of the run, (2n,)."""
    theta, omega = start.run(integrator, steps, start.theta, start.omega)
    if not (np.isfinite(theta).all() and np.isfinite(omega).all()):
        return np.full(2 * len(theta), np.nan)
    theta, omega = start.run(integrator, steps, theta, -omega)
    return np.concatenate([theta - start.theta, (-omega - start.omega) * start.time])


def way_back_noise(start: Start, integrator: Integrator) -> float:
    """[rad]: the rates' error of both ways; that of the first has grown on the second as well."""
    angles = EPSILON * float(np.abs(start.theta).max() + 2 * np.pi)
    return 2 * start.growth**2 * (start.off[integrator.name] * start.time + angles)


INVARIANTS = (
    Invariant(ENERGY, energy_left, energy_noise),
    Invariant(Kept("there and back", "rad", WAY_BACK), way_back_left, way_back_noise),
)
MOMENTUM = Invariant(
    Kept("angular momentum", "kg m²/s", "without gravity no torque acts about the support"),
    momentum_left,
    momentum_noise,
)
