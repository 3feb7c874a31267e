"""One scene on one engine: what every check is given, and how an engine is asked so that bad answers are told apart."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..diagnosis.explanation import Explanation
from ..diagnosis.finding import Finding
from ..engines import AnyShape, EngineInfo, Integrator
from ..models import Scene
from ..models.states import States
from ..models.systems import DocumentSystem
from ..records.check import Outcome, Result
from ..reference import mass_matrix
from ..reference.rounding.bodies_first import bodies_first
from ..reference.rounding.bounds import Amplitudes, amplitudes
from ..reference.rounding.maximal_elimination import elimination, states_within_a_second
from .facts import SceneFacts

Array = NDArray[np.float64]


class EngineFault(RuntimeError):
    """The engine answered, but not with what was asked for: NaN, a wrong shape, a wrong type."""


@dataclass(frozen=True)
class Cell:
    """``states`` are those in which instantaneous quantities are compared; ``facts`` the truth in them.

    ``few_steps``: of the finest run of ten links that is worth a longer time, as a run's profile says.
    """

    scene: Scene
    info: EngineInfo
    engine: AnyShape
    states: States
    facts: SceneFacts
    few_steps: int = 1 << 10

    @property
    def start(self) -> tuple[Array, Array] | None:
        """The state from which trajectories start, θ and ω, (n,) each; None where the scene has none."""
        if self.scene.theta is None or self.scene.omega is None:
            return None
        return np.array(self.scene.theta), np.array(self.scene.omega)

    @cached_property
    def amplitude(self) -> Amplitudes:
        """Magnitudes of the terms in the coordinates in which this engine computes."""
        return self.amplitude_of(self.scene.system)

    @cached_property
    def of_offers(self) -> Cell:
        """This cell as to derivatives and M⁻¹, in which the engine may take moments about another point."""
        about = self.info.moments_of_offers
        if not about:
            return self
        return replace(self, info=replace(self.info, moments=about))

    @cached_property
    def ways(self) -> tuple[Cell, ...]:
        """This cell with each way in which the engine may compute, where that is not known; itself where it is."""
        ways = self.info.ways
        if any(not link.inertia > 0 for link in self.scene.system.tree().links):  # no body to be solved for by itself
            ways = tuple(way for way in ways if way.ordering != "bodies") or (replace(self.info, ordering="pivoted"),)
        return (self,) if ways == (self.info,) else tuple(replace(self, info=info) for info in ways)

    @property
    def most_eliminations(self) -> int:
        """In how many states :meth:`elimination` can be had in about a second."""
        n = self.scene.system.n
        return min(states_within_a_second(n, ordering=way.info.ordering) for way in self.ways)

    def elimination(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """In maximal coordinates, what elimination adds to the magnitudes of rows [N m] and of joints' forces [N].

        Of states (B, n), (B, n) each: the largest of all ways in which the engine may eliminate.
        """
        system = self.scene.system
        found = [
            bodies_first(system, theta, omega, way.info.placed)
            if way.info.ordering == "bodies"
            else elimination(system, theta, omega)
            for way in self.ways
        ]
        rows, forces = np.max(found, axis=0)
        return rows, forces

    def amplitude_of(self, system: DocumentSystem) -> Amplitudes:
        """The same for another mechanism in this engine."""
        info = self.info
        return _amplitudes(system, (info.coordinates, info.moments, info.placed, info.interchanges))

    @cached_property
    def mass(self) -> Array:
        """The true mass matrix in all states, (B, n, n) [kg m²]."""
        return _mass(self.scene.system, self.states.theta.tobytes())

    @cached_property
    def regular(self) -> Cell:
        """This cell in those states in which a solution for accelerations has digits that are sure."""
        info, system = self.info, self.scene.system
        how = info.coordinates, info.moments, info.placed, info.interchanges
        kept = _regular(system, how, info.accuracy, self.states.theta.tobytes())
        return self if kept.all() else replace(self, states=self.states.only(kept), facts=self.facts.only(kept))

    @cached_property
    def explanation(self) -> Explanation:
        """Why this engine differs, by what it was measured to do; empty where it cannot be measured either."""
        from ..diagnosis.explain import explanation

        try:
            return explanation(self.engine, self.scene.system, who=self.info.name, accuracy=self.info.accuracy)
        except Exception:
            return Explanation()  # an engine that fails here has failed, or will, in a check of its own

    def motion_causes(self, integrator: Integrator) -> list[Finding]:
        """Why runs with this integrator differ, given that the accelerations agree; measured once."""
        if integrator.name not in self._motion_causes:
            from ..diagnosis.explain_motion import explain_motion

            found: list[Finding] = []
            with suppress(Exception):
                found = explain_motion(self.engine, self.scene.system, integrator, who=self.info.name, diverged=True)
            self._motion_causes[integrator.name] = found
        return self._motion_causes[integrator.name]

    @cached_property
    def _motion_causes(self) -> dict[str, list[Finding]]:
        return {}

    def accelerations(self) -> Array:
        """The engine's accelerations in all states, (B, n)."""
        theta, omega = self.states.theta, self.states.omega
        return self.answer("accelerations", self.engine.accelerations(theta, omega), theta.shape)

    def torques(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool) -> Array:
        """The engine's inverse dynamics, (B, n)."""
        answer = self.engine.inverse_dynamics(theta, omega, alpha, gravity=gravity)
        return self.answer("inverse dynamics", answer, theta.shape)

    def trajectory(self, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int) -> Array:
        """θ and ω at the end of one of the engine's own runs, (2, n)."""
        return self.answer(
            integrator.name,
            np.array(self.engine.trajectory(theta, omega, integrator.name, step, steps)),
            (2, theta.size),
        )

    def path(self, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int) -> Array | None:
        """θ and ω side by side at the start and after each step, (steps + 1, 2n); None where the adapter has no paths.

        A run that diverges is no fault here: NaN passes.
        """
        found = self.engine.path(theta, omega, integrator.name, step, steps)
        return None if found is None else np.concatenate(found, axis=-1)

    def answer(self, quantity: str, answer: object, shape: tuple[int, ...]) -> Array:
        """``answer`` as an array of this shape, or :class:`EngineFault` saying what is wrong with it."""
        return array_of(quantity, answer, shape, self.states.labels)

    def result(self, check: str, outcome: Outcome, **fields: Any) -> Result:
        """A result of this cell."""
        return Result(scene=self.scene.name, engine=self.info.name, check=check, outcome=outcome, **fields)

    def not_judged(self, check: str, states: int) -> Result:
        """The states of a check that agrees elsewhere, in which it takes too long to say what rounding may do."""
        reason = (
            f"nothing is said of {states} of the states: what elimination adds to the bound takes too long to compute "
            "in each of them, and the states furthest off were looked at"
        )
        return self.result(f"{check}, other states", "skipped", reason=reason)


How = tuple[str, str, str, bool | None]  # an engine's coordinates, moments, placed and interchanges


def _amplitudes(system: DocumentSystem, how: How) -> Amplitudes:
    coordinates, moments, placed, interchanges = how
    return amplitudes(system, coordinates, moments=moments, placed=placed, interchanges=interchanges)


# A worker looks at a scene with several engines, in the same states, of which these two are the same for all or most.
@lru_cache(maxsize=2)
def _mass(system: DocumentSystem, theta: bytes) -> Array:
    found = mass_matrix(system, np.frombuffer(theta).reshape(-1, system.n))
    found.flags.writeable = False
    return found


@lru_cache(maxsize=8)
def _regular(system: DocumentSystem, how: How, accuracy: float, theta: bytes) -> NDArray[np.bool_]:
    return _amplitudes(system, how).regular(_mass(system, theta), accuracy)


def array_of(quantity: str, answer: object, shape: tuple[int, ...], labels: tuple[str, ...]) -> Array:
    """``answer`` as an array of this shape, or :class:`EngineFault` saying what is wrong with it.

    ``labels``: of the states, where the first axis goes over them.
    """
    try:
        array = np.asarray(answer, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise EngineFault(f"{quantity}: not an array of numbers: {error}") from None
    if array.shape != shape:
        raise EngineFault(f"{quantity}: shape {array.shape} returned, {shape} expected")
    bad = ~np.isfinite(array)
    if bad.any():
        row = int(np.argwhere(bad)[0][0])
        where = f", first in state {labels[row]!r}" if shape[0] == len(labels) else ""
        raise EngineFault(f"{quantity}: {int(bad.sum())} of {bad.size} values are NaN or infinite{where}")
    return array


@dataclass(frozen=True)
class Worst:
    """The largest of an array of quotients, and where it is."""

    value: float
    index: tuple[int, ...]


def worst(quotients: Array) -> Worst:
    """The largest entry; an infinite one where a comparison with nothing failed."""
    index = np.unravel_index(int(np.argmax(quotients)), quotients.shape)
    return Worst(float(quotients[index]), tuple(map(int, index)))


def quotient(error: Array, scale: Array) -> Array:
    """|error| / scale, where 0/0 is 0 (nothing was expected and nothing came) and x/0 is infinite."""
    size = np.abs(error)
    return np.divide(size, scale, out=np.where(size > 0, np.inf, 0.0), where=scale > 0)


@dataclass(frozen=True)
class Judged:
    """The worst entry of a residual: its quotient with what its state allows (1: as much as that), and where it is."""

    worst: Worst
    allowed: float

    @property
    def agrees(self) -> bool:
        return self.worst.value <= 1

    def fields(self) -> dict[str, Any]:
        """``measured``, ``allowed``, ``unit`` of a result."""
        return {"measured": self.worst.value * self.allowed, "allowed": self.allowed, "unit": "ε"}


def judge(residual: Array, unit: Array, epsilons: Array) -> Judged:
    """``residual`` over ``unit`` (K, n, n), against ``epsilons`` (K,): roundings allowed × ε, in absolute numbers."""
    found = worst(quotient(residual, epsilons[:, None, None] * unit))
    return Judged(found, float(epsilons[found.index[0]] / 2.0**-52))


class Asked(Protocol):
    """A cell of any kind: an engine, and how its answers are checked."""

    @property
    def engine(self) -> Any:
        """The engine."""
        ...

    def answer(self, quantity: str, answer: object, shape: tuple[int, ...], /) -> Array:
        """``answer`` as an array of this shape."""
        ...


def slopes(cell: Asked, offers: Collection[str], at: Array, rates: Array) -> tuple[Array | None, ...]:
    """The engine's ∂a/∂q, ∂a/∂v and M⁻¹ in states (K, n), (K, n, n) each; None for what it does not offer."""
    shape = (*rates.shape, rates.shape[-1])
    of_positions = of_rates = inverse = None
    if "derivatives" in offers:
        both = cell.engine.derivatives(at, rates)
        of_positions, of_rates = (cell.answer("derivatives", each, shape) for each in both)
    if "inverse_mass" in offers:
        inverse = cell.answer("inverse mass matrix", cell.engine.inverse_mass(at), shape)
    return of_positions, of_rates, inverse


def relative_error(error: Array, true: Array) -> float:
    """The largest error of a state's matrix over its largest entry; (K, n, n)."""
    size, off = np.abs(true).max(axis=(1, 2), initial=0.0), np.abs(error).max(axis=(1, 2), initial=0.0)
    return float(np.divide(off, size, out=np.where(off > 0, np.inf, 0.0), where=size > 0).max(initial=0.0))
