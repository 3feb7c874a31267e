"""An independent validator accepts real lines of a stream by the shipped schema, and refuses others."""

import json

import jsonschema
import pytest

from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.records.schema import FOLDER
from furiko.reports import StreamWriter

VALIDATOR = jsonschema.Draft202012Validator(json.loads((FOLDER / "check.json").read_text(encoding="utf-8")))


def test_real_lines_are_valid(make, tmp_path):
    run = make.large(links=(1, 20, 64))
    with StreamWriter(tmp_path / "r", run.header) as stream:
        for result in run.results:
            stream.write(result)
        stream.write(make.result("differs", measured=float("inf"), cause="armature"))
        finding = Difference(cause="gravity", where="mujoco", measured=9.8, expected="9.81", says="gravity is 9.8")
        stream.write_diagnosis(Diagnosis(scene="rods-2", engine="mujoco", findings=[finding], explains=["energy"]))
        stream.finish(1.0)
    lines = (tmp_path / "r").read_text(encoding="utf-8").splitlines()
    for line in lines:
        VALIDATOR.validate(json.loads(line))
    assert {json.loads(line)["kind"] for line in lines} == {"header", "result", "diagnosis", "footer"}


@pytest.mark.parametrize(
    "line",
    [
        [],
        {},
        {"kind": "other"},
        {"kind": "footer", "agrees": 1},
        {"kind": "footer", "agrees": "1", "differs": 0, "skipped": 0, "error": 0},
        {"kind": "result", "scene": "s", "engine": "e", "check": "c", "outcome": "fine"},
        {"kind": "result", "scene": "s", "engine": "e", "outcome": "agrees"},
        {"kind": "result", "scene": "s", "engine": "e", "check": "c", "outcome": "agrees", "measured": "3"},
    ],
)
def test_other_lines_are_not(line):
    assert not VALIDATOR.is_valid(line)
