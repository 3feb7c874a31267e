"""What a first call costs, and the next: processor seconds in fresh processes, by each way to machine code.

``ahead``: from the instructions that are written ahead. ``numba``: compiled by numba, nothing kept. ``kept``: loaded
from numba's own cache, as in the second process of an installation without instructions written ahead.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile

RUNS = 3
WAYS = ("ahead", "numba", "kept")
CALLS = {
    "accelerations of 5 rods in 4000 states": "furiko.accelerations(rods, theta, omega)",
    "the same, unequal rods": "furiko.accelerations(unequal, theta, omega)",
    "the same, an N-leg pendulum": "furiko.accelerations(legs, theta, omega)",
    "the tenth single state of 5 rods": "[furiko.accelerations(rods, theta[i], omega[i]) for i in range(10)]",
    "simulate 5 rods for 1 s": "furiko.simulate(rods, theta[0], omega[0], [0.0, 1.0])",
    "simulate an N-leg pendulum for 1 s": "furiko.simulate(legs, theta[0], omega[0], [0.0, 1.0])",
    "simulate 16 starts of 5 rods": "furiko.simulate(rods, theta[:16], omega[:16], [0.0, 1.0])",
    "Lyapunov exponents of 5 rods": "furiko.lyapunov(rods, theta[0], omega[0], [0.0, 1.0], count=1)",
    "flip times of 16 starts of 5 rods": "furiko.flip_times(rods, theta[:16], omega[:16], 1.0)",
}
_MEASURED = """
import json, sys, time
import numpy as np, furiko
from furiko.reference.kernels.ahead import load
if sys.argv[1] != "ahead":
    load.is_ahead = lambda name: False
rods, unequal = furiko.RodChain([1.0] * 5), furiko.RodChain([1.0, 9.0, 1.0, 1.0, 1.0])
legs = furiko.NLegPendulum([1.0] * 5, [1.0] * 5)
theta, omega = np.random.default_rng(1).uniform(-3, 3, (2, 4000, 5))
seconds = []
for _ in range(2):
    begun = time.process_time()
    eval(sys.argv[2])
    seconds.append(time.process_time() - begun)
print(json.dumps(seconds))
"""


def measured(way: str, call: str) -> tuple[float, float]:
    """Processor seconds of the first call and of the second: medians over fresh processes."""
    with tempfile.TemporaryDirectory() as folder:
        if way == "kept":
            _once(way, call, folder)
        pairs = [_once(way, call, folder if way == "kept" else f"{folder}/{k}") for k in range(RUNS)]
    first, second = (statistics.median(column) for column in zip(*pairs, strict=True))
    return first, second


def _once(way: str, call: str, cache: str) -> list[float]:
    command = [sys.executable, "-c", _MEASURED, way, call]
    environment = os.environ | {"NUMBA_CACHE_DIR": cache, "OPENBLAS_NUM_THREADS": "1"}
    found: list[float] = json.loads(subprocess.run(command, capture_output=True, check=True, env=environment).stdout)
    return found


def main(ways: list[str]) -> None:
    """A table: one row a call, two figures a way."""
    ways = ways or [*WAYS]
    sys.stdout.write(
        f"| first call, then the next [s of a processor] | {' | '.join(ways)} |\n|---|{'---|' * len(ways)}\n"
    )
    for says, call in CALLS.items():
        cells = ["{:.2f}, {:.1e}".format(*measured(way, call)) for way in ways]
        sys.stdout.write(f"| {says} | {' | '.join(cells)} |\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
