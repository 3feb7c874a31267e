"""``furiko enclose`` as a user meets it."""

import json
import subprocess
import sys

import jsonschema
import pytest
from flint import arb

from furiko.records.schema import schema


def run(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "furiko", *arguments], capture_output=True, text=True, timeout=120, check=False
    )


def test_a_table_of_intervals():
    done = run("enclose", "rods-1", "--until", "0.2")
    assert done.returncode == 0, done
    assert done.stderr == ""
    heading, *rows, last = done.stdout.splitlines()
    assert heading.split() == ["time", "[s]", "angle", "[rad]", "proved", "decimals"]
    assert len(rows) == 9
    assert "+/-" in rows[-1]
    assert int(rows[-1].split()[-1]) >= 15
    assert last.startswith("proved until 0.2 s; ")


def test_the_document_and_its_schema():
    done = run("enclose", "rods-1", "--until", "-0.2", "--digits", "25", "--json")
    assert done.returncode == 0, done
    document = json.loads(done.stdout)
    jsonschema.validate(document, json.loads(schema("enclose")))
    assert document["proved_until"] == -0.2
    last = document["rows"][-1]
    assert last["radius"] <= 1e-25
    assert last["theta_low"][0] <= float(arb(last["theta"][0])) <= last["theta_high"][0]


def test_a_part_is_status_3():
    done = run("enclose", "double-pendulum", "--until", "200", "--seconds", "0.5")
    assert done.returncode == 3, done
    assert "of 200 s: the time limit" in done.stdout.splitlines()[-1]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["rods-1", "--until", "nan"], "--until"),
        (["rods-20"], "[state] is missing"),
        (["acrobot"], "open mechanisms"),
        (["no-such-scene"], "no-such-scene"),
    ],
)
def test_what_cannot_be_is_one_line(arguments, words):
    done = run("enclose", *arguments)
    assert done.returncode == 2, done
    (line,) = done.stderr.splitlines()
    assert words in line
