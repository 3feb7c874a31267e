"""Trajectories under stress: the largest step that an integrator survives, and what energy does in the long run.

A chain of equal rods, 1 m in all unless that is what is put under stress, swings from a bow for the time in which a
pendulum of its length would swing to and fro once. A run has failed when a state is not finite or silently the first
one again, when half of the energy above rest has been gained or lost, or when joints have come apart by a hundredth of
the length; what shows first names the failure. The step halves from rung to rung, half an octave at a time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...engines import cannot, engine_info, load_engine
from ...models import RodChain
from ...records.check import Result
from ...reference.documents.equations_of_motion import energies
from .failures import Failure, of_energy, of_path

Array = NDArray[np.float64]
Stress = Literal["links", "speed", "length"]

# What is put under stress, the unit, and where it is looked at.
STRESSES: dict[Stress, tuple[str, tuple[float, ...]]] = {
    "links": ("rods", (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)),
    "speed": ("rad/s", (0.0, 10.0, 30.0, 100.0, 300.0)),
    "length": ("m", (1e-3, 1e-2, 1e-1, 1.0, 10.0)),
}
MANY_RODS = 32  # from so many on a run takes seconds
RODS = 4  # where it is not their number that is put under stress
FINEST = 12  # octaves of the step below the whole time
PER_OCTAVE = 2
TOP = FINEST * PER_OCTAVE
MOST_ENERGY = 0.5  # of what the state has above rest: gained or lost, it is another motion
MOST_GAP = 0.01  # of the length
SAMPLES = 256  # states at which the energy is looked at

REFUSED = {"failure": "refused"}

LONG_STEP = 1e-3  # [s]
CHUNKS, SAMPLES_A_CHUNK = 100, 10


@dataclass(frozen=True)
class Problem:
    """A chain, its state, how long it swings [s], and its energy above rest [J]."""

    system: RodChain
    theta: Array
    omega: Array
    duration: float
    scale: float


def problem(stress: Stress, value: float, seed: int) -> Problem:
    """The problem that is run; the seed shakes the bow a little."""
    n = int(value) if stress == "links" else RODS
    length = value if stress == "length" else 1.0
    system = RodChain((length / n,) * n)
    random = np.random.Generator(np.random.PCG64([seed, n]))
    theta = 1.2 - 0.6 * (np.arange(n) + 0.5) / n + 0.01 * random.uniform(-1, 1, n)
    speed = value if stress == "speed" else 0.0
    omega = np.full(n, speed)
    swing = 2 * math.pi * math.sqrt(length / system.gravity)
    duration = min(swing, 2 * math.pi / speed) if speed else swing
    _, lowest = energies(system, np.zeros(n), np.zeros(n))
    scale = float(sum(energies(system, theta, omega)) - lowest)
    return Problem(system, theta, omega, duration, scale)


def step(rung: int, duration: float) -> float:
    """The rung's step [s]: rung 0 is the shortest."""
    return duration / steps(rung)


def steps(rung: int) -> int:
    """How many steps the rung's are."""
    return round(math.exp2((TOP - rung) / PER_OCTAVE))


@dataclass(frozen=True)
class StabilityCase:
    """One run of one engine's integrator with one step."""

    engine: str
    integrator: str
    stress: Stress
    value: float
    rung: int
    seed: int

    @property
    def heavy(self) -> bool:
        """Whether it takes seconds rather than milliseconds."""
        return self.stress == "links" and self.value >= MANY_RODS

    @property
    def takes(self) -> float:
        """Seconds that it may well take: an implicit step solves for all rods at once."""
        return 300.0 if self.heavy else 0.0

    @property
    def scene(self) -> str:
        """The quantity that is put under stress, and its value."""
        return f"step, {self.stress} {self.value:g}"

    @property
    def check(self) -> str:
        """The integrator and the rung."""
        return f"{self.integrator}, rung {self.rung}"

    def run(self) -> Result:
        """Run it, and say what failed first."""
        given = problem(self.stress, self.value, self.seed)
        h, count = step(self.rung, given.duration), steps(self.rung)
        details = {
            "integrator": self.integrator,
            "stress": self.stress,
            "value": self.value,
            "rung": self.rung,
            "step": h,
            "steps": count,
            "duration": given.duration,
        }
        if why_not := cannot(engine_info(self.engine), given.system):
            return self._result("skipped", reason=why_not, details={**details, **REFUSED})
        engine = load_engine(self.engine, given.system)
        with np.errstate(all="ignore"):
            path = engine.path(given.theta, given.omega, self.integrator, h, count)
            if path is None:
                return self._result("skipped", reason="the adapter gives no paths", details={**details, **REFUSED})
            failure, when, drift = first_failure(given, *path, gap=engine.gap())
        reason = f"{failure} at {when * h:.3g} s of {given.duration:.3g} s" if failure else ""
        return self._result(
            "differs" if failure else "agrees",
            measured=drift,
            allowed=MOST_ENERGY,
            unit="of the energy above rest",
            reason=reason,
            details={**details, "failure": failure, "after": when * h if failure else None},
        )

    def _result(self, outcome: str, **fields: object) -> Result:
        return Result(scene=self.scene, engine=self.engine, check=self.check, outcome=outcome, **fields)  # type: ignore[arg-type]


def first_failure(
    given: Problem, theta: Array, omega: Array, gap: float | None = None
) -> tuple[Failure | None, int, float | None]:
    """The first failure in a run's states (K + 1, n), at which of them, and the largest |E - E₀| over its scale."""
    last = len(theta) - 1
    chosen = np.unique(np.linspace(0, last, min(SAMPLES, last + 1)).round().astype(int))
    kinetic, potential = energies(given.system, theta[chosen], omega[chosen])
    total = kinetic + potential
    drift = float(np.abs(total - total[0]).max() / given.scale)
    found: list[tuple[int, Failure]] = []
    lost = of_path(theta, omega)
    if lost is not None:
        found.append((lost[1], lost[0]))
    runaway = of_energy(total, given.scale, MOST_ENERGY)
    if runaway is not None:
        found.append((int(chosen[runaway]), "energy runs away"))
    if gap is not None and not gap <= MOST_GAP * sum(given.system.lengths):
        found.append((last, "joints come apart"))
    drift_told = drift if np.isfinite(drift) else None
    if not found:
        return None, last, drift_told
    # What is not finite has no energy: a state cannot fail by both at once.
    when, failure = min(found, key=lambda one: (one[0], one[1] != "NaN" and one[1] != "silent reset"))
    return failure, when, drift_told


@dataclass(frozen=True)
class LongRunCase:
    """A hundredth of a long run of a double rod pendulum, from where the hundredth before it ended."""

    engine: str
    integrator: str
    chunk: int
    steps: int
    start: tuple[tuple[float, ...], tuple[float, ...]] | None = None

    @property
    def scene(self) -> str:
        """How long the whole run is."""
        return f"long run, {self.steps} steps"

    @property
    def check(self) -> str:
        """The integrator and the part."""
        return f"{self.integrator}, part {self.chunk + 1} of {CHUNKS}"

    def run(self) -> Result:
        """Run on, and note the energy ten times."""
        system = RodChain((0.5, 0.5))
        first = np.array([1.0, 0.5]), np.zeros(2)
        theta, omega = first if self.start is None else (np.array(row) for row in self.start)
        engine = load_engine(self.engine, system)
        part = max(1, self.steps // (CHUNKS * SAMPLES_A_CHUNK))
        reference = float(sum(energies(system, *first)))
        _, lowest = energies(system, np.zeros(2), np.zeros(2))
        scale = reference - float(lowest)
        drifts = []
        for _ in range(SAMPLES_A_CHUNK):
            with np.errstate(all="ignore"):
                theta, omega = engine.trajectory(theta, omega, self.integrator, LONG_STEP, part)
                drifts.append((float(sum(energies(system, theta, omega))) - reference) / scale)
            if not np.isfinite(drifts[-1]):
                break
        finite = bool(np.isfinite(drifts).all())
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees" if finite else "differs",
            measured=abs(drifts[-1]) if finite else None,
            unit="of the energy above rest",
            reason="" if finite else "NaN",
            details={
                "integrator": self.integrator,
                "chunk": self.chunk,
                "steps": part * SAMPLES_A_CHUNK,
                "drift": [value for value in drifts if np.isfinite(value)],
                "theta": theta.tolist() if finite else None,
                "omega": omega.tolist() if finite else None,
                "failure": None if finite else "NaN",
            },
        )


@dataclass(frozen=True)
class Drift:
    """How energy drifts in the long run.

    ``exponent``: H of ⟨(E(t + τ) - E(t))²⟩ ~ τ^(2H), 0 for what is bounded, ½ for a random walk (Brouwer 1937), 1 for a
    line; ``rate``: of the line, or of the exponential, per step; ``spread``: largest less smallest, over the scale.
    """

    kind: Literal["bounded", "random walk", "linear", "exponential"]
    exponent: float
    rate: float
    spread: float


def classify(drift: Sequence[float] | Array, steps_apart: float) -> Drift:
    """Which of the four a series of equally spaced energies is, with the fit.

    An exponential is told from a line by leaving a quarter of the squares or less while growing tenfold; the others by
    the exponent H over lags from a hundredth to a tenth of the run, at ¼ and ¾: half-way between theirs. For a
    walk of a thousand energies it scatters by 0.08.
    """
    values = np.asarray(drift, dtype=np.float64)
    if len(values) < 50:
        raise ValueError(f"{len(values)} energies are too few to tell how they drift; 50 are needed")
    x = np.arange(len(values)) / (len(values) - 1)
    spread = float(np.ptp(values))
    if spread == 0:
        return Drift("bounded", 0.0, 0.0, 0.0)
    length = steps_apart * (len(values) - 1)
    line, slope = _squares_of_line(x, values)
    squares, growth = min((_squares_of_exponential(x, values, g), g) for g in np.geomspace(2.3, 60, 60))
    if squares < line / 4:
        return Drift("exponential", _exponent(values), growth / length, spread)
    exponent = _exponent(values)
    kind: Literal["bounded", "random walk", "linear"] = (
        "bounded" if exponent < 0.25 else "random walk" if exponent < 0.75 else "linear"
    )
    return Drift(kind, exponent, slope / length, spread)


def _exponent(values: Array) -> float:
    lags = np.unique(np.geomspace(max(1, len(values) // 100), len(values) // 10, 12).astype(int))
    squares = np.array([np.mean((values[lag:] - values[:-lag]) ** 2) for lag in lags])
    if (squares <= 0).any():
        return 0.0
    return float(np.polyfit(np.log(lags), np.log(squares), 1)[0] / 2)


def _squares_of_line(x: Array, values: Array) -> tuple[float, float]:
    slope, offset = np.polyfit(x, values, 1)
    return float(((values - slope * x - offset) ** 2).sum()), float(slope)


def _squares_of_exponential(x: Array, values: Array, growth: float) -> float:
    """The residual of a fit of a + b e^(growth·x)."""
    basis = np.stack([np.ones_like(x), np.exp(growth * (x - 1))], axis=1)
    fit, *_ = np.linalg.lstsq(basis, values, rcond=None)
    return float(((values - basis @ fit) ** 2).sum())
