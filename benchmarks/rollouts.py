"""Ensembles of trajectories: furiko.simulate beside MuJoCo's own rollout with RK4, at equal error.

    python benchmarks/rollouts.py [n ...]

Sixty-four starts of a chain of n rods on one thread. MuJoCo's step is shortened until the median error, over the
starts, is the one asked for; furiko's tolerance is the first of its list that reaches it. Errors are the largest
angle's difference from a run of furiko's at higher order and smaller steps. Times are processor time, the least of a
few runs.
Exit status 1 where what is asked for is missed.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

import mujoco
import mujoco.rollout
import numpy as np
from numpy.typing import NDArray

from furiko.models import RodChain, to_mjcf
from furiko.reference.integration.taylor import simulate

Array = NDArray[np.float64]

STARTS = 64
# Links: duration [s], error [rad], and how many times MuJoCo's time over furiko's is asked for.
ASKED = {2: (10.0, 1e-9, 500), 3: (3.0, 1e-7, 100), 5: (1.0, 1e-7, 100), 10: (1.0, 1e-7, 100), 30: (0.2, 1e-7, 100)}
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14)
FINER = 2**0.25  # a step shorter by so much halves the error of a scheme of fourth order
MOST_STEPS = 1 << 19


def rollout(model: Any, theta: Array, omega: Array, duration: float, steps: int) -> Array:
    """Absolute angles at the end, (B, n), by MuJoCo's RK4."""
    model.opt.integrator, model.opt.timestep = mujoco.mjtIntegrator.mjINT_RK4, duration / steps
    relative = [np.diff(values, axis=-1, prepend=0.0) for values in (theta, omega)]
    # Its full state: time, positions, rates.
    start = np.concatenate([np.zeros((len(theta), 1)), *relative], axis=-1)
    state, _ = mujoco.rollout.rollout(model, mujoco.MjData(model), start, nstep=steps)
    return np.asarray(np.cumsum(state[:, -1, 1 : 1 + theta.shape[1]], axis=-1))


def seconds(call: Callable[[], Any], runs: int) -> float:
    """Processor time of one run, the least of several."""
    taken = []
    for _ in range(runs):
        begun = time.thread_time()
        call()
        taken.append(time.thread_time() - begun)
    return min(taken)


def compared(n: int) -> tuple[float, float, float, float, float]:
    """furiko's error and seconds, MuJoCo's step [s], error and seconds, for the whole ensemble."""
    duration, wanted, _ = ASKED[n]
    system = RodChain([1.0 / n] * n)
    random = np.random.default_rng(1)
    theta, omega = random.uniform(-1, 1, (STARTS, n)), 0.3 * random.normal(size=(STARTS, n))
    times = [0.0, duration]
    exact = simulate(system, theta, omega, times, threads=1)._finer()[0][:, -1]

    def error(found: Array) -> float:
        return float(np.median(np.abs(found - exact).max(axis=-1)))

    def ours(tolerance: float) -> Array:
        return simulate(system, theta, omega, times, tolerance, threads=1).theta[:, -1]

    tolerance = next(each for each in TOLERANCES if error(ours(each)) <= wanted)
    model = mujoco.MjModel.from_xml_string(to_mjcf(system))
    steps = 64
    while not error(rollout(model, theta, omega, duration, steps)) <= wanted and steps < MOST_STEPS:
        steps = round(FINER * steps)
    theirs = rollout(model, theta, omega, duration, steps)
    took = seconds(lambda: rollout(model, theta, omega, duration, steps), 1)
    return error(ours(tolerance)), seconds(lambda: ours(tolerance), 7), duration / steps, error(theirs), took


def main(numbers: Sequence[int]) -> int:
    """Print the table; 1 where MuJoCo's time is less than asked for times furiko's."""
    mujoco.set_mju_user_warning(lambda _: None)  # of steps too long at first, which it tells and writes to a file
    print("rods  furiko's error     time   MuJoCo's step    error      time    ratio  asked")
    missed = 0
    for n in numbers or ASKED:
        own, taken, step, error, theirs = compared(n)
        asked = ASKED[n][2]
        missed += theirs < asked * taken
        each = 1000 / STARTS
        print(
            f"{n:4}         {own:8.1e} {each * taken:7.4f} ms     {step:9.2g} s {error:8.1e} {each * theirs:8.1f} ms "
            f"{theirs / taken:8.0f}  {asked:5}",
            flush=True,
        )
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main([int(argument) for argument in sys.argv[1:]]))
