"""The pool: every message arrives, the clock is the engine's alone, and no worker outlives the process it works for."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from misbehaving import LosesOne, Works

from furiko.engines.workers import pool as module
from furiko.engines.workers.pool import Finished, Lost, Pool, Said
from furiko.engines.workers.processes import PREFIX, remove_left_behind, worker_processes


def events_of(job, limit=60.0):
    with worker_processes() as source:
        pool = Pool(source, 1)
        pool.give(pool.workers[0], job, limit)
        found = []
        while pool.busy:
            found += pool.events()
        pool.close()
    return found


def test_a_message_that_does_not_arrive_is_noticed():
    *_, last = events_of(LosesOne())
    assert isinstance(last, Lost)
    assert "1 of 2 messages did not arrive" in last.reason


def test_an_engine_that_takes_too_long_is_overdue():
    *_, last = events_of(Works(engine=True, seconds=3600), limit=2.0)
    assert isinstance(last, Lost)
    assert last.overdue
    assert last.step.engine


@pytest.mark.slow
def test_work_of_the_jobs_own_is_not_on_the_engines_clock():
    found = events_of(Works(engine=False, seconds=3.0), limit=1.0)
    assert isinstance(found[-1], Finished)
    assert [event.message for event in found if isinstance(event, Said)][-1] == "done"


def test_work_of_the_jobs_own_has_a_limit_too(monkeypatch):
    monkeypatch.setattr(module, "OWN_LIMIT", 2.0)
    *_, last = events_of(Works(engine=False, seconds=3600), limit=1.0)
    assert isinstance(last, Lost)
    assert last.overdue
    assert not last.step.engine


PARENT = """
import sys, time
from misbehaving import Works
from furiko.engines.workers.pool import Pool
from furiko.engines.workers.processes import worker_processes
with worker_processes() as source:
    pool = Pool(source, 1)
    pool.give(pool.workers[0], Works(True, 3600.0), 3600.0)
    list(pool.events())
    print(pool.workers[0].process.process.pid, source.folder, flush=True)
    time.sleep(3600)
"""


def test_a_worker_dies_with_its_parent_and_the_next_run_removes_the_folder():
    tests = str(Path(__file__).parents[2])
    paths = os.pathsep.join([tests, os.environ.get("PYTHONPATH", "")])
    parent = subprocess.Popen(
        [sys.executable, "-c", PARENT], stdout=subprocess.PIPE, text=True, env=os.environ | {"PYTHONPATH": paths}
    )
    worker, folder = parent.stdout.readline().split(maxsplit=1)
    assert Path(f"/proc/{worker}").exists()
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    parent.stdout.close()
    until = time.monotonic() + 10
    while _running(worker) and time.monotonic() < until:
        time.sleep(0.05)
    assert not _running(worker)
    assert Path(folder.strip()).exists()
    remove_left_behind()
    assert not Path(folder.strip()).exists()


def test_folders_of_runs_that_are_alive_stay():
    with tempfile.TemporaryDirectory(prefix=f"{PREFIX}{os.getpid()}-") as folder:
        remove_left_behind()
        assert Path(folder).exists()


def _running(pid):
    """Whether a process is there and not merely waiting for its parent to ask for its status."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def process_of(job):
    """The worker's process, which has done the job."""
    with worker_processes(keeps=True) as source:
        pids = []
        for _ in range(2):
            pool = Pool(source, 1)
            pool.give(pool.workers[0], job, 60.0)
            while pool.busy:
                list(pool.events())
            pids.append(pool.workers[0].process.process.pid)
            pool.close()
    return pids


def test_a_source_that_keeps_its_workers_gives_them_to_the_next_pool():
    first, second = process_of(Works(engine=True, seconds=0.0))
    assert first == second


def test_one_that_died_while_it_waited_is_not_given_out():
    with worker_processes(keeps=True) as source:
        pool = Pool(source, 1)
        (old,) = [worker.process for worker in pool.workers]
        pool.close()
        old.process.kill()
        old.process.wait()
        assert source.worker() is not old
    assert source.taken[0].process.poll() is not None


def test_a_busy_worker_is_not_kept():
    with worker_processes(keeps=True) as source:
        pool = Pool(source, 1)
        (old,) = [worker.process for worker in pool.workers]
        pool.give(pool.workers[0], Works(engine=True, seconds=3600.0), 3600.0)
        pool.close()
        assert old.process.poll() is not None
        assert source.waiting == source.taken == []


@pytest.mark.slow
def test_the_start_of_a_worker_is_not_on_the_engines_clock(tmp_path, monkeypatch):
    (tmp_path / "slow_to_import.py").write_text("import time\ntime.sleep(4)\n")
    monkeypatch.syspath_prepend(tmp_path)
    with worker_processes(modules=["slow_to_import"]) as source:
        pool = Pool(source, 1)
        # The job itself sleeps for no time; two seconds are enough for its few messages.
        pool.give(pool.workers[0], Works(engine=True, seconds=0.0), 2.0)
        found = []
        while pool.busy:
            found += pool.events()
        pool.close()
    assert isinstance(found[-1], Finished), found[-1]
