"""Engines that compute batches on a GPU: time a state, time to compile, and error, beside furiko on a CPU.

    python benchmarks/gpu.py [--engines mjx,mjx-float32,mujoco-warp] [--scenes double-pendulum,rods-5,rods-20]
                             [--batches 64,4096] [--seconds 600] [--json FILE]

Each engine runs where it runs by itself: on a CUDA device where JAX or Warp finds one, else on the CPU. A batch is so
many random states of a scene (of the catalogue, the documents' or a tree). Two ways to the same accelerations are
timed, each from its call until the numbers are there: *bare*, the engine's own call with the states on the device and
its answer left there; *whole*, furiko's adapter, from arrays in double precision to arrays in double precision. The
first call of each, with all that is compiled for it, is told apart; of what follows the median counts. *furiko* is its
compiled kernel on one thread of the CPU.

Errors are those of the first states of the batch, the worst: *backward*, the residual in the true equations as a
multiple of rounding in the engine's own precision, of which *allowed* is explained by rounding; *forward*, the distance
from the proven accelerations, relative to the largest of the state. ``--seconds``: after so many no new row is begun.
Exit status 1 where an error is beyond what is allowed.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from furiko.checks.cell import Cell
from furiko.checks.comparisons.accelerations import backward_error
from furiko.checks.facts import scene_facts
from furiko.engines import engine_info, load_engine
from furiko.models import Scene, find_scene
from furiko.models.states import States, states
from furiko.reference.kernels.forward_dynamics import accelerations
from furiko.reference.rounding.bounds import EPSILON, allowed

CHECKED = 128  # states whose error is looked at
RUNS, A_WHILE = 15, 2.0  # as many runs, or as many as end in so many seconds


@dataclass(frozen=True)
class Row:
    """One way of one engine; seconds, of one state [ns]; errors in units of the engine's own rounding."""

    where: str
    engine: str
    way: str
    scene: str
    angles: int
    batch: int
    first_seconds: float
    nanoseconds: float
    backward: float
    allowed: float
    forward: float


def main() -> int:
    """Print the table; 1 where an error is beyond what rounding explains."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engines", default="mjx,mjx-float32,mujoco-warp")
    parser.add_argument("--scenes", default="double-pendulum,rods-5,rods-20")
    parser.add_argument("--batches", default="64,4096")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    end, rows = time.perf_counter() + given.seconds, []
    print(f"{'where':24} {'engine':12} {'way':26} {'scene':20} {'batch':>6} {'first s':>8} {'ns a state':>11}", end="")
    print(f" {'backward':>9} {'allowed':>8} {'forward':>8}")
    for scene in map(find_scene, given.scenes.split(",")):
        for batch in map(int, given.batches.split(",")):
            looked_at = states(replace(scene, random=batch, named=(), theta=None, omega=None), batch)
            for name in ["furiko", *given.engines.split(",")]:
                if time.perf_counter() > end:
                    print(f"no time left for {name}, {scene.name}, {batch}")
                    continue
                for row in measured(name, scene, looked_at):
                    rows.append(row)
                    print(shown(row), flush=True)
                    if given.json:
                        given.json.write_text(json.dumps([asdict(each) for each in rows], indent=1), encoding="utf-8")
    return int(any(row.backward > row.allowed for row in rows))


def measured(name: str, scene: Scene, looked_at: States) -> Iterator[Row]:
    """An engine's rows for one batch."""
    if name == "furiko":
        system = scene.system

        def answer() -> np.ndarray:
            return accelerations(system, looked_at.theta, looked_at.omega, threads=1)

        yield row_of("CPU, 1 thread", name, "accelerations", scene, looked_at, answer, answer)
        return
    loaded = load_engine(name, scene.system)

    def answer() -> np.ndarray:
        return loaded.accelerations(looked_at.theta, looked_at.omega)

    where = device_of(name)
    for way, bare in loaded.bare_calls(looked_at.theta, looked_at.omega).items():
        yield row_of(where, name, f"bare: {way}", scene, looked_at, bare.call, answer)
    yield row_of(where, name, "whole", scene, looked_at, answer, answer)


def row_of(
    where: str,
    name: str,
    way: str,
    scene: Scene,
    looked_at: States,
    call: Callable[[], object],
    answer: Callable[[], np.ndarray],
) -> Row:
    """Time ``call``; the errors are those of ``answer``."""
    first, once = timed(call)
    info = engine_info("mujoco" if name == "furiko" else name)  # furiko's are in absolute angles, whose bound is less
    few = looked_at.at(np.arange(min(CHECKED, len(looked_at))))
    cell = Cell(scene, info, load_engine("mujoco", scene.system), few, scene_facts(scene, few, slopes=False))
    got = answer()[: len(few)]
    error, _ = backward_error(cell, got, cell.amplitude)
    own = EPSILON / info.accuracy
    size = np.abs(cell.facts.high).max(axis=-1)
    return Row(
        where,
        name,
        way,
        scene.name,
        scene.system.n,
        len(looked_at),
        first,
        1e9 * once / len(looked_at),
        float(error.max()) * own,
        allowed(scene.system.n, info.accuracy) * own,
        float((np.abs(cell.facts.error(got)).max(axis=-1) / size).max()),
    )


def timed(call: Callable[[], object]) -> tuple[float, float]:
    """Seconds of the first call, and the median of those that follow."""
    begun = time.perf_counter()
    call()
    first, found = time.perf_counter() - begun, []
    begun = time.perf_counter()
    while len(found) < RUNS and (len(found) < 3 or time.perf_counter() - begun < A_WHILE):
        start = time.perf_counter()
        call()
        found.append(time.perf_counter() - start)
    return first, statistics.median(found)


def device_of(name: str) -> str:
    """The device that an engine computes on, by its own word."""
    if name == "mujoco-warp":
        import warp

        return str(warp.get_device().name)[:24]
    import jax

    return str(jax.devices()[0].device_kind)[:24]


def shown(row: Row) -> str:
    """As a line of the table."""
    return (
        f"{row.where:24} {row.engine:12} {row.way:26} {row.scene:20} {row.batch:6} {row.first_seconds:8.2f} "
        f"{row.nanoseconds:11.1f} {row.backward:9.2g} {row.allowed:8.3g} {row.forward:8.1e}"
    )


if __name__ == "__main__":
    sys.exit(main())
