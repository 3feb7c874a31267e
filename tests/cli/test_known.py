"""``furiko check --known``, as a user meets it."""

import json
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import msgspec
import pytest

from furiko.reports import StreamWriter, read_stream

FAKES = Path(__file__).parent.parent
ENVIRONMENT = os.environ | {"PYTHONPATH": os.pathsep.join([str(FAKES), *filter(None, [os.environ.get("PYTHONPATH")])])}

KNOWN = '[[known]]\nscene = "{}"\nengine = "fake_engines:*"\ncheck = "accelerations"\nreason = "it is a fake"\n'


@pytest.fixture
def check(tmp_path):
    def run(engine, known, *more):
        (tmp_path / "known.toml").write_text(known)
        command = [sys.executable, "-m", "furiko", "check", "rods-2", "-e", f"fake_engines:{engine}"]
        return subprocess.run(
            [*command, "--profile", "smoke", "--known", "known.toml", *more],
            capture_output=True, text=True, cwd=tmp_path, env=ENVIRONMENT, check=False, timeout=120,
        )  # fmt: skip

    return run


def test_a_known_difference_passes_and_is_shown_apart(check):
    done = check("SignFlipped", KNOWN.format("rods-*") + KNOWN.format("gone"))
    assert done.returncode == 0, done
    assert "Known differences: 1 of 1 difference; 0 not known\n" in done.stdout
    assert "gone × fake_engines:*, accelerations: stale" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(("scene", "failures", "skipped"), [("rods-*", "0", "1"), ("n-leg-*", "1", "0")])
def test_what_a_ci_reads_has_it_too(check, tmp_path, scene, failures, skipped):
    """A known difference is a skipped test with its reason, one that is not known a failed one."""
    check("SignFlipped", KNOWN.format(scene))
    suites = ElementTree.parse(tmp_path / "furiko-report" / "junit.xml").getroot()
    assert (suites.get("failures"), suites.get("skipped")) == (failures, skipped)
    messages = [element.get("message") for element in suites.iter("skipped")]
    assert messages == ["known difference: it is a fake"] * int(skipped)
    summary = (tmp_path / "furiko-report" / "report.md").read_text()
    assert f"### Known differences&#58; {skipped} of 1 difference; {failures} not known\n" in summary


def test_another_difference_fails(check):
    assert check("SignFlipped", KNOWN.format("n-leg-*")).returncode == 1


@pytest.mark.slow
@pytest.mark.parametrize(("more", "status"), [((), 0), (("--known-strict",), 1)])
def test_one_that_agrees_is_told(check, more, status):
    done = check("Right", KNOWN.format("rods-2"), *more)
    assert done.returncode == status, done
    assert "agrees now; take the entry out" in done.stdout


def test_json_has_it(check):
    done = check("SignFlipped", KNOWN.format("rods-*"), "--json")
    assert done.returncode == 0, done
    (known,) = json.loads(done.stdout)["known"]
    assert known["state"] == "differs"
    assert known["results"] == [["rods-2", "fake_engines:SignFlipped", "accelerations"]]
    assert known["reason"] == "it is a fake"
    (diagnosis,) = json.loads(done.stdout)["diagnoses"]
    assert diagnosis["explains"] == ["accelerations"]


def test_a_bad_file_is_one_line_before_anything_runs(check):
    done = check("Right", "[[known]]\n")
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.slow
def test_a_baseline_decides_too_where_all_that_differs_is_known(check, tmp_path):
    """It is known now, and it agreed then."""
    first = check("SignFlipped", KNOWN.format("rods-*"), "--out", "now")
    then = read_stream(tmp_path / "now")
    with StreamWriter(tmp_path / "then.jsonl", then.header) as stream:
        for result in then.results:
            stream.write(msgspec.structs.replace(result, outcome="agrees", measured=1.0))
        stream.finish()
    second = check("SignFlipped", KNOWN.format("rods-*"), "--baseline", "then.jsonl")
    assert (first.returncode, second.returncode) == (0, 1), second
    assert "broke (1)" in second.stdout
