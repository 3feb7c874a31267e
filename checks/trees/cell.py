"""One scene of an open mechanism on one engine: what its comparisons are given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...diagnosis.explanation import Explanation, together
from ...diagnosis.finding import Finding
from ...engines import EngineInfo, Integrator, TreeShape
from ...models import TreeScene
from ...models.spatial_mechanism import SpatialMechanism
from ...models.trees.states import TreeStates
from ...records.check import Outcome, Result
from ...reference.integration.tree_places import quaternions
from ...reference.rounding.bounds import EPSILON
from ...reference.rounding.spatial import Magnitudes
from ..cell import array_of
from .facts import TreeFacts

Array = NDArray[np.float64]


def magnitudes_in(info: EngineInfo, mechanism: SpatialMechanism, q: Array, v: Array) -> Magnitudes:
    """Of the terms of a mechanism, as an engine computes them, in one state, q (nq,) and v (nv,).

    Of what is not known of the engine the way with the most rounding counts.
    """
    world = info.moments in ("tree", "unknown") or info.placed in ("world", "unknown")
    together = info.algorithm == "unknown" or (info.tree is not None and info.tree.together)
    return Magnitudes(mechanism, q, v, world=world, together=together)


@dataclass(frozen=True)
class TreeCell:
    """``states`` are those in which quantities are compared; ``facts`` the truth in them.

    ``findings``: why answers differ, asked once and only if one does; ``in_file``: what was found in the engine's
    reading of the scene's model file. ``few_steps``: as of a mechanism of the documents.
    """

    scene: TreeScene
    info: EngineInfo
    engine: TreeShape
    states: TreeStates
    facts: TreeFacts
    findings: Callable[[], list[Finding]] = list
    in_file: list[Finding] = field(default_factory=list)
    few_steps: int = 1 << 10

    @cached_property
    def mechanism(self) -> SpatialMechanism:
        """The scene's mechanism, as arrays."""
        return self.scene.system.mechanism()

    @cached_property
    def magnitudes(self) -> list[Magnitudes]:
        """Of the terms, as this engine computes them, in each state."""
        pairs = zip(self.states.q, self.states.v, strict=True)
        return [self.magnitudes_of(self.mechanism, q, v) for q, v in pairs]

    def magnitudes_of(self, mechanism: SpatialMechanism, q: Array, v: Array) -> Magnitudes:
        """Those of any mechanism in this engine, in one state, q (nq,) and v (nv,)."""
        return magnitudes_in(self.info, mechanism, q, v)

    @cached_property
    def roundings(self) -> Array:
        """How many ε of its unit a number may be off by in each state, (B,)."""
        return np.array([self.roundings_of(units) for units in self.magnitudes])

    def roundings_of(self, units: Magnitudes) -> float:
        """How many ε of these units a number may be off by."""
        return units.roundings * (self.info.accuracy / EPSILON)

    @cached_property
    def integrators(self) -> tuple[Integrator, ...]:
        """The engine's, each with the order that it has in this mechanism."""
        if not quaternions(self.mechanism):
            return self.info.integrators
        return tuple(replace(one, order=one.turning or one.order) for one in self.info.integrators)

    @property
    def explanation(self) -> Explanation:
        """What is known of why answers differ: of a user's own equations, and of an engine's reading of a file."""
        return together([*self._found, *self.in_file])

    @cached_property
    def _found(self) -> list[Finding]:
        return self.findings()

    def motion_causes(self, integrator: Integrator) -> list[Finding]:
        """No cause is looked for in a tree."""
        return []

    @property
    def start(self) -> tuple[Array, Array] | None:
        """The state from which trajectories start, q (nq,) and v (nv,); None where the scene has none."""
        if self.scene.q is None or self.scene.v is None:
            return None
        return np.array(self.scene.q), np.array(self.scene.v)

    def trajectory(self, q: Array, v: Array, integrator: Integrator, step: float, steps: int) -> Array:
        """q and v at the end of one of the engine's own runs, (2, nv); of mechanisms with as many q as v."""
        return np.array(self.run(q, v, integrator, step, steps))

    def run(self, q: Array, v: Array, integrator: Integrator, step: float, steps: int) -> tuple[Array, Array]:
        """q (nq,) and v (nv,) at the end of one of the engine's own runs."""
        ends = self.engine.trajectory(q, v, integrator.name, step, steps)
        at, rates = (self.answer(integrator.name, end, given.shape) for end, given in zip(ends, (q, v), strict=True))
        return at, rates

    def path(self, q: Array, v: Array, integrator: Integrator, step: float, steps: int) -> Array | None:
        """No adapter of trees gives all states of a run."""
        return None

    def answer(self, quantity: str, answer: object, shape: tuple[int, ...]) -> Array:
        """``answer`` as an array of this shape, or :class:`EngineFault` saying what is wrong with it."""
        return array_of(quantity, answer, shape, self.states.labels)

    def result(self, check: str, outcome: Outcome, **fields: Any) -> Result:
        """A result of this cell."""
        return Result(scene=self.scene.name, engine=self.info.name, check=check, outcome=outcome, **fields)

    def freedom(self, index: int) -> str:
        """What a degree of freedom is called."""
        return self.scene.system.freedoms[index]
