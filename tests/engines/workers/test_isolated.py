"""Calls in processes of their own: one that dies, hangs or fails is told, and the others answer."""

import pytest
from misbehaving import damaged, die, double, endless, fail, half_a_message, hang, rubbish

from furiko.engines.workers.isolated import Call, NotReturned, call_isolated
from furiko.engines.workers.processes import spawn


@pytest.mark.slow
def test_each_call_is_its_own():
    calls = [Call(double, (21,)), Call(die), Call(hang), Call(fail), Call(double, (21,))]
    first, died, hung, failed, last = call_isolated(calls, timeout=8.0)
    assert first == last == 42
    assert isinstance(died, NotReturned)
    assert "SIGABRT" in died.reason
    assert isinstance(hung, NotReturned)
    assert "hangs" in hung.reason
    assert failed == NotReturned("ValueError: no")


def test_a_worker_that_died_before_its_call_is_told(monkeypatch):
    def still_born(*arguments):
        worker = spawn(*arguments)
        worker.process.kill()
        worker.process.wait()
        return worker

    monkeypatch.setattr("furiko.engines.workers.processes.spawn", still_born)
    (found,) = call_isolated([Call(double, (21,))], timeout=8.0)
    assert isinstance(found, NotReturned)
    assert "SIGKILL" in found.reason


@pytest.mark.slow
@pytest.mark.parametrize(
    ("function", "says"),
    [
        (rubbish, "something else"),
        (endless, "4611686018427387904 bytes"),
        (half_a_message, "hangs"),
        (damaged, "damaged"),
    ],
)
def test_what_is_no_message_is_told_and_spoils_nothing_else(function, says):
    bad, good = call_isolated([Call(function), Call(double, (21,))], timeout=3.0)
    assert isinstance(bad, NotReturned)
    assert says in bad.reason
    assert good == 42
