"""What every ``--json`` prints is valid by its shipped schema, which has all its fields."""

import json

import jsonschema
import msgspec
import pytest

import furiko
from furiko.cli.main import run
from furiko.models.errors import InvalidInput
from furiko.records.check import EngineEntry, Header, Result
from furiko.records.schema import FOLDER, SCHEMAS
from furiko.reports import StreamWriter, open_report
from furiko.run import ReportNotWritten

DERIVATION = """system = "n-leg"
links = 2
[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -m1*g*sin(t1) - m2*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) - m2*l1*w1^2*sin(t1-t2)"
"""
MODEL = furiko.to_mjcf(furiko.RodChain([1.0, 0.5])).replace('name="hinge2"', 'name="hinge2" armature="0.01"')


def two_results(folder, outcome):
    """A run that was made up: one result that agrees, one as asked for."""
    engine = EngineEntry(name="mujoco", formulation="", package="mujoco", version="4.0.0")
    header = Header(
        furiko="1", started="2026-01-01T00:00:00+00:00", command="furiko check", profile="quick", seed="", machine={},
        versions={}, scenes=[], engines=[engine],
    )  # fmt: skip
    measured = {"scene": "rods-2", "engine": "mujoco", "measured": 3.0, "allowed": 8.0, "unit": "ε"}
    with open_report(folder, header) as stream:
        stream.write(Result(check="accelerations", outcome="agrees", **measured))
        stream.write(Result(check="energy", outcome=outcome, **measured))
        stream.finish()


@pytest.fixture
def printed(tmp_path, monkeypatch, capfd):
    """The document that a command prints, run beside a wrong derivation and a model with an armature."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "derivation.toml").write_text(DERIVATION)
    (tmp_path / "model.xml").write_text(MODEL)
    for name, outcome in (("before", "agrees"), ("after", "differs")):
        two_results(tmp_path / name, outcome)

    def printed(*arguments):
        run([*arguments, "--json"])
        return json.loads(capfd.readouterr().out)

    return printed


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("check-report", ["check", "rods-1", "--profile", "smoke"]),
        ("scenes", ["scenes"]),
        ("engines", ["engines"]),
        ("diff", ["diff", "before", "after"]),
        ("cache", ["cache"]),
        ("cache", ["cache", "--clear"]),
        ("advise", ["advise", "double-pendulum", "-e", "mujoco", "--error", "1e-3", "--until", "0.5"]),
        ("grade", ["grade", "derivation.toml"]),
        ("diagnose", ["diagnose", "model.xml"]),
        ("diagnose-several", ["diagnose", "model.xml", "no-such-file.xml", "-e", "mujoco"]),
        ("stress", ["stress", "--axis", "long-rods", "-e", "document", "--budget", "5", "--out", "stress"]),
        pytest.param("audit", ["audit"], marks=pytest.mark.slow),
    ],
)
def test_a_document_is_valid_and_fully_described(printed, name, arguments):
    document = printed(*arguments)
    assert document
    validator = jsonschema.Draft202012Validator(json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8")))
    validator.validate(document)
    assert undescribed(document, msgspec.to_builtins(msgspec.convert(document, SCHEMAS[name][1]))) == []


def undescribed(document, known, where=""):
    """Places in the document that its record does not have. An engine's settings go by the engine's own names."""
    if isinstance(document, dict):
        own_names = where.rpartition("/")[0].endswith("/engines") and "status" in document
        missing = [] if own_names else [f"{where}/{key}" for key in document.keys() - known.keys()]
        shared = document.keys() & known.keys()
        return missing + [place for key in shared for place in undescribed(document[key], known[key], f"{where}/{key}")]
    if isinstance(document, list):
        pairs = enumerate(zip(document, known, strict=True))
        return [place for i, (one, other) in pairs for place in undescribed(one, other, f"{where}/{i}")]
    return [] if document == known else [where]


@pytest.mark.parametrize(
    "name", ["scenes", "engines", "diff", "cache", "grade", "diagnose", "diagnose-several", "audit", "bench"]
)
def test_another_document_is_not(name):
    validator = jsonschema.Draft202012Validator(json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8")))
    for other in (1, {}, [{}], {"verdict": "maybe"}):
        assert not validator.is_valid(other)


def test_a_run_prints_all_that_its_stream_has(printed, tmp_path):
    """Skipped and differing results, diagnoses and the footer: nothing is known from JSON that is not so."""
    document = printed("check", "rods-1", "-e", "mujoco", "-e", "pinocchio-aba", "--out", "here")
    lines = [json.loads(line) for line in (tmp_path / "here" / "report.jsonl").read_text().splitlines()]
    results = [line for line in lines if line["kind"] == "result"]
    assert {line["outcome"] for line in results} == {"agrees", "skipped"}
    assert len(document["results"]) == len(results)
    assert document["footer"]["digest"] == lines[-1]["digest"]


def full(*_, **__):
    raise InvalidInput("report: cannot be written: No space left on device")


def test_a_report_that_cannot_be_written_is_an_incomplete_run(tmp_path, monkeypatch, capfd):
    """All agrees, and the disk fills up at the end."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("furiko.run.write_reports", full)
    assert run(["check", "rods-1", "-e", "mujoco", "--profile", "smoke"]) == 3
    assert "No space left" in capfd.readouterr().err


def test_a_stream_that_takes_no_more_is_told_and_has_no_footer(tmp_path, monkeypatch):
    monkeypatch.setattr(StreamWriter, "write", full)
    with pytest.raises(ReportNotWritten, match="No space left") as caught:
        furiko.check(["rods-1"], ["mujoco"], profile="smoke", out=tmp_path)
    assert [result.outcome for result in caught.value.report.results] == ["agrees"]
    assert not furiko.read_stream(tmp_path).complete
