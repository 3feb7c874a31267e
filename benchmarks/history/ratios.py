"""Each function gives furiko's time over numpy's for a yardstick of its own size; less is better."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

import numpy as np

ROUNDS = 21
SAMPLE = 2e-3  # s


def ratio(call: Callable[[], object], yardstick: Callable[[], object], rounds: int = ROUNDS) -> float:
    """Median over rounds of one call's time over the other's, taken in turn."""
    calls = [(function, repeats(function)) for function in (call, yardstick)]
    return statistics.median(np.divide(*(seconds(function, count) for function, count in calls)) for _ in range(rounds))


def repeats(call: Callable[[], object]) -> int:
    """Calls that fill a sample, after one to warm up."""
    call()
    count = 1
    while (taken := seconds(call, count) * count) < SAMPLE:
        count = max(2 * count, int(count * SAMPLE / max(taken, 1e-9)))
    return count


def seconds(call: Callable[[], object], count: int) -> float:
    """Mean seconds of a call."""
    begun = time.perf_counter()
    for _ in range(count):
        call()
    return (time.perf_counter() - begun) / count


def dense(n: int, batch: int = 1) -> Callable[[], object]:
    """numpy's solution of so many dense systems: what an engine's mass matrix costs at the least."""
    generator = np.random.default_rng(n)
    matrix, right = generator.normal(size=(batch, n, n)) + n * np.eye(n), generator.normal(size=(batch, n, 1))
    return lambda: np.linalg.solve(matrix, right)


def states(n: int, batch: int) -> tuple[np.ndarray, np.ndarray]:
    """Random angles and rates, (batch, n) each."""
    generator = np.random.default_rng(n)
    return generator.uniform(-3, 3, (batch, n)), generator.normal(size=(batch, n))


class Accelerations:
    """One thread, a batch, a state."""

    params = (["rods", "legs"], [2, 10, 100])
    param_names = ("mechanism", "n")
    unit = "numpy.linalg.solve of as many systems of n"
    timeout = 120

    def setup(self, mechanism: str, n: int) -> None:
        import furiko

        self.system = (
            furiko.RodChain((0.5,) * n) if mechanism == "rods" else furiko.NLegPendulum((0.5,) * n, (1.0,) * n)
        )

    def track_batch(self, _mechanism: str, n: int) -> float:
        """1024 states a call, one thread."""
        from furiko.reference.kernels.forward_dynamics import accelerations

        theta, omega = states(n, 1024)
        return ratio(lambda: accelerations(self.system, theta, omega, threads=1), dense(n, 1024))

    def track_one(self, _mechanism: str, n: int) -> float:
        """One state a call, the kernel prepared."""
        from furiko.reference.kernels.forward_dynamics import kernel_of

        theta, omega = (row[0] for row in states(n, 1))
        kernel = kernel_of(self.system)
        return ratio(lambda: kernel(theta, omega), dense(n))

    def track_plain(self, _mechanism: str, n: int) -> float:
        """64 states a call in plain numpy, which a quick check uses."""
        from furiko.reference.kernels.forward_dynamics import plain_accelerations

        theta, omega = states(n, 64)
        return ratio(lambda: plain_accelerations(self.system, theta, omega), dense(n, 64))

    def track_literal(self, _mechanism: str, n: int) -> float:
        """16 states a call by the documents' formula as it stands."""
        from furiko.reference import literal_accelerations

        theta, omega = states(n, 16)
        return ratio(lambda: literal_accelerations(self.system, theta, omega), dense(n, 16))

    def track_enclosed(self, _mechanism: str, n: int) -> float:
        """One state, proved in ball arithmetic."""
        from furiko.reference.truth.newton_euler import enclosed_accelerations

        theta, omega = states(n, 1)
        return ratio(lambda: enclosed_accelerations(self.system, theta, omega), dense(n))


class Growth:
    """Rods in all being equal, long chains over short ones: 1 would be a cost that is exactly linear."""

    params = ([100, 1000, 10_000],)
    param_names = ("n",)
    unit = "chains of 10 rods with as many rods in all"
    timeout = 300

    def track_batch(self, n: int) -> float:
        """One thread; 64 states of the longest chain."""
        import furiko

        def call(length: int) -> Callable[[], object]:
            system = furiko.RodChain((2.0 / length,) * length)
            theta, omega = states(length, 640_000 // length)
            return lambda: furiko.accelerations(system, theta, omega, threads=1)

        return ratio(call(n), call(10))


class Motions:
    """Trajectories to the last digits that doubles hold."""

    params = (["bench-rods-2", "bench-rods-5", "bench-rods-100"],)
    param_names = ("motion",)
    unit = "numpy.linalg.solve of 1000 systems of 10"
    timeout = 300

    def track_taylor(self, name: str) -> float:
        """One motion at the default tolerance."""
        from furiko.reference.integration.taylor import simulate
        from furiko.studies.bench.scenes import BENCHMARKS

        scene = BENCHMARKS[name]
        times = [0.0, scene.duration]
        return ratio(lambda: simulate(scene.system, scene.theta, scene.omega, times), dense(10, 1000), rounds=9)


class Processes:
    """What a command takes from cold, over a process that only imports numpy."""

    unit = "python -c 'import numpy'"
    timeout = 300

    def track_help(self) -> float:
        """The command line itself."""
        return processes(["-m", "furiko", "--help"])

    def track_smoke(self) -> float:
        """A whole smoke check with its engines and reports, nothing kept."""
        with tempfile.TemporaryDirectory() as folder:
            return processes(["-m", "furiko", "check", "--profile", "smoke", "--no-cache", "--out", folder])


def processes(arguments: list[str], rounds: int = 7) -> float:
    """Median over rounds of a fresh process's time over that of one that imports numpy."""

    def taken(command: list[str]) -> float:
        begun = time.perf_counter()
        subprocess.run([sys.executable, *command], check=True, capture_output=True)
        return time.perf_counter() - begun

    yardstick = ["-c", "import numpy"]
    for command in (arguments, yardstick):
        taken(command)
    return statistics.median(taken(arguments) / taken(yardstick) for _ in range(rounds))
