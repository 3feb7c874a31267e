"""``<attach>``: what furiko reads of a document and the parts of others in it, against what MuJoCo compiles of it."""

import mujoco
import numpy as np
import pinocchio
import pytest

from furiko.diagnosis.model_files.diagnose import diagnose
from furiko.models import InvalidInput
from furiko.models.readers.model_file import read_model
from furiko.models.readers.rules import with_mjcf

from .compiled import assert_alike, read

# Everything that a child has of its own: angles, euler's axes, limits, groups that weigh, bounds, default classes; and
# what stays the parent's: options, the mass of all.
CHILD = """<mujoco model="kid">
  <compiler angle="radian" eulerseq="zyx" inertiagrouprange="1 3" boundmass="0.5" boundinertia="0.02" settotalmass="7"
    autolimits="false"/>
  <option gravity="0 0 -1" timestep="0.01"><flag gravity="disable"/></option>
  <default><joint damping="0.3" armature="0.1"/><geom density="500" group="2"/>
    <default class="c"><joint damping="0.7" stiffness="2"/></default></default>
  <worldbody>
    <geom name="ground" size=".2 .3 .1" type="box" pos="0 0 1" euler=".4 .1 .2"/>
    <body name="a" pos="1 0 0" euler="0.1 0.2 0.3">
      <joint name="ja" axis="0 1 0" ref="0.5" range="-1 1" limited="true"/><geom size=".1"/>
      <geom size=".3" group="0"/>
      <body childclass="c" name="deep" pos="0 0 1"><joint name="jdeep" axis="1 1 0" springref="0.2"/>
        <geom size=".2 .3 .1" type="box" euler=".4 .1 .2"/>
        <body name="tip" pos="0 .2 0" zaxis="0 1 1"><joint name="jtip"/><geom size=".1" class="main"/></body></body>
    </body>
    <frame name="turned" pos="0 0 3" axisangle="1 1 0 .5" childclass="c">
      <body name="d" pos="0 1 0"><joint name="jd" axis="0 1 0"/><geom size=".1"/></body>
      <geom size=".05" pos="1 0 0"/></frame>
  </worldbody>
  <actuator><general name="ma" joint="ja" gear="3"/><position name="md" joint="jd" kp="3"/></actuator>
</mujoco>"""
# A child of a child, in degrees.
BETWEEN = """<mujoco model="between"><compiler angle="degree"/><asset><model name="k" file="child.xml"/></asset>
  <worldbody><body name="m" euler="0 30 0" childclass="main"><joint name="jm" range="-40 40"/><geom size=".1"/>
  <frame pos="0 0 1" euler="20 0 0"><attach model="k" body="a" prefix="in_"/></frame></body></worldbody></mujoco>"""
CLASSES = '<default><joint damping="9"/><default class="c"><joint damping="5"/></default></default>'


def parent(inside, head="", asset='<model name="k" file="child.xml"/>'):
    return f"""<mujoco model="p">{head}{CLASSES}<asset>{asset}</asset><worldbody><body name="root" pos="0 0 5">
        <joint name="jr"/><geom size=".1"/><frame pos="0 1 2" euler="0 0 40" childclass="c">{inside}</frame></body>
        </worldbody></mujoco>"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "child.xml").write_text(CHILD)
    (tmp_path / "between.xml").write_text(BETWEEN)
    return tmp_path


KIDS = '<model file="child.xml"/>'
OF_BETWEEN = '<model name="b" file="between.xml"/>'
FILES = {
    "a body": parent('<attach model="k" body="a" prefix="p_"/>'),
    "a body in a body, with the class around it": parent('<attach model="k" body="tip" prefix="p_"/>'),
    "a body in a frame, without the frame": parent('<attach model="k" body="d" prefix="p_"/>'),
    "a frame, with its pose": parent('<attach model="k" frame="turned" prefix="p_"/>'),
    "all, with geoms for the body that it is in": parent('<attach model="k" prefix="p_"/>'),
    "twice": parent('<attach model="k" body="a" prefix="p_"/><body/><attach model="k" body="a" prefix="q_"/>'),
    "by the name in the document": parent('<attach model="kid" body="a" prefix="p_"/>', asset=KIDS),
    "in copies": parent(
        '<replicate count="3" offset="1 0 0" euler="0 0 9"><attach model="k" body="a" prefix="p_"/></replicate>'
    ),
    "a child of a child": parent('<attach model="b" prefix="p_"/>', asset=OF_BETWEEN),
    "a body that the child attaches": parent('<attach model="b" body="in_deep" prefix="p_"/>', asset=OF_BETWEEN),
    "where the parent has a compiler": parent(
        '<attach model="k" prefix="p_"/>',
        '<compiler angle="radian" inertiagrouprange="0 1" boundmass="9" settotalmass="100"/><option gravity="0 1 -3"/>',
    ),
}


@pytest.mark.parametrize("case", FILES)
def test_what_mujoco_compiles(folder, case):
    path = folder / "model.xml"
    path.write_text(FILES[case])
    model = mujoco.MjModel.from_xml_path(str(path))
    found = read(FILES[case], path=path)
    assert_alike(found, model)
    names = [joint.name for body in found.bodies for joint in body.joints]
    assert names == [model.joint(j).name for j in range(model.njnt)]
    assert [body.name for body in found.bodies if "furiko" not in body.name] == [
        name for b in range(1, model.nbody) if (name := model.body(b).name)
    ]


def test_the_arm_by_hand(tmp_path):
    """One metre up, turned by a quarter about x in the child's radians; a motor's armature 0.1 × 2² + 0.3."""
    child = """<mujoco><compiler angle="radian"/><worldbody><body name="a" pos="0 1 0" euler="1.5707963267948966 0 0">
        <joint name="j" axis="0 1 0" armature="0.3"/><inertial pos="0 0 0" mass="2" diaginertia="1 2 3"/></body>
        </worldbody><actuator><motor joint="j" gear="2" armature="0.1"/></actuator></mujoco>"""
    (tmp_path / "child.xml").write_text(child)
    text = """<mujoco><asset><model name="k" file="child.xml"/></asset><worldbody><frame pos="0 0 1" euler="0 0 90">
        <attach model="k" body="a" prefix="left/"/></frame></worldbody></mujoco>"""
    (body,) = read(text, path=tmp_path / "model.xml").bodies
    assert (body.name, body.joints[0].name) == ("left/a", "left/j")
    np.testing.assert_allclose(body.position, [-1, 0, 1], atol=1e-15)
    # A quarter about z, then one about the new x: (1, 1, 1, 1)/2.
    np.testing.assert_allclose(body.quaternion / np.sign(body.quaternion[0]), [0.5] * 4, atol=1e-15)
    assert body.joints[0].armature == pytest.approx(0.7, rel=1e-15)


def test_the_engines_read_the_file(folder):
    """MuJoCo agrees; Pinocchio passes over what is attached, with its joints, and that is said."""
    path = folder / "model.xml"
    path.write_text(FILES["a body"])
    assert list(pinocchio.buildModelFromMJCF(str(path)).names) == ["universe", "jr"]
    found = diagnose(path, engines=["mujoco", "pinocchio-aba"])
    assert found.engines["mujoco"]["status"] == "agrees"
    assert [finding.cause for finding in found.findings] == ["attach-ignored"]
    assert "actuators" in found.without


def test_all_that_is_attached_is_lost(folder):
    path = folder / "model.xml"
    path.write_text(FILES["all, with geoms for the body that it is in"])
    found = read_model(path, with_mjcf("attach_ignored")).spatial
    assert [joint.joint.name for joint in found.joints] == ["jr"]


@pytest.mark.parametrize(
    ("inside", "says"),
    [
        ('<attach model="k" body="a"/>', "prefix: needed"),
        ('<attach body="root" prefix="p"/>', "write its bodies out a second time"),
        ('<attach model="no" prefix="p"/>', "model='no': no <model> of that name"),
        ('<attach model="k" body="no" prefix="p"/>', "body='no': no <body> of that name"),
        ('<attach model="k" body="" prefix="p"/>', "body='': no <body> of that name"),
        ('<attach model="k" body="a" frame="turned" prefix="p"/>', "body and frame: only one"),
        ('<attach model="k" body="a" prefix=""/><attach model="k" body="a" prefix=""/>', "names must be unique"),
    ],
)
def test_what_is_not_attached(folder, inside, says):
    with pytest.raises(InvalidInput, match=says):
        read(parent(inside), path=folder / "model.xml")


@pytest.mark.parametrize(
    ("asset", "head", "says"),
    [
        ('<model name="k" file="robot.urdf"/>', "", "<robot>: only MJCF is attached"),
        ('<model name="k" file="gone.xml"/>', "", "there is no such file"),
        ('<model name="k" file="../child.xml"/>', "", "outside the model's own folder"),
        ('<model name="k"/>', "", "file: the name of an MJCF file is needed"),
        ('<model name="k" file="itself.xml"/>', "", "the document is attached to itself"),
        ('<model name="k" file="child.xml"/>', '<compiler conflict="merge"/>', 'conflict="merge"'),
    ],
)
def test_documents_that_are_not_attached(folder, asset, head, says):
    (folder / "robot.urdf").write_text("<robot name='r'/>")
    itself = '<asset><model name="k" file="itself.xml"/></asset><worldbody><attach model="k" prefix="x"/></worldbody>'
    (folder / "itself.xml").write_text(f"<mujoco>{itself}</mujoco>")
    with pytest.raises(InvalidInput, match=says):
        read(parent('<attach model="k" prefix="p"/>', head, asset), path=folder / "model.xml")


def test_documents_that_grow_are_refused(tmp_path):
    """Each attaches the next one forty times: 40⁹ bodies."""
    for level in range(9):
        inside = "".join(f'<attach model="k" prefix="{k}_"/>' for k in range(40))
        asset = f'<asset><model name="k" file="{level + 1}.xml"/></asset>'
        (tmp_path / f"{level}.xml").write_text(f"<mujoco>{asset}<worldbody>{inside}</worldbody></mujoco>")
    (tmp_path / "9.xml").write_text('<mujoco><worldbody><body name="b"><joint/></body></worldbody></mujoco>')
    with pytest.raises(InvalidInput, match=r"more than .* elements with what is attached"):
        read_model(tmp_path / "0.xml")
