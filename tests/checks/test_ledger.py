"""What was planned and did not arrive is an error, wherever it was lost."""

import pytest

import furiko
from furiko.checks import runner
from furiko.checks.ledger import Ledger
from furiko.checks.plan import make_plan
from furiko.records.check import Result


def result(check, comparison):
    return Result(scene="rods-2", engine="mujoco", check=check, comparison=comparison, outcome="agrees")


@pytest.fixture
def ledger():
    found = Ledger(make_plan(["rods-2"], ["mujoco"], "smoke"))
    found.promise("rods-2", "mujoco", "terms", 4)
    return found


def test_all_is_there(ledger):
    terms = [result(f"terms {part}", "terms") for part in ("M", "C", "G", "velocity")]
    assert ledger.missing([result("accelerations", "accelerations"), *terms]) == []


def test_a_check_without_results_and_one_with_too_few(ledger):
    first, second = ledger.missing([result("terms M", "terms"), result("terms C", "terms")])
    assert (first.check, first.outcome) == ("accelerations", "error")
    assert "no result" in first.reason
    assert (second.check, second.outcome) == ("terms", "error")
    assert "2 of its 4 results" in second.reason


def test_a_check_that_gave_nothing_is_missing_whatever_it_says_of_itself(ledger):
    """Each check that is planned has a result, a skip at least."""
    ledger.promise("rods-2", "mujoco", "accelerations", 0)
    terms = [result(f"terms {part}", "terms") for part in ("M", "C", "G", "velocity")]
    (missing,) = ledger.missing(terms)
    assert (missing.check, missing.outcome) == ("accelerations", "error")


def test_what_was_settled_beforehand_must_arrive_too():
    """Pinocchio has no integrator: the skips that say so are results as any others."""
    plan = make_plan(["rods-2"], ["pinocchio-aba"], "quick")
    planned = [found.comparison for found in plan.settled]
    assert "trajectory" in planned
    lost = {found.comparison for found in Ledger(plan).missing([])}
    assert lost == {*planned, *plan.tasks[0].checks}


@pytest.mark.slow
@pytest.mark.parametrize("lost", ["a whole check", "one of several results"])
def test_what_the_runner_drops_is_noticed(monkeypatch, lost):
    """A fault in the runner: a result that came from a worker is not handed on."""
    real = runner._Run._on

    def dropping(self, event):
        for found in real(self, event):
            dropped = found.comparison == "energy" if lost == "a whole check" else found.check == "terms C"
            if not dropped:
                yield found

    monkeypatch.setattr(runner._Run, "_on", dropping)
    report = furiko.check(["rods-2"], ["fake_engines:Right"])
    missing = [found for found in report.results if found.outcome == "error"]
    assert [found.check for found in missing] == ["energy" if lost == "a whole check" else "terms"]
    assert report.exit_status == 3


@pytest.mark.parametrize(("arrived", "says"), [(2, "3 of its 5 results did not arrive"), (5, None), (6, None)])
def test_how_many_results_are_missing(ledger, arrived, says):
    """More than promised are none too few: until a check has run, nobody knows how many it has."""
    ledger.promise("rods-2", "mujoco", "terms", 5)
    got = [result("accelerations", "accelerations"), *[result("terms M", "terms")] * arrived]
    assert [found.reason.split(", and ")[1].split(":")[0] for found in ledger.missing(got)] == ([says] if says else [])
