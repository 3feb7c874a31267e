"""Featherstone's law: how the mass matrix's condition grows with the number of links, in two kinds of coordinates.

R. Featherstone, "An empirical study of the joint space inertia matrix" (IJRR 23, 2004): for chains in relative
coordinates it grows with n⁴ when they are stretched out, for legs side by side with n or less.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...models import NLegPendulum, RodChain
from ...models.coordinates import absolute_from_relative
from ...records.check import Result
from ...reference import mass_matrix

Coordinates = Literal["absolute", "relative"]
Posture = Literal["straight chain", "random chain", "legs"]

LINKS = (4, 8, 16, 32, 64, 128, 256)
STATES = 5
ENGINE = "document"


@dataclass(frozen=True)
class ConditionCase:
    """Condition of the mass matrix in both coordinates, for one posture and n links."""

    posture: Posture
    n: int
    seed: int
    engine: str = ENGINE

    @property
    def scene(self) -> str:
        """The posture."""
        return f"condition, {self.posture}"

    @property
    def check(self) -> str:
        """How many links."""
        return f"{self.n} links"

    def run(self) -> Result:
        """Median over a few random states of λ_max/λ_min."""
        random = np.random.Generator(np.random.PCG64([self.seed, self.n]))
        ones = (1.0,) * self.n
        system = NLegPendulum(ones, ones) if self.posture == "legs" else RodChain(ones)
        states = 1 if self.posture == "straight chain" else STATES
        theta = np.zeros((1, self.n)) if states == 1 else random.uniform(-np.pi, np.pi, (states, self.n))
        M = mass_matrix(system, theta)
        S = absolute_from_relative(system.tree().parents)
        found = {
            "absolute": float(np.median([_condition(m) for m in M])),
            "relative": float(np.median([_condition(m) for m in S.T @ M @ S])),
        }
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees",
            measured=found["relative"],
            unit="(relative coordinates)",
            details={"n": self.n, "posture": self.posture, **found},
        )


def _condition(matrix: np.ndarray) -> float:
    values = np.linalg.eigvalsh(matrix)
    return float(values[-1] / values[0])


def condition_cases(seed: int) -> tuple[ConditionCase, ...]:
    """All of them, the small ones first."""
    postures: tuple[Posture, ...] = ("straight chain", "random chain", "legs")
    return tuple(ConditionCase(posture, n, seed) for n in LINKS for posture in postures)
