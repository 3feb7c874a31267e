"""``furiko diagnose --fix``: whether all engines read what was written alike is measured, and said."""

import json

import pytest
from click import UsageError
from click.testing import CliRunner

from furiko.cli.diagnose import diagnose
from furiko.engines import engine_version
from furiko.models.errors import InvalidInput

INERTIAL = '<inertial pos="0.1 0 -0.4" mass="1.5" diaginertia="0.1 0.2 0.25"/>'
HINGE = f'<body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}</body>'
# What the engines do not agree on is no fault of how it is written: a ball's damper, and a link without a mass.
BALL = f'<body name="a"><joint name="j" type="ball" damping="0.3"/>{INERTIAL}</body>'
DRIVEN = f"""<body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}<body name="tool">
<joint name="k" axis="1 0 0" armature="0.1"/></body></body>"""
SHOWN = f'<body name="a"><joint name="j" axis="0 1 0" ref="0.2"/><joint name="k" axis="1 0 0"/>{INERTIAL}</body>'
WEIGHTLESS = """<robot name="r"><link name="world"/><link name="a"><inertial><origin xyz="0 0 -1"/><mass value="1"/>
<inertia ixx=".1" iyy=".12" izz=".14" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="tool"/>
<joint name="j" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint>
<joint name="k" type="continuous"><parent link="a"/><child link="tool"/><axis xyz="1 0 0"/></joint></robot>"""

BETWEEN = WEIGHTLESS.replace(
    "</robot>",
    """<link name="hand"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1"
izz=".1" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="l" type="continuous"><parent link="tool"/>
<child link="hand"/><axis xyz="0 0 1"/></joint></robot>""",
)

ENGINES = pytest.mark.skipif(not (engine_version("mujoco") and engine_version("pinocchio-aba")), reason="two engines")
SLOW = pytest.mark.slow  # engines are asked in processes of their own, twice


def fixed(tmp_path, text, *options, name="model.xml"):
    path, out = tmp_path / name, tmp_path / "fixed.xml"
    path.write_text(f"<mujoco><worldbody>{text}</worldbody></mujoco>" if name.endswith("xml") else text)
    found = CliRunner().invoke(diagnose, [str(path), "--fix", str(out), *options], standalone_mode=False)
    return found.return_value, found.stdout, str(out)


@SLOW
@ENGINES
def test_a_file_that_all_read_alike_is_said_to_be_one(tmp_path):
    status, text, out = fixed(tmp_path, HINGE)
    assert (status, f"  written: {out}\n" in text) == (0, True)
    status, text, out = fixed(tmp_path, HINGE, "--json")
    assert json.loads(text)["fix"] == {"path": out, "agrees": True, "why": []}


@SLOW
@ENGINES
def test_what_weighs_nothing_between_two_joints_is_written_so_that_mujoco_takes_it(tmp_path):
    """In the file it is a link of its own, which MuJoCo refuses; in what is written the joints are one body's."""
    status, text, _ = fixed(tmp_path, BETWEEN, "--json", name="model.urdf")
    found = json.loads(text)
    assert (status, found["engines"]["mujoco"]["status"], found["fix"]["agrees"]) == (1, "refused", True)
    assert any("is left out, and that has its joints: 'tool'" in note for note in found["notes"])


@SLOW
@ENGINES
def test_what_weighs_nothing_at_an_end_is_fixed_there(tmp_path):
    """MuJoCo refuses the file; nothing says how its last link moves."""
    status, text, _ = fixed(tmp_path, WEIGHTLESS, "--json", name="model.urdf")
    found = json.loads(text)
    assert (status, found["engines"]["mujoco"]["status"], found["fix"]["agrees"]) == (1, "refused", True)
    assert any("is fixed where it is" in note and note.endswith("'k'") for note in found["notes"])


@SLOW
@ENGINES
def test_a_misreading_that_is_mended_leaves_the_files_own_status(tmp_path):
    """Pinocchio ignores the ref of the first of several joints: the model differs, and what is written does not."""
    status, text, _ = fixed(tmp_path, SHOWN, "--json")
    found = json.loads(text)
    assert (status, found["verdict"], found["fix"]["agrees"]) == (1, "differs", True)
    assert "alike" not in found["headline"]


@SLOW
@ENGINES
@pytest.mark.parametrize(
    ("text", "name", "says"),
    [
        (BALL, "model.xml", "pinocchio-aba drops damping and dry friction of free and ball joints: joint 'j'"),
        (DRIVEN, "model.xml", "mujoco refuses"),
    ],
)
def test_a_file_that_cannot_agree_is_said_not_to(tmp_path, text, name, says):
    status, printed, out = fixed(tmp_path, text, "--json", name=name)
    found = json.loads(printed)
    assert status == 1
    assert found["headline"].endswith(f"not all engines read {out}, which was written, alike")
    assert found["fix"]["agrees"] is False
    assert found["fix"]["why"][0].startswith(says)
    status, printed, out = fixed(tmp_path, text, name=name)
    assert f"  written: {out}, which not all engines read alike\n      {says}" in printed


def test_the_status_is_that_of_the_file_that_was_written_where_the_model_itself_is_read_alike(tmp_path):
    """MuJoCo alone reads the model alike; an engine that is named has to read what was written, too."""
    status, text, _ = fixed(tmp_path, BALL, "-e", "mujoco", "--json")
    assert (status, json.loads(text)["fix"]["agrees"]) == (0, True)


@pytest.mark.parametrize("option", ["--fix", "--out"])
@pytest.mark.parametrize(
    ("place", "says"),
    [
        ("missing/out.xml", "missing/out.xml: cannot be written: No such file or directory"),
        ("model.xml/out.xml", "model.xml/out.xml: cannot be written: Not a directory"),
        ("model.xml", "model.xml: this is the file itself, which is not overwritten"),
        ("./linked/model.xml", "model.xml: this is the file itself, which is not overwritten"),
        ("hard.xml", "hard.xml: this is the file itself, which is not overwritten"),
    ],
)
def test_what_cannot_be_written_is_said_before_any_engine_is_asked(tmp_path, monkeypatch, option, place, says):
    def asked(*_, **__):
        raise AssertionError("the file was looked at first")

    monkeypatch.setattr("furiko.cli.diagnose._read", asked)
    path = tmp_path / "model.xml"
    path.write_text(f"<mujoco><worldbody>{HINGE}</worldbody></mujoco>")
    (tmp_path / "linked").symlink_to(tmp_path)
    (tmp_path / "hard.xml").hardlink_to(path)
    content = path.read_bytes()
    with pytest.raises(InvalidInput) as raised:
        CliRunner().invoke(
            diagnose, [str(path), option, str(tmp_path / place)], standalone_mode=False, catch_exceptions=False
        )
    assert says in str(raised.value)
    assert path.read_bytes() == content


def test_a_page_and_a_model_in_one_file_are_refused(tmp_path):
    path, out = tmp_path / "model.xml", tmp_path / "out.xml"
    path.write_text(f"<mujoco><worldbody>{HINGE}</worldbody></mujoco>")
    with pytest.raises(UsageError, match="--fix and --out are both"):
        CliRunner().invoke(
            diagnose,
            [str(path), "--fix", str(out), "--out", f"{tmp_path}/./out.xml"],
            standalone_mode=False,
            catch_exceptions=False,
        )
    assert not out.exists()
