"""The chain's cases: small swings against Bernoulli's, large motions for ever more rods, the usable step, memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...records.check import Result
from ...reference.chain import Links, bow, chain, largest_step, move, swing_errors

ENGINE = "taylor"  # under whose name the motions' results stand: furiko's own
KERNEL = "kernels"
EQUATIONS = "document"

SWINGS = (10, 20, 50, 100, 200, 500, 1000, 2000)
SHORT = ((10, 4.0), (20, 4.0), (40, 4.0), (80, 4.0), (160, 4.0), (320, 2.0), (640, 2.0))  # rods and seconds
LONG = (1000, 10.0)
FRAMES = 320  # a second that are kept of the tip
LOOKS = 16  # at the tip between two of them: a crack of the whip lasts a millisecond
PIECE = 0.25  # [s] that are lost at most when a run is cut off
FINE, COARSE = 1e-13, 1e-8  # tolerances; what differs between them is numerics
AMPLITUDES = (1.0, 0.1)  # of the bow
STEP_RODS = (5, 10, 20, 40, 80, 160, 320)
MEMORY_RODS = (1000, 2000, 4000, 8000, 16000)
ENERGY = 1e-9  # relative drift that is allowed over the whole motion


@dataclass(frozen=True)
class SwingsCase:
    """The slowest ten small swings of n links."""

    n: int
    links: Links
    engine: str = EQUATIONS

    @property
    def scene(self) -> str:
        """Which links."""
        return f"chain, swings of {self.links}"

    @property
    def check(self) -> str:
        """How many."""
        return f"{self.n} links"

    def run(self) -> Result:
        """Relative errors against ω_k = (j₀,k/2) √(g/L)."""
        errors = swing_errors(self.n, self.links)
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees",
            measured=float(abs(errors[0])),
            unit="of the first swing's rate",
            details={"n": self.n, "links": self.links, "errors": errors.tolist()},
        )


@dataclass(frozen=True)
class StepCase:
    """The longest step of the classical Runge-Kutta scheme for n rods."""

    n: int
    engine: str = KERNEL
    scene = "chain, usable step"
    takes = 120.0  # seconds that it may well take: compiling comes first
    compiles = True  # machine code, once for each process

    @property
    def check(self) -> str:
        """How many rods."""
        return f"{self.n} rods"

    def run(self) -> Result:
        """Bisect."""
        step = largest_step(self.n)
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees" if step else "differs",
            measured=step,
            unit="s",
            details={"n": self.n, "step": step},
        )


@dataclass(frozen=True)
class MemoryCase:
    """How much more memory a process holds at most while it moves a chain of n rods."""

    n: int
    engine: str = ENGINE
    scene = "chain, memory"
    takes = 120.0  # seconds that it may well take: compiling comes first
    compiles = True  # machine code, once for each process

    @property
    def check(self) -> str:
        """How many rods."""
        return f"{self.n} rods"

    def run(self) -> Result:
        """Move a small chain first, so that code and libraries are there already; then this one for a moment."""
        move(chain(10), bow(10), np.zeros(10), [0.0, 1e-6])
        before = _peak(reset=True)
        move(chain(self.n), bow(self.n), np.zeros(self.n), [0.0, 1e-6])
        after = _peak(reset=False)
        known = before is not None and after is not None
        more = float(after - before) if before is not None and after is not None else None
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees" if known else "skipped",
            measured=more,
            unit="bytes",
            reason="" if known else "this system does not tell a process's peak memory anew",
            details={"n": self.n, "bytes": more},
        )


@dataclass(frozen=True)
class ChainCase:
    """A piece of the motion of n rods from the bow, from where the piece before it ended."""

    n: int
    amplitude: float
    tolerance: float
    duration: float
    piece: int
    start: tuple[Sequence[float], Sequence[float]] | None = None
    engine: str = ENGINE
    takes = 300.0  # seconds that it may well take: a thousand rods, on a processor that is shared
    compiles = True  # machine code, once for each process

    @property
    def scene(self) -> str:
        """Which motion."""
        return f"chain, {self.n} rods, amplitude {self.amplitude:g}, tolerance {self.tolerance:g}"

    @property
    def check(self) -> str:
        """Which piece of it."""
        return f"{self.piece * PIECE:g} s to {(self.piece + 1) * PIECE:g} s"

    def run(self) -> Result:
        """Move on."""
        theta, omega = (bow(self.n, self.amplitude), np.zeros(self.n)) if self.start is None else self.start
        frames = round(PIECE * FRAMES)
        times = self.piece * PIECE + np.arange(frames * LOOKS + 1) / (FRAMES * LOOKS)
        found = move(chain(self.n), theta, omega, times, self.tolerance)
        shown = [frames // 2 * LOOKS, frames * LOOKS]
        peak = int(found.speed.argmax())
        details: dict[str, Any] = {
            "n": self.n,
            "amplitude": self.amplitude,
            "tolerance": self.tolerance,
            "piece": self.piece,
            "tip": found.tip[::LOOKS].tolist(),
            "speed": found.speed[::LOOKS].round(6).tolist(),
            "peak": [float(found.speed[peak]), float(found.times[peak])],
            "fastest": float(found.fastest.max()),
            "energy": [float(found.energy[0]), float(found.energy.min()), float(found.energy.max())],
            "curves": {f"{found.times[k]:g}": found.curves[k].round(5).tolist() for k in shown},
            "steps": found.steps,
            "computing": found.seconds,
            "theta": found.theta.tolist(),
            "omega": found.omega.tolist(),
        }
        spread = float(np.ptp(found.energy) / found.energy[0])
        return Result(
            scene=self.scene,
            engine=self.engine,
            check=self.check,
            outcome="agrees" if spread <= max(ENERGY, 10 * self.tolerance) else "differs",
            measured=spread,
            allowed=max(ENERGY, 10 * self.tolerance),
            unit="of the energy above rest",
            details=details,
        )


@dataclass(frozen=True)
class ChainRun:
    """A whole motion, piece by piece."""

    n: int
    amplitude: float
    tolerance: float
    duration: float

    family = "chain"

    def case(self, piece: int, start: tuple[Sequence[float], Sequence[float]] | None = None) -> ChainCase:
        """One of its pieces."""
        return ChainCase(self.n, self.amplitude, self.tolerance, self.duration, piece, start)

    def pieces(self, results: Any) -> list[Result]:
        """Those that have been run, in order."""
        found: list[Result] = []
        while len(found) < round(self.duration / PIECE):
            case = self.case(len(found))
            result = results.get((case.scene, case.engine, case.check))
            if result is None or "theta" not in result.details:
                break
            found.append(result)
        return found

    def next(self, results: Any) -> tuple[ChainCase | None, int]:
        """The piece after those."""
        found = self.pieces(results)
        case = self.case(len(found))
        if len(found) == round(self.duration / PIECE) or (case.scene, case.engine, case.check) in results:
            return None, len(found)
        if not found:
            return case, 0
        return self.case(len(found), (found[-1].details["theta"], found[-1].details["omega"])), len(found)

    def caught(self, results: Any) -> bool:
        """It has no frontier."""
        return False


def chain_runs() -> list[ChainRun]:
    """The motions: ever more rods, in two amplitudes; a coarse run beside each; last the long one."""
    runs = [ChainRun(n, amplitude, FINE, seconds) for n, seconds in SHORT for amplitude in AMPLITUDES]
    runs += [ChainRun(n, AMPLITUDES[0], COARSE, seconds) for n, seconds in SHORT]
    runs.sort(key=lambda run: run.n)
    return [*runs, ChainRun(LONG[0], 1.0, FINE, LONG[1])]


def listed_cases() -> list[SwingsCase | StepCase | MemoryCase]:
    """The cases that need no result of another."""
    kinds: tuple[Links, Links] = ("rods", "point masses")
    return [
        *(SwingsCase(n, links) for n in SWINGS for links in kinds),
        *(StepCase(n) for n in STEP_RODS),
        *(MemoryCase(n) for n in MEMORY_RODS),
    ]


def _peak(*, reset: bool) -> int | None:
    """Most memory that this process has held [bytes], since it was last asked to forget; Linux only."""
    status = Path("/proc/self/status")
    try:
        if reset:
            Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
        lines = status.read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM")), None)
