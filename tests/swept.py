"""Sweeps of fake engines for tests: their files, their tables, a cluster of processes to run them on."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

TESTS = Path(__file__).parent
FAKES = str(TESTS / "fake_engines_sweep.py")
VOLATILE = ("seconds", "in_engine")  # what a clock says


def write(path, *, engines=("Sound",), lengths=(0.6, 0.7, 1.1, 1.2), chunk=2, seconds=20.0, memory=4.0, seeds=1):
    names = [f"{FAKES}:{name}" for name in engines]
    path.write_text(
        f"engines = {json.dumps(names)}\nseeds = {seeds}\nstates = 2\nnamed = []\nchunk = {chunk}\n"
        f"[limits]\nseconds = {seconds}\nmemory = {memory}\n"
        f'[[scenes]]\nscenes = ["rods-2"]\n[scenes.parameters]\nl1 = {list(lengths)}\n'
    )
    return path


def rows_of(folder):
    """All rows, in the order of the cells, without what a clock says."""
    from pyarrow import parquet

    found = []
    for path in sorted(Path(folder).glob("results/*/*.parquet")):
        found += parquet.read_table(path, partitioning=None).to_pylist()
    for row in found:
        for name in VOLATILE:
            del row[name]
    return sorted(found, key=lambda row: (row["cell"], row["check"]))


def started(file, out, *words):
    return subprocess.Popen(
        [sys.executable, "-m", "furiko", "sweep", str(file), "--out", str(out), *words],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        # Ctrl-C is ignored in the background of a shell, and so by all that is started from it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509 (no threads)
    )  # fmt: skip


def until(condition, within=60.0):
    end = time.monotonic() + within
    while not condition():
        assert time.monotonic() < end, "it did not come so far"
        time.sleep(0.02)


def children(pid):
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(path.parent.name))
    return found


class Cluster:
    """A scheduler and workers without nannies, so that what is killed stays so."""

    def __init__(self, folder):
        self.folder, self.file = folder, folder / "scheduler.json"
        self.processes = []
        self.scheduler = self._start(
            "dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(self.file)
        )
        until(self.file.is_file)
        self.workers = [self.worker() for _ in range(2)]

    def worker(self):
        local = self.folder / f"worker-{len(self.processes)}"
        words = ["--no-nanny", "--nthreads", "1", "--no-dashboard", "--local-directory", str(local)]
        return self._start("dask_worker", "--scheduler-file", str(self.file), *words)

    def _start(self, program, *words):
        command = [sys.executable, "-m", f"distributed.cli.{program}", *words]
        paths = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", str(TESTS.parent))])
        log = (self.folder / f"{len(self.processes)}.log").open("w")
        process = subprocess.Popen(
            command, stdout=log, stderr=log, cwd=self.folder, env=os.environ | {"PYTHONPATH": paths}
        )
        log.close()
        self.processes.append(process)
        return process

    def end(self):
        for process in reversed(self.processes):
            process.kill()
            process.wait()
