"""What surrounds the command line goes wrong: each fault in a real process, which ends with a status of its own."""

import json

import jsonschema
import msgspec
import pytest
from hostile_inputs import arguments, forked, wrong
from surroundings import Place
from surroundings_faults import CHECK, FAULTS

from furiko.checks.cache import user_cache
from furiko.cli.failures import Failure, failure_of
from furiko.cli.main import run
from furiko.cli.process import Stopped
from furiko.records.schema import FOLDER

QUICK = (
    "scenes, closed standard output",
    "scenes, full standard output",
    "check, reader that is gone",
    "check, full standard output",
    "scenes, no standard stream at all",
    "SIGTERM in a check",
    "SIGHUP in a check",
    "SIGTERM after 4.0 s of bench bench-rods-2 -e exudyn-redundant --budget 20",
    "a disk that fills up at the end",
    "a disk that fills up in the middle",
    "a journal that is a pipe",
    "a journal that is a folder",
    "lesson --out file/x",
    "bench --out /dev/null/x",
    "8 file handles",
    "grade of a pipe",
    "diff of /dev/zero",
    "check of a path of 5,000 characters",
    "grade of a key of 20,000 dots",
    "check of a hexadecimal number of 150,000 digits",
    "a name that acts on a terminal, check",
    "a scene's name that is not UTF-8, JSON",
    "a mistake in furiko",
    "a mistake in furiko, JSON",
    "a library that ends the process",
    "a pipe within furiko that breaks",
    "no word at all",
)


def test_every_fault_has_its_own_name_or_command_line():
    assert set(QUICK) <= {fault.name for fault in FAULTS}
    assert len(FAULTS) >= 60


@pytest.mark.slow
@pytest.mark.parametrize(
    "fault",
    [
        pytest.param(fault, marks=() if fault.name in QUICK else pytest.mark.sweep, id=fault.name[:60])
        for fault in FAULTS
    ],
)
def test_a_fault_of_the_surroundings_is_borne(fault, tmp_path):
    assert fault.wrong(Place(tmp_path)) == []


@pytest.mark.slow
@pytest.mark.parametrize("number", [*range(8), *(pytest.param(k, marks=pytest.mark.sweep) for k in range(8, 40))])
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")  # threads, and a fork
def test_a_hostile_input_is_borne(number, tmp_path):
    words = arguments(number, 2018, tmp_path)
    assert wrong(words, forked(Place(tmp_path), words)) == []


@pytest.mark.parametrize(
    ("words", "status"),
    [
        (["check", "no-such-scene"], 2),
        (["check", "--frobnicate"], 2),
        (["chekc"], 2),
        (["grade", "nowhere.toml"], 2),
        (["grade"], 2),
        (["diff", "a", "b"], 2),
        (["diagnose", "nowhere.xml"], 2),
        (["bench", "-e", "mujoco", "no-such-scene"], 2),
        (["stress", "-a", "nothing"], 2),
        (["export", "rods-1"], 2),
    ],
)
def test_an_error_with_json_is_one_document(words, status, capfd):
    assert run([*words, "--json"]) == status
    printed = capfd.readouterr()
    document = json.loads(printed.out)
    schema = json.loads((FOLDER / "error.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(document)
    assert document["error"]["what"]
    assert len(printed.err.splitlines()) == 1


@pytest.mark.parametrize(
    ("message", "parts"),
    [
        ("a.toml: masses[0]: must be positive, got -1", ("must be positive, got -1", "a.toml: masses[0]", "")),
        ("a.toml: cannot be read: it is a pipe; a file is needed",
         ("cannot be read: it is a pipe", "a.toml", "a file is needed")),
        ("engine: no engine is called 'mujoko' (did you mean 'mujoco'?)",
         ("no engine is called 'mujoko'", "engine", "did you mean 'mujoco'?")),
        ("'x': no such command (did you mean 'y'?); commands are y, z",
         ("no such command", "'x'", "did you mean 'y'?; commands are y, z")),
        ("something went wrong", ("something went wrong", "", "")),
    ],
)  # fmt: skip
def test_a_message_is_told_apart(message, parts):
    assert Failure(message, 2).parts() == parts


@pytest.mark.parametrize(("number", "status"), [(1, 129), (2, 130), (15, 143)])
def test_a_signal_is_the_status_that_a_shell_gives_it(number, status):
    assert failure_of(Stopped(number)).status == status


def test_a_document_is_not_followed_by_an_error(monkeypatch, capfd):
    """An interrupt after the document is printed: standard output has one document still."""

    def stopped():
        raise KeyboardInterrupt

    monkeypatch.setattr("furiko.cli.main.flush", stopped)
    assert run(["cache", "--json"]) == 130
    assert set(json.loads(capfd.readouterr().out)) == {"folder", "entries", "bytes", "limit", "kinds"}


def test_the_nearest_option_and_command_are_named(capfd):
    for words, says in ((["chek"], "'check'"), (["check", "--profil", "x"], "--profile")):
        assert run(words) == 2
        assert says in capfd.readouterr().err


def test_the_cache_says_what_it_holds(tmp_path, capfd):
    assert run(["check", "rods-1", "-e", "mujoco", "--profile", "smoke", "--out", str(tmp_path)]) == 0
    capfd.readouterr()
    assert run(["cache", "--json"]) == 0
    found = json.loads(capfd.readouterr().out)
    assert {name: kind["entries"] for name, kind in found["kinds"].items()} == {"results": 1, "truths": 1}
    assert found["bytes"] == sum(path.stat().st_size for path in user_cache().entries())
    assert found["limit"] == user_cache().largest
    assert run(["cache"]) == 0
    assert "least recently used" in capfd.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "status"),
    [((), 0), (("--sharp",), 1), (("--baseline", "b"), 1), (("--baseline", "b", "--no-sharp"), 0)],
)
def test_a_loose_result_is_a_difference_where_that_is_asked_for(options, status, tmp_path, monkeypatch, capfd):
    import furiko.run

    monkeypatch.chdir(tmp_path)
    assert run([*CHECK, "--out", "b"]) == 0
    sound = furiko.run.check

    def loose(*words, **options):
        found = sound(*words, **options)
        results = tuple(msgspec.structs.replace(result, loose=True) for result in found.results)
        return type(found)(found.header, results, msgspec.structs.replace(found.footer, loose=len(results)))

    monkeypatch.setattr("furiko.run.check", loose)
    assert run([*CHECK, *options]) == status


def test_what_was_asked_for_is_in_the_header(tmp_path):
    import furiko.run

    found = furiko.run.check(["rods-1"], ["mujoco"], profile="smoke")
    assert [scene.asked for scene in found.header.scenes] == [engine.asked for engine in found.header.engines] == [True]
    assert not any(engine.asked for engine in furiko.run.check(["rods-1"], profile="smoke").header.engines)
