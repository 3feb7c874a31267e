"""``furiko grade --problem``: a folder of submissions, its table, its files, and what one may do to another."""

import csv
import io
import json
import subprocess
import sys
from xml.etree import ElementTree

import jsonschema
import pytest

from furiko.records.schema import FOLDER

PROBLEM = """title = "Double pendulum <b>"
system = "n-leg"
links = 2
[points]
rows = [4, 6]
[feedback]
hints = 2
[limits]
seconds = 2
"""
RIGHT = """[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -(m1+m2)*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) + m2*l1*w1^2*sin(t1-t2)"
"""
WRONG = RIGHT.replace("+ m2*l1*w1^2", "- m2*l1*w1^2")
LATEX = r"""\begin{align}
(m_1+m_2) l_1 \ddot\theta_1 + m_2 l_2 \ddot\theta_2 \cos(\theta_1-\theta_2)
  + m_2 l_2 \dot\theta_2^2 \sin(\theta_1-\theta_2) + (m_1+m_2) g \sin\theta_1 &= 0 \\
l_2 \ddot\theta_2 + l_1 \ddot\theta_1 \cos(\theta_1-\theta_2)
  SIGN l_1 \dot\theta_1^2 \sin(\theta_1-\theta_2) + g \sin\theta_2 &= 0
\end{align}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "problem.toml").write_text(PROBLEM)
    (tmp_path / "in" / "cy").mkdir(parents=True)
    (tmp_path / "in" / "ann.toml").write_text(RIGHT)
    (tmp_path / "in" / "bob.toml").write_text(WRONG)
    (tmp_path / "in" / "cy" / "answer.toml").write_text(WRONG)
    (tmp_path / "in" / "<script>.toml").write_text("[equations]\n1 = '<script>alert(1)</script>'")
    (tmp_path / "in" / "=dan.toml").write_bytes(b"\xff\xfe")
    (tmp_path / "in" / "link.toml").symlink_to(tmp_path / "in" / "ann.toml")
    return tmp_path


def furiko(folder, *arguments):
    command = [sys.executable, "-m", "furiko", "grade", "--problem", "problem.toml", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)


def test_a_folder_is_a_table_of_who_made_which_mistake(folder):
    done = furiko(folder, "in", "--out", "out")
    assert (done.returncode, done.stderr) == (1, "")
    assert "2 " in done.stdout
    assert "bob, cy" in done.stdout
    assert "1 of 6 right" in done.stdout
    document = json.loads((folder / "out" / "class.json").read_text())
    jsonschema.Draft202012Validator(json.loads((FOLDER / "class.json").read_text())).validate(document)
    outcomes = {s["who"]: (s["outcome"], s["points"]) for s in document["submissions"]}
    # row 2 has four terms and is worth 6: one that is wrong costs 1.5
    assert outcomes == {
        "ann": ("correct", 10), "bob": ("wrong", 8.5), "cy": ("wrong", 8.5), "<script>": ("not read", 0),
        "=dan": ("not read", 0), "link": ("not read", 0),
    }  # fmt: skip
    rows = {row["who"]: row for row in csv.DictReader(io.StringIO((folder / "out" / "class.csv").read_text()))}
    assert (rows["bob"]["row 1"], rows["bob"]["row 2"], rows["bob"]["points"]) == ("4", "4.5", "8.5")
    assert "'=dan" in rows  # no spreadsheet takes it for a formula
    suite = ElementTree.parse(folder / "out" / "junit.xml").getroot()[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("6", "2", "3")


def test_pages_are_inert_and_a_students_page_keeps_what_the_hints_keep(folder):
    furiko(folder, "in", "--out", "out")
    teacher = (folder / "out" / "teacher.html").read_text()
    bob = (folder / "out" / "students" / "bob.html").read_text()
    assert "the sign is wrong" in teacher
    assert "Solution" in teacher
    assert "Look at the term with" in bob
    assert "sign is wrong" not in bob
    assert "expected" not in bob
    for page in [folder / "out" / "teacher.html", *(folder / "out" / "students").iterdir()]:
        text = page.read_text()
        assert "<script" not in text
        assert "<b>" not in text
    assert len(list((folder / "out" / "students").iterdir())) == 6


def test_one_that_takes_too_long_spoils_no_other(folder):
    # a sum of many parts to the twelfth power: more work than two seconds allow, or more than is multiplied out
    parts = "+".join(f"cos({k}*t1+{k}*t2)" for k in range(1, 16))
    for k in range(3):
        long = "\n".join(f"h{j} = '({parts})*({parts})*({parts})'" for j in range(12))
        (folder / "in" / f"slow{k}.toml").write_text(f"[define]\n{long}\n[equations]\n1 = 'h1*a1 = h2*h3'\n2 = 'a2=h4'")
    document = json.loads(furiko(folder, "in", "--json").stdout)
    outcomes = {s["who"]: s["outcome"] for s in document["submissions"]}
    assert {outcomes[f"slow{k}"] for k in range(3)} <= {"not read", "not graded", "wrong"}
    assert (outcomes["ann"], outcomes["bob"]) == ("correct", "wrong")


@pytest.mark.slow
def test_one_submission_is_told_what_its_hints_allow(folder):
    done = furiko(folder, "in/bob.toml")
    assert done.returncode == 1
    assert done.stdout.splitlines() == [
        "Wrong. 8.5 of 10 points.", "Row 1: right (4 of 4).", "Row 2: wrong (4.5 of 6).",
        "  Look at the term with θ̇₁² sin(θ₁−θ₂).",
    ]  # fmt: skip
    assert furiko(folder, "in/bob.toml", "--hints", "0").stdout == "Wrong. 8.5 of 10 points.\n"
    assert furiko(folder, "in/ann.toml").returncode == 0


def test_one_alone_has_its_time_too(folder):
    """Twenty rows of twenty squared terms in each row take seconds to prove different or equal."""
    problem = PROBLEM.replace("links = 2", "links = 20").replace("seconds = 2", "seconds = 0.5")
    (folder / "problem.toml").write_text(problem.replace("rows = [4, 6]", "total = 1"))
    sums = ["+".join(f"l{j}*m{k}*a{j}*cos(t{k}-2*t{j})^2" for j in range(1, 21)) for k in range(1, 21)]
    rows = [f"{k} = '{row} = g*sin(t{k})'" for k, row in enumerate(sums, 1)]
    (folder / "in" / "long.toml").write_text("[equations]\n" + "\n".join(rows))
    done = furiko(folder, "in/long.toml")
    assert (done.returncode, done.stdout) == (3, "It could not be graded: it takes longer than 0.5 s\n")


def test_gradescope_gets_its_results(folder):
    furiko(folder, "in/bob.toml", "--gradescope", "results.json")
    results = json.loads((folder / "results.json").read_text())
    assert results["score"] == 8.5
    visible = [t for t in results["tests"] if t["visibility"] == "visible"]
    assert [(t["name"], t["score"], t["max_score"], t["status"]) for t in visible] == [
        ("row 1", 4, 4, "passed"), ("row 2", 4.5, 6, "failed")
    ]  # fmt: skip
    shown = results["output"] + "".join(t["output"] for t in visible)
    assert "sign" not in shown
    (hidden,) = [t for t in results["tests"] if t["visibility"] == "hidden"]
    assert "the sign is wrong" in hidden["output"]
    assert "Solution" not in shown
    furiko(folder, "in/<script>.toml", "--gradescope", "results.json")
    assert json.loads((folder / "results.json").read_text())["score"] == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [["nowhere.toml"], ["in/ann.toml", "in/bob.toml", "--gradescope", "r.json"], ["in", "--system", "n-leg"], []],
)
def test_bad_usage_is_one_line(folder, arguments):
    done = furiko(folder, *arguments)
    assert done.returncode == (1 if arguments == ["nowhere.toml"] else 2)
    assert len(done.stderr.splitlines()) == (0 if arguments == ["nowhere.toml"] else 1)


def test_students_hand_in_what_they_have(folder):
    """A text or a program, about the problem's mechanism; beside a TOML file it is a draft."""
    latex = LATEX
    there = folder / "texts"
    (there / "eve").mkdir(parents=True)
    (there / "fay").mkdir()
    (there / "ann.tex").write_text(latex.replace("SIGN", "-"))
    (there / "bob.md").write_text(f"My answer is\n\n$${latex.replace('SIGN', '+')}$$\n")
    (there / "README.md").write_text("Hand in until Friday.")
    (there / "picture.png").write_bytes(b"no text")
    (there / "gus.toml").symlink_to(there / "nowhere.toml")
    (there / "eve" / "answer.toml").write_text(RIGHT)
    (there / "eve" / "draft.tex").write_text(latex.replace("SIGN", "+"))
    (there / "fay" / "answer.txt").write_text("theta'' = 0")  # of one angle, where there are two
    done = furiko(folder, "texts", "--json")
    found = {s["who"]: (s["outcome"], s["points"]) for s in json.loads(done.stdout)["submissions"]}
    assert (found.pop("fay"), found.pop("gus")) == (("not read", 0), ("not read", 0))
    assert found == {"ann": ("correct", 10), "bob": ("wrong", 8.5), "eve": ("correct", 10)}
    alone = furiko(folder, "texts/bob.md")
    assert (alone.returncode, alone.stderr) == (1, "")
    assert "Row 2: wrong (4.5 of 6)" in alone.stdout
