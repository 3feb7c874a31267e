"""A user's own equations against a model file and engines: which of the three is alone, and why."""

import json
from unicodedata import normalize

import pytest

from furiko.cli.main import run as cli_run
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models import InvalidInput
from furiko.reports.pages.check_page import to_html
from furiko.run import check

MODEL = """
<mujoco>
  <worldbody>
    <body name="cart">
      <joint name="slider" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
      <body name="pole">
        <joint name="hinge" axis="0 1 0"/>
        <inertial pos="0 0 0.5" mass="0.2" diaginertia="0.02 0.02 0.001"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
URDF = """
<robot name="cart-pole">
  <link name="rail"/>
  <link name="cart"><inertial><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="pole"><inertial><origin xyz="0 0 0.5"/><mass value="0.2"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slider" type="prismatic"><parent link="rail"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="9" velocity="9"/></joint>
  <joint name="hinge" type="continuous"><parent link="cart"/><child link="pole"/><axis xyz="0 1 0"/></joint>
</robot>
"""
# The same mass of the pole from a geom that touches nothing, which one of the engines does not weigh.
GEOM = MODEL.replace(
    '<inertial pos="0 0 0.5" mass="0.2" diaginertia="0.02 0.02 0.001"/>',
    '<geom type="box" size="0.1 0.1 0.5" pos="0 0 0.5" mass="0.2" contype="0" conaffinity="0"/>',
)
MINE = """
model = "cart-pole.xml"
[samples]
random = 2
[symbols]
x = "slider"
theta = "hinge"
M = 1.0
m = 0.2
l = 0.5
[equations]
1 = "(M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = 0"
2 = "(I2 + m*l^2)*theta'' + m*l*x''*cos(theta) - m*g*l*sin(theta) = 0"
"""


WRONG = MINE.replace("- m*l*theta'^2", "+ m*l*theta'^2")
SCENES = {  # model file and equations of each
    "mine": ("cart-pole.xml", MODEL, MINE),
    "urdf": ("cart-pole.urdf", URDF, MINE),
    "wrong": ("cart-pole.xml", MODEL, WRONG),
    "heavy": ("heavy.xml", MODEL.replace('mass="0.2"', 'mass="0.3"'), MINE),
    "geom": ("geom.xml", GEOM, MINE),
}


def judged(folder, scenes, engines):
    for name in scenes:
        file, model, mine = SCENES[name]
        (folder / file).write_text(model, encoding="utf-8")
        (folder / f"{name}.toml").write_text(mine.replace("cart-pole.xml", file), encoding="utf-8")
    paths = [folder / f"{name}.toml" for name in scenes]
    return check(paths, list(engines), use_cache=False, jobs=1, out=folder / "out")


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """All scenes in one run, since starting the engines takes longest."""
    return judged(tmp_path_factory.mktemp("own"), SCENES, ("mujoco", "pinocchio-aba"))


def alone_in(report, scene):
    return next(alone for alone in report.alone if alone.scene == scene)


def results(report, scene, outcome):
    return [r for r in report.results if (r.scene, r.outcome) == (scene, outcome)]


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["mine", "urdf"])
def test_right_equations_of_a_file_agree_with_every_engine_that_reads_it(report, scene):
    alone = alone_in(report, scene)
    assert (alone.who, alone.says) == (
        "nobody",
        f"{scene}: your equations, the theory of the model and 2 engines agree.",
    )
    own = [r.check for r in results(report, scene, "agrees") if r.engine == "own equations"]
    assert own == ["accelerations", "terms M", "terms bias", "terms G"]
    read = [r.engine for r in results(report, scene, "agrees") if r.check == "model fields"]
    assert sorted(read) == ["mujoco", "pinocchio-aba"]


def test_how_the_equations_were_read_is_told(report):
    said = report.scene("mine").own
    assert said[0] == "x is joint 'slider', theta is joint 'hinge'"
    assert said[2] == (
        "taken from the model: I2 = 0.02 kg m², the moment of inertia about the centre of mass of 'pole'"
    )
    assert normalize("NFC", said[3]) == "1: (M + m) ẍ + m l θ̈ cos θ − m l θ̇² sin θ = 0"
    assert "x is joint" in to_html(report)


def test_wrong_equations_are_alone(report):
    alone = alone_in(report, "wrong")
    assert (alone.who, alone.says) == (
        "equations",
        "wrong: your equations are alone: the theory of the model and 2 engines agree. "
        "Why: Row 1, the term with theta'² sin(theta): the sign is wrong.",
    )
    wrong = {r.check: r.cause for r in results(report, "wrong", "differs")}
    assert wrong == {"accelerations": "sign", "terms bias": "sign"}
    assert report.exit_status == 1


def test_a_model_of_another_mechanism_is_alone(report):
    alone = alone_in(report, "heavy")
    assert alone.who == "model"
    assert "the mass of 'pole' is 0.3 kg in the model, where m is 0.2 kg in the equations" in alone.says


def test_an_engine_that_reads_the_file_otherwise_is_alone_with_its_cause(report):
    if "geoms_without_contact_weigh_nothing" not in ROBOT_READERS["pinocchio-aba"].mistakes["mjcf"]:
        pytest.skip("Pinocchio weighs such geoms by now")
    alone = alone_in(report, "geom")
    assert (alone.who, alone.names) == ("engine", ["pinocchio-aba"])
    assert {r.cause for r in results(report, "geom", "differs")} == {"geoms-without-contact-weigh-nothing"}


def test_a_wrong_engine_is_alone_unless_the_equations_are_wrong_too(tmp_path):
    wrong = "fake_tree_engines:WrongVelocityTerms"
    report = judged(tmp_path, ("mine", "wrong"), (wrong, "fake_tree_engines:Right"))
    alone = alone_in(report, "mine")
    assert (alone.who, alone.names) == ("engine", [wrong])
    assert alone.says == f"mine: {wrong} is alone: your equations, the theory of the model and 1 engine agree."
    assert alone_in(report, "wrong").who == "several"


def test_the_command_line_needs_no_engine_and_prints_the_answer(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    (tmp_path / "cart-pole.xml").write_text(MODEL, encoding="utf-8")
    path.write_text(MINE, encoding="utf-8")
    arguments = ["check", str(path), "-e", "own equations", "--json", "--out", str(tmp_path / "o"), "--no-cache"]
    assert cli_run(arguments) == 0
    (alone,) = json.loads(capsys.readouterr().out)["alone"]
    assert alone["says"] == "mine: your equations and the theory of the model agree."
    path.write_text(MINE.replace("l = 0.5", "l = 'x'"), encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"mine\.toml: symbols\.l: no joint is called 'x'"):
        check([path])
    path.write_text(MINE.replace("- m*g*l", "- m*G*l"), encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"mine: equations\.2: column 47: 'G' is not known here"):
        check([path])
