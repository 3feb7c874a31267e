# ruff: noqa: E501 -- equations stand on one line
"""A user's list of equations, judged entry by entry."""

import json

import pytest

from furiko.cli.main import run
from furiko.derivations.audit.audit_file import audit_entries, audit_file
from furiko.derivations.audit.prose import of_file
from furiko.models import InvalidInput

# The double pendulum as textbooks have it; (3) has the wrong sign of the squared rate, (4) is right for rods of one
# line density alone, and (5) is the equation of one row, without the other.
NOTES = """
title = "Lecture notes"
system = "double-pendulum"

[[entry]]
number = "(1)"
says = "the Lagrangian"
lagrangian = "m1*l1^2*w1^2/2 + m2*(l1^2*w1^2 + l2^2*w2^2 + 2*l1*l2*w1*w2*cos(t1-t2))/2 + (m1+m2)*g*l1*cos(t1) + m2*g*l2*cos(t2)"

[[entry]]
number = "(2)"
equations = [
  "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0",
  "l2*a2 + l1*a1*cos(t1-t2) - l1*w1^2*sin(t1-t2) + g*sin(t2) = 0",
]

[[entry]]
number = "(3)"
says = "the second row"
equations = ["l2*a2 + l1*a1*cos(t1-t2) + l1*w1^2*sin(t1-t2) + g*sin(t2) = 0"]

[[entry]]
number = "(4)"
system = "simple-pendulum"
equations = ["l*a1 = g*sin(t1)"]

[[entry]]
equations = ["l2*a2 + l1*a1*cos(t1-t2) - l1*w1^2*sin(t1-t2) + g*sin(t2) = 0"]
"""


@pytest.fixture
def notes(tmp_path):
    path = tmp_path / "notes.toml"
    path.write_text(NOTES, encoding="utf-8")
    return path


def test_each_entry_is_judged_by_itself(notes):
    found = audit_file(notes)
    assert [(e.number, e.judgement) for e in found.entries] == [
        ("(1)", "holds"), ("(2)", "holds"), ("(3)", "wrong"), ("(4)", "holds-if"), ("(5)", "holds"),
    ]  # fmt: skip
    assert "sign" in " ".join(found.entries[2].told)
    assert found.entries[3].told == ("Right if angles are measured from the upward vertical.",)
    assert found.exit_status == 1
    assert "項目" in of_file(found, "ja").text()


def test_the_command_writes_a_page_and_json(notes, capsys, tmp_path):
    assert run(["audit", str(notes), "--out", str(tmp_path / "page.html"), "--lang", "ja"]) == 1
    assert "Lecture notes" in capsys.readouterr().out
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert '<html lang="ja">' in page
    assert "<td>(3)</td>" in page
    assert run(["audit", str(notes), "--json"]) == 1
    assert [e["judgement"] for e in json.loads(capsys.readouterr().out)["entries"]].count("wrong") == 1


# One bob from the downward vertical, first principles: T = m l² ω²/2, U = -m g l cos θ, H = p²/(2 m l²) + U.
BOB = "m*l^2*w1^2/2 + m*g*l*cos(t1)"


@pytest.mark.parametrize(
    ("entry", "judgement"),
    [
        ({"lagrangian": BOB, "kinetic": "m*l^2*w1^2/2"}, "holds"),
        ({"lagrangian": BOB, "kinetic": "m*l^2*w1^2"}, "wrong"),
        ({"lagrangian": BOB, "potential": "m*g*l*cos(t1)"}, "wrong"),
        ({"equations": ["l*a1 = -g*sin(t1)"], "solved": ["a1 = g/l*sin(t1)"]}, "wrong"),
        ({"hamiltonian": "p^2/(2*m*l^2) - m*g*l*cos(t1)"}, "holds"),
        ({"hamiltonian": "p^2/(m*l^2) - m*g*l*cos(t1)"}, "wrong"),
    ],
)  # fmt: skip
def test_an_entry_is_judged_by_all_that_it_states_and_in_every_form(entry, judgement):
    found = audit_entries({"system": "simple-pendulum", "from": "down", "entry": [entry]}, "notes")
    assert found.entries[0].judgement == judgement
    assert bool(found.entries[0].told) == (judgement == "wrong")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("title = 'x'", "entry: from 1 to 200"),
        ("entry = [1]", "entry 1: a table is needed"),
        ("system='double-pendulum'\n[[entry]]\nequations=['a1 = (']", r"entry \(1\): equations.1: column"),
        ("system='double-pendulum'\n[[entry]]\nequation=['a1 = 0']", "no such field"),
    ],
)
def test_what_cannot_be_read_is_refused_with_its_entry(text, says, tmp_path):
    path = tmp_path / "notes.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInput, match=says):
        audit_file(path)
