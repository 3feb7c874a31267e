"""``furiko diagnose`` on robots' files: sound ones agree, and each kind of misreading is named by its cause.

The right values are worked out by hand, or are what both engines' own interfaces give.
"""

from __future__ import annotations

import json
from dataclasses import replace

import mujoco
import numpy as np
import pinocchio
import pytest

from furiko import diagnose
from furiko.diagnosis.finding import CAUSES
from furiko.diagnosis.model_files.fix import write_fixed
from furiko.diagnosis.robots.fields import field_differences
from furiko.diagnosis.robots.misreadings import explain_reading
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models import InvalidInput
from furiko.models.readers.model_file import read_model
from furiko.models.readers.rules import with_mistakes

INERTIAL = '<inertial pos="0.1 0 -0.4" mass="1.5" diaginertia="0.1 0.2 0.25"/>'
LINK = '<link name="{}"><inertial><origin xyz="0.2 0 -1"/><mass value="1"/>{}</inertial>{}</link>'
LINE_ENDS_IN = '<inertia ixx=".1" iyy=".12" izz=".14\n" ixy="0" ixz="0" iyz="0"/>'
TENSOR = '<inertia ixx=".1" iyy=".12" izz=".14" ixy="0" ixz="0" iyz="0"/>'

SOUND = {
    "cart-pole.xml": f"""<mujoco><worldbody><body name="cart"><joint name="x" type="slide" axis="1 0 0" damping="0.3"/>
        <geom type="box" size=".1 .1 .1" mass="1.2"/><body name="pole"><joint name="q" axis="0 1 0"/>{INERTIAL}</body>
        </body></worldbody></mujoco>""",
    "arm.xml": f"""<mujoco><compiler angle="degree"/><worldbody><body name="a" pos="0 0 1" euler="10 20 30">
        <joint name="j1" axis="1 2 0" ref="20"/>{INERTIAL}<body name="b" pos="0.3 0 0">
        <joint name="j2" axis="0 0 1" pos="0 0.1 0"/><joint name="j3" axis="0 1 0"/>
        {INERTIAL}<body name="c" pos="0 0.2 0"><joint name="j4" type="ball"/>
        {INERTIAL}</body></body></body></worldbody></mujoco>""",
    "free.xml": f"""<mujoco><worldbody><body name="a" pos="0 0 1"><freejoint name="root"/>{INERTIAL}<body name="b">
        <joint name="hip" axis="0 1 0" armature="0.01"/>{INERTIAL}</body></body></worldbody></mujoco>""",
    "floating.urdf": f"""<robot name="r"><link name="base"/>{LINK.format("a", TENSOR, "")}
        <joint name="j" type="floating">
        <origin xyz="0 0 2" rpy="0.3 0 0"/><parent link="base"/><child link="a"/></joint></robot>""",
}
# name → (text, the engine that misreads it, the cause, part of what is said)
MISREAD = {
    "bare.xml": (
        f"""<mujoco><worldbody><body><joint name="j1" axis="0 1 0"/>{INERTIAL}<body name="b" pos="0 0 -1">
        <joint name="j2" axis="0 1 0"/>{INERTIAL}</body></body></worldbody></mujoco>""",
        "pinocchio-aba",
        "bare-bodies-lost",
        "'j1'",
    ),
    "roots.xml": (
        f"""<mujoco><worldbody><body name="a"><joint name="j1" axis="0 1 0"/>{INERTIAL}</body>
        <body name="b" pos="1 0 0">
        <joint name="j2" type="slide" axis="0 0 1"/>{INERTIAL}</body></worldbody></mujoco>""",
        "pinocchio-aba",
        "first-root-only",
        "'j2'",
    ),
    "class.xml": (  # a ball of 0.1 m of water weighs 4.18879 kg
        """<mujoco><default><geom type="sphere" size="0.1" mass="2"/></default><worldbody><body name="a">
        <joint name="j" type="slide" axis="0 0 1"/><geom/></body></worldbody></mujoco>""",
        "pinocchio-aba",
        "default-geom-mass-dropped",
        "4.18879 kg, the file says 2 kg",
    ),
    "shown.xml": (
        """<mujoco><worldbody><body name="a"><joint name="j" axis="0 1 0"/><geom size="0.1" mass="1" pos="0 0 -1"/>
        <geom size="0.1" mass="2" pos="0 0 -1" contype="0" conaffinity="0"/></body></worldbody></mujoco>""",
        "pinocchio-aba",
        "geoms-without-contact-weigh-nothing",
        "mass 1 kg, the file says 3 kg",
    ),
    "collision.urdf": (  # 1000 kg/m³ · 4/3 π 0.1³ = 4.18879 kg
        f"""<robot name="r"><link name="world"/>{LINK.format("a", TENSOR, "")}<link name="tip"><collision><geometry>
        <sphere radius="0.1"/></geometry></collision></link><joint name="j" type="continuous"><parent link="world"/>
        <child link="a"/><axis xyz="0 1 0"/></joint><joint name="f" type="fixed"><origin xyz="0 0 -1"/>
        <parent link="a"/><child link="tip"/></joint></robot>""",
        "mujoco",
        "collision-weighs",
        "link 'tip': mass 4.18879 kg, the file says 0 kg",
    ),
    "plane.urdf": (
        f"""<robot name="r"><link name="world"/>{LINK.format("a", TENSOR, "")}<joint name="j" type="planar">
        <parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint></robot>""",
        "pinocchio-aba",
        "planar-axis-ignored",
        "axis",
    ),
    "turning.xml": (
        """<mujoco><worldbody><body name="a" pos="0 0 1"><joint name="f" type="free" armature="0.1"/>
        <inertial pos="0 0 -.2" mass="1" diaginertia="0.1 0.2 0.3"/></body></worldbody></mujoco>""",
        "pinocchio-aba",
        "free-armature-in-body-axes",
        "0.1",
    ),
    "no-inertia.xml": (  # MuJoCo takes the least that it is told to; Pinocchio 1 kg m² about each axis
        f"""<mujoco><compiler boundinertia="1e-3"/><worldbody><body name="a"><joint name="j1" axis="0 1 0"/>
        <inertial pos="0.1 0 -0.4" mass="1.5"/><body name="b"><joint name="j2" axis="0 1 1"/>{INERTIAL}</body></body>
        </worldbody></mujoco>""",
        "pinocchio-aba",
        "inertial-without-inertia-is-unit",
        "inertia (1, 1, 1, 0, 0, 0) kg m², the file says (0.001, 0.001, 0.001, 0, 0, 0) kg m²",
    ),
    "worlds.xml": (
        f"""<mujoco><worldbody><body name="a"><joint name="j1" axis="0 1 0"/>{INERTIAL}</body></worldbody><worldbody>
        <body name="b" pos="1 0 0"><joint name="j2" axis="1 1 0"/>{INERTIAL}</body></worldbody></mujoco>""",
        "pinocchio-aba",
        "first-worldbody-again",
        "'j2'",
    ),
    "siblings.xml": (  # Pinocchio calls both joints aBisJoint_0, and gives the first of that name the armature twice
        f"""<mujoco><worldbody><body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}
        <body pos="0 0 1"><joint axis="1 0 0" armature="0.1" damping="0.2" frictionloss="0.3"/>{INERTIAL}</body>
        <body pos="0 1 0"><joint axis="1 0 0" armature="0.4"/>{INERTIAL.replace("1.5", "3")}</body>
        </body></worldbody></mujoco>""",
        "pinocchio-aba",
        "unnamed-sibling-twice",
        "armature 0 kg m², the file says 0.4 kg m²",
    ),
    "space.urdf": (  # its reader wants nothing behind a number, no end of line and no space
        f"""<robot name="r"><link name="world"/>{LINK.format("a", LINE_ENDS_IN, "")}
        {LINK.format("b", TENSOR, "").replace('<mass value="1"', '<mass value=" 1 "')}
        <joint name="j" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint>
        <joint name="k" type="continuous"><parent link="a"/><child link="b"/><axis xyz=" 1 0 0 "/></joint></robot>""",
        "pinocchio-aba",
        "space-behind-number-rejected",
        "link 'a': inertia (0, 0, 0, 0, 0, 0) kg m²",
    ),
    "ref.xml": (
        f"""<mujoco><worldbody><body name="a" pos="0 0 1" euler="0 40 0">
        <joint name="j1" axis="1 2 0" pos="0.1 0 0.2" ref="30" stiffness="2" springref="10"/>
        <joint name="j2" axis="0 0 3" type="slide" ref="0.2"/>{INERTIAL}
        <body name="b"><joint name="j3" type="slide" axis="0 2 0" ref="0.3"/><joint name="j4" ref="5"/>{INERTIAL}
        </body></body></worldbody></mujoco>""",
        "pinocchio-aba",
        "first-ref-ignored",
        "joint 'j1': ref 0 rad, the file says 0.523599 rad",  # 30°
    ),
}


def saved(folder, name, text):
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_robot_is_no_difference(tmp_path, name):
    found = diagnose(saved(tmp_path, name, SOUND[name]))
    assert (found.verdict, found.findings, found.exit_status) == ("agrees", (), 0), found.text()
    assert found.engines["mujoco"]["status"] == found.engines["pinocchio-aba"]["status"] == "agrees"
    assert "mujoco" in found.headline
    assert "pinocchio-aba" in found.headline


@pytest.mark.parametrize("name", MISREAD)
def test_a_misreading_is_named_by_its_cause(tmp_path, name):
    text, engine, cause, part = MISREAD[name]
    found = diagnose(saved(tmp_path, name, text))
    first = found.findings[0]
    assert (found.verdict, found.exit_status) == ("differs", 1)
    assert first.cause == cause, found.text()
    assert first.where.startswith(engine)
    assert part in first.says
    assert cause in CAUSES
    other = "mujoco" if engine != "mujoco" else "pinocchio-aba"
    assert found.engines[other]["status"] == "agrees"


def test_the_one_unnamed_joint_that_is_read_is_the_first(tmp_path):
    """Pinocchio calls it BisJoint_0, and has neither of the others: one cause, and no joint that the file has not."""
    text = f"""<mujoco><worldbody><body pos="0 0 1"><joint axis="0 1 0"/>{INERTIAL}</body><body pos="1 0 1"><joint/>
        {INERTIAL}</body><body pos="2 0 1"><freejoint/>{INERTIAL}</body></worldbody></mujoco>"""
    found = diagnose(saved(tmp_path, "roots.xml", text))
    assert [finding.cause for finding in found.findings] == ["first-root-only"], found.text()


def test_a_robot_that_is_read_twice_has_joints_out_of_order(tmp_path):
    """Its floor stands in a second <worldbody>. Pinocchio's joints are then numbered with each leg's second half behind
    the other leg, and crba, which takes what a joint carries to be numbered next, leaves entries at zero."""
    legs = "".join(
        f"""<body name="{side}" pos="0 {y} 0"><joint name="{side}_hip" axis="0 1 0" armature="0.1"/>{INERTIAL}
        <body name="{side}_shank" pos="0 0 -1"><joint name="{side}_knee" axis="0 1 0"/>{INERTIAL}</body></body>"""
        for side, y in (("left", 1), ("right", -1))
    )
    text = f"""<mujoco><worldbody><body name="trunk" pos="0 0 3"><freejoint name="base"/>{INERTIAL}{legs}</body>
        </worldbody><worldbody><geom type="plane" size="1 1 1"/></worldbody></mujoco>"""
    found = diagnose(saved(tmp_path, "robot.xml", text))
    assert [finding.cause for finding in found.findings] == ["first-worldbody-again", "joints-out-of-order"], (
        found.text()
    )
    assert "the mass matrix at joint 'base' and joint 'right_hip' is 0" in found.findings[1].says
    assert (found.verdict, found.engines["mujoco"]["status"]) == ("differs", "agrees")


def test_joints_that_share_one_made_up_name_are_still_asked(tmp_path):
    """Pinocchio has three composite joints of one name; what it holds and computes is compared, not given up."""
    two = f"""<joint axis="1 0 0"/><joint type="slide" axis="0 1 0"/>{INERTIAL}"""
    text = f"""<mujoco><worldbody><body name="base"><joint name="b" axis="0 1 0"/>{INERTIAL}
        <body pos="0 0 1">{two}</body><body pos="0 1 0"><joint axis="1 0 0"/>{INERTIAL}</body></body></worldbody>
        </mujoco>"""
    found = diagnose(saved(tmp_path, "a.xml", text))
    assert (found.verdict, found.engines["pinocchio-aba"]["status"]) == ("differs", "differs"), found.text()
    assert found.engines["mujoco"]["status"] == "agrees"


def test_an_unnamed_free_body_behind_named_ones_is_no_other_joint(tmp_path):
    """Pinocchio calls its joint ``Bis_free``; the joints before it, one body's further ones too, it does not read."""
    saved(
        tmp_path,
        "arm.xml",
        f"""<mujoco><worldbody><body name="a"><joint name="x" axis="1 0 0"/>
        <joint name="y" axis="0 1 0"/>{INERTIAL}</body></worldbody></mujoco>""",
    )
    dice = "".join(f'<body pos="{x} 0 0"><freejoint/>{INERTIAL}</body>' for x in (1, 2, 3))
    text = f'<mujoco><include file="arm.xml"/><worldbody>{dice}</worldbody></mujoco>'
    found = diagnose(saved(tmp_path, "scene.xml", text), engines=["pinocchio-aba"])
    assert {finding.cause for finding in found.findings} == {"first-root-only", "include-not-followed"}, found.text()


REFUSED_FOR = {
    "frame-ignored": (
        f"""<mujoco><worldbody><replicate count="2" offset="0 0 1"><body name="a"><joint/>{INERTIAL}</body></replicate>
        </worldbody></mujoco>""",
        "no joint is left. Instead",
    ),
    "bare-bodies-lost": (
        f"<mujoco><worldbody><body><freejoint/>{INERTIAL}</body></worldbody></mujoco>",
        "refuses: MJCF parser: no body found",
    ),
    "bare-bodies-lost, beside others": (
        f"""<mujoco><worldbody><body><freejoint/>{INERTIAL}</body><body pos="0 0 1"><freejoint/>{INERTIAL}</body>
        </worldbody></mujoco>""",
        ", and reads only the first <body> of the world; read so: no joint is left. Instead",
    ),
    "later-sections-ignored": (
        f"""<mujoco><default><joint damping="1"/></default><default><default class="servo"><joint axis="1 0 0"/>
        </default></default><worldbody><body name="a"><joint class="servo"/>{INERTIAL}</body></worldbody></mujoco>""",
        "class='servo': no <default> of that class. Instead, put all",
    ),
    "include-not-followed": (
        f"""<mujoco><include file="classes.xml"/><worldbody><body name="a" childclass="arm"><joint/>{INERTIAL}</body>
        </worldbody></mujoco>""",
        "childclass='arm': no <default> of that class. Instead",
    ),
}


@pytest.mark.parametrize("cause", REFUSED_FOR)
def test_a_refusal_has_the_mistake_that_leaves_nothing_to_read(tmp_path, cause):
    """What Pinocchio says of these, "No such node (body)" and "unordered_map::at", tells nobody what to do."""
    text, part = REFUSED_FOR[cause]
    saved(
        tmp_path,
        "classes.xml",
        '<mujoco><default><default class="arm"><joint axis="1 0 0"/></default></default></mujoco>',
    )
    found = diagnose(saved(tmp_path, "arm.xml", text))
    assert found.engines["pinocchio-aba"]["status"] == "refused"
    assert found.engines["mujoco"]["status"] == "agrees"
    assert [finding.cause for finding in found.findings] == [cause.partition(",")[0]], found.text()
    assert part in found.findings[0].says


def test_a_space_behind_a_joints_number_is_named_where_it_stands(tmp_path):
    """What Pinocchio says, that the file does not contain a valid URDF model, tells nobody what to do."""
    text = MISREAD["space.urdf"][0].replace("</joint>", '<dynamics damping="0.1 "/></joint>', 1)
    found = diagnose(saved(tmp_path, "a.urdf", text))
    assert found.engines["mujoco"]["status"] == "agrees"
    assert [finding.cause for finding in found.findings] == ["space-behind-number-rejected"], found.text()
    assert "<dynamics>: damping='0.1 ': no number" in found.findings[0].says


@pytest.mark.parametrize("place", ["body", "inertial", "geom"])
@pytest.mark.parametrize("axis", ["1 2 0", "0.71 0.71 0"])
def test_an_axis_that_is_not_of_length_one_is_named_wherever_it_is(tmp_path, place, axis):
    turned = f'axisangle="{axis} 40"'
    inside = INERTIAL.replace("/>", f" {turned}/>") if place == "inertial" else INERTIAL
    if place == "geom":
        inside = f'<geom type="box" size=".1 .2 .3" {turned}/>'
    b = f'<body name="b" pos="0 0 1" {turned if place == "body" else ""}><joint name="k" axis="1 0 0"/>{inside}</body>'
    text = (
        f"""<mujoco><worldbody><body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}{b}</body></worldbody></mujoco>"""
    )
    found = diagnose(saved(tmp_path, "axis.xml", text))
    assert [finding.cause for finding in found.findings] == ["axis-not-normalised"], found.text()
    assert "Instead, write quat" in found.findings[0].says
    same = diagnose(saved(tmp_path, "unit.xml", text.replace(f'"{axis} 40"', '"0.6 0.8 0 40"')))
    assert same.engines["pinocchio-aba"]["status"] == "agrees"


def test_what_is_unnamed_is_the_same_however_much_was_lost_before_it(tmp_path):
    """Of the file's two joints without a name Pinocchio, which follows no <include>, has the second, as its first."""
    saved(tmp_path, "part.xml", f'<mujoco><body name="a"><joint axis="0 1 0"/>{INERTIAL}</body></mujoco>')
    text = f"""<mujoco><worldbody><include file="part.xml"/><body name="b" pos="1 0 0"><freejoint/>{INERTIAL}</body>
        </worldbody></mujoco>"""
    found = diagnose(saved(tmp_path, "scene.xml", text))
    assert [finding.cause for finding in found.findings] == ["include-not-followed"], found.text()
    assert "joint 'furiko_joint_1' (hinge) is missing" in found.findings[0].says


def test_an_unnamed_free_joint_that_is_read_again_is_no_further_finding(tmp_path):
    """Pinocchio reads the robot in place of the floor's world, and calls the second free joint after its body."""
    robot = (
        f'<body name="a"><freejoint/>{INERTIAL}<body name="b"><joint name="j" axis="0 1 0"/>{INERTIAL}</body></body>'
    )
    text = f"<mujoco><worldbody>{robot}</worldbody><worldbody><light pos='0 0 1'/></worldbody></mujoco>"
    found = diagnose(saved(tmp_path, "mocap.xml", text))
    causes = [finding.cause for finding in found.findings]
    assert causes[0] == "first-worldbody-again", found.text()
    assert not {"joint-dropped-by-parser", "joint-added", "unexplained"} & set(causes), found.text()


def test_two_misreadings_at_once_are_both_named(tmp_path):
    text = MISREAD["shown.xml"][0].replace("<mujoco>", '<mujoco><compiler settotalmass="6"/>')
    found = diagnose(saved(tmp_path, "two.xml", text))
    assert {finding.cause for finding in found.findings} == {
        "geoms-without-contact-weigh-nothing",
        "total-mass-ignored",
    }


@pytest.mark.parametrize("name", ["bare.xml", "class.xml", "shown.xml", "ref.xml", "worlds.xml"])
def test_the_fixed_file_is_read_alike(tmp_path, name):
    path, out = saved(tmp_path, name, MISREAD[name][0]), tmp_path / "fixed.xml"
    write_fixed(read_model(path), out)
    found = diagnose(out)
    assert {engine: entry["status"] for engine, entry in found.engines.items() if engine != "exudyn-tree"} == {
        "mujoco": "agrees",
        "pinocchio-aba": "agrees",
    }, found.text()
    assert [f.cause for f in diagnose(out, path).findings] == []


@pytest.mark.parametrize("first", ["arms", "box"])
def test_a_fix_has_slides_and_a_ball_for_what_is_free_beside_others(tmp_path, first):
    """Two arms and a box, which Pinocchio would lose, or the arms: it reads the first body of the world alone."""
    arms = "".join(
        f"""<body name="{side}" pos="0 {y} 0"><body name="{side}_hand"><joint name="{side}_j" axis="0 1 0"/>{INERTIAL}
        </body></body>"""
        for side, y in (("left", 1), ("right", -1))
    )
    box = f'<body name="box" pos="1 2 3" euler="10 20 30"><joint type="free" name="f" armature="0.2"/>{INERTIAL}</body>'
    both = arms + box if first == "arms" else box + arms
    text = f"<mujoco><worldbody>{both}</worldbody></mujoco>"
    path, out = saved(tmp_path, "arms.xml", text), tmp_path / "fixed.xml"
    free, turning = write_fixed(read_model(path), out)
    assert free.startswith("what is free beside other bodies has three slides and a ball")
    assert turning.endswith("which MuJoCo alone has as written: 'f'")
    found = diagnose(out)
    assert (found.verdict, found.engines["pinocchio-aba"]["status"]) == ("agrees", "agrees"), found.text()
    assert {joint.joint.name for joint in read_model(out).spatial.joints} == {
        *("left_j", "right_j", "f_x", "f_y", "f_z", "f_turn")
    }
    _assert_the_same_motion(path, out)


def _assert_the_same_motion(path, out):
    """In MuJoCo: M and bias where the box is turned, moved and turning, the fixed file's slides zero at its own pos."""
    one, two = (mujoco.MjModel.from_xml_path(str(file)) for file in (path, out))
    datas = [mujoco.MjData(model) for model in (one, two)]
    place = np.array([0.4, -0.3, 0.2])
    start = one.body("box").quat
    turn = np.array([0.5, 0.1, -0.7, 0.5])
    turn /= np.linalg.norm(turn)
    whole = np.empty(4)
    mujoco.mju_mulQuat(whole, start, turn)
    rates = np.array([0.3, -0.5, 0.7, 1.1, -0.2, 0.4])
    terms = []
    for model, data in zip((one, two), datas, strict=True):
        for name, value in (("left_j", 0.3), ("right_j", -0.8)):
            data.joint(name).qpos, data.joint(name).qvel = value, 2 * value
        if model is one:
            data.joint("f").qpos, data.joint("f").qvel = [*(one.body("box").pos + place), *whole], rates
            columns = [int(model.joint(name).dofadr[0]) for name in ("left_j", "right_j")]
            columns += list(range(int(model.joint("f").dofadr[0]), int(model.joint("f").dofadr[0]) + 6))
        else:
            for letter, x, rate in zip("xyz", place, rates[:3], strict=True):
                data.joint(f"f_{letter}").qpos, data.joint(f"f_{letter}").qvel = x, rate
            data.joint("f_turn").qpos, data.joint("f_turn").qvel = turn, rates[3:]
            first = int(model.joint("f_turn").dofadr[0])
            columns = [int(model.joint(name).dofadr[0]) for name in ("left_j", "right_j", "f_x", "f_y", "f_z")]
            columns += list(range(first, first + 3))
        mujoco.mj_forward(model, data)
        matrix = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, matrix)
        terms.append((matrix[np.ix_(columns, columns)], data.qfrc_bias[columns]))
    np.testing.assert_allclose(terms[0][0], terms[1][0], atol=1e-13)
    np.testing.assert_allclose(terms[0][1], terms[1][1], atol=1e-12)


DRIVEN_TOOL = f"""<mujoco><worldbody><body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}<body name="tool">
<joint name="k" axis="1 0 0" armature="0.1"/></body></body></worldbody></mujoco>"""


def test_a_fix_says_which_links_weigh_nothing(tmp_path):
    text = f"""<robot name="r"><link name="world"/>{LINK.format("a", TENSOR, "")}<link name="tool"/>
        <joint name="j" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint>
        <joint name="k" type="continuous"><parent link="a"/><child link="tool"/><axis xyz="0 1 0"/></joint></robot>"""
    path, driven = saved(tmp_path, "a.urdf", text), saved(tmp_path, "driven.xml", DRIVEN_TOOL)
    for out in (tmp_path / "fixed.xml", tmp_path / "fixed.urdf"):
        (says,) = write_fixed(read_model(path), out)
        assert says.startswith("what a joint moves and weighs nothing is fixed where it is")
        assert says.endswith("give that a mass in the file: 'k'")
        found = diagnose(out)
        assert found.verdict == "agrees", found.text()
        assert found.engines["mujoco"]["status"] == "agrees"
    (says,) = write_fixed(read_model(driven), tmp_path / "fixed.xml")  # its armature says how it moves
    assert says == "MuJoCo refuses links that move and weigh nothing; give them a mass in the file: 'tool'"


def test_a_fix_keeps_all_joints_where_nothing_weighs(tmp_path):
    """A file without a joint would be none to ask anybody about."""
    text = """<robot name="r"><link name="world"/><link name="a"/><joint name="j" type="continuous">
        <parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint></robot>"""
    (says,) = write_fixed(read_model(saved(tmp_path, "a.urdf", text)), tmp_path / "fixed.xml")
    assert says.endswith("give them a mass in the file: 'a'")


def test_what_carries_nothing_but_idle_links_is_idle_too(tmp_path):
    """A wrist of two axes without a hand; the arm's own motion, M and bias, is that of the file."""
    text = f"""<robot name="r"><link name="world"/>{LINK.format("a", TENSOR, "")}<link name="wrist"/>
        <link name="frame"/><link name="tool"/><joint name="j" type="continuous"><parent link="world"/>
        <child link="a"/><axis xyz="0 1 0"/>
        </joint><joint name="k" type="continuous"><origin xyz="0 0 -1" rpy=".1 .2 .3"/><parent link="a"/>
        <child link="wrist"/><axis xyz="0 1 0"/></joint><joint name="f" type="fixed"><parent link="wrist"/>
        <child link="frame"/></joint><joint name="l" type="prismatic"><parent link="frame"/><child link="tool"/>
        <axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>"""
    path, out = saved(tmp_path, "a.urdf", text), tmp_path / "fixed.xml"
    (says,) = write_fixed(read_model(path), out)
    assert says.endswith("'l', 'k'")
    models = [pinocchio.buildModelFromUrdf(str(path)), pinocchio.buildModelFromMJCF(str(out))]
    assert [model.nv for model in models] == [3, 1]
    bias = []
    for model in models:
        q, v = pinocchio.neutral(model), np.zeros(model.nv)
        at = model.joints[model.getJointId("j")]
        q[at.idx_q : at.idx_q + at.nq] = [np.cos(0.7), np.sin(0.7)] if at.nq == 2 else [0.7]
        v[at.idx_v] = 1.3
        data = model.createData()
        matrix = pinocchio.crba(model, data, q)
        bias.append((matrix[at.idx_v, at.idx_v], pinocchio.rnea(model, data, q, v, 0 * v)[at.idx_v]))
    assert bias[0] == pytest.approx(bias[1], rel=1e-13)


def test_a_fix_is_not_written_over_the_file_itself_or_in_another_format(tmp_path):
    path = saved(tmp_path, "a.xml", SOUND["free.xml"])
    with pytest.raises(InvalidInput, match="is not overwritten"):
        write_fixed(read_model(path), path)
    with pytest.raises(InvalidInput, match="must end in"):
        write_fixed(read_model(path), tmp_path / "a.yaml")


def test_an_engine_that_refuses_is_never_agreement(tmp_path):
    """No body has moments 0.1, 0.1, 0.9: MuJoCo refuses it."""
    text = SOUND["floating.urdf"].replace('izz=".14"', 'izz=".9"')
    path = saved(tmp_path, "a.urdf", text)
    found = diagnose(path)
    assert (found.verdict, found.exit_status, found.findings[0].cause) == ("differs", 1, "inertia-rejected")
    named = diagnose(path, engines=["mujoco", "pinocchio-aba"])
    assert (named.verdict, named.exit_status) == ("incomplete", 3)
    assert diagnose(path, engines=["pinocchio-aba"]).verdict == "agrees"


def test_servos_and_long_time_steps_are_said_and_change_no_verdict(tmp_path):
    text = SOUND["cart-pole.xml"].replace(
        "</worldbody>", '</worldbody><actuator><position name="servo" joint="q" kp="12"/></actuator>'
    )
    text = text.replace("<mujoco>", '<mujoco><option timestep="0.05"/>')
    found = diagnose(saved(tmp_path, "a.xml", text))
    assert found.verdict == "agrees"
    assert {finding.cause for finding in found.simulation} == {"servo", "coarse-time-step"}
    assert any("'servo'" in f.says and "'q'" in f.says for f in found.simulation)
    assert any("actuator" in line for line in found.without)


def test_many_servos_are_said_in_one_sentence(tmp_path):
    servos = "".join(f'<position name="s{k}" joint="q" kp="12"/>' for k in range(8))
    text = SOUND["cart-pole.xml"].replace("</worldbody>", f"</worldbody><actuator>{servos}</actuator>")
    found = diagnose(saved(tmp_path, "a.xml", text), engines=["mujoco"])
    (said,) = (finding for finding in found.simulation if finding.cause == "servo")
    assert "8 actuators pull at ctrl = 0" in said.says
    assert "'s5' at joint 'q' and 2 more;" in said.says


def test_pinocchio_is_not_asked_for_a_workspace_that_fills_the_memory(tmp_path):
    """Its Data of 675 freedoms takes 11 GB and a minute and a half."""

    def sliding(count):
        bodies = "".join(f'<body name="b{k}"><joint type="slide"/>{INERTIAL}</body>' for k in range(count))
        return f'<mujoco><worldbody><body name="a">{bodies}</body></worldbody></mujoco>'

    few, many = saved(tmp_path, "few.xml", sliding(3)), saved(tmp_path, "many.xml", sliding(401))
    assert len(ROBOT_READERS["pinocchio-aba"].load(few, "mjcf").joints()) == 3
    with pytest.raises(ValueError, match="workspace for 401 freedoms takes some 2 GB"):
        ROBOT_READERS["pinocchio-aba"].load(many, "mjcf")


def test_pinocchio_does_not_read_what_would_take_gigabytes(tmp_path, monkeypatch):
    """Its reader makes the workspace. Of several bodies of the world it reads the first alone: that it is asked to."""
    monkeypatch.setitem(ROBOT_READERS, "pinocchio-aba", replace(ROBOT_READERS["pinocchio-aba"], most_freedoms=2))
    three = "".join(f'<body name="{n}"><joint type="slide"/>{INERTIAL}</body>' for n in "abc")
    apart = saved(tmp_path, "apart.xml", f"<mujoco><worldbody>{three}</worldbody></mujoco>")
    found = diagnose(apart, engines=["pinocchio-aba"])
    assert [finding.cause for finding in found.findings] == ["first-root-only"]
    together = f'<mujoco><worldbody><body name="w">{three}</body></worldbody></mujoco>'
    found = diagnose(saved(tmp_path, "together.xml", together), engines=["pinocchio-aba"])
    assert (found.verdict, found.engines["pinocchio-aba"]["status"]) == ("incomplete", "refused")
    assert "3 freedoms, more than the 2" in found.engines["pinocchio-aba"]["says"]
    found = diagnose(tmp_path / "together.xml")  # where nobody asked for it, the file is judged by the others
    assert (found.verdict, found.findings, "pinocchio-aba" in found.engines) == ("agrees", (), False)
    assert any(note.startswith("pinocchio-aba is not asked: 3 freedoms, more than the 2") for note in found.notes)


def test_damping_that_pinocchio_leaves_to_its_caller_is_said(tmp_path):
    found = diagnose(saved(tmp_path, "a.xml", SOUND["cart-pole.xml"]))
    assert any("damping in pinocchio-aba" in line for line in found.without)


def test_a_limit_that_acts_well_before_its_range_ends_is_no_difference(tmp_path):
    """Of a planar arm three quarters of the range are within the margin: MuJoCo's limit pushes in most states."""
    joint = f'<joint name="j" axis="0 1 0" range="-10 10" limited="true" margin="0.13"/>{INERTIAL}'
    path = saved(tmp_path, "arm.xml", f'<mujoco><worldbody><body name="a">{joint}</body></worldbody></mujoco>')
    found = diagnose(path, engines=["mujoco"])
    assert (found.verdict, "joint limits" in found.without) == ("agrees", True), found.text()
    assert [f.cause for f in diagnose(path, engines=["mujoco"], limits=True).findings] == ["joint-limit", "joint-limit"]


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_a_name_in_another_encoding_is_said_and_no_failure(tmp_path, engine):
    path = tmp_path / "arm.xml"
    body = f'<body name="caf\xe9"><joint name="caf\xe9" axis="1 2 0"/>{INERTIAL}</body>'
    text = f'<?xml version="1.0" encoding="iso-8859-1"?><mujoco><worldbody>{body}</worldbody></mujoco>'
    path.write_bytes(text.encode("latin-1"))
    found = diagnose(path, engines=[engine])
    assert found.engines[engine]["status"] == "refused"
    assert [finding.cause for finding in found.findings] == ["file-refused"]
    assert "save the file in UTF-8" in found.findings[0].says


def test_limits_count_where_they_are_asked_for(tmp_path):
    limited = SOUND["free.xml"].replace('axis="0 1 0" arm', 'axis="0 1 0" range="-30 30" arm')
    a, b = saved(tmp_path, "a.xml", limited), saved(tmp_path, "b.xml", SOUND["free.xml"])
    assert diagnose(a, b).verdict == "agrees"
    assert [f.cause for f in diagnose(a, b, limits=True).findings] == ["joint-limit"]


@pytest.mark.parametrize(("limits", "causes"), [(False, []), (True, ["joint-limit"])])
def test_a_range_that_an_engine_does_not_hold_is_left_where_ranges_count(tmp_path, limits, causes):
    holds = read_model(saved(tmp_path, "a.xml", SOUND["free.xml"])).spatial
    hip = replace(holds.bodies[1].joints[0], limits=(-0.5, 0.5))
    said = replace(holds, bodies=(holds.bodies[0], replace(holds.bodies[1], joints=(hip,))))

    def left(reading):
        return field_differences(holds, reading, limits=limits)

    explanation = explain_reading(lambda rules: said, "mjcf", left, ("first_root_only",))
    assert [difference.cause for difference in explanation.left] == causes


def test_no_file_is_read_again_for_what_is_explained(tmp_path):
    """As documented, with the first mistake, and no more: a large file takes tens of milliseconds to read."""
    path = saved(tmp_path, "a.xml", MISREAD["roots.xml"][0])
    readings = []

    def read(rules):
        readings.append(rules)
        return read_model(path, rules).spatial

    holds = read_model(path, with_mistakes("mjcf", ["first_root_only"])).spatial
    candidates = ROBOT_READERS["pinocchio-aba"].mistakes["mjcf"]
    found = explain_reading(read, "mjcf", lambda reading: field_differences(holds, reading), candidates)
    assert [flag for flag, _ in found.mistakes] == ["first_root_only"]
    assert len(readings) == 2


def test_another_robot_is_compared_number_by_number(tmp_path):
    a = saved(tmp_path, "a.xml", SOUND["free.xml"])
    b = saved(tmp_path, "b.xml", SOUND["free.xml"].replace('armature="0.01"', 'armature="0.02"'))
    found = diagnose(a, b)
    assert [(f.cause, f.measured, f.expected) for f in found.findings] == [("armature", 0.01, 0.02)]


def test_json_of_a_robot(tmp_path):
    document = json.loads(json.dumps(diagnose(saved(tmp_path, "a.xml", SOUND["arm.xml"])).to_json()))
    assert document["mechanism"] is None
    assert [j["kind"] for body in document["spatial"]["bodies"] for j in body["joints"]] == [
        "hinge",
        "hinge",
        "hinge",
        "ball",
    ]
    assert document["engines"]["pinocchio-aba"]["measured"][0]["ratio"] <= 1


def test_a_file_in_which_nothing_moves_is_refused(tmp_path):
    text = f'<mujoco><worldbody><body name="a">{INERTIAL}</body></worldbody></mujoco>'
    with pytest.raises(InvalidInput, match="no joint"):
        diagnose(saved(tmp_path, "a.xml", text))


def test_an_element_of_half_a_million_attributes_is_refused_before_any_engine_reads_it(tmp_path):
    many = "".join(f"a{i}='' " for i in range(500_000))
    with pytest.raises(InvalidInput, match="500000 attributes; at most 500"):
        diagnose(saved(tmp_path, "a.xml", SOUND["free.xml"].replace("<mujoco>", f"<mujoco {many}>")))


@pytest.mark.parametrize(
    ("mesh", "help_"),
    [
        ("gone.stl", ". Name the folder that has it with --meshes; --fix OUT writes the mechanism without meshes"),
        ("shape.dae", ". --fix OUT writes the mechanism without meshes"),
    ],
)
def test_an_engine_that_does_not_get_a_mesh_is_told_what_helps(tmp_path, mesh, help_):
    """The link has its inertial: its mesh has no part in the dynamics, and MuJoCo refuses the file all the same."""
    shape = f'<collision><geometry><mesh filename="{mesh}"/></geometry></collision>'
    text = SOUND["floating.urdf"].replace("</inertial>", f"</inertial>{shape}")
    saved(tmp_path, "shape.dae", "<COLLADA/>")
    path, out = saved(tmp_path, "a.urdf", text), tmp_path / "fixed.xml"
    found = diagnose(path)
    assert found.engines["pinocchio-aba"]["status"] == "agrees"
    assert [(f.cause, f.where) for f in found.findings] == [("file-refused", "mujoco")]
    assert found.findings[0].says.endswith(help_)
    assert write_fixed(read_model(path), out) == []
    assert diagnose(out).verdict == "agrees"


def test_what_has_no_name_is_told_by_its_line_alone(tmp_path):
    text = f"""<mujoco><worldbody><body name="a"><freejoint/>{INERTIAL}</body>
        <body name="b"><freejoint/>{INERTIAL}</body></worldbody></mujoco>"""
    (finding,) = diagnose(saved(tmp_path, "a.xml", text)).findings
    assert "line 2, <freejoint>)" in finding.says


def test_a_joint_without_a_name_is_called_after_its_body_in_notes(tmp_path):
    text = f"""<mujoco><worldbody><body name="trunk"><freejoint/>{INERTIAL}<body><joint type="ball"/>{INERTIAL}</body>
        </body></worldbody></mujoco>"""
    notes = diagnose(saved(tmp_path, "a.xml", text)).notes
    assert any("and the unnamed joint of body 'trunk' is free" in note for note in notes), notes
    assert not any("furiko_joint" in note for note in notes)


def test_an_unknown_engine_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match="mujocoo"):
        diagnose(saved(tmp_path, "a.xml", SOUND["free.xml"]), engines=["mujocoo"])


def test_readings_are_spatial_wherever_a_file_is_no_planar_tree(tmp_path):
    file = read_model(saved(tmp_path, "a.xml", SOUND["arm.xml"]))
    assert file.planar is None
    assert "not a planar tree" in file.not_planar


def test_two_misreadings_that_leave_nothing_only_together_are_both_named(tmp_path):
    """As in MuJoCo's humanoid100: one robot is attached, and a hundred bodies stand in frames."""
    other = f'<mujoco><worldbody><body name="b"><joint name="k" axis="0 1 0"/>{INERTIAL}</body></worldbody></mujoco>'
    saved(tmp_path, "other.xml", other)
    body = f'<body name="a"><joint name="j" axis="0 1 0"/>{INERTIAL}</body>'
    text = f"""<mujoco><asset><model name="other" file="other.xml"/></asset><worldbody><attach model="other" body="b"
        prefix="_"/><frame pos="0 0 1">{body}</frame></worldbody></mujoco>"""
    found = diagnose(saved(tmp_path, "model.xml", text))
    (finding,) = [one for one in found.findings if one.where.startswith("pinocchio-aba")]
    assert found.engines["pinocchio-aba"]["status"] == "refused"
    assert finding.cause == "attach-ignored"
    assert "No such node (body). It ignores <attach>" in finding.says
    assert "and ignores <frame>" in finding.says
    assert "read so: no joint is left" in finding.says
