"""The stress test as a whole: every way to fail is named and ends nothing, and what was killed is gone on with."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from furiko.cli.main import run
from furiko.engines import engine_info
from furiko.models import InvalidInput
from furiko.reports import read_stream
from furiko.reports.journal import Journal
from furiko.stress import STREAM, stress
from furiko.studies.stress.accelerations import AccelerationCase
from furiko.studies.stress.axes import find_axes
from furiko.studies.stress.searches import Listed, key, make_searches
from furiko.studies.stress.searches import run as run_cases

TESTS = Path(__file__).parents[2]

# On long-rods each rung is half a decade: 1000 m is rung 6, and these engines break beyond it.
HOLDS, FAILS = 6, 7


def one(engine, **options):
    found = stress(["long-rods"], [f"fake_engines_stress:{engine}"], budget=60, jobs=2, **options)
    (frontier,) = found.frontiers
    return found, frontier


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "failure"),
    [
        ("LosesDigits", "more than rounding"),
        ("LooksRight", "wrong numbers that look right"),
        ("GivesNaN", "NaN"),
        ("Raises", "exception"),
        ("Crashes", "crash"),
    ],
)
def test_the_frontier_is_where_the_engine_breaks_and_says_how(engine, failure):
    found, frontier = one(engine)
    assert (frontier.holds, frontier.fails, frontier.failure) == (HOLDS, FAILS, failure)
    assert frontier.closed
    assert found.open == 0
    assert {f.failure for f in found.failures} == {failure}


@pytest.mark.slow
def test_a_hang_is_ended_and_named():
    _, frontier = one("Hangs", timeout=2.0)
    assert (frontier.holds, frontier.fails, frontier.failure) == (HOLDS, FAILS, "hang")


def test_what_an_engine_does_not_take_is_refused_not_failed():
    found = stress(["light-leg"], ["fake_engines_stress:Refuses"], budget=60, jobs=1)
    (frontier,) = found.frontiers
    # 1e-2 kg is rung 4, which it takes.
    assert (frontier.fails, frontier.failure) == (5, "refused")
    assert "too light for me" in frontier.reason


def test_a_sound_engine_holds_to_the_end():
    found = stress(["long-rods"], ["fake_engines:Right", "document"], budget=60, jobs=1)
    frontiers = {f.engine: f for f in found.frontiers if f.axis == "long-rods"}
    assert {f.status for f in frontiers.values()} == {"holds"}


def test_kernels_keep_their_promise_where_engines_do_not():
    found = stress(["long-rods", "aligned-legs"], ["kernels"], budget=60, jobs=1)
    assert found.kernels.cases == 10
    assert found.kernels.broken == found.kernels.exceptions == []
    assert found.kernels.worst < 1e-13


def test_a_kernel_that_is_off_would_be_told(monkeypatch):
    from furiko.studies.stress import accelerations as stress_accelerations

    monkeypatch.setattr(stress_accelerations, "plain_accelerations", lambda s, t, w: 1.0 + 0 * t)
    result = AccelerationCase("long-rods", "kernels", 0, 1).run()
    assert result.outcome == "differs"
    assert result.measured > 1e-3


@pytest.mark.slow
def test_another_seed_finds_the_same_frontiers_to_one_rung():
    # Of an engine whose errors grow with what is put under stress, not of a fake with a hard edge.
    found = [
        {
            (f.engine, f.axis): f.fails
            for f in stress(["long-rods", "long-legs", "short-rods"], ["mujoco"], budget=60, seed=seed).frontiers
        }
        for seed in (1, 2)
    ]
    assert all(value is not None for value in found[0].values())
    for name, rung in found[0].items():
        assert abs(rung - found[1][name]) <= 1


@pytest.mark.slow
def test_the_budget_is_kept_and_what_is_open_is_said():
    begun = time.monotonic()
    found = stress(None, ["exudyn-tree"], budget=3, jobs=2)
    assert time.monotonic() - begun < 60  # all its questions take many minutes; a busy machine is not a fault
    assert found.open > 0
    assert found.cases > 0


def test_results_do_not_depend_on_workers_or_order():
    found = [stress(["long-legs", "short-legs"], ["mujoco", "document"], budget=60, jobs=jobs) for jobs in (1, 2)]
    assert found[0].frontiers == found[1].frontiers


def test_a_resumed_run_asks_for_nothing_twice(tmp_path):
    first = stress(["long-rods"], ["mujoco", "document"], budget=60, out=tmp_path)
    begun = (tmp_path / STREAM).read_bytes()
    again = stress(["long-rods"], ["mujoco", "document"], budget=60, out=tmp_path)
    assert again == first
    assert read_stream(tmp_path / STREAM).results == read_stream_bytes(tmp_path, begun).results
    more = stress(["long-rods", "short-rods"], ["mujoco", "document"], budget=60, out=tmp_path)
    names = [key(result) for result in read_stream(tmp_path / STREAM).results]
    assert len(names) == len(set(names)) == more.cases > first.cases


def read_stream_bytes(folder, content):
    (folder / "before.jsonl").write_bytes(content)
    return read_stream(folder / "before.jsonl")


def test_a_run_with_another_seed_does_not_go_on_with_this_one(tmp_path):
    stress(["long-rods"], ["document"], budget=60, out=tmp_path)
    with pytest.raises(InvalidInput, match="has seed 2018, this one 7"):
        stress(["long-rods"], ["document"], budget=60, seed=7, out=tmp_path)
    stress(["long-rods"], ["document"], budget=60, seed=7, out=tmp_path, fresh=True)


def test_nothing_to_ask_is_bad_input():
    with pytest.raises(InvalidInput, match="nothing to run"):
        stress(["steps"], ["document"])
    with pytest.raises(InvalidInput, match="no engine is called"):
        stress(["long-rods"], ["mujocco"])


def test_every_search_can_be_asked_before_anything_is_known():
    infos = [engine_info("mujoco"), engine_info("exudyn-redundant")]
    searches = make_searches(find_axes(("all",)), infos, ["document", "kernels"], seed=1)
    cases = [search.next({})[0] for search in searches]
    names = [key(case) for case in cases]
    assert len(set(names)) == len(names) > 500
    assert {search.family for search in searches} == {
        "accelerations", "trees", "pairs", "steps", "condition", "chain", "long runs", "tree runs",
    }  # fmt: skip


def test_a_case_that_gives_no_result_is_an_error():
    searches = [Listed("condition", (AccelerationCase("long-rods", "fake_engines_stress:Raises", FAILS, 0),))]
    (result,) = run_cases(searches, {}, budget=30, jobs=1)
    assert result.outcome == "error"
    assert "too long for me" in result.reason
    assert "ArithmeticError" in result.details["traceback"]


ARGUMENTS = ("--axis", "long-rods", "--axis", "short-legs", "--axis", "far-rods", "-e", "mujoco", "-e", "document")


def kill_and_resume(folder, times, moments):
    """Kill so many runs in one folder with SIGKILL, each at a random moment, then let one end; its summary."""
    for _ in range(times):
        run = start(folder)
        time.sleep(moments.uniform(0.2, 2.0))
        run.send_signal(signal.SIGKILL)
        run.communicate()
        torn = (folder / STREAM).read_bytes() if (folder / STREAM).exists() else b""
        if moments.random() < 0.5 and torn:  # as a machine that went down in the middle of a line leaves it
            (folder / STREAM).write_bytes(torn[: -moments.randint(1, 40)] if len(torn) > 2000 else torn)
    run = start(folder)
    out, _ = run.communicate(timeout=120)
    assert run.returncode == 0
    return json.loads(out)


def start(folder):
    return subprocess.Popen(
        [sys.executable, "-m", "furiko", "stress", *ARGUMENTS, "--budget", "100", "--out", str(folder), "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=os.environ | {"PYTHONPATH": str(TESTS)},
    )


@pytest.mark.slow
@pytest.mark.parametrize("times", [3, pytest.param(20, marks=pytest.mark.slow)])
def test_killed_again_and_again_the_table_is_the_same(times, tmp_path):
    whole = kill_and_resume(tmp_path / "whole", 0, random.Random(0))
    found = kill_and_resume(tmp_path / "killed", times, random.Random(times))
    assert found["frontiers"] == whole["frontiers"]
    assert found["open"] == whole["open"] == 0
    results = read_stream(tmp_path / "killed" / STREAM).results
    names = [key(result) for result in results]
    assert len(names) == len(set(names))  # nothing twice
    assert set(names) == {key(r) for r in read_stream(tmp_path / "whole" / STREAM).results}  # nothing lost


@pytest.mark.slow
def test_quiet_in_a_pipe_and_one_document_of_json(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "furiko", "stress", "--axis", "long-legs", "-e", "document", "--out", "out", "--json"],
        capture_output=True,
        cwd=tmp_path,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0
    assert done.stderr == b""
    assert json.loads(done.stdout)["frontiers"][0]["axis"] == "long-legs"
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["chain.html", "stress.html", STREAM]


@pytest.mark.slow
def test_a_person_is_told_the_frontiers(tmp_path):
    arguments = ["--axis", "long-rods", "--axis", "condition", "-e", "document", "-e", "mujoco", "--out", "out"]
    done = subprocess.run(
        [sys.executable, "-m", "furiko", "stress", *arguments],
        capture_output=True,
        cwd=tmp_path,
        timeout=60,
        check=False,
        text=True,
    )
    assert done.returncode == 0
    assert done.stderr == ""
    (row,) = (line for line in done.stdout.splitlines() if line.startswith("long-rods"))
    assert row.split() == ["long-rods", "holds", "to", "1e+06", "m", "1e+04", "m"]
    # Featherstone's law: a chain stretched out in relative coordinates.
    (law,) = (line for line in done.stdout.splitlines() if line.startswith("straight chain") and "relative" in line)
    assert float(law.split("n^")[1]) == pytest.approx(4, abs=0.1)
    assert "page: out/stress.html" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--axis", "long-rod"], "did you mean 'long-rods'"),
        (["-e", "mujocco"], "did you mean 'mujoco'"),
        (["--budget", "0"], "--budget"),
    ],
)
def test_bad_usage_is_one_clear_line(arguments, told, tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "furiko", "stress", *arguments],
        capture_output=True, cwd=tmp_path, timeout=60, check=False, text=True,
    )  # fmt: skip
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert told in line
    assert list(tmp_path.iterdir()) == []


ONE_AXIS = ["stress", "--axis", "long-rods", "-e", "document", "--budget", "5", "--jobs", "1"]


def test_where_the_pages_cannot_be_written_the_table_is_shown_all_the_same(tmp_path, capfd):
    (tmp_path / "stress.html").mkdir()
    assert run([*ONE_AXIS, "--out", str(tmp_path)]) == 3
    shown, failure = capfd.readouterr()
    assert "long-rods" in shown
    assert "page: " not in shown
    assert "stress.html: cannot be written: Is a directory" in failure
    assert read_stream(tmp_path / STREAM).complete


def test_where_the_journal_takes_no_more_the_table_is_shown_all_the_same(tmp_path, capfd, monkeypatch):
    """As on a disk that fills up: the header is there, and results, but no footer."""
    written = Journal.write

    def full(self, result):
        if len(read_stream(self.path).results) == 2:
            raise InvalidInput(f"{self.path}: cannot be written: No space left on device")
        return written(self, result)

    monkeypatch.setattr(Journal, "write", full)
    assert run([*ONE_AXIS, "--out", str(tmp_path), "--json"]) == 3
    shown, failure = capfd.readouterr()
    assert json.loads(shown)["cases"] > 2
    assert "No space left" in failure
    report = read_stream(tmp_path / STREAM)
    assert (len(report.results), report.footer) == (2, None)
