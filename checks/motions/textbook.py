"""Textbook schemes in the coordinates that an engine may apply them in, and how they move a state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...models.units import in_units, units_of
from ...reference import literal_accelerations
from ...reference.integration.schemes import RADIUS, SCHEMES, Scheme, generalized_alpha, newmark, run
from ...reference.kernels.forward_dynamics import plain_accelerations
from ...reference.maximal_coordinates import MaximalCoordinates, generalized_alpha_index_3, trapezoidal_index_2
from ..cell import Cell

Array = NDArray[np.float64]
Wide = NDArray[Any]
Steps = Callable[[Wide, Wide, float, int], tuple[Wide, Wide]]

MAXIMAL = "maximal coordinates"


@dataclass(frozen=True)
class Candidate:
    """A textbook scheme in some coordinates, and how it takes steps from states (B, n) in extended precision.

    ``steps``: θ, ω, the length of a step [s] and how many there are → θ, ω at the end. ``scheme``: the same in angles.
    """

    scheme: Scheme
    coordinates: str
    steps: Steps

    @property
    def name(self) -> str:
        """As it is called in the report."""
        return f"{self.scheme.name} in {self.coordinates}"

    @property
    def held(self) -> str:
        """What the scheme holds together in the joints at the end of a step: positions, velocities, or nothing."""
        return _HELD.get(self.scheme.name, "") if self.coordinates == MAXIMAL else ""

    def end(self, theta: Array, omega: Array, h: float, steps: int = 1) -> tuple[Wide, Wide]:
        """θ and ω after the steps, from states (B, n) in double precision."""
        return self.steps(theta.astype(np.longdouble), omega.astype(np.longdouble), h, steps)


def says_whose_step(integrator: Integrator, name: str, order: int, alike: Sequence[str]) -> str:
    """In words: one step of the integrator is that of the scheme of this ``name`` and ``order``, or ``alike``'s too."""
    if order != integrator.order:
        return f"{integrator.name} is said to be of order {integrator.order}; one step is that of {name}"
    if alike:
        return f"one step is that of {name}; rounding hides how it differs from {', '.join(alike)}"
    return f"one step is that of {name}"


def candidates(cell: Cell, rates: Array, *, literal: bool = True) -> list[Candidate]:
    """Every scheme, in the coordinates that the engine may apply it in; ``rates`` (B, n): those of its states.

    ``literal``: with accelerations by the document's own formula, or else in O(n).
    """
    system = cell.scene.system
    formula = literal_accelerations if literal else plain_accelerations

    def accelerations(theta: Wide, omega: Wide) -> Wide:
        return np.asarray(formula(system, theta, omega))

    def in_angles(scheme: Scheme) -> Steps:
        return lambda theta, omega, h, steps: run(scheme, accelerations, theta, omega, h, steps)

    found = [Candidate(scheme, "angles", in_angles(scheme)) for scheme in SCHEMES]
    if cell.info.coordinates == "maximal":
        units = units_of(system.tree()).fitting(system.gravity, rates)
        bodies = MaximalCoordinates(in_units(system.tree(), units))
        found += [
            Candidate(scheme, MAXIMAL, _one_by_one(bodies, steps, units.time)) for scheme, steps in MAXIMAL_SCHEMES
        ]
    return found


_Steps = Callable[[MaximalCoordinates, Wide, Wide, Any, int], tuple[Wide, Wide]]

_ALPHA, _TRAPEZOIDAL = generalized_alpha(RADIUS), newmark(np.longdouble(1) / 4, np.longdouble(1) / 2)
_POSITIONS = Scheme(
    "generalized-α, ρ∞ = 0.9, positions held together", 2, _ALPHA.step, reach=2.0, stages=3, remembers=_ALPHA
)
_VELOCITIES = Scheme(
    "trapezoidal rule, velocities held together", 2, _TRAPEZOIDAL.step, reach=2.0, stages=3, remembers=_TRAPEZOIDAL
)
_HELD = {_POSITIONS.name: "positions", _VELOCITIES.name: "velocities"}
MAXIMAL_SCHEMES: tuple[tuple[Scheme, _Steps], ...] = (
    (_POSITIONS, lambda bodies, t, w, h, steps: generalized_alpha_index_3(bodies, t, w, h, RADIUS, steps)),
    (_VELOCITIES, trapezoidal_index_2),
)


def _one_by_one(bodies: MaximalCoordinates, steps: _Steps, second: float) -> Steps:
    """Steps of ``bodies`` whose unit of time has so many seconds."""

    def each(theta: Wide, omega: Wide, h: float, count: int) -> tuple[Wide, Wide]:
        ends = [
            steps(bodies, t, w * second, np.longdouble(h / second), count) for t, w in zip(theta, omega, strict=True)
        ]
        return np.stack([end[0] for end in ends]), np.stack([end[1] for end in ends]) / second

    return each
