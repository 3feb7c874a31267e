"""``furiko sweep`` on this machine: every cell there, once, right, whatever the engines in others do."""

import json
import os
import signal
import sys
import time
from collections import Counter
from pathlib import Path

import jsonschema
import pytest
from fake_engines_sweep import FAULTS
from swept import children, rows_of, started, until, write

from furiko.cli.main import run
from furiko.records.schema import FOLDER
from furiko.sweep import sweep

parquet = pytest.importorskip("pyarrow.parquet")


def test_a_sweep_from_its_file_to_its_tables(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    file = write(tmp_path / "s.toml", engines=("Sound", "Off"))
    out = tmp_path / "out"
    assert run(["sweep", str(file), "--out", str(out), "--jobs", "2", "--json"]) == 1  # Off differs
    found = json.loads(capsys.readouterr().out)
    jsonschema.validate(found, json.loads((FOLDER / "sweep.json").read_text()))
    manifest, its_schema = (out / "manifest.json").read_text(), (FOLDER / "sweep-manifest.json").read_text()
    jsonschema.validate(json.loads(manifest), json.loads(its_schema))
    assert (found["complete"], found["cells"], found["missing"], found["flaws"]) == (True, 8, [], [])
    # By hand: Off is wrong where the first rod is longer than a metre, in two of four.
    tallies = {t["engine"].rpartition(":")[2]: (t["agrees"], t["differs"], t["errors"]) for t in found["tallies"]}
    assert tallies == {"Sound": (4, 0, 0), "Off": (2, 2, 0)}
    rows = rows_of(out)
    assert [row["cell"] for row in rows] == list(range(8))
    assert [row["p_l1"] for row in rows] == [0.6, 0.6, 0.7, 0.7, 1.1, 1.1, 1.2, 1.2]
    wrong = [row for row in rows if row["outcome"] == "differs"]
    assert {row["engine"].rpartition(":")[2] for row in wrong} == {"Off"}
    # The planted factor is 1 + 1e-6; the error is measured against the proven accelerations.
    assert [row["error"] for row in wrong] == pytest.approx([1e-6] * 2, rel=1e-6)
    assert all(row["error"] < 1e-13 for row in rows if row not in wrong)  # some roundings of two rods
    assert len(list(out.glob("results/*/*.parquet"))) == 4
    for name in ("sweep.json", "sweep.md", "sweep.html"):
        assert (out / name).stat().st_size
    # The same again is there already, and the report says the same.
    before = {path: path.stat().st_mtime_ns for path in out.glob("results/*/*.parquet")}
    assert run(["sweep", str(file), "--out", str(out)]) == 1
    assert run(["sweep", "report", str(out)]) == 1
    text = capsys.readouterr().out
    assert "all 8 cells are there" in text
    assert before == {path: path.stat().st_mtime_ns for path in out.glob("results/*/*.parquet")}


@pytest.mark.slow
def test_crashes_hangs_floods_and_hogs_are_errors_of_their_own_cells_alone(tmp_path):
    lengths = [0.6, *FAULTS.values(), 0.7]
    file = write(tmp_path / "s.toml", engines=("Faulty", "Sound"), lengths=lengths, seconds=5.0, memory=1.0, chunk=5)
    found = sweep(file, out=tmp_path / "out", jobs=2)
    assert found.complete
    rows = rows_of(tmp_path / "out")
    assert Counter(row["cell"] for row in rows) == Counter(range(2 * len(lengths)))  # each once
    outcomes = {(row["engine"].rpartition(":")[2], row["p_l1"]): row for row in rows}
    for name, length in FAULTS.items():
        assert outcomes["Faulty", length]["outcome"] == "error", name
    says = {name: outcomes["Faulty", length]["reason"] for name, length in FAULTS.items()}
    assert "SIGABRT" in says["crash"]
    assert "it hangs" in says["hang"]
    assert "cannot be understood" in says["flood"]
    assert "MemoryError" in says["hog"] or "memory" in says["hog"].lower()
    assert "too large" in says["raise"]
    assert "cannot be understood" in says["rubbish"]
    assert "SIGKILL" in says["kill"]
    others = [row for row in rows if row["outcome"] != "error"]
    assert len(others) == 2 * len(lengths) - len(FAULTS)
    assert {row["outcome"] for row in others} == {"agrees"}


def test_a_damaged_or_missing_file_is_made_again_and_a_cut_off_run_is_not_whole(tmp_path, capsys):
    file = write(tmp_path / "s.toml")
    out = tmp_path / "out"
    assert run(["sweep", str(file), "--out", str(out), "--jobs", "1"]) == 0
    whole = rows_of(out)
    first, second = sorted(out.glob("results/*/*.parquet"))
    second.unlink()
    capsys.readouterr()
    assert run(["sweep", "report", str(out)]) == 3
    told = capsys.readouterr().out
    assert "incomplete: 2 of 4 cells are there" in told
    assert second.name in told
    content = first.read_bytes()
    first.write_bytes(content[: len(content) // 2])  # as after a disk that was full
    assert run(["sweep", str(file), "--out", str(out), "--jobs", "1"]) == 0
    assert rows_of(out) == whole
    second.write_bytes(first.read_bytes())  # another chunk's file under its name
    assert run(["sweep", "report", str(out)]) == 3
    assert run(["sweep", str(file), "--out", str(out), "--jobs", "1"]) == 0
    assert rows_of(out) == whole


def test_a_folder_with_another_sweep_is_left_alone(tmp_path, capsys):
    out = tmp_path / "out"
    assert run(["sweep", str(write(tmp_path / "s.toml", lengths=[0.6])), "--out", str(out), "--jobs", "1"]) == 0
    other = write(tmp_path / "s.toml", lengths=[0.7])
    assert run(["sweep", str(other), "--out", str(out)]) == 2
    assert "holds another sweep" in capsys.readouterr().err
    assert [row["p_l1"] for row in rows_of(out)] == [0.6]
    assert run(["sweep", str(other), "--out", str(out), "--fresh", "--jobs", "1"]) == 0
    assert [row["p_l1"] for row in rows_of(out)] == [0.7]


def test_an_engine_that_is_not_installed_is_said_before_anything_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("furiko.engines.registry.engine_version", lambda name: "")
    (tmp_path / "s.toml").write_text('engines = ["mujoco"]\n[[scenes]]\nscenes = ["rods-2"]\n')
    assert run(["sweep", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) == 3
    assert "pip install 'furiko[mujoco]'" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("package", ["pyarrow", "distributed"])
def test_a_missing_library_is_one_line_with_the_extra(package, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, package, None)
    file = write(tmp_path / "s.toml")
    assert run(["sweep", str(file), "--out", str(tmp_path / "out"), "--dask", "tcp://127.0.0.1:1"]) == 3
    assert capsys.readouterr().err == f"furiko: this needs {package}: pip install 'furiko[sweep]'\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
@pytest.mark.parametrize(("sign", "status"), [(signal.SIGKILL, -9), (signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_a_run_that_is_ended_in_the_middle_goes_on_to_the_same_table(tmp_path, sign, status):
    lengths = [round(0.6 + k / 100, 2) for k in range(40)]
    file = write(tmp_path / "s.toml", engines=("Slow",), lengths=lengths)
    assert sweep(file, out=tmp_path / "whole", jobs=2).complete
    process = started(file, tmp_path / "out", "--jobs", "2")
    until(lambda: len(list(tmp_path.glob("out/results/*/*.parquet"))) >= 3)
    workers = children(process.pid)
    begun = time.monotonic()
    process.send_signal(sign)
    assert process.wait(15) == status
    process.stderr.close()
    assert time.monotonic() - begun < 10
    until(lambda: not any(map(alive, workers)), within=10.0)
    done = len(list(tmp_path.glob("out/results/*/*.parquet")))
    assert 3 <= done < 20
    assert run(["sweep", "report", str(tmp_path / "out")]) == 3
    assert sweep(file, out=tmp_path / "out", jobs=2).complete
    assert rows_of(tmp_path / "out") == rows_of(tmp_path / "whole")


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.slow
def test_workers_that_are_killed_from_outside_cost_at_most_the_cells_that_they_were_at(tmp_path):
    """Nothing is lost and nothing is there twice; what died is an error of its cell, and says so."""
    lengths = [round(0.6 + k / 100, 2) for k in range(30)]
    file = write(tmp_path / "s.toml", engines=("Slow",), lengths=lengths)
    process = started(file, tmp_path / "out", "--jobs", "1")
    for done in (2, 6):
        until(lambda done=done: len(list(tmp_path.glob("out/results/*/*.parquet"))) >= done)
        for worker in children(process.pid):
            os.kill(worker, signal.SIGKILL)
    _, _ = process.communicate(timeout=120)
    rows = rows_of(tmp_path / "out")
    assert [row["cell"] for row in rows] == list(range(30))
    failed = [row for row in rows if row["outcome"] == "error"]
    assert len(failed) <= 4  # two kills, each at most the truth of a scene or the check that it was at
    assert all("SIGKILL" in row["reason"] for row in failed)
