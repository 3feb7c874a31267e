"""Energy: the engine's kinetic and potential energy against the documents'."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...models.tree import SUPPORT, PlanarTree
from ...records.check import Result
from ...reference import energies
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, Amplitudes, allowed, turns
from .. import sharp
from ..cell import Cell, quotient, worst

Array = NDArray[np.float64]

NAME = "energy"


def compare(cell: Cell) -> Iterator[Result]:
    """Both parts, over the sum of the magnitudes of their terms."""
    states, system = cell.states, cell.scene.system
    got = cell.answer("energy", cell.engine.energy(states.theta, states.omega), (len(states), 2))
    # In extended precision, so that only the engine's rounding is seen.
    wide = (values.astype(np.longdouble) for values in (states.theta, states.omega))
    expected = np.stack(energies(system, *wide), axis=-1)
    off = (got - expected).astype(np.float64)
    scale = energy_amplitudes(system.tree(), cell.amplitude, states.omega) * turns(states.theta)[:, None]
    found = worst(quotient(off, EPSILON * scale))
    bound = allowed(system.n, cell.info.accuracy)
    state, part = found.index
    agrees = found.value <= bound
    word = ("kinetic", "potential")[part]
    line = sharp_line(cell, off, quotient(off, scale).max(axis=-1))
    reason = (
        f"worst in the {word} energy"
        if agrees
        else f"the {word} energy in state {states.labels[state]!r} is {got[state, part]:.9g} J, "
        f"the documents' {expected[state, part]:.9g} J"
    )
    yield cell.result(
        NAME,
        **sharp.verdict(agrees, line, reason),
        measured=found.value,
        allowed=bound,
        unit="ε",
        details={"part": word, "state": states.labels[state], "states": len(states)} | (line.details() if line else {}),
    )


def sharp_line(cell: Cell, off: Array, excess: Array) -> sharp.Line | None:
    """Errors (B, 2) [J] against what rounding does to each."""
    most = sharp.states_for_energy(cell.info, cell.scene.system.n)
    if not most:
        return None
    at = sharp.chosen(excess, most)
    states = cell.states.at(at)
    size = sharp.widest(cell, spread.energy, states.theta, states.omega)
    return sharp.line(off[at], size, sharp.ENERGY, states, len(cell.states))


def energy_amplitudes(tree: PlanarTree, amplitude: Amplitudes, omega: Array) -> Array:
    """½ Σ |rate_i| sqrt(W_ii W_jj) |rate_j|, and Σ m g × length of the way; (B, 2) [J]."""
    rates = np.abs(amplitude.own(omega))
    kinetic = ((rates @ amplitude.products) * rates).sum(axis=-1) / 2
    reach: list[float] = []
    potential = 0.0
    for link in tree.links:
        reach.append(0.0 if link.parent == SUPPORT else reach[link.parent] + math.hypot(*link.hinge))
        potential += link.mass * tree.gravity * (reach[-1] + math.hypot(*link.com))
    return np.stack([kinetic, np.full_like(kinetic, potential)], axis=-1) + amplitude.underflow(omega)
