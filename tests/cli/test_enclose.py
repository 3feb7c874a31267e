"""``furiko enclose`` as a user meets it."""

import json
import subprocess
import sys

import jsonschema
import pytest
from flint import arb, ctx

from furiko.records.schema import schema

# A pole of 0.75 kg at 0.5 m, hanging from a cart of 2 kg; the hinge's positive direction moves it to +x.
ARM = """<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="cart">
      <joint name="along" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>
      <body name="pole">
        <joint name="turn" type="hinge" axis="0 -1 0"/>
        <inertial pos="0 0 -0.5" mass="0.75" diaginertia="0.01 0.01 0.01"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


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


def test_an_open_mechanism_by_its_joints():
    done = run("enclose", "cart-pole")
    assert done.returncode == 0, done
    heading, first, second, *_rest, last = done.stdout.splitlines()
    assert heading.split() == ["time", "[s]", "joint", "[m],", "[rad]", "proved", "decimals"]
    assert first.split()[:3] == ["0", "track", "[-0.29999999999999998890"]  # the double -0.3
    assert second.split()[0] == "pivot"
    assert last.startswith("proved until 2 s; ")
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_a_users_scene_of_a_model_file(tmp_path):
    (tmp_path / "arm.xml").write_text(ARM, encoding="utf-8")
    scene = tmp_path / "arm.toml"
    scene.write_text('model = "arm.xml"\n\n[state]\nq = { turn = 1.0 }\nduration = 0.5\n', encoding="utf-8")
    done = run("enclose", str(scene), "--json")
    assert done.returncode == 0, done
    document = json.loads(done.stdout)
    jsonschema.validate(document, json.loads(schema("enclose")))
    assert document["coordinates"] == ["along", "turn"]
    assert document["units"] == ["m", "rad"]
    # no force along x: the common centre of mass stays at x = 0.75 sin 1 · 0.5, from the definition
    with ctx.workprec(120):
        along, turn = map(arb, document["rows"][-1]["theta"])
        centre = (2 * along + arb(0.75) * (along + arb(0.5) * turn.sin())) / 2.75
        assert (centre - arb(0.75) * arb(0.5) * arb(1).sin() / 2.75).contains(0)
        assert centre.rad() < 1e-15
    assert document["rows"][-1]["theta_high"][1] < 0.9  # it has fallen


def test_a_part_is_status_3():
    done = run("enclose", "double-pendulum", "--until", "200", "--seconds", "0.5")
    assert done.returncode == 3, done
    assert "of 200 s: the time limit" in done.stdout.splitlines()[-1]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["rods-1", "--until", "nan"], "--until"),
        (["rods-20"], "[state] is missing"),
        (["hopper"], "joint 'leg': it slides along what 'knee' turns"),
        (["arm-7", "--until", "1"], "joint 'j2'"),
        (["no-such-scene"], "no-such-scene"),
    ],
)
def test_what_cannot_be_is_one_line(arguments, words):
    done = run("enclose", *arguments)
    assert done.returncode == 2, done
    (line,) = done.stderr.splitlines()
    assert words in line
