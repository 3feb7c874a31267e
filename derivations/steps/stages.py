"""The stages of a derivation that is stated step by step, and what each has to follow from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

from ..algebra.trig import Formula
from .first_order import FirstOrder, Labelled

# fmt: off
StageName = Literal[
    "positions", "velocities", "kinetic", "potential", "lagrangian", "momenta", "hamiltonian", "equations", "solved"
]
# fmt: on
STAGES: tuple[StageName, ...] = (
    "positions",
    "velocities",
    "kinetic",
    "potential",
    "lagrangian",
    "momenta",
    "hamiltonian",
    "equations",
    "solved",
)  # fmt: skip
Component = tuple[str, int]  # "x", "y", or "v" for the square of a speed; and the body, from 0


@dataclass(frozen=True)
class Stages:
    """What was stated; a part that is None or empty is not given.

    ``momenta``: each as the momentum minus what it is said to be. ``hamiltonian``: the Lagrangian that belongs to it,
    in coordinates and rates, or None with ``first_order``, whose rows are those of a Hamiltonian that has none;
    ``equations`` with momenta are given with these eliminated, and ``rates`` are what remains of those for the rates.
    """

    positions: dict[Component, Formula] = field(default_factory=dict)
    velocities: dict[Component, Formula] = field(default_factory=dict)
    kinetic: Formula | None = None
    potential: Formula | None = None
    lagrangian: Formula | None = None
    momenta: Labelled = ()
    hamiltonian: Formula | None = None
    first_order: FirstOrder | None = None
    rates: Labelled = ()
    equations: Labelled = ()
    solved: Labelled = ()

    def mapped(self, change: Callable[[Formula], Formula]) -> Stages:
        """With every formula changed."""

        def one(f: Formula | None) -> Formula | None:
            return None if f is None else change(f)

        def rows(parts: Labelled) -> Labelled:
            return tuple((label, change(f)) for label, f in parts)

        return replace(
            self, positions={key: change(f) for key, f in self.positions.items()},
            velocities={key: change(f) for key, f in self.velocities.items()}, kinetic=one(self.kinetic),
            potential=one(self.potential), lagrangian=one(self.lagrangian), hamiltonian=one(self.hamiltonian),
            first_order=self.first_order.mapped(change) if self.first_order else None, momenta=rows(self.momenta),
            rates=rows(self.rates), equations=rows(self.equations), solved=rows(self.solved),
        )  # fmt: skip

    def has(self, stage: StageName) -> bool:
        """Whether it is given."""
        found = getattr(self, stage)
        if stage == "hamiltonian":
            return found is not None or self.first_order is not None
        return found is not None and (not isinstance(found, dict | tuple) or bool(found))

    @property
    def given(self) -> tuple[StageName, ...]:
        """The stages that are given, in order."""
        return tuple(stage for stage in STAGES if self.has(stage))
