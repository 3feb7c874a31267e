"""Meshes that are not where a file says, but in folders that the user has named."""

import struct

import numpy as np
import pytest
from handwritten_robots import mjcf, urdf_joint

from furiko.engines.model_files.robot_meshes import find_in


def tetrahedron():
    """The corner of a cube of one metre, of 1/6 m³, as binary STL."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype="<f4")
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    rows = (struct.pack("<12fH", 0, 0, 0, *corners[list(face)].ravel(), 0) for face in faces)
    return b" " * 80 + struct.pack("<I", len(faces)) + b"".join(rows)


@pytest.mark.parametrize("name", ["package://arm/meshes/t.stl", "meshes/t.stl", "elsewhere/t.stl", "../meshes/t.stl"])
def test_meshes_in_the_folders_that_are_named(read, tmp_path, name):
    """Where MuJoCo does not find a mesh it is looked for below them: as a whole path, then without its first parts."""
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


def test_no_mesh_outside_the_folders_that_are_named(tmp_path):
    outside, inside = tmp_path / "t.stl", tmp_path / "stock"
    outside.write_bytes(tetrahedron())
    (inside / "deep").mkdir(parents=True)
    (inside / "deep" / "link.stl").symlink_to(outside)
    for wanted in (
        "../t.stl",
        "/t.stl",
        "deep/../../t.stl",
        "deep/link.stl",
        "..",
        "/",
        "",
        str(outside),
        "file://" + str(outside),
    ):
        assert find_in([inside], wanted) is None, wanted
