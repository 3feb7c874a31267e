"""``furiko grade`` on the command line."""

import json
import subprocess
import sys

import pytest

# Shiki (1.9), as it stands there
RIGHT = """system = "n-leg"
links = 2
[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -m1*g*sin(t1) - m2*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) + m2*l1*w1^2*sin(t1-t2)"
"""


def grade(folder, text, *options):
    (folder / "derivation.toml").write_text(text)
    command = [sys.executable, "-m", "furiko", "grade", "derivation.toml", *options]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)


def test_a_right_derivation_is_correct(tmp_path):
    done = grade(tmp_path, RIGHT)
    assert (done.returncode, done.stdout.splitlines()[-1], done.stderr) == (0, "Correct.", "")
    assert done.stdout.startswith("Read: a chain of 2 massless rods with a point mass at the end of each")


def test_a_wrong_sign_is_named_at_its_term(tmp_path):
    done = grade(tmp_path, RIGHT.replace("+ m2*l1*w1^2", "- m2*l1*w1^2"), "--json")
    assert done.returncode == 1
    found = json.loads(done.stdout)
    assert found["verdict"] == "wrong"
    (finding,) = found["findings"]
    assert (finding["equation"], finding["term"], finding["cause"]) == ("1.10", "B[2,1]", "sign")


def test_it_says_so_in_japanese(tmp_path):
    assert "正しい" in grade(tmp_path, RIGHT, "--japanese").stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    "text", ["", "system = 1", RIGHT.replace("cos", "__import__"), RIGHT.replace("l1*a1", "l1*(a1", 1)]
)
def test_bad_input_is_one_clear_line(tmp_path, text):
    done = grade(tmp_path, text)
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert "derivation.toml" in line


@pytest.mark.slow
def test_a_pinned_problem_is_not_the_files_to_change(tmp_path):
    done = grade(tmp_path, RIGHT, "--system", "rod-chain")
    assert (done.returncode, done.stdout) == (2, "")
    assert "the problem is 'rod-chain'" in done.stderr
    upwards = RIGHT.replace("-m1*g", "m1*g").replace("- m2*g", "+ m2*g").replace("-m2*g", "m2*g")
    assert grade(tmp_path, upwards).returncode == 0
    assert grade(tmp_path, upwards, "--system", "n-leg", "--links", "2").returncode == 1
    assert grade(tmp_path, RIGHT, "--system", "n-leg", "--links", "2").returncode == 0
