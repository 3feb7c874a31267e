"""Environments that furiko makes: once, whole or not at all, by one at a time. The installer is a fake."""

import json
import multiprocessing
import os
import time
from pathlib import Path

import pytest
from places import environment

from furiko.engines import engine_place, engine_version, why_missing
from furiko.engines.places import environments, index, installing
from furiko.engines.places.environments import all_kept, ensure, environments_folder, kept, kept_name, remove
from furiko.engines.places.installing import Installer, NotInstalled
from furiko.models import EngineMissing, InvalidInput


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(index, "near", lambda package, version: ["3.12.0", "3.13.0"])
    monkeypatch.setattr(environments, "near", index.near)
    monkeypatch.setattr("furiko.engines.places.engines.provider", lambda package, version: package)


@pytest.fixture
def made(monkeypatch):
    """What was installed. The environment is one that sees this one's packages."""
    asked = []
    monkeypatch.setattr(Installer, "create", lambda self, folder: environment(folder))
    monkeypatch.setattr(Installer, "install", lambda self, python, requirements: asked.append(requirements))
    return asked


def test_it_is_made_once_with_what_it_needs_beside_it(made):
    first = ensure("pin", "3.9", "json")
    assert made == [("pin==3.9", "cmeel-urdfdom<5", "cmeel-tinyxml2<11")]
    assert ensure("pin", "3.9.0", "json").folder == first.folder  # the same version
    assert [one.name for one in all_kept()] == [kept_name("pin", "3.9")]
    assert first.packages["numpy"]


def test_another_need_makes_it_anew(made, monkeypatch):
    ensure("pin", "3.9", "json")
    monkeypatch.setattr(environments, "needed_beside", lambda package, version: ("something",))
    ensure("pin", "3.9", "json")
    assert [asked[1:] for asked in made] == [("cmeel-urdfdom<5", "cmeel-tinyxml2<11"), ("something",)]


def test_one_that_was_cut_off_is_not_whole_and_is_made_anew(made):
    name = kept_name("mujoco", "3.3.7")
    folder = environments_folder() / name
    environment(folder)
    assert kept(name) is None
    assert engine_version("mujoco@3.3.7") == ""
    (folder / "left over").write_text("")
    ensure("mujoco", "3.3.7", "json")
    assert kept(name) is not None
    assert not (folder / "left over").exists()


@pytest.mark.slow
@pytest.mark.parametrize("content", ["", "[]", "{}", '{"format": 2}', '{"format": 1, "python": 3}'])
def test_a_marker_that_is_none_counts_for_nothing(made, content):
    found = ensure("mujoco", "3.3.7", "json")
    (found.folder / environments.MARKER).write_text(content)
    assert kept(found.name) is None
    assert all_kept() == []


def test_a_version_that_cannot_be_installed_is_one_line(made, monkeypatch):
    def no(self, python, requirements):
        raise NotInstalled("no matching distribution")

    monkeypatch.setattr(Installer, "install", no)
    with pytest.raises(EngineMissing) as found:
        ensure("mujoco", "3.12.5", "mujoco")
    words = str(found.value)
    assert words.startswith("mujoco 3.12.5 cannot be installed: no matching distribution")
    assert words.endswith("releases near it: 3.12.0, 3.13.0")
    assert "\n" not in words
    assert not (environments_folder() / kept_name("mujoco", "3.12.5")).exists()


def test_one_whose_engine_cannot_be_imported_is_not_kept(made):
    with pytest.raises(EngineMissing, match=r"it is installed and cannot be imported: .*no_such_module"):
        ensure("mujoco", "3.3.7", "no_such_module")
    assert all_kept() == []


def test_it_is_an_engine(made):
    # What the fake installer "installs" is the MuJoCo that is here.
    assert why_missing("mujoco@3.3.7") == ""
    assert engine_version("mujoco@3.3.7") == engine_version("mujoco")
    assert "made by furiko" in engine_place("mujoco@3.3.7")


def test_it_is_removed(made):
    found = ensure("mujoco", "3.3.7", "json")
    remove(found.name)
    assert all_kept() == []
    assert not found.folder.exists()
    for name in (found.name, "..", "", "a/b"):
        with pytest.raises(InvalidInput):
            remove(name)


def _slow(folder: str, count: str) -> None:
    os.environ["FURIKO_CACHE"] = folder

    def create(self, path):
        with open(count, "a") as file:
            file.write("made\n")
        time.sleep(0.5)
        environment(path)

    Installer.create = create
    Installer.install = lambda self, python, requirements: None
    ensure("mujoco", "3.3.7", "json")


def test_of_two_at_once_one_makes_it_and_the_other_waits(tmp_path):
    count = tmp_path / "count"
    makers = [
        multiprocessing.get_context("fork").Process(target=_slow, args=(str(tmp_path / "cache"), str(count)))
        for _ in range(2)
    ]
    for maker in makers:
        maker.start()
    for maker in makers:
        maker.join(60)
    assert [maker.exitcode for maker in makers] == [0, 0]
    assert count.read_text() == "made\n"


def test_a_maker_that_is_killed_leaves_nothing_that_looks_whole(tmp_path):
    maker = multiprocessing.get_context("fork").Process(
        target=_slow, args=(str(tmp_path / "cache"), str(tmp_path / "count"))
    )
    maker.start()
    deadline = time.monotonic() + 30
    while not (tmp_path / "count").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    maker.kill()
    maker.join()
    assert all_kept() == []
    _slow(str(tmp_path / "cache"), str(tmp_path / "count"))  # and the lock is free
    assert len(all_kept()) == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "ERROR: Could not find a version that satisfies the requirement x==9 (from versions: 1.0, 2.0)\n"
            "ERROR: No matching distribution found for x==9\n",
            "Could not find a version that satisfies the requirement x==9 for Python",
        ),
        (
            'Traceback (most recent call last):\n  File "<string>", line 1\nImportError: libx.so.4\n',
            "ImportError: libx",
        ),
        ("", "without a word"),
    ],
)
def test_an_installer_s_words_become_one_line(text, words):
    found = installing._words(text)
    assert words in found
    assert "\n" not in found


def test_releases_are_read_from_what_pip_prints(monkeypatch):
    printed = {
        "mujoco": "mujoco (4.0.0)\nAvailable versions: 4.0.0, 3.17.0, 3.9.0, 4.1.0rc1, 3.10.0\n",
        "mujoco-core": "",
    }
    printed["mujoco-core"] = "mujoco-core (4.0.1)\nAvailable versions: 4.0.1, 4.0.0\n"
    monkeypatch.setattr(index, "run", lambda command, limit: printed[command[-1]])
    monkeypatch.setattr(index, "pip", lambda: ["pip"])
    index.versions_of.cache_clear()
    assert index.releases("mujoco") == {
        "3.9.0": "mujoco", "3.10.0": "mujoco", "3.17.0": "mujoco", "4.0.0": "mujoco", "4.0.1": "mujoco-core",
    }  # fmt: skip
    assert index.provider("mujoco", "4.0.1") == "mujoco-core"
    assert index.provider("mujoco", "4.0") == "mujoco"
    index.versions_of.cache_clear()


def test_the_marker_says_what_was_made(made):
    found = ensure("mujoco", "3.3.7", "json")
    content = json.loads((found.folder / environments.MARKER).read_text())
    assert content["requirements"] == ["mujoco==3.3.7", "numpy"]
    assert Path(found.executable).exists()
