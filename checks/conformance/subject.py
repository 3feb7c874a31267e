"""What is tested: an adapter, and the mechanisms that it is made for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from ...engines import EngineInfo, Offer, cannot
from ...models import NLegPendulum, RodChain
from ...models.systems import DocumentSystem
from ...records.listings import ConformanceStep, StepOutcome

Array = NDArray[np.float64]

# Of unlike links, so that no two orders, and no two coordinates, give the same.
CHAIN = RodChain((0.8, 0.5, 0.65), density=1.3, gravity=9.81)
LEGS = NLegPendulum((0.7, 0.45, 0.6, 0.9), (0.4, 0.25, 0.6, 0.35), gravity=9.81)
ONE = RodChain((0.75,), density=0.9, gravity=9.81)
MECHANISMS: dict[str, DocumentSystem] = {"a chain of three rods": CHAIN, "a rod with three legs": LEGS, "one rod": ONE}
STATES = 5
OFFERS = get_args(Offer)  # asked where its ``info`` says that they are offered
GROSS = 1e-6  # of the largest answer: single precision passes, a convention that is mixed up does not


class Wrong(Exception):
    """The adapter is wrong in this step: what was found, and what to change."""

    def __init__(self, says: str, help: str = "") -> None:
        super().__init__(says)
        self.says, self.help = says, help


@dataclass(frozen=True)
class Subject:
    """The adapter's class, its name on the command line, and its ``info``."""

    name: str
    adapter: Any
    info: EngineInfo

    @cached_property
    def mechanisms(self) -> dict[str, DocumentSystem]:
        """Those that it can take, as its ``info`` says."""
        return {name: system for name, system in MECHANISMS.items() if not cannot(self.info, system)}

    @cached_property
    def engines(self) -> dict[str, Any]:
        """An engine for each of them. Exceptions of the adapter pass."""
        return {name: self.adapter(system) for name, system in self.mechanisms.items()}

    def has(self, quantity: str) -> bool:
        """Whether the adapter offers to answer this question."""
        if quantity in OFFERS:
            return quantity in self.info.offers
        return hasattr(self.adapter, quantity) and quantity not in self.info.missing


def states(n: int, count: int = STATES, seed: int = 3) -> tuple[Array, Array]:
    """Angles [rad] and rates [rad/s] with every sign, of the size of one, (count, n) each."""
    generator = np.random.Generator(np.random.PCG64([seed, n, count]))
    theta = generator.uniform(-2.0, 2.0, (count, n))
    omega = generator.uniform(0.5, 2.0, (count, n)) * generator.choice([-1.0, 1.0], (count, n))
    return theta, omega


def apart(got: Array, wanted: Array, least: float = 0.0) -> float:
    """The largest difference over the largest that is wanted, or over ``least``; infinite where shapes differ."""
    if got.shape != wanted.shape:
        return np.inf
    return float(np.abs(got - wanted).max(initial=0.0)) / max(float(np.abs(wanted).max(initial=0.0)), least, 1e-300)


def right(step: str, says: str, outcome: StepOutcome = "right", help: str = "") -> ConformanceStep:
    """A step that found nothing wrong."""
    return ConformanceStep(step=step, outcome=outcome, says=says, help=help)


def array(quantity: str, answer: object, shape: tuple[int, ...]) -> Array:
    """The answer as float64. Raises :class:`Wrong` where it is no array of finite real numbers of this shape."""
    try:
        found = np.asarray(answer)
    except ValueError as error:
        raise Wrong(f"{quantity}: the answer is no array: {error}", _SHAPE) from None
    if found.dtype.kind not in "fiu":
        raise Wrong(f"{quantity}: the answer has the type {found.dtype}, real numbers are needed", "Return float64.")
    if found.shape != shape:
        how = ""
        if len(shape) == 2 and found.shape == shape[::-1] != shape:
            how = "Its axes are exchanged: row b of the answer belongs to row b of the question. "
        elif found.shape == shape[1:]:
            how = "It has one state's answer: loop over the rows, or let the engine take them all. "
        raise Wrong(f"{quantity}: the answer has shape {found.shape}, and {shape} is due", how + _SHAPE)
    values = np.asarray(found, dtype=np.float64)
    if not np.isfinite(values).all():
        raise Wrong(
            f"{quantity}: {int((~np.isfinite(values)).sum())} of {values.size} numbers are NaN or infinite",
            "Look whether the engine's data are filled before they are read, and whether masses reach it.",
        )
    return values


_SHAPE = "States come in batches, shape (B, n), B ≥ 0, and answers have a row for each."
