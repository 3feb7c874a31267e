"""What is kept is found again, only for the very same inputs, and its failures cost nothing but time."""

import multiprocessing
import os
from dataclasses import replace

import pytest

import furiko
from furiko.checks import cache as module
from furiko.checks.cache import Cache
from furiko.checks.plan import make_plan
from furiko.records.check import Result

RESULT = Result(scene="rods-2", engine="mujoco", check="accelerations", outcome="agrees", measured=1.5, unit="ε")


@pytest.fixture
def task():
    return make_plan(["rods-2"], ["mujoco"], "smoke").tasks[0]


@pytest.fixture
def cache(tmp_path):
    return Cache(tmp_path / "cache")


def test_results_are_found_again_and_marked(cache, task):
    assert cache.results(task, "4.0.0") is None
    cache.keep_results(task, "4.0.0", [RESULT])
    (found,) = cache.results(task, "4.0.0")
    assert found.kept
    assert (found.measured, found.outcome) == (1.5, "agrees")


def test_any_other_input_is_another_entry(cache, task, monkeypatch):
    cache.keep_results(task, "4.0.0", [RESULT])
    scene = task.scene
    others = [
        replace(task, random_states=21),
        replace(task, engine="exudyn-tree"),
        replace(task, checks=("energy",)),
        replace(task, scene=replace(scene, theta=(1.0, 1.0))),
        replace(task, scene=replace(scene, duration=3.0)),
        replace(task, scene=replace(scene, system=furiko.RodChain(scene.system.lengths, density=0.9))),
    ]
    assert all(cache.results(other, "4.0.0") is None for other in others)
    assert cache.results(task, "4.0.1") is None
    monkeypatch.setattr(module, "sources_digest", lambda: b"another version of furiko")
    assert cache.results(task, "4.0.0") is None


def test_a_failure_is_not_kept(cache, task):
    cache.keep_results(task, "4.0.0", [RESULT, replace_outcome("error")])
    assert cache.results(task, "4.0.0") is None


def replace_outcome(outcome):
    return Result(scene="rods-2", engine="mujoco", check="energy", outcome=outcome, reason="once")


@pytest.mark.parametrize("damage", [b"", b"[", b"\x00" * 100, b'[{"kind": "result"}]'])
def test_a_damaged_entry_is_computed_again(cache, task, damage):
    cache.keep_results(task, "4.0.0", [RESULT])
    cache.keep_facts(task.scene, 20, b"truth")
    for path in cache.entries():
        path.write_bytes(damage)
    assert cache.results(task, "4.0.0") is None
    assert cache.facts(task.scene, 20) is None


def test_truth_is_found_again(cache, task):
    cache.keep_facts(task.scene, 20, b"truth")
    assert cache.facts(task.scene, 20) == b"truth"
    assert cache.facts(task.scene, 21) is None


def test_a_folder_that_cannot_be_written_is_no_failure(tmp_path, task):
    (tmp_path / "file").write_text("")
    cache = Cache(tmp_path / "file" / "cache")
    cache.keep_results(task, "4.0.0", [RESULT])
    assert cache.results(task, "4.0.0") is None
    assert cache.entries() == []


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs Linux's /dev/full to stand for a full disk")
def test_a_full_disk_leaves_no_entry(cache, task, monkeypatch):
    from pathlib import Path

    def fail(self, content):
        with open("/dev/full", "wb", 0) as file:
            return file.write(content)

    monkeypatch.setattr(Path, "write_bytes", fail)
    cache.keep_results(task, "4.0.0", [RESULT])
    monkeypatch.undo()
    assert cache.entries() == []


def test_no_cache_keeps_nothing(task):
    cache = Cache(None)
    cache.keep_results(task, "4.0.0", [RESULT])
    assert cache.results(task, "4.0.0") is None
    assert cache.clear() == 0


def test_clearing_deletes_every_entry(cache, task):
    cache.keep_results(task, "4.0.0", [RESULT])
    cache.keep_facts(task.scene, 20, b"truth")
    assert cache.clear() == 2
    assert cache.results(task, "4.0.0") is None


def _write_and_read(folder, task, times):
    cache = Cache(folder)
    for _ in range(times):
        cache.keep_results(task, "4.0.0", [RESULT] * 50)
        found = cache.results(task, "4.0.0")
        assert found is not None
        assert len(found) == 50


def test_two_processes_at_once_never_see_half_an_entry(tmp_path, task):
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=_write_and_read, args=(tmp_path, task, 200)) for _ in range(2)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert [process.exitcode for process in processes] == [0, 0]


def test_a_second_run_gives_the_same_verdicts_from_the_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path))

    def run(**options):
        found = furiko.check(["rods-2"], ["mujoco", "pinocchio-aba"], profile="smoke", **options).results
        return {(r.engine, r.check): (r.outcome, r.measured, r.allowed) for r in found}, {r.kept for r in found}

    first, computed = run()
    second, kept = run()
    third, again = run(use_cache=False)
    assert first == second == third
    assert (computed, kept, again) == ({False}, {True}, {False})
