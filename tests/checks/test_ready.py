"""The cells that wait: their order, and that taking one of many costs no more than taking one of few."""

import time
from collections import Counter
from types import SimpleNamespace

import pytest

from furiko.checks.runner import _Ready


def cell(engine, n, name=""):
    return SimpleNamespace(
        task=SimpleNamespace(engine=engine, scene=SimpleNamespace(name=name, system=SimpleNamespace(n=n)))
    )


def order(ready, here=(), importers=None):
    found = []
    while job := ready.take(here, importers or Counter()):
        found.append((job.task.engine, job.task.scene.system.n, job.task.scene.name))
    return found


def filled(*cells):
    ready = _Ready()
    for one in cells:
        ready.add(cell(*one))
    return ready


def test_an_engine_that_is_here_comes_first_one_that_another_worker_has_last():
    ready = filled(("a", 9), ("b", 1), ("c", 5), ("a", 2))
    assert [engine for engine, _, _ in order(ready, {"b"}, Counter(a=1, b=1))] == ["b", "c", "a", "a"]


def test_the_largest_comes_first_and_of_equal_ones_the_first():
    ready = filled(("a", 2, "first"), ("a", 2, "second"), ("a", 30, ""))
    assert [(n, name) for _, n, name in order(ready)] == [(30, ""), (2, "first"), (2, "second")]


def test_cells_of_an_engine_are_taken_out_together():
    ready = filled(("a", 1), ("b", 2), ("a", 3))
    assert [job.task.scene.system.n for job in ready.remove("a")] == [3, 1]
    assert len(ready) == 1
    assert ready.remove("nobody") == []
    assert [engine for engine, _, _ in order(ready)] == ["b"]
    assert not ready


def seconds(count):
    ready = filled(*(("a", k % 7) for k in range(count)))
    begun = time.perf_counter()
    order(ready)
    return (time.perf_counter() - begun) / count


@pytest.mark.slow
def test_one_of_many_is_taken_as_fast_as_one_of_few():
    # log2(64,000) / log2(1,000) is 1.6; what grows with the number itself would take 64 times as long. Of three tries
    # the fastest, as other programs run beside.
    few, many = min(seconds(1_000) for _ in range(3)), min(seconds(64_000) for _ in range(3))
    assert many < 10 * few
