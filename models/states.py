"""The states in which a scene's accelerations, forces and energies are compared: given, named and random ones."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .scene import Scene
from .systems import System

Array = NDArray[np.float64]

# Random angles and rates are multiples of this, so that differences of neighbouring angles (an engine's relative
# coordinates) are exact and no comparison depends on how its input was rounded.
QUANTUM = 2.0**-40


@dataclass(frozen=True)
class States:
    """``theta`` [rad] and ``omega`` [rad/s], shape (B, n), and a label for each of the B states."""

    labels: tuple[str, ...]
    theta: Array
    omega: Array

    def __len__(self) -> int:
        return len(self.labels)

    def at(self, rows: NDArray[np.intp]) -> States:
        """Those with these numbers."""
        return States(tuple(self.labels[row] for row in rows), self.theta[rows], self.omega[rows])

    def only(self, chosen: NDArray[np.bool_]) -> States:
        """The states where ``chosen`` (B,) is true."""
        labels = tuple(label for label, taken in zip(self.labels, chosen, strict=True) if taken)
        return States(labels, self.theta[chosen], self.omega[chosen])


def states(scene: Scene, random: int | None = None) -> States:
    """The scene's given state, its named ones, then its random ones; at most ``random`` of these, if given."""
    system = scene.system
    labels: list[str] = []
    rows: list[tuple[Array, Array]] = []
    if scene.theta is not None and scene.omega is not None:
        labels.append("given")
        rows.append((np.array(scene.theta), np.array(scene.omega)))
    for word in scene.named:
        labels.append(word)
        rows.append(named_state(word, system))
    count = scene.random if random is None else min(random, scene.random)
    theta, omega = random_states(scene.name, system, count)
    labels += [f"random {i}" for i in range(count)]
    return States(
        tuple(labels),
        np.concatenate([np.array([row[0] for row in rows]).reshape(-1, system.n), theta]),
        np.concatenate([np.array([row[1] for row in rows]).reshape(-1, system.n), omega]),
    )


def natural_rate(system: System) -> float:
    """√(g/L) [rad/s], L being the length of the longest chain of links; 1 where there is no gravity."""
    reach = sum(system.lengths) if system.kind == "rod-chain" else system.lengths[0] + max(system.lengths[1:])
    return math.sqrt(system.gravity / reach) or 1.0


def named_state(word: str, system: System) -> tuple[Array, Array]:
    """θ [rad] and ω [rad/s], shape (n,) each, of one of :data:`furiko.models.scene.NAMED_STATES`. Else ValueError."""
    n = system.n
    rest = np.zeros(n)
    index = np.arange(1, n + 1)
    if word == "hanging":
        return rest, rest
    if word == "horizontal":
        return np.full(n, math.pi / 2), rest
    if word == "inverted":
        return np.full(n, math.pi), rest
    if word == "small":
        return quantised(1e-3 * np.cos(index)), quantised(1e-3 * natural_rate(system) * np.sin(index))
    if word == "whirling":
        return quantised(0.5 * index), quantised(100 * natural_rate(system) * np.cos(2.0 * index))
    if word == "straight":
        return np.full(n, 0.7), quantised(np.full(n, 2 * natural_rate(system)))
    raise ValueError(f"no state is called {word!r}")


def random_states(seed: str, system: System, count: int) -> tuple[Array, Array]:
    """Angles uniform on the circle, rates uniform within six times the natural rate; shape (count, n) each.

    ``seed`` is a word (a scene's name). The first 20 of 200 states are the same as 20 states asked for alone.
    """
    digest = hashlib.sha256(seed.encode()).digest()
    generator = np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "big")))
    draws = 2 * generator.random((count, 2, system.n)) - 1
    return quantised(math.pi * draws[:, 0]), quantised(6 * natural_rate(system) * draws[:, 1])


def quantised(values: NDArray[np.floating]) -> Array:
    """The values rounded to multiples of :data:`QUANTUM`."""
    return np.asarray(np.round(values / QUANTUM) * QUANTUM, dtype=np.float64)
