"""Calls in processes of their own: one that dies, hangs or fails is told, and the others answer."""

import os
import time
from pathlib import Path

import pytest

from furiko.checks.workers.isolated import Lost, call_apart
from furiko.checks.workers.messages import CallJob
from furiko.checks.workers.processes import spawn


@pytest.fixture(autouse=True)
def here_on_path(monkeypatch):
    monkeypatch.syspath_prepend(str(Path(__file__).parent))


def die():
    os.abort()


def hang():
    time.sleep(3600)


def fail():
    raise ValueError("no")


def double(number):
    return 2 * number


def test_each_call_is_its_own():
    # The functions are this module's own, found by name: a worker searches where this process does.
    names = ("double", "die", "hang", "fail", "double")
    calls = [CallJob("test_isolated", name, (21,) if name == "double" else ()) for name in names]
    first, died, hung, failed, last = call_apart(calls, timeout=8.0)
    assert first == last == 42
    assert isinstance(died, Lost)
    assert "SIGABRT" in died.reason
    assert isinstance(hung, Lost)
    assert "hangs" in hung.reason
    assert failed == Lost("ValueError: no")


def test_a_worker_that_died_before_its_call_is_told(monkeypatch):
    def still_born(folder):
        process, connection = spawn(folder)
        process.kill()
        process.wait()
        return process, connection

    monkeypatch.setattr("furiko.checks.workers.processes.spawn", still_born)
    (found,) = call_apart([CallJob("test_isolated", "double", (21,))], timeout=8.0)
    assert isinstance(found, Lost)
    assert "SIGKILL" in found.reason
