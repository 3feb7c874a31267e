"""How small an error a run notices: the sharp line over an engine's own error, entry by entry, and planted faults.

An error that is a given part of an entry in every state is noticed where the line is the sharpest, in any one state.
Long mechanisms are looked at in a few states, though, which are others for an engine with a fault in it: what is read
off the line is raised until planted faults confirm it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...checks import sharp
from ...checks.cell import Cell
from ...checks.check import Check
from ...checks.facts import FORCE_STATES, scene_facts
from ...checks.registry import CHECKS
from ...engines import AnyShape, cannot, load_engine
from ...models import InvalidInput, find_document_scene
from ...models.states import states
from ...records.bench import Sharpness
from ...reference import mass_matrix
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON

Array = NDArray[np.float64]
Entry = tuple[int, ...]

RAISED = 2.0**10  # the line at most, for faults to confirm it


@dataclass(frozen=True)
class Measured:
    """Of one quantity in states (B, …): true sizes, the engine's errors, and the sharp line in those looked at."""

    size: Array
    error: Array
    line: Array
    looked_at: NDArray[np.intp]


def sharpness(scenes: Sequence[str], engines: Sequence[str], random_states: int = 200) -> list[Sharpness]:
    """A row for each scene, engine and quantity (accelerations, mass matrix, joint forces) that the engine gives.

    Engines in their order, scene by scene, in this process. Raises as :func:`furiko.engines.load_engine` does, but
    leaves out a scene that an engine cannot take.
    """
    return [row for scene in scenes for row in _of_scene(scene, engines, random_states)]


def _of_scene(name: str, engines: Sequence[str], random_states: int) -> Iterator[Sharpness]:
    scene = find_document_scene(name, "furiko bench --sharpness")
    looked_at = states(scene, random_states)
    facts = scene_facts(scene, looked_at)
    for engine in engines:
        try:
            loaded = load_engine(engine, scene.system)
        except InvalidInput:
            continue
        if cannot(loaded.info, scene.system):
            continue
        cell = Cell(scene, loaded.info, loaded, looked_at, facts)
        for quantity, (needs, measure) in QUANTITIES.items():
            if needs not in cell.info.missing:
                yield _row(cell, quantity, measure(cell))


def _row(cell: Cell, quantity: str, found: Measured) -> Sharpness:
    noticed = _smallest(found.line, found.size[found.looked_at])
    own = np.maximum(np.quantile(_relative(found.error, found.size), 0.99, axis=0), EPSILON)
    places = [tuple(int(n * part) for n in noticed.shape) for part in (0.0, 0.5)]
    places.append(tuple(n - 1 for n in noticed.shape))
    planted = [place for place in dict.fromkeys(places) if np.isfinite(noticed[place])]
    raised = [_raised(cell, quantity, place, 2 * float(noticed[place])) for place in planted]
    noticed = noticed * max(raised, default=1.0)
    ratio = np.where(np.isfinite(noticed), noticed / own, 0.0)  # an entry that is always zero has no relative error
    worst = np.unravel_index(int(ratio.argmax()), ratio.shape)
    return Sharpness(
        scene=cell.scene.name,
        engine=cell.info.name,
        quantity=quantity,
        states=len(found.looked_at),
        noticed=float(noticed[worst]),
        own=float(own[worst]),
        ratio=float(ratio[worst]),
        entry=[int(i) + 1 for i in worst],
        planted=len(planted),
        found=sum(factor < RAISED for factor in raised),
    )


def _raised(cell: Cell, quantity: str, place: Entry, share: float) -> float:
    """The smallest power of two times which a fault of this part of an entry is noticed; :data:`RAISED` for none."""
    factor = 1.0
    while factor < RAISED and not _notices(cell, quantity, place, factor * share):
        factor *= 2
    return factor


def _relative(values: Array, size: Array) -> Array:
    return np.divide(np.abs(values), np.abs(size), out=np.zeros_like(size), where=size != 0)


def _smallest(line: Array, size: Array) -> Array:
    """The smallest of the line over an entry's size in any state; infinite where it is zero in all."""
    found = np.divide(line, np.abs(size), out=np.full(size.shape, np.inf), where=size != 0)
    return np.asarray(found.min(axis=0))


def _accelerations(cell: Cell) -> Measured:
    info, system, high = cell.info, cell.scene.system, cell.facts.high
    error = cell.facts.error(cell.accelerations())
    at = sharp.chosen(np.abs(error).max(axis=-1), max(1, sharp.states_for_accelerations(info, system.n)))
    chosen = cell.states.at(at)
    size = sharp.widest(cell, spread.accelerations, chosen.theta, chosen.omega, high[at])
    factor = sharp.for_accelerations(info)
    return Measured(high, error, factor * size, at)


def _mass(cell: Cell) -> Measured:
    from ...checks.comparisons.terms import ROWS, columns, widest_terms

    n = cell.scene.system.n
    some = cell.states.at(np.arange(len(cell.states))[::-1][: max(1, ROWS // (2 * n + 2))])
    mass = mass_matrix(cell.scene.system, some.theta)
    error = columns(cell, some.theta, "alpha") - mass
    at = sharp.chosen(np.abs(error).reshape(len(error), -1).max(axis=-1), max(1, sharp.states_for_terms(cell.info, n)))
    chosen = some.at(at)
    return Measured(mass, error, sharp.TERMS * widest_terms(cell, chosen).mass, at)


def _forces(cell: Cell) -> Measured:
    info, system, forces = cell.info, cell.scene.system, cell.facts.forces
    last = cell.states.at(np.arange(len(cell.states))[-FORCE_STATES:])
    alpha = cell.facts.high[-FORCE_STATES:]
    got = cell.answer("joint forces", cell.engine.joint_forces(last.theta, last.omega, alpha), forces.shape)
    error = np.linalg.norm(got - forces, axis=-1)
    at = sharp.chosen(error.max(axis=-1), max(1, sharp.states_for_accelerations(info, system.n)))
    chosen = last.at(at)
    size = sharp.widest(cell, spread.joint_forces, chosen.theta, chosen.omega, alpha[at])
    factor = sharp.MAXIMAL if info.coordinates == "maximal" else sharp.JOINT_FORCES
    return Measured(np.linalg.norm(forces, axis=-1), error, factor * size, at)


QUANTITIES: dict[str, tuple[str, Callable[[Cell], Measured]]] = {
    "accelerations": ("accelerations", _accelerations),
    "terms M": ("inverse_dynamics", _mass),
    "joint forces": ("joint_forces", _forces),
}


class _Planted:
    """An engine one entry of whose answers is off by a part of it."""

    def __init__(self, engine: AnyShape, cell: Cell, quantity: str, entry: Entry, share: float) -> None:
        self._engine, self._system = engine, cell.scene.system
        self._quantity, self._entry, self._share = quantity, entry, share

    def __getattr__(self, name: str) -> Any:
        return getattr(self._engine, name)

    def accelerations(self, theta: Array, omega: Array) -> Array:
        """As the engine's, but for the entry."""
        return self._moved("accelerations", self._engine.accelerations(theta, omega).copy())

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        """The same."""
        return self._moved("joint forces", self._engine.joint_forces(theta, omega, alpha).copy())

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        """With an entry of the mass matrix that is off."""
        found = self._engine.inverse_dynamics(theta, omega, alpha, gravity=gravity).copy()
        if self._quantity == "terms M":
            row, column = self._entry
            found[:, row] += self._share * mass_matrix(self._system, theta)[:, row, column] * alpha[:, column]
        return found

    def _moved(self, quantity: str, answer: Array) -> Array:
        if quantity == self._quantity:
            answer[:, self._entry[0]] *= 1 + self._share
        return answer


def _notices(cell: Cell, quantity: str, entry: Entry, share: float) -> bool:
    """Whether the check of the quantity finds a fault of this part of the entry."""
    check: Check = CHECKS["terms" if quantity == "terms M" else quantity]
    faulty: Any = _Planted(cell.engine, cell, quantity, entry, share)
    results = [result for result in check.compare(replace(cell, engine=faulty)) if result.check == quantity]
    return any(result.loose or result.outcome == "differs" for result in results)
