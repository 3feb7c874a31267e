"""Scenes of open mechanisms on the command line and in the reports."""

import json

import mujoco
import pytest

from furiko.cli.main import run as cli_run
from furiko.models import find_scene
from furiko.records.check import SceneEntry
from furiko.reference.outline import outline
from furiko.reports.pages.mechanism_drawing import draw_mechanism
from furiko.run import check


def run(*arguments):
    return cli_run(list(arguments))


def test_scenes_lists_them(capsys):
    assert run("scenes", "--json") == 0
    rows = {row["name"]: row for row in json.loads(capsys.readouterr().out)}
    assert (rows["quadruped"]["system"], rows["quadruped"]["n"]) == ("tree", 18)


def test_export_writes_what_engines_read(capsys, tmp_path):
    assert run("export", "humanoid", "--mjcf") == 0
    model = mujoco.MjModel.from_xml_string(capsys.readouterr().out)
    system = find_scene("humanoid").system
    assert (model.nq, model.nv) == (system.nq, system.n)
    assert model.body_mass.sum() == pytest.approx(sum(link.mass for link in system.links))
    assert run("export", "humanoid", "--urdf") == 2
    assert "URDF cannot say it" in capsys.readouterr().err
    assert run("export", "humanoid", "--mjcf", "--urdf", "--out", str(tmp_path / "both")) == 2
    assert not (tmp_path / "both").exists(), "one of two would be half an answer"


@pytest.mark.parametrize("what", [("bench", "--sharpness", "hopper"), ("bench", "--skips", "hopper")])
def test_what_takes_documents_alone_says_so(what, capsys, tmp_path):
    assert run(*what, "--out", str(tmp_path)) == 2
    assert "takes the documents' mechanisms, not a tree" in capsys.readouterr().err


def test_bench_times_the_accelerations_of_a_tree(capsys, tmp_path):
    assert run("bench", "cart-pole", "-e", "mujoco", "--budget", "1", "--out", str(tmp_path)) == 0
    assert "accelerations, cart-pole, 2 degrees of freedom" in capsys.readouterr().out
    rows = json.loads((tmp_path / "bench.json").read_text(encoding="utf-8"))["speeds"]
    assert {(row["scene"], row["states"]) for row in rows} == {("cart-pole", 1), ("cart-pole", 64)}
    assert all(row["error"] < 1e-13 for row in rows)
    assert "cart-pole, 2 degrees of freedom" in (tmp_path / "bench.html").read_text(encoding="utf-8")


def test_a_check_of_a_tree_is_reported_with_its_joints_and_drawn(tmp_path):
    report = check(["hopper"], ["mujoco", "pinocchio-aba"], out=tmp_path, use_cache=False, jobs=1)
    assert {result.outcome for result in report.results} == {"agrees", "skipped"}
    entry = report.header.scenes[0]
    assert (entry.system, entry.n, len(entry.masses)) == ("tree", 6, 4)
    assert entry.joints[:2] == ["forward (slide)", "upward (slide)"]
    assert entry.states == 24
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "tree of links, 6 degrees of freedom" in page
    assert "leg (slide)" in page
    assert '"drawing":[' in page


def test_an_outline_is_where_the_links_are():
    """A pole of 0.62 m (its centre at 0.31) that leans by a right angle lies along x at the cart's height."""
    system = find_scene("cart-pole").system
    lines = outline(system.mechanism(), [1.0, 1.5707963267948966])
    assert lines[0] == pytest.approx((1.0, 0.0, 1.0, 0.05))
    assert lines[1] == pytest.approx((1.0, 0.05, 1.31, 0.05))
    entry = SceneEntry(name="x", system="tree", n=2, lengths=[], masses=[], gravity=0.0, outline=lines)
    drawing = draw_mechanism(entry)
    assert len(drawing.lines) == 2
    assert drawing.lines[1][1] == pytest.approx(drawing.lines[1][3])  # level
