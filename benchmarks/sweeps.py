"""``furiko sweep`` under load: cells a second, the main process's own time for each, its memory, and planted faults.

    python benchmarks/sweeps.py rate [--scenes 1000] [--jobs 1 2]     # cells a second; ms and MiB of the main process
    python benchmarks/sweeps.py rate --cores 0 --jobs 1               # on one core: the main process shares it
    python benchmarks/sweeps.py rate --jobs 2 --dask FILE             # on a cluster of two workers of one thread each
    python benchmarks/sweeps.py faults [--scenes 5000] [--faults 200] [--dask FILE]

``rate``: random rod chains of 3 links in 20 states, accelerations, on MuJoCo and Pinocchio. ``faults``: two fake
engines on so many scenes, of which one crashes, hangs, floods, takes all memory, raises, writes rubbish or is killed in
some; every other cell must be there, once, and agree. The exit status is 1 where something is not as it should be.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any

from furiko.sweep import Doing, sweep

TESTS = Path(__file__).resolve().parent.parent / "tests"
OVERHEAD = 0.5e-3  # [s] asked: of the main process, for a cell
ENGINES = ["mujoco", "pinocchio-aba"]


def rate(scenes: int, jobs: int, dask: str | None = None) -> bool:
    """One measurement, printed; whether the main process did what is asked."""
    with tempfile.TemporaryDirectory(prefix="furiko-sweeps-") as folder:
        file = Path(folder) / "rate.toml"
        file.write_text(
            f"engines = {json.dumps(ENGINES)}\nseeds = {scenes}\nstates = 20\nchunk = 100\n"
            '[[random]]\nkind = "rod-chain"\nlinks = 3\n'
        )
        marks: list[tuple[float, float, int]] = []

        def watch(now: Doing) -> None:
            marks.append((time.perf_counter(), time.process_time(), now.here))

        before = peak()
        found = sweep(file, out=Path(folder) / "out", jobs=jobs, dask=dask, watch=watch)
    begun, spent, first = marks[jobs]  # each worker has done a chunk: all is imported
    ended, used, last = marks[-1]
    cells = last - first
    own = (used - spent) / cells
    print(
        f"{jobs} workers, {cells:,} cells: {cells / (ended - begun):.0f} cells/s; the main process: "
        f"{1e3 * own:.2f} ms a cell, {peak() - before:.0f} MiB more at its peak ({peak():.0f} in all)",
        flush=True,
    )
    return found.complete and own <= OVERHEAD


def peak() -> float:
    """The largest memory of this process so far [MiB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def faults(scenes: int, planted: int, jobs: int | None, dask: str | None) -> bool:
    """Plant so many faults of all kinds, evenly; whether every other cell is there, once, and agrees."""
    sys.path.insert(0, str(TESTS))
    from fake_engines_sweep import fault_of, faulty_lengths  # type: ignore[import-not-found]

    lengths = faulty_lengths(scenes, planted)
    engines = [f"{TESTS / 'fake_engines_sweep.py'}:{name}" for name in ("Faulty", "Sound")]
    with tempfile.TemporaryDirectory(prefix="furiko-sweeps-") as folder:
        file, out = Path(folder) / "faults.toml", Path(folder) / "out"
        file.write_text(
            f"engines = {json.dumps(engines)}\nstates = 2\nnamed = []\nchunk = 100\n"
            "[limits]\nseconds = 2.0\nmemory = 1.0\n"
            f'[[scenes]]\nscenes = ["rods-2"]\n[scenes.parameters]\nl1 = {lengths}\n'
        )
        begun = time.perf_counter()
        complete = sweep(file, out=out, jobs=jobs, dask=dask).complete
        seconds = time.perf_counter() - begun
        rows = [row for path in out.glob("results/*/*.parquet") for row in _rows(path)]
    each = Counter(row["cell"] for row in rows)
    once = each == Counter(range(2 * scenes))
    due = {row["cell"]: fault_of(row["p_l1"]) if row["engine"].endswith("Faulty") else None for row in rows}
    wrong = [row for row in rows if row["outcome"] != ("error" if due[row["cell"]] else "agrees")]
    failed = Counter(str(due[row["cell"]]) for row in rows if row["outcome"] == "error")
    print(f"{len(each):,} cells in {seconds:.0f} s, {sum(failed.values())} failed: {dict(failed)}")
    print(f"every cell there, once: {once}; planted ones fail and all others agree: {not wrong}")
    for row in wrong[:5]:
        print(f"  {row['scene']} on {row['engine']}: {row['outcome']}: {row['reason']}")
    return once and not wrong and complete and sum(failed.values()) == planted


def _rows(path: Path) -> list[dict[str, Any]]:
    from pyarrow import parquet

    columns = ["cell", "scene", "engine", "outcome", "reason", "p_l1"]
    found: list[dict[str, Any]] = parquet.read_table(path, columns=columns, partitioning=None).to_pylist()
    return found


def main() -> int:
    """Measure what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["rate", "faults"])
    parser.add_argument("--scenes", type=int)
    parser.add_argument("--jobs", type=int, nargs="+")
    parser.add_argument("--cores", type=int, nargs="+", help="run on these alone")
    parser.add_argument("--faults", type=int, default=200)
    parser.add_argument("--dask")
    given = parser.parse_args()
    if given.cores:
        os.sched_setaffinity(0, given.cores)
    if given.what == "rate":
        done = [rate(given.scenes or 1000, jobs, given.dask) for jobs in given.jobs or [1, 2]]
        return 0 if all(done) else 1
    return 0 if faults(given.scenes or 5000, given.faults, given.jobs[0] if given.jobs else None, given.dask) else 1


if __name__ == "__main__":
    sys.exit(main())
