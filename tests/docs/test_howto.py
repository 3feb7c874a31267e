"""The how-to for a class, run as it stands; the nbgrader example on a right, a wrong and an unreadable submission."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from furiko.cli.main import run

HOWTO = Path(__file__).parent.parent.parent / "docs" / "howto"
BLOCK = re.compile(r"^```(toml|console|python)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SOURCE = HOWTO / "nbgrader" / "source" / "pendulum" / "derivation.ipynb"
SIGN = ("+ m2*l1*w1^2", "- m2*l1*w1^2")  # one of the four terms of a row that is worth 6
CHANGES = {"right": (("", ""), 10), "wrong": (SIGN, 8.5), "unreadable": (("m2*l2*a2 +", "m2*(l2*a2 +"), 0)}


@pytest.mark.slow
def test_the_tutorial_adapter_conforms_as_shown(tmp_path, monkeypatch):
    pytest.importorskip("mujoco")
    monkeypatch.chdir(tmp_path)
    blocks = dict(BLOCK.findall((HOWTO / "add-an-engine.md").read_text(encoding="utf-8")))
    code = blocks["python"]
    assert len(code.splitlines()) < 40
    Path("my_engine.py").write_text(code, encoding="utf-8")
    command, *expected = blocks["console"].splitlines()
    assert ran(command) == [without_digits(line) for line in expected]
    Path("my_engine.py").write_text(code.replace("self.coordinates.absolute(found)", "found"), encoding="utf-8")
    text = (HOWTO / "add-an-engine.md").read_text(encoding="utf-8")
    wrong = ran(command)[7:9]
    assert all(line in without_digits(text) for line in wrong), wrong
    assert "relative values are used as absolute ones" in wrong[0]


def ran(command):
    words = command.removeprefix("$ furiko ").split()
    done = subprocess.run(
        [sys.executable, "-m", "furiko", *words], capture_output=True, text=True, encoding="utf-8", check=False
    )
    assert done.stderr == ""
    return [without_digits(line.rstrip()) for line in done.stdout.splitlines()]


def without_digits(text):
    """Rounding depends on the engine's build: its size is not compared."""
    return re.sub(r"off by [0-9.e-]+", "off by …", text)


@pytest.mark.slow
def test_the_howto_of_own_equations_ends_as_it_says(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = (HOWTO / "my-equations-my-robot.md").read_text(encoding="utf-8")
    ((_, model),) = re.findall(r"^```(xml)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    mine, command, declared = (block for _, block in BLOCK.findall(text))
    Path("cart-pole.xml").write_text(model.partition("\n")[2], encoding="utf-8")  # a remark cannot come first
    Path("mine.toml").write_text(mine, encoding="utf-8")
    words, says = command.removeprefix("$ furiko ").splitlines()
    assert run([*words.split(), "--profile", "smoke", "--no-cache"]) == 1
    assert says in " ".join(capsys.readouterr().out.split())
    # The same derivation, with the angle counted as the snippet on angles has it: gravity would have to be reversed.
    right = mine.replace("+ m*l*theta'^2", "- m*l*theta'^2").replace("- m*g*l", "+ m*g*l")
    Path("mine.toml").write_text(declared + right, encoding="utf-8")
    assert run(["check", "mine.toml", "-e", "own equations", "--profile", "smoke", "--no-cache"]) == 0


def handed_in(change):
    notebook = json.loads(SOURCE.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        cell["source"] = [line.replace(*change) if change[0] else line for line in cell["source"]]
    return notebook


@pytest.mark.parametrize(("change", "points"), CHANGES.values(), ids=CHANGES)
def test_the_cells_of_the_notebook_give_points(change, points, capsys):
    """As nbgrader has it: a cell that raises has no points, and the number it ends in is its points."""
    names: dict = {}
    cells = ["".join(cell["source"]) for cell in handed_in(change)["cells"] if cell["cell_type"] == "code"]
    exec(cells[0], names)
    last = cells[1].splitlines()
    if points == 0:
        with pytest.raises(ValueError, match="missing"):
            exec(cells[1], names)
        return
    exec("\n".join(last[:-1]), names)
    assert eval(last[-1], names) == points
    assert json.loads(SOURCE.read_text())["cells"][2]["metadata"]["nbgrader"]["points"] == 10


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("nbgrader") is None, reason="nbgrader is not installed")
def test_nbgrader_grades_the_example(tmp_path):
    course = tmp_path / "course"
    shutil.copytree(HOWTO / "nbgrader", course)

    def nbgrader(*words):
        done = subprocess.run(
            ["nbgrader", *words], cwd=course, capture_output=True, text=True, check=False, env=dict(os.environ)
        )
        assert done.returncode == 0, done.stderr

    nbgrader("generate_assignment", "pendulum", "--create")
    released = (course / "release" / "pendulum" / "derivation.ipynb").read_text()
    assert "m2*l2*a2" not in released
    for who, (change, _) in CHANGES.items():
        notebook = json.loads(released)
        solution = handed_in(change)["cells"][1]["source"]
        for cell in notebook["cells"]:
            if cell["metadata"].get("nbgrader", {}).get("grade_id") == "derivation":
                cell["source"] = solution
        folder = course / "submitted" / who / "pendulum"
        folder.mkdir(parents=True)
        (folder / "derivation.ipynb").write_text(json.dumps(notebook))
    nbgrader("autograde", "pendulum", "--create")
    nbgrader("export")
    rows = {
        row["student_id"]: float(row["score"])
        for row in csv.DictReader((course / "grades.csv").read_text().splitlines())
    }
    assert rows == {who: points for who, (_, points) in CHANGES.items()}
