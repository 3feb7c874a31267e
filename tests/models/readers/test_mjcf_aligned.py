"""Free bodies that MuJoCo moves to their centre of mass, along the principal axes, against its own compiler."""

import mujoco
import numpy as np
import pytest

from furiko.diagnosis.model_files.diagnose import diagnose
from furiko.models.errors import InvalidInput
from furiko.models.spatial import from_quaternion

from .compiled import read

TWO_GEOMS = (
    '<geom type="box" size=".1 .2 .3" pos=".1 .2 .3" euler="10 20 30"/><geom size=".1" pos="-1 .3 .2" mass="2"/>'
)
FULL = '<inertial pos=".1 .2 .3" mass="2" fullinertia="2 3 4 .1 .2 .3"/>'
CONTENTS = {
    "diaginertia": '<inertial pos=".1 .2 .3" mass="2" diaginertia="1 3 2" euler="5 6 7"/>',
    "diaginertia in a frame": '<frame euler="0 0 40"><inertial pos=".1 .2 .3" mass="2" diaginertia="1 3 2"/></frame>',
    "fullinertia": FULL,
    "one geom": '<geom type="box" size=".3 .1 .2" pos=".1 .2 .3" euler="10 20 30"/>',
    "one geom in a frame": '<frame pos="0 0 1" euler="0 40 0"><geom type="box" size=".3 .1 .2" euler="1 2 3"/></frame>',
    "one geom from point to point": '<geom type="ellipsoid" fromto="0 0 0 1 2 3" size=".1"/>',
    "one geom of two that weighs": '<geom type="box" size=".3 .1 .2" euler="10 20 30"/><geom size="1" mass="0"/>',
    "several geoms": TWO_GEOMS,
    "a mesh": '<geom type="mesh" mesh="t" pos="1 2 3" euler="10 20 30"/>',
    "tiny": '<inertial pos=".1 .2 .3" mass="1e-6" fullinertia="2e-9 3e-9 4e-9 1e-10 2e-10 3e-10"/>',
}
ASSET = '<asset><mesh name="t" vertex="0 0 0  1 0 0  0 2 0  0 0 3"/></asset>'


def text(inside, joint='<freejoint name="j" align="true"/>', compiler=""):
    return (
        f'<mujoco><compiler {compiler}/>{ASSET}<worldbody><body name="a" pos="1 2 3" euler="10 20 30">{joint}{inside}'
        "</body></worldbody></mujoco>"
    )


def both(document):
    """The first body as furiko reads it, and MuJoCo's model: the frame, mass, centre and tensor of each."""
    ours, model = read(document).bodies[0], mujoco.MjModel.from_xml_string(document)
    turned = from_quaternion(model.body_iquat[1])
    theirs = model.body_pos[1], from_quaternion(model.body_quat[1]), model.body_ipos[1]
    tensor = turned @ np.diag(model.body_inertia[1]) @ turned.T
    inertial = ours.inertial
    return (ours.position, from_quaternion(ours.quaternion), inertial.centre, inertial.tensor), (*theirs, tensor)


@pytest.mark.parametrize("kind", CONTENTS)
def test_the_frame_is_that_of_the_compiled_model(kind):
    """But for the sense of axes, which the documentation leaves open: turned by half a turn about one of them."""
    (place, turned, centre, tensor), (its_place, its_turned, its_centre, its_tensor) = both(text(CONTENTS[kind]))
    close = 3e-7 if kind == "a mesh" else 1e-12  # which MuJoCo turns to 1e-7 of its principal axes
    assert place == pytest.approx(its_place, abs=close)
    assert centre == pytest.approx(np.zeros(3), abs=1e-15)
    assert its_centre == pytest.approx(np.zeros(3), abs=1e-15)
    assert tensor == pytest.approx(its_tensor, abs=close * np.abs(its_tensor).max())
    if kind != "one geom from point to point":  # round about one axis
        assert np.abs(turned.T @ its_turned) == pytest.approx(np.eye(3), abs=1e-6 if kind == "a mesh" else 1e-11)


@pytest.mark.parametrize(
    ("joint", "compiler", "inside", "moved"),
    [
        ('<freejoint align="true"/>', "", FULL, True),
        ("<freejoint/>", "", FULL, False),
        ('<freejoint align="auto"/>', 'alignfree="true"', FULL, True),
        ("<freejoint/>", 'alignfree="true"', FULL, True),
        ('<joint type="free"/>', 'alignfree="true"', FULL, True),
        ('<freejoint align="false"/>', 'alignfree="true"', FULL, False),
        ('<freejoint align="true"/>', "", FULL + '<body name="b"><geom size=".1"/></body>', False),
        ('<freejoint align="true"/>', "", FULL + "<site/>", True),
        ('<freejoint align="true"/>', 'settotalmass="7"', FULL, True),
        ('<freejoint align="true"/>', 'boundinertia="3"', FULL, True),
    ],
)
def test_which_bodies_are_moved(joint, compiler, inside, moved):
    (place, turned, centre, tensor), (its_place, its_turned, its_centre, its_tensor) = both(
        text(inside, joint, compiler)
    )
    assert place == pytest.approx(its_place, abs=1e-12)
    assert centre == pytest.approx(its_centre, abs=1e-12)
    assert tensor == pytest.approx(its_tensor, abs=1e-11)
    assert bool((place != [1, 2, 3]).any()) is moved
    if not moved:
        assert turned == pytest.approx(its_turned, abs=1e-12)


def test_what_is_moved_is_said():
    (note,) = read(text(FULL)).notes
    assert note.startswith("body 'a': its frame is moved to its centre of mass")
    assert read(text(FULL, "<freejoint/>")).notes == []


@pytest.mark.parametrize("kind", CONTENTS)
def test_mass_matrix_and_bias_are_mujocos(kind, tmp_path):
    """The mass matrix is diagonal there; both are held against the proven ones of what MuJoCo holds."""
    path = tmp_path / "aligned.xml"
    path.write_text(text(CONTENTS[kind], '<joint name="j" type="free" armature="0.2"/>', 'alignfree="true"'))
    found = diagnose(path, engines=["mujoco"])
    assert found.verdict == "agrees", found.text()
    assert any("moved to its centre of mass" in note for note in found.notes)
    assert len(found.engines["mujoco"]["measured"]) == 4


@pytest.mark.parametrize("how", ['fusestatic="true"', ""])
def test_what_is_fused_first_is_refused(how):
    """MuJoCo makes one body of both, and aligns that, unless something in the file names the second."""
    fuse = "" if how else 'fuse="true"'
    second = f'<body name="b" pos="0 0 1" {fuse}><geom size=".1"/></body>'
    with pytest.raises(InvalidInput, match=r"align beside fusestatic: .* or align='false'"):
        read(text(FULL + second, compiler=how))
    moving = second.replace("<geom", "<joint/><geom")
    assert read(text(FULL + moving, compiler=how)).bodies[0].position == pytest.approx([1, 2, 3])


def test_mujocos_own_extension_of_urdf_aligns_too(tmp_path):
    path = tmp_path / "aligned.urdf"
    path.write_text(
        """<robot name="r"><mujoco><compiler alignfree="true"/></mujoco><link name="world"/><link name="a"><inertial>
        <origin xyz=".1 .2 .3"/><mass value="2"/><inertia ixx="2" iyy="3" izz="4" ixy=".1" ixz=".2" iyz=".3"/>
        </inertial></link><joint name="j" type="floating"><parent link="world"/><child link="a"/></joint></robot>"""
    )
    found = diagnose(path, engines=["mujoco"])
    assert [finding.cause for finding in found.findings] == ["extension-honoured"], found.text()
    assert any('alignfree="true" in <mujoco> is honoured by MuJoCo alone' in note for note in found.notes)


@pytest.mark.parametrize("engine", ["pinocchio-aba", "drake"])
def test_an_engine_that_keeps_the_frame_is_named_for_it(engine, tmp_path):
    pytest.importorskip({"drake": "pydrake", "pinocchio-aba": "pinocchio"}[engine])
    path = tmp_path / "aligned.xml"
    path.write_text(text(FULL))
    found = diagnose(path, engines=[engine])
    assert [finding.cause for finding in found.findings] == ["align-ignored"], found.text()
    assert "Instead, write align='false'" in found.findings[0].says
    path.write_text(text(CONTENTS["fullinertia"], "<freejoint/>"))
    assert diagnose(path, engines=[engine]).verdict == "agrees"
