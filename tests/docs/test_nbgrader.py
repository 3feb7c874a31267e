"""The nbgrader example on a right, a wrong and an unreadable submission."""

import csv
import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

HOWTO = Path(__file__).parent.parent.parent / "docs" / "howto"
SOURCE = HOWTO / "nbgrader" / "source" / "pendulum" / "derivation.ipynb"
SIGN = ("+ m2*l1*w1^2", "- m2*l1*w1^2")  # one of the four terms of a row that is worth 6
CHANGES = {"right": (("", ""), 10), "wrong": (SIGN, 8.5), "unreadable": (("m2*l2*a2 +", "m2*(l2*a2 +"), 0)}


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
