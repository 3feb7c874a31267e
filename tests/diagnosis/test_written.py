"""The verdict on a file that ``--fix`` wrote, and what it does to the exit status."""

from dataclasses import replace
from pathlib import Path

import pytest

from furiko.diagnosis.finding import Finding
from furiko.diagnosis.model_files.fix import judged
from furiko.diagnosis.model_files.result import Diagnosis, Written

OUT = Path("out.xml")


def found(verdict="agrees", findings=(), **statuses):
    engines = {name.replace("_", "-"): {"status": status, "says": "so"} for name, status in statuses.items()}
    return Diagnosis("model.xml", verdict, tuple(findings), engines)


def test_what_every_engine_reads_alike_agrees():
    assert judged(OUT, found(mujoco="agrees", drake="missing", exudyn_tree="failed")) == Written("out.xml", (), 0)


@pytest.mark.parametrize("status", ["differs", "refused", "failed"])
def test_what_one_engine_does_not_read_alike_does_not(status):
    written = judged(OUT, found(mujoco="agrees", drake=status))
    assert (written.status, len(written.why)) == (1, 1)
    assert written.why[0].startswith("drake ")


def test_a_finding_says_why_in_the_place_of_a_status():
    finding = Finding("damping", "drake: joint 'j'", 0.0, 0.1, "drake drops damping")
    written = judged(OUT, found(findings=[finding], mujoco="agrees", drake="differs"))
    assert written.why == ("drake drops damping",)


def test_what_no_engine_can_be_asked_about_is_not_called_right():
    written = judged(OUT, found(mujoco="missing", exudyn_tree="agrees"))
    assert (written.status, written.why) == (3, ("no engine could be asked about it",))
    assert written.to_json()["agrees"] is False


@pytest.mark.parametrize(
    ("verdict", "status", "expected"),
    [
        ("agrees", 0, 0),
        ("agrees", 1, 1),
        ("agrees", 3, 3),
        ("differs", 0, 1),
        ("incomplete", 0, 3),
        ("incomplete", 1, 1),
    ],
)
def test_the_exit_status_counts_both(verdict, status, expected):
    assert replace(found(verdict), written=Written("out.xml", (), status)).exit_status == expected
