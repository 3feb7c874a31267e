"""MJCF and URDF as furiko reads them: against MuJoCo's own compiler, and against files that mean harm."""

import math
import time

import numpy as np
import pytest

import furiko
from furiko.models import InvalidInput, document_catalogue, find_scene, to_mjcf, to_urdf
from furiko.models.readers.model_file import model_from_text, read_model
from furiko.models.readers.xml_file import parse_xml, write_xml


def mjcf(world, head=""):
    return f"<mujoco>{head}<worldbody>{world}</worldbody></mujoco>"


def body(inside="", **attributes):
    given = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    return f'<body {given}><joint axis="0 -1 0"/><inertial pos="0 0 -1" mass="1" diaginertia="1 1 1"/>{inside}</body>'


@pytest.mark.parametrize("name", [name for name in document_catalogue() if find_scene(name).system.n <= 50])
@pytest.mark.parametrize("write", [to_mjcf, to_urdf])
def test_what_furiko_writes_it_reads_back_exactly(name, write):
    system = find_scene(name).system
    found = model_from_text(write(system)).mechanism
    for got, asked in zip(found.links, system.tree().links, strict=True):
        assert (got.parent, got.hinge, got.com, got.mass) == (asked.parent, asked.hinge, asked.com, asked.mass)
        assert got.inertia == asked.inertia
    assert all(hinge.ideal for hinge in found.hinges)


FEATURES = {
    "degrees are the default": body(euler="0 30 0"),
    "frames": f'<frame pos="1 2 3" euler="0 20 0">{body(pos="0 0 1")}</frame>',
    "axisangle": body(axisangle="0 1 0 40"),
    "xyaxes": body(xyaxes="1 0 0.5 0 1 0"),
    "zaxis": body(zaxis="0.3 0 1"),
    "nested and fixed": body(body().replace('<joint axis="0 -1 0"/>', "") + body(pos="0 0 -2")),
    "capsule": '<body><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .1 0 1" size=".05"/></body>',
    "other shapes": '<body><joint axis="0 1 0" pos="0 0 .5"/><geom type="box" size=".1 .2 .3" euler="10 20 30"/>'
    '<geom size=".2" pos="0 0 1" density="500"/><geom type="cylinder" size=".1 .4" mass="2" pos=".1 0 0"/>'
    '<geom type="ellipsoid" size=".1 .2 .3" pos="0 0 -1"/><geom type="mesh" mesh="m" mass="0"/></body>',
    "full inertia": '<body><joint axis="0 1 0"/>'
    '<inertial pos="0 .1 1" mass="2" fullinertia="1 2 2.5 .1 .2 .3"/></body>',
    "turned inertia": '<body><joint axis="0 1 0"/>'
    '<inertial pos="0 0 1" mass="2" diaginertia="1 2 2.5" euler="20 30 40"/></body>',
    "two hinges on one body": '<body><joint axis="0 1 0"/><joint axis="0 -1 0" pos="0 0 1"/>'
    '<inertial pos="0 0 2" mass="1" diaginertia="1 1 1"/></body>',
    "hinge properties": '<body><joint axis="0 1 0" damping=".1" armature=".2" frictionloss=".3" stiffness="4" '
    'springref="15" ref="10" range="-30 90"/><geom size=".1" pos="0 0 1"/></body>',
}
HEADS = {
    "": "",
    "classes": '<default><joint damping="0.4"/><geom density="300"/>'
    '<default class="other"><joint armature="1"/></default></default>',
    "total mass": '<compiler settotalmass="7"/>',
    "geoms rule": '<compiler inertiafromgeom="true" autolimits="true"/>',
}


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize("feature", FEATURES)
def test_mjcf_is_read_as_mujoco_compiles_it(feature, head):
    from furiko.engines.model_files.mujoco import MujocoFile

    world = FEATURES[feature]
    if head == "geoms rule" and "geom" not in world:
        pytest.skip("nothing to weigh")
    file = model_from_text(mjcf(world, HEADS[head]))
    ours, theirs = file.mechanism, MujocoFile(file).compiled()
    assert ours.n == theirs.n
    for a, b in zip(ours.links, theirs.links, strict=True):
        # MuJoCo rotates through quaternions and principal axes: some tens of roundings of the largest moment.
        numbers = ([*x.hinge, *x.com, x.mass, x.inertia] for x in (a, b))
        np.testing.assert_allclose(*numbers, rtol=1e-12, atol=1e-13)
    for a, b in zip(ours.hinges, theirs.hinges, strict=True):
        for name in ("armature", "damping", "friction", "stiffness", "sense", "zero"):
            assert getattr(a, name) == pytest.approx(getattr(b, name), rel=1e-13), name
        if a.stiffness:
            assert a.rest == pytest.approx(b.rest, rel=1e-13)
        assert (a.limits is None) == (b.limits is None)
        if a.limits:
            assert a.limits == pytest.approx(b.limits, rel=1e-13)


def test_classes_reach_their_children():
    head = '<default><default class="stiff"><joint stiffness="2"/></default></default>'
    world = body(body(childclass="stiff", pos="0 0 -1"))
    assert [h.stiffness for h in model_from_text(mjcf(world, head)).mechanism.hinges] == [0, 2]


def test_what_is_switched_off_is_not_read_as_on():
    head = '<option><flag gravity="disable" damper="disable" constraint="disable"/></option>'
    world = body().replace("/><inertial", ' damping="1" frictionloss="1" range="-1 1" limited="true"/><inertial', 1)
    (hinge,) = (found := model_from_text(mjcf(world, head)).mechanism).hinges
    assert hinge.ideal
    assert found.gravity == (0, 0)


def test_a_file_may_include_another_of_its_folder(tmp_path):
    (tmp_path / "part.xml").write_text(f"<mujocoinclude>{body()}</mujocoinclude>")
    (tmp_path / "model.xml").write_text(mjcf('<include file="part.xml"/>'))
    assert read_model(tmp_path / "model.xml").mechanism.n == 1


URDF = """<robot name="r"><link name="base"/><link name="arm">
<inertial><origin xyz="0 0 -1" rpy="1.5707963267948966 0 0"/>
<mass value="2"/><inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="package://nowhere/arm.dae"/></geometry></visual></link>
<joint name="j" type="{kind}"><parent link="{parent}"/><child link="arm"/><axis xyz="0 1 0"/>
<dynamics damping="0.1" friction="0.2"/>{more}</joint></robot>"""


def test_urdf_turns_the_inertia_and_leaves_meshes_alone():
    file = model_from_text(URDF.format(kind="continuous", parent="base", more=""))
    (link,) = file.mechanism.links
    assert link.inertia == pytest.approx(2.5, rel=1e-15)  # by hand: a quarter turn about x takes z to y
    assert file.mechanism.hinges[0].damping == 0.1
    assert "mesh" not in file.text


def test_a_joint_on_a_world_that_is_not_declared_is_drakes_way():
    text = URDF.replace('<link name="base"/>', "").format(kind="continuous", parent="world", more="")
    assert model_from_text(text).mechanism.n == 1


def test_a_plane_turned_in_space_is_the_same_mechanism():
    plain = model_from_text(mjcf(body(body(pos="0.1 0 -1")))).mechanism
    turned = model_from_text(
        mjcf(
            f'<frame euler="90 0 0">{body(body(pos="0.1 0 -1"))}</frame>',
            '<option gravity="0 9.81 0"/>',
        )
    ).mechanism
    # A quarter turn about x takes −z to +y: the links hang along gravity as before.
    assert math.hypot(*turned.gravity) == pytest.approx(9.81)
    for a, b in zip(plain.links, turned.links, strict=True):
        assert math.hypot(*a.com) == pytest.approx(math.hypot(*b.com))
        assert a.inertia == pytest.approx(b.inertia)


def test_a_document_type_that_declares_nothing_is_passed_over():
    assert model_from_text(f"<!DOCTYPE mujoco>{mjcf(body())}").mechanism.n == 1


LONG = "".join(f'<body name="b{i}"/>' for i in range(100_000))
BOMB = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]><mujoco>&b;</mujoco>'
HOSTILE = {
    "nothing": ("", "not well-formed|no XML"),
    "no XML": ("hello", "not well-formed"),
    "cut off": ("<mujoco><worldbody>", "not well-formed"),
    "another format": ("<sdf/>", "MJCF.*URDF.*needed"),
    "entities": (BOMB, "document type declaration"),
    "outside document type": ('<!DOCTYPE r SYSTEM "r.dtd"><robot/>', "document type"),
    "outside entity": ('<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot>&x;</robot>', "document type"),
    "100 000 links": (mjcf(LONG), "elements"),
    "2 001 bodies": (mjcf(LONG[: LONG.index("b2001") - 12]), "more than 2000 bodies"),
    "100 000 hinges": (mjcf(LONG.replace("/>", "><joint/></body>")), "more than"),
    "nested too deep": (mjcf("<body>" * 5000 + "</body>" * 5000), "deep"),
    "NaN": (mjcf(body(pos="0 nan 0")), "finite number"),
    "infinite mass": (mjcf(body().replace('mass="1"', 'mass="1e999"')), "finite number"),
    "no number": (mjcf(body(pos="0 a 0")), "'a' is no number"),
    "too few numbers": (mjcf(body(pos="0 0")), "3 numbers needed, got 2"),
    "a long attribute": (mjcf(body(pos="0 " * 20_000)), "characters"),
    "negative mass": (mjcf(body().replace('mass="1"', 'mass="-1"')), "must not be negative"),
    "no axis": (mjcf(body().replace("0 -1 0", "0 0 0")), "direction"),
    "no body": (mjcf(""), "no hinge"),
    "two of a name": (mjcf(body(name="a") + body(name="a")), "unique"),
    "no such class": (mjcf(body(childclass="none")), "no <default>"),
    "another plane": (mjcf(body(body(pos="0 0 -1", euler="30 0 0"))), "turned by 30°"),
    "a slide": (mjcf(body().replace("<joint ", '<joint name="rail" type="slide" ')), "'rail'.*type 'slide'"),
    "a ball": (mjcf(body().replace("<joint ", '<joint type="ball" ')), "type 'ball'"),
    "free": (mjcf("<body><freejoint/></body>"), "type 'free'"),
    "copies": (mjcf('<replicate count="1000000"><body/></replicate>'), "copies"),
    "a plugin": ('<mujoco><extension><plugin plugin="x"/></extension></mujoco>', "no hinge"),
    "weighed by a mesh": (mjcf('<body><joint/><geom type="mesh" mesh="m"/></body>'), "no <mesh> of that name"),
    "include of anything": (mjcf('<include file="/etc/passwd"/>'), "outside the model's own folder"),
    "include above": (mjcf('<include file="../secret.xml"/>'), "outside the model's own folder"),
    "include of nothing": (mjcf('<include file="missing.xml"/>'), "cannot be read"),
    "weightless": (mjcf(body().replace('mass="1"', 'mass="0"').replace("1 1 1", "0 0 0")), "not determined"),
    "xacro": ('<robot><xacro:macro/></robot>', "xacro|not well-formed"),
    "prismatic": (URDF.format(kind="prismatic", parent="base", more=""), "'j'.*type 'slide'"),
    "unknown link": (URDF.format(kind="continuous", parent="nobody", more=""), "no such link"),
    "its own parent": (URDF.format(kind="continuous", parent="arm", more=""), "loop|have no parent|carry all"),
    "two roots": ('<robot><link name="a"/><link name="b"/></robot>', "2 links have no parent"),
    "a circle": (
        '<robot><link name="a"/><link name="b"/><link name="c"/>'
        '<joint name="1" type="fixed"><parent link="b"/><child link="c"/></joint>'
        '<joint name="2" type="fixed"><parent link="c"/><child link="b"/></joint></robot>',
        "loop",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", HOSTILE)
def test_a_bad_file_ends_in_one_line_that_names_it(tmp_path, case):
    content, says = HOSTILE[case]
    path = tmp_path / "model.xml"
    path.write_text(content)
    begun = time.perf_counter()
    with pytest.raises(InvalidInput, match=says) as caught:
        assert read_model(path).mechanism  # what can be read, but is no planar tree, is refused here
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 600
    assert time.perf_counter() - begun < 5  # measured: 0.4 s for the longest


def test_includes_in_a_circle_end(tmp_path):
    (tmp_path / "a.xml").write_text('<mujoco><include file="b.xml"/></mujoco>')
    (tmp_path / "b.xml").write_text('<mujoco><include file="a.xml"/></mujoco>')
    with pytest.raises(InvalidInput, match="included twice, or by itself"):
        read_model(tmp_path / "a.xml")


def test_an_include_that_is_a_link_to_outside_is_outside(tmp_path):
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "secret.xml").write_text("<mujoco/>")
    (inside / "link.xml").symlink_to(tmp_path / "secret.xml")
    (inside / "model.xml").write_text(mjcf('<include file="link.xml"/>'))
    with pytest.raises(InvalidInput, match="outside the model's own folder"):
        read_model(inside / "model.xml")


@pytest.mark.parametrize("size", [8_000_001, 9_000_000])
def test_a_huge_file_is_not_read(tmp_path, size):
    path = tmp_path / "model.xml"
    with path.open("wb") as stream:
        stream.truncate(size)
    with pytest.raises(InvalidInput, match="larger than 8,000,000 bytes"):
        read_model(path)


@pytest.mark.parametrize("path", ["missing.xml", "", "\0", "/dev"])
def test_what_is_no_file(path):
    with pytest.raises(InvalidInput):
        read_model(path)


@pytest.mark.parametrize("comment", ["<!-- left -- right -->", "<!---- a\n-- b --->", "<!--- <a> -->"])
def test_comments_may_have_two_hyphens(comment):
    """MuJoCo, Pinocchio and Drake read them; lines are counted as they stand."""
    root = parse_xml(f"<mujoco>{comment}\n<a/><!-- plain --><b c='1'/></mujoco>".encode(), "m")
    assert [(child.tag, child.line) for child in root.children] == [(t, comment.count("\n") + 2) for t in "ab"]
    with pytest.raises(InvalidInput, match=f"line {comment.count(chr(10)) + 2}: not well-formed"):
        parse_xml(f"<mujoco>{comment}\n<a</mujoco>".encode(), "m")


def test_a_comment_without_end_is_refused_in_no_time():
    with pytest.raises(InvalidInput, match="not well-formed"):
        parse_xml(b"<mujoco>" + b"<!-- -- " * 500_000, "m")


def test_xml_is_written_as_it_was_read():
    text = b'<a x="1 &lt; 2" y=\'"\'><b/><c><d z="&#233;"/></c></a>'
    root = parse_xml(text, "text")
    again = parse_xml(write_xml(root).encode(), "text")
    assert (again.attributes, [c.tag for c in again.children]) == (root.attributes, [c.tag for c in root.children])
    assert again.children[1].children[0].get("z") == "é"


def test_reading_imports_no_engine():
    import subprocess
    import sys

    engines = "{'mujoco', 'pinocchio', 'exudyn'}"
    code = f"import sys, furiko.models.readers.model_file; print(sorted({engines} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
    assert furiko.InvalidInput is InvalidInput
