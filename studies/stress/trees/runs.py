"""How long runs of engines' integrators on open mechanisms are to be trusted: against motions that are known for ever.

A run is over when it is another motion: its phase is lost by a tenth of a radian or of what moves, half of its energy
has been gained or lost, a quaternion's length has lost half its digits, or a number is none. Times are half a decade
apart; up to a thousand seconds a case takes seconds, beyond it is asked for when all else is known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....engines import cannot, engine_info, load_tree_engine
from ....records.check import Result
from ....records.stress import HALF_THE_DIGITS
from ....reference.truth.spatial import energy
from ..accelerations import finite
from ..failures import Failure
from .motions import Known, known_motions

Array = NDArray[np.float64]

TIMES = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0)  # s
LONG = 1000.0  # s; longer runs are asked for last
STEPS = (0.04, 0.01, 0.002)  # s
TOP = len(TIMES) - 1
MOST_PHASE = 0.1  # rad, or of what moves
MOST_ENERGY = 0.5  # of the motion's own
SECONDS_A_STEP = 2e-4  # that an engine may well take


@dataclass(frozen=True)
class TreeRunCase:
    """One run of one engine's integrator over one time, from the motion's start."""

    engine: str
    integrator: str
    motion: str
    step: float
    rung: int

    @property
    def time(self) -> float:
        """How long it is [s]."""
        return TIMES[self.rung]

    @property
    def heavy(self) -> bool:
        """Whether it takes many seconds."""
        return self.time > LONG

    @property
    def takes(self) -> float:
        """Seconds that it may well take."""
        return SECONDS_A_STEP * self.time / self.step

    @property
    def scene(self) -> str:
        """The motion and the step."""
        return f"{self.motion}, step {self.step:g} s"

    @property
    def check(self) -> str:
        """The integrator and the time."""
        return f"{self.integrator}, {self.time:g} s"

    def run(self) -> Result:
        """Run it, and say what failed."""
        known, info = known_motions()[self.motion], engine_info(self.engine)
        where = {"integrator": self.integrator, "motion": self.motion, "step": self.step, "time": self.time}
        if why_not := cannot(info, known.system):
            return self._result("skipped", reason=why_not, details={**where, "failure": "refused"})
        steps = round(self.time / self.step)
        with np.errstate(all="ignore"):
            q, v = load_tree_engine(self.engine, known.system).trajectory(
                np.array(known.q), np.array(known.v), self.integrator, self.step, steps
            )
        found = kept(known, steps * self.step, q, v)
        failure = found.failure
        return self._result(
            "differs" if failure else "agrees",
            measured=finite(found.phase),
            allowed=MOST_PHASE,
            unit="rad, or of what moves",
            reason=f"{failure} after {self.time:g} s" if failure else "",
            details={
                **where,
                "failure": failure,
                "phase error": finite(found.phase),
                "energy drift": finite(found.energy),
                "length drift": finite(found.length),
            },
        )

    def _result(self, outcome: str, **fields: object) -> Result:
        return Result(scene=self.scene, engine=self.engine, check=self.check, outcome=outcome, **fields)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Kept:
    """What a run's end kept: error of the ``phase`` [rad, or of what moves], of the ``energy`` (over the motion's own),
    and of a quaternion's ``length``."""

    phase: float
    energy: float
    length: float

    @property
    def failure(self) -> Failure | None:
        """The first that makes it another motion."""
        if not all(map(math.isfinite, (self.phase, self.energy, self.length))):
            return "NaN"
        if self.energy > MOST_ENERGY:
            return "energy runs away"
        if self.length > HALF_THE_DIGITS:
            return "quaternions lose their length"
        return "phase lost" if self.phase > MOST_PHASE else None


def kept(known: Known, time: float, q: Array, v: Array) -> Kept:
    """Of the state at a time [s] of a known motion."""
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        return Kept(math.inf, math.inf, math.inf)
    return Kept(known.error(time, q, v), energy_drift(known, time, q, v), known.length_off(q))


def energy_drift(known: Known, time: float, q: Array, v: Array) -> float:
    """|E - E₀| over how large the motion's energies are at this time [s]."""
    mechanism = known.system.mechanism()
    kinetic, potential = energy(mechanism, q, v).float
    first = energy(mechanism, np.array(known.q), np.array(known.v)).float
    return float(abs(kinetic + potential - first.sum()) / known.energy_at(time))
