"""Known differences: what they account for, what they never do, and what is said of entries that are no use."""

import msgspec
import pytest

from furiko.models import InvalidInput
from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.reports.known import Entry, known_in, read_known
from furiko.reports.report import Report

ENTRY = '[[known]]\nscene = "rods-*"\nengine = "mujoco"\nreason = "issue 12"\n'


def entry(scene="rods-*", engine="mujoco", reason="accepted", **fields):
    return Entry(scene, engine, reason, **fields)


def difference(cause):
    return Difference(cause=cause, where="link 1", measured=1.0, expected=2.0, says="another number")


def states(known):
    return [difference.state for difference in known.differences]


@pytest.fixture
def differs(make):
    return make.result("differs", measured=900.0, cause="gravity")


def test_a_known_difference_does_not_fail_and_is_counted(make, differs):
    run = make.report(differs, make.result())
    known = known_in(run, [entry(link="https://example.org/12")])
    assert (run.exit_status, known.exit_status_of(False, True), known.new) == (1, 0, 0)
    assert states(known) == ["differs"]
    assert known.differences[0].results == [("rods-2", "mujoco", "accelerations")]
    first, second = known.text().splitlines()
    assert first == "Known differences: 1 of 1 difference; 0 not known"
    assert second == "  rods-* × mujoco, *: 1 difference: accepted https://example.org/12"


@pytest.mark.parametrize(
    "other", [{"scene": "n-leg-*"}, {"engine": "exudyn-*"}, {"check": "terms*"}, {"cause": "mass"}, {"scene": "Rods-*"}]
)
def test_another_scene_engine_check_or_cause_is_not_meant(make, differs, other):
    known = known_in(make.report(differs), [entry(**other)])
    assert (known.exit_status_of(False, False), known.new) == (1, 1)
    assert states(known) == ["another-cause" if "cause" in other else "stale"]


def test_every_cause_must_be_known(make, differs):
    findings = [difference("gravity"), difference("mass")]
    found = Diagnosis(scene="rods-2", engine="mujoco", findings=findings, explains=["accelerations"])
    run = with_diagnoses(make.report(differs), found)
    one, both = [entry(cause="gravity")], [entry(cause="gravity"), entry(cause="mass")]
    assert known_in(run, one).new == 1
    assert states(known_in(run, one)) == ["another-cause"]
    assert known_in(run, both).new == 0
    assert states(known_in(run, both)) == ["differs", "differs"]


def with_diagnoses(report, *diagnoses):
    footer = msgspec.structs.replace(report.footer, diagnoses=len(diagnoses))
    return Report(report.header, report.results, footer, diagnoses)


def test_one_that_agrees_is_told_and_fails_where_strict(make):
    known = known_in(make.report(make.result()), [entry()])
    assert states(known) == ["agrees"]
    assert [known.exit_status_of(False, strict) for strict in (False, True)] == [0, 1]
    assert "agrees now; take the entry out" in known.text()


def test_one_that_agrees_in_some_scenes_is_still_known(make, differs):
    run = make.report(differs, make.result(scene="rods-3"))
    assert states(known_in(run, [entry()])) == ["differs"]


def test_one_that_means_nothing_that_ran_is_stale_and_does_not_fail(make):
    run = make.report(make.result(), make.result("skipped", check="energy"))
    known = known_in(run, [entry(check="energy"), entry(scene="gone")])
    assert states(known) == ["stale", "stale"]
    assert known.exit_status_of(False, True) == 0
    assert known.text().count("stale: it means nothing that was run") == 2


def test_a_failure_is_never_known(make, differs):
    known = known_in(make.report(make.result("error", reason="crash")), [entry()])
    assert states(known) == ["failed"]
    assert known.exit_status_of(False, False) == 3


def test_a_cut_off_run_and_a_loose_result_stay_what_they_are(make, differs):
    assert known_in(make.report(differs, footer=False), [entry()]).exit_status_of(False, False) == 3
    loose = known_in(make.report(differs, make.result("loose", check="energy")), [entry()])
    assert [loose.exit_status_of(sharp, False) for sharp in (False, True)] == [0, 1]


def test_without_entries_it_is_the_run(make, differs):
    for run in (make.report(differs), make.report(make.result()), make.report(make.result("error"))):
        for sharp in (False, True):
            assert known_in(run, []).exit_status_of(sharp, False) == run.exit_status_of(sharp)


def test_a_file_is_read(tmp_path):
    path = tmp_path / "known.toml"
    path.write_text(ENTRY + 'check = "terms ?"\ncause = "gravity"\nlink = "https://example.org"\n')
    assert read_known(path) == (Entry("rods-*", "mujoco", "issue 12", "terms ?", "gravity", "https://example.org"),)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "known: missing"),
        ('[[known]]\nscene = "a"\nreason = "b"\n', "engine"),
        (ENTRY + "checks = 1\n", "checks: unknown field; did you mean 'check'|unknown field"),
        (ENTRY.replace("issue 12", " "), r"known\[0\].reason: empty"),
        (ENTRY.replace("rods-*", "*****"), r"known\[0\].scene: a pattern of at most"),
        (ENTRY.replace("rods-*", ""), r"known\[0\].scene: a pattern of at most"),
        (ENTRY + 'link = "javascript:alert(1)"\n', r"known\[0\].link: an address that begins with https"),
        (ENTRY * 501, "at most 500 entries"),
        ("known = 3", "known"),
        ("[[known]", "not TOML"),
    ],
)
def test_a_bad_file_is_refused_with_the_field(tmp_path, text, says):
    path = tmp_path / "known.toml"
    path.write_text(text)
    with pytest.raises(InvalidInput, match=says) as error:
        read_known(path)
    assert str(error.value).startswith(str(path))


def test_no_file_is_refused(tmp_path):
    with pytest.raises(InvalidInput):
        read_known(tmp_path / "none.toml")


def test_an_entry_accounts_for_no_failure(make):
    run = make.report(make.result("error"), make.result("differs", check="energy"))
    known = known_in(run, [entry()])
    assert list(known.by_result) == [("rods-2", "mujoco", "energy")]
    assert known.exit_status_of(False, False) == 3
