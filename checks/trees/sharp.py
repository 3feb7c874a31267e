"""The sharp line of open mechanisms: how far a result is from what rounding really does to its entries.

As :mod:`..sharp` for the documents' mechanisms, with spreads of :mod:`furiko.reference.spatial_spread.spreads`. The
factors were set by measurement with five engines over the catalogue's trees and 480 random ones, of which 160 have
links up to 10⁴ times heavier than others and 100 times as long (``python tests/score_trees.py``): the largest quotients
were 42 for terms, 13 for accelerations of a mass matrix that is factorised, 47 for those of articulated bodies.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import EngineInfo
from ...reference.spatial_spread import spreads
from .. import sharp
from .cell import TreeCell

Array = NDArray[np.float64]
Chosen = NDArray[np.intp]

# Spreads beyond which a result is loose, for each quantity.
ACCELERATIONS = 25.0  # of a mass matrix that is factorised
ARTICULATED = 60.0  # of articulated bodies
TERMS = 50.0

FREEDOMS = 200  # states times freedoms that are looked at
FEWEST = 3  # states


@dataclass(frozen=True)
class Usual:
    """An ``error`` (B, …), and what rounding usually does: its ``spread`` in chosen states, for an engine that computes
    in one way; ``factor``: how many times that is usual."""

    error: Array
    factor: float
    spread: Callable[[EngineInfo, Chosen], Array]


def of_accelerations(cell: TreeCell, error: Array) -> Usual:
    """Of accelerations' ``error``, (B, nv)."""
    facts = cell.facts

    def spread(info: EngineInfo, at: Chosen) -> Array:
        state = cell.states.q[at], cell.states.v[at], facts.high[at], facts.mass_matrix[at], facts.passive[at]
        terms = np.array([cell.magnitudes[k].passive for k in at])
        return spreads.accelerations(info, cell.mechanism, *state, terms)

    return Usual(error, ARTICULATED if cell.info.algorithm in ("aba", "unknown") else ACCELERATIONS, spread)


def of_mass_matrix(cell: TreeCell, error: Array) -> Usual:
    """Of M's ``error``, (B, nv, nv)."""
    return Usual(error, TERMS, lambda info, at: spreads.mass_matrix(info, cell.mechanism, cell.states.q[at]))


def of_bias(cell: TreeCell, v: Array, error: Array) -> Usual:
    """Of the ``error`` of the bias with rates ``v``, (B, nv)."""
    return Usual(error, TERMS, lambda info, at: spreads.bias(info, cell.mechanism, cell.states.q[at], v[at]))


def line(cell: TreeCell, quotients: Array, usual: Usual) -> sharp.Line | None:
    """Hold an error against the widest spread, in the states that are worst by ``quotients`` and some others."""
    count = len(cell.states)
    if not count or not sharp.is_known(cell.info):
        return None
    excess = quotients.reshape(count, -1).max(axis=1, initial=0.0)
    at = sharp.chosen(excess, max(FEWEST, FREEDOMS // cell.mechanism.nv))
    spreads = np.max([usual.spread(way, at) for way in cell.info.ways], axis=0)
    return sharp.line(usual.error[at], spreads, usual.factor, cell.states.at(at), count)
