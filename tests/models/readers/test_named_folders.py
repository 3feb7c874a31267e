"""Files that are looked for in folders that the user named, and below them."""

import pytest

from furiko.models.errors import InvalidInput
from furiko.models.readers import named_folders
from furiko.models.readers.named_folders import NamedFolders


def put(root, *names):
    """A file at each place; its content is the place."""
    for name in names:
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("package://arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("model://arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("package://arm/visual/../meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("package://leg/meshes/a.stl", "meshes/a.stl"),  # no such folder: the rest of the path, beside the document
        ("package://leg/other/b.stl", None),  # another robot's file of the same name
        ("package://leg/a.stl", None),
        ("package://arm", None),
        ("package:///c.stl", "c.stl"),  # what CAD exporters write: a path from the document's folder
        ("package://c.stl", "c.stl"),
        ("package:/c.stl", "c.stl"),  # as MuJoCo has it
        ("package:///meshes/a.stl", "meshes/a.stl"),
        ("package:///visual/a.stl", None),
        ("meshes/a.stl", "meshes/a.stl"),
        ("../arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("package://stock/meshes/a.stl", "meshes/a.stl"),  # the folder is the package
        ("/home/somebody/arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("file:///somewhere/deep/b.stl", "deep/b.stl"),
        ("file:///somewhere/b.stl", None),
        ("/home/somebody/leg/visual/a.stl", None),
        ("visual/a.stl", None),
        ("a/../../b.stl", "deep/b.stl"),
        ("flat/c.stl", "c.stl"),  # in the folder that is named
        ("gone.stl", None),
        ("..", None),
        ("/", None),
        ("", None),
        ("package://", None),
    ],
)
def test_what_a_name_means(tmp_path, name, found):
    stock = tmp_path / "stock"
    put(stock, "meshes/a.stl", "deep/arm/meshes/a.stl", "deep/leg/other/a.stl", "deep/b.stl", "c.stl")
    assert NamedFolders(stock / "model.xml", [stock]).find(name) == (None if found is None else stock / found)


def test_of_two_folders_the_first_that_has_the_end(tmp_path):
    put(tmp_path, "one/x/a.stl", "two/y/a.stl", "two/y/meshes/a.stl")
    folders = NamedFolders(tmp_path / "model.xml", [tmp_path / "one", tmp_path / "two"])
    assert folders.find("a.stl") == tmp_path / "one/x/a.stl"
    assert folders.find("meshes/a.stl") == tmp_path / "two/y/meshes/a.stl"


def test_what_the_folder_has_in_so_many_words_is_before_what_lies_deeper(tmp_path):
    """An absolute path of another machine, whose last parts two files have."""
    put(tmp_path, "mesh/a.stl", "deeper/mesh/a.stl")
    folders = NamedFolders(tmp_path / "robot.urdf", [tmp_path])
    assert folders.find("/home/somebody/robot/mesh/a.stl") == tmp_path / "mesh/a.stl"


def test_several_that_differ_are_said_and_copies_are_one(tmp_path):
    put(tmp_path, "x/meshes/a.stl", "y/meshes/a.stl")
    with pytest.raises(InvalidInput, match=r"name the folder .*: x/meshes/a\.stl and y/meshes/a\.stl differ"):
        NamedFolders(tmp_path / "model.xml", [tmp_path]).find("meshes/a.stl")
    (tmp_path / "y/meshes/a.stl").write_text("x/meshes/a.stl")
    assert NamedFolders(tmp_path / "model.xml", [tmp_path]).find("meshes/a.stl") == tmp_path / "x/meshes/a.stl"


def test_of_several_the_one_nearest_to_the_document(tmp_path):
    """A repository of several robots is named; each has its own meshes."""
    put(tmp_path, "robots/a/meshes/base.stl", "robots/b/meshes/base.stl", "robots/c/meshes/deep/base.stl")
    for robot in "ab":
        document = tmp_path / "robots" / robot / "urdf" / "model.urdf"
        found = NamedFolders(document, [tmp_path]).find("package://robot/meshes/base.stl")
        assert found == tmp_path / "robots" / robot / "meshes" / "base.stl"
    folders = NamedFolders(tmp_path / "robots" / "c" / "model.urdf", [tmp_path])
    assert folders.find("package://robot/meshes/base.stl") is None
    with pytest.raises(InvalidInput, match="name the folder"):
        folders.find("meshes/base.stl")


def manifest(folder, name, before=""):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(f"<package>{before}<name> {name} </name></package>")


def test_the_manifest_says_which_package_a_folder_is(tmp_path):
    """A checkout has another name than the package; another package beside has a file of the same path."""
    put(tmp_path, "arm-main/meshes/base.stl", "leg/meshes/base.stl")
    manifest(tmp_path / "arm-main", "arm", "<!-- <name>leg</name> -->")
    for document in ("arm-main/urdf/arm.urdf", "model.urdf", "leg/model.urdf"):
        folders = NamedFolders(tmp_path / document, [tmp_path])
        assert folders.find("package://arm/meshes/base.stl") == tmp_path / "arm-main/meshes/base.stl"
        assert folders.find("package://leg/meshes/base.stl") == tmp_path / "leg/meshes/base.stl"


def test_a_folder_that_says_it_is_another_package_has_no_files_of_this_one(tmp_path):
    put(tmp_path, "gripper/meshes/base.stl")
    document = tmp_path / "gripper" / "urdf" / "model.urdf"
    name = "package://arm/meshes/base.stl"
    assert NamedFolders(document, [tmp_path]).find(name) == tmp_path / "gripper/meshes/base.stl"
    manifest(tmp_path / "gripper", "gripper")
    assert NamedFolders(document, [tmp_path]).find(name) is None


def test_another_robots_file_is_not_taken(tmp_path):
    """It is the only one of the name, and of the path: the wrong mesh would be weighed."""
    put(tmp_path, "robots/other/meshes/base.stl", "robots/mine/urdf/readme.txt")
    document = tmp_path / "robots" / "mine" / "urdf" / "model.urdf"
    assert NamedFolders(document, [tmp_path]).find("package://mine/meshes/base.stl") is None
    assert NamedFolders(document, [tmp_path]).find("package://other/meshes/base.stl") is not None


def test_a_link_that_the_user_named_says_the_package(tmp_path):
    put(tmp_path, "stock/v2/meshes/base.stl")
    (tmp_path / "arm").symlink_to(tmp_path / "stock" / "v2")
    found = NamedFolders(tmp_path / "a" / "b.urdf", [tmp_path / "arm"]).find("package://arm/meshes/base.stl")
    assert found == tmp_path / "stock/v2/meshes/base.stl"


def test_nothing_outside_the_folders_and_no_link_out_of_them(tmp_path):
    put(tmp_path, "outside/a.stl", "outside/b.stl", "stock/deep/c.stl")
    (tmp_path / "stock/deep/a.stl").symlink_to(tmp_path / "outside/a.stl")
    (tmp_path / "stock/linked").symlink_to(tmp_path / "outside")
    (tmp_path / "stock/turning").symlink_to(tmp_path / "stock")
    (tmp_path / "stock/d.stl").symlink_to(tmp_path / "stock/deep/c.stl")
    folders = NamedFolders(tmp_path / "model.xml", [tmp_path / "stock"])
    for name in ("a.stl", "deep/a.stl", "b.stl", "linked/b.stl", "../outside/b.stl", str(tmp_path / "outside/b.stl")):
        assert folders.find(name) is None, name
    assert folders.find("c.stl") == tmp_path / "stock/deep/c.stl"
    assert folders.find("d.stl") == tmp_path / "stock/d.stl"


def test_a_folder_with_too_much_below_it_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(named_folders, "MOST_ENTRIES", 3)
    put(tmp_path, "stock/a.stl", "stock/b/c.stl", "stock/b/d/e.stl")
    folders = NamedFolders(tmp_path / "model.xml", [tmp_path / "stock"])
    assert folders.find("a.stl") == tmp_path / "stock/a.stl"  # not looked through for this one
    with pytest.raises(InvalidInput, match=r"more than 3 files and folders below it.*name a folder nearer"):
        folders.find("e.stl")
