"""Meshes that are not where a file says, but in folders that the user has named."""

import struct

import numpy as np
import pytest
from handwritten_robots import mjcf, urdf_joint

from furiko.diagnosis.model_files.diagnose import diagnose
from furiko.models.readers.model_file import read_model


def tetrahedron(edge=1.0):
    """The corner of a cube of this edge [m], of edge³/6 m³, as binary STL."""
    corners = edge * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype="<f4")
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    rows = (struct.pack("<12fH", 0, 0, 0, *corners[list(face)].ravel(), 0) for face in faces)
    return b" " * 80 + struct.pack("<I", len(faces)) + b"".join(rows)


@pytest.mark.parametrize("name", ["package://stock/meshes/t.stl", "meshes/t.stl", "elsewhere/t.stl", "../meshes/t.stl"])
def test_meshes_in_the_folders_that_are_named(read, tmp_path, name):
    """Where MuJoCo does not find a mesh it is looked for below them: by package or path, then the bare name in them."""
    (tmp_path / "stock" / "meshes").mkdir(parents=True)
    (tmp_path / "stock" / "meshes" / "t.stl").write_bytes(tetrahedron())
    text = f"""<robot name="r"><link name="world"/><link name="a">
        <collision><geometry><mesh filename="{name}"/></geometry></collision></link>
        {urdf_joint("continuous", "j", "world", "a")}</robot>"""
    with pytest.raises(ValueError, match=r"t\.stl"):
        read("mujoco", text)
    folders = [tmp_path / "stock", tmp_path / "stock" / "meshes"]
    assert read("mujoco", text, folders).compiled().bodies[-1].inertial.mass == pytest.approx(1000 / 6, rel=1e-6)


def test_meshes_of_a_mjcf_in_the_folders_that_are_named(read, tmp_path):
    (tmp_path / "stock").mkdir()
    (tmp_path / "stock" / "t.stl").write_bytes(tetrahedron())
    body = '<body name="a"><joint/><geom type="mesh" mesh="t"/></body>'
    asset = '<compiler meshdir="assets"/><asset><mesh name="t" file="visual/t.stl"/></asset>'
    robot = read("mujoco", mjcf(body, asset), [tmp_path / "stock"])
    assert robot.compiled().bodies[0].inertial.mass == pytest.approx(1000 / 6, rel=1e-6)


def collision(name, more=""):
    return f"""<robot name="r">{more}<link name="world"/><link name="a">
        <visual><geometry><mesh filename="package://arm/visual/t.stl"/></geometry></visual>
        <collision><geometry><mesh filename="{name}"/></geometry></collision></link>
        {urdf_joint("continuous", "j", "world", "a")}</robot>"""


def put(folder, edge):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "t.stl").write_bytes(tetrahedron(edge))


KEEP_VISUAL = '<mujoco><compiler discardvisual="false"/></mujoco>'


@pytest.mark.parametrize("more", ["", KEEP_VISUAL], ids=["visual meshes left out", "visual meshes kept"])
@pytest.mark.parametrize("name", ["package://arm/collision/t.stl", "../collision/t.stl", "model://arm/collision/t.stl"])
def test_meshes_of_one_name_below_the_folder_that_is_named(read, tmp_path, more, name):
    """Each is the one in the folder that the file says, however deep: 1000 kg/m³ of a tetrahedron of two metres."""
    put(tmp_path / "stock" / "robots" / "arm" / "visual", 1.0)
    put(tmp_path / "stock" / "robots" / "arm" / "collision", 2.0)
    robot = read("mujoco", collision(name, more), [tmp_path / "stock"])
    assert robot.compiled().bodies[-1].inertial.mass == pytest.approx(8000 / 6, rel=1e-6)


def test_a_mesh_where_the_file_says_beside_one_of_the_same_name_that_is_elsewhere(read, tmp_path):
    put(tmp_path / "collision", 2.0)
    put(tmp_path / "stock" / "arm" / "visual", 1.0)
    robot = read("mujoco", collision("collision/t.stl", KEEP_VISUAL), [tmp_path / "stock"])
    assert robot.compiled().bodies[-1].inertial.mass == pytest.approx(8000 / 6, rel=1e-6)


@pytest.mark.parametrize("name", ["package:///t.stl", "package://t.stl", "package:///deep/t.stl"])
def test_a_mesh_without_a_package_is_beside_the_file(tmp_path, name):
    """As CAD exporters write it; no folder need be named for that."""
    put(tmp_path / ("deep" if "deep" in name else ""), 2.0)
    path = tmp_path / "model.urdf"
    path.write_text(collision(name))
    for folders in ([], [tmp_path]):
        found = diagnose(path, engines=["mujoco"], meshes=folders)
        assert [finding.cause for finding in found.findings] == ["collision-weighs"], found.text()
        assert found.engines["mujoco"]["holds"]["bodies"][-1]["mass"] == pytest.approx(8000 / 6, rel=1e-6)


def test_furiko_and_mujoco_read_the_same_mesh(tmp_path):
    """The link has no inertial: MuJoCo weighs the mesh, and furiko weighs the same one to say so."""
    put(tmp_path / "stock" / "robots" / "arm" / "visual", 1.0)
    put(tmp_path / "stock" / "robots" / "arm" / "collision", 2.0)
    path = tmp_path / "model.urdf"
    path.write_text(collision("package://arm/collision/t.stl"))
    found = diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock"])
    assert [finding.cause for finding in found.findings] == ["collision-weighs"]


def test_two_that_the_name_may_mean_are_said(tmp_path):
    """Neither is taken; the folder of one of them says which it is."""
    put(tmp_path / "stock" / "one" / "arm" / "collision", 1.0)
    put(tmp_path / "stock" / "two" / "arm" / "collision", 2.0)
    path = tmp_path / "model.urdf"
    path.write_text(collision("package://arm/collision/t.stl"))
    found = diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock"])
    (finding,) = found.findings
    assert finding.cause == "file-refused"
    assert "of the one that is meant: one/arm/collision/t.stl and two/arm/collision/t.stl" in finding.says
    found = diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock" / "two"])
    assert [finding.cause for finding in found.findings] == ["collision-weighs"]


def test_a_mesh_of_another_robot_is_not_taken(tmp_path):
    """The only file of the name lies in another package: its mass would be that of another body."""
    put(tmp_path / "stock" / "leg" / "collision", 2.0)
    path = tmp_path / "model.urdf"
    path.write_text(collision("package://arm/collision/t.stl"))
    found = diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock"])
    assert found.verdict == "incomplete"
    (finding,) = found.findings
    assert finding.cause == "file-refused"
    assert "Name the folder" in finding.says


def test_an_unnamed_mesh_of_a_mjcf_below_the_folder_keeps_its_name(read, tmp_path):
    """MuJoCo names a mesh by its file."""
    put(tmp_path / "stock" / "deep" / "assets" / "visual", 2.0)
    body = '<body name="a"><joint/><geom type="mesh" mesh="t"/></body>'
    asset = '<compiler meshdir="assets"/><asset><mesh file="visual/t.stl"/></asset>'
    robot = read("mujoco", mjcf(body, asset), [tmp_path / "stock"])
    assert robot.compiled().bodies[0].inertial.mass == pytest.approx(8000 / 6, rel=1e-6)


PART = '<body name="a"><joint name="j"/><geom size="0.1" mass="1"/></body>'


@pytest.mark.parametrize("name", ["model.mjcf", "model.XML", "model"])
def test_meshes_of_a_file_of_any_name(tmp_path, name):
    """MuJoCo makes its ``MjSpec`` of ``.xml`` and ``.urdf`` alone; what is included lies beside the file."""
    put(tmp_path / "stock", 2.0)
    (tmp_path / "part.xml").write_text(f"<mujocoinclude>{PART}</mujocoinclude>")
    body = '<include file="part.xml"/><body name="b"><joint name="k"/><geom type="mesh" mesh="t"/></body>'
    path = tmp_path / name
    path.write_text(mjcf(body, '<asset><mesh name="t" file="t.stl"/></asset>'))
    found = diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock"])
    assert found.verdict == "agrees", found.text()
    assert [body["mass"] for body in found.engines["mujoco"]["holds"]["bodies"]] == pytest.approx([1, 8000 / 6])


def test_furiko_weighs_a_mesh_of_a_mjcf_below_the_folder(tmp_path):
    """As MuJoCo does, which is handed what furiko finds there."""
    put(tmp_path / "stock" / "deep" / "visual", 2.0)
    path = tmp_path / "model.xml"
    body = '<body name="a"><joint/><geom type="mesh" mesh="t"/></body>'
    path.write_text(mjcf(body, '<asset><mesh file="t.stl"/></asset>'))
    assert read_model(path, meshes=[tmp_path / "stock"]).spatial.bodies[0].inertial.mass == pytest.approx(8000 / 6)
    assert diagnose(path, engines=["mujoco"], meshes=[tmp_path / "stock"]).verdict == "agrees"
