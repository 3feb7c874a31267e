"""The spread that rounding gives to what engines compute link by link: RNEA and ABA in Monte-Carlo arithmetic.

Each function takes states (B, n) in absolute angles and returns root mean squares of the error, in absolute
coordinates too: the sums and differences that furiko's own change of coordinates takes are rounded with the rest.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models import PlanarTree
from ...models.tree import SUPPORT
from . import tree_frame
from .composite import about_centre_of_mass, in_link_frames
from .lever_arms import differences_lost
from .link_frames import (
    Inertia,
    Turn,
    forward_dynamics,
    in_world,
    inverse_dynamics,
    joint_turns,
    rigid_inertia,
    velocities,
)
from .link_frames import depths as link_depths
from .monte_carlo import MAGNIFIED, Noise, Noisy, spread

Array = NDArray[np.float64]

SAMPLES = 16  # the spread is then known to a fifth of itself
SEED = 20261126


class _Run:
    """One mechanism in Monte-Carlo arithmetic: constants, and states' differences and sums along the tree."""

    def __init__(self, tree: PlanarTree, states: int, accuracy: float) -> None:
        self.tree, self.shape = tree, (SAMPLES, states)
        self.noise = Noise(SEED, accuracy)

    def number(self, value: float) -> Noisy:
        """A constant that double precision rounds."""
        return self.noise(np.full(self.shape, value))

    def array(self, number: Noisy | float) -> Noisy:
        """A number of one run as one of many."""
        return number if isinstance(number, Noisy) else Noisy(np.full(self.shape, number), self.noise)

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
        each = [x.value if isinstance(x, Noisy) else np.full(self.shape, float(x)) for x in numbers]
        return np.moveaxis(np.stack(each), 0, -1)  # put together as they lie in memory, which is several times faster

    def turns(self, theta: Array, placed: str) -> list[Turn]:
        """The joints' transformations from link to link."""
        return joint_turns(self.relative(theta), self._places(placed))

    def _places(self, placed: str) -> list[tuple[Any, Any]]:
        """The joints' places on their parents, off by what they lose if had as differences of places in the world.

        That is so much and no other, in all links together. Every other sample has the opposite of it, so that their
        mean is that of places which have lost nothing.
        """
        turns = MAGNIFIED * (-1.0) ** np.arange(SAMPLES)[:, None]
        places: list[tuple[Any, Any]] = [link.hinge for link in self.tree.links]
        if placed == "world":
            for i, lost in enumerate(differences_lost(self.tree)):
                if lost:
                    x, y = places[i]
                    places[i] = (Noisy(np.broadcast_to(x + lost * turns, self.shape), self.noise), y)
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
    run = _Run(tree, len(theta), accuracy)
    turns, rates = run.turns(theta, placed), run.relative(omega)
    found = forward_dynamics(tree, turns, rates, gravity=tree.gravity, rounded=run.number)
    return spread(run.values(run.absolute(found)), exact)


def rnea(
    tree: PlanarTree,
    theta: Array,
    omega: Array,
    alpha: Array,
    *,
    gravity: Array,
    accuracy: float,
    placed: str,
    moments: str,
) -> tuple[Array, Array]:
    """Of generalised forces of absolute angles [N m] and of the length of each joint's force [N], (B, n) each.

    ``gravity`` [m/s²], (B,).

    ``moments``: about each link's own ``hinge``, in its frame, or about the ``tree``'s centre of mass.
    """
    run = _Run(tree, len(theta), accuracy)
    rates, accelerations = run.relative(omega), run.relative(alpha)
    down = Noisy(np.broadcast_to(gravity, run.shape), run.noise)
    if moments == "tree":
        half = [(angle.sin(), angle.cos()) for angle in run.relative(theta / 2)]
        at = tree_frame.Placed(tree, half)
        torques, found = tree_frame.inverse_dynamics(tree, at, rates, accelerations, gravity=down)
        forces = [(force.x, force.y) for force in found]
    else:
        turns = run.turns(theta, placed)
        found = inverse_dynamics(tree, turns, rates, accelerations, gravity=down, rounded=run.number)
        torques, forces = [force.w for force in found], in_world(tree, turns, found)
    x, y = (_around_mean(run.values([pair[k] for pair in forces])) for k in range(2))
    return _around_mean(run.values(run.absolute_rows(torques))), np.hypot(x, y)


def energies(
    tree: PlanarTree, theta: Array, omega: Array, *, accuracy: float, placed: str, moments: str, matrix: bool
) -> Array:
    """Of kinetic and potential energy [J], (B, 2); the kinetic link by link, or with the mass ``matrix``."""
    run = _Run(tree, len(theta), accuracy)
    rates = run.relative(omega)
    if moments == "tree":
        at = tree_frame.Placed(tree, [(angle.sin(), angle.cos()) for angle in run.relative(theta / 2)])
        twice = _twice_kinetic(about_centre_of_mass(tree, at.axes, at.inertias), rates)
        depths = at.depths
    else:
        turns = run.turns(theta, placed)
        inertias = [rigid_inertia(tree, i, run.number) for i in range(tree.n)]
        if matrix:
            own = [Inertia(*map(run.array, inertia)) for inertia in inertias]
            twice = _twice_kinetic(in_link_frames(tree, turns, own), rates)
        else:
            v = velocities(tree, turns, rates)
            force = [inertia.times(moving) for inertia, moving in zip(inertias, v, strict=True)]
            twice = _dot([x for moving in v for x in moving], [x for pushed in force for x in pushed])
        depths = link_depths(tree, turns)
    weight = _dot([link.mass for link in tree.links], depths)
    return _around_mean(run.values([run.array(0.5 * twice), run.array(-tree.gravity * weight)]))


def _twice_kinetic(parts: dict[int, tuple[list[int], Noisy]], rates: list[Any]) -> Any:
    """q̇ᵀ M q̇ from one half of M: of each row or column, those beside the diagonal count twice."""
    products: list[Any] = []
    for i, (others, entries) in parts.items():
        columns = [Noisy(entries.value[..., k], entries.noise) for k in range(len(others))]
        row = _dot([rates[j] if j == i else 2.0 * rates[j] for j in others], columns)
        products.append(rates[i] * row)
    return _dot([1.0] * len(products), products)


def _dot(one: list[Any], other: list[Any]) -> Any:
    total: Any = 0.0
    for a, b in zip(one, other, strict=True):
        total = total + a * b
    return total


def crba_matrix(tree: PlanarTree, theta: Array, *, accuracy: float, placed: str, moments: str) -> Array:
    """Of the absolute mass matrix [kg m²] from that of relative angles, (B, n, n)."""
    run, n = _Run(tree, len(theta), accuracy), tree.n
    if moments == "tree":
        at = tree_frame.Placed(tree, [(angle.sin(), angle.cos()) for angle in run.relative(theta / 2)])
        parts = about_centre_of_mass(tree, at.axes, at.inertias)
    else:
        inertias = [Inertia(*map(run.array, rigid_inertia(tree, i, run.number))) for i in range(n)]
        parts = in_link_frames(tree, run.turns(theta, placed), inertias)
    relative = np.zeros((*run.shape, n, n))
    for i, (others, entries) in parts.items():
        relative[..., i, others] = relative[..., others, i] = entries.value
    columns = run.absolute_rows([Noisy(relative[..., k], run.noise) for k in range(n)])
    wide = Noisy(np.stack([column.value for column in columns], axis=-1), run.noise)
    rows = run.absolute_rows([Noisy(wide.value[..., i, :], run.noise) for i in range(n)])
    return _around_mean(np.stack([row.value for row in rows], axis=-2))


def _around_mean(samples: Array) -> Array:
    return spread(samples, samples.mean(axis=0))
