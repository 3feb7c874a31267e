"""The errors of an implementation of a misprint as it is printed."""

from __future__ import annotations

from typing import Any

import numpy as np
from msgspec import Struct

from ..algebra.symbols import Symbols, symbols_of
from ..mistakes.catalogue import catalogue
from ..steps.derivation import Row, correct_derivation, derive
from ..steps.motion import ParameterValues, RowMotion, divergence_time

STATES = 2000
LENGTHS, MASSES = (1.3, 0.8, 0.6, 0.9), (1.0, 0.5, 0.7, 0.4)  # unequal, so that a wrong length or mass shows
DURATION, STEPS = 20.0, 8000  # 2.5 ms a step: both motions are known to far better than 0.1 rad over the times reported


class Cost(Struct, frozen=True):
    """Relative error of the accelerations over random states, and the time after which a motion is 0.1 rad off [s].

    None: it is not 0.1 rad off within 20 s, from a small or from a large swing.
    """

    reading: str
    system: str
    links: int
    median_error: float
    largest_error: float
    divergence_small: float | None
    divergence_large: float | None


def cost(reading: str, m: Symbols, wrong: list[Row]) -> Cost:
    """The cost of wrong rows: 2000 random states; motions from rest at 0.2 rad, and at 2 rad."""
    parameters = parameters_of(m)
    true, false = RowMotion(m, correct_derivation(m).rows, parameters), RowMotion(m, wrong, parameters)
    draw = np.random.default_rng(20)
    theta, omega = draw.uniform(-np.pi, np.pi, (STATES, m.n)), draw.normal(0, 3, (STATES, m.n))
    expected = true.accelerations(theta, omega)
    error = np.linalg.norm(false.accelerations(theta, omega) - expected, axis=1) / np.linalg.norm(expected, axis=1)
    start = np.linspace(1.0, 1.3, m.n)
    rest = np.zeros(m.n)
    times = [divergence_time(true, false, size * start, rest, DURATION, STEPS) for size in (0.2, 2.0)]
    small, large = (time if time < float("inf") else None for time in times)
    return Cost(reading, m.kind, m.n, float(np.median(error)), float(error.max()), small, large)


def parameters_of(m: Symbols) -> ParameterValues:
    """The lengths and masses that costs are measured with."""
    return ParameterValues(LENGTHS[: m.n], MASSES[: m.n] if m.kind == "n-leg" else ())


def costs_of(key: str) -> list[Cost]:
    """The costs of one misprint: one for each way of reading it."""
    return [
        cost(reading, m, derive(m, [_named(m, name)]).rows)
        for reading, m, name in INTERPRETATIONS.get(key, [])
    ]  # fmt: skip


def _named(m: Symbols, name: str) -> Any:
    return next(mistake for mistake in catalogue(m) if mistake.name == name)


INTERPRETATIONS: dict[str, list[tuple[str, Symbols, str]]] = {
    "shiki 2.1": [("positions as printed", symbols_of("n-leg", 3), "wrong-length-in-position:3:3:2")],
    "shiki 3.4": [("Lagrangian as printed", symbols_of("n-leg", 4), "length-missing-in-speed:1:1")],
    "takeno 12": [
        ("l_m read as l_j", symbols_of("rod-chain", 3), "sum-index-own"),
        ("l_m read as l_n", symbols_of("rod-chain", 3), "sum-index-last"),
    ],
}
