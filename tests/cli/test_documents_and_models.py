"""``furiko audit``, ``lesson``, ``diagnose`` and ``grade --callable`` on the command line."""

import json
import subprocess
import sys

import pytest

import furiko


def run(folder, *arguments):
    command = [sys.executable, "-m", "furiko", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)


@pytest.mark.slow
def test_audit_judges_all_57_equations(tmp_path):
    found = json.loads(run(tmp_path, "audit", "--json").stdout)
    judged = {(entry["document"], entry["number"]): entry["judgement"] for entry in found["equations"]}
    assert len(found["equations"]) == len(judged) == 57
    # Read in the documents themselves: l₂ for l₃, a missing l₁², an index that nothing binds.
    misprints = {key for key, judgement in judged.items() if judgement == "misprint"}
    assert misprints == {("shiki", "2.1"), ("shiki", "3.4"), ("takeno", "12")}
    assert {judged["shiki", "3.12"], judged["takeno", "22"], judged["takeno", "19"]} == {"holds"}
    assert found["slips"]


@pytest.mark.slow
def test_lesson_is_one_page_that_fetches_nothing(tmp_path):
    done = run(tmp_path, "lesson")
    assert done.returncode == 0, done
    page = (tmp_path / "furiko-lesson.html").read_text()
    for attribute in ('src="http', 'href="http', "@import", "url(http"):
        assert attribute not in page
    assert "間違" in page or "誤り" in page


@pytest.mark.slow
def test_a_lesson_that_cannot_be_written_is_one_clear_line(tmp_path):
    done = run(tmp_path, "lesson", "--out", "no/such/folder/lesson.html")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "furiko: no/such/folder/lesson.html: cannot be written: No such file or directory\n"


def test_diagnose_agrees_with_a_model_that_furiko_wrote(tmp_path):
    (tmp_path / "model.xml").write_text(furiko.to_mjcf(furiko.RodChain([1.0, 0.5])))
    done = run(tmp_path, "diagnose", "model.xml", "--json")
    found = json.loads(done.stdout)
    assert (done.returncode, found["verdict"], found["findings"]) == (0, "agrees", [])
    assert len(found["engines"]) >= 3


@pytest.mark.slow
def test_diagnose_names_an_armature(tmp_path):
    clean = furiko.to_mjcf(furiko.RodChain([1.0, 0.5]))
    (tmp_path / "clean.xml").write_text(clean)
    (tmp_path / "model.xml").write_text(clean.replace('name="hinge2"', 'name="hinge2" armature="0.01"'))
    done = run(tmp_path, "diagnose", "model.xml", "--against", "clean.xml", "--json")
    found = json.loads(done.stdout)
    assert done.returncode == 1
    assert found["findings"][0]["cause"] == "armature"
    assert "0.01" in found["findings"][0]["says"]
    alone = run(tmp_path, "diagnose", "model.xml", "--json")  # the file says so itself, and engines do as it says
    assert alone.returncode == 0
    assert any("armature" in note for note in json.loads(alone.stdout)["notes"])


@pytest.mark.slow
def test_of_several_files_a_bad_one_does_not_spoil_the_others(tmp_path):
    link = '<inertial pos="0 0 -1" mass="{}" diaginertia="1 1 1"/>'
    body = f'<body name="a"><joint name="j" axis="0 1 0"/>{link.format(1)}</body>'
    (tmp_path / "good.xml").write_text(f"<mujoco><worldbody>{body}</worldbody></mujoco>")
    (tmp_path / "bad.xml").write_text("<mujoco><worldbody>")
    two = body + body.replace('"a"', '"b"').replace('"j"', '"k"')  # Pinocchio reads the first body of the world
    (tmp_path / "two.xml").write_text(f"<mujoco><worldbody>{two}</worldbody></mujoco>")
    engines = ("-e", "mujoco", "-e", "pinocchio-aba")
    done = run(tmp_path, "diagnose", "bad.xml", "good.xml", "two.xml", *engines)
    first, second, third = done.stdout.splitlines()
    assert first == "good.xml: agrees: mujoco and pinocchio-aba do what the file says"
    assert second.startswith("two.xml: differs: ")
    assert third.startswith("  first-root-only: ")
    assert (done.returncode, [line.startswith("furiko: bad.xml") for line in done.stderr.splitlines()]) == (1, [True])
    as_json = run(tmp_path, "diagnose", "two.xml", "good.xml", *engines, "--json")
    models = json.loads(as_json.stdout)["models"]
    assert (as_json.returncode, [(m["model"], m["status"]) for m in models]) == (1, [("two.xml", 1), ("good.xml", 0)])
    alone = json.loads(run(tmp_path, "diagnose", "good.xml", *engines, "--json").stdout)
    assert models[1]["diagnosis"] == alone


def test_a_page_of_several_files_is_bad_usage(tmp_path):
    done = run(tmp_path, "diagnose", "a.xml", "b.xml", "--out", "page.html")
    assert (done.returncode, done.stderr) == (2, "furiko: --out is for one MODEL, 2 are given\n")


ENTITY = '<!DOCTYPE x [<!ENTITY a "b">]><mujoco>&a;</mujoco>'


@pytest.mark.parametrize("text", ["", "<mujoco>", "<robot/>", "hello", ENTITY])
def test_a_bad_model_file_is_one_clear_line(tmp_path, text):
    (tmp_path / "model.xml").write_text(text)
    done = run(tmp_path, "diagnose", "model.xml")
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert "model.xml" in line


@pytest.mark.slow
def test_a_trusted_function_is_graded_from_what_it_gives(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from math import sin\n"
        "def right(theta, omega, parameters):\n"
        "    return [-1.5 * parameters.gravity / parameters.lengths[0] * sin(theta[0])]\n"
        "def wrong(theta, omega, parameters):\n"
        "    return [-parameters.gravity / parameters.lengths[0] * sin(theta[0])]\n"
    )
    options = ("--system", "rod-chain", "--links", "1", "--json")
    right = json.loads(run(tmp_path, "grade", "--callable", "mine:right", *options).stdout)
    wrong = json.loads(run(tmp_path, "grade", "--callable", "mine:wrong", *options).stdout)
    assert (right["verdict"], wrong["verdict"]) == ("correct", "wrong")
    missing = run(tmp_path, "grade", "--callable", "mine:other", *options)
    assert missing.returncode == 2
    assert len(missing.stderr.splitlines()) == 1
