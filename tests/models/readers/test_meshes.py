"""Meshes: closed forms of a box, a tetrahedron and a frame, MuJoCo's compiled meshes, and files that mean harm."""

import itertools
import struct

import numpy as np
import pytest

from furiko.models import InvalidInput
from furiko.models.readers import meshes
from furiko.models.readers.meshes import MODES, checked_mesh, mesh_inertial, read_mesh
from furiko.models.spatial import from_quaternion

BOX = np.array(list(itertools.product((0.0, 1.0), (0.0, 2.0), (0.0, 3.0))))
# Each side as seen from outside, counter-clockwise; corner number = 4 x + 2 y + z of its ends.
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = np.array([half for a, b, c, d in SIDES for half in ((a, b, c), (a, c, d))])
# A box with a notch: an L of three unit cubes, not convex. Its outline in x and y, and the cut of its two ends.
L_OUTLINE = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], dtype=float)
L_ENDS = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]


def box():
    return checked_mesh("box", BOX, TRIANGLES)


def bracket():
    low, high = (np.column_stack([L_OUTLINE, np.full(6, z)]) for z in (0.0, 1.0))
    faces = [(c, b, a) for a, b, c in L_ENDS] + [(a + 6, b + 6, c + 6) for a, b, c in L_ENDS]
    for i in range(6):
        j = (i + 1) % 6
        faces += [(i, j, j + 6), (i, j + 6, i + 6)]
    return checked_mesh("bracket", np.concatenate([low, high]), np.array(faces))


@pytest.mark.parametrize("mode", ["legacy", "exact", "convex"])
@pytest.mark.parametrize("scale", [(1, 1, 1), (2, 0.5, 3), (-1, 1, 1), (-2, -3, -1)])
def test_a_box_weighs_what_the_textbook_says(mode, scale):
    found = mesh_inertial(box(), mode, scale)
    sides = np.abs(np.array(scale) * [1, 2, 3])
    volume = sides.prod()
    # A few sums of products of numbers of the size of the result.
    np.testing.assert_allclose(found.mass, volume, rtol=1e-14)
    np.testing.assert_allclose(found.centre, np.array(scale) * [0.5, 1, 1.5], rtol=1e-14)
    squares = sides**2
    np.testing.assert_allclose(
        found.tensor, np.diag(volume / 12 * (squares.sum() - squares)), rtol=1e-13, atol=1e-13 * volume
    )


def test_the_shell_of_a_box():
    found = mesh_inertial(box(), "shell")
    assert found.mass == pytest.approx(2 * (2 + 3 + 6), rel=1e-15)
    # Each pair of sides: a plate's own second moment of x, and that of its distance from the middle.
    x_across, x_along = 2 * 6 * 0.25, 2 * (2 + 3) * 1 / 12
    y_across, y_along = 2 * 3 * 1.0, 2 * (2 + 6) * 4 / 12
    assert found.tensor[2, 2] == pytest.approx(x_across + x_along + y_across + y_along, rel=1e-14)


def test_what_is_not_convex():
    solid = mesh_inertial(bracket(), "exact")
    # Three unit cubes with centres (½, ½), (3/2, ½), (½, 3/2): each 1/6 about its own centre, and distances squared.
    assert solid.mass == pytest.approx(3, rel=1e-14)
    np.testing.assert_allclose(solid.centre, [5 / 6, 5 / 6, 0.5], rtol=1e-14)
    assert solid.tensor[2, 2] == pytest.approx(3 / 6 + 2 / 9 + 5 / 9 + 5 / 9, rel=1e-14)
    # The hull has half a unit square more.
    assert mesh_inertial(bracket(), "convex").mass == pytest.approx(3.5, rel=1e-14)


def test_refpos_and_refquat_come_before_scale():
    turn = (1.0, 0.2, -0.3, 0.4)
    found = mesh_inertial(box(), "exact", (2, 1, 1), (1, 2, 3), turn)
    expected = (from_quaternion(turn).T @ (np.array([0.5, 1, 1.5]) - [1, 2, 3])) * [2, 1, 1]
    np.testing.assert_allclose(found.centre, expected, rtol=1e-14)


def stl(mesh):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *mesh.vertices[f].ravel(), 0) for f in mesh.faces)
    return b"solid is how this header begins".ljust(80) + struct.pack("<I", len(mesh.faces)) + body


def row(point):
    return " ".join(repr(float(x)) for x in point)


def text_stl(mesh):
    facets = ("\n".join(f"vertex {row(v)}" for v in mesh.vertices[f]) for f in mesh.faces)
    return ("solid x\n" + "\n".join(f"facet normal 0 0 0\nouter loop\n{f}\nendloop\nendfacet" for f in facets)).encode()


def obj(mesh):
    lines = ["# a box", *(f"v {row(v)}" for v in mesh.vertices)]
    return "\n".join([*lines, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.faces)]).encode()


def msh(mesh):
    n = len(mesh.vertices)
    head = struct.pack("<4i", n, n, 0, len(mesh.faces))
    points = mesh.vertices.astype("<f4").tobytes()
    return head + points + points + mesh.faces.astype("<i4").tobytes()


FORMATS = {"m.stl": stl, "m.STL": text_stl, "m.obj": obj, "m.msh": msh}


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_read(tmp_path, name):
    (tmp_path / name).write_bytes(FORMATS[name](bracket()))
    found = mesh_inertial(read_mesh(tmp_path / name), "exact")
    assert found.mass == pytest.approx(3, rel=1e-14)
    np.testing.assert_allclose(found.centre, [5 / 6, 5 / 6, 0.5], rtol=1e-14)


def test_an_obj_may_have_normals_and_textures_and_count_backwards(tmp_path):
    faces = "\n".join(f"f {a + 1}/1/1 {b - 8}//1 {c + 1}/1" for a, b, c in TRIANGLES)
    (tmp_path / "m.obj").write_bytes(obj(box()).split(b"\nf")[0] + f"\nvn 0 0 1\nvt 0 0\n{faces}".encode())
    assert mesh_inertial(read_mesh(tmp_path / "m.obj"), "exact").mass == pytest.approx(6, rel=1e-14)


def compiled(folder, name, mode, scale):
    """Mass, centre, tensor of a body that MuJoCo weighs by the mesh in a file, at a density of one."""
    import mujoco

    path = folder / "model.xml"
    path.write_text(
        f'<mujoco><asset><mesh name="m" file="{name}" inertia="{mode}" scale="{scale}" refpos=".1 .2 .3"'
        ' refquat="1 .5 0 .2"/></asset><worldbody><body><joint/><geom type="mesh" mesh="m" density="1"/></body>'
        "</worldbody></mujoco>"
    )
    model = mujoco.MjModel.from_xml_path(str(path))
    turn = from_quaternion(model.body_iquat[1])
    return model.body_mass[1], model.body_ipos[1], turn @ np.diag(model.body_inertia[1]) @ turn.T


def rough(seed=3):
    """A box and a bracket whose corners are shaken: no symmetry, not convex, single precision."""
    generator = np.random.default_rng(seed)
    both = [box(), bracket()]
    points = np.concatenate([both[0].vertices, both[1].vertices + 5]) + generator.normal(0, 0.1, (20, 3))
    faces = np.concatenate([both[0].faces, both[1].faces + 8])
    return checked_mesh("rough", points.astype(np.float32).astype(float), faces)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("scale", ["1 1 1", "2 -.5 1.5"])
@pytest.mark.parametrize("name", ["m.stl", "m.obj", "m.msh"])
def test_meshes_weigh_what_mujoco_makes_of_them(tmp_path, name, mode, scale):
    (tmp_path / name).write_bytes(FORMATS[name](rough()))
    mass, centre, tensor = compiled(tmp_path, name, mode, scale)
    stretch = [float(s) for s in scale.split()]
    found = mesh_inertial(read_mesh(tmp_path / name), mode, stretch, (0.1, 0.2, 0.3), (1, 0.5, 0, 0.2))
    assert found.mass == pytest.approx(mass, rel=1e-13)  # sums over some tens of triangles
    np.testing.assert_allclose(found.centre, centre, rtol=1e-12)
    # MuJoCo turns to the principal axes until what is off the diagonal is below 1e-12 of it; the axes are then right
    # to the square root of that.
    np.testing.assert_allclose(found.tensor, tensor, rtol=0, atol=1e-6 * np.abs(tensor).max())


QUAD = b"v 0 0 0\nv 1 0 0\nv 1.2 1 .4\nv 0 1 0\nv .4 .3 2\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"


@pytest.mark.parametrize("more", [b"", b"o second\nf 1 3 5\nf 5 4 2\n", b"g second\nv 9 9 9\nf 1 6 5\nf 5 6 2\n"])
@pytest.mark.parametrize("first", [b"f 4 3 2 1", b"f 1 4 3 2"])  # the shorter diagonal is the first, the second
def test_four_corners_and_several_objects_are_read_as_mujoco_does(tmp_path, first, more):
    (tmp_path / "m.obj").write_bytes(b"o first\n" + QUAD.replace(b"f 4 3 2 1", first) + more)
    mass, centre, _ = compiled(tmp_path, "m.obj", "legacy", "1 1 1")
    found = mesh_inertial(read_mesh(tmp_path / "m.obj"), "legacy", (1, 1, 1), (0.1, 0.2, 0.3), (1, 0.5, 0, 0.2))
    assert found.mass == pytest.approx(mass, rel=1e-13)
    np.testing.assert_allclose(found.centre, centre, rtol=1e-12)


def test_vertices_alone_are_their_hull():
    mesh = checked_mesh("points", BOX, np.zeros((0, 3), dtype=np.int64))
    assert mesh_inertial(mesh, "legacy").mass == pytest.approx(6, rel=1e-14)


BAD = {
    "m.dae": (b"<COLLADA/>", "STL, OBJ and MSH"),
    "m": (b"", "STL, OBJ and MSH"),
    "empty.stl": (b"", "size"),
    "short.stl": (stl(box())[:-1], "size|vertex"),
    "many.stl": (b" " * 80 + struct.pack("<I", 2**32 - 1), "size"),
    "nan.stl": (stl(box()).replace(struct.pack("<f", 3), struct.pack("<f", np.nan)), "no number"),
    "words.stl": (b"solid\nvertex a b c\nvertex 1 2 3\nvertex 1 2 3", "not a mesh"),
    "ragged.stl": (b"solid\nvertex 1 2\nvertex 1 2 3\nvertex 1 2 3", "not a mesh"),
    "negative.msh": (struct.pack("<4i", -1, 0, 0, 0), "size"),
    "huge.msh": (struct.pack("<4i", 2**31 - 1, 0, 0, 2**31 - 1), "size"),
    "index.msh": (struct.pack("<4i", 3, 0, 0, 1) + bytes(36) + struct.pack("<3i", 0, 1, 7), "does not exist"),
    "index.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4", "not a mesh|does not exist"),
    "before.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9", "does not exist"),
    "corners.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1" * 100, "corners"),
    "nothing.obj": (b"hello", "vertices|not a mesh"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_mesh_is_refused(tmp_path, name):
    content, says = BAD[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InvalidInput, match=says) as caught:
        read_mesh(tmp_path / name)
    assert str(caught.value).startswith(str(tmp_path / name))


def test_sizes_are_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr(meshes, "MOST_FACES", 11)
    for name, write in FORMATS.items():
        (tmp_path / name).write_bytes(write(box()))  # twelve triangles
        with pytest.raises(InvalidInput, match=r"11|three a triangle"):
            read_mesh(tmp_path / name)
    monkeypatch.setattr(meshes, "LARGEST_MESH", 100)
    with pytest.raises(InvalidInput, match="larger than 100 bytes"):
        read_mesh(tmp_path / "m.stl")


def test_what_weighs_nothing_is_refused():
    inside_out = checked_mesh("box", BOX, TRIANGLES[:, ::-1])
    with pytest.raises(InvalidInput, match="face inwards"):
        mesh_inertial(inside_out, "exact")
    with pytest.raises(InvalidInput, match="one sense"):
        mesh_inertial(checked_mesh("box", BOX, np.concatenate([TRIANGLES[:6], TRIANGLES[6:, ::-1]])), "exact")
    with pytest.raises(InvalidInput, match="shell"):
        mesh_inertial(checked_mesh("flat", BOX * [1, 1, 0], TRIANGLES), "legacy")
    with pytest.raises(InvalidInput, match="surface"):
        mesh_inertial(checked_mesh("dot", BOX * 0, TRIANGLES), "legacy")
    with pytest.raises(InvalidInput, match="hull"):
        mesh_inertial(checked_mesh("flat", BOX * [1, 1, 0], TRIANGLES), "convex")
