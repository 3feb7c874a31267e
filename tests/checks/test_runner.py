"""Runs on worker processes: one engine's failure is its own, and nothing is lost or counted twice."""

import os
import subprocess
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest

import furiko
from furiko.checks import runner
from furiko.checks.cache import Cache, Kept
from furiko.checks.jobs import Announced, Asking, CellJob, Facts, accelerations_differ
from furiko.checks.ledger import Ledger
from furiko.checks.plan import PROFILES, make_plan
from furiko.checks.runner import run
from furiko.engines.workers.messages import Failed, Step
from furiko.engines.workers.pool import Finished, Lost, Said
from furiko.engines.workers.processes import worker_processes
from furiko.models import EngineMissing, LibraryMissing
from furiko.records.check import Diagnosis, Result

CHECKS = PROFILES["quick"].checks


def check(*engines, scenes=("rods-2",), **options):
    return furiko.check(scenes, [f"fake_engines:{engine}" for engine in engines], **options)


def by_check(report, engine):
    return {result.check: result for result in report.results if result.engine == f"fake_engines:{engine}"}


@pytest.mark.slow
def test_a_crash_costs_its_own_check_alone():
    report = check("Crashing", "Right")
    crashed = by_check(report, "Crashing")
    assert crashed["energy"].outcome == "error"
    assert "SIGABRT" in crashed["energy"].reason
    for name, result in crashed.items():
        if name != "energy":
            assert result.outcome == "agrees", result
    assert {result.outcome for result in by_check(report, "Right").values()} == {"agrees"}
    assert set(crashed) == set(by_check(report, "Right"))
    assert report.exit_status == 3


@pytest.mark.slow
def test_a_hang_is_ended_and_costs_its_own_check_alone():
    report = check("Hanging", "Right", timeout=3.0)
    hung = by_check(report, "Hanging")
    assert hung["energy"].outcome == "error"
    assert "hangs" in hung["energy"].reason
    assert hung["accelerations"].outcome == "agrees"
    assert {result.outcome for result in by_check(report, "Right").values()} == {"agrees"}


@pytest.mark.slow
def test_an_engine_that_hangs_again_is_given_up():
    scenes = ["rods-1", "rods-2", "rods-3", "double-pendulum"]
    report = check("Hanging", scenes=scenes, timeout=2.0, jobs=1)
    found = Counter((result.scene, result.check) for result in report.results)
    assert set(found.values()) == {1}
    reasons = Counter(result.reason for result in report.results if result.outcome == "error")
    assert sum(count for reason, count in reasons.items() if "it hangs" in reason) == 2
    assert any("not tried" in reason for reason in reasons)
    assert {result.scene for result in report.results} == set(scenes)


@pytest.mark.slow
def test_an_engine_that_cannot_start_fails_its_cells_alone():
    report = check("CannotStart", "Right")
    assert {result.outcome for result in by_check(report, "CannotStart").values()} == {"error"}
    assert set(by_check(report, "CannotStart")) == set(CHECKS)
    assert all("too large for me" in result.reason for result in by_check(report, "CannotStart").values())
    assert {result.outcome for result in by_check(report, "Right").values()} == {"agrees"}


@pytest.mark.slow
def test_engines_print_nothing_and_leave_nothing(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    check("Littering", out="out")
    assert capfd.readouterr() == ("", "")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.slow
def test_no_worker_outlives_its_run():
    before = set(os.listdir("/proc"))
    check("Right", jobs=2)
    workers = [
        pid
        for pid in set(os.listdir("/proc")) - before
        if pid.isdigit() and b"furiko.engines.workers.worker" in _command_line(pid) and _parent(pid) == os.getpid()
    ]
    assert workers == []


def test_workers_begin_at_once_and_end_with_their_source():
    """Nobody asks for a result here: as where the header or the stream cannot be written."""
    with worker_processes() as source:
        run(make_plan(["rods-2"], ["mujoco"], "smoke"), cache=Cache(None), source=source, jobs=2)
        processes = [worker.process for worker in source.taken]
        assert processes
        assert all(process.poll() is None for process in processes)
    assert all(process.poll() is not None for process in processes)


def test_a_plan_is_made_without_numpy():
    """Workers import it at the same time; a plan that waited for it too would make every run a tenth slower."""
    code = "import furiko.run, sys; from furiko.checks.plan import make_plan; make_plan(None, None, 'smoke')"
    loaded = subprocess.run([sys.executable, "-c", f"{code}; print(*sys.modules)"], capture_output=True, check=True)
    assert not {"numpy", "mujoco", "rich", "jinja2"} & set(loaded.stdout.decode().split())


@pytest.mark.slow
def test_results_do_not_depend_on_the_number_of_workers():
    def verdicts(jobs):
        found = check("Right", "SignFlipped", scenes=["rods-2", "rods-3"], jobs=jobs).results
        return {(r.scene, r.engine, r.check): (r.outcome, r.measured) for r in found if "trajectory" not in r.check}

    assert verdicts(1) == verdicts(2)


def test_a_missing_engine_is_skipped_unless_it_was_asked_for(monkeypatch):
    from furiko.checks import plan

    monkeypatch.setattr("furiko.engines.registry.engine_version", lambda name: "" if name == "mujoco" else "9")
    skipped = plan.make_plan(["rods-1"], None, "smoke").settled
    assert [(r.engine, r.outcome) for r in skipped] == [("mujoco", "skipped")]
    assert "pip install 'furiko[mujoco]'" in skipped[0].reason
    asked = plan.make_plan(["rods-1"], ["mujoco"], "smoke").settled
    assert [r.outcome for r in asked] == ["error"]


def _parent(pid):
    """So that workers of tests which run beside this one are not taken for its own."""
    try:
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return None


def _command_line(pid):
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2])
def test_every_planned_check_has_its_results(jobs):
    report = check("Right", scenes=["rods-1", "double-pendulum-no-gravity"], jobs=jobs)
    assert report.complete
    checks = {(result.scene, result.comparison) for result in report.results}
    assert len(checks) == 2 * len(CHECKS)


def test_a_truth_is_looked_for_and_kept_in_as_many_states_as_the_run_has(monkeypatch):
    asked, kept = [], []

    class Spy(Cache):
        def facts(self, scene, random_states, *_asked):
            asked.append((scene.name, random_states))

        def keep_facts(self, scene, random_states, content, *_asked):
            kept.append((scene.name, random_states, content))

    monkeypatch.setattr(runner, "Pool", lambda *_: SimpleNamespace(idle=list, busy=[]))
    plan = make_plan(["rods-1"], ["mujoco"], "quick")
    run = runner._Run(list(plan.tasks), Spy(None), None, 1, 60.0, Ledger(plan))
    run.begin()
    (job,), worker = run.truths, object()
    run.progress[worker] = runner._Progress()
    assert list(run._on(Said(worker, job, Facts(b"truth")))) == []
    assert (asked, kept) == ([("rods-1", 200)], [("rods-1", 200, b"truth")])
    assert run.ready.take((), {}).facts == b"truth"


def test_a_truth_that_cannot_be_computed_fails_every_cell_of_its_scene(monkeypatch):
    monkeypatch.setattr(runner, "Pool", lambda *_: SimpleNamespace(idle=list, busy=[]))
    plan = make_plan(["rods-1"], ["mujoco", "exudyn-tree"], "smoke")
    run = runner._Run(list(plan.tasks), Cache(None), None, 1, 60.0, Ledger(plan))
    run.begin()
    (job,), worker = run.truths, object()
    run.progress[worker] = runner._Progress()
    found = list(run._on(Said(worker, job, Failed("no digits left", ""))))
    assert [(result.engine, result.outcome) for result in found] == [("mujoco", "error"), ("exudyn-tree", "error")]
    assert all("the truth could not be computed: no digits left" in result.reason for result in found)


def test_a_check_that_a_worker_never_told_of_is_an_error_and_its_cell_is_not_kept(monkeypatch):
    kept = []
    monkeypatch.setattr(runner, "Pool", lambda *_: SimpleNamespace(idle=list, busy=[]))
    monkeypatch.setattr(Cache, "keep_results", lambda self, task, results, found: kept.append(results))
    (task,) = (plan := make_plan(["rods-1"], ["mujoco"], "quick")).tasks
    run = runner._Run([task], Cache(None), None, 1, 60.0, Ledger(plan))
    run.begin()
    job, worker = CellJob(task, b""), object()
    for told, missing in ((task.checks[1:], [(task.checks[0], "error")]), (task.checks, [])):
        run.progress[worker] = runner._Progress(compared=set(told))
        found = list(run._on(Finished(worker, job)))
        assert [(result.check, result.outcome) for result in found] == missing
    assert kept == [[]]  # the second, of which nothing is missing


def test_what_is_kept_comes_with_its_diagnosis_and_is_promised(monkeypatch):
    plan = make_plan(["rods-1"], ["mujoco"], "smoke")
    (task,) = plan.tasks
    (check,) = task.checks
    results = [
        Result(scene="rods-1", engine="mujoco", check=name, comparison=check, outcome="differs") for name in ("a", "b")
    ]
    diagnosis = Diagnosis(scene="rods-1", engine="mujoco", explains=["a"])
    monkeypatch.setattr(Cache, "results", lambda *_: Kept(results, [diagnosis]))
    ledger = Ledger(plan)
    found = list(run(plan, cache=Cache(None), source=None, ledger=ledger))
    assert found == [*plan.settled, *results, diagnosis]
    assert "1 of its 2 results" in ledger.missing([*plan.settled, results[0]])[0].reason


@pytest.mark.parametrize(
    ("check", "outcome", "stops"),
    [("accelerations", "differs", True), ("accelerations", "error", False), ("terms", "differs", False)],
)
def test_only_accelerations_that_differ_make_a_motion_pointless(check, outcome, stops):
    """An engine's motion rests on its accelerations, and on none of its other answers."""
    result = Result(scene="s", engine="e", check=check, comparison=check, outcome=outcome)
    assert accelerations_differ(check, result) == stops


@pytest.mark.parametrize(("missing", "outcome"), [(EngineMissing, "error"), (LibraryMissing, "skipped")])
def test_an_engine_that_is_gone_has_failed_and_a_library_of_furikos_own_is_a_reason_to_skip(missing, outcome):
    def compare(_cell):
        raise missing("it is not there")

    check = SimpleNamespace(name="terms", moves=False, compare=compare)
    cell = SimpleNamespace(result=lambda name, found, **more: (name, found, more["reason"]))
    (task,) = make_plan(["rods-1"], ["mujoco"], "smoke").tasks
    (found,) = CellJob(task, b"")._results(check, cell, False, None, Asking([].append, "terms"))
    assert found[:2] == ("terms", outcome)
    assert "it is not there" in found[2]


def test_what_is_settled_comes_first_of_all(monkeypatch):
    """Pinocchio has no integrator: what needs one is settled before anything runs."""
    plan = make_plan(["rods-1"], ["pinocchio-aba"], "quick")
    assert plan.settled
    monkeypatch.setattr(Cache, "results", lambda *_: Kept([], []))
    assert list(run(plan, cache=Cache(None), source=None)) == list(plan.settled)


def begun(monkeypatch, engines, scenes, hangs=runner.HANGS):
    """A run of which no worker has a job, and its tasks."""
    monkeypatch.setattr(runner, "Pool", lambda *_: SimpleNamespace(idle=list, busy=[]))
    plan = make_plan(scenes, engines, "quick")
    run = runner._Run(list(plan.tasks), Cache(None), None, 1, 60.0, Ledger(plan), hangs)
    run.begin()
    return run, plan.tasks


def lost(run, task, check, *, engine, compared=(), diagnosis=None):
    """What comes of a worker that is overdue in this check, in the engine's own work or in furiko's."""
    worker = object()
    run.progress[worker] = runner._Progress(compared=set(compared), diagnosis=diagnosis)
    event = Lost(worker, CellJob(task, b""), Step(check, engine), "no answer within 60 s", overdue=True)
    return list(run._on(event))


def test_furikos_own_work_that_takes_too_long_is_not_said_of_the_engine(monkeypatch):
    run, (task,) = begun(monkeypatch, ["mujoco"], ["rods-1"])
    (own,) = lost(run, task, "terms", engine=False)
    assert "furiko's own computation takes too long" in own.reason
    assert "hangs" not in own.reason
    assert not run.hangs["mujoco"]
    (engines,) = lost(run, task, "terms", engine=True)
    assert engines.reason.endswith(": it hangs")
    assert run.hangs["mujoco"] == 1


def test_an_engine_that_is_given_up_has_an_error_for_every_check_of_scenes_that_still_wait(monkeypatch):
    run, tasks = begun(monkeypatch, ["mujoco", "exudyn-tree"], ["rods-1", "rods-2", "rods-3"], hangs=1)
    (first,) = (task for task in tasks if (task.scene.name, task.engine) == ("rods-1", "mujoco"))
    run.waiting["rods-1"].remove(first)  # it runs
    found = lost(run, first, first.checks[-1], engine=True, compared=first.checks[:-1])
    others = [result for result in found if result.scene != "rods-1"]
    assert {(result.engine, result.outcome) for result in others} == {("mujoco", "error")}
    assert Counter(result.scene for result in others) == {name: len(first.checks) for name in ("rods-2", "rods-3")}
    assert {task.engine for tasks in run.waiting.values() for task in tasks} == {"exudyn-tree"}


def test_the_diagnosis_of_a_cell_that_goes_on_comes_once_at_its_end(monkeypatch):
    run, (task,) = begun(monkeypatch, ["mujoco"], ["rods-1"])
    early = Diagnosis(scene="rods-1", engine="mujoco", explains=["accelerations"])
    found = lost(run, task, "energy", engine=True, compared=["accelerations"], diagnosis=early)
    assert [type(one) for one in found] == [Result]
    rest, worker = run.ready.take((), {}), object()
    late = Diagnosis(scene="rods-1", engine="mujoco", explains=["trajectory"])
    run.progress[worker] = runner._Progress(compared=set(rest.task.checks), diagnosis=late)
    (whole,) = run._on(Finished(worker, rest))
    assert whole.explains == ["accelerations", "trajectory"]


def test_an_image_of_the_mechanism_is_asked_on_the_engines_clock_too():
    """Scaled, mirrored, without gravity: what is asked of the same engine with another mechanism."""

    class Engine:
        info = "known"

        def of(self, system):
            return Engine()

        def accelerations(self, theta, omega):
            return theta

    said = []
    engine = Announced(Engine(), said.append)
    image = engine.of("another")
    assert (image.info, image.accelerations(1, 2)) == ("known", 1)
    assert said == [True, False, True, False]
    with pytest.raises(TypeError):
        image.accelerations()
    assert said[4:] == [True, False]  # it is no longer asked once it has failed
