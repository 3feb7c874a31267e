"""The spread that rounding gives to what engines compute in link frames: RNEA and ABA in Monte-Carlo arithmetic.

Each function takes states (B, n) in absolute angles and returns root mean squares of the error, in absolute
coordinates too: the sums and differences that furiko's own change of coordinates takes are rounded with the rest.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import PlanarTree
from ...models.tree import SUPPORT
from .lever_arms import from_support
from .link_frames import forward_dynamics, in_world, inverse_dynamics, joint_turns
from .monte_carlo import Noise, Noisy, spread

Array = NDArray[np.float64]

SAMPLES = 16  # the spread is then known to a fifth of itself
SEED = 20261126


class _Run:
    """One mechanism in Monte-Carlo arithmetic: constants, states, and joints that a reader may have displaced."""

    def __init__(self, tree: PlanarTree, theta: Array, accuracy: float, placed: str) -> None:
        self.tree, self.shape = tree, (SAMPLES, len(theta))
        self.noise = Noise(SEED, accuracy)
        self.turns = joint_turns(self.relative(theta), self._places(placed))

    def number(self, value: float) -> Noisy:
        """A constant that double precision rounds."""
        return self.noise(np.full(self.shape, value))

    def relative(self, absolute: Array) -> list[Any]:
        """Differences to the parent's value; the number 0.0 where it is zero in every state."""
        found: list[Any] = []
        for i, parent in enumerate(self.tree.parents):
            column = absolute[:, i] if parent == SUPPORT else absolute[:, i] - absolute[:, parent]
            found.append(self.noise(np.broadcast_to(column, self.shape)) if column.any() else _Zero(0.0))
        return found

    def absolute(self, relative: list[Any]) -> list[Any]:
        """Sums over the way from the support."""
        found: list[Any] = []
        for i, parent in enumerate(self.tree.parents):
            found.append(relative[i] if parent == SUPPORT else found[parent] + relative[i])
        return found

    def absolute_rows(self, torques: list[Any]) -> list[Any]:
        """Each joint's torque less those of the joints that its link carries."""
        found = list(torques)
        for i, parent in enumerate(self.tree.parents):
            if parent != SUPPORT:
                found[parent] = found[parent] - torques[i]
        return found

    def values(self, numbers: list[Any]) -> Array:
        """(samples, B, n)."""
        return np.stack(
            [x.value if isinstance(x, Noisy) else np.full(self.shape, float(x)) for x in numbers], axis=-1
        )

    def _places(self, placed: str) -> list[tuple[Any, Any]]:
        """The joints' places on their parents; off by the rounding of the way from the support if had from there."""
        places: list[tuple[Any, Any]] = [link.hinge for link in self.tree.links]
        if placed == "world":
            way = from_support(self.tree)[0]
            for i, link in enumerate(self.tree.links):
                if link.parent != SUPPORT:
                    error = self.number(way[i]).value - way[i]
                    x, y = link.hinge
                    places[i] = (Noisy(x + error, self.noise), y)
        return places


class _Zero(float):
    """An angle or a rate that is zero in every state, so that what it is multiplied by vanishes exactly."""

    def cos(self) -> float:
        return 1.0

    def sin(self) -> float:
        return 0.0


def aba_accelerations(
    tree: PlanarTree, theta: Array, omega: Array, exact: Array, *, accuracy: float, placed: str
) -> Array:
    """Of ABA's accelerations [rad/s²], (B, n), around the ``exact`` ones."""
    run = _Run(tree, theta, accuracy, placed)
    found = forward_dynamics(
        tree, run.turns, run.relative(omega), gravity=tree.gravity, rounded=run.number
    )
    return spread(run.values(run.absolute(found)), exact)


def rnea_torques(
    tree: PlanarTree,
    theta: Array,
    omega: Array,
    alpha: Array,
    *,
    gravity: bool,
    accuracy: float,
    placed: str,
) -> Array:
    """Of the generalised forces of absolute angles [N m] that RNEA gives, (B, n), around their mean."""
    run = _Run(tree, theta, accuracy, placed)
    forces = _rnea(run, omega, alpha, tree.gravity if gravity else 0.0)
    return run.values(run.absolute_rows([force.w for force in forces])).std(axis=0)


def rnea_forces(
    tree: PlanarTree, theta: Array, omega: Array, alpha: Array, *, accuracy: float, placed: str
) -> Array:
    """Of the length [N] of the error of each joint's force, (B, n), around their mean."""
    run = _Run(tree, theta, accuracy, placed)
    pairs = in_world(tree, run.turns, _rnea(run, omega, alpha, tree.gravity))
    x, y = (run.values([pair[k] for pair in pairs]) for k in range(2))
    return np.sqrt(x.var(axis=0) + y.var(axis=0))


def _rnea(run: _Run, omega: Array, alpha: Array, gravity: float) -> list[Any]:
    return inverse_dynamics(
        run.tree, run.turns, run.relative(omega), run.relative(alpha), gravity=gravity, rounded=run.number
    )
