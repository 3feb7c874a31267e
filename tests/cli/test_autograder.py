"""The zip for Gradescope, unpacked and run as its documentation says; and grading where engines are not installed."""

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from furiko.cli.main import run

PROBLEM = 'title = "T"\nsystem = "n-leg"\nlinks = 2\n[points]\nrows = [4, 6]\n'
RIGHT = """[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -(m1+m2)*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) + m2*l1*w1^2*sin(t1-t2)"
"""
WRONG = RIGHT.replace("+ m2*l1*w1^2", "- m2*l1*w1^2")
BLOCKED = ("mujoco", "pinocchio", "exudyn", "pydrake", "scipy", "numba", "llvmlite", "heyoka", "sympy")
BLOCK = f"""
import sys
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {BLOCKED}:
            raise ImportError(name + " is blocked")
sys.meta_path.insert(0, Blocked())
"""


@pytest.fixture
def without_engines(tmp_path):
    """An environment whose Python processes, children too, cannot import what grading must not need."""
    (tmp_path / "block").mkdir()
    (tmp_path / "block" / "sitecustomize.py").write_text(BLOCK)
    environment = dict(os.environ)
    environment["PYTHONPATH"] = os.pathsep.join([str(tmp_path / "block"), environment.get("PYTHONPATH", "")])
    return environment


@pytest.fixture
def autograder(tmp_path):
    """/autograder as Gradescope makes it, inside a temporary root: source unpacked, run_autograder copied, set up."""
    (tmp_path / "problem.toml").write_text(PROBLEM)
    assert run(["grade", "--problem", str(tmp_path / "problem.toml"), "--autograder", str(tmp_path / "a.zip")]) == 0
    root = tmp_path / "autograder"
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        archive.extractall(root / "source")
        assert {"setup.sh", "run_autograder"} <= set(archive.namelist())  # at the root, not in a folder
        assert archive.getinfo("run_autograder").external_attr >> 16 == 0o755
    shutil.copy(root / "source" / "run_autograder", root / "run_autograder")
    (root / "run_autograder").chmod(0o755)
    (root / "submission").mkdir()
    (root / "results").mkdir()
    return root


@pytest.mark.slow
@pytest.mark.parametrize(
    ("files", "score", "says"),
    [
        ({"mine.toml": RIGHT}, 10, "Right."),
        ({"mine.toml": WRONG}, 8.5, "the sign is wrong"),  # one of four terms of a row that is worth 6
        ({"mine.toml": "[equations]\n1 = 'l1*(a1 = 0'"}, 0, "could not be read"),
        ({"mine.toml": 'system = "rods"\n' + RIGHT}, 0, "cannot change it"),
        ({}, 0, "hand in one file"),
        ({"a.toml": RIGHT, "b.toml": RIGHT}, 0, "here are 2"),
        ({"mine.toml": RIGHT, "problem.toml": "points = 99"}, 0, "here are 2"),
    ],
)
def test_gradescope_runs_it(autograder, without_engines, files, score, says):
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**without_engines, "PATH": path}
    environment["PYTHONPATH"] = environment["PYTHONPATH"].split(os.pathsep)[0]  # furiko comes from the zip alone
    subprocess.run(["bash", "source/setup.sh"], cwd=autograder, env=environment, check=True)
    for name, text in files.items():
        (autograder / "submission" / name).write_text(text)
    done = subprocess.run(["./run_autograder"], cwd=autograder, env=environment, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    results = json.loads((autograder / "results" / "results.json").read_text())
    assert results["score"] == score
    assert says in results["output"]
    for test in results["tests"]:
        assert test["score"] <= test["max_score"]
        assert test["visibility"] in ("visible", "hidden")


@pytest.mark.slow
def test_grading_needs_no_engine_scipy_or_numba(tmp_path, without_engines):
    (tmp_path / "in").mkdir()
    (tmp_path / "problem.toml").write_text(PROBLEM)
    (tmp_path / "in" / "ann.toml").write_text('system = "n-leg"\nlinks = 2\n' + RIGHT)
    (tmp_path / "in" / "bob.toml").write_text('system = "n-leg"\nlinks = 2\n' + WRONG)

    def furiko(*arguments):
        command = [sys.executable, "-m", "furiko", "grade", *arguments]
        return subprocess.run(command, cwd=tmp_path, env=without_engines, capture_output=True, text=True, check=False)

    assert furiko("in/ann.toml").returncode == 0
    assert "the sign is wrong" in furiko("in/bob.toml").stdout
    whole = furiko("--problem", "problem.toml", "in", "--out", "out")
    assert (whole.returncode, whole.stderr) == (1, "")
    assert "1 of 2 right" in whole.stdout
    blocked = subprocess.run(
        [sys.executable, "-c", "import scipy"], env=without_engines, capture_output=True, text=True, check=False
    )
    assert "is blocked" in blocked.stderr
