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
        ("package://leg/meshes/a.stl", "meshes/a.stl"),  # what is there in so many words, before what is below
        ("meshes/a.stl", "meshes/a.stl"),
        ("../arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("package://stock/meshes/a.stl", "meshes/a.stl"),  # the folder is the package
        ("/home/somebody/arm/meshes/a.stl", "deep/arm/meshes/a.stl"),
        ("file:///somewhere/b.stl", "deep/b.stl"),
        ("a/../../b.stl", "deep/b.stl"),
        ("gone.stl", None),
        ("..", None),
        ("/", None),
        ("", None),
        ("package://", None),
    ],
)
def test_the_longest_end_of_the_path_wins(tmp_path, name, found):
    stock = tmp_path / "stock"
    put(stock, "meshes/a.stl", "deep/arm/meshes/a.stl", "deep/leg/other/a.stl", "deep/b.stl")
    assert NamedFolders(stock / "model.xml", [stock]).find(name) == (None if found is None else stock / found)


def test_of_two_folders_the_first_that_has_the_end(tmp_path):
    put(tmp_path, "one/x/a.stl", "two/y/a.stl", "two/y/meshes/a.stl")
    folders = NamedFolders(tmp_path / "model.xml", [tmp_path / "one", tmp_path / "two"])
    assert folders.find("a.stl") == tmp_path / "one/x/a.stl"
    assert folders.find("meshes/a.stl") == tmp_path / "two/y/meshes/a.stl"


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
    with pytest.raises(InvalidInput, match="name the folder"):
        NamedFolders(tmp_path / "robots" / "c" / "model.urdf", [tmp_path]).find("package://robot/meshes/base.stl")


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
