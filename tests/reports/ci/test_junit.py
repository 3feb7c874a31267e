"""The JUnit file is well formed, says what CI systems read, and its tallies are those of its cases."""

from xml.etree import ElementTree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.reports.ci.junit import to_junit
from furiko.reports.known import Entry, known_in
from furiko.reports.report import Report


def parsed(report):
    return ElementTree.fromstring(to_junit(report).encode())


def assert_structure(root):
    """The shape on which GitHub's, GitLab's and Jenkins's readers agree."""
    assert root.tag == "testsuites"
    for suite in root:
        assert suite.tag == "testsuite"
        assert suite.get("name")
        cases = suite.findall("testcase")
        assert len(cases) == len(suite)
        for case in cases:
            assert set(case.attrib) == {"classname", "name", "time"}
            assert float(case.get("time")) >= 0
            assert len(case) <= 1
            for said in case:
                assert said.tag in ("failure", "error", "skipped", "system-out")
                assert said.text if said.tag == "system-out" else said.get("message")
        tally(suite, cases)
    tally(root, root.findall("testsuite/testcase"))


def tally(element, cases):
    assert int(element.get("tests")) == len(cases)
    for attribute, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        assert int(element.get(attribute)) == sum(case.find(tag) is not None for case in cases)
    assert float(element.get("time")) == pytest.approx(sum(float(case.get("time")) for case in cases), abs=1e-4)


def test_a_large_run(make):
    run = make.large()
    root = parsed(run)
    assert_structure(root)
    assert [suite.get("name") for suite in root] == list(run.scenes)
    assert int(root.get("tests")) == len(run.results)
    assert int(root.get("failures")) == run.counts["differs"]
    assert int(root.get("errors")) == run.counts["error"]
    assert int(root.get("skipped")) == run.counts["skipped"]
    assert root.find("testsuite").get("timestamp") == "2026-11-23T04:45:00"


def test_a_case_of_each_outcome(make):
    root = parsed(
        make.report(
            make.result("agrees", check="a"),
            make.result("differs", check="b", measured=200, allowed=64, cause="armature", reason="M is larger"),
            make.result("skipped", check="c", reason="it cannot"),
            make.result("error", check="d", reason="RuntimeError: no", details={"traceback": "Traceback:\n  line 7"}),
        )
    )
    assert_structure(root)
    agrees, differs, skipped, error = root.findall("testsuite/testcase")
    assert agrees.get("classname") == "rods-2.mujoco"
    assert agrees.get("name") == "a"
    assert len(agrees) == 0
    assert differs.find("failure").get("message") == "200 ε against 64 ε allowed: M is larger"
    assert differs.find("failure").get("type") == "armature"
    assert skipped.find("skipped").get("message") == "it cannot"
    assert error.find("error").get("message") == "RuntimeError: no"
    assert "line 7" in error.find("error").text


def test_a_run_that_was_cut_off_is_not_green(make):
    whole = make.report(make.result())
    assert int(parsed(whole).get("errors")) == 0
    root = parsed(Report(whole.header, whole.results))
    assert_structure(root)
    assert int(root.get("errors")) == 1
    assert "cut off" in root.find("testsuite[@name='furiko']/testcase/error").get("message")


def test_a_loose_result_is_said_and_no_failure(make):
    root = parsed(make.report(make.result("loose", reason="Monte-Carlo")))
    assert_structure(root)
    assert root.get("failures") == "0"
    said = root.find("testsuite/testcase/system-out").text
    assert said == "loose: 50 ε, rounding gives at most 4 ε: Monte-Carlo"


def test_a_failure_carries_its_whole_diagnosis(make):
    mass = Difference(cause="mass", where="link 1", measured=2.0, expected=1.0, says="mass of link 1 is 2")
    found = Diagnosis(scene="rods-2", engine="mujoco", alternatives=[mass], explains=["accelerations"])
    whole = make.report(make.result("differs"))
    root = parsed(Report(whole.header, whole.results, whole.footer, (found,)))
    failure = root.find("testsuite/testcase/failure")
    assert failure.get("type") == "mass"
    assert "either mass of link 1 is 2" in failure.text
    assert failure.get("message").startswith("either mass of link 1 is 2; ")


def test_a_failure_is_none_of_the_known_differences(make):
    """Of a check that gave one result, and was lost with its worker before the next: both go by the check's name."""
    run = make.report(make.result("differs"), make.result("error", reason="the engine's process died"))
    root = ElementTree.fromstring(to_junit(run, known_in(run, [Entry("*", "*", "accepted")])).encode())
    assert_structure(root)
    assert [root.get(name) for name in ("tests", "failures", "errors", "skipped")] == ["2", "0", "1", "1"]


@settings(deadline=None, max_examples=60)
@given(name=st.text(min_size=1), outcome=st.sampled_from(["agrees", "differs", "skipped", "error"]))
def test_any_text_leaves_it_well_formed(make, name, outcome):
    result = make.result(outcome, scene=name, engine=name, check=name, reason=name, cause=name, unit=name)
    root = parsed(make.report(result, scenes=[], engines=[]))
    assert_structure(root)


@pytest.mark.parametrize("text", ["]]>", "<!--", "</testsuite>", '" x="', "\x00\x0b\x1f\ufffe\uffff\ud800", "&amp;<b>"])
def test_hostile_text_comes_out_as_it_went_in_or_escaped(make, text):
    result = make.result("error", scene=f"s{text}", check=text, reason=text, details={"traceback": text})
    root = parsed(make.report(result, scenes=[], engines=[]))
    expected = text if text.isprintable() else text.encode("unicode_escape").decode()
    assert root.find("testsuite").get("name") == f"s{expected}"
    assert root.find("testsuite/testcase").get("name") == expected
    assert root.find("testsuite/testcase/error").text == f"{expected}\n{expected}"
