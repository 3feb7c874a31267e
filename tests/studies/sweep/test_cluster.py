"""``furiko sweep --dask``: scheduler and workers are processes of their own, which are killed in the middle."""

import signal
import time

import pytest
from fake_engines_sweep import FAULTS
from swept import Cluster, rows_of, started, until, write

from furiko.cli.main import run
from furiko.sweep import sweep

pytest.importorskip("distributed")
pytestmark = pytest.mark.slow
MANY = [round(0.6 + k / 100, 2) for k in range(40)]


@pytest.fixture
def cluster(tmp_path):
    folder = tmp_path / "cluster"
    folder.mkdir()
    found = Cluster(folder)
    yield found
    found.end()


def files(out):
    return len(list(out.glob("results/*/*.parquet")))


def test_engines_that_misbehave_take_no_worker_and_the_table_is_that_of_one_machine(cluster, tmp_path):
    file = write(
        tmp_path / "s.toml", engines=("Faulty", "Sound"), lengths=[0.6, *FAULTS.values(), 0.7], seconds=5.0, memory=1.0
    )
    found = sweep(file, out=tmp_path / "cluster-out", dask=str(cluster.file))
    assert found.complete
    assert [worker.poll() for worker in cluster.workers] == [None, None]
    sweep(file, out=tmp_path / "here", jobs=2)
    assert without_paths(rows_of(tmp_path / "cluster-out")) == without_paths(rows_of(tmp_path / "here"))


def without_paths(rows):
    """A traceback names the lines that lead to the fault: those of a task are others."""
    return [{**row, "traceback": bool(row["traceback"])} for row in rows]


def test_workers_killed_in_the_middle_cost_nothing(cluster, tmp_path):
    file, out = write(tmp_path / "s.toml", engines=("Slow",), lengths=MANY), tmp_path / "out"
    process = started(file, out, "--dask", str(cluster.file))
    until(lambda: files(out) >= 3)
    cluster.workers[0].kill()
    until(lambda: files(out) >= 6)
    cluster.worker()
    cluster.workers[1].kill()
    _, said = process.communicate(timeout=240)
    assert (process.returncode, said) == (0, b"")
    sweep(file, out=tmp_path / "here", jobs=2)
    assert rows_of(out) == rows_of(tmp_path / "here")


def test_a_scheduler_killed_in_the_middle_is_one_line_and_the_same_command_goes_on(cluster, tmp_path):
    file, out = write(tmp_path / "s.toml", engines=("Slow",), lengths=MANY), tmp_path / "out"
    process = started(file, out, "--dask", str(cluster.file))
    until(lambda: files(out) >= 3)
    cluster.scheduler.kill()
    _, said = process.communicate(timeout=120)
    assert (process.returncode, len(said.splitlines())) == (3, 1), said.decode()
    line = said.decode()
    assert "the scheduler is gone; what was done is kept, and the same command goes on" in line
    done = files(out)
    assert 3 <= done < 20
    cluster.end()
    cluster.folder = tmp_path / "another"
    cluster.folder.mkdir()
    other = Cluster(cluster.folder)
    try:
        again = started(file, out, "--dask", str(other.file))
        until(lambda: files(out) > done)
        again.send_signal(signal.SIGKILL)  # and the runner in the middle
        again.wait()
        again.stderr.close()
        assert run(["sweep", "report", str(out)]) == 3
        assert sweep(file, out=out, dask=str(other.file)).complete
    finally:
        other.end()
    sweep(file, out=tmp_path / "here", jobs=2)
    assert rows_of(out) == rows_of(tmp_path / "here")


def test_where_nobody_answers_it_says_so(tmp_path, capsys):
    file = write(tmp_path / "s.toml")
    begun = time.monotonic()
    assert run(["sweep", str(file), "--out", str(tmp_path / "out"), "--dask", "tcp://127.0.0.1:9"]) == 2
    assert "no scheduler answers" in capsys.readouterr().err
    assert time.monotonic() - begun < 60
    assert not (tmp_path / "out").exists()
