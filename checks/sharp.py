"""The sharp line: as good as rounding should be, entry by entry, well within the proven worst case.

:mod:`furiko.reference.rounding.spread` says what rounding really does to an entry in a state: its root mean square. A
result that is within the proven bound, but further off than a factor times that, agrees and is ``loose``.

The factors were set by measurement with all six engines over the catalogue's scenes and random mechanisms, mild and
wide, as ``tests/checks/score_sound.py`` draws them. The largest quotients were 34 for accelerations (articulated bodies
on a chain with a link a thousand times shorter than the next; 17 elsewhere), 10 for terms, 6 for joint forces, 31 for
energies and 6.4 in maximal coordinates, where 110 mechanisms more than the others' were looked at (13,436 results). A
factor is about twice that where the model is known to lack an operation or the sample is small, and less elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engines import EngineInfo, Integrator
from ..models.states import States
from ..models.systems import DocumentSystem
from ..models.trees.states import TreeStates
from ..reference.rounding.maximal_elimination import spread_states
from .cell import Cell, quotient, worst

Array = NDArray[np.float64]

# Spreads beyond which a result is loose, for each quantity.
ACCELERATIONS = 25.0  # of a mass matrix that is factorised
ARTICULATED = 15.0  # of articulated bodies
TERMS = 15.0
JOINT_FORCES = 15.0
ENERGY = 15.0
STEPS = 10.0  # angles and rates after steps of an explicit scheme, or the accelerations' where that is more
ITERATED = 30.0  # the same of an implicit one, whose tolerance comes besides
MAXIMAL = 8.0  # accelerations and joint forces of engines in maximal coordinates

ENTRIES = 1_000  # states times links that are looked at for accelerations
SYMMETRIES = 64  # the same for symmetries, each of which has an image
COLUMNS = 200  # for terms, where each state costs n rows of inverse dynamics
LONGEST = 200  # links of the longest mechanism for which terms, or maximal coordinates, are looked at
FEW = 10  # states in maximal coordinates, at most


@dataclass(frozen=True)
class Line:
    """How far a result is from the sharp line.

    ``quotient``: the worst |error| / spread; ``factor``: the quotient beyond which a result is loose; ``where``: the
    worst entry's index, ``state`` its label; ``states``: how many were looked at, of ``asked``.
    """

    quotient: float
    factor: float
    where: tuple[int, ...]
    state: str
    states: int
    asked: int

    @property
    def loose(self) -> bool:
        """Whether rounding as it really is does not explain the result."""
        return self.quotient > self.factor

    @property
    def says(self) -> str:
        """A sentence why the result is loose."""
        entry = ", ".join(str(i + 1) for i in self.where)
        return (
            f"within the proven bound, but entry [{entry}] in state {self.state!r} is off by {self.quotient:.3g} times "
            f"what rounding does there (root mean square); up to {self.factor:g} times is rounding"
        )

    def details(self) -> dict[str, Any]:
        """For a result's ``details``."""
        return {
            "sharp line": {
                "quotient": self.quotient,
                "factor": self.factor,
                "entry": [i + 1 for i in self.where],
                "state": self.state,
                "states": self.states,
                "of states": self.asked,
            }
        }


def line(
    error: Array, spread: Array, factor: float, states: States | TreeStates, asked: int, besides: Array | float = 0.0
) -> Line:
    """Hold errors (B, …) against their spreads; ``states``: those that were chosen, of ``asked``.

    A spread of zero is one where nothing but exact zeros meets: any error there is beyond the line. One that overflows
    says nothing. ``besides``: what an error may be besides rounding, as it is: a tolerance that a solver states.
    """
    whole = spread + besides / factor
    known = np.where(np.isfinite(whole), whole, np.inf)
    found = worst(quotient(error, np.broadcast_to(known, error.shape)))
    return Line(found.value, factor, found.index[1:], states.labels[found.index[0]], len(states), asked)


def widest(cell: Cell, spread: Callable[..., Array], *state: Array, system: DocumentSystem | None = None) -> Array:
    """The largest spread in each entry, of all the ways in which the cell's engine may compute.

    ``spread``: a function of :mod:`furiko.reference.rounding.spread`; ``state``: what it is given besides engine and
    mechanism; ``system``: another mechanism in this engine.
    """
    sizes = [
        spread(way.info, cell.scene.system, way.amplitude, *state)
        if system is None
        else spread(way.info, system, way.amplitude_of(system), *state)
        for way in cell.ways
    ]
    return np.asarray(np.max(sizes, axis=0))


def chosen(excess: Array, most: int) -> NDArray[np.intp]:
    """Which of the states to look at, in order: all, or half the worst by ``excess`` (B,) and half evenly spread."""
    count = len(excess)
    if count <= most or not most:
        return np.arange(count)
    bad = np.argsort(-excess, kind="stable")[: (most + 1) // 2]
    even = np.linspace(0, count - 1, most - len(bad)).round().astype(np.intp)
    return np.union1d(bad, even)


def is_known(info: EngineInfo) -> bool:
    """Whether the usual rounding of an engine's algorithm is known, and not its worst alone."""
    return info.algorithm != "other"


def for_accelerations(info: EngineInfo) -> float:
    """The factor for accelerations of this engine."""
    if info.coordinates == "maximal":
        return MAXIMAL
    return ARTICULATED if info.algorithm == "aba" else ACCELERATIONS  # the larger, where it may be either


def for_steps(info: EngineInfo, integrator: Integrator) -> float:
    """The factor for angles and rates after steps of this integrator: no smaller than the accelerations' it adds up."""
    return max(ITERATED if integrator.tolerance else STEPS, for_accelerations(info))


def states_for_accelerations(info: EngineInfo, n: int) -> int:
    """How many states a cell can afford, about a quarter of a second's work; 0: none."""
    if not is_known(info):
        return 0
    if info.coordinates != "maximal":
        return max(4, ENTRIES // n)
    return min(FEW, *(spread_states(n, way.ordering) for way in info.ways))


def steps_together(integrator: Integrator, n: int, few: int) -> int:
    """How many steps of a run are taken beside the engine's: what costs some hundredths of a second.

    ``few``: as of a trajectory that is worth a longer time.
    """
    return max(4, round((8 if integrator.tolerance else 64 // integrator.order) * min(1.0, 4 / n) * few / 1024))


def states_for_symmetries(info: EngineInfo, n: int) -> int:
    """How many states a cell can afford in which each image of the mechanism is looked at; 0: none."""
    if not is_known(info):
        return 0
    if info.coordinates == "maximal":
        return min(2, *(spread_states(n, way.ordering) // 4 for way in info.ways))
    return min(2, SYMMETRIES // n)


def states_for_energy(info: EngineInfo, n: int) -> int:
    """The same for energies."""
    return max(4, ENTRIES // n) if is_known(info) else 0


def states_for_terms(info: EngineInfo, n: int) -> int:
    """The same for the terms of the equations of motion."""
    return max(2, COLUMNS // n, min(8, 3 * COLUMNS // n)) if n <= LONGEST and is_known(info) else 0


def verdict(agrees: bool, sharp: Line | None, reason: str) -> dict[str, Any]:
    """``outcome``, ``loose`` and ``reason`` of a result: loose is only what agrees."""
    if not agrees:
        return {"outcome": "differs", "reason": reason}
    if sharp is None or not sharp.loose:
        return {"outcome": "agrees", "reason": reason}
    return {"outcome": "agrees", "loose": True, "reason": sharp.says}
