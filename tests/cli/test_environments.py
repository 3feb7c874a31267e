"""``furiko environments``, and engines in places of their own on the command line."""

import json

import jsonschema
import pytest
from places import environment

from furiko.cli.main import run
from furiko.engines.places.environments import ensure, kept_name
from furiko.engines.places.installing import Installer
from furiko.records.schema import FOLDER


@pytest.fixture
def made(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(Installer, "create", lambda self, folder: environment(folder))
    monkeypatch.setattr(Installer, "install", lambda self, python, requirements: None)
    return kept_name("mujoco", "3.3.7")


def test_none_is_told(made, capsys):
    assert run(["environments"]) == 0
    assert "There are none" in capsys.readouterr().out
    assert run(["environments", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == []


def test_they_are_listed_and_removed(made, capsys):
    ensure("mujoco", "3.3.7", "json")
    assert run(["environments"]) == 0
    assert made in capsys.readouterr().out
    assert run(["environments", "--json"]) == 0
    (row,) = document = json.loads(capsys.readouterr().out)
    jsonschema.Draft202012Validator(json.loads((FOLDER / "environments.json").read_text())).validate(document)
    assert (row["name"], row["requirements"]) == (made, ["mujoco==3.3.7", "numpy"])
    assert run(["environments", "--remove", "nothing"]) == 2
    assert "there is none called 'nothing'" in capsys.readouterr().err
    assert run(["environments", "--remove", "all"]) == 0
    assert "There are none" in capsys.readouterr().out


def test_two_places_in_one_report_and_the_cache_knows_their_binaries(tmp_path, monkeypatch, capsys):
    pytest.importorskip("mujoco")
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    environment(tmp_path / "one")
    environment(tmp_path / "two")
    names = ["./one:mujoco", "./two:mujoco"]
    command = ["check", "rods-1", "--profile", "smoke", "--json", "-e", names[0], "-e", names[1]]

    def kept():
        assert run(command) == 0
        document = json.loads(capsys.readouterr().out)
        entries = {entry["name"]: entry for entry in document["header"]["engines"]}
        assert all(entries[name]["version"] and name[:5] in entries[name]["place"] for name in names)
        return {result["engine"]: result["kept"] for result in document["results"]}

    assert kept() == dict.fromkeys(names, False)
    assert kept() == dict.fromkeys(names, True)


@pytest.mark.slow
def test_an_engine_elsewhere_is_listed_and_tested(tmp_path, monkeypatch, capsys):
    pytest.importorskip("mujoco")
    environment(tmp_path / "venv")
    name = f"{tmp_path}/venv:mujoco"
    assert run(["engines", name, "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    assert row["name"] == name
    assert row["version"]
    assert run(["engine-test", name]) == 0
    assert "The adapter conforms" in capsys.readouterr().out
