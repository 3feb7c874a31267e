"""``furiko versions`` from end to end, without a network: releases that are all the engine that is here, some with a
planted fault. The fault is MuJoCo's own of 2025: the rotation of a URDF's inertial is lost."""

import json
import shutil

import jsonschema
import pytest
from places import environment

from furiko.cli.main import run
from furiko.engines.places import index
from furiko.engines.places.installing import Installer, NotInstalled
from furiko.records.schema import FOLDER
from furiko.reports.pages.versions_page import to_versions_page
from furiko.versions import versions

pytest.importorskip("mujoco")
RELEASES = [f"5.{k}" for k in range(8)]
# Put in when MuJoCo is imported, and not before: its import starts this Python again, which would do so in turn.
FAULT = """
import importlib.util, sys

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name != "mujoco":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        load = spec.loader.exec_module
        def exec_module(module):
            load(module)
            right = module.MjModel.from_xml_path
            def lost(path, *more):
                model = right(path, *more)
                if path.endswith("inertial-rpy.urdf"):  # as if rpy were "0 0 0"
                    model.body_inertia[1], model.body_iquat[1] = (0.01, 0.02, 0.025), (1, 0, 0, 0)
                return model
            module.MjModel.from_xml_path = staticmethod(lost)
        spec.loader.exec_module = exec_module
        return spec

sys.meta_path.insert(0, Finder())
"""


@pytest.fixture
def planted(tmp_path, monkeypatch):
    """A function that says from which release on the fault is there, and which cannot be installed."""
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(index, "versions_of", lambda package: tuple(RELEASES) if package == "mujoco" else ())
    faulty, gone = set(), set()

    def create(self, folder):
        made = environment(folder)
        version = folder.name.split("-")[1]
        if version in faulty:
            packages = next((made / "lib").glob("python*")) / "site-packages"
            (packages / "fault.py").write_text(FAULT)
            (packages / "z.pth").write_text("import fault\n")  # after here.pth, which finds the engine

    def install(self, python, requirements):
        if requirements[0].removeprefix("mujoco==") in gone:
            shutil.rmtree(python.parent)
            raise NotInstalled("no matching distribution")

    monkeypatch.setattr(Installer, "create", create)
    monkeypatch.setattr(Installer, "install", install)

    def plant(first, missing=()):
        faulty.update(RELEASES[RELEASES.index(first) :])
        gone.update(missing)

    return plant


@pytest.mark.slow
def test_the_release_that_lost_the_rotation_is_named(planted):
    planted("5.3")
    found = versions("mujoco", scenes=["rods-1"])
    grave = [change for change in found.changes if change.kind == "verdict"]
    assert [(change.release, change.before, change.probe) for change in grave] == [
        ("5.3", "5.2", "urdf-inertial-rpy.urdf")
    ]
    assert "drops the rotation of an inertial" in grave[0].says
    looked = [row.version for row in found.releases if row.looked_at]
    assert looked[0] == "5.0"
    assert looked[-1] == "5.7"
    assert len(looked) <= 2 + 3
    for row in found.releases:
        assert {look.outcome for look in row.looks if look.of == "theory"} <= {"agrees"}
    page = to_versions_page(found)
    assert "mujoco: 5.3 changed an answer" in page


@pytest.mark.slow
def test_one_that_cannot_be_installed_is_told_and_passed_over(planted, tmp_path, capsys, monkeypatch):
    planted("5.2", missing=["5.1"])
    monkeypatch.setattr("furiko.engines.places.environments.near", lambda package, version: ["5.0", "5.2"])
    monkeypatch.setattr("furiko.versions.SCENES", ("rods-1",))
    status = run(["versions", "mujoco", "--to", "5.3", "--every", "--json", "--out", str(tmp_path / "out")])
    document = json.loads(capsys.readouterr().out)
    assert status == 3
    jsonschema.Draft202012Validator(json.loads((FOLDER / "versions.json").read_text())).validate(document)
    rows = {row["version"]: row for row in document["releases"]}
    assert list(rows) == ["5.0", "5.1", "5.2", "5.3"]
    assert rows["5.1"]["missing"].startswith("mujoco 5.1 cannot be installed: no matching distribution")
    verdicts = [change for change in document["changes"] if change["kind"] == "verdict"]
    assert [(change["before"], change["release"], change["between"]) for change in verdicts] == [("5.0", "5.2", 1)]
    assert json.loads((tmp_path / "out" / "versions.json").read_text()) == document


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["mujoco", "--from", "5.7"], 2, "two releases are needed"),
        (["mujoco", "--from", "new"], 2, "'new' is no version"),
        (["no-such"], 2, "no engine is called"),
        (["mujoco@3.3.7"], 2, "an engine with a package is needed"),
    ],
)
def test_bad_input_is_one_line(planted, arguments, status, words, capsys):
    assert run(["versions", *arguments]) == status
    found = capsys.readouterr()
    assert words in found.err
    assert len(found.err.splitlines()) == 1


def test_an_index_that_does_not_answer_is_one_line(monkeypatch, capsys):
    def no(command, limit):
        raise NotInstalled("no route to host")

    monkeypatch.setattr(index, "run", no)
    index.versions_of.cache_clear()
    assert run(["versions", "mujoco"]) == 3
    assert "the package index does not say which releases there are: no route to host" in capsys.readouterr().err
