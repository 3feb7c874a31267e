"""Measured in fresh processes: the time of a command from its start, and the packages that it imports."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator

from target import Target

SMOKE_RUNS = 7
HEAVY = ("numba", "scipy")
PROFILES = {"smoke": 1.0, "quick": 20.0, "full": 180.0}  # s

# The command itself, then the work of its workers in the same process: what is imported by then?
_IMPORTED = """
import json, sys
from furiko.cli.main import run
run(["check", "--profile", "smoke", "--no-cache", "--out", sys.argv[1]])
from furiko.checks.plan import make_plan
from furiko.studies.bench.skips import check_task
for task in make_plan(None, None, "smoke").tasks:
    check_task(task.scene.name, task.engine, [])
sys.stderr.write(json.dumps(sorted({name.partition(".")[0] for name in sys.modules})))
"""


def check_seconds(profile: str) -> tuple[float, int]:
    """Seconds and exit status of ``furiko check`` with this profile in a fresh process, without the cache."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "furiko", "check", "--profile", profile, "--no-cache", "--out", folder]
        begun = time.perf_counter()
        done = subprocess.run(command, capture_output=True, check=False, env=_environment())
        return time.perf_counter() - begun, done.returncode


def imported_by_smoke() -> list[str]:
    """Top-level packages that a smoke run and its workers have imported."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", _IMPORTED, folder]
        done = subprocess.run(command, capture_output=True, text=True, check=True, env=_environment())
    names: list[str] = json.loads(done.stderr)
    return names


def smoke_target() -> Target:
    """The time of a smoke run in a fresh process, and that it imports nothing heavy."""
    check_seconds("smoke")  # from here on the files are compiled, and cached by the system
    runs = [check_seconds("smoke") for _ in range(SMOKE_RUNS)]
    seconds = statistics.median(taken for taken, _ in runs)
    heavy = sorted(set(HEAVY) & set(imported_by_smoke()))
    failed = [status for _, status in runs if status]
    says = f"median of {SMOKE_RUNS} fresh processes, fastest {min(taken for taken, _ in runs):.2f} s; "
    says += f"imports {', '.join(heavy)}" if heavy else "imports neither numba nor scipy"
    if failed:
        says += f"; exit status {failed[0]}"
    return Target(
        name="furiko check --profile smoke, cold",
        asked="≤ 0.8 s, importing neither numba nor scipy",
        got=f"{seconds:.2f} s",
        met=seconds <= 0.8 and not heavy and not failed,
        share=0.8 / seconds,
        says=says,
    )


def profile_targets() -> Iterator[Target]:
    """One run of each profile in a fresh process."""
    for profile, allowed in PROFILES.items():
        seconds, status = check_seconds(profile)
        yield Target(
            name=f"furiko check --profile {profile} --no-cache",
            asked=f"< {allowed:g} s",
            got=f"{seconds:.2f} s",
            met=seconds < allowed and status == 0,
            share=allowed / seconds,
            says=f"one fresh process, {os.cpu_count()} cores" + (f"; exit status {status}" if status else ""),
        )


def _environment() -> dict[str, str]:
    """This process's, without the numbers of threads set above; bytecode is written, as by an installed furiko."""
    left_out = "PYTHONDONTWRITEBYTECODE"
    return {key: value for key, value in os.environ.items() if not key.endswith("_NUM_THREADS") and key != left_out}
