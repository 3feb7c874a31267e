"""What is kept is found again, only for the very same inputs, and its failures cost nothing but time."""

import ast
import hashlib
import importlib
import multiprocessing
import os
import re
import sys
from dataclasses import replace

import pytest
from msgspec import json, structs
from package_rooms import ROOMS, ROOT

import furiko
from furiko.checks import cache as module
from furiko.checks import foundations
from furiko.checks.cache import Cache
from furiko.checks.foundations import package_foundation
from furiko.checks.plan import make_plan
from furiko.engines import ENGINES, OWN_EQUATIONS
from furiko.records.check import Result

RESULT = Result(
    scene="rods-2",
    engine="mujoco",
    check="accelerations",
    comparison="accelerations",
    outcome="agrees",
    measured=1.5,
    unit="ε",
)


@pytest.fixture
def task():
    return make_plan(["rods-2"], ["mujoco"], "smoke").tasks[0]


@pytest.fixture
def cache(tmp_path):
    return Cache(tmp_path / "cache")


def test_results_are_found_again_and_marked(cache, task):
    assert cache.results(task) is None
    cache.keep_results(task, [RESULT])
    (found,) = cache.results(task).results
    assert found.kept
    assert (found.measured, found.outcome) == (1.5, "agrees")


def test_any_other_input_is_another_entry(cache, task, monkeypatch):
    cache.keep_results(task, [RESULT])
    scene = task.scene
    others = [
        replace(task, random_states=21),
        replace(task, few_steps=21),
        replace(task, engine="exudyn-tree"),
        replace(task, checks=("energy",)),
        replace(task, scene=replace(scene, theta=(1.0, 1.0))),
        replace(task, scene=replace(scene, duration=3.0)),
        replace(task, scene=replace(scene, system=furiko.RodChain(scene.system.lengths, density=0.9))),
    ]
    assert all(cache.results(other) is None for other in others)
    monkeypatch.setattr(module, "own_foundation", lambda: b"another version of furiko")
    assert cache.results(task) is None


def test_the_key_has_every_input(task, monkeypatch):
    """Each changes what an answer may be; none is left to what else is looked at when an entry is read."""
    scene = task.scene
    numbers = ("theta", "omega", "duration", "random", "named", "tags", "name", "system")
    values = ((1.0, 1.0), (1.0, 1.0), 3.0, 7, ("hanging",), ("other",), "other", furiko.RodChain((1.0, 0.5)))
    others = [replace(task, scene=replace(scene, **{name: value})) for name, value in zip(numbers, values, strict=True)]
    others += [replace(task, random_states=21), replace(task, few_steps=21), replace(task, checks=("energy",))]
    pinocchio = [replace(task, engine=name) for name in ("pinocchio-aba", "pinocchio-crba")]  # of one package
    keys = {module._results_key(each) for each in (task, *others, *pinocchio)}
    assert len(keys) == 1 + len(others) + 2
    assert len({module._facts_key(scene, count, True) for count in (20, 21)}) == 2
    assert module._facts_key(scene, 20, True) != module._facts_key(scene, 20, False)  # without derivatives
    before = module._results_key(task)
    monkeypatch.setattr(module, "package_foundation", lambda *_: b"another build")
    assert module._results_key(task) != before
    assert module._digest("a", "bc") != module._digest("ab", "c")


def test_every_room_and_library_that_a_result_is_made_with_is_part_of_its_foundation():
    """As the imports tell: all that ``checks`` reaches, but for derivations, which only a user's own equations ask for:
    those are no engine's, and are not kept.
    """
    rooms = {room: "".join(path.read_text() for path in (ROOT / room).rglob("*.py")) for room in ROOMS}
    reached, left = set(), {"checks"}
    while left:
        here = left.pop()
        reached.add(here)
        left |= set(re.findall(r"^ *from \.\.+(\w+)", rooms[here], flags=re.MULTILINE)) & set(ROOMS) - reached
    assert reached - {"derivations"} == set(foundations.ROOMS)
    assert not package_foundation(OWN_EQUATIONS.package, OWN_EQUATIONS.module)
    assert OWN_EQUATIONS.name not in ENGINES
    others = {"msgspec", "platformdirs", "llvmlite", "sympy"}  # carry results, come with numba, and formulas alone
    files = [path for room in ("reference", "checks") for path in (ROOT / room).rglob("*.py")]
    libraries = {name for path in files for name in libraries_of(path)} - set(sys.stdlib_module_names) - others
    assert libraries == set(foundations.SHARED.values())


def libraries_of(path):
    """What a file imports that is not furiko's: in statements, and by ``library("…")`` where it is used."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (name.name.partition(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module.partition(".")[0]
        elif isinstance(node, ast.Call) and ast.unparse(node.func) == "library":
            yield node.args[0].value.partition(".")[0]


def test_what_a_package_requires_is_part_of_it(tmp_path, monkeypatch):
    """A library that an installed package requires, of the same version, with one byte more."""
    for name, requires in (("outer", "Requires-Dist: inner\n"), ("inner", "")):
        (tmp_path / f"{name}.py").write_text("")
        info = tmp_path / f"{name}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n{requires}")
        (info / "RECORD").write_text(f"{name}.py,,\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    before = package_foundation("outer", "outer")
    package_foundation.cache_clear()
    (tmp_path / "inner.py").write_text("#")
    assert package_foundation("outer", "outer") != before


def test_what_a_users_model_file_gives_is_not_kept(task, tmp_path):
    """It may include others, and meshes."""
    (tree,) = make_plan(["cart-pole"], ["mujoco"], "smoke").tasks
    assert module._results_key(tree)
    assert module._results_key(replace(tree, scene=replace(tree.scene, model="robot.xml"))) is None


def test_a_failure_among_results_is_not_kept_either(cache, task):
    cache.keep_results(task, [RESULT, structs.replace(RESULT, check="accelerations, other states", outcome="error")])
    assert cache.results(task) is None


def test_a_failure_is_not_kept(cache, task):
    cache.keep_results(task, [RESULT, replace_outcome("error")])
    assert cache.results(task) is None


def test_results_lost_from_an_entry_make_it_run_again(cache, task):
    both = replace(task, checks=("accelerations", "terms"))
    terms = [structs.replace(RESULT, check=f"terms {part}", comparison="terms") for part in "MCG"]
    cache.keep_results(both, [RESULT, *terms])
    assert len(cache.results(both).results) == 4
    (path,) = cache.entries()
    for kept in ([RESULT], [RESULT, *terms[:1]], terms):
        lost = json.encode({"count": 4, "results": kept, "diagnoses": []})
        path.write_bytes(hashlib.sha256(lost).digest() + lost)
        assert cache.results(both) is None
    whole_check = json.encode({"count": 1, "results": [RESULT], "diagnoses": []})
    path.write_bytes(hashlib.sha256(whole_check).digest() + whole_check)
    assert cache.results(both) is None


def test_an_engine_from_elsewhere_is_never_kept(cache, task):
    """Nobody knows what its answers rest on: its file, those it imports, an engine that it wraps."""
    foreign = replace(task, engine="fake_engines:Right")
    cache.keep_results(foreign, [structs.replace(RESULT, engine="fake_engines:Right")])
    assert cache.results(foreign) is None
    assert cache.entries() == []


def installed(folder, module="someengine", package="some-engine"):
    """A package as pip leaves it, with one Python file and one library."""
    (folder / module).mkdir()
    (folder / module / "__init__.py").write_text("")
    (folder / module / "core.so").write_bytes(b"library")
    info = folder / "some_engine-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
    (info / "RECORD").write_text(f"{module}/__init__.py,,\n{module}/core.so,,\n")
    importlib.invalidate_caches()
    return package, module


def edit_library(folder):
    (folder / "someengine" / "core.so").write_bytes(b"libraRy")


def edit_and_set_back_the_clock(folder):
    path = folder / "someengine" / "core.so"
    status = path.stat()
    path.write_bytes(b"libraRy")
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def delete_library(folder):
    (folder / "someengine" / "core.so").unlink()


def hide_behind_another(folder):
    (folder / "front").mkdir()
    (folder / "front" / "someengine.py").write_text("raise ImportError('broken')")
    sys.path.insert(0, str(folder / "front"))


@pytest.mark.parametrize("change", [edit_library, edit_and_set_back_the_clock, delete_library, hide_behind_another])
def test_an_engine_whose_code_changed_under_the_same_version_is_another(tmp_path, monkeypatch, change):
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    package, module = installed(tmp_path)
    before = package_foundation.__wrapped__(package, module)
    assert before
    assert package_foundation.__wrapped__(package, module) == before
    change(tmp_path)
    importlib.invalidate_caches()
    assert package_foundation.__wrapped__(package, module) != before


def test_it_is_not_known_what_an_editable_install_rests_on(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    package, module = installed(tmp_path)
    source = '{"dir_info": {"editable": true}, "url": "file:///home/me/engine"}'
    (tmp_path / "some_engine-1.0.dist-info" / "direct_url.json").write_text(source)
    assert package_foundation.__wrapped__(package, module) == b""


def test_an_engine_that_is_gone_rests_on_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    assert package_foundation.__wrapped__("some-engine", "someengine") == b""


def test_reference_data_are_part_of_what_a_result_rests_on(tmp_path, monkeypatch):
    for room in foundations.ROOMS:
        (tmp_path / room).mkdir()
    data = tmp_path / "reference" / "data" / "endpoints.json"
    data.parent.mkdir()
    monkeypatch.setattr(foundations, "__file__", str(tmp_path / "checks" / "foundations.py"))
    monkeypatch.setattr(foundations, "own_code", foundations.own_code.__wrapped__)  # computed anew each time
    digests = set()
    for content in ("0.51", "0.52"):
        data.write_text(content)
        digests.add(foundations.own_foundation.__wrapped__())
    assert len(digests) == 2


def test_what_a_run_compiles_is_no_other_code(tmp_path, monkeypatch):
    (tmp_path / "reference" / "__pycache__").mkdir(parents=True)
    (tmp_path / "reference" / "kernel.py").write_text("code")
    monkeypatch.setattr(foundations, "__file__", str(tmp_path / "checks" / "foundations.py"))
    before = foundations.own_code.__wrapped__()
    for name in ("kernel.cpython-311.pyc", "kernel.batch-1.py311.nbi", "kernel.batch-1.py311.1.nbc"):
        (tmp_path / "reference" / "__pycache__" / name).write_bytes(b"compiled")
    assert foundations.own_code.__wrapped__() == before
    (tmp_path / "reference" / "kernel.py").write_text("edited")
    assert foundations.own_code.__wrapped__() != before


def test_the_folder_is_bounded_and_what_was_used_last_stays(tmp_path, task):
    cache = Cache(tmp_path / "cache", largest=1000)
    for states in range(4):
        cache.keep_facts(task.scene, states, b"x" * 300)
    for age, path in enumerate(sorted(cache.entries())):
        os.utime(path, (1000 - age, 1000 - age))
    assert cache.facts(task.scene, 2) is not None  # used just now
    cache.trim()
    assert sum(path.stat().st_size for path in cache.entries()) <= 1000
    assert cache.facts(task.scene, 2) is not None
    assert cache.holds()["truths"].entries == len(cache.entries()) == 3


def replace_outcome(outcome):
    return Result(scene="rods-2", engine="mujoco", check="energy", comparison="energy", outcome=outcome, reason="once")


@pytest.mark.parametrize("damage", [b"", b"[", b"\x00" * 100, b'[{"kind": "result"}]'])
def test_a_damaged_entry_is_computed_again(cache, task, damage):
    cache.keep_results(task, [RESULT])
    cache.keep_facts(task.scene, 20, b"truth")
    for path in cache.entries():
        path.write_bytes(damage)
    assert cache.results(task) is None
    assert cache.facts(task.scene, 20) is None


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes that have a name")
@pytest.mark.parametrize("kind", ["pipe", "device", "folder", "itself", "sparse"])
def test_what_is_no_entry_in_the_place_of_one_is_computed_again_at_once(cache, task, kind):
    """A pipe would be waited for without end, a device read without end."""
    cache.keep_results(task, [RESULT])
    (entry,) = cache.entries()
    entry.unlink()
    if kind == "sparse":
        with entry.open("wb") as file:
            file.truncate(1 << 40)
    else:
        makers = {"pipe": os.mkfifo, "folder": os.mkdir, "itself": lambda path: os.symlink(path, path)}
        makers.get(kind, lambda path: os.symlink("/dev/zero", path))(entry)
    assert cache.results(task) is None


def test_truth_is_found_again(cache, task):
    cache.keep_facts(task.scene, 20, b"truth")
    assert cache.facts(task.scene, 20) == b"truth"
    assert cache.facts(task.scene, 21) is None


def test_a_folder_that_cannot_be_written_is_no_failure(tmp_path, task):
    (tmp_path / "file").write_text("")
    cache = Cache(tmp_path / "file" / "cache")
    cache.keep_results(task, [RESULT])
    assert cache.results(task) is None
    assert cache.entries() == []


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs Linux's /dev/full to stand for a full disk")
def test_a_full_disk_leaves_no_entry(cache, task, monkeypatch):
    from pathlib import Path

    def fail(self, content):
        with open("/dev/full", "wb", 0) as file:
            return file.write(content)

    monkeypatch.setattr(Path, "write_bytes", fail)
    cache.keep_results(task, [RESULT])
    monkeypatch.undo()
    assert cache.entries() == []


def test_no_cache_keeps_nothing(task):
    cache = Cache(None)
    cache.keep_results(task, [RESULT])
    assert cache.results(task) is None
    assert cache.clear() == 0


def test_clearing_deletes_every_entry(cache, task):
    cache.keep_results(task, [RESULT])
    cache.keep_facts(task.scene, 20, b"truth")
    assert cache.clear() == 2
    assert cache.results(task) is None


def _write_and_read(folder, task, times):
    cache = Cache(folder)
    for _ in range(times):
        cache.keep_results(task, [RESULT] * 50)
        found = cache.results(task)
        assert found is not None
        assert len(found.results) == 50


def test_two_processes_at_once_never_see_half_an_entry(tmp_path, task):
    context = multiprocessing.get_context("spawn")
    processes = [context.Process(target=_write_and_read, args=(tmp_path, task, 200)) for _ in range(2)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert [process.exitcode for process in processes] == [0, 0]


def test_a_second_run_gives_the_same_verdicts_from_the_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path))

    def run(**options):
        found = furiko.check(["rods-2"], ["mujoco", "pinocchio-aba"], profile="smoke", **options).results
        return {(r.engine, r.check): (r.outcome, r.measured, r.allowed) for r in found}, {r.kept for r in found}

    first, computed = run()
    second, kept = run()
    third, again = run(use_cache=False)
    assert first == second == third
    assert (computed, kept, again) == ({False}, {True}, {False})


@pytest.mark.parametrize(("size", "kept"), [(68, True), (69, False)])
def test_an_entry_that_would_be_too_large_is_not_kept(cache, task, monkeypatch, size, kept):
    """Of 100 bytes 32 are its digest."""
    monkeypatch.setattr(module, "LARGEST_ENTRY", 100)
    cache.keep_facts(task.scene, 2, b"x" * size)
    assert bool(cache.entries()) == kept
    assert cache.facts(task.scene, 2) == (b"x" * size if kept else None)


def test_a_users_cache_is_where_it_was_said_and_no_larger_than_half_a_gibibyte(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path))
    assert module.user_cache() == Cache(tmp_path, 536_870_912)
